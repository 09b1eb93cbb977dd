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

use fem_material::ElasticModuli;
use fem_mesh::SphereMesh;

use super::snapshot::{BodyFields, ContactProfile};
use super::stress::invariants;

/// Contact radii within which the strain of the half-space is known from the pressure.
const REACH: f64 = 2.5;
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

/// Stress and strain of an element.
#[derive(Debug, Clone, Copy)]
pub(crate) struct ElementState {
    /// (σ_rr, σ_yy, σ_θθ, σ_ry), Pa.
    pub stress: [f64; 4],
    /// (ε_rr, ε_yy, ε_θθ, γ_ry).
    pub strain: [f64; 4],
    pub flows: bool,
}

/// A node of the surface at an instant.
#[derive(Debug, Clone, Copy)]
struct SurfaceNode {
    /// Unit tangents (r, y) of the undeformed and of the deformed surface.
    tangents: [[f64; 2]; 2],
    /// Contact pressure, Pa.
    pressure: f64,
    /// Strains along the meridian and along the hoop.
    strains: [f64; 2],
}

/// The surface of a body at an instant.
#[derive(Debug)]
pub(crate) struct SurfaceState {
    moduli: ElasticModuli,
    nodes: Vec<SurfaceNode>,
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
        let (nu, shear) = (moduli.poissons_ratio(), moduli.shear_modulus());
        let compliance = (1.0 - 2.0 * nu) / (2.0 * shear);
        let strained =
            if fields.effective.is_empty() { &fields.displacement } else { &fields.effective };
        let u = |k: usize| strained[self.nodes[k] as usize];
        // Bodies at finite strain store their stress, and their contact is that of the deformed surfaces.
        let is_deformed = !fields.stress.is_empty();
        let moved = |k: usize| {
            let [u_r, u_y] = fields.displacement[self.nodes[k] as usize];
            [self.places[k][0] + u_r, self.places[k][1] + u_y]
        };
        let radius = |k: usize| if is_deformed { moved(k)[0] } else { self.places[k][0] };
        let loads = RadialLoads::of(contact);
        let reach = REACH * contact.radius;
        // The surface near the contact, as long as it runs outward.
        let n_near = (0..self.nodes.len())
            .take_while(|&k| radius(k) < reach && (k == 0 || radius(k) > radius(k - 1)))
            .count();
        let near: Vec<_> =
            (0..(n_near + 1).min(self.nodes.len())).map(|k| loads.at(radius(k))).collect();
        let half_space = |k: usize| match near.get(k) {
            Some(load) if radius(k) > 0.0 => compliance * load.inner / radius(k),
            _ => 0.0,
        };
        let is_near = |k: usize| k < n_near && k + 1 < near.len();
        // The sum of both strains less that of the half-space, and the hoop strain.
        let strains: Vec<[f64; 2]> = (0..self.nodes.len())
            .map(|k| {
                let along = self.derivative_of(k, |k| self.places[k]);
                let slope = self.derivative_of(k, |j| match u(j) {
                    [r, y] if is_near(k) => [r + half_space(j), y],
                    u => u,
                });
                let square = along[0] * along[0] + along[1] * along[1];
                let rest = (slope[0] * along[0] + slope[1] * along[1]) / square;
                let hoop = |meridian: f64| match self.places[k][0] {
                    0.0 => meridian,
                    r => u(k)[0] / r,
                };
                match near.get(k).filter(|_| is_near(k)) {
                    Some(load) => {
                        // u_r/r of the half-space, which on the axis is half of the sum.
                        let own = match radius(k) {
                            0.0 => -0.5 * compliance * load.pressure,
                            r => -compliance * load.inner / (r * r),
                        };
                        let hoop = hoop(rest + own);
                        [rest + hoop - own, hoop]
                    }
                    None => [rest + hoop(rest), hoop(rest)],
                }
            })
            .collect();
        let smooth =
            |k: usize| if is_near(k) { running_median(&strains, k, n_near) } else { strains[k][0] };
        let nodes = (0..self.nodes.len()).map(|k| {
            let pressure = near.get(k).filter(|_| is_near(k)).map_or(0.0, |load| load.pressure);
            let sum = smooth(k) - compliance * pressure;
            let strains = match self.places[k][0] {
                0.0 => [0.5 * sum; 2],
                _ => [sum - strains[k][1], strains[k][1]],
            };
            let tangents = [
                unit(self.derivative_of(k, |k| self.places[k])),
                unit(
                    self.derivative_of(k, |k| if is_deformed { moved(k) } else { self.places[k] }),
                ),
            ];
            SurfaceNode { tangents, pressure, strains }
        });
        SurfaceState { moduli: *moduli, nodes: nodes.collect() }
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

impl SurfaceState {
    /// Returns (σ_rr, σ_yy, σ_θθ, σ_ry) at a node of the surface, Pa, from the elements around it and the stress that is
    /// extrapolated from them.
    pub fn stress(
        &self,
        position: usize,
        elements: impl Iterator<Item = ElementState> + Clone,
        extrapolated: [f64; 4],
    ) -> [f64; 4] {
        let node = &self.nodes[position];
        if elements.clone().any(|element| element.flows) {
            let largest = elements.map(|element| invariants(element.stress).1).fold(0.0, f64::max);
            return node.flowing(extrapolated, largest);
        }
        let (mut meridian, mut hoop, mut n) = (0.0, 0.0, 0.0);
        for element in elements {
            let [along, around] = self.of_element(node, &element);
            (meridian, hoop, n) = (meridian + along, hoop + around, n + 1.0);
        }
        node.components(meridian / n, hoop / n)
    }

