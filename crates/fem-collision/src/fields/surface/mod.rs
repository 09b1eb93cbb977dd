//! Stress at the surface of a body, where the traction is known: the contact pressure, and nothing outside of the contact.
//!
//! The surface measures its strain as a strain gauge does: the strain ε_ss along the meridian from the displacements of
//! neighbouring nodes, and the hoop strain u_r/r. The stress of an element around a node, which is a mean over the
//! element, is changed by the difference of both strains, with the normal strain that the traction asks for:
//!
//! ```math
//! \sigma = \sigma_e + C : (\varepsilon - \varepsilon_e), \qquad
//! \sigma_{nn} = -p, \quad \sigma_{ns} = 0 .
//! ```
//!
//! At small strain this is Hooke's law for ε and p. Where the stress depends on more than the strain (relaxation, finite
//! strain), only the difference over half an element follows Hooke's law. Where a body flows, that difference is plastic.
//! The deviator is then extrapolated from the elements, no larger than theirs, and the traction gives the pressure.
//!
//! **Edge of the contact.** The tension there is a cusp, and differences over it are means of both sides. On a half-space
//! under any pressure p(r) it is known, since each point force P displaces the surface by −(1−2ν)P/4πGr (Landau &
//! Lifshitz, *Theory of Elasticity*, § 8):
//!
//! ```math
//! u_r = -\frac{1-2\nu}{2Gr} \int_0^r p\,\rho\,\mathrm d\rho, \qquad
//! \varepsilon_{ss} + \varepsilon_{\theta\theta} = -\frac{1-2\nu}{2G}\,p .
//! ```
//!
//! Only the rest, which bending and the finite size of the body cause and which is smooth, is taken from differences. Its
//! running median over [`MEDIAN`] nodes leaves out the error of the elements at the edge, which is two nodes wide.
//!
//! **Limits.** Values are those of nodes, and linear between them: the cusp is drawn over the one element that contains it.

mod half_space;
mod state;

use fem_material::ElasticModuli;
use fem_mesh::SphereMesh;

use super::snapshot::{BodyFields, ContactProfile};
use half_space::HalfSpace;
use state::SurfaceNode;
pub(crate) use state::{ElementState, SurfaceState};

/// Nodes of the running median.
const MEDIAN: usize = 5;

/// The surface of a mesh, from the contact pole outward.
#[derive(Debug, Clone)]
pub(crate) struct Surface {
    nodes: Vec<u32>,
    places: Vec<[f64; 2]>,
    /// Distances along the surface from the pole, m.
    arcs: Vec<f64>,
    /// Nodes in ascending order, with their positions in `nodes`.
    positions: Vec<(u32, usize)>,
    /// The elements around each node.
    elements: Vec<Vec<u32>>,
}

impl Surface {
    pub fn of(mesh: &SphereMesh) -> Self {
        let nodes = mesh.surface().to_vec();
        let places: Vec<[f64; 2]> = nodes.iter().map(|&node| mesh.nodes()[node as usize]).collect();
        let mut arcs = vec![0.0; nodes.len()];
        for k in 1..nodes.len() {
            let [a, b] = [places[k - 1], places[k]];
            arcs[k] = arcs[k - 1] + (b[0] - a[0]).hypot(b[1] - a[1]);
        }
        let mut positions: Vec<_> = nodes.iter().enumerate().map(|(k, node)| (*node, k)).collect();
        positions.sort_unstable();
        let elements = vec![Vec::new(); nodes.len()];
        let mut surface = Self { nodes, places, arcs, positions, elements };
        for (element, quad) in mesh.quads().iter().enumerate() {
            for position in quad.map(|node| surface.position(node)).into_iter().flatten() {
                surface.elements[position].push(element as u32);
            }
        }
        surface
    }

    /// Returns the position of a node along the surface; `None` for a node inside of the body.
    pub fn position(&self, node: u32) -> Option<usize> {
        let found = self.positions.binary_search_by_key(&node, |(node, _)| *node);
        found.ok().map(|k| self.positions[k].1)
    }

    /// Returns the nodes from the pole outward.
    pub fn nodes(&self) -> &[u32] {
        &self.nodes
    }

    /// Returns the elements around the node at a position.
    pub fn elements(&self, position: usize) -> &[u32] {
        &self.elements[position]
    }

