//! The model of an oblique impact: the collision is that of bodies that meet head-on, with friction on its contact
//! ([`TangentialContact`]).
//!
//! The patch of the contact moves with v_t = (v₁ − ω₁R₁) − (v₂ + ω₂R₂) along x, where body 1 is the lower one. A tangential impulse J
//! against it changes velocities by −J/m₁ and J/m₂ and both spins by JR/I, I = ⅖mR², so that the angular momentum of each body about
//! the contact is kept. Sticking bodies have no tangential result.

use fem_case::{Body, ModelChoice, Scene};
use fem_collision::{
    Account, Collision, Ending, EnergyLedger, HistoryRow, TangentialErrors, TangentialResult,
    TangentialRow,
};
use fem_laws::{LawError, NormalSprings, TangentialContact, TangentialImpact, TangentialInstant};

use crate::effects::FrictionEffect;
use crate::models::altered::Alteration;
use crate::rejection::Rejection;

/// Moment of inertia of a solid sphere over m R².
const INERTIA: f64 = 0.4;
/// Error of the displacement by finite size, whose second order is neglected, over itself: a series in a/R and the first order differ by
/// that between a/R of 0.005 and 0.1.
const SECOND_ORDER: f64 = 0.05;

/// Relative change of an input by which its effect is found.
const CHANGE: f64 = 0.01;

/// Two bodies that move across the axis or spin.
#[derive(Clone, Debug)]
pub(super) struct ObliqueBodies {
    scene: Scene,
    contact: TangentialContact,
    /// The contact of half-spaces instead of spheres, or of spheres instead of half-spaces: what finite size changes.
    other_size: TangentialContact,
    /// 1/m of each body; 0 of one that neither moves nor turns.
    inverse_masses: [f64; 2],
}

impl ObliqueBodies {
    /// Returns the bodies of an oblique scene; `None` of another one.
    ///
    /// # Errors
    /// Friction beside an effect with which it is not computed.
    pub fn of(scene: &Scene) -> Result<Option<Self>, Rejection> {
        if !scene.is_oblique() {
            return Ok(None);
        }
        if scene.friction() > 0.0 {
            check(scene)?;
        }
        let friction = scene.friction();
        let reject = |error: LawError| Rejection::new("contact.friction", error.to_string());
        let moves = |body: &Body| body.mass().filter(|_| !body.is_held());
        let inverse_masses =
            scene.bodies().each_ref().map(|body| moves(body).map_or(0.0, f64::recip));
        let patch_mass = (inverse_masses.iter().sum::<f64>() * (1.0 + INERTIA.recip())).recip();
        let relaxes = matches!(scene.model(), ModelChoice::Ting { .. } | ModelChoice::Condensed(_));
        let materials = scene.bodies().each_ref().map(|body| {
            let material = body.material()?;
            Some(if relaxes { material.clone() } else { material.without_relaxation() })
        });
        let bodies = materials.each_ref().map(Option::as_ref);
        let half_spaces = TangentialContact::new(bodies, patch_mass, friction).map_err(reject)?;
        let sized =
            scene.clone().with_materials(materials.clone()).tangential_size().map_err(reject)?;
        let spheres = half_spaces.clone().with_finite_size(sized);
        let has_size = match scene.model() {
            ModelChoice::Ting { finite_size, .. } | ModelChoice::Hertz { finite_size } => {
                *finite_size
            }
            model => !matches!(model, ModelChoice::Law { .. }),
        };
        let [contact, other_size] = match has_size {
            true => [spheres, half_spaces],
            false => [half_spaces, spheres],
        };
        Ok(Some(Self { scene: scene.clone(), contact, other_size, inverse_masses }))
    }

    /// Returns the bodies with another coefficient of friction.
    pub fn with_friction(&self, friction: f64) -> Self {
        let [contact, other_size] =
            [&self.contact, &self.other_size].map(|it| it.clone().with_friction(friction));
        Self { contact, other_size, ..self.clone() }
    }

