//! Contact forces: patch test, balance, energy, the wall, the end of the candidates.

use std::f64::consts::PI;

use crate::common::{
    STIFFNESS, assert_balance, assert_gradient, axial, flat, forces, glass_pair, interface,
    n_closed, ragged, rigid, sphere, tributary_area,
};
use fem_contact::{ContactError, ContactInterface, DeformedInterface, Surface};
use fem_mesh::Side;

/// A uniform penetration makes the pressure kδ, for any meshes and on a wall: the total is kδ times the
/// area, and each node of each side carries its consistent share. Against a wall the penalty is that over the length of
/// the sphere's segment alone.
#[test]
fn uniform_penetration_passes_the_patch_test() {
    let pairs = [[0.01, 0.01], [0.01, 0.013], [0.013, 0.01], [0.01, 0.2], [0.2, 0.01]];
    let walls = [[None, Some(0.01)], [Some(0.01), None]];
    for sizes in pairs.map(|sizes| sizes.map(Some)).into_iter().chain(walls) {
        let sides = [(sizes[0], Side::Below), (sizes[1], Side::Above)];
        let meshes = sides.map(|(size, side)| size.map(|size| flat(size, side)));
        let [lower, upper] =
            meshes.each_ref().map(|mesh| mesh.as_ref().map_or(Surface::wall(), Surface::of_sphere));
        let interface = ContactInterface::new(lower, upper, STIFFNESS, 0.0, 0.0999).unwrap();
        let radius = interface.candidate_radius();
        // So deep that the 5e-6 m of the surface are 5e-12 of it.
        let depth = 1e6;
        let u = [0, 1].map(|side: usize| {
            let n_nodes = meshes[side].as_ref().map_or(1, |mesh| mesh.nodes().len());
            vec![[0.0, [0.25, -0.75][side] * depth]; n_nodes]
        });
        let (total, f) = forces(&interface, &u);
        let lengths: Vec<f64> = sizes.into_iter().flatten().collect();
        let length = lengths.iter().sum::<f64>() / lengths.len() as f64;
        let pressure = STIFFNESS / length * depth;
        // Element lengths, and with them the penalty, differ by 2.5e-9.
        let tolerance = 1e-8;
        assert!((total.force / (pressure * PI * radius * radius) - 1.0).abs() < tolerance);
        assert!((total.energy / (0.5 * total.force * depth) - 1.0).abs() < tolerance);
        assert_eq!(total.n_closed, interface.n_points());
        for (side, sign) in [-1.0, 1.0].into_iter().enumerate() {
            let sum: f64 = f[side].iter().map(|f| f[1]).sum();
            assert!((sum - sign * total.force).abs() < 1e-14 * total.force, "{sizes:?}: {sum}");
            let Some(mesh) = &meshes[side] else { continue };
            let r = |k: usize| mesh.nodes()[mesh.surface()[k] as usize][0];
            let inside =
                (0..mesh.surface().len() / 2).take_while(|k| r(k + 1) <= radius * (1.0 + 1e-9));
            for k in inside {
                let (area, force) =
                    (tributary_area(mesh, k), f[side][mesh.surface()[k] as usize][1]);
                assert!((force / (sign * pressure * area) - 1.0).abs() < tolerance, "{sizes:?}");
            }
        }
        for (r, p) in interface.nodal_pressure([&u[0], &u[1]]) {
            assert!((p / pressure - 1.0).abs() < tolerance, "{sizes:?}: {p} at {r}");
        }
    }
}

/// Forces balance, are frictionless, and are −∂energy/∂displacement on both sides, with points that are open.
#[test]
fn straight_contact_forces_balance_and_derive_from_the_energy() {
    for sizes in [[30e-6, 30e-6], [30e-6, 37e-6], [15e-6, 300e-6]] {
        let meshes = glass_pair(sizes);
        let (interface, u) = (interface(&meshes, 0.4e-3), ragged(&meshes, 20e-6));
        let (total, f) = forces(&interface, &u);
        assert!(total.n_closed > 10 && total.n_closed < interface.n_points());
        assert_balance(&total, &f);
        assert!(f.iter().flatten().all(|f| f[0] == 0.0), "the contact is frictionless");
        // The energy is quadratic, so the difference is exact but for rounding.
        assert_gradient(|u| forces(&interface, u), &u, axial(&interface), [1e-10, 1e-14]);
    }
}

#[test]
fn open_contact_has_no_force_radius_or_pressure() {
    let meshes = glass_pair([30e-6, 30e-6]);
    let interface = interface(&meshes, 0.4e-3);
    let u = [rigid(&meshes[0], 0.0), rigid(&meshes[1], 1e-12)];
    let (total, f) = forces(&interface, &u);
    assert_eq!(total, Default::default());
    assert!(f.iter().flatten().all(|f| *f == [0.0; 2]));
    assert_eq!(interface.contact_radius([&u[0], &u[1]]), 0.0);
    assert_eq!(interface.centre_pressure([&u[0], &u[1]]), 0.0);
}

