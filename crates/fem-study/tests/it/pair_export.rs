//! Laws of DEM codes for every pair of some grains.

use fem_study::laws::PairExport;

/// An export of pairs has three pairs of two sizes, and names a material that does not exist.
#[test]
fn pairs_of_all_sizes_are_exported() {
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
    let case = fem_case::Case::parse("ball.toml", text, std::path::Path::new("."), &[]).unwrap();
    let of =
        |materials: &[String]| PairExport::of(&case, materials, &[1e-3, 2e-3], None, 0.01, false);
    let unknown = of(&["lib:glas".to_string()]).unwrap_err();
    assert_eq!(unknown.to_string(), "there is no material lib:glas");
    assert_eq!(of(&[]).unwrap().numbers().len(), 3);
}