    /// Returns the tangential contact.
    pub fn contact(&self) -> &TangentialContact {
        &self.contact
    }

    /// Returns the scene of the bodies.
    pub fn scene(&self) -> &Scene {
        &self.scene
    }

    /// Returns the velocity of the contact patch of the lower body relative to that of the upper one, m/s, if the ball has a tangential
    /// velocity (m/s) relative to the other body, and both have the spins of the scene.
    pub fn patch_velocity(&self, ball_velocity: f64) -> f64 {
        let turning: f64 = self.scene.bodies().iter().map(turning).sum();
        side(&self.scene) * ball_velocity - turning
    }

    /// Returns tangential velocity (m/s, relative to the other body) and spin (rad/s) of the ball after an impulse, N s.
    pub fn ball_after(&self, velocity: f64, impulse: f64) -> (f64, f64) {
        let ball = self.scene.ball();
        let relative =
            side(&self.scene) * velocity - impulse * self.inverse_masses.iter().sum::<f64>();
        (
            side(&self.scene) * relative,
            self.scene.bodies()[ball].spin() + self.lever(ball) * impulse,
        )
    }

    /// Returns R/I of a body, 1/(kg m); 0 of a flat one.
    fn lever(&self, k: usize) -> f64 {
        self.inverse_masses[k] / (INERTIA * self.scene.bodies()[k].radius())
    }

    /// Returns the velocities and spins of both bodies after a tangential impulse, N s.
    fn after(&self, impulse: f64) -> ([f64; 2], [f64; 2]) {
        let bodies = self.scene.bodies();
        let [lower, upper] = self.inverse_masses;
        let velocities = bodies.each_ref().map(Body::tangential_velocity);
        let spins = [0, 1].map(|k| bodies[k].spin() + self.lever(k) * impulse);
        ([velocities[0] - lower * impulse, velocities[1] + upper * impulse], spins)
    }

    /// Returns the kinetic energy of moving bodies across the axis and by spin after an impulse (N s), J.
    fn kinetic(&self, impulse: f64) -> f64 {
        let (velocities, spins) = self.after(impulse);
        let of_body = |k: usize| {
            let body = &self.scene.bodies()[k];
            let mass = body.mass().filter(|_| self.inverse_masses[k] > 0.0)?;
            let turning = INERTIA * (body.radius() * spins[k]).powi(2);
            Some(0.5 * mass * (velocities[k] * velocities[k] + turning))
        };
        (0..2).filter_map(of_body).sum()
    }

    /// Returns the work of bodies that keep their velocity until this impulse (N s), J.
    fn wall_work(&self, impulse: f64) -> f64 {
        let [lower, upper] = surfaces(&self.scene);
        let fixed = |k: usize| self.inverse_masses[k] == 0.0;
        let of = |is_fixed: bool, velocity: f64| if is_fixed { impulse * velocity } else { 0.0 };
        of(fixed(0), lower) - of(fixed(1), upper)
    }

    /// Returns m*, kg, of the motion along the axis.
    pub fn normal_mass(&self) -> f64 {
        self.inverse_masses.iter().sum::<f64>().recip()
    }

    /// Returns the energies with those of the tangential contact at an instant after an impulse, N s.
    fn added(&self, energies: EnergyLedger, at: &TangentialInstant, impulse: f64) -> EnergyLedger {
        let work = self.wall_work(impulse);
        let energies = energies
            .with(Account::Kinetic, self.kinetic(impulse))
            .with(Account::Strain, at.strain_energy)
            .with(Account::Friction, at.friction_work)
            .with(Account::TangentialRelaxation, at.relaxation_loss);
        if work == 0.0 { energies } else { energies.with(Account::WallWork, work) }
    }

