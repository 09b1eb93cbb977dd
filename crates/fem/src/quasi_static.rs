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

/// Accuracy of an impact that only foretells.
const FORECAST: f64 = 1e-3;

/// Ting's impact of a scene on half-spaces at a speed (m/s), to foretell how far bodies come and how long they
/// take.
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

/// Impacts that are remembered; a case asks for some, each of them several times.
const REMEMBERED: usize = 8;

thread_local! {
    /// The impacts of this thread that were computed last.
    static LAST: RefCell<Vec<(Ting, f64, Rc<Impact>)>> = const { RefCell::new(Vec::new()) };
}

/// [`Ting::impact`], computed once where it was among the last ones: what effects change is told between
/// impacts most of which are the same for all effects.
///
/// # Errors
/// Those of [`Ting::impact`].
pub(crate) fn known_impact(ting: Ting, speed: f64) -> Result<Rc<Impact>, LawError> {
    let known = LAST.with_borrow(|last| {
        let same = last.iter().find(|(other, at, _)| *at == speed && *other == ting);
        same.map(|(.., impact)| impact.clone())
    });
    if let Some(impact) = known {
        return Ok(impact);
    }
    let impact = Rc::new(ting.impact(speed)?);
    LAST.with_borrow_mut(|last| {
        last.drain(..(last.len() + 1).saturating_sub(REMEMBERED));
        last.push((ting, speed, impact.clone()));
    });
    Ok(impact)
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
