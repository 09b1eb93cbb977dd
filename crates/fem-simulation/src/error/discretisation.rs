//! What mesh, springs, added mass and steps of a collision are off by, from cheap companions.
//!
//! Condensed bodies with the springs of explicit elements make the same errors on the same mesh, down to
//! where the edge of the contact falls between two nodes, and take a fortieth of the time. So the error
//! of explicit elements with elements of length h is
//!
//! ```math
//! q^{\rm springs}(h) - q_0, \qquad
//! q_0 = q\bigl(\tfrac h2\bigr) + \tfrac{1}{2^p-1}\,\bigl[q\bigl(\tfrac h2\bigr) - q(h)\bigr]
//! ```
//!
//! with q of condensed bodies without springs and p = 1.9, the order that is seen; to which comes what
//! added mass does, and how explicit elements scatter beside condensed bodies. The edge of the contact is at a node
//! of both meshes, a/h a whole number: then q falls by that order alone, and q₀ of glass spheres is the
//! same to 0.003 % from eight elements on, where it swings by 0.1 % with the place of the edge. So it is at finite
//! strain, as long as that is small. Of condensed bodies
//! themselves, and of elements at large strain, companions are coarser, since they must be cheap, and the
//! larger of two errors is taken, since the place of the edge is another one on each mesh:
//!
//! ```math
//! q(h) - q_0 \approx \frac{q(rh) - q(h)}{r^p-1}, \qquad r = \tfrac32,\ 2
//! ```
//!
//! Of five to seven elements there is one coarser mesh, r = 3/2, and margins are wider, since the place of the edge shows
//! more (`accuracy/coarser.rs`); where that tells more than the case allows, a finer one is asked. Meshes of three
//! elements across the contact tell nothing: of condensed bodies with so few that a coarser one would be left with them,
//! and of seven to nine, the companion is finer, r = ⅔. So it is of explicit elements that coarser meshes do not carry
//! through the collision: they turn over or collapse.
//!
//! A mesh that was read from a file has neither coarser nor finer ones. Its limit is that of meshes that are made
//! here, with elements as long as its own at the contact and twice as long, or half where they are few; its error
//! that of condensed bodies on the mesh itself. So what a mesh of its own kind does is in the bar, too. Of large
//! strains and fast impacts, for which condensed bodies cannot speak, there is none.
//!
//! Errors are told without their sign and with a margin (`accuracy/margins.rs`): the limit is expected within them.

use fem_collision::{Collision, QuantityOfInterest, longest_at_pole};

use super::coarser::ByCoarserMeshes;
use super::companion::{Beside, COARSER, Companions, FLAT, companion_updates};
use super::margins::{
    CONDENSED_SCATTER, FEW, MARGIN, MARGIN_OF_FINER, MARGIN_OF_STRAINED, OF_FAST_TERMS, OF_FEW,
    OF_FEW_CONDENSED, SCATTER, added_share, beside_condensed, fronts, lost_at_once,
    of_few_strained, told,
};
use crate::effects::Doubt;
use crate::error::early_pressure::EarlyPressure;
use crate::simulation::Simulation;

/// Elements of the collision over those of the finer companion of condensed bodies: with half of the length it
/// takes twice the time of the collision itself.
const FINER: f64 = 1.5;

