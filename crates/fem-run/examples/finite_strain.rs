//! What finite strain changes of a collision: spheres on a rigid wall, with and without it. Prints the
//! numbers that the plan foretells from, and the same as a table of docs/finite-strain.md.
//!
//! `cargo run --release -p fem-run --example finite_strain`

#![allow(clippy::disallowed_macros, reason = "an example prints what it found")]

use std::path::Path;

use fem::{Case, Collision, Row, Simulation};

/// Contact radius over the sphere's radius, as Hertz foretells it.
const STRAINS: [f64; 7] = [0.01, 0.05, 0.1, 0.2, 0.35, 0.5, 0.7];
const POISSONS_RATIOS: [f64; 5] = [0.0, 0.2, 0.33, 0.45, 0.49];
/// As case files name them.
const LAWS: [&str; 4] = ["neo-hooke", "neo-hooke-ln", "hencky", "saint-venant-kirchhoff"];
const RADIUS: f64 = 0.01;
const DENSITY: f64 = 1000.0;
const YOUNGS_MODULUS: f64 = 1e7;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    println!("| law | ν | a/R | Δe | ΔT/T | ΔF/F | Δp₀/p₀ |\n|---|---|---|---|---|---|---|");
    let mut numbers = vec![String::new(); LAWS.len()];
    for nu in POISSONS_RATIOS {
        let mut rows: Vec<Vec<[f64; 4]>> = vec![Vec::new(); LAWS.len()];
        for (k, strain) in STRAINS.into_iter().enumerate() {
            let small = collide(nu, strain, None)?;
            for (law, row) in LAWS.into_iter().zip(&mut rows) {
                let found = changes(&small, &collide(nu, strain, Some(law))?);
                let [e, time, force, pressure] = found.unwrap_or([f64::NAN; 4]);
                println!(
                    "| {law} | {nu} | {strain} | {e:+.4} | {:+.3} % | {:+.3} % | {:+.2} % |",
                    100.0 * time,
                    100.0 * force,
                    100.0 * pressure
                );
                row.push(match (found, k) {
                    (Some(_), _) | (None, 0) => [e, time, force, pressure],
                    // What collapses: of less strain in proportion.
                    (None, _) => row[k - 1].map(|change| change * strain / STRAINS[k - 1]),
                });
            }
        }
        for (row, lines) in rows.into_iter().zip(&mut numbers) {
            let row = row.into_iter().map(|[e, time, force, pressure]| {
                format!("[{e:.4}, {time:.5}, {force:.5}, {pressure:.4}]")
            });
            lines.push_str(&format!("        [{}],\n", row.collect::<Vec<_>>().join(", ")));
        }
    }
    for (law, lines) in LAWS.into_iter().zip(numbers) {
        println!("    // {law}\n    [\n{lines}    ],");
    }
    Ok(())
}

/// Of the restitution, and shares of contact time, peak force and peak pressure on the axis;
/// none of a run that stopped.
fn changes(small: &Collision, finite: &Collision) -> Option<[f64; 4]> {
    let share = |with: Option<f64>, without: Option<f64>| Some(with? / without? - 1.0);
    let axis = |row: &Row| row.centre_pressure.unwrap_or_default();
    Some([
        finite.restitution? - small.restitution?,
        share(finite.contact_time, small.contact_time)?,
        share(peak(finite, |row| row.contact_force), peak(small, |row| row.contact_force))?,
        share(peak(finite, axis), peak(small, axis))?,
    ])
}

/// The largest mean over a 64th of the contact time: springs that open and close scatter about it.
fn peak(collision: &Collision, value: fn(&Row) -> f64) -> Option<f64> {
    let half = collision.contact_time? / 128.0;
    let rows = &collision.history;
    let means = rows.iter().map(|row| {
        let near = rows.iter().filter(|other| (other.time - row.time).abs() <= half);
        let (sum, n) = near.fold((0.0, 0.0), |(sum, n), row| (sum + value(row), n + 1.0));
        sum / n
    });
    means.fold(None, |largest, mean| Some(largest.map_or(mean, |largest: f64| largest.max(mean))))
}

fn collide(
    nu: f64,
    strain: f64,
    law: Option<&str>,
) -> Result<Collision, Box<dyn std::error::Error>> {
    let text = format!(
        "[material.m]\ndensity = \"{DENSITY} kg/m^3\"\nyoungs_modulus = \"{YOUNGS_MODULUS} Pa\"\n\
         poissons_ratio = {nu}\nhyperelastic = \"{}\"\n\
         [[body]]\nname = \"wall\"\nwall = {{}}\n\
         [[body]]\nname = \"ball\"\nsphere = {{ diameter = \"{} m\" }}\nmaterial = \"m\"\n\
         approach_speed = \"{} m/s\"\n\
         [model.fem]\n[output]\nsnapshots = []\n[effects]\nfinite_strain = \"{}\"\n",
        law.unwrap_or(LAWS[0]),
        2.0 * RADIUS,
        speed(nu, strain),
        if law.is_some() { "on" } else { "off" },
    );
    let case = Case::parse("sphere.toml", &text, Path::new("."), &[])?;
    let collision = Simulation::new(case)?.run(&mut ());
    if collision.restitution.is_none() {
        eprintln!("{law:?} nu {nu} a/R {strain}: {:?}", collision.ending);
    }
    Ok(collision)
}

/// At which Hertz' contact radius is this share of the sphere's, m/s:
/// (a/R)⁵ = (δ/R)^(5/2) = 15 m v²/(16 E* R³).
fn speed(nu: f64, strain: f64) -> f64 {
    let modulus = YOUNGS_MODULUS / (1.0 - nu * nu);
    let mass = 4.0 / 3.0 * std::f64::consts::PI * DENSITY;
    (strain.powi(5) * 16.0 * modulus / (15.0 * mass)).sqrt()
}
