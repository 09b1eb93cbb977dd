//! What is refused, and what is enlarged.

mod common;

use common::{GLASS, Scene, collide, glass, material};
use fem_condensed::{
    BodyInput, CollideSettings, CondensedError, CondensedPair, Ending, PairSettings,
};
use fem_material::ActsOn::{All, Shear};

#[test]
fn a_contact_beyond_the_candidates_is_told_and_enlarged() {
    let scene = Scene::paper(glass(), glass());
    let pair = scene.condensed(8.0);
    let fast = pair.collide(5.0, [None; 2], &CollideSettings::default());
    assert!(matches!(fast, Err(CondensedError::ContactBeyondCandidates { .. })), "{fast:?}");
    let larger = pair.enlarge(4.0 * pair.candidate_radius()).unwrap();
    let run = collide(&larger, 5.0, &CollideSettings::default());
    // Hertz' 25.1 µs·√… less the finite size: 39.1 µs at this speed.
    assert!((run.contact_time / 39.1e-6 - 1.0).abs() < 0.01, "{}", run.contact_time);
    // What the smaller one could do, the larger one does as well.
    let (a, b) = (scene.collide(&pair), scene.collide(&larger));
    assert!((a.contact_time / b.contact_time - 1.0).abs() < 1e-9);
    // The hemisphere has an end.
    let whole = larger.enlarge(1.0).unwrap();
    assert!(matches!(whole.enlarge(2.0), Err(CondensedError::ContactTooLarge { .. })));
}

#[test]
fn impossible_inputs_are_refused() {
    let scene = Scene::paper(glass(), glass());
    let pair = scene.condensed(4.0);
    let with = |speed: f64, settings: &CollideSettings| pair.collide(speed, [None; 2], settings);
    for speed in [0.0, -1.0, f64::INFINITY, f64::NAN] {
        let refused = with(speed, &CollideSettings::default());
        assert!(matches!(refused, Err(CondensedError::NotApproaching(_))));
    }
    let few = CollideSettings { n_steps: 3, ..Default::default() };
    assert!(matches!(with(0.5, &few), Err(CondensedError::Setting { .. })));
    let walls = [BodyInput::Wall, BodyInput::Wall];
    let refused = CondensedPair::new(walls, PairSettings::new(1e-3));
    assert!(matches!(refused, Err(CondensedError::Contact(_))));
    for radius in [0.0, -1.0, f64::NAN] {
        let refused = CondensedPair::new(scene.inputs(4.0), PairSettings::new(radius));
        assert!(matches!(refused, Err(CondensedError::Contact(_))));
    }
}

/// What relaxes completely within the contact keeps nothing that could part the bodies, whichever
/// moduli relax: the restitution is 0, or nearly.
#[test]
fn bodies_that_stay_together() {
    let scene = Scene::paper(glass(), glass());
    let pair = scene.condensed(4.0).enlarge(4e-3).unwrap();
    let settings = CollideSettings { history: true, ..Default::default() };
    for (acts_on, rate) in [(All, 1e6), (Shear, 1e6), (Shear, 3e5)] {
        let fluid = material(GLASS, acts_on, &[(1.0, rate)]);
        let run = pair.collide(0.5, [fluid.relaxation(); 2], &settings).unwrap();
        assert!(run.restitution < 1e-4, "{acts_on:?} {rate:e} {}", run.restitution);
        if acts_on == All {
            assert_eq!((run.ending.clone(), run.restitution), (Ending::Together, 0.0));
        }
        assert!(run.residual_relative < 1e-3, "{}", run.residual_relative);
        // A stiff fluid flows deeper than elastic bodies are pressed.
        assert!(run.max_approach > 11e-6 && run.max_approach < 1e-4, "{}", run.max_approach);
        assert!(run.history.len() < 5000);
    }
}

/// A run that does not end keeps what it has.
#[test]
fn a_stopped_run_keeps_what_it_has() {
    let scene = Scene::paper(glass(), glass());
    let pair = scene.condensed(4.0);
    let settings = CollideSettings { history: true, ..Default::default() };
    let mut glances = 0;
    let run = pair.follow(0.5, [None; 2], &settings, &mut |glance| {
        glances += 1;
        assert!(glance.fraction > 0.0 && glance.fraction < 1.0);
        glances < 2
    });
    let run = run.unwrap();
    let Ending::Stopped(CondensedError::Interrupted { steps, .. }) = run.ending else {
        panic!("{:?}", run.ending);
    };
    assert!(run.steps == steps && run.history.len() == steps + 1 && run.max_approach > 9e-6);
    let brief = CollideSettings { give_up_after: 0.4, ..settings };
    assert!(matches!(
        pair.collide(0.5, [None; 2], &brief),
        Err(CondensedError::NoSeparation { .. })
    ));
}

/// Modes that the mesh cannot carry are left out; with those that it can, energy adds up.
#[test]
fn only_modes_that_the_mesh_resolves() {
    let scene = Scene::paper(glass(), glass());
    for (elements, most) in [(0.25, 12), (4.0, 30)] {
        let settings = PairSettings { vibration_modes: 100, ..scene.settings() };
        let settings = PairSettings { candidate_radius: 1.2e-3, ..settings };
        let pair = CondensedPair::new(scene.inputs(elements), settings).unwrap();
        let counts = pair.frequencies().map(<[f64]>::len);
        assert!(counts.iter().all(|&n| n > 0 && n < most), "{elements}: {counts:?}");
        let run = collide(&pair, 0.5, &CollideSettings::default());
        assert!(run.restitution < 1.0 + 1e-6 && run.residual_relative < 1e-4);
    }
}

/// One pair serves any number of threads.
#[test]
fn a_pair_is_shared() {
    fn is_shared<T: Send + Sync>(_: &T) {}
    let scene = Scene::paper(glass(), glass());
    let pair = scene.condensed(4.0);
    is_shared(&pair);
    let alone = scene.collide(&pair);
    std::thread::scope(|scope| {
        let runs: Vec<_> = (0..4).map(|_| scope.spawn(|| scene.collide(&pair))).collect();
        for run in runs {
            assert_eq!(run.join().unwrap(), alone);
        }
    });
}
