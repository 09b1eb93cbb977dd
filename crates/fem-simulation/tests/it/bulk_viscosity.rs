//! Bulk viscosity: its switch, and scenes with ringing springs that call for it.

use fem_collision::{Account, Approach, OutputRequest};
use fem_simulation::Simulation;

use crate::scene::{coarse_glass as simulation, decision_on};

/// 65 m/s is the limit, a fiftieth of the shear wave speed.
const SLOW: &str = "body.0.approach_speed='60 m/s'";
const FAST: &str = "body.0.approach_speed='80 m/s'";
const ON: &str = "effects.bulk_viscosity='on'";
const OFF: &str = "effects.bulk_viscosity='off'";
const PENALTY: &str = "contact.method='penalty'";
/// A coarse mesh for such speeds.
const MESH: &str = "mesh={contact_element_size='0.4 mm', refined_radius='1.6 mm'}";
/// Contact at small strain has no damping of its own.
const SMALL: &str = "effects.finite_strain='off'";
/// Identical bodies, of which one is computed.
const TWINS: &str = "body.1.sphere.diameter='22.2 mm'";

fn fem(overrides: &[&str]) -> Simulation {
    simulation("fem", &[&[MESH, PENALTY], overrides, &[SMALL]].concat())
}

/// Returns the work of bulk viscosity, J; `None` if the run has none.
fn work(simulation: &Simulation) -> Option<f64> {
    simulation.run(&mut ()).energies.get(Account::BulkViscosity)
}

#[test]
fn a_fast_scene_calls_for_it_and_a_switch_is_obeyed() {
    for (speed, switch, expected, reason) in [
        (SLOW, "effects={}", false, "too slow for steep fronts"),
        (FAST, "effects={}", true, "0.025"),
        (SLOW, ON, true, "forced on"),
        (FAST, OFF, false, "switched off"),
    ] {
        for bodies in ["start={}", TWINS] {
            let simulation = fem(&[speed, switch, bodies]);
            let decision = decision_on(&simulation, "bulk viscosity");
            assert_eq!(decision.active, expected, "{speed} {switch} {bodies}: {decision:?}");
            assert!(decision.reason.contains(reason), "{decision:?}");
            let warnings = simulation.setup().warnings();
            let warned = warnings.iter().any(|warning| warning.contains("steep fronts ring"));
            assert_eq!(warned, (speed, switch) == (FAST, OFF), "{warnings:?}");
            let work = work(&simulation);
            assert_eq!(work.is_some(), expected, "{speed} {switch} {bodies}");
            assert!(work.is_none_or(|work| work > 0.0), "{work:?}");
        }
    }
}

/// At another approach speed the model decides again, and the decisions on the collision agree.
#[test]
fn another_approach_has_its_own_decision() {
    for bodies in ["start={}", TWINS] {
        let simulation = fem(&[SLOW, bodies]);
        let request = OutputRequest {
            snapshots: fem_collision::SnapshotRequest::none(),
            ..OutputRequest::quantities()
        };
        for (speed, expected) in [(60.0, false), (80.0, true)] {
            let approach = Approach::at(speed).unwrap();
            let collision = simulation.model().collide(&approach, &request, &mut ());
            assert_eq!(collision.energies.has(Account::BulkViscosity), expected, "{speed}");
            let decisions = simulation.decisions(&collision);
            let own = decisions.all.iter().find(|decision| decision.name == "bulk viscosity");
            assert_eq!(own.unwrap().active, expected);
        }
    }
}

/// Half of a scene has the same viscosity at half of the speed.
#[test]
fn mirrored_bulk_viscosity_equals_that_of_the_full_pair() {
    let whole = fem(&[FAST, TWINS, "effects.mirror_symmetry='off'"]).run(&mut ());
    let mirrored = fem(&[FAST, TWINS]).run(&mut ());
    assert_eq!(mirrored.steps, whole.steps);
    assert_eq!(mirrored.element_updates.map(|n| 2 * n), whole.element_updates);
    let [a, b] = [&mirrored, &whole].map(|c| c.energies.get(Account::BulkViscosity).unwrap());
    // Contact that opens and closes amplifies rounding.
    assert!((a / b - 1.0).abs() < 1e-6, "{a:e} {b:e}");
    let [a, b] = [&mirrored, &whole].map(|collision| collision.restitution.unwrap());
    assert!((a - b).abs() < 1e-6, "{a} {b}");
}

/// Off gives the same bits as absent, without a key in summary and history.
#[test]
fn bulk_viscosity_off_equals_absent_to_the_bit() {
    let [absent, off, on] = ["effects={}", OFF, ON].map(|switch| {
        let simulation = fem(&[SLOW, switch]);
        let collision = simulation.run(&mut ());
        let energy = serde_json::to_value(simulation.summary(&collision).energy).unwrap();
        let scene = simulation.case().scene();
        let columns = fem_simulation::results::history_columns(scene, &collision.history);
        let last = columns.last().unwrap().0.clone();
        let has_key = energy.get("bulk_viscosity_j").is_some_and(|work| work.as_f64() > Some(0.0));
        (collision, has_key, last == "bulk_viscosity_j")
    });
    assert_eq!(absent, off);
    assert!(!off.1 && !off.2 && on.1 && on.2);
    assert!(on.0.steps > off.0.steps);
}
