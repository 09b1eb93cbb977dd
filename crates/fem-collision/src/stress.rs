//! Stress from a snapshot.

use fem_element::QuadGeometry;
use fem_material::{ActsOn, ElasticModuli, Material};
use fem_mesh::SphereMesh;

use crate::patches::Patches;
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
        StressRecovery::new(mesh).stress(material, fields)
    }
}

/// What recovery needs of a mesh, for any number of fields.
#[derive(Debug, Clone)]
pub struct StressRecovery<'a> {
    mesh: &'a SphereMesh,
    geometries: Vec<QuadGeometry>,
    patches: Patches,
}

impl<'a> StressRecovery<'a> {
    /// Integrates the elements and fits the patches of a mesh.
    pub fn new(mesh: &'a SphereMesh) -> Self {
        let elements = 0..mesh.quads().len();
        let geometries = elements.map(|element| QuadGeometry::new(&mesh.corners(element)));
        Self { mesh, geometries: geometries.collect(), patches: Patches::new(mesh) }
    }

    /// Recovers the stress of a body: that of its elements where the fields have it, as at finite
    /// strain, else Hooke's of its displacements. Patches are those of the undeformed mesh.
    pub fn stress(&self, material: &Material, fields: &BodyFields) -> StressField {
        let cells = match fields.stress.is_empty() {
            true => self.at_small_strain(material, fields),
            false => fields.stress.clone(),
        };
        let mut points = self.patches.smooth(&cells);
        for &node in self.mesh.axis() {
            let point = &mut points[node as usize];
            *point = Self::on_axis(*point);
        }
        StressField { cells, points }
    }

    /// A stress as symmetry has it on the axis.
    pub(crate) fn on_axis([rr, yy, tt, _]: [f64; 4]) -> [f64; 4] {
        let mean = 0.5 * (rr + tt);
        [mean, yy, mean, 0.0]
    }

    /// The mesh.
    pub(crate) fn mesh(&self) -> &SphereMesh {
        self.mesh
    }

    /// Elements around a node and their weights in its stress.
    pub(crate) fn weights(&self, node: usize) -> &[(u32, f64)] {
        self.patches.weights(node)
    }

    /// Geometry of an element.
    pub(crate) fn geometry(&self, element: usize) -> &QuadGeometry {
        &self.geometries[element]
    }

    /// Stress of the elements at small strain.
    fn at_small_strain(&self, material: &Material, fields: &BodyFields) -> Vec<[f64; 4]> {
        let of = SmallStrain::of(material, &fields.displacement, &fields.effective);
        let elements = self.geometries.iter().zip(self.mesh.quads());
        elements.map(|(geometry, quad)| of.stress(geometry, quad)).collect()
    }
}

/// What stress follows from at small strain.
#[derive(Debug, Clone, Copy)]
pub struct SmallStrain<'a> {
    moduli: &'a ElasticModuli,
    shear_field: &'a [[f64; 2]],
    /// The field of the mean part, where it is another.
    bulk_field: Option<&'a [[f64; 2]]>,
}

impl<'a> SmallStrain<'a> {
    /// Of displacements and, of a body that relaxes, effective displacements of its nodes, m; none of any
    /// other.
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

    /// Cauchy stress (σ_rr, σ_yy, σ_θθ, σ_ry) of an element with these corners, tension positive, Pa.
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
}

/// Pressure −tr σ / 3 and von Mises' equivalent stress of (σ_rr, σ_yy, σ_θθ, σ_ry).
pub fn invariants([rr, yy, tt, ry]: [f64; 4]) -> (f64, f64) {
    let pressure = -(rr + yy + tt) / 3.0;
    let square = 0.5 * ((rr - yy).powi(2) + (yy - tt).powi(2) + (tt - rr).powi(2));
    (pressure, (square + 3.0 * ry * ry).sqrt())
}