    /// Returns the positions and the weights of the derivative along the surface at a node, from it and both neighbours. Beyond
    /// the axis the neighbour is the mirror image, whose sign is −1.
    fn derivative(&self, k: usize) -> [(usize, f64, f64); 3] {
        let last = self.nodes.len() - 1;
        let (arcs, on_axis) = (&self.arcs, self.places[k][0] == 0.0);
        let stencil = match k {
            0 => [(1, -1.0), (0, 1.0), (1, 1.0)],
            _ if k < last => [(k - 1, 1.0), (k, 1.0), (k + 1, 1.0)],
            _ if on_axis => [(k - 1, 1.0), (k, 1.0), (k - 1, -1.0)],
            _ => [(k - 2, 1.0), (k - 1, 1.0), (k, 1.0)],
        };
        let place = |j: usize| match stencil[j] {
            // The mirror image lies as far beyond the axis.
            (at, sign) if sign < 0.0 => 2.0 * arcs[k] - arcs[at],
            (at, _) => arcs[at],
        };
        let at = arcs[k];
        [0, 1, 2].map(|j| {
            let [a, b] = [(j + 1) % 3, (j + 2) % 3].map(place);
            let weight = (2.0 * at - a - b) / ((place(j) - a) * (place(j) - b));
            (stencil[j].0, stencil[j].1, weight)
        })
    }

    /// Returns the derivative (r, y) of a vector field along the surface at a node; its r component is odd over the axis.
    fn derivative_of(&self, k: usize, field: impl Fn(usize) -> [f64; 2]) -> [f64; 2] {
        let mut sum = [0.0; 2];
        for (at, sign, weight) in self.derivative(k) {
            let [r, y] = field(at);
            sum[0] += weight * sign * r;
            sum[1] += weight * y;
        }
        sum
    }

    /// Returns the surface of a body with these fields under a contact.
    pub fn state(
        &self,
        moduli: &ElasticModuli,
        fields: &BodyFields,
        contact: &ContactProfile,
    ) -> SurfaceState {
        let u = match fields.effective.is_empty() {
            true => &fields.displacement,
            false => &fields.effective,
        };
        // Bodies at finite strain store their stress, and their contact is that of the deformed surfaces.
        let moved: Vec<[f64; 2]> = match fields.stress.is_empty() {
            true => self.places.clone(),
            false => self.moved(&fields.displacement),
        };
        let radii: Vec<f64> = moved.iter().map(|place| place[0]).collect();
        let compliance = (1.0 - 2.0 * moduli.poissons_ratio()) / (2.0 * moduli.shear_modulus());
        let half_space = HalfSpace::new(compliance, contact, &radii);
        let excess: Vec<[f64; 2]> =
            (0..self.nodes.len()).map(|k| self.excess(k, u, &half_space)).collect();
        let node = |k: usize| {
            let [own, hoop] = excess[k];
            let smooth = match half_space.is_near(k) {
                true => running_median(&excess, k, half_space.n_near),
                false => own,
            };
            let sum = smooth + half_space.dilatation(k);
            let strains =
                if self.places[k][0] == 0.0 { [0.5 * sum; 2] } else { [sum - hoop, hoop] };
            let tangent = |places: &[[f64; 2]]| unit(self.derivative_of(k, |k| places[k]));
            let tangents = [tangent(&self.places), tangent(&moved)];
            SurfaceNode { tangents, pressure: half_space.pressure(k), strains }
        };
        SurfaceState { moduli: *moduli, nodes: (0..self.nodes.len()).map(node).collect() }
    }

    /// Returns the places of the nodes after a displacement, m.
    fn moved(&self, displacement: &[[f64; 2]]) -> Vec<[f64; 2]> {
        let both = self.places.iter().zip(&self.nodes);
        both.map(|([r, y], node)| {
            let [u_r, u_y] = displacement[*node as usize];
            [r + u_r, y + u_y]
        })
        .collect()
    }

    /// Returns ε_ss + ε_θθ at a node less that of the half-space, and ε_θθ, for displacements (m) of all nodes.
    fn excess(&self, k: usize, u: &[[f64; 2]], half_space: &HalfSpace) -> [f64; 2] {
        let along = self.derivative_of(k, |k| self.places[k]);
        let is_near = half_space.is_near(k);
        let slope = self.derivative_of(k, |j| match u[self.nodes[j] as usize] {
            [r, y] if is_near => [r - half_space.displacement(j), y],
            u => u,
        });
        let square = along[0] * along[0] + along[1] * along[1];
        let rest = (slope[0] * along[0] + slope[1] * along[1]) / square;
        // The half-space has the rest of ε_ss: its sum of both less its hoop strain.
        let own = if is_near { half_space.hoop_strain(k) } else { 0.0 };
        let hoop = match self.places[k][0] {
            0.0 => rest + own,
            r => u[self.nodes[k] as usize][0] / r,
        };
        [rest + hoop - own, hoop]
    }
}

