//! The cost of a run is announced before it: the mesh that its tolerance needs, or an upper bound of what may follow.

use std::path::Path;

use fem::{Case, ComputedCollision, Cost, ErrorEstimator, RefinedBeforeRun, Simulation};

/// Two balls, stiff or soft, that relax or not.
const BALLS: &str = r#"
[material.a]
density = "2500 kg/m^3"
youngs_modulus = "60 GPa"
poissons_ratio = 0.25

[material.steel]
density = "8000 kg/m^3"
youngs_modulus = "200 GPa"
poissons_ratio = 0.3

[[body]]
name = "lower"
sphere = { diameter = "10 mm" }
material = "a"

[[body]]
name = "upper"
sphere = { diameter = "10 mm" }
material = "a"
approach_speed = "1 m/s"

[output]
snapshots = []
"#;

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

fn simulation(set: &[&str]) -> Simulation {
    let set: Vec<String> = set.iter().map(ToString::to_string).collect();
    Simulation::new(Case::parse("balls.toml", BALLS, Path::new("."), &set).unwrap()).unwrap()
}

fn refined_before_run(set: &[&str], goes_on: bool) -> RefinedBeforeRun {
    ErrorEstimator::default().refine_before_run(simulation(set), || goes_on)
}

fn announced(simulation: &Simulation) -> u64 {
    match simulation.setup().cost {
        Cost::Steps { element_updates, .. } => element_updates,
        _ => panic!("no elements"),
    }
}

/// Element updates of a collision and of all coarser meshes before it.
fn spent(computed: &ComputedCollision) -> u64 {
    let levels = computed.simulation.levels();
    let before: u64 = levels.iter().filter_map(|level| level.element_updates).sum();
    before + computed.collision.element_updates.unwrap()
}

/// A mesh that is known before the run costs what is announced within 1.5 times; another one no more than the bound, but
/// for steps that grow shorter.
#[test]
fn what_is_announced_is_spent() {
    for (set, is_known) in [
        (&[][..], true),
        (AUXETIC, true),
        (SOFT_SPRINGS, true),
        (SOFTEST_SPRINGS, true),
        (FLUID, true),
        (ON_STEEL, false),
        (FAST_RUBBER, false),
    ] {
        let RefinedBeforeRun { simulation: refined, is_open } = refined_before_run(set, true);
        assert_eq!(!is_open, is_known, "{set:?}");
        let least = announced(&refined) as f64;
        let follow = least * refined.refinement_bound().map_or(0.0, |bound| bound.over_first);
        let spent = spent(&simulation(set).run_within_tolerance(&mut ())) as f64;
        let most = if is_open { 1.2 * (least + follow) } else { 1.5 * least };
        assert!((least / 1.5..most).contains(&spent), "{set:?}: {least:e} {follow:e} {spent:e}");
    }
}

/// A mesh that reference runs reject before the run is not run, and the result is that of the chosen mesh.
#[test]
fn no_run_is_thrown_away() {
    let ComputedCollision { simulation, collision, .. } =
        simulation(AUXETIC).run_within_tolerance(&mut ());
    assert!(!simulation.levels().is_empty());
    assert!(simulation.levels().iter().all(|level| level.element_updates.is_none()));
    assert!(simulation.refined_because().unwrap().contains(": elements of"));
    let again = Case::of(simulation.resolved().clone()).unwrap();
    assert_eq!(Simulation::new(again).unwrap().run(&mut ()), collision);
}

/// Without time for reference runs the mesh stays open.
#[test]
fn without_reference_runs_the_mesh_is_open() {
    let RefinedBeforeRun { simulation, is_open } = refined_before_run(AUXETIC, false);
    assert!(is_open && simulation.levels().is_empty());
    assert!(simulation.refinement_bound().unwrap().over_first > 1.0);
}

