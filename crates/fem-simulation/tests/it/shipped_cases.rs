//! The cases of the repository: their models, effects and warnings.

use std::collections::BTreeSet;
use std::fs;
use std::path::{Path, PathBuf};

use fem_case::Case;
use fem_simulation::Simulation;

use crate::scene::decision_on;

/// Effects that explicit elements have in every scene.
const MESHED: [&str; 3] = ["hourglass control", "contact search", "mass scaling"];

/// The file name of a case without extension, its model, its active effects without [`MESHED`] (all others are off), and
/// words in the reasons of effects.
type Row = (&'static str, &'static str, &'static [&'static str], &'static [[&'static str; 2]]);

const RELAXES: &str = "viscoelasticity";
const ROWS: [Row; 20] = [
    ("glass_0.5ms", "fem", &[RELAXES], &[["mirror symmetry", "differ"]]),
    ("glass_0.5ms_14um", "fem", &[], &[]),
    ("glass_0.5ms_elastic", "fem", &[], &[]),
    ("glass_0.5ms_elastic_bulk", "fem", &[RELAXES], &[]),
    ("glass_on_wall", "fem", &[], &[]),
    ("ice_2cm", "fem", &["mirror symmetry"], &[]),
    (
        "glass_twins",
        "fem",
        &[RELAXES, "mirror symmetry"],
        &[["mirror symmetry", "one is computed"]],
    ),
    // The ratio is 3.4e-5: steel has E/(1 − ν²) = 231 GPa, rubber 7.9 MPa. β = (1 − 2ν)/(2 − 2ν) = 0.02 makes surface slip
    // negligible.
    (
        "steel_on_rubber",
        "condensed",
        &[RELAXES, "surface slip", "rigid partner"],
        &[
            ["rigid partner", "steel contributes 3.4e-3 % of the compliance"],
            ["surface slip", "= 0.0015"],
        ],
    ),
    (
        "ball_on_block",
        "fem",
        &["partner waves"],
        &[["partner waves", "waves do not return from block"]],
    ),
    (
        "ball_on_plate",
        "fem",
        &["plate bending"],
        &[["plate bending", "waves travel 36 thicknesses of bench during the contact; λ = 0.16"]],
    ),
    (
        "steel_on_aluminium",
        "fem",
        &["finite strain", "surface slip", "plastic flow", "partner waves"],
        &[["plastic flow", "pressure of first yield of block = 4.51"]],
    ),
    (
        "polymer_drop",
        "ting",
        &[RELAXES, "finite size", "surface slip", "plate bending"],
        &[["plate bending", "thicknesses of plate during the contact"]],
    ),
    ("three_bounces", "fem", &[RELAXES, "gravity"], &[]),
    // The speed ratio is 20 m/s over √(G/ρ) = √(1.154 MPa / 950 kg/m³) = 34.9 m/s.
    (
        "fast_impact",
        "fem",
        &["finite strain", "partner waves", "bulk viscosity"],
        &[
            ["bulk viscosity", "approach speed / shear wave speed = 0.57"],
            ["finite strain", "law neo-hooke"],
        ],
    ),
    (
        "soft_sphere",
        "fem",
        &[RELAXES, "finite strain", "bulk viscosity"],
        &[["finite strain", "law neo-hooke"]],
    ),
    ("dust_grain", "hertz", &[], &[]),
    // The contact takes 0.1 ms: terms of 5 ns and less are over, those of 0.2 s and more do not relax.
    (
        "polymer_ten_terms",
        "condensed",
        &[RELAXES],
        &[[RELAXES, "3 of 10 terms remain"], [RELAXES, "2 faster and 5 slower than the contact"]],
    ),
    // At 30 °C the times are 10^(−20.7 · 10/101.1) = 0.9 % of those at 20 °C: one of 2.8 ms takes 25 µs.
    (
        "oblique_glass",
        "ting",
        &[RELAXES, "finite size", "friction", "partner waves"],
        &[["friction", "coefficient of friction = 0.15"], ["tangential coupling", "β = 0"]],
    ),
    ("pool_balls", "ting", &["friction"], &[]),
    ("pvb_ball", "ting", &[RELAXES], &[[RELAXES, "4 of 11 terms remain"]]),
];

fn folder() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../../cases")
}

#[test]
fn every_case_has_the_plan_of_its_row() {
    for (name, model, effects, reasons) in ROWS {
        let case = Case::load(&folder().join(format!("{name}.toml")), &[]).unwrap();
        let simulation = Simulation::new(case).unwrap();
        let table = serde_json::to_value(&simulation.resolved().model).unwrap();
        let models: Vec<&String> = table.as_object().unwrap().keys().collect();
        assert_eq!(models, [model], "{name}");
        let decisions = &simulation.setup().decisions.all;
        let active =
            decisions.iter().filter(|decision| decision.active).map(|decision| decision.name);
        let active: Vec<&str> = active.filter(|effect| !MESHED.contains(effect)).collect();
        assert_eq!(active, effects, "{name}");
        for [effect, words] in reasons {
            let reason = &decision_on(&simulation, effect).reason;
            assert!(reason.contains(words), "{name}: {effect}: {reason}");
        }
        // The ice of a fit has a loss that the case does not give.
        let warnings = simulation.warnings_before();
        let is_told = name == "ice_2cm" && warnings.len() == 1;
        assert!(is_told || warnings.is_empty(), "{name}: {warnings:?}");
    }
}

/// Every case file with bodies has a row (sweeps have none).
#[test]
fn every_case_has_a_row() {
    let mut cases = BTreeSet::new();
    for entry in fs::read_dir(folder()).unwrap() {
        let path = entry.unwrap().path();
        if fs::read_to_string(&path).unwrap().contains("\n[[body]]") {
            cases.insert(path.file_stem().unwrap().to_str().unwrap().to_string());
        }
    }
    let rows: BTreeSet<String> = ROWS.iter().map(|row| row.0.to_string()).collect();
    assert_eq!(rows, cases);
}
