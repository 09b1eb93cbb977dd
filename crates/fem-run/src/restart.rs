//! The restart file of a run: written while it goes on, taken up by a later one.

use std::fs::{self, File};
use std::io::{Read, Write, stderr};
use std::path::Path;
use std::time::{Duration, Instant};

use fem::{
    CheckpointHead, Course, Identity, Memory, Simulation, checkpoint, checkpoint_head, memory_of,
};
use fem_case::engineering::show;

use crate::failure::Failure;
use crate::result_folder::ResultFolder;
use crate::standard_output::one_line;

/// Its name in the folder of the result.
pub const RESTART_FILE: &str = "fem-run.restart";
/// Bytes in which its first line is.
const HEAD_BYTES: u64 = 1024;

/// Whether a run can be gone on with.
#[derive(clap::Args, Clone, Copy, Debug)]
pub struct RestartArguments {
    /// Keep a restart file in the result folder, written anew after so many seconds
    ///
    /// It goes when the run is over; an interrupted run leaves one of where it was.
    #[arg(long, value_name = "SECONDS", allow_negative_numbers = true, value_parser = parse_seconds)]
    pub checkpoint_every: Option<Duration>,
    /// Go on from the restart file in the result folder, to the same bits as an unbroken run
    #[arg(long)]
    pub restart: bool,
}

/// A time by the clock.
fn parse_seconds(text: &str) -> Result<Duration, String> {
    let seconds = text.parse::<f64>().ok().and_then(|s| Duration::try_from_secs_f64(s).ok());
    seconds.ok_or_else(|| "it must be seconds, at least 0, such as 60".to_string())
}

/// What the restart file in a folder is of, if there is one.
pub fn head_of(folder: &Path) -> Option<CheckpointHead> {
    let mut bytes = Vec::new();
    let file = File::open(folder.join(RESTART_FILE)).ok()?;
    file.take(HEAD_BYTES).read_to_end(&mut bytes).ok()?;
    checkpoint_head(&bytes).ok()
}

/// What the restart file in a folder knows of this run; `None` where there is no such file.
///
/// # Errors
/// A file of another case or of another build; one that is damaged or cannot be read.
pub fn memory_in(folder: &Path, identity: &Identity) -> Result<Option<Memory>, Failure> {
    let path = folder.join(RESTART_FILE);
    let refused = |what: &dyn std::fmt::Display| {
        let name = one_line(&path.display().to_string());
        Failure::bad_input(format!("--restart: {name}: {what}")).with_help(
            "name the folder of this run with --out, or start anew without --restart; a restart file \
             is good for the build and the case that wrote it",
        )
    };
    match fs::read(&path) {
        Err(error) if error.kind() == std::io::ErrorKind::NotFound => Ok(None),
        Err(error) => Err(refused(&error)),
        Ok(bytes) => memory_of(&bytes, identity).map(Some).map_err(|error| refused(&error)),
    }
}

/// Writes the restart file of a run under way.
pub struct Keeper<'a> {
    folder: &'a ResultFolder,
    identity: &'a Identity,
    arguments: RestartArguments,
    last: Instant,
    has_failed: bool,
}

impl<'a> Keeper<'a> {
    /// Of a run that begins now.
    pub fn new(
        folder: &'a ResultFolder,
        identity: &'a Identity,
        arguments: RestartArguments,
    ) -> Self {
        Self { folder, identity, arguments, last: Instant::now(), has_failed: false }
    }

    /// Whether the run is to leave a file at all.
    pub fn keeps(&self) -> bool {
        self.arguments.checkpoint_every.is_some() || self.arguments.restart
    }

    /// Says so if the model has nothing to write down.
    pub fn begin(&self, course: &dyn Course) {
        if self.arguments.checkpoint_every.is_some() && course.memory().is_none() {
            let text = "this model computes all in one go: it leaves no restart file";
            let _ = writeln!(stderr(), "warning: {text}");
        }
    }

    /// Writes the file anew if it is time.
    pub fn look_at(&mut self, simulation: &Simulation, course: &dyn Course) {
        let every = self.arguments.checkpoint_every;
        if every.is_none_or(|every| self.last.elapsed() < every) {
            return;
        }
        let Some(memory) = simulation.memory_of(course) else { return };
        let written = self.folder.write_ahead(RESTART_FILE, &checkpoint(self.identity, &memory));
        self.last = Instant::now();
        if let Err(error) = written
            && !self.has_failed
        {
            // Once: the run itself is sound, and its next file may be written again.
            self.has_failed = true;
            let _ = writeln!(stderr(), "warning: {RESTART_FILE} cannot be written: {error}");
        }
    }

    /// Puts the file among those of an interrupted run; whether there is one.
    pub fn leave(&self, simulation: &Simulation, course: &dyn Course) -> bool {
        let Some(memory) = simulation.memory_of(course) else { return false };
        let path = self.folder.path().join(RESTART_FILE);
        fs::write(path, checkpoint(self.identity, &memory)).is_ok()
    }
}

/// One line on what is gone on from.
pub fn tell(memory: Option<&Memory>) {
    let text = match memory {
        Some(memory) => format!(
            "going on from step {} of the contact at t = {}",
            memory.step(),
            show(memory.contact().time(), "s")
        ),
        None => format!("no {RESTART_FILE} in the result folder: starting anew"),
    };
    let _ = writeln!(stderr(), "{text}");
}