    /// Returns the errors of the velocity of the rebounding patch, m/s: the largest changes over the impact, since those at its end
    /// pass through zero.
    pub fn errors(
        &self,
        speed: f64,
        springs: &NormalSprings,
        impact: &TangentialImpact,
        before: f64,
    ) -> TangentialErrors {
        let coarse = springs.coarser();
        let own = self.contact.impact(&coarse, before);
        let other_size = self.other_size.impact(&coarse, before);
        let share = if self.contact.has_finite_size() { SECOND_ORDER } else { 1.0 };
        let coupling = FrictionEffect::coupling(&self.scene);
        let psi = before.abs() * coupling.stiffness_ratio / (self.contact.friction() * speed);
        let is_known = !coupling.is_unknown(psi);
        let slope = |contact: &TangentialContact, before: f64| {
            (contact.impact(&coarse, before).velocity - own.velocity) / CHANGE
        };
        TangentialErrors {
            discretisation: Some(largest_change(&own.history, &impact.history)),
            model: is_known.then(|| share * largest_change(&other_size.history, &own.history)),
            slopes: [
                slope(&self.contact, (1.0 + CHANGE) * before) / before,
                slope(&self.contact.clone().stiffer_by(CHANGE), before),
            ],
        }
    }
}

impl Alteration for ObliqueBodies {
    fn needs_springs(&self) -> bool {
        self.scene.friction() > 0.0
    }

    /// Returns a collision of the bodies as they meet head-on with its tangential half, on the springs of its contact.
    fn applied(&self, collision: Collision, springs: Option<NormalSprings>) -> Collision {
        let is_parted = collision.ending == Ending::Parted;
        let Some(restitution) = collision.restitution.filter(|_| is_parted) else {
            return Collision { pressures: None, ..collision };
        };
        let before = patch_velocity(&self.scene);
        let is_free = self.scene.friction() == 0.0 || before == 0.0;
        let springs = springs.filter(|_| !is_free);
        if !is_free && springs.is_none() {
            return Collision { pressures: None, ..collision };
        }
        let impact = springs.as_ref().map(|springs| self.contact.impact(springs, before));
        let standing = TangentialInstant { velocity: before, ..TangentialInstant::default() };
        let history = impact.as_ref().map_or(vec![standing], |impact| impact.history.clone());
        let last = history.last().copied().unwrap_or(standing);
        let impulse = impact.as_ref().map_or(0.0, |impact| impact.impulse);
        let mass = self.normal_mass();
        let normal = mass * (1.0 + restitution) * collision.approach.speed();
        let (velocities, spins) = self.after(impulse);
        let errors = match (&springs, &impact) {
            (Some(springs), Some(impact)) => {
                self.errors(collision.approach.speed(), springs, impact, before)
            }
            _ => {
                TangentialErrors { discretisation: Some(0.0), model: Some(0.0), slopes: [1.0, 0.0] }
            }
        };
        let result = TangentialResult {
            patch_velocity: [before, last.velocity],
            impulse_ratio: if before < 0.0 { -impulse / normal } else { impulse / normal },
            velocities,
            spins,
            errors,
        };
        let first_touch = collision.first_contact.unwrap_or_default();
        let row = |row: HistoryRow| {
            let at = instant_at(&history, row.time - first_touch);
            let so_far = self.contact.mass() * (before - at.velocity);
            let ratio = row.contact_radius.filter(|radius| *radius > 0.0);
            HistoryRow {
                energies: self.added(row.energies, &at, so_far),
                tangential: Some(TangentialRow {
                    force: at.force,
                    patch_velocity: at.velocity,
                    stick_ratio: ratio.map(|radius| (at.stick_radius / radius).min(1.0)),
                }),
                ..row
            }
        };
        let own_residual = impact.as_ref().map_or(0.0, |impact| impact.residual);
        let scale = 0.5 * mass * collision.approach.speed().powi(2)
            + 0.5 * self.contact.mass() * before * before;
        let of_residual = collision.residual_relative.map(|own| own.max(own_residual / scale));
        let energies = self.added(collision.energies, &last, impulse);
        let initial_energy = collision.initial_energy.map(|own| own + self.kinetic(0.0));
        let whole = Collision {
            tangential: Some(result),
            pressures: None,
            energies,
            initial_energy,
            residual_relative: of_residual,
            ..collision
        };
        whole.map_samples(row, |fields| fields)
    }
}

