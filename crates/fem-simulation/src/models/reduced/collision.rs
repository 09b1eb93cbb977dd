//! The collision of two bodies from their relative motion.

use fem_collision::{
    Account, BodyResult, Collision, Ending, EnergyLedger, Frame, HistoryRow, OutputRequest,
    nan_aware_max_abs,
};
use fem_laws::laws::ContactLaw;
use fem_laws::{Impact, ImpactInstant, ImpactPath, Pair};

/// Rows of the history within the contact per row after it.
const ROWS_PER_ROW_AFTER: usize = 5;

/// Returns the collision of both bodies of a frame.
pub(super) fn of_impact(
    impact: &Impact,
    frame: &Frame,
    pair: &Pair,
    law: Option<&ContactLaw>,
    request: &OutputRequest,
) -> Collision {
    let has_radius = law.is_none_or(ContactLaw::has_contact_radius);
    let dents = law.is_some_and(|law| law.elastic_plastic().is_some());
    let rows = Rows { frame, has_radius, dents };
    let instants = || impact.history.iter();
    let residual = |instant| rows.row(instant).residual.unwrap_or(0.0);
    let is_together = impact.contact_time.is_none();
    let first_touch = frame.approach.first_touch();
    let energy_scale = frame.energy_scale(impact.max_approach);
    let end = impact.history.last().map(|instant| rows.row(instant));
    let ending = if is_together { Ending::Together } else { Ending::Parted };
    let restitution = ending.restitution(impact.restitution, 1.0);
    let after = frame.velocities(-restitution.unwrap_or(0.0) * frame.speed());
    Collision {
        restitution,
        contact_time: impact.contact_time,
        first_contact: Some(first_touch),
        last_contact: impact.contact_time.map(|time| first_touch + time),
        contact_episodes: 1,
        peak_force: Some(impact.peak_force),
        max_approach: Some(impact.max_approach),
        max_contact_radius: has_radius.then_some(impact.max_contact_radius),
        peak_pressure: impact.peak_pressure,
        initial_energy: Some(frame.kinetic(frame.speed())),
        energies: end.map_or(EnergyLedger::EMPTY, |row| row.energies),
        residual: end.and_then(|row| row.residual),
        residual_relative: Some(
            instants().map(residual).fold(0.0, nan_aware_max_abs) / energy_scale,
        ),
        bodies: [0, 1].map(|side: usize| BodyResult {
            mass: frame.masses[side],
            velocity_after: Some(after[side]),
            ..BodyResult::default()
        }),
        history: rows.of(impact, pair, law, request.history_rows),
        warnings: ending.together_warning().into_iter().collect(),
        ..Collision::empty(frame.approach, ending)
    }
}

/// Makes history rows from instants of the motion.
struct Rows<'a> {
    frame: &'a Frame,
    has_radius: bool,
    /// Whether the contact loses its energy by plastic flow.
    dents: bool,
}

impl Rows<'_> {
    /// Returns `n` rows at equal intervals over the contact and a fifth of its duration after it; a contact without an end
    /// has none after.
    fn of(
        &self,
        impact: &Impact,
        pair: &Pair,
        law: Option<&ContactLaw>,
        n: usize,
    ) -> Vec<HistoryRow> {
        let Some(last) = impact.history.last().filter(|_| n > 0) else { return Vec::new() };
        let path = ImpactPath::new(impact, pair, law).with_gravity(self.frame.gravity);
        let after = if impact.contact_time.is_some() { n / ROWS_PER_ROW_AFTER } else { 0 };
        (0..=n + after)
            // The last instant of the contact is exact.
            .map(|k| if k == n { last.time } else { last.time * (k as f64 / n as f64) })
            .filter_map(|time| Some(self.row(&path.at(time)?)))
            .collect()
    }

    fn row(&self, instant: &ImpactInstant) -> HistoryRow {
        let (frame, rate) = (self.frame, instant.approach_rate);
        let accounted = match (instant.strain_energy, instant.dissipated) {
            (Some(strain), Some(dissipated)) => {
                strain + dissipated + instant.radiated.unwrap_or(0.0) + instant.plate.unwrap_or(0.0)
            }
            _ => instant.work,
        };
        let potential = frame.potential(instant.approach);
        let lost = if self.dents { Account::PlasticWork } else { Account::ViscousDissipation };
        let known = [
            (Account::Strain, instant.strain_energy),
            (lost, instant.dissipated),
            (Account::Radiated, instant.radiated),
            (Account::Plate, instant.plate),
            (Account::Potential, potential),
        ];
        let mut energies = EnergyLedger::EMPTY
            .with(Account::Kinetic, frame.kinetic(rate))
            .with(Account::WallWork, frame.wall_work(rate));
        for (account, energy) in known {
            if let Some(energy) = energy {
                energies.add(account, energy);
            }
        }
        HistoryRow {
            time: frame.approach.first_touch() + instant.time,
            contact_force: instant.force,
            contact_radius: self.has_radius.then_some(instant.contact_radius),
            approach: instant.approach,
            centre_pressure: instant.centre_pressure,
            velocity: frame.velocities(rate),
            energies,
            residual: Some(frame.gained(rate) + accounted + potential.unwrap_or(0.0)),
            vibration: [0.0; 2],
            tangential: None,
        }
    }
}
