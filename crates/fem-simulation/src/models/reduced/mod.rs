//! Models of one degree of freedom, the approach of the mass centres. Results follow from the relative motion and the
//! conservation of momentum.

mod collision;
pub(super) mod effects;
mod hertz;
mod law;
mod ting;

use std::fmt;

use fem_case::schema::{End, HertzTable, ModelTable, StartTable, TingTable};
use fem_case::{CaseFile, ModelChoice, Quantity, Scene};
use fem_collision::{Approach, Collision, Monitor, OutputRequest, StaticContact, Stop};
use fem_laws::laws::ContactLaw;
use fem_laws::{
    EndRule, FirstYield, Impact, LawError, LawInput, NormalSprings, Pair, PairRelaxation,
    StaticHertz,
};

use crate::effects::{Effect, PlateBending, RateDependence, Support, decide};
use crate::estimate::approach::{approach_of, frame_of};
use crate::estimate::{Estimate, Regime};
use crate::models::method::{Cost, Method, Model, ModelSetup, SharedModels};
use crate::plan::Plan;
use crate::rejection::Rejection;

/// The reduced methods.
#[derive(Clone, Copy, Debug)]
pub enum ReducedMethod {
    /// Hertz' model, `[model] hertz = {}`.
    Hertz,
    /// A contact law, `[model] law = { NAME = { … } }`.
    Law,
    /// Ting's model, `[model] ting = {}`.
    Ting,
}

impl Method for ReducedMethod {
    fn name(&self) -> &'static str {
        match self {
            Self::Hertz => "hertz",
            Self::Law => "law",
            Self::Ting => "ting",
        }
    }

    fn build(&self, regime: &Regime, _: &SharedModels) -> Result<Box<dyn Model>, Rejection> {
        if regime.scene.model().name() != self.name() {
            return Err(Rejection::chose_another(&regime.scene, self.name()));
        }
        Ok(Box::new(Reduced::of(regime)?))
    }

    fn support(&self, effect: &dyn Effect, scene: &Scene, estimate: &Estimate) -> Option<Support> {
        let regime = || Regime { scene: scene.clone(), estimate: estimate.clone() };
        let is_law = matches!(scene.model(), ModelChoice::Law { .. });
        let reduced = is_law.then(|| Reduced::of(&regime()));
        let law = reduced.as_ref().and_then(|reduced| reduced.as_ref().ok()?.law());
        effects::support(effect, scene, estimate, law)
    }

    /// Computes the collision, which takes milliseconds.
    fn check(&self, regime: &Regime) -> Result<(), Rejection> {
        let impact = Reduced::of(regime)?.impact(regime.scene.approach_speed());
        impact.map(|_| ()).map_err(|error| rejected(&regime.scene, &error))
    }

    fn resolve(
        &self,
        regime: &Regime,
        _: Option<&Plan>,
        mut file: CaseFile,
    ) -> Result<CaseFile, Rejection> {
        let scene = &regime.scene;
        let table = match *scene.model() {
            ModelChoice::Hertz { finite_size } => {
                HertzTable { finite_size: Some(finite_size) }.into()
            }
            ModelChoice::Ting { finite_size, tolerance } => {
                let tolerance = Some(Quantity::from_si(tolerance));
                TingTable { finite_size: Some(finite_size), tolerance }.into()
            }
            ModelChoice::Law { end_rule, tolerance, .. } => {
                Reduced::of(regime)?;
                let given = file.model.take().unwrap_or_default();
                let end = match end_rule {
                    EndRule::ZeroForce => End::ZeroForce,
                    EndRule::ZeroOverlap => End::ZeroOverlap,
                };
                let law = given.law.unwrap_or_default().filled(end, tolerance);
                let law = Some(law::with_speed(law, scene.approach_speed()));
                ModelTable { law, ..ModelTable::default() }
            }
            _ => return Ok(file),
        };
        file.model = Some(table);
        let gap = scene.gap().unwrap_or(fem_case::defaults::GAP);
        file.start = Some(StartTable { gap: Some(Quantity::from_si(gap)) });
        Ok(file)
    }
}

/// A method that computes the relative motion.
pub(super) trait Motion: fmt::Debug + Send + Sync {
    /// Computes the relative motion at an approach speed, m/s.
    fn impact(&self, speed: f64) -> Result<Impact, LawError>;

    /// Returns the share of the contact modulus that never relaxes, 0 to 1.
    fn equilibrium_weight(&self) -> f64 {
        1.0
    }

    /// Returns the stiffness and dashpot of a law of the overlap.
    fn law(&self) -> Option<&ContactLaw> {
        None
    }

    /// Returns the law's parameters in SI units, in the order of its family.
    fn law_numbers(&self) -> Option<&[f64]> {
        None
    }
}

