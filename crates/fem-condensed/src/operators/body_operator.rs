//! One body of a pair, seen at the contact points.

use std::collections::BTreeMap;
use std::sync::{Arc, Mutex, PoisonError};

use faer::Mat;
use fem_contact::{ContactPoint, Reading};
use fem_material::Material;
use fem_mesh::SphereMesh;

use crate::condensation::condensed_body::CondensedBody;
use crate::error::CondensedError;
use crate::operators::points::{NodeInterpolation, gather};
use crate::operators::shear::ShearSprings;
use crate::operators::vibration::Vibrations;
use crate::settings::PairSettings;

/// A body and how the contact points hang on its contact nodes.
#[derive(Debug)]
pub(crate) struct BodyOperator {
    pub body: CondensedBody,
    feet: NodeInterpolation,
    /// Compliance at the points, m/N.
    pub compliance: Mat<f64>,
    /// Φ of constant Poisson's ratio at the points, m/√J.
    pub uniform: Mat<f64>,
    /// Springs of a relaxing shear by the number of blocks of their basis.
    shear: Mutex<BTreeMap<usize, Arc<ShearOperator>>>,
    pub vibrations: Option<VibrationOperator>,
}

/// Springs of a relaxing shear, seen at the points.
#[derive(Debug)]
pub(crate) struct ShearOperator {
    pub springs: ShearSprings,
    pub at_points: Mat<f64>,
}

/// Modes of vibration, seen at the points.
#[derive(Debug)]
pub(crate) struct VibrationOperator {
    pub modes: Vibrations,
    /// Inward displacement over frequency, m/√J.
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
        feet: NodeInterpolation,
        settings: &PairSettings,
    ) -> Result<Self, CondensedError> {
        let outermost = feet.iter().flatten().map(|(node, _)| *node).max().unwrap_or(0);
        let nodes = &nodes[..=outermost];
        let body = CondensedBody::new(mesh.clone(), material, nodes, settings.keeps_factors)?;
        let compliance = gather(&feet, &gather(&feet, &body.compliance).transpose().to_owned());
        let uniform = gather(&feet, &body.compliance_factor);
        // Waves in a half-space do not come back: it has no modes.
        let n_vibrations = if mesh.is_half_space() { 0 } else { settings.vibration_modes };
        let vibrations = (n_vibrations > 0)
            .then(|| {
                let modes = Vibrations::new(&body, material.shear_wave_speed(), n_vibrations)?;
                let at_points = gather(&feet, &modes.contact);
                Ok::<_, CondensedError>(VibrationOperator { modes, at_points })
            })
            .transpose()?;
        Ok(Self { body, feet, compliance, uniform, shear: Mutex::default(), vibrations })
    }

    /// Springs for a relaxing shear modulus, made when first asked for.
    ///
    /// # Errors
    /// A stiffness that is not positive definite to rounding.
    pub fn shear(&self, n_blocks: usize) -> Result<Arc<ShearOperator>, CondensedError> {
        // A thread that panicked left the map whole.
        let mut made = self.shear.lock().unwrap_or_else(PoisonError::into_inner);
        if let Some(side) = made.get(&n_blocks) {
            return Ok(side.clone());
        }
        let springs = ShearSprings::new(&self.body, n_blocks)?;
        let at_points = gather(&self.feet, &springs.contact);
        let side = Arc::new(ShearOperator { springs, at_points });
        made.insert(n_blocks, side.clone());
        Ok(side)
    }

    /// Radii of the contact nodes, from the axis outward, m.
    fn contact_radii(&self) -> Vec<f64> {
        let mesh = &self.body.mesh;
        let nodes = mesh.surface()[..self.body.numbering.n_contact].iter();
        nodes.map(|&node| mesh.nodes()[node as usize][0]).collect()
    }

    /// Forces (N) at the contact nodes of forces at the points.
    pub fn nodal_forces(&self, forces: &[f64]) -> Vec<f64> {
        let mut nodal = vec![0.0; self.body.numbering.n_contact];
        for (feet, force) in self.feet.iter().zip(forces) {
            for &(node, share) in feet {
                nodal[node] += share * force;
            }
        }
        nodal
    }
}

/// A surface node and the points whose forces it carries.
#[derive(Debug, Clone)]
pub(crate) struct PressureNode {
    pub radius: f64,
    pub area: f64,
    /// Point and share of its force.
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
    /// Beside the side that pressures are read at.
    pub fn beside(
        carrier: &BodyOperator,
        sides: &[Option<BodyOperator>; 2],
        points: &[ContactPoint],
    ) -> Option<Self> {
        let [Some(lower), Some(upper)] = sides else { return None };
        let other = if std::ptr::eq(carrier, lower) { upper } else { lower };
        let lengths = [carrier, other].map(|side| side.contact_radii().get(1).copied());
        match Reading::of(lengths, 0) {
            Reading::Single(_) => None,
            Reading::Staggered(lengths) => {
                Some(Self { nodes: pressure_nodes(points, Some(other)), lengths })
            }
        }
    }
}

/// The side that deforms and has the fewer contact nodes.
pub(crate) fn coarser(sides: &[Option<BodyOperator>; 2]) -> Option<&BodyOperator> {
    sides.iter().flatten().min_by_key(|side| side.body.numbering.n_contact)
}

/// Nodes of the points' own surface, or those of a deformable side that carry the Gauss points.
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
    for (k, (point, feet)) in points.iter().zip(&side.feet).enumerate() {
        for &(node, share) in feet {
            nodes[node].area += share * point.area;
            nodes[node].shares.push((k, share));
        }
    }
    nodes
}
