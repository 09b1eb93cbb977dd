//! The result folder of a fit, a calibration, an export, a cradle or a study of accuracy: `<command>.json`, which
//! identifies it, and other files.

use std::path::PathBuf;

use fem::digest_of;
use fem::results::PROGRAM;
use serde::Serialize;
use serde_json::json;

use super::{Replaces, ResultFolder, ResultPath};
use crate::text::failure::Failure;
use crate::text::standard_output::one_line;

/// Options for the result folder of a command.
#[derive(clap::Args, Clone, Debug)]
pub struct OutputArguments {
    /// Folder for the result [default: in runs/, named after the input and the command]
    ///
    /// An existing folder is replaced only if it is empty or the result of the same command, case and
    /// data. Files of your own in it are kept. Without --out, a folder with another result is left
    /// alone too, and the files go into a folder beside it.
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
    ///
    /// # Errors
    /// The place cannot be written, or holds something that may not be replaced.
    pub fn claim(
        &self,
        stem: &str,
        command: &str,
        inputs: &[&str],
    ) -> Result<CommandOutput, Failure> {
        let inputs = inputs.iter().map(|input| input.as_bytes());
        let made_from = digest_of(std::iter::once(command.as_bytes()).chain(inputs));
        let replaces = Replaces::only(&made_from, self.force);
        let name = format!("{stem}_{command}");
        let place = ResultPath::choose(self.out.as_deref(), &name, &made_from, &replaces);
        let longest_name = "liggghts_coeff_restitution.in.tmp";
        let folder = ResultFolder::claim(&place.out, longest_name, replaces)?;
        Ok(CommandOutput { folder, made_from, name: format!("{command}.json"), files: Vec::new() })
    }
}

/// A claimed folder and the names of the files written so far.
#[derive(Debug)]
pub struct CommandOutput {
    folder: ResultFolder,
    made_from: String,
    name: String,
    files: Vec<String>,
}

impl CommandOutput {
    /// Writes a file.
    ///
    /// # Errors
    /// The file system.
    pub fn write(&mut self, name: &str, bytes: impl AsRef<[u8]>) -> Result<(), Failure> {
        std::fs::write(self.folder.path().join(name), bytes).map_err(|error| {
            Failure::failed(format!("{name} cannot be written: {error}"))
                .with_help("nothing was kept; is the disk full? An older result is unchanged")
        })?;
        self.files.push(name.to_string());
        Ok(())
    }

    /// Writes a table.
    ///
    /// # Errors
    /// The file system.
    pub fn write_table(
        &mut self,
        name: &str,
        header: &[&str],
        rows: impl IntoIterator<Item = impl AsRef<[Option<f64>]>>,
    ) -> Result<(), Failure> {
        let failed = |error: &dyn std::fmt::Display| {
            Failure::failed(format!("{name} cannot be written: {error}"))
        };
        let mut writer = csv::Writer::from_writer(Vec::new());
        writer.write_record(header).map_err(|error| failed(&error))?;
        for row in rows {
            let cells =
                row.as_ref().iter().map(|value| value.map_or(String::new(), |v| format!("{v:?}")));
            writer.write_record(cells).map_err(|error| failed(&error))?;
        }
        let bytes = writer.into_inner().map_err(|error| failed(&error))?;
        self.write(name, bytes)
    }

    /// Writes the numbers, moves all files to their place and returns the path of that.
    ///
    /// # Errors
    /// The file system.
    pub fn publish(mut self, numbers: &impl Serialize) -> Result<String, Failure> {
        let name = self.name.clone();
        let mut numbers = serde_json::to_value(numbers)
            .map_err(|error| Failure::failed(format!("{name} cannot be written: {error}")))?;
        let mut files = vec![name.clone()];
        files.extend(self.files.iter().cloned());
        numbers["program"] = json!(PROGRAM);
        numbers["version"] = json!(env!("CARGO_PKG_VERSION"));
        numbers["made_from"] = json!(self.made_from);
        numbers["files"] = json!(files);
        self.write(&name, format!("{numbers:#}\n"))?;
        Ok(one_line(&self.folder.publish(true)?.display().to_string()))
    }
}
