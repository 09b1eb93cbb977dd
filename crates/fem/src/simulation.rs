//! A case with the model that computes it, whichever that is: one variant a model family, one arm
//! each in the methods.

use fem_explicit::{Monitor, SnapshotRequest};
use fem_laws::HertzImpact;

use crate::case::Case;
use crate::condensed::{Condensed, PairCache};
use crate::effects::Effect;
use crate::error::CaseError;
use crate::model::Model;
use crate::outcome::Outcome;
use crate::plan::Plan;
use crate::problem::Problem;
use crate::reduced::Reduced;
use crate::schema::CaseFile;

/// A case that is ready to run.
#[derive(Clone, Debug)]
pub enum Simulation {
    /// Explicit finite elements.
    Fem(Box<Problem>),
    /// Linear finite elements condensed to their contact.
    Condensed(Box<Condensed>),
    /// One degree of freedom: Hertz, Ting, contact laws.
    Reduced(Box<Reduced>),
}

impl Simulation {
    /// Builds the model that the case asks for.
    ///
    /// # Errors
    /// What the model refuses; see [`Problem::new`] and [`Reduced::new`].
    pub fn new(case: Case) -> Result<Self, CaseError> {
        Self::with_cache(case, &PairCache::default())
    }

    /// The same; condensed bodies are taken from the cache where it has them.
    ///
    /// # Errors
    /// As [`Simulation::new`].
    pub fn with_cache(case: Case, cache: &PairCache) -> Result<Self, CaseError> {
        Ok(match case.scene.model {
            Model::Fem => Self::Fem(Box::new(Problem::new(case)?)),
            Model::Condensed(_) => Self::Condensed(Box::new(Condensed::new(case, cache)?)),
            _ => Self::Reduced(Box::new(Reduced::new(case)?)),
        })
    }

    /// The case with every default filled in, without the cost of building its model.
    ///
    /// # Errors
    /// A scene whose closed-form estimates are not finite; what a reduced model refuses.
    pub fn resolve(case: Case) -> Result<CaseFile, CaseError> {
        match case.scene.model {
            Model::Fem => Ok(Plan::of(&case)?.resolve(&case)),
            Model::Condensed(_) => Condensed::resolve_case(&case),
            _ => Ok(Reduced::new(case)?.resolve()),
        }
    }

    /// The case.
    pub fn case(&self) -> &Case {
        match self {
            Self::Fem(problem) => &problem.case,
            Self::Condensed(condensed) => &condensed.case,
            Self::Reduced(reduced) => &reduced.case,
        }
    }

    /// The case with every default filled in.
    pub fn resolved(&self) -> CaseFile {
        match self {
            Self::Fem(problem) => problem.plan.resolve(&problem.case),
            Self::Condensed(condensed) => condensed.resolve(),
            Self::Reduced(reduced) => reduced.resolve(),
        }
    }

    /// Hertz with instantaneous moduli, to compare with.
    pub fn hertz(&self) -> &HertzImpact {
        match self {
            Self::Fem(problem) => &problem.plan.estimate.hertz,
            Self::Condensed(condensed) => &condensed.plan.estimate.hertz,
            Self::Reduced(reduced) => &reduced.estimate.hertz,
        }
    }

    /// Which effects are on, and why.
    pub fn effects(&self) -> Vec<Effect> {
        match self {
            Self::Fem(problem) => problem.effects(),
            Self::Condensed(condensed) => condensed.effects.clone(),
            Self::Reduced(reduced) => reduced.effects.clone(),
        }
    }

    /// What the user should know before the run.
    pub fn warnings(&self) -> &[String] {
        match self {
            Self::Fem(problem) => &problem.plan.warnings,
            Self::Condensed(condensed) => &condensed.warnings,
            Self::Reduced(reduced) => &reduced.warnings,
        }
    }

    /// Element updates to come, what runs are ordered by, of a case that could run: a factor takes
    /// milliseconds and is not made, a reduced model takes microseconds.
    ///
    /// # Errors
    /// As [`Simulation::new`], but for a stiffness that cannot be factored.
    pub fn price(case: Case) -> Result<u64, CaseError> {
        match case.scene.model {
            Model::Fem => Ok(Problem::new(case)?.cost.element_updates),
            Model::Condensed(_) => Condensed::check(&case).map(|()| 0),
            _ => Reduced::new(case).map(|_| 0),
        }
    }

    /// Makes the run compute no fields to draw, nor warn of those that could not be had. All else
    /// keeps its bits, the resolved case too.
    pub fn skip_snapshots(&mut self) {
        let plan = match self {
            Self::Fem(problem) => &mut problem.plan,
            Self::Condensed(condensed) => &mut condensed.plan,
            Self::Reduced(_) => return,
        };
        plan.snapshots = SnapshotRequest::Labels(Vec::new());
    }

    /// Computes the collision.
    pub fn run(&mut self, monitor: &mut dyn Monitor) -> Outcome {
        match self {
            Self::Fem(problem) => {
                let collision = problem.run(monitor);
                Outcome::of_fem(problem, collision)
            }
            Self::Condensed(condensed) => condensed.run(monitor),
            Self::Reduced(reduced) => reduced.run(),
        }
    }
}