/// The motion of a scene, its pair, which has relaxed moduli if a law is a slow limit, and the description of the model.
type MotionOfScene = (Box<dyn Motion>, Pair, String);

/// A scene with a reduced model, ready to run.
#[derive(Debug)]
pub struct Reduced {
    setup: ModelSetup,
    scene: Scene,
    motion: Box<dyn Motion>,
    pair: Pair,
}

impl Reduced {
    /// Builds the reduced model that a scene chooses.
    ///
    /// # Errors
    /// A scene whose closed-form estimates are not finite, or that asks for finite elements; a
    /// contact too large for the finite-size correction; a law that cannot be made of this pair.
    pub fn new(scene: &Scene) -> Result<Self, Rejection> {
        Self::of(&Regime::of(scene.clone())?)
    }

    /// Returns the loads of the contact's springs in an impact.
    fn springs_of(&self, impact: &Impact) -> Option<NormalSprings> {
        let materials = self.scene.bodies().each_ref().map(|body| match self.scene.model() {
            ModelChoice::Ting { .. } => body.material().cloned(),
            _ => Some(body.material()?.without_relaxation()),
        });
        let [lower, upper] = materials.each_ref().map(Option::as_ref);
        let relaxation = PairRelaxation::new(lower, upper).ok()?;
        let gravity = self.scene.gravity().map_or(0.0, |gravity| gravity.acceleration);
        let (pair, law, n_steps) = (&self.pair, self.law(), NormalSprings::N_STEPS);
        NormalSprings::of_impact(impact, pair, &relaxation, law, gravity, n_steps).ok()
    }

    /// Builds the reduced model of a scene in its regime.
    ///
    /// # Errors
    /// Those of [`Reduced::new`].
    pub(crate) fn of(regime: &Regime) -> Result<Self, Rejection> {
        let Regime { scene, estimate } = regime;
        PlateBending::check(scene)?;
        let (motion, pair, description) = match scene.model() {
            ModelChoice::Hertz { finite_size } => hertz::motion(regime, *finite_size),
            ModelChoice::Ting { finite_size, tolerance } => {
                ting::motion(regime, *finite_size, *tolerance)
            }
            ModelChoice::Law { law, end_rule, tolerance } => {
                law::motion(regime, law, *end_rule, *tolerance)
            }
            ModelChoice::Condensed(_) | ModelChoice::Fem | ModelChoice::Auto => {
                Err(Rejection::new("model", "finite elements are no reduced model"))
            }
        }?;
        let support = |effect: &dyn Effect| effects::support(effect, scene, estimate, motion.law());
        let decisions = decide(scene, estimate, support)?;
        let setup = ModelSetup {
            description,
            approach: approach_of(scene)?,
            request: OutputRequest::history(),
            estimate: estimate.clone(),
            decisions,
            unread_key_warnings: effects::unread_keys(scene),
            cost: Cost::ClosedForm { law: motion.law().copied() },
            elements: None,
        };
        Ok(Self { setup, scene: scene.clone(), motion, pair })
    }

    /// Returns the stiffness and dashpot of a law.
    pub fn law(&self) -> Option<&ContactLaw> {
        self.motion.law()
    }

    /// Returns the law's parameters in SI units, in the order of its family.
    pub fn law_numbers(&self) -> Option<&[f64]> {
        self.motion.law_numbers()
    }

    /// Returns the parameters, SI, of a law that is given by some of its keys, in the order of its family; the others come from
    /// the scene.
    ///
    /// # Errors
    /// A scene whose closed-form estimates are not finite; a law that cannot be made of this pair.
    pub fn parameters_of(scene: &Scene, law: &LawInput) -> Result<Vec<f64>, Rejection> {
        let end_rule = law.family.end_rule().unwrap_or_default();
        let Regime { scene, estimate } = Regime::of(scene.clone())?;
        let (parameters, _) = law::law_numbers(&scene, &estimate, law, end_rule)?;
        Ok(parameters)
    }

    /// Returns the error of the restitution by a law with the given values at an approach speed, m/s: its own and that of neglected
    /// effects, without the rate of strain, at which a strength of a law is. `None` if it is not known, or the law cannot be made of
    /// the scene.
    pub fn restitution_error(scene: &Scene, law: LawInput, speed: f64) -> Option<f64> {
        let end_rule = law.family.end_rule().unwrap_or_default();
        let tolerance = fem_case::defaults::LAW_TOLERANCE;
        let model = ModelChoice::Law { law, end_rule, tolerance };
        Self::model_error(&scene.clone().with_model(model), speed)
    }

