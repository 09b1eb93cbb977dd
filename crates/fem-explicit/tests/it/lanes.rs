//! Kernels give the same bits on lanes of every kind.

use fem_collision::{Approach, BodyInput, Expectation, OutputRequest};
use fem_explicit::{
    BulkViscosity, ExplicitBodies, ModelParts, NodeForce, Run, Settings, ViscosityCoefficients,
    limit_lanes,
};
use fem_material::finite::HyperelasticLaw;
use fem_material::{ActsOn, PronySeries, PronyTerm};

use crate::common::{unit_glass, unit_sphere};

/// A unit sphere that hits a wall at a tenth of the shear wave speed, with relaxation terms of these weights.
fn model(weights: &[f64], acts_on: ActsOn, parts: ModelParts, viscosity: bool) -> ExplicitBodies {
    let term = |(k, &weight): (usize, &f64)| PronyTerm { weight, relaxation_time: 0.2 + k as f64 };
    let terms = weights.iter().enumerate().map(term).collect();
    let (mesh, material) = (unit_sphere(10.0), unit_glass(PronySeries::new(terms, acts_on).ok()));
    let coefficients = ViscosityCoefficients::default();
    let force = BulkViscosity::new(&mesh, &material, coefficients, 0.7).unwrap();
    let forces = viscosity.then(|| Box::new(force) as Box<dyn NodeForce>);
    let parts = ModelParts { node_forces: [Vec::new(), Vec::from_iter(forces)], ..parts };
    let bodies = [BodyInput::Wall, BodyInput::Sphere { mesh, material }];
    let settings = Settings {
        contact_stiffness: 5.0,
        candidate_radius: 0.9,
        step_factor: 0.9,
        mass_scaling: 0.0,
        mass_times: [1.0; 2],
    };
    let approach = Approach::new([0.0, -0.1], 0.0).unwrap();
    ExplicitBodies::with_parts(bodies, approach, &settings, parts).unwrap()
}

/// Hertz' contact time and approach.
const EXPECTED: Expectation = Expectation { contact_time: 5.4, approach: 0.18 };

/// Returns the restart state after some steps on lanes of at most this width, as bytes. It has displacements, velocities,
/// internal variables, energies and the time step.
fn state_on(widest: u8, model: &ExplicitBodies) -> Vec<u8> {
    limit_lanes(widest);
    let mut run = Run::new(model, EXPECTED, &OutputRequest::history());
    assert_eq!(run.advance(50), None);
    limit_lanes(u8::MAX);
    postcard::to_stdvec(run.restart_state()).unwrap()
}

/// Small and finite strain, all laws, elastic and relaxing with one and two terms, bulk viscosity, and finite strain near
/// the contact alone. Other tests run at the same time, on lanes of any width.
#[test]
fn lanes_of_every_kind_give_the_same_bits() {
    let laws = [None].into_iter().chain(HyperelasticLaw::ALL.map(Some));
    for (law, weights) in laws.flat_map(|law| [&[][..], &[0.3], &[0.3, 0.5]].map(|w| (law, w))) {
        for (acts_on, within) in [(ActsOn::All, None), (ActsOn::Shear, Some(0.4))] {
            let parts = ModelParts {
                finite_strain: [None, law],
                finite_strain_within: law.and(within),
                ..ModelParts::default()
            };
            let model = model(weights, acts_on, parts, within.is_some());
            let plain = state_on(0, &model);
            for widest in 1..=2 {
                assert!(state_on(widest, &model) == plain, "{law:?} {weights:?} {widest}");
            }
        }
    }
}

/// A single relaxation term at finite strain has a loop of its own, which gives the same as that of several terms.
#[test]
fn single_relaxation_term_gives_the_bits_of_several() {
    for law in HyperelasticLaw::ALL {
        let history = |weights: &[f64]| {
            let parts = ModelParts { finite_strain: [None, Some(law)], ..ModelParts::default() };
            let model = model(weights, ActsOn::All, parts, false);
            let mut run = Run::new(&model, EXPECTED, &OutputRequest::history());
            assert_eq!(run.advance(50), None);
            run.finish().history
        };
        let [one, several] = [&[0.3][..], &[0.3, 0.0]].map(history);
        assert!(one == several && one.len() > 20, "{law:?}");
    }
}
