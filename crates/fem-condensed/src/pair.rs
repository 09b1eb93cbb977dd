//! Two bodies condensed to their contact, ready for any number of collisions.

use faer::Mat;
use fem_collision::{Approach, ApproachError, BodyInput, BodyResult, CandidateRegion, Frame, Stop};
use fem_contact::{ContactError, ContactPoint, Surface};
use fem_material::{ActsOn, PronySeries};

use crate::contact::elastic_impact::{ElasticCurve, ElasticImpact};
use crate::error::CondensedError;
use crate::operators::body_operator::{
    BodyOperator, PressureNode, Staggered, coarser, pressure_nodes,
};
use crate::operators::points::ContactPoints;
use crate::settings::{ContactModel, PairSettings};

/// A shear modulus that falls below this share within the elastic contact time is strongly relaxed. With two blocks
/// the error of the restitution of glass is 2e-5 at 0.4 and 8e-4 at 0.06, and a residual stiffness separates bodies
/// that should stay together.
const STRONG_RELAXATION: f64 = 0.4;
/// The same limit for bodies with a Poisson's ratio below [`SOFT_BULK`]. With two blocks the error is 3e-4 at 0.3 for
/// a ratio of 0.02 and 2e-3 for −0.5; at 0.06 it is 6e-3 and 3e-2.
const STRONG_OF_SOFT_BULK: f64 = 0.7;
const SOFT_BULK: f64 = 0.2;
/// Sufficient number of blocks for strong relaxation; the error is at most 6e-5 in these cases.
const STRONG_BLOCKS: usize = 4;

/// Two bodies condensed to their contact.
///
/// A pair has all that does not depend on speed or relaxation. Collisions only read it, from any number of threads.
#[derive(Debug)]
pub struct CondensedPair {
    inputs: [BodyInput; 2],
    settings: PairSettings,
    /// Operators of the bodies; `None` for a rigid body.
    pub(crate) sides: [Option<BodyOperator>; 2],
    /// Masses, kg; `None` for a wall.
    masses: [Option<f64>; 2],
    pub(crate) points: Vec<ContactPoint>,
    /// Side whose nodes the points are; `None` for Gauss points.
    pub(crate) nodal_side: Option<usize>,
    /// Nodes at which the pressure is recovered.
    pub(crate) nodes: Vec<PressureNode>,
    /// Nodes of the other surface, where the meshes are staggered.
    pub(crate) staggered: Option<Staggered>,
    /// Compliance of the penalty springs at the points, m/N.
    pub(crate) spring_compliance: Vec<f64>,
    /// Compliance between all points without relaxation, m/N.
    pub(crate) compliance: Mat<f64>,
    pub(crate) curve: ElasticCurve,
    pub(crate) reduced_mass: f64,
}

