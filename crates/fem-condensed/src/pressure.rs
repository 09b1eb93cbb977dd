//! Contact radius and pressure from the forces at the points.

use fem_contact::centre_pressure;

use crate::disc::Disc;
use crate::pair::CondensedPair;

/// Distance of the contact's edge from the node whose force passes through zero, in elements: a
/// node joins while the edge of the contact is still so far inside of it. Measured on Hertz'
/// contact, 0.31 from 4 to 32 elements across; every edge is alike on the scale of an element.
const EDGE_INSIDE: f64 = 0.31;

impl CondensedPair {
    /// Radius at which the pressure falls to zero (m) and pressure on the axis (Pa); of surfaces that have
    /// slipped, q of each side, m².
    pub(crate) fn radius_and_pressure(
        &self,
        contact: &Disc,
        forces: &[f64],
        moved: [f64; 2],
    ) -> (f64, f64) {
        let n = contact.n_closed;
        if n == 0 {
            return (0.0, 0.0);
        }
        let (last, next) = (&self.points[n - 1], &self.points[n]);
        let width = next.radius - last.radius;
        let radius = if self.nodal_side.is_some() {
            let edge = forces[n - 1] / (forces[n - 1] - contact.tension) - EDGE_INSIDE;
            (last.radius + edge * width).max(0.0)
        } else {
            // Where the signed pressure of the springs passes through zero, as in fem-contact.
            let (inside, outside) = (forces[n - 1] / last.area, next.stiffness * contact.gap);
            last.radius + width * inside / (inside + outside)
        };
        let spacing = self.nodes[1].radius;
        let pressure = centre_pressure(self.nodal_pressure(forces), radius, spacing);
        match &self.settings().slip {
            None => (radius, pressure),
            Some(slip) => slip.halfway([radius, pressure], forces.iter().sum(), moved),
        }
    }

    /// Pressure at the nodes of a deformable side from the axis outward, (r in m, p in Pa): nodal
    /// force over nodal area.
    pub fn nodal_pressure<'a>(
        &'a self,
        forces: &'a [f64],
    ) -> impl Iterator<Item = (f64, f64)> + 'a {
        self.nodes.iter().map(move |node| {
            let force: f64 = node
                .shares
                .iter()
                .filter_map(|(point, share)| Some(share * forces.get(*point)?))
                .sum();
            (node.radius, force / node.area)
        })
    }
}
