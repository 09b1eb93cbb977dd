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
//! ([`foresight`](crate::foresight)).

use std::convert::Infallible;
use std::sync::{MutexGuard, PoisonError};

use fem_case::{Body, CaseError, Shape};
use fem_collision::{Collision, Headline, Monitor, Stop};
use fem_material::engineering::Unit;
use serde::{Deserialize, Serialize};

use crate::accuracy::{
    FEW, far_mesh_errors, far_mesh_key, foretold_errors, of_moved_mass, scatter_of_any_mesh,
};
use crate::assess::overlap_warning;
use crate::early_pressure::EarlyPressure;
use crate::effects::percent;
use crate::method::{Cost, ElementSetup};
use crate::simulation::Simulation;
use crate::soft_springs::softness;
use crate::uncertainty::of_noise;

/// Room beyond the error that is seen.
const ROOM: f64 = 1.1;
/// Power of h by which errors fall, about.
const ORDER: f64 = 1.5;
/// The same with fewer elements than [`FEW`] across the contact.
const ORDER_OF_FEW: f64 = 3.0;
/// Least and most by which elements become smaller at once.
pub(crate) const STEPS: [f64; 2] = [1.25, 2.0];
/// Finer meshes after the first.
pub(crate) const MOST_LEVELS: usize = 4;
/// Element updates of a finer mesh, where the case gives no limit: some seconds.
pub(crate) const MOST_UPDATES: u64 = 150_000_000;
/// Elements of a finer mesh of condensed bodies, which take no updates: a second.
pub(crate) const MOST_ELEMENTS: u64 = 60_000;
/// An error of more than so many times what soft springs change is one of the mesh: what is told has a margin, and
/// force and pressure change by more than the contact time.
const OF_SPRINGS: f64 = 4.0;
/// Elements that would have to be smaller by more are named to nobody: what they are off by nobody has seen, and a
/// tolerance that needs them is one of rounding.
const MOST_NAMED: f64 = 100.0;
/// Scatter over the tolerance below which it is left out where a finer mesh is chosen.
const SCATTER_OF_TOLERANCE: f64 = 0.25;
/// The key of their length.
const SIZE: &str = "mesh.contact_element_size";
/// An error of more is no number any more: it is not resolved at all.
const LARGEST_TOLD: f64 = 0.5;

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

/// A quantity that may be off by more than the case allows.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Miss {
    headline: Headline,
    /// The restitution's as it is, others as shares.
    error: f64,
    tolerance: f64,
    /// What of the error is told of every mesh.
    scatter: f64,
}

impl Miss {
    fn excess(&self) -> f64 {
        self.error / self.tolerance
    }

    /// Whether a mesh could be fine enough.
    fn is_of_mesh(&self) -> bool {
        self.scatter < self.tolerance
    }

    /// By how many times what the mesh does is to become less. Where little is scatter that is the excess.
    fn excess_of_mesh(&self) -> f64 {
        match self.scatter < SCATTER_OF_TOLERANCE * self.tolerance {
            true => self.excess(),
            false => (self.error - self.scatter) / (self.tolerance - self.scatter),
        }
    }

    /// "peak force may be off by 1.7 % where 1 % is asked".
    fn in_words(&self) -> String {
        let (name, error, tolerance) =
            (self.headline.name(), self.error_in_words(), self.number(self.tolerance));
        match error == tolerance {
            true => {
                format!("{name} may be off by a little more than the {tolerance} that is asked")
            }
            false => format!("{name} may be off by {error} where {tolerance} is asked"),
        }
    }

    /// "peak force by 1.7 %", beside another one; with what is asked where that is another number.
    fn beside(&self, first: &Self) -> String {
        let (name, error, tolerance) =
            (self.headline.name(), self.error_in_words(), self.number(self.tolerance));
        let asked = match tolerance == first.number(first.tolerance) {
            true => String::new(),
            false => format!(" where {tolerance} is asked"),
        };
        let of_any_mesh = match self.is_of_mesh() {
            true => String::new(),
            false => format!(" ({} of it on any mesh)", self.number(self.scatter)),
        };
        format!("{name} by {error}{asked}{of_any_mesh}")
    }

