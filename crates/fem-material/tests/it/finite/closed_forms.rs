//! Laws against closed forms of the textbooks, in stretches, E and ν, which the code does not
//! use: it has K, G, and the tensors.

use fem_material::finite::HyperelasticLaw;

use super::{components, gradient_of, moduli, solid};

const RATIOS: [f64; 4] = [0.0, 0.244, 0.45, 0.495];

/// Roundings of 1e-16 times stresses that cancel on the free faces, up to 3K = 200.
const ROUNDING: f64 = 1e-12;

/// Radial (and hoop) and axial first Piola-Kirchhoff stress at such stretches.
fn stress(law: HyperelasticLaw, nu: f64, radial: f64, axial: f64) -> [f64; 2] {
    let h = gradient_of([radial, 0.0, 0.0, axial, radial]);
    let [rr, ry, yr, yy, tt] = components(&solid(law, nu).first_piola(&h).unwrap());
    assert_eq!((ry, yr), (0.0, 0.0));
    assert!((rr - tt).abs() < ROUNDING);
    [rr, yy]
}

/// The zero of an increasing function between two numbers.
fn zero(mut low: f64, mut high: f64, f: impl Fn(f64) -> f64) -> f64 {
    for _ in 0..200 {
        let middle = 0.5 * (low + high);
        *(if f(middle) < 0.0 { &mut low } else { &mut high }) = middle;
    }
    0.5 * (low + high)
}

/// The loaded stress and the stretch of the free faces where `n` axes, one or two, have an equal stretch x and stress and
/// the others none: uniaxial along y, or equibiaxial along r and θ.
fn assert_loaded(n: i32, stretches: [f64; 6]) {
    let m = f64::from(n);
    for nu in RATIOS {
        let (k, g) = (moduli(nu).bulk_modulus(), moduli(nu).shear_modulus());
        let lambda = moduli(nu).lame_lambda();
        // h_free = −ν h of one axis, −2ν/(1−ν) h of two, under E and E/(1−ν).
        let (thinning, modulus) = match n {
            1 => (nu, 2.0),
            _ => (2.0 * nu / (1.0 - nu), 2.0 / (1.0 - nu)),
        };
        for x in stretches {
            let check = |law, free: f64, expected: f64| {
                let what = format!("{law:?}, ν = {nu}, {n} stretches {x}");
                let ([loaded, at_rest], [radial, axial]) = match n {
                    1 => ([1, 0], [free, x]),
                    _ => ([0, 1], [x, free]),
                };
                let found = stress(law, nu, radial, axial);
                assert!(found[at_rest].abs() < ROUNDING, "{what}: free face {}", found[at_rest]);
                let found = found[loaded];
                assert!(
                    (found - expected).abs() < ROUNDING,
                    "{what}: {found}, expected {expected}"
                );
            };
            // τ = E h (Hencky 1928).
            check(HyperelasticLaw::Hencky, x.powf(-thinning), modulus * x.ln() / x);
            // The same of Green's strain and the second stress S = P/λ; thin at λ² = 1 + 1/ν.
            let strain = 0.5 * (x * x - 1.0);
            let free = (1.0 - 2.0 * thinning * strain).sqrt();
            check(HyperelasticLaw::SaintVenantKirchhoff, free, modulus * strain * x);
            // G (λ_t² − 1) + λ ln J = 0, and the difference of both: τ = G (λ² − λ_t²).
            let volume = |free: f64| x.powi(n) * free.powi(3 - n);
            let free = zero(0.2, 4.0, |t| g * (t * t - 1.0) + lambda * volume(t).ln());
            check(HyperelasticLaw::NeoHookeLn, free, g * (x * x - free * free) / x);
            // tr τ = 3K J (J − 1) = n τ = n G J^{−2/3} (λ² − λ_t²).
            let pressure = |j: f64| 3.0 / m * k * j * (j - 1.0);
            let free = zero(0.2, 4.0, |t| {
                let j = volume(t);
                pressure(j) - g * j.powf(-2.0 / 3.0) * (x * x - t * t)
            });
            check(HyperelasticLaw::NeoHooke, free, pressure(volume(free)) / x);
        }
    }
}

#[test]
fn uniaxial_and_equibiaxial_stress_equal_the_closed_forms() {
    assert_loaded(1, [0.6, 0.8, 0.99, 1.01, 1.2, 1.6]);
    assert_loaded(2, [0.7, 0.9, 0.99, 1.01, 1.1, 1.2]);
}

