//! A body that flies and rings for a million steps.

use fem_explicit::FreeMotion;
use fem_material::{ElasticModuli, Material};
use fem_mesh::HalfDisc;

use crate::error::StudyError;

/// Between two looks.
const STEPS: usize = 100;

/// The largest drift of a sphere's velocity that flies and rings, over that, and of its energy, over that;
/// and the element updates that it took.
///
/// It flies along the axis at a hundred times the speed with which it rings: in the mode that is
/// started by a stretch along the axis, of which every other mode has a little. Its frequencies are those of
/// the claim on free vibration.
pub(super) fn endure(n_steps: usize) -> Result<([f64; 2], u64), StudyError> {
    const FLIGHT: f64 = 1.0;
    let moduli = ElasticModuli::from_youngs_modulus_poissons_ratio(2.488, 0.244)?;
    let disc =
        HalfDisc { radius: 1.0, contact_element_size: 0.125, refined_radius: 0.5, growth: None };
    let material = Material::new(1.0, moduli, None)?;
    let mut sphere = FreeMotion::new(disc.build()?, &material, 0.9)?;
    let ringing = |[r, y]: [f64; 2]| [-0.5e-2 * r, 1e-2 * (y - 1.0)];
    // Flight is not in what the springs of a body at rest would feel; its energy hides that of ringing.
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

/// Velocity of the mass centre along the axis, m/s.
fn velocity(sphere: &FreeMotion) -> f64 {
    let mass = sphere.body().nodal_mass();
    let momentum: f64 = mass.iter().zip(sphere.velocity()).map(|(m, v)| m * v[1]).sum();
    momentum / mass.iter().sum::<f64>()
}
