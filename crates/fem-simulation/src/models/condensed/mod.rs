//! Linear finite elements condensed to their contact nodes, with the meshes and materials of the explicit model. A
//! collision takes milliseconds instead of seconds. A plate that bends is meshed as a half-space and bends as a dashpot.

pub(crate) mod cost;

mod effects;
pub(super) mod static_contact;

use std::sync::{Arc, Mutex, PoisonError};

use fem_case::schema::{CondensedTable, ModelTable};
use fem_case::{CaseFile, CondensedOptions, ModelChoice, Quantity, Scene};
use fem_collision::{
    Approach, BodyInput, Collision, Ending, Monitor, OutputRequest, POST_CONTACT_FRACTION,
    StaticContact, StepInstant, Stop,
};
use fem_condensed::{CondensedError, CondensedPair, ContactModel, Damping, PairSettings, Slip};
use fem_laws::{NormalSprings, radiation_damping};
use fem_material::PronySeries;
use fem_material::engineering::Unit;
use fem_mesh::SphereMesh;

use self::cost::{ExpectedProgress, MAX_BYTES, expected_bytes, n_steps, relaxes_in_shear};
use super::mirrored::whole_or_half;
use crate::effects::{Effect, PartnerWaves, Support, Vibration, decide};
use crate::estimate::approach::{approach_of, frame_of};
use crate::estimate::plate_impact::free_plate;
use crate::estimate::quasi_static::surfaces_slip;
use crate::estimate::viscous_flow::slower;
use crate::estimate::{Estimate, Regime};
use crate::models::method::{
    Cost, ElementSetup, ExpectedRun, Method, Model, ModelSetup, SharedModels, estimate_at,
};
use crate::plan::Plan;
use crate::plan::body_source::BodySource;
use crate::plan::contact_method::ContactNoiseAdvice;
use crate::plan::pair_cache::PairKey;
use crate::rejection::Rejection;

/// Growth factor of the condensed region if the contact needs a larger one.
const CANDIDATE_GROWTH: f64 = 2.0;
/// Half-width of the condensed region over that of the fine block.
const CANDIDATES_OVER_REFINED: f64 = 1.125;
/// Least half-width of the condensed region over Hertz' contact radius.
const CANDIDATES_OVER_CONTACT: f64 = 1.3;
/// Least half-width of the condensed region, in elements of the contact.
const CANDIDATE_ELEMENTS: f64 = 3.0;

/// Linear finite elements condensed to their contact, `[model] condensed = {}`.
#[derive(Clone, Copy, Debug)]
pub struct CondensedMethod;

impl Method for CondensedMethod {
    fn name(&self) -> &'static str {
        "condensed"
    }

    fn build(&self, regime: &Regime, shared: &SharedModels) -> Result<Box<dyn Model>, Rejection> {
        if !matches!(regime.scene.model(), ModelChoice::Condensed(_)) {
            return Err(Rejection::chose_another(&regime.scene, "condensed"));
        }
        whole_or_half(regime, |scene, plan| Condensed::with_plan(scene, plan, shared))
    }

    fn support(&self, effect: &dyn Effect, scene: &Scene, estimate: &Estimate) -> Option<Support> {
        effects::support(effect, scene, estimate, None)
    }

    fn expected(&self, regime: &Regime) -> Result<ExpectedRun, Rejection> {
        let plan = Plan::in_regime(regime)?;
        check_memory(&plan, &BodySource::of_scene(&regime.scene, &plan)?)?;
        let out_of_reach = plan.out_of_reach().map(str::to_string);
        Ok(ExpectedRun { element_updates: 0, out_of_reach })
    }

    /// Returns the case with the defaults of the tables that the model reads.
    fn resolve(
        &self,
        regime: &Regime,
        plan: Option<&Plan>,
        file: CaseFile,
    ) -> Result<CaseFile, Rejection> {
        let options = options(&regime.scene);
        let (time, contact) = (file.time.clone(), file.contact.clone());
        let mut file = Plan::known(plan, regime)?.resolve(file);
        file.time = time;
        if !options.penalty_springs {
            file.contact = contact;
        }
        let table = CondensedTable {
            vibration_modes: Some(Quantity::from_si(options.vibration_modes as f64)),
            steps: Some(Quantity::from_si(options.steps as f64)),
            penalty_springs: Some(options.penalty_springs),
        };
        file.model = Some(ModelTable { condensed: Some(table), ..ModelTable::default() });
        Ok(file)
    }
}

/// A scene with condensed bodies, ready to run.
#[derive(Debug)]
pub struct Condensed {
    setup: ModelSetup,
    regime: Regime,
    pair: Arc<CondensedPair>,
    /// The same bodies condensed out to other radii, for collisions that needed them.
    others: Mutex<Vec<Arc<CondensedPair>>>,
    options: CondensedOptions,
}

