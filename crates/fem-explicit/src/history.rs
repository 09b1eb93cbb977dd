//! The history of a collision.

/// One instant; all quantities belong to the same time.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct HistoryRow {
    /// Time since the start of the case, s.
    pub time: f64,
    /// Contact force, ≥ 0, N.
    pub contact_force: f64,
    /// Radius where the contact pressure falls to zero, m.
    pub contact_radius: f64,
    /// Decrease of the distance of the mass centres since first touch, m.
    pub approach: f64,
    /// Contact pressure on the axis, Pa.
    pub centre_pressure: f64,
    /// Velocities of the mass centres along +y, m/s.
    pub velocity: [f64; 2],
    /// Kinetic energy, walls not counted, J.
    pub kinetic: f64,
    /// Strain energy, J.
    pub strain: f64,
    /// Energy in the penalty springs, J.
    pub contact: f64,
    /// Energy dissipated by relaxation since the start, J.
    pub viscous_dissipation: f64,
    /// Work that a moving wall has done, J.
    pub wall_work: f64,
    /// What the ledger does not account for, J.
    pub residual: f64,
    /// Kinetic energy of each body relative to its mass centre, J.
    pub vibration: [f64; 2],
}

/// Why a row is kept.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum RowKind {
    /// It was due.
    Regular,
    /// The first contact, or the end of the run.
    Landmark,
    /// The last contact so far.
    LastContact,
}

/// Rows at an even stride that adapts to the length of the contact.
#[derive(Debug, Clone)]
pub(crate) struct History {
    rows: Vec<HistoryRow>,
    /// Rows of the first contact and of the last so far, which thinning leaves.
    essential: Vec<bool>,
    /// Where the row of the last contact so far is.
    last_contact: Option<usize>,
    stride: u64,
    max_rows: usize,
}

impl History {
    /// For about `n_rows` rows over `expected_steps` steps.
    pub fn new(n_rows: usize, expected_steps: f64) -> Self {
        let stride = (expected_steps / n_rows.max(1) as f64).floor().max(1.0) as u64;
        let max_rows = 4 * n_rows.max(16);
        Self {
            rows: Vec::with_capacity(max_rows + 1),
            essential: Vec::with_capacity(max_rows + 1),
            last_contact: None,
            stride,
            max_rows,
        }
    }

    /// Whether a row is due at this step.
    pub fn is_due(&self, step: u64) -> bool {
        step.is_multiple_of(self.stride)
    }

    /// Adds a row; beyond the capacity every second one is dropped and the
    /// stride doubled.
    pub fn push(&mut self, row: HistoryRow, kind: RowKind) {
        if kind == RowKind::LastContact {
            // Another contact has come since: the earlier row is one like others.
            if let Some(earlier) = self.last_contact.replace(self.rows.len()) {
                self.essential[earlier] = false;
            }
        }
        self.rows.push(row);
        self.essential.push(kind != RowKind::Regular);
        if self.rows.len() > self.max_rows {
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
            self.stride *= 2;
        }
    }

    pub fn rows(&self) -> &[HistoryRow] {
        &self.rows
    }

    pub fn into_rows(self) -> Vec<HistoryRow> {
        self.rows
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn row(step: u64) -> HistoryRow {
        HistoryRow {
            time: step as f64,
            contact_force: 0.0,
            contact_radius: 0.0,
            approach: 0.0,
            centre_pressure: 0.0,
            velocity: [0.0; 2],
            kinetic: 0.0,
            strain: 0.0,
            contact: 0.0,
            viscous_dissipation: 0.0,
            wall_work: 0.0,
            residual: 0.0,
            vibration: [0.0; 2],
        }
    }

    /// Runs so many steps with first and last contact at these; the steps of the rows.
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
    fn a_long_run_is_thinned_and_keeps_what_is_essential() {
        for n_rows in [16, 100] {
            for n_steps in [1_000, 100_000, 345_678] {
                let mut history = History::new(n_rows, n_rows as f64);
                let capacity = history.rows.capacity();
                let essential = [37, n_steps - 5];
                let steps = run(&mut history, n_steps, essential);
                assert!(steps.len() <= 4 * n_rows && steps.len() > n_rows, "{}", steps.len());
                assert!(steps.windows(2).all(|pair| pair[0] < pair[1]));
                assert!(essential.iter().all(|step| steps.contains(step)));
                // Even to a factor of 2, away from the essential rows.
                let stride = history.stride;
                assert!(steps.windows(2).all(|pair| pair[1] - pair[0] <= 2 * stride), "{steps:?}");
                assert_eq!(history.rows.capacity(), capacity, "a row was allocated");
            }
        }
    }
}
