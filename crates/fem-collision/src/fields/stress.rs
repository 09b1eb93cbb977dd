//! Stress recovery from a snapshot.

use fem_element::QuadGeometry;
use fem_material::{ActsOn, ElasticModuli, Material};
use fem_mesh::SphereMesh;
use nalgebra::{Matrix3, Vector3};

use super::surface::{ElementState, Surface};
use crate::fields::{BodyFields, ContactProfile};

/// Cauchy stress (σ_rr, σ_yy, σ_θθ, σ_ry), tension positive, Pa.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct StressField {
    /// Mean stress of each element.
    pub cells: Vec<[f64; 4]>,
    /// Smooth stress at each node: inside of the body from the best linear fit to the elements around it (superconvergent
    /// patch recovery, Zienkiewicz & Zhu 1992), at the surface from its own strain and the contact pressure.
    pub points: Vec<[f64; 4]>,
}

impl StressField {
    /// Recovers the stress of a body under a contact. See [`StressRecovery::stress`].
    pub fn of(
        mesh: &SphereMesh,
        material: &Material,
        fields: &BodyFields,
        contact: Option<&ContactProfile>,
    ) -> Self {
        StressRecovery::new(mesh).stress(material, fields, contact)
    }
}

/// The stress recovery of a mesh, for any number of fields.
#[derive(Debug, Clone)]
pub struct StressRecovery<'a> {
    mesh: &'a SphereMesh,
    geometries: Vec<QuadGeometry>,
    patches: Patches,
    surface: Surface,
}

impl<'a> StressRecovery<'a> {
    /// Integrates the elements and fits the patches of a mesh.
    pub fn new(mesh: &'a SphereMesh) -> Self {
        let elements = 0..mesh.quads().len();
        let geometries = elements.map(|element| QuadGeometry::new(&mesh.corners(element)));
        let (patches, surface) = (Patches::new(mesh), Surface::of(mesh));
        Self { mesh, geometries: geometries.collect(), patches, surface }
    }

    /// Recovers the stress of a body: from the element stresses, if the fields have them (finite strain), or else from its
    /// displacements with Hooke's law. The patches are those of the undeformed mesh. The surface carries the pressure of
    /// the contact; without one its traction is not known, and its stress is extrapolated.
    pub fn stress(
        &self,
        material: &Material,
        fields: &BodyFields,
        contact: Option<&ContactProfile>,
    ) -> StressField {
        let of = SmallStrain::of(material, &fields.displacement, &fields.effective);
        let elements = self.geometries.iter().zip(self.mesh.quads());
        let cells = match fields.stress.is_empty() {
            true => elements.map(|(geometry, quad)| of.stress(geometry, quad)).collect(),
            false => fields.stress.clone(),
        };
        let mut points = self.patches.smooth(&cells);
        if let Some(contact) = contact {
            let state = self.surface.state(material.instantaneous(), fields, contact);
            for (position, &node) in self.surface.nodes().iter().enumerate() {
                let around = self.surface.elements(position).iter().map(|&element| {
                    let element = element as usize;
                    let (geometry, quad) = (&self.geometries[element], &self.mesh.quads()[element]);
                    of.state(geometry, quad, cells[element], fields.plastic.get(element))
                });
                let point = &mut points[node as usize];
                *point = state.stress(position, around, *point);
            }
        }
        for &node in self.mesh.axis() {
            let point = &mut points[node as usize];
            *point = Self::on_axis(*point);
        }
        StressField { cells, points }
    }

    /// Returns the stress with the symmetry of the axis.
    pub(crate) fn on_axis([rr, yy, tt, _]: [f64; 4]) -> [f64; 4] {
        let mean = 0.5 * (rr + tt);
        [mean, yy, mean, 0.0]
    }

    /// Returns the mesh.
    pub(crate) fn mesh(&self) -> &SphereMesh {
        self.mesh
    }

    /// Returns the elements around a node and their weights in its stress.
    pub(crate) fn weights(&self, node: usize) -> &[(u32, f64)] {
        self.patches.weights(node)
    }

    /// Returns the surface.
    pub(crate) fn surface(&self) -> &Surface {
        &self.surface
    }

    /// Returns the geometry of an element.
    pub(crate) fn geometry(&self, element: usize) -> &QuadGeometry {
        &self.geometries[element]
    }
}