/// u_r = γ Y, which keeps the volume. Cauchy stresses rr, yy, tt, ry; those of neo-Hooke are in
/// Ogden (1984), section 4.4, Poynting's effect included.
#[test]
fn simple_shear_stress_equals_the_closed_forms() {
    for nu in RATIOS {
        let (g, lambda) = (moduli(nu).shear_modulus(), moduli(nu).lame_lambda());
        for gamma in [0.01, 0.3, 1.0, 2.5f64] {
            let square = gamma * gamma;
            let check = |law, expected: [f64; 4]| {
                let h = gradient_of([1.0, gamma, 0.0, 1.0, 1.0]);
                let s = solid(law, nu).cauchy(&h).unwrap();
                for (found, expected) in [s.rr, s.yy, s.tt, s.ry].iter().zip(expected) {
                    let error = (found - expected).abs();
                    // St Venant-Kirchhoff's grow as λ γ⁴.
                    assert!(error < 1e-11, "{law:?} {nu} {gamma}: {found} {expected}");
                }
            };
            let third = g * square / 3.0;
            check(HyperelasticLaw::NeoHooke, [2.0 * third, -third, -third, g * gamma]);
            check(HyperelasticLaw::NeoHookeLn, [g * square, 0.0, 0.0, g * gamma]);
            // Principal stretches e^{±asinh(γ/2)}; the larger one's axis has tan 2φ = 2/γ.
            let root = (4.0 + square).sqrt();
            let h = (0.5 * gamma).asinh();
            let normal = 2.0 * g * h * gamma / root;
            check(HyperelasticLaw::Hencky, [normal, -normal, 0.0, 4.0 * g * h / root]);
            // S = λ γ²/2 1 + 2G E with E_ry = γ/2, E_yy = γ²/2; σ = F S Fᵀ.
            let mean = 0.5 * lambda * square;
            let (s_rr, s_ry, s_yy) = (mean, g * gamma, mean + g * square);
            let rr = s_rr + 2.0 * gamma * s_ry + square * s_yy;
            check(HyperelasticLaw::SaintVenantKirchhoff, [rr, s_yy, mean, s_ry + gamma * s_yy]);
        }
    }
}

/// Rubber: G (λ − 1/λ²) of the incompressible solid (Treloar 1943). The effect of ν < 1/2 falls as
/// 1 − 2ν.
#[test]
fn nearly_incompressible_rubber_is_treloars() {
    let g = 1.0;
    let error = |law, nu: f64, x: f64| {
        let solid = fem_material::ElasticModuli::from_two(fem_material::ModuliInput {
            shear_modulus: Some(g),
            poissons_ratio: Some(nu),
            ..Default::default()
        });
        let solid = fem_material::finite::Hyperelastic::new(law, &solid.unwrap());
        let at = |radial: f64| {
            let h = gradient_of([radial, 0.0, 0.0, x, radial]);
            components(&solid.first_piola(&h).unwrap())
        };
        let radial = zero(0.3, 2.0, |t| at(t)[0]);
        (at(radial)[3] - g * (x - 1.0 / (x * x))).abs()
    };
    for law in [HyperelasticLaw::NeoHooke, HyperelasticLaw::NeoHookeLn] {
        for x in [0.6, 1.7] {
            let (near, nearer) = (error(law, 0.495, x), error(law, 0.4995, x));
            let order = (near / nearer).log10();
            assert!((order - 1.0).abs() < 0.05, "{law:?} {x}: order {order}");
            assert!(near < 0.02, "{law:?} {x}: {near}");
        }
    }
}

/// The stresses of the docs for a bar of ν = 0.45 at 0.7 of its length are those of these closed forms.
#[test]
fn the_stresses_of_the_docs_are_right() {
    let page = concat!(env!("CARGO_MANIFEST_DIR"), "/../../docs/finite-strain.md");
    let page = std::fs::read_to_string(page).unwrap();
    let stresses = HyperelasticLaw::ALL.map(|law| {
        // At ν = 0.45 all lateral stretches lie in between; the stress grows with them.
        let radial = zero(0.6, 1.7, |t| stress(law, 0.45, t, 0.7)[0]);
        format!("−{:.2} E", -stress(law, 0.45, radial, 0.7)[1] / 2.0)
    });
    let [first, second, third, last] = stresses;
    let said = format!("{first}, {second}, {third} and {last}");
    assert!(page.contains(&said), "{said}");
}
