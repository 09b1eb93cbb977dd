//! Bodies that relax completely stay together in every model.

use fem_case::Case;
use fem_collision::{Ending, OutputRequest, STAY_TOGETHER, SnapshotInstant};
use fem_laws::MIN_RESTITUTION;
use fem_simulation::{Cost, Simulation};

use crate::scene::{GLASS, case_of};

fn simulation(model: &str, acts_on: &str, weight: f64, time: &str) -> Simulation {
    Simulation::new(case(model, acts_on, weight, time)).unwrap()
}

fn case(model: &str, acts_on: &str, weight: f64, time: &str) -> Case {
    let overrides = [
        format!("model.{model}={{}}"),
        "mesh.contact_element_size='0.2 mm'".to_string(),
        "mesh.refined_radius='0.6 mm'".to_string(),
        format!(
            "material.glass.relaxation={{acts_on='{acts_on}', terms=[{{weight={weight}, \
             relaxation_time='{time}'}}]}}"
        ),
    ];
    case_of(GLASS, &overrides)
}

#[test]
fn a_collision_without_separation_is_complete() {
    for model in ["fem", "condensed"] {
        for acts_on in ["all", "shear"] {
            for time in ["0.1 us", "1 us"] {
                let name = format!("{model} {acts_on} {time}");
                let simulation = simulation(model, acts_on, 1.0, time);
                let collision = simulation.run(&mut ());
                assert_eq!(collision.ending, Ending::Together, "{name}");
                assert_eq!(collision.restitution, Some(0.0), "{name}");
                assert_eq!(collision.contact_time, None, "{name}");
                // Both bodies keep the speed of their mass centre; ρ cancels.
                let cubes = [22.2_f64, 15.9].map(|diameter| diameter.powi(3));
                let common = 0.5 * cubes[0] / (cubes[0] + cubes[1]);
                for body in &collision.bodies {
                    let after = body.velocity_after.unwrap();
                    assert!((after / common - 1.0).abs() < 1e-3, "{name}: {after} {common}");
                }
                // The largest approach is at the end, half of it on the way.
                for label in [SnapshotInstant::MidCompression, SnapshotInstant::Maximum] {
                    assert!(collision.snapshot(label).is_some(), "{name} {label:?}");
                }
                let summary = simulation.summary(&collision);
                assert!(summary.complete && summary.stopped_because.is_none(), "{name}");
                assert!(summary.warnings.iter().any(|text| text == STAY_TOGETHER), "{name}");
            }
        }
    }
}

/// Faster relaxing bodies come to rest later, here in up to three hundred elastic contact times. If they would flow
/// into each other, all models reject them with the same message.
#[test]
fn flowing_bodies_have_the_same_result_in_all_models() {
    for (acts_on, times) in
        [("all", ["1 us", "0.2 us", "0.05 us"]), ("shear", ["3 us", "1 us", "0.2 us"])]
    {
        for time in times {
            for model in ["ting", "condensed", "auto"] {
                let simulation = simulation(model, acts_on, 1.0, time);
                let collision = simulation.run(&mut ());
                assert_eq!(collision.ending, Ending::Together, "{model} {acts_on} {time}");
                assert_eq!(collision.restitution, Some(0.0), "{model} {acts_on} {time}");
            }
        }
    }
    for time in ["1 ns", "0.1 ns", "1e-6 ns"] {
        let refused = ["ting", "condensed", "fem", "auto"].map(|model| {
            let error = Simulation::new(case(model, "all", 1.0, time)).err();
            error.unwrap_or_else(|| panic!("{model} {time}")).to_string()
        });
        assert!(refused[0].contains("flow into each other"), "{}", refused[0]);
        assert!(refused.iter().all(|one| *one == refused[0]), "{refused:?}");
    }
    // With an equilibrium stiffness they act as soft bodies.
    let soft = simulation("ting", "all", 0.9999, "1 ns").run(&mut ());
    assert!(soft.restitution.unwrap() > 0.5, "{:?}", soft.restitution);
}

