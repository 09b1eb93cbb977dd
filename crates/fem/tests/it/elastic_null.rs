//! What a relaxing run says that it would lose without relaxation, against runs without it.

use std::path::Path;

use fem::{Case, Simulation, Summary};

/// A soft ball that relaxes, struck by steel.
const SOFT: &str = "
    material.soft = { density = 1100, youngs_modulus = '3 MPa', poissons_ratio = 0.45,
        relaxation = { acts_on = 'shear', terms = [{ weight = 0.3, relaxation_time = '1 ms' }] } }
    material.steel = { density = 7800, youngs_modulus = '210 GPa', poissons_ratio = 0.28 }
    body = [{ name = 'ball', sphere.diameter = '12 mm', material = 'soft' },
            { name = 'hammer', sphere.diameter = '8 mm', material = 'steel', approach_speed = 0.6 }]
    model.fem = {}
    output.snapshots = []";

fn simulation(set: &[&str]) -> Simulation {
    let set: Vec<String> = set.iter().map(ToString::to_string).collect();
    Simulation::new(Case::parse("soft.toml", SOFT, Path::new("."), &set).unwrap()).unwrap()
}

fn summary(set: &[&str]) -> Summary {
    let simulation = simulation(set);
    let collision = simulation.run(&mut ());
    simulation.summary(&collision)
}

/// However much has relaxed since the bodies rang: from a tenth of a contact to hundreds of relaxation times.
#[test]
fn it_is_that_of_elastic_runs_however_fast_bodies_relax() {
    let elastic = 1.0 - summary(&["effects.viscoelasticity='off'"]).collision.restitution.unwrap();
    for (time, is_estimated) in [("10 ms", true), ("1 ms", true), ("40 us", false), ("4 us", false)]
    {
        let series = format!(
            "material.soft.relaxation={{acts_on='shear',terms=[{{weight=0.3,relaxation_time='{time}'}}]}}"
        );
        let summary = summary(&[&series]);
        let null = summary.elastic_null.unwrap();
        let ratio = null.one_minus_restitution / elastic;
        assert!((1.0 / 3.0..3.0).contains(&ratio), "{time}: {null:?} {elastic:e}");
        assert_eq!(null.estimated, is_estimated, "{time}");
        let (own, all) = (summary.element_updates.unwrap(), summary.cost.all_element_updates);
        // What told it is counted.
        assert!(is_estimated || all.unwrap() > own, "{all:?} {own}");
    }
}

/// The run that tells it is computed once.
#[test]
fn a_summary_that_is_asked_for_again_takes_nothing() {
    let simulation =
        simulation(&["material.soft.relaxation.terms=[{weight=0.3,relaxation_time='4 us'}]"]);
    let collision = simulation.run(&mut ());
    let [first, second] = [simulation.summary(&collision), simulation.summary(&collision)];
    assert!(first.elastic_null.is_some() && first.elastic_null == second.elastic_null);
    assert_eq!(first.cost.all_element_updates, second.cost.all_element_updates);
}
