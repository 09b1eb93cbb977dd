//! The restart file of a run: written during the run, and read to continue it.

use std::fs;
use std::io::{Write, stderr};
use std::path::Path;
use std::time::{Duration, Instant};

use fem::{Identity, RestartState, Simulation, Stepper, checkpoint, restart_state_of};
use fem_case::engineering::show;

use super::ResultFolder;
use super::whole_file::{cause, write_whole};
use crate::text::{Failure, shown};

pub use super::existing_output::RESTART_FILE;

/// Options for restart files.
#[derive(clap::Args, Clone, Copy, Debug)]
pub struct RestartArguments {
    /// Keep a restart file in the result folder and update it at this interval
    ///
    /// The file is removed when the run is over; an interrupted run leaves its last state.
    #[arg(long, value_name = "SECONDS", allow_negative_numbers = true, value_parser = parse_seconds)]
    pub checkpoint_every: Option<Duration>,
    /// Continue from the restart file in the result folder, to the same bits as an unbroken run
    #[arg(long)]
    pub restart: bool,
}

fn parse_seconds(text: &str) -> Result<Duration, String> {
    let seconds = text.parse::<f64>().ok().and_then(|s| Duration::try_from_secs_f64(s).ok());
    seconds.ok_or_else(|| "give seconds, at least 0, such as 60".to_string())
}

/// Returns the restart state of this run from a folder; `None` if there is no restart file.
pub fn read_restart(folder: &Path, identity: &Identity) -> Result<Option<RestartState>, Failure> {
    let path = folder.join(RESTART_FILE);
    let refused = |what: &dyn std::fmt::Display| {
        let name = shown(&path);
        Failure::bad_input(format!("--restart: {name}: {what}")).with_help(
            "name the folder of this run with --out, or start anew without --restart; a restart file \
             works only with the build and the case that wrote it",
        )
    };
    match fs::read(&path) {
        Err(error) if error.kind() == std::io::ErrorKind::NotFound => Ok(None),
        Err(error) => Err(refused(&error)),
        Ok(bytes) => restart_state_of(&bytes, identity).map(Some).map_err(|error| refused(&error)),
    }
}

pub fn announce_restart(state: Option<&RestartState>) {
    let text = match state {
        Some(state) => format!(
            "continuing from step {} of the contact at t = {}",
            state.step(),
            show(state.contact().time(), "s")
        ),
        None => format!("no {RESTART_FILE} in the result folder: starting anew"),
    };
    let _ = writeln!(stderr(), "{text}");
}

pub struct RestartWriter<'a> {
    folder: &'a ResultFolder,
    identity: &'a Identity,
    arguments: RestartArguments,
    last: Instant,
    has_failed: bool,
}

impl<'a> RestartWriter<'a> {
    pub fn new(
        folder: &'a ResultFolder,
        identity: &'a Identity,
        arguments: RestartArguments,
    ) -> Self {
        Self { folder, identity, arguments, last: Instant::now(), has_failed: false }
    }

    pub fn is_on(&self) -> bool {
        self.arguments.checkpoint_every.is_some() || self.arguments.restart
    }

    /// Warns if the model has no restart state.
    pub fn begin(&self, stepper: &dyn Stepper) {
        if self.arguments.checkpoint_every.is_some() && stepper.restart_state().is_none() {
            let text = "this model computes its result at once: it leaves no restart file";
            let _ = writeln!(stderr(), "warning: {text}");
        }
    }

    pub fn update(&mut self, simulation: &Simulation, stepper: &dyn Stepper) {
        let every = self.arguments.checkpoint_every;
        if every.is_none_or(|every| self.last.elapsed() < every) {
            return;
        }
        let Some(state) = simulation.restart_state_of(stepper) else { return };
        let written = self.folder.write_ahead(RESTART_FILE, &checkpoint(self.identity, &state));
        self.last = Instant::now();
        if let Err(error) = written
            && !self.has_failed
        {
            // Warn once: the run itself is unaffected, and the next file may be written again.
            self.has_failed = true;
            let _ =
                writeln!(stderr(), "warning: {RESTART_FILE} cannot be written: {}", cause(&error));
        }
    }

    /// Writes the file of an interrupted run into its result; returns whether there is one.
    pub fn leave(&self, simulation: &Simulation, stepper: &dyn Stepper) -> bool {
        let Some(state) = simulation.restart_state_of(stepper) else { return false };
        let folder = self.folder.path();
        let bytes = checkpoint(self.identity, &state);
        write_whole(&folder.join(RESTART_FILE), folder, &bytes).is_ok()
    }
}
