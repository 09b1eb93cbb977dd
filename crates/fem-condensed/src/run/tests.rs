//! Runs whose motion is modified, because no case is known that stops in this way by itself.

use fem_collision::BodyInput;
use fem_material::{ElasticModuli, Material};
use fem_mesh::{HalfDisc, Side};

use super::*;
use crate::settings::PairSettings;

/// Approximate elastic contact time of the pair, s.
const CONTACT_TIME: f64 = 68e-6;
const N_STEPS: usize = 200;

/// A glass sphere of 22.2 mm on a wall.
fn pair() -> CondensedPair {
    let moduli = ElasticModuli::from_youngs_modulus_poissons_ratio(63e9, 0.244).unwrap();
    let disc = HalfDisc {
        radius: 11.1e-3,
        contact_element_size: 60e-6,
        refined_radius: 0.45e-3,
        growth: None,
    };
    let mesh = disc.build().unwrap().on_side(Side::Below);
    let material = Material::new(2390.0, moduli, None).unwrap();
    let bodies = [BodyInput::Sphere { mesh, material }, BodyInput::Wall];
    CondensedPair::new(bodies, PairSettings::new(0.55e-3)).unwrap()
}

/// Runs a collision whose motion is modified after a third of the contact.
fn disturbed(disturb: impl FnOnce(&mut ImpactMotion<'_>)) -> Collision {
    let (pair, request) = (pair(), OutputRequest::history());
    let frame = pair.frame(0.5).unwrap();
    pair.prepare(0.5, pair.relaxations()).unwrap();
    let n_points = pair.points.len();
    let time_step = CONTACT_TIME / N_STEPS as f64;
    let motion =
        ImpactMotion::new(&pair, 0.5, pair.relaxations().into(), time_step, n_points).unwrap();
    let mut run = ImpactRun::new(&pair, motion, &frame, &request, N_STEPS, CONTACT_TIME);
    run.record();
    for _ in 0..N_STEPS / 3 {
        assert_eq!(run.advance(&mut ()), Ok(None));
    }
    disturb(&mut run.motion);
    let ending = loop {
        match run.advance(&mut ()) {
            Ok(None) => {}
            Ok(Some(ending)) => break ending,
            Err(stop) => break Ending::Stopped(stop),
        }
    };
    run.finish(ending).collision
}

/// Returns whether a stopped run has its history and force until then, but no restitution.
fn is_kept_so_far(collision: &Collision) -> bool {
    collision.restitution.is_none()
        && collision.contact_time.is_none()
        && collision.peak_force_raw.is_some_and(|force| force > 0.0)
        && collision.history.len() > N_STEPS / 10
}

#[test]
fn added_energy_stops_the_condensed_run() {
    let run = disturbed(|motion| motion.rate *= 1.5);
    let Some(&Stop::EnergyImbalance { time, relative }) = run.stop() else { panic!("{run:?}") };
    assert!(relative > LARGEST_IMBALANCE && relative < 1.5, "{relative}");
    assert!(time > 0.3 * CONTACT_TIME && time < 0.4 * CONTACT_TIME, "{time}");
    assert!(is_kept_so_far(&run));
}

#[test]
fn motion_with_nan_stops_the_condensed_run() {
    let run = disturbed(|motion| motion.rate = f64::NAN);
    assert!(matches!(run.stop(), Some(Stop::NoContactState { .. })), "{:?}", run.ending);
    assert!(is_kept_so_far(&run));
}

/// Without a modification the run ends normally.
#[test]
fn undisturbed_bodies_part() {
    let run = disturbed(|_| {});
    assert_eq!(run.ending, Ending::Parted);
    assert!((run.restitution.unwrap() - 1.0).abs() < 1e-4, "{:?}", run.restitution);
}
