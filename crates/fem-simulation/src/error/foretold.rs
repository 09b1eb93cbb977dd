//! What elements are going to be off by, and how many steps they take, as companions tell it before a collision.

use fem_collision::{Collision, QuantityOfInterest};

use super::companion::{Beside, COARSER, Coarser, Companions, ORDER, companion_updates};
use super::margins::{
    MARGIN, MARGIN_OF_STRAINED, beside_condensed, of_few_strained, told, with_fronts,
};
use crate::effects::FiniteStrain;
use crate::estimate::Estimate;
use crate::models::method::{Cost, ElementSetup};
use crate::simulation::Simulation;

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
    let companions = Companions::of_what_is_planned(simulation)?;
    let Beside { values, errors } = companions.of_condensed()?;
    let across = values[QuantityOfInterest::MaxContactRadius as usize]? / companions.size;
    let (scatter, of_few) = beside_condensed(mach, is_finite);
    Some(told(errors, MARGIN, scatter, of_few, across, *added_share))
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
        let companions = Companions::of_what_is_planned(simulation)?;
        let [fine, coarse] = COARSER;
        let Cost::Steps { element_updates, .. } = setup.cost else { return None };
        let [near, far] = [fine, coarse].map(|ratio| {
            let foretold = element_updates as f64 / ratio.powi(3);
            companions.with_elements(ratio, (PATIENCE * foretold) as u64)
        });
        let (Coarser { values: near, lengthening, .. }, Coarser { values: far, .. }) =
            (near?, far?);
        let fall = coarse.powf(ORDER) - fine.powf(ORDER);
        let errors = QuantityOfInterest::ALL.map(|headline| {
            let (near, far) = (near[headline as usize]?, far[headline as usize]?);
            Some((far - near).abs() / fall / headline.scale(near))
        });
        let mach = setup.estimate.mach;
        Some(Self {
            errors,
            scatter: with_fronts(mach),
            of_few: of_few_strained(simulation, mach),
            across: near[QuantityOfInterest::MaxContactRadius as usize]? / companions.size,
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
    let Cost::Steps { element_updates, .. } = simulation.setup().cost else { return None };
    // The usual companions are kept for the collision.
    let by_price = (element_updates as f64 / most as f64).cbrt();
    let ratio = if by_price <= COARSER[1] { COARSER[1] } else { by_price };
    let companions = Companions::of_what_is_planned(simulation)?;
    Some(companions.with_elements(ratio, (PATIENCE * PATIENCE) as u64 * most)?.lengthening)
}
