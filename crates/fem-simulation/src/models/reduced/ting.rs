//! Ting's quasi-static viscoelastic half-spaces, with the spheres' finite size if asked for.

use std::sync::Arc;

use fem_case::Scene;
use fem_laws::{Impact, LawError, Ting};

use super::{Motion, MotionOfScene, rejected};
use crate::effects::PartnerWaves;
use crate::estimate::quasi_static::ting_of;
use crate::estimate::semi_infinite_partner::radiating_impact;
use crate::estimate::viscous_flow;
use crate::estimate::{Estimate, Regime};
use crate::rejection::Rejection;

impl Motion for Ting {
    fn impact(&self, speed: f64) -> Result<Impact, LawError> {
        Ting::impact(self, speed)
    }

    fn equilibrium_weight(&self) -> f64 {
        Ting::equilibrium_weight(self)
    }
}

/// Ting's model with radiated waves, which depend on the approach speed.
#[derive(Debug)]
struct WithRadiation {
    /// The model without radiation.
    ting: Ting,
    regime: Regime,
    finite_size: bool,
    tolerance: f64,
}

impl Motion for WithRadiation {
    fn impact(&self, speed: f64) -> Result<Impact, LawError> {
        let Self { regime, finite_size, tolerance, .. } = self;
        let (scene, estimate) = (&regime.scene, regime.at(speed)?);
        let radiating = PartnerWaves::radiating(scene, &estimate);
        match radiating {
            [None, None] => {
                let known = estimate.impacts.impact(self.ting.clone(), speed)?;
                Ok(Arc::unwrap_or_clone(known))
            }
            _ => {
                let finish = |ting: Ting| with_gravity(ting, scene)?.with_tolerance(*tolerance);
                radiating_impact(scene, &radiating, &estimate, *finite_size, finish)
            }
        }
    }

    fn equilibrium_weight(&self) -> f64 {
        self.ting.equilibrium_weight()
    }
}

/// Returns the model with the gravity of a scene, if it has gravity.
fn with_gravity(ting: Ting, scene: &Scene) -> Result<Ting, LawError> {
    match scene.gravity() {
        Some(gravity) => ting.with_gravity(gravity.acceleration),
        None => Ok(ting),
    }
}

/// Returns the motion of a scene.
pub(super) fn motion(
    regime: &Regime,
    finite_size: bool,
    tolerance: f64,
) -> Result<MotionOfScene, Rejection> {
    let Regime { scene, estimate } = regime;
    viscous_flow::check(scene, estimate)?;
    let ting = ting(scene, estimate, true, finite_size, tolerance)?;
    let motion = Box::new(WithRadiation { ting, regime: regime.clone(), finite_size, tolerance });
    let description = "model ting, one degree of freedom".to_string();
    Ok((motion, *estimate.hertz.pair(), description))
}

/// Returns Ting's model of a scene; without relaxation its materials are elastic with the instantaneous moduli.
pub(super) fn ting(
    scene: &Scene,
    estimate: &Estimate,
    relaxes: bool,
    finite_size: bool,
    tolerance: f64,
) -> Result<Ting, Rejection> {
    let reject = |error: LawError| rejected(scene, &error);
    let size = finite_size.then(|| scene.finite_size()).transpose().map_err(reject)?;
    if let Some(size) = &size {
        size.check(viscous_flow::widest_contact(scene, estimate)).map_err(|error| {
            Rejection::new(format!("{}.finite_size", scene.model().path()), error.to_string())
                .with_help("write finite_size = false, or use model fem")
        })?;
    }
    let ting = ting_of(scene, estimate.hertz.pair(), relaxes, size).map_err(reject)?;
    with_gravity(ting, scene).and_then(|ting| ting.with_tolerance(tolerance)).map_err(reject)
}
