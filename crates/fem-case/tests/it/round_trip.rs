//! A case that is written in SI numbers and read again is the same scene to the last bit; no text makes the reader panic;
//! and the shipped cases have their documented values.

use std::path::{Path, PathBuf};

use fem_case::{Case, CaseError, Shape, SnapshotLabel, Snapshots};
use fem_material::{ActsOn, PronyTerm};

const FULL: &str = r#"
[material."my glass"]
density = "2.39 g/cm^3"
youngs_modulus = "9137.4 ksi"
poissons_ratio = 0.244
[material."my glass".relaxation]
acts_on = "shear"
terms = [{ weight = "10 %", decay_rate = "2.7081 1/ms" }, { weight = 0.1, relaxation_time = "3 h" }]
[material.unused]
density = 1
shear_modulus = "1 psi"
bulk_modulus = 1e-300
[material.metal]
density = 8000
youngs_modulus = 2e11
poissons_ratio = 0.3
[material.metal.flow]
yield_strength = "1 ± 0.1 GPa"
hardening = { table = [["1 %", "1.2 GPa"], [0.2, 2e9]] }
rate = { johnson_cook = { c = 0.014, reference_rate = "1 1/s" } }
[[body]]
name = "a"
sphere = { diameter = "0.874 in", mesh = "../meshes/ball.vtu" }
material = "my glass"
approach_speed = "1.2345 km/h"
[[body]]
name = "wall"
wall = {}
[start]
gap = "1.1 um"
[mesh]
contact_element_size = "14.3 um"
refined_radius = "0.31 mm"
growth = 1.1
[contact]
penalty_factor = 0.7
[time]
step_factor = "90 %"
mass_scaling = 2e-4
[output]
snapshots = ["3 us", 1.7e-6, 1e-5]
[model]
fem = {}
[effects]
finite_strain = "auto"
mirror_symmetry = "off"
[limits]
elements = 200000
element_updates = 1e12
memory = "8.5 GiB"
"#;

fn parse(name: &str, text: &str) -> Result<Case, CaseError> {
    Case::parse(name, text, Path::new("/some/folder"), &[])
}

/// Numbers as text: `==` on doubles would pass 0 for −0, and their `Debug` is exact.
fn exactly(case: &Case) -> String {
    format!("{:?}", case.scene())
}

#[test]
fn toml_out_and_in_is_the_same_scene() {
    for snapshots in ["[\"3 us\", 1.7e-6, 1e-5]", "7", "[]", "[\"maximum\", \"last-contact\"]"] {
        let text = FULL.replace("[\"3 us\", 1.7e-6, 1e-5]", snapshots);
        let case = parse("first.toml", &text).unwrap();
        let printed = case.file().to_toml().unwrap();
        // Another name and folder: title and mesh path must have been resolved.
        let again = Case::parse("second.toml", &printed, Path::new("/elsewhere"), &[]).unwrap();
        assert_eq!(exactly(&again), exactly(&case), "{printed}");
        assert_eq!(again.file().to_toml().unwrap(), printed);
        for with_unit in [" ksi\"", " mm\"", " km/h\"", " %\"", " GiB\"", " h\""] {
            assert!(!printed.contains(with_unit), "{printed}");
        }
    }
}

#[test]
fn json_has_the_same_numbers() {
    let case = parse("first.toml", FULL).unwrap();
    let json = serde_json::to_value(case.file()).unwrap();
    assert_eq!(json["body"][0]["sphere"]["diameter"], 0.874 * 25.4e-3);
    assert_eq!(json["body"][1]["wall"], serde_json::json!({}));
    assert_eq!(json["title"], "first");
    assert_eq!(json["body"][1]["approach_speed"], 0.0);
    assert_eq!(json["mesh"]["contact_element_size"], 14.3e-6);
    let table: toml::Table = serde_json::from_value(json).unwrap();
    let again = parse("second.toml", &toml::to_string(&table).unwrap()).unwrap();
    assert_eq!(exactly(&again), exactly(&case));
}

