//! Contact radius and pressure, recovered from a configuration.

use crate::interface::ContactInterface;
use crate::pressure_recovery::{self, ContactEnforcement, Reading};
use crate::surface::Surface;

impl ContactInterface {
    /// Radius at which the pressure falls to zero, m; 0 without contact: see
    /// [`contact_radius`](crate::contact_radius).
    pub fn contact_radius(&self, u: [&[[f64; 2]]; 2]) -> f64 {
        self.radius_of(self.signed_pressure(u))
    }

    /// The same of signed pressures at the points.
    pub(crate) fn radius_of(
        &self,
        signed_pressure: impl Iterator<Item = (f64, f64)> + Clone,
    ) -> f64 {
        reading(&self.surfaces, self.candidate_radius).radius(|side| {
            let nodes = self.at_nodes(side, signed_pressure.clone());
            pressure_recovery::contact_radius(nodes, ContactEnforcement::Springs)
        })
    }

    /// The side whose nodes define the profile.
    pub(crate) fn coarser(&self) -> usize {
        coarser(self.surfaces.each_ref(), self.candidate_radius)
    }

    /// Contact pressure at the nodes of a deformable side, from the axis
    /// outward: (r in m, p in Pa), the nodal contact force over the nodal area.
    pub fn nodal_pressure<'a>(
        &'a self,
        u: [&'a [[f64; 2]]; 2],
    ) -> impl Iterator<Item = (f64, f64)> + Clone + 'a {
        self.at_nodes(self.coarser(), self.signed_pressure(u))
    }

    /// The same at the nodes of one side (0 lower, 1 upper), of signed pressures at the points.
    pub(crate) fn at_nodes<'a>(
        &'a self,
        side: usize,
        signed_pressure: impl Iterator<Item = (f64, f64)> + Clone + 'a,
    ) -> impl Iterator<Item = (f64, f64)> + Clone + 'a {
        let pressures = signed_pressure.map(|(_, pressure)| pressure.max(0.0));
        let sums = self.sums_at_nodes(side, pressures);
        sums.map(|(radius, [sum, area])| (radius, if area > 0.0 { sum / area } else { 0.0 }))
    }

    /// Of what each point has the integral over the hat of each node of a side, and its area, m², with the
    /// radius of the node, m.
    fn sums_at_nodes<'a>(
        &'a self,
        side: usize,
        values: impl Iterator<Item = f64> + Clone + 'a,
    ) -> impl Iterator<Item = (f64, [f64; 2])> + Clone + 'a {
        let surface = &self.surfaces[side];
        let mut points = self.points.iter().zip(values).peekable();
        // Integral and area that the segment inside of a node has given to it.
        let mut from_inside = [0.0; 2];
        self.candidate_nodes(side).zip(&surface.radii).map(move |(node, &radius)| {
            let [mut sum, mut area] = from_inside;
            from_inside = [0.0; 2];
            while let Some((point, value)) =
                points.next_if(|(point, _)| point.feet[side].nodes[0] == node)
            {
                let [inner, outer] = point.feet[side].shape.map(|shape| point.area * shape);
                sum += inner * value;
                area += inner;
                from_inside[0] += outer * value;
                from_inside[1] += outer;
            }
            (radius, [sum, area])
        })
    }

    /// The same of what each point has, at the nodes at which pressures are read.
    pub(crate) fn sums<'a>(
        &'a self,
        values: impl Iterator<Item = f64> + Clone + 'a,
    ) -> impl Iterator<Item = (f64, [f64; 2])> + Clone + 'a {
        self.sums_at_nodes(self.coarser(), values)
    }

    /// Contact pressure on the axis, Pa; 0 without contact there: see [`centre_pressure`](crate::centre_pressure).
    pub fn centre_pressure(&self, u: [&[[f64; 2]]; 2]) -> f64 {
        self.radius_and_pressure(u).1
    }

    /// [Radius](Self::contact_radius), m, and [pressure on the axis](Self::centre_pressure), Pa, which asks for the
    /// radius.
    pub fn radius_and_pressure(&self, u: [&[[f64; 2]]; 2]) -> (f64, f64) {
        self.radius_and_pressure_of(self.signed_pressure(u))
    }

    /// The same of signed pressures at the points.
    pub(crate) fn radius_and_pressure_of(
        &self,
        signed_pressure: impl Iterator<Item = (f64, f64)> + Clone,
    ) -> (f64, f64) {
        radius_and_pressure(reading(&self.surfaces, self.candidate_radius), |side| {
            self.at_nodes(side, signed_pressure.clone())
        })
    }
}

