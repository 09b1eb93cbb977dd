//! Penalty springs between the surfaces, as a contact without history.

use std::f64::consts::PI;

use fem_collision::{BodyInput, CandidateRegion};
use fem_contact::{
    ContactError, ContactForces, ContactInterface, Displacement, Profile, SlippingInterface,
    Surface,
};

use super::{Contact, Massless, SmallStrainContact};
use crate::error::ModelError;
use crate::part::{Field, Motion, NodalField, Part};
use crate::settings::Settings;

/// Penalty springs of [`fem_contact`].
#[derive(Debug)]
pub enum Springs {
    /// Springs along y, whose gap is a linear function of the displacements.
    Undeformed(ContactInterface),
    /// Springs between surfaces that slip on each other: they turn, and their gap is a function of second order.
    Slipping(SlippingInterface),
}

/// Makes the contact that settings ask for, between surfaces that slip or do not.
pub(crate) fn contact_between(
    inputs: &[BodyInput; 2],
    gap: f64,
    settings: &Settings,
    (method, surface_slip, stability_factor): (SmallStrainContact, bool, f64),
) -> Result<Box<dyn Contact>, ModelError> {
    let [lower, upper] = inputs;
    let (lower_surface, upper_surface) = (surface(lower)?, surface(upper)?);
    let &Settings { contact_stiffness, candidate_radius, .. } = settings;
    let interface = match method {
        SmallStrainContact::NodeToSurface if !surface_slip => ContactInterface::node_to_surface,
        _ => ContactInterface::new,
    };
    let interface =
        interface(lower_surface, upper_surface, contact_stiffness, gap, candidate_radius)?;
    let interface = match mass_ratio(inputs) {
        Some(ratio) => interface.with_rigid_mass(ratio),
        None => interface,
    };
    let interface = interface.with_stability_factor(stability_factor);
    let springs = match surface_slip {
        true => Springs::Slipping(SlippingInterface::new(interface)),
        false => Springs::Undeformed(interface),
    };
    Ok(match method {
        SmallStrainContact::Massless => Box::new(Massless::new(inputs, springs)?),
        SmallStrainContact::Penalty | SmallStrainContact::NodeToSurface => Box::new(springs),
    })
}

/// Returns the mass of a rigid sphere over that of the deformable sphere that it meets; `None` for other pairs.
pub(super) fn mass_ratio(inputs: &[BodyInput; 2]) -> Option<f64> {
    match inputs {
        [BodyInput::Rigid { mass, .. }, BodyInput::Sphere { mesh, material }]
        | [BodyInput::Sphere { mesh, material }, BodyInput::Rigid { mass, .. }] => {
            let volume = 4.0 / 3.0 * PI * mesh.radius().powi(3);
            Some(mass / (material.density() * volume))
        }
        _ => None,
    }
}

/// Returns the surface of a body that can touch the other one.
pub(super) fn surface(input: &BodyInput) -> Result<Surface, ContactError> {
    match input {
        BodyInput::Sphere { mesh, .. } | BodyInput::HalfSpace { mesh, .. } => {
            Ok(Surface::of_sphere(mesh))
        }
        BodyInput::Rigid { radius, .. } => Surface::rigid_sphere(*radius),
        BodyInput::Wall => Ok(Surface::wall()),
    }
}

impl Springs {
    /// Returns the springs without their slip.
    pub fn interface(&self) -> &ContactInterface {
        match self {
            Self::Undeformed(interface) => interface,
            Self::Slipping(slipping) => slipping.interface(),
        }
    }

    /// Returns the springs if their surfaces slip.
    pub fn slipping(&self) -> Option<&SlippingInterface> {
        match self {
            Self::Undeformed(_) => None,
            Self::Slipping(slipping) => Some(slipping),
        }
    }

    /// Returns the contact force (N) at the displacements of the nodes.
    pub fn force(&self, u: [&dyn Fn(u32) -> Displacement; 2]) -> f64 {
        match self {
            Self::Undeformed(interface) => interface.force(u.map(|u| move |node| u(node)[1])),
            Self::Slipping(slipping) => slipping.force(u),
        }
    }
}

impl Part for Springs {}

impl Contact for Springs {
    fn candidate_region(&self) -> CandidateRegion {
        let interface = self.interface();
        let (radius, n_points) = (interface.candidate_radius(), interface.n_points());
        CandidateRegion { radius, n_points, at_nodes: false }
    }

    fn add_stiffness_bound(&self, side: usize, bound: &mut [f64]) {
        match self {
            Self::Undeformed(interface) => interface.add_stiffness_bound(side, bound),
            Self::Slipping(slipping) => slipping.add_stiffness_bound(side, bound),
        }
    }

    fn add_forces(
        &self,
        motions: &[Motion<'_>; 2],
        _: [&[NodalField]; 2],
        forces: [&mut Field; 2],
    ) -> ContactForces {
        let u = motions.each_ref().map(|motion| motion.displacement);
        match self {
            Self::Undeformed(interface) => interface.add_forces(u, forces),
            Self::Slipping(slipping) => slipping.add_forces(u, forces),
        }
    }

    fn pushed_nodes(&self, side: usize) -> Vec<u32> {
        self.interface().points().iter().flat_map(|point| point.projections[side].nodes).collect()
    }

    fn is_closed_next(
        &self,
        _: &ContactForces,
        next: [&dyn Fn(u32) -> [f64; 2]; 2],
        _: [&[NodalField]; 2],
    ) -> bool {
        match self {
            Self::Undeformed(interface) => {
                interface.is_closed(next.map(|displacement| move |node| displacement(node)[1]))
            }
            Self::Slipping(slipping) => slipping.is_closed(next),
        }
    }

    fn radius_and_pressure(&self, motions: &[Motion<'_>; 2], _: [&[NodalField]; 2]) -> (f64, f64) {
        let u = motions.each_ref().map(|motion| motion.displacement);
        match self {
            Self::Undeformed(interface) => interface.radius_and_pressure(u),
            Self::Slipping(slipping) => slipping.radius_and_pressure(u),
        }
    }

    fn profile(&self, motions: &[Motion<'_>; 2], _: [&[NodalField]; 2]) -> Profile {
        let u = motions.each_ref().map(|motion| motion.displacement);
        match self {
            Self::Undeformed(interface) => interface.profile(u),
            Self::Slipping(slipping) => slipping.profile(u),
        }
    }
}