impl CondensedPair {
    /// Factors and condenses both bodies; the first lies below the second.
    ///
    /// # Errors
    /// Two rigid bodies or planes, settings or a rigid sphere's mass out of range, a stiffness without
    /// Cholesky factor, missing memory.
    pub fn new(inputs: [BodyInput; 2], settings: PairSettings) -> Result<Self, CondensedError> {
        if settings.shear_blocks == 0 {
            let (name, allowed) = ("number of shear blocks", "at least 1");
            return Err(CondensedError::Setting { name, value: 0.0, allowed });
        }
        let [lower, upper] = &inputs;
        let surfaces = [surface(lower)?, surface(upper)?];
        let ContactPoints { points, nodal_side, projections } =
            ContactPoints::new(&surfaces, &settings)?;
        let (mut sides, mut masses) = ([None, None], [None, None]);
        for (side, (input, projections)) in inputs.iter().zip(projections).enumerate() {
            match input {
                BodyInput::Sphere { mesh, material } | BodyInput::HalfSpace { mesh, material } => {
                    let nodes = surfaces[side].nodes_within(f64::INFINITY);
                    let side_made =
                        BodyOperator::new(mesh, material, nodes, projections, &settings)?;
                    masses[side] = (!mesh.is_half_space()).then_some(side_made.body.mass);
                    sides[side] = Some(side_made);
                }
                BodyInput::Rigid { mass, .. } => masses[side] = Some(check_mass(*mass)?),
                BodyInput::Wall => {}
            }
        }
        let spring_compliance: Vec<f64> =
            points.iter().map(|point| (point.stiffness * point.area).recip()).collect();
        let of_slip = settings.slip.as_ref().map(|slip| {
            let of_side = |side: usize| {
                inputs[side].material().map_or(0.0, |m| slip.compliance(side, m.instantaneous()))
            };
            of_side(0) + of_side(1)
        });
        let compliance = total_compliance(&sides, &spring_compliance, of_slip);
        let carrier = if nodal_side.is_some() { None } else { coarser(&sides) };
        let nodes = pressure_nodes(&points, carrier);
        let staggered = carrier.and_then(|carrier| Staggered::beside(carrier, &sides, &points));
        let gaps: Vec<f64> = points.iter().map(|point| point.initial_gap).collect();
        let curve = match settings.contact {
            ContactModel::Exact => ElasticCurve::new(&compliance, &gaps),
            ContactModel::Springs(_) => {
                ElasticCurve::of_springs(&compliance, &spring_compliance, &gaps)
            }
        };
        let curve = curve.ok_or(CondensedError::NotPositiveDefinite)?;
        let moving = masses.iter().zip(settings.held).filter(|(_, held)| !held);
        let inverse_mass: f64 = moving.filter_map(|(mass, _)| Some(mass.as_ref()?.recip())).sum();
        Ok(Self {
            inputs,
            settings,
            sides,
            masses,
            points,
            nodal_side,
            nodes,
            staggered,
            spring_compliance,
            compliance,
            curve,
            reduced_mass: inverse_mass.recip(),
        })
    }

    /// Condenses this pair again out to a larger radius, m.
    ///
    /// # Errors
    /// Those of [`CondensedPair::new`]; a radius beyond the hemisphere of the smaller body.
    pub fn enlarge(&self, candidate_radius: f64) -> Result<Self, CondensedError> {
        let enlarged =
            Self::new(self.inputs.clone(), PairSettings { candidate_radius, ..self.settings })?;
        if enlarged.candidate_radius() > self.candidate_radius() {
            Ok(enlarged)
        } else {
            let ratio = self.candidate_radius() / self.smallest_radius();
            Err(Stop::ContactTooLarge { ratio }.into())
        }
    }

    /// Returns the radius of the outermost point that can touch, m.
    pub fn candidate_radius(&self) -> f64 {
        self.points.last().map_or(0.0, |point| point.radius)
    }

    /// Returns the candidate region, in which contact is searched for.
    pub fn candidate_region(&self) -> CandidateRegion {
        CandidateRegion {
            radius: self.candidate_radius(),
            n_points: self.n_points(),
            at_nodes: self.nodal_side.is_some(),
        }
    }

    /// Returns the radius of the smaller sphere, m.
    pub fn smallest_radius(&self) -> f64 {
        let radii = self.inputs.iter().filter_map(|input| match input {
            BodyInput::Sphere { mesh, .. } => Some(mesh.radius()),
            BodyInput::Rigid { radius, .. } => Some(*radius),
            BodyInput::HalfSpace { .. } | BodyInput::Wall => None,
        });
        radii.fold(f64::INFINITY, f64::min)
    }

    /// Returns the reduced mass m₁m₂/(m₁+m₂), kg; held bodies have infinite mass.
    pub fn reduced_mass(&self) -> f64 {
        self.reduced_mass
    }

    /// Returns the masses, kg; infinite for a wall, a half-space and a held body.
    pub fn masses(&self) -> [f64; 2] {
        self.moving_masses().map(|mass| mass.unwrap_or(f64::INFINITY))
    }