/// The displacements and moduli that give the stress at small strain.
#[derive(Debug, Clone, Copy)]
pub struct SmallStrain<'a> {
    moduli: &'a ElasticModuli,
    shear_field: &'a [[f64; 2]],
    /// The displacements of the volumetric strain, if they differ.
    bulk_field: Option<&'a [[f64; 2]]>,
}

impl<'a> SmallStrain<'a> {
    /// Takes the displacements of the nodes and, if the body relaxes, the effective displacements, m (otherwise empty).
    pub fn of(
        material: &'a Material,
        displacement: &'a [[f64; 2]],
        effective: &'a [[f64; 2]],
    ) -> Self {
        let relaxed = if effective.is_empty() { None } else { material.relaxation() };
        Self {
            moduli: material.instantaneous(),
            shear_field: if relaxed.is_some() { effective } else { displacement },
            bulk_field: relaxed
                .filter(|series| series.acts_on() == ActsOn::Shear)
                .map(|_| displacement),
        }
    }

    /// Returns the Cauchy stress (σ_rr, σ_yy, σ_θθ, σ_ry) of an element with these corners, tension positive, Pa.
    pub fn stress(&self, geometry: &QuadGeometry, quad: &[u32; 4]) -> [f64; 4] {
        let trace = |e: &[f64; 4]| e[0] + e[1] + e[2];
        let at = |field: &[[f64; 2]]| geometry.mean_strain(&quad.map(|node| field[node as usize]));
        let mut strain = at(self.shear_field);
        if let Some(bulk_field) = self.bulk_field {
            let shift = (trace(&at(bulk_field)) - trace(&strain)) / 3.0;
            strain[..3].iter_mut().for_each(|e| *e += shift);
        }
        self.moduli.stress(strain)
    }

    /// Returns the state of an element with this stress, plastic strain and plastic work.
    pub(crate) fn state(
        &self,
        geometry: &QuadGeometry,
        quad: &[u32; 4],
        stress: [f64; 4],
        plastic: Option<&[f64; 2]>,
    ) -> ElementState {
        let strain = geometry.mean_strain(&quad.map(|node| self.shear_field[node as usize]));
        ElementState { stress, strain, flows: plastic.is_some_and(|[strain, _]| *strain > 0.0) }
    }
}

/// Returns the pressure −tr σ / 3 and the von Mises stress of (σ_rr, σ_yy, σ_θθ, σ_ry).
pub fn invariants([rr, yy, tt, ry]: [f64; 4]) -> (f64, f64) {
    let pressure = -(rr + yy + tt) / 3.0;
    let square = 0.5 * ((rr - yy).powi(2) + (yy - tt).powi(2) + (tt - rr).powi(2));
    (pressure, (square + 3.0 * ry * ry).sqrt())
}

/// The weights of each node's elements.
#[derive(Debug, Clone)]
pub(crate) struct Patches {
    /// Index of the first weight of each node, and the end of the last one.
    starts: Vec<usize>,
    /// Elements and their weights.
    weights: Vec<(u32, f64)>,
}

impl Patches {
    /// Fits the elements around each node of a mesh.
    pub fn new(mesh: &SphereMesh) -> Self {
        let n_nodes = mesh.nodes().len();
        let mut around: Vec<Vec<u32>> = vec![Vec::with_capacity(4); n_nodes];
        for (element, quad) in mesh.quads().iter().enumerate() {
            for &node in quad {
                around[node as usize].push(element as u32);
            }
        }
        let centres: Vec<[f64; 2]> = (0..mesh.quads().len())
            .map(|element| mesh.corners(element))
            .map(|corners| {
                [0, 1].map(|axis: usize| corners.map(|x| x[axis]).iter().sum::<f64>() / 4.0)
            })
            .collect();
        let mut on_boundary = vec![false; n_nodes];
        let mut edges: Vec<[u32; 2]> = Vec::with_capacity(4 * mesh.quads().len());
        for quad in mesh.quads() {
            edges.extend((0..4).map(|k| {
                let (one, other) = (quad[k], quad[(k + 1) % 4]);
                [one.min(other), one.max(other)]
            }));
        }
        edges.sort_unstable();
        for same in edges.chunk_by(|one, other| one == other).filter(|same| same.len() == 1) {
            same[0].iter().for_each(|&node| on_boundary[node as usize] = true);
        }
        let mut patches = Self { starts: vec![0], weights: Vec::with_capacity(5 * n_nodes) };
        let mut patch = Vec::new();
        for (node, &origin) in mesh.nodes().iter().enumerate() {
            patch.clone_from(&around[node]);
            if on_boundary[node] {
                // One layer of elements does not determine a gradient: add the next ring.
                let corners =
                    around[node].iter().flat_map(|&element| mesh.quads()[element as usize]);
                patch.extend(corners.flat_map(|corner| around[corner as usize].iter().copied()));
                patch.sort_unstable();
                patch.dedup();
            }
            patches.add(origin, &patch, &centres);
        }
        patches
    }

