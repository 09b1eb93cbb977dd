//! By how much errors that companions estimate are told larger, as random scenes of all kinds showed
//! (`validation/error_bars`): margins, scatter, and what grows where elements are few.

use fem_case::Body;
use fem_collision::{Collision, QuantityOfInterest};
use fem_material::Material;
use fem_material::finite::HyperelasticLaw;

use super::companion::{SLOW, companion_updates};
use crate::effects::{FiniteStrain, MassScaling};
use crate::estimate::Estimate;
use crate::models::method::Cost;
use crate::simulation::Simulation;

/// Errors that are told over those that are estimated, in the order of [`QuantityOfInterest::ALL`]: by condensed
/// bodies on the same mesh, ...
pub(super) const MARGIN: [f64; 6] = [1.3; 6];
/// ... of condensed bodies by a finer one, whose force does not swing, ...
pub(super) const MARGIN_OF_FINER: [f64; 6] = [1.3, 1.3, 1.0, 1.3, 1.3, 1.3];
/// ... and of explicit elements by coarser ones. What a contact with mass takes of the restitution falls with the
/// first order.
pub(super) const MARGIN_OF_STRAINED: [f64; 6] = [3.0, 2.0, 2.0, 2.0, 2.0, 2.0];
/// How explicit elements scatter beside condensed bodies on the same mesh: the restitution absolute, all
/// others relative, in the order of [`QuantityOfInterest::ALL`].
pub(super) const SCATTER: [f64; 6] = [2e-5, 1e-4, 2e-4, 5e-5, 1e-3, 1e-3];
/// The same at finite strain: springs between moved surfaces ring.
const SCATTER_AT_FINITE_STRAIN: [f64; 6] = [2e-5, 2e-4, 2e-4, 5e-5, 1e-3, 1e-3];
/// The same of condensed bodies: steps, and the place of the contact's edge.
pub(super) const CONDENSED_SCATTER: [f64; 6] = [1e-5, 1e-4, 2e-4, 1.5e-4, 3e-3, 1e-3];
/// What both grow by where elements are few, times the square of h/a: where the edge of the contact lies between
/// nodes shows in radius and pressure. Of the contact time of four in 54 random scenes 0.03 to 0.08 % were missing at
/// four elements, all of the same sign; of
/// the pressure of four in 40, and of two soft balls in eight, 0.1 to 0.23 %.
pub(super) const OF_FEW: [f64; 6] = [1.6e-3, 0.008, 4e-3, 0.013, 0.05, 0.068];
/// The same at finite strain.
const OF_FEW_AT_FINITE_STRAIN: [f64; 6] = [1.6e-3, 0.02, 0.02, 0.013, 0.05, 0.1];
pub(super) const OF_FEW_CONDENSED: [f64; 6] = [1e-3, 0.01, 0.012, 0.008, 0.3, 0.1];
/// The same of explicit elements that wave after wave strains: which of them opens last decides on the contact
/// time. Slower impacts than [`SLOW`] have less of it, in proportion: of twelve soft scenes at a tenth to nine
/// tenths of that the time was off by 0.12 % at most, where 0.3 (h/a)² is 0.3 to 0.7 %.
const OF_WAVES: f64 = 0.3;
/// More of it of a body that softens as it is pressed, by St Venant and Kirchhoff's law: of nine balls with ν from 0.2 to 0.45
/// the time of two was off by 0.5 and 0.7 %, of which 0.4 and 0.5 % are told without.
const OF_SOFTENING: f64 = 0.6;
/// And the rest of what grows where elements are few. Of twenty soft scenes the radius of three was off by 0.4 to 0.6 %, of
/// which 0.35 to 0.55 % are told with a seventh of its part, and the pressure of one by 0.8 %, of which 0.7 % are told with
/// half of its part.
const OF_FEW_STRAINED: [f64; 6] = [1.6e-3, 0.0, 0.0, 0.013, 0.35, 0.2];
/// How their force, radius and pressure scatter over the speed of the impact in that of shear waves, up to [`FAST`]:
/// fronts raise the middle of a contact at one instant or another. Of soft balls on a wall at 0.16, 0.3 and 0.33 the
/// pressure was off by 0.4, 2.0 and 1.4 % (of elements half as long, which may be off by 0.6, 1.9 and 2.8 % themselves)
/// where coarser meshes told 1.4, 1.0 and 6 %, the force by 0.26 % of 0.28.
const FRONTS: [f64; 6] = [0.0, 0.0, 5e-3, 0.0, 5e-3, 0.02];
/// See [`FRONTS`].
const FAST: f64 = 0.3;
/// With fewer elements across the contact errors are told larger by the square of what is missing.
pub(crate) const FEW: f64 = 4.5;
/// What explicit elements lose of the restitution by terms of relaxation that are over at once, over the share of the
/// moduli that they take: they damp what waves there are of first touch and of elements that open. 4e-4 of spheres of
/// which 0.7 of the shear modulus is gone after a millionth of the contact, half of it beside moved mass.
pub(super) const OF_FAST_TERMS: f64 = 3e-4;
/// Terms are over at once that have gone in this share of the contact time.
const AT_ONCE: f64 = 1e-3;
/// Relative change for each share of mass that is moved.
const OF_ADDED_MASS: [f64; 6] = [0.05, 0.25, 0.4, 0.45, 0.1, 0.2];

