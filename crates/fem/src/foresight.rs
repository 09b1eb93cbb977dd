//! The mesh that a run ends with, and what it takes, before it begins.
//!
//! What explicit elements are off by, condensed companions tell without them (`accuracy/companion.rs`): the mesh is
//! made finer by that before the first run ([`crate::refinement`]), and no run is thrown away. At finite strain
//! and beside waves the companions are runs themselves: two of the coarser ones tell what is to be expected, of cheap runs
//! the first itself, and the run decides. Of condensed bodies a collision is as cheap as any forecast: of these only bounds are known.

use fem_collision::{Headline, Want};

use crate::accuracy::{ByCoarser, ORDER, companion_updates};
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

/// Finer meshes that are expected to follow a collision, all together.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Following {
    /// How many.
    pub meshes: usize,
    /// What they take, without their companions.
    pub element_updates: u64,
    /// What the collision took that foretold them, where it was that.
    pub trial_updates: u64,
}

/// Element updates of a collision that is computed to foretell what follows: some tenths of a second.
const CHEAP: u64 = 3_000_000;

/// What tells what meshes are going to be off by.
enum Told {
    /// Errors of a collision on the first mesh, the restitution's absolute, others relative.
    Trial([Option<f64>; 6]),
    Coarser(ByCoarser),
}

impl Told {
    /// None of a collision that does not come to its end.
    fn by_trial(simulation: &Simulation) -> Option<Self> {
        let want = Want { history_rows: simulation.want().history_rows, ..Want::quantities() };
        let collision = simulation.model().collide(&simulation.setup().approach, &want, &mut ());
        simulation.count_companion(&collision);
        let doubt = simulation.discretisation(&collision);
        let errors = Headline::ALL
            .map(|headline| Some(doubt.size(headline)? / headline.scale(headline.of(&collision)?)));
        errors[Headline::PeakForce as usize].map(|_| Self::Trial(errors))
    }

    /// What a finer mesh is going to be off by.
    fn of(&self, first: &Simulation, finer: &Simulation) -> Option<[Option<f64>; 6]> {
        let elements = finer.setup().elements.as_ref()?;
        let size = first.setup().elements.as_ref()?.plan.contact_element_size;
        let smaller = size / elements.plan.contact_element_size;
        Some(match self {
            Self::Trial(errors) => errors.map(|error| Some(error? / smaller.powf(ORDER))),
            Self::Coarser(coarser) => coarser.told(smaller, elements.added_share),
        })
    }
}

impl Simulation {
    /// The finer meshes that are foretold to follow, by a cheap collision itself and by two coarser meshes of others,
    /// which take [`Simulation::companion_updates`] of it; none where these tell nothing.
    pub fn following(&self) -> Option<Following> {
        let Cost::Steps { element_updates, .. } = self.setup().cost else { return None };
        self.companion_updates()?;
        let told = match element_updates <= CHEAP {
            true => Told::by_trial(self),
            false => None,
        };
        let trial_updates = if told.is_some() { element_updates } else { 0 };
        let told = told.or_else(|| ByCoarser::of(self).map(Told::Coarser))?;
        let mut following = Following { meshes: 0, element_updates: 0, trial_updates };
        let mut finest: Option<Self> = None;
        loop {
            let now = finest.as_ref().unwrap_or(self);
            let errors = told.of(self, now)?;
            let miss = now.worst_miss(|headline| errors[headline as usize]);
            let Some(finer) = miss.and_then(|miss| now.finer_for(&miss)) else {
                return Some(following);
            };
            let Cost::Steps { element_updates, .. } = finer.setup().cost else {
                return Some(following);
            };
            following.meshes += 1;
            following.element_updates += element_updates;
            finest = Some(finer);
        }
    }

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
