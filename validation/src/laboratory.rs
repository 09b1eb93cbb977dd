//! Evaluates claims: runs their cases, each once, counts their cost and makes their checks.

use std::collections::HashMap;
use std::sync::{Arc, Mutex, OnceLock, PoisonError};

use fem::effects::{Effect, RigidPartner};
use fem::{Estimate, Explicit, Model, ModelSetup, SharedModels, Simulation};
use fem_case::{Case, CaseFile, ModelChoice};
use fem_collision::{Collision, Monitor, Progress};
use fem_laws::HertzImpact;
use rayon::prelude::*;
use serde::de::DeserializeOwned;

use crate::{
    Check, CheckResult, Claim, ExplicitRun, Findings, Run, StudyError, studies::find_study,
};

/// Observes the evaluation of claims from several threads.
pub trait Observer: Sync {
    /// Returns the time since some instant, s; the only clock of the studies.
    fn clock(&self) -> f64;
    /// Whether the user wants to stop.
    fn is_interrupted(&self) -> bool;
}

/// Runs the cases of a claim for its study.
pub struct Laboratory<'a> {
    claim: &'a Claim,
    cache: &'a ResultCache,
    observer: &'a dyn Observer,
    cost: Mutex<StudyCost>,
}

impl<'a> Laboratory<'a> {
    /// Creates the laboratory of a claim.
    pub fn new(claim: &'a Claim, cache: &'a ResultCache, observer: &'a dyn Observer) -> Self {
        Self { claim, cache, observer, cost: Mutex::default() }
    }

    /// Returns the claim that is tested.
    pub fn claim(&self) -> &Claim {
        self.claim
    }

    /// Returns the parameters of the study.
    pub fn parameters<T: DeserializeOwned>(&self) -> Result<T, StudyError> {
        let table = self.claim.parameters.clone();
        table.try_into().map_err(|error| StudyError::parameters(format!("[parameters]: {error}")))
    }

    /// Returns a case of the claim by the name of its `[run.NAME]`.
    pub fn case(&self, run: &str) -> Result<Case, StudyError> {
        let file = self.claim.runs.get(run).ok_or_else(|| {
            StudyError::parameters(format!("the claim has no [run.{run}], which the study needs"))
        })?;
        Ok(self.claim.load_case(file)?)
    }

    /// Returns the names and the cases of all runs of the claim.
    pub fn cases(&self) -> Result<(Vec<&'a String>, Vec<Case>), StudyError> {
        let names: Vec<&String> = self.claim.runs.keys().collect();
        let cases = names.iter().map(|name| self.case(name)).collect::<Result<_, _>>()?;
        Ok((names, cases))
    }

    /// Runs a case of the explicit model, or takes the result of an earlier run of it.
    pub fn run(&self, case: Case) -> Result<Arc<ExplicitRun>, StudyError> {
        if self.observer.is_interrupted() {
            return Err(StudyError::Interrupted);
        }
        if *case.scene().model() != ModelChoice::Fem {
            let message =
                format!("model `{}` has no explicit elements", case.scene().model().name());
            return Err(case.error_at(&case.scene().model().path(), message).into());
        }
        let slot = self.cache.explicit.slot(key(Simulation::resolve(&case)?)?);
        let result = slot.get_or_init(|| self.run_explicit(case)).clone();
        self.pay_for(result.as_ref().map(|run| &run.run));
        result
    }

    /// Runs cases on all cores and returns their results in order.
    pub fn run_all(&self, cases: Vec<Case>) -> Result<Vec<Arc<ExplicitRun>>, StudyError> {
        cases.into_par_iter().map(|case| self.run(case)).collect()
    }

    /// Runs a case of any model, or takes the result of an earlier run of it. A partner that the plan treats as rigid
    /// gets no elements, which would need thousands of times as many steps, and a ball under gravity has all of its contacts.
    pub fn simulate(&self, case: Case) -> Result<Arc<Run>, StudyError> {
        let is_one_contact = case.scene().gravity().is_none() && !has_rigid_partner(&case);
        if *case.scene().model() == ModelChoice::Fem && is_one_contact {
            return self.run(case).map(|run| Arc::new(run.run.clone()));
        }
        if self.observer.is_interrupted() {
            return Err(StudyError::Interrupted);
        }
        let slot = self.cache.others.slot(key(Simulation::resolve(&case)?)?);
        let result = slot.get_or_init(|| self.run_other(case)).clone();
        self.pay_for(result.as_deref());
        result
    }

    /// Runs cases of any model on all cores and returns their results in order.
    pub fn simulate_all(&self, cases: Vec<Case>) -> Result<Vec<Arc<Run>>, StudyError> {
        cases.into_par_iter().map(|case| self.simulate(case)).collect()
    }

    /// Does other work than [`Laboratory::run`]; the work returns its result and its number of element updates.
    pub fn work<T>(
        &self,
        work: impl FnOnce() -> Result<(T, u64), StudyError>,
    ) -> Result<T, StudyError> {
        if self.observer.is_interrupted() {
            return Err(StudyError::Interrupted);
        }
        let started = self.observer.clock();
        let (result, element_updates) = work()?;
        self.pay(element_updates, self.observer.clock() - started);
        Ok(result)
    }

    /// Returns the cost of the claim so far.
    pub(crate) fn cost(&self) -> StudyCost {
        *self.cost.lock().unwrap_or_else(PoisonError::into_inner)
    }

    fn pay_for<E>(&self, run: Result<&Run, E>) {
        if let Ok(run) = run {
            self.pay(run.collision.element_updates.unwrap_or(0), run.seconds);
        }
    }

