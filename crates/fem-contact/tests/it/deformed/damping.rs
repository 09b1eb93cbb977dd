//! Dashpots parallel to the springs.

use std::f64::consts::PI;

use fem_contact::{DeformedInterface, Surface};
use fem_mesh::Side;

use super::geometry::displace;
use super::{Scene, bounded, sum};
use crate::common::{Field, STIFFNESS, flat, glass_pair, largest_quotient, noise, sphere};

/// Impedance of the dashpots, Pa s/m.
const IMPEDANCE: f64 = 3.0;

/// The same surfaces with dashpots.
fn damped(scene: Scene) -> Scene {
    Scene { interface: scene.interface.with_damping(IMPEDANCE), ..scene }
}

fn dashpots(scene: &Scene, u: &[Field; 2], v: &[Field; 2]) -> [Field; 2] {
    let mut f = scene.at_rest();
    let [lower, upper] = &mut f;
    scene.interface.add_damping([&u[0], &u[1]], [&v[0], &v[1]], [lower, upper]);
    f
}

fn power(f: &[Field; 2], v: &[Field; 2]) -> f64 {
    let both = f.concat();
    both.as_flattened().iter().zip(v.concat().as_flattened()).map(|(f, v)| f * v).sum()
}

/// A stretched disc comes down on a wall at v: cv on its deformed area, whatever its depth. Sliding along the
/// wall it is not damped. Moving off faster than kδ/c it takes all of the springs' force and never pulls.
#[test]
fn dashpot_force_of_a_disc_is_impedance_times_velocity() {
    let (stretch, depth, speed) = (1.3, 2e-4, 0.1);
    let mesh = flat(0.01, Side::Above);
    let scene = damped(Scene::above(Surface::wall(), &mesh, 0.0999));
    let u = [vec![[0.0; 2]], displace(&scene, &mesh, 1, |r| [stretch * r, -depth])];
    let moving = |v: [f64; 2]| {
        let v = [vec![[0.0; 2]], vec![v; scene.n_nodes[1]]];
        (dashpots(&scene, &u, &v), v)
    };
    let area = PI * (stretch * scene.interface.candidate_radius()).powi(2);
    let (f, v) = moving([0.0, -speed]);
    // The surface of 1 km has slopes of 1e-4.
    assert!((sum(&f[1], 1) / (IMPEDANCE * speed * area) - 1.0).abs() < 1e-6);
    assert!((sum(&f[0], 1) + sum(&f[1], 1)).abs() < 1e-13 * sum(&f[1], 1));
    assert!((-power(&f, &v) / (IMPEDANCE * speed.powi(2) * area) - 1.0).abs() < 1e-6);
    let (f, _) = moving([speed, 0.0]);
    assert!(sum(&f[1], 1).abs() < 1e-3 * IMPEDANCE * speed * area);
    let (springs, _) = scene.forces(&u);
    let (f, _) = moving([0.0, 2.0 * STIFFNESS / 0.01 * depth / IMPEDANCE]);
    assert!((sum(&f[1], 1) / springs.force + 1.0).abs() < 1e-13);
}

/// For ragged surfaces and velocities, the forces of dashpots are opposite along y and dissipate energy. An open
/// contact has no damping.
#[test]
fn dashpots_balance_and_take_energy() {
    let scene = damped(Scene::pair(&glass_pair([30e-6, 37e-6]), 0.4e-3));
    let u = scene.ragged(10e-6, 20e-6);
    for seed in 0..20 {
        let v = [0, 1].map(|side: usize| -> Field {
            let at = |k: usize| noise(5 * k + 3 * seed + side);
            (0..scene.n_nodes[side]).map(|k| [at(2 * k), at(2 * k + 1)]).collect()
        });
        let f = dashpots(&scene, &u, &v);
        let [lower, upper] = f.each_ref().map(|f| sum(f, 1));
        let size: f64 = f[0].iter().map(|f| f[1].abs()).sum();
        assert!(size > 0.0 && (lower + upper).abs() < 1e-13 * size, "{lower} {upper}");
        assert!(power(&f, &v) < 0.0);
        let none = |f: [Field; 2]| f.concat().iter().all(|f| *f == [0.0; 2]);
        let apart = [u[0].clone(), u[1].iter().map(|u| [u[0], u[1] + 1e-3]).collect()];
        assert!(none(dashpots(&scene, &apart, &v)));
        let undamped = Scene::pair(&glass_pair([30e-6, 37e-6]), 0.4e-3);
        assert!(none(dashpots(&undamped, &u, &v)));
    }
}

