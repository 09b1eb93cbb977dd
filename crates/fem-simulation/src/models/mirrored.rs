//! A collision of identical bodies from that of one of them with a rigid plane: see
//! [`MirrorSymmetry`](crate::effects::MirrorSymmetry).

use fem_case::Scene;
use fem_collision::{
    Account, Approach, BodyFields, BodyResult, Collision, ContactProfile, ContactProfilePoint,
    DeepestOverlap, EnergyLedger, HistoryRow, Monitor, OutputRequest, Snapshot, StaticContact,
    Stop,
};
use fem_laws::NormalSprings;
use fem_mesh::{Side, SphereMesh};

use crate::effects::{Effect, MirrorSymmetry, Support, decide};
use crate::estimate::approach::approach_of;
use crate::estimate::{Estimate, Regime};
use crate::models::method::{ElementSetup, Model, ModelSetup};
use crate::models::stepper::{RestartState, Stepper, Transformed, stopped};
use crate::plan::{Plan, candidate_radius};
use crate::rejection::Rejection;

/// The model of a whole scene of which half is computed.
#[derive(Debug)]
pub(super) struct Mirrored<M> {
    half: M,
    setup: ModelSetup,
    image: Option<SphereMesh>,
}

/// Builds the model of a scene, or of half of it if that suffices.
///
/// # Errors
/// A scene that the plan or `build` rejects; an effect that the case forces on and the half's model lacks.
pub(super) fn whole_or_half<M: Model + 'static>(
    regime: &Regime,
    build: impl Fn(&Scene, Plan) -> Result<M, Rejection>,
) -> Result<Box<dyn Model>, Rejection> {
    let half = MirrorSymmetry::half_of(&regime.scene)?;
    let plan = Plan::in_regime(regime)?;
    let Some(half) = half else { return Ok(Box::new(build(&regime.scene, plan)?)) };
    let half = regime.variant(half)?;
    let model = build(&half.scene, plan_of_half(&plan, &half)?)?;
    Ok(Box::new(Mirrored::new(model, &regime.scene, plan)?))
}

/// Returns the plan of half of a scene, with the meshes, snapshots and limits of the whole.
fn plan_of_half(whole: &Plan, half: &Regime) -> Result<Plan, Rejection> {
    let Plan { estimate, contact_stiffness, gap, .. } = Plan::in_regime(half)?;
    let candidate_radius = candidate_radius(&estimate, whole.contact_element_size);
    let speed_share = 0.5 * whole.speed_share;
    Ok(Plan { estimate, speed_share, contact_stiffness, gap, candidate_radius, ..whole.clone() })
}

impl<M: Model> Mirrored<M> {
    /// Builds the whole from the model of the lower half, a sphere against a rigid plane, and the plan of the whole.
    fn new(half: M, scene: &Scene, plan: Plan) -> Result<Self, Rejection> {
        let image = half.meshes()[0].map(|mesh| mesh.clone().on_side(Side::Above));
        let own = half.setup().clone();
        let estimate = plan.estimate.clone();
        let decisions = decide(scene, &estimate, |effect| support(effect, &half, &estimate))?;
        let elements = own.elements.map(|elements| ElementSetup { plan, ..elements });
        let approach = approach_of(scene)?;
        let setup = ModelSetup { approach, estimate, decisions, elements, ..own };
        Ok(Self { half, setup, image })
    }
}

/// Returns the support of the whole for an effect: that of the half, and the symmetry.
fn support(effect: &dyn Effect, half: &impl Model, estimate: &Estimate) -> Option<Support> {
    match effect.name() {
        MirrorSymmetry::NAME => Some(MirrorSymmetry::of_half()),
        _ => half.support(effect, estimate),
    }
}

impl<M: Model> Model for Mirrored<M> {
    fn setup(&self) -> &ModelSetup {
        &self.setup
    }

    fn support(&self, effect: &dyn Effect, estimate: &Estimate) -> Option<Support> {
        support(effect, &self.half, estimate)
    }

    fn collide(
        &self,
        approach: &Approach,
        request: &OutputRequest,
        monitor: &mut dyn Monitor,
    ) -> Collision {
        match half_of(approach) {
            Ok(half) => {
                let request = &in_half(request);
                MirroredFrame::of(approach).collision(self.half.collide(&half, request, monitor))
            }
            Err(stop) => Collision::stopped(*approach, stop),
        }
    }

    fn collide_on_springs(
        &self,
        approach: &Approach,
        request: &OutputRequest,
        monitor: &mut dyn Monitor,
    ) -> (Collision, Option<NormalSprings>) {
        let half = match half_of(approach) {
            Ok(half) => half,
            Err(stop) => return (Collision::stopped(*approach, stop), None),
        };
        let (collision, springs) = self.half.collide_on_springs(&half, &in_half(request), monitor);
        (MirroredFrame::of(approach).collision(collision), springs)
    }

    fn start(&self, approach: &Approach, request: &OutputRequest) -> Option<Box<dyn Stepper>> {
        match half_of(approach) {
            Ok(half) => Some(whole_of(*approach, self.half.start(&half, &in_half(request))?)),
            Err(stop) => Some(stopped(*approach, stop)),
        }
    }

