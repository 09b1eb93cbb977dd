//! What runs cost: an element update in the loops of all laws, whole processes, and where a run spends its
//! time. Writes the tables of docs/performance.md.
//!
//! `cargo build --release && cargo run --release -p fem-run --example performance -- docs/performance.md`
//!
//! Times are medians of turns that all take one after the other, so that what else the machine does meets
//! all, and stand beside those of plain code on the same elements in the same run.

#![allow(
    clippy::disallowed_macros,
    clippy::disallowed_methods,
    reason = "a benchmark has the clock and prints what it found"
)]

#[path = "../../fem-explicit/benches/bodies/mod.rs"]
mod bodies;
#[path = "performance/elements.rs"]
mod elements;
#[path = "page/mod.rs"]
mod page;
#[path = "../../fem-explicit/benches/plain/mod.rs"]
mod plain;
#[path = "performance/processes.rs"]
mod processes;
#[path = "performance/profile.rs"]
mod profile;

use std::path::Path;

use bodies::Error;

fn main() -> Result<(), Error> {
    let path = std::env::args().nth(1);
    let put = |name: &str, table: &str| -> Result<(), Error> {
        match &path {
            Some(path) => page::put(Path::new(path), name, table)?,
            None => println!("{table}"),
        }
        Ok(())
    };
    put("machine", &machine())?;
    put("elements", &elements::table()?)?;
    put("processes", &processes::table()?)?;
    put("profile", &profile::table()?)?;
    Ok(())
}

/// What kind of machine the times are of.
fn machine() -> String {
    #[cfg(target_arch = "x86_64")]
    let lanes = [
        ("AVX-512", std::arch::is_x86_feature_detected!("avx512f")),
        ("AVX2 and FMA", std::arch::is_x86_feature_detected!("avx2")),
    ];
    #[cfg(not(target_arch = "x86_64"))]
    let lanes: [(&str, bool); 0] = [];
    let lanes = lanes.into_iter().find_map(|(name, has)| has.then_some(name));
    let lanes = lanes.map_or(String::new(), |name| format!(" with {name}"));
    format!("On {}{lanes}, one thread.", std::env::consts::ARCH)
}

/// The middle one.
fn median(mut values: Vec<f64>) -> f64 {
    values.sort_by(f64::total_cmp);
    values.get(values.len() / 2).copied().unwrap_or(f64::NAN)
}
