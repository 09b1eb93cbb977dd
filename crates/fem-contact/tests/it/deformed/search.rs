//! The limits of the candidate region, and folds of the surface.

use fem_contact::{DeformedInterface, Surface};
use fem_mesh::Side;

use super::Scene;
use super::geometry::displace;
use crate::common::{Field, STIFFNESS, flat, glass_pair, rigid, sphere};

#[test]
fn is_closed_agrees_with_the_moved_contact_forces() {
    let scene = Scene::pair(&glass_pair([30e-6, 37e-6]), 0.4e-3);
    for (depth, closed) in [(-1e-12, false), (1.1e-9, false), (1.4e-9, true), (5e-6, true)] {
        let u: [Field; 2] = [vec![[0.0, depth]; scene.n_nodes[0]], scene.at_rest()[1].clone()];
        let (total, f) = scene.forces(&u);
        let is_closed = scene.interface.is_closed([0, 1].map(|side: usize| {
            let u = &u[side];
            move |node: u32| u[node as usize]
        }));
        // The first point is 3.4e-6 m off the axis, where the arcs are 1.24e-9 m apart.
        assert_eq!((total.n_closed > 0, is_closed), (closed, closed), "{depth}");
        if !closed {
            assert_eq!(total, Default::default());
            assert!(f.iter().flatten().all(|f| *f == [0.0; 2]));
            assert_eq!(scene.interface.contact_radius([&u[0], &u[1]]), 0.0);
            assert_eq!(scene.interface.centre_pressure([&u[0], &u[1]]), 0.0);
        }
    }
}

/// Bodies that part along y have a gap, given by the interface or by the displacement.
#[test]
fn the_gap_separates_the_poles() {
    let meshes = glass_pair([30e-6, 30e-6]);
    let [lower, upper] = meshes.each_ref().map(Surface::of_sphere);
    let apart = DeformedInterface::new(lower, upper, STIFFNESS, 3e-6, 0.4e-3).unwrap();
    let together = Scene::pair(&meshes, 0.4e-3);
    let u = [rigid(&meshes[0], 8e-6), rigid(&meshes[1], 0.0)];
    let mut f = together.at_rest();
    let [lower, upper] = &mut f;
    let force = apart.add_forces([&u[0], &u[1]], [lower, upper]).force;
    let (expected, _) = together.forces(&[rigid(&meshes[0], 5e-6), rigid(&meshes[1], 0.0)]);
    assert!((force / expected.force - 1.0).abs() < 1e-9, "{force} {expected:?}");
}

/// The candidate region ends at the first undeformed node beyond the candidate radius; a contact that reaches it is
/// reported.
#[test]
fn the_end_of_the_candidate_region_is_reported() {
    let mesh = sphere(7.95e-3, 30e-6, 0.5e-3, Side::Above);
    let scene = Scene::above(Surface::wall(), &mesh, 0.3e-3);
    let radius = scene.interface.candidate_radius();
    assert!((0.3e-3..0.331e-3).contains(&radius));
    let pressed = |depth: f64| scene.forces(&[vec![[0.0; 2]], rigid(&mesh, -depth)]).0;
    let arc = radius * radius / (2.0 * 7.95e-3);
    // The last point is 6e-6 m inside, where the arc is lower by 4 %.
    assert!(!pressed(0.95 * arc).at_limit);
    assert!(pressed(1.05 * arc).at_limit);
}

/// A disc of elements 0.01, bent by `y` (m) where its nodes beyond 0.06 come back inward by twice as much
/// as they are out.
fn folded(y: impl Fn(f64) -> f64) -> fem_contact::ContactForces {
    let mesh = flat(0.01, Side::Above);
    let scene = Scene::above(Surface::wall(), &mesh, 0.0999);
    let fold = |r: f64| [if r > 0.0601 { 0.18 - 2.0 * r } else { r }, y(r)];
    scene.forces(&[vec![[0.0; 2]], displace(&scene, &mesh, 1, fold)]).0
}

/// A fold outside of the contact does not matter. A fold that the contact reaches, or behind which the surface
/// touches again, is reported.
#[test]
fn surface_fold_is_reported_only_within_the_contact() {
    let depth = 1e-3;
    let bowl = |r: f64| 1.0 * r * r - depth;
    let beside = folded(bowl);
    assert!(beside.n_closed > 2 && beside.fold.is_none() && !beside.at_limit);
    let up_to_it = folded(|r| if r < 0.065 { -depth } else { depth });
    assert_eq!(up_to_it.fold.map(|fold| (fold.radius * 1e6).round()), Some(60e3));
    assert!(!up_to_it.at_limit);
    // The eighth node, which would be at 0.07.
    let fold = up_to_it.fold.unwrap();
    let mesh = flat(0.01, Side::Above);
    assert_eq!((fold.side, fold.node), (1, mesh.surface()[7]));
    let behind = folded(|r| if r > 0.075 { -depth } else { bowl(r) });
    assert_eq!(behind.fold.map(|fold| (fold.radius * 1e6).round()), Some(60e3));
    // Displacements that are no numbers give no force.
    let blown_up = folded(|_| f64::NAN);
    assert_eq!(blown_up.n_closed, 0);
}

/// Two barrels are flat on each other out to 0.05. From there their flanks bulge, the lower one more, and come
/// back above and below. Nodes behind the fold are compared with the other surface at their radius, not with the
/// inward extension of a flank.
#[test]
fn flanks_behind_a_fold_make_no_contact() {
    let meshes = [Side::Below, Side::Above].map(|side| flat(0.005, side));
    let scene = Scene::pair(&meshes, 0.0999);
    let barrel = |sign: f64, bulge: f64| {
        move |r: f64| {
            let (out, back) = ((r - 0.05).clamp(0.0, 0.02), (r - 0.07).max(0.0));
            [r.min(0.05) + bulge * out - back, sign * (2.0 * (out + back) - 1e-4)]
        }
    };
    let u = [
        displace(&scene, &meshes[0], 0, barrel(-1.0, 0.2)),
        displace(&scene, &meshes[1], 1, barrel(1.0, 0.15)),
    ];
    let (total, _) = scene.forces(&u);
    assert!(total.n_closed > 20 && total.fold.is_none() && !total.at_limit, "{total:?}");
    // Back into the flat part of the other one.
    let touches = |r: f64| {
        let [at, y] = barrel(1.0, 0.15)(r);
        [at, if r > 0.085 { -2e-4 } else { y }]
    };
    let u = [u[0].clone(), displace(&scene, &meshes[1], 1, touches)];
    assert!(scene.forces(&u).0.fold.is_some());
}