impl Condensed {
    /// Meshes and condenses the bodies, or takes the same pair from the shared ones without a mesh. A scene of another
    /// model is condensed with default options.
    ///
    /// # Errors
    /// A scene that the plan rejects; meshes that cannot be made or read; more elements or memory than the limits allow; a
    /// stiffness that cannot be factored.
    pub fn new(scene: &Scene, shared: &SharedModels) -> Result<Self, Rejection> {
        Self::with_plan(scene, Plan::of(scene)?, shared)
    }

    /// Meshes and condenses by a plan that may have been changed.
    fn with_plan(scene: &Scene, plan: Plan, shared: &SharedModels) -> Result<Self, Rejection> {
        let options = options(scene);
        let sources = BodySource::of_scene(scene, &plan)?;
        check_memory(&plan, &sources)?;
        // Condensation does not depend on relaxation.
        let bodies = sources.map(BodySource::without_relaxation);
        let asks_for_fields = !plan.snapshots.is_empty() || !scene.probes().is_empty();
        let settings = PairSettings {
            keeps_factors: (asks_for_fields && !shared.is_of_reference_runs)
                || options.vibration_modes > 0
                || scene.bodies().iter().any(relaxes_in_shear),
            ..settings(scene, &plan, options)
        };
        let key = PairKey { bodies, settings };
        let pair = shared.pairs.pair(key, |key| {
            CondensedPair::new(inputs(key)?, key.settings)
                .map_err(|error| Rejection::new(scene.model().path(), error.to_string()))
        })?;
        let estimate = &plan.estimate;
        let support = |effect: &dyn Effect| effects::support(effect, scene, estimate, Some(&pair));
        let decisions = decide(scene, estimate, support)?;
        let mut unread_key_warnings = plan.warnings.clone();
        unread_key_warnings.extend(effects::unread_keys(scene, options));
        let approach = approach_of(scene)?;
        let slower = slower(scene, estimate, &approach);
        let per_contact = n_steps(options, slower, estimate.relaxed) as f64;
        let n_steps = slower.end * (1.0 + POST_CONTACT_FRACTION) * per_contact;
        let setup = ModelSetup {
            description: "model condensed, finite elements condensed to their contact".to_string(),
            approach,
            request: plan.request(),
            estimate: plan.estimate.clone(),
            decisions,
            unread_key_warnings,
            cost: cost_of(scene, &pair, n_steps as u64),
            elements: Some(ElementSetup {
                has_springs: options.penalty_springs,
                moved_share: 0.0,
                noise_advice: ContactNoiseAdvice::MoreSteps,
                plan,
            }),
        };
        let regime = Regime { scene: scene.clone(), estimate: setup.estimate.clone() };
        Ok(Self { setup, regime, pair, others: Mutex::default(), options })
    }

    /// Returns the warnings about the speed.
    pub fn speed_warnings(&self) -> Vec<String> {
        Vibration::warnings_of_speed(&self.setup.estimate, self.options.vibration_modes)
    }

    /// Returns the condensed bodies.
    pub fn pair(&self) -> &CondensedPair {
        &self.pair
    }

    /// Computes the restitution of the same bodies at another speed, m/s, and with other relaxations, lower body first. The
    /// factors are used again.
    ///
    /// # Errors
    /// A collision that stops before its end.
    pub fn restitution(
        &self,
        speed: f64,
        relaxations: [Option<&PronySeries>; 2],
        n_steps: usize,
    ) -> Result<f64, Stop> {
        let request = OutputRequest::quantities();
        let approach = Approach::at(speed).map_err(CondensedError::from)?;
        let collision = self.follow(&approach, relaxations, n_steps, &request, &mut ());
        match (collision.ending, collision.restitution) {
            (Ending::Stopped(stop), _) => Err(stop),
            (_, restitution) => Ok(restitution.unwrap_or_default()),
        }
    }