    /// Returns σ_ss and σ_θθ at a node from one element.
    fn of_element(&self, node: &SurfaceNode, element: &ElementState) -> [f64; 2] {
        let [reference, deformed] = node.tangents;
        let [_, normal, _] = in_axes(deformed, element.stress);
        let [rr, yy, tt, ry] = element.strain;
        let [strain, ..] = in_axes(reference, [rr, yy, tt, 0.5 * ry]);
        let (along, around) = (node.strains[0] - strain, node.strains[1] - tt);
        let (lambda, shear) = (self.moduli.lame_lambda(), self.moduli.shear_modulus());
        let across = (-node.pressure - normal - lambda * (along + around)) / (lambda + 2.0 * shear);
        let volume = lambda * (along + around + across);
        let [meridian, ..] = in_axes(deformed, element.stress);
        [meridian + volume + 2.0 * shear * along, element.stress[2] + volume + 2.0 * shear * around]
    }
}

impl SurfaceNode {
    /// Returns the stress of a flowing body: the deviator of an extrapolated one, with at most this von Mises stress, and
    /// the pressure that the traction asks for.
    fn flowing(&self, extrapolated: [f64; 4], largest: f64) -> [f64; 4] {
        let [meridian, normal, _] = in_axes(self.tangents[1], extrapolated);
        let hoop = extrapolated[2];
        let (_, von_mises) = invariants([meridian, normal, hoop, 0.0]);
        let scale = if von_mises > largest { largest / von_mises } else { 1.0 };
        let from_normal = |stress: f64| scale * (stress - normal) - self.pressure;
        self.components(from_normal(meridian), from_normal(hoop))
    }