    /// Adds the weights for the value at `origin` of the linear field that fits a patch.
    fn add(&mut self, origin: [f64; 2], patch: &[u32], centres: &[[f64; 2]]) {
        let offset = |element: u32| {
            let [r, y] = centres[element as usize];
            [r - origin[0], y - origin[1]]
        };
        let square =
            patch.iter().map(|&e| offset(e)).fold(0.0, |s: f64, [r, y]| s.max(r * r + y * y));
        let size = square.sqrt();
        let basis = |element: u32| {
            let [r, y] = offset(element);
            Vector3::new(1.0, r / size, y / size)
        };
        let matrix: Matrix3<f64> = patch.iter().map(|&e| basis(e) * basis(e).transpose()).sum();
        // The first row of the inverse; the mean if the gradient is not determined.
        let row = match matrix.cholesky() {
            Some(factor) => factor.solve(&Vector3::x()),
            None => Vector3::x() / patch.len() as f64,
        };
        self.weights.extend(patch.iter().map(|&element| (element, row.dot(&basis(element)))));
        self.starts.push(self.weights.len());
    }

    /// Returns the elements around a node and their weights.
    pub fn weights(&self, node: usize) -> &[(u32, f64)] {
        &self.weights[self.starts[node]..self.starts[node + 1]]
    }

    /// Returns four components at every node from those of the elements.
    pub fn smooth(&self, cells: &[[f64; 4]]) -> Vec<[f64; 4]> {
        let patches = self.starts.windows(2).map(|ends| &self.weights[ends[0]..ends[1]]);
        let points = patches.map(|weights| {
            let mut point = [0.0; 4];
            for &(element, weight) in weights {
                for (sum, value) in point.iter_mut().zip(cells[element as usize]) {
                    *sum += weight * value;
                }
            }
            point
        });
        points.collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use fem_mesh::{HalfDisc, Side};

    /// Tension σ has the von Mises stress σ, pure shear τ has √3 τ in any axes, and a pressure has none.
    #[test]
    fn invariants_of_elementary_stress_states_are_known() {
        assert_eq!(invariants([0.0, 2.0, 0.0, 0.0]), (-2.0 / 3.0, 2.0));
        assert_eq!(invariants([0.0, 0.0, 0.0, 2.0]), (0.0, 12f64.sqrt()));
        assert_eq!(invariants([-2.0, -2.0, -2.0, 0.0]), (2.0, 0.0));
        for shear in [[1.0, -1.0, 0.0, 0.0], [0.0, 1.0, -1.0, 0.0]] {
            let (pressure, von_mises) = invariants(shear);
            // A rounding.
            assert!(pressure == 0.0 && (von_mises - 3f64.sqrt()).abs() < 1e-15, "{shear:?}");
        }
    }

    #[test]
    fn linear_stress_is_recovered_exactly() {
        for side in [Side::Above, Side::Below] {
            let disc = HalfDisc {
                radius: 1.0,
                contact_element_size: 0.05,
                refined_radius: 0.2,
                growth: None,
                edge: None,
            };
            let mesh = disc.build().unwrap().on_side(side);
            let stress = |[r, y]: [f64; 2]| {
                [1.0 + 2.0 * y - 3.0 * r, 0.5 - y + 4.0 * r, 1.0 + 2.0 * y - 3.0 * r, 0.7 * r]
            };
            let mean_of = |corners: [[f64; 2]; 4], axis: usize| {
                corners.iter().map(|corner| corner[axis]).sum::<f64>() / 4.0
            };
            let cells: Vec<_> = (0..mesh.quads().len())
                .map(|element| mesh.corners(element))
                .map(|corners| stress([mean_of(corners, 0), mean_of(corners, 1)]))
                .collect();
            for (node, point) in Patches::new(&mesh).smooth(&cells).into_iter().enumerate() {
                let exact = stress(mesh.nodes()[node]);
                for (value, exact) in point.into_iter().zip(exact) {
                    // Rounding of a fit over up to a dozen elements.
                    assert!((value - exact).abs() < 1e-13, "node {node}: {point:?}");
                }
            }
        }
    }
}