/// A ball of glass on a steel plate that takes 0.999 of its speed if it is 0.2 mm thick.
const FOIL: &str = r#"
    material.glass = { density = 2500, youngs_modulus = "70 GPa", poissons_ratio = 0.23, elastic = true }
    material.steel = { density = 7850, youngs_modulus = "206 GPa", poissons_ratio = 0.29, elastic = true }
    body = [{ name = "foil", plate.thickness = "0.203 mm", material = "steel" },
            { name = "ball", sphere.diameter = "4 mm", material = "glass", approach_speed = 0.1 }]"#;

/// Bodies that part with more than a thousandth of their speed have a contact time in every model, slower ones in none.
#[test]
fn all_models_have_the_same_least_restitution() {
    let relaxing = ["ting", "condensed", "fem"]
        .map(|model| [0.99994, 0.99996].map(|weight| case(model, "all", weight, "3 us")));
    let on_foil = ["hertz={}", "ting={}", "condensed={}", "law.hertz={}"].map(|model| {
        ["0.203 mm", "0.199 mm"].map(|thickness| {
            let thickness = format!("body.0.plate.thickness='{thickness}'");
            case_of(FOIL, &[format!("model.{model}"), thickness])
        })
    });
    // Its closed form has ζ of 15 and 17: e is 1.1e-3 and 0.9e-3.
    let linear = [15.0, 17.0].map(|ratio| {
        // With the reduced mass in kg.
        let damping = 2.0 * ratio * (1e7_f64 * 3.6787e-3).sqrt();
        case_of(GLASS, &[format!("model.law.linear={{ k=1e7, c={damping} }}")])
    });
    for [above, below] in relaxing.into_iter().chain(on_foil).chain([linear]) {
        let name = above.scene().model().path();
        let [above, below] = [above, below].map(|case| Simulation::new(case).unwrap().run(&mut ()));
        let restitution = above.restitution.unwrap();
        assert!((MIN_RESTITUTION..1.5e-3).contains(&restitution), "{name}: {restitution}");
        assert_eq!(
            (&above.ending, above.contact_time.is_some()),
            (&Ending::Parted, true),
            "{name}"
        );
        assert_eq!((below.restitution, below.contact_time), (Some(0.0), None), "{name}");
        assert_eq!(below.ending, Ending::Together, "{name}");
        assert!(below.warnings.iter().any(|text| text == STAY_TOGETHER), "{name}");
    }
}

/// The time limit of a run follows from its predicted duration.
#[test]
fn runs_wait_for_the_predicted_duration() {
    let elastic = simulation("condensed", "all", 1e-3, "1 ms");
    assert_eq!(elastic.request().max_contact_times, OutputRequest::MAX_CONTACT_TIMES);
    let times = ["0.2 us", "0.05 us"].map(|time| simulation("condensed", "all", 1.0, time));
    let [early, late] = times.each_ref().map(|simulation| simulation.request().max_contact_times);
    assert!(early > OutputRequest::MAX_CONTACT_TIMES && late > early, "{early} {late}");
}

/// The number of steps is predicted for bodies that separate late and for those that stay together: within a half, and
/// within a quarter if Ting's contact time gives it, on a mesh with three elements across the contact.
#[test]
fn the_steps_of_a_relaxing_contact_are_predicted() {
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
        let mut stepper = simulation.start();
        while stepper.advance(&mut ()) {
            let now = stepper.progress();
            progress.push((now.step, now.fraction));
        }
        let taken = stepper.finish().steps.unwrap();
        let ratio = taken as f64 / steps as f64;
        assert!(ratio < most && ratio > 1.0 / most, "{weight} {time}: {taken} of {steps}");
        assert!(seconds > 0.0 && seconds.is_finite());
        // The reported progress is right within the error of the estimate.
        let half = progress.iter().find(|(_, fraction)| *fraction >= 0.5).unwrap().0;
        let share = half as f64 / taken as f64;
        assert!(share > 0.5 / most && share < 0.5 * most, "{weight} {time}: {share}");
    }
}
