//! Two bodies condensed to their contact, ready for any number of collisions.

use std::sync::OnceLock;

use faer::Mat;
use fem_contact::{ContactInterface, ContactPoint, NodalContact, Surface};
use fem_material::{ActsOn, Material, PronySeries};
use fem_mesh::SphereMesh;

use crate::CondensedError;
use crate::body::CondensedBody;
use crate::curve::{ElasticCurve, ElasticImpact};
use crate::fields::active;
use crate::shear::ShearSprings;
use crate::vibration::Vibrations;

/// What a body is.
#[derive(Debug, Clone, PartialEq)]
pub enum BodyInput {
    /// A meshed sphere.
    Sphere {
        /// Its mesh, on its side of the plane y = 0.
        mesh: SphereMesh,
        /// Its material; a relaxation in it is what [`CondensedPair::relaxations`] gives.
        material: Material,
    },
    /// A rigid plane of infinite mass.
    Wall,
}

/// How the surfaces resist overlap.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum ContactModel {
    /// They do not overlap at the nodes.
    Exact,
    /// Penalty springs at Gauss points, those of the explicit model: stiffness per area times
    /// element size, Pa.
    Springs(f64),
}

/// What a pair is condensed with.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PairSettings {
    /// Radius out to which the surfaces are condensed, m; [`CondensedPair::enlarge`] makes more.
    pub candidate_radius: f64,
    /// How overlap is prevented.
    pub contact: ContactModel,
    /// Blocks of the basis for a relaxing shear beside an elastic bulk modulus; 2 is the default.
    pub shear_blocks: usize,
    /// Modes of free vibration of each body; 0 is quasi-static.
    pub vibration_modes: usize,
}

impl PairSettings {
    /// Exact contact, two blocks, no vibration.
    pub fn new(candidate_radius: f64) -> Self {
        Self { candidate_radius, contact: ContactModel::Exact, shear_blocks: 2, vibration_modes: 0 }
    }
}

/// For each contact point the contact nodes that carry it, numbered outward, and their shares.
type Feet = Vec<Vec<(usize, f64)>>;

/// A body and how the contact points hang on its contact nodes.
#[derive(Debug)]
pub(crate) struct PairSide {
    pub body: CondensedBody,
    feet: Feet,
    /// Compliance at the points, m/N.
    pub compliance: Mat<f64>,
    /// Φ of constant Poisson's ratio at the points, m/√J.
    pub uniform: Mat<f64>,
    shear: OnceLock<Result<ShearSide, CondensedError>>,
    pub vibrations: Option<VibratingSide>,
}

/// Springs of a relaxing shear, seen at the points.
#[derive(Debug)]
pub(crate) struct ShearSide {
    pub springs: ShearSprings,
    pub at_points: Mat<f64>,
}

/// Modes of vibration, seen at the points.
#[derive(Debug)]
pub(crate) struct VibratingSide {
    pub modes: Vibrations,
    /// Inward displacement over frequency, m/√J.
    pub at_points: Mat<f64>,
}

impl PairSide {
    /// Rows of contact nodes gathered into rows of contact points.
    fn at_points(&self, nodal: &Mat<f64>) -> Mat<f64> {
        gather(&self.feet, nodal)
    }

