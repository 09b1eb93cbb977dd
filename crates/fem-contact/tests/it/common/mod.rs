//! Surfaces and displacements for the tests.

#![allow(dead_code, reason = "each test file uses its share")]

use fem_contact::{ContactForces, ContactInterface, Surface};
use fem_mesh::{HalfDisc, Side, SphereMesh, segment_measures};
use nalgebra::DMatrix;

/// Displacements or forces, one pair (r, y) a node.
pub type Field = Vec<[f64; 2]>;

/// Penalty factor times contact modulus of the tests, Pa.
pub const STIFFNESS: f64 = 3e11;

/// Numbers in −1/2 .. 1/2 without pattern: the golden ratio's multiples.
pub fn noise(k: usize) -> f64 {
    (k as f64 * 0.618_033_988_749_895 + 0.29).fract() - 0.5
}

pub fn sphere(radius: f64, size: f64, refined_radius: f64, side: Side) -> SphereMesh {
    HalfDisc { radius, contact_element_size: size, refined_radius, growth: None, edge: None }
        .build()
        .unwrap()
        .on_side(side)
}

/// A sphere so large (1 km) that its surface is flat: over 0.1 m, elements differ in length by
/// 2.5e-9, and the surface rises 5e-6 m.
pub fn flat(size: f64, side: Side) -> SphereMesh {
    sphere(1e3, size, (10.0 * size).max(0.1), side)
}

/// The glass pair of the paper with the given element sizes.
pub fn glass_pair(sizes: [f64; 2]) -> [SphereMesh; 2] {
    [sphere(11.1e-3, sizes[0], 0.5e-3, Side::Below), sphere(7.95e-3, sizes[1], 0.5e-3, Side::Above)]
}

pub fn interface(meshes: &[SphereMesh; 2], candidate_radius: f64) -> ContactInterface {
    let [lower, upper] = meshes.each_ref().map(Surface::of_sphere);
    ContactInterface::new(lower, upper, STIFFNESS, 0.0, candidate_radius).unwrap()
}

/// The same displacement along y for every node.
pub fn rigid(mesh: &SphereMesh, displacement: f64) -> Field {
    vec![[0.0, displacement]; mesh.nodes().len()]
}

/// Forces of a configuration on both bodies.
pub fn forces(interface: &ContactInterface, u: &[Field; 2]) -> (ContactForces, [Field; 2]) {
    let mut f = u.each_ref().map(|u| vec![[0.0; 2]; u.len()]);
    let [lower, upper] = &mut f;
    let total = interface.add_forces([&u[0], &u[1]], [lower, upper]);
    (total, f)
}

/// Asserts that forces of a configuration balance.
pub fn assert_balance(total: &ContactForces, f: &[Field; 2]) {
    let [lower, upper] = f.each_ref().map(|f| f.iter().map(|f| f[1]).sum::<f64>());
    // Rounding of some hundred terms.
    assert!((lower + total.force).abs() < 1e-13 * total.force, "{lower} {total:?}");
    assert!((upper - total.force).abs() < 1e-13 * total.force, "{upper} {total:?}");
}

/// A degree of freedom: side, node and axis (r, y).
pub type Freedom = (usize, usize, usize);

/// The freedoms along y of the nodes that may touch.
pub fn axial(interface: &ContactInterface) -> Vec<Freedom> {
    let of_side = |side| interface.candidate_nodes(side).map(move |node| (side, node as usize, 1));
    (0..2).flat_map(of_side).collect()
}

/// Asserts that forces are −∂energy/∂displacement, by central differences of a step, to a tolerance of the energy over
/// the step, and returns the largest ones along r and y.
pub fn assert_gradient(
    forces: impl Fn(&[Field; 2]) -> (ContactForces, [Field; 2]),
    u: &[Field; 2],
    freedoms: impl IntoIterator<Item = Freedom>,
    [step, tolerance]: [f64; 2],
) -> [f64; 2] {
    let (total, f) = forces(u);
    let mut largest = [0.0f64; 2];
    for (side, node, axis) in freedoms {
        let energy = |change: f64| {
            let mut moved = u.clone();
            moved[side][node][axis] += change;
            forces(&moved).0.energy
        };
        let slope = (energy(step) - energy(-step)) / (2.0 * step);
        let error = (f[side][node][axis] + slope).abs();
        assert!(
            error < tolerance * total.energy / step,
            "{side} {node} {axis}: {error:e} {total:?}"
        );
        largest[axis] = largest[axis].max(slope.abs());
    }
    largest
}

/// Returns the largest eigenvalue of D^−1/2 K D^−1/2, D the bounds and K symmetric but for a share of its largest entry.
pub fn largest_quotient(bound: &[f64], asymmetry: f64, column: impl Fn(usize) -> Vec<f64>) -> f64 {
    let columns: Vec<_> = (0..bound.len()).map(column).collect();
    let matrix = DMatrix::from_fn(bound.len(), bound.len(), |i, j| columns[j][i]);
    let found = (&matrix - matrix.transpose()).amax() / matrix.amax();
    assert!(found < asymmetry, "{found:e}");
    let scaled = DMatrix::from_fn(bound.len(), bound.len(), |i, j| {
        0.5 * (matrix[(i, j)] + matrix[(j, i)]) / (bound[i] * bound[j]).sqrt()
    });
    scaled.symmetric_eigenvalues().max()
}

/// Returns ∫N 2πr dr over the plane for the k-th node of a surface.
pub fn tributary_area(mesh: &SphereMesh, k: usize) -> f64 {
    let place = |k: usize| [mesh.nodes()[mesh.surface()[k] as usize][0], 0.0];
    let inner = if k > 0 { segment_measures(place(k - 1), place(k))[1] } else { 0.0 };
    inner + segment_measures(place(k), place(k + 1))[0]
}

/// Displacements without pattern that close the contact of the glass pair in places.
pub fn ragged(meshes: &[SphereMesh; 2], depth: f64) -> [Field; 2] {
    [0, 1].map(|side: usize| {
        let sign = if side == 0 { 1.0 } else { -1.0 };
        let n = meshes[side].nodes().len();
        let value = |k: usize| sign * depth * (0.2 + 2.0 * noise(2 * k + side));
        (0..n).map(|k| [depth * noise(k), value(k)]).collect()
    })
}

/// Asserts that a contact says at forty depths of no pattern that it is closed where forces say so, and counts these.
/// The innermost point closes at 4e-9 m.
pub fn n_closed(closed_and_total: impl Fn(f64) -> (bool, ContactForces)) -> usize {
    let is_closed = |sample| {
        let (closed, total) = closed_and_total(4e-8 * noise(sample));
        assert_eq!(closed, total.n_closed > 0, "{sample}");
        closed
    };
    (0..40).filter(|&sample| is_closed(sample)).count()
}
