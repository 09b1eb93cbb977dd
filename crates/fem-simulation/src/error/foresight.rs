//! The mesh that a run ends with, and what it takes, before it begins.
//!
//! What explicit elements are off by, condensed companions tell without them (`accuracy/foretold.rs`): the mesh is
//! made finer by that before the first run ([`crate::error::refinement`]), and no run is thrown away. At finite strain
//! and beside waves the companions are runs themselves: two of the coarser ones tell what is to be expected, of cheap runs
//! these themselves, and the run decides. Of condensed bodies a collision is as cheap as any forecast: of these only bounds are known.

use std::sync::PoisonError;

use fem_collision::{OutputRequest, QuantityOfInterest};

use crate::effects::FiniteStrain;
use crate::error::{ByCoarser, ORDER, companion_updates, foretold_lengthening, lengthening};
use crate::estimate::Estimate;
use crate::models::method::Cost;
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
}

/// What meshes are told to be off by falls with these powers of the length of their elements, in the order of
/// [`QuantityOfInterest::ALL`], where one of them is known: of contact time and force, which swing with the place of the contact's
/// edge, slower than by their order. Of 30 soft scenes six of 15 needed a second finer mesh for them.
const FALL: [f64; 6] = [1.25, 1.25, 1.25, 1.25, 1.25, ORDER];
/// Element updates of a coarser mesh that tells how long a run takes, where its companions would take much more.
const LITTLE: u64 = 4_000_000;
/// Element updates of a collision whose companions are computed before it.
const QUICK: u64 = 30_000_000;

/// A mesh may be off by so many times what coarser ones tell (1.79 times the tolerance of fast rubber, where they told
/// 0.87): nearer to the tolerance only the run tells whether a finer one follows.
const NEAR: f64 = 2.0;

/// What tells what meshes are going to be off by.
enum Told {
    /// Errors of a collision with elements of this length (m), the restitution's absolute, others relative.
    Trial { size: f64, errors: [Option<f64>; 6] },
    /// What coarser meshes than one with elements of this length (m) tell.
    Coarser { size: f64, coarser: ByCoarser },
}

impl Told {
    /// None of a collision that does not come to its end; with what it takes more than is announced.
    fn by_trial(simulation: &Simulation) -> Option<(Self, f64)> {
        let want = OutputRequest {
            history_rows: simulation.want().history_rows,
            ..OutputRequest::quantities()
        };
        let collision = simulation.model().collide(&simulation.setup().approach, &want, &mut ());
        simulation.count_companion(&collision);
        let doubt = simulation.discretisation(&collision);
        let errors = QuantityOfInterest::ALL
            .map(|headline| Some(doubt.size(headline)? / headline.scale(headline.of(&collision)?)));
        errors[QuantityOfInterest::PeakForce as usize]?;
        let size = simulation.setup().elements.as_ref()?.plan.contact_element_size;
        Some((Self::Trial { size, errors }, lengthening(simulation, &collision)?))
    }

    /// By two coarser meshes.
    fn by_coarser(simulation: &Simulation) -> Option<(Self, f64)> {
        let coarser = ByCoarser::of(simulation)?;
        let size = simulation.setup().elements.as_ref()?.plan.contact_element_size;
        Some((Self::Coarser { size, coarser }, coarser.lengthening))
    }

    /// What a mesh is going to be off by that is no coarser.
    fn of(&self, finer: &Simulation) -> Option<[Option<f64>; 6]> {
        let elements = finer.setup().elements.as_ref()?;
        let smaller = |size: f64| size / elements.plan.contact_element_size;
        Some(match self {
            Self::Trial { size, errors } => {
                let fall = FALL.map(|order| smaller(*size).powf(order));
                std::array::from_fn(|k| Some(errors[k]? / fall[k]))
            }
            Self::Coarser { size, coarser } => coarser.told(smaller(*size), elements.added_share),
        })
    }
}

impl Simulation {
    /// Element updates of this collision over those that are announced, and the finer meshes that are foretold to follow
    /// it, by coarser meshes, which take [`Simulation::companion_updates`] of it, and, of collisions that take no more
    /// element updates than `patience` together with their companions, by these themselves; none where nothing tells it, or
    /// where it is near.
    pub fn following(&self, patience: u64) -> (f64, Option<Following>) {
        match self.announced() {
            None => (1.0, None),
            _ if self.case().scene().gravity().is_some() => (1.0, None),
            Some(updates) if updates < QUICK => {
                self.told_following(patience).unwrap_or((1.0, None))
            }
            _ => (foretold_lengthening(self, LITTLE).unwrap_or(1.0), None),
        }
    }

    fn announced(&self) -> Option<u64> {
        match self.setup().cost {
            Cost::Steps { element_updates, .. } => Some(element_updates),
            _ => None,
        }
    }

    fn told_following(&self, patience: u64) -> Option<(f64, Option<Following>)> {
        let share = 1.0 + self.companion_updates()?;
        let mut patience = patience as f64;
        let mut following = Following { meshes: 0, element_updates: 0 };
        let mut finest: Option<Self> = None;
        let mut known: Option<(Told, f64)> = None;
        let mut first = None;
        loop {
            let now = finest.as_ref().unwrap_or(self);
            let longer = known.as_ref().map_or(1.0, |(_, longer)| *longer);
            let price = share * longer * now.announced()? as f64;
            if price <= patience {
                patience -= price;
                known = Told::by_trial(now).or(known);
            }
            if known.is_none() {
                known = Told::by_coarser(now);
            }
            let (told, longer) = known.as_ref()?;
            match first {
                None => first = Some(*longer),
                Some(_) => {
                    following.element_updates += (longer * now.announced()? as f64) as u64;
                }
            }
            let errors = told.of(now)?;
            let missed_by =
                |factor: f64| now.worst_miss(|headline| Some(factor * errors[headline as usize]?));
            let finer = |factor: f64| missed_by(factor).and_then(|miss| now.finer_for(&miss));
            let Some(finer) = finer(1.0) else {
                let is_told = following.meshes > 0 || matches!(told, Told::Trial { .. });
                let is_open = !is_told && finer(NEAR).is_some();
                return Some((first?, (!is_open).then_some(following)));
            };
            following.meshes += 1;
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

    /// Bytes that the collision takes, and those of the condensed bodies that tell what it is off by, if they are
    /// still to be computed; none of models without elements.
    pub fn memory_ahead(&self) -> Option<(u64, Option<u64>)> {
        match self.setup().cost {
            Cost::Steps { memory, companion_memory, .. } => {
                // Who panicked has left nothing half written.
                let known = self.condensed.lock().unwrap_or_else(PoisonError::into_inner);
                Some((memory, companion_memory.filter(|_| known.is_none())))
            }
            Cost::Factors { memory, .. } => Some((memory, None)),
            Cost::Little { .. } => None,
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
