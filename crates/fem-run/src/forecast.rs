//! How long a run will take here: some of its steps are timed. `check` and the run say the same.

use std::time::{Duration, Instant};

use fem::accuracy::condensed_companion_time;
use fem::{Cost, Following, MostFiner, Simulation};
use fem_case::engineering::show;
use fem_collision::{Monitor, Phase, Progress, Want};

/// What the timing of steps takes at least, ...
const PATIENCE: Duration = Duration::from_millis(1);
/// ... and until so many reports are timed, ...
const REPORTS: u32 = 5;
/// ... unless that takes longer.
const PATIENCE_WITH_REPORTS: Duration = Duration::from_millis(50);
/// The same of condensed bodies, ...
const PATIENCE_WITH_CONDENSED: Duration = Duration::from_millis(20);
/// ... of whose collision so large a share is enough.
const SHARE_OF_CONDENSED: f64 = 0.2;
/// Time of the fields of a snapshot of condensed bodies over that of making these: 0.08 of elastic ones, 0.1 of relaxing
/// ones.
const FIELDS: f64 = 0.1;
/// The same of its file, 0.2 to 0.6, ...
const FILE: f64 = 0.4;
/// ... and of the report of a run with snapshots.
const REPORT: f64 = 0.8;

/// Element updates of collisions and their companions that `check` computes to foretell what follows: two or three seconds.
pub const PATIENCE_OF_CHECK: u64 = 30_000_000;

/// What is known of a run with elements before it begins.
#[derive(Clone, Copy, Debug)]
pub struct Forecast {
    /// Seconds here, with what tells its error.
    pub seconds: Option<f64>,
    /// Element updates of the collision over those that its cost announces.
    pub longer: f64,
    /// Element updates of the collision and of its companions; none of what takes none.
    element_updates: f64,
    /// Finer meshes that may follow.
    pub finer: Option<Finer>,
}

/// Finer meshes that follow where the mesh misses what the case allows, which only the run tells.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Finer {
    /// Those that coarser meshes foretell, or the collision itself, where these are quick.
    foretold: Option<Foretold>,
    /// Those that may follow.
    most: MostFiner,
    /// What the collision takes with its companions: element updates and seconds.
    first: (f64, f64),
}

/// Finer meshes that are expected.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Foretold {
    meshes: usize,
    /// Element updates with those of their companions over those of the first mesh.
    over_first: f64,
}

impl Forecast {
    /// Of a run whose bodies took so long to make, s; `is_open` says whether finer meshes may follow, which collisions of
    /// no more than `patience` element updates are computed to foretell.
    pub fn of(simulation: &Simulation, making: f64, is_open: bool, patience: u64) -> Self {
        let (longer, following) = simulation.following(patience);
        let seconds = seconds(simulation, making, longer);
        let (companions, announced) = match simulation.setup().cost {
            Cost::Steps { element_updates, .. } => {
                (simulation.companion_updates().unwrap_or(0.0), element_updates as f64)
            }
            _ => (0.0, 0.0),
        };
        let element_updates = (1.0 + companions) * longer * announced;
        let most = is_open.then(|| simulation.most_of_finer_meshes()).flatten();
        let finer = seconds.zip(most).map(|(seconds, most)| Finer {
            foretold: following.map(|Following { meshes, element_updates }| Foretold {
                meshes,
                over_first: element_updates as f64 / (longer * announced),
            }),
            most,
            first: (element_updates, seconds),
        });
        Self { seconds, longer, element_updates, finer }
    }

    /// Element updates that are expected in all.
    pub fn all_element_updates(&self) -> f64 {
        self.element_updates * self.over_first()
    }

    /// Seconds here in all.
    pub fn all_seconds(&self) -> Option<f64> {
        Some(self.over_first() * self.seconds?)
    }

    /// Seconds here with all finer meshes that may follow.
    pub fn most_seconds(&self) -> Option<f64> {
        let most = self.finer.map_or(0.0, |finer| finer.most.over_first);
        Some(self.over_first().max(1.0 + most) * self.seconds?)
    }

    /// What is expected in all, over what the first mesh takes.
    fn over_first(&self) -> f64 {
        let foretold = self.finer.and_then(|finer| finer.foretold);
        1.0 + foretold.map_or(0.0, |foretold| foretold.over_first)
    }
}

impl Finer {
    /// "1 foretold, about 6.0e6 element updates more, 8.1 s; at most 1.7e8 element updates more, 229 s".
    pub fn in_words(&self) -> String {
        let (updates, seconds) = self.first;
        let price = |over_first: f64| {
            let time = show(over_first * seconds, "s");
            match updates > 0.0 {
                true => format!("{:.1e} element updates more, {time}", over_first * updates),
                false => format!("{time} more"),
            }
        };
        let MostFiner { meshes, over_first: most } = self.most;
        match self.foretold {
            Some(Foretold { meshes, over_first }) => {
                let most = price(most.max(over_first));
                match meshes {
                    0 => format!("none is foretold; at most {most}"),
                    _ => format!("{meshes} foretold, about {}; at most {most}", price(over_first)),
                }
            }
            None => format!("at most {meshes}, {}", price(most)),
        }
    }
}