/// Rigid spheres that overlap by δ touch within the radius a = √(2R*δ) of the true arcs, where elastic
/// ones of this pressure would end within half an element of it, and the
/// penalty carries kπR*δ². Chords instead of arcs would add h²/6R*δ = 1.1 % to it.
#[test]
fn overlap_is_that_of_the_true_arcs() {
    let size = 40e-6;
    let meshes = glass_pair([size, size]);
    let interface = interface(&meshes, 0.4e-3);
    let (depth, effective_radius) = (5e-6, 1.0 / (1.0 / 11.1e-3 + 1.0 / 7.95e-3));
    let u = [rigid(&meshes[0], 0.0), rigid(&meshes[1], -depth)];
    let (total, _) = forces(&interface, &u);
    let overlap_radius = (2.0 * effective_radius * depth).sqrt();
    let radius = interface.contact_radius([&u[0], &u[1]]);
    assert!((radius - overlap_radius).abs() < 0.5 * size, "{radius} {overlap_radius}");
    // Two Gauss points see the rim, a kink, to (h/a)²/10 = 0.4 %; k varies by 1e-4.
    let force = STIFFNESS / size * PI * effective_radius * depth * depth;
    assert!((total.force / force - 1.0).abs() < 5e-3, "{} {force}", total.force);
}

/// Rigid spheres close from the axis outward, point by point.
#[test]
fn limit_is_reached_when_the_outermost_point_closes() {
    let meshes = glass_pair([30e-6, 30e-6]);
    let interface = interface(&meshes, 0.3e-3);
    let mut n_at_limit = 0;
    // The last point lies at 0.31 to 0.33 mm, where the arcs are r²/2R* = 11 µm apart.
    for k in 0..200 {
        let u = [rigid(&meshes[0], 8e-6 + 2e-8 * f64::from(k)), rigid(&meshes[1], 0.0)];
        let (total, _) = forces(&interface, &u);
        assert_eq!(total.at_limit, total.n_closed == interface.n_points());
        n_at_limit += usize::from(total.at_limit);
    }
    assert!(n_at_limit > 0 && n_at_limit < 150, "{n_at_limit}");
}

#[test]
fn is_closed_agrees_with_the_straight_contact_forces() {
    let meshes = glass_pair([30e-6, 37e-6]);
    let interface = interface(&meshes, 0.4e-3);
    let n_closed = n_closed(|depth| {
        let u = [rigid(&meshes[0], depth), rigid(&meshes[1], 0.0)];
        let at = |side: usize| {
            let u = &u[side];
            move |node: u32| u[node as usize][1]
        };
        (interface.is_closed([at(0), at(1)]), forces(&interface, &u).0)
    });
    assert!(n_closed > 10 && n_closed < 30, "{n_closed}");
}

#[test]
fn candidates_end_at_the_first_node_beyond_the_radius_asked_for() {
    let meshes = glass_pair([30e-6, 37e-6]);
    let interface = interface(&meshes, 0.3e-3);
    let radius = interface.candidate_radius();
    assert!((0.3e-3..0.3e-3 + 30e-6).contains(&radius), "{radius}");
    for side in 0..2 {
        let r = |node: u32| meshes[side].nodes()[node as usize][0];
        assert!(interface.candidate_nodes(side).all(|node| r(node) <= radius * (1.0 + 1e-12)));
        let n = interface.candidate_nodes(side).count();
        assert!(r(meshes[side].surface()[n]) > radius);
    }
    // However large the radius, only near hemispheres touch, as far as both reach.
    let all = crate::common::interface(&meshes, 1.0);
    assert!((all.candidate_radius() / 7.95e-3 - 1.0).abs() < 0.01, "{}", all.candidate_radius());
}

/// Two rigid bodies and numbers that are not positive are rejected by all interfaces.
#[test]
fn impossible_interfaces_are_refused() {
    let sphere = Surface::of_sphere(&sphere(1.0, 0.1, 0.3, Side::Above));
    type Make = fn(Surface, Surface, f64, f64) -> Result<(), ContactError>;
    let makes: [Make; 3] = [
        |a, b, stiffness, r| ContactInterface::new(a, b, stiffness, 0.0, r).map(|_| ()),
        |a, b, stiffness, r| ContactInterface::node_to_surface(a, b, stiffness, 0.0, r).map(|_| ()),
        |a, b, stiffness, r| DeformedInterface::new(a, b, stiffness, 0.0, r).map(|_| ()),
    ];
    for make in makes {
        let on_wall = |stiffness, radius| make(Surface::wall(), sphere.clone(), stiffness, radius);
        assert!(on_wall(1.0, 1.0).is_ok());
        for bad in [0.0, -1.0, f64::NAN, f64::INFINITY] {
            for (made, name) in
                [(on_wall(bad, 1.0), "penalty stiffness"), (on_wall(1.0, bad), "candidate radius")]
            {
                let Err(ContactError::NotPositive { name: found, value }) = made else { panic!() };
                assert_eq!((found, value.to_bits()), (name, bad.to_bits()));
            }
        }
        let walls = make(Surface::wall(), Surface::wall(), 1.0, 1.0);
        assert_eq!(walls, Err(ContactError::BothRigid));
    }
}
