//! Bodies that relax to nothing stay together, whichever model computes them.

use std::path::Path;

use fem::{Case, Cost, Ending, Label, Simulation, Stop, Want};
use fem_collision::STAY_TOGETHER;

const GLASS: &str = include_str!("../../../../cases/glass_0.5ms.toml");

fn simulation(model: &str, acts_on: &str, weight: f64, time: &str) -> Simulation {
    let overrides = [
        format!("model.{model}={{}}"),
        "mesh.contact_element_size='0.2 mm'".to_string(),
        "mesh.refined_radius='0.6 mm'".to_string(),
        format!(
            "material.glass.relaxation={{acts_on='{acts_on}', terms=[{{weight={weight}, \
             relaxation_time='{time}'}}]}}"
        ),
    ];
    let case = Case::parse("glass.toml", GLASS, Path::new("."), &overrides).unwrap();
    Simulation::new(case).unwrap()
}

#[test]
fn a_collision_without_an_end_is_complete() {
    for model in ["fem", "condensed"] {
        for acts_on in ["all", "shear"] {
            for time in ["0.1 us", "1 us"] {
                let name = format!("{model} {acts_on} {time}");
                let simulation = simulation(model, acts_on, 1.0, time);
                let collision = simulation.run(&mut ());
                assert_eq!(collision.ending, Ending::Together, "{name}");
                assert_eq!(collision.restitution, Some(0.0), "{name}");
                assert_eq!(collision.contact_time, None, "{name}");
                // Momentum is kept: both go on at the speed of their mass centre, ρ cancels.
                let cubes = [22.2_f64, 15.9].map(|diameter| diameter.powi(3));
                let common = 0.5 * cubes[0] / (cubes[0] + cubes[1]);
                for body in &collision.bodies {
                    let after = body.velocity_after.unwrap();
                    assert!((after / common - 1.0).abs() < 1e-3, "{name}: {after} {common}");
                }
                // They are closest in the end, and half as close on the way.
                for label in [Label::MidCompression, Label::Maximum] {
                    assert!(collision.snapshot(label).is_some(), "{name} {label:?}");
                }
                let summary = simulation.summary(&collision);
                assert!(summary.complete && summary.stopped_because.is_none(), "{name}");
                assert!(summary.warnings.iter().any(|text| text == STAY_TOGETHER), "{name}");
            }
        }
    }
}

/// The limit of a case is kept while the run goes, whatever was expected of it.
#[test]
fn a_run_ends_at_its_limit() {
    let mut simulation = simulation("fem", "all", 1.0, "0.1 us");
    let Cost::Steps { element_updates: expected, .. } = simulation.setup().cost else { panic!() };
    let limit = expected / 10;
    simulation.ask_for(Want { most_element_updates: limit, ..simulation.want().clone() }).unwrap();
    let collision = simulation.run(&mut ());
    assert!(
        matches!(collision.stop(), Some(Stop::TooManyUpdates { .. })),
        "{:?}",
        collision.ending
    );
    let (taken, elements) = (collision.element_updates.unwrap(), collision.bodies[0].elements);
    assert!(taken >= limit && taken < limit + 2 * elements.unwrap() as u64 + 1000);
    assert!(!simulation.summary(&collision).complete);
}

/// What a run will take is known before it, of bodies that part late and of those that stay together:
/// within the half that an estimate may be off by, and a quarter where Ting's contact time is its measure, on
/// a mesh of three elements across the contact.
#[test]
fn the_steps_of_a_relaxing_contact_are_foretold() {
    for (weight, time, most) in [
        (0.5, "10 us", 1.25),
        (0.9, "10 us", 1.25),
        (0.9, "1 us", 1.25),
        (1.0, "10 us", 1.25),
        (1.0, "1 us", 1.5),
    ] {
        let simulation = simulation("fem", "all", weight, time);
        let Cost::Steps { steps, seconds, .. } = simulation.setup().cost else { panic!() };
        let mut progress = Vec::new();
        let mut course = simulation.start();
        while course.advance(&mut ()) {
            let now = course.progress();
            progress.push((now.step, now.fraction));
        }
        let taken = course.finish().steps.unwrap();
        let ratio = taken as f64 / steps as f64;
        assert!(ratio < most && ratio > 1.0 / most, "{weight} {time}: {taken} of {steps}");
        assert!(seconds > 0.0 && seconds.is_finite());
        // What is said to be done is done, within what the estimate is off by.
        let half = progress.iter().find(|(_, fraction)| *fraction >= 0.5).unwrap().0;
        let share = half as f64 / taken as f64;
        assert!(share > 0.5 / most && share < 0.5 * most, "{weight} {time}: {share}");
    }
}

/// A little that lasts parts them.
#[test]
fn bodies_with_something_left_part() {
    for model in ["fem", "condensed"] {
        let collision = simulation(model, "all", 0.9, "1 us").run(&mut ());
        assert_eq!(collision.ending, Ending::Parted, "{model}");
        assert!(collision.restitution.unwrap() > 0.01, "{model} {:?}", collision.restitution);
    }
}
