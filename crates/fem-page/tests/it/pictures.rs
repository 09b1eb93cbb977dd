//! Pictures of a collision, and charts that a page requests.

use fem_page::{ChartSpec, RecordedAmount, Session};

use crate::session::{CONDENSED, GLASS, run};

const ASK: RecordedAmount = RecordedAmount { rows: 300, frames: 3 };

/// The middle of three recorded times is within one step of the largest approach: its stress is the largest
/// pressure, recovered from elements of a twelfth of the contact radius, and its force the largest force.
#[test]
fn picture_at_maximum_approach_has_the_largest_pressure() {
    let mut session = Session::default();
    let outcome = run(&mut session, &(GLASS.to_string() + CONDENSED), ASK);
    assert_eq!(outcome.frames.len(), 3);
    let [first, middle] = [0, 1].map(|k| session.picture(k, 2.5).expect("elements"));
    let pressure = outcome.summary.collision.peak_pressure_pa.unwrap();
    assert!((-middle.range_pa.0 / pressure - 1.0).abs() < 0.06, "{:?}", middle.range_pa);
    let force = outcome.summary.collision.peak_force_n.unwrap();
    // An elastic pulse falls by a hundredth within a twentieth of its length from its peak.
    assert!((outcome.frames[1].contact_force_n.unwrap() / force - 1.0).abs() < 0.01);
    // All times have one scale, and every band has a colour on light and on dark backgrounds.
    assert_eq!(
        (first.bar.as_str(), first.dark_rules.as_str()),
        (&*middle.bar, &*middle.dark_rules)
    );
    assert!(middle.svg.contains("in striker (below) and target (above)"));
    assert!(middle.svg.contains("class=\"n9\"") && !first.svg.contains("class=\"n9\""));
    assert!(session.picture(3, 2.5).is_none());
    // No window reaches farther than the larger sphere to each side, 22.2 mm.
    let [whole, beyond] = [200.0, 1e9].map(|width| session.picture(0, width).unwrap().svg);
    assert_eq!(whole, beyond);
}

#[test]
fn model_without_elements_has_curves_and_no_picture() {
    let mut session = Session::default();
    let outcome = run(&mut session, &(GLASS.to_string() + "\n[model]\nting = {}\n"), ASK);
    assert!(session.picture(0, 2.5).is_none() && outcome.frames.is_empty());
    for chart in [&outcome.charts.force, &outcome.charts.approach] {
        let svg = chart.as_deref().expect("a curve");
        assert!(svg.contains(">Hertz<") && svg.contains("[µs]"), "{svg}");
    }
}

/// An energy that is negligible next to the others has no curve: glass without relaxation loses no energy
/// to it.
#[test]
fn negligible_energies_have_no_curve() {
    let of = |text: &str| {
        let outcome = run(&mut Session::default(), &(text.to_string() + CONDENSED), ASK);
        outcome.charts.energy.expect("energies")
    };
    let elastic = include_str!("../../../../cases/glass_0.5ms_elastic.toml");
    assert!(of(GLASS).contains(">viscous dissipation<"));
    assert!(!of(elastic).contains("dissipation") && of(elastic).contains(">relative motion<"));
}

/// Ting's model separates stored energy from heat only at the end: until then they are one curve, from
/// first touch on.
#[test]
fn ting_shows_stored_and_dissipated_energy_as_one_curve() {
    let ting = GLASS.to_string() + "\n[model]\nting = {}\n";
    let chart = run(&mut Session::default(), &ting, ASK).charts.energy.expect("energies");
    assert!(chart.contains(">deformation and heat<"), "{chart}");
    assert!(!chart.contains(">strain<") && !chart.contains(">viscous dissipation<"));
}

/// Far away a sphere looks round although its mesh is coarse on the far side, and lengths are in a unit that
/// suits the window.
#[test]
fn whole_sphere_outline_is_round_with_short_tick_labels() {
    let mut session = Session::default();
    run(&mut session, &(GLASS.to_string() + CONDENSED), ASK);
    let [near, far] = [2.5, 200.0].map(|width| session.picture(1, width).unwrap().svg);
    assert!(near.contains("r [µm]") && far.contains("r [mm]"));
    assert!(far.contains(">−20<") && !far.contains("0000<"), "{far}");
    let outline = far.split("class=\"ink stroke\"").nth(1).and_then(|rest| rest.split('>').next());
    let path = outline.unwrap().split('"').find(|value| value.starts_with('M')).unwrap();
    let points = path[1..].split('L').map(|point| {
        let coordinates: Vec<f64> = point.split(' ').map(|x| x.parse().unwrap()).collect();
        [coordinates[0], coordinates[1]]
    });
    let points: Vec<[f64; 2]> = points.collect();
    let extent = |axis: usize| {
        let along = || points.iter().map(|point| point[axis]);
        [along().fold(f64::INFINITY, f64::min), along().fold(f64::NEG_INFINITY, f64::max)]
    };
    let [horizontal, vertical] = [0, 1].map(extent);
    let centre = [horizontal, vertical].map(|[least, most]| 0.5 * (least + most));
    let radius = 0.5 * (horizontal[1] - horizontal[0]);
    for side in points.windows(2) {
        let middle = [0, 1].map(|axis: usize| 0.5 * (side[0][axis] + side[1][axis]) - centre[axis]);
        let off = (middle[0].hypot(middle[1]) - radius).abs();
        assert!(off < 0.3, "a side of the outline is {off} px off the circle: {side:?}");
    }
}

#[test]
fn chart_spec_draws_curves_and_rejects_unknown_keys() {
    let spec = |text: &str| serde_json::from_str::<ChartSpec>(text);
    let chart = spec(
        r#"{"x": "speed [m/s]", "y": "T [µs]", "logarithmic": [true, true], "range": [40, 100], "curves":
            [{"label": "computed", "mark": "line", "points": [[0.1, 90.0], [1.0, 60.0]]},
             {"label": "measured", "mark": "points", "points": [[0.5, 66.0]]}]}"#,
    );
    let svg = chart.unwrap().svg().expect("points");
    // Points, and one mark per curve in the legend.
    assert_eq!(svg.matches("<circle").count(), 2 + 1 + 2);
    assert!(spec(r#"{"x": "", "y": "", "curves": []}"#).unwrap().svg().is_none());
    assert!(spec(r#"{"x": "", "y": "", "curves": [], "z": 1}"#).is_err());
}
