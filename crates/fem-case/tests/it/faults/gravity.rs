//! Gravity, its support, and bounces; their faults are in the table.

use super::message_table::{GRAVITY, parse};

/// A ball is supported by a held sphere as by a wall; without gravity nothing bounces.
#[test]
fn a_falling_sphere_is_supported_by_a_held_one() {
    let held = "sphere = { diameter = 0.03 }\nmaterial = \"glass\"\nheld = true";
    parse(&GRAVITY.replace("wall = {}", held)).unwrap();
    // A table without keys is valid.
    let (still, _) = GRAVITY.split_once("[gravity]").unwrap();
    parse(&format!("{still}[stop]\n")).unwrap();
}

/// Torricelli: √(v² + 2 g h), thrown down or up; time of flight from h + v t − g t²/2 = 0.
#[test]
fn a_body_at_rest_falls() {
    let scene = |speed: &str| {
        parse(&GRAVITY.replace("approach_speed = 0.5", speed)).unwrap().scene().clone()
    };
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
