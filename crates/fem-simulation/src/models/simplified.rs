//! A scene that effects have simplified, computed by the model of what they left of it: the collision
//! is the model's, what is decided and said is of the scene as it is given.

use fem_case::Scene;
use fem_collision::{Approach, Collision, Monitor, OutputRequest, StaticContact};
use fem_mesh::SphereMesh;

use crate::effects::{Answer, Effect, decide};
use crate::estimate::Estimate;
use crate::models::method::{Model, Setup};
use crate::models::restart_state::Memory;
use crate::models::stepper::Course;
use crate::refusal::Refusal;

/// The model of a simplified scene.
#[derive(Debug)]
pub(super) struct Simplified {
    model: Box<dyn Model>,
    setup: Setup,
    answers: Vec<(&'static str, Answer)>,
}

impl Simplified {
    /// Of the model of what effects left of a scene, and what they say of it.
    ///
    /// # Errors
    /// An effect that the case switches and the model cannot obey.
    pub fn new(
        model: Box<dyn Model>,
        given: &Scene,
        answers: Vec<(&'static str, Answer)>,
    ) -> Result<Self, Refusal> {
        let own = model.setup().clone();
        let estimate = Estimate::checked(given)?;
        let has = |effect: &dyn Effect| has(effect, &answers, model.as_ref(), &estimate);
        let decisions = decide(given, &estimate, has)?;
        let setup = Setup { estimate, decisions, ..own };
        Ok(Self { model, setup, answers })
    }
}

/// What the effects that simplified the scene say, and else what the model has.
fn has(
    effect: &dyn Effect,
    answers: &[(&'static str, Answer)],
    model: &dyn Model,
    estimate: &Estimate,
) -> Option<Answer> {
    let own = answers.iter().find(|(name, _)| *name == effect.name());
    own.map(|(_, answer)| answer.clone()).or_else(|| model.has(effect, estimate))
}

impl Model for Simplified {
    fn setup(&self) -> &Setup {
        &self.setup
    }

    fn has(&self, effect: &dyn Effect, estimate: &Estimate) -> Option<Answer> {
        has(effect, &self.answers, self.model.as_ref(), estimate)
    }

    fn collide(
        &self,
        approach: &Approach,
        want: &OutputRequest,
        monitor: &mut dyn Monitor,
    ) -> Collision {
        self.model.collide(approach, want, monitor)
    }

    fn start(&self, approach: &Approach, want: &OutputRequest) -> Option<Box<dyn Course>> {
        self.model.start(approach, want)
    }

    fn resume(&self, memory: Memory) -> Result<Box<dyn Course>, Refusal> {
        self.model.resume(memory)
    }

    fn static_contact(&self, force: f64) -> Result<Option<StaticContact>, Refusal> {
        self.model.static_contact(force)
    }

    fn meshes(&self) -> [Option<&SphereMesh>; 2] {
        self.model.meshes()
    }
}
