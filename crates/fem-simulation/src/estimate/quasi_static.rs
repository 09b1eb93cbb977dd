//! Ting's quasi-static impact of a scene, which predicts approach and contact time of relaxing bodies.

use std::sync::{Arc, Mutex};

use fem_case::{Body, Scene, Shape, Switch};
use fem_laws::{FiniteSize, Impact, LawError, Pair, PairRelaxation, Ting};
use fem_material::Material;

use crate::estimate::plate_impact::{plate_mobility_of, thin_plate_mobility};
use crate::plan::pair_cache::lock;

/// Returns Ting's impact of a scene between half-spaces, or with the compliance of finite spheres in series, however large
/// the contact.
///
/// # Errors
/// Parameters that the law rejects.
pub fn ting_impact(scene: &Scene, pair: &Pair, finite_size: bool) -> Result<Impact, LawError> {
    let size = finite_size.then(|| scene.finite_size()).transpose()?;
    ting_of(scene, pair, true, size)?.impact(scene.approach_speed())
}

/// Relative accuracy of an impact used for prediction only.
const ESTIMATE_TOLERANCE: f64 = 1e-3;

/// Impacts that are kept. The choice of a model needs two dozen, most of them once per candidate.
const KEPT_IMPACTS: usize = 32;

/// A viscoelastic pair, the speed of its impact (m/s), and the result.
type Known = (Ting, f64, Result<Arc<Impact>, LawError>);

/// Ting's impacts of a scene and its variants, which all estimates of them share.
#[derive(Clone, Debug, Default)]
pub(crate) struct KnownImpacts(Arc<Mutex<Vec<Known>>>);

/// Estimates are the same, whichever impacts are known.
impl PartialEq for KnownImpacts {
    fn eq(&self, _: &Self) -> bool {
        true
    }
}

impl KnownImpacts {
    /// Returns [`Ting::impact`], computed once. The effects compare impacts that are mostly the same. A failed impact,
    /// which takes longest, is kept too.
    pub(crate) fn impact(&self, ting: Ting, speed: f64) -> Result<Arc<Impact>, LawError> {
        let is_it = |(other, at, _): &&Known| *at == speed && *other == ting;
        if let Some((.., impact)) = lock(&self.0).iter().find(is_it) {
            return impact.clone();
        }
        let impact = ting.impact(speed).map(Arc::new);
        let mut known = lock(&self.0);
        let n_dropped = (known.len() + 1).saturating_sub(KEPT_IMPACTS);
        known.drain(..n_dropped);
        known.push((ting, speed, impact.clone()));
        impact
    }

    /// Predicts the impact of a scene's pair with instantaneous moduli between half-spaces at a speed (m/s).
    pub(crate) fn on_half_spaces(
        &self,
        scene: &Scene,
        pair: &Pair,
        speed: f64,
    ) -> Result<Arc<Impact>, LawError> {
        let ting = ting_of(scene, pair, true, None)?.with_coarse_waves();
        self.impact(ting.with_tolerance(ESTIMATE_TOLERANCE)?, speed)
    }
}

/// Effective radius times mismatch below which surfaces slip only by the rounding of their moduli.
const MAX_ROUNDING: f64 = 1e-9;

/// Returns whether the surfaces slip on each other, at any speed, in a model that has surface slip.
pub fn surfaces_slip(scene: &Scene) -> bool {
    match scene.effects().surface_slip {
        Some(Switch::On) => !has_wall(scene),
        Some(Switch::Off) => false,
        None | Some(Switch::Auto) => materials_mismatch(scene),
    }
}

/// Returns whether surface slip changes the collision: no body is a rigid wall, and the materials have a mismatch
/// or relax differently.
pub(crate) fn materials_mismatch(scene: &Scene) -> bool {
    if has_wall(scene) {
        return false;
    }
    let radii = scene.bodies().each_ref().map(|body| body.diameter().map_or(0.0, f64::recip));
    let effective_radius = 0.5 / (radii[0] + radii[1]);
    let [first, second] =
        scene.bodies().each_ref().map(|body| body.material().and_then(Material::relaxation));
    let differs = scene.surface_slip().mismatch().abs() * effective_radius > MAX_ROUNDING;
    differs || first != second
}

