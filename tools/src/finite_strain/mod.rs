//! The influence of finite strain on collisions, the plan's estimate of it, and its convergence with the mesh. Writes
//! the tables of validation/finite_strain_tables.md and prints the numbers of the estimate,
//! `fem-simulation/src/effects/material/finite_strain/measured.rs`.
//!
//! `cargo run --release -p fem-tools -- finite_strain validation/finite_strain_tables.md`
//!
//! A second argument, `spheres`, `pairs` or `meshes`, selects one table. Widths and heights of pulses are those of
//! [`fem_validate::Pulse`].

mod collide;
mod meshes;
mod pairs;
mod spheres;

use crate::{Error, page};

/// Writes the tables into a page, or prints them.
pub fn run(words: &[String]) -> Result<(), Error> {
    let (path, only) = (words.first(), words.get(1));
    for (name, table) in [
        ("spheres", spheres::table as fn() -> _),
        ("pairs", pairs::table),
        ("meshes", meshes::table),
    ] {
        if only.is_some_and(|only| only != name) {
            continue;
        }
        let table: String = table().map_err(|fault| fault as Error)?;
        page::put_or_print(path, name, &table)?;
    }
    Ok(())
}
