//! Contact radius and pressure of moved surfaces: true ones.

use super::MovedInterface;
use super::pieces::GAUSS;
use crate::pressure::{coarser, staggered_lengths};
use crate::read_out::{Barrier, centre_pressure, contact_radius, staggered_radius};

impl MovedInterface {
    /// Distance from the axis at which the pressure falls to zero now, m; 0 without contact: see
    /// [`contact_radius`](crate::contact_radius).
    pub fn contact_radius(&self, u: [&[[f64; 2]]; 2]) -> f64 {
        let at = |side: usize| contact_radius(self.at_nodes(side, u), Barrier::Springs);
        match staggered_lengths(&self.surfaces) {
            Some(lengths) => staggered_radius([at(0), at(1)], lengths),
            None => at(coarser(&self.surfaces, self.candidate_radius)),
        }
    }

    /// Contact pressure at the nodes of a deformable side, from the axis outward: where the node is now
    /// (r in m), and the force along y over the area of its surroundings seen along y, which is the true
    /// pressure on the true area (p in Pa).
    pub fn nodal_pressure<'a>(
        &'a self,
        u: [&'a [[f64; 2]]; 2],
    ) -> impl Iterator<Item = (f64, f64)> + Clone + 'a {
        self.at_nodes(coarser(&self.surfaces, self.candidate_radius), u)
    }

    /// The same of one side, 0 the lower one.
    fn at_nodes<'a>(
        &'a self,
        side: usize,
        u: [&'a [[f64; 2]]; 2],
    ) -> impl Iterator<Item = (f64, f64)> + Clone + 'a {
        let surface = &self.surfaces[side];
        let pieces = self.pieces(u.map(|u| move |node: u32| u[node as usize]));
        let points = pieces.flat_map(|piece| GAUSS.map(|gauss| (piece, piece.point(gauss))));
        let mut points = points.peekable();
        // Force and area that the segment inside of a node has given to it.
        let mut from_inside = [0.0; 2];
        (0..self.n_nodes[side]).map(move |k| {
            let [mut force, mut area] = from_inside;
            from_inside = [0.0; 2];
            while let Some((piece, point)) =
                points.next_if(|(piece, _)| piece.segments[side].index == k)
            {
                let share = point.places[side].share;
                let pressure = (-piece.stiffness * point.gap).max(0.0);
                let (inner, outer) = ((1.0 - share) * point.area, share * point.area);
                force += inner * pressure;
                area += inner;
                from_inside[0] += outer * pressure;
                from_inside[1] += outer;
            }
            let radius = surface.radii[k] + u[side][surface.nodes[k] as usize][0];
            (radius, if area > 0.0 { force / area } else { 0.0 })
        })
    }

    /// True contact pressure on the axis, Pa; 0 without contact there: see
    /// [`centre_pressure`](crate::centre_pressure), of the nodes where they are now.
    pub fn centre_pressure(&self, u: [&[[f64; 2]]; 2]) -> f64 {
        let radius = self.contact_radius(u);
        let at = |side: usize| centre_pressure(self.at_nodes(side, u), radius, Barrier::Springs);
        match staggered_lengths(&self.surfaces) {
            Some(_) => 0.5 * (at(0) + at(1)),
            None => at(coarser(&self.surfaces, self.candidate_radius)),
        }
    }
}
