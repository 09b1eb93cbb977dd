//! The massless boundary: no energy is gained at any stiffness. See also `collision.rs`.

use crate::common::{Pair, quantities};
use fem_collision::{BodyInput, Collision, Ending};
use fem_explicit::{ExplicitBodies, Run, SmallStrainContact};
use fem_material::ActsOn;

fn coarse() -> Pair {
    Pair { method: SmallStrainContact::Massless, ..Pair::coarse() }
}

/// For any stiffness the step stays the same, to the bit, and no energy is gained. The softest springs let the
/// spheres overlap by some of their contact radius.
#[test]
fn massless_step_and_energy_are_independent_of_stiffness() {
    let step = coarse().model().time_step();
    for penalty_factor in [1e-3, 1e-2, 0.1, 10.0, 1e2, 1e3, 1e4] {
        let soft = if penalty_factor < 0.1 { 2e-3 } else { coarse().max_time };
        let candidate_radius =
            if penalty_factor < 0.1 { 1.2e-3 } else { coarse().candidate_radius };
        let pair = Pair { penalty_factor, max_time: soft, candidate_radius, ..coarse() };
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

fn close(one: &Collision, other: &Collision, tolerance: f64) {
    let numbers = |run: &Collision| {
        let found = quantities(run);
        [found.restitution, found.contact_time, found.peak_force, found.peak_pressure]
    };
    for (one, other) in numbers(one).into_iter().zip(numbers(other)) {
        assert!((one / other - 1.0).abs() < tolerance, "{one:e} {other:e}");
    }
}

/// Between twins lies a plane that neither passes, on which each overlaps by half: half of the springs
/// in series. A wall that moves is no other.
#[test]
fn massless_wall_contact_equals_the_mirrored_twin_pair() {
    let twins = |velocities, penalty_factor| Pair {
        radii: [7.95e-3; 2],
        velocities,
        penalty_factor,
        ..coarse()
    };
    let both = twins([0.5, -0.5], 0.5).run();
    for (velocities, wall) in [([0.0, -0.5], 0), ([0.5, 0.0], 1), ([1.5, 1.0], 0)] {
        let pair = twins(velocities, 1.0);
        let mut bodies = [0, 1].map(|body| pair.sphere(body));
        bodies[wall] = BodyInput::Wall;
        let run = pair.run_model(&pair.model_of(bodies));
        // Roundings, of two meshes and of one.
        close(&run, &both, 1e-9);
        let found = quantities(&run);
        assert_eq!(found.velocity_after[wall], velocities[wall]);
        assert!(found.momentum_residual < 1e-12 && found.residual < 1e-5, "{:e}", found.residual);
    }
}

#[test]
fn massless_swapped_bodies_give_mirrored_results() {
    let plain = coarse().run();
    let swapped = Pair { radii: [7.95e-3, 11.1e-3], velocities: [0.0, -0.5], ..coarse() };
    let swapped = Collision { peak_pressure: plain.peak_pressure, ..swapped.run() };
    close(&plain, &swapped, 1e-9);
}

/// A rigid sphere has the same mass and step with any springs; a very large one behaves as a wall.
#[test]
fn massless_rigid_sphere_conserves_energy_and_becomes_a_wall() {
    let with = |body: BodyInput, penalty_factor: f64| {
        let pair = Pair { velocities: [0.0, -0.5], penalty_factor, ..coarse() };
        pair.run_model(&pair.model_of([body, pair.sphere(1)]))
    };
    let enormous = with(BodyInput::Rigid { radius: 1e10, mass: 1e10 }, 1.0);
    close(&enormous, &with(BodyInput::Wall, 1.0), 1e-9);
    for penalty_factor in [1.0, 100.0] {
        let run = with(BodyInput::Rigid { radius: 11.1e-3, mass: 13.7e-3 }, penalty_factor);
        let found = quantities(&run);
        assert!((found.restitution - 1.0).abs() < 1e-4, "{}", found.restitution);
        assert!(found.residual < 1e-5, "{:e}", found.residual);
        assert!(found.momentum_residual < 1e-12);
    }
}

/// The contents of the buffers of the boundary do not change results.
#[test]
fn massless_resumed_run_is_the_same_to_the_bit() {
    let pair = Pair { relaxation: Some(ActsOn::Shear), ..coarse() };
    let model = pair.model();
    assert_eq!(pair.in_pieces(&model, 61), pair.run_model(&model));
    // The same springs between nodes that have mass are another model.
    let penalty = Pair { method: SmallStrainContact::Penalty, ..pair.clone() }.model();
    let start = Run::new(&model, pair.expected(), &pair.request()).restart_state().clone();
    assert!(Run::resume(&penalty, start).is_err());
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
