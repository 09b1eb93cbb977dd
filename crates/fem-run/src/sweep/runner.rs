//! Runs the members of a sweep and puts their results into its folder.

use std::sync::Mutex;
use std::time::Instant;

use fem::results::Summary;
use fem::sweep::{Member, Observer, Ran, Runner};
use fem::{CaseError, Shared};
use fem_case::engineering::show;
use fem_case::{Keep, Sweep};
use fem_report::number_text::elapsed;
use rayon::ThreadPool;

use super::board::{Board, MemberWatch};
use super::folder::SweepFolder;
use super::packs::Pack;
use super::shard::Shard;
use crate::failure::Failure;
use crate::interrupt::Interrupt;
use crate::result_files::{longest_name, write_result};
use crate::result_folder::{Replaces, ResultFolder};
use crate::stopwatch::{Stopwatch, Timed};

/// What members are run with.
pub struct Job<'a> {
    /// The sweep.
    pub sweep: &'a Sweep,
    /// The members, in order, those that run among them.
    pub members: &'a [Member],
    /// Where results go.
    pub folder: &'a SweepFolder,
    /// Which of them are this process's.
    pub shard: Shard,
    /// Threads that they run on.
    pub pool: &'a ThreadPool,
    /// Show no progress.
    pub quiet: bool,
    /// Whether the user wants the sweep to end.
    pub interrupt: Interrupt,
}

impl Job<'_> {
    /// What the member at a place is known by.
    fn identity(&self, index: usize) -> String {
        let place = self.members.binary_search_by_key(&index, |member| member.index);
        place.map_or(String::new(), |place| self.members[place].identity())
    }
}

/// Runs these members in this order; those that another process finishes first are left out.
/// An interrupted member leaves nothing.
///
/// # Errors
/// A result that cannot be written. The other members end early.
pub fn run_members(job: &Job<'_>, left: &[usize]) -> Result<(), Failure> {
    let board = Board::new(job.interrupt.clone(), left.len(), job.quiet);
    let pack = job.folder.pack(job.shard);
    let keeper = Keeper { job, board: &board, pack, first_failure: Mutex::new(None) };
    let shared = Shared::default();
    let runner = Runner::new(job.sweep, &shared);
    let runner = if job.sweep.keep == Keep::All { runner } else { runner.without_fields() };
    job.pool.install(|| runner.run_all(left, &keeper));
    board.finish();
    keeper.first_failure.into_inner().ok().flatten().map_or(Ok(()), Err)
}

/// Puts each member's result into the sweep's folder when it has ended.
struct Keeper<'a> {
    job: &'a Job<'a>,
    board: &'a Board,
    pack: Pack,
    first_failure: Mutex<Option<Failure>>,
}

impl<'a> Observer for Keeper<'a> {
    type Watch = Timed<MemberWatch<'a>>;

    fn admits(&self, index: usize) -> bool {
        if self.board.is_stopped() {
            return false;
        }
        let Job { sweep, folder, .. } = self.job;
        let is_done = folder.has(&self.job.identity(index), sweep.keep);
        if is_done {
            self.board.finish_member(&format!("{}: done elsewhere", sweep.describe(index)));
        }
        !is_done
    }

    fn begin(&self, _: usize) -> Self::Watch {
        Timed::since(Instant::now(), MemberWatch::new(self.board))
    }

    fn end(&self, index: usize, watch: Self::Watch, ran: Result<&Ran, &CaseError>) {
        let (stopwatch, watch) = watch.stop();
        let kept = match ran {
            Ok(ran) if ran.collision.is_interrupted() => return,
            Ok(ran) => self.keep(index, ran, &stopwatch),
            Err(error) => Err(error.clone().into()),
        };
        match kept {
            Ok(summary) => {
                watch.finish();
                let name = self.job.sweep.describe(index);
                self.board.finish_member(&format!("{name}: {}", in_a_few_words(&summary)));
            }
            Err(failure) => {
                self.board.abort();
                if let Ok(mut first) = self.first_failure.lock() {
                    first.get_or_insert(failure);
                }
            }
        }
    }
}

impl Keeper<'_> {
    fn keep(&self, index: usize, ran: &Ran, stopwatch: &Stopwatch) -> Result<Summary, Failure> {
        let Job { sweep, folder, .. } = self.job;
        let stem = &self.job.identity(index);
        if sweep.keep == Keep::Packed {
            return self.append(stem, ran, stopwatch);
        }
        let out = folder.member(stem);
        let place = ResultFolder::claim_swept(&out, &longest_name(stem), Replaces::Any)
            .map_err(|failure| Failure::failed(format!("{}: {failure}", sweep.describe(index))))?;
        let Ran { simulation, collision } = ran;
        let (path, keep) = (place.path(), sweep.keep);
        let written = write_result(path, stem, simulation, collision, stopwatch, keep, &[]);
        if let Some(fault) = written.fault {
            return Err(fault);
        }
        place.publish(true)?;
        Ok(written.summary)
    }

    fn append(&self, identity: &str, ran: &Ran, stopwatch: &Stopwatch) -> Result<Summary, Failure> {
        let Ran { simulation, collision } = ran;
        let warnings = simulation.warnings(collision);
        let summary = Summary::of(simulation, collision, stopwatch.spent(), warnings, Vec::new());
        self.pack.append(identity, &summary).map_err(|error| {
            Failure::failed(format!("a summary cannot be written: {error}"))
                .with_help("the members before it are kept; is the disk full?")
        })?;
        Ok(summary)
    }
}

/// A member's result in a few words.
fn in_a_few_words(summary: &Summary) -> String {
    if let Some(reason) = &summary.stopped_because {
        return format!("FAILED: {reason}");
    }
    let quantity = |value: Option<f64>, unit| value.map_or("-".into(), |value| show(value, unit));
    format!(
        "restitution {}, contact time {}, {}",
        summary.collision.restitution.map_or("-".into(), |value| format!("{value:.5}")),
        quantity(summary.collision.contact_time_s, "s"),
        elapsed(summary.cost.solve_s)
    )
}
