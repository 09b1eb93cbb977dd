//! Hertz' closed form for elastic half-spaces; with the spheres' finite size or gravity, Ting's model of
//! elastic bodies.

use fem_case::schema::{HertzTable, ModelTable};
use fem_case::{CaseFile, ModelChoice, Scene, Switch};
use fem_laws::{HertzImpact, Impact, LawError, Ting};

use super::effects::support;
use super::ting;
use super::{Motion, Reduced, resolve_start};
use crate::effects::{Effect, NamedEffect, Support, SurfaceSlip};
use crate::estimate::Estimate;
use crate::models::method::{Method, Model, SharedModels};
use crate::rejection::Rejection;

/// Hertz' model, `[model] hertz = {}`.
#[derive(Clone, Copy, Debug)]
pub struct HertzMethod;

impl Method for HertzMethod {
    fn name(&self) -> &'static str {
        "hertz"
    }

    fn build(&self, scene: &Scene, _: &SharedModels) -> Result<Box<dyn Model>, Rejection> {
        Ok(Box::new(build(scene)?))
    }

    fn support(&self, effect: &dyn Effect, scene: &Scene, estimate: &Estimate) -> Option<Support> {
        support(effect, scene, estimate, None)
    }

    fn resolve(&self, scene: &Scene, file: CaseFile) -> Result<CaseFile, Rejection> {
        let ModelChoice::Hertz { finite_size } = *scene.model() else { return Ok(file) };
        let mut file = resolve_start(scene, file);
        let table = HertzTable { finite_size: Some(finite_size) };
        file.model = Some(ModelTable { hertz: Some(table), ..ModelTable::default() });
        Ok(file)
    }
}

#[derive(Debug)]
struct ClosedForm(HertzImpact);

impl Motion for ClosedForm {
    fn impact(&self, speed: f64) -> Result<Impact, LawError> {
        Ok(HertzImpact::new(self.0.pair(), speed)?.impact())
    }
}

/// Builds the model of a scene.
///
/// # Errors
/// As [`Reduced::new`]; a scene that chose another model.
pub(in crate::models) fn build(scene: &Scene) -> Result<Reduced, Rejection> {
    let ModelChoice::Hertz { finite_size } = *scene.model() else {
        return Err(Rejection::chose_another(scene, "hertz"));
    };
    let estimate = Estimate::checked(scene)?;
    // Ting's model of elastic bodies is Hertz' with finite size and gravity.
    let is_closed = !finite_size && scene.gravity().is_none();
    let tolerance = Ting::DEFAULT_TOLERANCE;
    let motion: Box<dyn Motion> = match is_closed {
        true => Box::new(ClosedForm(estimate.hertz)),
        false => {
            let scene = SurfaceSlip.switched(scene, Some(Switch::Off));
            Box::new(ting::motion(&scene, &estimate, false, finite_size, tolerance)?)
        }
    };
    let description = match is_closed {
        true => "model hertz, a closed form",
        false => "model hertz, one degree of freedom",
    };
    Reduced::of(scene, estimate, *estimate.hertz.pair(), motion, description.to_string())
}
