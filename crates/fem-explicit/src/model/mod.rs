//! The model: bodies, contact and time step, constant over a run.

mod fingerprint;

use std::any::Any;
use std::sync::Arc;

use fem_collision::{Approach, BodyInput, CandidateRegion, Frame};
use fem_contact::ContactInterface;
use fem_material::Material;
use fem_material::finite::HyperelasticLaw;

use crate::body::{Body, UnscaledBody};
use crate::contact::{
    Contact, DeformedContact, Massless, SmallStrainContact, Springs, contact_between,
};
use crate::error::ModelError;
use crate::forces::NodeForce;
use crate::part::Motion;
use crate::settings::Settings;
use crate::stress::FiniteStrainChoice;
pub(crate) use fingerprint::fingerprint;

/// Parts of a model beyond those that follow from its bodies and settings: none by default.
///
/// The stress of a body follows from its material and, at finite strain, from a law. The contact follows from the
/// settings; it acts between the deformed surfaces if either body is at finite strain.
#[derive(Debug, Default)]
pub struct ModelParts {
    /// Forces on the nodes of the lower and of the upper body, in the order in which they are added.
    pub node_forces: [Vec<Box<dyn NodeForce>>; 2],
    /// Whether the mass centre of the lower and of the upper sphere is held in place, by forces on its nodes in
    /// proportion to their masses.
    pub held: [bool; 2],
    /// Hyperelastic laws of the lower and of the upper body; without one a body is at small strain. At finite strain
    /// the time step follows the stiffness of the deformed bodies.
    pub finite_strain: [Option<HyperelasticLaw>; 2],
    /// Distance from first touch (m) within which elements of such bodies are at finite strain; elements farther away
    /// stay at small strain. By default all elements are at finite strain.
    pub finite_strain_within: Option<f64>,
    /// Whether the surfaces slip on each other, as those of unlike materials do. At finite strain they always may.
    pub surface_slip: bool,
    /// A contact in place of the springs.
    pub contact: Option<Box<dyn Contact>>,
    /// Contact method at small strain.
    pub method: SmallStrainContact,
    /// Stiffness of the springs over the usual one. Stiffer springs between nodes with mass need a shorter step than
    /// stability asks for ([`SmallStrainContact::stability_factor`]).
    pub penalty_factor: f64,
}

/// Two bodies, their contact and the time step. The first body lies below.
#[derive(Debug, Clone)]
pub struct ExplicitBodies {
    bodies: [Body; 2],
    contact: Arc<dyn Contact>,
    /// Whether it has anything to do at the end of a step.
    pub(crate) contact_advances: bool,
    time_step: f64,
    plain_time_step: f64,
    step_factor: f64,
    approach: Approach,
    /// Σ 1/m of both bodies with mass scaling, 1/kg; 0 of what is held.
    pub(crate) inverse_mass: f64,
}

impl ExplicitBodies {
    /// Lumps masses, pairs the surfaces and chooses the time step.
    ///
    /// # Errors
    /// A setting is out of range; both bodies are rigid or both surfaces are planes; the radius or the mass of a rigid
    /// sphere is not positive and finite.
    pub fn new(
        inputs: [BodyInput; 2],
        approach: Approach,
        settings: &Settings,
    ) -> Result<Self, ModelError> {
        Self::with_parts(inputs, approach, settings, ModelParts::default())
    }

