//! Laws of contacts that dent: from restitutions to a yield strength and to DEM codes.

use crate::common::{Place, number};

/// Returns the case of a striker of steel on a body of it; with the keys of the strength, of the lower body and of the ball.
fn case(strength: &str, lower: &str, ball: &str) -> String {
    format!(
        r#"
[material.steel]
density = "7850 kg/m^3"
youngs_modulus = "210 GPa"
poissons_ratio = 0.3
{strength}

[[body]]
name = "striker"
{ball}

[[body]]
name = "target"
{lower}
"#
    )
}

/// Returns the case of balls of 10 mm.
fn balls(strength: &str) -> String {
    let ball = "sphere.diameter = '10 mm'\nmaterial = 'steel'";
    case(strength, ball, &format!("{ball}\napproach_speed = '1 m/s'"))
}

const FLOWING: &str = "flow = { yield_strength = '1 GPa', hardening = 'perfect' }";

fn restitution(place: &Place, words: &str) -> f64 {
    place.succeed((words, "--out law --quiet --force"));
    number(&place.json("law/summary.json")["restitution"])
}

/// A flowing pair is exported by the mean-pressure law, with the laws that dent of each code; an elastic one is not.
#[test]
fn a_flowing_pair_is_exported_with_laws_that_dent() {
    let place = Place::with(&balls(FLOWING));
    let ran = place.succeed("export case.toml");
    ran.prints("at most 0.018|error of the law mean_pressure");
    ran.prints("LAMMPS' mdr and Luding's springs");
    let numbers = place.json("runs/case_export/export.json");
    let snippets = numbers["snippets"].as_array().unwrap();
    let worst = |file: &str| {
        let found = snippets.iter().find(|snippet| snippet["file"] == file).unwrap();
        number(&found["worst_error"])
    };
    let springs = ["liggghts_hooke_hysteresis.in", "yade_luding.py", "mercury_luding.cpp"];
    for file in springs.into_iter().chain(["lammps_mdr.in"]) {
        // Closer than one restitution for all speeds, and than a dashpot.
        assert!(
            worst(file) < worst("lammps_tsuji.in") && worst(file) < worst("lammps_viscoelastic.in")
        );
        assert!(
            place.text(format!("runs/case_export/{file}")).contains("leaves no dent"),
            "{file}"
        );
    }
    let svg = place.text("runs/case_export/export.svg");
    assert!(svg.contains("mean_pressure") && svg.contains("mdr of LAMMPS"));
    // A rate that is entered is that of each speed.
    let rate = "material.steel.flow.rate={johnson_cook={c=0.05, reference_rate='1 1/s'}}";
    place.succeed(["export", "case.toml", "--set", rate, "--out", "rate", "--quiet"]);
    let of = |numbers: &serde_json::Value, k: usize| number(&numbers["data"][k]["restitution"]);
    for k in [0, 12] {
        assert!(of(&place.json("rate/export.json"), k) > of(&numbers, k) + 0.02);
    }

    let elastic = Place::with(&balls(""));
    elastic.write("e.csv", "speed_m_s,restitution\n0.1,0.95\n1,0.9\n");
    elastic.succeed("export case.toml --data e.csv");
    assert!(!elastic.list("runs/case_export").contains(&"lammps_mdr.in".to_string()));
}

/// The exported law of bodies that dent is ten times as close as the best own law of any code, and the figure shows both.
#[test]
fn an_exported_law_stands_beside_the_codes_own_laws() {
    let place = Place::with(&balls(FLOWING));
    place.succeed("export case.toml --law");
    let numbers = place.json("runs/case_export/export.json");
    let (error, own) =
        (number(&numbers["law"]["restitution_error"]), numbers["own_laws"].as_array().unwrap());
    assert!(own.iter().any(|own| own["code"] == "LAMMPS"));
    assert!(own.iter().all(|own| number(&own["restitution_error"]) > 10.0 * error), "{numbers}");
    let svg = place.text("runs/case_export/export.svg");
    assert!(svg.contains("the exported law") && svg.contains("mdr of LAMMPS"));
}

