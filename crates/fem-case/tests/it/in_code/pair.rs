//! One case as text and in code, and ways to change it.

use std::path::Path;

use fem_case::schema::*;
use fem_case::{Case, CaseFile, Quantity};

use crate::faults::message_table::VALID;
use crate::parse_in;

/// Returns the case as text.
fn text() -> String {
    VALID.replace("finite_strain = \"auto\"\n", "")
}

/// Reads the text with overrides.
pub fn parsed(overrides: &[&str]) -> Case {
    parse_in(Path::new("."), "pair.toml", &text(), overrides).unwrap()
}

/// Returns the case of [`text`], made in code.
pub fn made() -> CaseFile {
    let glass = MaterialTable::from_youngs_modulus_poissons_ratio("2390 kg/m^3", "63 GPa", 0.244)
        .relaxing(
            ActsOn::All,
            [
                TermTable::with_decay_rate(0.5, "2708 1/s"),
                TermTable::with_relaxation_time(0.25, 1e-3),
            ],
        );
    let striker = BodyTable::sphere("striker", "22.2 mm", "glass").approaching("0.5 m/s");
    let target = BodyTable::sphere("target", 0.0159, "glass");
    let labels = ["mid-compression", "maximum"].map(Quantity::from).to_vec();
    CaseFile {
        title: Some("a pair".into()),
        start: Some(StartTable { gap: Some("1 um".into()) }),
        mesh: Some(MeshTable {
            contact_element_size: Some(14e-6.into()),
            refined_radius: Some("0.3 mm".into()),
            growth: Some(1.1.into()),
            far_radius: None,
            staggered: None,
        }),
        contact: Some(ContactTable { penalty_factor: Some(1.0.into()), ..Default::default() }),
        time: Some(TimeTable { step_factor: Some(0.9.into()), mass_scaling: Some(2e-4.into()) }),
        output: Some(OutputTable {
            fields: None,
            snapshots: Some(SnapshotsValue::List(labels)),
            report: None,
            probe: Vec::new(),
        }),
        effects: Some(EffectsTable { bulk_viscosity: Some(Switch::Off), ..Default::default() }),
        limits: Some(LimitsTable {
            elements: Some(200_000.into()),
            element_updates: Some(1e12.into()),
            memory: Some("8 GB".into()),
        }),
        ..CaseFile::of_bodies(striker, target)
            .with_material("glass", glass)
            .with_model(ModelTable::fem())
    }
}

pub type Change = fn(&mut CaseFile);

pub fn mesh(file: &mut CaseFile) -> &mut MeshTable {
    file.mesh.get_or_insert_default()
}

pub fn glass(file: &mut CaseFile) -> &mut MaterialTable {
    file.material.get_mut("glass").unwrap()
}

pub fn relaxation(file: &mut CaseFile) -> &mut RelaxationTable {
    glass(file).relaxation.as_mut().unwrap()
}

pub fn sphere(file: &mut CaseFile) -> &mut SphereTable {
    file.body[0].sphere.as_mut().unwrap()
}

pub fn snapshots(file: &mut CaseFile, list: &[&str]) {
    let list = list.iter().map(|text| Quantity::from(*text)).collect();
    file.output.get_or_insert_default().snapshots = Some(SnapshotsValue::List(list));
}
