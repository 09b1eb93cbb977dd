//! One number, one status and one error bar wherever a result goes: terminal, summary, sweep, report, fit and export. A restitution
//! that is a bound reaches no contact law unless it is asked for.

use fem_case::library::{Material, materials};
use serde_json::Value;

use crate::common::Place;

const KEYS: [(&str, &str); 6] = [
    ("restitution", "restitution"),
    ("contact_time_s", "contact time"),
    ("peak_force_n", "peak force"),
    ("max_approach_m", "largest approach"),
    ("max_contact_radius_m", "largest contact radius"),
    ("peak_pressure_pa", "peak pressure"),
];

fn ball(diameter: &str, speed: &str, material: &str) -> String {
    format!(
        "[[body]]\nname = 'ball'\nsphere.diameter = '{diameter}'\napproach_speed = '{speed}'\nmaterial = '{material}'\n"
    )
}

fn floor(shape: &str) -> String {
    format!("[[body]]\nname = 'floor'\n{shape}\n")
}

/// Compares all faces of one case, and returns its summary.
fn compare(of: &str, text: &str) -> Value {
    let place = Place::with(text);
    let ran = place.succeed("case.toml --out result");
    let summary = place.json("result/summary.json");
    let json: Value =
        serde_json::from_str(&place.succeed("case.toml --json --out other").stdout).unwrap();
    let speed = &summary["case"]["body"][1]["approach_speed"];
    let vary = format!("case = 'case.toml'\n[vary]\n'body.1.approach_speed' = [{speed}]\n");
    place.write("sweep.toml", &vary);
    let sweep = place.succeed("sweep sweep.toml --out sweep");
    let bytes = place.read("sweep/sweep.csv");
    let mut reader = csv::Reader::from_reader(bytes.as_slice());
    let header = reader.headers().unwrap().clone();
    let row = reader.records().next().unwrap().unwrap();
    let cell = |name: &str| row[header.iter().position(|it| it == name).unwrap()].to_string();
    let report = place.text("result/report.html");
    for (key, name) in KEYS {
        let (value, status) = (&summary[key], summary["status"][key].as_str().unwrap());
        let parts = &summary["uncertainty"][key];
        let expected = match (value.is_null(), parts["model"].is_null()) {
            (true, _) => "unknown",
            (false, true) => "bound",
            (false, false) => "computed",
        };
        assert_eq!(status, expected, "{of}: {key}");
        for part in [key, "status", "uncertainty"] {
            let of_json = if part == key { &json[key] } else { &json[part][key] };
            let own = if part == key { value } else { &summary[part][key] };
            assert_eq!(own, of_json, "{of}: {key} {part}");
        }
        assert_eq!(cell(&format!("{key}_status")), status, "{of}: {key}");
        assert_eq!(cell(key).parse::<f64>().ok(), value.as_f64(), "{of}: {key}");
        let model = cell(&format!("uncertainty_model_{key}")).parse::<f64>().ok();
        assert_eq!(model, parts["model"].as_f64(), "{of}: {key}");
        // The line of the terminal and the card of the report have the sign of a bound.
        let line = ran.stdout.lines().find(|line| line.starts_with(name)).unwrap();
        let sign = match parts["bound"].as_str() {
            Some("at most") => "≤",
            Some("at least") => "≥",
            _ => "",
        };
        assert_eq!(line.contains(['≤', '≥']), !sign.is_empty(), "{of}: {line}");
        assert!(line.contains(sign), "{of}: {line}");
        let card = report.split("<div class=\"card\">").find(|card| card.contains(name));
        let card = card.filter(|_| !value.is_null()).unwrap_or("");
        assert_eq!(card.contains(['≤', '≥']), !sign.is_empty(), "{of}: {card}");
        // An error bar is no rounding noise.
        for part in ["discretisation", "model", "input"] {
            let scale = if key == "restitution" { 1.0 } else { value.as_f64().unwrap_or(1.0) };
            let size = parts[part].as_f64().unwrap_or(0.0);
            assert!(size == 0.0 || size > 1e-13 * scale, "{of}: {key} {part}: {size:e}");
        }
    }
    let is_bound = summary["status"]["restitution"] == "bound";
    assert_eq!(
        sweep.stdout.contains('≤'),
        is_bound && !summary["uncertainty"]["restitution"]["bound"].is_null()
    );
    assert!(!is_bound || !ran.stdout.contains("No warnings."), "{of}");
    assert!(!is_bound || !ran.stdout.contains("none above the tolerance"), "{of}");
    // A fit takes no bound.
    let fit = "fit case.toml --data sweep/sweep.csv --law tsuji --out fit";
    let refused = place.run(fit);
    assert_eq!(refused.stderr.contains("upper bound"), is_bound, "{of}: {}", refused.stderr);
    summary
}

fn has_strength(entry: &Material) -> bool {
    entry.material.yield_strength.is_some() || entry.material.flow.is_some()
}

