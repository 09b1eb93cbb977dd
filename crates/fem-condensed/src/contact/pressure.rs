//! Contact radius and pressure from the forces at the points.

use fem_contact::{ContactEnforcement, Reading, centre_pressure, contact_radius};

use crate::contact::disc_contact::ContactDisc;
use crate::operators::body_operator::PressureNode;
use crate::pair::CondensedPair;

/// Room for the pressures at the nodes of both surfaces (r in m, p in Pa), which are read more than once.
pub(crate) type Pressures = [Vec<(f64, f64)>; 2];

impl CondensedPair {
    /// Radius at which the pressure falls to zero (m) and pressure on the axis (Pa); of surfaces that have
    /// slipped, q of each side, m².
    pub(crate) fn radius_and_pressure(
        &self,
        contact: &ContactDisc,
        forces: &[f64],
        moved: [f64; 2],
        room: &mut Pressures,
    ) -> (f64, f64) {
        if contact.n_closed == 0 {
            return (0.0, 0.0);
        }
        let (radius, pressure) = self.read_out(forces, room);
        match &self.settings().slip {
            None => (radius, pressure),
            Some(slip) => slip.halfway([radius, pressure], forces.iter().sum(), moved),
        }
    }

    /// The same of surfaces that do not slip, or as if they had not.
    pub(crate) fn read_out(&self, forces: &[f64], room: &mut Pressures) -> (f64, f64) {
        let barrier = self.barrier();
        let other = self.staggered.as_ref();
        let reading = other.map_or(Reading::Single(0), |other| Reading::Staggered(other.lengths));
        let surfaces = [Some(&self.nodes), other.map(|other| &other.nodes)];
        for (room, nodes) in room.iter_mut().zip(surfaces) {
            room.clear();
            room.extend(nodes.into_iter().flat_map(|nodes| pressures(nodes, forces)));
        }
        let at = |surface: usize| room[surface].iter().copied();
        let radius = reading.radius(|surface| contact_radius(at(surface), barrier));
        let of_axis = |surface| centre_pressure(at(surface), radius, barrier);
        (radius, reading.pressure(of_axis))
    }

    /// The contact model: rigid forces or penalty springs.
    pub(crate) fn barrier(&self) -> ContactEnforcement {
        if self.nodal_side.is_some() {
            ContactEnforcement::Rigid
        } else {
            ContactEnforcement::Springs
        }
    }

    /// Pressure at the nodes of a deformable side from the axis outward, (r in m, p in Pa): nodal
    /// force over nodal area.
    pub fn nodal_pressure<'a>(
        &'a self,
        forces: &'a [f64],
    ) -> impl Iterator<Item = (f64, f64)> + Clone + 'a {
        pressures(&self.nodes, forces)
    }
}

fn pressures<'a>(
    nodes: &'a [PressureNode],
    forces: &'a [f64],
) -> impl Iterator<Item = (f64, f64)> + Clone + 'a {
    nodes.iter().map(move |node| {
        let force: f64 =
            node.shares.iter().filter_map(|(point, share)| Some(share * forces.get(*point)?)).sum();
        (node.radius, force / node.area)
    })
}