    fn resume(&self, state: RestartState) -> Result<Box<dyn Stepper>, Rejection> {
        let whole = state.approach;
        let approach = half_of(&whole).map_err(|stop| Rejection::new("body", stop.to_string()))?;
        Ok(whole_of(whole, self.half.resume(RestartState { approach, ..state })?))
    }

    /// Gravity makes bodies differ, so it never meets mirror symmetry.
    fn static_contact(&self, _: f64) -> Result<Option<StaticContact>, Rejection> {
        Ok(None)
    }

    fn meshes(&self) -> [Option<&SphereMesh>; 2] {
        [self.half.meshes()[0], self.image.as_ref()]
    }
}

/// Returns the output request of the half: places in the upper body are mirrored to the lower one.
fn in_half(request: &OutputRequest) -> OutputRequest {
    let mut request = request.clone();
    for probe in request.probes.iter_mut().filter(|probe| probe.side == 1) {
        (probe.side, probe.place[1]) = (0, -probe.place[1]);
    }
    request
}

/// Returns the approach of the lower body to the plane between both.
fn half_of(approach: &Approach) -> Result<Approach, Stop> {
    // Half of a positive speed may underflow to zero.
    Approach::new([0.5 * approach.speed(), 0.0], 0.5 * approach.gap())
        .map_err(|error| Stop::NotMade(error.to_string()))
}

/// Returns the stepper of the whole from that of the half.
fn whole_of(approach: Approach, half: Box<dyn Stepper>) -> Box<dyn Stepper> {
    let whole = MirroredFrame::of(&approach);
    Box::new(Transformed { approach, stepper: half, transform: move |it| whole.collision(it) })
}

/// The transformation of the half's results to those of both bodies.
struct MirroredFrame {
    approach: Approach,
    /// Velocity of the mass centre along +y, m/s.
    velocity: f64,
}

impl MirroredFrame {
    fn of(approach: &Approach) -> Self {
        let [lower, upper] = approach.velocities();
        Self { approach: *approach, velocity: 0.5 * (lower + upper) }
    }

    fn collision(&self, half: Collision) -> Collision {
        let body = half.bodies[0];
        // Kinetic energy of the mass centre of both bodies, 2 m V²/2.
        let of_centre = body.mass.unwrap_or(0.0) * self.velocity * self.velocity;
        let after = |side: usize| BodyResult {
            velocity_after: body.velocity_after.map(|v| self.velocities(v)[side]),
            ..body
        };
        let energies = twice(&half.energies).with(Account::Kinetic, of_centre);
        let whole = Collision {
            approach: self.approach,
            energies,
            residual: half.residual.map(|residual| 2.0 * residual),
            deepest_overlap: half
                .deepest_overlap
                .map(|deepest| DeepestOverlap { overlap: 2.0 * deepest.overlap, ..deepest }),
            max_approach: half.max_approach.map(|approach| 2.0 * approach),
            initial_energy: half.initial_energy.map(|energy| 2.0 * energy + of_centre),
            bodies: [after(0), after(1)],
            ..half
        };
        whole.map_samples(|row| self.row(&row, of_centre), |fields| self.snapshot(fields))
    }

    /// Returns the velocities of both bodies from that of the lower one relative to the plane, m/s.
    fn velocities(&self, lower: f64) -> [f64; 2] {
        [self.velocity + lower, self.velocity - lower]
    }

    fn row(&self, half: &HistoryRow, of_centre: f64) -> HistoryRow {
        HistoryRow {
            approach: 2.0 * half.approach,
            velocity: self.velocities(half.velocity[0]),
            energies: twice(&half.energies).with(Account::Kinetic, of_centre),
            residual: half.residual.map(|residual| 2.0 * residual),
            vibration: [half.vibration[0]; 2],
            ..*half
        }
    }

    fn snapshot(&self, half: Snapshot) -> Snapshot {
        let [lower, _] = half.bodies;
        let shift = self.velocity * half.time;
        let moved = |field: &[[f64; 2]], sign: f64, by: f64| {
            field.iter().map(|[r, y]| [*r, sign * y + by]).collect()
        };
        let body = |sign: f64| BodyFields {
            displacement: moved(&lower.displacement, sign, 0.0),
            velocity: moved(&lower.velocity, sign, self.velocity),
            effective: moved(&lower.effective, sign, 0.0),
            stress: lower.stress.iter().map(|&[rr, yy, tt, ry]| [rr, yy, tt, sign * ry]).collect(),
            plastic: lower.plastic.clone(),
        };
        let carried = [half.carried[0] + shift, shift - half.carried[0]];
        // The plane does not move along r, and both bodies move alike.
        let place = |place: &ContactProfilePoint| ContactProfilePoint {
            gap: 2.0 * place.gap,
            radial: [place.radial[0]; 2],
            ..*place
        };
        let places = half.contact.places.iter().map(place).collect();
        let contact = ContactProfile { places, ..half.contact };
        let bodies = [body(1.0), body(-1.0)];
        Snapshot { approach: 2.0 * half.approach, carried, bodies, contact, ..half }
    }
}

/// Returns the accounts of both bodies from those of one.
fn twice(ledger: &EnergyLedger) -> EnergyLedger {
    ledger.and(ledger)
}
