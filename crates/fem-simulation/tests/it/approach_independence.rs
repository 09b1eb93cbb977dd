//! A model computes its bodies at any approach, and a collision does not depend on earlier ones.

use std::path::Path;

use fem_case::Case;
use fem_collision::{Approach, Collision, OutputRequest, SnapshotRequest, Stop};
use fem_simulation::{METHODS, Simulation};

use crate::scene::coarse_glass as simulation;

/// Returns an approach so fast that the contact outgrows its first candidate region.
fn fast() -> Approach {
    Approach::new([4.0, -2.0], 2e-6).unwrap()
}

/// Returns a collision without its fields.
fn plain(collision: &Collision) -> Collision {
    Collision { snapshots: Vec::new(), ..collision.clone() }
}

/// The summary of a collision at another approach belongs to that approach, and its resolved case gives the same
/// collision to the bit.
#[test]
fn a_summary_belongs_to_its_approach() {
    let twins = &["body.1.sphere.diameter='22.2 mm'"][..];
    for (method, more) in METHODS.iter().flat_map(|method| [(method, &[][..]), (method, twins)]) {
        let slow = simulation(method.name(), more);
        for approach in [Approach::new([1.0, -0.5], 1e-6), Approach::at(0.05), Ok(fast())] {
            let approach = approach.unwrap();
            let name = format!("{} {more:?} {approach:?}", method.name());
            let collision = slow.model().collide(&approach, &OutputRequest::history(), &mut ());
            let resolved = slow.resolved_at(&approach).to_toml().unwrap();
            let case = Case::parse("again.toml", &resolved, Path::new("."), &[]).unwrap();
            let again = Simulation::new(case).unwrap();
            let again = again.with_output_request(OutputRequest::history()).unwrap();
            let expected = again.run(&mut ());
            assert_eq!(plain(&collision), plain(&expected), "{name}");
            let values = |simulation: &Simulation, collision: &Collision| {
                serde_json::to_value(simulation.summary(collision)).unwrap()
            };
            let (found, expected) = (values(&slow, &collision), values(&again, &expected));
            // The resolved case names the chosen model and has every default.
            let of_choice =
                |key: &&String| !["models_considered", "made_from"].contains(&key.as_str());
            assert_ne!(found["made_from"], fem_simulation::case_identity(slow.case()), "{name}");
            for key in found.as_object().unwrap().keys().filter(of_choice) {
                let value = &found[key];
                assert_eq!(value, &expected[key], "{name}: {key}");
            }
            let strain =
                slow.warnings(&collision).iter().any(|w| w.contains("elastic laws differ"));
            assert_eq!(strain, approach == fast(), "{name}");
        }
    }
}

/// A request that no run could keep is rejected, and a model stops at once.
#[test]
fn an_impossible_request_is_rejected() {
    for method in METHODS {
        let simulation = simulation(method.name(), &[]);
        for request in [
            OutputRequest { history_rows: usize::MAX, ..OutputRequest::history() },
            OutputRequest {
                snapshots: SnapshotRequest::Count(usize::MAX),
                ..OutputRequest::history()
            },
            OutputRequest {
                snapshots: SnapshotRequest::Times(vec![f64::NAN]),
                ..OutputRequest::history()
            },
        ] {
            let approach = simulation.setup().approach;
            let collision = simulation.model().collide(&approach, &request, &mut ());
            assert!(matches!(collision.stop(), Some(Stop::NotMade(_))), "{}", method.name());
            assert!(simulation.clone().with_output_request(request).is_err());
        }
    }
}