    /// Computes the collision, with a larger condensed region as long as the contact outgrows it.
    fn follow(
        &self,
        approach: &Approach,
        relaxations: [Option<&PronySeries>; 2],
        n_steps: usize,
        request: &OutputRequest,
        monitor: &mut dyn Monitor,
    ) -> Collision {
        let damping = match self.damping(approach.speed(), relaxations) {
            Ok(damping) => damping,
            Err(stop) => return Collision::stopped(*approach, stop),
        };
        let mut collide = |pair: &CondensedPair| {
            let frame = frame_of(&self.regime.scene, approach, pair.reduced_mass());
            match pair.collide(&frame, damping, n_steps, request, &mut *monitor) {
                Ok(collision) => collision,
                Err(error) => Collision {
                    initial_energy: Some(frame.kinetic(frame.speed())),
                    bodies: pair.bodies_before(&frame),
                    candidate_region: Some(pair.candidate_region()),
                    factor_bytes: Some(pair.factor_bytes() as u64),
                    ..Collision::stopped(*approach, stop_of(error, approach))
                },
            }
        };
        let checked = request.check().map_err(Stop::from);
        let mut pair = match checked.and_then(|()| self.pair_at(approach)) {
            Ok(pair) => pair,
            Err(stop) => return Collision::stopped(*approach, stop),
        };
        loop {
            let mut collision = collide(&pair);
            if collision.outgrown_radius().is_none() {
                return collision;
            }
            match self.larger(&pair) {
                Ok(larger) => pair = larger,
                Err(error) => {
                    collision.ending = Ending::Stopped(stop_of(error, approach));
                    return collision;
                }
            }
        }
    }

    /// Returns the dissipation at a speed (m/s) with these relaxations: that of waves and of a plate depends on the speed.
    fn damping<'a>(
        &self,
        speed: f64,
        relaxations: [Option<&'a PronySeries>; 2],
    ) -> Result<Damping<'a>, Stop> {
        let estimate = estimate_at(&self.regime, speed)?;
        let radiating = PartnerWaves::radiating_at_rest(&self.regime.scene, &estimate);
        let radiation = radiating.map(|material| Some(radiation_damping(&material?)));
        let plate = free_plate(&self.regime.scene);
        let plate_mobility = plate.map(|plate| plate.mobility(&estimate.hertz));
        Ok(Damping { relaxations, radiation, plate_mobility })
    }

    /// Returns the bodies with the condensed region that an approach needs at first.
    fn pair_at(&self, approach: &Approach) -> Result<Arc<CondensedPair>, Stop> {
        let own = self.pair.settings().candidate_radius;
        let Some(elements) = &self.setup.elements else { return Ok(self.pair.clone()) };
        if *approach == self.setup.approach {
            return Ok(self.pair.clone());
        }
        let estimate = estimate_at(&self.regime, approach.speed())?;
        let radius = candidate_radius(&elements.plan, &estimate);
        if radius == own {
            return Ok(self.pair.clone());
        }
        self.other(radius, |settings| CondensedPair::new(self.pair.inputs().clone(), settings))
            .map_err(|error| stop_of(error, approach))
    }

    /// Returns the bodies with a larger condensed region, so large that it has more contact points.
    fn larger(&self, pair: &CondensedPair) -> Result<Arc<CondensedPair>, CondensedError> {
        // The pole may be the only point, at radius 0.
        let reached = Some(pair.candidate_radius()).filter(|radius| *radius > 0.0);
        let mut radius = CANDIDATE_GROWTH * reached.unwrap_or(pair.settings().candidate_radius);
        loop {
            match self.other(radius, |settings| pair.enlarge(settings.candidate_radius)) {
                Err(CondensedError::Stopped(Stop::ContactTooLarge { .. }))
                    if radius < self.setup.estimate.smallest_radius =>
                {
                    radius *= CANDIDATE_GROWTH;
                }
                larger => return larger,
            }
        }
    }

    /// Returns the bodies condensed out to another radius, m, which all collisions share.
    fn other(
        &self,
        candidate_radius: f64,
        make: impl FnOnce(PairSettings) -> Result<CondensedPair, CondensedError>,
    ) -> Result<Arc<CondensedPair>, CondensedError> {
        let mut others = self.others.lock().unwrap_or_else(PoisonError::into_inner);
        let is_it =
            |other: &&Arc<CondensedPair>| other.settings().candidate_radius == candidate_radius;
        if let Some(known) = others.iter().find(is_it) {
            return Ok(known.clone());
        }
        let made = Arc::new(make(PairSettings { candidate_radius, ..*self.pair.settings() })?);
        others.push(made.clone());
        Ok(made)
    }
}

impl Model for Condensed {
    fn setup(&self) -> &ModelSetup {
        &self.setup
    }

    fn support(&self, effect: &dyn Effect, estimate: &Estimate) -> Option<Support> {
        effects::support(effect, &self.regime.scene, estimate, Some(&self.pair))
    }

    fn collide(
        &self,
        approach: &Approach,
        request: &OutputRequest,
        monitor: &mut dyn Monitor,
    ) -> Collision {
        let bodies = self.regime.scene.bodies().each_ref();
        let relaxations = bodies.map(|body| body.material()?.relaxation());
        let estimate = match estimate_at(&self.regime, approach.speed()) {
            Ok(estimate) => estimate,
            Err(stop) => return Collision::stopped(*approach, stop),
        };
        let slower = slower(&self.regime.scene, &estimate, approach);
        let n_steps = n_steps(self.options, slower, estimate.relaxed);
        let duration = slower.end * (1.0 + POST_CONTACT_FRACTION) * estimate.hertz.contact_time();
        let mut monitor = ExpectedProgress { monitor, begin: approach.first_touch(), duration };
        self.follow(approach, relaxations, n_steps, request, &mut monitor)
    }

