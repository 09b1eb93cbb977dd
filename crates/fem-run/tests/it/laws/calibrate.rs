//! `fem-run calibrate` on the command line.

use serde_json::Value;

use super::rejects_data;
use crate::common::{Place, number, set};

const ICE: &str = include_str!("../../../../../cases/ice_2cm.toml");
const BRIDGES: &str = include_str!("../../../../../validation/data/bridges_ice.csv");
const GLASS_POINT: &str = include_str!("../../../../../validation/data/paper_glass.csv");
const PAIRINGS: &str = include_str!("../../../../../validation/data/synthetic_pairings.csv");
const GLASS: &str = include_str!("../../../../../cases/glass_0.5ms.toml");

#[test]
fn calibrate_one_point_determines_one_of_four_combinations() {
    let place = Place::with(GLASS);
    place.write("glass.csv", GLASS_POINT);
    place
        .succeed("calibrate case.toml --data glass.csv --verbose")
        .prints("the data determine 1 of 4 combinations|8.0 elements across the smallest");
    let files = ["calibrate.json", "calibrate.svg", "relaxation.toml", "residuals.csv"];
    assert_eq!(place.list("runs/glass_calibrate"), files);
    let numbers = place.json("runs/glass_calibrate/calibrate.json");
    assert_eq!(numbers["combinations_determined"], 1);
    assert!(number(&numbers["rms"]) < 1e-5);
    // The paper's single term, β = 2708 1/s, gives 0.9276; 0.925 needs slightly more relaxation.
    let time = number(&numbers["maxwell"]["relaxation_time_s"]);
    assert!(340e-6 < time && time < 369e-6, "{time}");

    // The table to paste gives the restitution in a run.
    let (before, rest) = GLASS.split_once("[material.glass.relaxation]").unwrap();
    let (_, after) = rest.split_once("[[body]]").unwrap();
    let table = place.text("runs/glass_calibrate/relaxation.toml");
    place.write("pasted.toml", &format!("{before}\n{table}\n[[body]]{after}"));
    place.succeed(["pasted.toml", "--set", "model.condensed={}", "--out", "run", "--quiet"]);
    let restitution = number(&place.json("run/summary.json")["restitution"]);
    assert!((restitution - 0.925).abs() < 2e-4, "{restitution}");

    // A second calibration replaces the first.
    let again = "calibrate case.toml --data glass.csv --terms 2 --quiet";
    assert_eq!(place.succeed(again).stdout, "");
    let numbers = place.json("runs/glass_calibrate/calibrate.json");
    assert_eq!(numbers["terms"].as_array().map(Vec::len), Some(2));
}

#[test]
fn calibrate_explains_data_that_no_maxwell_series_reproduces() {
    let place = Place::with(ICE);
    place.write("ice.csv", BRIDGES);
    let calibrate = "calibrate case.toml --data ice.csv --model ting --terms 3";
    let printed = place.succeed(calibrate);
    printed.prints("restitution falls with speed|neither a single Maxwell term (weight 1) nor any series fits these data|no series of these relaxation times fits these data");
    assert!(printed.stdout.lines().count() <= 24, "{}", printed.stdout);
    let svg = place.text("runs/ice_calibrate/calibrate.svg");
    for label in ["slopes of any Prony series", "single Maxwell term", "best fit", "data"] {
        assert!(svg.contains(label), "{label}");
    }
}

/// One series for nine pairs; the ranges of determined quantities contain the truth.
#[test]
fn nine_pairings_share_a_series() {
    let place = Place::with(GLASS);
    place.write("nine.csv", PAIRINGS);
    // The relaxation times of the series, 10 and 300 µs.
    let times = "--verbose --terms 2 --times '10 us..300 us'";
    place
        .succeed(("calibrate case.toml --data nine.csv", times))
        .prints("45 points of nine.csv, 9 pairs");
    let numbers = place.json("runs/nine_calibrate/calibrate.json");
    for (k, weight) in [0.02, 0.3].into_iter().enumerate() {
        let range = &numbers["terms"][k]["range"];
        assert!(number(&range[0]) < weight && weight < number(&range[1]), "{range}");
        // The range is not trivially wide.
        assert!(number(&range[1]) - number(&range[0]) < 0.5 * weight, "{range}");
    }
    let misfit = number(&numbers["misfit"]);
    assert!(0.8 < misfit && misfit < 1.2, "{misfit}");
}

