//! A ball that bounces, put away between two steps and taken up again, is the same ball.

use fem::{Collision, RestartState, Simulation};

use crate::coarse_mesh::simulation_of;

const BALL: &str = include_str!("rubber_ball.toml");
/// Three elements across the first contact.
const COARSE: &str = "mesh={contact_element_size='0.6 mm', refined_radius='1.8 mm'}";
const FEM: &str = "model.fem={}";

fn simulation(set: &[&str]) -> Simulation {
    simulation_of(BALL, set)
}

/// Computes a collision that is stopped after every `n_pieces` advances, stored as bytes and continued by another
/// simulation. Returns it with the number of stops in each contact.
fn in_pieces(overrides: &[&str], n_pieces: usize) -> (Collision, Vec<usize>) {
    let mut n_stops = vec![0; 10];
    let mut stepper = simulation(overrides).start();
    loop {
        for _ in 0..n_pieces {
            if !stepper.advance(&mut ()) {
                return (stepper.finish(), n_stops);
            }
        }
        let n_contacts = simulation(overrides).case().scene().gravity().unwrap().bounces as f64;
        n_stops[(stepper.progress().fraction * n_contacts) as usize] += 1;
        let state = stepper.restart_state().unwrap();
        let bytes = postcard::to_stdvec(&state).unwrap();
        let read: RestartState = postcard::from_bytes(&bytes).unwrap();
        assert_eq!(read, state);
        stepper = simulation(overrides).resume(read).unwrap();
    }
}

/// A ball that is stopped and continued in each contact gives the same rows, snapshots, bounces and energies to the bit.
#[test]
fn a_ball_continues_from_its_restart_state() {
    for more in [
        "output.snapshots=['maximum', 'last-contact']",
        "output.snapshots=['101 ms', '102.5 ms', '1 s']",
        "body.0={name='floor', sphere={diameter='40 mm'}, material='rubber', held=true}",
    ] {
        let overrides = [FEM, COARSE, more];
        let whole = simulation(&overrides).run(&mut ());
        assert_eq!(whole.bounces.len(), 3, "{more}");
        let (resumed, n_stops) = in_pieces(&overrides, 3);
        assert_eq!(resumed, whole, "{more}");
        assert!(n_stops[..3].iter().all(|&n| n > 1), "{n_stops:?}");
    }
}

/// The restart state passes through the model of a transformed scene under gravity.
#[test]
fn a_ball_on_a_rigid_partner_continues_from_its_restart_state() {
    let steel = "material.steel={density=7850, youngs_modulus=210e9, poissons_ratio=0.3}";
    let floor = "body.0={name='floor', sphere={diameter='40 mm'}, material='steel', held=true}";
    let overrides = [FEM, COARSE, steel, floor, "effects.rigid_partner='on'"];
    let whole = simulation(&overrides).run(&mut ());
    assert_eq!(whole.bodies[0].elements, Some(0));
    assert_eq!(in_pieces(&overrides, 11).0, whole);
}

/// The mesh of a late contact that was refined is refined again on restart.
#[test]
fn a_ball_with_a_refined_mesh_continues_from_its_restart_state() {
    let lossy = "material.rubber.relaxation={acts_on='all', \
                 terms=[{weight=0.6, relaxation_time='0.3 ms'}]}";
    let overrides = [FEM, lossy, "mesh.growth=1.35", "accuracy.tolerance='0.3 %'"];
    let whole = simulation(&overrides).run(&mut ());
    let speed = |k: usize| whole.bounces[k].speed_before;
    // The radius goes with v^(2/5): three quarters of it.
    assert!(speed(2) < 0.75_f64.powf(2.5) * speed(0), "{:?}", whole.bounces);
    let (resumed, n_stops) = in_pieces(&overrides, 15);
    assert_eq!(resumed, whole);
    assert!(n_stops[..3].iter().all(|&n| n > 0), "{n_stops:?}");
}

/// A restart state of another ball, of other bounces, of a scene without gravity, or with missing parts is rejected.
#[test]
fn a_restart_state_of_another_ball_is_rejected() {
    let overrides = [FEM, COARSE];
    let own = simulation(&overrides);
    let mut stepper = own.start();
    while stepper.progress().fraction < 0.5 {
        assert!(stepper.advance(&mut ()));
    }
    let state = stepper.restart_state().unwrap();
    assert!(own.resume(state.clone()).is_ok());
    for more in [
        "gravity.acceleration=9.8",
        "stop.bounces=4",
        "start.gap='4 cm'",
        "material.rubber.density=1101",
        "model={condensed={}}",
    ] {
        let other = simulation(&[FEM, COARSE, more]);
        assert!(other.resume(state.clone()).is_err(), "{more}");
    }
    let mut one_contact = serde_json::to_value(&state).unwrap();
    one_contact["bounces"].take();
    assert!(own.resume(serde_json::from_value(one_contact).unwrap()).is_err());
}
