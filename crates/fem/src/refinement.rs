//! Meshes that are made finer until a result is within the tolerance of its case.
//!
//! The plan chooses elements by a rule of closed forms ([`crate::Plan`]). What the mesh of a result is off by
//! its companions tell when it is there (`accuracy/companion.rs`). Where that is more than `[accuracy]`
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

use std::convert::Infallible;

use fem_case::{Body, CaseError, Shape};
use fem_collision::{Collision, Headline, Monitor, Stop};
use fem_material::engineering::Unit;
use serde::{Deserialize, Serialize};

use crate::accuracy::of_moved_mass;
use crate::early_pressure::EarlyPressure;
use crate::effects::percent;
use crate::method::Cost;
use crate::simulation::Simulation;

/// Room beyond the error that is seen.
const ROOM: f64 = 1.1;
/// Power of h by which errors fall, about.
const ORDER: f64 = 1.5;
/// Least and most by which elements become smaller at once.
const STEPS: [f64; 2] = [1.25, 2.0];
/// Finer meshes after the first.
const MOST_LEVELS: usize = 4;
/// Element updates of a mesh over those of one of twice as long elements, at most.
const DEAREST: u64 = 8;
/// Element updates of a finer mesh, where the case gives no limit: some seconds.
const MOST_UPDATES: u64 = 150_000_000;
/// Elements of a finer mesh of condensed bodies, which take no updates: a second.
const MOST_ELEMENTS: u64 = 60_000;

/// A mesh that was too coarse.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Level {
    /// Edge length of its elements at the contact.
    pub contact_element_size_m: f64,
    /// What it took, of a model that steps.
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
}

impl Miss {
    fn excess(&self) -> f64 {
        self.error / self.tolerance
    }

    /// "peak force may be off by 1.7 % where 1 % is asked".
    fn in_words(&self) -> String {
        let [error, tolerance] = [self.error, self.tolerance].map(|size| match self.headline {
            Headline::Restitution => format!("{size:.1e}"),
            _ => percent(size),
        });
        let name = self.headline.name();
        format!("{name} may be off by {error} where {tolerance} is asked")
    }
}

/// Why a mesh stays as it is.
enum Kept {
    Given,
    FromFile,
    Gravity,
    /// What else the case gives is off by more than it allows.
    Setting(Cause),
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
}

impl Cause {
    /// What numbers are off by, and what helps.
    fn in_words(self) -> [&'static str; 2] {
        match self {
            Self::MovedMass => ["the mass that is moved", "leave time.mass_scaling out"],
            Self::SoftSprings => ["springs that give way", "leave contact.penalty_factor out"],
        }
    }
}

impl Simulation {
    /// Computes the collision, again on finer meshes where the first does not do; what came, and the
    /// simulation that it came from.
    pub fn run_within_tolerance(self, monitor: &mut dyn Monitor) -> (Self, Collision) {
        let computed =
            self.within_tolerance(|simulation| Ok::<_, Infallible>(simulation.run(monitor)));
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
        self.finer_or_kept(&self.missed(collision)?, collision).ok()
    }

    /// Most element updates that finer meshes take in all, beyond those of this one, should its result miss the
    /// tolerance; `None` where its elements stay.
    pub fn most_of_finer_meshes(&self) -> Option<u64> {
        let Cost::Steps { element_updates, .. } = self.setup().cost else { return None };
        let scene = self.case().scene();
        let is_given = scene.mesh().contact_element_size.is_some();
        if is_given || self.has_mesh_file() || scene.gravity().is_some() {
            return None;
        }
        let most = scene.limits().element_updates.unwrap_or(MOST_UPDATES);
        let levels = 1..=MOST_LEVELS as u32;
        let dearest = levels.map(|level| element_updates.saturating_mul(DEAREST.pow(level)));
        // Of meshes up to the dearest that is allowed each takes half of the next, or less.
        let all = dearest.fold(0, u64::saturating_add);
        Some(all.min(most.saturating_mul(2)))
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
        let miss = Miss { headline, error: level.error, tolerance: level.tolerance };
        let size = self.setup().elements.as_ref()?.plan.contact_element_size;
        Some(format!(
            "{}: again with elements of {} in place of {}",
            miss.in_words(),
            length(size),
            length(level.contact_element_size_m)
        ))
    }

