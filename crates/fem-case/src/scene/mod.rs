//! A validated case in SI units: two bodies that are about to meet, and what the case says on
//! how to compute it. `None` is left to the plan.

pub(crate) mod body;
pub(crate) mod gravity;
pub(crate) mod model;
pub(crate) mod plausibility;

use fem_laws::{FiniteSize, LawError, Pair, SlipSurface, SurfaceSlip, compliance_shares};

use crate::scene::body::{Body, Shape};
use crate::scene::gravity::{Gravity, impact_speed};
use crate::scene::model::ModelChoice;
use crate::schema::{ContactMethod, EffectsTable, Field, SnapshotLabel};

/// A validated case. Only this crate makes one, so every value keeps the limits stated here.
#[derive(Clone, Debug, PartialEq)]
pub struct Scene {
    pub(crate) title: String,
    pub(crate) bodies: [Body; 2],
    pub(crate) gap: Option<f64>,
    pub(crate) gravity: Option<Gravity>,
    pub(crate) mesh: MeshSettings,
    pub(crate) contact_method: Option<ContactMethod>,
    pub(crate) penalty_factor: Option<f64>,
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
}

impl Scene {
    /// Title of the case.
    pub fn title(&self) -> &str {
        &self.title
    }

    /// The lower body, then the upper one. They approach each other, or the upper one falls on the
    /// lower one; at least one is a sphere.
    pub fn bodies(&self) -> &[Body; 2] {
        &self.bodies
    }

    /// Distance of the surfaces on the axis at time 0, m, ≥ 0.
    pub fn gap(&self) -> Option<f64> {
        self.gap
    }

    /// The weight of the upper body, a sphere above a body that does not move; `None` without.
    pub fn gravity(&self) -> Option<Gravity> {
        self.gravity
    }

    /// How finely the bodies are divided.
    pub fn mesh(&self) -> MeshSettings {
        self.mesh
    }

    /// How springs keep the surfaces apart.
    pub fn contact_method(&self) -> Option<ContactMethod> {
        self.contact_method
    }

    /// Times the default normal stiffness per area, > 0.
    pub fn penalty_factor(&self) -> Option<f64> {
        self.penalty_factor
    }

    /// Times the critical time step, in (0, 1].
    pub fn step_factor(&self) -> Option<f64> {
        self.step_factor
    }

    /// Largest mass that is moved as a fraction of the lighter body's mass, in [0, 0.1], if both
    /// bodies are equally compliant.
    pub fn mass_scaling(&self) -> Option<f64> {
        self.mass_scaling
    }

    /// Which instants are drawn.
    pub fn snapshots(&self) -> Option<&Snapshots> {
        self.snapshots.as_ref()
    }

    /// Whether files of snapshots have an array.
    pub fn wants_field(&self, field: Field) -> bool {
        self.fields.as_ref().is_none_or(|fields| fields.contains(&field))
    }

    /// Probes: places whose fields are recorded over time.
    pub fn probes(&self) -> &[Probe] {
        &self.probes
    }

    /// Whether a run writes its page.
    pub fn wants_report(&self) -> bool {
        self.wants_report
    }

    /// Which model computes the collision.
    pub fn model(&self) -> &ModelChoice {
        &self.model
    }

    /// Tolerances of the results.
    pub fn accuracy(&self) -> Accuracy {
        self.accuracy
    }

    /// Effects that the case forces on or off.
    pub fn effects(&self) -> &EffectsTable {
        &self.effects
    }

    /// Limits of the cost of a run.
    pub fn limits(&self) -> Limits {
        self.limits
    }

    /// Relative to each other at first touch, m/s, > 0: with gravity √(v² + 2 g h) of a sphere with the
    /// velocity v at the height h at time 0.
    pub fn approach_speed(&self) -> f64 {
        match self.gravity {
            None => self.bodies[0].velocity - self.bodies[1].velocity,
            Some(Gravity { acceleration, .. }) => {
                let height = self.gap.unwrap_or_default();
                impact_speed(self.bodies[1].velocity, acceleration, height)
            }
        }
    }

    /// Time of first touch, s: of a fall, or of a flight at constant speed.
    pub fn first_touch(&self) -> f64 {
        let gap = self.gap.unwrap_or_default();
        match self.gravity {
            None => gap / self.approach_speed(),
            Some(Gravity { acceleration, .. }) => {
                (self.bodies[1].velocity + self.approach_speed()) / acceleration
            }
        }
    }

    /// The same scene with gravity, whose bodies touch at time 0 at this speed, m/s: `None` of a scene
    /// without gravity, and of a speed that is not positive and finite.
    pub fn touching_at(&self, speed: f64) -> Option<Self> {
        let mut scene = self.clone();
        scene.gravity?;
        scene.gap = Some(0.0);
        scene.bodies[1].velocity = -speed;
        (speed > 0.0 && speed.is_finite()).then_some(scene)
    }

