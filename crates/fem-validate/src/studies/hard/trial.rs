//! What came of a hard scene with a model, and the invariants of a collision.

use fem::Simulation;
use fem_case::{Case, CaseError};
use fem_collision::{Collision, Row, Side};
use fem_laws::HertzImpact;

use crate::error::StudyError;
use crate::laboratory::Laboratory;

/// A run, or why there is none.
pub(super) struct Trial {
    pub outcome: Outcome,
}

/// How a run ended.
pub(super) enum Outcome {
    /// By itself.
    Ran { collision: Box<Collision>, warnings: Vec<String>, hertz: HertzImpact },
    /// Before it began, or on the way.
    Refused(String),
}

/// Restitution; contact time and peak force over Hertz'.
pub(super) type Numbers = [Option<f64>; 3];

impl Trial {
    /// Runs a case, if it is one.
    ///
    /// # Errors
    /// An interrupt.
    pub fn of(laboratory: &Laboratory, case: Result<Case, CaseError>) -> Result<Self, StudyError> {
        let outcome = laboratory.work(|| {
            let outcome =
                case.and_then(run).unwrap_or_else(|error| Outcome::Refused(error.to_string()));
            let updates = match &outcome {
                Outcome::Ran { collision, .. } => collision.element_updates.unwrap_or(0),
                Outcome::Refused(_) => 0,
            };
            Ok((outcome, updates))
        })?;
        Ok(Self { outcome })
    }

    fn collision(&self) -> Option<&Collision> {
        match &self.outcome {
            Outcome::Ran { collision, .. } => Some(collision),
            Outcome::Refused(_) => None,
        }
    }

    /// Numbers without unit.
    pub fn numbers(&self) -> Option<Numbers> {
        let Outcome::Ran { collision, hertz, .. } = &self.outcome else { return None };
        Some([
            collision.restitution,
            collision.contact_time.map(|time| time / hertz.contact_time()),
            collision.peak_force.map(|force| force / hertz.peak_force()),
        ])
    }

    pub fn restitution(&self) -> Option<f64> {
        self.collision()?.restitution
    }

    /// By how much the energy that the bodies hold is above what they had and were given, at any row,
    /// over what they had.
    pub fn growth(&self) -> Option<f64> {
        let collision = self.collision()?;
        let initial = collision.initial_energy?;
        let held = |row: &Row| {
            let held = row.energies.total(Side::Held)?;
            Some((held - row.energies.total(Side::Given).unwrap_or(0.0)) / initial - 1.0)
        };
        collision.history.iter().filter_map(held).reduce(largest)
    }

    /// Worst drift of momentum over Σ m|v|.
    pub fn momentum(&self) -> Option<f64> {
        self.collision()?.momentum_residual_relative
    }

    /// Of the restitution above 1.
    pub fn excess(&self) -> Option<f64> {
        Some(self.restitution()? - 1.0)
    }

    /// How many numbers are none.
    pub fn no_number(&self) -> Option<f64> {
        let collision = self.collision()?;
        let results = [
            collision.restitution,
            collision.contact_time,
            collision.peak_force,
            collision.max_approach,
            collision.max_contact_radius,
            collision.peak_pressure,
            collision.residual_relative,
        ];
        let of_row = |row: &Row| {
            let [lower, upper] = row.velocity;
            [row.time, row.contact_force, row.approach, lower, upper]
        };
        let all = results.into_iter().flatten().chain(collision.history.iter().flat_map(of_row));
        Some(all.filter(|value| !value.is_finite()).count() as f64)
    }

    /// How what the user is told begins.
    pub fn words(&self) -> String {
        match &self.outcome {
            Outcome::Ran { warnings, .. } if warnings.is_empty() => "no warnings".to_string(),
            Outcome::Ran { warnings, .. } => {
                let warnings: Vec<String> = warnings.iter().map(|one| beginning(one)).collect();
                format!("warns: {}", warnings.join("; "))
            }
            Outcome::Refused(message) => {
                format!("refused: {}", beginning(message.lines().next().unwrap_or_default()))
            }
        }
    }
}

/// Words up to so many letters.
const LONGEST: usize = 100;

/// The first words of a text.
fn beginning(text: &str) -> String {
    let words = text.split_whitespace();
    let mut short = words.fold(String::new(), |mut short, word| {
        if short.len() < LONGEST {
            short += if short.is_empty() { "" } else { " " };
            short += word;
        }
        short
    });
    if short.len() < text.len() {
        short += " …";
    }
    short
}

/// The larger one, signs counted; NaN stays.
fn largest(so_far: f64, value: f64) -> f64 {
    if value > so_far || value.is_nan() { value } else { so_far }
}

/// Nothing is drawn: instants that did not occur are no warning here.
fn run(case: Case) -> Result<Outcome, CaseError> {
    let mut simulation = Simulation::new(case)?;
    simulation.skip_snapshots();
    let collision = simulation.run(&mut ());
    if let Some(stop) = collision.stop() {
        return Ok(Outcome::Refused(stop.to_string()));
    }
    let warnings = simulation.warnings(&collision);
    let hertz = simulation.setup().estimate.hertz;
    Ok(Outcome::Ran { collision: Box::new(collision), warnings, hertz })
}
