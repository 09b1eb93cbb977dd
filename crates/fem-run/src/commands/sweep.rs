//! `fem-run sweep SWEEP.toml`: computes all members of a sweep or a shard of them, here or with Slurm.

use std::cell::OnceCell;
use std::num::NonZeroUsize;
use std::path::{Path, PathBuf};

use fem::sweep::{Checked, KeyNumbers, Member, check_some, load};
use fem::{WarningKinds, digest_of};
use fem_case::{CaseFile, Sweep};
use fem_report::sweep::FigureChoice;
use rayon::{ThreadPool, ThreadPoolBuilder};

use crate::arguments::case::{parse_count, stem_of};
use crate::progress::CheckProgress;
use crate::progress::interrupt::Interrupt;
use crate::result_folder::Origin;
use crate::sweep::{
    Collector, Manifest, Shard, ShardFilter, SlurmBatch, SlurmOptions, SweepCost, SweepFolder,
    SweepJob, announce, conclude, report, run_members, status, warning_lines,
};
use crate::text::failure::Failure;
use crate::text::standard_output;

/// Compute a case for many values of some of its keys
///
/// Writes sweep.csv, sweep.svg and a summary of each member into a folder. The same command on the folder
/// of a stopped sweep continues it; members that are done are not computed again.
#[derive(clap::Args, Debug)]
pub struct Arguments {
    /// The sweep file (TOML): a case, and in [vary] some of its keys with values; with --status the folder of
    /// a sweep
    #[arg(value_name = "SWEEP")]
    sweep: PathBuf,
    /// Folder for the results [default: runs/<the sweep file's stem>]
    ///
    /// Values of --set that change the scene are appended to the default, as for a case. An existing folder must
    /// be empty or that of the same sweep file and overrides, perhaps before the file was edited, or of an equal
    /// sweep, which is then continued. Without --out another sweep is kept, and a new folder lies next to it.
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
    /// Continue in the folder of another sweep and replace its table; its members are kept
    #[arg(long)]
    force: bool,
    /// Override a key of the base case by its dotted path; may be repeated
    #[arg(long, value_name = "KEY=VALUE")]
    set: Vec<String>,
    /// Number of members that run at the same time [default: one per processor]
    #[arg(long, value_name = "N", allow_negative_numbers = true, value_parser = parse_count)]
    threads: Option<NonZeroUsize>,
    /// Run only the K-th of N shards: every N-th member, from the K-th
    ///
    /// Shards may run at any time, on several machines, into the same folder; the last one leaves the same
    /// files as the whole sweep.
    #[arg(long, value_name = "K/N")]
    shard: Option<Shard>,
    /// Leave table, figure and sweep.json to a later --merge, for shards of large sweeps
    #[arg(long, requires = "shard")]
    no_merge: bool,
    /// Compute nothing; write table and figure of the members that are done
    #[arg(long, conflicts_with_all = ["shard", "dry_run"])]
    merge: bool,
    /// Print the progress of the sweep in the folder SWEEP, whoever computes it
    #[arg(long, conflicts_with_all = ["out", "set", "threads", "shard", "dry_run", "merge", "slurm"])]
    status: bool,
    #[command(flatten)]
    slurm: SlurmOptions,
    /// Check all members and print how many are to run; compute and write nothing
    #[arg(long)]
    dry_run: bool,
    /// Print nothing but errors and warnings
    #[arg(long, short)]
    quiet: bool,
}

struct Work<'a> {
    arguments: &'a Arguments,
    sweep: &'a Sweep,
    out: &'a Path,
    origin: &'a Origin,
    pool: &'a ThreadPool,
    /// Cost estimate of the members that are left, made when it is first needed.
    expected: OnceCell<SweepCost>,
}

pub fn execute(arguments: &Arguments) -> Result<(), Failure> {
    if arguments.status {
        return standard_output::print(&status(&arguments.sweep)?);
    }
    let sweep = load(&arguments.sweep, &arguments.set)?;
    let origin = Origin::of_digest("sweep", digest_of(sweep.texts().map(str::as_bytes)))
        .with_inputs(&arguments.set)
        .with_file(&arguments.sweep);
    let out = match &arguments.out {
        Some(out) => out.clone(),
        None => default_folder(&sweep.folder_name(&stem_of(&arguments.sweep)), &origin, arguments),
    };
    let pool = thread_pool(arguments.threads)?;
    let work = Work {
        arguments,
        sweep: &sweep,
        out: &out,
        origin: &origin,
        pool: &pool,
        expected: OnceCell::new(),
    };
    work.compute(arguments.shard.unwrap_or(Shard::WHOLE))
}

/// Returns `runs/<name>`, or a folder next to it if that holds another sweep.
fn default_folder(name: &str, origin: &Origin, arguments: &Arguments) -> PathBuf {
    let default = Path::new("runs").join(name);
    let is_free = |folder: &PathBuf| {
        let here = SweepFolder::at(folder, ShardFilter::All).only_of(origin);
        arguments.force || here.other_sweep().is_none()
    };
    let mut folders = std::iter::once(default.clone()).chain(origin.folders_beside(&default));
    folders.find(is_free).unwrap_or(default)
}

