//! The folder of a fit, a calibration, an export or a cradle: `<name>.json`, by which it is known, and files beside.

use std::path::{Path, PathBuf};

use serde::Serialize;
use serde_json::json;

use crate::failure::Failure;
use crate::result_folder::ResultFolder;
use crate::standard_output::one_line;
use fem::results::PROGRAM;

/// Where results go.
#[derive(clap::Args, Clone, Debug)]
pub struct OutputArguments {
    /// Folder for the result [default: in runs/, named after the input and the command]
    ///
    /// An existing folder is replaced only if it is empty or a result of fem-run. Files of your
    /// own in it are kept.
    #[arg(long, value_name = "DIR")]
    pub out: Option<PathBuf>,
    /// Print nothing but errors
    #[arg(long, short)]
    pub quiet: bool,
}

impl OutputArguments {
    /// Claims the folder; nothing in it is touched yet.
    ///
    /// # Errors
    /// A place that cannot be written, or that holds something else.
    pub fn claim(&self, stem: &str, command: &str) -> Result<Output, Failure> {
        let default = || Path::new("runs").join(format!("{stem}_{command}"));
        let out = self.out.clone().unwrap_or_else(default);
        let folder = ResultFolder::claim(&out, "liggghts_coeff_restitution.in.tmp")?;
        Ok(Output { folder, mark: format!("{command}.json"), files: Vec::new() })
    }
}

/// A claimed folder.
#[derive(Debug)]
pub struct Output {
    folder: ResultFolder,
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
        numbers["files"] = json!(files);
        self.write(&mark, format!("{numbers:#}\n"))?;
        Ok(one_line(&self.folder.publish()?.display().to_string()))
    }
}
