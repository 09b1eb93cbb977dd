//! Faults of gravity, its support, and bounces.

use super::message_table::{error_at_mark, parse};

const BALL: &str = "[material.glass]\ndensity = 2390\nyoungs_modulus = 63e9\npoissons_ratio = 0.2\n\
                    [[body]]\nname = \"floor\"\nwall = {}\n\
                    [[body]]\nname = \"ball\"\nsphere = { diameter = 0.02 }\nmaterial = \"glass\"\n\
                    approach_speed = 0.5\n\
                    [start]\ngap = 0.1\n\
                    [gravity]\nacceleration = \"9.81 m/s^2\"\n\
                    [stop]\nbounces = 3\n";
const WALL: &str = "wall = {}";
const SPHERE: &str = "sphere = { diameter = 0.03 }\nmaterial = \"glass\"";
const GRAVITY: &str = "[gravity]\nacceleration = \"9.81 m/s^2\"\n";
const STOP: &str = "[stop]\nbounces = 3\n";

/// Replaces parts of the case; the error must point at the marked text.
fn fault(changes: &[(&str, &str)], message: &str, help: &str) {
    let text = changes.iter().fold(BALL.to_string(), |text, (from, to)| {
        assert!(text.contains(from), "{from} is not in {text}");
        text.replacen(from, to, 1)
    });
    let error = error_at_mark(&text);
    assert!(error.message().contains(message), "{error}");
    assert!(error.help().unwrap_or_default().contains(help), "{error}");
}

#[test]
fn a_falling_sphere_needs_a_support() {
    parse(BALL).unwrap();
    parse(&BALL.replace(WALL, &format!("{SPHERE}\nheld = true"))).unwrap();
    let (weight, held) = ("«[gravity]»", format!("{SPHERE}\nheld = true"));
    fault(
        &[(WALL, SPHERE), ("[gravity]", weight)],
        "nothing supports the free sphere \"floor\"",
        "held = true",
    );
    let above = "sphere = { diameter = 0.02 }\nmaterial = \"glass\"\napproach_speed = 0.5\n";
    fault(
        &[(WALL, &held), (above, "wall = {}\n"), ("[gravity]", weight)],
        "is not a sphere",
        "wall",
    );
    fault(
        &[(WALL, &held), ("approach_speed = 0.5", "approach_speed = 0.5\nheld = «true»")],
        "both bodies are held",
        "free sphere",
    );
    fault(&[("approach_speed = 0.5", "held = «true»")], "is held and cannot fall", "free sphere");
    fault(&[(WALL, "wall = {}\nheld = «true»")], "is not a sphere", "remove the key");
    fault(&[(WALL, "wall = {}\napproach_speed = «0.1»")], "moves", "remove approach_speed");
}

#[test]
fn held_and_bounces_need_gravity() {
    fault(&[(GRAVITY, ""), ("= 3", "= «3»")], "stop.bounces needs [gravity]", "9.81 m/s^2");
    let held = format!("{SPHERE}\nheld = «true»");
    fault(
        &[(GRAVITY, ""), (STOP, ""), (WALL, &held)],
        "is held, but there is no [gravity]",
        "9.81 m/s^2",
    );
    // A table without keys is valid.
    parse(&BALL.replace(GRAVITY, "").replace(STOP, "[stop]\n")).unwrap();
}

#[test]
fn gravity_and_bounces_reject_values_out_of_range() {
    for wrong in ["«0»", "«-9.81»", "«\"9.81 m/s\"»", "«nan»"] {
        fault(&[("\"9.81 m/s^2\"", wrong)], "", "");
    }
    fault(&[(GRAVITY, "«[gravity]»\n")], "acceleration", "");
    for wrong in ["«0»", "«1.5»", "«20000»", "«nan»"] {
        fault(&[("bounces = 3", &format!("bounces = {wrong}"))], "bounces is", "");
    }
    let at_rest = [("approach_speed = 0.5\n", ""), ("gap = 0.1", "gap = «0»")];
    fault(&at_rest, "would never reach its support (impact speed 0.000 m/s)", "gap = \"10 cm\"");
}

/// Torricelli: √(v² + 2 g h), thrown down or up; time of flight from h + v t − g t²/2 = 0.
#[test]
fn a_body_at_rest_falls() {
    let scene =
        |speed: &str| parse(&BALL.replace("approach_speed = 0.5", speed)).unwrap().scene().clone();
    let fall = (2.0 * 9.81 * 0.1_f64).sqrt();
    let dropped = scene("");
    assert!((dropped.approach_speed() / fall - 1.0).abs() < 1e-15);
    assert!((dropped.first_touch() - fall / 9.81).abs() < 1e-15);
    for speed in [0.5, -0.5] {
        let thrown = scene(&format!("approach_speed = {speed}"));
        let impact = (0.25 + 2.0 * 9.81 * 0.1_f64).sqrt();
        assert!((thrown.approach_speed() / impact - 1.0).abs() < 1e-15);
        let time = thrown.first_touch();
        assert!((0.1 - speed * time - 0.5 * 9.81 * time * time).abs() < 1e-15);
    }
    let later = dropped.touching_at(0.2).unwrap();
    assert_eq!((later.approach_speed(), later.first_touch()), (0.2, 0.0));
    assert_eq!(dropped.gravity().unwrap().bounces, 3);
    assert!(dropped.touching_at(0.0).is_none() && dropped.touching_at(f64::NAN).is_none());
}
