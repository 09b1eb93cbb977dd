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
//! Errors are told without their sign and with a margin: the limit is expected within them. Margins and
//! scatter are measured on random scenes of all kinds (`validation/error_bars`).

use std::sync::PoisonError;

use fem_case::schema::ContactMethod;
use fem_case::{Body, CondensedOptions, Quantity};
use fem_collision::{Approach, Collision, Headline, Want, longest_at_pole};
use fem_material::Material;
use fem_material::finite::HyperelasticLaw;

use super::coarser::ByCoarserMeshes;
use super::ladder::first_contact;
use super::setting::Setting;
use crate::early_pressure::EarlyPressure;
use crate::effects::{Doubt, FiniteStrain};
use crate::estimate::Estimate;
use crate::method::{Cost, ElementSetup};
use crate::plan::Plan;
use crate::simulation::Simulation;

/// Errors of a sequence of meshes fall with this power of the length of their elements.
pub(crate) const ORDER: f64 = 1.9;
/// Elements of coarser companions over those of the collision.
pub(super) const COARSER: [f64; 2] = [1.5, 2.0];
/// Elements of the collision over those of the finer companion of condensed bodies: with half of the length it
/// takes twice the time of the collision itself.
const FINER: f64 = 1.5;
/// Errors that are told over those that are estimated, in the order of [`Headline::ALL`]: by condensed
/// bodies on the same mesh, ...
const MARGIN: [f64; 6] = [1.3; 6];
/// ... of condensed bodies by a finer one, whose force does not swing, ...
const MARGIN_OF_FINER: [f64; 6] = [1.3, 1.3, 1.0, 1.3, 1.3, 1.3];
/// ... and of explicit elements by coarser ones. What a contact with mass takes of the restitution falls with the
/// first order.
const MARGIN_OF_STRAINED: [f64; 6] = [3.0, 2.0, 2.0, 2.0, 2.0, 2.0];
/// How explicit elements scatter beside condensed bodies on the same mesh: the restitution absolute, all
/// others relative, in the order of [`Headline::ALL`].
const SCATTER: [f64; 6] = [2e-5, 1e-4, 2e-4, 5e-5, 1e-3, 1e-3];
/// The same at finite strain: springs between moved surfaces ring.
const SCATTER_AT_FINITE_STRAIN: [f64; 6] = [2e-5, 2e-4, 2e-4, 5e-5, 1e-3, 1e-3];
/// The same of condensed bodies: steps, and the place of the contact's edge.
const CONDENSED_SCATTER: [f64; 6] = [1e-5, 1e-4, 2e-4, 1.5e-4, 3e-3, 1e-3];
/// What both grow by where elements are few, times the square of h/a: where the edge of the contact lies between
/// nodes shows in radius and pressure. Of the contact time of four in 54 random scenes 0.03 to 0.08 % were missing at
/// four elements, all of the same sign; of
/// the pressure of four in 40, and of two soft balls in eight, 0.1 to 0.23 %.
const OF_FEW: [f64; 6] = [1.6e-3, 0.008, 4e-3, 0.013, 0.05, 0.068];
/// The same at finite strain.
const OF_FEW_AT_FINITE_STRAIN: [f64; 6] = [1.6e-3, 0.02, 0.02, 0.013, 0.05, 0.1];
pub(super) const OF_FEW_CONDENSED: [f64; 6] = [1e-3, 0.01, 0.012, 0.008, 0.3, 0.1];
/// Over the shear wave speed the speed of an impact of which condensed bodies tell what meshes do: rubber on a
/// wall at twice that is off by 1.4 % of the contact time where they find 0.3 %.
const SLOW: f64 = 0.02;
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
/// Steps of condensed companions of explicit elements over the elastic contact time: a restitution to 4e-5,
/// and the same of all three, of which differences are taken.
const STEPS: f64 = 120.0;
/// The same of condensed companions of condensed bodies, which may have more: a restitution to 2e-5.
const OWN_STEPS: f64 = 160.0;
/// With fewer elements across the contact errors are told larger by the square of what is missing.
pub(crate) const FEW: f64 = 4.5;
/// What explicit elements lose of the restitution by terms of relaxation that are over at once, over the share of the
/// moduli that they take: they damp what waves there are of first touch and of elements that open. 4e-4 of spheres of
/// which 0.7 of the shear modulus is gone after a millionth of the contact, half of it beside moved mass.
const OF_FAST_TERMS: f64 = 3e-4;
/// Terms are over at once that have gone in this share of the contact time.
const AT_ONCE: f64 = 1e-3;
/// Relative change for each share of mass that is moved.
const OF_ADDED_MASS: [f64; 6] = [0.05, 0.25, 0.4, 0.45, 0.1, 0.2];
/// Errors that are told over what the mesh away from the contact changes.
const MARGIN_OF_FAR_MESH: f64 = 1.3;
/// Contact radius over effective radius up to which meshes do at finite strain what they do at small strain:
/// there the two differ by the same on all meshes with eight elements or more across, to 0.02 % of time and force.
const FLAT: f64 = 0.1;

