//! The whole problem, constant over a run.

use fem_collision::{Approach, BodyInput};
use fem_contact::{ContactInterface, Surface};

use crate::body::Body;
use crate::error::ModelError;
use crate::time_step::NodalBound;

/// Numerical settings of a model.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Settings {
    /// Penalty factor times the pair's contact modulus E*, Pa.
    pub contact_stiffness: f64,
    /// Radius out to which contact is looked for, m.
    pub candidate_radius: f64,
    /// Time step over critical time step, in (0, 1].
    pub step_factor: f64,
    /// Largest added mass as a fraction of a body's mass, in [0, 1).
    pub mass_scaling: f64,
}

/// Two bodies, their contact and the time step. The first body lies below.
#[derive(Debug, Clone)]
pub struct Model {
    bodies: [Body; 2],
    interface: ContactInterface,
    time_step: f64,
    plain_time_step: f64,
    approach: Approach,
}

impl Model {
    /// Lumps masses, pairs the surfaces, chooses the time step.
    ///
    /// # Errors
    /// Settings out of range, two walls, bodies that do not approach.
    pub fn new(
        inputs: [BodyInput; 2],
        approach: Approach,
        settings: &Settings,
    ) -> Result<Self, ModelError> {
        check(settings, approach.gap)?;
        let approach_speed = approach.speed();
        if !(approach_speed > 0.0 && approach_speed.is_finite()) {
            return Err(ModelError::NotApproaching(approach_speed));
        }
        let [lower, upper] = inputs
            .each_ref()
            .map(|input| input.mesh().map_or_else(Surface::wall, Surface::of_sphere));
        let interface = ContactInterface::new(
            lower,
            upper,
            settings.contact_stiffness,
            approach.gap,
            settings.candidate_radius,
        )?;
        let bounds: [Option<NodalBound>; 2] = std::array::from_fn(|side| match &inputs[side] {
            BodyInput::Sphere { mesh, material } => {
                let mut bound = NodalBound::of_sphere(mesh, material);
                interface.add_stiffness_bound(side, &mut bound.stiffness);
                Some(bound)
            }
            BodyInput::Wall => None,
        });
        let smallest = |step: &dyn Fn(&NodalBound) -> f64| {
            bounds.iter().flatten().map(step).fold(f64::INFINITY, f64::min)
        };
        let plain = smallest(&NodalBound::critical_time_step);
        let critical = smallest(&|bound| bound.scaled_time_step(settings.mass_scaling));
        let time_step = settings.step_factor * critical;
        let mut parts = inputs.into_iter().zip(bounds);
        let bodies = approach.velocities.map(|velocity| match parts.next() {
            Some((BodyInput::Sphere { mesh, material }, Some(bound))) => {
                let (nodal_mass, added_mass) = bound.scale_mass(critical);
                Body::deformable(mesh, &material, velocity, nodal_mass, added_mass, time_step)
            }
            _ => Body::wall(velocity),
        });
        Ok(Self {
            bodies,
            interface,
            time_step,
            plain_time_step: settings.step_factor * plain,
            approach,
        })
    }

    /// Lower and upper body.
    pub fn bodies(&self) -> &[Body; 2] {
        &self.bodies
    }

    /// Their contact.
    pub fn interface(&self) -> &ContactInterface {
        &self.interface
    }

    /// Time step, s.
    pub fn time_step(&self) -> f64 {
        self.time_step
    }

    /// What the time step would be without mass scaling, s.
    pub fn plain_time_step(&self) -> f64 {
        self.plain_time_step
    }

    /// How the bodies meet. Free flight before first touch is not stepped.
    pub fn approach(&self) -> &Approach {
        &self.approach
    }

    /// Number of elements of both bodies.
    pub fn n_elements(&self) -> usize {
        self.bodies.iter().map(Body::n_elements).sum()
    }
}

fn check(settings: &Settings, gap: f64) -> Result<(), ModelError> {
    let &Settings { step_factor, mass_scaling, .. } = settings;
    let setting = |name, value, allowed| Err(ModelError::Setting { name, value, allowed });
    check_step_factor(step_factor)?;
    if !(0.0..1.0).contains(&mass_scaling) {
        return setting("mass scaling", mass_scaling, "at least 0 and below 1");
    }
    if !(gap >= 0.0 && gap.is_finite()) {
        return setting("gap", gap, "at least 0");
    }
    Ok(())
}

pub(crate) fn check_step_factor(value: f64) -> Result<(), ModelError> {
    if value > 0.0 && value <= 1.0 {
        return Ok(());
    }
    Err(ModelError::Setting { name: "step factor", value, allowed: "above 0 and at most 1" })
}
