//! The result folder of a fit, a calibration, an export, a cradle, a record or a study of accuracy: `<command>.json`, which
//! identifies it, and other files.
//!
//! On a full disk the answer is printed all the same, and what can be written is kept: the JSON file before all others.

use std::io;
use std::path::{Path, PathBuf};

use fem::results::PROGRAM;
use serde::Serialize;
use serde_json::{Value, json};

use super::whole_file::{OwnedFileKind, cause, write_whole};
use super::{Origin, ResultFolder, ResultPath};
use crate::text::{Failure, shown, standard_output};

/// Options for the result folder of a command.
#[derive(clap::Args, Clone, Debug)]
pub struct OutputArguments {
    /// Folder for the result [default: in runs/, named after the input and the command]
    ///
    /// An existing folder is replaced only if it is empty or holds a result of the same command from the same
    /// files and overrides, perhaps before they were edited, or from equal ones. Other files in it are kept.
    /// Without --out another result is kept too, and the files go into a new folder next to it.
    /// A file TABLE.csv of measure, or FILE.toml of relaxation, gets a copy of the table, and the folder is the default one.
    #[arg(long, value_name = "DIR")]
    pub out: Option<PathBuf>,
    /// Replace any other result
    #[arg(long)]
    pub force: bool,
    /// Print only the numbers on stdout, as in the JSON file of the result
    #[arg(long)]
    pub json: bool,
    /// Print nothing but errors and warnings, and the numbers with --json
    #[arg(long, short)]
    pub quiet: bool,
}

impl OutputArguments {
    /// Claims the folder without touching its content. It may replace a result of the same command and origin.
    pub fn claim(
        &self,
        stem: &str,
        command: &str,
        origin: Origin,
    ) -> Result<CommandOutput, Failure> {
        self.claim_in(self.out.as_deref(), (stem, command), origin)
    }

    /// Claims the folder of a command with one main file, of which `--out` may ask for a copy: if that names a file of this kind, the
    /// folder is the default one.
    pub fn claim_with_copy(
        &self,
        stem: &str,
        command: &str,
        origin: Origin,
        kind: OwnedFileKind,
    ) -> Result<CommandOutput, Failure> {
        let is_file = |path: &&PathBuf| {
            path.extension().is_some_and(|found| found.eq_ignore_ascii_case(kind.extension))
        };
        let Some(path) = self.out.as_ref().filter(is_file) else {
            return self.claim(stem, command, origin);
        };
        if !self.force {
            kind.check(path)?;
        }
        let output = self.claim_in(None, (stem, command), origin)?;
        Ok(CommandOutput { copy: Some((kind, path.clone())), ..output })
    }

    fn claim_in(
        &self,
        out: Option<&Path>,
        (stem, command): (&str, &str),
        origin: Origin,
    ) -> Result<CommandOutput, Failure> {
        let folder = format!("{stem}_{command}");
        let place = ResultPath::choose(out, &folder, &origin, self.force);
        let longest_name = "liggghts_coeff_restitution.in.tmp";
        let made_from = origin.made_from().to_string();
        let folder = ResultFolder::claim(&place.out, longest_name, origin, self.force)?;
        let files = vec![format!("{command}.json")];
        let (quiet, json) = (self.quiet, self.json);
        let (main, copy, missing) = (None, None, None);
        Ok(CommandOutput { folder, made_from, place, files, missing, main, copy, quiet, json })
    }
}

/// A claimed folder and the names of its files, the first of which is written last.
#[derive(Debug)]
pub struct CommandOutput {
    folder: ResultFolder,
    made_from: String,
    place: ResultPath,
    files: Vec<String>,
    /// The reason why the first file that is missing could not be written.
    missing: Option<String>,
    /// The content of the first file after the JSON file.
    main: Option<Vec<u8>>,
    /// A file beside the folder that has it too.
    copy: Option<(OwnedFileKind, PathBuf)>,
    quiet: bool,
    json: bool,
}

impl CommandOutput {
    /// Writes a file. One that cannot be written is reported by [`CommandOutput::publish`].
    pub fn write(&mut self, name: &str, bytes: impl AsRef<[u8]>) {
        let bytes = bytes.as_ref();
        self.main.get_or_insert_with(|| bytes.to_vec());
        match self.try_write(name, bytes) {
            Ok(()) => self.files.push(name.to_string()),
            Err(error) => self.lacks(name, &error),
        }
    }

    fn try_write(&self, name: &str, bytes: &[u8]) -> io::Result<()> {
        let folder = self.folder.path();
        write_whole(&folder.join(name), folder, bytes)
    }

