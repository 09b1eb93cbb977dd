//! The same case with cheaper models: results, files, sweeps over models.

use crate::common::{Place, number, set};
use serde_json::Value;

/// Runs the case with these overrides and returns its summary.
fn summary(place: &Place, overrides: &[&str]) -> Value {
    place.succeed(("case.toml --out out --quiet --force", set(overrides)));
    place.json("out/summary.json")
}

fn keys(value: &Value) -> Vec<&String> {
    value.as_object().unwrap().keys().collect()
}

const MODELS: [&str; 4] = [
    "model.ting={}",
    "model.hertz={}",
    "model.ting.finite_size=true",
    "model.law.kuwabara_kono.a='1 us'",
];

/// A striker of a given mass moves as one of the density that gives it; elements name that density.
#[test]
fn a_sphere_may_have_a_mass_of_its_own() {
    let place = Place::new();
    for model in MODELS {
        let own = summary(&place, &[model, "body.0.sphere.mass='100 g'"]);
        assert_eq!(own["bodies"][0]["mass_kg"], 0.1, "{model}");
        let volume = std::f64::consts::PI / 6.0 * 0.0222_f64.powi(3);
        let density = format!("material.heavy.density={}", 0.1 / volume);
        let moduli = "material.heavy={density=1, youngs_modulus='63 GPa', poissons_ratio=0.244, \
                      relaxation={acts_on='all', terms=[{weight=1.0, decay_rate='2708 1/s'}]}}";
        let heavy = summary(&place, &[model, moduli, &density, "body.0.material='heavy'"]);
        for key in ["restitution", "contact_time_s", "peak_force_n", "max_approach_m"] {
            let [own, heavy] = [&own, &heavy].map(|it| number(&it[key]));
            assert!((own / heavy - 1.0).abs() < 1e-9, "{model} {key}: {own} {heavy}");
        }
    }
    for model in ["model.fem={}", "model.condensed={}"] {
        let refused = place.fails(2, ("case.toml", set(&["body.0.sphere.mass='100 g'", model])));
        refused.tells("elements have the density of their material|density = \"17456 kg/m^3\"");
    }
    let chosen = summary(&place, &["body.0.sphere.mass='100 g'", "model.auto={}"]);
    let model = chosen["case"]["model"].as_object().unwrap();
    assert!(model.contains_key("ting") || model.contains_key("hertz"), "{model:?}");
    place.fails(2, "case.toml --set body.0.sphere.mass=0").tells("greater than 0");
}

#[test]
fn every_model_writes_the_same_keys_and_columns() {
    let place = Place::new();
    let fem = summary(&place, &[]);
    let columns = place.text("out/history.csv");
    for model in MODELS {
        let reduced = summary(&place, &[model]);
        // The resolved case that `check` prints names the model, and so does the announcement of its run.
        let name = model["model.".len()..].split(['.', '=']).next().unwrap();
        let named = &format!("model {name}");
        let checked = place.succeed(["check", "case.toml", "--resolved", "--set", model]);
        checked.prints(named);
        place.write("resolved.toml", &checked.stdout);
        place.succeed("resolved.toml --out resolved --force").tells(named);
        assert_eq!(keys(&reduced), keys(&fem), "{model}");
        for inner in ["hertz", "energy", "cost"] {
            assert_eq!(keys(&reduced[inner]), keys(&fem[inner]), "{model} {inner}");
        }
        assert_eq!(keys(&reduced["bodies"][0]), keys(&fem["bodies"][0]));
        assert_eq!(reduced["hertz"], fem["hertz"]);
        assert_eq!(reduced["complete"], true);
        for none in ["time_step_s", "steps", "element_updates"] {
            assert!(reduced[none].is_null(), "{none}");
        }
        for body in reduced["bodies"].as_array().unwrap() {
            assert!(body["elements"].is_null() && body["vibration_energy_j"].is_null());
            assert!(number(&body["mass_kg"]) > 0.0);
        }
        // Within a few per cent of finite elements on such a coarse mesh.
        for key in ["restitution", "contact_time_s", "peak_force_n", "max_approach_m"] {
            let ratio = number(&reduced[key]) / number(&fem[key]);
            assert!((0.85..1.15).contains(&ratio), "{model} {key}: {ratio}");
        }
        assert!(number(&reduced["energy"]["residual_relative"]) < 1e-8);
        assert_eq!(place.list("out"), ["history.csv", "report.html", "summary.json"]);
        assert_eq!(
            reduced["files"],
            serde_json::json!(["summary.json", "history.csv", "report.html"])
        );
        let history = place.text("out/history.csv");
        assert_eq!(history.lines().next(), columns.lines().next());
        assert_eq!(history.lines().count(), 1202);
        // Time, force and approach are always there; a law has no pressure, and no model has
        // penalty springs.
        let row: Vec<&str> = history.lines().nth(500).unwrap().split(',').collect();
        assert!(row[0].parse::<f64>().unwrap() > 0.0 && row[1].parse::<f64>().unwrap() > 0.0);
        assert_eq!(row[4].is_empty(), model.contains("law"), "{model}: {row:?}");
        assert_eq!(row[9], "");
    }
}

