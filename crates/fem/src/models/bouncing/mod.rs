//! A ball that gravity brings back: contact, flight, contact, until it rests or has bounced as often as
//! was asked.
//!
//! Every contact is a collision of the scene's model at the speed at which the ball comes down. Between
//! two contacts it flies, in closed form: a ball that leaves with the velocity u at the height y, of its
//! mass centre above that at first touch, comes down after a time t with a speed v,
//!
//! ```math
//! v^2 = u^2 + 2 g y, \qquad g t = u + v .
//! ```
//!
//! One that does not come up to y = 0 is at rest: it leaves no more than a dent. Each contact begins with
//! bodies that neither vibrate nor remember. What the contact before has left in them stays in an account
//! of its own ([`Account::LeftBefore`](fem_collision::Account)); what its phase could have done is
//! bounded ([`phase`]).
//!
//! Elements that the plan has chosen are chosen anew where the contacts have become too small for them.

mod chain;
mod phase;
mod report;

use fem_case::{Gravity, Scene};
use fem_collision::{
    Approach, Bounce, Collision, Ending, Monitor, Phase, Progress, Rest, Snapshot, SnapshotRequest,
    StaticContact, Stop, Want,
};
use fem_mesh::SphereMesh;

use crate::effects::{Answer, Effect};
use crate::estimate::Estimate;
use crate::method::{Model, Setup, Shared};
use crate::models::method_of;
use crate::refusal::Refusal;
use chain::Chain;

/// Elements across the expected contact radius below which a mesh is made anew; the plan's has eight.
const FEWEST_ELEMENTS: f64 = 6.0;
/// Rows of all contacts after the first one together are at most so many times those of the first.
const ROWS_OF_ALL: usize = 10;
/// Rows of a contact that show its course.
const FEWEST_ROWS: usize = 20;

/// A scene with gravity, and the model of its first contact.
#[derive(Debug)]
pub(super) struct Bouncing {
    scene: Scene,
    gravity: Gravity,
    first: Box<dyn Model>,
}

impl Bouncing {
    /// Of a scene with this gravity.
    pub fn new(scene: &Scene, gravity: Gravity, first: Box<dyn Model>) -> Self {
        Self { scene: scene.clone(), gravity, first }
    }

    /// Speed (m/s) and time (s) of first touch, and the height of the fall, m.
    fn fall(&self, approach: &Approach) -> (f64, f64, f64) {
        if *approach == self.setup().approach {
            let height = self.scene.gap().unwrap_or_default();
            return (approach.speed(), self.scene.first_touch(), height);
        }
        let acceleration = self.gravity.acceleration;
        let (speed, height) = (approach.speed(), approach.gap());
        let impact = speed.hypot((2.0 * acceleration).sqrt() * height.sqrt());
        (impact, (impact - speed) / acceleration, height)
    }

    /// The model for a contact at a speed (m/s), if the present one's elements are too large for it.
    fn anew(&self, present: &dyn Model, speed: f64) -> Result<Option<Box<dyn Model>>, Stop> {
        let Some(elements) = &present.setup().elements else { return Ok(None) };
        let is_given = self.scene.mesh().contact_element_size.is_some();
        if is_given || !elements.plan.makes_meshes {
            return Ok(None);
        }
        let estimate = Estimate::at(&self.scene, speed)
            .map_err(|error| Stop::OutOfRange(error.to_string()))?;
        if estimate.contact_radius >= FEWEST_ELEMENTS * elements.plan.contact_element_size {
            return Ok(None);
        }
        let not_made = |message: String| Stop::NotMade(message);
        let scene = self.scene.touching_at(speed);
        let scene =
            scene.ok_or_else(|| not_made(format!("the ball comes down at {speed:?} m/s")))?;
        let model = method_of(&scene).build(&scene, &Shared::default());
        model.map(Some).map_err(|refusal| not_made(refusal.to_string()))
    }

    /// Contacts and flights, up to rest or the number that is asked for.
    fn bounce(&self, approach: &Approach, want: &Want, monitor: &mut dyn Monitor) -> Bounced {
        let (mut speed, time, height) = self.fall(approach);
        let mut bounced = Bounced::new(Chain::new(time), self.gravity);
        let mut replaced: Option<Box<dyn Model>> = None;
        for k in 0..self.gravity.bounces {
            let present = replaced.as_deref().unwrap_or(self.first.as_ref());
            match self.anew(present, speed) {
                Ok(Some(model)) if k > 0 => replaced = Some(model),
                Ok(_) => {}
                Err(stop) => return bounced.stopped(stop),
            }
            let model = replaced.as_deref().unwrap_or(self.first.as_ref());
            let asked = match k {
                0 => first_want(want, time),
                _ => later_want(want, self.gravity.bounces, bounced.element_updates()),
            };
            let contact = match Approach::new([0.0, -speed], 0.0) {
                Ok(contact) => contact,
                Err(error) => return bounced.stopped(Stop::NotMade(error.to_string())),
            };
            let mut one = OneOfMany { monitor, k, n: self.gravity.bounces, time: bounced.time() };
            let collision = model.collide(&contact, &asked, &mut one);
            let collision = if k == 0 { fallen(collision, time, height) } else { collision };
            match bounced.take(collision, want) {
                Some(landing) => speed = landing,
                None => break,
            }
        }
        bounced
    }