    /// The quantity of a collision that may be off by most of what the case allows, if by more than that.
    pub(crate) fn missed(&self, collision: &Collision) -> Option<Miss> {
        let accuracy = self.case().scene().accuracy();
        let doubt = self.discretisation(collision);
        let of = |(headline, tolerance): (Headline, f64)| {
            let error = doubt.size(headline)? / headline.scale(headline.of(collision)?);
            Some(Miss { headline, error, tolerance })
        };
        let all = [
            (Headline::Restitution, accuracy.restitution),
            (Headline::ContactTime, accuracy.contact_time),
            (Headline::PeakForce, accuracy.peak_force),
            (Headline::PeakPressure, accuracy.peak_pressure),
        ];
        // Of a pressure that comes much too early there is a warning of its own.
        let early = EarlyPressure::of(self, collision);
        let is_early = || early.as_ref().is_some_and(EarlyPressure::is_beyond_reach);
        let is_wanted =
            |(headline, _): &(Headline, f64)| *headline != Headline::PeakPressure || !is_early();
        let all = all.into_iter().filter(is_wanted);
        let missed = all.filter_map(of).filter(|miss| miss.excess() > 1.0);
        missed.max_by(|a, b| a.excess().total_cmp(&b.excess()))
    }

    /// What is to be known of a collision that misses its tolerance, and why its mesh is no finer.
    pub(crate) fn miss_warning(&self, collision: &Collision) -> Option<String> {
        let plan = &self.setup().elements.as_ref()?.plan;
        let Some(miss) = self.missed(collision) else { return self.untold(collision) };
        let size = plan.contact_element_size / step(miss.excess(), f64::INFINITY);
        let mut cause = "the mesh";
        let write = format!("write mesh.contact_element_size = \"{}\"", length(size));
        let remedy = match self.finer_or_kept(&miss, collision) {
            // Who has the course decides.
            Ok(_) => write,
            Err(Kept::Given) => write,
            Err(Kept::Setting(setting)) => {
                let [of, remedy] = setting.in_words();
                cause = of;
                remedy.to_string()
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
            "{} because of {cause}: {remedy}, or allow more in accuracy.tolerance",
            miss.in_words()
        ))
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

    /// The setting of the case that is off by more than is allowed, whatever the mesh.
    fn other_cause(&self, miss: &Miss, collision: &Collision) -> Option<Cause> {
        let scene = self.case().scene();
        let of_mass = of_moved_mass(collision, miss.headline);
        if scene.mass_scaling().is_some() && of_mass > miss.tolerance {
            return Some(Cause::MovedMass);
        }
        // On average springs overlap by half as much, and the contact lasts longer as the approach grows.
        let overlap = collision.deepest.map_or(0.0, |deepest| deepest.overlap);
        let of_springs = 0.5 * overlap / collision.max_approach?;
        let is_soft = scene.penalty_factor().is_some_and(|factor| factor < 1.0);
        (is_soft && of_springs > miss.tolerance).then_some(Cause::SoftSprings)
    }

    /// The same case on a finer mesh, or why there is none.
    fn finer_or_kept(&self, miss: &Miss, collision: &Collision) -> Result<Self, Kept> {
        let scene = self.case().scene();
        let elements = self.setup().elements.as_ref().ok_or(Kept::Given)?;
        if let Some(cause) = self.other_cause(miss, collision) {
            return Err(Kept::Setting(cause));
        }
        if self.has_mesh_file() {
            return Err(Kept::FromFile);
        }
        if scene.mesh().contact_element_size.is_some() {
            return Err(Kept::Given);
        }
        if scene.gravity().is_some() || collision.approach != self.setup().approach {
            return Err(Kept::Gravity);
        }
        if let Some(why) = &self.stopped_finer {
            return Err(Kept::Stopped(why.clone()));
        }
        if self.levels.len() >= MOST_LEVELS {
            return Err(Kept::Dear { updates: None });
        }
        let level = Level {
            contact_element_size_m: elements.plan.contact_element_size,
            element_updates: collision.element_updates,
            quantity: miss.headline.key().to_string(),
            error: miss.error,
            tolerance: miss.tolerance,
        };
        let levels: Vec<Level> = self.levels.iter().cloned().chain([level]).collect();
        let finer =
            |by: f64| self.refined(self.refinement * by, levels.clone()).map_err(Kept::Refused);
        let by = step(miss.excess(), STEPS[1]);
        let finer = match (finer(by)?, by < STEPS[1]) {
            (short, true) if self.is_foretold(collision) && short.missed(collision).is_some() => {
                finer(STEPS[1])?
            }
            (enough, _) => enough,
        };
        match finer.setup().cost {
            Cost::Steps { element_updates, .. } => {
                let most = scene.limits().element_updates.unwrap_or(MOST_UPDATES);
                match element_updates <= most {
                    true => Ok(finer),
                    false => Err(Kept::Dear { updates: Some(element_updates) }),
                }
            }
            Cost::Factors { elements, .. } if elements > MOST_ELEMENTS => {
                Err(Kept::Dear { updates: None })
            }
            _ => Ok(finer),
        }
    }
}

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
