//! ∂P/∂F: against differences of the stress, its largest eigenvalue, and where laws lose
//! ellipticity.

use fem_material::finite::HyperelasticLaw;

use super::{Random, assert_slopes, gradient_of, moduli, product, rotation, solid, tensor};

/// The largest eigenvalue by powers of A + s 1, with s that makes all eigenvalues positive.
pub fn largest_by_powers(a: &[[f64; 5]; 5]) -> f64 {
    let shift = a.iter().flatten().map(|x| x.abs()).sum::<f64>();
    let mut v = [1.0, 0.3, -0.7, 0.5, 0.9];
    let mut value = 0.0;
    for _ in 0..20_000 {
        let w: [f64; 5] =
            std::array::from_fn(|k| (0..5).map(|l| a[k][l] * v[l]).sum::<f64>() + shift * v[k]);
        let length = w.iter().map(|x| x * x).sum::<f64>().sqrt();
        value = length - shift;
        v = w.map(|x| x / length);
    }
    value
}

/// Differences of P over 2δ err by δ²/6 P''' = 1e-10 times stiffnesses up to some hundred.
#[test]
fn the_tangent_is_the_derivative_of_the_stress() {
    let mut random = Random(6);
    for law in HyperelasticLaw::ALL {
        for nu in [-0.3, 0.0, 0.244, 0.495] {
            let solid = solid(law, nu);
            for _ in 0..50 {
                let h = random.gradient(0.4);
                let tangent = solid.tangent(&h).unwrap();
                assert_slopes(tangent, &h, 1e-6, |h| solid.first_piola(h).unwrap());
            }
        }
    }
}

/// F = R diag(1.3, 0.8) Q of the plane: rotations leave stretches as they are.
#[test]
fn principal_stretches_are_those_without_rotations() {
    for [first, second] in [[0.0, 0.0], [0.3, -1.1], [2.8, 0.4]] {
        let stretched =
            product(rotation(first), product([0.8, 0.0, 0.0, 1.3, 0.9], rotation(second)));
        let found = gradient_of(stretched).principal_stretches();
        for (found, expected) in found.iter().zip([1.3, 0.8, 0.9]) {
            assert!((found - expected).abs() < 1e-14, "{first} {second}: {found}");
        }
    }
}

/// Equal stretches in the plane, and stretches on both sides of the switch from the quotient to
/// the derivative.
#[test]
fn the_tangent_is_smooth_where_two_stretches_meet() {
    for law in HyperelasticLaw::ALL {
        let solid = solid(law, 0.3);
        for difference in [0.0, 1e-9, 0.99e-5, 1.01e-5, 1e-3] {
            let h = gradient_of([1.2 + difference, 0.0, 0.0, 1.2, 0.9]);
            let tangent = solid.tangent(&h).unwrap();
            assert_slopes(tangent, &h, 1e-8, |h| solid.first_piola(h).unwrap());
        }
    }
}

/// From above, and no further than 1e-6; powers have converged to 1e-9 where eigenvalues are apart.
#[test]
fn the_largest_stiffness_is_the_largest_eigenvalue_from_above() {
    let mut random = Random(7);
    for law in HyperelasticLaw::ALL {
        for nu in [-0.3, 0.0, 0.244, 0.45, 0.495] {
            let solid = solid(law, nu);
            for size in [1e-9, 0.05, 0.4] {
                let h = random.gradient(size);
                let found = solid.largest_stiffness(&h).unwrap();
                let exact = largest_by_powers(&solid.tangent(&h).unwrap());
                let excess = found / exact - 1.0;
                assert!((-1e-9..1e-6).contains(&excess), "{law:?} {nu} {size}: {excess:e}");
            }
        }
    }
    // Undeformed it is that of Hooke's law: 3K of a change of volume, 2G of shape.
    let rest = tensor([0.0; 5]);
    for nu in [-0.3, 0.0, 0.3] {
        let expected = (3.0 * moduli(nu).bulk_modulus()).max(2.0 * moduli(nu).shear_modulus());
        let found = solid(HyperelasticLaw::NeoHooke, nu).largest_stiffness(&rest).unwrap();
        assert!((found / expected - 1.0).abs() < 1e-6, "{nu}: {found} {expected}");
    }
}

fn margin(law: HyperelasticLaw, nu: f64, f: [f64; 5]) -> f64 {
    solid(law, nu).least_acoustic_stiffness(&gradient_of(f)).unwrap()
}

