//! Contact radius and pressure from the forces at the points.

use fem_contact::{Barrier, centre_pressure, contact_radius};

use crate::disc::Disc;
use crate::pair::CondensedPair;

impl CondensedPair {
    /// Radius at which the pressure falls to zero (m) and pressure on the axis (Pa); of surfaces that have
    /// slipped, q of each side, m².
    pub(crate) fn radius_and_pressure(
        &self,
        contact: &Disc,
        forces: &[f64],
        moved: [f64; 2],
    ) -> (f64, f64) {
        if contact.n_closed == 0 {
            return (0.0, 0.0);
        }
        let nodes = self.nodal_pressure(forces);
        let radius = contact_radius(nodes.clone(), self.barrier());
        let pressure = centre_pressure(nodes, radius, self.barrier());
        match &self.settings().slip {
            None => (radius, pressure),
            Some(slip) => slip.halfway([radius, pressure], forces.iter().sum(), moved),
        }
    }

    /// What keeps the surfaces apart.
    pub(crate) fn barrier(&self) -> Barrier {
        if self.nodal_side.is_some() { Barrier::Rigid } else { Barrier::Springs }
    }

    /// Pressure at the nodes of a deformable side from the axis outward, (r in m, p in Pa): nodal
    /// force over nodal area.
    pub fn nodal_pressure<'a>(
        &'a self,
        forces: &'a [f64],
    ) -> impl Iterator<Item = (f64, f64)> + Clone + 'a {
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