#[test]
fn calibrate_reports_faults_with_position_and_writes_nothing() {
    let place = Place::new();
    let refused = |csv, more, expected| {
        rejects_data(&place, "calibrate case.toml --data bad.csv", [csv, more, expected]);
    };
    let good = "speed_m_s,e\n0.2,0.9\n0.5,0.91\n";
    refused(
        good,
        "--regularisation 0",
        "2 measured values cannot determine 4 parameters|lower --terms",
    );
    refused(good, "--regularisation -1", "--regularisation|a value of at least 0");
    refused(good, "--confidence 95", "--confidence|between 0 and 1, such as 0.95");
    refused(good, "--uncertainty 0", "greater than 0");
    refused(good, "--uncertainty -1", "--uncertainty is -1|greater than 0");
    refused(good, "--uncertainty 5", "--uncertainty is 5|at most 1");
    refused(good, "--material steel", "no body has this material|glass");
    refused(good, "--times '1 ms..1 us'", "at most the last");
    refused(good, "--times '1 m..2 m'", "is not a time");
    refused(good, "--terms 0", "1..=12");
    refused("speed_m_s,e,sigma\n0.2,0.9,5\n", "", "bad.csv:2: sigma is 5|at most 1|percent");
    refused(
        "speed_m_s,e,restitution_uncertainy\n0.2,0.9,0.01\n",
        "",
        "bad.csv:1: unknown column restitution_uncertainy|did you mean `restitution_uncertainty`?|diameter_1, diameter_2",
    );
    refused(
        "diameter1_mm,diameter2_mm,speed_m_s,e\n10,10,0.2,0.9\n20,20,0.2,0.9\n",
        "",
        "bad.csv:1: unknown column diameter1_mm|did you mean `diameter_1`?",
    );
    refused(
        "speed_m_s,e,uncertainty\n0.2,0.9,0.01\n",
        "--uncertainty 0.01",
        "has uncertainties of its own",
    );
    refused(
        "body.0.approach_speed,material.glass.density,restitution\n1,2390,0.9\n1,2400,0.8\n",
        "",
        "bad.csv:3: the sweep varies material.glass.density",
    );
}

/// Calibrates with Ting's model on the paper's spheres, which is the fastest.
fn calibrated(csv: &str, more: &[&str]) -> (String, serde_json::Value) {
    let place = Place::with(GLASS);
    place.write("e.csv", csv);
    let calibrate = ["calibrate", "case.toml", "--data", "e.csv", "--out", "found", "--terms", "2"];
    let ting = if more.contains(&"--model") { &[][..] } else { &["--model", "ting"] };
    let ran = place.succeed((calibrate, ting, more));
    (ran.stdout, place.json("found/calibrate.json"))
}

#[test]
fn calibrate_warns_about_unread_columns_except_its_own() {
    let header = "speed_m_s,e,humidity,contact_radius_um,speed_uncertainty_m_s,member";
    let (text, _) = calibrated(&format!("{header}\n0.2,0.9,0.4,3,0.01,a\n"), &[]);
    let warning = "warning: columns that are not read: humidity, contact_radius_um\n";
    assert!(text.contains(warning), "{text}");
}

