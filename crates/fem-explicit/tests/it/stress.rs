//! Stress recovery from displacements.

use fem_explicit::FreeMotion;
use fem_material::Material;

use crate::common::{elastic, unit_sphere};

fn material() -> Material {
    elastic(1.0, 0.244, 1.0)
}

/// The unit sphere with `n` elements over its radius, displaced.
fn displaced(n: f64, displacement: impl Fn([f64; 2]) -> [f64; 2]) -> FreeMotion {
    let mut sphere = FreeMotion::new(unit_sphere(n), &material(), 0.9).unwrap();
    sphere.set_displacement(displacement);
    sphere
}

#[test]
fn uniform_strain_gives_uniform_stress() {
    let sphere = displaced(8.0, |[r, y]| [-0.2 * r, 7.0 + 0.5 * y]);
    let (body, stress) = (sphere.body(), sphere.stress());
    let exact = material().instantaneous().stress([-0.2, 0.5, -0.2, 0.0]);
    assert_eq!(stress.cells.len(), body.n_elements());
    assert_eq!(stress.points.len(), body.n_nodes());
    for found in stress.cells.iter().chain(&stress.points) {
        for (found, exact) in found.iter().zip(exact) {
            // Rounding of a rigid translation of 7 over elements of 1/8.
            assert!((found - exact).abs() < 1e-12, "{found:?} {exact:?}");
        }
    }
}

/// A smooth displacement whose stress is quadratic: u_r = r(0.3y + 0.2y² + 0.5r²),
/// u_y = 0.4y² + 0.3r²y + 0.1r².
fn bent([r, y]: [f64; 2]) -> [f64; 2] {
    [r * (0.3 * y + 0.2 * y * y + 0.5 * r * r), 0.4 * y * y + 0.3 * r * r * y + 0.1 * r * r]
}

fn bent_stress([r, y]: [f64; 2]) -> [f64; 4] {
    let hoop = 0.3 * y + 0.2 * y * y + 0.5 * r * r;
    let shear = r * (0.3 + 0.4 * y) + 0.6 * r * y + 0.2 * r;
    material().instantaneous().stress([hoop + r * r, 0.8 * y + 0.3 * r * r, hoop, shear])
}

/// Worst error of the point stresses inside, on the axis and on the surface.
fn errors(n: f64) -> [f64; 3] {
    let sphere = displaced(n, bent);
    let (mesh, stress) = (sphere.body().mesh().unwrap(), sphere.stress());
    let mut worst = [0.0; 3];
    for (node, found) in stress.points.iter().enumerate() {
        let p = mesh.nodes()[node];
        let place = match node as u32 {
            node if mesh.axis().contains(&node) => 1,
            node if mesh.surface().contains(&node) => 2,
            _ => 0,
        };
        for (found, exact) in found.iter().zip(bent_stress(p)) {
            worst[place] = f64::max(worst[place], (found - exact).abs());
        }
    }
    worst
}

#[test]
fn point_stresses_converge_at_second_order() {
    let (coarse, fine) = (errors(64.0), errors(128.0));
    for (coarse, fine) in coarse.into_iter().zip(fine) {
        // 1.91, 1.82 and 1.91 inside, on the axis and on the surface; 1.82, 1.99 and 1.76 on
        // meshes twice as coarse.
        let order = (coarse / fine).log2();
        assert!((1.7..2.2).contains(&order), "{order}: {coarse} {fine}");
    }
    // The largest element, at the far pole, is 1/32, the stress 3 and its second derivative 4.
    assert!(fine.iter().all(|&error| error < 4e-3), "{fine:?}");
}
