//! The quantities of a collision do not depend on whether its history is kept.

use crate::common::{GLASS, Scene, glass, material};
use fem_collision::{
    Approach, Collision, Frame, OutputRequest, SnapshotInstant, SnapshotRequest, did_not_occur,
};
use fem_condensed::{CondensedPair, ContactModel, PairSettings};
use fem_material::ActsOn::{All, Shear};
use fem_material::Material;

/// With modes of vibration, with springs.
const KINDS: [(usize, bool); 3] = [(0, false), (4, false), (0, true)];

fn pair(scene: &Scene, vibration_modes: usize, has_springs: bool) -> CondensedPair {
    let contact = match has_springs {
        true => ContactModel::Springs(scene.pair().contact_modulus()),
        false => ContactModel::Exact,
    };
    // Bodies that stay together have a wide contact.
    let candidate_radius = 2.5 * scene.hertz().max_contact_radius();
    let settings = PairSettings { candidate_radius, contact, vibration_modes, ..scene.settings() };
    CondensedPair::new(scene.inputs(4.0), settings).unwrap()
}

/// With so many rows, and fields at every named instant.
fn collide(pair: &CondensedPair, frame: &Frame, history_rows: usize) -> Collision {
    let snapshots = SnapshotRequest::Labels(SnapshotInstant::OF_CONTACT.to_vec());
    let request = OutputRequest { history_rows, snapshots, ..OutputRequest::quantities() };
    let n_steps = CondensedPair::N_STEPS;
    pair.collide(frame, pair.relaxations(), n_steps, &request, &mut ()).unwrap()
}

/// Exact bits: `==` of numbers that are the same is what `Collision` has, none of them NaN.
#[test]
fn quantities_are_those_of_a_run_with_a_history() {
    let terms = [(0.3, 1e4), (0.2, 1e6)];
    let relaxing = |acts_on| material(GLASS, acts_on, &terms);
    // The last one stays together.
    let glasses: [Material; 4] =
        [glass(), relaxing(All), relaxing(Shear), material(GLASS, All, &[(1.0, 2e5)])];
    for (k, glass) in glasses.into_iter().enumerate() {
        let scene = Scene::paper(glass.clone(), glass);
        for (vibration_modes, has_springs) in KINDS {
            let pair = pair(&scene, vibration_modes, has_springs);
            // Both move, and begin apart.
            let approach = Approach::new([0.4, -0.1], 1e-6).unwrap();
            let frame = Frame { approach, ..pair.frame(scene.speed).unwrap() };
            let none = collide(&pair, &frame, 0);
            let name = format!("glass {k}, {vibration_modes} modes, springs: {has_springs}");
            assert!(none.history.is_empty(), "{name}");
            assert!(none.is_complete(), "{name}: {:?}", none.ending);
            assert_eq!(none.restitution == Some(0.0), k == 3, "{name}");
            for rows in [1, OutputRequest::ROWS] {
                let with = collide(&pair, &frame, rows);
                let last = with.history.last().unwrap();
                assert_eq!((none.energies, none.residual), (last.energies, last.residual));
                assert_eq!(none, Collision { history: Vec::new(), ..with }, "{name}, {rows} rows");
            }
            assert!(none.force_scatter.is_some_and(|scatter| scatter.is_finite()), "{name}");
            // Bodies that stay together have neither mid-separation nor last contact.
            let labels: Vec<_> = none.snapshots.iter().filter_map(|one| one.label).collect();
            assert_eq!(labels, SnapshotInstant::OF_CONTACT[..if k == 3 { 2 } else { 4 }], "{name}");
            let missing = did_not_occur(SnapshotInstant::LastContact);
            assert_eq!(none.warnings.contains(&missing), k == 3, "{name}");
        }
    }
}

/// The impulse of the contact force is the momentum that the bodies exchange; a wall's too.
#[test]
fn the_impulse_is_the_momentum_that_is_exchanged() {
    let relaxing = material(GLASS, Shear, &[(0.5, 1e4)]);
    let spheres = Scene::paper(relaxing.clone(), relaxing.clone());
    let wall = Scene { bodies: [None, Some((15.9e-3, relaxing))], speed: 0.5 };
    for scene in [spheres, wall] {
        let pair = scene.condensed(4.0);
        let run = scene.collide(&pair);
        // Two sums over some 240 steps of what the steps did: rounding.
        let residual = run.momentum_residual_relative.unwrap();
        assert!(residual > 0.0 && residual < 1e-14, "{residual}");
    }
}
