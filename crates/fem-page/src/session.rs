//! One case after the other, each in steps that the caller paces.

use std::path::Path;
use std::sync::Arc;

use fem::results::Spent;
use fem::schema::ModelTable;
use fem::{
    Case, CaseError, Collision, Course, PairCache, Row, Shared, Simulation, SnapshotRequest,
    Summary, Want, WantError,
};

use crate::charts::Charts;
use crate::contour::{StressPicture, picture};
use crate::outcome::{Begun, Frame, Outcome};
use crate::sharing::{Sharing, common_of};

/// What faults call the text.
const SOURCE: &str = "the case";
/// Bytes that a run may take: a module of 32 bits has 4 GB, other cases and the results in them.
const MOST_MEMORY: f64 = 2.5e9;
/// Bytes that condensed bodies may take which are kept for the next case: some dozens of them.
const MOST_KEPT: usize = 200_000_000;

/// A run that is not over is not whole.
const MOST_UNDER_WAY: f64 = 0.999;

/// What a run is asked for beside its numbers.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Ask {
    /// Rows of the history over the expected contact.
    pub rows: usize,
    /// Instants whose fields are kept, evenly over the contact.
    pub frames: usize,
}

/// The case that was read last and its collision, and what cases share.
pub struct Session {
    shared: Shared,
    simulation: Option<Simulation>,
    ask: Option<Ask>,
    course: Option<Box<dyn Course>>,
    collision: Option<Collision>,
}

impl Default for Session {
    fn default() -> Self {
        let pairs = || Arc::new(PairCache::with_max_bytes(MOST_KEPT));
        let shared = Shared { pairs: pairs(), companions: pairs(), ..Shared::default() };
        Self { shared, simulation: None, ask: None, course: None, collision: None }
    }
}

/// A case that leaves its limit of memory open, with that of a browser.
fn within_memory(case: Case) -> Result<Case, CaseError> {
    match case.gives("limits.memory") {
        true => Ok(case),
        false => case.edited(|file| {
            file.limits.get_or_insert_default().memory = Some(MOST_MEMORY.into());
        }),
    }
}

impl Session {
    /// Reads a case and begins its collision, in place of the one before.
    ///
    /// # Errors
    /// What is wrong with the case, what its model refuses, more than a run keeps.
    pub fn begin(&mut self, text: &str, ask: Ask) -> Result<Begun, CaseError> {
        (self.simulation, self.course, self.collision) = (None, None, None);
        let case = within_memory(Case::parse(SOURCE, text, Path::new("."), &[])?)?;
        let mut simulation = Simulation::sharing(case, &self.shared)?;
        let snapshots = SnapshotRequest::Count(ask.frames);
        let want = Want { history_rows: ask.rows, snapshots, ..simulation.want().clone() };
        let too_much = |error: WantError| CaseError::new(SOURCE, error.to_string());
        simulation.ask_for(want).map_err(too_much)?;
        let setup = simulation.setup();
        let begun = Begun {
            case: simulation.case().file().clone(),
            model: setup.description.clone(),
            price: setup.cost.into(),
            warnings: simulation.warnings_before(),
        };
        (self.course, self.ask) = (Some(simulation.start()), Some(ask));
        self.simulation = Some(simulation);
        Ok(begun)
    }

    /// Goes on by so many pieces of the run; how much of it is done, 1 when it is over.
    pub fn advance(&mut self, pieces: u32) -> f64 {
        let Some(course) = &mut self.course else { return 1.0 };
        for _ in 0..pieces {
            if !course.advance(&mut ()) {
                return 1.0;
            }
        }
        course.progress().fraction.min(MOST_UNDER_WAY)
    }

    /// What came out, after so long, s; a run that is not over is interrupted. None if nothing runs.
    pub fn finish(&mut self, seconds: f64) -> Option<Outcome> {
        let simulation = self.simulation.as_ref()?;
        let collision = self.course.take()?.finish();
        let spent = Spent { wall: seconds, solve: seconds, threads: 1, ..Spent::default() };
        let warnings = simulation.warnings(&collision);
        let hertz = self.hertz(simulation, &collision).unwrap_or_default();
        let outcome = Outcome {
            summary: Summary::of(simulation, &collision, spent, warnings, Vec::new()),
            sharing: Sharing::of(&collision),
            charts: Charts::of(&collision.history, &hertz, common_of(&collision)),
            frames: Frame::all(&collision, simulation.case().scene().first_touch()),
        };
        self.collision = Some(collision);
        Some(outcome)
    }

    /// The same bodies by Hertz' theory, as long as the run goes; none where it has no answer.
    fn hertz(&self, simulation: &Simulation, collision: &Collision) -> Option<Vec<Row>> {
        let case = simulation.case().edited(|file| file.model = Some(ModelTable::hertz())).ok()?;
        let mut hertz = Simulation::sharing(case, &self.shared).ok()?;
        hertz.ask_for(Want { history_rows: self.ask?.rows, ..Want::history() }).ok()?;
        let mut rows = hertz.run(&mut ()).history;
        let end = collision.history.last()?.time;
        rows.retain(|row| row.time <= end);
        Some(rows)
    }

    /// The bodies at an instant, in a window of so many contact radii to each side of the contact; none of a
    /// model without fields.
    pub fn picture(&self, index: usize, half_width: f64) -> Option<StressPicture> {
        picture(self.simulation.as_ref()?, self.collision.as_ref()?, index, half_width)
    }
}
