//! The cases of the repository: their models, effects and warnings.

use std::collections::BTreeSet;
use std::fs;
use std::path::{Path, PathBuf};

use fem::{Case, Simulation};

/// The expected plan of a case.
struct Row {
    /// File name in `cases`, without extension.
    case: &'static str,
    /// Name of the model.
    model: &'static str,
    /// Active effects without [`MESHED`]; all others are off.
    active: &'static [&'static str],
    /// Words in the reason of an effect.
    why: &'static [(&'static str, &'static str)],
    /// Words in each warning before the run.
    warnings: &'static [&'static str],
}

/// Effects that explicit elements have in every scene.
const MESHED: [&str; 3] = ["hourglass control", "contact search", "mass scaling"];

const ROWS: [Row; 14] = [
    Row {
        case: "glass_0.5ms",
        model: "fem",
        active: &["viscoelasticity"],
        why: &[("mirror symmetry", "differ")],
        warnings: &[],
    },
    Row { case: "glass_0.5ms_14um", model: "fem", active: &[], why: &[], warnings: &[] },
    Row { case: "glass_0.5ms_elastic", model: "fem", active: &[], why: &[], warnings: &[] },
    Row {
        case: "glass_0.5ms_elastic_bulk",
        model: "fem",
        active: &["viscoelasticity"],
        why: &[],
        warnings: &[],
    },
    Row { case: "glass_on_wall", model: "fem", active: &[], why: &[], warnings: &[] },
    Row { case: "ice_2cm", model: "fem", active: &["mirror symmetry"], why: &[], warnings: &[] },
    Row {
        case: "glass_twins",
        model: "fem",
        active: &["viscoelasticity", "mirror symmetry"],
        why: &[("mirror symmetry", "one is computed")],
        warnings: &[],
    },
    // The ratio is 3.4e-5: steel has E/(1 − ν²) = 231 GPa, rubber 7.9 MPa.
    Row {
        case: "steel_on_rubber",
        model: "condensed",
        active: &["viscoelasticity", "surface slip", "rigid partner"],
        why: &[
            ("rigid partner", "steel contributes 3.4e-5 of the compliance"),
            // β = (1 − 2ν)/(2 − 2ν) = 0.02 makes surface slip negligible.
            ("surface slip", "= 0.0015"),
        ],
        warnings: &[],
    },
    Row {
        case: "ball_on_block",
        model: "fem",
        active: &["partner waves"],
        why: &[("partner waves", "cross block 0.00 times")],
        warnings: &[],
    },
    Row {
        case: "three_bounces",
        model: "fem",
        active: &["viscoelasticity", "gravity"],
        why: &[],
        warnings: &[],
    },
    // The speed ratio is 20 m/s over √(G/ρ) = √(1.154 MPa / 950 kg/m³) = 34.9 m/s.
    Row {
        case: "fast_impact",
        model: "fem",
        active: &["finite strain", "partner waves", "bulk viscosity"],
        why: &[
            ("bulk viscosity", "approach speed / shear wave speed = 0.57"),
            ("finite strain", "law neo-hooke"),
        ],
        warnings: &[],
    },
    Row {
        case: "soft_sphere",
        model: "fem",
        active: &["viscoelasticity", "finite strain", "bulk viscosity"],
        why: &[("finite strain", "law neo-hooke")],
        warnings: &[],
    },
    Row { case: "dust_grain", model: "hertz", active: &[], why: &[], warnings: &[] },
    // The contact takes 0.1 ms: terms of 5 ns and less are over, those of 0.2 s and more do not relax.
    Row {
        case: "polymer_ten_terms",
        model: "condensed",
        active: &["viscoelasticity"],
        why: &[
            ("viscoelasticity", "3 of 10 terms are integrated"),
            ("viscoelasticity", "2 faster and 5 slower than the contact"),
        ],
        warnings: &[],
    },
];

fn folder() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../../cases")
}

#[test]
fn every_case_has_the_plan_of_its_row() {
    for row in ROWS {
        let name = row.case;
        let case = Case::load(&folder().join(format!("{name}.toml")), &[]).unwrap();
        let simulation = Simulation::new(case).unwrap();
        let model = serde_json::to_value(&simulation.resolved().model).unwrap();
        let models: Vec<&String> = model.as_object().unwrap().keys().collect();
        assert_eq!(models, [row.model], "{name}");
        let decisions = &simulation.setup().decisions.all;
        let active =
            decisions.iter().filter(|decision| decision.active).map(|decision| decision.name);
        let active: Vec<&str> = active.filter(|effect| !MESHED.contains(effect)).collect();
        assert_eq!(active, row.active, "{name}");
        for (effect, why) in row.why {
            let decision = decisions.iter().find(|decision| decision.name == *effect).unwrap();
            assert!(decision.reason.contains(why), "{name}: {effect}: {}", decision.reason);
        }
        let warnings = simulation.warnings_before();
        assert_eq!(warnings.len(), row.warnings.len(), "{name}: {warnings:?}");
        for (warning, expected) in warnings.iter().zip(row.warnings) {
            assert!(warning.contains(expected), "{name}: {warning}");
        }
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
    let rows: BTreeSet<String> = ROWS.iter().map(|row| row.case.to_string()).collect();
    assert_eq!(rows, cases);
}
