//! The cost of a run is estimated before it: the mesh that its tolerance needs, or an upper bound of the refinement.

use fem_simulation::{ComputedCollision, Cost, ErrorEstimator, RefinedBeforeRun, Simulation};

use crate::scene::simulation_of;

/// Two balls, stiff or soft, that relax or not.
const BALLS: &str = r#"
    material.a = { density = "2500 kg/m^3", youngs_modulus = "60 GPa", poissons_ratio = 0.25 }
    material.steel = { density = "8000 kg/m^3", youngs_modulus = "200 GPa", poissons_ratio = 0.3 }
    body = [{ name = "lower", sphere.diameter = "10 mm", material = "a" },
            { name = "upper", sphere.diameter = "10 mm", material = "a", approach_speed = "1 m/s" }]
    output.snapshots = []"#;

const AUXETIC: &[&str] = &["material.a.poissons_ratio=-0.99"];
const SOFT_SPRINGS: &[&str] = &["contact.penalty_factor=0.03"];
const SOFTEST_SPRINGS: &[&str] = &["contact.penalty_factor=0.001"];
const FLUID: &[&str] = &[
    "material.a={density=1200, youngs_modulus='10 MPa', poissons_ratio=0.4, relaxation={acts_on='all', \
     terms=[{weight=1.0, decay_rate=3e3}]}}",
    "body.1.approach_speed='0.1 m/s'",
];
const ON_STEEL: &[&str] = &[
    "material.a={density=1000, youngs_modulus='1 MPa', poissons_ratio=0.3, hyperelastic='neo-hooke'}",
    "body.1.material='steel'",
    "body.1.approach_speed='7 cm/s'",
];
const FAST_RUBBER: &[&str] = &[
    "material.a={density=1100, youngs_modulus='1 MPa', poissons_ratio=0.45, hyperelastic='neo-hooke'}",
    "body.0={name='wall', wall={}}",
    "body.1.approach_speed='3 m/s'",
];
/// A soft ball on a wall, as fast as its waves.
const ON_WALL: &[&str] = &[
    "material.a={density=1100, youngs_modulus='1 MPa', poissons_ratio=0.3, hyperelastic='hencky'}",
    "body.0={name='wall', wall={}}",
    "body.1.approach_speed='6 m/s'",
];
const SOFT_AND_RELAXING: &[&str] = &[
    "material.a={density=1200, youngs_modulus='0.3 MPa', poissons_ratio=0.45, hyperelastic='neo-hooke-ln', \
     relaxation={acts_on='shear', terms=[{weight=0.6, relaxation_time='1 ms'}]}}",
    "body.1.approach_speed='2 m/s'",
];

fn simulation(set: &[&str]) -> Simulation {
    simulation_of(BALLS, set)
}

fn refined_before_run(set: &[&str], goes_on: bool) -> RefinedBeforeRun {
    ErrorEstimator::default().refine_before_run(simulation(set), || goes_on)
}

fn expected_updates(simulation: &Simulation) -> u64 {
    match simulation.setup().cost {
        Cost::Steps { element_updates, .. } => element_updates,
        _ => panic!("no elements"),
    }
}

/// Returns the element updates of a collision and of all coarser meshes before it.
fn computed_updates(computed: &ComputedCollision) -> u64 {
    let levels = computed.simulation.levels();
    let before: u64 = levels.iter().filter_map(|level| level.element_updates).sum();
    before + computed.collision.element_updates.unwrap()
}

/// Compares the cost with its estimate. A mesh that is known before the run costs the estimate within a factor of 1.5;
/// otherwise the cost is at most the bound, except for time steps that become shorter. Returns the computed collision.
fn compare_cost(set: &[&str], is_known: bool) -> ComputedCollision {
    let RefinedBeforeRun { simulation: refined, is_open } = refined_before_run(set, true);
    assert_eq!(!is_open, is_known, "{set:?}");
    let least = expected_updates(&refined) as f64;
    let follow = least * refined.refinement_bound().map_or(0.0, |bound| bound.over_first);
    let computed = simulation(set).run_within_tolerance(&mut ());
    let updates = computed_updates(&computed) as f64;
    let most = if is_open { 1.2 * (least + follow) } else { 1.5 * least };
    assert!((least / 1.5..most).contains(&updates), "{set:?}: {least:e} {follow:e} {updates:e}");
    computed
}

/// The mesh of the auxetic pair is refined before the run, by reference runs alone, without running the coarser mesh.
#[test]
fn the_cost_is_estimated() {
    let ComputedCollision { simulation, .. } = compare_cost(AUXETIC, true);
    assert!(!simulation.levels().is_empty());
    assert!(simulation.levels().iter().all(|level| level.element_updates.is_none()));
    assert!(simulation.refined_because().unwrap().contains(": elements of"));
    compare_cost(&[], true);
}

