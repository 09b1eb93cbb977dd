//! The result folder of a fit, a calibration, an export, a cradle, a record or a study of accuracy: `<command>.json`, which
//! identifies it, and other files.

use std::path::{Path, PathBuf};

use fem::results::PROGRAM;
use serde::Serialize;
use serde_json::json;

use super::whole_file::OwnedFileKind;
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
        Ok(CommandOutput { folder, made_from, place, files, copy: None, quiet, json })
    }
}

/// A claimed folder and the names of its files, the first of which is written last.
#[derive(Debug)]
pub struct CommandOutput {
    folder: ResultFolder,
    made_from: String,
    place: ResultPath,
    files: Vec<String>,
    /// A file beside the folder that has the first file after the JSON file too.
    copy: Option<(OwnedFileKind, PathBuf)>,
    quiet: bool,
    json: bool,
}

impl CommandOutput {
    /// Returns the folder that the files will be in.
    pub fn place(&self) -> &Path {
        &self.place.out
    }

    pub fn write(&mut self, name: &str, bytes: impl AsRef<[u8]>) -> Result<(), Failure> {
        self.files.push(name.to_string());
        std::fs::write(self.folder.path().join(name), bytes).map_err(|error| {
            unwritten(name, error)
                .with_help("nothing was kept; is the disk full, or a quota or ulimit -f reached? An older result is unchanged")
        })
    }

    pub fn write_table(
        &mut self,
        name: &str,
        header: &[&str],
        rows: impl IntoIterator<Item = impl AsRef<[Option<f64>]>>,
    ) -> Result<(), Failure> {
        let mut text = header.join(",") + "\n";
        for row in rows {
            let cells =
                row.as_ref().iter().map(|value| value.map_or(String::new(), |v| format!("{v:?}")));
            text += &(cells.collect::<Vec<_>>().join(",") + "\n");
        }
        self.write(name, text)
    }

    /// Writes the numbers, moves all files to their place, and prints the numbers, or `text` and the path of that place.
    pub fn publish(
        mut self,
        numbers: &impl Serialize,
        text: impl FnOnce() -> String,
    ) -> Result<(), Failure> {
        let name = self.files.remove(0);
        let mut numbers = serde_json::to_value(numbers).map_err(|error| unwritten(&name, error))?;
        numbers["program"] = json!(PROGRAM);
        numbers["version"] = json!(env!("CARGO_PKG_VERSION"));
        numbers["made_from"] = json!(self.made_from);
        numbers["source"] = json!(self.folder.source());
        numbers["files"] = std::iter::once(&name).chain(&self.files).cloned().collect();
        let json = format!("{numbers:#}\n");
        self.write(&name, &json)?;
        let place = self.folder.publish(true)?;
        let copied = match (&self.copy, self.files.first()) {
            (Some((kind, path)), Some(main)) => {
                let bytes = std::fs::read(place.join(main));
                kind.replace(path, &bytes.map_err(|error| unwritten(main, error))?)?
            }
            _ => String::new(),
        };
        if self.json {
            return standard_output::print(&json);
        }
        if self.quiet {
            return Ok(());
        }
        let note = self.place.note();
        standard_output::print(&format!("{}\n{copied}Result: {}{note}\n", text(), shown(&place)))
    }
}

fn unwritten(name: &str, error: impl std::fmt::Display) -> Failure {
    Failure::failed(format!("{name} cannot be written: {error}"))
}
