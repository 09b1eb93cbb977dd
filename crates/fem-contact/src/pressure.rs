//! Contact radius and pressure, recovered from a configuration.

use crate::interface::ContactInterface;
use crate::pressure_recovery::{self, ContactEnforcement, RecoverySurfaces};
use crate::surface::Surface;

impl ContactInterface {
    /// Returns the radius at which the pressure falls to zero, m; 0 without contact: see
    /// [`contact_radius`](crate::contact_radius).
    pub fn contact_radius(&self, u: [&[[f64; 2]]; 2]) -> f64 {
        self.radius_of(self.signed_pressure(u))
    }

    /// Returns the contact radius (m) for given signed pressures at the points.
    pub(crate) fn radius_of(
        &self,
        signed_pressure: impl Iterator<Item = (f64, f64)> + Clone,
    ) -> f64 {
        recovery_surfaces(&self.surfaces, self.candidate_radius).radius(|side| {
            let nodes = self.at_nodes(side, signed_pressure.clone());
            pressure_recovery::contact_radius(nodes, ContactEnforcement::Springs)
        })
    }

    /// Returns the side whose nodes define the profile.
    pub(crate) fn coarser(&self) -> usize {
        coarser(self.surfaces.each_ref(), self.candidate_radius)
    }

    /// Returns the contact pressure at the nodes of a deformable side, from the axis outward: (r in m, p in Pa),
    /// the nodal contact force over the nodal area.
    pub fn nodal_pressure<'a>(
        &'a self,
        u: [&'a [[f64; 2]]; 2],
    ) -> impl Iterator<Item = (f64, f64)> + Clone + 'a {
        self.at_nodes(self.coarser(), self.signed_pressure(u))
    }

    /// Returns radius (m) and contact pressure (Pa) at the nodes of one side (0 lower, 1 upper), for given signed
    /// pressures at the points.
    pub(crate) fn at_nodes<'a>(
        &'a self,
        side: usize,
        signed_pressure: impl Iterator<Item = (f64, f64)> + Clone + 'a,
    ) -> impl Iterator<Item = (f64, f64)> + Clone + 'a {
        let pressures = signed_pressure.map(|(_, pressure)| pressure.max(0.0));
        let sums = self.sums_at_nodes(side, pressures);
        sums.map(|(radius, [sum, area])| (radius, if area > 0.0 { sum / area } else { 0.0 }))
    }

    /// Returns for each node of a side its radius (m), the integral of the points' values over its hat function,
    /// and the area of the hat, m².
    fn sums_at_nodes<'a>(
        &'a self,
        side: usize,
        values: impl Iterator<Item = f64> + Clone + 'a,
    ) -> impl Iterator<Item = (f64, [f64; 2])> + Clone + 'a {
        let surface = &self.surfaces[side];
        let mut points = self.points.iter().zip(values).peekable();
        // Integral and area from the segment inside of a node.
        let mut from_inside = [0.0; 2];
        self.candidate_nodes(side).zip(&surface.radii).map(move |(node, &radius)| {
            let [mut sum, mut area] = from_inside;
            from_inside = [0.0; 2];
            while let Some((point, value)) =
                points.next_if(|(point, _)| point.projections[side].nodes[0] == node)
            {
                let [inner, outer] = point.projections[side].shape.map(|shape| point.area * shape);
                sum += inner * value;
                area += inner;
                from_inside[0] += outer * value;
                from_inside[1] += outer;
            }
            (radius, [sum, area])
        })
    }

    /// Returns radius, integral and area at the nodes of the coarser side, as [`Self::sums_at_nodes`] does.
    pub(crate) fn sums<'a>(
        &'a self,
        values: impl Iterator<Item = f64> + Clone + 'a,
    ) -> impl Iterator<Item = (f64, [f64; 2])> + Clone + 'a {
        self.sums_at_nodes(self.coarser(), values)
    }

    /// Returns the contact pressure on the axis, Pa; 0 without contact there: see
    /// [`centre_pressure`](crate::centre_pressure).
    pub fn centre_pressure(&self, u: [&[[f64; 2]]; 2]) -> f64 {
        self.radius_and_pressure(u).1
    }

    /// Returns the [radius](Self::contact_radius) (m) and the [pressure on the axis](Self::centre_pressure) (Pa).
    pub fn radius_and_pressure(&self, u: [&[[f64; 2]]; 2]) -> (f64, f64) {
        self.radius_and_pressure_of(self.signed_pressure(u))
    }

    /// Returns the contact radius (m) and the pressure on the axis (Pa) for given signed pressures at the points.
    pub(crate) fn radius_and_pressure_of(
        &self,
        signed_pressure: impl Iterator<Item = (f64, f64)> + Clone,
    ) -> (f64, f64) {
        radius_and_pressure(recovery_surfaces(&self.surfaces, self.candidate_radius), |side| {
            self.at_nodes(side, signed_pressure.clone())
        })
    }
}

