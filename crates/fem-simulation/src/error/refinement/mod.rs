//! Meshes that are made finer until a result is within the tolerance of its case.
//!
//! The plan chooses elements by a rule of closed forms ([`crate::Plan`]). What the mesh of a result is off by
//! its companions tell when it is there (`accuracy/discretisation.rs`). Where that is more than `[accuracy]`
//! allows of one of its quantities and the case left the elements to the plan, they are made smaller by
//!
//! ```math
//! \frac{h}{h'} = \Bigl(1.1\,\max_q \frac{|\Delta q|}{\tau_q}\Bigr)^{2/3}, \qquad 1.25 \le \frac h{h'} \le 2,
//! ```
//!
//! between the first order of bulk viscosity and the second of elements, and the collision is computed
//! again; twice as fine at once where condensed companions, which know the bar of a mesh before the collision is
//! computed on it, foretell that less does not do; at most [`MOST_LEVELS`] times and with no more element updates
//! than [`MOST_UPDATES`], or what the case gives as `limits.element_updates`; nor where mass or springs, as the case
//! gives them, are off by more than is allowed, which no mesh mends. Where that does not do, or may not be, a
//! warning says so. All of it is decided by numbers of the case and of the runs: it is the same on all machines.
//! Where condensed companions tell it, the first mesh is chosen so before anything is run
//! ([`foresight`](crate::error::foresight)).

mod kept;
mod miss;
mod warning;

use std::convert::Infallible;
use std::sync::{MutexGuard, PoisonError};

use fem_case::{Body, Shape};
use fem_collision::{Collision, Monitor, QuantityOfInterest, Stop};
use fem_material::engineering::Unit;
use serde::{Deserialize, Serialize};

use self::kept::Kept;
use self::miss::Miss;
use crate::error::foretold_errors;
use crate::models::method::Cost;
use crate::simulation::Simulation;

/// Room beyond the error that is seen.
const ROOM: f64 = 1.1;
/// Power of h by which errors fall, about.
const ORDER: f64 = 1.5;
/// Least and most by which elements become smaller at once.
pub(crate) const STEPS: [f64; 2] = [1.25, 2.0];
/// Finer meshes after the first.
pub(crate) const MOST_LEVELS: usize = 4;
/// Element updates of a finer mesh, where the case gives no limit: some seconds.
pub(crate) const MOST_UPDATES: u64 = 150_000_000;
/// Elements of a finer mesh of condensed bodies, which take no updates: a second.
pub(crate) const MOST_ELEMENTS: u64 = 60_000;

/// A mesh that was too coarse, or was foretold to be.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Level {
    /// Edge length of its elements at the contact.
    pub contact_element_size_m: f64,
    /// What it took, of a model that steps; none where companions alone were computed with it.
    pub element_updates: Option<u64>,
    /// Key of the quantity that missed its tolerance by most.
    pub quantity: String,
    /// By how much it may have been off: the restitution as it is, others as shares.
    pub error: f64,
    /// What the case allows of it.
    pub tolerance: f64,
}

impl Simulation {
    /// Computes the collision, again on finer meshes where the first does not do; what came, and the
    /// simulation that it came from.
    pub fn run_within_tolerance(self, monitor: &mut dyn Monitor) -> (Self, Collision) {
        let computed = self
            .foreseen(|| true)
            .simulation
            .within_tolerance(|simulation| Ok::<_, Infallible>(simulation.run(monitor)));
        match computed {
            Ok(both) => both,
            Err(never) => match never {},
        }
    }

    /// The same with a way to compute it, which knows of a finer mesh by [`Simulation::levels`]. Of a finer
    /// mesh that cannot go through the collision the one before counts.
    ///
    /// # Errors
    /// Those of the way.
    pub fn within_tolerance<E>(
        self,
        mut compute: impl FnMut(&Self) -> Result<Collision, E>,
    ) -> Result<(Self, Collision), E> {
        let mut collision = compute(&self)?;
        let mut simulation = self;
        while let Some(finer) = simulation.finer(&collision) {
            let next = compute(&finer)?;
            if let Some(stop) = next.stop().filter(|stop| !is_wanted(stop)) {
                simulation.stopped_finer = Some(stop.to_string());
                break;
            }
            (simulation, collision) = (finer, next);
        }
        Ok((simulation, collision))
    }

    /// The same case on a finer mesh, where a quantity of its collision may be off by more than the case allows
    /// and a finer mesh may be had.
    pub fn finer(&self, collision: &Collision) -> Option<Self> {
        self.finer_or_kept(&self.missed(collision)?, Some(collision)).ok()
    }

    /// Whether meshes of the case may be made finer for its tolerance.
    pub(crate) fn may_be_refined(&self) -> bool {
        let scene = self.case().scene();
        let is_given = scene.mesh().contact_element_size.is_some();
        let has_elements = self.setup().elements.is_some();
        has_elements && !is_given && !self.has_mesh_file() && scene.gravity().is_none()
    }

    fn has_mesh_file(&self) -> bool {
        let is_file = |body: &Body| matches!(body.shape(), Shape::Sphere { mesh: Some(_), .. });
        self.case().scene().bodies().iter().any(is_file)
    }

