//! Shapes whose overlap has a closed form.

use std::f64::consts::PI;

use fem_contact::Surface;
use fem_mesh::{Side, SphereMesh};

use super::{Scene, sum};
use crate::common::{Field, STIFFNESS, flat, sphere};

/// Displacements that bring each candidate of a body from its undeformed radius to a place (r, y).
pub fn displace(
    scene: &Scene,
    mesh: &SphereMesh,
    side: usize,
    place: impl Fn(f64) -> [f64; 2],
) -> Field {
    let mut u = vec![[0.0; 2]; mesh.nodes().len()];
    for node in scene.interface.candidate_nodes(side) {
        let [r, y] = mesh.nodes()[node as usize];
        let to = place(r);
        u[node as usize] = [to[0] - r, to[1] - y];
    }
    u
}

/// A flat disc that is stretched by a half and bent to the paraboloid y = c r² − δ: on a wall,
/// F = k π δ²/(2c) and Π = F δ/3, and the contact ends at √(δ/c), all of *moved* radii. On the undeformed
/// ones F would be 1/2.25 of it.
#[test]
fn a_stretched_surface_presses_on_its_moved_area() {
    let (stretch, curvature, depth) = (1.5, 0.5, 5.3e-3);
    let errors = [0.01, 0.005, 0.0025].map(|size| {
        let mesh = flat(size, Side::Above);
        let scene = Scene::above(Surface::wall(), &mesh, 0.0999);
        let place = |r: f64| [stretch * r, curvature * (stretch * r).powi(2) - depth];
        let u = [vec![[0.0; 2]], displace(&scene, &mesh, 1, place)];
        let (total, f) = scene.forces(&u);
        assert!(!total.at_limit && (sum(&f[1], 1) / total.force - 1.0).abs() < 1e-13);
        let force = 0.5 * STIFFNESS / size * PI * depth.powi(2) / curvature;
        // Elastic bodies of this pressure would end within half an element of where the overlap does.
        let radius = scene.interface.contact_radius([&u[0], &u[1]]);
        let expected = (depth / curvature).sqrt();
        assert!((radius - expected).abs() < 0.5 * stretch * size, "{radius} {expected}");
        let (expected, found) = ([force, force * depth / 3.0], [total.force, total.energy]);
        [0, 1].map(|k: usize| (found[k] / expected[k] - 1.0).abs())
    });
    // Chords of the paraboloid lie above it by up to c (λh)²/4 = 5 % of δ at the coarsest, two thirds of
    // that on average, and F goes with twice, Π with three times the depth; second order.
    let limits = [0.07, 0.11];
    for (k, limit) in limits.into_iter().enumerate() {
        let error = errors.map(|error| error[k]);
        assert!(error[0] < limit && error[2] < limit / 12.0, "{k}: {error:?}");
    }
}

/// Where all of the surface overlaps a wall by δ, the true pressure is kδ at all nodes.
#[test]
fn pressure_is_per_moved_area() {
    let (stretch, depth) = (1.3, 2e-4);
    let mesh = flat(0.01, Side::Above);
    let scene = Scene::above(Surface::wall(), &mesh, 0.0999);
    let u = [vec![[0.0; 2]], displace(&scene, &mesh, 1, |r| [stretch * r, -depth])];
    let pressure = STIFFNESS / 0.01 * depth;
    // The surface of 1 km rises by up to 1e-8 m between nodes, 5e-5 of δ; lengths differ by 2.5e-9.
    let close = |p: f64| (p / pressure - 1.0).abs() < 1e-4;
    let u = [&u[0][..], &u[1][..]];
    for (k, (r, p)) in scene.interface.nodal_pressure(u).enumerate() {
        assert!((r - stretch * 0.01 * k as f64).abs() < 1e-8 && close(p), "{p} at {r}");
    }
    let area = PI * (stretch * scene.interface.candidate_radius()).powi(2);
    assert!((scene.forces(&u.map(<[_]>::to_vec)).0.force / (pressure * area) - 1.0).abs() < 1e-4);
}