/// Returns the median of the first value over the nodes around k, those beyond the axis mirrored; fewer at the outer end.
fn running_median(values: &[[f64; 2]], k: usize, n: usize) -> f64 {
    let half = (MEDIAN / 2).min(n - 1 - k) as isize;
    let mut window: Vec<f64> =
        (-half..=half).map(|by| values[(k as isize + by).unsigned_abs()][0]).collect();
    window.sort_unstable_by(f64::total_cmp);
    window[window.len() / 2]
}

fn unit([r, y]: [f64; 2]) -> [f64; 2] {
    let length = r.hypot(y);
    [r / length, y / length]
}

#[cfg(test)]
pub mod tests {
    use fem_material::Material;
    use fem_mesh::{HalfDisc, QuarterDisc, Side};

    use super::*;
    use crate::fields::{ContactProfilePoint, StressField};

    fn moduli() -> ElasticModuli {
        ElasticModuli::from_youngs_modulus_poissons_ratio(1.0, 0.3).unwrap()
    }

    pub fn profile(radius: f64, pressure: impl Fn(f64) -> f64) -> ContactProfile {
        let place = |k: usize| {
            let radius = radius * k as f64 / 64.0;
            ContactProfilePoint { radius, pressure: pressure(radius), ..Default::default() }
        };
        ContactProfile { radius, places: (0..=64).map(place).collect() }
    }

    /// A plane that is stretched in all directions along it has E/(1−ν) ε along it and no stress across it, whatever the
    /// elements say; without a contact its traction is not known.
    #[test]
    fn the_traction_of_the_surface_is_imposed() {
        let plane = QuarterDisc {
            far_radius: 1.0,
            contact_element_size: 0.1,
            refined_radius: 0.3,
            growth: None,
            edge: None,
        };
        let mesh = plane.build().unwrap().on_side(Side::Above);
        let material = Material::new(1.0, moduli(), None).unwrap();
        let displacement = mesh.nodes().iter().map(|[r, _]| [0.1 * r, 0.0]).collect();
        let fields = BodyFields { displacement, ..BodyFields::default() };
        let stress = |contact| StressField::of(&mesh, &material, &fields, contact);
        let node = mesh.surface()[3] as usize;
        let [confined, free] =
            [None, Some(&ContactProfile::default())].map(|contact| stress(contact).points[node]);
        let clamped = moduli().stress([0.1, 0.0, 0.1, 0.0]);
        // Rounding.
        assert!((0..4).all(|k| (confined[k] - clamped[k]).abs() < 1e-13), "{confined:?}");
        let along = 0.1 / (1.0 - 0.3);
        assert!((0..4).all(|k| (free[k] - [along, 0.0, along, 0.0][k]).abs() < 1e-13), "{free:?}");
    }

    /// The surface of a half-space under Hertz' pressure: with the displacements of the closed form at the nodes the strain
    /// has its closed form at each of them, over the edge of the contact too, where differences are means of both sides.
    #[test]
    fn the_strain_of_a_half_space_is_known_over_the_edge_of_the_contact() {
        let (a, compliance) = (1.0, (1.0 - 2.0 * 0.3) / (2.0 * moduli().shear_modulus()));
        let inner = |r: f64| (1.0 - (1.0 - r * r / (a * a)).max(0.0).powf(1.5)) * a * a / 3.0;
        let disc = HalfDisc {
            radius: 200.0,
            contact_element_size: 0.23,
            refined_radius: 4.0,
            growth: None,
            edge: None,
        };
        let mesh = disc.build().unwrap().on_side(Side::Above);
        let displacement = mesh.nodes().iter().map(|[r, _]| match *r {
            0.0 => [0.0; 2],
            r => [-compliance * inner(r) / r, 0.0],
        });
        let fields = BodyFields { displacement: displacement.collect(), ..BodyFields::default() };
        let contact = profile(a, |r| (1.0 - r * r / (a * a)).max(0.0).sqrt());
        let surface = Surface::of(&mesh);
        let state = surface.state(&moduli(), &fields, &contact);
        for (k, place) in surface.places.iter().enumerate().take(9).skip(1) {
            let r = place[0];
            let pressure = contact.pressure_at(r);
            let exact = compliance * (inner(r) / (r * r) - pressure);
            // Straight lines between 64 points lack 2 % of the pressure next to the edge.
            let error = (state.nodes[k].strains[0] - exact).abs();
            assert!(error < 0.01 * compliance, "{r}: {} {exact}", state.nodes[k].strains[0]);
        }
    }
}