    fn error_in_words(&self) -> String {
        match self.error <= LARGEST_TOLD {
            true => self.number(self.error),
            false => "more than half".to_string(),
        }
    }

    /// An error of its quantity.
    fn number(&self, error: f64) -> String {
        match self.headline {
            Headline::Restitution => format!("{error:.1e}"),
            _ => percent(error),
        }
    }

    /// Whether springs of these that are softer than the usual ones are at fault, and not the mesh.
    fn is_of_springs(&self, elements: &ElementSetup) -> bool {
        let is_theirs = |softness: f64| self.error <= OF_SPRINGS * softness;
        let is_possible = elements.has_springs && self.headline != Headline::Restitution;
        is_possible && softness(&elements.plan).is_some_and(is_theirs)
    }
}

/// Why a mesh stays as it is.
enum Kept {
    Given,
    FromFile,
    Gravity,
    /// What else the case gives is off by more than it allows.
    Setting(Cause),
    /// More than is allowed is told of every mesh.
    Scatter(f64),
    Dear {
        updates: Option<u64>,
    },
    Refused(CaseError),
    Stopped(String),
}

/// A setting that a case gives, of which a finer mesh is no cure.
#[derive(Clone, Copy)]
enum Cause {
    MovedMass,
    SoftSprings,
    RingingSprings,
    /// The key that gives it.
    FarMesh(&'static str),
}

impl Cause {
    /// What numbers are off by.
    fn in_words(self) -> &'static str {
        match self {
            Self::MovedMass => "the mass that is moved",
            Self::SoftSprings => "springs that give way",
            Self::RingingSprings => "springs that ring",
            Self::FarMesh(_) => "the mesh away from the contact",
        }
    }

