//! What is refused, and what is enlarged.

mod common;

use common::{GLASS, Scene, collide, glass, material};
use fem_condensed::{BodyInput, CollideSettings, CondensedError, CondensedPair, PairSettings};
use fem_material::ActsOn::All;

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

#[test]
fn bodies_that_stay_together_are_given_up() {
    let fluid = material(GLASS, All, &[(1.0, 1e10)]);
    let scene = Scene::paper(glass(), glass());
    let pair = scene.condensed(4.0).enlarge(4e-3).unwrap();
    let run = pair.collide(0.5, [fluid.relaxation(); 2], &CollideSettings::default());
    assert!(
        matches!(
            run,
            Err(CondensedError::NoSeparation { .. }
                | CondensedError::ContactBeyondCandidates { .. })
        ),
        "{run:?}"
    );
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