#[test]
fn given_uncertainties_and_repeats_are_the_scatter() {
    let unknown = "their scatter is unknown";
    let (text, numbers) = calibrated("speed_m_s,e\n0.2,0.9\n", &[]);
    assert!(text.contains(unknown) && text.contains("error of 4.0e-4 in e"), "{text}");
    assert!(numbers["pure_error"].is_null());

    // One standard deviation is known, with no degree of freedom left.
    let (text, numbers) = calibrated("speed_m_s,e,sigma\n0.2,0.9,0.01\n", &[]);
    assert!(!text.contains(unknown), "{text}");
    assert!((number(&numbers["error"]) - 0.01).abs() < 1e-15);

    // Four data of one collision: ±0.01 and ±0.01 about the mean, with three degrees of freedom.
    let repeats = "speed_m_s,e\n0.2,0.91\n0.2,0.89\n0.2,0.91\n20 cm/s,0.89\n";
    let (text, numbers) =
        calibrated(&repeats.replace("speed_m_s", "speed").replace("0.2,", "0.2 m/s,"), &[]);
    assert!(!text.contains(unknown), "{text}");
    assert_eq!(numbers["degrees_of_freedom"], 3);
    let expected = (4e-4f64 / 3.0).sqrt();
    assert!((number(&numbers["pure_error"]) - expected).abs() < 1e-12);
    // The regularisation moves the fit off the mean by about 1e-5 of 0.01.
    assert!((number(&numbers["error"]) / expected - 1.0).abs() < 1e-3, "{}", numbers["error"]);
}

#[test]
fn calibrate_reports_a_maxwell_time_at_the_search_limit() {
    let finite = ["--model", "condensed"];
    let (text, numbers) = calibrated("speed_m_s,e\n0.2,0\n", &finite);
    assert!(text.contains("or faster, at the end of the search range"), "{text}");
    assert_eq!(numbers["maxwell"]["beyond_search"], "faster");
    let (text, _) = calibrated("speed_m_s,e\n0.2,1\n", &finite);
    assert!(text.contains("or slower, at the end of the search range"), "{text}");
    // A term with a tenth of the contact time as relaxation time returns little energy.
    let (_, numbers) = calibrated("speed_m_s,e\n0.2,0.01\n", &finite);
    assert!(numbers["maxwell"]["beyond_search"].is_null());
    assert!(number(&numbers["maxwell"]["rms"]) < 1e-5);
}

#[test]
fn ignored_keys_of_the_case_are_named() {
    let with = |more: &[&str]| calibrated("speed_m_s,e\n0.2,0.9\n", more).0;
    let text = with(&["--set", "model.condensed.steps=50"]);
    assert!(
        text.contains("model.condensed is ignored: --model chooses the model, here ting"),
        "{text}"
    );
    let text = with(&["--set", "model.condensed.steps=50", "--model", "condensed"]);
    assert!(text.contains("model.condensed.steps is ignored: calibrate takes 300"), "{text}");
    let text = with(&["--set", "model.ting={}"]);
    assert!(text.contains("model.ting is ignored"), "{text}");
    assert!(!with(&[]).contains("is ignored"));
}

#[test]
fn calibrate_questions_the_unit_of_very_high_speeds_first() {
    let fast = "speed_m_s,e\n200,0.9\n300,0.9\n";
    let (text, numbers) = calibrated(fast, &["--model", "condensed"]);
    let first = numbers["warnings"][0].as_str().unwrap_or_default();
    assert!(first.contains("is the unit of the speeds right?"), "{text}");
    assert!(!text.contains("model fem"), "{text}");
    // Ting's contact would be too large for its spheres.
    let place = Place::with(GLASS);
    place.write("e.csv", fast);
    place
        .fails(2, "calibrate case.toml --data e.csv --model ting")
        .tells("e.csv:3: |is the unit of the speeds right?");
}

