//! The operators of one body at the contact points.

use std::collections::BTreeMap;
use std::sync::{Arc, Mutex, PoisonError};

use faer::Mat;
use fem_contact::{ContactPoint, RecoverySurfaces};
use fem_material::Material;
use fem_mesh::SphereMesh;

use crate::condensation::condensed_body::CondensedBody;
use crate::error::CondensedError;
use crate::operators::points::{NodeInterpolation, gather};
use crate::operators::shear::ShearSprings;
use crate::operators::vibration::Vibrations;
use crate::settings::PairSettings;

/// A condensed body with its operators at the contact points.
#[derive(Debug)]
pub(crate) struct BodyOperator {
    pub body: CondensedBody,
    projections: NodeInterpolation,
    /// Compliance at the points, m/N.
    pub compliance: Mat<f64>,
    /// Modes Φ for constant Poisson's ratio at the points, m/√J.
    pub uniform: Mat<f64>,
    /// Modes of a relaxing shear modulus by the number of blocks of their basis.
    shear: Mutex<BTreeMap<usize, Arc<ShearOperator>>>,
    pub vibrations: Option<VibrationOperator>,
}

/// Modes of a relaxing shear modulus at the points.
#[derive(Debug)]
pub(crate) struct ShearOperator {
    pub springs: ShearSprings,
    pub at_points: Mat<f64>,
}

/// Modes of vibration at the points.
#[derive(Debug)]
pub(crate) struct VibrationOperator {
    pub modes: Vibrations,
    /// Inward displacement over angular frequency, m/√J.
    pub at_points: Mat<f64>,
}

impl BodyOperator {
    /// Condenses a body to the nodes that carry the points; `nodes` are those of its surface from the
    /// axis outward.
    ///
    /// # Errors
    /// A stiffness without factor, missing memory.
    pub fn new(
        mesh: &SphereMesh,
        material: &Material,
        nodes: &[u32],
        projections: NodeInterpolation,
        settings: &PairSettings,
    ) -> Result<Self, CondensedError> {
        let outermost = projections.iter().flatten().map(|(node, _)| *node).max().unwrap_or(0);
        let nodes = &nodes[..=outermost];
        let body = CondensedBody::new(mesh.clone(), material, nodes, settings.keeps_factors)?;
        let compliance =
            gather(&projections, &gather(&projections, &body.compliance).transpose().to_owned());
        let uniform = gather(&projections, &body.compliance_factor);
        // Waves in a half-space do not return: it has no modes.
        let n_vibrations = if mesh.is_half_space() { 0 } else { settings.vibration_modes };
        let vibrations = (n_vibrations > 0)
            .then(|| {
                let modes = Vibrations::new(&body, material.shear_wave_speed(), n_vibrations)?;
                let at_points = gather(&projections, &modes.contact);
                Ok::<_, CondensedError>(VibrationOperator { modes, at_points })
            })
            .transpose()?;
        Ok(Self { body, projections, compliance, uniform, shear: Mutex::default(), vibrations })
    }

    /// Returns the modes for a relaxing shear modulus, computed at the first request.
    ///
    /// # Errors
    /// A stiffness that is not positive definite to rounding.
    pub fn shear(&self, n_blocks: usize) -> Result<Arc<ShearOperator>, CondensedError> {
        // A panic in another thread cannot leave the map inconsistent.
        let mut made = self.shear.lock().unwrap_or_else(PoisonError::into_inner);
        if let Some(side) = made.get(&n_blocks) {
            return Ok(side.clone());
        }
        let springs = ShearSprings::new(&self.body, n_blocks)?;
        let at_points = gather(&self.projections, &springs.contact);
        let side = Arc::new(ShearOperator { springs, at_points });
        made.insert(n_blocks, side.clone());
        Ok(side)
    }

    /// Returns the radii of the contact nodes, from the axis outward, m.
    fn contact_radii(&self) -> Vec<f64> {
        let mesh = &self.body.mesh;
        let nodes = mesh.surface()[..self.body.numbering.n_contact].iter();
        nodes.map(|&node| mesh.nodes()[node as usize][0]).collect()
    }

    /// Distributes forces (N) at the points to the contact nodes.
    pub fn nodal_forces(&self, forces: &[f64]) -> Vec<f64> {
        let mut nodal = vec![0.0; self.body.numbering.n_contact];
        for (projections, force) in self.projections.iter().zip(forces) {
            for &(node, share) in projections {
                nodal[node] += share * force;
            }
        }
        nodal
    }
}

/// A surface node with the points whose forces act on it.
#[derive(Debug, Clone)]
pub(crate) struct PressureNode {
    pub radius: f64,
    pub area: f64,
    /// Points and the shares of their forces.
    pub shares: Vec<(usize, f64)>,
}

/// For staggered meshes, the surface with the smaller elements.
#[derive(Debug, Clone)]
pub(crate) struct Staggered {
    pub nodes: Vec<PressureNode>,
    /// Lengths of the segments of both surfaces, m.
    pub lengths: [f64; 2],
}

impl Staggered {
    /// Returns the other surface, if its mesh is staggered against that of the side with the pressure nodes.
    pub fn beside(
        carrier: &BodyOperator,
        sides: &[Option<BodyOperator>; 2],
        points: &[ContactPoint],
    ) -> Option<Self> {
        let [Some(lower), Some(upper)] = sides else { return None };
        let other = if std::ptr::eq(carrier, lower) { upper } else { lower };
        let lengths = [carrier, other].map(|side| side.contact_radii().get(1).copied());
        match RecoverySurfaces::of(lengths, 0) {
            RecoverySurfaces::Single(_) => None,
            RecoverySurfaces::Staggered(lengths) => {
                Some(Self { nodes: pressure_nodes(points, Some(other)), lengths })
            }
        }
    }
}

/// Returns the deformable side with fewer contact nodes.
pub(crate) fn coarser(sides: &[Option<BodyOperator>; 2]) -> Option<&BodyOperator> {
    sides.iter().flatten().min_by_key(|side| side.body.numbering.n_contact)
}

/// Returns the nodes at which pressure is recovered: those of the points' surface, or of a deformable side with Gauss
/// points.
pub(crate) fn pressure_nodes(
    points: &[ContactPoint],
    side: Option<&BodyOperator>,
) -> Vec<PressureNode> {
    let Some(side) = side else {
        let own = points.iter().enumerate();
        return own
            .map(|(k, p)| PressureNode { radius: p.radius, area: p.area, shares: vec![(k, 1.0)] })
            .collect();
    };
    let radii = side.contact_radii();
    let mut nodes: Vec<_> = radii
        .into_iter()
        .map(|radius| PressureNode { radius, area: 0.0, shares: Vec::new() })
        .collect();
    for (k, (point, projections)) in points.iter().zip(&side.projections).enumerate() {
        for &(node, share) in projections {
            nodes[node].area += share * point.area;
            nodes[node].shares.push((k, share));
        }
    }
    nodes
}
