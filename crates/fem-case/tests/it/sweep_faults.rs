//! Faults of a sweep's base case and of its values, together.

use std::fs;

use fem_case::Sweep;
use tempfile::TempDir;

use crate::BALL_ON_WALL;

const GLASS: &str = r#"material.solid = { density = "2390 kg", youngs_modulus = "63 GPa", poissons_ratio = 0.244 }"#;

/// Returns file, line and column of the faults of a sweep over these values.
fn places(values: &str) -> Vec<(String, usize, usize)> {
    let folder = TempDir::new().unwrap();
    fs::write(folder.path().join("base.toml"), format!("{GLASS}{BALL_ON_WALL}")).unwrap();
    let path = folder.path().join("sweep.toml");
    fs::write(&path, format!("case = 'base.toml'\n[vary]\n{values}\n")).unwrap();
    let sweep = Sweep::load(&path, &[], &|_, _, _| Ok(Vec::new())).unwrap();
    let first = (0..sweep.n_members()).find_map(|member| sweep.build(member, Ok).err()).unwrap();
    let error = sweep.with_other_faults(first, Ok);
    let all = std::iter::once(&error).chain(error.others());
    let place = |fault: &fem_case::CaseError| {
        let file = fault.source_name().rsplit(['/', '\\']).next().unwrap_or_default().to_string();
        (file, fault.line().unwrap(), fault.column().unwrap())
    };
    all.map(place).collect()
}

#[test]
fn faults_of_the_base_case_hide_none_of_the_values() {
    let found = places("body.0.approach_speed = [1, '2 kg']\n'body.0.sphere.diametre' = [1]");
    let expected = [("base.toml", 1, 30), ("sweep.toml", 3, 29), ("sweep.toml", 4, 16)];
    assert_eq!(found, expected.map(|(file, line, column)| (file.to_string(), line, column)));
}

#[test]
fn a_fault_that_a_value_replaces_is_not_reported() {
    let found =
        places("material.solid.density = ['2390 kg/m^3']\nbody.0.approach_speed = ['2 kg']");
    assert_eq!(found, [("sweep.toml".to_string(), 4, 26)]);
}
