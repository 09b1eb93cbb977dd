//! The diagonal bound of the contact stiffness.

use crate::common::{
    Field, STIFFNESS, forces, glass_pair, interface, largest_quotient, ragged, rigid, sphere,
};
use fem_contact::{ContactInterface, Surface};
use fem_mesh::Side;

/// Largest eigenvalue of D^−1/2 K D^−1/2, K the contact stiffness of the points that `u` closes
/// and D the bound, of bodies that are no walls. Forces are linear while none opens or closes.
fn quotient_at(interface: &ContactInterface, u: &[Field; 2], is_wall: [bool; 2]) -> f64 {
    let (mut bound, mut freedoms) = (Vec::new(), Vec::new());
    for side in (0..2).filter(|side| !is_wall[*side]) {
        let mut of_side = vec![0.0; u[side].len()];
        interface.add_stiffness_bound(side, &mut of_side);
        for (node, d) in of_side.into_iter().enumerate().filter(|(_, d)| *d > 0.0) {
            freedoms.push((side, node));
            bound.push(d);
        }
    }
    let (before, f) = forces(interface, u);
    let step = 1e-9;
    // Differences of forces: 1e-16 · displacement / step.
    largest_quotient(&bound, 1e-10, |j| {
        let ((side, node), mut moved) = (freedoms[j], u.clone());
        moved[side][node][1] += step;
        let (after, g) = forces(interface, &moved);
        assert_eq!(after.n_closed, before.n_closed);
        freedoms.iter().map(|&(side, node)| (f[side][node][1] - g[side][node][1]) / step).collect()
    })
}

/// The bound takes the springs four times (for opening and closing within a few steps). Without that it is
/// sharp: a row of |K| sums to the bound, so the quotient of all springs closed is 1/4, and that
/// of any other pattern is less.
#[test]
fn bound_is_never_below_the_penalty_springs() {
    for sizes in [[50e-6, 50e-6], [50e-6, 37e-6], [25e-6, 300e-6]] {
        let meshes = glass_pair(sizes);
        let interface = interface(&meshes, 0.4e-3);
        let closed = [rigid(&meshes[0], 50e-6), rigid(&meshes[1], 0.0)];
        let all = quotient_at(&interface, &closed, [false; 2]);
        let some = quotient_at(&interface, &ragged(&meshes, 20e-6), [false; 2]);
        // Forces are differenced: 1e-16 · displacement / step.
        assert!((all - 0.25).abs() < 1e-10, "{sizes:?}: {all}");
        assert!(some < all && some > 0.15, "{sizes:?}: {some}");
    }
}

/// Sum of a side's bound, N/m.
fn sum_of_bound(interface: &ContactInterface, side: usize, n_nodes: usize) -> f64 {
    let mut bound = vec![0.0; n_nodes];
    interface.add_stiffness_bound(side, &mut bound);
    bound.iter().sum()
}

/// However the bound is shared, it is a bound, and a sharp one: bodies that move as a whole against
/// each other reach it. A light sphere takes half of it, as a body that deforms does; a heavy one is
/// a wall to the other body, and on all springs has the frequency of two rigid bodies.
#[test]
fn bound_is_shared_with_a_rigid_sphere_by_the_masses() {
    let mesh = sphere(7.95e-3, 50e-6, 0.5e-3, Side::Above);
    let n_nodes = mesh.nodes().len();
    let make = |lower: Surface| {
        ContactInterface::new(lower, Surface::of_sphere(&mesh), STIFFNESS, 0.0, 0.4e-3).unwrap()
    };
    let wall = make(Surface::wall());
    let springs = sum_of_bound(&wall, 1, n_nodes);
    let closed = [vec![[0.0; 2]], rigid(&mesh, -50e-6)];
    // Against a wall there is one spring; as above.
    let quotient = quotient_at(&wall, &closed, [true, false]);
    assert!((quotient - 0.25).abs() < 1e-10, "{quotient}");
    let plain = make(Surface::rigid_sphere(11.1e-3).unwrap());
    assert_eq!(plain, plain.clone().with_rigid_mass(1.0));
    for (ratio, on_mesh, on_sphere) in [
        (1e-3, 2.0, 2.0),
        (1.0, 2.0, 2.0),
        (4.0, 1.25, 5.0),
        (1e6, 1.0 + 1e-6, 1.0 + 1e6),
        (1e300, 1.0, 2f64.powi(52) + 1.0),
    ] {
        let shared = plain.clone().with_rigid_mass(ratio);
        for (side, n, expected) in [(0, 1, on_sphere), (1, n_nodes, on_mesh)] {
            let found = sum_of_bound(&shared, side, n) / springs;
            assert!((found / expected - 1.0).abs() < 1e-13, "{ratio:e} {side}: {found}");
        }
        let quotient = quotient_at(&shared, &closed, [false; 2]);
        // As above.
        assert!((quotient - 0.25).abs() < 1e-10, "{ratio:e}: {quotient}");
    }
    assert_eq!(wall, wall.clone().with_rigid_mass(4.0));
}