#[test]
#[ignore = "takes many seconds; .ci/run runs it"]
fn the_cost_of_further_scenes_is_estimated() {
    for set in [SOFT_SPRINGS, SOFTEST_SPRINGS, FLUID] {
        compare_cost(set, true);
    }
    compare_cost(ON_STEEL, false);
    compare_cost(FAST_RUBBER, false);
}

/// Without time for reference runs the mesh may be refined after the run.
#[test]
fn mesh_may_be_refined_after_the_run_without_reference_runs() {
    let RefinedBeforeRun { simulation, is_open } = refined_before_run(AUXETIC, false);
    assert!(is_open && simulation.levels().is_empty());
    assert!(simulation.refinement_bound().unwrap().over_first > 1.0);
}

/// A mesh stays too coarse only if a finer one exceeds the limit of element updates, for any Poisson's ratio.
fn refine_up_to_the_limit(poissons_ratios: &[f64]) {
    const LIMIT: u64 = 6_000_000;
    let mut n_limited = 0;
    for nu in poissons_ratios {
        let ratio = format!("material.a.poissons_ratio={nu}");
        let limit = format!("limits.element_updates={LIMIT}");
        let set = [FAST_RUBBER, &[ratio.as_str(), limit.as_str()]].concat();
        let computed = simulation(&set).run_within_tolerance(&mut ());
        assert!(expected_updates(&computed.simulation) <= LIMIT);
        let warnings = computed.warnings().join("\n");
        if warnings.contains("because of the mesh") {
            assert!(warnings.contains("limits.element_updates"), "{nu}: {warnings}");
            n_limited += 1;
        }
    }
    assert!(n_limited > 0);
}

#[test]
fn a_mesh_is_refined_up_to_the_limit() {
    refine_up_to_the_limit(&[0.49]);
}

#[test]
#[ignore = "takes many seconds; .ci/run runs it"]
fn a_mesh_is_refined_up_to_the_limit_for_any_poissons_ratio() {
    refine_up_to_the_limit(&[0.2, 0.3, 0.4, 0.45, 0.49]);
}

/// Soft springs are named as the cause, once before the run and once after it. The mesh is not refined against them, and
/// the advice helps.
#[test]
fn soft_springs_cause_advice_and_no_mesh_refinement() {
    let computed = simulation(SOFT_SPRINGS).run_within_tolerance(&mut ());
    assert_eq!(computed.simulation.levels(), []);
    let before = computed.simulation.warnings_before();
    for (when, warnings) in [("before", before), ("after", computed.warnings())] {
        let of_springs = |warning: &&String| warning.contains("contact.penalty_factor");
        assert_eq!(warnings.iter().filter(of_springs).count(), 1, "{when}: {warnings:#?}");
        assert!(!warnings.join("\n").contains("because of the mesh"), "{warnings:#?}");
    }
    let computed = simulation(&["contact.penalty_factor=1"]).run_within_tolerance(&mut ());
    assert_eq!(computed.simulation.levels(), []);
    assert!(!computed.warnings().join("\n").contains("penalty_factor"));
}

/// A coarser run predicts the element updates of a soft body within a factor of 1.5 (flattened elements have short steps,
/// and bodies that stiffen or relax touch for another time), and all reference runs cost at most a fifth of the run.
fn compare_reference_runs(set: &[&str]) {
    let simulation = simulation(set);
    let longer = ErrorEstimator::default().updates_over_expected(&simulation);
    let collision = simulation.run(&mut ());
    let updates = collision.element_updates.unwrap() as f64;
    let ratio = updates / (longer * expected_updates(&simulation) as f64);
    assert!((1.0 / 1.5..1.5).contains(&ratio), "{set:?}: {ratio} {longer}");
    let share = simulation.estimate_errors(&collision).element_updates as f64 / updates;
    assert!(share < 0.2, "{set:?}: {share}");
    assert_eq!(share > 0.0, simulation.reference_updates().is_some(), "{set:?}");
}

#[test]
fn reference_runs_predict_the_cost_and_are_cheap() {
    compare_reference_runs(&[]);
    compare_reference_runs(ON_STEEL);
}

#[test]
#[ignore = "takes many seconds; .ci/run runs it"]
fn reference_runs_of_further_soft_bodies_predict_the_cost_and_are_cheap() {
    for set in [ON_WALL, SOFT_AND_RELAXING, FAST_RUBBER] {
        compare_reference_runs(set);
    }
}
