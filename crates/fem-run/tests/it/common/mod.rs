//! Runs a program, [`crate::PROGRAM`], in a folder of its own.

#![allow(dead_code, reason = "no test file uses all of it")]

use std::ffi::{OsStr, OsString};
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
pub const FAILS: [&str; 3] = [
    "material.glass={density=2390, youngs_modulus=1e6, poissons_ratio=0.244}",
    "body.0.approach_speed=60",
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

    /// Returns a result without its cost, which the report page shows, and without its source: all other files as text or bytes, by
    /// name.
    pub fn result(&self, folder: &str) -> Vec<(String, Vec<u8>)> {
        let file = |name: String| {
            let path = format!("{folder}/{name}");
            if name != "summary.json" {
                return (name, self.read(path));
            }
            let mut summary = self.json(&path);
            for key in ["cost", "source"] {
                summary.as_object_mut().unwrap().remove(key).unwrap();
            }
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

    /// Returns the text of a file.
    pub fn text(&self, name: impl AsRef<Path>) -> String {
        String::from_utf8(self.read(name)).unwrap()
    }

    /// Returns the command, to be started in this folder.
    pub fn command(&self, words: impl Words) -> Command {
        let mut command = Command::new(crate::PROGRAM);
        command.current_dir(self.0.path()).args(words.words());
        command
    }

    /// Runs the command to its end.
    pub fn run(&self, words: impl Words) -> Ran {
        self.command(words).output().unwrap().into()
    }

    /// Runs the command, which must succeed.
    #[track_caller]
    pub fn succeed(&self, words: impl Words) -> Ran {
        self.fails(0, words)
    }

    /// Runs the command, which must end with this exit status.
    #[track_caller]
    pub fn fails(&self, code: i32, words: impl Words) -> Ran {
        let words = words.words();
        let ran: Ran = self.command(&words).output().unwrap().into();
        assert_eq!(ran.code, Some(code), "{words:?}: {}{}", ran.stdout, ran.stderr);
        ran
    }
}

impl Ran {
    /// Checks that stdout contains some texts, parted by `|`.
    #[track_caller]
    pub fn prints(&self, expected: impl AsRef<str>) {
        for part in expected.as_ref().split('|') {
            assert!(self.stdout.contains(part), "stdout lacks {part}:\n{}", self.stdout);
        }
    }

    /// Checks that stderr contains some texts, parted by `|`.
    #[track_caller]
    pub fn tells(&self, expected: impl AsRef<str>) {
        for part in expected.as_ref().split('|') {
            assert!(self.stderr.contains(part), "stderr lacks {part}:\n{}", self.stderr);
        }
    }
}

/// The words of a command line: a text that is split at spaces outside of 'words in quotes', a list, or several of
/// these in a tuple.
pub trait Words {
    fn words(&self) -> Vec<OsString>;
}

impl Words for &str {
    fn words(&self) -> Vec<OsString> {
        let (mut words, mut rest) = (Vec::new(), self.trim_start());
        while !rest.is_empty() {
            let (text, end) = match rest.strip_prefix('\'') {
                Some(quoted) => (quoted, '\''),
                None => (rest, ' '),
            };
            let (word, after) = text.split_once(end).unwrap_or((text, ""));
            words.push(word.into());
            rest = after.trim_start();
        }
        words
    }
}

impl Words for &String {
    fn words(&self) -> Vec<OsString> {
        self.as_str().words()
    }
}

impl<S: AsRef<OsStr>> Words for &[S] {
    fn words(&self) -> Vec<OsString> {
        self.iter().map(|word| word.as_ref().to_os_string()).collect()
    }
}

impl<S: AsRef<OsStr>> Words for &Vec<S> {
    fn words(&self) -> Vec<OsString> {
        self.as_slice().words()
    }
}

impl Words for Vec<&str> {
    fn words(&self) -> Vec<OsString> {
        self.as_slice().words()
    }
}

impl<S: AsRef<OsStr>, const N: usize> Words for &[S; N] {
    fn words(&self) -> Vec<OsString> {
        self.as_slice().words()
    }
}

impl<S: AsRef<OsStr>, const N: usize> Words for [S; N] {
    fn words(&self) -> Vec<OsString> {
        self.as_slice().words()
    }
}

impl<A: Words, B: Words> Words for (A, B) {
    fn words(&self) -> Vec<OsString> {
        [self.0.words(), self.1.words()].concat()
    }
}

impl<A: Words, B: Words, C: Words> Words for (A, B, C) {
    fn words(&self) -> Vec<OsString> {
        [self.0.words(), self.1.words(), self.2.words()].concat()
    }
}

impl<A: Words, B: Words, C: Words, D: Words> Words for (A, B, C, D) {
    fn words(&self) -> Vec<OsString> {
        [self.0.words(), self.1.words(), self.2.words(), self.3.words()].concat()
    }
}

#[track_caller]
pub fn number(value: &serde_json::Value) -> f64 {
    value.as_f64().unwrap_or_else(|| panic!("{value} is no number"))
}

/// Returns the options that set these keys.
pub fn set<'a>(overrides: &[&'a str]) -> Vec<&'a str> {
    overrides.iter().flat_map(|value| ["--set", value]).collect()
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