    /// What bears the ball in the end, or why nothing does.
    fn rest(&self, bounced: &mut Bounced) {
        let Some(weight) = bounced.weight() else { return };
        match self.first.static_contact(weight) {
            Ok(Some(contact)) => {
                let radius = self.setup().estimate.hertz.pair().effective_radius();
                let too_large = report::too_large(&contact, radius);
                too_large.into_iter().for_each(|warning| bounced.warn(warning));
                bounced.bear(Rest { time: bounced.time(), contact });
            }
            Ok(None) => bounced.warn(report::sinks()),
            Err(refusal) => bounced.warn(report::unknown(&refusal)),
        }
    }
}

impl Model for Bouncing {
    fn setup(&self) -> &Setup {
        self.first.setup()
    }

    fn has(&self, effect: &dyn Effect, estimate: &Estimate) -> Option<Answer> {
        self.first.has(effect, estimate)
    }

    fn collide(&self, approach: &Approach, want: &Want, monitor: &mut dyn Monitor) -> Collision {
        if let Err(error) = want.check() {
            return Collision::stopped(*approach, error.into());
        }
        let mut bounced = self.bounce(approach, want, monitor);
        if bounced.is_at_rest() {
            self.rest(&mut bounced);
        }
        bounced.collision(*approach)
    }

    fn static_contact(&self, force: f64) -> Result<Option<StaticContact>, Refusal> {
        self.first.static_contact(force)
    }

    fn meshes(&self) -> [Option<&SphereMesh>; 2] {
        self.first.meshes()
    }
}

/// What the first contact is asked for, which begins at a time (s) of the case.
fn first_want(want: &Want, time: f64) -> Want {
    let snapshots = match &want.snapshots {
        SnapshotRequest::Times(times) => SnapshotRequest::Times(
            times.iter().map(|one| one - time).filter(|t| *t >= 0.0).collect(),
        ),
        other => other.clone(),
    };
    Want { history_rows: want.history_rows.max(FEWEST_ROWS), snapshots, ..want.clone() }
}

/// What a contact after the first of so many is asked for, after so many element updates.
fn later_want(want: &Want, n_contacts: usize, element_updates: u64) -> Want {
    let share = ROWS_OF_ALL.saturating_mul(want.history_rows) / n_contacts.max(1);
    Want {
        history_rows: share.min(want.history_rows).max(FEWEST_ROWS),
        snapshots: SnapshotRequest::none(),
        most_element_updates: want.most_element_updates.saturating_sub(element_updates),
        ..want.clone()
    }
}

/// A first contact at time 0 as that of a case in which it came after a fall, s and m.
fn fallen(collision: Collision, time: f64, height: f64) -> Collision {
    let lowered = |mut snapshot: Snapshot| {
        snapshot.time += time;
        let [_, upper] = &mut snapshot.bodies;
        for place in upper.displacement.iter_mut().chain(&mut upper.effective) {
            place[1] -= height;
        }
        snapshot
    };
    let snapshots = collision.snapshots.into_iter().map(lowered).collect();
    Collision { snapshots, ..collision }
}

/// Looks on for one that looks on at all contacts.
struct OneOfMany<'a> {
    monitor: &'a mut dyn Monitor,
    k: usize,
    n: usize,
    /// First touch since the start of the case, s.
    time: f64,
}

impl Monitor for OneOfMany<'_> {
    fn enter(&mut self, phase: Phase) {
        self.monitor.enter(phase);
    }

    fn report(&mut self, progress: Progress) -> bool {
        let fraction = (self.k as f64 + progress.fraction) / self.n as f64;
        self.monitor.report(Progress { time: self.time + progress.time, fraction, ..progress })
    }
}

/// What came of the contacts so far.
struct Bounced {
    gravity: Gravity,
    chain: Chain,
    first: Option<Collision>,
    bounces: Vec<Bounce>,
    rest: Option<Rest>,
    ending: Ending,
    steps: Option<u64>,
    element_updates: Option<u64>,
    /// Energy (J) left in vibrations by the contact before, and the largest bound of what they do.
    vibration: f64,
    phase: Option<(usize, f64)>,
    warnings: Vec<String>,
}

impl Bounced {
    fn new(chain: Chain, gravity: Gravity) -> Self {
        Self {
            gravity,
            chain,
            first: None,
            bounces: Vec::new(),
            rest: None,
            ending: Ending::Parted,
            steps: None,
            element_updates: None,
            vibration: 0.0,
            phase: None,
            warnings: Vec::new(),
        }
    }