/// Every material of the library, and its numbers typed by hand without a name, struck on a rigid floor.
#[test]
fn every_material_says_the_same_everywhere() {
    for (name, entry) in materials() {
        let text = format!(
            "{}{}[output]\nsnapshots = []\n[model.ting]\n",
            floor("wall = {}"),
            ball("10 mm", "0.1 m/s", &format!("lib:{name}"))
        );
        let summary = compare(name, &text);
        let relaxes = entry.material.relaxation.is_some();
        let expected = if relaxes { "computed" } else { "bound" };
        assert_eq!(summary["status"]["restitution"], expected, "{name}");
    }
    for (modulus, density) in
        [("210 GPa", 7850), ("70 GPa", 2700), ("72 GPa", 2500), ("3 GPa", 1200)]
    {
        let text = format!(
            "[material.mine]\ndensity = {density}\nyoungs_modulus = '{modulus}'\npoissons_ratio = 0.3\n{}{}[model.ting]\n",
            floor("wall = {}"),
            ball("10 mm", "0.1 m/s", "mine"),
        );
        let summary = compare(modulus, &text);
        assert_eq!(summary["status"]["restitution"], "bound", "{modulus}");
        assert_ne!(summary["uncertainty"]["restitution"]["model"], 0.0, "{modulus}");
        let meant = text.replace("poissons_ratio = 0.3", "poissons_ratio = 0.3\nelastic = true");
        assert_eq!(compare(modulus, &meant)["status"]["restitution"], "computed", "{modulus}");
    }
}

/// Scenes with the statuses of restitution and peak force, and whether a DEM file is written.
#[test]
fn scenes_say_the_same_everywhere() {
    let block = |material: &str| floor(&format!("half_space = {{}}\nmaterial = 'lib:{material}'"));
    let plate = |thickness: &str| {
        floor(&format!("plate.thickness = '{thickness}'\nmaterial = 'lib:steel'"))
    };
    let coarse = "[accuracy]\ntolerance = '5 %'\n[output]\nsnapshots = []\n";
    let typed =
        "[material.mine]\ndensity = 7850\nyoungs_modulus = '210 GPa'\npoissons_ratio = 0.3\n";
    let sticky = "[contact]\nwork_of_adhesion = '0.1 J/m^2'\n";
    let scenes = [
        (
            "steel flows",
            block("steel") + &ball("10 mm", "1 m/s", "lib:steel") + coarse,
            ["computed"; 2],
            true,
        ),
        (
            "slow steel",
            block("steel") + &ball("10 mm", "1 mm/s", "lib:steel") + coarse,
            ["bound", "computed"],
            false,
        ),
        (
            "hard on soft",
            block("steel") + &ball("10 mm", "1 m/s", "lib:bearing-steel") + coarse,
            ["computed"; 2],
            true,
        ),
        (
            "ting",
            block("steel") + &ball("10 mm", "1 m/s", "lib:steel") + coarse + "[model.ting]\n",
            ["bound"; 2],
            true,
        ),
        (
            "flow off",
            block("steel")
                + &ball("10 mm", "1 m/s", "lib:steel")
                + coarse
                + "[effects]\nplastic_flow = 'off'\n",
            ["bound"; 2],
            false,
        ),
        (
            "typed steel",
            typed.to_string() + &block("steel") + &ball("10 mm", "1 m/s", "mine") + coarse,
            ["bound"; 2],
            false,
        ),
        (
            "ice",
            block("ice") + &ball("5 cm", "1 cm/s", "lib:ice") + coarse,
            ["bound", "computed"],
            false,
        ),
        (
            "PMMA",
            block("steel") + &ball("10 mm", "0.1 m/s", "lib:pmma") + coarse,
            ["bound", "computed"],
            false,
        ),
        (
            "dust",
            block("fused-silica") + &ball("1 um", "0.1 m/s", "lib:fused-silica") + coarse,
            ["bound"; 2],
            false,
        ),
        (
            "dust that sticks",
            block("fused-silica") + &ball("1 um", "0.02 m/s", "lib:fused-silica") + sticky + coarse,
            ["computed"; 2],
            false,
        ),
        (
            "polymer",
            block("steel") + &ball("10 mm", "0.1 m/s", "lib:pvb") + coarse,
            ["computed"; 2],
            true,
        ),
        (
            "plate",
            plate("5 mm") + &ball("10 mm", "0.5 m/s", "lib:steel") + coarse,
            ["computed"; 2],
            true,
        ),
    ];
    for (name, text, statuses, is_exported) in scenes {
        let summary = compare(name, &text);
        let found = ["restitution", "peak_force_n"].map(|key| summary["status"][key].clone());
        assert_eq!(found, statuses, "{name}");
        let place = Place::with(&text);
        let ran = place.run("export case.toml --out export");
        assert_eq!(ran.code == Some(0), is_exported, "{name}: {}", ran.stderr);
        if is_exported {
            let text = place.text("export/lammps_coeff_restitution.in");
            assert!(!text.contains("no loss of"), "{name}: {text}");
        } else {
            assert!(!place.path("export").exists(), "{name}");
        }
    }
}

/// The law that follows elements is the first of an inversion for bodies that yield, and only what changes a parameter is an
/// uncertain input of it.
#[test]
fn an_inversion_of_metals_begins_with_their_law() {
    for (name, entry) in materials() {
        let text = floor("wall = {}") + &ball("10 mm", "1 m/s", &format!("lib:{name}"));
        let place = Place::with(&text);
        let ran = place.succeed("invert case.toml --restitution 0.5");
        let first = ran.stdout.lines().nth(3).unwrap();
        assert_eq!(first.starts_with("mean_pressure"), has_strength(entry), "{name}: {first}");
        for wrong in ["± 0 ", "0.000000", "0.000 "] {
            assert!(!ran.stdout.contains(wrong), "{name}: {}", ran.stdout);
        }
    }
    let text = floor("wall = {}") + &ball("10 mm", "0.4 m/s", "lib:bearing-steel");
    let place = Place::with(&text);
    place.write("e.csv", "speed_m_s,restitution\n0.4,0.95\n0.6,0.9\n1,0.85\n");
    let ran = place.succeed("fit case.toml --data e.csv --law mean_pressure");
    assert!(!ran.stdout.contains(" by material"), "{}", ran.stdout);
}
