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
    /// What the ledger does not account for, J.
    pub residual: f64,
    /// Kinetic energy of each body relative to its mass centre, J.
    pub vibration: [f64; 2],
}

/// Rows at an even stride that adapts to the length of the contact.
#[derive(Debug, Clone)]
pub(crate) struct History {
    rows: Vec<HistoryRow>,
    /// Rows that thinning leaves: first and last contact.
    essential: Vec<bool>,
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
    pub fn push(&mut self, row: HistoryRow, essential: bool) {
        self.rows.push(row);
        self.essential.push(essential);
        if self.rows.len() > self.max_rows {
            let mut kept = 0;
            for k in 0..self.rows.len() {
                if self.essential[k] || k % 2 == 0 {
                    self.rows[kept] = self.rows[k];
                    self.essential[kept] = self.essential[k];
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
