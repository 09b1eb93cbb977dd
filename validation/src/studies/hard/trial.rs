//! Outcome of a hard scene with a model, and the invariants of a collision.

use std::path::{MAIN_SEPARATOR, Path};

use fem::{Cost, Simulation};
use fem_case::{Case, CaseError};
use fem_collision::{BalanceSide, Collision, HistoryRow, QuantityOfInterest};
use fem_laws::HertzImpact;

use crate::{Laboratory, StudyError};

pub(super) struct Trial {
    pub outcome: Outcome,
    estimated: Option<u64>,
}

pub(super) enum Outcome {
    /// The run ended by itself.
    Ran { collision: Box<Collision>, warnings: Vec<String>, hertz: HertzImpact },
    /// The run was rejected or stopped, with the message.
    Rejected(String),
}

/// Restitution (the product of all for a bouncing ball); contact time, peak force and peak pressure over Hertz' values.
pub(super) type Numbers = [Option<f64>; 4];

impl Trial {
    pub fn of(laboratory: &Laboratory, case: Result<Case, CaseError>) -> Result<Self, StudyError> {
        let outcome = laboratory.work(|| {
            let refused = |error: CaseError| (Outcome::Rejected(error.to_string()), None);
            let (outcome, estimated) = case.and_then(run).unwrap_or_else(refused);
            let trial = Self { outcome, estimated };
            let updates = trial.collision().and_then(|collision| collision.element_updates);
            Ok((trial, updates.unwrap_or(0)))
        })?;
        Ok(outcome)
    }

    /// Returns the element updates over the estimated ones, for a run that ended by itself.
    pub fn cost(&self) -> Option<f64> {
        let collision = self.collision().filter(|collision| collision.bounces.is_empty())?;
        Some(collision.element_updates? as f64 / self.estimated? as f64)
    }

    fn collision(&self) -> Option<&Collision> {
        match &self.outcome {
            Outcome::Ran { collision, .. } => Some(collision),
            Outcome::Rejected(_) => None,
        }
    }

    pub fn numbers(&self) -> Option<Numbers> {
        let Outcome::Ran { collision, hertz, .. } = &self.outcome else { return None };
        Some([
            self.restitution(),
            collision.contact_time.map(|time| time / hertz.contact_time()),
            collision.peak_force.map(|force| force / hertz.peak_force()),
            collision.peak_pressure.map(|pressure| pressure / hertz.peak_pressure()),
        ])
    }

    pub fn restitution(&self) -> Option<f64> {
        let collision = self.collision()?;
        let bounces =
            collision.bounces.iter().map(|bounce| bounce.restitution).reduce(|a, b| a * b);
        bounces.or(collision.restitution)
    }

    /// Returns the largest growth of the bodies' energy over the initial energy and the work done on them, relative to the
    /// initial energy, over all steps; for models of one degree of freedom over all rows.
    pub fn growth(&self) -> Option<f64> {
        let collision = self.collision()?;
        if let Some(growth) = collision.energy_growth {
            return Some(growth);
        }
        let initial = collision.initial_energy?;
        let held = |row: &HistoryRow| {
            let held = row.energies.total(BalanceSide::Held)?;
            Some((held - row.energies.total(BalanceSide::Given).unwrap_or(0.0)) / initial - 1.0)
        };
        collision.history.iter().filter_map(held).reduce(largest)
    }

    /// Returns the largest drift of momentum over Σ m|v|.
    pub fn momentum(&self) -> Option<f64> {
        self.collision()?.momentum_residual_relative
    }

    /// Returns the excess of the restitution over 1, the worst of all contacts of a bouncing ball.
    pub fn excess(&self) -> Option<f64> {
        let collision = self.collision()?;
        let bounces = collision.bounces.iter().map(|bounce| bounce.restitution).reduce(f64::max);
        Some(bounces.or(collision.restitution)? - 1.0)
    }

    /// Returns the count of results that are not finite.
    pub fn no_number(&self) -> Option<f64> {
        let collision = self.collision()?;
        let results = QuantityOfInterest::ALL.map(|quantity| quantity.of(collision));
        let results = results.into_iter().chain([collision.residual_relative]);
        let of_row = |row: &HistoryRow| {
            let [lower, upper] = row.velocity;
            [row.time, row.contact_force, row.approach, lower, upper]
        };
        let all = results.flatten().chain(collision.history.iter().flat_map(of_row));
        Some(all.filter(|value| !value.is_finite()).count() as f64)
    }

    /// Returns the beginning of the messages to the user, without the folder of mesh files.
    pub fn words(&self, folder: &Path) -> String {
        let folder = format!("{}{MAIN_SEPARATOR}", folder.display());
        let beginning = |text: &str| beginning(&text.replace(&folder, ""));
        match &self.outcome {
            Outcome::Ran { warnings, .. } if warnings.is_empty() => "no warnings".to_string(),
            Outcome::Ran { warnings, .. } => {
                let warnings: Vec<String> = warnings.iter().map(|one| beginning(one)).collect();
                format!("warns: {}", warnings.join("; "))
            }
            Outcome::Rejected(message) => {
                format!("refused: {}", beginning(message.lines().next().unwrap_or_default()))
            }
        }
    }
}

/// Largest number of characters of a shortened text.
const LONGEST: usize = 100;

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

fn largest(so_far: f64, value: f64) -> f64 {
    if value > so_far || value.is_nan() { value } else { so_far }
}

fn run(case: Case) -> Result<(Outcome, Option<u64>), CaseError> {
    let simulation = Simulation::new(case)?.without_snapshots();
    let estimated = match simulation.setup().cost {
        Cost::Steps { element_updates, .. } => Some(element_updates),
        _ => None,
    };
    let collision = simulation.run(&mut ());
    if let Some(stop) = collision.stop() {
        return Ok((Outcome::Rejected(stop.to_string()), estimated));
    }
    let warnings = simulation.warnings(&collision);
    let hertz = simulation.setup().estimate.hertz;
    Ok((Outcome::Ran { collision: Box::new(collision), warnings, hertz }, estimated))
}
