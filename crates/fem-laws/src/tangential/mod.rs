//! The tangential half of an oblique impact: friction, sticking and rebound of the contact patch.
//!
//! Beside each spring of the normal contact ([`NormalSprings`]) stands a tangential one. It holds at most the coefficient of
//! friction times the load of the other and slides beyond; while it sticks it follows the patch with the tangential modulus
//!
//! ```math
//! \frac1{G^*(s)} = \sum_{i=1,2}\frac{2-\nu_i}{4G_i}(s) = \sum_{i=1,2}\frac38\left[\frac1{G_i(s)}+\frac1{3K_i(s)+G_i(s)}\right].
//! ```
//!
//! The springs are equivalent to a disc that sticks inside a ring that slides (Popov & Heß 2015, ch. 5; for impacts Willert, Kusche &
//! Popov 2017), under the assumption of Maw, Barber & Fawcett (Wear 38, 1976, 101): like materials, no radial slip. The patch moves by
//!
//! ```math
//! m_t\dot v_t = -T, \qquad \frac1{m_t} = \sum_{i=1,2}\Bigl(\frac1{m_i}+\frac{R_i^2}{I_i}\Bigr) = \sum_{i=1,2}\frac{7}{2m_i},
//! ```
//!
//! of which the springs take the displacement that [`FiniteSize::tangential`] leaves them. A spring whose load has gone recovers freely, so that
//! the sum of all elongations times the modulus before relaxation is the pseudo-force of the finite size. Steps are those of the
//! trapezoidal rule: what the motion loses is to rounding what springs hold, dashpots and friction take.
//!
//! Limits: a contact small beside the bodies, no waves of shear, one contact; friction does not alter the normal contact.

mod far_field;
mod normal_springs;

pub use normal_springs::NormalSprings;

use fem_material::{Material, PronyTerm, RelaxationStep};

use crate::error::LawError;
use crate::finite_size::FiniteSize;
use crate::pair_relaxation::PairRelaxation;
use crate::tangential::far_field::FarField;

/// Largest number of Newton's iterations of a step. Sticking springs are linear; each that begins to slide may take one more.
const MAX_ITERATIONS: usize = 50;

/// Two bodies that touch obliquely.
#[derive(Debug, Clone, PartialEq)]
pub struct TangentialContact {
    /// Tangential modulus G* before relaxation, Pa.
    modulus: f64,
    relaxation: PairRelaxation,
    /// Mass m_t of the patch, kg.
    mass: f64,
    /// Coulomb's coefficient of friction.
    friction: f64,
    size: Option<FiniteSize>,
}

/// The motion of the contact patch in an oblique impact.
#[derive(Debug, Clone, PartialEq)]
pub struct TangentialImpact {
    /// Velocity of the patch after the impact, m/s.
    pub velocity: f64,
    /// ∫T dt, N s; positive against a positive velocity of the patch.
    pub impulse: f64,
    /// Work of friction, J.
    pub friction_work: f64,
    /// Energy lost by relaxation of the tangential springs, J.
    pub relaxation_loss: f64,
    /// Largest residual of the energies, J.
    pub residual: f64,
    /// At the steps of the springs.
    pub history: Vec<TangentialInstant>,
}

/// The tangential contact at one instant.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct TangentialInstant {
    /// After first touch, s.
    pub time: f64,
    /// T, N; positive against a positive velocity of the patch.
    pub force: f64,
    /// Velocity of the contact patch, m/s.
    pub velocity: f64,
    /// Radius of the disc that sticks, m.
    pub stick_radius: f64,
    /// Energy held by the springs and the bodies around them, J.
    pub strain_energy: f64,
    /// Work of friction since first touch, J.
    pub friction_work: f64,
    /// Energy lost by relaxation since first touch, J.
    pub relaxation_loss: f64,
}

impl TangentialContact {
    /// Creates the contact of two bodies, of which `None` is rigid, from the mass m_t of the patch (kg) and Coulomb's coefficient.
    ///
    /// # Errors
    /// Two rigid bodies; relaxation times that leave the range of f64.
    pub fn new(bodies: [Option<&Material>; 2], mass: f64, friction: f64) -> Result<Self, LawError> {
        let (modulus, relaxation) = PairRelaxation::tangential(bodies[0], bodies[1])?;
        Ok(Self { modulus, relaxation, mass, friction, size: None })
    }

