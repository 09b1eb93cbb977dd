//! The paper's glass pair on a coarse mesh, five elements a contact radius.

#![allow(dead_code, reason = "each test file uses its share")]

use std::f64::consts::PI;
use std::sync::LazyLock;

use fem_collision::{
    Approach, BodyInput, Collision, Expectation, Monitor, OutputRequest, Progress, SnapshotRequest,
};
use fem_explicit::{
    Contact, DeformedContact, ExplicitBodies, ModelError, ModelParts, Run, RunState, Settings,
    SmallStrainContact, collide,
};
use fem_material::finite::HyperelasticLaw;
use fem_material::{ActsOn, ElasticModuli, FlowRule, Material, PronySeries, PronyTerm};
use fem_mesh::{HalfDisc, Side, SphereMesh};

/// Hertz' impact of a sphere on a plane.
pub struct Hertz {
    pub time: f64,
    pub approach: f64,
    pub force: f64,
    pub contact_radius: f64,
}

impl Hertz {
    /// Takes radius (m), reduced mass (kg), contact modulus (Pa) and speed (m/s).
    pub fn new(radius: f64, mass: f64, modulus: f64, speed: f64) -> Self {
        let stiffness = 4.0 / 3.0 * modulus * radius.sqrt();
        let approach = (1.25 * mass * speed * speed / stiffness).powf(0.4);
        Self {
            time: 2.943_275 * approach / speed,
            approach,
            force: stiffness * approach.powf(1.5),
            contact_radius: (radius * approach).sqrt(),
        }
    }

    pub fn expected(&self) -> Expectation {
        Expectation { contact_time: self.time, approach: self.approach }
    }
}

/// Returns the mass (kg) of a sphere of a radius (m) and a density (kg/m³).
pub fn sphere_mass(radius: f64, density: f64) -> f64 {
    4.0 / 3.0 * PI * radius.powi(3) * density
}

/// Hertz' contact time and approach at 0.5 m/s.
pub const HERTZ_TIME: f64 = 63.235e-6;
pub const HERTZ_APPROACH: f64 = 10.742e-6;
/// E/(1 − ν²)/2 of the glass.
pub const CONTACT_MODULUS: f64 = 33.494e9;

/// The definition of a pair; lengths, times and masses can be scaled.
#[derive(Clone)]
pub struct Pair {
    pub radii: [f64; 2],
    pub velocities: [f64; 2],
    pub gap: f64,
    pub element_size: f64,
    pub step_factor: f64,
    pub method: SmallStrainContact,
    /// Times the usual stiffness of the springs.
    pub penalty_factor: f64,
    pub relaxation: Option<ActsOn>,
    /// Prony terms of a relaxing pair: weight, relaxation time.
    pub terms: &'static [(f64, f64)],
    /// At finite strain.
    pub law: Option<HyperelasticLaw>,
    /// Yield strength of a perfectly plastic pair, Pa.
    pub yield_strength: Option<f64>,
    pub candidate_radius: f64,
    pub history_rows: usize,
    pub snapshots: SnapshotRequest,
    pub max_time: f64,
}

impl Default for Pair {
    fn default() -> Self {
        Self {
            radii: [11.1e-3, 7.95e-3],
            velocities: [0.5, 0.0],
            gap: 0.0,
            element_size: 45e-6,
            step_factor: 0.9,
            method: SmallStrainContact::Penalty,
            penalty_factor: 1.0,
            relaxation: None,
            terms: &[(1.0, 1.0 / 2708.0)],
            law: None,
            yield_strength: None,
            candidate_radius: 0.35e-3,
            history_rows: 1000,
            snapshots: SnapshotRequest::Times(Vec::new()),
            max_time: 200e-6,
        }
    }
}

/// The elastic collision of the coarse pair, with which several tests compare theirs.
pub static COARSE_RUN: LazyLock<Collision> = LazyLock::new(|| Pair::coarse().run());

impl Pair {
    /// About three elements per contact radius.
    pub fn coarse() -> Self {
        Self { element_size: 80e-6, candidate_radius: 0.4e-3, ..Self::default() }
    }

    /// About 1900 steps per contact and 270 elements.
    pub fn small() -> Self {
        Self { element_size: 110e-6, candidate_radius: 0.45e-3, ..Self::default() }
    }

    /// One whose contact outgrows the region in which it is looked for.
    pub fn outgrown() -> Self {
        Self { candidate_radius: 0.15e-3, ..Self::small() }
    }

    /// One that is ended before it parts.
    pub fn endless() -> Self {
        Self { max_time: 30e-6, ..Self::small() }
    }