/// Number of nodal pressures that are stored; those of larger contacts are evaluated again for each use.
const STORED_PRESSURES: usize = 64;

/// Returns contact radius (m) and pressure on the axis (Pa) for pressures at the nodes of either side from the
/// axis outward (r in m, p in Pa). Nodal pressures are evaluated once, because they cost more than their use.
pub(crate) fn radius_and_pressure<I: Iterator<Item = (f64, f64)> + Clone>(
    recovery: RecoverySurfaces,
    at_nodes: impl Fn(usize) -> I,
) -> (f64, f64) {
    let mut room = [[(0.0, 0.0); STORED_PRESSURES]; 2];
    let kept = [0, 1].map(|side: usize| {
        if !recovery.includes(side) {
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
    let radius = recovery.radius(|side| match nodes(side) {
        Some(nodes) => pressure_recovery::contact_radius(nodes, ContactEnforcement::Springs),
        None => pressure_recovery::contact_radius(at_nodes(side), ContactEnforcement::Springs),
    });
    let pressure = recovery.pressure(|side| match nodes(side) {
        Some(nodes) => {
            pressure_recovery::centre_pressure(nodes, radius, ContactEnforcement::Springs)
        }
        None => {
            pressure_recovery::centre_pressure(at_nodes(side), radius, ContactEnforcement::Springs)
        }
    });
    (radius, pressure)
}

/// Selects the surfaces for the recovery of radius and pressure; they can touch out to a radius, m.
pub(crate) fn recovery_surfaces(surfaces: &[Surface; 2], radius: f64) -> RecoverySurfaces {
    let lengths = surfaces.each_ref().map(|s| (!s.is_rigid()).then(|| s.segment_length(0)));
    RecoverySurfaces::of(lengths, coarser(surfaces.each_ref(), radius))
}

/// Returns the deformable side with fewer nodes out to a radius, m, at which pressures are recovered.
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

    /// Radius and pressure are the same together and by themselves, for contacts with fewer nodes than are stored,
    /// as many, and more, at one surface and at both.
    #[test]
    fn radius_and_pressure_together_equal_the_separate_results() {
        let hertz = |n: usize, length: f64| {
            (0..n).map(move |k| {
                let r = k as f64 * length;
                let x = r / (0.8 * n as f64);
                (r, (1.0 - x * x).max(0.0).sqrt())
            })
        };
        for n in [8, STORED_PRESSURES, STORED_PRESSURES + 1, 200] {
            let lengths = [1.0, 1.04];
            let at = |side: usize| hertz(n, lengths[side]);
            for recovery in [
                RecoverySurfaces::Single(0),
                RecoverySurfaces::Single(1),
                RecoverySurfaces::of(lengths.map(Some), 0),
            ] {
                let radius = recovery.radius(|side| {
                    pressure_recovery::contact_radius(at(side), ContactEnforcement::Springs)
                });
                let pressure = recovery.pressure(|side| {
                    pressure_recovery::centre_pressure(
                        at(side),
                        radius,
                        ContactEnforcement::Springs,
                    )
                });
                assert!((0.7..0.9).contains(&(radius / n as f64)), "{n} {recovery:?}: {radius}");
                let n_made = Cell::new(0);
                let counted = |side: usize| {
                    n_made.set(n_made.get() + 1);
                    at(side)
                };
                let both = radius_and_pressure(recovery, counted);
                assert_eq!(both, (radius, pressure), "{n} {recovery:?}");
                // Pressures are made once at each surface where there is room for them.
                let n_read = [0, 1].into_iter().filter(|&side| recovery.includes(side)).count();
                let most = if n <= STORED_PRESSURES { n_read } else { 3 * n_read };
                assert_eq!(n_made.get(), most, "{n} {recovery:?}");
            }
        }
    }
}
