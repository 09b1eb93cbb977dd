//! Impact of an elastic–plastic sphere by the mean pressure of its contact: sizes and times for a plan.
//!
//! The contact loads along the mean pressure p_m of finite-element computations, a function of x = E\*a/(Y R\*), with Hertz'
//! p_m = 4E\*a/(3πR\*) below first yield and the hardness of about 2.85 Y far beyond, and sinks in or piles up from
//! δ = a²/R\* to δ = a²/(2R\*) and beyond on the way (Johnson, *Contact Mechanics*, section 6.3),
//!
//! ```math
//! F = \pi a^2 p_m(x) \left(1 - \frac{a}{2R^*}\right), \qquad \delta = \frac{a^2}{c(x) R^*}, \qquad
//! \tfrac12 m^* v^2 = \int F\, d\delta .
//! ```
//!
//! It rebounds as a flat punch pressed by a uniform pressure does, W' = 3F²/(10 a E\*) (Johnson, section 11.5), with Hertz'
//! history of the force.

use std::f64::consts::PI;

use crate::hertz::{HertzImpact, contact_time_coefficient};
use crate::impact::ImpactQuantities;

/// x = E\*a/(Y R\*), and there p_m/Y for a small a/R\* and c = a²/(R\*δ), of an elastic–perfectly plastic ball on a rigid wall at
/// ν = 0.3 and E\*/Y = 230, by the elements of this program on meshes of 20 elements across the contact.
const LOADING: [[f64; 3]; 8] = [
    [2.2, 0.934, 1.0],
    [2.94, 1.25, 1.008],
    [3.97, 1.557, 1.048],
    [7.15, 2.04, 1.207],
    [12.1, 2.347, 1.418],
    [22.8, 2.67, 1.688],
    [39.4, 2.816, 1.945],
    [76.0, 2.84, 2.241],
];
/// Relative fall of the mean pressure with a/R\*.
const PRESSURE_OF_WIDE_CONTACTS: f64 = 0.5;
/// Number of steps of the loading.
const N_STEPS: usize = 400;

/// Returns the impact of spheres of which the softer one has a flow stress (Pa); Hertz' impact if it does not yield.
///
/// A plan takes its sizes from it. Against finite elements from 2 to 1000 times the speed of first yield the largest contact
/// radius and approach are within an eighth, and the contact time within a fifth.
pub fn elastic_plastic_impact(hertz: &HertzImpact, flow_stress: f64) -> ImpactQuantities {
    let (pair, speed) = (hertz.pair(), hertz.approach_speed());
    let (radius, modulus, mass) =
        (pair.effective_radius(), pair.contact_modulus(), pair.effective_mass());
    let unit = flow_stress * radius / modulus;
    if hertz.max_contact_radius() <= LOADING[0][0] * unit {
        return ImpactQuantities::from(hertz);
    }
    let energy = 0.5 * mass * speed * speed;
    let pressure = |a: f64| {
        let wide = (1.0 - PRESSURE_OF_WIDE_CONTACTS * a / radius).max(0.5);
        wide * flow_stress * loading(a / unit)[0]
    };
    let force = |a: f64| PI * a * a * pressure(a);
    let approach = |a: f64| a * a / (radius * loading(a / unit)[1]);
    // Steps of equal ratio from a contact that stores little energy.
    let first = 0.05 * hertz.max_contact_radius();
    let widest = 4.0
        * hertz
            .max_contact_radius()
            .max((4.0 * radius * energy / (PI * 2.0 * flow_stress)).powf(0.25));
    let ratio = (widest / first).powf(1.0 / N_STEPS as f64);
    let (mut a, mut work) = (first, 0.4 * force(first) * approach(first));
    let mut time = approach(first) / speed;
    loop {
        let next = ratio * a;
        let step = approach(next) - approach(a);
        let more = 0.5 * (force(a) + force(next)) * step;
        if work + more >= energy || next >= widest {
            let share = ((energy - work) / more).clamp(0.0, 1.0);
            // The speed falls as the root of the rest of the energy.
            time += 2.0 * share * step / (speed * (1.0 - work / energy).max(1e-12).sqrt());
            a *= ratio.powf(share);
            break;
        }
        let mean = 0.5 * ((1.0 - work / energy).sqrt() + (1.0 - (work + more) / energy).sqrt());
        time += step / (speed * mean);
        (a, work) = (next, work + more);
    }
    let peak_force = force(a);
    let returned = (0.3 * peak_force * peak_force / (a * modulus)).min(energy);
    let restitution = (returned / energy).sqrt();
    let unloaded = 2.5 * returned / peak_force;
    ImpactQuantities {
        restitution,
        contact_time: time + 0.5 * contact_time_coefficient() * unloaded / (restitution * speed),
        peak_force,
        max_approach: approach(a),
        max_contact_radius: a,
        // The pressure of a contact that flows is flat.
        peak_pressure: pressure(a),
    }
}

/// Returns p_m/Y and c at x = E\*a/(Y R\*), linear in its logarithm between the rows of [`LOADING`].
fn loading(x: f64) -> [f64; 2] {
    let [first, .., last] = LOADING;
    if x <= first[0] {
        return [first[1] * x / first[0], 1.0];
    }
    let after = LOADING.partition_point(|row| row[0] < x);
    let Some(high) = LOADING.get(after) else { return [last[1], last[2]] };
    let low = LOADING[after - 1];
    let share = (x / low[0]).ln() / (high[0] / low[0]).ln();
    [1, 2].map(|k: usize| low[k] + share * (high[k] - low[k]))
}