    /// The contact under way has first touched here, s; after the last one when that ended.
    fn time(&self) -> f64 {
        self.chain.time()
    }

    fn element_updates(&self) -> u64 {
        self.element_updates.unwrap_or_default()
    }

    fn is_at_rest(&self) -> bool {
        self.ending == Ending::AtRest
    }

    fn warn(&mut self, warning: String) {
        if !self.warnings.contains(&warning) {
            self.warnings.push(warning);
        }
    }

    fn bear(&mut self, rest: Rest) {
        self.rest = Some(rest);
    }

    /// m g, N.
    fn weight(&self) -> Option<f64> {
        Some(self.gravity.acceleration * self.first.as_ref()?.bodies[1].mass?)
    }

    fn stopped(mut self, stop: Stop) -> Self {
        self.ending = Ending::Stopped(stop);
        self
    }

    /// Takes a contact; the speed (m/s) at which the ball comes down again, if it does.
    fn take(&mut self, mut collision: Collision, want: &Want) -> Option<f64> {
        let add = |sum: Option<u64>, more: Option<u64>| {
            more.map(|more| sum.unwrap_or_default().saturating_add(more)).or(sum)
        };
        self.steps = add(self.steps, collision.steps);
        self.element_updates = add(self.element_updates, collision.element_updates);
        let time = self.time();
        for warning in std::mem::take(&mut collision.warnings) {
            self.warn(warning);
        }
        let rows = std::mem::take(&mut collision.history);
        self.chain.take(&collision, &rows);
        if let Ending::Stopped(stop) = &collision.ending {
            self.chain.keep(&rows, f64::INFINITY);
            self.ending = Ending::Stopped(stop.clone().later_by(time));
            self.first.get_or_insert(collision);
            return None;
        }
        let bounce = Bounce {
            time,
            speed_before: collision.approach.speed(),
            restitution: collision.restitution.unwrap_or_default(),
            contact_time: collision.contact_time,
            peak_force: collision.peak_force,
        };
        self.bounces.push(bounce);
        self.bound_phase(&collision, &bounce);
        let is_parted = collision.ending == Ending::Parted;
        let end = rows.last().copied().filter(|_| is_parted);
        if end.is_some_and(|end| !Chain::is_sound(&end)) {
            let what = format!("the flight after contact {} is no number", self.bounces.len());
            self.ending = Ending::Stopped(Stop::OutOfRange(what));
            self.chain.keep(&rows, f64::INFINITY);
            self.first.get_or_insert(collision);
            return None;
        }
        let landing = end.and_then(|end| self.chain.landing(&end, self.gravity.acceleration));
        self.chain.keep(&rows, landing.map_or(f64::INFINITY, |landing| landing.time));
        self.first.get_or_insert(collision);
        let Some(landing) = landing else {
            self.chain.stay(rows.last());
            self.ending = Ending::AtRest;
            return None;
        };
        if self.bounces.len() < self.gravity.bounces
            && let Some(end) = &end
        {
            self.chain.fly(end, &landing, want.history_rows > 0);
        }
        Some(landing.speed)
    }

    /// What the vibrations of the contact before can have done to this one.
    fn bound_phase(&mut self, collision: &Collision, bounce: &Bounce) {
        let left: f64 = collision.bodies.iter().filter_map(|body| body.vibration_energy).sum();
        let initial = collision.initial_energy.unwrap_or(f64::INFINITY);
        let bound = phase::bound(self.vibration, left, initial, bounce.restitution);
        if bound > self.phase.map_or(phase::LARGEST, |(_, largest)| largest) {
            self.phase = Some((self.bounces.len(), bound));
        }
        self.vibration = left;
    }

    /// The whole.
    fn collision(mut self, approach: Approach) -> Collision {
        let Some(first) = self.first.take() else {
            let stop = match self.ending {
                Ending::Stopped(stop) => stop,
                _ => Stop::NotMade("the ball never came down".to_string()),
            };
            return Collision::stopped(approach, stop);
        };
        let said = report::of(&self.bounces, &self.ending, self.phase);
        said.into_iter().for_each(|warning| self.warn(warning));
        let shift = |time: Option<f64>| Some(time? + self.chain.first_touch());
        Collision {
            approach,
            first_contact: shift(first.first_contact),
            last_contact: shift(first.last_contact),
            energies: self.chain.energies(),
            residual: self.chain.residual(),
            residual_relative: self.chain.worst_residual().or(first.residual_relative),
            steps: self.steps,
            element_updates: self.element_updates,
            bounces: self.bounces,
            rest: self.rest,
            ending: self.ending,
            history: self.chain.into_rows(),
            warnings: self.warnings,
            ..first
        }
    }
}
