//! The diagonal bound of the contact stiffness, of deformed surfaces.

use fem_contact::Surface;
use fem_mesh::Side;

use super::geometry::displace;
use super::{Scene, bounded};
use crate::common::{Field, Freedom, flat, largest_quotient, sphere};

/// Largest eigenvalue of D^−1/2 K D^−1/2 along r and y, K = ∂²Π/∂u² and D the bound at `u`; the axis
/// stays the axis, a rigid sphere straight.
fn quotient_at(scene: &Scene, u: &[Field; 2], is_wall: [bool; 2]) -> f64 {
    let sides = (0..2).filter(|side| !is_wall[*side]);
    let (bound, freedoms) = bounded(scene, sides, |side, bound| {
        scene.interface.add_deformed_stiffness_bound([&u[0], &u[1]], 0.0, side, bound);
    });
    let step = 1e-9;
    largest_quotient(&bound, 1e-4, |j| {
        let (side, node, axis) = freedoms[j];
        let forces = |change: f64| {
            let mut moved = u.clone();
            moved[side][node][axis] += change;
            scene.forces(&moved).1
        };
        let (before, after) = (forces(-step), forces(step));
        let slope =
            |&(side, node, axis): &Freedom| before[side][node][axis] - after[side][node][axis];
        freedoms.iter().map(|freedom| slope(freedom) / (2.0 * step)).collect()
    })
}

/// The bound takes the springs four times (for opening and closing), so the quotient of all springs
/// closed is 1/4 and a little less: surfaces bent to bowls with slopes up to 0.8, stretched and shrunk
/// by up to a half, pressed into each other and on a wall. The pressure's own terms add to it as overlap
/// over segment length does: a tenth at 1, half as much again at a half of a segment on a wall.
#[test]
fn stiffness_bound_covers_the_moved_springs() {
    for (depth, limit) in [(1e-4, 0.251), (2e-3, 0.251), (5e-3, 0.27), (1e-2, 0.35), (2e-2, 0.6)] {
        for (bend, stretch) in [(0.0, 1.0), (0.8, 1.3), (2.0, 1.0), (2.0, 0.7), (-1.0, 1.5)] {
            let meshes =
                [sphere(1.0, 0.02, 0.45, Side::Below), sphere(1.0, 0.0173, 0.45, Side::Above)];
            let scene = Scene::pair(&meshes, 0.4);
            let bowl = |sign: f64| {
                move |r: f64| {
                    let r = stretch * r;
                    [r, 0.5 * bend * r * r + sign * depth * (0.5 - 4.0 * r * r)]
                }
            };
            let u = [
                displace(&scene, &meshes[0], 0, bowl(1.0)),
                displace(&scene, &meshes[1], 1, bowl(-1.0)),
            ];
            let quotient = quotient_at(&scene, &u, [false; 2]);
            let mesh = &meshes[1];
            let scene = Scene::above(Surface::wall(), mesh, 0.4);
            let flat = |r: f64| [stretch * r, -depth * (1.0 - 8.0 * r * r)];
            let u = [vec![[0.0; 2]], displace(&scene, mesh, 1, flat)];
            let on_wall = quotient_at(&scene, &u, [true, false]);
            for quotient in [quotient, on_wall] {
                assert!(quotient < limit, "{depth} {bend} {stretch}: {quotient}");
                assert!(quotient > 0.24, "{depth} {bend} {stretch}: {quotient}");
            }
        }
    }
}

/// A flat body below a barrel: flat out to 0.05, then with a flank of slope 8 that opens at once. The flank's slope
/// counts where it is closed or within reach, and nowhere else.
#[test]
fn stiffness_bound_counts_slopes_within_reach_only() {
    let meshes = [Side::Below, Side::Above].map(|side| flat(0.005, side));
    let scene = Scene::pair(&meshes, 0.0999);
    let barrel = |r: f64| {
        let out = (r - 0.05).max(0.0);
        [r.min(0.05) + 0.25 * out, 2.0 * out - 1e-4]
    };
    let flat = |r: f64| [r.min(0.05) + 0.25 * (r - 0.05).max(0.0), 0.0];
    let bound = |reach: f64, place: &dyn Fn(f64) -> [f64; 2]| {
        let u = [scene.at_rest()[0].clone(), displace(&scene, &meshes[1], 1, place)];
        let mut bound = vec![0.0; meshes[1].nodes().len()];
        scene.interface.add_deformed_stiffness_bound([&u[0], &u[1]], reach, 1, &mut bound);
        scene.interface.candidate_nodes(1).map(|node| bound[node as usize]).collect::<Vec<_>>()
    };
    let level = bound(0.0, &flat);
    // Nodes 0 to 10 are level; a step of 0.005 along the flank is 0.01 of gap.
    let ratios = |reach: f64| {
        let bound = bound(reach, &barrel);
        bound.iter().zip(&level).map(|(one, other)| one / other).collect::<Vec<_>>()
    };
    let is_near = |ratio: f64, expected: f64| (ratio / expected - 1.0).abs() < 1e-3;
    let closed = ratios(0.0);
    assert!(closed.len() > 18, "{}", closed.len());
    assert!((0..10).chain(12..19).all(|k| is_near(closed[k], 1.0)), "{closed:?}");
    let all = ratios(0.1);
    assert!((12..19).all(|k| is_near(all[k], 1.0 + 8.0 * 8.0)), "{all:?}");
    // Up to a gap of 0.03, that of node 13: the way along r brings the flank no nearer than twice that along y.
    let some = ratios(0.03);
    assert!(is_near(some[12], 65.0) && (19 - 1..19).all(|k| is_near(some[k], 1.0)), "{some:?}");
}
