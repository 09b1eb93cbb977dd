//! The influence of finite strain on collisions, the plan's estimate of it, and its convergence with the mesh. Writes
//! the tables of validation/finite_strain_tables.md and prints the numbers of the estimate,
//! `fem-simulation/src/effects/material/finite_strain/measured.rs`.
//!
//! `cargo run --release -p fem-run --example finite_strain -- validation/finite_strain_tables.md`
//!
//! A second argument, `spheres`, `pairs` or `meshes`, selects one table. Widths and heights of pulses are those of
//! [`fem_validate::Pulse`].

#![allow(clippy::disallowed_macros, reason = "a study prints what it found")]

#[path = "finite_strain/collide.rs"]
mod collide;
#[path = "finite_strain/meshes.rs"]
mod meshes;
#[path = "page/mod.rs"]
mod page;
#[path = "finite_strain/pairs.rs"]
mod pairs;
#[path = "finite_strain/spheres.rs"]
mod spheres;

use std::path::Path;

fn main() -> Result<(), Box<dyn std::error::Error + Send + Sync>> {
    let mut words = std::env::args().skip(1);
    let path = words.next();
    let only = words.next();
    for (name, table) in [
        ("spheres", spheres::table as fn() -> _),
        ("pairs", pairs::table),
        ("meshes", meshes::table),
    ] {
        if only.as_ref().is_some_and(|only| only != name) {
            continue;
        }
        let table: String = table()?;
        match &path {
            Some(path) => page::put(Path::new(path), name, &table)?,
            None => print!("{table}"),
        }
    }
    Ok(())
}
