//! The loss that a relaxing run would have without relaxation, compared with elastic runs.

use fem_simulation::Simulation;

use crate::scene::simulation_of;

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
    simulation_of(SOFT, set)
}

/// The estimate agrees with elastic runs from a tenth of a contact to hundreds of relaxation times, and its run is computed
/// once.
#[test]
fn the_elastic_loss_is_that_of_elastic_runs() {
    let elastic = simulation(&["effects.viscoelasticity='off'"]).run(&mut ());
    let elastic = 1.0 - elastic.restitution.unwrap();
    for (time, is_estimated) in [("10 ms", true), ("1 ms", true), ("40 us", false), ("4 us", false)]
    {
        let series = format!(
            "material.soft.relaxation={{acts_on='shear',terms=[{{weight=0.3,relaxation_time='{time}'}}]}}"
        );
        let simulation = simulation(&[&series]);
        let collision = simulation.run(&mut ());
        let [summary, again] = [(); 2].map(|()| simulation.summary(&collision));
        assert_eq!(summary.elastic_null, again.elastic_null);
        assert_eq!(summary.cost.all_element_updates, again.cost.all_element_updates);
        let null = summary.elastic_null.unwrap();
        let ratio = null.one_minus_restitution / elastic;
        assert!((1.0 / 3.0..3.0).contains(&ratio), "{time}: {null:?} {elastic:e}");
        assert_eq!(null.estimated, is_estimated, "{time}");
        // The part by vibrations is known of an estimate alone.
        assert_eq!(null.vibrations.is_some(), is_estimated, "{time}");
        assert!(null.vibrations <= Some(null.one_minus_restitution), "{null:?}");
        let (own, all) = (summary.element_updates.unwrap(), summary.cost.all_element_updates);
        // The elastic run is counted.
        assert!(is_estimated || all.unwrap() > own, "{all:?} {own}");
    }
}