impl Work<'_> {
    fn folder(&self, filter: ShardFilter) -> SweepFolder {
        let folder = SweepFolder::at(self.out, filter);
        if self.arguments.force { folder } else { folder.only_of(self.origin) }
    }

    fn manifest<'m>(&'m self, members: &'m [Member]) -> Manifest<'m> {
        let Self { arguments, sweep, origin, out, .. } = self;
        let (made_from, source) = (origin.made_from(), origin.source(out));
        Manifest { sweep, members, set: &arguments.set, made_from, source }
    }

    /// Computes a shard, usually the whole, and then writes table and figure of all members that are done, unless that is left to a later
    /// merge: then no other member is read.
    fn compute(&self, shard: Shard) -> Result<(), Failure> {
        let Self { arguments, sweep, pool, .. } = self;
        let (places, filter) = match arguments.no_merge {
            true => (shard.places(sweep.n_members()), ShardFilter::Shard(shard)),
            false => (Shard::WHOLE.places(sweep.n_members()), ShardFilter::All),
        };
        let mut folder = self.folder(filter);
        folder.check()?;
        let mut numbers = KeyNumbers::new(sweep);
        let mut checking = CheckProgress::new(places.len(), arguments.quiet);
        let see = |member: &Member, case: &CaseFile| {
            checking.tick();
            numbers.see(sweep, member.index, case);
        };
        let is_own = |index: usize| shard.has(index);
        let is_done = |member: &Member| folder.has(&member.identity(), sweep.keep);
        let checked = pool.install(|| check_some(*sweep, &places, is_own, is_done, see))?;
        let Checked { members, left, .. } = &checked;
        let merges = !arguments.no_merge;
        let choice = merges.then(|| FigureChoice::of(sweep, &numbers)).transpose()?;
        let n_own = shard.places(sweep.n_members()).len();
        if arguments.dry_run {
            self.announce(&checked, n_own);
            return Ok(());
        }
        let batch = |options| SlurmBatch::of(sweep, &checked, self.expected(&checked), options);
        let batch = arguments.slurm.options().map(batch).transpose()?;
        // Until here a signal ends the process at once: nothing is kept.
        let interrupt = Interrupt::listen();
        let mark = self.manifest(members);
        folder.claim(merges, |file| mark.write(file))?;
        if let Some(batch) = batch {
            return self.hand_over(&batch, &folder, &checked);
        }
        let mut ran = Ok(());
        if !arguments.merge {
            self.announce(&checked, n_own);
            ran = run_members(&self.job(&folder, members, shard, &interrupt), left);
        }
        let (numbers, folder) = (&numbers, &mut folder);
        let mut collector = Collector { sweep, members, folder, numbers, choice: choice.as_ref() };
        let collected = collector.collect(is_own)?;
        ran?;
        standard_output::warn(warning_lines(&collected.warnings, sweep, &checked.warnings));
        if !arguments.quiet && merges {
            standard_output::print(&report(sweep, &collected, members.len(), self.out))?;
        }
        if arguments.merge && collected.n_done < n_own {
            let message = format!("{} of {n_own} members are done", collected.n_done);
            let help =
                "they are in the table; the same command without --merge computes the others";
            return Err(Failure::failed(message).with_help(help));
        }
        conclude(&collected, n_own, interrupt.is_requested())
    }

    fn hand_over(
        &self,
        batch: &SlurmBatch,
        folder: &SweepFolder,
        checked: &Checked,
    ) -> Result<(), Failure> {
        let Self { arguments, sweep, .. } = self;
        self.announce(checked, sweep.n_members());
        let set = &arguments.set;
        let script = batch.write(&arguments.sweep, set, folder)?;
        let submitted = if arguments.slurm.submit { Some(batch.submit(&script)?) } else { None };
        match arguments.quiet {
            true => Ok(()),
            false => standard_output::print(&batch.report(&script, submitted.as_deref())),
        }
    }

    fn expected(&self, checked: &Checked) -> &SweepCost {
        self.expected.get_or_init(|| SweepCost::of(self.sweep, checked, self.pool))
    }

    fn announce(&self, checked: &Checked, n_own: usize) {
        let Self { arguments, sweep, pool, .. } = self;
        if !arguments.quiet {
            let name = arguments.sweep.display().to_string();
            let expected = self.expected(checked);
            announce(&name, sweep, checked, expected, n_own, pool.current_num_threads());
        }
        standard_output::warn(warning_lines(&checked.warnings, sweep, &WarningKinds::default()));
    }

    fn job<'j>(
        &'j self,
        folder: &'j SweepFolder,
        members: &'j [Member],
        shard: Shard,
        interrupt: &Interrupt,
    ) -> SweepJob<'j> {
        let (sweep, pool, quiet) = (self.sweep, self.pool, self.arguments.quiet);
        SweepJob { sweep, members, folder, shard, pool, quiet, interrupt: interrupt.clone() }
    }
}

/// Returns so many threads, or one per processor.
pub fn thread_pool(threads: Option<NonZeroUsize>) -> Result<ThreadPool, Failure> {
    let pool = ThreadPoolBuilder::new().num_threads(threads.map_or(0, NonZeroUsize::get)).build();
    pool.map_err(|error| Failure::failed(format!("no threads to run on: {error}")))
}