    /// Adds the finite size of the bodies, of the same materials.
    #[must_use]
    pub fn with_finite_size(self, size: FiniteSize) -> Self {
        Self { size: Some(size), ..self }
    }

    /// Returns the contact with a modulus that is larger by a share.
    #[must_use]
    pub fn stiffer_by(self, share: f64) -> Self {
        Self { modulus: (1.0 + share) * self.modulus, ..self }
    }

    /// Returns the contact with another coefficient of friction.
    #[must_use]
    pub fn with_friction(self, friction: f64) -> Self {
        Self { friction, ..self }
    }

    /// Returns Coulomb's coefficient of friction.
    pub fn friction(&self) -> f64 {
        self.friction
    }

    /// Returns m_t, kg.
    pub fn mass(&self) -> f64 {
        self.mass
    }

    /// Returns whether the bodies have a finite size.
    pub fn has_finite_size(&self) -> bool {
        self.size.is_some()
    }

    /// Returns G* before relaxation, Pa.
    pub fn modulus(&self) -> f64 {
        self.modulus
    }

    /// Returns the impact of a patch with a velocity (m/s) under the loads of the normal contact.
    pub fn impact(&self, normal: &NormalSprings, velocity: f64) -> TangentialImpact {
        Sliding::new(self, normal, velocity).run()
    }
}

/// Change of the displacement of the patch, as a share, at which its iteration ends.
const SETTLED: f64 = 1e-13;

/// The springs under way.
struct Sliding<'a> {
    contact: &'a TangentialContact,
    normal: &'a NormalSprings,
    /// Weight of each term, and its factors over a step.
    terms: Vec<(f64, RelaxationStep)>,
    /// Largest force of a spring over its load, 1/Pa.
    limit: f64,
    /// g∞ + Σ g_k of what is kept of a change in the step.
    stiffness: f64,
    /// What each spring holds over G* per length if it keeps its elongation over the step, m.
    held: Vec<f64>,
    elongations: Vec<f64>,
    /// Elongation of the springs of each term, m.
    branches: Vec<Vec<f64>>,
    far_field: FarField,
    force: f64,
    velocity: f64,
    initial: f64,
    impulse: f64,
    friction_work: f64,
    relaxation_loss: f64,
    residual: f64,
    history: Vec<TangentialInstant>,
}

impl<'a> Sliding<'a> {
    fn new(contact: &'a TangentialContact, normal: &'a NormalSprings, velocity: f64) -> Self {
        let factors = |term: &PronyTerm| {
            (term.weight, RelaxationStep::new(term.relaxation_time, normal.time_step))
        };
        let terms: Vec<_> = contact.relaxation.terms().iter().map(factors).collect();
        let equilibrium = contact.relaxation.equilibrium_weight();
        let stiffness =
            equilibrium + terms.iter().map(|(weight, step)| weight * step.gain).sum::<f64>();
        let widest = normal.places[normal.places.len() - 1];
        Self {
            contact,
            normal,
            limit: contact.friction / contact.modulus,
            stiffness,
            held: Vec::with_capacity(normal.places.len()),
            elongations: vec![0.0; normal.places.len()],
            branches: vec![vec![0.0; normal.places.len()]; terms.len()],
            far_field: FarField::new(
                contact.size.as_ref(),
                &contact.relaxation,
                widest,
                normal.time_step,
            ),
            terms,
            force: 0.0,
            velocity,
            initial: 0.5 * contact.mass * velocity * velocity,
            impulse: 0.0,
            friction_work: 0.0,
            relaxation_loss: 0.0,
            residual: 0.0,
            history: vec![TangentialInstant { velocity, ..TangentialInstant::default() }],
        }
    }

    fn run(mut self) -> TangentialImpact {
        for step in 1..=self.normal.n_steps() {
            self.advance(step);
        }
        TangentialImpact {
            velocity: self.velocity,
            impulse: self.impulse,
            friction_work: self.friction_work,
            relaxation_loss: self.relaxation_loss,
            residual: self.residual,
            history: self.history,
        }
    }