/// Data that do not fit the case, and a mesh that cannot be made.
#[test]
fn calibrate_rejects_data_and_meshes_that_do_not_fit() {
    const WALL: &str = include_str!("../../../../../cases/glass_on_wall.toml");
    let sized = "diameter_1_mm,speed_m_s,e\n10,0.2,0.9\n";
    for (case, data, set, expected) in [
        (WALL, PAIRINGS, "", "e.csv:4: diameter_1_mm|is a wall|leave the column out"),
        (
            GLASS,
            "speed_m_s,e\n1e-6,0.9\n1e3,0.9\n",
            "",
            "no mesh for all speeds from|split the data by speed|--model ting",
        ),
        (
            GLASS,
            sized,
            "--set mesh.refined_radius=0.02",
            "error: --set mesh.refined_radius=…:1:21: ",
        ),
        (
            GLASS,
            sized,
            "--set body.0.sphere.mesh='no.vtu'",
            "error: --set body.0.sphere.mesh=…:1:20: ",
        ),
    ] {
        let place = Place::with(case);
        place.write("e.csv", data);
        let ran = place.fails(2, ("calibrate case.toml --data e.csv", set));
        ran.tells(expected);
        assert_eq!(ran.stderr.contains("--set"), !set.is_empty(), "{}", ran.stderr);
    }
}

/// A polymer ball on a steel plate.
const RIG: &str = r#"
    material.polymer = { density = "1200 kg/m^3", youngs_modulus = "3 GPa", poissons_ratio = 0.35,
        relaxation = { acts_on = "all", terms = [{ weight = 0.2, relaxation_time = "100 us" }] } }
    body = [{ name = "plate", plate.thickness = "5 mm", material = "lib:steel" },
            { name = "ball", sphere.diameter = "10 mm", material = "polymer", approach_speed = "1 m/s" }]
    model.ting.finite_size = true"#;

/// The loss of a ball on a plate is that of its material if the case has the plate, and far from it if the case has a
/// half-space.
#[test]
fn calibrations_and_fits_take_the_plate_with_them() {
    let place = Place::with(RIG);
    let speeds = "case = \"case.toml\"\n[vary]\n\"body.1.approach_speed\" = [0.1, 0.3, 1.0]\n";
    place.write("sweep.toml", speeds);
    place.succeed("sweep sweep.toml --out drops --quiet");
    let calibrate = "calibrate case.toml --material polymer --data drops/sweep.csv --terms 1 --times '100 us..100 us'";
    let half_space = set(&["body.0={name='block',half_space={},material='lib:steel'}"]);
    let weight = |folder: &str| {
        number(&place.json(format!("{folder}/calibrate.json").as_str())["terms"][0]["weight"])
    };
    // The plate and the soft ball choose the model and the material.
    let plain = calibrate.replace("--material polymer ", "");
    place.succeed((plain.as_str(), "--out plate"));
    assert!((weight("plate") - 0.2).abs() < 1e-4, "{}", weight("plate"));
    place.succeed((calibrate, "--model ting --out block", half_space.clone()));
    assert!(weight("block") > 0.25, "{}", weight("block"));

    let fit = "fit case.toml --data drops/sweep.csv --law kuwabara_kono";
    let time = |folder: &str| {
        number(&place.json(format!("{folder}/fit.json").as_str())["parameters"][0]["value"])
    };
    place.succeed((fit, "--out of_plate"));
    place.succeed((fit, "--out of_block", half_space));
    assert!(time("of_plate") < 0.8 * time("of_block"), "{} {}", time("of_plate"), time("of_block"));
    // Trial series that relax more have contacts beyond the first order of finite size, and the answer does not.
    place.write("fast.toml", &speeds.replace("0.1, 0.3, 1.0", "1.0, 2.25"));
    place.succeed("sweep fast.toml --out fast --quiet");
    let ran = place.succeed((
        "calibrate case.toml --material polymer --data fast/sweep.csv --terms 1 --times '100 us..100 us'",
        "--model ting --out of_fast",
    ));
    assert!((weight("of_fast") - 0.2).abs() < 1e-4, "{}", weight("of_fast"));
    assert!(!ran.stderr.contains("finite size"), "{}", ran.stderr);
    // The case names the model that the calibration has.
    assert!(!ran.stderr.contains("is ignored"), "{}", ran.stderr);
    // An impact that is too fast for the model is left out, and the others give the answer.
    let rows = place.text("plate/residuals.csv");
    let rows = rows.lines().skip(1).map(|row| row.split(',').collect::<Vec<_>>());
    let rows: String = rows.map(|row| format!("{},{}\n", row[2], row[3])).collect();
    place.write("faster.csv", &format!("speed_m_s,restitution\n{rows}9,0.8\n"));
    let ran =
        place.succeed((plain.replace("drops/sweep.csv", "faster.csv").as_str(), "--out faster"));
    assert!((weight("faster") - 0.2).abs() < 1e-4, "{}", weight("faster"));
    ran.prints("1 of 4 points, from 9.000 m/s on, are left out");
    // What no series makes is said first.
    place.write("none.csv", "v,e,u(e)\n1,0.8,0.001\n0.5,0.99,0.001\n0.2,0.85,0.001\n");
    let ran = place.succeed(plain.replace("drops/sweep.csv", "none.csv").as_str());
    assert!(ran.stdout.starts_with("no Prony series fits these data: "), "{}", ran.stdout);

    // What no closed form has is refused.
    place.fails(2, (calibrate, "--model condensed")).tells("no plate that bends|--model ting");
    let bonded = set(&["body.0.plate.support='bonded'"]);
    place.fails(2, (calibrate, "--model ting", bonded)).tells("bonded below");
    let small = set(&["body.0.plate.diameter='2 cm'"]);
    place.fails(1, (calibrate, "--model ting", small)).tells("diameter of the plate");
}

