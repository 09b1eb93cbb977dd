//! The mesh that a run ends with, and what it takes, before it begins.
//!
//! What explicit elements are off by, condensed companions tell without them (`accuracy/companion.rs`): the mesh is
//! made finer by that before the first run ([`crate::refinement`]), and no run is thrown away. At finite strain
//! and beside waves the companions are runs themselves, and of condensed bodies a collision is as cheap as any
//! forecast: of these only bounds are known.

use fem_collision::Headline;

use crate::accuracy::{companion_updates, foretold_errors};
use crate::effects::FiniteStrain;
use crate::method::Cost;
use crate::simulation::Simulation;

/// A simulation on the mesh that it is expected to end with.
#[derive(Debug)]
pub struct Foreseen {
    /// The case with that mesh.
    pub simulation: Simulation,
    /// Whether finer meshes may follow, which nothing but a run can tell.
    pub is_open: bool,
}

impl Simulation {
    /// The same case on the mesh that its tolerance needs, as far as companions of it tell that before a run.
    /// Where `goes_on` says no, what is left is as open as what they cannot tell.
    pub fn foreseen(self, mut goes_on: impl FnMut() -> bool) -> Foreseen {
        let mut simulation = self;
        loop {
            if !simulation.may_be_refined() {
                return Foreseen { simulation, is_open: false };
            }
            let Some(errors) = goes_on().then(|| foretold_errors(&simulation)).flatten() else {
                let is_open = simulation.setup().elements.is_some();
                return Foreseen { simulation, is_open };
            };
            let miss = simulation.worst_miss(|headline: Headline| errors[headline as usize]);
            match miss.and_then(|miss| simulation.finer_for(&miss)) {
                Some(finer) => simulation = finer,
                None => return Foreseen { simulation, is_open: false },
            }
        }
    }

    /// Element updates of explicit companions, which tell what a run is off by, over those of the run; none of other
    /// companions.
    pub fn companion_updates(&self) -> Option<f64> {
        let setup = self.setup();
        let Cost::Steps { .. } = setup.cost else { return None };
        setup.elements.as_ref().filter(|elements| elements.plan.makes_meshes)?;
        companion_updates(setup.estimate.mach, setup.decisions.is_active(FiniteStrain::NAME))
    }

    /// Element updates of the finer meshes that may follow, all together, at most; none of what takes no updates.
    pub fn most_updates_to_follow(&self) -> Option<u64> {
        match self.setup().cost {
            Cost::Steps { element_updates, .. } => Some(self.most_that_follow(element_updates)),
            _ => None,
        }
    }
}
