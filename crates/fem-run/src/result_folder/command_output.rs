//! The result folder of a fit, a calibration, an export, a cradle or a study of accuracy: `<command>.json`, which
//! identifies it, and other files.

use std::path::PathBuf;

use fem::digest_of;
use fem::results::PROGRAM;
use serde::Serialize;
use serde_json::json;

use super::{OverwritePolicy, ResultFolder, ResultPath};
use crate::text::{Failure, shown, standard_output};

/// Options for the result folder of a command.
#[derive(clap::Args, Clone, Debug)]
pub struct OutputArguments {
    /// Folder for the result [default: in runs/, named after the input and the command]
    ///
    /// An existing folder is replaced only if it is empty or holds a result of the same command, case and
    /// data. Other files in it are kept. Without --out another result is kept too, and the files go into a
    /// new folder next to it.
    #[arg(long, value_name = "DIR")]
    pub out: Option<PathBuf>,
    /// Replace the result of another case or other data
    #[arg(long)]
    pub force: bool,
    /// Print nothing but errors and warnings
    #[arg(long, short)]
    pub quiet: bool,
}

impl OutputArguments {
    /// Claims the folder without touching its content. It may replace a result of the same command that was
    /// made from the same `inputs`, such as a case's identity and a file's path.
    pub fn claim(
        &self,
        stem: &str,
        command: &str,
        inputs: &[String],
    ) -> Result<CommandOutput, Failure> {
        let inputs = inputs.iter().map(String::as_bytes);
        let made_from = digest_of(std::iter::once(command.as_bytes()).chain(inputs));
        let replaces = OverwritePolicy::only(&made_from, self.force);
        let folder = format!("{stem}_{command}");
        let place = ResultPath::choose(self.out.as_deref(), &folder, &made_from, &replaces);
        let longest_name = "liggghts_coeff_restitution.in.tmp";
        let folder = ResultFolder::claim(&place.out, longest_name, replaces)?;
        let (files, quiet) = (vec![format!("{command}.json")], self.quiet);
        Ok(CommandOutput { folder, made_from, files, quiet })
    }
}

/// A claimed folder and the names of its files, the first of which is written last.
#[derive(Debug)]
pub struct CommandOutput {
    folder: ResultFolder,
    made_from: String,
    files: Vec<String>,
    quiet: bool,
}

impl CommandOutput {
    pub fn write(&mut self, name: &str, bytes: impl AsRef<[u8]>) -> Result<(), Failure> {
        self.files.push(name.to_string());
        std::fs::write(self.folder.path().join(name), bytes).map_err(|error| {
            unwritten(name, error)
                .with_help("nothing was kept; is the disk full? An older result is unchanged")
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
        numbers["files"] = std::iter::once(&name).chain(&self.files).cloned().collect();
        self.write(&name, format!("{numbers:#}\n"))?;
        let place = self.folder.publish(true)?;
        if self.quiet {
            return Ok(());
        }
        standard_output::print(&format!("{}\nResult: {}\n", text(), shown(&place)))
    }
}

fn unwritten(name: &str, error: impl std::fmt::Display) -> Failure {
    Failure::failed(format!("{name} cannot be written: {error}"))
}
