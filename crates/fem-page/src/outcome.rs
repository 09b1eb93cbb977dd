//! What the page gets as JSON: errors of a case, materials of the library, a run before, during and after it.

use fem::effects::{EFFECTS, Effect, EffectKind};
use fem::{CaseFile, Collision, Cost, HistoryRow, Summary};
use fem_case::CaseError;
use fem_case::library::{materials, table_text};
use serde::Serialize;

use crate::charts::Charts;
use crate::sharing::EnergyShares;

/// A case that is ready to run.
#[derive(Clone, Debug, Serialize)]
pub struct RunStart {
    /// The case as written, with numbers in SI.
    pub case: CaseFile,
    /// A short description of the model.
    pub model: String,
    /// The cost estimate.
    pub price: CostEstimate,
    /// Warnings before the run.
    pub warnings: Vec<String>,
}

/// The cost estimate of a run.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize)]
pub struct CostEstimate {
    /// Elements of both bodies, if the model has any.
    pub elements: Option<u64>,
    /// Number of steps, if the model has any.
    pub steps: Option<u64>,
    /// Elements times steps, for models that update every element in every step.
    pub element_updates: Option<u64>,
}

impl From<Cost> for CostEstimate {
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
            Cost::ClosedForm { .. } => Self::default(),
        }
    }
}

/// A collision, complete or not.
#[derive(Clone, Debug, Serialize)]
pub struct RunOutcome {
    /// The summary, as the command writes it.
    pub summary: Summary,
    /// The shares of the energy; `None` if there is external work, or if they are not known.
    pub sharing: Option<EnergyShares>,
    /// Charts over contact and separation.
    pub charts: Charts,
    /// The instants whose fields can be drawn, in order.
    pub frames: Vec<FrameInfo>,
    /// The explanations of all effects.
    pub effects: Vec<EffectExplanation>,
}

/// The explanation of an effect.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct EffectExplanation {
    /// Name of the effect in the summary.
    pub name: &'static str,
    /// Explanation in one sentence.
    pub words: &'static str,
    /// Whether it is a part of the computation and not physics.
    pub is_numerical: bool,
}

impl EffectExplanation {
    /// Returns the explanations of all effects.
    pub(crate) fn all() -> Vec<Self> {
        let of = |effect: &dyn Effect| Self {
            name: effect.name(),
            words: effect.explanation(),
            is_numerical: effect.kind() == EffectKind::Numerical,
        };
        EFFECTS.into_iter().map(of).collect()
    }
}

/// An instant whose fields are kept.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct FrameInfo {
    /// Time since first touch.
    pub time_s: f64,
    /// Approach of the mass centres.
    pub approach_m: f64,
    /// Contact force, interpolated in the history.
    pub contact_force_n: Option<f64>,
}

impl FrameInfo {
    /// Returns the instants of a collision whose bodies first touch at this time, s.
    pub(crate) fn all(collision: &Collision, first_touch: f64) -> Vec<Self> {
        let frame = |snapshot: &fem::Snapshot| Self {
            time_s: snapshot.time - first_touch,
            approach_m: snapshot.approach,
            contact_force_n: force_at(&collision.history, snapshot.time),
        };
        collision.snapshots.iter().map(frame).collect()
    }
}

/// Interpolates the contact force (N) linearly at a time (s); `None` beyond the rows.
fn force_at(rows: &[HistoryRow], time: f64) -> Option<f64> {
    let next = rows.partition_point(|row| row.time < time);
    let after = rows.get(next)?;
    let before = rows.get(next.saturating_sub(1))?;
    let length = after.time - before.time;
    let share = if length > 0.0 { (time - before.time) / length } else { 0.0 };
    Some(before.contact_force + share * (after.contact_force - before.contact_force))
}

/// An error of a case, its position, and what is allowed.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct CaseFault {
    /// The error, in one sentence.
    pub message: String,
    /// The allowed values, or what to do.
    pub help: Option<String>,
    /// The dotted path of the key.
    pub key: Option<String>,
    /// Line in the text, from 1; with `column`.
    pub line: Option<usize>,
    /// Column in characters, from 1.
    pub column: Option<usize>,
    /// The whole error as plain text, with the line of the case.
    pub text: String,
    /// Further errors in the same case.
    pub others: Vec<CaseFault>,
}

impl From<CaseError> for CaseFault {
    fn from(mut error: CaseError) -> Self {
        let others = error.take_others().into_iter().map(Self::from).collect();
        Self {
            others,
            message: error.message().to_string(),
            help: error.help().map(String::from),
            key: error.key().map(String::from),
            line: error.line(),
            column: error.column(),
            text: error.to_string(),
        }
    }
}

/// A material of the library.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct LibraryEntry {
    /// Name, without `lib:`.
    pub name: &'static str,
    /// Title for the list of materials.
    pub title: &'static str,
    /// Source of the numbers.
    pub source: &'static str,
    /// Range of validity, and scatter.
    pub range: &'static str,
    /// Its table in a case, as TOML; relaxation comes last.
    pub text: String,
}

impl LibraryEntry {
    /// Returns all materials, by name.
    pub fn all() -> Vec<Self> {
        let entry = |(name, material): (&'static String, &'static fem_case::library::Material)| {
            let text = table_text(name)?;
            let (title, source, range) = (&material.title, &material.source, &material.range);
            Some(Self { name, title, source, range, text })
        };
        materials().iter().filter_map(entry).collect()
    }
}
