//! Contact radius and pressure, recovered from a configuration.

use crate::interface::ContactInterface;

/// Share of the contact radius over which the pressure on the axis is fitted.
const FIT_RADIUS: f64 = 0.8;
/// Fewest nodes for the fit; with fewer the value at the axis node stands.
const FIT_NODES: usize = 4;

impl ContactInterface {
    /// Radius at which the pressure falls to zero, m; 0 without contact.
    ///
    /// Interpolated linearly in the signed penalty pressure −k g between the
    /// outermost closed point and the next.
    pub fn contact_radius(&self, u: [&[[f64; 2]]; 2]) -> f64 {
        edge(self.signed_pressure(u))
    }

    /// Contact pressure at the nodes of a deformable side, from the axis
    /// outward: (r in m, p in Pa), the nodal contact force over the nodal area.
    pub fn nodal_pressure<'a>(
        &'a self,
        u: [&'a [[f64; 2]]; 2],
    ) -> impl Iterator<Item = (f64, f64)> + 'a {
        self.at_nodes(self.signed_pressure(u))
    }

    /// The same of signed pressures at the points.
    pub(crate) fn at_nodes<'a>(
        &'a self,
        signed_pressure: impl Iterator<Item = (f64, f64)> + 'a,
    ) -> impl Iterator<Item = (f64, f64)> + 'a {
        let side = usize::from(self.surfaces[0].is_rigid());
        let surface = &self.surfaces[side];
        let mut points = self.points.iter().zip(signed_pressure).peekable();
        // Force and area that the segment inside of a node has given to it.
        let mut from_inside = [0.0; 2];
        self.candidate_nodes(side).zip(&surface.radii).map(move |(node, &radius)| {
            let [mut force, mut area] = from_inside;
            from_inside = [0.0; 2];
            while let Some((point, (_, pressure))) =
                points.next_if(|(point, _)| point.feet[side].nodes[0] == node)
            {
                let [inner, outer] = point.feet[side].shape.map(|shape| point.area * shape);
                let pressure = pressure.max(0.0);
                force += inner * pressure;
                area += inner;
                from_inside[0] += outer * pressure;
                from_inside[1] += outer;
            }
            (radius, if area > 0.0 { force / area } else { 0.0 })
        })
    }

    /// Contact pressure on the axis, Pa; 0 without contact there.
    ///
    /// The axis node represents a disc of one element's radius and reads low and
    /// noisy, so p² = α − β r² (exact for Hertz' profile) is fitted to the nodes
    /// within 0.8 contact radii, weighted with their distance from the axis as
    /// their areas are, and √α returned; with fewer than four nodes there, or
    /// a fit that rises outward from nothing, the axis node's own value.
    pub fn centre_pressure(&self, u: [&[[f64; 2]]; 2]) -> f64 {
        self.on_axis(self.nodal_pressure(u), self.contact_radius(u))
    }

    /// The same of pressures at nodes and a contact radius, m.
    pub(crate) fn on_axis(
        &self,
        nodes: impl Iterator<Item = (f64, f64)>,
        contact_radius: f64,
    ) -> f64 {
        let side = usize::from(self.surfaces[0].is_rigid());
        centre_pressure(nodes, contact_radius, self.surfaces[side].segment_length(0))
    }
}

/// Where signed pressures, (r in m, p in Pa) from the axis outward, pass through zero; 0 without
/// contact.
pub(crate) fn edge(signed_pressure: impl DoubleEndedIterator<Item = (f64, f64)>) -> f64 {
    let mut outside: Option<(f64, f64)> = None;
    for (radius, pressure) in signed_pressure.rev() {
        if pressure > 0.0 {
            return match outside {
                Some((open, tension)) => radius + (open - radius) * pressure / (pressure - tension),
                None => radius,
            };
        }
        outside = Some((radius, pressure));
    }
    0.0
}

/// Pressure on the axis (Pa) of pressures at nodes, (r in m, p in Pa) from the axis outward, for a
/// contact radius and an element size on the axis (m); see [`ContactInterface::centre_pressure`].
pub fn centre_pressure(
    nodes: impl Iterator<Item = (f64, f64)>,
    contact_radius: f64,
    spacing: f64,
) -> f64 {
    let limit = FIT_RADIUS * contact_radius;
    let (mut own, mut n_inside) = (0.0, 0);
    let mut sums = [0.0; 5];
    for (node, (r, p)) in nodes.enumerate() {
        if node == 0 {
            own = p;
        }
        if r >= limit {
            break;
        }
        n_inside += 1;
        let (weight, x, y) = (r.max(0.25 * spacing), (r / limit).powi(2), p * p);
        let terms = [1.0, x, x * x, y, x * y];
        for (sum, term) in sums.iter_mut().zip(terms) {
            *sum += weight * term;
        }
    }
    if n_inside < FIT_NODES {
        return own;
    }
    let [s0, s1, s2, y0, y1] = sums;
    let squared = (y0 * s2 - y1 * s1) / (s0 * s2 - s1 * s1);
    if squared > 0.0 { squared.sqrt() } else { own }
}
