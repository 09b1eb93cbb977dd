//! How long a run will take here: some of its steps are timed.

use std::time::{Duration, Instant};

use fem::{Cost, Simulation};

/// What the timing of steps may take, beside those of one report.
const PATIENCE: Duration = Duration::from_millis(1);

/// Seconds of a run of explicit elements; nothing of a model that computes all in one go.
pub fn seconds(simulation: &Simulation) -> Option<f64> {
    let Cost::Steps { steps, .. } = simulation.setup().cost else { return None };
    let mut course = simulation.start();
    // Of a ball that bounces the cost is that of one contact.
    if simulation.case().scene().gravity().is_some() {
        return None;
    }
    let begin = Instant::now();
    while begin.elapsed() < PATIENCE && course.advance(&mut ()) {}
    let (spent, done) = (begin.elapsed().as_secs_f64(), course.progress().step);
    (done > 0).then(|| spent / done as f64 * steps as f64)
}
