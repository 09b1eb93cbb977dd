//! Scenes that the condensed model, the explicit model and the closed forms all understand.

#![allow(dead_code)]

use fem_collision::{Approach, BodyInput, Collision, Expectation, OutputRequest};
use fem_condensed::{CondensedPair, ContactModel, PairSettings};
use fem_explicit::{ExplicitBodies, Settings};
use fem_laws::{FiniteSize, HertzImpact, Impact, Pair, PairRelaxation, Partner, Ting};
use fem_material::{ActsOn, ElasticModuli, Material, PronySeries, PronyTerm};
use fem_mesh::{HalfDisc, Side, SphereMesh};

/// E (Pa), ν, ρ (kg/m³), and terms (weight, rate in 1/s).
pub fn material(constants: [f64; 3], acts_on: ActsOn, terms: &[(f64, f64)]) -> Material {
    let moduli =
        ElasticModuli::from_youngs_modulus_poissons_ratio(constants[0], constants[1]).unwrap();
    let term = |&(weight, rate): &(f64, f64)| PronyTerm { weight, relaxation_time: 1.0 / rate };
    let relaxation = (!terms.is_empty())
        .then(|| PronySeries::new(terms.iter().map(term).collect(), acts_on).unwrap());
    Material::new(constants[2], moduli, relaxation).unwrap()
}

pub const GLASS: [f64; 3] = [63e9, 0.244, 2390.0];
pub const STEEL: [f64; 3] = [210e9, 0.29, 7850.0];
pub const POLYMER: [f64; 3] = [3e9, 0.4, 1200.0];

pub fn glass() -> Material {
    material(GLASS, ActsOn::All, &[])
}

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

/// A body of a scene: diameter (m) and material; `None` is a wall.
pub type Body = Option<(f64, Material)>;

/// Two bodies that meet.
#[derive(Clone)]
pub struct Scene {
    pub bodies: [Body; 2],
    /// Relative speed, m/s.
    pub speed: f64,
}

impl Scene {
    /// The paper's pair of spheres, 22.2 and 15.9 mm, at 0.5 m/s.
    pub fn paper(lower: Material, upper: Material) -> Self {
        Self { bodies: [Some((22.2e-3, lower)), Some((15.9e-3, upper))], speed: 0.5 }
    }

    pub fn pair(&self) -> Pair {
        let partner = |body: &Body| match body {
            Some((diameter, material)) => Partner::solid_sphere(*diameter, material),
            None => Partner::Wall,
        };
        Pair::new(partner(&self.bodies[0]), partner(&self.bodies[1])).unwrap()
    }

    pub fn hertz(&self) -> HertzImpact {
        HertzImpact::new(&self.pair(), self.speed).unwrap()
    }

    /// Returns Ting's impact, with the finite size of the spheres on request.
    pub fn ting(&self, finite_size: bool) -> Impact {
        let [first, second] = self.bodies.each_ref().map(|b| b.as_ref().map(|(_, m)| m));
        let ting = Ting::new(&self.pair(), PairRelaxation::new(first, second).unwrap());
        if !finite_size {
            return ting.impact(self.speed).unwrap();
        }
        let [first, second] = self.bodies.each_ref().map(|b| b.as_ref().map(|(d, m)| (0.5 * d, m)));
        let finite_size = FiniteSize::new(first, second).unwrap();
        ting.with_finite_size(finite_size).impact(self.speed).unwrap()
    }

    /// Returns the mesh of a body with a number of elements per Hertz' contact radius.
    pub fn mesh(&self, side: usize, elements: f64) -> Option<SphereMesh> {
        let contact_radius = self.hertz().max_contact_radius();
        let (diameter, _) = self.bodies[side].as_ref()?;
        let side = [Side::Below, Side::Above][side];
        Some(sphere(0.5 * diameter, contact_radius / elements, 1.2 * contact_radius, side))
    }

    pub fn inputs(&self, elements: f64) -> [BodyInput; 2] {
        [0, 1].map(|side| match (self.mesh(side, elements), &self.bodies[side]) {
            (Some(mesh), Some((_, material))) => {
                BodyInput::Sphere { mesh, material: material.clone() }
            }
            _ => BodyInput::Wall,
        })
    }

    pub fn settings(&self) -> PairSettings {
        PairSettings::new(1.5 * self.hertz().max_contact_radius())
    }

    /// Condenses the pair with a number of elements per contact radius, exact contact and no vibration.
    pub fn condensed(&self, elements: f64) -> CondensedPair {
        self.condensed_with(elements, self.settings())
    }

    pub fn condensed_with(&self, elements: f64, settings: PairSettings) -> CondensedPair {
        CondensedPair::new(self.inputs(elements), settings).unwrap()
    }

    /// Condenses the pair with modes of vibration.
    pub fn vibrating(&self, elements: f64, vibration_modes: usize) -> CondensedPair {
        self.condensed_with(elements, PairSettings { vibration_modes, ..self.settings() })
    }