/// The record of a ball that bounces on a plate gives back the relaxation that it was made with, inside its range and within a tenth,
/// if the case has the plate; without it the relaxation is off by 30 ranges.
#[test]
fn bounces_on_a_plate_give_the_relaxation_of_the_ball() {
    let place = Place::with(include_str!("../../../../../cases/polymer_drop.toml"));
    place.write("drops.csv", include_str!("../../../../../validation/data/plate_drops.csv"));
    let air = ["--diameter", "20 mm", "--density", "1190 kg/m^3", "--contact-time", "200 ± 20 us"];
    place.succeed(("measure drops.csv --out record", air));
    let calibrate = "calibrate case.toml --data record/measure.csv --material polymer --model ting --terms 1 \
                     --times 200us..200us --out";
    let half_space = set(&["body.0={name='block',half_space={},material='plate-steel'}"]);
    place.succeed((calibrate, "plate"));
    place.succeed((calibrate, "block", half_space));
    let sum = |folder: &str| {
        let sum = place.json(format!("{folder}/calibrate.json").as_str())["weight_sum"].clone();
        (number(&sum["value"]), number(&sum["range"][0]), number(&sum["range"][1]))
    };
    let (found, low, high) = sum("plate");
    assert!(low < 0.2 && 0.2 < high && high - low < 0.04, "{found}: {low} to {high}");
    let (found, low, high) = sum("block");
    assert!(found - 0.2 > 15.0 * (high - low), "{found}: {low} to {high}");
}

