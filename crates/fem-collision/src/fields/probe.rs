//! Probes: points of a body whose fields are recorded over time.
//!
//! A probe moves with the material. Displacement and velocity are interpolated from the four nodes of its element with the
//! element's shape functions, and so is the recovered nodal stress ([`StressRecovery`]), at the surface with the traction.

use fem_element::QuadGeometry;
use fem_material::Material;
use fem_mesh::SphereMesh;
use serde::{Deserialize, Serialize};

use super::surface::{Surface, SurfaceState};
use crate::fields::{BodyFields, ContactProfile, SmallStrain, Snapshot, StressRecovery};

/// A requested probe.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct ProbeRequest {
    /// The body: 0 is the lower one, 1 the upper one.
    pub side: usize,
    /// Position (r, y) in the undeformed body, whose contact pole is at the origin, m.
    pub place: [f64; 2],
}

/// A point this far beyond an element's edge, in its local coordinates from −1 to 1, still belongs to the element, since
/// the arc of a surface is beyond its chord.
const LOCAL_COORDINATE_TOLERANCE: f64 = 0.05;
/// The largest number of Newton steps to the local coordinates of a point; a convex quad needs a few.
const NEWTON_STEPS: usize = 20;

/// A point of a mesh, with the interpolation of its displacement and stress.
#[derive(Debug, Clone)]
pub struct Probe {
    quad: [u32; 4],
    /// Shape functions of the element's corners; their sum is 1.
    shares: [f64; 4],
    elements: Vec<Element>,
    corners: [Corner; 4],
}

/// A corner of a probe's element.
#[derive(Debug, Clone)]
struct Corner {
    /// The elements around it, as indices of `elements`, and their weights.
    weights: Vec<(usize, f64)>,
    is_on_axis: bool,
    /// Its position on the surface and its own elements, as indices of `elements`.
    on_surface: Option<(usize, Vec<usize>)>,
}

/// An element that contributes to the stress.
#[derive(Debug, Clone)]
struct Element {
    number: usize,
    quad: [u32; 4],
    geometry: QuadGeometry,
}

impl Probe {
    /// Finds a point (r, y), m, in a mesh; `None` if it is outside.
    pub fn new(recovery: &StressRecovery<'_>, place: [f64; 2]) -> Option<Self> {
        let mesh = recovery.mesh();
        let within = |number: usize| {
            let [xi, eta] = local_coordinates(&mesh.corners(number), place)?;
            let beyond = xi.abs().max(eta.abs()) - 1.0;
            (beyond <= LOCAL_COORDINATE_TOLERANCE).then_some((number, [xi, eta], beyond))
        };
        let found = (0..mesh.quads().len()).filter_map(within);
        let (number, own, _) = found.min_by(|one, other| one.2.total_cmp(&other.2))?;
        let quad = mesh.quads()[number];
        let mut elements: Vec<Element> = Vec::new();
        let mut index_of = |number: u32| {
            let number = number as usize;
            let known = elements.iter().position(|element| element.number == number);
            known.unwrap_or_else(|| {
                let (quad, geometry) = (mesh.quads()[number], *recovery.geometry(number));
                elements.push(Element { number, quad, geometry });
                elements.len() - 1
            })
        };
        let corners = quad.map(|node| {
            let weights = recovery.weights(node as usize).iter();
            let surface = recovery.surface();
            let own = |position: usize| surface.elements(position).to_vec();
            Corner {
                weights: weights.map(|&(number, weight)| (index_of(number), weight)).collect(),
                is_on_axis: mesh.axis().contains(&node),
                on_surface: surface.position(node).map(|position| {
                    (position, own(position).into_iter().map(&mut index_of).collect())
                }),
            }
        });
        Some(Self { quad, shares: shape(own), elements, corners })
    }

    /// Returns whether its stress depends on that of the surface.
    fn is_at_surface(&self) -> bool {
        self.corners.iter().any(|corner| corner.on_surface.is_some())
    }