/// Errors of the numbers of a collision of bodies with elements, computed with large strains or without.
/// None of what has no number, nor of a collision that did not end by itself.
pub(crate) fn discretisation_errors(
    simulation: &Simulation,
    collision: &Collision,
    is_at_finite_strain: bool,
) -> Doubt {
    let values = Headline::ALL.map(|headline| headline.of(collision));
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
        true => FRONTS.map(|scatter| scatter * mach.min(FAST)),
        false => [0.0; 6],
    };
    let added = added_share(collision);
    let early = EarlyPressure::of(simulation, collision);
    let fast = if is_explicit { OF_FAST_TERMS * lost_at_once(simulation, collision) } else { 0.0 };
    let of_relaxation = |headline| match headline {
        Headline::PeakPressure => early.map_or(0.0, |early| early.error),
        Headline::Restitution => fast,
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

/// What grows where elements at large strain are few, of an impact with this speed over that of shear waves.
fn of_few_strained(simulation: &Simulation, mach: f64) -> [f64; 6] {
    let setup = simulation.setup();
    let laws = FiniteStrain::laws(&simulation.scene_of_model(), &setup.estimate);
    let softens = laws.contains(&Some(HyperelasticLaw::SaintVenantKirchhoff));
    let mut of_few = with_waves(OF_FEW_STRAINED, mach);
    if softens && setup.decisions.is_active(FiniteStrain::NAME) {
        of_few[Headline::ContactTime as usize] += OF_SOFTENING;
    }
    of_few
}

/// Errors that are told of those that are estimated, with so many elements across the contact and such a share
/// of mass that is moved.
fn told(
    errors: [Option<f64>; 6],
    margin: [f64; 6],
    scatter: [f64; 6],
    of_few: [f64; 6],
    across: f64,
    added: f64,
) -> [Option<f64>; 6] {
    let coarse = (FEW / across).max(1.0).powi(2);
    Headline::ALL.map(|headline| {
        let k = headline as usize;
        let scatter = scatter[k] + of_few[k] / (across * across);
        Some(coarse * margin[k] * errors[k]?.abs() + scatter + added * OF_ADDED_MASS[k])
    })
}

/// The errors, the restitution's absolute, all others relative, that elements are going to make: before a
/// collision of them, of those whose companions are condensed bodies. None of others, which only a run tells.
pub(crate) fn foretold_errors(simulation: &Simulation) -> Option<[Option<f64>; 6]> {
    let setup = simulation.setup();
    let Cost::Steps { .. } = setup.cost else { return None };
    let ElementSetup { plan, added_share, .. } = setup.elements.as_ref()?;
    let is_finite = setup.decisions.is_active(FiniteStrain::NAME);
    let Estimate { mach, strain, .. } = setup.estimate;
    if !plan.makes_meshes || companion_updates([mach, strain], is_finite).is_some() {
        return None;
    }
    let (approach, size) = (setup.approach, plan.contact_element_size);
    let Beside { values, errors } =
        Companions { simulation, approach, plan, size }.of_condensed()?;
    let across = values[Headline::MaxContactRadius as usize]? / size;
    let (scatter, of_few) = beside_condensed(mach, is_finite);
    Some(told(errors, MARGIN, scatter, of_few, across, *added_share))
}

/// What is told of every mesh, the finest included, of a simulation's numbers: how they scatter. The restitution's
/// absolute, all others relative, in the order of [`Headline::ALL`].
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
fn with_fronts(mach: f64) -> [f64; 6] {
    std::array::from_fn(|k| SCATTER[k] + FRONTS[k] * mach.min(FAST))
}

/// What the mesh away from the contact, as the case gives it, is going to take from numbers, the restitution's absolute,
/// all others as shares; none where the case leaves it open.
pub(crate) fn far_mesh_errors(simulation: &Simulation) -> Option<[Option<f64>; 6]> {
    let setup = simulation.setup();
    let plan = &setup.elements.as_ref()?.plan;
    let (approach, size) = (setup.approach, plan.contact_element_size);
    Companions { simulation, approach, plan, size }.of_far_mesh()
}

/// The key by which a case makes the mesh away from the contact another one than is chosen, if it does.
pub(crate) fn far_mesh_key(simulation: &Simulation) -> Option<&'static str> {
    let setup = simulation.setup();
    let plan = &setup.elements.as_ref()?.plan;
    plan.far_mesh_key(simulation.case().scene(), setup.estimate.contact_radius)
}

