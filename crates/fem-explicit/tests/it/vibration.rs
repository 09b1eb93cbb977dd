//! Free vibration of a sphere: an exact test of element, mass and boundary without contact.
//!
//! Frequencies ω R/c_s at ν = 0.244 (Lamb 1882; the roots are listed in the project's notes).

use std::f64::consts::PI;

use fem_explicit::FreeMotion;
use fem_material::finite::HyperelasticLaw;

use crate::common::{unit_glass, unit_sphere};

/// Starts a unit sphere at rest with a velocity field of (r, y), y from its centre, and finds the
/// frequency near `guess` at which Σ m v₀·u, with a Hann window over 24 periods, is strongest.
fn frequency_of(
    mut sphere: FreeMotion,
    guess: f64,
    velocity: impl Fn([f64; 2]) -> [f64; 2],
) -> f64 {
    sphere.set_velocity(|[r, y]| velocity([r, y - 1.0]));
    let start = sphere.velocity().to_vec();
    let time_step = sphere.time_step();
    let n_steps = (24.0 * 2.0 * PI / guess / time_step) as usize;
    let signal: Vec<f64> = (0..n_steps)
        .map(|_| {
            sphere.step();
            let moved = start.iter().zip(sphere.displacement());
            let mass = sphere.body().nodal_mass().iter();
            mass.zip(moved).map(|(m, (v, u))| m * (v[0] * u[0] + v[1] * u[1])).sum()
        })
        .collect();
    let strength = |omega: f64| {
        let (mut re, mut im) = (0.0, 0.0);
        for (k, x) in signal.iter().enumerate() {
            let window = 1.0 - (2.0 * PI * (k as f64 + 0.5) / n_steps as f64).cos();
            let (sin, cos) = (omega * time_step * (k + 1) as f64).sin_cos();
            re += window * x * cos;
            im += window * x * sin;
        }
        re.hypot(im)
    };
    // The window's main lobe is 4·2π/length wide: one peak within 4 % of the guess.
    let (mut low, mut high) = (0.96 * guess, 1.04 * guess);
    let golden = (5f64.sqrt() - 1.0) / 2.0;
    while high - low > 1e-6 * guess {
        let (a, b) = (high - golden * (high - low), low + golden * (high - low));
        if strength(a) > strength(b) { high = b } else { low = a }
    }
    0.5 * (low + high)
}

/// Relative errors with 16 and 32 elements over the radius, and the order between.
#[test]
fn free_vibrations_have_the_frequencies_of_a_sphere() {
    for (mode, exact, [radial, axial], limit) in [
        // Uniform dilatation starts it; −0.24 and −0.06 % are measured.
        ("breathing, 0S0", 4.38361, [1.0, 1.0], 0.003),
        // Uniform isochoric strain starts it; −0.52 and −0.13 % are measured.
        ("oblate and prolate, 0S2", 2.63906, [-0.5, 1.0], 0.006),
    ] {
        let errors = [16.0, 32.0].map(|n| {
            let sphere = FreeMotion::new(unit_sphere(n), &unit_glass(None), 0.9).unwrap();
            frequency_of(sphere, exact, |[r, y]| [radial * r, axial * y]) / exact - 1.0
        });
        let order = (errors[0] / errors[1]).log2();
        assert!(errors[0].abs() < limit, "{mode}: {errors:?}");
        // Second order; the peak is found to 1e-6, a thousandth of the smaller error.
        assert!((1.9..2.1).contains(&order), "{mode}: {order} {errors:?}");
    }
}

/// Small vibrations at finite strain are those of small strain: at the same step the frequencies differ by
/// rounding, and by the strain.
#[test]
fn small_vibrations_at_finite_strain_have_small_strain_frequencies() {
    let mesh = || unit_sphere(8.0);
    for (guess, axial) in [(4.38361, 1.0), (2.63906, -2.0)] {
        let velocity = |[r, y]: [f64; 2]| [1e-9 * r, 1e-9 * axial * y];
        let small = FreeMotion::new(mesh(), &unit_glass(None), 0.5).unwrap();
        let time_step = small.time_step();
        let before = frequency_of(small, guess, velocity);
        for law in HyperelasticLaw::ALL {
            let at = |step_factor: f64| {
                FreeMotion::at_finite_strain(mesh(), &unit_glass(None), law, step_factor).unwrap()
            };
            let finite = at(0.5 * time_step / at(0.5).time_step());
            assert!((finite.time_step() / time_step - 1.0).abs() < 1e-14);
            let after = frequency_of(finite, guess, velocity);
            // Strains of 1e-9; the peak is found to 1e-6.
            assert!((after / before - 1.0).abs() < 1e-6, "{law:?}: {after} {before}");
        }
    }
}
