//! Meshes whose nodes do not meet: the finer surface is projected on the nodes of the coarser.

use crate::common::{
    CONVERGED, CONVERGED_RESTITUTIONS, GLASS, Scene, assert_balance, assert_close, assert_pulse,
    assert_restitution, glass, material,
};
use fem_collision::Collision;
use fem_condensed::CondensedPair;

/// Lower and upper body with so many elements across the contact each.
fn run(scene: &Scene, elements: [f64; 2]) -> Collision {
    let [lower, _] = scene.inputs(elements[0]);
    let [_, upper] = scene.inputs(elements[1]);
    scene.collide(&CondensedPair::new([lower, upper], scene.settings()).unwrap())
}

/// Both meshes at the default element size, an eighth of the contact radius, or one of them up to twice as fine.
/// Limits are converged quasi-static finite elements of another code (h = 3.75 µm); forces on the nearest nodes alone would be
/// 0.9 % off in contact time.
#[test]
fn glass_pair_equals_converged_finite_elements_with_like_and_unlike_meshes() {
    let elastic = Scene::paper(glass(), glass());
    let hertz = elastic.hertz();
    for elements in [[8.0, 8.0], [8.0, 12.0], [12.0, 8.0], [8.0, 16.0], [16.0, 8.0]] {
        let run = run(&elastic, elements);
        // The node set grows in steps of an element: ±0.02 % of T with the place of the edge between two nodes; what
        // F would swing by that, ±0.2 %, is taken off; pressure 0.8 % low, first order in the element size.
        let force = if elements == [8.0; 2] { 1e-3 } else { 3e-3 };
        assert_pulse(&run, CONVERGED, [1.5e-3, force, 1.5e-3]);
        let share = (run.peak_force.unwrap() / hertz.peak_force()).cbrt();
        assert_close(
            "pressure",
            run.peak_pressure.unwrap(),
            0.998 * share * hertz.peak_pressure(),
            1e-2,
        );
        // A third of an element between nodes.
        assert_close(
            "radius",
            run.max_contact_radius.unwrap(),
            share * hertz.max_contact_radius(),
            1e-2,
        );
        // Nothing is lost but in the time step: 1e-6.
        assert_restitution("elastic", &run, 1.0, 1e-5);
        assert_eq!((run.contact_episodes, run.repeated_contact_solutions), (1, Some(0)));
    }
    for ((acts_on, restitution), elements) in
        CONVERGED_RESTITUTIONS.into_iter().flat_map(|case| [(case, 8.0), (case, 16.0)])
    {
        let relaxing = material(GLASS, acts_on, &[(1.0, 2708.0)]);
        let run = run(&Scene::paper(relaxing.clone(), relaxing), [elements, 8.0]);
        assert_restitution("relaxing", &run, restitution, 4e-4);
        // The ledger closes to the order of the time step, (ωΔt)²/6 = 4e-5, where dissipation is
        // summed from the state.
        assert_balance("relaxing", &run, 1e-4);
    }
}

/// The coarser mesh decides the error: a finer one on one side alone, even five times, stays within
/// 0.2 % of the coarse pair, whose peak force is 0.7 % high.
#[test]
fn the_coarser_mesh_decides() {
    let scene = Scene::paper(glass(), glass());
    let coarse = run(&scene, [4.0, 4.0]);
    let pulse = [coarse.contact_time, coarse.peak_force, coarse.max_approach].map(Option::unwrap);
    for elements in [[4.0, 20.0], [20.0, 4.0], [4.0, 4.3]] {
        assert_pulse(&run(&scene, elements), pulse, [2e-3; 3]);
    }
}

/// Which body is the finer does not matter, and neither does the order of the bodies.
#[test]
fn swapped_bodies_with_unlike_meshes_give_the_same_results() {
    let scene = Scene::paper(glass(), glass());
    let one = run(&scene, [8.0, 13.0]);
    let turned = Scene { bodies: [scene.bodies[1].clone(), scene.bodies[0].clone()], speed: 0.5 };
    let other = run(&turned, [13.0, 8.0]);
    assert_close("contact time", other.contact_time.unwrap(), one.contact_time.unwrap(), 1e-10);
    assert_close("peak force", other.peak_force.unwrap(), one.peak_force.unwrap(), 1e-10);
}