fn has_wall(scene: &Scene) -> bool {
    scene.bodies().iter().any(|body| *body.shape() == Shape::Wall)
}

/// Returns Ting's model of a scene and its pair, with surface slip and a plate if the scene has them, and without relaxation if `relaxes`
/// is false. With a finite size the plate has its finite thickness, too.
pub(crate) fn ting_of(
    scene: &Scene,
    pair: &Pair,
    relaxes: bool,
    size: Option<FiniteSize>,
) -> Result<Ting, LawError> {
    let [first, second] = scene.bodies().each_ref().map(Body::material);
    let elastic = |material: Option<&Material>| material.map(Material::without_relaxation);
    let relaxation = if relaxes {
        PairRelaxation::new(first, second)?
    } else {
        PairRelaxation::new(elastic(first).as_ref(), elastic(second).as_ref())?
    };
    let mut ting = Ting::new(pair, relaxation);
    if surfaces_slip(scene) {
        ting = ting.with_surface_slip(scene.surface_slip());
    }
    let mobility = match size {
        Some(_) => plate_mobility_of(scene, pair)?,
        None => thin_plate_mobility(scene),
    };
    if let Some(mobility) = mobility {
        ting = ting.with_plate(mobility)?;
    }
    Ok(match size {
        Some(size) => ting.with_finite_size(size),
        None => ting,
    })
}

#[cfg(test)]
mod tests {
    use std::path::Path;

    use fem_case::Case;

    use super::*;
    use crate::estimate::Regime;
    use crate::models::SelectedModel;

    /// A scene far outside Ting's range: ten terms over ten decades, and bodies whose stiffness differs by 1e15.
    const EXTREME: &str = "
        [material.hard]
        density = 2e3
        youngs_modulus = 1e20
        poissons_ratio = 0.3
        relaxation = { acts_on = 'shear', terms = [
            { weight = 0.1, decay_rate = 1 }, { weight = 0.1, decay_rate = 10 },
            { weight = 0.1, decay_rate = 1e2 }, { weight = 0.1, decay_rate = 1e3 },
            { weight = 0.1, decay_rate = 1e4 }, { weight = 0.1, decay_rate = 1e5 },
            { weight = 0.1, decay_rate = 1e6 }, { weight = 0.1, decay_rate = 1e7 },
            { weight = 0.1, decay_rate = 1e8 }, { weight = 0.0999, decay_rate = 1e9 }] }
        [material.soft]
        density = 1e3
        youngs_modulus = 1e5
        poissons_ratio = 0.4999
        relaxation = { acts_on = 'shear', terms = [
            { weight = 0.6, decay_rate = 1e7 }, { weight = 0.3999, decay_rate = 1e9 }] }
        [[body]]
        name = 'lower'
        sphere.diameter = '1 cm'
        material = 'hard'
        [[body]]
        name = 'upper'
        sphere.diameter = '1 mm'
        material = 'soft'
        approach_speed = 0.01
        [model]
        auto = {}
    ";

    /// The choice of a model computes each impact once, also those that fail.
    #[test]
    fn model_selection_computes_each_impact_once() {
        let case = Case::parse("extreme.toml", EXTREME, Path::new("."), &[]).unwrap();
        let regime = Regime::of(case.scene().clone()).unwrap();
        let known = || {
            let known = lock(&regime.estimate.impacts.0);
            let address =
                |impact: &Result<Arc<Impact>, LawError>| impact.clone().map(|it| Arc::as_ptr(&it));
            known.iter().map(|(.., impact)| address(impact)).collect::<Vec<_>>()
        };
        let _ = SelectedModel::of(regime.clone());
        let once = known();
        assert!((1..KEPT_IMPACTS).contains(&once.len()), "{}", once.len());
        let _ = SelectedModel::of(regime.clone());
        assert_eq!(known(), once);
        assert!(
            once.iter().any(Result::is_err),
            "the scene has an impact that Ting's model cannot compute"
        );
    }
}
