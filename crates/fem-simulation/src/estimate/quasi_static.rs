//! Ting's quasi-static impact of a scene.

use std::cell::RefCell;
use std::rc::Rc;

use fem_case::{Body, Scene};
use fem_laws::{FiniteSize, Impact, LawError, Pair, PairRelaxation, Ting};
use fem_material::Material;

use crate::effects::SurfaceSlip;
use crate::estimate::Estimate;

/// Ting's impact of a scene, on half-spaces or with the compliance of finite spheres in series,
/// however large the contact.
///
/// # Errors
/// Numbers that the law refuses.
pub fn ting_impact(scene: &Scene, pair: &Pair, finite_size: bool) -> Result<Impact, LawError> {
    let size = finite_size.then(|| scene.finite_size()).transpose()?;
    ting_of(scene, pair, true, size)?.impact(scene.approach_speed())
}

/// Relative accuracy of an impact used for prediction only.
const FORECAST: f64 = 1e-3;

/// Returns Ting's impact of the scene between half-spaces at a speed (m/s), to predict approach and contact
/// time.
///
/// # Errors
/// Numbers that the law refuses.
pub(crate) fn foretold_impact(
    scene: &Scene,
    estimate: &Estimate,
    speed: f64,
) -> Result<Rc<Impact>, LawError> {
    foretold_on_half_spaces(scene, estimate.hertz.pair(), speed)
}

/// The same of the scene's pair with instantaneous moduli.
///
/// # Errors
/// Numbers that the law refuses.
pub(crate) fn foretold_on_half_spaces(
    scene: &Scene,
    pair: &Pair,
    speed: f64,
) -> Result<Rc<Impact>, LawError> {
    let ting = ting_of(scene, pair, true, None)?.with_coarse_waves();
    known_impact(ting.with_tolerance(FORECAST)?, speed)
}

/// Impacts that are remembered: a choice of the model asks for two dozen, most of them once for each candidate.
const REMEMBERED: usize = 32;

/// A viscoelastic pair, the speed of its impact (m/s), and what came of it.
type Known = (Ting, f64, Result<Rc<Impact>, LawError>);

thread_local! {
    /// The impacts of this thread that were computed last.
    static LAST: RefCell<Vec<Known>> = const { RefCell::new(Vec::new()) };
    /// Number of computed impacts.
    #[cfg(test)]
    static COMPUTED: std::cell::Cell<usize> = const { std::cell::Cell::new(0) };
}

/// [`Ting::impact`], computed once where it was among the last ones: what effects change is told between
/// impacts most of which are the same for all effects. One that does not come to its end takes longest of all, and is
/// remembered, too.
///
/// # Errors
/// Those of [`Ting::impact`].
pub(crate) fn known_impact(ting: Ting, speed: f64) -> Result<Rc<Impact>, LawError> {
    let known = LAST.with_borrow(|last| {
        let same = last.iter().find(|(other, at, _)| *at == speed && *other == ting);
        same.map(|(.., impact)| impact.clone())
    });
    if let Some(impact) = known {
        return impact;
    }
    let impact = ting.impact(speed).map(Rc::new);
    #[cfg(test)]
    COMPUTED.set(COMPUTED.get() + 1);
    LAST.with_borrow_mut(|last| {
        last.drain(..(last.len() + 1).saturating_sub(REMEMBERED));
        last.push((ting, speed, impact.clone()));
    });
    impact
}

/// Ting's model of a scene and its pair, of surfaces that slip on each other where the scene has that on;
/// of elastic materials with the same instantaneous moduli where nothing relaxes.
///
/// # Errors
/// Numbers that the law refuses.
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
    if SurfaceSlip::is_on(scene) {
        ting = ting.with_surface_slip(scene.surface_slip());
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
    use crate::models::SelectedModel;

    /// Far outside of Ting's range: ten terms over ten decades, between bodies of which one is 1e15 times as stiff.
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

    /// A choice of the model computes each impact once, those that do not come to an end, too.
    #[test]
    fn no_impact_is_foretold_twice() {
        let case = Case::parse("extreme.toml", EXTREME, Path::new("."), &[]).unwrap();
        let before = COMPUTED.get();
        let _ = SelectedModel::of(case.scene());
        let once = COMPUTED.get() - before;
        assert!((1..=REMEMBERED).contains(&once), "{once}");
        let _ = SelectedModel::of(case.scene());
        assert_eq!(COMPUTED.get() - before, once);
        let known = LAST.with_borrow(|last| last.iter().filter(|(.., came)| came.is_err()).count());
        assert!(known > 0, "a scene beyond what Ting's model has an answer to");
    }
}
