//! The command: its exit status, messages and written files.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Child, Command as Process, Output, Stdio};
use std::thread::sleep;
use std::time::{Duration, Instant};

use super::{cases, files, root};
use crate::mutate::{Random, change_text};
use crate::trial::{Taken, Target};

const LONGEST: Duration = Duration::from_secs(60);
/// Limit of the address space of the process, kB.
const MEMORY: &str = "4000000";
/// Commands that read a case.
const READING_A_CASE: [&[&str]; 5] = [
    &["check", "in.toml"],
    &["in.toml", "--out", "result", "--set", "limits.element_updates=3e6"],
    &["mesh", "in.toml", "--out", "meshes", "--set", "limits.elements=3000"],
    &["in.toml", "--out", "result", "--set", "model.ting={}", "--json"],
    &["invert", "in.toml", "--restitution", "0.9", "--law", "tsuji"],
];
/// Commands that read a table of data.
const READING_DATA: [&[&str]; 3] = [
    &["fit", "glass.toml", "--data", "in.csv", "--law", "kuwabara_kono", "--out", "result"],
    &[
        "cradle",
        "--length",
        "20 cm",
        "--diameters",
        "22.2 mm,15.9 mm",
        "--data",
        "in.csv",
        "--out",
        "result",
    ],
    // Each further term takes a second for the largest table.
    &[
        "calibrate",
        "glass.toml",
        "--data",
        "in.csv",
        "--model",
        "ting",
        "--terms",
        "2",
        "--out",
        "result",
    ],
];

pub struct Command {
    path: PathBuf,
    cases: Vec<Vec<u8>>,
    data: Vec<Vec<u8>>,
    glass: Vec<u8>,
}

impl Command {
    pub fn new(path: &Path) -> Self {
        let data = files("validation/data", "csv").into_iter().map(|(_, text)| text).collect();
        let glass = fs::read(root().join("cases/glass_0.5ms.toml")).unwrap_or_default();
        Self { path: path.to_path_buf(), cases: cases(), data, glass }
    }
}

impl Target for Command {
    /// Returns one byte for the command, and the text that it reads.
    fn make(&self, random: &mut Random) -> Vec<u8> {
        let which = random.below(READING_A_CASE.len() + READING_DATA.len());
        let seeds = if which < READING_A_CASE.len() { &self.cases } else { &self.data };
        let mut text = seeds[random.below(seeds.len())].clone();
        change_text(&mut text, seeds, random);
        text.insert(0, which as u8);
        text
    }

    fn take(&self, input: &[u8]) -> Result<Taken, String> {
        let Some((which, text)) = input.split_first() else { return Ok(Taken::Rejected) };
        let all: Vec<&[&str]> = READING_A_CASE.into_iter().chain(READING_DATA).collect();
        let arguments = all[usize::from(*which) % all.len()];
        let folder = tempfile::tempdir().map_err(|error| error.to_string())?;
        let given = ["in.toml", "in.csv", "glass.toml"];
        for (name, bytes) in given.iter().zip([text, text, &self.glass]) {
            fs::write(folder.path().join(name), bytes).map_err(|error| error.to_string())?;
        }
        let output = self.run(folder.path(), arguments)?;
        let said = String::from_utf8_lossy(&output.stderr).to_string();
        let written = fs::read_dir(folder.path()).map_err(|error| error.to_string())?.flatten();
        let written: Vec<_> = written.map(|entry| entry.file_name()).collect();
        match output.status.code() {
            Some(0) => Ok(Taken::Accepted),
            Some(_) if said.contains("panicked") || said.trim().is_empty() => Err(said),
            Some(1) => Ok(Taken::Rejected),
            Some(2) if written.len() == given.len() => Ok(Taken::Rejected),
            Some(2) => Err(format!("bad input, and there is {written:?}\n{said}")),
            _ => Err(format!("{}\n{said}", output.status)),
        }
    }
}

impl Command {
    fn run(&self, folder: &Path, arguments: &[&str]) -> Result<Output, String> {
        let child = Process::new("sh")
            .args(["-c", &format!("ulimit -v {MEMORY}; exec \"$0\" \"$@\"")])
            .arg(&self.path)
            .args(arguments)
            .current_dir(folder)
            .env("RAYON_NUM_THREADS", "1")
            .stdin(Stdio::null())
            .stdout(Stdio::null())
            .stderr(Stdio::piped())
            .spawn();
        let mut child = child.map_err(|error| format!("{}: {error}", self.path.display()))?;
        wait(&mut child)?;
        child.wait_with_output().map_err(|error| error.to_string())
    }
}

/// Waits for a process and ends it after a time limit.
fn wait(child: &mut Child) -> Result<(), String> {
    let begin = Instant::now();
    while child.try_wait().map_err(|error| error.to_string())?.is_none() {
        if begin.elapsed() > LONGEST {
            let _ = child.kill();
            return Err(format!("it takes more than {LONGEST:?}"));
        }
        sleep(Duration::from_millis(1));
    }
    Ok(())
}
