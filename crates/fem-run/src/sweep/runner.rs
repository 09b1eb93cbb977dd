//! Runs the members of a sweep and writes their results.

use std::sync::Mutex;
use std::time::Instant;

use fem::ComputedCollision;
use fem::results::Summary;
use fem::sweep::{Member, Observer, Runner};
use fem::{CaseError, SharedModels};
use fem_case::{Keep, Sweep};
use fem_collision::QuantityOfInterest;
use fem_report::answer::answer_text;
use fem_report::number_text::elapsed;
use rayon::ThreadPool;

use super::folder::SweepFolder;
use super::member_store::MemberFile;
use super::shard::Shard;
use crate::progress::interrupt::Interrupt;
use crate::progress::stopwatch::{Stopwatch, Timed};
use crate::progress::{ItemMonitor, ItemProgress};
use crate::result_folder::ResultFolder;
use crate::result_folder::run_files::{longest_name, write_result};
use crate::result_folder::whole_file::cause;
use crate::text::failure::Failure;
use crate::text::run_report::across;

pub struct SweepJob<'a> {
    pub sweep: &'a Sweep,
    /// The members in order, those to run among them.
    pub members: &'a [Member],
    pub folder: &'a SweepFolder,
    /// The part of the sweep that this process computes.
    pub shard: Shard,
    pub pool: &'a ThreadPool,
    pub quiet: bool,
    pub interrupt: Interrupt,
}

impl SweepJob<'_> {
    fn identity(&self, index: usize) -> String {
        let place = self.members.binary_search_by_key(&index, |member| member.index);
        place.map_or(String::new(), |place| self.members[place].identity())
    }
}

/// Runs these members in this order, without those that another process finishes first. An interrupted
/// member leaves nothing.
pub fn run_members(job: &SweepJob<'_>, left: &[usize]) -> Result<(), Failure> {
    let progress = ItemProgress::new(job.interrupt.clone(), "members", left.len(), job.quiet);
    let pack = job.folder.pack(job.shard);
    let keeper = ResultKeeper { job, progress: &progress, pack, first_failure: Mutex::new(None) };
    let shared = SharedModels::default();
    let runner = Runner::new(job.sweep, &shared);
    let runner = if job.sweep.keep == Keep::All { runner } else { runner.without_fields() };
    job.pool.install(|| runner.run_all(left, &keeper));
    progress.finish();
    keeper.first_failure.into_inner().ok().flatten().map_or(Ok(()), Err)
}

struct ResultKeeper<'a> {
    job: &'a SweepJob<'a>,
    progress: &'a ItemProgress,
    pack: MemberFile,
    first_failure: Mutex<Option<Failure>>,
}

impl<'a> Observer for ResultKeeper<'a> {
    type Watch = Timed<ItemMonitor<'a>>;

    fn admits(&self, index: usize) -> bool {
        if self.progress.is_stopped() {
            return false;
        }
        let SweepJob { sweep, folder, .. } = self.job;
        let is_done = folder.has(&self.job.identity(index), sweep.keep);
        if is_done {
            self.progress.finish_item(&format!("{}: done elsewhere", sweep.describe(index)));
        }
        !is_done
    }

    fn begin(&self, _: usize) -> Self::Watch {
        Timed::since(Instant::now(), self.progress.begin())
    }

    fn end(&self, index: usize, watch: Self::Watch, ran: Result<&ComputedCollision, &CaseError>) {
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
                self.progress.finish_item(&format!("{name}: {}", in_a_few_words(&summary)));
            }
            Err(failure) => {
                self.progress.abort();
                if let Ok(mut first) = self.first_failure.lock() {
                    first.get_or_insert(failure);
                }
            }
        }
    }
}

impl ResultKeeper<'_> {
    fn keep(
        &self,
        index: usize,
        ran: &ComputedCollision,
        stopwatch: &Stopwatch,
    ) -> Result<Summary, Failure> {
        let SweepJob { sweep, folder, .. } = self.job;
        let stem = &self.job.identity(index);
        if sweep.keep == Keep::Packed {
            let summary = stopwatch.summary(ran, Vec::new());
            return match self.pack.append(stem, &summary) {
                Ok(()) => Ok(summary),
                Err(error) => {
                    let message = format!("a summary cannot be written: {}", cause(&error));
                    let help = "the members before it are kept; the same command continues";
                    Err(Failure::failed(message).with_help(help))
                }
            };
        }
        let out = folder.member(stem);
        let place = ResultFolder::claim_recovered(&out, &longest_name(stem), None, true)
            .map_err(|failure| Failure::failed(format!("{}: {failure}", sweep.describe(index))))?;
        let written = write_result(&place, stem, ran, stopwatch, sweep.keep, &[]);
        if let Some(fault) = written.fault {
            return Err(fault);
        }
        place.publish(true)?;
        Ok(written.summary)
    }
}

fn in_a_few_words(summary: &Summary) -> String {
    if let Some(reason) = &summary.stopped_because {
        return format!("FAILED: {reason}");
    }
    let answer = |quantity: QuantityOfInterest| {
        let number = summary.collision.number(quantity);
        let parts = summary.uncertainty.of(quantity);
        let measured = summary.measured_restitutions().first().map(|it| it.1);
        number.map_or("-".to_string(), |number| answer_text(number, &parts, quantity, measured))
    };
    let time = || format!("contact time {}", answer(QuantityOfInterest::ContactTime));
    format!(
        "restitution {}, {}, {}",
        answer(QuantityOfInterest::Restitution),
        across(summary).unwrap_or_else(time),
        elapsed(summary.cost.solve_s)
    )
}
