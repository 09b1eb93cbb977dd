//! The history of a run, which drops rows as it grows.

use serde::{Deserialize, Serialize};

use crate::run::{Account, EnergyLedger, SamplingInterval};

/// The reason why a row is kept.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum RowKind {
    /// The row was due.
    Regular,
    /// A contact or the run begins or ends there.
    Landmark,
    /// The last contact so far; the row becomes regular after a later contact.
    LastContact,
}

/// Largest number of rows for which memory is reserved at the start.
const MAX_RESERVED: usize = 1 << 16;

/// Rows at a constant stride that adapts to the length of the contact.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct History {
    rows: Vec<HistoryRow>,
    /// Whether each row is a landmark or the last contact, which are never dropped.
    essential: Vec<bool>,
    /// Index of the row of the last contact so far.
    last_contact: Option<usize>,
    interval: SamplingInterval,
    /// For a run that offers a row at every step: the last row, if it was not due, and whether the contact was closed.
    skipped: Option<HistoryRow>,
    was_closed: Option<bool>,
}

impl History {
    /// Creates a history of about `n_rows` rows over `expected_steps` steps; it has at most four times as many.
    pub fn new(n_rows: usize, expected_steps: f64) -> Self {
        let interval = SamplingInterval::nearest(n_rows, expected_steps);
        let capacity = interval.most().saturating_add(1).min(MAX_RESERVED);
        Self {
            rows: Vec::with_capacity(capacity),
            essential: Vec::with_capacity(capacity),
            last_contact: None,
            interval,
            skipped: None,
            was_closed: None,
        }
    }

    /// Returns whether a row is due at this step.
    pub fn is_due(&self, step: u64) -> bool {
        self.interval.is_due(step)
    }

    /// Adds a row. If there are too many, drops every second one and doubles the stride.
    pub fn push(&mut self, row: HistoryRow, kind: RowKind) {
        if kind == RowKind::LastContact {
            // After another contact the earlier row is regular.
            if let Some(earlier) = self.last_contact.replace(self.rows.len()) {
                self.essential[earlier] = false;
            }
        }
        self.rows.push(row);
        self.essential.push(kind != RowKind::Regular);
        if self.interval.count() {
            self.thin();
        }
    }

    /// Takes a row at every step. Keeps those that are due, and the rows before and after each opening and closing of the
    /// contact.
    pub fn follow(&mut self, step: u64, is_closed: bool, row: HistoryRow) {
        let changes = self.was_closed.replace(is_closed) != Some(is_closed);
        if changes {
            if let Some(before) = self.skipped.take() {
                self.push(before, RowKind::Landmark);
            } else if let Some(before) = self.essential.last_mut() {
                *before = true;
            }
            self.push(row, RowKind::Landmark);
        } else if self.is_due(step) {
            self.skipped = None;
            self.push(row, RowKind::Regular);
        } else {
            self.skipped = Some(row);
        }
    }

    fn thin(&mut self) {
        let mut kept = 0;
        for k in 0..self.rows.len() {
            if self.essential[k] || k % 2 == 0 {
                self.rows[kept] = self.rows[k];
                self.essential[kept] = self.essential[k];
                if self.last_contact == Some(k) {
                    self.last_contact = Some(kept);
                }
                kept += 1;
            }
        }
        self.rows.truncate(kept);
        self.essential.truncate(kept);
        self.interval.recount(kept);
    }

    /// Returns the rows so far, in the order of time.
    pub fn rows(&self) -> &[HistoryRow] {
        &self.rows
    }

    /// Returns whether a restart state is consistent.
    pub fn is_consistent(&self) -> bool {
        let n = self.rows.len();
        self.interval.is_consistent()
            && self.interval.n() == n
            && self.essential.len() == n
            && self.last_contact.is_none_or(|row| row < n)
            && self.rows.is_sorted_by(|one, next| one.time < next.time)
    }

    /// Returns the rows in the order of time, with the last row of a run that offered every step.
    pub fn into_rows(mut self) -> Vec<HistoryRow> {
        self.rows.extend(self.skipped.take());
        self.rows
    }
}

/// One instant. All quantities belong to the same time; `None` means that the model does not compute the quantity.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct HistoryRow {
    /// Time since the start of the case, s.
    pub time: f64,
    /// Contact force, ≥ 0, N.
    pub contact_force: f64,
    /// Contact radius, where the pressure falls to zero, m.
    pub contact_radius: Option<f64>,
    /// Approach: decrease of the distance of the mass centres since first touch, m. A half-space counts with its far
    /// boundary.
    pub approach: f64,
    /// Contact pressure on the axis, Pa.
    pub centre_pressure: Option<f64>,
    /// Velocities of the mass centres along +y, m/s.
    pub velocity: [f64; 2],
    /// Energy in each account, J.
    pub energies: EnergyLedger,
    /// Energy residual, J.
    pub residual: Option<f64>,
    /// Kinetic energy of each body relative to its mass centre, or to the far boundary of a half-space, J.
    pub vibration: [f64; 2],
    /// The tangential contact, of an oblique impact.
    pub tangential: Option<TangentialRow>,
}

