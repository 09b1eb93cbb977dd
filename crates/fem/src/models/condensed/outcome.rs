//! From a condensed collision to what is asked of every model.

use fem_condensed::{Collision, CondensedError, Ending, Row};
use fem_collision::Snapshot;

use super::Condensed;
use crate::outcome::{BodyOutcome, Halt, Outcome, OutcomeRow, STAY_TOGETHER, Timing};
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
        let (halt, is_parted) = match &collision.ending {
            Ending::Parted => (None, true),
            Ending::Together => {
                warnings.push(STAY_TOGETHER.to_string());
                (None, false)
            }
            Ending::Stopped(error) => (Some(Halt::Condensed(error.clone())), false),
        };
        Outcome {
            restitution: halt.is_none().then_some(collision.restitution),
            contact_time: is_parted.then_some(collision.contact_time),
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
                velocity_after: halt.is_none().then_some(after[side]),
                vibration_energy: meshes[side]
                    .filter(|_| is_parted)
                    .map(|_| collision.vibration_energy[side]),
                ..self.body_before(side)
            }),
            time_step: Some(collision.time_step),
            steps: Some(collision.steps as u64),
            element_updates: None,
            history: self.rows(&relative, collision),
            halt,
            warnings,
            collision: None,
            snapshots,
            timing: Some(timing),
        }
    }

    /// Of a collision that could not begin.
    pub(super) fn stopped(&self, error: CondensedError) -> Outcome {
        let relative = Relative::of(&self.case.scene, self.pair.reduced_mass());
        Outcome {
            initial_energy: Some(relative.kinetic(relative.speed())),
            bodies: [0, 1].map(|side| self.body_before(side)),
            ..Outcome::halted(error.into())
        }
    }

    /// What is known of a body before the collision.
    fn body_before(&self, side: usize) -> BodyOutcome {
        let mesh = self.meshes()[side];
        BodyOutcome {
            elements: Some(mesh.map_or(0, |mesh| mesh.quads().len())),
            nodes: Some(mesh.map_or(0, |mesh| mesh.nodes().len())),
            mass: Relative::of(&self.case.scene, self.pair.reduced_mass()).masses()[side],
            added_mass: mesh.map(|_| 0.0),
            ..BodyOutcome::default()
        }
    }

    /// The rows that were kept, and the end of the contact between two of them.
    fn rows(&self, relative: &Relative, collision: &Collision) -> Vec<OutcomeRow> {
        let end = match collision.ending {
            Ending::Parted => collision.contact_time,
            _ => f64::INFINITY,
        };
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
