//! The paper's glass pair on a coarse mesh, five elements a contact radius.

#![allow(dead_code, reason = "each test file uses its share")]

use fem_explicit::{BodyInput, Collision, Model, RunSettings, Settings, SnapshotRequest, collide};
use fem_material::{ActsOn, ElasticModuli, Material, PronySeries, PronyTerm};
use fem_mesh::{HalfDisc, Side};

/// Hertz' contact time and approach at 0.5 m/s.
pub const HERTZ_TIME: f64 = 63.235e-6;
pub const HERTZ_APPROACH: f64 = 10.742e-6;
/// E/(1 − ν²)/2 of the glass.
pub const CONTACT_MODULUS: f64 = 33.494e9;

/// What makes a pair: lengths, times and masses can be scaled.
#[derive(Clone)]
pub struct Pair {
    pub radii: [f64; 2],
    pub velocities: [f64; 2],
    pub gap: f64,
    pub element_size: f64,
    pub step_factor: f64,
    pub relaxation: Option<ActsOn>,
    /// Units of length, time and mass in m, s and kg.
    pub units: [f64; 3],
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
            relaxation: None,
            units: [1.0; 3],
            candidate_radius: 0.35e-3,
            history_rows: 1000,
            snapshots: SnapshotRequest::Times(Vec::new()),
            max_time: 200e-6,
        }
    }
}

impl Pair {
    pub fn material(&self) -> Material {
        let [length, time, mass] = self.units;
        let pressure = mass / (length * time * time);
        let moduli =
            ElasticModuli::from_youngs_modulus_poissons_ratio(63e9 * pressure, 0.244).unwrap();
        let relaxation = self.relaxation.map(|acts_on| {
            let term = PronyTerm { weight: 1.0, relaxation_time: time / 2708.0 };
            PronySeries::new(vec![term], acts_on).unwrap()
        });
        Material::new(2390.0 * mass / length.powi(3), moduli, relaxation).unwrap()
    }

    pub fn sphere(&self, body: usize) -> BodyInput {
        let [length, time, _] = self.units;
        let disc = HalfDisc {
            radius: self.radii[body] * length,
            contact_element_size: self.element_size * length,
            refined_radius: 0.3e-3 * length,
            growth: None,
        };
        let side = if body == 0 { Side::Below } else { Side::Above };
        BodyInput::Deformable {
            mesh: disc.build().unwrap().on_side(side),
            material: self.material(),
            velocity: self.velocities[body] * length / time,
        }
    }

    pub fn wall(&self, body: usize) -> BodyInput {
        let [length, time, _] = self.units;
        BodyInput::Wall { velocity: self.velocities[body] * length / time }
    }

    pub fn settings(&self) -> Settings {
        let [length, time, mass] = self.units;
        Settings {
            contact_stiffness: 10.0 * CONTACT_MODULUS * mass / (length * time * time),
            candidate_radius: self.candidate_radius * length,
            step_factor: self.step_factor,
            mass_scaling: 2e-4,
            gap: self.gap * length,
        }
    }

    pub fn model(&self) -> Model {
        Model::new([self.sphere(0), self.sphere(1)], &self.settings()).unwrap()
    }

    pub fn run_settings(&self) -> RunSettings {
        let [length, time, _] = self.units;
        RunSettings {
            expected_contact_time: HERTZ_TIME * time,
            expected_approach: HERTZ_APPROACH * length,
            history_rows: self.history_rows,
            snapshots: self.snapshots.clone(),
            max_time: self.max_time * time,
        }
    }

    pub fn run(&self) -> Collision {
        self.run_model(&self.model())
    }

    pub fn run_model(&self, model: &Model) -> Collision {
        collide(model, &self.run_settings(), &mut ())
    }
}

/// First to last contact, s.
pub fn contact_time(collision: &Collision) -> f64 {
    collision.last_contact.unwrap() - collision.first_contact.unwrap()
}