/// Largest eigenvalue of D^−1/2 C D^−1/2, C = −∂f/∂v and D the bound: between spheres that all overlap, and
/// on a wall, it is 1 and a little less.
#[test]
fn bound_is_never_below_the_dashpots() {
    let meshes = [sphere(1.0, 0.02, 0.45, Side::Below), sphere(1.0, 0.0173, 0.45, Side::Above)];
    let pair = (damped(Scene::pair(&meshes, 0.4)), vec![0, 1]);
    let wall = (damped(Scene::above(Surface::wall(), &meshes[1], 0.4)), vec![1]);
    for (scene, sides) in [pair, wall] {
        let u = [0, 1].map(|side: usize| match scene.n_nodes[side] {
            1 => vec![[0.0; 2]],
            _ => displace(&scene, &meshes[side], side, |r| [r, [1e-4, -1e-4][side]]),
        });
        let add = |side, bound: &mut [f64]| scene.interface.add_damping_bound(side, bound);
        let (bound, freedoms) = bounded(&scene, sides, add);
        let quotient = largest_quotient(&bound, 1e-12, |j| {
            let ((side, node, axis), mut v) = (freedoms[j], scene.at_rest());
            // So slow that the springs are the stronger.
            v[side][node][axis] = 1e-9;
            let f = dashpots(&scene, &u, &v);
            freedoms.iter().map(|&(side, node, axis)| -1e9 * f[side][node][axis]).collect()
        });
        // Arcs between flat nodes have slopes up to h/2R = 0.01, whose squares are not counted.
        assert!(quotient < 1.0 + 1e-4 && quotient > 0.95, "{quotient}");
    }
}

/// The safety factor for opening and closing is 2 with dashpots and 4 without.
#[test]
fn dashpots_halve_the_stiffness_bound() {
    let mesh = sphere(7.95e-3, 30e-6, 0.5e-3, Side::Above);
    let bound = |interface: &DeformedInterface| {
        let mut bound = vec![0.0; mesh.nodes().len()];
        interface.add_stiffness_bound(1, &mut bound);
        bound
    };
    let plain = Scene::above(Surface::wall(), &mesh, 0.4e-3);
    let (of_plain, of_damped) = (bound(&plain.interface), bound(&damped(plain).interface));
    assert!(of_plain.iter().zip(&of_damped).all(|(plain, damped)| *plain == 2.0 * damped));
    assert!(of_plain.iter().any(|bound| *bound > 0.0));
}

/// The bounds of the deformed surfaces are those of the undeformed ones plus their growth, for a stretched disc that of
/// its area.
#[test]
fn stiffness_and_damping_bounds_grow_with_the_stretched_area() {
    let (stretch, depth) = (1.3, 2e-4);
    let mesh = flat(0.01, Side::Above);
    let scene = damped(Scene::above(Surface::wall(), &mesh, 0.0999));
    let u = [vec![[0.0; 2]], displace(&scene, &mesh, 1, |r| [stretch * r, -depth])];
    let [mut stiffness, mut damping] = [0, 1].map(|_| vec![0.0; mesh.nodes().len()]);
    scene.interface.add_stiffness_bound(1, &mut stiffness);
    scene.interface.add_damping_bound(1, &mut damping);
    let before = [stiffness.clone(), damping.clone()];
    scene.interface.add_bound_growth([&u[0], &u[1]], 0.0, 1, &mut stiffness, &mut damping);
    let mut moved = vec![0.0; mesh.nodes().len()];
    scene.interface.add_deformed_stiffness_bound([&u[0], &u[1]], 0.0, 1, &mut moved);
    for (k, [after, expected]) in stiffness.iter().zip(&moved).map(|(a, b)| [a, b]).enumerate() {
        assert!((after - expected).abs() <= 1e-14 * expected, "{k}: {after} {expected}");
    }
    for (before, after) in before.iter().flatten().zip(stiffness.iter().chain(&damping)) {
        // Arcs of the surface of 1 km rise over its chords by 1e-5 of their length.
        assert!((after - stretch * stretch * before).abs() <= 1e-6 * after, "{before} {after}");
    }
}