    /// Interpolates a nodal field, such as the displacement (r, y), m, or the velocity, m/s.
    pub fn interpolate(&self, field: &[[f64; 2]]) -> [f64; 2] {
        let mut sum = [0.0; 2];
        for (node, share) in self.quad.into_iter().zip(self.shares) {
            for axis in 0..2 {
                sum[axis] += share * field[node as usize][axis];
            }
        }
        sum
    }

    /// Returns the stress (σ_rr, σ_yy, σ_θθ, σ_ry) of a body's fields and its surface, tension positive, Pa.
    fn stress(
        &self,
        material: &Material,
        fields: &BodyFields,
        surface: Option<&SurfaceState>,
    ) -> [f64; 4] {
        let small_strain = SmallStrain::of(material, &fields.displacement, &fields.effective);
        let of_element = |element: &Element| match fields.stress.get(element.number) {
            Some(stress) => *stress,
            None => small_strain.stress(&element.geometry, &element.quad),
        };
        let cells: Vec<[f64; 4]> = self.elements.iter().map(of_element).collect();
        let mut sum = [0.0; 4];
        for (corner, share) in self.corners.iter().zip(self.shares) {
            let mut at_node = [0.0; 4];
            for &(element, weight) in &corner.weights {
                (0..4).for_each(|k| at_node[k] += weight * cells[element][k]);
            }
            if let (Some(surface), Some((position, own))) = (surface, &corner.on_surface) {
                let around = own.iter().map(|&k| {
                    let Element { number, quad, geometry } = &self.elements[k];
                    small_strain.state(geometry, quad, cells[k], fields.plastic.get(*number))
                });
                at_node = surface.stress(*position, around, at_node);
            }
            if corner.is_on_axis {
                at_node = StressRecovery::on_axis(at_node);
            }
            (0..4).for_each(|k| sum[k] += share * at_node[k]);
        }
        sum
    }
}

/// The requested probes in the meshes of both bodies.
#[derive(Debug, Clone, Default)]
pub struct Probes {
    /// The body and the probe of each request; `None` if the point is outside of the mesh.
    found: Vec<Option<(usize, Probe)>>,
    /// The surfaces of the bodies that have a probe near their surface.
    surfaces: [Option<Surface>; 2],
}

impl Probes {
    /// Finds the requested points in the lower and the upper mesh.
    pub fn new(meshes: [Option<&SphereMesh>; 2], requests: &[ProbeRequest]) -> Self {
        if requests.is_empty() {
            return Self::default();
        }
        let recoveries = meshes.map(|mesh| mesh.map(StressRecovery::new));
        let find = |request: &ProbeRequest| {
            let recovery = recoveries.get(request.side)?.as_ref()?;
            Some((request.side, Probe::new(recovery, request.place)?))
        };
        let found: Vec<_> = requests.iter().map(find).collect();
        let surfaces = [0, 1].map(|side: usize| {
            let mut of_side = found.iter().flatten().filter(|(of, _)| *of == side);
            let is_needed = of_side.any(|(_, probe)| probe.is_at_surface());
            recoveries[side].as_ref().filter(|_| is_needed).map(|it| it.surface().clone())
        });
        Self { found, surfaces }
    }

    /// Returns whether there are no requests.
    pub fn is_empty(&self) -> bool {
        self.found.is_empty()
    }

    /// Returns the first request outside of the meshes.
    pub fn first_outside(&self) -> Option<usize> {
        self.found.iter().position(Option::is_none)
    }

