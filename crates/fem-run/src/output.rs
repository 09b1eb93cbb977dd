//! The folder of a fit, a calibration, an export or a cradle: `<name>.json`, by which it is known, and files beside.

use std::path::PathBuf;

use serde::Serialize;
use serde_json::json;

use crate::failure::Failure;
use crate::place::ResultPlace;
use crate::result_folder::{Replaces, ResultFolder};
use crate::standard_output::one_line;
use fem::digest_of;
use fem::results::PROGRAM;

/// Where results go.
#[derive(clap::Args, Clone, Debug)]
pub struct OutputArguments {
    /// Folder for the result [default: in runs/, named after the input and the command]
    ///
    /// An existing folder is replaced only if it is empty or the result of the same command, case and
    /// data. Files of your own in it are kept. Without --out another result is left alone too: then
    /// the files go into a folder beside it.
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
    /// Claims the folder; nothing in it is touched yet. A result of the same command that was made of
    /// the same inputs, a case's identity or a file's path, is replaced.
    ///
    /// # Errors
    /// A place that cannot be written, or that holds something else.
    pub fn claim(&self, stem: &str, command: &str, inputs: &[&str]) -> Result<Output, Failure> {
        let inputs = inputs.iter().map(|input| input.as_bytes());
        let made_from = digest_of(std::iter::once(command.as_bytes()).chain(inputs));
        let replaces = Replaces::only(&made_from, self.force);
        let name = format!("{stem}_{command}");
        let place = ResultPlace::of(self.out.as_deref(), &name, &made_from, &replaces);
        let longest_name = "liggghts_coeff_restitution.in.tmp";
        let folder = ResultFolder::claim(&place.out, longest_name, replaces)?;
        Ok(Output { folder, made_from, mark: format!("{command}.json"), files: Vec::new() })
    }
}

/// A claimed folder.
#[derive(Debug)]
pub struct Output {
    folder: ResultFolder,
    made_from: String,
    mark: String,
    files: Vec<String>,
}

impl Output {
    /// Writes a file.
    ///
    /// # Errors
    /// The file system.
    pub fn write(&mut self, name: &str, bytes: impl AsRef<[u8]>) -> Result<(), Failure> {
        std::fs::write(self.folder.path().join(name), bytes).map_err(|error| {
            Failure::failed(format!("{name} cannot be written: {error}"))
                .with_help("nothing was kept; is the disk full? An older result is where it was")
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

    /// Writes the numbers, puts all in its place and tells where that is.
    ///
    /// # Errors
    /// The file system.
    pub fn publish(mut self, numbers: &impl Serialize) -> Result<String, Failure> {
        let mut numbers = serde_json::to_value(numbers).map_err(|error| {
            Failure::failed(format!("{} cannot be written: {error}", self.mark))
        })?;
        let mark = self.mark.clone();
        let mut files = vec![mark.clone()];
        files.extend(self.files.iter().cloned());
        numbers["program"] = json!(PROGRAM);
        numbers["version"] = json!(env!("CARGO_PKG_VERSION"));
        numbers["made_from"] = json!(self.made_from);
        numbers["files"] = json!(files);
        self.write(&mark, format!("{numbers:#}\n"))?;
        Ok(one_line(&self.folder.publish(true)?.display().to_string()))
    }
}