    /// Builds a model as [`ExplicitBodies::new`] does, with parts of the caller.
    ///
    /// # Errors
    /// Those of [`ExplicitBodies::new`]; forces on a wall; finite strain of a rigid body.
    pub fn with_parts(
        inputs: [BodyInput; 2],
        approach: Approach,
        settings: &Settings,
        parts: ModelParts,
    ) -> Result<Self, ModelError> {
        settings.check()?;
        let mut contact: Box<dyn Contact> = match parts.contact {
            Some(contact) => contact,
            None if parts.finite_strain.iter().any(Option::is_some) => {
                Box::new(DeformedContact::new(&inputs, approach.gap(), settings)?)
            }
            None => {
                let times = parts.method.stability_factor(parts.penalty_factor);
                let (gap, slips) = (approach.gap(), parts.surface_slip);
                contact_between(&inputs, gap, settings, (parts.method, slips, times))?
            }
        };
        let [lower, upper] = inputs;
        let [forces_on_lower, forces_on_upper] = parts.node_forces;
        let of = |law| FiniteStrainChoice { law, within: parts.finite_strain_within };
        let [law_of_lower, law_of_upper] = parts.finite_strain.map(|law| law.map(of));
        let mut movable = [
            UnscaledBody::new(lower, law_of_lower, forces_on_lower, contact.massless_nodes(0))?,
            UnscaledBody::new(upper, law_of_upper, forces_on_upper, contact.massless_nodes(1))?,
        ];
        for (side, body) in movable.iter_mut().enumerate() {
            if let Some(body) = body {
                contact.add_stiffness_bound(side, body.stiffness_mut());
                contact.add_damping_bound(side, body.damping_mut());
            }
        }
        let [plain, critical] = critical_time_steps(&movable, settings);
        let time_step = settings.step_factor * critical;
        if !(time_step > 0.0 && time_step.is_finite()) {
            return Err(ModelError::NoStep { time_step });
        }
        contact.set_time_step(time_step);
        contact.check()?;
        let changes_stiffness = movable.iter().flatten().any(UnscaledBody::changes_stiffness);
        let mut movable = movable.into_iter().zip(parts.held);
        let mut next = || movable.next().and_then(|(body, held)| Some((body?, held)));
        let bodies = approach.velocities().map(|velocity| match next() {
            Some((body, held)) => {
                Body::scaled(body, velocity, critical, time_step, changes_stiffness).with_held(held)
            }
            None => Body::wall(velocity),
        });
        Ok(Self {
            inverse_mass: bodies.iter().map(Body::inverse_mass_of_centre).sum(),
            bodies,
            contact_advances: contact.n_history() > 0
                || (0..2).any(|side| !contact.massless_nodes(side).is_empty()),
            contact: Arc::from(contact),
            time_step,
            plain_time_step: settings.step_factor * plain,
            step_factor: settings.step_factor,
            approach,
        })
    }

    /// Returns the same bodies with another approach of the same gap. Unlike [`ExplicitBodies::new`] it leaves everything
    /// else as it was chosen for the speed of this model.
    #[must_use]
    pub fn approaching(&self, approach: Approach) -> Self {
        let mut other = Self { approach, ..self.clone() };
        for (body, velocity) in other.bodies.iter_mut().zip(approach.velocities()) {
            body.velocity = velocity;
        }
        other
    }

    /// Returns the lower and the upper body.
    pub fn bodies(&self) -> &[Body; 2] {
        &self.bodies
    }

    /// Returns the contact of the two bodies.
    pub fn contact(&self) -> &dyn Contact {
        self.contact.as_ref()
    }

    /// Returns the springs of the contact; `None` where it has none or its surfaces slip.
    pub fn interface(&self) -> Option<&ContactInterface> {
        let contact = self.contact() as &dyn Any;
        let massless = contact.downcast_ref::<Massless>().map(Massless::springs);
        match contact.downcast_ref().or(massless)? {
            Springs::Undeformed(interface) => Some(interface),
            Springs::Slipping(_) => None,
        }
    }

    /// Returns the radius of the candidate region, in which contact is searched for, m.
    pub fn candidate_radius(&self) -> f64 {
        self.candidate_region().radius
    }

    /// Returns the candidate region.
    pub fn candidate_region(&self) -> CandidateRegion {
        self.contact.candidate_region()
    }

    /// Returns the time step, s; the longest of a run where the stiffness of a body changes.
    pub fn time_step(&self) -> f64 {
        self.time_step
    }

    /// Returns the time step over the critical time step.
    pub(crate) fn step_factor(&self) -> f64 {
        self.step_factor
    }

    /// Returns whether the stiffness of a body changes as it deforms, and the time step with it.
    pub fn changes_stiffness(&self) -> bool {
        self.bodies.iter().any(|body| body.bound.is_some())
    }

    /// Returns the time since the start of the case after a number of steps, s.
    pub(crate) fn time_after(&self, step: u64) -> f64 {
        self.approach.first_touch() + step as f64 * self.time_step
    }

    /// Returns the time step without mass scaling, s.
    pub fn plain_time_step(&self) -> f64 {
        self.plain_time_step
    }

