//! The history and energy ledger of all contacts.
//!
//! The ledger of a contact begins with the motion of the ball. Losses of earlier contacts are added to it, and the energy
//! that they left in the bodies has its own account, so that the ledger has all energy since the first touch.

use fem_collision::{
    Account, BalanceSide, Collision, EnergyLedger, HistoryRow, nan_aware_max, nan_aware_max_abs,
};
use serde::{Deserialize, Serialize};

/// Number of rows per flight.
const FLIGHT_ROWS: usize = 8;

/// Time and speed of a landing.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Landing {
    /// Time after first touch of the contact before, s.
    pub time: f64,
    /// Speed at the landing, m/s.
    pub speed: f64,
}

/// Contacts and flights so far.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub(super) struct Chain {
    /// Times of the first touch of all and of the contact under way, since the start of the case, s.
    first_touch: f64,
    time: f64,
    /// Energy lost or supplied in earlier contacts, in joules.
    lost: EnergyLedger,
    /// Energy that earlier contacts left in the bodies, J, without that of dents onto which the ball falls; `None` in the
    /// first contact.
    left: Option<f64>,
    /// Energy residual of earlier contacts, in joules.
    residual: f64,
    /// Kinetic and potential energy of the ball at the start of the flight before, J.
    handed_on: Option<f64>,
    /// Energy at stake in the first contact, J.
    initial: Option<f64>,
    worst_residual: Option<f64>,
    growth: Option<f64>,
    /// Energies at the end of the contact under way.
    energies: EnergyLedger,
    residual_at_end: Option<f64>,
    rows: Vec<HistoryRow>,
}

impl Chain {
    /// Makes the history of a ball that first touches at a time, s.
    pub fn new(first_touch: f64) -> Self {
        Self {
            first_touch,
            time: first_touch,
            lost: EnergyLedger::EMPTY,
            left: None,
            residual: 0.0,
            handed_on: None,
            initial: None,
            worst_residual: None,
            growth: None,
            energies: EnergyLedger::EMPTY,
            residual_at_end: None,
            rows: Vec::new(),
        }
    }

    /// Returns the time of first touch of the contact under way, or the time at which the ball came to rest, s.
    pub fn time(&self) -> f64 {
        self.time
    }

    /// Returns the time of the first touch of all, s.
    pub fn first_touch(&self) -> f64 {
        self.first_touch
    }

    /// Takes the ledger of the contact under way, for a ball of a weight, N.
    pub fn take(&mut self, collision: &Collision, rows: &[HistoryRow], weight: f64) {
        if let (Some(handed_on), Some(initial)) = (self.handed_on, collision.initial_energy) {
            self.residual += initial - handed_on;
        }
        let given = weight * collision.max_approach.unwrap_or(0.0);
        let at_stake = collision.initial_energy.map(|initial| initial + given);
        let initial = *self.initial.get_or_insert(at_stake.unwrap_or(f64::NAN));
        if let Some((scale, relative)) = at_stake.zip(collision.residual_relative) {
            let here = (self.residual.abs() + relative * scale) / initial;
            self.worst_residual = Some(nan_aware_max_abs(self.worst_residual.unwrap_or(0.0), here));
        }
        self.growth =
            [self.growth, collision.energy_growth].into_iter().flatten().reduce(nan_aware_max);
        // A history is that without adhesion.
        let end = rows.last().filter(|_| !collision.energies.has(Account::Adhesion));
        let end = end.map_or(collision.energies, |row| row.energies);
        self.energies = self.carried(&end);
        self.residual_at_end = collision.residual.map(|residual| residual + self.residual);
    }

    /// Returns whether the motion of a row is finite.
    pub fn is_finite(row: &HistoryRow) -> bool {
        row.velocity.iter().chain([&row.approach, &row.time]).all(|number| number.is_finite())
    }

    /// Returns the landing of a ball that flies as in this row; `None` if it does not rise to the height of first touch.
    pub fn landing(&self, end: &HistoryRow, gravity: f64) -> Option<Landing> {
        let velocity = end.velocity[1] - end.velocity[0];
        let squared = velocity * velocity - 2.0 * gravity * end.approach;
        let speed = squared.sqrt();
        let time = end.time + (velocity + speed) / gravity;
        (squared > 0.0 && speed > 0.0 && time.is_finite()).then_some(Landing { time, speed })
    }

    /// Keeps the rows of the contact under way up to a time after its first touch, s.
    pub fn keep(&mut self, rows: &[HistoryRow], until: f64) {
        let kept: Vec<HistoryRow> = rows
            .iter()
            .filter(|row| row.time < until)
            .map(|row| HistoryRow {
                time: self.time + row.time,
                energies: self.carried(&row.energies),
                residual: row.residual.map(|residual| residual + self.residual),
                ..*row
            })
            .collect();
        self.rows.extend(kept);
    }

