//! From a scene to the bodies of a reduced model.

use fem_case::{Case, Scene, Shape};
use fem_fit::{Family, FitError, Model};
use fem_laws::{EndRule, LawError, Pair, Partner};

/// The pair, moduli instantaneous.
///
/// # Errors
/// Numbers so extreme that they leave the range of f64.
pub fn pair_of(scene: &Scene) -> Result<Pair, LawError> {
    let [first, second] = scene.bodies.each_ref().map(|body| match &body.shape {
        Shape::Sphere { diameter, material, .. } => Partner::solid_sphere(*diameter, material),
        Shape::Wall => Partner::Wall,
    });
    Pair::new(first, second)
}

/// The bodies of a case under a law.
///
/// # Errors
/// As [`pair_of`]; Ting's model of bodies that do not relax.
pub fn model_of(case: &Case, family: Family, end_rule: EndRule) -> Result<Model, FitError> {
    let pair = pair_of(&case.scene)?;
    let materials = case.scene.bodies.each_ref().map(|body| body.material().cloned());
    Model::new(&pair, materials, family, end_rule)
}

/// The relative speed of the case, m/s.
pub fn approach_speed(scene: &Scene) -> f64 {
    scene.bodies[0].velocity - scene.bodies[1].velocity
}
