//! A validated case in SI units: two bodies that are about to collide, and the settings of the computation. The plan
//! decides on settings that are `None`.

pub(crate) mod body;
pub mod defaults;
pub(crate) mod model;
pub(crate) mod plausibility;

use serde::{Deserialize, Serialize};

use fem_laws::{FiniteSize, LawError, Pair, SlipSurface, SurfaceSlip, compliance_shares};
use fem_material::Material;

use crate::scene::body::{Body, Shape};
use crate::scene::model::ModelChoice;
use crate::schema::{ContactMethod, EffectsTable, Field, SnapshotLabel, Spot};

/// A validated case. Only this crate creates one, so every value is within the limits stated here.
#[derive(Clone, Debug, PartialEq)]
pub struct Scene {
    pub(crate) title: String,
    pub(crate) bodies: [Body; 2],
    pub(crate) temperature: Option<f64>,
    pub(crate) gap: Option<f64>,
    pub(crate) gravity: Option<Gravity>,
    pub(crate) mesh: MeshSettings,
    pub(crate) contact_method: Option<ContactMethod>,
    pub(crate) penalty_factor: Option<f64>,
    pub(crate) work_of_adhesion: Option<f64>,
    pub(crate) friction: f64,
    pub(crate) step_factor: Option<f64>,
    pub(crate) mass_scaling: Option<f64>,
    pub(crate) snapshots: Option<Snapshots>,
    pub(crate) probes: Vec<Probe>,
    pub(crate) fields: Option<Vec<Field>>,
    pub(crate) wants_report: bool,
    pub(crate) model: ModelChoice,
    pub(crate) accuracy: Accuracy,
    pub(crate) effects: EffectsTable,
    pub(crate) limits: Limits,
    pub(crate) refinement: f64,
    pub(crate) inputs: Vec<UncertainInput>,
}

impl Scene {
    /// Returns the title of the case.
    pub fn title(&self) -> &str {
        &self.title
    }

    /// Returns the lower body, then the upper one. They approach each other, or the upper one falls on the lower one; at
    /// least one is a sphere.
    pub fn bodies(&self) -> &[Body; 2] {
        &self.bodies
    }

    /// Returns the temperature of the bodies, K, if the case gives it.
    pub fn temperature(&self) -> Option<f64> {
        self.temperature
    }

    /// Returns the distance of the surfaces on the axis at time 0, m, ≥ 0.
    pub fn gap(&self) -> Option<f64> {
        self.gap
    }

    /// Returns the gravity on the upper body, a sphere above a body that does not move.
    pub fn gravity(&self) -> Option<Gravity> {
        self.gravity
    }

    /// Returns the settings of the mesh.
    pub fn mesh(&self) -> MeshSettings {
        self.mesh
    }

    /// Returns the contact method.
    pub fn contact_method(&self) -> Option<ContactMethod> {
        self.contact_method
    }

    /// Returns the factor on the default normal penalty stiffness per area, > 0.
    pub fn penalty_factor(&self) -> Option<f64> {
        self.penalty_factor
    }

    /// Returns the work of adhesion of the pair: that of the case, or 2√(γ₁γ₂) of the surface energies of both materials,
    /// twice that of like ones. A wall takes the surface energy of the other body.
    pub fn work_of_adhesion(&self) -> WorkOfAdhesion {
        let energies = [0, 1].map(|k| {
            let (own, other) = (&self.bodies[k], &self.bodies[1 - k]);
            own.surface_energy.or(other.surface_energy.filter(|_| own.shape == Shape::Wall))
        });
        let of_pair = match energies {
            [Some(lower), Some(upper)] => Some(2.0 * (lower * upper).sqrt()),
            _ => None,
        };
        let typical = WorkOfAdhesion::Typical(2.0 * defaults::TYPICAL_SURFACE_ENERGY);
        self.work_of_adhesion.or(of_pair).map_or(typical, WorkOfAdhesion::Given)
    }

    /// Returns Coulomb's coefficient of friction, ≥ 0.
    pub fn friction(&self) -> f64 {
        self.friction
    }

    /// Returns whether a body moves across the axis or spins.
    pub fn is_oblique(&self) -> bool {
        self.bodies.iter().any(|body| body.tangential_velocity != 0.0 || body.spin != 0.0)
    }

    /// Returns the factor on the critical time step, in (0, 1].
    pub fn step_factor(&self) -> Option<f64> {
        self.step_factor
    }

    /// Returns the limit of mass scaling, in [0, 0.1]: in equally compliant bodies the largest moved mass over the lighter
    /// body's mass.
    pub fn mass_scaling(&self) -> Option<f64> {
        self.mass_scaling
    }

