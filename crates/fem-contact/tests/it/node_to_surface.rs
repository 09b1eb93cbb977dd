//! Springs at the nodes of each surface.

use std::f64::consts::PI;

use crate::common::{
    STIFFNESS, assert_balance, assert_gradient, axial, flat, forces, glass_pair, ragged, rigid,
};
use fem_contact::{ContactInterface, Surface};
use fem_mesh::{Side, SphereMesh};

fn interface(meshes: &[SphereMesh; 2], candidate_radius: f64) -> ContactInterface {
    let [lower, upper] = meshes.each_ref().map(Surface::of_sphere);
    ContactInterface::node_to_surface(lower, upper, STIFFNESS, 0.0, candidate_radius).unwrap()
}

/// Radii of the nodes of a surface.
fn radii(mesh: &SphereMesh) -> Vec<f64> {
    mesh.surface().iter().map(|&node| mesh.nodes()[node as usize][0]).collect()
}

/// Returns the tributary area ∫ N_k 2πr dr of node k with its linear shape function N_k; Simpson's rule is exact.
fn hat_area(radii: &[f64], k: usize) -> f64 {
    let piece = |from: f64, to: f64| {
        let middle = 0.5 * (from + to);
        (to - from).abs() / 6.0 * 2.0 * PI * (4.0 * 0.5 * middle + to)
    };
    let inner = if k > 0 { piece(radii[k - 1], radii[k]) } else { 0.0 };
    inner + piece(radii[k + 1], radii[k])
}

/// On equal meshes each node has the consistent share of a uniform pressure, half of it in each pass. Against a wall there
/// is one pass, with all of the area.
#[test]
fn uniform_penetration_loads_nodes_by_their_hats() {
    let meshes = [flat(0.01, Side::Below), flat(0.01, Side::Above)];
    let interface = interface(&meshes, 0.0999);
    // So deep that the 5e-6 m of the surface are 5e-12 of it.
    let depth = 1e6;
    let (total, f) = forces(&interface, &[rigid(&meshes[0], depth), rigid(&meshes[1], 0.0)]);
    let (pressure, radii) = (STIFFNESS / 0.01 * depth, radii(&meshes[0]));
    let n = interface.n_points() / 2;
    assert_eq!((n, total.n_closed), (radii.iter().take_while(|r| **r < 0.0999).count(), 2 * n));
    let areas: f64 = (0..n).map(|k| hat_area(&radii, k)).sum();
    // Element lengths, and with them the penalty, differ by 2.5e-9.
    assert!((total.force / (pressure * areas) - 1.0).abs() < 1e-8);
    for k in 0..n {
        let force = f[0][meshes[0].surface()[k] as usize][1];
        assert!((force / (-pressure * hat_area(&radii, k)) - 1.0).abs() < 1e-8, "{k}");
    }
    let (wall, sphere) = (Surface::wall(), Surface::of_sphere(&meshes[1]));
    let on_wall = ContactInterface::node_to_surface(wall, sphere, STIFFNESS, 0.0, 0.0999).unwrap();
    assert_eq!(on_wall.n_points(), n);
    let (total, _) = forces(&on_wall, &[vec![[0.0; 2]], rigid(&meshes[1], -depth)]);
    assert!((total.force / (pressure * areas) - 1.0).abs() < 1e-8);
}

#[test]
fn node_to_surface_forces_balance_and_derive_from_the_energy() {
    let meshes = glass_pair([30e-6, 37e-6]);
    let interface = interface(&meshes, 0.4e-3);
    let u = ragged(&meshes, 20e-6);
    let (total, f) = forces(&interface, &u);
    assert!(total.n_closed > 5 && total.n_closed < interface.n_points());
    assert_balance(&total, &f);
    // The energy is quadratic, so the difference is exact but for rounding.
    assert_gradient(|u| forces(&interface, u), &u, axial(&interface), [1e-10, 1e-14]);
}
