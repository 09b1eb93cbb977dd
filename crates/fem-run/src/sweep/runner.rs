//! Runs members on all threads, each on one, and puts their results into the sweep's folder.

use std::num::NonZeroUsize;
use std::sync::Mutex;
use std::time::Instant;

use fem::results::Summary;
use fem::{Shared, Simulation};
use fem_case::{Keep, Sweep};
use rayon::ThreadPoolBuilder;
use rayon::iter::{ParallelBridge, ParallelIterator};

use super::board::{Board, MemberWatch};
use super::folder::SweepFolder;
use super::member::Member;
use crate::commands::run::{longest_name, write_result};
use crate::engineering::show;
use crate::failure::Failure;
use crate::interrupt::Interrupt;
use crate::result_folder::ResultFolder;
use crate::stopwatch::Stopwatch;

/// What members are run with.
pub struct Job<'a> {
    /// The sweep.
    pub sweep: &'a Sweep,
    /// Where results go.
    pub folder: &'a SweepFolder,
    /// Threads; as many as the machine has if none.
    pub threads: Option<NonZeroUsize>,
    /// Show no progress.
    pub quiet: bool,
    /// What members share.
    pub shared: Shared,
    /// Whether the user wants the sweep to end.
    pub interrupt: Interrupt,
}

/// Runs these members in this order; those that another process finishes first are left out.
/// An interrupted member leaves nothing.
///
/// # Errors
/// A result that cannot be written, or no threads. The other members end early.
pub fn run_members(job: &Job<'_>, members: &[&Member]) -> Result<(), Failure> {
    let threads = job.threads.map_or(0, NonZeroUsize::get);
    let pool = ThreadPoolBuilder::new().num_threads(threads).build();
    let pool = pool.map_err(|error| Failure::failed(format!("no threads to run on: {error}")))?;
    let board = Board::new(job.interrupt.clone(), members.len(), job.quiet);
    let first_failure = Mutex::new(None);
    pool.install(|| {
        // A bridge hands members out one by one, in order.
        members.iter().par_bridge().for_each(|member| {
            if board.is_stopped() {
                return;
            }
            if let Err(failure) = run_member(job, &board, member) {
                board.abort();
                if let Ok(mut first) = first_failure.lock() {
                    first.get_or_insert(failure);
                }
            }
        });
    });
    board.finish();
    first_failure.into_inner().ok().flatten().map_or(Ok(()), Err)
}

fn run_member(job: &Job<'_>, board: &Board, member: &Member) -> Result<(), Failure> {
    let Job { sweep, folder, .. } = job;
    let name = sweep.describe(member.index);
    if folder.has(&member.identity, sweep.keep) {
        board.finish_member(&format!("{name}: done elsewhere"));
        return Ok(());
    }
    let started = Instant::now();
    let mut simulation =
        sweep.build(member.index, |case| Simulation::sharing(case, &job.shared))?;
    if sweep.keep == Keep::Summary {
        simulation.skip_snapshots();
    }
    let mut watch = MemberWatch::new(board);
    let (collision, stopwatch) = Stopwatch::run(started, &mut simulation, &mut watch);
    if collision.is_interrupted() {
        return Ok(());
    }
    let stem = &member.identity;
    let place = ResultFolder::claim(&folder.member(stem), &longest_name(stem))
        .map_err(|failure| Failure::failed(format!("{name}: {failure}")))?;
    let summary =
        write_result(place.path(), stem, &simulation, &collision, &stopwatch, sweep.keep)?;
    place.publish()?;
    watch.finish();
    board.finish_member(&format!("{name}: {}", in_a_few_words(&summary)));
    Ok(())
}

/// A member's result in a few words.
fn in_a_few_words(summary: &Summary) -> String {
    if let Some(reason) = &summary.stopped_because {
        return format!("FAILED: {reason}");
    }
    let quantity = |value: Option<f64>, unit| value.map_or("-".into(), |value| show(value, unit));
    format!(
        "restitution {}, contact time {}, {:.2} s",
        summary.collision.restitution.map_or("-".into(), |value| format!("{value:.5}")),
        quantity(summary.collision.contact_time_s, "s"),
        summary.cost.solve_s
    )
}
