//! The methods, one file or folder each, and the method that a scene uses.

mod altered;
mod auto;
pub(crate) mod bouncing;
pub(crate) mod condensed;
pub(crate) mod explicit;
pub(crate) mod method;
mod mirrored;
mod oblique;
mod oblique_response;
mod own_frame;
mod reduced;
pub(crate) mod stepper;
mod sticking;

use fem_case::schema::StopTable;
use fem_case::{CaseFile, ModelChoice, Quantity, Scene};

use crate::effects::{Effect, SimplifiedScene, Support, Transformation, decide};
use crate::estimate::{Estimate, Regime};
use crate::models::method::{ExpectedRun, Method, Model, ModelSetup, SharedModels};
use crate::plan::Plan;
use crate::rejection::Rejection;

use altered::Altered;
use bouncing::Bouncing;
use oblique::ObliqueBodies;
use sticking::Bond;

pub use auto::{AutoMethod, ExpectedError, ModelCandidate, SelectedModel};
pub use condensed::{Condensed, CondensedMethod};
pub use explicit::{Explicit, ExplicitMethod};
pub(crate) use oblique::patch_velocity;
pub use oblique_response::{ObliqueRebound, ObliqueResponse};
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

/// A scene as its method computes it: transformed by the effects, with the model selected.
#[derive(Clone, Debug)]
pub(crate) struct ComputedScene {
    /// The scene as it is given.
    given: Regime,
    /// The transformed scene with the selected model.
    pub selected: SelectedModel,
    transformations: Vec<(&'static str, Transformation)>,
}

impl ComputedScene {
    /// Transforms a scene and selects its model.
    ///
    /// # Errors
    /// A scene that an effect rejects, or whose closed-form estimates are not finite.
    pub fn of(given: &Scene) -> Result<Self, Rejection> {
        Self::sharing(given, &SharedModels::default())
    }

    /// Returns [`ComputedScene::of`] with the impacts that other scenes know.
    ///
    /// # Errors
    /// Those of [`ComputedScene::of`].
    pub fn sharing(given: &Scene, shared: &SharedModels) -> Result<Self, Rejection> {
        let given = Regime::with_known(given.clone(), shared.impacts.clone())?;
        let SimplifiedScene { scene, transformations } = SimplifiedScene::of(&given)?;
        let regime = match transformations.is_empty() {
            true => given.clone(),
            false => given.variant(scene)?,
        };
        Ok(Self { selected: SelectedModel::of(regime)?, given, transformations })
    }

    fn method(&self) -> &'static dyn Method {
        method_of(&self.selected.regime.scene)
    }

    /// Makes the model of the transformed scene; with gravity, the model of all contacts.
    ///
    /// # Errors
    /// A scene that the method rejects.
    pub fn model(&self, shared: &SharedModels) -> Result<Box<dyn Model>, Rejection> {
        let regime = &self.selected.regime;
        let bond = Bond::of(&self.given.scene);
        let model = Altered::around(self.method().build(regime, shared)?, bond);
        let model = Altered::around(model, ObliqueBodies::of(&regime.scene)?);
        Ok(match self.given.scene.gravity() {
            Some(gravity) => Box::new(Bouncing::new(regime, gravity, model, bond)?),
            None => model,
        })
    }

    /// Returns the setup of this model, with the estimate of the given scene and the decisions on its effects.
    ///
    /// # Errors
    /// A switch of an effect that the model cannot obey.
    pub fn setup_of(&self, model: &dyn Model) -> Result<ModelSetup, Rejection> {
        if self.transformations.is_empty() {
            return Ok(model.setup().clone());
        }
        let Regime { scene, estimate } = &self.given;
        let decisions = decide(scene, estimate, |effect| self.support(model, effect, estimate))?;
        Ok(ModelSetup { estimate: estimate.clone(), decisions, ..model.setup().clone() })
    }

    /// Returns the support of this model for an effect of the given scene.
    pub fn support(
        &self,
        model: &dyn Model,
        effect: &dyn Effect,
        estimate: &Estimate,
    ) -> Option<Support> {
        let of_model = model.support(effect, estimate);
        let own = self.transformations.iter().find(|(name, _)| *name == effect.name());
        let Some((_, transformation)) = own else { return of_model };
        let relevance = effect.relevance(&self.given.scene, estimate).unwrap_or_default();
        transformation.support(of_model, &relevance.number)
    }

    /// Returns what is expected of a run with all contacts ([`Method::expected`]).
    pub fn expected(&self) -> Result<ExpectedRun, Rejection> {
        let gravity = self.given.scene.gravity();
        let contacts = gravity.map_or(1, |gravity| gravity.bounces as u64);
        ObliqueBodies::of(&self.selected.regime.scene)?;
        let of_contact = self.method().expected(&self.selected.regime)?;
        let element_updates = of_contact.element_updates.saturating_mul(contacts);
        Ok(ExpectedRun { element_updates, ..of_contact })
    }

    /// Returns the case as written with every default of its method filled in; `plan` is that of a model that is built.
    pub fn resolve(&self, plan: Option<&Plan>, file: CaseFile) -> Result<CaseFile, Rejection> {
        let mut file = self.method().resolve(&self.selected.regime, plan, file)?;
        if let Some(gravity) = self.given.scene.gravity() {
            let bounces = Quantity::from_si(gravity.bounces as f64);
            file.stop = Some(StopTable { bounces: Some(bounces) });
        }
        Ok(file)
    }
}

/// Returns the model that computes a scene: the selected one, if the case leaves it open.
///
/// # Errors
/// A scene that an effect rejects, or whose closed-form estimates are not finite.
pub fn selected_model(scene: &Scene) -> Result<ModelChoice, Rejection> {
    Ok(ComputedScene::of(scene)?.selected.regime.scene.model().clone())
}
