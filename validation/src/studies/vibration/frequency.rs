//! The frequency with which a meshed sphere vibrates.

use std::f64::consts::PI;

use fem_explicit::FreeMotion;
use fem_material::{ElasticModuli, Material};
use fem_mesh::{HalfDisc, Side};

use super::spheroidal::Vibration;
use crate::error::StudyError;

/// Half-width of the window of the spectrum in which the peak is searched, as a share of the
/// exact frequency; the discrete mode is much nearer.
const SEARCH: f64 = 0.04;
/// Accuracy of the peak, as a share of the frequency.
const RESOLUTION: f64 = 1e-8;

/// Returns the frequency ω R/c_s of a unit sphere that starts with the velocities of a vibration,
/// and the number of element updates.
///
/// It is the peak of the spectrum of Σ m v₀·u over a number of periods with Hann's window.
pub fn frequency(
    exact: &Vibration,
    poissons_ratio: f64,
    elements_over_radius: f64,
    periods: f64,
) -> Result<(f64, u64), StudyError> {
    let mut sphere = unit_sphere(poissons_ratio, elements_over_radius)?;
    sphere.set_velocity(|[r, y]| exact.displacement([r, y - 1.0]));
    let start = sphere.velocity().to_vec();
    let time_step = sphere.time_step();
    let n_steps = (periods * 2.0 * PI / exact.frequency / time_step) as usize;
    let signal: Vec<f64> = (0..n_steps)
        .map(|_| {
            sphere.step();
            projection(&sphere, &start)
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
    let peak = peak(strength, (1.0 - SEARCH) * exact.frequency, (1.0 + SEARCH) * exact.frequency);
    Ok((peak, (n_steps * sphere.body().n_elements()) as u64))
}

/// Returns the material with G = ρ = R = 1, so that c_s = 1.
fn unit_sphere(poissons_ratio: f64, elements_over_radius: f64) -> Result<FreeMotion, StudyError> {
    let moduli = ElasticModuli::from_youngs_modulus_poissons_ratio(
        2.0 * (1.0 + poissons_ratio),
        poissons_ratio,
    );
    let material = moduli.and_then(|moduli| Material::new(1.0, moduli, None))?;
    let disc = HalfDisc {
        radius: 1.0,
        contact_element_size: elements_over_radius.recip(),
        refined_radius: 0.5,
        growth: None,
        edge: None,
    };
    Ok(FreeMotion::new(disc.build()?.on_side(Side::Above), &material, 0.9)?)
}

/// Returns Σ m a·u.
fn projection(sphere: &FreeMotion, a: &[[f64; 2]]) -> f64 {
    let moved = a.iter().zip(sphere.displacement());
    let mass = sphere.body().nodal_mass().iter();
    mass.zip(moved).map(|(m, (a, u))| m * (a[0] * u[0] + a[1] * u[1])).sum()
}

/// Returns the place of the largest value of a function with one peak between two places, by golden sections.
fn peak(value: impl Fn(f64) -> f64, mut low: f64, mut high: f64) -> f64 {
    let golden = (5f64.sqrt() - 1.0) / 2.0;
    let (mut a, mut b) = (high - golden * (high - low), low + golden * (high - low));
    let (mut at_a, mut at_b) = (value(a), value(b));
    while high - low > RESOLUTION * high {
        if at_a > at_b {
            (high, b, at_b) = (b, a, at_a);
            a = high - golden * (high - low);
            at_a = value(a);
        } else {
            (low, a, at_a) = (a, b, at_b);
            b = low + golden * (high - low);
            at_b = value(b);
        }
    }
    0.5 * (low + high)
}
