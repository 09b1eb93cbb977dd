//! A body that flies and vibrates for a million steps.

use fem_explicit::FreeMotion;
use fem_material::{ElasticModuli, Material};
use fem_mesh::HalfDisc;

use crate::error::StudyError;

/// Number of steps between two measurements.
const STEPS: usize = 100;

/// Returns the largest relative drifts of velocity and energy of a sphere that flies and vibrates, and the number of
/// element updates.
///
/// It flies along the axis at a hundred times the speed of its vibration, which begins with a stretch along the axis and
/// so excites every mode. The claim on free vibration tests the frequencies.
pub(super) fn endure(n_steps: usize) -> Result<([f64; 2], u64), StudyError> {
    const FLIGHT: f64 = 1.0;
    let moduli = ElasticModuli::from_youngs_modulus_poissons_ratio(2.488, 0.244)?;
    let disc = HalfDisc {
        radius: 1.0,
        contact_element_size: 0.125,
        refined_radius: 0.5,
        growth: None,
        edge: None,
    };
    let material = Material::new(1.0, moduli, None)?;
    let mut sphere = FreeMotion::new(disc.build()?, &material, 0.9)?;
    let ringing = |[r, y]: [f64; 2]| [-0.5e-2 * r, 1e-2 * (y - 1.0)];
    // The energy of flight would hide that of the vibration: a body at rest vibrates alike.
    let mut still = sphere.clone();
    still.set_velocity(ringing);
    sphere.set_velocity(|place| {
        let [r, y] = ringing(place);
        [r, y + FLIGHT]
    });
    let (first, energy) = (velocity(&sphere), still.energy());
    let mut worst = [0.0f64; 2];
    for _ in 0..n_steps / STEPS {
        for _ in 0..STEPS {
            sphere.step();
            still.step();
        }
        let drift = [(velocity(&sphere) - first) / first, still.energy() / energy - 1.0];
        worst = [0, 1].map(|k| fem_collision::nan_aware_max_abs(worst[k], drift[k].abs()));
    }
    let elements = sphere.body().n_elements() + still.body().n_elements();
    Ok((worst, (n_steps * elements) as u64))
}

fn velocity(sphere: &FreeMotion) -> f64 {
    let mass = sphere.body().nodal_mass();
    let momentum: f64 = mass.iter().zip(sphere.velocity()).map(|(m, v)| m * v[1]).sum();
    momentum / mass.iter().sum::<f64>()
}