    /// Returns the error of the restitution by the reduced model of a scene at an approach speed, m/s, as
    /// [`Reduced::restitution_error`] does that of a law.
    pub fn model_error(scene: &Scene, speed: f64) -> Option<f64> {
        let scene = scene.touching_at(speed)?;
        let setup = Self::new(&scene).ok()?.setup;
        setup.restitution_error(&scene, |effect| effect != RateDependence::NAME)
    }

    /// Returns the first yield of the body that flows under a law that dents, with that body's flow stress and without a plate;
    /// `None` if the law cannot be made of the scene.
    pub(crate) fn flow_of(
        scene: &Scene,
        estimate: &Estimate,
        law: &LawInput,
    ) -> Option<FirstYield> {
        law::flow_of(scene, estimate, law)
    }

    /// Computes the relative motion at an approach speed, m/s, with the law's parameters of the case.
    ///
    /// # Errors
    /// A speed at which the model has no solution.
    pub fn impact(&self, speed: f64) -> Result<Impact, LawError> {
        self.motion.impact(speed)
    }
}

impl Model for Reduced {
    fn setup(&self) -> &ModelSetup {
        &self.setup
    }

    fn support(&self, effect: &dyn Effect, estimate: &Estimate) -> Option<Support> {
        effects::support(effect, &self.scene, estimate, self.law())
    }

    /// Computes the collision without reports of progress, since it takes milliseconds.
    fn collide(
        &self,
        approach: &Approach,
        request: &OutputRequest,
        _: &mut dyn Monitor,
    ) -> Collision {
        match self.checked_impact(approach, request) {
            Ok(impact) => self.collision_of(&impact, approach, request),
            Err(stop) => Collision::stopped(*approach, stop),
        }
    }

    fn collide_on_springs(
        &self,
        approach: &Approach,
        request: &OutputRequest,
        _: &mut dyn Monitor,
    ) -> (Collision, Option<NormalSprings>) {
        match self.checked_impact(approach, request) {
            Ok(impact) => {
                let collision = self.collision_of(&impact, approach, request);
                (collision, self.springs_of(&impact))
            }
            Err(stop) => (Collision::stopped(*approach, stop), None),
        }
    }

    fn static_contact(&self, force: f64) -> Result<Option<StaticContact>, Rejection> {
        let found = match self.law() {
            Some(law) => under_spring(law, &self.pair, force).map(Some),
            None => relaxed_hertz(&self.pair, self.motion.equilibrium_weight(), force),
        };
        found.map_err(|error| rejected(&self.scene, &error))
    }
}

impl Reduced {
    /// Returns the relative motion of a requested collision, or why there is none.
    fn checked_impact(&self, approach: &Approach, request: &OutputRequest) -> Result<Impact, Stop> {
        request.check()?;
        self.impact(approach.speed()).map_err(|error| stop_of(&error))
    }

    fn collision_of(
        &self,
        impact: &Impact,
        approach: &Approach,
        request: &OutputRequest,
    ) -> Collision {
        let frame = frame_of(&self.scene, approach, self.pair.effective_mass());
        collision::of_impact(impact, &frame, &self.pair, self.law(), request)
    }
}

/// Returns Hertz' static contact with the equilibrium modulus; `None` if that is zero.
fn relaxed_hertz(
    pair: &Pair,
    equilibrium_weight: f64,
    force: f64,
) -> Result<Option<StaticContact>, LawError> {
    if equilibrium_weight == 0.0 {
        return Ok(None);
    }
    let hertz = StaticHertz::new(&pair.with_modulus_share(equilibrium_weight)?, force)?;
    Ok(Some(StaticContact {
        force,
        approach: hertz.approach,
        contact_radius: Some(hertz.contact_radius),
        centre_pressure: Some(hertz.peak_pressure),
    }))
}

/// Returns the static contact of a law's first loading without its dashpot.
fn under_spring(law: &ContactLaw, pair: &Pair, force: f64) -> Result<StaticContact, LawError> {
    let approach = law.approach_under(force);
    if !(approach > 0.0 && approach.is_finite()) {
        return Err(LawError::NotPositive { quantity: "static approach", value: approach });
    }
    let contact_radius = law.contact_radius(pair, approach);
    Ok(StaticContact { force, approach, contact_radius, centre_pressure: None })
}

fn stop_of(error: &LawError) -> Stop {
    let message = error.to_string();
    match error {
        LawError::NotFinished { .. } => Stop::NotFinished(message),
        LawError::OutsideValidity { .. } => Stop::OutsideValidity(message),
        _ => Stop::OutOfRange(message),
    }
}

/// Returns the rejection of a scene by its law.
pub(super) fn rejected(scene: &Scene, error: &LawError) -> Rejection {
    Rejection::new(scene.model().path(), error.to_string())
}