    /// Reduces a snapshot of bodies of these materials to the probes: fields with one entry per request, in their
    /// order, and zero in the other body.
    pub fn reduce(&self, materials: [Option<&Material>; 2], all: &Snapshot) -> Snapshot {
        let n = self.found.len();
        let mut few = Snapshot {
            label: None,
            time: all.time,
            approach: all.approach,
            carried: all.carried,
            contact: ContactProfile::default(),
            bodies: [0, 1].map(|_| BodyFields {
                displacement: vec![[0.0; 2]; n],
                velocity: vec![[0.0; 2]; n],
                effective: Vec::new(),
                stress: vec![[0.0; 4]; n],
                ..BodyFields::default()
            }),
        };
        let surfaces = [0, 1].map(|side: usize| {
            let moduli = materials[side]?.instantaneous();
            Some(self.surfaces[side].as_ref()?.state(moduli, &all.bodies[side], &all.contact))
        });
        for (k, (side, probe)) in
            self.found.iter().enumerate().filter_map(|(k, found)| Some((k, found.as_ref()?)))
        {
            let (from, to) = (&all.bodies[*side], &mut few.bodies[*side]);
            to.displacement[k] = probe.interpolate(&from.displacement);
            to.velocity[k] = probe.interpolate(&from.velocity);
            if let Some(material) = materials[*side] {
                to.stress[k] = probe.stress(material, from, surfaces[*side].as_ref());
            }
        }
        few
    }
}

/// Signs of the corners' local coordinates.
const CORNERS: [[f64; 2]; 4] = [[-1.0, -1.0], [1.0, -1.0], [1.0, 1.0], [-1.0, 1.0]];

/// Returns the shape functions at (ξ, η).
fn shape([xi, eta]: [f64; 2]) -> [f64; 4] {
    CORNERS.map(|[x, e]| 0.25 * (1.0 + x * xi) * (1.0 + e * eta))
}

/// Returns the local coordinates (ξ, η) of a point by Newton's method on the bilinear map; `None` if it does not converge.
fn local_coordinates(corners: &[[f64; 2]; 4], place: [f64; 2]) -> Option<[f64; 2]> {
    // Far points need no iteration.
    let within = (0..2).all(|axis| {
        let (low, high) =
            corners.iter().fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), c| {
                (low.min(c[axis]), high.max(c[axis]))
            });
        let margin = LOCAL_COORDINATE_TOLERANCE * (high - low);
        (low - margin..=high + margin).contains(&place[axis])
    });
    if !within {
        return None;
    }
    let mut own = [0.0; 2];
    for _ in 0..NEWTON_STEPS {
        let (mut miss, mut slope) = (place, [[0.0; 2]; 2]);
        for (corner, (share, [x, e])) in corners.iter().zip(shape(own).into_iter().zip(CORNERS)) {
            for axis in 0..2 {
                miss[axis] -= share * corner[axis];
                slope[axis][0] += 0.25 * x * (1.0 + e * own[1]) * corner[axis];
                slope[axis][1] += 0.25 * e * (1.0 + x * own[0]) * corner[axis];
            }
        }
        let determinant = slope[0][0] * slope[1][1] - slope[0][1] * slope[1][0];
        let change = [
            (slope[1][1] * miss[0] - slope[0][1] * miss[1]) / determinant,
            (slope[0][0] * miss[1] - slope[1][0] * miss[0]) / determinant,
        ];
        own = [own[0] + change[0], own[1] + change[1]];
        if change[0].abs().max(change[1].abs()) < 1e-14 {
            break;
        }
    }
    own.iter().all(|x| x.is_finite()).then_some(own)
}

#[cfg(test)]
mod tests {
    use fem_material::ElasticModuli;
    use fem_mesh::{HalfDisc, Side};

    use super::*;

    fn glass() -> Material {
        let moduli = ElasticModuli::from_youngs_modulus_poissons_ratio(63e9, 0.244).unwrap();
        Material::new(2390.0, moduli, None).unwrap()
    }

    fn mesh(side: Side) -> SphereMesh {
        let disc = HalfDisc {
            radius: 1.0,
            contact_element_size: 0.05,
            refined_radius: 0.2,
            growth: None,
            edge: None,
        };
        disc.build().unwrap().on_side(side)
    }

