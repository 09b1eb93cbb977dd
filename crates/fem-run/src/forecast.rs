//! How long a run will take here: some of its steps are timed. `check` and the run say the same.

use std::time::{Duration, Instant};

use fem::accuracy::condensed_companion_time;
use fem::{Cost, Following, Simulation};
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

/// Element updates of collisions and their companions that `check` computes to foretell what follows: two or three seconds.
pub const PATIENCE_OF_CHECK: u64 = 30_000_000;

/// What is known of a run of finite elements before it begins.
#[derive(Clone, Copy, Debug)]
pub struct Forecast {
    /// Seconds here, with what tells its error.
    pub seconds: Option<f64>,
    /// Element updates of the collision over those that its cost announces.
    pub longer: f64,
    /// Element updates of the collision and of its companions.
    element_updates: f64,
    /// Finer meshes that may follow.
    pub finer: Option<Finer>,
}

/// Finer meshes that follow where the mesh misses what the case allows, which only the run tells.
#[derive(Clone, Copy, Debug)]
pub struct Finer {
    /// Those that coarser meshes foretell, where these are quick.
    following: Option<Following>,
    /// Element updates at most.
    most: u64,
    /// Of their companions over those of the collision.
    companions: f64,
    /// Seconds of an element update here.
    each: f64,
}

impl Forecast {
    /// Of a run whose bodies took so long to make, s; `is_open` says whether finer meshes may follow, which collisions of
    /// no more than `patience` element updates are computed to foretell.
    pub fn of(simulation: &Simulation, making: f64, is_open: bool, patience: u64) -> Self {
        let companions = simulation.companion_updates().unwrap_or(0.0);
        let Cost::Steps { element_updates, .. } = simulation.setup().cost else {
            let seconds = seconds(simulation, making, 1.0);
            return Self { seconds, longer: 1.0, element_updates: 0.0, finer: None };
        };
        let (longer, following) = simulation.following(patience);
        let seconds = seconds(simulation, making, longer);
        let all = (1.0 + companions) * longer * element_updates as f64;
        let most = simulation.most_of_finer_meshes().filter(|most| is_open && *most > 0);
        let finer = seconds.zip(most).map(|(seconds, most)| Finer {
            following,
            most,
            companions,
            each: seconds / all,
        });
        Self { seconds, longer, element_updates: all, finer }
    }

    /// Element updates that are expected in all.
    pub fn all_element_updates(&self) -> f64 {
        let following = self.finer.and_then(|finer| Some((finer.following?, finer.companions)));
        let finer = following.map_or(0.0, |(following, companions)| {
            (1.0 + companions) * following.element_updates as f64
        });
        self.element_updates + finer
    }
}

impl Finer {
    /// "coarser meshes foretell 1, about 6.0e6 element updates more, 8.1 s; at most 1.7e8 element updates more, 229 s".
    pub fn in_words(&self) -> String {
        let price = |updates: u64| {
            let updates = (1.0 + self.companions) * updates as f64;
            format!("{updates:.1e} element updates more, {}", show(self.each * updates, "s"))
        };
        let expected = match self.following {
            Some(Following { meshes: 0, .. }) => "coarser meshes foretell none; ".to_string(),
            Some(Following { meshes, element_updates, .. }) => {
                format!("coarser meshes foretell {meshes}, about {}; ", price(element_updates))
            }
            None => String::new(),
        };
        format!("{expected}at most {}", price(self.most))
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
    let mut patient = Patient { begin: Instant::now(), seen: (0.0, 0.0), is_over: false };
    let approach = &simulation.setup().approach;
    let _ = simulation.model().collide(approach, &Want::history(), &mut patient);
    let (spent, fraction) = match patient.is_over {
        true => patient.seen,
        false => (patient.begin.elapsed().as_secs_f64(), 1.0),
    };
    let collision = if fraction > 0.0 { spent / fraction } else { spent };
    let fields = FIELDS * making * simulation.want().snapshots.len() as f64;
    let elements = simulation.setup().elements.as_ref();
    let across = elements.map_or(f64::INFINITY, |elements| {
        simulation.setup().estimate.contact_radius / elements.plan.contact_element_size
    });
    collision + fields + condensed_companion_time(across) * (collision + making)
}

/// Stops a run that tells enough, or after a while, and knows how far it was.
struct Patient {
    begin: Instant,
    /// Seconds and share of the run.
    seen: (f64, f64),
    is_over: bool,
}

impl Monitor for Patient {
    fn enter(&mut self, _: Phase) {}

    fn report(&mut self, progress: Progress) -> bool {
        let spent = self.begin.elapsed();
        self.seen = (spent.as_secs_f64(), progress.fraction);
        let is_enough = progress.fraction >= SHARE_OF_CONDENSED;
        self.is_over = is_enough || (spent > PATIENCE_WITH_CONDENSED && progress.fraction > 0.0);
        !self.is_over
    }
}