    /// Springs for a relaxing shear modulus, made when first asked for.
    pub fn shear(&self, n_blocks: usize) -> Result<&ShearSide, CondensedError> {
        let made = self.shear.get_or_init(|| {
            let springs = ShearSprings::new(&self.body, n_blocks)?;
            let at_points = self.at_points(&springs.contact);
            Ok(ShearSide { springs, at_points })
        });
        made.as_ref().map_err(Clone::clone)
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

/// Nodes of the points' own surface, or those of a deformable side that carry the Gauss points.
fn pressure_nodes(points: &[ContactPoint], side: Option<&PairSide>) -> Vec<PressureNode> {
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

fn gather(feet: &Feet, nodal: &Mat<f64>) -> Mat<f64> {
    Mat::from_fn(feet.len(), nodal.ncols(), |i, j| {
        feet[i].iter().map(|&(node, share)| share * nodal[(node, j)]).sum()
    })
}

/// Two bodies condensed to their contact.
///
/// Everything that does not depend on speed or relaxation; collisions only read it, from any
/// number of threads.
#[derive(Debug)]
pub struct CondensedPair {
    inputs: [BodyInput; 2],
    settings: PairSettings,
    pub(crate) sides: [Option<PairSide>; 2],
    pub(crate) points: Vec<ContactPoint>,
    /// The side whose nodes the points are; `None` for Gauss points.
    pub(crate) nodal_side: Option<usize>,
    /// Nodes at which the pressure is taken.
    pub(crate) nodes: Vec<PressureNode>,
    /// Compliance of the penalty springs at the points, m/N.
    pub(crate) spring_compliance: Vec<f64>,
    pub(crate) curve: ElasticCurve,
    pub(crate) reduced_mass: f64,
}

impl CondensedPair {
    /// Factors and condenses both bodies; the first lies below the second.
    ///
    /// # Errors
    /// Two walls, settings out of range, a stiffness without Cholesky factor, missing memory.
    pub fn new(inputs: [BodyInput; 2], settings: PairSettings) -> Result<Self, CondensedError> {
        if settings.shear_blocks == 0 {
            let (name, allowed) = ("number of shear blocks", "at least 1");
            return Err(CondensedError::Setting { name, value: 0.0, allowed });
        }
        let surfaces = inputs.each_ref().map(|input| match input {
            BodyInput::Sphere { mesh, .. } => Surface::of_sphere(mesh),
            BodyInput::Wall => Surface::wall(),
        });
        let Points { points, nodal_side, feet } = Points::new(&surfaces, &settings)?;
        let mut sides = [None, None];
        for (side, (input, feet)) in inputs.iter().zip(feet).enumerate() {
            if let BodyInput::Sphere { mesh, material } = input {
                let nodes = surfaces[side].nodes_within(f64::INFINITY);
                let side_made = condense(mesh, material, nodes, feet, settings.vibration_modes)?;
                sides[side] = Some(side_made);
            }
        }
        let spring_compliance: Vec<f64> =
            points.iter().map(|point| (point.stiffness * point.area).recip()).collect();
        let n = points.len();
        let mut compliance = Mat::<f64>::zeros(n, n);
        for side in sides.iter().flatten() {
            compliance += &side.compliance;
        }
        for (k, spring) in spring_compliance.iter().enumerate() {
            compliance[(k, k)] += spring;
        }
        let carrier = if nodal_side.is_some() { None } else { sides.iter().flatten().next() };
        let nodes = pressure_nodes(&points, carrier);
        let gaps: Vec<f64> = points.iter().map(|point| point.initial_gap).collect();
        let curve =
            ElasticCurve::new(&compliance, &gaps).ok_or(CondensedError::NotPositiveDefinite)?;
        let inverse_mass: f64 = sides.iter().flatten().map(|side| side.body.mass.recip()).sum();
        Ok(Self {
            inputs,
            settings,
            sides,
            points,
            nodal_side,
            nodes,
            spring_compliance,
            curve,
            reduced_mass: inverse_mass.recip(),
        })
    }

    /// The same pair condensed out to a larger radius, m.
    ///
    /// # Errors
    /// As [`CondensedPair::new`]; a radius that the smaller body's near hemisphere does not have.
    pub fn enlarge(&self, candidate_radius: f64) -> Result<Self, CondensedError> {
        let enlarged =
            Self::new(self.inputs.clone(), PairSettings { candidate_radius, ..self.settings })?;
        if enlarged.candidate_radius() > self.candidate_radius() {
            Ok(enlarged)
        } else {
            let ratio = self.candidate_radius() / self.smallest_radius();
            Err(CondensedError::ContactTooLarge { ratio })
        }
    }

    /// Radius of the outermost point that can touch, m.
    pub fn candidate_radius(&self) -> f64 {
        self.points.last().map_or(0.0, |point| point.radius)
    }

    /// Radius of the smaller sphere, m.
    pub fn smallest_radius(&self) -> f64 {
        let radii = self.sides.iter().flatten().map(|side| side.body.mesh.radius());
        radii.fold(f64::INFINITY, f64::min)
    }

    /// m₁m₂/(m₁+m₂), kg.
    pub fn reduced_mass(&self) -> f64 {
        self.reduced_mass
    }

    /// Masses, kg; infinite for a wall.
    pub fn masses(&self) -> [f64; 2] {
        self.sides.each_ref().map(|side| side.as_ref().map_or(f64::INFINITY, |s| s.body.mass))
    }

    /// Lumped masses of a body's nodes, kg; none for a wall.
    pub fn nodal_masses(&self, side: usize) -> &[f64] {
        self.sides[side].as_ref().map_or(&[], |side| &side.body.nodal_mass)
    }

    /// The bodies, lower first.
    pub fn inputs(&self) -> &[BodyInput; 2] {
        &self.inputs
    }

    /// What the pair was condensed with.
    pub fn settings(&self) -> &PairSettings {
        &self.settings
    }

    /// ω² of each body's modes of vibration, rising, 1/s²; none for a wall or without modes.
    pub fn frequencies(&self) -> [&[f64]; 2] {
        self.sides.each_ref().map(|side| {
            let vibrations = side.as_ref().and_then(|side| side.vibrations.as_ref());
            vibrations.map_or(&[][..], |v| &v.modes.squared_frequency)
        })
    }

    /// Number of points that can touch.
    pub fn n_points(&self) -> usize {
        self.points.len()
    }

    /// Equations of both bodies.
    pub fn n_equations(&self) -> usize {
        self.sides.iter().flatten().map(|side| side.body.numbering.n_equations).sum()
    }

    /// Bytes of both factors.
    pub fn factor_bytes(&self) -> usize {
        self.sides.iter().flatten().map(|side| side.body.bytes()).sum()
    }

    /// The relaxations of the bodies' own materials.
    pub fn relaxations(&self) -> [Option<&PronySeries>; 2] {
        self.inputs.each_ref().map(|input| match input {
            BodyInput::Sphere { material, .. } => material.relaxation(),
            BodyInput::Wall => None,
        })
    }

    /// Makes what the first collision with these relaxations would make: the springs of a shear
    /// modulus that relaxes beside an elastic bulk modulus.
    ///
    /// # Errors
    /// A stiffness that is not positive definite to rounding.
    pub fn prepare(&self, relaxations: [Option<&PronySeries>; 2]) -> Result<(), CondensedError> {
        for (side, series) in self.sides.iter().zip(relaxations) {
            let relaxes_in_shear = active(series).is_some_and(|s| s.acts_on() == ActsOn::Shear);
            if let Some(side) = side.as_ref().filter(|_| relaxes_in_shear) {
                side.shear(self.settings.shear_blocks)?;
            }
        }
        Ok(())
    }

    /// The elastic quasi-static collision at a relative speed, m/s, exact in time.
    ///
    /// # Errors
    /// A contact that reaches the end of the condensed region.
    pub fn elastic_impact(&self, speed: f64) -> Result<ElasticImpact, CondensedError> {
        self.curve
            .impact(self.reduced_mass, speed)
            .ok_or(CondensedError::ContactBeyondCandidates { radius: self.candidate_radius() })
    }
}

/// Where the bodies can touch.
struct Points {
    points: Vec<ContactPoint>,
    /// The side whose nodes the points are; `None` for Gauss points.
    nodal_side: Option<usize>,
    feet: [Feet; 2],
}

impl Points {
    fn new(surfaces: &[Surface; 2], settings: &PairSettings) -> Result<Self, CondensedError> {
        let [lower, upper] = surfaces;
        match settings.contact {
            ContactModel::Exact => {
                let contact = NodalContact::new([lower, upper], 0.0, settings.candidate_radius)?;
                let NodalContact { points, side, shares } = contact;
                let own: Feet = (0..points.len()).map(|k| vec![(k, 1.0)]).collect();
                let feet = if side == 0 { [own, shares] } else { [shares, own] };
                Ok(Self { points, nodal_side: Some(side), feet })
            }
            ContactModel::Springs(stiffness) => {
                let interface = ContactInterface::new(
                    lower.clone(),
                    upper.clone(),
                    stiffness,
                    0.0,
                    settings.candidate_radius,
                )?;
                let points = interface.points().to_vec();
                let feet = [0, 1].map(|side: usize| spring_feet(&points, side, &surfaces[side]));
                Ok(Self { points, nodal_side: None, feet })
            }
        }
    }
}

/// A Gauss point lies between two nodes of each surface.
fn spring_feet(points: &[ContactPoint], side: usize, surface: &Surface) -> Feet {
    let along = surface.nodes_within(f64::INFINITY);
    let place = |node: u32| along.iter().position(|&other| other == node).unwrap_or(0);
    let feet = points.iter().map(|point| {
        let foot = &point.feet[side];
        foot.nodes.into_iter().map(place).zip(foot.shape).collect()
    });
    feet.collect()
}

/// Condenses a body with the nodes of its surface from the axis outward.
fn condense(
    mesh: &SphereMesh,
    material: &Material,
    nodes: &[u32],
    feet: Feet,
    n_vibrations: usize,
) -> Result<PairSide, CondensedError> {
    let outermost = feet.iter().flatten().map(|(node, _)| *node).max().unwrap_or(0);
    let body = CondensedBody::new(mesh.clone(), material, &nodes[..=outermost])?;
    let compliance = gather(&feet, &gather(&feet, &body.compliance).transpose().to_owned());
    let uniform = gather(&feet, &body.compliance_factor);
    let vibrations = (n_vibrations > 0)
        .then(|| {
            let modes = Vibrations::new(&body, n_vibrations)?;
            let at_points = gather(&feet, &modes.contact);
            Ok::<_, CondensedError>(VibratingSide { modes, at_points })
        })
        .transpose()?;
    Ok(PairSide { body, feet, compliance, uniform, shear: OnceLock::new(), vibrations })
}
