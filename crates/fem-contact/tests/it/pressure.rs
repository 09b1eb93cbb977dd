//! Force and pressures at the nodes of an imposed Hertzian contact.

use std::f64::consts::PI;

use crate::common::{Field, STIFFNESS, forces, glass_pair, interface, rigid, tributary_area};
use fem_mesh::SphereMesh;

const CONTACT_RADIUS: f64 = 0.223e-3;
const PEAK_PRESSURE: f64 = 1.027e9;

/// Displacements that make the penalty pressure at the nodes Hertz', p₀ √(1 − r²/a²), and open
/// the gap outside as steeply. Between nodes the arcs sag below the chords of the displacement;
/// at both Gauss points by h²/12R*, which is made up for.
fn hertzian(meshes: &[SphereMesh; 2], size: f64) -> [Field; 2] {
    let arc = |r: f64, radius: f64| radius - (radius * radius - r * r).sqrt();
    let displacement = |r: f64| {
        let x = (r / CONTACT_RADIUS).powi(2) - 1.0;
        let pressure = -PEAK_PRESSURE * x.signum() * x.abs().sqrt();
        let sag = size * size / 12.0 * (1.0 / 11.1e-3 + 1.0 / 7.95e-3);
        arc(r, 11.1e-3) + arc(r, 7.95e-3) - sag + pressure * size / STIFFNESS
    };
    let field = |mesh: &SphereMesh, share: f64| {
        mesh.nodes()
            .iter()
            .map(|&[r, _]| [0.0, share * displacement(r.min(0.5e-3))])
            .collect::<Vec<_>>()
    };
    [field(&meshes[0], 0.5), field(&meshes[1], -0.5)]
}

#[test]
fn force_and_nodal_pressures_of_hertz_are_recovered() {
    let exact = 2.0 / 3.0 * PI * CONTACT_RADIUS.powi(2) * PEAK_PRESSURE;
    let errors = [40e-6, 20e-6, 10e-6].map(|size| {
        let meshes = glass_pair([size, size]);
        let interface = interface(&meshes, 0.45e-3);
        let u = hertzian(&meshes, size);
        let both = [u[0].as_slice(), u[1].as_slice()];
        let nodes = interface.nodal_pressure(both);
        let hertz = |r: f64| PEAK_PRESSURE * (1.0 - (r / CONTACT_RADIUS).powi(2)).max(0.0).sqrt();
        let inner = nodes.take_while(|(r, _)| *r < 0.5 * CONTACT_RADIUS);
        let worst = inner.map(|(r, p)| (p / hertz(r) - 1.0).abs()).fold(0.0, f64::max);
        let force = forces(&interface, &u).0.force / exact - 1.0;
        [worst, force]
    });
    // At 5.6, 11 and 22 elements a contact radius; measured are 1.3 and 2.9 % at the first.
    assert!(errors[0][0].abs() < 0.015 && errors[0][1].abs() < 0.03, "{errors:?}");
    for pair in errors.windows(2) {
        for k in 0..2 {
            // Second order, but that the rim falls into an element at another place each time.
            let order = (pair[0][k] / pair[1][k]).log2();
            assert!((1.6..2.4).contains(&order), "{order} {errors:?}");
        }
    }
}

/// Nodal pressures are nodal forces over nodal areas, so they give the force back.
#[test]
fn nodal_pressures_add_up_to_the_force() {
    for sizes in [[30e-6, 30e-6], [30e-6, 37e-6], [15e-6, 100e-6]] {
        let meshes = glass_pair(sizes);
        let interface = interface(&meshes, 0.4e-3);
        let u = [rigid(&meshes[0], 8e-6), rigid(&meshes[1], 0.0)];
        let (total, f) = forces(&interface, &u);
        let mut sum = 0.0;
        let pressures = interface.nodal_pressure([&u[0], &u[1]]);
        // At the nodes of the coarser mesh; the upper body is pushed up.
        let side = usize::from(sizes[1] > sizes[0]);
        let (mesh, sign) = (&meshes[side], [1.0, -1.0][side]);
        for (k, (r, p)) in pressures.enumerate() {
            let node = mesh.surface()[k] as usize;
            assert_eq!(r, mesh.nodes()[node][0]);
            let area = tributary_area(mesh, k);
            // Where pieces are joined, nodes that lie 1e-5 of a segment apart share one's area; the
            // contact ends well before the candidates do.
            let off = (p * area + sign * f[side][node][1]).abs() / total.force;
            assert!(off < 2e-6, "{sizes:?} {k}: {off:e}");
            sum += p * area;
        }
        assert!((sum / total.force - 1.0).abs() < 2e-6, "{sum} {total:?}");
    }
}
