//! The `.pvd` and the `.vtu.series` say the same, and their times read back exactly.

use fem_vtk::write_collection;

#[test]
fn times_and_names_are_in_both_files() {
    let folder = tempfile::tempdir().unwrap();
    let snapshots =
        [(-1e-7, "run_0_start.vtu"), (1.0 / 3e5, "run_1_a&b.vtu"), (0.5, "run_2_end.vtu")];
    write_collection(folder.path().join("run.pvd"), &snapshots).unwrap();

    let pvd = std::fs::read_to_string(folder.path().join("run.pvd")).unwrap();
    let times: Vec<f64> = pvd
        .split("timestep=\"")
        .skip(1)
        .map(|rest| rest.split('"').next().unwrap().parse().unwrap())
        .collect();
    assert_eq!(times, snapshots.map(|(time, _)| time));
    assert!(pvd.contains("file=\"run_1_a&amp;b.vtu\""), "{pvd}");

    let series = std::fs::read_to_string(folder.path().join("run.vtu.series")).unwrap();
    let series: serde_json::Value = serde_json::from_str(&series).unwrap();
    assert_eq!(series["file-series-version"], "1.0");
    for (entry, (time, name)) in series["files"].as_array().unwrap().iter().zip(snapshots) {
        assert_eq!(entry["time"].as_f64(), Some(time));
        assert_eq!(entry["name"], name);
    }
}
