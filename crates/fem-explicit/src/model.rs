//! The whole problem, constant over a run.

mod outlook;

use std::any::Any;
use std::f64::consts::PI;
use std::sync::Arc;

use fem_collision::{Approach, BodyInput, CandidateRegion, Frame};
use fem_contact::{ContactError, ContactInterface, SlippingInterface, Surface};
use fem_material::finite::HyperelasticLaw;

use crate::body::Body;
use crate::contact::{Contact, ContactMethod, Massless, MovedContact};
use crate::error::ModelError;
use crate::forces::NodeForce;
use crate::lumped::{FiniteStrainOf, LumpedBody};

/// Numerical settings of a model.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Settings {
    /// Penalty factor times the pair's contact modulus E*, Pa.
    pub contact_stiffness: f64,
    /// Radius out to which contact is looked for, m.
    pub candidate_radius: f64,
    /// Time step over critical time step, in (0, 1].
    pub step_factor: f64,
    /// Largest mass that is moved in a body, as a fraction of its mass or of `mass_times` that of the lighter one of
    /// both, whichever is less, in [0, 1).
    pub mass_scaling: f64,
    /// See [`Settings::mass_scaling`], of the lower and of the upper body. With 1, mass at the contact of a large body
    /// with a small one goes as the small one does; that of a body that hardly gives way does not.
    pub mass_times: [f64; 2],
}

/// Parts of a model beyond what its bodies and settings ask for by themselves: none by default.
///
/// The stress of a body follows from its material, at small strain or by a law beyond; the contact from
/// the settings, between the surfaces where they are now if either body is at finite strain.
#[derive(Debug, Default)]
pub struct Parts {
    /// Forces on the nodes of the lower and of the upper body, in the order in which they add up.
    pub node_forces: [Vec<Box<dyn NodeForce>>; 2],
    /// Spheres whose mass centres do not move, lower and upper: a force on their nodes in proportion to
    /// the masses takes up what else would move them. None by default.
    pub held: [bool; 2],
    /// Which energy the lower and the upper body store at finite strain; small strain where none is
    /// named. The time step of such a body follows its stiffness.
    pub finite_strain: [Option<HyperelasticLaw>; 2],
    /// Distance from first touch (m) within which elements of such bodies are at finite strain; those farther
    /// away stay at small strain. None by default: all are.
    pub finite_strain_within: Option<f64>,
    /// Whether the surfaces slip on each other, as those of unlike materials do. At finite strain they do
    /// of themselves.
    pub surface_slip: bool,
    /// Instead of springs.
    pub contact: Option<Box<dyn Contact>>,
    /// How springs keep the bodies apart at small strain, where their surfaces do not slip.
    pub method: ContactMethod,
    /// How many times as stiff as usual the springs are: where they pull at nodes with mass, stiffer ones ask
    /// for a shorter step than is stable, [`ContactMethod::shorter_steps`].
    pub penalty_factor: f64,
}

/// Two bodies, their contact and the time step. The first body lies below.
#[derive(Debug, Clone)]
pub struct Model {
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

impl Model {
    /// Lumps masses, pairs the surfaces, chooses the time step.
    ///
    /// # Errors
    /// Settings out of range, two rigid bodies or planes, a rigid sphere's radius or mass that is not
    /// positive and finite.
    pub fn new(
        inputs: [BodyInput; 2],
        approach: Approach,
        settings: &Settings,
    ) -> Result<Self, ModelError> {
        Self::with_parts(inputs, approach, settings, Parts::default())
    }