    /// Adds the flight from the last row of a contact to the next landing, with rows if requested. The next contact begins
    /// with the energy of the dents (J) as its strain energy if the ball falls onto them.
    pub fn fly(&mut self, end: &HistoryRow, landing: &Landing, of_dents: f64, has_rows: bool) {
        let is_inner = |account: Account| {
            account.side() == BalanceSide::Held
                && !matches!(account, Account::Kinetic | Account::Potential)
        };
        let inner = end.energies.entries().filter(|(account, _)| is_inner(*account));
        let vibration: f64 = end.vibration.iter().sum();
        let left = vibration + inner.map(|(_, energy)| energy).sum::<f64>() - of_dents;
        let kinetic = end.energy(Account::Kinetic).unwrap_or_default() - vibration;
        let handed_on = kinetic + end.energy(Account::Potential).unwrap_or_default();
        self.lost = self.lost_after(&end.energies);
        self.left = Some(self.left.unwrap_or_default() + left);
        self.residual += end.residual.unwrap_or_default();
        self.handed_on = Some(handed_on);
        if has_rows {
            let step = (landing.time - end.time) / (FLIGHT_ROWS + 1) as f64;
            let times = (1..=FLIGHT_ROWS).map(|k| k as f64 * step).filter(|_| step > 0.0);
            let rows: Vec<HistoryRow> =
                times.map(|time| self.flying(end, landing, of_dents, time)).collect();
            self.rows.extend(rows);
        }
        self.time += landing.time;
    }

    /// Ends the history with a ball that stays.
    pub fn stay(&mut self, end: Option<&HistoryRow>) {
        self.time += end.map_or(0.0, |row| row.time);
    }

    /// Returns the row of a flight at a time (s) after the last row of a contact.
    fn flying(&self, end: &HistoryRow, landing: &Landing, of_dents: f64, time: f64) -> HistoryRow {
        let upward = end.velocity[1] - end.velocity[0];
        // g (t_landing − t_end) = u + v.
        let gravity = (upward + landing.speed) / (landing.time - end.time);
        let velocity = upward - gravity * time;
        let handed_on = self.handed_on.unwrap_or_default();
        let share = (velocity / landing.speed).powi(2);
        let mut energies = self.carried(&EnergyLedger::EMPTY);
        for (account, energy) in self.lost.entries() {
            energies.add(account, energy);
        }
        for (account, _) in end.energies.entries() {
            match account {
                Account::Kinetic => energies.add(account, handed_on * share),
                Account::Potential => energies.add(account, handed_on * (1.0 - share)),
                Account::Strain => energies.add(account, of_dents),
                _ if account.side() == BalanceSide::Held => energies.add(account, 0.0),
                _ => {}
            }
        }
        HistoryRow {
            time: self.time + end.time + time,
            contact_force: 0.0,
            contact_radius: end.contact_radius.map(|_| 0.0),
            approach: end.approach - (upward - 0.5 * gravity * time) * time,
            centre_pressure: end.centre_pressure.map(|_| 0.0),
            velocity: [end.velocity[0], end.velocity[0] + velocity],
            energies,
            residual: end.residual.map(|_| self.residual),
            vibration: [0.0; 2],
            tangential: None,
        }
    }

    /// Returns the accounts of a contact with those of earlier contacts added.
    fn carried(&self, own: &EnergyLedger) -> EnergyLedger {
        let mut ledger = EnergyLedger::EMPTY;
        for (account, energy) in own.entries() {
            ledger.add(account, energy + self.lost.get(account).unwrap_or_default());
        }
        match self.left {
            Some(left) => ledger.with(Account::LeftBefore, left),
            None => ledger,
        }
    }

    /// Returns the energy lost or supplied up to the end of a contact, in joules.
    fn lost_after(&self, end: &EnergyLedger) -> EnergyLedger {
        let own = end.entries().filter(|(account, _)| account.side() != BalanceSide::Held);
        own.fold(self.lost, |ledger, (account, energy)| ledger.with(account, energy))
    }

    /// Returns the energy of each account at the end, in joules.
    pub fn energies(&self) -> EnergyLedger {
        self.energies
    }

    /// Returns the energy residual at the end, in joules.
    pub fn residual(&self) -> Option<f64> {
        self.residual_at_end
    }

    /// Returns the largest energy residual over the energy at first touch of all.
    pub fn worst_residual(&self) -> Option<f64> {
        self.worst_residual
    }

    /// Returns the largest growth of energy in a contact.
    pub fn growth(&self) -> Option<f64> {
        self.growth
    }

    /// Returns all rows in the order of time.
    pub fn into_rows(self) -> Vec<HistoryRow> {
        self.rows
    }
}
