//! From measured restitutions to a material that makes them: a contact law, a relaxation, a run.
//!
//! `cargo run --release -p fem --example calibrate`

#![allow(clippy::disallowed_macros, reason = "an example prints what it found")]

use std::error::Error;

use fem::calibrate::{Calibration, SettingNames, Settings};
use fem::laws::{ChosenLaw, LawFamily, LawFit};
use fem::measured::{Restitutions, Table};
use fem::schema::{BodyTable, MaterialTable, ModelTable};
use fem::{Case, CaseFile, collide};

/// A measurement; a column says its unit in its name.
const MEASURED: &str = "\
speed_cm_s, restitution, restitution_uncertainty
10, 0.898, 0.002
20, 0.911, 0.002
50, 0.925, 0.002
100, 0.935, 0.002
";

fn main() -> Result<(), Box<dyn Error>> {
    // Instantaneous moduli; what relaxes is to be found.
    let glass = MaterialTable::from_youngs_modulus_poissons_ratio("2.39 g/cm^3", "63 GPa", 0.244);
    let striker = BodyTable::sphere("striker", "22.2 mm", "glass").approaching("50 cm/s");
    let target = BodyTable::sphere("target", "15.9 mm", "glass");
    let case = Case::of(CaseFile::of_bodies(striker, target).with_material("glass", glass))?;
    let table = Table::parse("measured", MEASURED)?;
    let measured = Restitutions::read(&table, case.scene())?;

    // A spring and a dashpot of the overlap, as DEM codes have them.
    let law = ChosenLaw::of(&case, LawFamily::KuwabaraKono, &[], None)?;
    let fit = LawFit::of(&measured, law.problem(&measured.points, &["a"])?, 0.95)?;
    println!(
        "kuwabara_kono: a = {:.2e} s, rms {:.1} uncertainties",
        fit.fit.values[0], fit.fit.rms
    );

    // A Prony series of the material, and what the data leave open of it.
    let found = Calibration::of(&case, measured.into(), &Settings::default())?;
    for (time, weight) in found.times.iter().zip(&found.fit.weight_ranges) {
        let (low, high) = (weight.low, weight.high);
        println!(
            "relaxation time {time:.1e} s: weight {:.3} ({low:.3} to {high:.3})",
            weight.value
        );
    }
    found.warnings(&SettingNames::default()).iter().for_each(|warning| println!("{warning}"));

    // The same spheres with what was found, by another model than the one that found it.
    let relaxing = case.edited(|file| {
        if let Some(glass) = file.material.get_mut(&found.target.material) {
            glass.relaxation = found.relaxation();
        }
        file.model = Some(ModelTable::ting());
    })?;
    let restitution = collide(&relaxing)?.restitution.unwrap_or(f64::NAN);
    println!("at 50 cm/s: measured 0.925, ting {restitution:.4}");
    Ok(())
}
