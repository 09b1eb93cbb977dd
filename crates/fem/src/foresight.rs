//! The mesh that a run ends with, and what it takes, before it begins.
//!
//! What explicit elements are off by, condensed companions tell without them (`accuracy/companion.rs`): the mesh is
//! made finer by that before the first run ([`crate::refinement`]), and no run is thrown away. At finite strain
//! and beside waves the companions are runs themselves, and of condensed bodies a collision is as cheap as any
//! forecast: of these only bounds are known.

use crate::accuracy::companion_updates;
use crate::effects::FiniteStrain;
use crate::estimate::Estimate;
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
            let Some(miss) = goes_on().then(|| simulation.foretold_miss()).flatten() else {
                let is_open = simulation.setup().elements.is_some();
                return Foreseen { simulation, is_open };
            };
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
        let Estimate { mach, strain, .. } = setup.estimate;
        companion_updates([mach, strain], setup.decisions.is_active(FiniteStrain::NAME))
    }
}