/// Seconds of a run here, with what tells its error where that takes runs; nothing of a model without elements, nor of
/// a ball that bounces, whose cost is that of one contact.
fn seconds(simulation: &Simulation, making: f64, longer: f64) -> Option<f64> {
    if simulation.case().scene().gravity().is_some() {
        return None;
    }
    match simulation.setup().cost {
        Cost::Steps { steps, seconds, .. } => {
            let companions = simulation.companion_updates().unwrap_or(0.0);
            let timed = (1.0 + companions) * seconds_a_step(simulation)? * steps as f64;
            // The first steps have little contact, and are in the processor's cache.
            Some(longer * timed.max(seconds))
        }
        Cost::Factors { .. } => Some(of_condensed(simulation, making)),
        Cost::Little { .. } => None,
    }
}

/// The fewest seconds of a step among some reports: what else this machine does now and then is no part of it.
fn seconds_a_step(simulation: &Simulation) -> Option<f64> {
    let mut course = simulation.start();
    let begin = Instant::now();
    let (mut fewest, mut before) = (None, (Duration::ZERO, 0));
    let mut n_reports = 0;
    let goes_on = |spent: Duration, n_reports: u32| {
        spent < PATIENCE || (n_reports < REPORTS && spent < PATIENCE_WITH_REPORTS)
    };
    while goes_on(begin.elapsed(), n_reports) && course.advance(&mut ()) {
        let now = (begin.elapsed(), course.progress().step);
        let seconds = (now.0 - before.0).as_secs_f64() / (now.1 - before.1).max(1) as f64;
        fewest = Some(fewest.map_or(seconds, |fewest: f64| fewest.min(seconds)));
        (before, n_reports) = (now, n_reports + 1);
    }
    fewest
}

/// Of condensed bodies that took so long to make, s.
fn of_condensed(simulation: &Simulation, making: f64) -> f64 {
    let begin = Instant::now();
    let mut patient = Patient { begin, before: 0.0, seen: (0.0, 0.0), is_over: false };
    let approach = &simulation.setup().approach;
    let _ = simulation.model().collide(approach, &Want::history(), &mut patient);
    if !patient.is_over {
        patient.seen = (begin.elapsed().as_secs_f64(), 1.0);
    }
    let collision = patient.collision();
    let n_snapshots = simulation.want().snapshots.len();
    let has_report = simulation.case().scene().wants_report() && n_snapshots > 0;
    let of_report = if has_report { REPORT } else { 0.0 };
    let files = making * ((FIELDS + FILE) * n_snapshots as f64 + of_report);
    let elements = simulation.setup().elements.as_ref();
    let across = elements.map_or(f64::INFINITY, |elements| {
        simulation.setup().estimate.contact_radius / elements.plan.contact_element_size
    });
    collision + files + condensed_companion_time(across) * (collision + making)
}

/// Stops a run that tells enough, or after a while, and knows how far it was.
struct Patient {
    begin: Instant,
    /// Seconds until the first step: factors of bodies that relax are made before it.
    before: f64,
    /// Seconds and share of the run.
    seen: (f64, f64),
    is_over: bool,
}

impl Patient {
    /// Seconds of the whole collision.
    fn collision(&self) -> f64 {
        let (spent, fraction) = self.seen;
        let steps = spent - self.before;
        self.before + if fraction > 0.0 { steps / fraction } else { steps }
    }
}

impl Monitor for Patient {
    fn enter(&mut self, phase: Phase) {
        if phase == Phase::Collision {
            self.before = self.begin.elapsed().as_secs_f64();
        }
    }

    fn report(&mut self, progress: Progress) -> bool {
        let spent = self.begin.elapsed();
        self.seen = (spent.as_secs_f64(), progress.fraction);
        let is_enough = progress.fraction >= SHARE_OF_CONDENSED;
        self.is_over = is_enough || (spent > PATIENCE_WITH_CONDENSED && progress.fraction > 0.0);
        !self.is_over
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A fifth of the steps took a second: all take five, after four of factors.
    #[test]
    fn factors_are_made_once() {
        let patient =
            Patient { begin: Instant::now(), before: 4.0, seen: (5.0, 0.2), is_over: true };
        assert!((patient.collision() - 9.0).abs() < 1e-12);
        let nothing = Patient { seen: (5.0, 0.0), ..patient };
        assert!((nothing.collision() - 5.0).abs() < 1e-12);
    }
}