    pub fn material(&self) -> Material {
        let moduli = ElasticModuli::from_youngs_modulus_poissons_ratio(63e9, 0.244).unwrap();
        let relaxation = self.relaxation.map(|acts_on| {
            let term = |&(weight, relaxation_time)| PronyTerm { weight, relaxation_time };
            PronySeries::new(self.terms.iter().map(term).collect(), acts_on).unwrap()
        });
        let material = Material::new(2390.0, moduli, relaxation).unwrap();
        match self.yield_strength {
            Some(strength) => material.with_flow(FlowRule::perfect(strength).unwrap()).unwrap(),
            None => material,
        }
    }

    pub fn sphere(&self, body: usize) -> BodyInput {
        let side = [Side::Below, Side::Above][body];
        let mesh = sphere(self.radii[body], self.element_size, 0.3e-3, side);
        BodyInput::Sphere { mesh, material: self.material() }
    }

    pub fn bodies(&self) -> [BodyInput; 2] {
        [0, 1].map(|body| self.sphere(body))
    }

    /// Both spheres, or a wall in the place of one.
    pub fn on_wall(&self, wall: usize) -> [BodyInput; 2] {
        let mut bodies = self.bodies();
        bodies[wall] = BodyInput::Wall;
        bodies
    }

    pub fn approach(&self) -> Approach {
        Approach::new(self.velocities, self.gap).unwrap()
    }

    pub fn settings(&self) -> Settings {
        let stiffness = self.penalty_factor * 10.0 * CONTACT_MODULUS;
        let usual = settings(stiffness, self.candidate_radius);
        Settings { step_factor: self.step_factor, ..usual }
    }

    pub fn model(&self) -> ExplicitBodies {
        self.model_of(self.bodies())
    }

    pub fn with_parts(&self, parts: ModelParts) -> ExplicitBodies {
        meeting(self.bodies(), self.approach(), &self.settings(), parts)
    }

    pub fn model_of(&self, bodies: [BodyInput; 2]) -> ExplicitBodies {
        let finite_strain = bodies.each_ref().map(|body| body.mesh().and(self.law));
        let parts = ModelParts { finite_strain, method: self.method, ..ModelParts::default() };
        meeting(bodies, self.approach(), &self.settings(), parts)
    }

    pub fn expected(&self) -> Expectation {
        Expectation { contact_time: HERTZ_TIME, approach: HERTZ_APPROACH }
    }

    pub fn request(&self) -> OutputRequest {
        OutputRequest {
            history_rows: self.history_rows,
            snapshots: self.snapshots.clone(),
            max_contact_times: self.max_time / HERTZ_TIME,
            ..OutputRequest::history()
        }
    }

    pub fn run(&self) -> Collision {
        self.run_model(&self.model())
    }

    pub fn run_model(&self, model: &ExplicitBodies) -> Collision {
        collide(model, self.expected(), &self.request(), &mut ())
    }

    /// Returns the restart state before the first step.
    pub fn start(&self, model: &ExplicitBodies) -> RunState {
        Run::new(model, self.expected(), &self.request()).restart_state().clone()
    }

    /// Returns the size of the restart state before the first step, in bytes.
    pub fn n_bytes(&self, model: &ExplicitBodies) -> usize {
        postcard::to_stdvec(&self.start(model)).unwrap().len()
    }

    /// Runs in pieces of some steps, each from the stored restart state of the one before.
    pub fn in_pieces(&self, model: &ExplicitBodies, n_steps: u64) -> Collision {
        let mut run = Run::new(model, self.expected(), &self.request());
        while run.advance(n_steps).is_none() {
            run = Run::resume(model, stored(run.restart_state())).unwrap();
        }
        run.finish()
    }
}

/// Returns a restart state as another process would read it.
pub fn stored(state: &RunState) -> RunState {
    let read = postcard::from_bytes(&postcard::to_stdvec(state).unwrap()).unwrap();
    assert_eq!(&read, state);
    read
}

/// Stores the progress of a run, and stops it once it has come to a step.
pub struct Watcher {
    pub stop_at: u64,
    pub seen: Vec<Progress>,
}

impl Monitor for Watcher {
    fn report(&mut self, progress: Progress) -> bool {
        self.seen.push(progress);
        progress.step < self.stop_at
    }
}

/// Asserts that a restart state fits no model like this.
pub fn assert_foreign(what: &str, model: &ExplicitBodies, state: &RunState) {
    let refused = Run::resume(model, stored(state)).err();
    assert_eq!(refused, Some(ModelError::ForeignRestartState), "{what}");
}

