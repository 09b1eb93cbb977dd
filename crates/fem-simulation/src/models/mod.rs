//! The methods, one file or folder each, and the method that a scene uses.

mod auto;
mod bouncing;
pub(crate) mod condensed;
pub(crate) mod explicit;
pub(crate) mod method;
mod mirrored;
mod own_frame;
mod reduced;
mod simplified;
pub(crate) mod stepper;

use fem_case::schema::StopTable;
use fem_case::{CaseFile, ModelChoice, Quantity, Scene};

use crate::effects::SimplifiedScene;
use crate::models::method::{Method, Model, SharedModels};
use crate::rejection::Rejection;

use bouncing::Bouncing;
use simplified::Simplified;

pub use auto::{AutoMethod, ExpectedError, ModelCandidate, SelectedModel};
pub use condensed::{Condensed, CondensedMethod};
pub use explicit::{Explicit, ExplicitMethod};
pub use reduced::{Reduced, ReducedMethod};

/// All methods, from the cheapest to the most expensive, and the one that selects among them.
pub const METHODS: [&dyn Method; 6] = [
    &ReducedMethod::Hertz,
    &ReducedMethod::Law,
    &ReducedMethod::Ting,
    &CondensedMethod,
    &ExplicitMethod,
    &AutoMethod,
];

/// Returns the method of a scene.
pub fn method_of(scene: &Scene) -> &'static dyn Method {
    match scene.model() {
        ModelChoice::Hertz { .. } => &ReducedMethod::Hertz,
        ModelChoice::Law { .. } => &ReducedMethod::Law,
        ModelChoice::Ting { .. } => &ReducedMethod::Ting,
        ModelChoice::Condensed(_) => &CondensedMethod,
        ModelChoice::Fem => &ExplicitMethod,
        ModelChoice::Auto => &AutoMethod,
    }
}

/// Makes the model of a scene after the transformations by effects; with gravity, the model of all contacts.
///
/// # Errors
/// A scene that an effect or the method rejects.
pub fn model_of(scene: &Scene, shared: &SharedModels) -> Result<Box<dyn Model>, Rejection> {
    let SimplifiedScene { scene: computed, supports } = SimplifiedScene::of(scene)?;
    let computed = SelectedModel::of(&computed)?.scene;
    let model = method_of(&computed).build(&computed, shared)?;
    let model = match scene.gravity() {
        Some(gravity) => Box::new(Bouncing::new(&computed, gravity, model)?),
        None => model,
    };
    match supports.is_empty() {
        true => Ok(model),
        false => Ok(Box::new(Simplified::new(model, scene, supports)?)),
    }
}

/// Returns the automatically chosen model, if the scene leaves the choice open.
///
/// # Errors
/// A scene that an effect rejects, or whose closed-form estimates are not finite.
pub fn chosen(scene: &Scene) -> Result<Option<SelectedModel>, Rejection> {
    match scene.model() {
        ModelChoice::Auto => SelectedModel::of(&SimplifiedScene::of(scene)?.scene).map(Some),
        _ => Ok(None),
    }
}

/// Returns the number of element updates of all contacts ([`Method::element_updates`]).
pub(crate) fn element_updates_of(scene: &Scene) -> Result<u64, Rejection> {
    let one = method_of(scene).element_updates(&SimplifiedScene::of(scene)?.scene)?;
    let contacts = scene.gravity().map_or(1, |gravity| gravity.bounces as u64);
    Ok(one.saturating_mul(contacts))
}

/// Returns the case as written with every default of its method filled in.
pub(crate) fn resolved(scene: &Scene, file: CaseFile) -> Result<CaseFile, Rejection> {
    let mut file = method_of(scene).resolve(&SimplifiedScene::of(scene)?.scene, file)?;
    if let Some(gravity) = scene.gravity() {
        let bounces = Quantity::from_si(gravity.bounces as f64);
        file.stop = Some(StopTable { bounces: Some(bounces) });
    }
    Ok(file)
}
