//! Kernels give the same bits on lanes of every kind.

use fem_collision::{Account, BodyInput, Expectation, OutputRequest};
use fem_explicit::{
    BulkViscosity, ExplicitBodies, ModelParts, NodeForce, Run, Settings, ViscosityCoefficients,
    limit_lanes,
};
use fem_material::finite::HyperelasticLaw;
use fem_material::{
    ActsOn, FlowPoint, FlowRule, Hardening, Material, PronySeries, PronyTerm, RateFactor,
};

use crate::common::{falling, settings, unit_glass, unit_sphere, upper_at_finite_strain};

/// A unit sphere that hits a wall at a tenth of the shear wave speed, with relaxation terms of these weights.
fn model(weights: &[f64], acts_on: ActsOn, parts: ModelParts, viscosity: bool) -> ExplicitBodies {
    let term = |(k, &weight): (usize, &f64)| PronyTerm { weight, relaxation_time: 0.2 + k as f64 };
    let terms = weights.iter().enumerate().map(term).collect();
    model_of(unit_glass(PronySeries::new(terms, acts_on).ok()), parts, viscosity)
}

/// A unit sphere of a material that hits a wall.
fn model_of(material: Material, parts: ModelParts, viscosity: bool) -> ExplicitBodies {
    let mesh = unit_sphere(10.0);
    let coefficients = ViscosityCoefficients::default();
    let force = BulkViscosity::new(&mesh, &material, coefficients, 0.7).unwrap();
    let forces = viscosity.then(|| Box::new(force) as Box<dyn NodeForce>);
    let parts = ModelParts { node_forces: [Vec::new(), Vec::from_iter(forces)], ..parts };
    let bodies = [BodyInput::Wall, BodyInput::Sphere { mesh, material }];
    let settings = Settings { mass_scaling: 0.0, ..settings(5.0, 0.9) };
    falling(bodies, 0.1, &settings, parts)
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
            let finite_strain_within = law.and(within);
            let parts = ModelParts { finite_strain_within, ..upper_at_finite_strain(law) };
            let model = model(weights, acts_on, parts, within.is_some());
            let plain = state_on(0, &model);
            for widest in 1..=2 {
                assert!(state_on(widest, &model) == plain, "{law:?} {weights:?} {widest}");
            }
        }
    }
}

/// Rules with hardening and rate of every kind, in all elements and near the contact alone.
#[test]
fn lanes_of_every_kind_give_the_same_bits_where_elements_flow() {
    let yield_strength = 0.02;
    let point = |(plastic_strain, flow_stress)| FlowPoint { plastic_strain, flow_stress };
    let table = [(0.0, 0.02), (0.01, 0.03), (0.1, 0.035)].map(point).to_vec();
    let rate = Some(RateFactor { coefficient: 0.02, reference_rate: 1e-3 });
    for (hardening, rate, within) in [
        (Hardening::Linear { yield_strength, modulus: 0.01 }, None, None),
        (Hardening::Swift { yield_strength, strain: 0.002, exponent: 0.2 }, rate, Some(0.6)),
        (Hardening::Table(table), rate, None),
    ] {
        let hencky = upper_at_finite_strain(Some(HyperelasticLaw::Hencky));
        let parts = ModelParts { finite_strain_within: within, ..hencky };
        let rule = FlowRule::new(hardening.clone(), rate).unwrap();
        let model = model_of(unit_glass(None).with_flow(rule).unwrap(), parts, false);
        let plain = state_on(0, &model);
        for widest in 1..=2 {
            assert!(state_on(widest, &model) == plain, "{hardening:?} {widest}");
        }
        let mut run = Run::new(&model, EXPECTED, &OutputRequest::history());
        assert_eq!(run.advance(50), None);
        let row = run.finish().history.last().copied().unwrap();
        assert!(row.energy(Account::PlasticWork).unwrap() > 0.0, "{hardening:?}: no flow");
    }
}

/// A single relaxation term at finite strain has a loop of its own, which gives the same as that of several terms.
#[test]
fn single_relaxation_term_gives_the_bits_of_several() {
    for law in HyperelasticLaw::ALL {
        let history = |weights: &[f64]| {
            let parts = upper_at_finite_strain(Some(law));
            let model = model(weights, ActsOn::All, parts, false);
            let mut run = Run::new(&model, EXPECTED, &OutputRequest::history());
            assert_eq!(run.advance(50), None);
            run.finish().history
        };
        let [one, several] = [&[0.3][..], &[0.3, 0.0]].map(history);
        assert!(one == several && one.len() > 20, "{law:?}");
    }
}