/// Undeformed it is that of a shear wave, G; and no m ⊗ N of any angles has less than the least found, but
/// for the angles that lie between.
#[test]
fn the_least_acoustic_stiffness_is_that_of_the_softest_wave() {
    let mut random = Random(10);
    for law in HyperelasticLaw::ALL {
        let solid = solid(law, 0.3);
        let rest = solid.least_acoustic_stiffness(&tensor([0.0; 5])).unwrap();
        assert!((rest / solid.shear_modulus() - 1.0).abs() < 1e-12, "{law:?}");
        for _ in 0..50 {
            let h = random.gradient(0.4);
            let (least, a) =
                (solid.least_acoustic_stiffness(&h).unwrap(), solid.tangent(&h).unwrap());
            let mut found = f64::INFINITY;
            for k in 0..100 * 100 {
                let angle = |k: i32| (std::f64::consts::PI * f64::from(k) / 100.0).sin_cos();
                let ((s, c), (big_s, big_c)) = (angle(k % 100), angle(k / 100));
                let wave = [c * big_c, c * big_s, s * big_c, s * big_s];
                let row = |i: usize| (0..4).map(|j| wave[i] * a[i][j] * wave[j]).sum::<f64>();
                found = found.min((0..4).map(row).sum());
            }
            let range = solid.largest_stiffness(&h).unwrap() - least;
            assert!((found - least).abs() < 2e-3 * range, "{law:?}: {found} {least}");
        }
    }
}

/// Under pressure the stiffness S + G λ² of a shear, with S = 3K (λ² − 1)/2, is zero at
/// λ² = 1/(1 + 2G/3K). In uniaxial strain P = ½ (λ+2G)(F³ − F) has its extreme at F² = 1/3, and
/// shear across it has no stiffness S_yy + G at F² = ν/(1−ν): by the larger of both it is lost.
#[test]
fn saint_venant_kirchhoff_collapses_in_compression() {
    for nu in [0.0, 0.2, 0.3, 0.45, 0.495] {
        let at = |f| margin(HyperelasticLaw::SaintVenantKirchhoff, nu, f);
        let (k, g) = (moduli(nu).bulk_modulus(), moduli(nu).shear_modulus());
        let limit = 1.0 / (1.0 + 2.0 * g / (3.0 * k)).sqrt();
        let pressed = |x: f64| at([x, 0.0, 0.0, x, x]);
        assert!(pressed(limit + 1e-4) > 0.0 && pressed(limit - 1e-4) < 0.0, "{nu} {limit}");
        let latest = (1.0f64 / 3.0).max(nu / (1.0 - nu)).sqrt();
        assert!(at([1.0, 0.0, 0.0, latest - 1e-4, 1.0]) < 0.0, "{nu} {latest}");
    }
}

/// In uniaxial strain P = M ln F/F has its extreme at F = e. Bruhns, Xiao & Meyers (2001) find
/// ellipticity for any moduli while stretches stay in 0.21162 .. 1.39561.
#[test]
fn hencky_softens_in_tension_alone() {
    let along = |y: f64| {
        solid(HyperelasticLaw::Hencky, 0.0).tangent(&gradient_of([1.0, 0.0, 0.0, y, 1.0])).unwrap()
            [3][3]
    };
    let limit = std::f64::consts::E;
    assert!(along(limit - 1e-3) > 0.0 && along(limit + 1e-3) < 0.0);

    let mut random = Random(8);
    let mut stretch = || 0.803615 + 0.591995 * random.next();
    for _ in 0..2000 {
        let f = [stretch(), 0.0, 0.0, stretch(), stretch()];
        for nu in [0.0, 0.3, 0.495] {
            assert!(margin(HyperelasticLaw::Hencky, nu, f) > 0.0, "{nu} {f:?}");
        }
    }
}

/// Both neo-Hooke laws are polyconvex, the one always, the other while ln J ≤ 1 + G/λ.
#[test]
fn neo_hooke_is_elliptic_at_any_compression() {
    let mut random = Random(9);
    for _ in 0..2000 {
        let mut stretch = || 10f64.powf(random.next());
        let f = [stretch(), 0.0, 0.0, stretch(), stretch()];
        for nu in [0.0, 0.3, 0.495] {
            assert!(margin(HyperelasticLaw::NeoHooke, nu, f) > 0.0, "{nu} {f:?}");
            let (g, lambda) = (moduli(nu).shear_modulus(), moduli(nu).lame_lambda());
            if (f[0] * f[3] * f[4]).ln() <= 1.0 + g / lambda {
                assert!(margin(HyperelasticLaw::NeoHookeLn, nu, f) > 0.0, "{nu} {f:?}");
            }
        }
    }
}