    fn lacks(&mut self, name: &str, error: &io::Error) {
        self.missing.get_or_insert_with(|| format!("{name} cannot be written: {}", cause(error)));
    }

    pub fn write_table(
        &mut self,
        name: &str,
        header: &[&str],
        rows: impl IntoIterator<Item = impl AsRef<[Option<f64>]>>,
    ) {
        let mut text = header.join(",") + "\n";
        for row in rows {
            let cells =
                row.as_ref().iter().map(|value| value.map_or(String::new(), |v| format!("{v:?}")));
            text += &(cells.collect::<Vec<_>>().join(",") + "\n");
        }
        self.write(name, text);
    }

    /// Writes the numbers, moves all files to their place, and prints the numbers, or `text`, which may name files that are kept, and
    /// the path of that place. A result that lacks files does not replace another one.
    pub fn publish(
        mut self,
        numbers: &impl Serialize,
        text: impl FnOnce(&KeptFiles) -> String,
    ) -> Result<(), Failure> {
        let name = self.files.remove(0);
        let mut numbers = serde_json::to_value(numbers).map_err(|error| unwritten(&name, error))?;
        numbers["program"] = json!(PROGRAM);
        numbers["version"] = json!(env!("CARGO_PKG_VERSION"));
        numbers["made_from"] = json!(self.made_from);
        numbers["source"] = json!(self.folder.source());
        let json = self.write_numbers(&name, &mut numbers);
        let Self { folder, place, files, missing, main, copy, quiet, json: is_json, .. } = self;
        let placed = match files.is_empty() {
            true => Ok(None),
            false => folder.publish(missing.is_none()).map(Some),
        };
        let copied = match copy.as_ref().zip(main) {
            Some(((kind, path), bytes)) => kind.replace(path, &bytes),
            None => Ok(String::new()),
        };
        let mut kept = KeptFiles { folder: placed.as_ref().ok().cloned().flatten(), files };
        if is_json {
            standard_output::print(&json)?;
        } else if !quiet {
            let copied = copied.as_ref().map_or("", String::as_str);
            let result = match &placed {
                Ok(Some(found)) => shown(found) + &place.note(),
                _ => "not written".to_string(),
            };
            standard_output::print(&format!("{}\n{copied}Result: {result}\n", text(&kept)))?;
        }
        placed?;
        kept.files.extend(copied.is_ok().then(|| copy.map(|(_, path)| shown(&path))).flatten());
        missing.map_or(Ok(()), |missing| Err(incomplete(missing, &kept.files)))?;
        copied.map(drop)
    }

    /// Writes the file of the numbers, with the names of all files, and returns its text. If there is no room for it, it gets that of
    /// the other files; if it cannot be written at all, there are no files.
    fn write_numbers(&mut self, name: &str, numbers: &mut Value) -> String {
        loop {
            let others = std::mem::take(&mut self.files);
            self.files = std::iter::once(name.to_string()).chain(others).collect();
            numbers["files"] = json!(self.files);
            let json = format!("{numbers:#}\n");
            let Err(error) = self.try_write(name, json.as_bytes()) else { return json };
            self.lacks(name, &error);
            let others = self.files.split_off(1);
            self.files.clear();
            if others.is_empty() {
                return json;
            }
            for other in others {
                let _ = std::fs::remove_file(self.folder.path().join(other));
            }
        }
    }
}

/// The files of a result that could be written.
#[derive(Debug)]
pub struct KeptFiles {
    folder: Option<PathBuf>,
    files: Vec<String>,
}

impl KeptFiles {
    /// Returns the folder of the files, if any is kept.
    pub fn folder(&self) -> Option<&Path> {
        self.folder.as_deref()
    }

    /// Returns the path of a file as the user would name it, if it is kept.
    pub fn path(&self, name: &str) -> Option<PathBuf> {
        let folder = self.folder.as_ref()?;
        self.files.iter().any(|file| file == name).then(|| folder.join(name))
    }
}

/// Returns the failure of a result that lacks files.
fn incomplete(missing: String, files: &[String]) -> Failure {
    let kept = match files.is_empty() {
        true => "nothing was kept, and an older result is unchanged".to_string(),
        false => format!("kept: {}", files.join(", ")),
    };
    Failure::failed(missing).with_help(kept)
}

fn unwritten(name: &str, error: impl std::fmt::Display) -> Failure {
    Failure::failed(format!("{name} cannot be written: {error}"))
}
