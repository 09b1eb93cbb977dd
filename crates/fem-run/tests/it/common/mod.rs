//! Runs the command in a folder of its own.

#![allow(dead_code, reason = "no test file uses all of it")]

use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};

use tempfile::TempDir;

/// The elastic glass pair on a mesh so coarse that a run takes a fraction of a second.
pub const CASE: &str = r#"title = "A pair"

[material.glass]
density = "2390 kg/m^3"
youngs_modulus = "63 GPa"
poissons_ratio = 0.244

[material.glass.relaxation]
acts_on = "all"
terms = [{ weight = 1.0, decay_rate = "2708 1/s" }]

[[body]]
name = "striker"
sphere = { diameter = "22.2 mm" }
material = "glass"
approach_speed = "0.5 m/s"

[[body]]
name = "target"
sphere = { diameter = "15.9 mm" }
material = "glass"

[mesh]
contact_element_size = "90 um"
"#;

/// Overrides that make [`CASE`] soft and fast: the contact outgrows the sphere, and the run fails.
pub const FAILS: [&str; 6] = [
    "--set",
    "material.glass={density=2390, youngs_modulus=1e6, poissons_ratio=0.244}",
    "--set",
    "body.0.approach_speed=60",
    "--set",
    "mesh.contact_element_size=0.5e-3",
];

/// A folder with `case.toml` in which the command runs.
pub struct Place(TempDir);

/// The end of a command.
pub struct Ran {
    pub code: Option<i32>,
    pub stdout: String,
    pub stderr: String,
}

impl Place {
    /// Creates a folder with [`CASE`] as `case.toml`.
    pub fn new() -> Self {
        Self::with(CASE)
    }

    /// Creates a folder with `case` as `case.toml`.
    pub fn with(case: &str) -> Self {
        let place = Self(TempDir::new().unwrap());
        place.write("case.toml", case);
        place
    }

    pub fn path(&self, name: impl AsRef<Path>) -> PathBuf {
        self.0.path().join(name)
    }

    pub fn write(&self, name: &str, text: &str) {
        fs::write(self.path(name), text).unwrap();
    }

    pub fn read(&self, name: impl AsRef<Path>) -> Vec<u8> {
        let path = self.path(name);
        fs::read(&path).unwrap_or_else(|error| panic!("{}: {error}", path.display()))
    }

    pub fn json(&self, name: &str) -> serde_json::Value {
        serde_json::from_slice(&self.read(name)).unwrap()
    }

    /// Returns a result without its cost, which the report page shows: all other files as text or bytes, by
    /// name.
    pub fn result(&self, folder: &str) -> Vec<(String, Vec<u8>)> {
        let file = |name: String| {
            let path = format!("{folder}/{name}");
            if name != "summary.json" {
                return (name, self.read(path));
            }
            let mut summary = self.json(&path);
            summary.as_object_mut().unwrap().remove("cost").unwrap();
            (name, summary.to_string().into_bytes())
        };
        self.list(folder).into_iter().filter(|name| name != "report.html").map(file).collect()
    }

    /// Returns the sorted names in a folder, including hidden ones.
    pub fn list(&self, name: &str) -> Vec<String> {
        let entries = fs::read_dir(self.path(name)).unwrap();
        let mut names: Vec<String> =
            entries.map(|entry| entry.unwrap().file_name().into_string().unwrap()).collect();
        names.sort();
        names
    }

    /// Returns the command, to be started in this folder.
    pub fn command<S: AsRef<std::ffi::OsStr>>(&self, arguments: &[S]) -> Command {
        let mut command = Command::new(env!("CARGO_BIN_EXE_fem-run"));
        command.current_dir(self.0.path()).args(arguments);
        command
    }

    /// Runs the command to its end.
    pub fn run<S: AsRef<std::ffi::OsStr>>(&self, arguments: &[S]) -> Ran {
        self.command(arguments).output().unwrap().into()
    }

    /// Runs the command, which must succeed.
    pub fn succeed<S: AsRef<std::ffi::OsStr>>(&self, arguments: &[S]) -> Ran {
        let ran = self.run(arguments);
        assert_eq!(ran.code, Some(0), "{}", ran.stderr);
        ran
    }
}

impl From<Output> for Ran {
    fn from(output: Output) -> Self {
        Self {
            code: output.status.code(),
            stdout: String::from_utf8(output.stdout).unwrap(),
            stderr: String::from_utf8(output.stderr).unwrap(),
        }
    }
}
