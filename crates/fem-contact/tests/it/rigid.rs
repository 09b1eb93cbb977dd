//! A rigid sphere: its arc, its one node, where it ends.

use crate::common::{STIFFNESS, forces, sphere};
use fem_contact::{ContactError, ContactInterface, NodalContact, Surface};
use fem_mesh::Side;

/// A plate that deforms under a rigid sphere, or over one.
fn interface(rigid_side: usize, radius: f64) -> (ContactInterface, usize) {
    let mesh = sphere(7.95e-3, 40e-6, 0.5e-3, [Side::Above, Side::Below][rigid_side]);
    let (round, other) = (Surface::rigid_sphere(radius).unwrap(), Surface::of_sphere(&mesh));
    let [lower, upper] = if rigid_side == 0 { [round, other] } else { [other, round] };
    let made = ContactInterface::new(lower, upper, STIFFNESS, 0.0, 0.4e-3).unwrap();
    (made, mesh.nodes().len())
}

/// The overlap of two arcs, as of meshed spheres, all of its force on one node.
#[test]
fn a_rigid_sphere_overlaps_with_its_true_arc() {
    let effective_radius = 1.0 / (1.0 / 11.1e-3 + 1.0 / 7.95e-3);
    let depth = 5e-6;
    for rigid_side in 0..2 {
        let (interface, n_nodes) = interface(rigid_side, 11.1e-3);
        let sign = if rigid_side == 0 { 1.0 } else { -1.0 };
        let mut u = [vec![[0.0; 2]; n_nodes], vec![[0.0; 2]; n_nodes]];
        u[rigid_side] = vec![[0.0, sign * depth]];
        let (total, f) = forces(&interface, &u);
        // Two Gauss points see the rim, a kink, to (h/a)²/10 = 0.4 %.
        let force = STIFFNESS / 40e-6 * std::f64::consts::PI * effective_radius * depth * depth;
        assert!((total.force / force - 1.0).abs() < 5e-3, "{} {force}", total.force);
        let radius = interface.contact_radius([&u[0], &u[1]]);
        // As of meshed spheres, half an element.
        assert!((radius - (2.0 * effective_radius * depth).sqrt()).abs() < 0.5 * 40e-6);
        assert!((f[rigid_side][0][1] + sign * total.force).abs() < 1e-13 * total.force);
        let on_other: f64 = f[1 - rigid_side].iter().map(|f| f[1]).sum();
        assert!((on_other - sign * total.force).abs() < 1e-13 * total.force);
        // The pressure is that on the nodes of the other body.
        assert!(interface.nodal_pressure([&u[0], &u[1]]).take_while(|(_, p)| *p > 0.0).count() > 5);
        assert_eq!(interface.candidate_nodes(rigid_side).collect::<Vec<_>>(), [0]);
    }
}

/// Nothing is looked for beyond a small sphere's own radius, at Gauss points and at nodes.
#[test]
fn contact_ends_where_the_sphere_does() {
    let mesh = sphere(7.95e-3, 40e-6, 0.5e-3, Side::Below);
    let (own, round) = (Surface::of_sphere(&mesh), Surface::rigid_sphere(0.25e-3).unwrap());
    let interface =
        ContactInterface::new(own.clone(), round.clone(), STIFFNESS, 0.0, 0.4e-3).unwrap();
    assert_eq!(interface.candidate_radius(), 0.25e-3);
    assert!(interface.points().iter().all(|point| point.radius < 0.25e-3));
    assert!(interface.points().iter().all(|point| point.initial_gap.is_finite()));
    let nodal = NodalContact::new([&own, &round], 0.0, 0.4e-3).unwrap();
    assert_eq!((nodal.side, nodal.points.len()), (0, 7));
    assert!(nodal.shares.iter().all(Vec::is_empty));
    // By hand: R − √(R² − r²) of both at r = 0.2 mm, where meshes keep their element size.
    let point = nodal.points[5];
    let arc = |radius: f64| radius - (radius * radius - point.radius * point.radius).sqrt();
    assert!((point.initial_gap / (arc(7.95e-3) + arc(0.25e-3)) - 1.0).abs() < 1e-10);
}

#[test]
fn impossible_spheres_are_refused() {
    for bad in [0.0, -1.0, f64::NAN, f64::INFINITY, 1e-310] {
        match Surface::rigid_sphere(bad) {
            Err(ContactError::NotPositive { name, value }) => {
                assert_eq!(name, "radius of a rigid sphere");
                assert_eq!(value.to_bits(), bad.to_bits());
            }
            other => panic!("{other:?}"),
        }
    }
    let [wall, round] = [Surface::wall(), Surface::rigid_sphere(1.0).unwrap()];
    assert!(wall.is_wall() && wall.is_rigid() && round.is_rigid() && !round.is_wall());
    for [lower, upper] in [[&wall, &round], [&round, &wall], [&round, &round]] {
        let made = ContactInterface::new(lower.clone(), upper.clone(), 1.0, 0.0, 1.0);
        assert_eq!(made, Err(ContactError::BothRigid));
        assert!(NodalContact::new([lower, upper], 0.0, 1.0).is_err());
    }
}
