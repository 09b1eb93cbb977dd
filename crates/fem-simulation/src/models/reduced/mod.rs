//! Models of one degree of freedom, the approach of the mass centres. What is asked of all models comes
//! from the relative motion and the conservation of momentum.

pub(super) mod hertz;
pub(super) mod law;
pub(super) mod ting;

pub use hertz::HertzMethod;
pub use law::LawMethod;
pub use ting::TingMethod;

mod collision;
pub(super) mod effects;
mod static_contact;

use std::fmt;

use fem_case::schema::StartTable;
use fem_case::{CaseFile, Quantity, Scene};
use fem_collision::{Approach, Collision, Monitor, OutputRequest, StaticContact, Stop};
use fem_laws::laws::ContactLaw;
use fem_laws::{Impact, LawError, Pair};

use crate::effects::{Effect, Support, decide};
use crate::estimate::Estimate;
use crate::estimate::approach::{approach_of, frame_of};
use crate::models::method::{Cost, ForceLaw, Model, ModelSetup};
use crate::rejection::Rejection;
use effects::Traits;

/// What computes a relative motion.
pub(super) trait Motion: fmt::Debug + Send + Sync {
    /// The relative motion at an approach speed, m/s.
    fn impact(&self, speed: f64) -> Result<Impact, LawError>;

    /// Share of the contact modulus that never relaxes, 0 to 1.
    fn equilibrium_weight(&self) -> f64 {
        1.0
    }

    /// Stiffness and dashpot of a law of the overlap.
    fn law(&self) -> Option<&ContactLaw> {
        None
    }

    /// The law's numbers, SI, in the order of its family's parameters.
    fn law_numbers(&self) -> Option<&[f64]> {
        None
    }
}

/// A motion of a scene's bodies, and what is to be known of it.
pub(super) struct Moving {
    /// What computes it.
    pub motion: Box<dyn Motion>,
    /// Of the motion: with relaxed moduli if the law is a slow limit.
    pub pair: Pair,
    /// In a few words, what is integrated.
    pub description: String,
    /// What the model has that another lacks.
    pub traits: Traits,
}

/// A scene with a reduced model, ready to run.
#[derive(Debug)]
pub struct Reduced {
    setup: ModelSetup,
    scene: Scene,
    motion: Box<dyn Motion>,
    pair: Pair,
    traits: Traits,
}

impl Reduced {
    /// A scene whose bodies move like this.
    ///
    /// # Errors
    /// An effect that the case forces on and a reduced model lacks.
    pub(super) fn of(scene: &Scene, estimate: Estimate, moving: Moving) -> Result<Self, Rejection> {
        let Moving { motion, pair, description, traits } = moving;
        let has = |effect: &dyn Effect| effects::has(effect, scene, &estimate, &traits);
        let decisions = decide(scene, &estimate, has)?;
        let force = motion.law().map(|law| ForceLaw {
            stiffness: law.stiffness(),
            elastic_exponent: law.elastic_exponent(),
            damping: law.damping(),
            damping_exponent: law.damping_exponent(),
        });
        let setup = ModelSetup {
            description,
            approach: approach_of(scene)?,
            request: OutputRequest::history(),
            estimate,
            decisions,
            unread: effects::unread_keys(scene),
            cost: Cost::Little { force },
            elements: None,
        };
        Ok(Self { setup, scene: scene.clone(), motion, pair, traits })
    }

    /// The scene.
    pub fn scene(&self) -> &Scene {
        &self.scene
    }

    /// Stiffness and dashpot of a law.
    pub fn law(&self) -> Option<&ContactLaw> {
        self.motion.law()
    }

    /// The law's numbers, SI, in the order of its family's parameters.
    pub fn law_numbers(&self) -> Option<&[f64]> {
        self.motion.law_numbers()
    }

    /// The relative motion at an approach speed, m/s, the law's numbers those of the case.
    ///
    /// # Errors
    /// Those of the model.
    pub fn impact(&self, speed: f64) -> Result<Impact, LawError> {
        self.motion.impact(speed)
    }
}

impl Model for Reduced {
    fn setup(&self) -> &ModelSetup {
        &self.setup
    }

    fn has(&self, effect: &dyn Effect, estimate: &Estimate) -> Option<Support> {
        effects::has(effect, &self.scene, estimate, &self.traits)
    }

    /// Closed forms and short integrations: nobody needs to look on.
    fn collide(
        &self,
        approach: &Approach,
        request: &OutputRequest,
        _: &mut dyn Monitor,
    ) -> Collision {
        if let Err(error) = request.check() {
            return Collision::stopped(*approach, error.into());
        }
        match self.impact(approach.speed()) {
            Ok(impact) => {
                let frame = frame_of(&self.scene, approach, self.pair.effective_mass());
                collision::of_impact(&impact, &frame, &self.pair, self.law(), request)
            }
            Err(error) => Collision::stopped(*approach, stop_of(&error)),
        }
    }

    fn static_contact(&self, force: f64) -> Result<Option<StaticContact>, Rejection> {
        let found = match self.law() {
            Some(law) => static_contact::of_law(law, &self.pair, force).map(Some),
            None => static_contact::of_hertz(&self.pair, self.motion.equilibrium_weight(), force),
        };
        found.map_err(|error| refused(&self.scene, &error))
    }
}

fn stop_of(error: &LawError) -> Stop {
    let message = error.to_string();
    match error {
        LawError::NotFinished { .. } => Stop::NotFinished(message),
        LawError::OutsideValidity { .. } => Stop::OutsideValidity(message),
        _ => Stop::OutOfRange(message),
    }
}

/// What a law of the scene refuses.
pub(super) fn refused(scene: &Scene, error: &LawError) -> Rejection {
    Rejection::new(scene.model().path(), error.to_string())
}

/// The start that all reduced models fill in; what they do not read stays as it is.
pub(super) fn resolve_start(scene: &Scene, mut file: CaseFile) -> CaseFile {
    let gap = scene.gap().unwrap_or_default();
    file.start = Some(StartTable { gap: Some(Quantity::from_si(gap)) });
    file
}