/// Coarser meshes that foretell may take so many times what is expected of them.
const PATIENCE: f64 = 2.0;

/// What elements are going to be off by, as two coarser meshes tell it before a collision, of those whose companions are
/// explicit elements themselves:
///
/// ```math
/// |q(h) - q_0| \approx \frac{|q(2h) - q(\tfrac32 h)|}{2^p - (\tfrac32)^p},
/// ```
///
/// which falls with h^p. Only a collision tells it for sure.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct ByCoarser {
    errors: [Option<f64>; 6],
    scatter: [f64; 6],
    of_few: [f64; 6],
    across: f64,
    /// Of the finer one of both, see [`lengthening`].
    pub lengthening: f64,
}

impl ByCoarser {
    /// Computes both coarser meshes; none where condensed bodies tell it, or where a mesh does not carry the collision.
    pub fn of(simulation: &Simulation) -> Option<Self> {
        simulation.companion_updates()?;
        let setup = simulation.setup();
        let plan = &setup.elements.as_ref()?.plan;
        let (approach, size) = (setup.approach, plan.contact_element_size);
        let companions = Companions { simulation, approach, plan, size };
        let [fine, coarse] = COARSER;
        let Cost::Steps { element_updates, .. } = setup.cost else { return None };
        let [near, far] = [fine, coarse].map(|ratio| {
            let foretold = element_updates as f64 / ratio.powi(3);
            companions.with_elements(ratio, (PATIENCE * foretold) as u64)
        });
        let (Coarser { values: near, lengthening, .. }, Coarser { values: far, .. }) =
            (near?, far?);
        let fall = coarse.powf(ORDER) - fine.powf(ORDER);
        let errors = Headline::ALL.map(|headline| {
            let (near, far) = (near[headline as usize]?, far[headline as usize]?);
            Some((far - near).abs() / fall / headline.scale(near))
        });
        let mach = setup.estimate.mach;
        Some(Self {
            errors,
            scatter: with_fronts(mach),
            of_few: of_few_strained(simulation, mach),
            across: near[Headline::MaxContactRadius as usize]? / size,
            lengthening,
        })
    }

