//! A ball that bounces, put away between two steps and taken up again, is the same ball.

use fem_collision::Collision;
use fem_simulation::{RestartState, Simulation};

use crate::scene::{RUBBER_BALL as BALL, simulation_of};

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

/// A ball that is stopped and continued in each contact gives the same rows, snapshots, bounces and energies to the bit:
/// also through the model of a transformed scene, and where the mesh of a late contact was refined.
#[test]
fn a_ball_continues_from_its_restart_state() {
    let steel = "material.steel={density=7850, youngs_modulus=210e9, poissons_ratio=0.3}";
    let on_steel = "body.0={name='floor', sphere={diameter='40 mm'}, material='steel', held=true}";
    let on_rubber =
        "body.0={name='floor', sphere={diameter='40 mm'}, material='rubber', held=true}";
    let lossy = "material.rubber.relaxation={acts_on='all', \
                 terms=[{weight=0.6, relaxation_time='0.3 ms'}]}";
    for (more, n_pieces) in [
        (&[COARSE, "output.snapshots=['maximum', 'last-contact']"][..], 3),
        (&[COARSE, "output.snapshots=['101 ms', '102.5 ms', '1 s']"], 3),
        (&[COARSE, on_rubber], 3),
        // It sticks at the third landing.
        (&[COARSE, "contact.work_of_adhesion='240 J/m^2'"], 3),
        (&[COARSE, steel, on_steel, "effects.rigid_partner='on'"], 3),
        (&[lossy, "mesh.growth=1.35", "accuracy.tolerance='0.3 %'"], 15),
    ] {
        let overrides = [&[FEM], more].concat();
        let whole = simulation(&overrides).run(&mut ());
        assert_eq!(whole.bounces.len(), 3, "{more:?}");
        assert_eq!(whole.bodies[0].elements.is_some_and(|n| n > 0), more.contains(&on_rubber));
        let (resumed, n_stops) = in_pieces(&overrides, n_pieces);
        assert_eq!(resumed, whole, "{more:?}");
        let is_stuck = more.iter().any(|set| set.contains("adhesion"));
        let sticks = whole.bounces.iter().map(|bounce| bounce.restitution == 0.0);
        assert_eq!(sticks.collect::<Vec<_>>(), [false, false, is_stuck], "{:?}", whole.bounces);
        assert!(n_stops[..3].iter().all(|&n| n > 0), "{n_stops:?}");
        if more[0] == lossy {
            // The radius goes with v^(2/5): three quarters of it.
            let speed = |k: usize| whole.bounces[k].speed_before;
            assert!(speed(2) < 0.75_f64.powf(2.5) * speed(0), "{:?}", whole.bounces);
        }
    }
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
