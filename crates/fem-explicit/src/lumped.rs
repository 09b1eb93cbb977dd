//! A body before its time step is known.

use fem_collision::BodyInput;
use fem_element::QuadGeometry;
use fem_material::Material;
use fem_material::finite::HyperelasticLaw;
use fem_mesh::SphereMesh;

use crate::boundary_mass::BoundaryMass;
use crate::error::ModelError;
use crate::forces::NodeForce;
use crate::stress::{self, MOST_FINITE_STRAIN_TERMS, Stress};
use crate::time_step::NodalBound;

/// A body that contact and forces move, with its masses and a bound of the stiffness that pulls at
/// them: what the time step is chosen from.
#[derive(Debug)]
pub(crate) enum LumpedBody {
    Meshed(Box<LumpedMesh>),
    Rigid(RigidSphere),
}

/// A sphere or a half-space with its parts.
#[derive(Debug)]
pub(crate) struct LumpedMesh {
    pub mesh: SphereMesh,
    pub material: Material,
    pub stress: Box<dyn Stress>,
    pub node_forces: Vec<Box<dyn NodeForce>>,
    /// Without contact.
    pub bound: NodalBound,
}

/// The law of a body at finite strain.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct FiniteStrainOf {
    pub law: HyperelasticLaw,
    /// Distance from first touch of the elements that follow it, m; all without.
    pub within: Option<f64>,
}

/// A rigid sphere: one node that carries its mass.
#[derive(Debug)]
pub(crate) struct RigidSphere {
    pub node_forces: Vec<Box<dyn NodeForce>>,
    /// Without contact.
    pub bound: NodalBound,
}

impl LumpedBody {
    /// `None` for a wall, which nothing moves; some nodes of a mesh may have no mass.
    ///
    /// # Errors
    /// A rigid sphere's mass that is not positive and finite; forces on a wall; an element without mass;
    /// finite strain of a body that does not deform, or that relaxes by too many terms.
    pub fn new(
        input: BodyInput,
        finite_strain: Option<FiniteStrainOf>,
        node_forces: Vec<Box<dyn NodeForce>>,
        massless: &[u32],
    ) -> Result<Option<Self>, ModelError> {
        if input.mesh().is_none() && finite_strain.is_some() {
            return Err(ModelError::StrainOfRigid);
        }
        match input {
            BodyInput::Sphere { mesh, material } | BodyInput::HalfSpace { mesh, material } => {
                let meshed = LumpedMesh::new(mesh, material, finite_strain, node_forces, massless)?;
                Ok(Some(Self::Meshed(Box::new(meshed))))
            }
            BodyInput::Rigid { mass, .. } => {
                Ok(Some(Self::Rigid(RigidSphere::new(mass, node_forces)?)))
            }
            BodyInput::Wall if node_forces.is_empty() => Ok(None),
            BodyInput::Wall => Err(ModelError::ForceOnWall),
        }
    }

    fn bound(&self) -> &NodalBound {
        match self {
            Self::Meshed(meshed) => &meshed.bound,
            Self::Rigid(sphere) => &sphere.bound,
        }
    }

    /// The bound of its nodes' stiffness, N/m, to which contact adds its own.
    pub fn stiffness_mut(&mut self) -> &mut [f64] {
        match self {
            Self::Meshed(meshed) => &mut meshed.bound.stiffness,
            Self::Rigid(sphere) => &mut sphere.bound.stiffness,
        }
    }

    /// The bound of its nodes' damping, N s/m, to which contact adds its own.
    pub fn damping_mut(&mut self) -> &mut [f64] {
        match self {
            Self::Meshed(meshed) => &mut meshed.bound.damping,
            Self::Rigid(sphere) => &mut sphere.bound.damping,
        }
    }

    /// Whether its stiffness changes as it deforms.
    pub fn changes_stiffness(&self) -> bool {
        match self {
            Self::Meshed(meshed) => meshed.stress.changes_stiffness(),
            Self::Rigid(_) => false,
        }
    }

    /// Critical time step without mass scaling, s.
    pub fn critical_time_step(&self) -> f64 {
        self.bound().critical_time_step()
    }

    /// Its mass, kg; a half-space's has no end.
    pub fn mass(&self) -> Option<f64> {
        match self {
            Self::Meshed(meshed) if meshed.mesh.is_half_space() => None,
            Self::Meshed(_) | Self::Rigid(_) => Some(self.bound().mass.iter().sum()),
        }
    }

    /// Longest critical time step (s) within a budget of added mass, kg. No mass is added to a rigid
    /// sphere, which has no light nodes.
    pub fn scaled_time_step(&self, budget: f64) -> f64 {
        match self {
            Self::Meshed(meshed) => meshed.bound.scaled_time_step(budget),
            Self::Rigid(sphere) => sphere.bound.critical_time_step(),
        }
    }
}

impl LumpedMesh {
    /// Integrates the elements, once for stress, masses and bound. Its stress is that of small strain, or
    /// of a law beyond; some nodes may have no mass.
    ///
    /// # Errors
    /// Too many terms of relaxation for finite strain; an element whose corners all are among the nodes
    /// without mass.
    pub fn new(
        mesh: SphereMesh,
        material: Material,
        finite_strain: Option<FiniteStrainOf>,
        node_forces: Vec<Box<dyn NodeForce>>,
        massless: &[u32],
    ) -> Result<Self, ModelError> {
        let n_terms = material.relaxation().map_or(0, |series| series.terms().len());
        if finite_strain.is_some() && n_terms > MOST_FINITE_STRAIN_TERMS {
            return Err(ModelError::TooManyTerms { n_terms, most: MOST_FINITE_STRAIN_TERMS });
        }
        let elements = 0..mesh.quads().len();
        let geometries: Vec<_> =
            elements.map(|element| QuadGeometry::new(&mesh.corners(element))).collect();
        let stress = match finite_strain {
            None => stress::of_material(&mesh, &geometries, &material),
            Some(FiniteStrainOf { law, within: None }) => {
                stress::finite_strain(&mesh, &geometries, &material, law)
            }
            Some(FiniteStrainOf { law, within: Some(radius) }) => {
                stress::finite_strain_within(radius, &mesh, &geometries, &material, law)
            }
        };
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
    /// Of a mass, kg.
    ///
    /// # Errors
    /// A mass that is not positive and finite.
    fn new(mass: f64, node_forces: Vec<Box<dyn NodeForce>>) -> Result<Self, ModelError> {
        // What it is divided by has to be finite too.
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
