//! A ball that bounces, put away between two steps and taken up again, is the same ball.

use std::path::Path;

use fem::{Case, Collision, Monitor, Progress, RestartState, Simulation};

const BALL: &str = include_str!("rubber_ball.toml");
/// Three elements across the first contact.
const COARSE: &str = "mesh={contact_element_size='0.6 mm', refined_radius='1.8 mm'}";
const FEM: &str = "model.fem={}";

fn simulation(overrides: &[&str]) -> Simulation {
    let overrides: Vec<String> = overrides.iter().map(ToString::to_string).collect();
    let case = Case::parse("ball.toml", BALL, Path::new("."), &overrides).unwrap();
    Simulation::new(case).unwrap()
}

/// Put away after every so many pieces, as bytes, and taken up again by a simulation of its own;
/// whether it was put away in each of the contacts.
fn in_pieces(overrides: &[&str], n_pieces: usize) -> (Collision, Vec<usize>) {
    let mut n_put_away = vec![0; 10];
    let mut course = simulation(overrides).start();
    loop {
        for _ in 0..n_pieces {
            if !course.advance(&mut ()) {
                return (course.finish(), n_put_away);
            }
        }
        let n_contacts = simulation(overrides).case().scene().gravity().unwrap().bounces as f64;
        n_put_away[(course.progress().fraction * n_contacts) as usize] += 1;
        let memory = course.restart_state().unwrap();
        let bytes = postcard::to_stdvec(&memory).unwrap();
        let read: RestartState = postcard::from_bytes(&bytes).unwrap();
        assert_eq!(read, memory);
        course = simulation(overrides).resume(read).unwrap();
    }
}

/// Rows, snapshots, bounces and books to the bit, put away in each contact.
#[test]
fn a_ball_goes_on_from_its_memory() {
    for more in [
        "output.snapshots=['maximum', 'last-contact']",
        "output.snapshots=['101 ms', '102.5 ms', '1 s']",
        "body.0={name='floor', sphere={diameter='40 mm'}, material='rubber', held=true}",
    ] {
        let overrides = [FEM, COARSE, more];
        let whole = simulation(&overrides).run(&mut ());
        assert_eq!(whole.bounces.len(), 3, "{more}");
        let (resumed, n_put_away) = in_pieces(&overrides, 3);
        assert_eq!(resumed, whole, "{more}");
        assert!(n_put_away[..3].iter().all(|&n| n > 1), "{n_put_away:?}");
    }
}

/// A model around the model: the scene that an effect has left, under gravity.
#[test]
fn a_simplified_ball_goes_on_from_its_memory() {
    let steel = "material.steel={density=7850, youngs_modulus=210e9, poissons_ratio=0.3}";
    let floor = "body.0={name='floor', sphere={diameter='40 mm'}, material='steel', held=true}";
    let overrides = [FEM, COARSE, steel, floor, "effects.rigid_partner='on'"];
    let whole = simulation(&overrides).run(&mut ());
    assert_eq!(whole.bodies[0].elements, Some(0));
    assert_eq!(in_pieces(&overrides, 11).0, whole);
}

/// Elements of a late contact that are made anew are made anew once more.
#[test]
fn a_ball_with_late_elements_goes_on_from_its_memory() {
    let lossy = "material.rubber.relaxation={acts_on='all', \
                 terms=[{weight=0.6, relaxation_time='0.3 ms'}]}";
    let overrides = [FEM, lossy, "mesh.growth=1.35", "accuracy.tolerance='0.3 %'"];
    let whole = simulation(&overrides).run(&mut ());
    let speed = |k: usize| whole.bounces[k].speed_before;
    // The radius goes with v^(2/5): three quarters of it.
    assert!(speed(2) < 0.75_f64.powf(2.5) * speed(0), "{:?}", whole.bounces);
    let (resumed, n_put_away) = in_pieces(&overrides, 15);
    assert_eq!(resumed, whole);
    assert!(n_put_away[..3].iter().all(|&n| n > 0), "{n_put_away:?}");
}

/// Of another ball, of one that bounces otherwise, of one without gravity; contradicting itself.
#[test]
fn a_memory_of_another_ball_is_refused() {
    let overrides = [FEM, COARSE];
    let own = simulation(&overrides);
    let mut course = own.start();
    while course.progress().fraction < 0.5 {
        assert!(course.advance(&mut ()));
    }
    let memory = course.restart_state().unwrap();
    assert!(own.resume(memory.clone()).is_ok());
    for more in [
        "gravity.acceleration=9.8",
        "stop.bounces=4",
        "start.gap='4 cm'",
        "material.rubber.density=1101",
        "model={condensed={}}",
    ] {
        let other = simulation(&[FEM, COARSE, more]);
        assert!(other.resume(memory.clone()).is_err(), "{more}");
    }
    let mut one_contact = serde_json::to_value(&memory).unwrap();
    one_contact["bounces"].take();
    assert!(own.resume(serde_json::from_value(one_contact).unwrap()).is_err());
}

/// Told of in the time of the case, and stopped in a later contact: the beginning of the whole.
#[test]
fn a_ball_that_is_left_keeps_its_bounces() {
    struct Until(f64);
    impl Monitor for Until {
        fn report(&mut self, progress: Progress) -> bool {
            progress.time < self.0
        }
    }
    let simulation = simulation(&[FEM, COARSE]);
    let whole = simulation.run(&mut ());
    let part = simulation.run(&mut Until(whole.bounces[1].time + 1e-4));
    assert!(part.is_interrupted(), "{:?}", part.ending);
    assert_eq!(part.bounces, whole.bounces[..1]);
    assert!(part.history.last().unwrap().time > whole.bounces[1].time);
}
