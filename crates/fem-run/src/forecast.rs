//! How long a run will take here: some of its steps are timed.

use std::time::{Duration, Instant};

use fem::{Cost, Simulation};
use fem_collision::{Monitor, Phase, Progress};

/// What the timing of steps may take, beside those of one report.
const PATIENCE: Duration = Duration::from_millis(1);
/// The same of condensed bodies, which begin with their slowest steps.
const PATIENCE_WITH_CONDENSED: Duration = Duration::from_millis(20);
/// Over a collision of condensed bodies what tells its error takes: a collision of a mesh of 1.5 times the elements
/// across where these are few, factors too, ...
const FINER_COMPANION: f64 = 3.0;
/// ... and else two of coarser ones.
const COARSER_COMPANIONS: f64 = 0.7;
/// Fewer elements across the contact have a finer companion.
const FEW: f64 = 9.0;

/// Seconds of a run here, with what tells its error where that takes runs; nothing of a model without elements, nor of
/// a ball that bounces, whose cost is that of one contact.
pub fn seconds(simulation: &Simulation, making: f64) -> Option<f64> {
    if simulation.case().scene().gravity().is_some() {
        return None;
    }
    match simulation.setup().cost {
        Cost::Steps { steps, seconds, .. } => {
            let companions = simulation.companion_updates().unwrap_or(0.0);
            let timed = (1.0 + companions) * seconds_a_step(simulation)? * steps as f64;
            // The first steps have little contact, and are in the processor's cache.
            Some(timed.max(seconds))
        }
        Cost::Factors { .. } => Some(of_condensed(simulation, making)),
        Cost::Little { .. } => None,
    }
}

fn seconds_a_step(simulation: &Simulation) -> Option<f64> {
    let mut course = simulation.start();
    let begin = Instant::now();
    while begin.elapsed() < PATIENCE && course.advance(&mut ()) {}
    let (spent, done) = (begin.elapsed().as_secs_f64(), course.progress().step);
    (done > 0).then(|| spent / done as f64)
}

/// Of condensed bodies that took so long to make, s.
fn of_condensed(simulation: &Simulation, making: f64) -> f64 {
    let mut patient = Patient { begin: Instant::now(), seen: (0.0, 0.0), is_over: false };
    let _ = simulation.run(&mut patient);
    let (spent, fraction) = match patient.is_over {
        true => patient.seen,
        false => (patient.begin.elapsed().as_secs_f64(), 1.0),
    };
    let collision = if fraction > 0.0 { spent / fraction } else { spent };
    let elements = simulation.setup().elements.as_ref();
    let across = elements.map_or(f64::INFINITY, |elements| {
        simulation.setup().estimate.contact_radius / elements.plan.contact_element_size
    });
    let companions = if across < FEW { FINER_COMPANION } else { COARSER_COMPANIONS };
    collision + companions * (collision + making)
}

/// Stops a run after a while, and knows how far it was.
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
        self.is_over = spent > PATIENCE_WITH_CONDENSED && progress.fraction > 0.0;
        !self.is_over
    }
}