/// A mesh stays too coarse only where a finer one takes more than the limit, whatever Poisson's ratio is.
#[test]
fn a_mesh_is_given_up_for_its_cost_alone() {
    const LIMIT: u64 = 6_000_000;
    let mut ends = [0, 0];
    for nu in [0.2, 0.3, 0.4, 0.45, 0.49] {
        let ratio = format!("material.a.poissons_ratio={nu}");
        let limit = format!("limits.element_updates={LIMIT}");
        let set = [FAST_RUBBER, &[ratio.as_str(), limit.as_str()]].concat();
        let computed = simulation(&set).run_within_tolerance(&mut ());
        assert!(announced(&computed.simulation) <= LIMIT);
        let warnings = computed.warnings().join("\n");
        match warnings.contains("because of the mesh") {
            true => {
                assert!(warnings.contains("limits.element_updates"), "{nu}: {warnings}");
                ends[0] += 1;
            }
            false => ends[1] += 1,
        }
    }
    assert!(ends[0] > 0, "{ends:?}");
}

/// Soft springs are named as the cause, once, before and after; no finer mesh is tried against them, and the remedy helps.
#[test]
fn soft_springs_are_not_taken_for_the_mesh() {
    for set in [SOFT_SPRINGS, SOFTEST_SPRINGS] {
        let computed = simulation(set).run_within_tolerance(&mut ());
        assert_eq!(computed.simulation.levels(), []);
        let before = computed.simulation.warnings_before();
        for (when, warnings) in [("before", before), ("after", computed.warnings())] {
            let of_springs =
                |warning: &&String| warning.contains("write contact.penalty_factor = ");
            assert_eq!(
                warnings.iter().filter(of_springs).count(),
                1,
                "{set:?} {when}: {warnings:#?}"
            );
            assert!(!warnings.join("\n").contains("because of the mesh"), "{warnings:#?}");
        }
    }
    let computed = simulation(&["contact.penalty_factor=1"]).run_within_tolerance(&mut ());
    assert_eq!(computed.simulation.levels(), []);
    assert!(!computed.warnings().join("\n").contains("penalty_factor"));
}

/// A soft ball on another body that is as fast as its waves, far softer, relaxing or on steel.
const SOFT: &[(&str, &[&str])] = &[
    (
        "on a wall",
        &[
            "material.a={density=1100, youngs_modulus='1 MPa', poissons_ratio=0.3, hyperelastic='hencky'}",
            "body.0={name='wall', wall={}}",
            "body.1.approach_speed='6 m/s'",
        ],
    ),
    (
        "on its like, relaxing",
        &[
            "material.a={density=1200, youngs_modulus='0.3 MPa', poissons_ratio=0.45, hyperelastic='neo-hooke-ln', \
             relaxation={acts_on='shear', terms=[{weight=0.6, relaxation_time='1 ms'}]}}",
            "body.1.approach_speed='2 m/s'",
        ],
    ),
    ("on steel", ON_STEEL),
    ("rubber", FAST_RUBBER),
];

/// The element updates that a coarser run expects of soft bodies are right within 1.5 times: elements that are pressed
/// flat have short steps, and bodies that stiffen or relax touch for another time.
#[test]
fn the_cost_of_soft_bodies_is_known_from_a_coarser_run() {
    for (name, set) in SOFT {
        let simulation = simulation(set);
        let longer = ErrorEstimator::default().updates_over_announced(&simulation);
        let updates = simulation.run(&mut ()).element_updates.unwrap() as f64;
        let ratio = updates / (longer * announced(&simulation) as f64);
        assert!((1.0 / 1.5..1.5).contains(&ratio), "{name}: {ratio} {longer}");
    }
}

/// Reference runs cost at most a fifth of a run of explicit elements, in element updates.
#[test]
fn reference_runs_cost_a_fifth_at_most() {
    for set in [&[][..], ON_STEEL, FAST_RUBBER] {
        let simulation = simulation(set);
        let collision = simulation.run(&mut ());
        let errors = simulation.estimate_errors(&collision);
        let share = errors.element_updates as f64 / collision.element_updates.unwrap() as f64;
        assert!(share < 0.2, "{set:?}: {share}");
        assert_eq!(share > 0.0, simulation.reference_updates().is_some(), "{set:?}");
    }
}
