//! From a condensed collision to what is asked of every model.

use fem_condensed::{Collision, Row};
use fem_field::Snapshot;

use super::Condensed;
use crate::outcome::{BodyOutcome, Outcome, OutcomeRow, Timing};
use crate::reduced::relative::Relative;

/// Contact problems that are no discs, as a share of the steps, that are worth a word.
const MANY_FALLBACKS: f64 = 0.01;

impl Condensed {
    pub(super) fn outcome(
        &self,
        collision: &Collision,
        timing: Timing,
        snapshots: Vec<Snapshot>,
        missing: Vec<String>,
    ) -> Outcome {
        let relative = Relative::of(&self.case.scene, self.pair.reduced_mass());
        let after = relative.velocities(-collision.restitution * relative.speed());
        let meshes = self.meshes();
        let drift = |row: &Row| relative.momentum_drift(row.approach_rate);
        let mut warnings = missing;
        let share = collision.n_fallbacks as f64 / collision.steps as f64;
        if share > MANY_FALLBACKS && !self.options().penalty_springs {
            warnings.push(format!(
                "in {:.0} % of the steps the contact was no disc; it was solved all the same",
                100.0 * share
            ));
        }
        Outcome {
            restitution: Some(collision.restitution),
            contact_time: Some(collision.contact_time),
            contact_episodes: collision.contact_episodes as u64,
            peak_force: Some(collision.peak_force),
            max_approach: Some(collision.max_approach),
            max_contact_radius: Some(collision.max_contact_radius),
            peak_pressure: Some(collision.peak_pressure),
            initial_energy: Some(relative.kinetic(relative.speed())),
            residual_relative: Some(collision.residual_relative),
            momentum_residual_relative: Some(
                collision.history.iter().map(drift).fold(0.0, f64::max),
            ),
            bodies: [0, 1].map(|side| BodyOutcome {
                elements: Some(meshes[side].map_or(0, |mesh| mesh.quads().len())),
                nodes: Some(meshes[side].map_or(0, |mesh| mesh.nodes().len())),
                mass: relative.masses()[side],
                added_mass: meshes[side].map(|_| 0.0),
                velocity_after: Some(after[side]),
                vibration_energy: meshes[side].map(|_| collision.vibration_energy[side]),
            }),
            time_step: Some(collision.time_step),
            steps: Some(collision.steps as u64),
            element_updates: None,
            history: self.rows(&relative, collision),
            halt: None,
            warnings,
            collision: None,
            snapshots,
            timing: Some(timing),
        }
    }

    /// Every step, and the end of the contact between two of them.
    fn rows(&self, relative: &Relative, collision: &Collision) -> Vec<OutcomeRow> {
        let end = collision.contact_time;
        let mut rows = Vec::with_capacity(collision.history.len() + 1);
        for two in collision.history.windows(2) {
            rows.push(self.row(relative, &two[0]));
            if two[0].time < end && end < two[1].time {
                rows.push(self.row(relative, &between(&two[0], &two[1], end)));
            }
        }
        rows.extend(collision.history.last().map(|row| self.row(relative, row)));
        rows
    }

    fn row(&self, relative: &Relative, row: &Row) -> OutcomeRow {
        let rate = row.approach_rate;
        let [lower, upper] = row.vibration;
        OutcomeRow {
            time: self.frame().first_touch() + row.time,
            contact_force: row.contact_force,
            contact_radius: Some(row.contact_radius),
            approach: row.approach,
            centre_pressure: Some(row.centre_pressure),
            velocity: relative.velocities(rate),
            kinetic: relative.kinetic(rate) + lower + upper,
            strain: Some(row.strain),
            contact: Some(row.contact),
            viscous_dissipation: Some(row.viscous_dissipation),
            wall_work: relative.wall_work(rate),
            residual: Some(row.residual),
        }
    }
}

/// The end of the contact, where the force is zero; the rest linearly.
fn between(before: &Row, after: &Row, time: f64) -> Row {
    let part = (time - before.time) / (after.time - before.time);
    let mean = |get: fn(&Row) -> f64| (1.0 - part) * get(before) + part * get(after);
    Row {
        time,
        contact_force: 0.0,
        contact_radius: 0.0,
        centre_pressure: 0.0,
        approach: mean(|row| row.approach),
        approach_rate: mean(|row| row.approach_rate),
        kinetic: mean(|row| row.kinetic),
        strain: mean(|row| row.strain),
        contact: mean(|row| row.contact),
        viscous_dissipation: mean(|row| row.viscous_dissipation),
        residual: mean(|row| row.residual),
        vibration: [0, 1]
            .map(|side| (1.0 - part) * before.vibration[side] + part * after.vibration[side]),
    }
}