    /// Condenses the pair with penalty springs of a stiffness, Pa.
    pub fn on_springs(
        &self,
        elements: f64,
        stiffness: f64,
        vibration_modes: usize,
    ) -> CondensedPair {
        let contact = ContactModel::Springs(stiffness);
        let settings = PairSettings { contact, vibration_modes, ..self.settings() };
        self.condensed_with(elements, settings)
    }

    pub fn collide(&self, pair: &CondensedPair) -> Collision {
        collide(pair, self.speed)
    }
}

/// Returns scenes of unequal and unlike bodies, of a wall, and of bodies that relax in different ways.
pub fn unlike_scenes() -> [(&'static str, Scene); 4] {
    let sphere = |diameter, material| Some((diameter, material));
    let two = |lower, upper, speed| Scene { bodies: [lower, upper], speed };
    let steel = sphere(20e-3, material(STEEL, ActsOn::All, &[]));
    let polymer = sphere(12e-3, material(POLYMER, ActsOn::Shear, &[(0.5, 2e3)]));
    let relaxing = sphere(15.9e-3, material(GLASS, ActsOn::All, &[(0.8, 5e3)]));
    let both = material(GLASS, ActsOn::All, &[(0.5, 3e3), (0.1, 1e6)]);
    [
        ("unequal", two(sphere(22.2e-3, glass()), sphere(10e-3, glass()), 0.3)),
        ("unlike", two(steel, polymer, 0.2)),
        ("wall", two(None, relaxing, 0.5)),
        ("one of each kind", Scene::paper(both, material(GLASS, ActsOn::Shear, &[(0.7, 1e4)]))),
    ]
}

/// Runs explicit elements with penalty springs of a stiffness, Pa.
pub fn explicit(
    inputs: [BodyInput; 2],
    hertz: &HertzImpact,
    contact_stiffness: f64,
    request: &OutputRequest,
) -> Collision {
    let settings = Settings {
        contact_stiffness,
        candidate_radius: 1.5 * hertz.max_contact_radius(),
        step_factor: 0.9,
        // 3e-5 of the mass moves T by as much.
        mass_scaling: 3e-5,
        mass_times: [1.0; 2],
    };
    let approach = Approach::at(hertz.approach_speed()).unwrap();
    let model = ExplicitBodies::new(inputs, approach, &settings).unwrap();
    let expected =
        Expectation { contact_time: hertz.contact_time(), approach: hertz.max_approach() };
    let request = OutputRequest { max_contact_times: 20.0, ..request.clone() };
    fem_explicit::collide(&model, expected, &request, &mut ())
}

/// Computes the collision with the relaxations of the bodies' own materials.
pub fn collide(pair: &CondensedPair, speed: f64) -> Collision {
    collide_in(pair, speed, CondensedPair::N_STEPS)
}

/// The same with a number of steps per contact time.
pub fn collide_in(pair: &CondensedPair, speed: f64, n_steps: usize) -> Collision {
    pair.impact(speed, pair.relaxations(), n_steps).unwrap()
}

pub fn assert_close(what: &str, found: f64, expected: f64, relative: f64) {
    let error = found / expected - 1.0;
    assert!(
        error.abs() <= relative,
        "{what}: found {found:e}, expected {expected:e}, off by {error:.2e} of {relative:.0e}"
    );
}

/// Asserts that a restitution is an expected one, to an absolute tolerance.
pub fn assert_restitution(what: &str, run: &Collision, expected: f64, tolerance: f64) {
    let found = run.restitution.unwrap();
    assert!((found - expected).abs() < tolerance, "{what}: {found} {expected}");
}

/// Asserts that energy balances to a share of the initial one.
pub fn assert_balance(what: &str, run: &Collision, limit: f64) {
    let residual = run.residual_relative.unwrap();
    assert!(residual < limit, "{what}: {residual:e}");
}

/// Asserts that contact time, peak force and approach are expected ones, to relative tolerances.
pub fn assert_pulse(run: &Collision, expected: [f64; 3], tolerances: [f64; 3]) {
    let found = [run.contact_time, run.peak_force, run.max_approach].map(Option::unwrap);
    for (k, what) in ["contact time", "peak force", "approach"].into_iter().enumerate() {
        assert_close(what, found[k], expected[k], tolerances[k]);
    }
}

/// Contact time, peak force and approach of Hertz' impact.
pub fn hertz_pulse(hertz: &HertzImpact) -> [f64; 3] {
    [hertz.contact_time(), hertz.peak_force(), hertz.max_approach()]
}

/// Contact time, peak force and approach of Ting's impact.
pub fn ting_pulse(ting: &Impact) -> [f64; 3] {
    [ting.contact_time.unwrap(), ting.peak_force, ting.max_approach]
}

/// Converged quasi-static finite elements of another code for the glass pair, h = 3.75 µm: contact time, peak force
/// and approach, and restitutions.
pub const CONVERGED: [f64; 3] = [62.818e-6, 107.99, 10.681e-6];
pub const CONVERGED_RESTITUTIONS: [(ActsOn, f64); 2] =
    [(ActsOn::All, 0.92763), (ActsOn::Shear, 0.94811)];
