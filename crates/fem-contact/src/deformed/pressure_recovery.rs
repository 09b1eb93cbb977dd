//! Contact radius and pressure of deformed surfaces in the deformed configuration.

use super::DeformedInterface;
use super::common_refinement::{GAUSS, Interval};
use crate::pressure::{coarser, radius_and_pressure, recovery_surfaces};
use crate::pressure_recovery::{ContactEnforcement, contact_radius};
use crate::profile::{N_BEYOND, Profile};

impl DeformedInterface {
    /// Returns the current distance from the axis at which the pressure falls to zero, m; 0 without contact: see
    /// [`contact_radius`](crate::contact_radius).
    pub fn contact_radius(&self, u: [&[[f64; 2]]; 2]) -> f64 {
        recovery_surfaces(&self.surfaces, self.candidate_radius)
            .radius(|side| contact_radius(self.at_nodes(side, u), ContactEnforcement::Springs))
    }

    /// Returns the contact pressure at the nodes of a deformable side, from the axis outward: the current radius of
    /// the node (m), and the force along y over the projected area of its hat function, which is the true pressure
    /// on the true area (Pa).
    pub fn nodal_pressure<'a>(
        &'a self,
        u: [&'a [[f64; 2]]; 2],
    ) -> impl Iterator<Item = (f64, f64)> + Clone + 'a {
        self.at_nodes(coarser(self.surfaces.each_ref(), self.candidate_radius), u)
    }

    /// Returns radius (m) and contact pressure (Pa) at the nodes of a side, 0 the lower one.
    fn at_nodes<'a>(
        &'a self,
        side: usize,
        u: [&'a [[f64; 2]]; 2],
    ) -> impl Iterator<Item = (f64, f64)> + Clone + 'a {
        let pressure = |interval: &Interval<'a>, gauss: [f64; 2]| {
            interval.closed_point(gauss).map_or(0.0, |point| -interval.stiffness * point.gap)
        };
        let sums = self.sums_at_nodes(side, u, pressure);
        sums.map(|(radius, [sum, area])| (radius, if area > 0.0 { sum / area } else { 0.0 }))
    }

    /// Returns for each node of a side its current radius (m), the integral of the points' values over its hat
    /// function, and the projected area of the hat, m².
    fn sums_at_nodes<'a>(
        &'a self,
        side: usize,
        u: [&'a [[f64; 2]]; 2],
        value: impl Fn(&Interval<'a>, [f64; 2]) -> f64 + Clone + 'a,
    ) -> impl Iterator<Item = (f64, [f64; 2])> + Clone + 'a {
        let surface = &self.surfaces[side];
        let mut intervals = self.intervals(u.map(|u| move |node: u32| u[node as usize])).peekable();
        // Integral and area from the segment inside of a node.
        let mut from_inside = [0.0; 2];
        (0..self.n_nodes[side]).map(move |k| {
            let [mut sum, mut area] = from_inside;
            from_inside = [0.0; 2];
            while let Some(interval) =
                intervals.next_if(|interval| interval.segments[side].index == k)
            {
                for gauss in GAUSS {
                    let (radius, of_ring) = interval.ring(gauss);
                    let share = interval.segments[side].share(radius);
                    let value = value(&interval, gauss);
                    let (inner, outer) = ((1.0 - share) * of_ring, share * of_ring);
                    sum += inner * value;
                    area += inner;
                    from_inside[0] += outer * value;
                    from_inside[1] += outer;
                }
            }
            let radius = surface.radii[k] + u[side][surface.nodes[k] as usize][0];
            (radius, [sum, area])
        })
    }

    /// Returns the true contact pressure on the axis, Pa, from the current positions of the nodes; 0 without
    /// contact there: see [`centre_pressure`](crate::centre_pressure).
    pub fn centre_pressure(&self, u: [&[[f64; 2]]; 2]) -> f64 {
        self.radius_and_pressure(u).1
    }

    /// Returns the [radius](Self::contact_radius) (m) and the [pressure on the axis](Self::centre_pressure) (Pa).
    pub fn radius_and_pressure(&self, u: [&[[f64; 2]]; 2]) -> (f64, f64) {
        let recovery = recovery_surfaces(&self.surfaces, self.candidate_radius);
        radius_and_pressure(recovery, |side| self.at_nodes(side, u))
    }

    /// Returns the contact profile like [`ContactInterface::profile`](crate::ContactInterface::profile), with
    /// current distances from the axis and true pressures.
    pub fn profile(&self, u: [&[[f64; 2]]; 2]) -> Profile {
        let side = coarser(self.surfaces.each_ref(), self.candidate_radius);
        let gaps = self.sums_at_nodes(side, u, |interval, gauss| interval.point(gauss).gap);
        let facing = gaps.map(|(radius, [sum, area])| {
            let own = |of: usize| self.radial_displacement(of, radius, u[of]);
            (area > 0.0).then(|| (sum / area, [own(0), own(1)]))
        });
        let radius = self.contact_radius(u);
        let own = Profile::new(self.nodal_pressure(u), radius, ContactEnforcement::Springs, facing);
        let last = own.points.last().map_or(0.0, |point| point.radius);
        let (surface, of) =
            (&self.surfaces[side], |k: usize| self.surfaces[side].nodes[k] as usize);
        let now = |k: usize| surface.radii[k] + u[side][of(k)][0];
        // As long as the surface runs outward.
        let rising = (1..surface.radii.len()).take_while(|k| now(*k) > now(k - 1)).map(now);
        let beyond = rising.filter(|radius| *radius > last * (1.0 + 1e-9)).take(N_BEYOND);
        let faces = |radius: f64| {
            let [lower, upper] = [self.height(0, radius, u[0])?, self.height(1, radius, u[1])?];
            let radial = [0, 1].map(|side: usize| self.radial_displacement(side, radius, u[side]));
            Some((radius, (upper - lower, radial)))
        };
        own.extended(beyond.map_while(faces))
    }

    /// Returns y (m) of a side's surface at a radius, m; `None` beyond its end.
    fn height(&self, side: usize, radius: f64, u: &[[f64; 2]]) -> Option<f64> {
        let last = self.surfaces[side].radii.len() - 1;
        let at = |node: u32| u[node as usize];
        let mut segments = (0..last).map_while(|k| self.segment(side, k, &at));
        segments.find(|segment| radius <= segment.radii[1]).map(|segment| segment.at(radius).height)
    }

    /// Returns the displacement along r (m) of the point of a side that is now at a radius, m.
    fn radial_displacement(&self, side: usize, radius: f64, u: &[[f64; 2]]) -> f64 {
        let surface = &self.surfaces[side];
        if surface.is_rigid() {
            return 0.0;
        }
        let along = |k: usize| u[surface.nodes[k] as usize][0];
        let now = |k: usize| surface.radii[k] + along(k);
        let n = surface.radii.len();
        let outer = (1..n).find(|&k| now(k) >= radius).unwrap_or(n - 1);
        let share = (radius - now(outer - 1)) / (now(outer) - now(outer - 1));
        along(outer - 1) + share.clamp(0.0, 1.0) * (along(outer) - along(outer - 1))
    }
}