    /// What helps without it.
    fn key(self) -> &'static str {
        match self {
            Self::MovedMass => "time.mass_scaling",
            Self::SoftSprings | Self::RingingSprings => "contact.penalty_factor",
            Self::FarMesh(key) => key,
        }
    }
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
        let headline = Headline::ALL.into_iter().find(|it| it.key() == level.quantity)?;
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

    /// The quantity of a collision that may be off by most of what the case allows, if by more than that.
    pub(crate) fn missed(&self, collision: &Collision) -> Option<Miss> {
        self.all_missed(collision).into_iter().next()
    }

    /// The quantities of a collision that may be off by more than the case allows, in the order of
    /// [`Simulation::misses`].
    fn all_missed(&self, collision: &Collision) -> Vec<Miss> {
        let doubt = self.discretisation(collision);
        // Of a pressure that comes much too early there is a warning of its own.
        let early = EarlyPressure::of(self, collision);
        let is_early = early.as_ref().is_some_and(EarlyPressure::is_beyond_reach);
        self.misses(|headline| {
            if headline == Headline::PeakPressure && is_early {
                return None;
            }
            Some(doubt.size(headline)? / headline.scale(headline.of(collision)?))
        })
    }

    /// The quantities that are off by more than the case allows, that which is off by most of it first; those that a
    /// mesh helps before the others.
    fn misses(&self, error: impl Fn(Headline) -> Option<f64>) -> Vec<Miss> {
        let accuracy = self.case().scene().accuracy();
        let scatter = scatter_of_any_mesh(self);
        let of = |(headline, tolerance): (Headline, f64)| {
            let scatter = scatter[headline as usize];
            Some(Miss { headline, error: error(headline)?, tolerance, scatter })
        };
        let all = [
            (Headline::Restitution, accuracy.restitution),
            (Headline::ContactTime, accuracy.contact_time),
            (Headline::PeakForce, accuracy.peak_force),
            (Headline::PeakPressure, accuracy.peak_pressure),
        ];
        let mut missed: Vec<Miss> =
            all.into_iter().filter_map(of).filter(|miss| miss.excess() > 1.0).collect();
        let by_excess = |a: &Miss, b: &Miss| b.excess().total_cmp(&a.excess());
        missed.sort_by(|a, b| b.is_of_mesh().cmp(&a.is_of_mesh()).then(by_excess(a, b)));
        missed
    }

    /// The first of them.
    pub(crate) fn worst_miss(&self, error: impl Fn(Headline) -> Option<f64>) -> Option<Miss> {
        self.misses(error).into_iter().next()
    }

    /// What is to be known of a collision that misses its tolerance, and why its mesh is no finer.
    pub(crate) fn miss_warning(&self, collision: &Collision) -> Option<String> {
        let plan = &self.setup().elements.as_ref()?.plan;
        let missed = self.all_missed(collision);
        let Some(miss) = missed.first() else { return self.untold(collision) };
        // One word a cause.
        if self.is_unresolved(collision)
            || overlap_warning(self, collision).is_some()
            || is_of_noise(miss, collision)
        {
            return None;
        }
        // One word a cause: that one names what does for both.
        if self.finest_needed(collision).is_some()
            && self.mesh_warning_after(collision).is_some_and(|warning| warning.contains(SIZE))
        {
            return None;
        }
        let finer = self.finer_by(&missed, collision);
        let others: Vec<String> = missed[1..].iter().map(|other| other.beside(miss)).collect();
        let others = match others.is_empty() {
            true => String::new(),
            false => format!("; also missed: {}", others.join(", ")),
        };
        let what = miss.in_words();
        let mut cause = "the mesh";
        let size = length(plan.contact_element_size / finer);
        let write = format!("write mesh.contact_element_size = \"{size}\"");
        let remedy = match self.finer_or_kept(miss, Some(collision)) {
            // A setting that is at fault comes first, whatever is asked.
            Err(Kept::Scatter(_)) if plan.is_out_of_reach => return None,
            Err(Kept::Scatter(scatter)) => {
                return Some(format!(
                    "{what}, and by {} on any mesh: allow more in accuracy.tolerance{others}",
                    miss.number(scatter)
                ));
            }
            kept if finer > MOST_NAMED && !matches!(kept, Err(Kept::Setting(_))) => {
                return Some(format!(
                    "{what} because of {cause}, and no mesh can be told that does: allow more in \
                     accuracy.tolerance{others}"
                ));
            }
            // Who has the course decides.
            Ok(_) => write,
            Err(Kept::Given) => write,
            Err(Kept::Setting(setting)) => {
                // One word a cause.
                let of_mesh = self.mesh_warning_after(collision);
                if of_mesh.is_some_and(|warning| warning.contains(setting.key())) {
                    return None;
                }
                cause = setting.in_words();
                format!("leave {} out", setting.key())
            }
            Err(Kept::FromFile) => "use meshes that are finer at the contact".to_string(),
            Err(Kept::Gravity) => {
                format!("elements of contacts under gravity are not made finer; {write}")
            }
            Err(Kept::Dear { updates: Some(updates) }) => format!(
                "a finer mesh would take {:.1e} element updates; write limits.element_updates = {:.0e}, or {write}",
                updates as f64,
                rounded_up(updates)
            ),
            Err(Kept::Dear { updates: None }) => write,
            Err(Kept::Stopped(why)) => format!("on a finer mesh {why}"),
            Err(Kept::Refused(fault)) => match fault.key() {
                Some(key) if key.starts_with("limits.") => {
                    format!("on a finer mesh {}; raise {key}", fault.message())
                }
                _ => format!("on a finer mesh {}; {write}", fault.message()),
            },
        };
        Some(format!(
            "{what} because of {cause}: {remedy}, or allow more in accuracy.tolerance{others}"
        ))
    }

    /// By how much elements would have to be smaller for what a collision is off by, as far as a mesh can help. Errors
    /// that are told of few elements fall faster than those of more.
    fn finer_by(&self, missed: &[Miss], collision: &Collision) -> f64 {
        let of_mesh = missed.iter().filter(|miss| miss.is_of_mesh());
        let excess = of_mesh.map(Miss::excess_of_mesh).fold(1.0, f64::max);
        let size =
            self.setup().elements.as_ref().map(|elements| elements.plan.contact_element_size);
        let across =
            collision.max_contact_radius.zip(size).map_or(FEW, |(radius, size)| radius / size);
        let to_usual = (FEW / across).max(1.0);
        let (excess, of_few) = (ROOM * excess, to_usual.powf(ORDER_OF_FEW));
        match excess < of_few {
            true => excess.powf(1.0 / ORDER_OF_FEW).max(STEPS[0]),
            false => (to_usual * (excess / of_few).powf(1.0 / ORDER)).max(STEPS[0]),
        }
    }

    /// Length of the elements (m) that a collision needs on whose mesh it misses its tolerance, where that was given.
    pub(crate) fn finest_needed(&self, collision: &Collision) -> Option<f64> {
        let missed = self.all_missed(collision);
        let finer = self.finer_by(&missed, collision);
        let kept = self.finer_or_kept(missed.first()?, Some(collision));
        let is_given = matches!(kept, Err(Kept::Given));
        let size = self.setup().elements.as_ref()?.plan.contact_element_size;
        (is_given && finer <= MOST_NAMED).then_some(size / finer)
    }

    /// That nothing tells what the mesh of a collision is off by, where that was to be told.
    fn untold(&self, collision: &Collision) -> Option<String> {
        let is_to_be = collision.is_complete()
            && collision.element_updates.is_some()
            && self.setup().elements.as_ref()?.plan.makes_meshes;
        let is_told = self.discretisation(collision).size(Headline::PeakForce).is_some();
        (is_to_be && !is_told).then(|| {
            "what the mesh is off by is not told: on coarser and finer meshes the bodies did not come through the \
             collision; lower body.N.approach_speed, or compare results of several mesh.contact_element_size"
                .to_string()
        })
    }

    /// The setting of the case that is off by more than is allowed, whatever the mesh; of a collision or before one.
    fn other_cause(&self, miss: &Miss, met: Option<&Collision>) -> Option<Cause> {
        let (scene, elements) = (self.case().scene(), self.setup().elements.as_ref()?);
        if miss.is_of_springs(elements) {
            return Some(Cause::SoftSprings);
        }
        let of_mass = of_moved_mass(elements.added_share, miss.headline);
        if scene.mass_scaling().is_some() && of_mass > miss.tolerance {
            return Some(Cause::MovedMass);
        }
        if let Some(key) = far_mesh_key(self) {
            let of_far_mesh = far_mesh_errors(self).and_then(|of| of[miss.headline as usize]);
            if of_far_mesh.is_some_and(|of| of > miss.tolerance) {
                return Some(Cause::FarMesh(key));
            }
        }
        let collision = met?;
        if is_of_noise(miss, collision) {
            return Some(Cause::RingingSprings);
        }
        // On average springs overlap by half as much, and the contact lasts longer as the approach grows.
        let overlap = collision.deepest.map_or(0.0, |deepest| deepest.overlap);
        let of_springs = 0.5 * overlap / collision.max_approach?;
        let is_soft = scene.penalty_factor().is_some_and(|factor| factor < 1.0);
        (is_soft && of_springs > miss.tolerance).then_some(Cause::SoftSprings)
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

/// Whether what is missed is what noise is off by.
fn is_of_noise(miss: &Miss, collision: &Collision) -> bool {
    of_noise(collision, miss.headline) > miss.tolerance
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

/// One digit.
fn rounded_up(updates: u64) -> f64 {
    let power = 10f64.powf((updates as f64).log10().floor());
    (updates as f64 / power).ceil() * power
}
