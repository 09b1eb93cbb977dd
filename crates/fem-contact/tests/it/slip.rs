//! Surfaces that slip on each other: energy, balance, and where it is nothing.

use crate::common::{
    Field, STIFFNESS, assert_balance, assert_gradient, forces, glass_pair, interface, n_closed,
    ragged, sphere,
};
use fem_contact::{ContactForces, ContactInterface, SlippingInterface, Surface};
use fem_mesh::Side;

fn slipping_forces(interface: &SlippingInterface, u: &[Field; 2]) -> (ContactForces, [Field; 2]) {
    let mut f = u.each_ref().map(|u| vec![[0.0; 2]; u.len()]);
    let [lower, upper] = &mut f;
    let total = interface.add_forces([&u[0], &u[1]], [lower, upper]);
    (total, f)
}

/// A pair of two meshed spheres, or one of them rigid, with ragged displacements.
fn scenes() -> Vec<(SlippingInterface, [Field; 2])> {
    let mut scenes = Vec::new();
    for sizes in [[30e-6, 37e-6], [15e-6, 300e-6]] {
        let meshes = glass_pair(sizes);
        let plain = interface(&meshes, 0.4e-3);
        scenes.push((SlippingInterface::new(plain), ragged(&meshes, 20e-6)));
    }
    for rigid_side in 0..2 {
        let side = [Side::Above, Side::Below][rigid_side];
        let mesh = sphere(7.95e-3, 40e-6, 0.5e-3, side);
        let (round, own) = (Surface::rigid_sphere(11.1e-3).unwrap(), Surface::of_sphere(&mesh));
        let [lower, upper] = if rigid_side == 0 { [round, own] } else { [own, round] };
        let plain = ContactInterface::new(lower, upper, STIFFNESS, 0.0, 0.4e-3).unwrap();
        let mut u = ragged(&[mesh.clone(), mesh], 20e-6);
        u[rigid_side] = vec![[0.0, [1.0, -1.0][rigid_side] * 5e-6]];
        scenes.push((SlippingInterface::new(plain), u));
    }
    scenes
}

/// Forces balance and are −∂energy/∂displacement along r and y, including the rotation of the slope.
#[test]
fn slipping_forces_balance_and_derive_from_the_energy() {
    for (interface, u) in scenes() {
        let (total, f) = slipping_forces(&interface, &u);
        assert!(total.n_closed > 10 && total.n_closed < interface.interface().n_points());
        assert_balance(&total, &f);
        // A rigid body does not move along r.
        let of_side = |side: usize| {
            let axes = usize::from(u[side].len() == 1)..2;
            let nodes = interface.interface().candidate_nodes(side);
            nodes.flat_map(move |node| axes.clone().map(move |axis| (side, node as usize, axis)))
        };
        // Rounding of the energy over the step; it is of fourth order in u, whose third derivative is worth
        // (step/20 µm)² of it.
        let freedoms = (0..2).flat_map(of_side);
        let forces = |u: &[Field; 2]| slipping_forces(&interface, u);
        let largest = assert_gradient(forces, &u, freedoms, [1e-10, 1e-13]);
        // Radial forces are not negligible: slopes are up to 0.04, and ragged ones more.
        assert!(largest[0] > 0.01 * largest[1], "{largest:?}");
    }
}

/// Facing points that move alike do not slip: force, pressure and radius are those of the plain
/// interface; only the shares along r are new.
#[test]
fn equal_surface_motion_gives_the_forces_without_slip() {
    let meshes = glass_pair([30e-6, 30e-6]);
    let plain = interface(&meshes, 0.4e-3);
    let slipping = SlippingInterface::new(plain.clone());
    let u = [0, 1].map(|side: usize| {
        let down = -5e-6 * side as f64;
        meshes[side].nodes().iter().map(|[r, _]| [1e-3 * r, down]).collect::<Field>()
    });
    let ((a, f), (b, g)) = (forces(&plain, &u), slipping_forces(&slipping, &u));
    assert!(a.n_closed > 10 && a.n_closed == b.n_closed);
    // u_r of linear elements is linear too: what is left is rounding.
    assert!((a.force - b.force).abs() < 1e-12 * a.force);
    assert!((a.energy - b.energy).abs() < 1e-12 * a.energy);
    for (f, g) in f.iter().zip(&g).flat_map(|(f, g)| f.iter().zip(g)) {
        assert!((f[1] - g[1]).abs() < 1e-12 * a.force && f[0] == 0.0);
    }
    let of = [&u[0][..], &u[1][..]];
    assert!((plain.contact_radius(of) / slipping.contact_radius(of) - 1.0).abs() < 1e-12);
    assert!((plain.centre_pressure(of) / slipping.centre_pressure(of) - 1.0).abs() < 1e-12);
}

/// The slope at the innermost point, 2e-3, takes 1e-8 m of the depth away or adds it.
#[test]
fn is_closed_agrees_with_the_slipping_forces() {
    let meshes = glass_pair([30e-6, 37e-6]);
    let interface = SlippingInterface::new(interface(&meshes, 0.4e-3));
    let n_closed = n_closed(|depth| {
        let mut u = ragged(&meshes, 1e-5);
        u[0].iter_mut().for_each(|u| u[1] = depth);
        u[1].iter_mut().for_each(|u| u[1] = 0.0);
        let at = |side: usize| {
            let u = &u[side];
            move |node: u32| u[node as usize]
        };
        (interface.is_closed([at(0), at(1)]), slipping_forces(&interface, &u).0)
    });
    assert!(n_closed > 5 && n_closed < 35, "{n_closed}");
}

/// More than that of the plain interface by the square of the steeper slope, 0.05 at the end.
#[test]
fn the_stiffness_bound_grows_with_the_slope() {
    let meshes = glass_pair([30e-6, 37e-6]);
    let plain = interface(&meshes, 0.4e-3);
    let slipping = SlippingInterface::new(plain.clone());
    for side in 0..2 {
        let mut bounds = [0, 1].map(|_| vec![0.0; meshes[side].nodes().len()]);
        plain.add_stiffness_bound(side, &mut bounds[0]);
        slipping.add_stiffness_bound(side, &mut bounds[1]);
        let ratios: Vec<f64> = plain
            .candidate_nodes(side)
            .map(|node| bounds[1][node as usize] / bounds[0][node as usize])
            .collect();
        assert!(ratios.windows(2).all(|pair| pair[1] > pair[0]), "{ratios:?}");
        let last = ratios[ratios.len() - 1] - 1.0;
        assert!((last / (0.4e-3f64 / 7.95e-3).powi(2) - 1.0).abs() < 0.1, "{last}");
    }
}
