//! Bodies of models with meshes, and the radius that the mesh of a half-space needs.

use fem_material::Material;
use fem_mesh::SphereMesh;
use std::f64::consts::PI;

use crate::request::POST_CONTACT_FRACTION;

/// One of the two bodies.
#[derive(Clone, Debug, PartialEq)]
pub enum BodyInput {
    /// A meshed sphere.
    Sphere {
        /// Mesh on its side of the plane y = 0.
        mesh: SphereMesh,
        /// Material of the sphere.
        material: Material,
    },
    /// A rigid sphere: its only degree of freedom is the motion along y.
    Rigid {
        /// Radius of the sphere, m.
        radius: f64,
        /// Mass of the sphere, kg.
        mass: f64,
    },
    /// A half-space bounded by the plane y = 0. It has infinite mass, and its far boundary keeps
    /// its velocity as a wall does.
    HalfSpace {
        /// Mesh on its side of the plane, as [`QuarterDisc`](fem_mesh::QuarterDisc) creates it. The mesh identifies a
        /// half-space, even if it is given for a sphere.
        mesh: SphereMesh,
        /// Material of the half-space.
        material: Material,
    },
    /// A rigid plane of infinite mass that keeps its velocity.
    Wall,
}

impl BodyInput {
    /// Returns the mesh; a rigid body has none.
    pub fn mesh(&self) -> Option<&SphereMesh> {
        match self {
            Self::Sphere { mesh, .. } | Self::HalfSpace { mesh, .. } => Some(mesh),
            Self::Rigid { .. } | Self::Wall => None,
        }
    }

    /// Returns the material; a rigid body has none.
    pub fn material(&self) -> Option<&Material> {
        match self {
            Self::Sphere { material, .. } | Self::HalfSpace { material, .. } => Some(material),
            Self::Rigid { .. } | Self::Wall => None,
        }
    }

    /// Returns whether the body is a half-space.
    pub fn is_half_space(&self) -> bool {
        self.mesh().is_some_and(SphereMesh::is_half_space)
    }
}

/// Largest relative error of the compliance due to the fixed far boundary of a half-space in static
/// equilibrium.
const COMPLIANCE_LEFT_OUT: f64 = 1e-6;

/// Returns the far radius (m) of a half-space that waves do not reach within a run: during a
/// contact of this duration (s) and the flight after it, from anywhere in the candidate region of
/// this radius (m). Even if relaxation doubles the duration, no reflected wave returns to the
/// contact.
pub fn far_radius_of_waves(material: &Material, contact_time: f64, candidate_radius: f64) -> f64 {
    let time = (1.0 + POST_CONTACT_FRACTION) * contact_time;
    // Even for a contact of zero duration the mesh needs its rings.
    (candidate_radius + material.dilatational_wave_speed() * time).max(4.0 * candidate_radius)
}

/// Returns the far radius (m) of a half-space in static equilibrium for a contact of this radius
/// (m). The relative error of the compliance is 1e-6.
pub fn far_radius_at_rest(contact_radius: f64) -> f64 {
    8.0 / (3.0 * PI) * contact_radius / COMPLIANCE_LEFT_OUT
}

#[cfg(test)]
mod tests {
    use super::*;
    use fem_material::ElasticModuli;

    /// By hand: c_p = 2 at λ + 2μ = 4 and ρ = 1; 1.2 contact times of 10 take it 24 far.
    #[test]
    fn far_radius_exceeds_the_distance_of_pressure_waves() {
        let moduli = ElasticModuli::from_bulk_shear(8.0 / 3.0, 1.0).unwrap();
        let material = Material::new(1.0, moduli, None).unwrap();
        assert!((far_radius_of_waves(&material, 10.0, 0.5) - 24.5).abs() < 1e-12);
        assert_eq!(far_radius_of_waves(&material, 0.0, 0.5), 2.0);
    }
}