    /// As [`Model::new`] does, with parts of the caller's beside or in place of the settings' own.
    ///
    /// # Errors
    /// As [`Model::new`]; forces on a wall; finite strain of a rigid body.
    pub fn with_parts(
        inputs: [BodyInput; 2],
        approach: Approach,
        settings: &Settings,
        parts: Parts,
    ) -> Result<Self, ModelError> {
        check(settings)?;
        let mut contact: Box<dyn Contact> = match parts.contact {
            Some(contact) => contact,
            None if parts.finite_strain.iter().any(Option::is_some) => {
                Box::new(MovedContact::new(&inputs, approach.gap(), settings)?)
            }
            None => {
                let times = parts.method.shorter_steps(parts.penalty_factor);
                let (gap, slips) = (approach.gap(), parts.surface_slip);
                springs(&inputs, gap, settings, parts.method, slips, times)?
            }
        };
        let [lower, upper] = inputs;
        let [forces_on_lower, forces_on_upper] = parts.node_forces;
        let within = parts.finite_strain_within;
        let of = |law: HyperelasticLaw| FiniteStrainOf { law, within };
        let [law_of_lower, law_of_upper] = parts.finite_strain.map(|law| law.map(of));
        let massless = [0, 1].map(|side: usize| contact.massless_nodes(side));
        let mut movable = [
            LumpedBody::new(lower, law_of_lower, forces_on_lower, massless[0])?,
            LumpedBody::new(upper, law_of_upper, forces_on_upper, massless[1])?,
        ];
        for (side, body) in movable.iter_mut().enumerate() {
            if let Some(body) = body {
                contact.add_stiffness_bound(side, body.stiffness_mut());
                contact.add_damping_bound(side, body.damping_mut());
            }
        }
        let smallest = |step: &dyn Fn(&LumpedBody) -> f64| {
            movable.iter().flatten().map(step).fold(f64::INFINITY, f64::min)
        };
        let plain = smallest(&LumpedBody::critical_time_step);
        let masses = movable.each_ref().map(|body| body.as_ref().and_then(LumpedBody::mass));
        let lightest = masses.into_iter().flatten().reduce(f64::min).unwrap_or_default();
        let critical = movable.iter().zip(settings.mass_times).filter_map(|(body, times)| {
            let body = body.as_ref()?;
            let whole = body.mass().unwrap_or(f64::INFINITY).min(times * lightest);
            Some(body.scaled_time_step(settings.mass_scaling * whole))
        });
        let critical = critical.fold(f64::INFINITY, f64::min);
        let time_step = settings.step_factor * critical;
        if !(time_step > 0.0 && time_step.is_finite()) {
            return Err(ModelError::NoStep { time_step });
        }
        contact.set_time_step(time_step);
        contact.check()?;
        let changes_stiffness = movable.iter().flatten().any(LumpedBody::changes_stiffness);
        let mut movable = movable.into_iter().zip(parts.held);
        let mut next = || movable.next().and_then(|(body, held)| Some((body?, held)));
        let bodies = approach.velocities().map(|velocity| match next() {
            Some((body, held)) => {
                Body::of_lumped(body, velocity, critical, time_step, changes_stiffness)
                    .with_held(held)
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

    /// Lower and upper body.
    pub fn bodies(&self) -> &[Body; 2] {
        &self.bodies
    }

    /// The contact of the two bodies.
    pub fn contact(&self) -> &dyn Contact {
        self.contact.as_ref()
    }

    /// The springs of their contact, where it has any and its surfaces do not slip.
    pub fn interface(&self) -> Option<&ContactInterface> {
        let contact = self.contact() as &dyn Any;
        let massless = contact.downcast_ref::<Massless>().filter(|massless| !massless.slips());
        contact.downcast_ref().or_else(|| massless.map(Massless::interface))
    }

    /// Radius out to which contact is looked for, m.
    pub fn candidate_radius(&self) -> f64 {
        self.searched().radius
    }

    /// Where contact is looked for.
    pub fn searched(&self) -> CandidateRegion {
        self.contact.searched()
    }

    /// Time step, s; the longest of a run where the stiffness of a body changes.
    pub fn time_step(&self) -> f64 {
        self.time_step
    }

    /// Time step over critical time step.
    pub(crate) fn step_factor(&self) -> f64 {
        self.step_factor
    }

    /// Whether the stiffness of a body changes as it deforms, and the time step with it.
    pub fn changes_stiffness(&self) -> bool {
        self.bodies.iter().any(|body| body.bound.is_some())
    }

    /// Time after so many steps since the start of the case, s.
    pub(crate) fn time_after(&self, step: u64) -> f64 {
        self.approach.first_touch() + step as f64 * self.time_step
    }

    /// What the time step would be without mass scaling, s.
    pub fn plain_time_step(&self) -> f64 {
        self.plain_time_step
    }

    /// Time (s) after first touch at which waves can be back at the contact from the far boundary of a
    /// half-space; `None` without one.
    pub(crate) fn waves_return(&self) -> Option<f64> {
        let returns = self.bodies.iter().filter_map(|body| {
            let way = body.mesh()?.far_radius()? - self.candidate_radius();
            Some(2.0 * way / body.material()?.dilatational_wave_speed())
        });
        returns.reduce(f64::min)
    }

    /// How the bodies meet. Free flight before first touch is not stepped.
    pub fn approach(&self) -> &Approach {
        &self.approach
    }

    /// The frame of the common mass centre, mass scaling included.
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

    /// Acceleration of the approach by forces that act on whole bodies alike, m/s².
    pub(crate) fn gravity(&self) -> f64 {
        self.bodies[0].acceleration - self.bodies[1].acceleration
    }

    /// Number of elements of both bodies.
    pub fn n_elements(&self) -> usize {
        self.bodies.iter().map(Body::n_elements).sum()
    }
}

/// The contact that settings ask for.
fn springs(
    inputs: &[BodyInput; 2],
    gap: f64,
    settings: &Settings,
    method: ContactMethod,
    surface_slip: bool,
    shorter_steps: f64,
) -> Result<Box<dyn Contact>, ModelError> {
    let [lower, upper] = inputs;
    let (lower_surface, upper_surface) = (surface(lower)?, surface(upper)?);
    let &Settings { contact_stiffness, candidate_radius, .. } = settings;
    let interface = match method {
        ContactMethod::NodeToSurface if !surface_slip => ContactInterface::node_to_surface,
        _ => ContactInterface::new,
    };
    let interface =
        interface(lower_surface, upper_surface, contact_stiffness, gap, candidate_radius)?;
    let interface = match mass_ratio(inputs) {
        Some(ratio) => interface.with_rigid_mass(ratio),
        None => interface,
    };
    let interface = interface.with_shorter_steps(shorter_steps);
    Ok(match method {
        ContactMethod::Massless if surface_slip => {
            Box::new(Massless::slipping(inputs, SlippingInterface::new(interface))?)
        }
        _ if surface_slip => Box::new(SlippingInterface::new(interface)),
        ContactMethod::Massless => Box::new(Massless::new(inputs, interface)?),
        ContactMethod::Penalty | ContactMethod::NodeToSurface => Box::new(interface),
    })
}

/// Mass of a rigid sphere over that of the sphere that it meets; `None` of other pairs.
pub(crate) fn mass_ratio(inputs: &[BodyInput; 2]) -> Option<f64> {
    match inputs {
        [BodyInput::Rigid { mass, .. }, BodyInput::Sphere { mesh, material }]
        | [BodyInput::Sphere { mesh, material }, BodyInput::Rigid { mass, .. }] => {
            let volume = 4.0 / 3.0 * PI * mesh.radius().powi(3);
            Some(mass / (material.density() * volume))
        }
        _ => None,
    }
}

/// The touching side of a body.
pub(crate) fn surface(input: &BodyInput) -> Result<Surface, ContactError> {
    match input {
        BodyInput::Sphere { mesh, .. } | BodyInput::HalfSpace { mesh, .. } => {
            Ok(Surface::of_sphere(mesh))
        }
        BodyInput::Rigid { radius, .. } => Surface::rigid_sphere(*radius),
        BodyInput::Wall => Ok(Surface::wall()),
    }
}

fn check(settings: &Settings) -> Result<(), ModelError> {
    let &Settings { step_factor, mass_scaling, mass_times, .. } = settings;
    check_step_factor(step_factor)?;
    let (name, allowed) = ("mass scaling", "at least 0 and below 1");
    if !(0.0..1.0).contains(&mass_scaling) {
        return Err(ModelError::Setting { name, value: mass_scaling, allowed });
    }
    let (name, allowed) = ("times of the lighter mass", "positive and finite");
    match mass_times.into_iter().find(|times| !(*times > 0.0 && times.is_finite())) {
        Some(value) => Err(ModelError::Setting { name, value, allowed }),
        None => Ok(()),
    }
}

pub(crate) fn check_step_factor(value: f64) -> Result<(), ModelError> {
    if value > 0.0 && value <= 1.0 {
        return Ok(());
    }
    Err(ModelError::Setting { name: "step factor", value, allowed: "above 0 and at most 1" })
}
