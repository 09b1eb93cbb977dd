//! The massless boundary: no energy is gained at any stiffness. See also `collision.rs`.

use crate::common::{Pair, quantities};
use fem_collision::{BodyInput, Ending};
use fem_explicit::{ExplicitBodies, SmallStrainContact};

fn coarse() -> Pair {
    Pair { method: SmallStrainContact::Massless, ..Pair::coarse() }
}

/// For any stiffness the step stays the same, to the bit, and no energy is gained. The softest springs let the
/// spheres overlap by some of their contact radius.
#[test]
fn massless_step_and_energy_are_independent_of_stiffness() {
    let step = coarse().model().time_step();
    for penalty_factor in [1e-3, 1e-2, 0.1, 10.0, 1e2, 1e3, 1e4] {
        let pair = match penalty_factor < 0.1 {
            true => Pair { max_time: 2e-3, candidate_radius: 1.2e-3, ..coarse() },
            false => coarse(),
        };
        let pair = Pair { penalty_factor, ..pair };
        let model = pair.model();
        assert!(penalty_factor < 0.1 || model.time_step() == step);
        let run = pair.run_model(&model);
        assert_eq!(run.ending, Ending::Parted, "{penalty_factor:e}");
        let found = quantities(&run);
        assert!(found.restitution < 1.0 + 1e-9, "{penalty_factor:e}: {}", found.restitution);
        assert!(found.residual < 2e-5, "{penalty_factor:e}: {:e}", found.residual);
        let noise = run.force_scatter.unwrap() / found.peak_force;
        assert!(noise < 2e-3, "{penalty_factor:e}: {noise:e}");
        if penalty_factor > 1.0 {
            // Ever stiffer springs come to contact without overlap.
            assert!((found.contact_time / 62.818e-6 - 1.0).abs() < 0.01);
            assert!((found.peak_force / 107.99 - 1.0).abs() < 0.02, "{}", found.peak_force);
        }
    }
}

/// A rigid sphere has the same mass and step with any springs.
#[test]
fn massless_rigid_sphere_conserves_energy() {
    let with = |body: BodyInput, penalty_factor: f64| {
        let pair = Pair { velocities: [0.0, -0.5], penalty_factor, ..coarse() };
        pair.run_model(&pair.model_of([body, pair.sphere(1)]))
    };
    for penalty_factor in [1.0, 100.0] {
        let run = with(BodyInput::Rigid { radius: 11.1e-3, mass: 13.7e-3 }, penalty_factor);
        let found = quantities(&run);
        assert!((found.restitution - 1.0).abs() < 1e-4, "{}", found.restitution);
        found.assert_balance(1e-5, 1e-12);
    }
}

/// No mass is lost with that of the boundary, and nothing of it is where the bodies flatten: the approach
/// is that of mass centres.
#[test]
fn masses_and_their_centres_stay() {
    let masses = |method| {
        let model: ExplicitBodies = Pair { method, ..coarse() }.model();
        model.bodies().each_ref().map(|body| {
            let nodes = body.mesh().unwrap().nodes().iter();
            let moment: f64 = body.nodal_mass().iter().zip(nodes).map(|(m, x)| m * x[1]).sum();
            [body.mass(), moment / body.nodal_mass().iter().sum::<f64>()]
        })
    };
    let [bare, full] = [SmallStrainContact::Massless, SmallStrainContact::Penalty].map(masses);
    for (bare, full) in bare.into_iter().zip(full) {
        assert!((bare[0] / full[0] - 1.0).abs() < 1e-13);
        // Mass scaling adds 2e-4 of the mass near the pole, elsewhere a little in each.
        assert!((bare[1] / full[1] - 1.0).abs() < 2e-4, "{bare:?} {full:?}");
    }
}
