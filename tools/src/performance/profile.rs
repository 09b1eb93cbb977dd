//! The phases of a run by time: samples of `perf`, grouped by the purpose of the functions.

use std::fmt::Write;
use std::path::Path;
use std::process::{Command, Stdio};

use super::bodies::Error;
use super::processes::command;

/// The phases and parts of their functions' names; the first match counts.
const PHASES: [(&str, &[&str]); 9] = [
    ("element forces and energies", &["run_row_lanes", "run_lanes", "run_wide_lanes"]),
    ("motion of nodes", &["advance_motion"]),
    ("relaxation", &["advance_branch", "start_effective", "prony"]),
    ("contact", &["fem_contact", "contact::"]),
    ("rows and accounts", &["ledger", "observed", "history", "centre"]),
    ("setup of meshes and models", &["fem_element", "fem_mesh", "time_step", "lumped"]),
    ("condensed reference run", &["fem_condensed", "faer", "gemm", "pulp"]),
    ("closed forms", &["fem_laws", "ieee754", "__exp", "__log", "__atan"]),
    ("files", &["zlib", "deflate", "base64", "adler", "fem_vtk", "ryu", "Display", "fmt"]),
];
const RUNS: usize = 5;
const CASES: [(&str, &str); 2] = [("glass_0.5ms", "default"), ("glass_0.5ms_14um", "paper's mesh")];

/// Returns the shares of a case in % of all samples, with the kernel and the rest last.
fn shares(case: &str) -> Result<Option<Vec<f64>>, Error> {
    let scratch = tempfile::tempdir()?;
    let (samples, out) = (scratch.path().join("samples"), scratch.path().join("out"));
    let case = Path::new(env!("CARGO_MANIFEST_DIR")).join(format!("../cases/{case}.toml"));
    let mut shares = vec![0.0; PHASES.len() + 2];
    for _ in 0..RUNS {
        let recorded = Command::new("perf")
            .args(["record", "-F", "5000", "-o"])
            .arg(&samples)
            .arg(command()?)
            .arg(&case)
            .arg("--out")
            .arg(&out)
            .stdout(Stdio::null())
            .stderr(Stdio::null())
            .status();
        if !recorded.is_ok_and(|status| status.success()) {
            return Ok(None);
        }
        let report = Command::new("perf")
            .args(["report", "--stdio", "--percent-limit", "0", "--sort", "dso,symbol", "-i"])
            .arg(&samples)
            .output()?;
        for line in String::from_utf8_lossy(&report.stdout).lines() {
            let Some((share, name)) = line.trim().split_once('%') else { continue };
            let Ok(share) = share.parse::<f64>() else { continue };
            let fits = |(_, parts): &(_, &[&str])| parts.iter().any(|part| name.contains(part));
            let phase = match name.contains("[k]") {
                true => PHASES.len(),
                false => PHASES.iter().position(fits).unwrap_or(PHASES.len() + 1),
            };
            shares[phase] += share / RUNS as f64;
        }
    }
    Ok(Some(shares))
}

/// Returns the table, one row per phase, or why there is none.
pub fn table() -> Result<String, Error> {
    let mut columns = Vec::new();
    for (case, _) in CASES {
        match shares(case)? {
            Some(shares) => columns.push(shares),
            None => return Ok("`perf` is not there, or may not sample here.".into()),
        }
    }
    let mut table = String::from("| share of the process |");
    CASES.iter().for_each(|(case, name)| table += &format!(" {name}, `{case}` |"));
    write!(table, "\n|---|{}", "---|".repeat(CASES.len()))?;
    let names = PHASES.iter().map(|(name, _)| *name);
    let rest = ["operating system: pages, start, end, files", "other"];
    for (k, name) in names.chain(rest).enumerate() {
        write!(table, "\n| {name} |")?;
        columns.iter().for_each(|shares| table += &format!(" {:.0} % |", shares[k]));
    }
    Ok(table)
}
