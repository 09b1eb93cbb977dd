//! Bodies that stay together, and bodies that separate slowly.

use crate::common::{GLASS, Scene, material};
use fem_collision::{Collision, Ending, OutputRequest, STAY_TOGETHER};
use fem_condensed::CondensedPair;
use fem_material::ActsOn::{self, All, Shear};

/// One term of this weight and relaxation time (s), with four elements across the elastic contact; the region is made
/// larger when the contact asks for it.
fn collide(acts_on: ActsOn, weight: f64, relaxation_time: f64) -> (Scene, Collision) {
    let relaxing = material(GLASS, acts_on, &[(weight, relaxation_time.recip())]);
    let scene = Scene::paper(relaxing.clone(), relaxing);
    let mut pair = scene.condensed(4.0);
    loop {
        let frame = pair.frame(scene.speed).unwrap();
        let n_steps = CondensedPair::N_STEPS;
        let request = OutputRequest::quantities();
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
                let (scene, run) = collide(acts_on, weight, relaxation_time);
                let name = format!("{acts_on:?} {weight} {relaxation_time:e}");
                let found = run.restitution.unwrap_or_else(|| panic!("{name}: {:?}", run.ending));
                let ting = scene.ting(false);
                // Ting's bodies are half-spaces; these have a tenth of their radius in contact.
                let off = (found - ting.restitution).abs();
                assert!(off < 0.015, "{name}: {found} {}", ting.restitution);
                assert!(run.residual_relative.unwrap() < 1e-3, "{name}");
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
        let (scene, run) = collide(All, weight, relaxation_time);
        let ting = scene.ting(false);
        let found = run.restitution.unwrap_or_else(|| panic!("{weight}: {:?}", run.ending));
        let off = (found - ting.restitution).abs();
        assert!(off < 0.05 * ting.restitution, "{weight}: {found} {}", ting.restitution);
        assert!(ting.restitution < 1e-3 || run.ending == Ending::Parted, "{weight}");
    }
}
