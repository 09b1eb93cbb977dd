//! Contact radius and pressure from the forces at the points.

use fem_contact::{ContactEnforcement, RecoverySurfaces, centre_pressure, contact_radius};

use crate::contact::disc_contact::ContactDisc;
use crate::operators::body_operator::PressureNode;
use crate::pair::CondensedPair;

/// Buffers for the pressures at the nodes of both surfaces (r in m, p in Pa), which are used more than once.
pub(crate) type Pressures = [Vec<(f64, f64)>; 2];

impl CondensedPair {
    /// Returns the radius at which the pressure falls to zero (m) and the pressure on the axis (Pa), for the slip q of
    /// each side, m².
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
        let (radius, pressure) = self.recover(forces, room);
        match &self.settings().slip {
            None => (radius, pressure),
            Some(slip) => slip.halfway([radius, pressure], forces.iter().sum(), moved),
        }
    }

    /// Returns contact radius (m) and pressure on the axis (Pa) without slip.
    pub(crate) fn recover(&self, forces: &[f64], room: &mut Pressures) -> (f64, f64) {
        let enforcement = self.enforcement();
        let other = self.staggered.as_ref();
        let reading = other.map_or(RecoverySurfaces::Single(0), |other| {
            RecoverySurfaces::Staggered(other.lengths)
        });
        let surfaces = [Some(&self.nodes), other.map(|other| &other.nodes)];
        for (room, nodes) in room.iter_mut().zip(surfaces) {
            room.clear();
            room.extend(nodes.into_iter().flat_map(|nodes| pressures(nodes, forces)));
        }
        let at = |surface: usize| room[surface].iter().copied();
        let radius = reading.radius(|surface| contact_radius(at(surface), enforcement));
        let of_axis = |surface| centre_pressure(at(surface), radius, enforcement);
        (radius, reading.pressure(of_axis))
    }

    /// Returns the enforcement of the contact: rigid forces or penalty springs.
    pub(crate) fn enforcement(&self) -> ContactEnforcement {
        if self.nodal_side.is_some() {
            ContactEnforcement::Rigid
        } else {
            ContactEnforcement::Springs
        }
    }

    /// Returns the pressure at the nodes of a deformable side from the axis outward, (r in m, p in Pa): nodal
    /// force over nodal area.
    pub(crate) fn nodal_pressure<'a>(
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