    /// Returns the masses of the bodies that move, kg.
    fn moving_masses(&self) -> [Option<f64>; 2] {
        [0, 1].map(|side: usize| self.masses[side].filter(|_| !self.settings.held[side]))
    }

    /// Returns the frame of a collision in which the lower body strikes the upper one at rest, at a speed in m/s.
    ///
    /// # Errors
    /// A speed that is not positive and finite.
    pub fn frame(&self, speed: f64) -> Result<Frame, ApproachError> {
        let (masses, reduced_mass) = (self.moving_masses(), self.reduced_mass);
        Ok(Frame { approach: Approach::at(speed)?, masses, reduced_mass, gravity: 0.0 })
    }

    /// Returns the properties of the bodies before the collision.
    pub fn bodies_before(&self, frame: &Frame) -> [BodyResult; 2] {
        [0, 1].map(|side: usize| {
            let mesh = self.inputs[side].mesh();
            BodyResult {
                elements: Some(mesh.map_or(0, |mesh| mesh.quads().len())),
                nodes: Some(mesh.map_or(0, |mesh| mesh.nodes().len())),
                mass: frame.masses[side],
                moved_mass: frame.masses[side].map(|_| 0.0),
                ..BodyResult::default()
            }
        })
    }

    /// Returns the lumped masses of a body's nodes, kg; none for a rigid body.
    pub fn nodal_masses(&self, side: usize) -> &[f64] {
        self.sides[side].as_ref().map_or(&[], |side| &side.body.nodal_mass)
    }

    /// Returns the bodies, lower first.
    pub fn inputs(&self) -> &[BodyInput; 2] {
        &self.inputs
    }

    /// Returns the settings of the condensation.
    pub fn settings(&self) -> &PairSettings {
        &self.settings
    }

    /// Returns ω² of each body's modes of vibration in rising order, 1/s²; none for a rigid body or without modes.
    pub fn frequencies(&self) -> [&[f64]; 2] {
        self.sides.each_ref().map(|side| {
            let vibrations = side.as_ref().and_then(|side| side.vibrations.as_ref());
            vibrations.map_or(&[][..], |v| &v.modes.squared_frequency)
        })
    }

    /// Returns the number of points that can touch.
    pub fn n_points(&self) -> usize {
        self.points.len()
    }

    /// Returns how many of the first `n_points` points may be closed without a contact beyond them. Springs at Gauss
    /// points close in any pattern within an element, so that the longer element of the two bodies has to stay open.
    /// For nodes one point is sufficient.
    pub(crate) fn most_closed(&self, n_points: usize) -> usize {
        let Some(last) = n_points.checked_sub(1) else { return 0 };
        if self.nodal_side.is_some() {
            return last;
        }
        let open = self.points[last].radius - self.longest_element(last);
        self.points[..last].partition_point(|point| point.radius < open)
    }

    /// Returns the length along r of the longer element of the two bodies at a point, m.
    pub(crate) fn longest_element(&self, point: usize) -> f64 {
        let lengths = self.inputs.iter().zip(&self.points[point].projections).filter_map(
            |(input, projection)| {
                let nodes = input.mesh()?.nodes();
                let [inner, outer] = projection.nodes.map(|node| nodes[node as usize][0]);
                Some(outer - inner)
            },
        );
        lengths.fold(0.0, f64::max)
    }

    /// Returns the number of equations of both bodies.
    pub fn n_equations(&self) -> usize {
        self.sides.iter().flatten().map(|side| side.body.numbering.n_equations).sum()
    }

    /// Returns the size of both factors in bytes.
    pub fn factor_bytes(&self) -> usize {
        self.sides.iter().flatten().map(|side| side.body.bytes()).sum()
    }

