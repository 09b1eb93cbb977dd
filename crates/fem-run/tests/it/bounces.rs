//! A shipped case of a bouncing ball, from the command to the files.

use fem_vtk::VtuFile;

use crate::common::Place;

const BALL: &str = include_str!("../../../../cases/three_bounces.toml");

#[test]
fn bounces_are_printed_and_written_to_summary_and_history() {
    for (model, has_rest) in [("ting", false), ("condensed", true)] {
        let place = Place::new();
        place.write("ball.toml", BALL);
        let model = format!("model.{model}={{}}");
        let bounces = if has_rest { "stop.bounces=500" } else { "stop.bounces=3" };
        let set =
            ["ball.toml", "--set", model.as_str(), "--set", bounces, "--verbose", "--out", "out"];
        let printed = place.succeed(set).stdout;
        assert!(printed.contains("bounce ") && printed.contains("\n3 "), "{printed}");
        assert_eq!(printed.contains("at rest from"), has_rest, "{printed}");
        let summary = place.json("out/summary.json");
        let contacts = summary["bounces"].as_array().unwrap();
        assert_eq!(contacts.len() == 3, !has_rest, "{}", contacts.len());
        assert_eq!(contacts[0]["restitution"], summary["restitution"]);
        let keys: Vec<&String> = contacts[0].as_object().unwrap().keys().collect();
        let named = [
            "speed_before_m_s",
            "restitution",
            "restitution_uncertainty",
            "measured_restitution",
            "contact_time_s",
            "peak_force_n",
            "time_s",
        ];
        assert_eq!(keys, named);
        assert_eq!(summary["rest"].is_object(), has_rest);
        assert_eq!(summary["complete"], true);
        assert!(summary["energy"]["potential_j"].is_number());
        let page = place.text("out/report.html");
        assert_eq!(page.contains("Velocity v, upward"), contacts.len() > 1);
        assert_eq!(page.contains("Height h ["), contacts.len() > 1);
        place.succeed(["plot", "out", "--what", "bounces"]);
        assert_eq!(place.text("out-bounces.svg").matches("<g transform").count(), 2);
        let history = place.text("out/history.csv");
        let header = history.lines().next().unwrap();
        assert!(header.ends_with("residual_j,potential_j,left_before_j"), "{header}");
    }
}

/// As without gravity, half of the gap is drawn on each side of y = 0, so the floor is half a height below.
#[test]
fn a_ball_that_fell_is_drawn_on_the_floor() {
    let place = Place::new();
    place.write("ball.toml", BALL);
    place.succeed(["ball.toml", "--set", "model.condensed={}", "--out", "out"]);
    let file = VtuFile::open(place.path("out/ball_1_maximum.vtu")).unwrap();
    let points = file.quad_mesh().unwrap().points;
    let displacement = file.point_data("displacement").unwrap();
    let displaced = displacement.as_float().unwrap().chunks_exact(3);
    let lowest = |heights: &mut dyn Iterator<Item = f64>| heights.fold(f64::INFINITY, f64::min);
    assert_eq!(lowest(&mut points.iter().map(|point| point[1])), 0.01);
    // Contact is exact up to rounding of the height.
    let now = lowest(&mut points.iter().zip(displaced).map(|(point, u)| point[1] + u[1]));
    assert!((now + 0.01).abs() < 1e-12, "{now:e}");
}
