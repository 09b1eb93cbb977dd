//! The result folder of a fit, a calibration, an export, a cradle, a record or a study of accuracy: `<command>.json`, which
//! identifies it, and other files.

use std::path::{Path, PathBuf};

use fem::results::PROGRAM;
use serde::Serialize;
use serde_json::json;

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
    #[arg(long, value_name = "DIR")]
    pub out: Option<PathBuf>,
    /// Replace any other result
    #[arg(long)]
    pub force: bool,
    /// Print nothing but errors and warnings
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
        let folder = format!("{stem}_{command}");
        let place = ResultPath::choose(self.out.as_deref(), &folder, &origin, self.force);
        let longest_name = "liggghts_coeff_restitution.in.tmp";
        let made_from = origin.made_from().to_string();
        let folder = ResultFolder::claim(&place.out, longest_name, origin, self.force)?;
        let (files, quiet) = (vec![format!("{command}.json")], self.quiet);
        Ok(CommandOutput { folder, made_from, place, files, quiet })
    }
}

/// A claimed folder and the names of its files, the first of which is written last.
#[derive(Debug)]
pub struct CommandOutput {
    folder: ResultFolder,
    made_from: String,
    place: ResultPath,
    files: Vec<String>,
    quiet: bool,
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

    /// Writes the numbers, moves all files to their place, and prints `text` and the path of that place.
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
        self.write(&name, format!("{numbers:#}\n"))?;
        let place = self.folder.publish(true)?;
        if self.quiet {
            return Ok(());
        }
        standard_output::print(&format!(
            "{}\nResult: {}{}\n",
            text(),
            shown(&place),
            self.place.note()
        ))
    }
}

fn unwritten(name: &str, error: impl std::fmt::Display) -> Failure {
    Failure::failed(format!("{name} cannot be written: {error}"))
}