/// The tangential contact at one instant.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct TangentialRow {
    /// Force against a positive velocity of the contact patch, N.
    pub force: f64,
    /// Velocity of the patch of the first body relative to that of the second, m/s.
    pub patch_velocity: f64,
    /// Radius of the disc that sticks over the contact radius; `None` without a contact.
    pub stick_ratio: Option<f64>,
}

impl HistoryRow {
    /// Returns the energy in an account, J.
    pub fn energy(&self, account: Account) -> Option<f64> {
        self.energies.get(account)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    use crate::run::EnergyLedger;

    fn row(step: u64) -> HistoryRow {
        HistoryRow {
            time: step as f64,
            contact_force: 0.0,
            contact_radius: None,
            approach: 0.0,
            centre_pressure: None,
            velocity: [0.0; 2],
            energies: EnergyLedger::EMPTY,
            residual: None,
            vibration: [0.0; 2],
            tangential: None,
        }
    }

    /// Runs this many steps with first and last contact at these steps; returns the steps of the rows.
    fn run(history: &mut History, n_steps: u64, landmarks: [u64; 2]) -> Vec<u64> {
        for step in 0..=n_steps {
            let kind = match step {
                _ if step == landmarks[0] => RowKind::Landmark,
                // A contact that ends now and then before it ends for good.
                _ if step == landmarks[1] || step % 1000 == 999 => RowKind::LastContact,
                _ => RowKind::Regular,
            };
            if kind != RowKind::Regular || history.is_due(step) {
                history.push(row(step), kind);
            }
        }
        history.rows().iter().map(|row| row.time as u64).collect()
    }

    #[test]
    fn rows_come_at_the_stride_of_the_estimate() {
        let mut history = History::new(100, 1000.0);
        let steps = run(&mut history, 1000, [3, 907]);
        let expected: Vec<u64> =
            (0..=1000).filter(|s| s % 10 == 0 || [3, 907, 999].contains(s)).collect();
        assert_eq!(steps, expected);
        // Fewer steps than rows: every step.
        assert_eq!(run(&mut History::new(1000, 50.0), 50, [0, 50]).len(), 51);
        assert_eq!(run(&mut History::new(0, 0.0), 5, [0, 5]).len(), 6);
    }

    #[test]
    fn long_history_is_thinned_and_keeps_essential_rows() {
        for n_rows in [16, 100] {
            for n_steps in [1_000, 100_000, 345_678] {
                let mut history = History::new(n_rows, n_rows as f64);
                let capacity = history.rows.capacity();
                let essential = [37, n_steps - 5];
                let steps = run(&mut history, n_steps, essential);
                assert!(steps.len() <= 4 * n_rows && steps.len() > n_rows, "{}", steps.len());
                assert!(history.is_consistent());
                assert!(steps.windows(2).all(|pair| pair[0] < pair[1]));
                assert!(essential.iter().all(|step| steps.contains(step)));
                // Even to a factor of 2, away from the essential rows.
                let stride = history.interval.stride();
                assert!(steps.windows(2).all(|pair| pair[1] - pair[0] <= 2 * stride), "{steps:?}");
                assert_eq!(history.rows.capacity(), capacity, "a row was allocated");
            }
        }
    }

    /// Any number of rows is accepted, and all steps are kept.
    #[test]
    fn any_number_of_rows_can_be_asked_for() {
        for n_rows in [1_000_000, usize::MAX / 4, usize::MAX] {
            for expected_steps in [0.0, 1e3, f64::INFINITY, f64::NAN] {
                let mut history = History::new(n_rows, expected_steps);
                assert!(history.rows.capacity() <= MAX_RESERVED);
                let steps = run(&mut history, 20, [3, 17]);
                assert!(history.is_consistent());
                assert!(expected_steps.is_infinite() || steps.len() == 21, "{steps:?}");
            }
        }
    }

    /// A run that offers every step keeps a few thousand rows, both sides of every change of contact,
    /// and its last step.
    #[test]
    fn followed_history_keeps_rows_on_both_sides_of_a_contact_change() {
        let (last, closed) = (100_003, 777..90_001);
        let mut history = History::new(1000, 5000.0);
        for step in 0..=last {
            history.follow(step, closed.contains(&step), row(step));
        }
        let rows = history.into_rows();
        assert!(rows.len() > 2000 && rows.len() <= 4001, "{}", rows.len());
        assert!(rows.windows(2).all(|two| two[0].time < two[1].time));
        for step in [0, 776, 777, 90_000, 90_001, last] {
            assert!(rows.iter().any(|row| row.time == step as f64), "{step}");
        }
    }
}