/// Returns the velocity of a body's surface by its spin, m/s.
fn turning(body: &Body) -> f64 {
    body.diameter().map_or(0.0, |diameter| 0.5 * diameter * body.spin())
}

/// Returns the velocity of each body's surface at the contact before the impact, m/s.
fn surfaces(scene: &Scene) -> [f64; 2] {
    let [lower, upper] = scene.bodies();
    [lower.tangential_velocity() - turning(lower), upper.tangential_velocity() + turning(upper)]
}

/// Returns the velocity of the contact patch before the impact, m/s.
pub(crate) fn patch_velocity(scene: &Scene) -> f64 {
    let [lower, upper] = surfaces(scene);
    lower - upper
}

/// Returns the sign of the ball's velocity in that of the lower body relative to the upper one.
fn side(scene: &Scene) -> f64 {
    if scene.ball() == 0 { 1.0 } else { -1.0 }
}

/// Returns the tangential contact at a time after first touch (s), linear between the steps.
fn instant_at(history: &[TangentialInstant], time: f64) -> TangentialInstant {
    let after = history.partition_point(|instant| instant.time <= time);
    let (Some(a), Some(b)) = (after.checked_sub(1).map(|k| &history[k]), history.get(after)) else {
        return history[after.saturating_sub(1).min(history.len() - 1)];
    };
    let share = (time - a.time) / (b.time - a.time);
    let of = |get: fn(&TangentialInstant) -> f64| get(a) + share * (get(b) - get(a));
    TangentialInstant {
        time,
        force: of(|it| it.force),
        velocity: of(|it| it.velocity),
        stick_radius: of(|it| it.stick_radius),
        strain_energy: of(|it| it.strain_energy),
        friction_work: of(|it| it.friction_work),
        relaxation_loss: of(|it| it.relaxation_loss),
    }
}

/// Returns the largest change of the velocity of the patch, m/s, between two histories of an impact.
fn largest_change(one: &[TangentialInstant], other: &[TangentialInstant]) -> f64 {
    let change = |it: &TangentialInstant| (instant_at(other, it.time).velocity - it.velocity).abs();
    let ends = one.last().zip(other.last()).map(|(one, other)| one.velocity - other.velocity);
    one.iter().map(change).fold(ends.map_or(0.0, f64::abs), f64::max)
}

/// Checks that friction is computed in a scene.
fn check(scene: &Scene) -> Result<(), Rejection> {
    let reject = |key: &str, message: &str, help: &str| {
        Err(Rejection::new(key, format!("an oblique impact with friction {message}"))
            .with_help(help))
    };
    let bodies = scene.bodies();
    let law = match scene.model() {
        ModelChoice::Fem => {
            let message = "is not computed by model fem";
            return reject("contact.friction", message, "use model condensed or ting");
        }
        ModelChoice::Law { law, .. } => Some(law),
        _ => None,
    };
    if let Some(law) = law.filter(|law| law.family.strength_parameter().is_some()) {
        let name = law.family.name();
        let message = format!("is not computed beside plastic flow, which law {name} has");
        return reject(
            "model.law",
            &message,
            "use model condensed or ting, or contact.friction = 0",
        );
    }
    if let Some(side) = bodies.iter().position(|body| body.plate().is_some()) {
        let help = "write half_space = {} in place of the plate, or contact.friction = 0";
        return reject(&format!("body.{side}.plate"), "is not computed on a plate", help);
    }
    if let Some(side) = bodies.iter().position(|body| body.own_mass().is_some()) {
        let help = "remove the mass, or write contact.friction = 0";
        let message = "needs a moment of inertia, which a mass of its own does not give";
        return reject(&format!("body.{side}.sphere.mass"), message, help);
    }
    if scene.gravity().is_some_and(|gravity| gravity.bounces > 1) {
        let help = "write stop.bounces = 1 and go on from the velocities and spins of its result";
        return reject("stop.bounces", "is computed for one contact", help);
    }
    Ok(())
}
