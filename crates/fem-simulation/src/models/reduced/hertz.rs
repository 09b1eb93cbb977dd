//! Hertz' closed form for elastic half-spaces; with the spheres' finite size, gravity or a plate, Ting's model of
//! elastic bodies.

use fem_case::Switch;
use fem_laws::{HertzImpact, Impact, LawError, Ting};

use super::{Motion, MotionOfScene, ting};
use crate::effects::{NamedEffect, SurfaceSlip};
use crate::estimate::Regime;
use crate::rejection::Rejection;

#[derive(Debug)]
struct ClosedForm(HertzImpact);

impl Motion for ClosedForm {
    fn impact(&self, speed: f64) -> Result<Impact, LawError> {
        Ok(HertzImpact::new(self.0.pair(), speed)?.impact())
    }
}

/// Returns the motion of a scene.
pub(super) fn motion(regime: &Regime, finite_size: bool) -> Result<MotionOfScene, Rejection> {
    let Regime { scene, estimate } = regime;
    // Ting's model of elastic bodies is Hertz' with finite size, gravity and a plate.
    let has_plate = scene.bodies().iter().any(|body| body.plate().is_some());
    let is_closed = !finite_size && scene.gravity().is_none() && !has_plate;
    let tolerance = Ting::DEFAULT_TOLERANCE;
    let motion: Box<dyn Motion> = match is_closed {
        true => Box::new(ClosedForm(estimate.hertz)),
        false => {
            let scene = SurfaceSlip.switched(scene, Some(Switch::Off));
            Box::new(ting::ting(&scene, estimate, false, finite_size, tolerance)?)
        }
    };
    let description = match is_closed {
        true => "model hertz, a closed form",
        false => "model hertz, one degree of freedom",
    };
    Ok((motion, *estimate.hertz.pair(), description.to_string()))
}