    /// The errors that are going to be told of elements that are so many times smaller, beside such a share of moved
    /// mass.
    pub fn told(&self, smaller: f64, added: f64) -> [Option<f64>; 6] {
        let errors = self.errors.map(|error| Some(error? / smaller.powf(ORDER)));
        told(errors, MARGIN_OF_STRAINED, self.scatter, self.of_few, smaller * self.across, added)
    }
}

/// Element updates of a collision over those that closed forms announce of it. Elements that are pressed flat have
/// shorter steps, and a body that stiffens as it is strained parts sooner; coarser meshes have both.
pub(crate) fn lengthening(simulation: &Simulation, collision: &Collision) -> Option<f64> {
    let Cost::Steps { element_updates, .. } = simulation.setup().cost else { return None };
    Some(collision.element_updates? as f64 / element_updates as f64)
}

/// The same, foretold by a coarser mesh that takes no more than some element updates, of explicit elements whose
/// companions are explicit elements; none of others, and where a mesh does not carry the collision.
pub(crate) fn foretold_lengthening(simulation: &Simulation, most: u64) -> Option<f64> {
    simulation.companion_updates()?;
    let setup = simulation.setup();
    let Cost::Steps { element_updates, .. } = setup.cost else { return None };
    let plan = &setup.elements.as_ref()?.plan;
    let (approach, size) = (setup.approach, plan.contact_element_size);
    // The usual companions are kept for the collision.
    let by_price = (element_updates as f64 / most as f64).cbrt();
    let ratio = if by_price <= COARSER[1] { COARSER[1] } else { by_price };
    let companions = Companions { simulation, approach, plan, size };
    Some(companions.with_elements(ratio, (PATIENCE * PATIENCE) as u64 * most)?.lengthening)
}

/// Scatter, and what grows where elements are few, of explicit elements whose companions are condensed bodies.
fn beside_condensed(mach: f64, is_at_finite_strain: bool) -> ([f64; 6], [f64; 6]) {
    match is_at_finite_strain {
        true => (SCATTER_AT_FINITE_STRAIN, with_waves(OF_FEW_AT_FINITE_STRAIN, mach)),
        false => (SCATTER, OF_FEW),
    }
}

/// The numbers of condensed bodies with springs, and what they are off by.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Beside {
    values: [Option<f64>; 6],
    errors: [Option<f64>; 6],
}

/// Element updates of the companions of explicit elements over those of the collision, Σ r⁻³, whose impact has this
/// speed over that of shear waves and this strain; none where condensed bodies are its companions. These know no
/// large strains, nor what keeps such surfaces apart, and no waves.
pub(crate) fn companion_updates(
    [mach, strain]: [f64; 2],
    is_at_finite_strain: bool,
) -> Option<f64> {
    // A strain that is no number is not small.
    let is_large = is_at_finite_strain && (strain.is_nan() || strain >= FLAT);
    (is_large || mach >= SLOW).then(|| COARSER.into_iter().map(|ratio: f64| ratio.powi(-3)).sum())
}

/// What grows where elements are few, with that of the waves of an impact whose speed is so much of that of shear
/// waves.
fn with_waves(mut of_few: [f64; 6], mach: f64) -> [f64; 6] {
    of_few[Headline::ContactTime as usize] += OF_WAVES * (mach / SLOW).min(1.0);
    of_few
}

/// The largest share of its moduli that a body loses at once.
fn lost_at_once(simulation: &Simulation, collision: &Collision) -> f64 {
    let scene = simulation.scene_of_model();
    let Some(estimate) = simulation.estimate(collision) else { return 0.0 };
    let materials = scene.bodies().iter().filter_map(Body::material);
    let series = materials.filter_map(Material::relaxation);
    let lost = series.map(|series| 1.0 - series.relaxation(AT_ONCE * estimate.contact_time));
    lost.fold(0.0, f64::max)
}

