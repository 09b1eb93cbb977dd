//! A boundary without mass: no energy gained at any stiffness, little noise, and the same collision.

use crate::common::{HERTZ_TIME, Pair, Quantities, quantities};
use fem_collision::{BodyInput, Collision, Ending};
use fem_explicit::{ContactMethod, Model, Run};
use fem_material::ActsOn;

fn glass() -> Pair {
    Pair { method: ContactMethod::Massless, ..Pair::default() }
}

fn coarse() -> Pair {
    Pair { element_size: 80e-6, candidate_radius: 0.4e-3, ..glass() }
}

/// ForceNoise of the force from instant to instant over its peak.
fn noise(run: &Collision) -> f64 {
    run.force_scatter.unwrap() / run.peak_force.unwrap()
}

/// The results are those of the same springs between nodes with mass (`collision.rs`), within the same limits.
#[test]
fn the_collision_is_the_converged_one() {
    let run = glass().run();
    assert_eq!(run.ending, Ending::Parted);
    let found = quantities(&run);
    // Vibrations of a Hertz pulse, 2e-6, and of nodes that join one by one.
    let lost = 1.0 - found.restitution;
    assert!(lost > 0.0 && lost < 5e-5, "{lost:e}");
    for (found, limit, what) in [
        (found.contact_time, 62.818e-6, "time"),
        (found.peak_force, 107.99, "force"),
        (found.max_approach, 10.681e-6, "approach"),
    ] {
        assert!((found / limit - 1.0).abs() < 0.005, "{what}: {found:e}");
    }
    assert!((found.max_contact_radius / 0.2239e-3 - 1.0).abs() < 0.03);
    assert!((found.peak_pressure / 1.030e9 - 1.0).abs() < 0.05, "{}", found.peak_pressure);
    assert_eq!(run.contact_episodes, 1);
    // Leapfrog's order as with penalty; momentum to what rounding leaves of each step's balance.
    assert!(found.residual < 1e-6, "{}", found.residual);
    assert!(found.momentum_residual < 1e-12, "{}", found.momentum_residual);
}

/// The same springs and mesh: the force scatters by less, in a step that is longer for there being no
/// springs in it; what mass scaling has paid for already is not won twice.
#[test]
fn it_is_quieter_than_springs_between_masses() {
    let (massless, penalty) = (glass(), Pair { method: ContactMethod::Penalty, ..glass() });
    let [step, short] = [massless.model(), penalty.model()].map(|model| model.time_step());
    assert!(step > 1.1 * short, "{step:e} {short:e}");
    let [massless, penalty] = [massless.run(), penalty.run()];
    assert!(noise(&massless) < noise(&penalty) / 3.0, "{} {}", noise(&massless), noise(&penalty));
    let [massless, penalty] = [massless, penalty].map(|run| quantities(&run));
    assert!((massless.restitution - penalty.restitution).abs() < 1e-4);
}

/// For any stiffness the step stays the same, to the bit, and no energy is gained. The softest springs let the
/// spheres overlap by some of their contact radius.
#[test]
fn no_stiffness_gains_energy() {
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
        assert!(noise(&run) < 2e-3, "{penalty_factor:e}: {:e}", noise(&run));
        if penalty_factor > 1.0 {
            // Ever stiffer springs come to contact without overlap.
            assert!((found.contact_time / 62.818e-6 - 1.0).abs() < 0.01);
            assert!((found.peak_force / 107.99 - 1.0).abs() < 0.02, "{}", found.peak_force);
        }
    }
}

/// Converged quasi-static finite elements: 0.92763 if all moduli relax, 0.94811 if only shear does.
#[test]
fn relaxing_bodies_are_the_converged_ones() {
    for (acts_on, e) in [(ActsOn::All, 0.92763), (ActsOn::Shear, 0.94811)] {
        let run = Pair { relaxation: Some(acts_on), ..glass() }.run();
        let Quantities { restitution, residual, momentum_residual, .. } = quantities(&run);
        assert!((restitution - e).abs() < 0.0015, "{acts_on:?}: {restitution}");
        assert!(residual < 2e-6, "{residual:e}");
        assert!(momentum_residual < 1e-12, "{momentum_residual:e}");
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
fn a_wall_is_the_mirror_of_a_twin() {
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
fn swapped_bodies_collide_in_the_mirror() {
    let plain = coarse().run();
    let swapped = Pair { radii: [7.95e-3, 11.1e-3], velocities: [0.0, -0.5], ..coarse() };
    let swapped = Collision { peak_pressure: plain.peak_pressure, ..swapped.run() };
    close(&plain, &swapped, 1e-9);
}

/// A rigid sphere has the same mass and step with any springs; a very large one behaves as a wall.
#[test]
fn a_rigid_sphere_collides() {
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
fn a_resumed_run_is_the_same_to_the_bit() {
    let pair = Pair { relaxation: Some(ActsOn::Shear), ..coarse() };
    let model = pair.model();
    let whole = pair.run_model(&model);
    let mut memory = Run::new(&model, pair.expected(), &pair.request()).restart_state().clone();
    let resumed = loop {
        let mut run = Run::resume(&model, memory).unwrap();
        if run.advance(61).is_some() {
            break run.finish();
        }
        memory = run.restart_state().clone();
    };
    assert_eq!(resumed, whole);
    // The same springs between nodes that have mass are another model.
    let penalty = Pair { method: ContactMethod::Penalty, ..pair.clone() }.model();
    let memory = Run::new(&model, pair.expected(), &pair.request()).restart_state().clone();
    assert!(Run::resume(&penalty, memory).is_err());
}

/// No mass is lost with that of the boundary, and nothing of it is where the bodies flatten: the approach
/// is that of mass centres.
#[test]
fn masses_and_their_centres_stay() {
    let masses = |method| {
        let model: Model = Pair { method, ..coarse() }.model();
        model.bodies().each_ref().map(|body| {
            let nodes = body.mesh().unwrap().nodes().iter();
            let moment: f64 = body.nodal_mass().iter().zip(nodes).map(|(m, x)| m * x[1]).sum();
            [body.mass(), moment / body.nodal_mass().iter().sum::<f64>()]
        })
    };
    let [bare, full] = [ContactMethod::Massless, ContactMethod::Penalty].map(masses);
    for (bare, full) in bare.into_iter().zip(full) {
        assert!((bare[0] / full[0] - 1.0).abs() < 1e-13);
        // Mass scaling adds 2e-4 of the mass near the pole, elsewhere a little in each.
        assert!((bare[1] / full[1] - 1.0).abs() < 2e-4, "{bare:?} {full:?}");
    }
}

/// The penalty of textbooks: a node that closes brings the spring of an element.
#[test]
fn springs_at_nodes_collide_and_rattle() {
    let pair = |method| Pair { method, ..glass() };
    let run = pair(ContactMethod::NodeToSurface).run();
    let found = quantities(&run);
    assert_eq!(run.ending, Ending::Parted);
    assert!(
        (found.contact_time / 62.818e-6 - 1.0).abs() < 0.02,
        "{}",
        found.contact_time / HERTZ_TIME
    );
    assert!((found.restitution - 1.0).abs() < 1e-3, "{}", found.restitution);
    assert!(noise(&run) > noise(&pair(ContactMethod::Massless).run()));
}