/// A yield strength comes back from its restitutions by every command, and no relaxation is taken for it.
#[test]
fn a_yield_strength_comes_back_from_restitutions() {
    let place = Place::with(&balls(FLOWING));
    place.succeed("export case.toml --quiet");
    let data = place.json("runs/case_export/export.json")["data"].clone();
    let row =
        |point: &serde_json::Value| format!("{},{}\n", point["speed_m_s"], point["restitution"]);
    let rows: String = data.as_array().unwrap().iter().map(row).collect();
    place.write("e.csv", &format!("speed_m_s,restitution\n{rows}"));
    place.write("case.toml", &balls(""));

    let ran = place.succeed("fit case.toml --data e.csv --law all -v");
    ran.prints("yield_strength = 1|mean_pressure fits best of|the same curve as linear: tsuji");
    assert_eq!(ran.stdout.matches("the same curve as linear").count(), 1, "{}", ran.stdout);
    // Parameters that are not fitted are those of the case: like balls.
    let fit = place.json("runs/e_fit/fit.json");
    let values = fit["parameters"].as_array().unwrap().iter().map(|one| &one["value"]);
    assert!(values.clone().any(|value| value == 0.5), "{fit}");
    let e = data[6]["restitution"].as_f64().unwrap();
    let ran =
        place.succeed(format!("invert case.toml --law mean_pressure --restitution {e}").as_str());
    ran.prints("yield_strength  1.000 ± 0.0");

    let calibrate = "calibrate case.toml --data e.csv --model ting --terms 2";
    let ran = place.fails(2, calibrate);
    ran.tells("plastic flow explains these restitutions, and no relaxation does: a yield strength of 1.000 GPa");
    ran.tells("1 - e grows as the speed to the power 0.56");
    // A narrow range of speeds does not tell them apart.
    let narrow: String = rows.lines().take(3).map(|row| format!("{row},0.03\n")).collect();
    place.write("narrow.csv", &format!("speed_m_s,restitution,u\n{narrow}"));
    let ran = place.succeed("calibrate case.toml --data narrow.csv --model ting --terms 2");
    ran.prints("explains these restitutions too");
}

/// A ball of 12 mm of steel on a plate of steel; elements have a restitution of 0.223 on 5 mm and of 0.334 on 10 mm.
#[test]
fn the_plate_is_in_the_export_of_bodies_that_flow() {
    let strength = "flow = { yield_strength = '235 MPa', rate = { johnson_cook = { c = 0, reference_rate = '1 1/s' } } }";
    let ball = "sphere.diameter = '12 mm'\nmaterial = 'steel'\napproach_speed = '3 m/s'";
    for (thickness, elements) in [("5 mm", 0.223), ("10 mm", 0.334)] {
        let plate = format!("plate = {{ thickness = '{thickness}' }}\nmaterial = 'steel'");
        let place = Place::with(&case(strength, &plate, ball));
        place.succeed("export case.toml --quiet");
        let middle = &place.json("runs/case_export/export.json")["data"][6];
        assert!((number(&middle["speed_m_s"]) - 3.0).abs() < 1e-9);
        let e = number(&middle["restitution"]);
        assert!((e - elements).abs() < 0.005, "{thickness}: {e}");
        // The law itself has the same plate.
        let own = restitution(&place, "case.toml --set model.law={mean_pressure={}}");
        assert!((e - own).abs() < 1e-3, "{thickness}: {e} {own}");
    }
}

/// A strength that is found from a restitution is at the strain rate of the contact. The one at the reference rate of the flow rule, in a
/// case, gives that restitution, also if the case began with another.
#[test]
fn a_strength_that_is_found_goes_into_the_case_at_the_reference_rate() {
    let place_of = |strength: f64| {
        let rate = "rate = { johnson_cook = { c = 0.05, reference_rate = '1 1/s' } }";
        let flow =
            format!("flow = {{ yield_strength = {strength:?}, hardening = 'perfect', {rate} }}");
        let ball = "sphere.diameter = '10 mm'\nmaterial = 'steel'\napproach_speed = '2 m/s'";
        Place::with(&(case(&flow, "wall = {}", ball) + "[model]\nlaw = { mean_pressure = {} }\n"))
    };
    let e = restitution(&place_of(300e6), "case.toml");
    for start in [300e6, 400e6] {
        let words = format!("invert case.toml --law mean_pressure --restitution {e}");
        let ran = place_of(start).succeed(words.as_str());
        ran.prints("yield_strength is at the strain rate of the contact");
        let (_, found) = ran.stdout.split_once("at the reference rate it is ").unwrap();
        let strength: f64 = found.split(' ').next().unwrap().parse().unwrap();
        let again = restitution(&place_of(1e6 * strength), "case.toml");
        assert!((again - e).abs() < 1e-3, "{start}: {strength} {again} {e}");
    }
}

/// The strength of a block of steel under a ball of alumina that stays elastic, from the restitutions of a run of the law with the
/// strength of the material; and that of a material that hardens by a line.
#[test]
fn a_strength_is_that_of_the_body_that_yields_with_its_hardening() {
    let block = "half_space = {}\nmaterial = 'steel'";
    let ball = "sphere.diameter = '5 mm'\nmaterial = 'lib:alumina'\napproach_speed = '2 m/s'";
    for flow in [
        "yield_strength = '300 MPa'",
        "flow = { yield_strength = '300 MPa', hardening = { modulus = '800 MPa' }, \
         rate = { johnson_cook = { c = 0, reference_rate = '1 1/s' } } }",
    ] {
        let place = Place::with(&case(flow, block, ball));
        let e = restitution(&place, "case.toml --set model.law={mean_pressure={}}");
        let invert = format!("invert case.toml --law mean_pressure --restitution {e}");
        place.succeed(invert.as_str()).prints("300 ±");
    }
}