/// What grows where elements at large strain are few, of an impact with this speed over that of shear waves.
pub(super) fn of_few_strained(simulation: &Simulation, mach: f64) -> [f64; 6] {
    let setup = simulation.setup();
    let laws = FiniteStrain::laws(&simulation.scene_of_model(), &setup.estimate);
    let softens = laws.contains(&Some(HyperelasticLaw::SaintVenantKirchhoff));
    let mut of_few = with_waves(OF_FEW_STRAINED, mach);
    if softens && setup.decisions.is_active(FiniteStrain::NAME) {
        of_few[QuantityOfInterest::ContactTime as usize] += OF_SOFTENING;
    }
    of_few
}

/// Errors that are told of those that are estimated, with so many elements across the contact and such a share
/// of mass that is moved.
pub(super) fn told(
    errors: [Option<f64>; 6],
    margin: [f64; 6],
    scatter: [f64; 6],
    of_few: [f64; 6],
    across: f64,
    added: f64,
) -> [Option<f64>; 6] {
    let coarse = (FEW / across).max(1.0).powi(2);
    QuantityOfInterest::ALL.map(|headline| {
        let k = headline as usize;
        let scatter = scatter[k] + of_few[k] / (across * across);
        Some(coarse * margin[k] * errors[k]?.abs() + scatter + added * OF_ADDED_MASS[k])
    })
}

/// What is told of every mesh, the finest included, of a simulation's numbers: how they scatter. The restitution's
/// absolute, all others relative, in the order of [`QuantityOfInterest::ALL`].
pub(crate) fn scatter_of_any_mesh(simulation: &Simulation) -> [f64; 6] {
    let setup = simulation.setup();
    let Cost::Steps { .. } = setup.cost else { return CONDENSED_SCATTER };
    let is_finite = setup.decisions.is_active(FiniteStrain::NAME);
    let Estimate { mach, strain, .. } = setup.estimate;
    match companion_updates([mach, strain], is_finite) {
        None => beside_condensed(mach, is_finite).0,
        Some(_) => with_fronts(mach),
    }
}

/// How explicit elements scatter whose companions are explicit elements, of an impact with this speed over that of shear
/// waves.
pub(super) fn with_fronts(mach: f64) -> [f64; 6] {
    let fronts = fronts(mach);
    std::array::from_fn(|k| SCATTER[k] + fronts[k])
}

/// What of it fronts do.
pub(super) fn fronts(mach: f64) -> [f64; 6] {
    FRONTS.map(|scatter| scatter * mach.min(FAST))
}

/// Scatter, and what grows where elements are few, of explicit elements whose companions are condensed bodies.
pub(super) fn beside_condensed(mach: f64, is_at_finite_strain: bool) -> ([f64; 6], [f64; 6]) {
    match is_at_finite_strain {
        true => (SCATTER_AT_FINITE_STRAIN, with_waves(OF_FEW_AT_FINITE_STRAIN, mach)),
        false => (SCATTER, OF_FEW),
    }
}

/// What grows where elements are few, with that of the waves of an impact whose speed is so much of that of shear
/// waves.
fn with_waves(mut of_few: [f64; 6], mach: f64) -> [f64; 6] {
    of_few[QuantityOfInterest::ContactTime as usize] += OF_WAVES * (mach / SLOW).min(1.0);
    of_few
}

/// The largest share of its moduli that a body loses at once.
pub(super) fn lost_at_once(simulation: &Simulation, collision: &Collision) -> f64 {
    let scene = simulation.scene_of_model();
    let Some(estimate) = simulation.estimate(collision) else { return 0.0 };
    let materials = scene.bodies().iter().filter_map(Body::material);
    let series = materials.filter_map(Material::relaxation);
    let lost = series.map(|series| 1.0 - series.relaxation(AT_ONCE * estimate.contact_time));
    lost.fold(0.0, f64::max)
}

/// What such a share of moved mass changes of a number, as errors of it are told.
pub(crate) fn of_moved_mass(added: f64, headline: QuantityOfInterest) -> f64 {
    added * OF_ADDED_MASS[headline as usize]
}

/// The most mass that is moved in a body over that of the lighter one; of one that gives way less, that share over how many
/// times as much may be moved.
pub(super) fn added_share(simulation: &Simulation, collision: &Collision) -> f64 {
    let shares =
        collision.added_shares().into_iter().zip(MassScaling::times(simulation.case().scene()));
    shares.filter_map(|(share, times)| Some(share? / times)).fold(0.0, f64::max)
}