    /// u = (a r, b y) has a uniform strain: displacement and stress are exact everywhere, also on the axis and on the
    /// arc of the surface.
    #[test]
    fn linear_fields_are_exact_at_any_place() {
        let (glass, [a, b]) = (glass(), [1e-3, -2e-3]);
        let expected = glass.instantaneous().stress([a, b, a, 0.0]);
        for (side, sign) in [(Side::Above, 1.0), (Side::Below, -1.0)] {
            let mesh = mesh(side);
            let recovery = StressRecovery::new(&mesh);
            let displacement = mesh.nodes().iter().map(|[r, y]| [a * r, b * y]).collect();
            let fields = BodyFields { displacement, ..BodyFields::default() };
            let on_arc = [0.5f64.sin(), sign * (1.0 - 0.5f64.cos())];
            for place in [[0.0, 0.0], [0.0, sign * 1.3], [0.313, sign * 0.7], on_arc, [1.0, sign]] {
                let probe = Probe::new(&recovery, place).unwrap();
                let [u_r, u_y] = probe.interpolate(&fields.displacement);
                // Rounding.
                assert!((u_r - a * place[0]).abs() < 1e-16, "{place:?} {u_r}");
                assert!((u_y - b * place[1]).abs() < 1e-16, "{place:?} {u_y}");
                let stress = probe.stress(&glass, &fields, None);
                for (value, expected) in stress.into_iter().zip(expected) {
                    // Rounding of strains of 1e-3 and of the fit around a node.
                    let scale = expected.abs().max(6e7);
                    assert!((value - expected).abs() < 1e-11 * scale, "{place:?}");
                }
            }
        }
    }

    #[test]
    fn probe_outside_the_mesh_is_none() {
        let mesh = mesh(Side::Above);
        let recovery = StressRecovery::new(&mesh);
        for place in [[0.0, -0.1], [0.9, 0.1], [-0.1, 1.0], [0.0, 2.1], [f64::NAN, 1.0]] {
            assert!(Probe::new(&recovery, place).is_none(), "{place:?}");
        }
    }

    /// Each body has the entries of its own probes; all others are zero.
    #[test]
    fn a_snapshot_is_reduced_to_its_places() {
        let (meshes, glass) = ([mesh(Side::Below), mesh(Side::Above)], glass());
        let requests = [
            ProbeRequest { side: 1, place: [0.0, 0.5] },
            ProbeRequest { side: 0, place: [0.2, -0.5] },
            ProbeRequest { side: 0, place: [0.0, 0.5] },
        ];
        let probes = Probes::new(meshes.each_ref().map(Some), &requests);
        assert_eq!(probes.first_outside(), Some(2));
        let all = Snapshot {
            time: 2.0,
            carried: [0.5, 0.25],
            bodies: meshes.each_ref().map(|mesh| BodyFields {
                displacement: mesh.nodes().iter().map(|[r, y]| [*r, 2.0 * y]).collect(),
                velocity: mesh.nodes().iter().map(|[r, y]| [-r, *y]).collect(),
                ..BodyFields::default()
            }),
            ..Snapshot::default()
        };
        let few = probes.reduce([Some(&glass); 2], &all);
        let near = |[a, b]: [f64; 2], [c, d]: [f64; 2]| (a - c).abs() + (b - d).abs() < 1e-15;
        assert!(near(few.displacement(1)[0], [0.0, 1.25]));
        assert!(near(few.displacement(0)[1], [0.2, -0.5]));
        assert!(near(few.bodies[0].velocity[1], [-0.2, -0.5]));
        assert_eq!(few.bodies[0].displacement[2], [0.0; 2]);
        assert_eq!(few.bodies[0].stress[0], [0.0; 4]);
        assert!(few.bodies[1].stress[0][1] > 1e10);
    }
}
