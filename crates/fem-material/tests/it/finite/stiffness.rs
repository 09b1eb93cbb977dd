//! ∂P/∂F: against differences of the stress, its largest eigenvalue, and where laws lose
//! ellipticity.

use fem_material::finite::{AxisymmetricTensor, Hyperelastic, HyperelasticLaw};

use super::{Random, components, gradient_of, moduli, solid, tensor};

fn differences(solid: &Hyperelastic, h: &AxisymmetricTensor) -> [[f64; 5]; 5] {
    let delta = 1e-5;
    let mut slopes = [[0.0; 5]; 5];
    for l in 0..5 {
        let at = |shift: f64| {
            let mut moved = components(h);
            moved[l] += shift;
            components(&solid.first_piola(&tensor(moved)).unwrap())
        };
        let (after, before) = (at(delta), at(-delta));
        for k in 0..5 {
            slopes[k][l] = (after[k] - before[k]) / (2.0 * delta);
        }
    }
    slopes
}

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
                let (found, expected) = (solid.tangent(&h).unwrap(), differences(&solid, &h));
                for (found, expected) in found.iter().flatten().zip(expected.iter().flatten()) {
                    let error = (found - expected).abs();
                    assert!(error < 1e-6, "{law:?} {nu}: {found} {expected}");
                }
            }
        }
    }
}

/// Equal stretches in the plane, and stretches on both sides of where the quotient gives way to
/// the derivative.
#[test]
fn the_tangent_is_smooth_where_two_stretches_meet() {
    for law in HyperelasticLaw::ALL {
        let solid = solid(law, 0.3);
        for difference in [0.0, 1e-9, 0.99e-5, 1.01e-5, 1e-3] {
            let h = gradient_of([1.2 + difference, 0.0, 0.0, 1.2, 0.9]);
            let (found, expected) = (solid.tangent(&h).unwrap(), differences(&solid, &h));
            for (found, expected) in found.iter().flatten().zip(expected.iter().flatten()) {
                assert!((found - expected).abs() < 1e-8, "{law:?} {difference}");
            }
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

/// The smallest n ⊗ m : A : n ⊗ m over unit vectors of the plane, which an elliptic law keeps
/// positive.
fn smallest_of_rank_one(a: &[[f64; 5]; 5]) -> f64 {
    let directions = (0..90).map(|k| (f64::from(k) * 2f64.to_radians()).sin_cos());
    directions
        .map(|(s, c)| {
            // m·Q m of the acoustic tensor Q of the direction (c, s): its smaller eigenvalue.
            let q = |i: usize, j: usize| {
                let of = |i: usize, n: usize| a[2 * i + n];
                let pairs = [(0, 0, c * c), (0, 1, c * s), (1, 0, s * c), (1, 1, s * s)];
                pairs.iter().map(|&(k, l, weight)| weight * of(i, k)[2 * j + l]).sum::<f64>()
            };
            let (mean, half) = (0.5 * (q(0, 0) + q(1, 1)), 0.5 * (q(0, 0) - q(1, 1)));
            mean - (half * half + q(0, 1) * q(0, 1)).sqrt()
        })
        .fold(f64::INFINITY, f64::min)
}

fn margin(law: HyperelasticLaw, nu: f64, f: [f64; 5]) -> f64 {
    smallest_of_rank_one(&solid(law, nu).tangent(&gradient_of(f)).unwrap())
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