/// Uncertain sizes and moduli of the rig are in the bars of a calibration and of a fit, part by part: half of the difference of
/// the answers with either end. Data of a plate at the end of its tolerance are beyond the bar of the data alone, and
/// inside the whole one.
#[test]
fn bars_have_the_uncertain_inputs_of_the_rig() {
    let place = Place::with(RIG);
    let speeds = "case = \"case.toml\"\n[vary]\n\"body.1.approach_speed\" = [0.1, 0.15, 0.3, 0.5, 0.8, 1.0]\n";
    place.write("sweep.toml", speeds);
    place.succeed((
        "sweep sweep.toml --out drops --quiet",
        set(&["body.0.plate.thickness='4.6 mm'"]),
    ));
    let calibrate = "calibrate case.toml --material polymer --data drops/sweep.csv --model ting --terms 1 \
                     --times '100 us..100 us' --regularisation 0";
    let fit = "fit case.toml --data drops/sweep.csv --law kuwabara_kono";
    let numbers = |name: &str, values: &[&str]| -> (Value, Value) {
        place.succeed((calibrate, "--out", &format!("{name}_c"), set(values)));
        place.succeed((fit, "--out", &format!("{name}_f"), set(values)));
        (
            place.json(&format!("{name}_c/calibrate.json"))["terms"][0].clone(),
            place.json(&format!("{name}_f/fit.json"))["parameters"][0].clone(),
        )
    };
    let end = |name, end: &str| numbers(name, &[&format!("body.0.plate.thickness='{end}'")]);
    let (thin, thick) = (end("thin", "4.6 mm"), end("thick", "5.4 mm"));
    let rig = [
        "body.0.plate.thickness='5.0 ± 0.4 mm'",
        "body.1.sphere.diameter='10.0 ± 0.1 mm'",
        "material.polymer.youngs_modulus='3.0 ± 0.1 GPa'",
    ];
    let (term, a) = numbers("rig", &rig);
    let stored = place.json("rig_c/calibrate.json");
    let parts = stored["inputs"].as_array().unwrap();
    let keys: Vec<&str> = parts.iter().map(|part| part["key"].as_str().unwrap()).collect();
    assert_eq!(keys.len(), 3, "{keys:?}");
    let part = |stored: &Value, result: &str| {
        let parts = stored["inputs"].as_array().unwrap();
        let thickness = |part: &&Value| part["key"].as_str().unwrap().ends_with("thickness");
        number(&parts.iter().find(thickness).unwrap()["changes"][result])
    };
    let half =
        |thick: &Value, thin: &Value| 0.5 * (number(&thick["value"]) - number(&thin["value"]));
    let half_weight = 0.5 * (number(&thick.0["weight"]) - number(&thin.0["weight"]));
    assert!((part(&stored, "g1") / half_weight - 1.0).abs() < 1e-3, "{stored} {half_weight}");
    let stored_fit = place.json("rig_f/fit.json");
    // A change of ln A, not of A: second order of a tenth.
    assert!((part(&stored_fit, "a") / half(&thick.1, &thin.1) - 1.0).abs() < 0.02, "{stored_fit}");

    // Bars: the whole has the true weight, that of the data alone has not.
    let within = |range: &Value| number(&range[0]) < 0.2 && 0.2 < number(&range[1]);
    assert!(within(&term["range"]) && !within(&term["range_of_data"]), "{term}");
    let squares = stored_fit["inputs"].as_array().unwrap().iter();
    let squares: f64 = squares.map(|part| number(&part["changes"]["a"]).powi(2)).sum();
    let whole = (squares + number(&a["standard_error_of_data"]).powi(2)).sqrt();
    assert!((number(&a["standard_error"]) / whole - 1.0).abs() < 1e-9, "{a}");
    let again = place.succeed((fit, "--out again", set(&rig)));
    again.prints(
        "by the data, |by body.0.plate.thickness ± 8 %|by material.polymer.youngs_modulus ± 3.3 %",
    );
    let again = place.succeed((calibrate, "--out again_c", set(&rig)));
    again.prints("range by the data alone|by body.1.sphere.diameter ± 1 %");

    // The band of e(v) without the plate: its part of the thickness is half of the difference of what both ends give.
    let block = set(&["body.0={ name='plate', half_space={}, material='lib:steel' }"]);
    let band = |name: &str| -> (String, Vec<f64>) {
        place.succeed((&format!("export case.toml --fit {name}_f --out {name}_e"), &block));
        let text = place.text(format!("{name}_e/restitution_band.csv"));
        let row = text.lines().nth(40).unwrap().split(',').map(|cell| cell.parse().unwrap());
        (text.lines().next().unwrap().to_string(), row.collect())
    };
    let (_, thin) = band("thin");
    let (_, thick) = band("thick");
    let (header, whole) = band("rig");
    let column = header.split(',').position(|name| name.ends_with("thickness")).unwrap();
    let half = 0.5 * (thick[1] - thin[1]);
    assert!((whole[column] / half - 1.0).abs() < 0.05, "{header} {whole:?} {half}");
    let squares: f64 = whole[5..].iter().map(|part| part * part).sum();
    let reach = whole[4].hypot(1.959_964 * squares.sqrt());
    assert!(((whole[1] - whole[2]) / reach - 1.0).abs() < 1e-6, "{whole:?} {reach}");
    // On the plate itself the data say what e(v) is, but for the change of its share with speed.
    place.succeed(("export case.toml --fit rig_f --out on_plate", set(&rig)));
    let text = place.text("on_plate/restitution_band.csv");
    let row: Vec<f64> =
        text.lines().nth(40).unwrap().split(',').map(|cell| cell.parse().unwrap()).collect();
    assert!(row[column].abs() < 0.2 * half.abs(), "{row:?} {half}");
}