    /// The same scene once all has relaxed, its elements left to the plan; `None` of bodies that flow.
    pub fn at_equilibrium(&self) -> Option<Self> {
        let mut scene = self.clone();
        for body in &mut scene.bodies {
            if let Shape::Sphere { material, .. } | Shape::HalfSpace { material } = &mut body.shape
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

    /// Whether the bodies are spheres of one size and stuff, on meshes that are made here, without
    /// gravity.
    pub fn has_identical_bodies(&self) -> bool {
        let [lower, upper] = &self.bodies;
        if self.gravity.is_some() {
            return false;
        }
        let is_made_here = matches!(lower.shape, Shape::Sphere { mesh: None, .. });
        is_made_here && lower.shape == upper.shape
    }

    /// This scene with other bodies in the places of its own, which move as they do.
    pub fn with_shapes(mut self, shapes: [Shape; 2]) -> Self {
        for (body, shape) in self.bodies.iter_mut().zip(shapes) {
            body.shape = shape;
        }
        self
    }

    /// This scene with a half-space of the same material in the place of a sphere, 0 the lower one; a
    /// rigid body stays as it is.
    pub fn with_half_space(&self, side: usize) -> Self {
        let mut scene = self.clone();
        if let Some(body) = scene.bodies.get_mut(side)
            && let Some(material) = body.material().cloned()
        {
            body.shape = Shape::HalfSpace { material };
        }
        scene
    }

    /// This scene, computed by another model.
    pub fn with_model(mut self, model: ModelChoice) -> Self {
        self.model = model;
        self
    }

    /// Elements across a length that the plan chooses, over those that it takes at first: more than one
    /// where a result has shown that these do not do. No key of a case: a resolved case has the length.
    pub fn refinement(&self) -> f64 {
        self.refinement
    }

    /// Returns this scene with a factor on the number of elements across a length.
    pub fn with_refinement(mut self, refinement: f64) -> Self {
        self.refinement = refinement;
        self
    }

    /// This scene with other effects forced on or off.
    pub fn with_effects(mut self, effects: EffectsTable) -> Self {
        self.effects = effects;
        self
    }

    /// Half of a scene whose bodies are identical, in the frame of their mass centre: the lower body
    /// against a rigid plane at rest, which the upper one mirrors. `None` of bodies that differ or have
    /// a mesh of their own.
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

    /// The bodies as a pair, moduli instantaneous.
    ///
    /// # Errors
    /// Numbers so extreme that they leave the range of f64.
    pub fn pair(&self) -> Result<Pair, LawError> {
        let [first, second] = self.bodies.each_ref().map(Body::partner);
        Pair::new(first, second)
    }

    /// The spheres' own compliance.
    ///
    /// # Errors
    /// Two walls; moduli without one.
    pub fn finite_size(&self) -> Result<FiniteSize, LawError> {
        let [first, second] = self.bodies.each_ref().map(|body| match &body.shape {
            Shape::Sphere { diameter, material, .. } => Some((0.5 * diameter, material)),
            Shape::HalfSpace { .. } | Shape::Rigid { .. } | Shape::Wall => None,
        });
        FiniteSize::new(first, second)
    }

    /// Shares of the contact's compliance, with instantaneous moduli, lower body first.
    pub fn compliance_shares(&self) -> [f64; 2] {
        compliance_shares(
            self.bodies.each_ref().map(|body| body.partner().plane_strain_modulus().recip()),
        )
    }

    /// Slip of the bodies' surfaces on each other.
    pub fn surface_slip(&self) -> SurfaceSlip {
        SurfaceSlip::new(self.bodies.each_ref().map(|body| {
            let curvature = body.diameter().map_or(0.0, |diameter| 2.0 / diameter);
            SlipSurface::new(curvature, body.material())
        }))
    }
}

/// What `[mesh]` asks for; lengths in m.
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
    /// Whether the nodes of one body lie between those of the other at the edge of the contact.
    pub staggered: Option<bool>,
}

/// A place of the undeformed body, whose contact pole is at the origin.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Probe {
    /// 0 lower, 1 upper.
    pub body: usize,
    /// From the axis, m.
    pub r: f64,
    /// Along the axis, m.
    pub y: f64,
}

/// The instants at which fields are written.
#[derive(Clone, Debug, PartialEq)]
pub enum Snapshots {
    /// Those with a name, each at most once; none if empty.
    Labels(Vec<SnapshotLabel>),
    /// A number of snapshots, ≥ 1, evenly over the contact.
    Count(usize),
    /// s, ≥ 0, ascending.
    Times(Vec<f64>),
}

/// `[accuracy]`: how far results may be off. All > 0.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Accuracy {
    /// Tolerance of the restitution, absolute.
    pub restitution: f64,
    /// Tolerance of the contact time, relative.
    pub contact_time: f64,
    /// Of the peak force, relative.
    pub peak_force: f64,
    /// Of the peak pressure, relative.
    pub peak_pressure: f64,
}

impl Accuracy {
    /// What a case that says nothing asks for.
    pub const DEFAULT_TOLERANCE: f64 = 0.01;

    /// One share for all, and three times that for the peak pressure.
    pub fn within(tolerance: f64) -> Self {
        Self {
            restitution: tolerance,
            contact_time: tolerance,
            peak_force: tolerance,
            peak_pressure: 3.0 * tolerance,
        }
    }
}

/// `[limits]`: what the case says in place of this program's own limits. All ≥ 1.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Limits {
    /// Elements of both bodies together.
    pub elements: Option<u64>,
    /// Elements times steps.
    pub element_updates: Option<u64>,
    /// Memory of the run, bytes.
    pub memory: Option<u64>,
}