/// Errors of the numbers of a collision of bodies with elements, computed with large strains or without.
/// None of what has no number, nor of a collision that did not end by itself.
pub(crate) fn discretisation_errors(
    simulation: &Simulation,
    collision: &Collision,
    is_at_finite_strain: bool,
) -> Doubt {
    let values = QuantityOfInterest::ALL.map(|headline| headline.of(collision));
    let Some(elements) = simulation.setup().elements.as_ref() else { return Doubt::default() };
    if !collision.is_complete() {
        return Doubt::default();
    }
    let plan = &elements.plan;
    let size = match plan.makes_meshes {
        true => Some(plan.contact_element_size),
        false => Some(longest_at_pole(simulation.model().meshes())).filter(|size| *size > 0.0),
    };
    let Some(size) = size else { return Doubt::default() };
    let companions = Companions { simulation, approach: collision.approach, plan, size };
    let across = collision.max_contact_radius.map_or(FEW, |radius| radius / size);
    let is_explicit = collision.element_updates.is_some();
    let [mach, strain] = (simulation.estimate(collision))
        .map_or([0.0, FLAT], |estimate| [estimate.mach, estimate.strain]);
    let are_like = companion_updates([mach, strain], is_at_finite_strain).is_none();
    let condensed = match are_like && plan.makes_meshes && is_explicit {
        true => companions.of_condensed().map(|Beside { errors, .. }| errors),
        false => None,
    };
    // Condensed companions have it in their limit.
    let far_mesh = match (condensed, is_explicit && !are_like) {
        (Some(_), _) => None,
        (None, true) => companions.of_strained_far_mesh().or_else(|| companions.of_far_mesh()),
        (None, false) => companions.of_far_mesh(),
    };
    let is_few = across < 2.0 * FEW;
    let by_coarser = ByCoarserMeshes::of(across).filter(|_| !is_explicit && plan.makes_meshes);
    let (errors, margin) = match condensed {
        _ if !plan.makes_meshes && is_explicit && !are_like => return Doubt::default(),
        _ if !plan.makes_meshes => {
            let same = if is_explicit { companions.of_same_mesh() } else { Some(values) };
            let errors = same.and_then(|same| companions.beside_made(same, is_few));
            (errors.unwrap_or_default(), MARGIN)
        }
        Some(errors) => (errors, MARGIN),
        None if is_explicit => match companions.of_coarser(&COARSER, values) {
            // Coarser meshes have not gone through the collision.
            [None, ..] => (companions.of_finer(values, COARSER[0]), MARGIN_OF_STRAINED),
            errors => (errors, MARGIN_OF_STRAINED),
        },
        None => match by_coarser {
            Some(by_coarser) => {
                (companions.of_coarser(by_coarser.ratios, values), by_coarser.margin)
            }
            None => (companions.of_finer(values, FINER), MARGIN_OF_FINER),
        },
    };
    let (scatter, of_few) = match (is_explicit, condensed) {
        (true, _) if are_like && is_at_finite_strain => beside_condensed(mach, true),
        (true, Some(_)) => beside_condensed(mach, false),
        (true, None) if plan.makes_meshes => (SCATTER, of_few_strained(simulation, mach)),
        (true, None) => (SCATTER, OF_FEW),
        (false, _) => {
            let of_few = by_coarser.map(|by_coarser| by_coarser.of_few(collision.restitution));
            (CONDENSED_SCATTER, of_few.unwrap_or(OF_FEW_CONDENSED))
        }
    };
    let fronts = match is_explicit && condensed.is_none() {
        true => fronts(mach),
        false => [0.0; 6],
    };
    let added = added_share(simulation, collision);
    let early = EarlyPressure::of(simulation, collision);
    let fast = if is_explicit { OF_FAST_TERMS * lost_at_once(simulation, collision) } else { 0.0 };
    let of_relaxation = |headline| match headline {
        QuantityOfInterest::PeakPressure => early.map_or(0.0, |early| early.error),
        QuantityOfInterest::Restitution => fast,
        _ => 0.0,
    };
    let scatter: [f64; 6] = std::array::from_fn(|k| scatter[k] + fronts[k]);
    let coarse = told(errors, margin, scatter, of_few, across, added);
    let misses = || simulation.worst_miss(|headline| coarse[headline as usize]).is_some();
    let told = match by_coarser {
        Some(by_coarser) if by_coarser.may_be_sharper() && misses() => {
            let errors = companions.of_finer(values, FINER);
            told(errors, MARGIN_OF_FINER, scatter, OF_FEW_CONDENSED, across, added)
        }
        _ => coarse,
    };
    Doubt::by(|headline| {
        let k = headline as usize;
        let both = told[k].zip(values[k]);
        let far = far_mesh.and_then(|far| far[k]).unwrap_or(0.0);
        both.map(|(error, value)| (error + far) * headline.scale(value) + of_relaxation(headline))
    })
}

/// What the mesh away from the contact, as the case gives it, is going to take from numbers, the restitution's absolute,
/// all others as shares; none where the case leaves it open.
pub(crate) fn far_mesh_errors(simulation: &Simulation) -> Option<[Option<f64>; 6]> {
    Companions::of_what_is_planned(simulation)?.of_far_mesh()
}

/// The key by which a case makes the mesh away from the contact another one than is chosen, if it does.
pub(crate) fn far_mesh_key(simulation: &Simulation) -> Option<&'static str> {
    let setup = simulation.setup();
    let plan = &setup.elements.as_ref()?.plan;
    plan.far_mesh_key(simulation.case().scene(), setup.estimate.contact_radius)
}
