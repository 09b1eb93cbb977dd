//! Ting's quasi-static viscoelastic half-spaces, with the spheres' finite size if asked for.

use fem_case::schema::{ModelTable, TingTable};
use fem_case::{CaseFile, ModelChoice, Quantity, Scene};
use fem_laws::{Impact, LawError, Ting};

use super::effects::support;
use super::{Motion, Reduced, refused, resolve_start};
use crate::effects::{Effect, PartnerWaves, Support};
use crate::estimate::Estimate;
use crate::estimate::quasi_static::ting_of;
use crate::estimate::semi_infinite_partner::radiating_impact;
use crate::estimate::viscous_flow;
use crate::models::method::{Method, Model, SharedModels};
use crate::rejection::Rejection;

/// Ting's model, `[model] ting = {}`.
#[derive(Clone, Copy, Debug)]
pub struct TingMethod;

impl Method for TingMethod {
    fn name(&self) -> &'static str {
        "ting"
    }

    fn build(&self, scene: &Scene, _: &SharedModels) -> Result<Box<dyn Model>, Rejection> {
        Ok(Box::new(build(scene)?))
    }

    fn support(&self, effect: &dyn Effect, scene: &Scene, estimate: &Estimate) -> Option<Support> {
        support(effect, scene, estimate, None)
    }

    fn resolve(&self, scene: &Scene, file: CaseFile) -> Result<CaseFile, Rejection> {
        let ModelChoice::Ting { finite_size, tolerance } = *scene.model() else { return Ok(file) };
        let mut file = resolve_start(scene, file);
        let table = TingTable {
            finite_size: Some(finite_size),
            tolerance: Some(Quantity::from_si(tolerance)),
        };
        file.model = Some(ModelTable { ting: Some(table), ..ModelTable::default() });
        Ok(file)
    }
}

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
    scene: Scene,
    finite_size: bool,
    tolerance: f64,
}

impl Motion for WithRadiation {
    fn impact(&self, speed: f64) -> Result<Impact, LawError> {
        let estimate = Estimate::at(&self.scene, speed)?;
        let radiating = PartnerWaves::radiating(&self.scene, &estimate);
        match radiating {
            [None, None] => self.ting.impact(speed),
            _ => {
                let Self { scene, finite_size, tolerance, .. } = self;
                let finish = |ting: Ting| with_gravity(ting, scene)?.with_tolerance(*tolerance);
                radiating_impact(scene, &radiating, speed, *finite_size, finish)
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

/// Builds the model of a scene.
///
/// # Errors
/// As [`Reduced::new`]; a scene that chose another model.
pub(in crate::models) fn build(scene: &Scene) -> Result<Reduced, Rejection> {
    let ModelChoice::Ting { finite_size, tolerance } = *scene.model() else {
        return Err(Rejection::chose_another(scene, "ting"));
    };
    let estimate = Estimate::checked(scene)?;
    viscous_flow::check(scene, &estimate)?;
    let ting = motion(scene, &estimate, true, finite_size, tolerance)?;
    let motion = Box::new(WithRadiation { ting, scene: scene.clone(), finite_size, tolerance });
    let description = "model ting, one degree of freedom".to_string();
    Reduced::of(scene, estimate, *estimate.hertz.pair(), motion, description)
}

/// Returns Ting's model of a scene; without relaxation its materials are elastic with the instantaneous moduli.
///
/// # Errors
/// A contact too large for the correction of the spheres' size; numbers that the law refuses.
pub(super) fn motion(
    scene: &Scene,
    estimate: &Estimate,
    relaxes: bool,
    finite_size: bool,
    tolerance: f64,
) -> Result<Ting, Rejection> {
    let refuse = |error: LawError| refused(scene, &error);
    let size = finite_size.then(|| scene.finite_size()).transpose().map_err(refuse)?;
    if let Some(size) = &size {
        size.check(viscous_flow::widest_contact(scene, estimate)).map_err(|error| {
            Rejection::new(format!("{}.finite_size", scene.model().path()), error.to_string())
                .with_help("write finite_size = false, or use model fem")
        })?;
    }
    let ting = ting_of(scene, estimate.hertz.pair(), relaxes, size).map_err(refuse)?;
    with_gravity(ting, scene).and_then(|ting| ting.with_tolerance(tolerance)).map_err(refuse)
}
