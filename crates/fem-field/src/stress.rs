//! Stress from a snapshot.

use fem_element::QuadGeometry;
use fem_material::{ActsOn, Material};
use fem_mesh::SphereMesh;
use nalgebra::{Matrix3, Vector3};

use crate::snapshot::BodyFields;

/// Cauchy stress (σ_rr, σ_yy, σ_θθ, σ_ry), tension positive, Pa.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct StressField {
    /// Mean stress of each element.
    pub cells: Vec<[f64; 4]>,
    /// Smooth stress at each node: the linear field that fits the elements
    /// around best (superconvergent patch recovery, Zienkiewicz & Zhu 1992).
    pub points: Vec<[f64; 4]>,
}

impl StressField {
    /// Recovers the stress of a body.
    pub fn of(mesh: &SphereMesh, material: &Material, fields: &BodyFields) -> Self {
        let moduli = material.instantaneous();
        let relaxed = if fields.effective.is_empty() { None } else { material.relaxation() };
        let shear_field = if relaxed.is_some() { &fields.effective } else { &fields.displacement };
        let bulk_field = match relaxed {
            Some(series) if series.acts_on() == ActsOn::All => &fields.effective,
            _ => &fields.displacement,
        };
        let cells = (0..mesh.quads().len())
            .map(|element| {
                let geometry = QuadGeometry::new(&mesh.corners(element));
                let at = |field: &[[f64; 2]]| {
                    geometry.mean_strain(&mesh.quads()[element].map(|node| field[node as usize]))
                };
                let (mut strain, bulk) = (at(shear_field), at(bulk_field));
                // The mean part is replaced by that of the bulk field.
                let trace = |e: &[f64; 4]| e[0] + e[1] + e[2];
                let shift = (trace(&bulk) - trace(&strain)) / 3.0;
                strain[..3].iter_mut().for_each(|e| *e += shift);
                moduli.stress(strain)
            })
            .collect::<Vec<_>>();
        let points = recover(mesh, &cells);
        Self { cells, points }
    }
}

/// Pressure −tr σ / 3 and von Mises' equivalent stress of (σ_rr, σ_yy, σ_θθ, σ_ry).
pub fn invariants([rr, yy, tt, ry]: [f64; 4]) -> (f64, f64) {
    let pressure = -(rr + yy + tt) / 3.0;
    let square = 0.5 * ((rr - yy).powi(2) + (yy - tt).powi(2) + (tt - rr).powi(2));
    (pressure, (square + 3.0 * ry * ry).sqrt())
}

fn recover(mesh: &SphereMesh, cells: &[[f64; 4]]) -> Vec<[f64; 4]> {
    let n_nodes = mesh.nodes().len();
    let mut around: Vec<Vec<u32>> = vec![Vec::with_capacity(4); n_nodes];
    for (element, quad) in mesh.quads().iter().enumerate() {
        for &node in quad {
            around[node as usize].push(element as u32);
        }
    }
    let centre = |element: u32| {
        let corners = mesh.corners(element as usize);
        [0, 1].map(|axis: usize| corners.iter().map(|corner| corner[axis]).sum::<f64>() / 4.0)
    };
    let mut on_boundary = vec![false; n_nodes];
    for &node in mesh.axis().iter().chain(mesh.surface()) {
        on_boundary[node as usize] = true;
    }
    let mut points: Vec<[f64; 4]> = (0..n_nodes)
        .map(|node| {
            let mut patch = around[node].clone();
            if on_boundary[node] {
                // One element deep decides no gradient: take the next ring too.
                let ring: Vec<u32> = patch
                    .iter()
                    .flat_map(|&element| mesh.quads()[element as usize])
                    .flat_map(|corner| around[corner as usize].iter().copied())
                    .collect();
                patch.extend(ring);
                patch.sort_unstable();
                patch.dedup();
            }
            fit(mesh.nodes()[node], &patch, centre, cells)
        })
        .collect();
    for &node in mesh.axis() {
        let point = &mut points[node as usize];
        let mean = 0.5 * (point[0] + point[2]);
        *point = [mean, point[1], mean, 0.0];
    }
    points
}

/// Value at `origin` of the linear field that fits the elements of a patch.
fn fit(
    origin: [f64; 2],
    patch: &[u32],
    centre: impl Fn(u32) -> [f64; 2],
    cells: &[[f64; 4]],
) -> [f64; 4] {
    let offset = |element: u32| {
        let [r, y] = centre(element);
        [r - origin[0], y - origin[1]]
    };
    let size = patch.iter().map(|&e| offset(e)).fold(0.0, |s: f64, [r, y]| s.max(r.hypot(y)));
    let mut matrix = Matrix3::<f64>::zeros();
    let mut right = [Vector3::zeros(); 4];
    for &element in patch {
        let [r, y] = offset(element);
        let basis = Vector3::new(1.0, r / size, y / size);
        matrix += basis * basis.transpose();
        for (right, stress) in right.iter_mut().zip(cells[element as usize]) {
            *right += basis * stress;
        }
    }
    match matrix.cholesky() {
        Some(factor) => right.map(|right| factor.solve(&right)[0]),
        None => right.map(|right| right[0] / patch.len() as f64),
    }
}

#[cfg(test)]
mod tests {
    use fem_mesh::{HalfDisc, Side};

    use super::*;

    /// Any linear field that is smooth on the axis: σ_rr = σ_θθ and σ_ry = 0 there.
    #[test]
    fn linear_stress_is_recovered_exactly() {
        for side in [Side::Above, Side::Below] {
            let disc = HalfDisc {
                radius: 1.0,
                contact_element_size: 0.05,
                refined_radius: 0.2,
                growth: None,
            };
            let mesh = disc.build().unwrap().on_side(side);
            let stress = |[r, y]: [f64; 2]| {
                [1.0 + 2.0 * y - 3.0 * r, 0.5 - y + 4.0 * r, 1.0 + 2.0 * y - 3.0 * r, 0.7 * r]
            };
            let mean = |corners: [[f64; 2]; 4], axis: usize| {
                corners.iter().map(|corner| corner[axis]).sum::<f64>() / 4.0
            };
            let cells: Vec<_> = (0..mesh.quads().len())
                .map(|element| mesh.corners(element))
                .map(|corners| stress([mean(corners, 0), mean(corners, 1)]))
                .collect();
            for (node, point) in recover(&mesh, &cells).into_iter().enumerate() {
                let mut exact = stress(mesh.nodes()[node]);
                if mesh.nodes()[node][0] == 0.0 {
                    exact[3] = 0.0;
                }
                for (value, exact) in point.into_iter().zip(exact) {
                    // Rounding of a fit over up to a dozen elements.
                    assert!((value - exact).abs() < 1e-13, "node {node}: {point:?}");
                }
            }
        }
    }
}