    /// Returns (σ_rr, σ_yy, σ_θθ, σ_ry) of the stresses along the meridian and the hoop, with the pressure on the surface.
    fn components(&self, meridian: f64, hoop: f64) -> [f64; 4] {
        let [r, y] = self.tangents[1];
        let normal = -self.pressure;
        [
            meridian * r * r + normal * y * y,
            meridian * y * y + normal * r * r,
            hoop,
            (meridian - normal) * r * y,
        ]
    }
}

/// Returns the components ss, nn and sn of a tensor (rr, yy, θθ, ry), for a unit tangent s and its normal n = (−s_y, s_r).
fn in_axes([r, y]: [f64; 2], [rr, yy, _, ry]: [f64; 4]) -> [f64; 3] {
    [
        rr * r * r + yy * y * y + 2.0 * ry * r * y,
        rr * y * y + yy * r * r - 2.0 * ry * r * y,
        (yy - rr) * r * y + ry * (r * r - y * y),
    ]
}

fn unit([r, y]: [f64; 2]) -> [f64; 2] {
    let length = r.hypot(y);
    [r / length, y / length]
}

/// The contact pressure p (Pa) at a radius, and ∫₀ʳ p ρ dρ, N.
#[derive(Debug, Clone, Copy, Default)]
struct RadialLoad {
    pressure: f64,
    inner: f64,
}

/// The contact pressure and its integral at the points of a profile.
struct RadialLoads<'a> {
    contact: &'a ContactProfile,
    inner: Vec<f64>,
}

impl<'a> RadialLoads<'a> {
    fn of(contact: &'a ContactProfile) -> Self {
        let mut inner = Vec::with_capacity(contact.places.len());
        let (mut sum, mut before) = (0.0, [0.0; 2]);
        for (k, place) in contact.places.iter().enumerate() {
            let here = [place.radius, place.pressure];
            sum += if k == 0 { 0.5 * here[1] * here[0] * here[0] } else { between(before, here) };
            before = here;
            inner.push(sum);
        }
        Self { contact, inner }
    }

    /// Returns pressure and integral at a radius (m), for a pressure that is linear between the points of the profile.
    fn at(&self, radius: f64) -> RadialLoad {
        let (places, pressure) = (&self.contact.places, self.contact.pressure_at(radius));
        let outer = places.partition_point(|place| place.radius <= radius);
        let inner = match outer.checked_sub(1).map(|k| (&places[k], self.inner[k])) {
            Some((place, sum)) => sum + between([place.radius, place.pressure], [radius, pressure]),
            None => 0.5 * pressure * radius * radius,
        };
        RadialLoad { pressure, inner }
    }
}

/// Returns ∫ p ρ dρ between two points (ρ, p), by Simpson's rule, which is exact for a linear p.
fn between([a, p]: [f64; 2], [b, q]: [f64; 2]) -> f64 {
    (b - a) / 6.0 * (a * p + (a + b) * (p + q) + b * q)
}

#[cfg(test)]
mod tests {
    use fem_material::Material;
    use fem_mesh::{HalfDisc, QuarterDisc, Side};

    use super::*;
    use crate::fields::{ContactProfilePoint, StressField};

    fn moduli() -> ElasticModuli {
        ElasticModuli::from_youngs_modulus_poissons_ratio(1.0, 0.3).unwrap()
    }

    fn profile(radius: f64, pressure: impl Fn(f64) -> f64) -> ContactProfile {
        let place = |k: usize| {
            let radius = radius * k as f64 / 64.0;
            ContactProfilePoint { radius, pressure: pressure(radius), ..Default::default() }
        };
        ContactProfile { radius, places: (0..=64).map(place).collect() }
    }

    /// ∫ p ρ dρ of p = 2 − ρ is ρ² − ρ³/3, at points and between them, and constant beyond the last one.
    #[test]
    fn pressure_and_its_integral_are_those_of_a_linear_pressure() {
        let contact = profile(2.0, |r| 2.0 - r);
        let loads = RadialLoads::of(&contact);
        for r in [0.0, 0.01, 0.5, 1.7, 2.0] {
            let load = loads.at(r);
            // Rounding of 64 parts.
            assert!((load.inner - (r * r - r * r * r / 3.0)).abs() < 1e-14, "{r} {load:?}");
            assert!((load.pressure - (2.0 - r)).abs() < 1e-14, "{r} {load:?}");
        }
        assert_eq!((loads.at(3.0).pressure, loads.at(3.0).inner), (0.0, loads.at(2.0).inner));
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