    /// Advances by a step. The displacement of the springs in it is found by Newton's method from that of the bodies.
    fn advance(&mut self, step: usize) {
        let (time_step, mass) = (self.normal.time_step, self.contact.mass);
        self.hold(self.normal.at(step).len());
        let inertia = 0.25 * time_step * time_step / mass;
        let free = time_step * self.velocity - inertia * self.force;
        let (mut moved, mut sums) = (free, Sums::default());
        for _ in 0..MAX_ITERATIONS {
            sums = self.sums(step, moved);
            let excess = moved + inertia * sums.force + self.far_field.change(sums.change) - free;
            let steepness = 1.0 + (inertia * self.stiffness + self.far_field.slope()) * sums.slope;
            let next = moved - excess / steepness;
            if (next - moved).abs() <= SETTLED * free.abs().max(moved.abs()) {
                break;
            }
            moved = next;
        }
        let mean = 0.5 * (self.force + sums.force);
        self.impulse += time_step * mean;
        self.velocity -= time_step * mean / mass;
        let (strain, stick_radius) = self.stretch(step, moved);
        let [held, lost] = self.far_field.advance(sums.change, sums.force);
        self.relaxation_loss += lost;
        self.force = sums.force;
        let instant = TangentialInstant {
            time: step as f64 * time_step,
            force: self.force,
            velocity: self.velocity,
            stick_radius,
            strain_energy: strain + held,
            friction_work: self.friction_work,
            relaxation_loss: self.relaxation_loss,
        };
        let accounted = instant.strain_energy + self.friction_work + self.relaxation_loss;
        let gained = 0.5 * mass * self.velocity.powi(2) + accounted - self.initial;
        self.residual = self.residual.max(gained.abs());
        self.history.push(instant);
    }

    /// Finds what each spring holds at the end of the step if it keeps its elongation.
    fn hold(&mut self, n_reached: usize) {
        let equilibrium = self.contact.relaxation.equilibrium_weight();
        self.held.clear();
        let reached = self.elongations[..n_reached].iter();
        self.held.extend(reached.map(|elongation| equilibrium * elongation));
        for ((weight, step), branch) in self.terms.iter().zip(&self.branches) {
            for (held, branch) in self.held.iter_mut().zip(branch) {
                *held += weight * step.decay * branch;
            }
        }
    }

    /// Returns what a spring holds over G* per length at the end of a step in which the patch moves, and whether it sticks.
    fn clipped(&self, spring: usize, load: f64, moved: f64) -> (f64, bool) {
        let limit = self.limit * load;
        let free = self.held[spring] + self.stiffness * moved;
        (free.clamp(-limit, limit), free.abs() < limit)
    }

    fn sums(&self, step: usize, moved: f64) -> Sums {
        let mut sums = Sums::default();
        for (spring, load) in self.normal.at(step).iter().enumerate() {
            let unit = self.normal.lengths[spring] * self.contact.modulus;
            let (now, sticks) = self.clipped(spring, *load, moved);
            sums.force += unit * now;
            sums.change += unit * (now - self.held[spring]) / self.stiffness;
            sums.slope += if sticks { unit } else { 0.0 };
        }
        sums
    }

    /// Stretches the springs by a step in which the patch moves. Returns the energy that they hold, J, and the radius of the outermost
    /// that sticks, m.
    fn stretch(&mut self, step: usize, moved: f64) -> (f64, f64) {
        let equilibrium = self.contact.relaxation.equilibrium_weight();
        let (mut strain, mut stick_radius) = (0.0, 0.0);
        for (spring, load) in self.normal.at(step).iter().enumerate() {
            let unit = self.normal.lengths[spring] * self.contact.modulus;
            let (now, sticks) = self.clipped(spring, *load, moved);
            if sticks {
                stick_radius = self.normal.places[spring];
            }
            let stretched = (now - self.held[spring]) / self.stiffness;
            let mut before = equilibrium * self.elongations[spring];
            self.elongations[spring] += stretched;
            strain += unit * equilibrium * self.elongations[spring].powi(2);
            for ((weight, step), branch) in self.terms.iter().zip(&mut self.branches) {
                let old = branch[spring];
                let new = step.advance(old, stretched);
                before += weight * old;
                // The mean force by what the dashpot gives way.
                let given = stretched - (new - old);
                self.relaxation_loss += unit * weight * 0.5 * (old + new) * given;
                strain += unit * weight * new * new;
                branch[spring] = new;
            }
            self.friction_work += unit * 0.5 * (before + now) * (moved - stretched);
        }
        (0.5 * strain, stick_radius)
    }
}

/// What the springs sum up to at the end of a step.
#[derive(Default)]
struct Sums {
    /// Force of the springs, N.
    force: f64,
    /// Change of the pseudo-force in the step, N.
    change: f64,
    /// Its slope in the displacement of the patch, N/m.
    slope: f64,
}
