//! Feeds damaged inputs to readers; see the library.
//!
//! `fem-fuzz TARGET N [SEED]` feeds N inputs, `fem-fuzz all N` distributes them over all targets, and `fem-fuzz TARGET
//! =INPUT [SEED]` writes one input to the standard output and feeds it. `FEM_RUN` is the path of the command for the target
//! `command`.

#![allow(
    clippy::disallowed_methods,
    clippy::disallowed_macros,
    reason = "a program that uses clock and terminal"
)]

use std::io::Write;
use std::path::PathBuf;
use std::process::ExitCode;
use std::thread::available_parallelism;
use std::time::{Duration, Instant};

use fem_fuzz::{TARGETS, bounds, input_of, try_inputs};

#[global_allocator]
static ALLOCATOR: bounds::Counting = bounds::Counting;

/// Memory that the process may use in addition to the targets, bytes.
const MEMORY: i64 = 1_500_000_000;
const LONGEST: Duration = Duration::from_secs(120);
/// Number of findings that are shown per target.
const SHOWN: usize = 20;

fn main() -> ExitCode {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let words: Vec<&str> = arguments.iter().map(String::as_str).collect();
    let (name, wanted, seed) = match words[..] {
        [name, wanted] => (name, wanted, Some(1)),
        [name, wanted, seed] => (name, wanted, seed.parse().ok()),
        _ => return usage(),
    };
    let (only, n) = match wanted.strip_prefix('=') {
        Some(input) => (true, input.parse()),
        None => (false, wanted.parse()),
    };
    let (Ok(n), Some(seed)) = (n, seed) else { return usage() };
    if name != "all" && TARGETS.iter().all(|target| target.name != name) {
        return usage();
    }
    let command =
        std::env::var_os("FEM_RUN").map_or("target/release/fem-run".into(), PathBuf::from);
    let command = command.canonicalize().unwrap_or(command);
    let mut is_sound = true;
    for entry in TARGETS.iter().filter(|target| name == "all" || target.name == name) {
        let inputs = match (only, name) {
            (true, _) => n..n + 1,
            (false, "all") => 0..n * entry.share / 100,
            (false, _) => 0..n,
        };
        let (known, target) = (entry.name, (entry.make)(&command));
        bounds::limit_memory(MEMORY);
        if only {
            let _ = std::io::stdout().write_all(&input_of(&*target, seed, n));
        }
        let threads = available_parallelism().map_or(1, |n| n.get().min(3));
        let begin = Instant::now();
        let counts = try_inputs(&*target, seed, inputs, threads, LONGEST);
        for finding in counts.findings.iter().take(SHOWN) {
            eprintln!("{known} ={} {seed}: {}", finding.input, finding.words);
        }
        let (input, took) = counts.slowest;
        eprintln!(
            "{known}: {} accepted, {} rejected, {} findings; {:.0} s, the slowest {took:.1?} (={input})",
            counts.accepted,
            counts.rejected,
            counts.findings.len(),
            begin.elapsed().as_secs_f64(),
        );
        is_sound &= counts.findings.is_empty();
    }
    if is_sound { ExitCode::SUCCESS } else { ExitCode::FAILURE }
}

fn usage() -> ExitCode {
    let names: Vec<&str> = TARGETS.iter().map(|target| target.name).collect();
    eprintln!("fem-fuzz TARGET N|=INPUT [SEED]; targets: all {}", names.join(" "));
    ExitCode::from(2)
}