/// Nodes that are kept between both readings; of contacts with more the pressures are made anew.
const ROOM: usize = 64;

/// Contact radius (m) and pressure on the axis (Pa) of pressures at the nodes of either side from the axis
/// outward (r in m, p in Pa), which are made once: they cost more than what is read of them.
pub(crate) fn radius_and_pressure<I: Iterator<Item = (f64, f64)> + Clone>(
    reading: Reading,
    at_nodes: impl Fn(usize) -> I,
) -> (f64, f64) {
    let mut room = [[(0.0, 0.0); ROOM]; 2];
    let kept = [0, 1].map(|side: usize| {
        if !reading.asks(side) {
            return None;
        }
        let mut n = 0;
        for node in at_nodes(side) {
            *room[side].get_mut(n)? = node;
            n += 1;
        }
        Some(n)
    });
    let nodes = |side: usize| kept[side].map(|n| room[side][..n].iter().copied());
    let radius = reading.radius(|side| match nodes(side) {
        Some(nodes) => pressure_recovery::contact_radius(nodes, ContactEnforcement::Springs),
        None => pressure_recovery::contact_radius(at_nodes(side), ContactEnforcement::Springs),
    });
    let pressure = reading.pressure(|side| match nodes(side) {
        Some(nodes) => {
            pressure_recovery::centre_pressure(nodes, radius, ContactEnforcement::Springs)
        }
        None => {
            pressure_recovery::centre_pressure(at_nodes(side), radius, ContactEnforcement::Springs)
        }
    });
    (radius, pressure)
}

/// At whose nodes radius and pressure of surfaces are read, which can touch out to a radius, m.
pub(crate) fn reading(surfaces: &[Surface; 2], radius: f64) -> Reading {
    let lengths = surfaces.each_ref().map(|s| (!s.is_rigid()).then(|| s.segment_length(0)));
    Reading::of(lengths, coarser(surfaces.each_ref(), radius))
}

/// The side that deforms and has the longer segments, at whose nodes pressures are read.
pub(crate) fn coarser(surfaces: [&Surface; 2], radius: f64) -> usize {
    let n_nodes = surfaces.map(|surface| match surface.is_rigid() {
        true => usize::MAX,
        false => surface.nodes_within(radius).len(),
    });
    usize::from(n_nodes[1] < n_nodes[0])
}

#[cfg(test)]
mod tests {
    use std::cell::Cell;

    use super::*;

    /// Of contacts with fewer nodes than are kept, with as many and with more, read at one surface and at
    /// both: what each reading tells of the pressures by itself.
    #[test]
    fn both_readings_are_those_of_each() {
        let hertz = |n: usize, length: f64| {
            (0..n).map(move |k| {
                let r = k as f64 * length;
                let x = r / (0.8 * n as f64);
                (r, (1.0 - x * x).max(0.0).sqrt())
            })
        };
        for n in [8, ROOM, ROOM + 1, 200] {
            let lengths = [1.0, 1.04];
            let at = |side: usize| hertz(n, lengths[side]);
            for reading in
                [Reading::Single(0), Reading::Single(1), Reading::of(lengths.map(Some), 0)]
            {
                let radius = reading.radius(|side| {
                    pressure_recovery::contact_radius(at(side), ContactEnforcement::Springs)
                });
                let pressure = reading.pressure(|side| {
                    pressure_recovery::centre_pressure(
                        at(side),
                        radius,
                        ContactEnforcement::Springs,
                    )
                });
                assert!((0.7..0.9).contains(&(radius / n as f64)), "{n} {reading:?}: {radius}");
                let n_made = Cell::new(0);
                let counted = |side: usize| {
                    n_made.set(n_made.get() + 1);
                    at(side)
                };
                let both = radius_and_pressure(reading, counted);
                assert_eq!(both, (radius, pressure), "{n} {reading:?}");
                // Pressures are made once at each surface where there is room for them.
                let n_read = [0, 1].into_iter().filter(|&side| reading.asks(side)).count();
                let most = if n <= ROOM { n_read } else { 3 * n_read };
                assert_eq!(n_made.get(), most, "{n} {reading:?}");
            }
        }
    }
}