/// Digits of the closed form, and of the independent quasi-static solution, with the units of the keys. Other speeds and rates are
/// in the tests of `fem-laws`.
#[test]
fn hertz_and_ting_give_the_published_numbers() {
    let place = Place::new();
    let found = summary(&place, &["model.hertz={}"]);
    for (key, unit, expected, half_digit) in [
        ("contact_time_s", 1e6, 63.235, 5e-4),
        ("max_approach_m", 1e6, 10.742, 5e-4),
        ("peak_force_n", 1.0, 107.02, 5e-3),
        ("max_contact_radius_m", 1e3, 0.22307, 5e-6),
        ("peak_pressure_pa", 1e-9, 1.0268, 5e-5),
    ] {
        let found = unit * number(&found[key]);
        // Some are truncated, not rounded.
        assert!((found - expected).abs() <= 2.0 * half_digit, "{key}: {found}");
    }
    assert_eq!(found["restitution"], 1.0);
    for (acts_on, rate, restitution) in [("all", 2708.0, 0.9270), ("shear", 5966.6, 0.8881)] {
        let relaxation = format!(
            "material.glass.relaxation={{acts_on='{acts_on}', terms=[{{weight=1, decay_rate={rate}}}]}}"
        );
        let found = number(&summary(&place, &["model.ting={}", &relaxation])["restitution"]);
        assert!((found - restitution).abs() < 1e-4, "{acts_on} {rate}: {found}");
    }
}

#[test]
fn law_without_separation_or_end_is_reported() {
    let place = Place::new();
    let stuck = summary(&place, &["model.law.power={k=1e9, gamma=1.5, c=1e300, n=5}"]);
    assert_eq!((number(&stuck["restitution"]), stuck["contact_time_s"].is_null()), (0.0, true));
    assert!(stuck["warnings"].to_string().contains("stay together"), "{stuck}");
    assert_eq!(stuck["case"]["model"]["law"].as_object().unwrap().len(), 1);
    // The exponent of a linear law is not that of Hertz, so it has no contact radius.
    let linear = summary(&place, &["model.law.linear={e=0.9, contact_time='60 us'}"]);
    assert!((number(&linear["contact_time_s"]) - 60e-6).abs() < 1e-11);
    assert!((number(&linear["restitution"]) - 0.9).abs() < 1e-7);
    assert!(linear["max_contact_radius_m"].is_null());
    let creep = "model.law.linear={k=1e7, c=1e8, end='zero_overlap'}";
    place
        .fails(1, ["case.toml", "--out", "out", "--force", "--set", creep])
        .tells("remedy: lower the damping");
    assert_eq!(place.json("out/summary.json")["complete"], false);
    for (value, message) in [
        ("model.law.tsuji={}", "`e` is missing in model.law.tsuji"),
        ("model.law.kuwabara_kono={}", "flows"),
        ("model.auto={best=true}", "unknown key `best`"),
    ] {
        place.fails(2, ["check", "case.toml", "--set", value]).tells(message);
    }
}

#[test]
fn a_sweep_runs_over_models() {
    let place = Place::new();
    place.write(
        "sweep.toml",
        "case = 'case.toml'\n[vary]\nmodel = [{ hertz = {} }, { ting = {} }, \
         { law = { kuwabara_kono = { a = '1 us' } } }, { law = { linear = { k = 1e7, c = 1e8, \
         end = 'zero_overlap' } } }]\n'body.0.approach_speed' = [0.1, 0.5]\n",
    );
    let ran = place.run("sweep sweep.toml --out out");
    // Two members creep without end; the others are done.
    assert_eq!(ran.code, Some(1), "{}", ran.stderr);
    ran.tells("2 of 8 members failed");
    let table = place.read("out/sweep.csv");
    let mut table = csv::Reader::from_reader(table.as_slice());
    let header = table.headers().unwrap().clone();
    let column = |name: &str| header.iter().position(|key| key == name).unwrap();
    let rows: Vec<csv::StringRecord> = table.records().map(Result::unwrap).collect();
    let restitution = |row: usize| rows[row][column("restitution")].to_string();
    assert_eq!(restitution(0), "1.0");
    assert!(restitution(3).starts_with("0.927"));
    assert_eq!((restitution(7), &rows[7][column("complete")]), (String::new(), "false"));
    assert_eq!(&rows[3][column("elements")], "");
    place.run("sweep sweep.toml --out out").tells("8 already done, 0 to run");
}

/// The condensed model writes the same files and keys as finite elements, its cost, and its error estimates.
#[test]
fn condensed_bodies_write_all_files_of_finite_elements() {
    let place = Place::new();
    let fem = summary(&place, &[]);
    let files = place.list("out");
    let columns = place.text("out/history.csv");
    let condensed = summary(&place, &["model.condensed={}"]);
    assert_eq!(keys(&condensed), keys(&fem));
    assert_eq!(place.list("out"), files);
    let history = place.text("out/history.csv");
    assert_eq!(history.lines().next(), columns.lines().next());
    assert!(condensed["element_updates"].is_null() && condensed["complete"] == true);
    assert_eq!(condensed["bodies"][0]["elements"], fem["bodies"][0]["elements"]);
    // The mesh is coarse, and the penalty stiffness of the explicit model is small on it.
    for key in ["restitution", "contact_time_s", "peak_force_n", "max_approach_m"] {
        let ratio = number(&condensed[key]) / number(&fem[key]);
        assert!((0.97..1.03).contains(&ratio), "{key}: {ratio}");
    }
    assert!(number(&condensed["energy"]["residual_relative"]) < 1e-5);
    let cost = &condensed["cost"];
    let (setup, solve) = (number(&cost["setup_s"]), number(&cost["solve_s"]));
    assert!(setup > 0.0 && solve > 0.0 && setup + solve <= number(&cost["wall_s"]));
    // A factor holds at least the stiffness of its body, about ten numbers per equation.
    let nodes: f64 = (0..2).map(|k| number(&condensed["bodies"][k]["nodes"])).sum();
    assert!(number(&cost["factor_bytes"]) > 80.0 * 2.0 * nodes);
    assert!(cost["ns_per_element_update"].is_null());
}
