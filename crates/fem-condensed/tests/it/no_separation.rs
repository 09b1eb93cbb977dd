//! Bodies that stay together, and bodies that separate slowly.

use crate::common::{GLASS, Scene, material};
use fem_collision::{
    Collision, Ending, OutputRequest, STAY_TOGETHER, SnapshotInstant, SnapshotRequest, Stop,
    did_not_occur,
};
use fem_condensed::CondensedPair;
use fem_material::ActsOn::{self, All, Shear};

/// One term of this weight and relaxation time (s), given up after so many elastic contact times, with
/// four elements across the elastic contact; the region is made larger when the contact asks for it.
fn collide(
    acts_on: ActsOn,
    weight: f64,
    relaxation_time: f64,
    give_up_after: f64,
) -> (Scene, Collision) {
    let relaxing = material(GLASS, acts_on, &[(weight, relaxation_time.recip())]);
    let scene = Scene::paper(relaxing.clone(), relaxing);
    let mut pair = scene.condensed(4.0);
    loop {
        let frame = pair.frame(scene.speed).unwrap();
        let n_steps = CondensedPair::N_STEPS;
        let request = OutputRequest { give_up_after, ..OutputRequest::quantities() };
        let run = pair.collide(&frame, pair.relaxations(), n_steps, &request, &mut ()).unwrap();
        match run.outgrown_radius() {
            Some(radius) => pair = pair.enlarge(2.0 * radius).unwrap(),
            None => return (scene, run),
        }
    }
}

/// Against Ting's, which knows from its own equations which bodies stay together.
#[test]
fn relaxing_bodies_separate_or_stay_as_in_ting() {
    for acts_on in [All, Shear] {
        for weight in [1.0, 0.999] {
            for relaxation_time in [1e-7, 1e-6, 1e-5, 1e-4] {
                let (scene, run) =
                    collide(acts_on, weight, relaxation_time, OutputRequest::GIVE_UP_AFTER);
                let name = format!("{acts_on:?} {weight} {relaxation_time:e}");
                let found = run.restitution.unwrap_or_else(|| panic!("{name}: {:?}", run.ending));
                let ting = scene.ting(false);
                // Ting's bodies are half-spaces; these have a tenth of their radius in contact.
                let off = (found - ting.restitution).abs();
                assert!(off < 0.015, "{name}: {found} {}", ting.restitution);
                let stays = weight == 1.0 && relaxation_time < 1e-5;
                assert_eq!(run.ending == Ending::Together, stays, "{name}");
                assert_eq!(run.contact_time.is_none(), stays, "{name}");
                assert_eq!(ting.contact_time.is_none(), stays, "{name}");
                assert_eq!(run.warnings.iter().any(|text| text == STAY_TOGETHER), stays, "{name}");
                if stays {
                    assert_eq!(found, 0.0);
                    // The approach has come to its end too.
                    let approach = run.max_approach.unwrap() / ting.max_approach - 1.0;
                    assert!(approach.abs() < 0.1, "{name}: {approach}");
                }
            }
        }
    }
}

/// Nearly nothing is left of the modulus, and what is left parts them, slowly.
#[test]
fn small_equilibrium_modulus_separates_bodies_with_tings_restitution() {
    for (weight, relaxation_time) in [(0.9999, 1e-6), (0.9999, 3e-6)] {
        let (scene, run) = collide(All, weight, relaxation_time, OutputRequest::GIVE_UP_AFTER);
        let ting = scene.ting(false);
        let found = run.restitution.unwrap_or_else(|| panic!("{weight}: {:?}", run.ending));
        let off = (found - ting.restitution).abs();
        assert!(off < 0.05 * ting.restitution, "{weight}: {found} {}", ting.restitution);
        assert!(ting.restitution < 1e-3 || run.ending == Ending::Parted, "{weight}");
    }
}

/// Bodies that neither part nor come to rest within the time that they are given.
#[test]
fn bodies_that_are_too_slow_have_not_separated() {
    // 23 elastic contact times.
    let (_, run) = collide(All, 0.9999, 3e-6, 5.0);
    assert!(matches!(run.stop(), Some(Stop::NoSeparation { .. })), "{:?}", run.ending);
}

/// Bodies that stay in contact have no last contact; the other instants are those of any run.
#[test]
fn bodies_that_stay_have_no_last_contact() {
    let relaxing = material(GLASS, All, &[(1.0, 1e7)]);
    let scene = Scene::paper(relaxing.clone(), relaxing);
    let pair = scene.condensed(4.0).enlarge(2e-3).unwrap();
    let frame = pair.frame(scene.speed).unwrap();
    let snapshots = SnapshotRequest::Labels(SnapshotInstant::ALL.to_vec());
    let request = OutputRequest { snapshots, ..OutputRequest::quantities() };
    let n_steps = CondensedPair::N_STEPS;
    let run = pair.collide(&frame, pair.relaxations(), n_steps, &request, &mut ()).unwrap();
    assert_eq!(run.ending, Ending::Together);
    let labels: Vec<_> = run.snapshots.iter().filter_map(|snapshot| snapshot.label).collect();
    assert_eq!(labels, [SnapshotInstant::MidCompression, SnapshotInstant::Maximum]);
    assert!(
        run.warnings.contains(&did_not_occur(SnapshotInstant::LastContact)),
        "{:?}",
        run.warnings
    );
}
