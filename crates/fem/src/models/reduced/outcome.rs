//! From a relative motion to what is asked of every model.

use fem_laws::{Impact, ImpactInstant, ImpactPath};

use super::Reduced;
use super::relative::Relative;
use crate::outcome::{BodyOutcome, Outcome, OutcomeRow, STAY_TOGETHER};

/// Rows of the history over the contact.
const N_ROWS: u32 = 1000;
/// The history goes on for this many rows after the contact, a fifth of the contact time.
const N_ROWS_AFTER: u32 = 200;
/// Hertz' exponent: what has it has Hertz' contact radius.
const HERTZ_EXPONENT: f64 = 1.5;

impl Reduced {
    pub(super) fn outcome(&self, impact: &Impact) -> Outcome {
        let relative = Relative::of(&self.case.scene, self.pair.effective_mass());
        let has_radius = self.law().is_none_or(|law| law.elastic_exponent() == HERTZ_EXPONENT);
        let masses = relative.masses();
        let after = relative.velocities(-impact.restitution * relative.speed());
        let instants = || impact.history.iter();
        let residual = |instant| self.row(&relative, instant).residual.map_or(0.0, f64::abs);
        let drift = |instant: &ImpactInstant| relative.momentum_drift(instant.approach_rate);
        let mut warnings = Vec::new();
        if impact.contact_time.is_none() {
            warnings.push(STAY_TOGETHER.to_string());
        }
        Outcome {
            restitution: Some(impact.restitution),
            contact_time: impact.contact_time,
            contact_episodes: 1,
            peak_force: Some(impact.peak_force),
            max_approach: Some(impact.max_approach),
            max_contact_radius: has_radius.then_some(impact.max_contact_radius),
            peak_pressure: impact.peak_pressure,
            initial_energy: Some(relative.kinetic(relative.speed())),
            residual_relative: Some(instants().map(residual).fold(0.0, worse) / relative.initial()),
            momentum_residual_relative: Some(instants().map(drift).fold(0.0, worse)),
            bodies: [0, 1].map(|side| BodyOutcome {
                mass: masses[side],
                velocity_after: Some(after[side]),
                ..BodyOutcome::default()
            }),
            time_step: None,
            steps: None,
            element_updates: None,
            history: self.rows(&relative, impact),
            halt: None,
            warnings,
            collision: None,
            snapshots: Vec::new(),
            timing: None,
        }
    }

    /// Rows at equal times over the contact and a fifth of it after; a contact without an end has
    /// none after.
    fn rows(&self, relative: &Relative, impact: &Impact) -> Vec<OutcomeRow> {
        let Some(last) = impact.history.last() else { return Vec::new() };
        let path = ImpactPath::new(impact, &self.pair, self.law());
        let after = if impact.contact_time.is_some() { N_ROWS_AFTER } else { 0 };
        (0..=N_ROWS + after)
            // The last contact instant comes exactly.
            .map(|k| match k {
                N_ROWS => last.time,
                _ => last.time * (f64::from(k) / f64::from(N_ROWS)),
            })
            .filter_map(|time| Some(self.row(relative, &path.at(time)?)))
            .collect()
    }

    fn row(&self, relative: &Relative, instant: &ImpactInstant) -> OutcomeRow {
        let rate = instant.approach_rate;
        let has_radius = self.law().is_none_or(|law| law.elastic_exponent() == HERTZ_EXPONENT);
        let gap = self.case.scene.gap.unwrap_or_default();
        let accounted = match (instant.strain_energy, instant.dissipated) {
            (Some(strain), Some(dissipated)) => strain + dissipated,
            _ => instant.work,
        };
        OutcomeRow {
            time: gap / relative.speed() + instant.time,
            contact_force: instant.force,
            contact_radius: has_radius.then_some(instant.contact_radius),
            approach: instant.approach,
            centre_pressure: instant.centre_pressure,
            velocity: relative.velocities(rate),
            kinetic: relative.kinetic(rate),
            strain: instant.strain_energy,
            contact: None,
            viscous_dissipation: instant.dissipated,
            wall_work: relative.wall_work(rate),
            residual: Some(relative.gained(rate) + accounted),
        }
    }
}

/// The larger of two; NaN wins, so that it cannot pass unseen.
fn worse(so_far: f64, value: f64) -> f64 {
    if so_far.is_nan() || value <= so_far { so_far } else { value }
}