    fn pay(&self, element_updates: u64, seconds: f64) {
        let mut cost = self.cost.lock().unwrap_or_else(PoisonError::into_inner);
        cost.runs += 1;
        cost.element_updates += element_updates;
        cost.seconds += seconds;
    }

    fn run_explicit(&self, case: Case) -> Result<Arc<ExplicitRun>, StudyError> {
        let explicit = Explicit::new(case.scene()).map_err(|refusal| refusal.in_case(&case))?;
        let ModelSetup { approach, request, estimate, .. } = explicit.setup();
        let collide = |listener: &mut dyn Monitor| explicit.collide(approach, request, listener);
        let run = self.collide(case, estimate.hertz, collide)?;
        let model = explicit.bodies_of(&run.collision)?;
        Ok(Arc::new(ExplicitRun { model, run }))
    }

    /// Runs a case of another model; models in the cache are shared.
    fn run_other(&self, case: Case) -> Result<Arc<Run>, StudyError> {
        let simulation = Simulation::sharing(case, &self.cache.shared)?;
        let (case, hertz) = (simulation.case().clone(), simulation.setup().estimate.hertz);
        self.collide(case, hertz, |listener| simulation.run(listener)).map(Arc::new)
    }

    fn collide(
        &self,
        case: Case,
        hertz: HertzImpact,
        collide: impl FnOnce(&mut dyn Monitor) -> Collision,
    ) -> Result<Run, StudyError> {
        let started = self.observer.clock();
        let collision = collide(&mut Listener(self.observer));
        let seconds = self.observer.clock() - started;
        if collision.is_interrupted() {
            return Err(StudyError::Interrupted);
        }
        let title = || case.scene().title().to_string();
        if let Some(stop) = collision.stop() {
            return Err(StudyError::Stopped { title: title(), stop: stop.clone() });
        }
        let restitution = collision
            .restitution
            .ok_or_else(|| StudyError::parameters(format!("{}: no restitution", title())))?;
        Ok(Run { case, hertz, collision, restitution, seconds })
    }
}

/// Whether the plan treats a body of a case as rigid. An error is reported when the case is run.
fn has_rigid_partner(case: &Case) -> bool {
    let scene = case.scene();
    let estimate = Estimate::of(scene).ok();
    let of = |estimate| RigidPartner.transform(scene, &estimate).ok().flatten();
    estimate.and_then(of).is_some()
}

/// Returns the key under which runs of a case are shared: the resolved case without its title.
fn key(mut resolved: CaseFile) -> Result<String, StudyError> {
    resolved.title = None;
    resolved.to_toml().map_err(|error| StudyError::parameters(error.to_string()))
}

/// Passes an interrupt on to a run.
struct Listener<'a>(&'a dyn Observer);

impl Monitor for Listener<'_> {
    fn report(&mut self, _: Progress) -> bool {
        !self.0.is_interrupted()
    }
}

/// Cost of a claim: runs, element updates and time.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct StudyCost {
    /// Number of runs; runs that claims share count in each.
    pub runs: u64,
    /// Elements times steps.
    pub element_updates: u64,
    /// Seconds of one core.
    pub seconds: f64,
}

/// A run that is done, is being computed, or has failed.
type Slot<T> = Arc<OnceLock<Result<Arc<T>, StudyError>>>;

/// Runs keyed by their resolved case.
#[derive(Debug)]
struct Slots<T>(Mutex<HashMap<String, Slot<T>>>);

impl<T> Slots<T> {
    /// Returns the slot of a resolved case.
    fn slot(&self, key: String) -> Slot<T> {
        self.0.lock().unwrap_or_else(PoisonError::into_inner).entry(key).or_default().clone()
    }
}

impl<T> Default for Slots<T> {
    fn default() -> Self {
        Self(Mutex::default())
    }
}

/// The runs that claims share: a case is run once.
#[derive(Debug, Default)]
pub struct ResultCache {
    /// Runs of the explicit model.
    explicit: Slots<ExplicitRun>,
    /// Runs of all other models.
    others: Slots<Run>,
    /// Data shared by runs at several speeds or relaxations.
    shared: SharedModels,
}

/// The result of a claim.
#[derive(Debug, Clone)]
pub struct ClaimResult {
    /// The claim that was tested.
    pub claim: Claim,
    /// The results of its checks, in the order of the claim; empty if the study failed.
    pub checks: Vec<CheckResult>,
    /// Measurements, tables and figures of the study.
    pub findings: Findings,
    /// The error of a study that failed.
    pub error: Option<StudyError>,
    /// Cost of the claim.
    pub cost: StudyCost,
}

impl ClaimResult {
    /// Whether all checks were made and passed.
    pub fn passed(&self) -> bool {
        self.error.is_none() && self.checks.iter().all(|check| check.passed)
    }
}

/// Runs a claim's study and makes its checks.
pub fn evaluate(claim: &Claim, cache: &ResultCache, observer: &dyn Observer) -> ClaimResult {
    let laboratory = Laboratory::new(claim, cache, observer);
    let study = find_study(&claim.study).map_err(StudyError::Parameters);
    let outcome = study.and_then(|study| study(&laboratory));
    let cost = laboratory.cost();
    let claim = claim.clone();
    match outcome {
        Ok(findings) => {
            let measured = |quantity: &str| findings.quantities.get(quantity).copied();
            let judge = |check: &Check| check.judge(measured(&check.quantity));
            let checks = claim.checks.iter().map(judge).collect();
            ClaimResult { checks, claim, findings, error: None, cost }
        }
        Err(error) => {
            let findings = Findings::default();
            ClaimResult { claim, checks: Vec::new(), findings, error: Some(error), cost }
        }
    }
}