    fn collide_on_springs(
        &self,
        approach: &Approach,
        request: &OutputRequest,
        monitor: &mut dyn Monitor,
    ) -> (Collision, Option<NormalSprings>) {
        let request = OutputRequest { pressures: true, ..request.clone() };
        let collision = self.collide(approach, &request, monitor);
        let record = collision.pressures.as_ref().zip(collision.contact_time);
        let springs = record.map(|(record, contact_time)| {
            let (step, forces, profiles) = (record.time_step, &record.forces, &record.profiles);
            NormalSprings::of_pressures(contact_time, step, forces, profiles)
        });
        (collision, springs)
    }

    fn static_contact(&self, force: f64) -> Result<Option<StaticContact>, Rejection> {
        static_contact::of_elements(&self.regime.scene, force)
    }

    fn meshes(&self) -> [Option<&SphereMesh>; 2] {
        self.pair.inputs().each_ref().map(BodyInput::mesh)
    }
}

/// Returns the stop at first touch of a collision that could not begin.
fn stop_of(error: CondensedError, approach: &Approach) -> Stop {
    match error {
        CondensedError::ContactBeyondCandidates { radius } => Stop::ContactBeyondCandidates {
            at: StepInstant { time: approach.first_touch(), step: 0 },
            radius,
        },
        error => error.into(),
    }
}

fn options(scene: &Scene) -> CondensedOptions {
    match scene.model() {
        ModelChoice::Condensed(options) => *options,
        _ => fem_case::defaults::CONDENSED,
    }
}

fn cost_of(scene: &Scene, pair: &CondensedPair, steps: u64) -> Cost {
    let elements = pair.inputs().each_ref().map(|input| {
        let mesh = input.mesh();
        mesh.map_or(0, |mesh| mesh.quads().len() as u64)
    });
    let [lower, upper] = scene.bodies();
    let bodies = [(lower, elements[0]), (upper, elements[1])];
    Cost::Factors {
        elements: elements.iter().sum(),
        contact_points: pair.n_points() as u64,
        steps,
        factor_bytes: pair.factor_bytes() as u64,
        memory: expected_bytes(bodies, pair.settings().keeps_factors),
    }
}

fn inputs(key: &PairKey) -> Result<[BodyInput; 2], Rejection> {
    let [lower, upper] = &key.bodies;
    Ok([lower.build(0)?, upper.build(1)?])
}

/// Returns the radius of the condensed region. It depends on the fine block, so that all speeds that share a mesh share a
/// factor; a contact that is expected to be wider doubles it.
fn candidate_radius(plan: &Plan, estimate: &Estimate) -> f64 {
    let needed = (CANDIDATES_OVER_CONTACT * estimate.hertz.max_contact_radius())
        .max(CANDIDATE_ELEMENTS * plan.contact_element_size);
    let mut candidate_radius = CANDIDATES_OVER_REFINED * plan.refined_radius;
    while candidate_radius < needed {
        candidate_radius *= CANDIDATE_GROWTH;
    }
    candidate_radius
}

fn settings(scene: &Scene, plan: &Plan, options: CondensedOptions) -> PairSettings {
    let contact = if options.penalty_springs {
        ContactModel::Springs(plan.contact_stiffness)
    } else {
        ContactModel::Exact
    };
    PairSettings {
        contact,
        vibration_modes: options.vibration_modes,
        held: scene.bodies().each_ref().map(fem_case::Body::is_held),
        slip: surfaces_slip(scene).then(|| {
            let slip = scene.surface_slip();
            Slip { curvature: slip.curvature(), shares: slip.shares() }
        }),
        ..PairSettings::new(candidate_radius(plan, &plan.estimate))
    }
}

fn check_memory(plan: &Plan, sources: &[BodySource; 2]) -> Result<(), Rejection> {
    let elements = sources[0].n_elements()? + sources[1].n_elements()?;
    let bytes = MAX_BYTES.saturating_mul(elements as u64);
    if bytes <= plan.max_memory {
        return Ok(());
    }
    let shown = |bytes: u64| Unit::fitting(bytes as f64, "B").with_digits(2).show(bytes as f64);
    let message = format!("the factors may take up to {} of memory", shown(bytes));
    Err(Rejection::new("limits.memory", message).with_help(format!(
        "at most {} are allowed; use a larger mesh.contact_element_size, or raise limits.memory",
        shown(plan.max_memory)
    )))
}
