//! Forces follow from one energy, balance, and have the limit of contact on undeformed surfaces.

use fem_contact::{ContactInterface, Surface};
use fem_mesh::Side;

use super::Scene;
use crate::common::{
    Field, STIFFNESS, assert_balance, assert_gradient, glass_pair, interface, sphere,
};

const SIZES: [[f64; 2]; 4] = [[30e-6, 30e-6], [30e-6, 37e-6], [37e-6, 30e-6], [15e-6, 200e-6]];

/// Pairs of meshes, a wall and a rigid sphere, with ragged displacements: of a third of the
/// smaller elements along r.
fn scenes() -> Vec<(Scene, f64)> {
    let pairs = SIZES.map(|sizes| {
        (Scene::pair(&glass_pair(sizes), 0.4e-3), 0.33 * f64::min(sizes[0], sizes[1]))
    });
    let mesh = sphere(7.95e-3, 30e-6, 0.5e-3, Side::Above);
    let rigid = [Surface::wall(), Surface::rigid_sphere(5e-3).unwrap()]
        .map(|surface| (Scene::above(surface, &mesh, 0.4e-3), 10e-6));
    pairs.into_iter().chain(rigid).collect()
}

/// Forces balance and are −∂Π/∂u along r and y on both sides, with points that are open and others that slide
/// over nodes of the other body.
#[test]
fn moved_contact_forces_balance_and_derive_from_the_energy() {
    for (scene, along_r) in scenes() {
        let u = scene.ragged(along_r, 20e-6);
        let (total, f) = scene.forces(&u);
        assert!(total.n_closed >= 5 && total.fold.is_none(), "{total:?}");
        let of_side = |side: usize| {
            let nodes = scene.interface.candidate_nodes(side).map(|node| node as usize);
            let (scene, u) = (&scene, &u);
            nodes.flat_map(move |node| {
                let is_bound = scene.n_nodes[side] == 1 || u[side][node][0] == 0.0;
                (usize::from(is_bound)..2).map(move |axis| (side, node, axis))
            })
        };
        // Rounding of an energy of some ten terms. A missing term would be seen: the smallest terms of the
        // forces, by the ends of intervals, are some 1e-13 of this.
        let freedoms = (0..2).flat_map(of_side);
        assert_gradient(|u| scene.forces(u), &u, freedoms, [1e-11, 2e-15]);
        // Forces along y are opposite to rounding, and a rigid body has none along r.
        assert_balance(&total, &f);
        assert!(scene.n_nodes[0] > 1 || f[0][0][0] == 0.0);
    }
}

/// Surfaces that have moved along y alone overlap as undeformed ones do. Where all points are closed,
/// two Gauss points per interval, as in the other contact, are exact for forces along y, and three for
/// the energy; where the edge of the contact lies within an interval both are approximate.
#[test]
fn axial_motion_gives_the_forces_of_undeformed_surfaces() {
    let check = |scene: &Scene, other: &ContactInterface, [low, up]: [f64; 2], tolerance: f64| {
        let u = [low, up].map(|rise| [0.0, rise]);
        let u = [0, 1].map(|side: usize| vec![u[side]; scene.n_nodes[side]]);
        let (total, f) = scene.forces(&u);
        let mut g = scene.at_rest();
        let [lower, upper] = &mut g;
        let expected = other.add_forces([&u[0], &u[1]], [lower, upper]);
        let close = |a: f64, b: f64| (a - b).abs() < tolerance * expected.force;
        assert!(total.n_closed > 10);
        assert!(close(total.force, expected.force), "{total:?} {expected:?}");
        assert!((total.energy / expected.energy - 1.0).abs() < tolerance.max(1e-5), "{total:?}");
        let forces = |f: &[Field; 2]| f.concat();
        // Shares of nodes take one degree more: two points are 5e-8 off.
        let close = |a: f64, b: f64| (a - b).abs() < tolerance.max(2e-7) * expected.force;
        assert!(forces(&f).iter().zip(forces(&g)).all(|(f, g)| close(f[1], g[1])));
        let of_undeformed = (other.candidate_radius(), total.at_limit);
        assert_eq!((scene.interface.candidate_radius(), expected.at_limit), of_undeformed);
        expected.at_limit
    };
    let (mut n_edges, mut n_whole) = (0, 0);
    let mut check_both = |scene: &Scene, other: &ContactInterface| {
        // An edge that lies an interval away moves 1e-3 of the load.
        n_edges += u64::from(!check(scene, other, [4e-6, -5e-6], 2e-3));
        // Intervals joined across nodes that lie 1e-5 apart: 6e-9; rounding and the difference of arcs from
        // parabolas are less.
        n_whole += u64::from(check(scene, other, [150e-6, -50e-6], 2e-8));
    };
    for sizes in SIZES {
        let meshes = glass_pair(sizes);
        check_both(&Scene::pair(&meshes, 0.4e-3), &interface(&meshes, 0.4e-3));
    }
    let mesh = sphere(7.95e-3, 30e-6, 0.5e-3, Side::Above);
    for surface in [Surface::wall(), Surface::rigid_sphere(5e-3).unwrap()] {
        let scene = Scene::above(surface.clone(), &mesh, 0.4e-3);
        let upper = Surface::of_sphere(&mesh);
        let other = ContactInterface::new(surface, upper, STIFFNESS, 0.0, 0.4e-3).unwrap();
        check_both(&scene, &other);
    }
    assert_eq!((n_edges, n_whole), (6, 6));
}