    /// Returns the instants of snapshots.
    pub fn snapshots(&self) -> Option<&Snapshots> {
        self.snapshots.as_ref()
    }

    /// Returns whether the files of snapshots have this array.
    pub fn wants_field(&self, field: Field) -> bool {
        self.fields.as_ref().is_none_or(|fields| fields.contains(&field))
    }

    /// Returns the probes: points whose fields are recorded over time.
    pub fn probes(&self) -> &[Probe] {
        &self.probes
    }

    /// Returns whether a run writes its page.
    pub fn wants_report(&self) -> bool {
        self.wants_report
    }

    /// Returns the model of the collision.
    pub fn model(&self) -> &ModelChoice {
        &self.model
    }

    /// Returns the tolerances of the results.
    pub fn accuracy(&self) -> Accuracy {
        self.accuracy
    }

    /// Returns the effects that the case forces on or off.
    pub fn effects(&self) -> &EffectsTable {
        &self.effects
    }

    /// Returns the limits of the cost of a run.
    pub fn limits(&self) -> Limits {
        self.limits
    }

    /// Returns the relative speed at first contact, m/s, > 0. With gravity it is √(v² + 2 g h) for a sphere with the
    /// velocity v at the height h at time 0.
    pub fn approach_speed(&self) -> f64 {
        match self.gravity {
            None => self.bodies[0].velocity - self.bodies[1].velocity,
            Some(Gravity { acceleration, .. }) => {
                let height = self.gap.unwrap_or(defaults::GAP);
                impact_speed(self.bodies[1].velocity, acceleration, height)
            }
        }
    }

    /// Returns the time of first contact, s, after a fall or a motion at constant speed.
    pub fn first_touch(&self) -> f64 {
        let gap = self.gap.unwrap_or(defaults::GAP);
        match self.gravity {
            None => gap / self.approach_speed(),
            Some(Gravity { acceleration, .. }) => {
                (self.bodies[1].velocity + self.approach_speed()) / acceleration
            }
        }
    }

    /// Returns this scene with the bodies in contact at time 0 at this speed, m/s; `None` for a speed that is not positive and finite.
    pub fn touching_at(&self, speed: f64) -> Option<Self> {
        let mut scene = self.clone();
        scene.gap = Some(0.0);
        scene.bodies[1].velocity = match self.gravity {
            Some(_) => -speed,
            None => scene.bodies[0].velocity - speed,
        };
        (speed > 0.0 && speed.is_finite()).then_some(scene)
    }

    /// Returns this scene with a coefficient of friction and the tangential velocity (m/s) of its ball: the upper body, if that is a sphere.
    #[must_use]
    pub fn rubbing(mut self, friction: f64, velocity: f64) -> Self {
        let ball = self.ball();
        self.friction = friction;
        self.bodies[ball].tangential_velocity = velocity;
        self.bodies[1 - ball].tangential_velocity = 0.0;
        self
    }

    /// Returns the index of the body whose rebound is measured: the upper one, if that is a sphere, or else the lower one.
    pub fn ball(&self) -> usize {
        usize::from(self.bodies[1].diameter().is_some())
    }

    /// Returns the scene with the equilibrium moduli, without element sizes; `None` if a body has no equilibrium modulus.
    pub fn at_equilibrium(&self) -> Option<Self> {
        let mut scene = self.clone();
        for body in &mut scene.bodies {
            if let Shape::Sphere { material, .. }
            | Shape::HalfSpace { material }
            | Shape::Plate { material, .. } = &mut body.shape
            {
                *material = material.at_equilibrium()?;
            }
        }
        scene.mesh.contact_element_size = None;
        scene.mesh.refined_radius = None;
        scene.mesh.far_radius = None;
        scene.mesh.staggered = None;
        Some(scene)
    }

    /// Returns whether the bodies are spheres of the same size and material with built-in meshes, without gravity.
    pub fn has_identical_bodies(&self) -> bool {
        let [lower, upper] = &self.bodies;
        if self.gravity.is_some() {
            return false;
        }
        let is_made_here = matches!(lower.shape, Shape::Sphere { mesh: None, .. });
        is_made_here && lower.shape == upper.shape
    }

    /// Returns this scene with other shapes, whose velocities are unchanged.
    pub fn with_shapes(mut self, shapes: [Shape; 2]) -> Self {
        for (body, shape) in self.bodies.iter_mut().zip(shapes) {
            body.shape = shape;
        }
        self
    }

    /// Returns this scene with a half-space of the same material instead of a sphere or plate (0 is the lower body). A rigid body is
    /// unchanged.
    pub fn with_half_space(&self, side: usize) -> Self {
        let mut scene = self.clone();
        if let Some(body) = scene.bodies.get_mut(side)
            && let Some(material) = body.material().cloned()
        {
            body.shape = Shape::HalfSpace { material };
        }
        scene
    }

