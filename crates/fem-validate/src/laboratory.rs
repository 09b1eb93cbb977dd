//! Runs the cases of a claim.

use std::sync::{Arc, Mutex, PoisonError};

use fem_case::{Case, CaseFile, Halt, Model, Problem, Simulation};
use fem_explicit::{Monitor, Progress, Stop};
use rayon::prelude::*;
use serde::de::DeserializeOwned;

use crate::claim::Claim;
use crate::error::StudyError;
use crate::price::Price;
use crate::run::{Run, Simulated};
use crate::shelf::Shelf;

/// Looks on while claims are evaluated, from several threads.
pub trait Observer: Sync {
    /// Seconds since whenever; the only clock of the studies.
    fn clock(&self) -> f64;
    /// Whether the user wants to stop.
    fn is_interrupted(&self) -> bool;
}

/// Where a study runs the cases of its claim.
pub struct Laboratory<'a> {
    claim: &'a Claim,
    shelf: &'a Shelf,
    observer: &'a dyn Observer,
    price: Mutex<Price>,
}

impl<'a> Laboratory<'a> {
    /// For a claim.
    pub fn new(claim: &'a Claim, shelf: &'a Shelf, observer: &'a dyn Observer) -> Self {
        Self { claim, shelf, observer, price: Mutex::default() }
    }

    /// The claim.
    pub fn claim(&self) -> &Claim {
        self.claim
    }

    /// The study's parameters.
    ///
    /// # Errors
    /// Parameters that are missing, unknown or of the wrong type.
    pub fn parameters<T: DeserializeOwned>(&self) -> Result<T, StudyError> {
        let table = self.claim.parameters.clone();
        table.try_into().map_err(|error| StudyError::parameters(format!("[parameters]: {error}")))
    }

    /// A case of the claim by the name of its `[run.NAME]`.
    ///
    /// # Errors
    /// No such run; what is wrong with the case.
    pub fn case(&self, run: &str) -> Result<Case, StudyError> {
        let file = self.claim.runs.get(run).ok_or_else(|| {
            StudyError::parameters(format!("the claim has no [run.{run}], which the study needs"))
        })?;
        Ok(self.claim.load_case(file)?)
    }

    /// Runs a case of the explicit model, or takes the result of an earlier run of it.
    ///
    /// # Errors
    /// A case that cannot be prepared or has another model, a run that does not end by itself, an
    /// interrupt.
    pub fn run(&self, case: Case) -> Result<Arc<Run>, StudyError> {
        if self.observer.is_interrupted() {
            return Err(StudyError::Interrupted);
        }
        let problem = Problem::new(case)?;
        let slot = self.shelf.explicit.slot(key(problem.plan.resolve(&problem.case))?);
        let result = slot.get_or_init(|| self.collide(problem)).clone();
        if let Ok(run) = &result {
            self.pay(run.collision.element_updates, run.seconds);
        }
        result
    }

    /// Runs cases on all cores; results in the order of the cases.
    ///
    /// # Errors
    /// As [`Laboratory::run`], of the first case that has one.
    pub fn run_all(&self, cases: Vec<Case>) -> Result<Vec<Arc<Run>>, StudyError> {
        cases.into_par_iter().map(|case| self.run(case)).collect()
    }

    /// Runs a case of any model, or takes the result of an earlier run of it.
    ///
    /// # Errors
    /// As [`Laboratory::run`], but for the model.
    pub fn simulate(&self, case: Case) -> Result<Arc<Simulated>, StudyError> {
        if case.scene.model == Model::Fem {
            return self.run(case).map(|run| Arc::new(Simulated::from(&*run)));
        }
        if self.observer.is_interrupted() {
            return Err(StudyError::Interrupted);
        }
        let slot = self.shelf.others.slot(key(Simulation::resolve(case.clone())?)?);
        let result = slot.get_or_init(|| self.simulate_other(case)).clone();
        if let Ok(run) = &result {
            self.pay(run.outcome.element_updates.unwrap_or(0), run.seconds);
        }
        result
    }

    /// Runs cases of any model on all cores; results in the order of the cases.
    ///
    /// # Errors
    /// As [`Laboratory::simulate`], of the first case that has one.
    pub fn simulate_all(&self, cases: Vec<Case>) -> Result<Vec<Arc<Simulated>>, StudyError> {
        cases.into_par_iter().map(|case| self.simulate(case)).collect()
    }

    /// Does some other work than [`Laboratory::run`], which says how many element updates it took.
    ///
    /// # Errors
    /// Those of the work.
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

    /// What the claim has cost so far.
    pub(crate) fn price(&self) -> Price {
        *self.price.lock().unwrap_or_else(PoisonError::into_inner)
    }

    fn pay(&self, element_updates: u64, seconds: f64) {
        let mut price = self.price.lock().unwrap_or_else(PoisonError::into_inner);
        price.runs += 1;
        price.element_updates += element_updates;
        price.seconds += seconds;
    }

    fn collide(&self, mut problem: Problem) -> Result<Arc<Run>, StudyError> {
        let started = self.observer.clock();
        let collision = problem.run(&mut Listener(self.observer));
        let seconds = self.observer.clock() - started;
        let title = problem.case.scene.title.clone();
        match (&collision.stopped, collision.restitution) {
            (Some(Stop::Interrupted { .. }), _) => Err(StudyError::Interrupted),
            (Some(stop), _) => Err(StudyError::Stopped { title, halt: Halt::Fem(stop.clone()) }),
            (None, None) => Err(no_restitution(&title)),
            (None, Some(restitution)) => {
                let contact_time =
                    collision.last_contact.zip(collision.first_contact).map_or(0.0, |(b, a)| b - a);
                let run = Run { problem, collision, restitution, contact_time, seconds };
                Ok(Arc::new(run))
            }
        }
    }

    /// A condensed pair that the shelf has is not made again.
    fn simulate_other(&self, case: Case) -> Result<Arc<Simulated>, StudyError> {
        let started = self.observer.clock();
        let mut simulation = Simulation::with_cache(case, &self.shelf.pairs)?;
        let outcome = simulation.run(&mut Listener(self.observer));
        let seconds = self.observer.clock() - started;
        let (case, hertz) = (simulation.case().clone(), *simulation.hertz());
        let title = case.scene.title.clone();
        if outcome.is_interrupted() {
            return Err(StudyError::Interrupted);
        }
        if let Some(halt) = outcome.halt {
            return Err(StudyError::Stopped { title, halt });
        }
        let restitution = outcome.restitution.ok_or_else(|| no_restitution(&title))?;
        Ok(Arc::new(Simulated { case, hertz, outcome, restitution, seconds }))
    }
}

/// What a case is known by on the shelf: all of it but its title.
fn key(mut resolved: CaseFile) -> Result<String, StudyError> {
    resolved.title = None;
    resolved.to_toml().map_err(|error| StudyError::parameters(error.to_string()))
}

fn no_restitution(title: &str) -> StudyError {
    StudyError::parameters(format!("{title}: no restitution"))
}

/// Passes an interrupt on to a run.
struct Listener<'a>(&'a dyn Observer);

impl Monitor for Listener<'_> {
    fn report(&mut self, _: Progress) -> bool {
        !self.0.is_interrupted()
    }
}