    /// Returns the relaxations of the bodies' own materials.
    pub fn relaxations(&self) -> [Option<&PronySeries>; 2] {
        self.inputs.each_ref().map(|input| input.material()?.relaxation())
    }

    /// Computes in advance what the first collision at this speed (m/s) with these relaxations needs: the
    /// modes of a relaxing shear modulus with an elastic bulk modulus.
    ///
    /// # Errors
    /// Those of [`CondensedPair::elastic_impact`]; a stiffness that is not positive definite to rounding.
    pub fn prepare(
        &self,
        speed: f64,
        relaxations: [Option<&PronySeries>; 2],
    ) -> Result<(), CondensedError> {
        for (side, series) in self.sides.iter().zip(relaxations) {
            let relaxes_in_shear =
                series.is_some_and(|s| s.relaxes() && s.acts_on() == ActsOn::Shear);
            if let Some(side) = side.as_ref().filter(|_| relaxes_in_shear) {
                side.shear(self.shear_blocks(series, speed)?)?;
            }
        }
        Ok(())
    }

    /// Returns the number of blocks that the basis for a relaxation at a speed (m/s) needs.
    pub(crate) fn shear_blocks(
        &self,
        series: Option<&PronySeries>,
        speed: f64,
    ) -> Result<usize, CondensedError> {
        let usual = self.settings.shear_blocks;
        let Some(series) = series.filter(|series| series.relaxes()) else { return Ok(usual) };
        let left = series.relaxation(self.elastic_impact(speed)?.contact_time);
        let materials = self.inputs.iter().filter_map(BodyInput::material);
        let ratios = materials.map(|material| material.instantaneous().poissons_ratio());
        let is_soft = ratios.fold(f64::INFINITY, f64::min) < SOFT_BULK;
        let strong = if is_soft { STRONG_OF_SOFT_BULK } else { STRONG_RELAXATION };
        Ok(if left < strong { usual.max(STRONG_BLOCKS) } else { usual })
    }

    /// Computes the elastic quasi-static collision at a relative speed, m/s, exactly in time.
    ///
    /// # Errors
    /// A contact that reaches the end of the condensed region.
    pub fn elastic_impact(&self, speed: f64) -> Result<ElasticImpact, CondensedError> {
        self.curve
            .impact(self.reduced_mass, speed)
            .ok_or(CondensedError::ContactBeyondCandidates { radius: self.candidate_radius() })
    }
}

/// Returns the contact surface of a body.
pub(crate) fn surface(input: &BodyInput) -> Result<Surface, ContactError> {
    match input {
        BodyInput::Sphere { mesh, .. } | BodyInput::HalfSpace { mesh, .. } => {
            Ok(Surface::of_sphere(mesh))
        }
        BodyInput::Rigid { radius, .. } => Surface::rigid_sphere(*radius),
        BodyInput::Wall => Ok(Surface::wall()),
    }
}

/// Checks that the mass of a rigid sphere (kg) is positive and finite, and returns it.
fn check_mass(mass: f64) -> Result<f64, CondensedError> {
    if mass > 0.0 && mass.is_normal() {
        return Ok(mass);
    }
    let (name, allowed) = ("mass of a rigid sphere", "positive and finite, in kg");
    Err(CondensedError::Setting { name, value: mass, allowed })
}

/// Returns the compliance of both bodies, of the springs between the points, and of slip, which is the same for all of them, m/N.
fn total_compliance(
    sides: &[Option<BodyOperator>; 2],
    springs: &[f64],
    of_slip: Option<f64>,
) -> Mat<f64> {
    let n = springs.len();
    let mut compliance = Mat::<f64>::zeros(n, n);
    for side in sides.iter().flatten() {
        compliance += &side.compliance;
    }
    for (k, spring) in springs.iter().enumerate() {
        compliance[(k, k)] += spring;
    }
    match of_slip {
        Some(added) => Mat::from_fn(n, n, |i, j| compliance[(i, j)] + added),
        None => compliance,
    }
}