    /// Returns this scene with other materials of its bodies; a body without one here is unchanged.
    #[must_use]
    pub fn with_materials(self, materials: [Option<Material>; 2]) -> Self {
        let mut shapes = self.bodies.each_ref().map(|body| body.shape.clone());
        for ((shape, body), material) in shapes.iter_mut().zip(&self.bodies).zip(materials) {
            if let Some(material) = material {
                *shape = body.shape_of(material);
            }
        }
        self.with_shapes(shapes)
    }

    /// Returns whether the material of a body has a flow rule.
    pub fn flows(&self) -> bool {
        self.bodies.iter().filter_map(Body::material).any(|material| material.flow().is_some())
    }

    /// Returns this scene, computed by another model.
    pub fn with_model(mut self, model: ModelChoice) -> Self {
        self.model = model;
        self
    }

    /// Returns the inputs that the case gives with an uncertainty.
    pub fn uncertain_inputs(&self) -> &[UncertainInput] {
        &self.inputs
    }

    /// Returns the uncertainty of the work of adhesion, J/m²; 0 if the case gives none.
    pub fn adhesion_uncertainty(&self) -> f64 {
        let relative = |key: &str, value: Option<f64>| {
            let is_it =
                |input: &&UncertainInput| input.key.ends_with(key) && Some(input.value) == value;
            let found = self.inputs.iter().find(is_it);
            found.map_or(0.0, |input| input.uncertainty / input.value)
        };
        if let Some(work) = self.work_of_adhesion.filter(|work| *work > 0.0) {
            return work * relative("work_of_adhesion", Some(work));
        }
        let energies = self.bodies.each_ref().map(|body| body.surface_energy);
        let [lower, upper] = energies.map(|energy| relative("surface_energy", energy));
        // W = 2√(γ₁γ₂), where one material of both bodies is one input, and a wall has the energy of the other body.
        let is_one = energies[0] == energies[1] || energies.contains(&None);
        let of_work = if is_one { lower.max(upper) } else { 0.5 * lower.hypot(upper) };
        self.work_of_adhesion().value() * of_work
    }

    /// Returns the factor on the number of elements per length that the plan chooses. It is above one after a result missed
    /// its tolerance. It is not a key of a case: a resolved case has the element size.
    pub fn refinement(&self) -> f64 {
        self.refinement
    }

    /// Returns this scene with a factor on the number of elements per length.
    pub fn with_refinement(mut self, refinement: f64) -> Self {
        self.refinement = refinement;
        self
    }

    /// Returns this scene with other effects forced on or off.
    pub fn with_effects(mut self, effects: EffectsTable) -> Self {
        self.effects = effects;
        self
    }

    /// Returns the mirror-symmetric half of a scene of identical bodies, in the frame of their mass centre: the lower body
    /// against a rigid plane at rest. `None` if the bodies differ or have mesh files.
    pub fn half(&self) -> Option<Self> {
        if !self.has_identical_bodies() {
            return None;
        }
        let mut half = self.clone();
        half.bodies[0].velocity = 0.5 * self.approach_speed();
        half.bodies[1].velocity = 0.0;
        half.bodies[1].shape = Shape::Wall;
        half.gap = self.gap.map(|gap| 0.5 * gap);
        half.effects.mirror_symmetry = None;
        Some(half)
    }

    /// Returns the bodies as a pair with instantaneous moduli.
    ///
    /// # Errors
    /// A number leaves the range of f64.
    pub fn pair(&self) -> Result<Pair, LawError> {
        let [first, second] = self.bodies.each_ref().map(Body::partner);
        Pair::new(first, second)
    }

    /// Returns the compliance of the spheres' finite size.
    ///
    /// # Errors
    /// Both bodies are walls, or the moduli have no finite compliance.
    pub fn finite_size(&self) -> Result<FiniteSize, LawError> {
        let [first, second] = self.spheres();
        FiniteSize::new(first, second)
    }

    /// Returns the compliance of the spheres' finite size across the axis.
    ///
    /// # Errors
    /// Those of [`Scene::finite_size`].
    pub fn tangential_size(&self) -> Result<FiniteSize, LawError> {
        FiniteSize::tangential(self.spheres())
    }

    /// Returns radius (m) and material of the deformable spheres.
    fn spheres(&self) -> [Option<(f64, &Material)>; 2] {
        self.bodies.each_ref().map(|body| match &body.shape {
            Shape::Sphere { diameter, material, .. } => Some((0.5 * diameter, material)),
            _ => None,
        })
    }

