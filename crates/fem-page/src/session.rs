//! A session: one case after the other, each computed in pieces at the pace of the caller.

use std::path::Path;

use fem::results::CostSummary;
use fem::schema::ModelTable;
use fem::{
    Case, CaseError, Collision, HistoryRow, OutputRequest, OutputRequestError, SharedModels,
    Simulation, SnapshotRequest, Stepper, Summary,
};

use crate::charts::Charts;
use crate::contour::{StressPicture, picture};
use crate::outcome::{EffectExplanation, FrameInfo, RunOutcome, RunStart};
use crate::sharing::{EnergyShares, common_of};

/// The name of the text in errors.
const SOURCE: &str = "the case";
/// Memory limit of a run in bytes: a 32-bit module has 4 GB, which other cases and their results share.
const MAX_MEMORY: f64 = 2.5e9;
/// Memory limit of the condensed bodies that are kept for the next case, in bytes.
const MAX_KEPT: usize = 200_000_000;

/// Largest progress of an unfinished run.
const MAX_UNDER_WAY: f64 = 0.999;

/// The amount that a run records.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct RecordedAmount {
    /// Rows of the history over the expected contact.
    pub rows: usize,
    /// Instants with fields, evenly spaced over the contact.
    pub frames: usize,
}

/// The last case and its collision, and what cases share.
pub struct Session {
    shared: SharedModels,
    simulation: Option<Simulation>,
    ask: Option<RecordedAmount>,
    stepper: Option<Box<dyn Stepper>>,
    collision: Option<Collision>,
}

impl Default for Session {
    fn default() -> Self {
        let shared = SharedModels::with_max_bytes(MAX_KEPT);
        Self { shared, simulation: None, ask: None, stepper: None, collision: None }
    }
}

/// Sets the memory limit of a browser in a case that has none.
fn within_memory(case: Case) -> Result<Case, CaseError> {
    match case.gives("limits.memory") {
        true => Ok(case),
        false => case.edited(|file| {
            file.limits.get_or_insert_default().memory = Some(MAX_MEMORY.into());
        }),
    }
}

impl Session {
    /// Reads a case and begins its collision; the previous one is dropped.
    pub fn begin(&mut self, text: &str, ask: RecordedAmount) -> Result<RunStart, CaseError> {
        (self.simulation, self.stepper, self.collision) = (None, None, None);
        let case = within_memory(Case::parse(SOURCE, text, Path::new("."), &[])?)?;
        let simulation = Simulation::sharing(case, &self.shared)?;
        let snapshots = SnapshotRequest::Count(ask.frames);
        let request =
            OutputRequest { history_rows: ask.rows, snapshots, ..simulation.request().clone() };
        let too_much = |error: OutputRequestError| CaseError::new(SOURCE, error.to_string());
        let simulation = simulation.with_output_request(request).map_err(too_much)?;
        let setup = simulation.setup();
        let begun = RunStart {
            case: simulation.case().file().clone(),
            model: setup.description.clone(),
            price: setup.cost.into(),
            warnings: simulation.warnings_before(),
        };
        (self.stepper, self.ask) = (Some(simulation.start()), Some(ask));
        self.simulation = Some(simulation);
        Ok(begun)
    }

    /// Computes the next pieces of the run and returns the completed share, 1 when it is over.
    pub fn advance(&mut self, pieces: u32) -> f64 {
        let Some(stepper) = &mut self.stepper else { return 1.0 };
        for _ in 0..pieces {
            if !stepper.advance(&mut ()) {
                return 1.0;
            }
        }
        stepper.progress().fraction.min(MAX_UNDER_WAY)
    }

    /// Returns the outcome after this time in seconds; an unfinished run is interrupted. `None` if nothing
    /// runs.
    pub fn finish(&mut self, seconds: f64) -> Option<RunOutcome> {
        let simulation = self.simulation.as_ref()?;
        let collision = self.stepper.take()?.finish();
        let spent =
            CostSummary { wall_s: seconds, solve_s: seconds, threads: 1, ..CostSummary::default() };
        let errors = simulation.estimate_errors(&collision);
        let warnings = simulation.warnings_with(&collision, &errors);
        let hertz = self.hertz(simulation, &collision).unwrap_or_default();
        let outcome = RunOutcome {
            summary: Summary::of(simulation, &collision, &errors, spent, warnings, Vec::new()),
            sharing: EnergyShares::of(&collision),
            charts: Charts::of(&collision.history, &hertz, common_of(&collision)),
            frames: FrameInfo::all(&collision, simulation.case().scene().first_touch()),
            effects: EffectExplanation::all(),
        };
        self.collision = Some(collision);
        Some(outcome)
    }

    /// Returns the history of the same bodies with Hertz' theory, as long as the run; `None` if it cannot
    /// be computed.
    fn hertz(&self, simulation: &Simulation, collision: &Collision) -> Option<Vec<HistoryRow>> {
        let case = simulation.case().edited(|file| file.model = Some(ModelTable::hertz())).ok()?;
        let hertz = Simulation::sharing(case, &self.shared).ok()?;
        let hertz = hertz
            .with_output_request(OutputRequest {
                history_rows: self.ask?.rows,
                ..OutputRequest::history()
            })
            .ok()?;
        let mut rows = hertz.run(&mut ()).history;
        let end = collision.history.last()?.time;
        rows.retain(|row| row.time <= end);
        Some(rows)
    }

    /// Draws the bodies at an instant, in a window of `half_width` contact radii to each side of the
    /// contact; `None` for a model without fields.
    pub fn picture(&self, index: usize, half_width: f64) -> Option<StressPicture> {
        picture(self.simulation.as_ref()?, self.collision.as_ref()?, index, half_width)
    }
}
