//! Ting's prediction of restitution, contact time and peak force, with and without effects.

use fem_case::{Body, ModelChoice, Scene};
use fem_laws::{HertzImpact, Impact, LawError, Ting};

use crate::effects::{PartnerWaves, SurfaceSlip};
use crate::estimate::Estimate;
use crate::estimate::quasi_static::{known_impact, ting_of};
use crate::estimate::semi_infinite_partner::radiating_impact;

/// Relative accuracy of the predictions.
const TOLERANCE: f64 = 1e-4;

/// The results that effects change.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct TingPrediction {
    pub restitution: f64,
    /// s; none of bodies that stay together.
    pub contact_time: Option<f64>,
    /// Peak force, in newtons.
    pub peak_force: f64,
}

impl TingPrediction {
    /// Predicts the collision of a scene at an approach speed (m/s), with its relaxation and radiated
    /// waves; between half-spaces, or with the spheres' finite size.
    ///
    /// # Errors
    /// Numbers that the law refuses.
    pub fn of(scene: &Scene, speed: f64, finite_size: bool) -> Result<Self, LawError> {
        let estimate = Estimate::at(scene, speed)?;
        let is_condensed = matches!(scene.model(), ModelChoice::Condensed(_));
        let radiating = match is_condensed {
            true => PartnerWaves::radiating_at_rest(scene, &estimate),
            false => PartnerWaves::radiating(scene, &estimate),
        };
        let radiates = radiating != [None, None];
        if !radiates && !relaxes(scene) && !finite_size && !SurfaceSlip::is_on(scene) {
            return Ok(Self::from(&estimate.hertz));
        }
        let finish = |ting: Ting| ting.with_coarse_waves().with_tolerance(TOLERANCE);
        if radiates && !is_condensed {
            let impact = radiating_impact(scene, &radiating, speed, finite_size, finish)?;
            return Ok(Self::from(&impact));
        }
        let size = finite_size.then(|| scene.finite_size()).transpose()?;
        let ting = finish(ting_of(scene, estimate.hertz.pair(), true, size)?)?;
        let ting = ting.with_radiation(radiating.iter().flatten())?;
        Ok(Self::from(&*known_impact(ting, speed)?))
    }
}

fn relaxes(scene: &Scene) -> bool {
    let mut materials = scene.bodies().iter().filter_map(Body::material);
    materials.any(|material| material.relaxation().is_some())
}

impl From<&Impact> for TingPrediction {
    fn from(impact: &Impact) -> Self {
        let Impact { restitution, contact_time, peak_force, .. } = *impact;
        Self { restitution, contact_time, peak_force }
    }
}

impl From<&HertzImpact> for TingPrediction {
    fn from(hertz: &HertzImpact) -> Self {
        Self {
            restitution: hertz.restitution(),
            contact_time: Some(hertz.contact_time()),
            peak_force: hertz.peak_force(),
        }
    }
}