    /// Returns each body's share of the contact compliance with instantaneous moduli, lower body first.
    pub fn compliance_shares(&self) -> [f64; 2] {
        compliance_shares(
            self.bodies.each_ref().map(|body| body.partner().plane_strain_modulus().recip()),
        )
    }

    /// Returns the slip of the bodies' surfaces on each other.
    pub fn surface_slip(&self) -> SurfaceSlip {
        SurfaceSlip::new(self.bodies.each_ref().map(|body| {
            let curvature = body.diameter().map_or(0.0, |diameter| 2.0 / diameter);
            SlipSurface::new(curvature, body.material())
        }))
    }
}

/// A number of a case with its uncertainty, SI.
#[derive(Clone, Debug, PartialEq)]
pub struct UncertainInput {
    /// Dotted key of the number.
    pub key: String,
    /// Value of the number.
    pub value: f64,
    /// Its uncertainty, ≥ 0.
    pub uncertainty: f64,
}

/// The work of adhesion of a pair, J/m².
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum WorkOfAdhesion {
    /// The work that the case gives, ≥ 0.
    Given(f64),
    /// A typical value, for a case that gives none.
    Typical(f64),
}

impl WorkOfAdhesion {
    /// Returns the work, J/m².
    pub fn value(self) -> f64 {
        let (Self::Given(work) | Self::Typical(work)) = self;
        work
    }
}

/// The gravity on the upper body of a scene.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Gravity {
    /// Acceleration along −y, m/s², > 0.
    pub acceleration: f64,
    /// Number of contacts after which the run ends, ≥ 1; rest ends it earlier.
    pub bounces: usize,
    /// Where a ball that dents falls next.
    pub spot: Option<Spot>,
}

/// Returns the impact speed √(v² + 2 g h), m/s, of a body with the velocity v (m/s) at the height h (m).
pub fn impact_speed(velocity: f64, acceleration: f64, height: f64) -> f64 {
    if height == 0.0 {
        return velocity.abs();
    }
    velocity.hypot((2.0 * acceleration).sqrt() * height.sqrt())
}

/// The settings of `[mesh]`; lengths in m.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct MeshSettings {
    /// Edge length of the elements at the contact, m, > 0.
    pub contact_element_size: Option<f64>,
    /// Half-width of the uniformly fine block around the contact, m, > 0.
    pub refined_radius: Option<f64>,
    /// Ratio of the sizes of neighbouring elements outside of that block, > 1.
    pub growth: Option<f64>,
    /// Distance of the far boundary of a half-space, m, > 0.
    pub far_radius: Option<f64>,
    /// Whether the meshes are offset, so that at the edge of the contact the nodes of one body lie between those of the
    /// other.
    pub staggered: Option<bool>,
}

/// A point of the undeformed body, whose contact pole is at the origin.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Probe {
    /// The body: 0 is the lower one, 1 the upper one.
    pub body: usize,
    /// Distance from the axis, m.
    pub r: f64,
    /// Coordinate along the axis, m.
    pub y: f64,
}

/// The instants at which fields are written.
#[derive(Clone, Debug, PartialEq)]
pub enum Snapshots {
    /// Named instants, each at most once; an empty list requests none.
    Labels(Vec<SnapshotLabel>),
    /// A number of snapshots, ≥ 1, evenly over the contact.
    Count(usize),
    /// Times, s, ≥ 0, in ascending order.
    Times(Vec<f64>),
}

impl Snapshots {
    /// Returns whether no snapshot is requested.
    pub fn is_empty(&self) -> bool {
        match self {
            Self::Labels(labels) => labels.is_empty(),
            Self::Count(n) => *n == 0,
            Self::Times(times) => times.is_empty(),
        }
    }
}

/// `[accuracy]`: the tolerances of the results, all > 0.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Accuracy {
    /// Tolerance of the restitution, absolute.
    pub restitution: f64,
    /// Tolerance of the contact time, relative.
    pub contact_time: f64,
    /// Tolerance of the peak force, relative.
    pub peak_force: f64,
    /// Tolerance of the peak pressure, relative.
    pub peak_pressure: f64,
}

impl Accuracy {
    /// Returns one tolerance for all results, and three times that for the peak pressure.
    pub fn within(tolerance: f64) -> Self {
        Self {
            restitution: tolerance,
            contact_time: tolerance,
            peak_force: tolerance,
            peak_pressure: 3.0 * tolerance,
        }
    }
}

/// `[limits]`: the limits that replace those of the program, all ≥ 1.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Limits {
    /// Number of elements of both bodies.
    pub elements: Option<u64>,
    /// Number of elements times number of steps.
    pub element_updates: Option<u64>,
    /// Memory of the run, bytes.
    pub memory: Option<u64>,
}
