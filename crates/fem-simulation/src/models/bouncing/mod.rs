//! A bouncing ball: contacts and flights until the ball rests or has bounced as often as the case asks.
//!
//! Each contact is a collision by the scene's model at the landing speed. Flights are closed forms: a ball that leaves with
//! the velocity u at the height y, of its mass centre above that at first touch, lands after a time t with a speed v,
//!
//! ```math
//! v^2 = u^2 + 2 g y, \qquad g t = u + v .
//! ```
//!
//! A ball that does not rise to y = 0 is at rest. Each contact begins with bodies without vibration or strain history. The
//! energy that earlier contacts left in them has its own account ([`Account::LeftBefore`](fem_collision::Account)), and the
//! influence of its phase is bounded ([`report`]). Meshes chosen by the plan are refined when contacts become too small for
//! them.

mod bounced;
mod chain;
mod report;
mod stepper;

use std::sync::Arc;

use fem_case::engineering::show;
use fem_case::{Gravity, Scene, impact_speed};
use fem_collision::{
    Approach, Collision, Monitor, OutputRequest, Phase, RestState, Snapshot, SnapshotRequest,
    StaticContact, Stop,
};
use fem_laws::StaticHertz;
use fem_mesh::SphereMesh;

use crate::effects::{Effect, Support};
use crate::estimate::{Estimate, Regime};
use crate::models::altered::Altered;
use crate::models::method::{Cost, Model, ModelSetup, SharedModels, estimate_at};
use crate::models::method_of;
use crate::models::stepper::{RestartState, Stepper, stopped};
use crate::models::sticking::Bond;
use crate::plan::Plan;
use crate::rejection::Rejection;
use bounced::Bounced;
pub(crate) use bounced::Bounces;
use stepper::BouncingStepper;

/// Largest contact radius at rest over effective radius.
const MAX_DENT: f64 = 0.5;
/// Contact radius over that for which a mesh was made below which the mesh is made again.
const MIN_SHARE: f64 = 0.75;
/// Largest number of rows of all later contacts over that of the first.
const ROWS_OF_ALL: usize = 10;
/// Least number of rows per contact.
const MIN_ROWS: usize = 20;

/// All contacts of a scene with gravity.
#[derive(Debug)]
pub(super) struct Bouncing {
    ball: Arc<Ball>,
}

/// A scene with gravity, and the model of its first contact.
#[derive(Debug)]
struct Ball {
    regime: Regime,
    gravity: Gravity,
    first: Arc<dyn Model>,
    /// The bond of ball and floor, if they stick when they are slow.
    bond: Option<Bond>,
}

impl Bouncing {
    /// Builds the model of a scene with this gravity, from that of its first contact. Models of later contacts get the bond.
    ///
    /// # Errors
    /// A weight that presses the bodies so flat that no contact theory holds.
    pub fn new(
        regime: &Regime,
        gravity: Gravity,
        first: Box<dyn Model>,
        bond: Option<Bond>,
    ) -> Result<Self, Rejection> {
        let reject = |message: String| {
            Err(Rejection::new("gravity.acceleration", message).with_help(
                "a ball bounces where its weight is small; check its unit, sizes and moduli",
            ))
        };
        let pair = regime.estimate.hertz.pair();
        let weight = pair.effective_mass() * gravity.acceleration;
        match StaticHertz::new(pair, weight) {
            Ok(pressed) if pressed.contact_radius <= MAX_DENT * pair.effective_radius() => {
                let ball = Ball { regime: regime.clone(), gravity, first: Arc::from(first), bond };
                Ok(Self { ball: Arc::new(ball) })
            }
            Ok(pressed) => reject(format!(
                "the weight presses the bodies flat: a contact radius of {:.1e} effective radii at rest",
                pressed.contact_radius / pair.effective_radius()
            )),
            Err(error) => reject(error.to_string()),
        }
    }

    /// Begins a collision with a request that has been checked.
    fn stepper(&self, approach: &Approach, request: &OutputRequest) -> BouncingStepper {
        BouncingStepper::new(&self.ball, approach, request)
    }
}

impl Ball {
    /// Returns speed (m/s) and time (s) of first touch, and the height of the fall, m.
    fn fall(&self, approach: &Approach) -> (f64, f64, f64) {
        if *approach == self.first.setup().approach {
            let height = self.regime.scene.gap().unwrap_or(fem_case::defaults::GAP);
            return (approach.speed(), self.regime.scene.first_touch(), height);
        }
        let acceleration = self.gravity.acceleration;
        let (speed, height) = (approach.speed(), approach.gap());
        let impact = impact_speed(speed, acceleration, height);
        (impact, (impact - speed) / acceleration, height)
    }

    /// Returns a model for a contact at a speed (m/s), if the elements of the present one are too large for it.
    fn refined_model(
        &self,
        present: &dyn Model,
        speed: f64,
    ) -> Result<Option<Box<dyn Model>>, Stop> {
        let Some(elements) = &present.setup().elements else { return Ok(None) };
        let radius = estimate_at(&self.regime, speed)?.contact_radius;
        match is_made_again(
            &self.regime.scene,
            &elements.plan,
            elements.plan.estimate.contact_radius,
            radius,
        ) {
            true => self.made_at(speed).map(Some),
            false => Ok(None),
        }
    }

