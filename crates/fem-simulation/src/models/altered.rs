//! A model around a model: the collision of the inner one, altered when it has ended.

use std::fmt::Debug;

use fem_collision::{Approach, Collision, Monitor, OutputRequest, StaticContact, Stop};
use fem_laws::NormalSprings;
use fem_mesh::SphereMesh;

use crate::effects::{Effect, Support};
use crate::estimate::Estimate;
use crate::models::method::{Model, ModelSetup};
use crate::models::stepper::{RestartState, Stepper, Transformed};
use crate::rejection::Rejection;

/// What alters a collision.
pub(super) trait Alteration: Clone + Debug + Send + Sync + 'static {
    /// Returns whether it needs the contact as springs ([`Model::collide_on_springs`]).
    fn needs_springs(&self) -> bool {
        false
    }

    /// Returns the altered collision.
    fn applied(&self, collision: Collision, springs: Option<NormalSprings>) -> Collision;
}

/// A model whose collisions are altered.
#[derive(Debug)]
pub(super) struct Altered<A> {
    model: Box<dyn Model>,
    alteration: A,
}

impl<A: Alteration> Altered<A> {
    /// Returns a model with its alteration, if there is one.
    pub fn around(model: Box<dyn Model>, alteration: Option<A>) -> Box<dyn Model> {
        match alteration {
            Some(alteration) => Box::new(Self { model, alteration }),
            None => model,
        }
    }

    fn stepper(&self, approach: Approach, stepper: Box<dyn Stepper>) -> Box<dyn Stepper> {
        let alteration = self.alteration.clone();
        let transform = move |collision| alteration.applied(collision, None);
        Box::new(Transformed { approach, stepper, transform })
    }
}

impl<A: Alteration> Model for Altered<A> {
    fn setup(&self) -> &ModelSetup {
        self.model.setup()
    }

    fn support(&self, effect: &dyn Effect, estimate: &Estimate) -> Option<Support> {
        self.model.support(effect, estimate)
    }

    fn collide(
        &self,
        approach: &Approach,
        request: &OutputRequest,
        monitor: &mut dyn Monitor,
    ) -> Collision {
        let (collision, springs) = match self.alteration.needs_springs() {
            true => self.model.collide_on_springs(approach, request, monitor),
            false => (self.model.collide(approach, request, monitor), None),
        };
        self.alteration.applied(collision, springs)
    }

    fn collide_on_springs(
        &self,
        approach: &Approach,
        request: &OutputRequest,
        monitor: &mut dyn Monitor,
    ) -> (Collision, Option<NormalSprings>) {
        let (collision, springs) = self.model.collide_on_springs(approach, request, monitor);
        (self.alteration.applied(collision, springs.clone()), springs)
    }

    fn start(&self, approach: &Approach, request: &OutputRequest) -> Option<Box<dyn Stepper>> {
        Some(self.stepper(*approach, self.model.start(approach, request)?))
    }

    fn resume(&self, state: RestartState) -> Result<Box<dyn Stepper>, Rejection> {
        Ok(self.stepper(state.approach, self.model.resume(state)?))
    }

    fn again(
        &self,
        before: &RestartState,
        approach: &Approach,
        request: &OutputRequest,
    ) -> Result<Box<dyn Stepper>, Stop> {
        Ok(self.stepper(*approach, self.model.again(before, approach, request)?))
    }

    fn static_contact(&self, force: f64) -> Result<Option<StaticContact>, Rejection> {
        self.model.static_contact(force)
    }

    fn meshes(&self) -> [Option<&SphereMesh>; 2] {
        self.model.meshes()
    }
}
