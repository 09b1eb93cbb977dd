//! A body before the time step and mass scaling are known.

use fem_collision::BodyInput;
use fem_element::QuadGeometry;
use fem_material::Material;
use fem_mesh::SphereMesh;

use super::critical_time_step::NodalBound;
use super::massless_boundary_mass::BoundaryMass;
use crate::error::ModelError;
use crate::forces::NodeForce;
use crate::stress::{self, FiniteStrainChoice, Stress};

/// A body that contact and forces move, with its masses and a bound of the stiffness at its nodes, from which the time
/// step is chosen.
#[derive(Debug)]
pub(crate) enum UnscaledBody {
    Meshed(Box<UnscaledMesh>),
    Rigid(RigidSphere),
}

/// A sphere or a half-space with its parts.
#[derive(Debug)]
pub(crate) struct UnscaledMesh {
    pub mesh: SphereMesh,
    pub material: Material,
    pub stress: Box<dyn Stress>,
    pub node_forces: Vec<Box<dyn NodeForce>>,
    /// Without the share of the contact.
    pub bound: NodalBound,
}

/// A rigid sphere: one node that carries its mass.
#[derive(Debug)]
pub(crate) struct RigidSphere {
    pub node_forces: Vec<Box<dyn NodeForce>>,
    /// Without the share of the contact.
    pub bound: NodalBound,
}

impl UnscaledBody {
    /// Makes a body, some nodes of which may have no mass; `None` for a wall.
    ///
    /// # Errors
    /// The mass of a rigid sphere is not positive and finite; forces act on a wall; an element has no mass; a rigid
    /// body is to be at finite strain, or one that relaxes by too many terms.
    pub fn new(
        input: BodyInput,
        finite_strain: Option<FiniteStrainChoice>,
        node_forces: Vec<Box<dyn NodeForce>>,
        massless: &[u32],
    ) -> Result<Option<Self>, ModelError> {
        if input.mesh().is_none() && finite_strain.is_some() {
            return Err(ModelError::StrainOfRigid);
        }
        match input {
            BodyInput::Sphere { mesh, material } | BodyInput::HalfSpace { mesh, material } => {
                let meshed =
                    UnscaledMesh::new(mesh, material, finite_strain, node_forces, massless)?;
                Ok(Some(Self::Meshed(Box::new(meshed))))
            }
            BodyInput::Rigid { mass, .. } => {
                Ok(Some(Self::Rigid(RigidSphere::new(mass, node_forces)?)))
            }
            BodyInput::Wall if node_forces.is_empty() => Ok(None),
            BodyInput::Wall => Err(ModelError::ForceOnWall),
        }
    }

    /// Returns masses and bounds of its nodes.
    pub fn bound(&self) -> &NodalBound {
        match self {
            Self::Meshed(meshed) => &meshed.bound,
            Self::Rigid(sphere) => &sphere.bound,
        }
    }

    /// Returns the bound of the stiffness at its nodes, N/m, to which the contact adds its own.
    pub fn stiffness_mut(&mut self) -> &mut [f64] {
        match self {
            Self::Meshed(meshed) => &mut meshed.bound.stiffness,
            Self::Rigid(sphere) => &mut sphere.bound.stiffness,
        }
    }

    /// Returns the bound of the damping at its nodes, N s/m, to which the contact adds its own.
    pub fn damping_mut(&mut self) -> &mut [f64] {
        match self {
            Self::Meshed(meshed) => &mut meshed.bound.damping,
            Self::Rigid(sphere) => &mut sphere.bound.damping,
        }
    }

    /// Returns whether its stiffness changes as it deforms.
    pub fn changes_stiffness(&self) -> bool {
        match self {
            Self::Meshed(meshed) => meshed.stress.strain_measure().finite().is_some(),
            Self::Rigid(_) => false,
        }
    }

    /// Returns the body's mass, kg; `None` for a half-space.
    pub fn mass(&self) -> Option<f64> {
        match self {
            Self::Meshed(meshed) if meshed.mesh.is_half_space() => None,
            Self::Meshed(_) | Self::Rigid(_) => Some(self.bound().mass.iter().sum()),
        }
    }

    /// Returns the longest critical time step (s) within a budget of moved mass, kg. A rigid sphere has no light nodes,
    /// so no mass is moved.
    pub fn scaled_time_step(&self, budget: f64) -> f64 {
        match self {
            Self::Meshed(meshed) => meshed.bound.scaled_time_step(budget),
            Self::Rigid(sphere) => sphere.bound.critical_time_step(),
        }
    }
}

impl UnscaledMesh {
    /// Integrates the elements, once for stress, masses and bound. Some nodes may have no mass.
    ///
    /// # Errors
    /// Too many relaxation terms for finite strain; no corner of an element has mass.
    pub fn new(
        mesh: SphereMesh,
        material: Material,
        finite_strain: Option<FiniteStrainChoice>,
        node_forces: Vec<Box<dyn NodeForce>>,
        massless: &[u32],
    ) -> Result<Self, ModelError> {
        let elements = 0..mesh.quads().len();
        let geometries: Vec<_> =
            elements.map(|element| QuadGeometry::new(&mesh.corners(element))).collect();
        let stress = stress::stress_of_body(&mesh, &geometries, &material, finite_strain)?;
        let (boundary, density) = (BoundaryMass::new(&mesh, massless)?, material.density());
        let mut bound =
            NodalBound::of_elements(&mesh, &geometries, density, stress.as_ref(), &boundary);
        for force in &node_forces {
            force.add_stiffness_bound(&mut bound.stiffness);
            force.add_damping_bound(&mut bound.damping);
        }
        bound.leave_out(boundary.nodes());
        Ok(Self { mesh, material, stress, node_forces, bound })
    }
}

impl RigidSphere {
    /// Takes a mass, kg.
    fn new(mass: f64, node_forces: Vec<Box<dyn NodeForce>>) -> Result<Self, ModelError> {
        // Its inverse has to be finite too.
        if !(mass > 0.0 && mass.is_normal()) {
            let (name, allowed) = ("mass of a rigid sphere", "positive and finite, in kg");
            return Err(ModelError::Setting { name, value: mass, allowed });
        }
        let mut bound = NodalBound { mass: vec![mass], stiffness: vec![0.0], damping: vec![0.0] };
        for force in &node_forces {
            force.add_stiffness_bound(&mut bound.stiffness);
            force.add_damping_bound(&mut bound.damping);
        }
        Ok(Self { node_forces, bound })
    }
}