#[test]
fn truncated_and_mutated_cases_never_panic() {
    let (mut n_valid, mut n_faults) = (0, 0);
    let mut read = |text: &str, overrides: &[String]| match Case::parse(
        "x.toml",
        text,
        Path::new("."),
        overrides,
    ) {
        Ok(case) => {
            n_valid += 1;
            let printed = case.file().to_toml().unwrap();
            let again = Case::parse("x.toml", &printed, Path::new("."), &[]).unwrap();
            assert_eq!(exactly(&again), exactly(&case), "{text}");
        }
        Err(error) => {
            n_faults += 1;
            assert!(error.line().is_some() && !error.to_string().is_empty());
            assert!(!error.message().is_empty(), "{text}");
        }
    };
    for end in (0..FULL.len()).filter(|&end| FULL.is_char_boundary(end)) {
        read(&FULL[..end], &[]);
    }
    // Knuth's MMIX generator: the same mutations on every machine.
    let mut state = 1u64;
    let mut random = |below: usize| {
        state = state.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
        (state >> 33) as usize % below
    };
    let pieces = "\" ' [ ] { } = . - 0 9 e \n nan inf µ ² / ^ ( ) [[body]] wall={} \u{0} \\u0000 # , 1e999 true \
                  1979-05-27 [[[[ mesh \"\"\" \r \u{feff}";
    let pieces: Vec<&str> = pieces.split(' ').chain([" "]).collect();
    let mut mutated = |text: &str| {
        let mut text: Vec<char> = text.chars().collect();
        for _ in 0..=random(3) {
            let start = random(text.len());
            let end = (start + random(4)).min(text.len());
            text.splice(start..end, pieces[random(pieces.len())].chars());
        }
        text.into_iter().collect::<String>()
    };
    let overrides =
        ["body.0.sphere.diameter='1 mm'", "material.\"my glass\".density=1", "a.b=[{}]"];
    for k in 0..600 {
        read(&mutated(FULL), &[]);
        read(FULL, &[mutated(overrides[k % overrides.len()])]);
    }
    // Deep nesting must not exhaust the stack.
    read(&format!("a = {}", "[".repeat(100_000)), &[]);
    read(&format!("a = {}", "{a=".repeat(100_000)), &[]);
    read(&format!("{}a = 1", "a.".repeat(100_000)), &[]);
    read(FULL, &[format!("{}a=1", "a.".repeat(100_000))]);
    read(FULL, &[format!("model.law={}", "[".repeat(100_000))]);
    read(&FULL.replace("1.2345 km/h", &"(".repeat(100_000)), &[]);
    assert!(n_valid > 10 && n_faults > 500, "{n_valid} valid, {n_faults} faults");
}

fn repository_case(name: &str) -> Case {
    let path = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("../../cases").join(name);
    Case::load(&path, &[]).unwrap_or_else(|error| panic!("{error}"))
}

#[test]
fn glass_case_has_the_published_bodies_and_material() {
    let scene = repository_case("glass_0.5ms.toml").scene().clone();
    assert_eq!(scene.title(), "Glass on glass, 22.2 mm striking 15.9 mm at 0.5 m/s");
    let [striker, target] = &scene.bodies();
    assert_eq!((striker.name(), target.name()), ("striker", "target"));
    assert_eq!((striker.diameter(), target.diameter()), (Some(0.0222), Some(0.0159)));
    assert_eq!((striker.velocity(), target.velocity()), (0.5, 0.0));
    assert_eq!(striker.material(), target.material());
    let glass = striker.material().unwrap();
    assert_eq!(glass.density(), 2390.0);
    // K and G are stored: E and ν come back to rounding.
    assert!((glass.instantaneous().youngs_modulus() / 63e9 - 1.0).abs() < 1e-15);
    assert!((glass.instantaneous().poissons_ratio() - 0.244).abs() < 1e-15);
    let relaxation = glass.relaxation().unwrap();
    assert_eq!(relaxation.acts_on(), ActsOn::All);
    assert_eq!(relaxation.terms(), [PronyTerm { weight: 1.0, relaxation_time: 1.0 / 2708.0 }]);
    assert_eq!(scene.snapshots(), None);
    assert_eq!(scene.mesh(), Default::default());
}

#[test]
fn variants_of_the_glass_case_differ_only_in_relaxation_and_the_wall_lies_below() {
    let bodies = |name: &str| repository_case(name).scene().bodies().clone();
    let relaxation = |name: &str| {
        let mut relaxations = Vec::new();
        for (a, b) in bodies("glass_0.5ms.toml").iter().zip(bodies(name)) {
            assert_eq!(
                (a.name(), a.diameter(), a.velocity()),
                (b.name(), b.diameter(), b.velocity())
            );
            let (a, b) = (a.material().unwrap(), b.material().unwrap());
            assert_eq!((a.density(), a.instantaneous()), (b.density(), b.instantaneous()));
            relaxations.push(b.relaxation().map(|series| series.acts_on()));
        }
        relaxations
    };
    assert_eq!(relaxation("glass_0.5ms_elastic.toml"), [None; 2]);
    assert_eq!(relaxation("glass_0.5ms_elastic_bulk.toml"), [Some(ActsOn::Shear); 2]);
    let case = repository_case("glass_on_wall.toml");
    let [wall, ball] = case.scene().bodies();
    assert_eq!((wall.shape(), wall.velocity()), (&Shape::Wall, 0.0));
    assert_eq!((ball.diameter(), ball.velocity()), (Some(0.0222), -0.5));
    assert_eq!(ball.material().unwrap().relaxation(), None);
}

#[test]
fn snapshots_are_labels_times_or_a_count() {
    let snapshots = |value: &str| {
        let text = FULL.replace("[\"3 us\", 1.7e-6, 1e-5]", value);
        parse("x.toml", &text).unwrap().scene().snapshots().cloned().unwrap()
    };
    assert_eq!(snapshots("7"), Snapshots::Count(7));
    assert_eq!(snapshots("[]"), Snapshots::Labels(vec![]));
    assert_eq!(snapshots("[\"3 us\", 1e-6, 0, 1e-6]"), Snapshots::Times(vec![0.0, 1e-6, 3e-6]));
    let all = "[\"mid-compression\", \"maximum\", \"mid-separation\", \"last-contact\", \"after-separation\"]";
    let labels = SnapshotLabel::WORDS.iter().map(|word| SnapshotLabel::from_word(word).unwrap());
    assert_eq!(snapshots(all), Snapshots::Labels(labels.collect()));
}