/// Two spheres that are bent to the same bowl y = s r²/2 and overlap by δ everywhere feel the pressure
/// along their common normal: f_r = −y' f_y at every node, and in all ∓∫ p y' 2πr dr of the one and the
/// other.
#[test]
fn a_bowl_presses_along_the_common_normal() {
    let (bend, depth) = (0.8, 1e-4);
    let meshes = [sphere(1.0, 0.02, 0.45, Side::Below), sphere(1.0, 0.017, 0.45, Side::Above)];
    let scene = Scene::pair(&meshes, 0.4);
    let bowl = |sign: f64| move |r: f64| [r, 0.5 * bend * r * r + 0.5 * sign * depth];
    let u =
        [displace(&scene, &meshes[0], 0, bowl(1.0)), displace(&scene, &meshes[1], 1, bowl(-1.0))];
    let (total, f) = scene.forces(&u);
    let mut n_nodes = 0;
    for side in 0..2 {
        for node in scene.interface.candidate_nodes(side) {
            let r = meshes[side].nodes()[node as usize][0];
            let [f_r, f_y] = f[side][node as usize];
            if (0.1..0.36).contains(&r) {
                let error = f_r / (-bend * r * f_y) - 1.0;
                assert!(error.abs() < 0.02, "{side} {r}: {error}");
                n_nodes += 1;
            }
        }
    }
    assert!(n_nodes > 20);
    let [lower, upper] = f.each_ref().map(|f| sum(f, 0));
    // All that is left is the end of the search, where the overlap is cut off: 1.5 δ/(s r²) = 0.12 %.
    assert!((lower + upper).abs() < 3e-3 * lower, "{lower} {upper}");
    let mean_slope = 2.0 / 3.0 * bend * scene.interface.candidate_radius();
    assert!((lower / (mean_slope * total.force) - 1.0).abs() < 0.02, "{lower} {total:?}");
}

/// A surface slides over another one, several segments wide, while what touches stays the same
/// paraboloid, of which ever longer chords overlap less. Returned are the largest difference in a step
/// between the energy's change and the work of the forces, and how far the energy goes off its start,
/// both over the energy.
fn slide(n_steps: u32) -> [f64; 2] {
    let (curvature, depth) = (0.5, 2.5e-3);
    let meshes = [flat(0.013, Side::Below), flat(0.01, Side::Above)];
    let scene = Scene::pair(&meshes, 0.0999);
    let at = |stretch: f64| {
        let place = |r: f64| [stretch * r, curvature * (stretch * r).powi(2) - depth];
        [vec![[0.0; 2]; scene.n_nodes[0]], displace(&scene, &meshes[1], 1, place)]
    };
    // At the edge of the contact, at r = 0.07, a segment's length slides by for 0.14 of the stretch.
    let stretch = |k: u32| 1.0 + 0.6 * f64::from(k) / f64::from(n_steps);
    let mut before = at(stretch(0));
    let (mut total, mut f) = scene.forces(&before);
    let start = total.energy;
    let (mut jump, mut ripple) = (0.0f64, 0.0f64);
    for k in 1..=n_steps {
        let u = at(stretch(k));
        let (next, g) = scene.forces(&u);
        let work: f64 = [0, 1]
            .map(|side: usize| {
                let nodes = 0..scene.n_nodes[side];
                nodes
                    .flat_map(|node| [(node, 0), (node, 1)])
                    .map(|(node, axis)| {
                        0.5 * (f[side][node][axis] + g[side][node][axis])
                            * (u[side][node][axis] - before[side][node][axis])
                    })
                    .sum::<f64>()
            })
            .iter()
            .sum();
        jump = jump.max((next.energy - total.energy + work).abs() / start);
        ripple = ripple.max((next.energy / start - 1.0).abs());
        (before, total, f) = (u, next, g);
    }
    [jump, ripple]
}

/// The energy never jumps, whatever nodes pass each other: what it changes is the work of the forces, by
/// the trapezoidal rule, and what is left shrinks faster than the steps. If it jumped it would stay.
#[test]
fn sliding_over_many_segments_keeps_the_energy() {
    let [[coarse, _], [fine, change]] = [1000, 4000].map(slide);
    // Chords of the paraboloid as long as λ 0.01 lie above it by up to c (λ 0.01)²/4: of δ 0.8 % more at
    // the end than at the start, on average two thirds of that, and the energy goes with δ³.
    assert!(change < 0.02, "{change}");
    assert!(coarse < 2e-6 && fine < 0.3 * coarse, "{coarse:e} {fine:e}");
}