/// What such a share of moved mass changes of a number, as errors of it are told.
pub(crate) fn of_moved_mass(added: f64, headline: Headline) -> f64 {
    added * OF_ADDED_MASS[headline as usize]
}

/// The most mass that is moved in a body over that of the lighter one.
fn added_share(collision: &Collision) -> f64 {
    collision.added_shares().into_iter().flatten().fold(0.0, f64::max)
}

/// A companion of a model itself with longer elements.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Coarser {
    /// How the bodies met.
    approach: Approach,
    /// Length of the elements at the contact, m.
    size: f64,
    /// In the order of [`Headline::ALL`].
    values: [Option<f64>; 6],
    /// See [`lengthening`].
    lengthening: f64,
}

/// How meshes go on away from the contact.
#[derive(Clone, Copy, Debug, PartialEq)]
enum FarMesh {
    AsGiven,
    Chosen,
}

/// Cheaper collisions of the same bodies.
struct Companions<'a> {
    simulation: &'a Simulation,
    /// How the bodies meet.
    approach: Approach,
    plan: &'a Plan,
    /// Length of the elements at the contact, m.
    size: f64,
}

impl Companions<'_> {
    /// Errors of explicit elements, the restitution's absolute, all others relative; none where condensed
    /// bodies cannot be had. What they were is kept: they are asked for before a collision and after it.
    fn of_condensed(&self) -> Option<Beside> {
        // Who panicked has left nothing half written.
        let mut known = self.simulation.condensed.lock().unwrap_or_else(PoisonError::into_inner);
        match *known {
            Some((approach, beside)) if approach == self.approach => beside,
            _ => {
                let beside = self.condensed_anew();
                *known = Some((self.approach, beside));
                beside
            }
        }
    }

    fn condensed_anew(&self) -> Option<Beside> {
        let values = self.collide(&[
            Setting::Condensed { vibration_modes: 0, penalty_springs: true },
            Setting::ElementSize(self.size),
            Setting::Staggered(self.plan.finer_body.is_some()),
        ])?;
        Some(Beside { values, errors: self.beside_touching(values, self.size)? })
    }

    /// The numbers of condensed bodies with springs on the mesh of a file.
    fn of_same_mesh(&self) -> Option<[Option<f64>; 6]> {
        self.collide(&[Setting::Condensed { vibration_modes: 0, penalty_springs: true }])
    }

    /// Errors of numbers from the mesh of a file beside the limit of meshes that are made here.
    fn beside_made(&self, same: [Option<f64>; 6], is_few: bool) -> Option<[Option<f64>; 6]> {
        self.beside_touching(same, if is_few { self.size } else { 2.0 * self.size })
    }

    fn far_mesh_key(&self) -> Option<&'static str> {
        let scene = self.simulation.case().scene();
        let estimate = Estimate::at(scene, self.approach.speed()).ok()?;
        self.plan.far_mesh_key(scene, estimate.contact_radius)
    }

    /// Errors by the mesh away from the contact, where the case gives it; the restitution's absolute, all others relative.
    fn of_far_mesh(&self) -> Option<[Option<f64>; 6]> {
        self.far_mesh_key()?;
        let [given, chosen] = [FarMesh::AsGiven, FarMesh::Chosen].map(|far_mesh| {
            let settings = [
                Setting::Condensed { vibration_modes: 0, penalty_springs: true },
                Setting::ElementSize(self.size),
            ];
            self.collide_within(&settings, far_mesh, u64::MAX)
        });
        Some(beside_chosen(given?, chosen?))
    }

    /// The same as the model itself tells it with longer elements: at large strains it is more.
    fn of_strained_far_mesh(&self) -> Option<[Option<f64>; 6]> {
        self.far_mesh_key()?;
        let ratio = COARSER[0];
        let size = Setting::ElementSize(ratio * self.size);
        let staggered = Setting::Staggered(self.plan.finer_body.is_some());
        let given = self.with_elements(ratio, u64::MAX)?.values;
        let chosen = self.collide_within(&[size, staggered], FarMesh::Chosen, u64::MAX)?;
        Some(beside_chosen(given, chosen))
    }

    /// Errors of numbers beside the limit of nodes that touch exactly, which have no meshes that are staggered, with
    /// elements about as long (m) and half as long.
    fn beside_touching(&self, values: [Option<f64>; 6], size: f64) -> Option<[Option<f64>; 6]> {
        let size = match values[Headline::MaxContactRadius as usize] {
            Some(radius) if radius > size => radius / (radius / size).round(),
            _ => size,
        };
        let far_mesh = match self.far_mesh_key() {
            Some(_) => FarMesh::Chosen,
            None => FarMesh::AsGiven,
        };
        let [coarse, fine] = [size, 0.5 * size].map(|size| {
            let settings = [
                Setting::Condensed { vibration_modes: 0, penalty_springs: false },
                Setting::ElementSize(size),
                Setting::Staggered(false),
            ];
            self.collide_within(&settings, far_mesh, u64::MAX)
        });
        Some(beside_limit(values, coarse?, fine?))
    }

    /// The same from the model itself with elements that are so many times shorter.
    fn of_finer(&self, values: [Option<f64>; 6], ratio: f64) -> [Option<f64>; 6] {
        let size = Setting::ElementSize(self.size / ratio);
        let staggered = Setting::Staggered(self.plan.finer_body.is_some());
        let fine = self.collide(&[size, staggered]).unwrap_or_default();
        Headline::ALL.map(|headline| {
            let k = headline as usize;
            let (fine, value) = (fine[k]?, values[k]?);
            Some((1.0 + remaining(ratio)) * (fine - value) / headline.scale(value))
        })
    }

    /// The numbers of the model itself with elements that are so many times longer; none of a run that takes more. They
    /// are kept: they are asked for before a collision and after it.
    fn with_elements(&self, ratio: f64, most_element_updates: u64) -> Option<Coarser> {
        let size = ratio * self.size;
        // Who panicked has left nothing half written.
        let mut known = self.simulation.coarser.lock().unwrap_or_else(PoisonError::into_inner);
        let is_it = |one: &&Coarser| one.approach == self.approach && one.size == size;
        if let Some(coarser) = known.iter().find(is_it) {
            return Some(*coarser);
        }
        let staggered = Setting::Staggered(self.plan.finer_body.is_some());
        let settings = [Setting::ElementSize(size), staggered];
        let (values, lengthening) =
            self.computed(&settings, FarMesh::AsGiven, most_element_updates)?;
        let coarser = Coarser { approach: self.approach, size, values, lengthening };
        known.push(coarser);
        Some(coarser)
    }

    /// The same from the model itself with elements that are so many times longer.
    fn of_coarser(&self, ratios: &[f64], values: [Option<f64>; 6]) -> [Option<f64>; 6] {
        let mut errors = [None; 6];
        for &ratio in ratios {
            let Some(Coarser { values: coarse, .. }) = self.with_elements(ratio, u64::MAX) else {
                continue;
            };
            for (k, headline) in Headline::ALL.into_iter().enumerate() {
                let both = coarse[k].zip(values[k]);
                let error = both.map(|(coarse, value)| {
                    remaining(ratio) * (coarse - value).abs() / headline.scale(value)
                });
                errors[k] =
                    error.map(|error| errors[k].map_or(error, |other: f64| error.max(other)));
            }
        }
        errors
    }

    /// The numbers of the bodies' first contact with these settings; none where the model refuses them.
    fn collide(&self, settings: &[Setting]) -> Option<[Option<f64>; 6]> {
        self.collide_within(settings, FarMesh::AsGiven, u64::MAX)
    }

    /// The same; none of a run that takes more element updates.
    fn collide_within(
        &self,
        settings: &[Setting],
        far_mesh: FarMesh,
        most_element_updates: u64,
    ) -> Option<[Option<f64>; 6]> {
        self.computed(settings, far_mesh, most_element_updates).map(|(values, _)| values)
    }

    /// The same, and by how many times it took more than closed forms announce.
    fn computed(
        &self,
        settings: &[Setting],
        far_mesh: FarMesh,
        most_element_updates: u64,
    ) -> Option<([Option<f64>; 6], f64)> {
        let case = self.simulation.case().edited(|file| {
            file.stop = first_contact(file);
            // Where the case leaves the model open, the one that was chosen.
            file.model = self.simulation.resolved().model.clone();
            let is_condensed = settings.iter().any(|it| matches!(it, Setting::Condensed { .. }));
            if is_condensed {
                // Switches of what condensed bodies lack, and springs that they have not.
                file.effects = None;
                let contact = file.contact.as_mut();
                if let Some(method) = contact.and_then(|contact| contact.method.as_mut())
                    && *method == ContactMethod::NodeToSurface
                {
                    *method = ContactMethod::Massless;
                }
            }
            for setting in settings {
                setting.apply(file);
            }
            if let (FarMesh::Chosen, Some(mesh)) = (far_mesh, file.mesh.as_mut()) {
                (mesh.growth, mesh.refined_radius) = (None, None);
                // What is chosen goes by the speed.
                *file = self.simulation.meeting(file.clone(), &self.approach);
            }
            if settings.iter().any(|it| matches!(it, Setting::ElementSize(_))) {
                let spheres = file.body.iter_mut().filter_map(|body| body.sphere.as_mut());
                spheres.for_each(|sphere| sphere.mesh = None);
            }
            let condensed = file.model.as_mut().and_then(|model| model.condensed.as_mut());
            if let Some(table) = condensed {
                let own = table.steps.as_ref().and_then(|steps| steps.si().ok());
                // Who asks for more than the usual ones has an instant to see that fewer do not show.
                let usual = CondensedOptions::default().steps as f64;
                let steps = match own {
                    _ if is_condensed => STEPS,
                    Some(own) if own > usual => own,
                    own => own.unwrap_or(OWN_STEPS).min(OWN_STEPS),
                };
                table.steps = Some(Quantity::from_si(steps));
            }
        });
        let shared = self.simulation.shared().of_companions();
        let companion = Simulation::sharing(case.ok()?, &shared).ok()?;
        let want = Want { most_element_updates, ..Want::quantities() };
        let collision = companion.model().collide(&self.approach, &want, &mut ());
        self.simulation.count_companion(&collision);
        let values = Headline::ALL.map(|headline| headline.of(&collision));
        let longer = lengthening(&companion, &collision).unwrap_or(1.0);
        collision.is_complete().then_some((values, longer))
    }
}

/// What the mesh away from the contact changes, with its margin, of numbers with the given and with the chosen one.
fn beside_chosen(given: [Option<f64>; 6], chosen: [Option<f64>; 6]) -> [Option<f64>; 6] {
    Headline::ALL.map(|headline| {
        let k = headline as usize;
        let (given, chosen) = (given[k]?, chosen[k]?);
        Some(MARGIN_OF_FAR_MESH * (given - chosen).abs() / headline.scale(chosen))
    })
}

/// Errors beside the limit of numbers with elements of some length and of half of it.
fn beside_limit(
    values: [Option<f64>; 6],
    coarse: [Option<f64>; 6],
    fine: [Option<f64>; 6],
) -> [Option<f64>; 6] {
    Headline::ALL.map(|headline| {
        let k = headline as usize;
        let limit = fine[k]? + remaining(2.0) * (fine[k]? - coarse[k]?);
        Some((values[k]? - limit) / headline.scale(limit))
    })
}

/// What is left of the way to the limit, over the last step of a length that is this many times smaller.
fn remaining(ratio: f64) -> f64 {
    1.0 / (ratio.powf(ORDER) - 1.0)
}
