//! What a page is told: before a run, and after it.

use fem::{CaseFile, Collision, Cost, Row, Summary};
use serde::Serialize;

use crate::charts::Charts;
use crate::sharing::Sharing;

/// A case that is ready to run.
#[derive(Clone, Debug, Serialize)]
pub struct Begun {
    /// The case as written, numbers in SI.
    pub case: CaseFile,
    /// In a few words: what computes it.
    pub model: String,
    /// What it will take.
    pub price: Price,
    /// What the user should know before the run.
    pub warnings: Vec<String>,
}

/// What a run will take.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize)]
pub struct Price {
    /// Of both bodies, of a model that has them.
    pub elements: Option<u64>,
    /// Of a model that steps.
    pub steps: Option<u64>,
    /// Elements times steps, of a model that computes each at each.
    pub element_updates: Option<u64>,
}

impl From<Cost> for Price {
    fn from(cost: Cost) -> Self {
        match cost {
            Cost::Steps { elements, steps, element_updates, .. } => Self {
                elements: Some(elements),
                steps: Some(steps),
                element_updates: Some(element_updates),
            },
            Cost::Factors { elements, steps, .. } => {
                Self { elements: Some(elements), steps: Some(steps), element_updates: None }
            }
            Cost::Little { .. } => Self::default(),
        }
    }
}

/// A collision as far as it got.
#[derive(Clone, Debug, Serialize)]
pub struct Outcome {
    /// As the command writes it.
    pub summary: Summary,
    /// Where the energy went; none where it comes from outside, too, or is not known.
    pub sharing: Option<Sharing>,
    /// Over contact and separation.
    pub charts: Charts,
    /// Instants whose fields can be drawn, in the order of time.
    pub frames: Vec<Frame>,
}

/// An instant whose fields are kept.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Frame {
    /// Since first touch.
    pub time_s: f64,
    /// Of the mass centres.
    pub approach_m: f64,
    /// Of the contact, between two rows of the history.
    pub contact_force_n: Option<f64>,
}

impl Frame {
    /// Those of a collision whose bodies first touch at a time, s.
    pub(crate) fn all(collision: &Collision, first_touch: f64) -> Vec<Self> {
        let frame = |snapshot: &fem::Snapshot| Self {
            time_s: snapshot.time - first_touch,
            approach_m: snapshot.approach,
            contact_force_n: force_at(&collision.history, snapshot.time),
        };
        collision.snapshots.iter().map(frame).collect()
    }
}

/// Contact force (N) at a time (s), linear between rows; `None` beyond them.
fn force_at(rows: &[Row], time: f64) -> Option<f64> {
    let next = rows.partition_point(|row| row.time < time);
    let after = rows.get(next)?;
    let before = rows.get(next.saturating_sub(1))?;
    let length = after.time - before.time;
    let share = if length > 0.0 { (time - before.time) / length } else { 0.0 };
    Some(before.contact_force + share * (after.contact_force - before.contact_force))
}
