//! Exported laws of DEM codes: the curve that they are fitted to, and every pair of some grains.

use fem_case::Case;
use fem_data::table::{Point, Restitutions};
use fem_study::laws::{ImpactCurve, PairExport};

fn case() -> Case {
    let text = "[[body]]
        name = 'floor'
        wall = {}
        [[body]]
        name = 'ball'
        sphere.diameter = 0.02
        material = 'lib:pmma'
        approach_speed = 0.1
        [model.law.kuwabara_kono]
        a = 1e-6";
    Case::parse("ball.toml", text, std::path::Path::new("."), &[]).unwrap()
}

/// An export of pairs has three pairs of two sizes, and names a material that does not exist.
#[test]
fn pairs_of_all_sizes_are_exported() {
    let case = case();
    let of =
        |materials: &[String]| PairExport::of(&case, materials, &[1e-3, 2e-3], None, 0.01, false);
    let unknown = of(&["lib:glas".to_string()]).unwrap_err();
    assert_eq!(unknown.to_string(), "there is no material lib:glas");
    assert_eq!(of(&[]).unwrap().numbers().len(), 3);
}

/// A line over the logarithm of speed has no scatter, and alternating errors ± s have the standard deviation s in the
/// mean of many: each point is 2 s from the line between its neighbours.
#[test]
fn the_scatter_of_points_is_that_about_a_smooth_curve() {
    let case = case();
    let deviation = |error: f64, n: i32| {
        let point = |k: i32| {
            let (speed, sign) = (0.1 * 1.1f64.powi(k), if k % 2 == 0 { 1.0 } else { -1.0 });
            Point::new(speed, 0.9 - 0.02 * speed.ln() + sign * error)
        };
        let data = Restitutions {
            points: (0..n).map(point).collect(),
            ..Restitutions::of("curve", &[(0.1, 0.9)])
        };
        ImpactCurve::measured(case.scene(), &data).unwrap().scatter / 3.0
    };
    assert!(deviation(0.0, 40) < 1e-12);
    let expected = 0.02 * 2.0 / 1.5f64.sqrt();
    assert!((deviation(0.02, 40) / expected - 1.0).abs() < 1e-9);
    assert_eq!(deviation(0.02, 2), 0.0);
}