    /// Returns the time after first touch (s) at which waves can be back at the contact from the far boundary of a
    /// half-space; `None` without a half-space.
    pub(crate) fn waves_return(&self) -> Option<f64> {
        let returns = self.far_boundaries().map(|(radius, speed)| {
            let way = radius - self.candidate_radius();
            2.0 * way / speed
        });
        returns.reduce(f64::min)
    }

    /// Returns the far radius (m) of half-spaces from whose boundary no wave returns within a time after first touch, s.
    pub(crate) fn far_radius_without_return(&self, time: f64) -> f64 {
        let ways = self.far_boundaries().map(|(_, speed)| 0.5 * speed * time);
        self.candidate_radius() + ways.fold(0.0, f64::max)
    }

    /// Returns the far radius (m) of each half-space or plate, and the speed of the waves that matter there, m/s.
    fn far_boundaries(&self) -> impl Iterator<Item = (f64, f64)> {
        self.bodies.iter().filter_map(|body| {
            let radius = body.mesh()?.far_radius()?;
            let material = body.material()?;
            // Bending waves carry what matters in a plate, and none is faster than shear waves.
            let speed = match body.mesh()?.thickness() {
                Some(_) => material.shear_wave_speed(),
                None => material.dilatational_wave_speed(),
            };
            Some((radius, speed))
        })
    }

    /// Returns how the bodies meet. Free flight before first touch is not stepped.
    pub fn approach(&self) -> &Approach {
        &self.approach
    }

    /// Returns the frame of the common mass centre, mass scaling included.
    pub(crate) fn frame(&self) -> Frame {
        let mass = |body: &Body| (body.is_free() && !body.held).then(|| body.mass());
        let masses = self.bodies.each_ref().map(mass);
        Frame {
            approach: self.approach,
            masses,
            reduced_mass: self.inverse_mass.recip(),
            gravity: self.gravity(),
        }
    }

    /// Returns the acceleration of the approach by uniform forces, m/s².
    pub(crate) fn gravity(&self) -> f64 {
        self.bodies[0].acceleration - self.bodies[1].acceleration
    }

    /// Returns the largest strain rate (1/s) of an element at finite strain as first touch changes the velocity of its
    /// pole. The bodies share the change in inverse proportion to their impedances, as waves do.
    pub(crate) fn first_strain_rate(&self) -> f64 {
        let compliances = self.bodies.each_ref().map(|body| {
            let of = |material: &Material| {
                (material.density() * material.dilatational_wave_speed()).recip()
            };
            body.material().map_or(0.0, of)
        });
        let rate = |side: usize| {
            let body = &self.bodies[side];
            let (stress, pole) = (body.finite_strain()?, *body.mesh()?.surface().first()?);
            let displacement = vec![[0.0; 2]; body.nodal_mass.len()];
            let mut velocity = displacement.clone();
            velocity[pole as usize][1] =
                self.approach.speed() * compliances[side] / (compliances[0] + compliances[1]);
            let (time, time_step) = (self.approach.first_touch(), self.time_step);
            let (displacement, velocity) = (&*displacement, &*velocity);
            let nodal_mass = &*body.nodal_mass;
            let motion = Motion { time, time_step, displacement, velocity, nodal_mass };
            Some(stress.strain_rate(&motion))
        };
        [0, 1].into_iter().filter_map(rate).fold(0.0, f64::max)
    }

    /// Returns the number of elements of both bodies.
    pub fn n_elements(&self) -> usize {
        self.bodies.iter().map(Body::n_elements).sum()
    }
}

/// Returns the critical time step (s) of both bodies without and with mass scaling; a body has at most the mass that the lightest body
/// would have as a share of its own.
fn critical_time_steps(bodies: &[Option<UnscaledBody>; 2], settings: &Settings) -> [f64; 2] {
    let movable =
        || bodies.iter().zip(settings.mass_times).filter_map(|(it, n)| Some((it.as_ref()?, n)));
    let lightest = movable().filter_map(|(body, _)| body.mass()).reduce(f64::min);
    let lightest = lightest.unwrap_or_default();
    let plain = movable().map(|(body, _)| body.bound().critical_time_step());
    let scaled = movable().map(|(body, times)| {
        let whole = body.mass().unwrap_or(f64::INFINITY).min(times * lightest);
        body.scaled_time_step(settings.mass_scaling * whole)
    });
    [plain.fold(f64::INFINITY, f64::min), scaled.fold(f64::INFINITY, f64::min)]
}
