//! `fem-run relaxation` on the command line.

use std::time::{Duration, Instant};

use crate::common::Place;

const MODULI: &str = include_str!("../../../../../validation/data/dma_23_degc.csv");

/// The data are made by a known series with 2 % noise.
#[test]
#[allow(clippy::disallowed_methods, reason = "the test measures the time of a command")]
fn moduli_become_a_material_that_a_case_accepts() {
    let place = Place::new();
    place.write("pmma.csv", MODULI);
    let begin = Instant::now();
    let ran = place.succeed("relaxation pmma.csv --density '1180 kg/m^3' --poissons-ratio 0.38");
    // Tests run side by side, and without optimisation.
    assert!(begin.elapsed() < Duration::from_secs(10), "{:?}", begin.elapsed());
    ran.prints(
        "5 terms|glassy modulus E0: 2.4|rubbery modulus E∞: 38|10.00 mHz to 100.0 Hz|23.0 °C",
    );
    let files = ["pmma.relaxation.toml", "relaxation.csv", "relaxation.json", "relaxation.svg"];
    assert_eq!(place.list("runs/pmma_relaxation"), files);
    let numbers = place.json("runs/pmma_relaxation/relaxation.json");
    let glassy = numbers["instantaneous_modulus_pa"].as_f64().unwrap();
    let uncertainty = numbers["instantaneous_modulus_uncertainty_pa"].as_f64().unwrap();
    assert!((glassy - 2.4e9).abs() < 2.0 * uncertainty, "{glassy} ± {uncertainty}");
    assert_eq!((&numbers["test"], &numbers["warnings"]), (&"oscillation".into(), &[0; 0].into()));
    let svg = place.text("runs/pmma_relaxation/relaxation.svg");
    assert!(svg.starts_with("<svg") && svg.contains("loss modulus E″"));
    // What is printed is the material of a case.
    let start = ran.stdout.find("[material.pmma]").unwrap();
    let end = ran.stdout.find("\nResult:").unwrap();
    let material = &ran.stdout[start..end];
    let body =
        |name| format!("[[body]]\nname = '{name}'\nsphere.diameter = '2 cm'\nmaterial = 'pmma'\n");
    let [a, b] = ["a", "b"].map(body);
    let case = format!("[model.ting]\n{a}{b}approach_speed = '1 m/s'\n{material}");
    place.write("impact.toml", &case);
    // The moduli are measured up to 100 Hz, at one temperature.
    place.succeed("impact.toml --out e").tells("at its reference temperature, 23.0 degC");
    let ran = place.succeed("impact.toml --out e --force");
    ran.prints("± input|(± input has the extrapolation): measure up to|or at lower temperatures");
    place
        .fails(2, ["impact.toml", "--set", "scene.temperature=30 degC"])
        .tells("no material depends on");
    let summary = place.json("e/summary.json");
    let e = summary["restitution"].as_f64().unwrap();
    assert!((0.5..1.0).contains(&e), "{e}");
    let coverage = &summary["relaxation_coverage"];
    let decades = ["decades_inside", "decades_needed"].map(|key| coverage[key].as_f64().unwrap());
    assert!(decades[0] == 0.0 && (decades[1] - 2.0).abs() < 1e-12, "{coverage}");
    assert!(coverage["warning"].as_str().unwrap().contains("measure up to"), "{coverage}");
}

#[test]
fn options_of_moduli_are_checked() {
    let place = Place::new();
    place.write("pmma.csv", MODULI);
    place.write("step.csv", "t [s],E [MPa]\n0.1,2000\n1,1500\n10,1000\n");
    for (options, expected) in [
        ("pmma.csv --terms-per-decade 9", "from 0.1 to 4"),
        ("pmma.csv --modulus bulk", "possible values: young, shear"),
        ("pmma.csv --modulus shear", "the columns are of the youngs modulus"),
        ("pmma.csv --bulk-modulus '5 m'", "is not a modulus"),
        ("pmma.csv --bulk-modulus '0.5 GPa'", "leaves Poisson's ratio below 0"),
        ("pmma.csv --bulk-modulus '5 GPa' --poissons-ratio 0.3", "cannot be used with"),
        ("step.csv --bulk-modulus '5 GPa'", "E(t) becomes G(t) only over frequency"),
        ("none.csv", "there is no such file"),
    ] {
        place.fails(2, &format!("relaxation {options}")).tells(expected);
    }
    let ran = place.succeed("relaxation pmma.csv --bulk-modulus '5 GPa' --terms-per-decade 1");
    ran.prints("elastic bulk modulus|glassy modulus G0|shear_modulus = |bulk_modulus = \"5000000000.0 Pa\"");
    place.succeed("relaxation step.csv").prints("(1/2πt)");
}

/// The data are made with C1 = 12 and C2 = 120 K at 20 °C.
#[test]
fn temperatures_become_a_master_curve() {
    let place = Place::new();
    place.write("polymer.csv", include_str!("../../../../../validation/data/dma_polymer.csv"));
    let ran = place.succeed("relaxation polymer.csv");
    assert!(ran.stdout.lines().count() <= 24, "{}", ran.stdout);
    let ran = place.succeed("relaxation polymer.csv -v");
    ran.prints("WLF: C1 = 11.8|Arrhenius: activation energy|-10.0 °C   4.0|1.070 MHz");
    // The last line is one of a case, which shifts the series.
    let key = ran.stdout.lines().find_map(|line| Some(line.split_once("above all tables: ")?.1));
    let key = key.unwrap();
    let polymer = "[material.polymer]\ndensity = 1180\nyoungs_modulus = 2.6e9\npoissons_ratio = 0.38\n\
                   relaxation = { file = 'runs/polymer_relaxation/polymer.relaxation.toml' }\n\
                   [model]\nting = {}\n[[body]]\nname = 'floor'\nwall = {}\n[[body]]\nname = 'ball'\n\
                   sphere = { diameter = '2 cm' }\nmaterial = 'polymer'\napproach_speed = '1 m/s'\n";
    place.write("far.toml", &format!("{key}\n{polymer}"));
    place.write("near.toml", polymer);
    let restitution = |case: &str| {
        let summary = place.succeed(&format!("{case}.toml --json")).stdout;
        serde_json::from_str::<serde_json::Value>(&summary).unwrap()["restitution"].clone()
    };
    assert_ne!(restitution("far"), restitution("near"));
    let numbers = place.json("runs/polymer_relaxation/relaxation.json");
    let wlf = &numbers["superposition"]["wlf"];
    let of = |key: &str| wlf[key].as_f64().unwrap();
    assert!((of("c1") - 12.0).abs() < 2.0 * of("c1_uncertainty"), "{wlf}");
    assert!((of("c2_k") - 120.0).abs() < 2.0 * of("c2_uncertainty_k"), "{wlf}");
    assert!(place.text("runs/polymer_relaxation/relaxation.svg").contains("Arrhenius"));
    let options =
        "relaxation polymer.csv --reference-temperature '30 degC' --vertical-shift --out warm";
    place.succeed(options).prints("temperature: 30.0 °C");
    for (options, expected) in [
        (
            "--reference-temperature '70 degC'",
            "no rows are at the reference temperature, 70.0 °C|there are -10.0",
        ),
        ("--reference-temperature 20", "is not a temperature, such as '23 degC'"),
    ] {
        place.fails(2, &format!("relaxation polymer.csv {options}")).tells(expected);
    }
}