/// Returns the number of nodes of both bodies.
pub fn n_nodes(model: &ExplicitBodies) -> usize {
    model.bodies().iter().map(|body| body.n_nodes()).sum()
}

pub fn meeting(
    bodies: [BodyInput; 2],
    approach: Approach,
    settings: &Settings,
    parts: ModelParts,
) -> ExplicitBodies {
    ExplicitBodies::with_parts(bodies, approach, settings, parts).unwrap()
}

/// Returns the model of a body that falls onto a wall, or onto another body that is at rest.
pub fn falling(
    bodies: [BodyInput; 2],
    speed: f64,
    settings: &Settings,
    parts: ModelParts,
) -> ExplicitBodies {
    meeting(bodies, Approach::new([0.0, -speed], 0.0).unwrap(), settings, parts)
}

/// The upper body at finite strain.
pub fn upper_at_finite_strain(law: Option<HyperelasticLaw>) -> ModelParts {
    ModelParts { finite_strain: [None, law], ..ModelParts::default() }
}

/// Returns the model of a pair with contact between the deformed surfaces.
pub fn on_deformed_surfaces(
    bodies: [BodyInput; 2],
    approach: Approach,
    settings: &Settings,
    finite_strain: [Option<HyperelasticLaw>; 2],
) -> ExplicitBodies {
    let contact = DeformedContact::new(&bodies, approach.gap(), settings).unwrap();
    let contact = Some(Box::new(contact) as Box<dyn Contact>);
    let parts = ModelParts { finite_strain, contact, ..ModelParts::default() };
    meeting(bodies, approach, settings, parts)
}

/// The quantities of a run that has ended, which are all there.
pub struct Quantities {
    pub restitution: f64,
    pub contact_time: f64,
    pub peak_force: f64,
    pub max_approach: f64,
    pub max_contact_radius: f64,
    pub peak_pressure: f64,
    pub residual: f64,
    pub momentum_residual: f64,
    pub velocity_after: [f64; 2],
    pub steps: u64,
}

impl Quantities {
    /// Asserts that energy and momentum balance to shares of the initial ones.
    #[track_caller]
    pub fn assert_balance(&self, energy: f64, momentum: f64) {
        assert!(self.residual < energy, "energy: {:e}", self.residual);
        assert!(self.momentum_residual < momentum, "momentum: {:e}", self.momentum_residual);
    }
}

pub fn quantities(run: &Collision) -> Quantities {
    Quantities {
        restitution: run.restitution.unwrap(),
        contact_time: run.contact_time.unwrap(),
        peak_force: run.peak_force.unwrap(),
        max_approach: run.max_approach.unwrap(),
        max_contact_radius: run.max_contact_radius.unwrap(),
        peak_pressure: run.peak_pressure.unwrap(),
        residual: run.residual_relative.unwrap(),
        momentum_residual: run.momentum_residual_relative.unwrap(),
        velocity_after: run.bodies.map(|body| body.velocity_after.unwrap()),
        steps: run.steps.unwrap(),
    }
}

/// Returns an elastic material of a modulus (Pa), Poisson's ratio and density (kg/m³).
pub fn elastic(youngs_modulus: f64, poissons_ratio: f64, density: f64) -> Material {
    let moduli =
        ElasticModuli::from_youngs_modulus_poissons_ratio(youngs_modulus, poissons_ratio).unwrap();
    Material::new(density, moduli, None).unwrap()
}

/// Returns a sphere with elements of a size as far as a radius from the first touch.
pub fn sphere(
    radius: f64,
    contact_element_size: f64,
    refined_radius: f64,
    side: Side,
) -> SphereMesh {
    HalfDisc { radius, contact_element_size, refined_radius, growth: None, edge: None }
        .build()
        .unwrap()
        .on_side(side)
}

/// Returns settings with the usual step factor and mass scaling.
pub fn settings(contact_stiffness: f64, candidate_radius: f64) -> Settings {
    Settings {
        contact_stiffness,
        candidate_radius,
        step_factor: 0.9,
        mass_scaling: 2e-4,
        mass_times: [1.0; 2],
    }
}

/// Returns a glass of ν = 0.244 in units of density, shear modulus and so of the shear wave speed.
pub fn unit_glass(relaxation: Option<PronySeries>) -> Material {
    let moduli = ElasticModuli::from_youngs_modulus_poissons_ratio(2.0 * 1.244, 0.244).unwrap();
    Material::new(1.0, moduli, relaxation).unwrap()
}

/// Returns an upper unit sphere with `n` elements over the radius, nearly uniform.
pub fn unit_sphere(n: f64) -> SphereMesh {
    sphere(1.0, 1.0 / n, 0.5, Side::Above)
}