    /// Returns the model for a contact at a speed, m/s.
    fn made_at(&self, speed: f64) -> Result<Box<dyn Model>, Stop> {
        let scene = self.regime.scene.touching_at(speed);
        let no_speed = || Stop::NotMade(format!("the ball comes down at {}", show(speed, "m/s")));
        let regime = self.regime.variant(scene.ok_or_else(no_speed)?);
        let model = regime
            .and_then(|regime| method_of(&regime.scene).build(&regime, &SharedModels::default()));
        let model = model.map_err(|rejection| Stop::NotMade(rejection.to_string()))?;
        Ok(Altered::around(model, self.bond))
    }

    /// Returns the static contact of the ball at rest, or why there is none.
    fn rest(&self, bounced: &mut Bounced) {
        let Some(weight) = bounced.weight() else { return };
        match self.first.static_contact(weight) {
            Ok(Some(contact)) => {
                let radius = self.first.setup().estimate.hertz.pair().effective_radius();
                let too_large = report::too_large(&contact, radius);
                too_large.into_iter().for_each(|warning| bounced.warn(warning));
                bounced.bear(RestState { time: bounced.time(), contact });
            }
            Ok(None) => bounced.sink(),
            Err(rejection) => bounced.warn(report::unknown(&rejection)),
        }
    }
}

impl Model for Bouncing {
    fn setup(&self) -> &ModelSetup {
        self.ball.first.setup()
    }

    fn support(&self, effect: &dyn Effect, estimate: &Estimate) -> Option<Support> {
        self.ball.first.support(effect, estimate)
    }

    fn collide(
        &self,
        approach: &Approach,
        request: &OutputRequest,
        monitor: &mut dyn Monitor,
    ) -> Collision {
        if let Err(error) = request.check() {
            return Collision::stopped(*approach, error.into());
        }
        monitor.enter(Phase::Collision);
        let mut stepper = self.stepper(approach, request);
        // A contact without steps reports its own progress.
        let goes_in_steps = matches!(self.setup().cost, Cost::Steps { .. });
        while stepper.advance(monitor) && (!goes_in_steps || monitor.report(stepper.progress())) {}
        Box::new(stepper).finish()
    }

    fn start(&self, approach: &Approach, request: &OutputRequest) -> Option<Box<dyn Stepper>> {
        Some(match request.check() {
            Ok(()) => Box::new(self.stepper(approach, request)),
            Err(error) => stopped(*approach, error.into()),
        })
    }

    fn resume(&self, state: RestartState) -> Result<Box<dyn Stepper>, Rejection> {
        Ok(Box::new(BouncingStepper::resume(&self.ball, state)?))
    }

    fn static_contact(&self, force: f64) -> Result<Option<StaticContact>, Rejection> {
        self.ball.first.static_contact(force)
    }

    fn meshes(&self) -> [Option<&SphereMesh>; 2] {
        self.ball.first.meshes()
    }
}

/// Returns whether a mesh that was made for a contact radius, m, is made again for a smaller one.
fn is_made_again(scene: &Scene, plan: &Plan, made_for: f64, radius: f64) -> bool {
    let is_free = plan.makes_meshes && scene.mesh().contact_element_size.is_none();
    is_free && radius < MIN_SHARE * made_for
}

/// Returns the element size at the contact, m, of contacts at these speeds, m/s, if the first has `size`; `None` for a speed without a
/// Hertz impact.
pub(crate) fn element_sizes(
    scene: &Scene,
    plan: &Plan,
    size: f64,
    speeds: impl Iterator<Item = f64>,
) -> Vec<Option<f64>> {
    let first = plan.estimate.contact_radius;
    let mut made_for = first;
    let of_speed = |speed: f64| {
        let radius = plan.estimate.of_variant(scene, speed).ok()?.contact_radius;
        if is_made_again(scene, plan, made_for, radius) {
            made_for = radius;
        }
        Some(size * made_for / first)
    };
    speeds.map(of_speed).collect()
}

/// Returns the output request of the first contact, which begins at a time (s) of the case.
fn first_request(request: &OutputRequest, time: f64) -> OutputRequest {
    let snapshots = match &request.snapshots {
        SnapshotRequest::Times(times) => SnapshotRequest::Times(
            times.iter().map(|one| one - time).filter(|t| *t >= 0.0).collect(),
        ),
        other => other.clone(),
    };
    OutputRequest { history_rows: request.history_rows.max(MIN_ROWS), snapshots, ..request.clone() }
}

/// Returns the output request of a later contact, after a number of element updates.
fn later_request(
    request: &OutputRequest,
    n_contacts: usize,
    element_updates: u64,
) -> OutputRequest {
    let share = ROWS_OF_ALL.saturating_mul(request.history_rows) / n_contacts.max(1);
    OutputRequest {
        history_rows: share.min(request.history_rows).max(MIN_ROWS),
        snapshots: SnapshotRequest::none(),
        probes: Vec::new(),
        most_element_updates: request.most_element_updates.saturating_sub(element_updates),
        ..request.clone()
    }
}

/// Returns the first contact, which was computed from time 0, after a fall of a duration (s) and height (m).
fn after_fall(collision: Collision, time: f64, height: f64) -> Collision {
    let lowered = |mut snapshot: Snapshot| {
        snapshot.time += time;
        snapshot.carried[1] -= height;
        snapshot
    };
    let snapshots = collision.snapshots.into_iter().map(lowered).collect();
    let probes = collision.probes.into_iter().map(lowered).collect();
    Collision { snapshots, probes, ..collision }
}
