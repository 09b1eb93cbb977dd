//! Spheres on a rigid wall with every law, from very small strain to a contact of 0.7 radii.

use rayon::prelude::*;

use super::collide::{Changes, Fault, Numbers, alike, signed, simulation, speed};

/// Contact radius over the sphere's radius, according to Hertz.
const STRAINS: [f64; 8] = [0.01, 0.05, 0.1, 0.2, 0.35, 0.5, 0.7, 0.85];
const POISSONS_RATIOS: [f64; 5] = [0.0, 0.2, 0.33, 0.45, 0.49];
/// The laws, as named in case files.
const LAWS: [&str; 4] = ["neo-hooke", "neo-hooke-ln", "hencky", "saint-venant-kirchhoff"];
const RADIUS: f64 = 0.01;
const DENSITY: f64 = 1000.0;
const YOUNGS_MODULUS: f64 = 1e7;

/// Returns the table for the default law; the numbers of all laws are printed for `measured.rs`.
pub fn table() -> Result<String, Fault> {
    let scenes: Vec<(f64, f64)> =
        POISSONS_RATIOS.iter().flat_map(|nu| STRAINS.map(|strain| (*nu, strain))).collect();
    let changes: Vec<Vec<Option<Changes>>> =
        scenes.par_iter().map(|(nu, strain)| changes(*nu, *strain)).collect::<Result<_, _>>()?;
    let mut table = "| ν | a/R | Δe | ΔT | ΔF | Δp₀ |\n|---|---|---|---|---|---|\n".to_string();
    for ((nu, strain), changes) in scenes.iter().zip(&changes) {
        let Some(it) = changes[0] else { continue };
        let shares = [it.time, it.force].map(|share| signed(100.0 * share, 2)).join(" | ");
        let (e, pressure) = (signed(it.restitution, 3), signed(100.0 * it.pressure, 1));
        table += &format!("| {nu} | {strain} | {e} | {shares} | {pressure} |\n");
    }
    for (law, name) in LAWS.iter().enumerate() {
        eprintln!("    // {name}\n    [");
        for row in changes.chunks(STRAINS.len()) {
            let cells: Vec<String> = row.iter().map(|changes| cell(changes[law])).collect();
            eprintln!("        [{}],", cells.join(", "));
        }
        eprintln!("    ],");
    }
    Ok(table)
}

/// Returns a cell as source code; `None` if the sphere collapsed.
fn cell(changes: Option<Changes>) -> String {
    let Some(Changes { restitution, time, force, pressure }) = changes else {
        return "None".to_string();
    };
    format!("Some([{restitution:.4}, {time:.5}, {force:.5}, {pressure:.4}])")
}

/// Returns the changes for each law.
fn changes(nu: f64, strain: f64) -> Result<Vec<Option<Changes>>, Fault> {
    let small = collide(nu, strain, None)?.ok_or("a run at small strain stopped")?;
    let with = |law: &&str| Ok(collide(nu, strain, Some(law))?.map(|with| with.against(&small)));
    LAWS.iter().map(with).collect()
}

fn collide(nu: f64, strain: f64, law: Option<&str>) -> Result<Option<Numbers>, Fault> {
    let mass = 4.0 / 3.0 * std::f64::consts::PI * DENSITY * RADIUS.powi(3);
    let modulus = YOUNGS_MODULUS / (1.0 - nu * nu);
    let text = format!(
        "[material.m]\ndensity = {DENSITY}\nyoungs_modulus = {YOUNGS_MODULUS}\n\
         poissons_ratio = {nu}\nhyperelastic = \"{}\"\n\
         [[body]]\nname = \"wall\"\nwall = {{}}\n\
         [[body]]\nname = \"ball\"\nsphere = {{ diameter = {} }}\nmaterial = \"m\"\n\
         approach_speed = {}\n[effects]\nfinite_strain = \"{}\"\n",
        law.unwrap_or(LAWS[0]),
        2.0 * RADIUS,
        speed(strain, [RADIUS, mass, modulus]),
        if law.is_some() { "on" } else { "off" },
    );
    Ok(Numbers::of(&simulation(&text, &alike(strain, RADIUS, nu))?))
}