/// `invert` solves again with the restitution and each input at both ends, and adds the changes as squares.
#[test]
fn an_inversion_has_the_uncertain_inputs_of_the_rig() {
    let place = Place::with(RIG);
    let invert = "invert case.toml --law kuwabara_kono --restitution";
    // kuwabara_kono  a  6.7 µs  6.7e-6  102 µs
    let value = |restitution: &str, thickness: &str| {
        let thickness = format!("body.0.plate.thickness='{thickness}'");
        let ran = place.succeed((invert, [restitution], set(&[&thickness])));
        let last = ran.stdout.lines().last().unwrap();
        last.split_whitespace().nth(4).unwrap().parse::<f64>().unwrap()
    };
    let half = |upper: f64, lower: f64| 0.5 * (upper - lower).abs();
    let of_data = half(value("0.66", "5 mm"), value("0.64", "5 mm"));
    let of_plate = half(value("0.65", "5.1 mm"), value("0.65", "4.9 mm"));
    let set =
        set(&["body.0.plate.thickness='5.0 ± 0.1 mm'", "gravity.acceleration='9.81 ± 0.01 m/s^2'"]);
    let ran = place.succeed((invert, ["0.65 ± 0.01"], set));
    let whole = of_data.hypot(of_plate);
    let line = ran.stdout.lines().find(|line| line.starts_with("kuwabara_kono")).unwrap();
    let (_, error) = line.split_once(" ± ").unwrap();
    let error: f64 = error.split_whitespace().next().unwrap().parse().unwrap();
    // Three digits are printed.
    assert!((error / (1e6 * whole) - 1.0).abs() < 5e-3, "{line} {whole}");
    ran.prints("uncertain input|restitution ± 1.5 %|body.0.plate.thickness ± 2 %");
    assert!(!ran.stdout.contains("gravity"), "{}", ran.stdout);
    place.fails(2, (invert, ["0.65 ± -0.01"])).tells("an uncertainty is at least 0");
    place.fails(2, (invert, ["0.65 ± x"])).tells("such as 0.9 or '90 %'");
}

/// Prior knowledge and one restitution: both parts are printed and stored.
#[test]
fn calibrate_says_what_prior_and_data_contribute() {
    let place = Place::with(include_str!("../../../../../validation/data/polymer_ball.toml"));
    place.write(
        "dma_polymer.relaxation.toml",
        include_str!("../../../../../validation/data/dma_polymer.relaxation.toml"),
    );
    place.write("e.csv", "speed_m_s,restitution\n0.2,0.9903\n");
    let command = "calibrate case.toml --data e.csv --model ting --prior --out found";
    place.fails(2, command).tells("prior knowledge needs data with uncertainties|--uncertainty");
    let both = format!("{command} --terms 3 --uncertainty 0.002");
    place.fails(2, both.as_str()).tells("--terms");
    let good = format!("{command} --uncertainty 0.002 --set scene.temperature=263.15");
    place
        .succeed(good.as_str())
        .prints("by the measured relaxation|the data determine 0.9 of 14 weights");
    let numbers = place.json("found/calibrate.json");
    let mean = &numbers["prior"]["mean_restitution"];
    let error = |of: &str| number(&mean[of]["error"]);
    assert!(error("both") < error("data") && error("both") < error("prior"), "{mean}");
    assert!(number(&numbers["terms"][0]["prior"]["error"]) > 0.0);
    assert!(place.text("found/relaxation.toml").contains("shift = {"));
}
