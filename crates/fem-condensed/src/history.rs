//! Rows of a history, thinned as they come.

use crate::collision::Row;

/// Rows over the elastic contact time.
const ROWS: usize = 1000;
/// More rows than this are thinned to half of them.
const MOST_ROWS: usize = 4 * ROWS;

/// A history that is written.
pub(crate) struct History {
    stride: usize,
    kept: Vec<Kept>,
    /// The last step, if it was not kept.
    skipped: Option<Kept>,
    was_closed: Option<bool>,
}

struct Kept {
    step: usize,
    /// Beside the beginning or end of a contact, or the first or last step: always kept.
    is_end: bool,
    row: Row,
}

impl History {
    /// For so many steps over the elastic contact time.
    pub fn new(n_steps: usize) -> Self {
        let stride = n_steps.div_ceil(ROWS).max(1);
        Self { stride, kept: Vec::new(), skipped: None, was_closed: None }
    }

    /// Adds the next step.
    pub fn push(&mut self, step: usize, is_closed: bool, row: Row) {
        let changes = self.was_closed.replace(is_closed) != Some(is_closed);
        if changes {
            if let Some(before) = self.skipped.take() {
                self.kept.push(Kept { is_end: true, ..before });
            } else if let Some(before) = self.kept.last_mut() {
                before.is_end = true;
            }
        }
        let kept = Kept { step, is_end: changes, row };
        if changes || step.is_multiple_of(self.stride) {
            self.skipped = None;
            self.kept.push(kept);
        } else {
            self.skipped = Some(kept);
        }
        if self.kept.len() > MOST_ROWS {
            self.stride *= 2;
            let stride = self.stride;
            self.kept.retain(|kept| kept.is_end || kept.step.is_multiple_of(stride));
        }
    }

    /// The rows, the last step among them.
    pub fn finish(mut self) -> Vec<Row> {
        self.kept.extend(self.skipped.take());
        self.kept.into_iter().map(|kept| kept.row).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn row(step: usize) -> Row {
        Row {
            time: step as f64,
            contact_force: 0.0,
            contact_radius: 0.0,
            approach: 0.0,
            centre_pressure: 0.0,
            approach_rate: 0.0,
            kinetic: 0.0,
            strain: 0.0,
            contact: 0.0,
            viscous_dissipation: 0.0,
            residual: 0.0,
            vibration: [0.0; 2],
        }
    }

    /// Long runs keep a few thousand rows, and both sides of every change of contact.
    #[test]
    fn rows_are_thinned_and_ends_are_kept() {
        let (last, closed) = (100_003, 777..90_001);
        let mut history = History::new(5000);
        for step in 0..=last {
            history.push(step, closed.contains(&step), row(step));
        }
        let rows = history.finish();
        assert!(rows.len() > MOST_ROWS / 2 && rows.len() <= MOST_ROWS, "{}", rows.len());
        assert!(rows.windows(2).all(|two| two[0].time < two[1].time));
        for step in [0, 776, 777, 90_000, 90_001, last] {
            assert!(rows.iter().any(|row| row.time == step as f64), "{step}");
        }
    }
}