    /// Coarser meshes that did not do, the first one first.
    pub fn levels(&self) -> &[Level] {
        &self.levels
    }

    /// That the mesh was made finer, why, and what it takes.
    pub fn refined_because(&self) -> Option<String> {
        let level = self.levels.last()?;
        let headline = QuantityOfInterest::ALL.into_iter().find(|it| it.key() == level.quantity)?;
        let miss = Miss { headline, error: level.error, tolerance: level.tolerance, scatter: 0.0 };
        let size = self.setup().elements.as_ref()?.plan.contact_element_size;
        // What was foretold was not run.
        let is_foretold =
            level.element_updates.is_none() && matches!(self.setup().cost, Cost::Steps { .. });
        Some(format!(
            "{}: {}elements of {} in place of {}",
            miss.in_words(),
            if is_foretold { "" } else { "again with " },
            length(size),
            length(level.contact_element_size_m)
        ))
    }

    /// Element updates of elements that are so many times smaller, where they have been found too dear.
    fn known_as_too_dear(&self, by: f64) -> Option<u64> {
        let known = *self.lock_too_dear();
        known.filter(|(known, _)| (by / known - 1.0).abs() < SAME_STEP).map(|(_, updates)| updates)
    }

    fn lock_too_dear(&self) -> MutexGuard<'_, Option<(f64, u64)>> {
        // Who panicked has left nothing half written.
        self.too_dear.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// The same case on the finer mesh that a quantity needs that is going to be off, of bodies that meet as the case
    /// says; none where there is none.
    pub(crate) fn finer_for(&self, miss: &Miss) -> Option<Self> {
        self.finer_or_kept(miss, None).ok()
    }

    /// The quantity that is foretold to be off by most of what the case allows, if by more than that.
    pub(crate) fn foretold_miss(&self) -> Option<Option<Miss>> {
        let errors = foretold_errors(self)?;
        Some(self.worst_miss(|headline| errors[headline as usize]))
    }

    /// The same case on a finer mesh, or why there is none; after a collision or before one.
    fn finer_or_kept(&self, miss: &Miss, met: Option<&Collision>) -> Result<Self, Kept> {
        let scene = self.case().scene();
        let elements = self.setup().elements.as_ref().ok_or(Kept::Given)?;
        if let Some(cause) = self.other_cause(miss, met) {
            return Err(Kept::Setting(cause));
        }
        if !miss.is_of_mesh() {
            return Err(Kept::Scatter(miss.scatter));
        }
        if self.has_mesh_file() {
            return Err(Kept::FromFile);
        }
        if scene.mesh().contact_element_size.is_some() {
            return Err(Kept::Given);
        }
        let is_other = |collision: &Collision| collision.approach != self.setup().approach;
        if scene.gravity().is_some() || met.is_some_and(is_other) {
            return Err(Kept::Gravity);
        }
        if let Some(why) = &self.stopped_finer {
            return Err(Kept::Stopped(why.clone()));
        }
        if self.levels.len() >= MOST_LEVELS {
            return Err(Kept::Dear { updates: None });
        }
        let by = step(miss.excess_of_mesh(), STEPS[1]);
        if let Some(updates) = self.known_as_too_dear(by) {
            return Err(Kept::Dear { updates: Some(updates) });
        }
        let level = Level {
            contact_element_size_m: elements.plan.contact_element_size,
            element_updates: met.and_then(|collision| collision.element_updates),
            quantity: miss.headline.key().to_string(),
            error: miss.error,
            tolerance: miss.tolerance,
        };
        let levels: Vec<Level> = self.levels.iter().cloned().chain([level]).collect();
        let finer =
            |by: f64| self.refined(self.refinement * by, levels.clone()).map_err(Kept::Refused);
        let finer = match (finer(by)?, by < STEPS[1]) {
            (short, true) if short.foretold_miss().flatten().is_some() => finer(STEPS[1])?,
            (enough, _) => enough,
        };
        match finer.setup().cost {
            Cost::Steps { element_updates, .. } => {
                let most = scene.limits().element_updates.unwrap_or(MOST_UPDATES);
                match element_updates <= most {
                    true => Ok(finer),
                    false => {
                        *self.lock_too_dear() = Some((by, element_updates));
                        Err(Kept::Dear { updates: Some(element_updates) })
                    }
                }
            }
            Cost::Factors { elements, .. } if elements > MOST_ELEMENTS => {
                Err(Kept::Dear { updates: None })
            }
            _ => Ok(finer),
        }
    }
}

/// What is known of one refinement holds for others that differ from it by less: those of one mesh, which its
/// companions foretell before a run and tell after it, differ by some 1e-3.
const SAME_STEP: f64 = 0.01;

/// Whether a run was stopped by its user.
fn is_wanted(stop: &Stop) -> bool {
    matches!(stop, Stop::Interrupted { .. })
}

/// By how much elements become smaller where an error is so many times what is allowed.
fn step(excess: f64, most: f64) -> f64 {
    (ROOM * excess).powf(1.0 / ORDER).max(STEPS[0]).min(most)
}

/// An element's edge, m, in three digits, as a case takes it, too.
fn length(size: f64) -> String {
    Unit::fitting(size, "m").with_digits(3).show(size)
}
