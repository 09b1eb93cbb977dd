//! Contact between surfaces that slip on each other.
//!
//! In bodies of unlike materials, points that faced each other initially move along r by different amounts. The
//! gap is then measured halfway between both; to first order in the displacements
//!
//! ```math
//! g = g_0 + u_y^{up} - u_y^{low} + m\,(u_r^{low} - u_r^{up}), \qquad
//! m = \tfrac12\Bigl(\frac{\mathrm d y^{low}}{\mathrm d r} + \frac{\mathrm d y^{up}}{\mathrm d r}\Bigr),
//! ```
//!
//! with the slopes of the deformed surfaces, so that m is the slope of the interface where they touch. A spring's
//! force F acts on each displacement u as F ∂g/∂u: ±F m along r, and ∓F (u_r^low − u_r^up)/2l along y at
//! the two ends of a segment of length l, whose rotation changes m. So the forces derive from the energy of the
//! springs, and those along y conserve momentum. A rigid body has u_r = 0 and a constant slope.
//!
//! Between like bodies u_r is equal, and against a rigid plane m = 0: there the gap is exact to second order
//! without slip. Areas are those of the undeformed surfaces. Limits: first order in the slope, and slopes of the
//! arcs up to 1.

use crate::interface::{ContactInterface, ContactPoint};
use crate::surface::SurfaceProjection;
use crate::undeformed_forces::ContactForces;

/// Displacement (u_r, u_y) of a node, m.
pub type Displacement = [f64; 2];

/// The slope of the interface at a point.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Slope {
    /// Mean slope of both undeformed arcs.
    at_first: f64,
    /// Its change per difference of u_y between the ends of a side's segment, 1/2l, 1/m; 0 for a rigid body.
    per_difference: [f64; 2],
}

/// Gap and slip at a point.
struct Slip {
    gap: f64,
    /// Slope m of the interface.
    slope: f64,
    /// u_r of the lower less that of the upper body, m.
    relative: f64,
}

/// The gap at a point and its derivative.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SlippingGap {
    /// Gap g, m.
    pub gap: f64,
    /// Derivative ∂g/∂u by side, end of the segment, and axis.
    pub opening: [[Displacement; 2]; 2],
}

/// An interface whose surfaces slip on each other.
#[derive(Debug, Clone, PartialEq)]
pub struct SlippingInterface {
    interface: ContactInterface,
    /// Slopes of the interface at each point.
    slopes: Vec<Slope>,
}

impl SurfaceProjection {
    fn at(&self, u: [Displacement; 2]) -> Displacement {
        [0, 1].map(|i: usize| self.shape[0] * u[0][i] + self.shape[1] * u[1][i])
    }
}

impl SlippingInterface {
    /// Creates the interface with the same points.
    pub fn new(interface: ContactInterface) -> Self {
        let slope = |point: &ContactPoint| {
            let [lower, upper] = interface.surfaces.each_ref().map(|s| s.slope(point.radius));
            let per_difference = interface.surfaces.each_ref().map(|surface| {
                let (segment, _) = surface.locate(point.radius);
                // The segment of a rigid plane is infinite.
                let length = surface.segment_length(segment);
                if surface.is_rigid() { 0.0 } else { 0.5 / length }
            });
            Slope { at_first: 0.5 * (upper - lower), per_difference }
        };
        let slopes = interface.points.iter().map(slope).collect();
        Self { interface, slopes }
    }

    /// Returns the interface without slip.
    pub fn interface(&self) -> &ContactInterface {
        &self.interface
    }

    /// Returns the gap and its derivative at point k, for displacements of the ends of both segments.
    pub fn gap_of_ends(&self, k: usize, ends: [[Displacement; 2]; 2]) -> SlippingGap {
        let Slip { gap, slope: m, relative } = self.of_ends(k, ends);
        let (point, slope) = (&self.interface.points[k], &self.slopes[k]);
        let opening = [0, 1].map(|side: usize| {
            let (shape, turning) =
                (point.projections[side].shape, slope.per_difference[side] * relative);
            let sign = [-1.0, 1.0][side];
            [0, 1].map(|end: usize| {
                let own = sign * shape[end];
                [-own * m, own + [-1.0, 1.0][end] * turning]
            })
        });
        SlippingGap { gap, opening }
    }

    /// Returns gap and slip at point k, for displacements of the nodes of the lower and the upper body.
    fn at(&self, k: usize, u: [impl Fn(u32) -> Displacement; 2]) -> Slip {
        let projections = &self.interface.points[k].projections;
        self.of_ends(k, [0, 1].map(|side: usize| projections[side].nodes.map(&u[side])))
    }

    fn of_ends(&self, k: usize, ends: [[Displacement; 2]; 2]) -> Slip {
        let (point, slope) = (&self.interface.points[k], &self.slopes[k]);
        let [lower, upper] = [0, 1].map(|side: usize| point.projections[side].at(ends[side]));
        let turned = [0, 1]
            .map(|side: usize| slope.per_difference[side] * (ends[side][1][1] - ends[side][0][1]));
        let (slope, relative) = (slope.at_first + (turned[0] + turned[1]), lower[0] - upper[0]);
        let gap = point.initial_gap + (upper[1] - lower[1]) + slope * relative;
        Slip { gap, slope, relative }
    }

    /// Adds the contact forces like [`ContactInterface::add_forces`].
    pub fn add_forces(&self, u: [&[Displacement]; 2], f: [&mut [[f64; 2]]; 2]) -> ContactForces {
        let mut total = ContactForces::default();
        for (k, (point, slope)) in self.interface.points.iter().zip(&self.slopes).enumerate() {
            let Slip { gap, slope: m, relative } = self.at(k, of_nodes(u));
            if gap < 0.0 {
                let force = -point.stiffness * point.area * gap;
                for (side, sign) in [-1.0, 1.0].into_iter().enumerate() {
                    let SurfaceProjection { nodes, shape } = point.projections[side];
                    let turning = force * relative * slope.per_difference[side];
                    for (end, outward) in [-1.0, 1.0].into_iter().enumerate() {
                        let own = sign * shape[end] * force;
                        let node = &mut f[side][nodes[end] as usize];
                        node[0] -= own * m;
                        node[1] += own + outward * turning;
                    }
                }
                total.force += force;
                total.energy -= 0.5 * force * gap;
                total.n_closed += 1;
                total.note_overlap(gap, point.radius);
                total.at_limit = k + 1 == self.interface.points.len();
            }
        }
        total
    }

    /// Returns the gap at each point, m.
    pub(crate) fn gaps<'a>(
        &'a self,
        u: [&'a [Displacement]; 2],
    ) -> impl Iterator<Item = f64> + Clone + 'a {
        (0..self.slopes.len()).map(move |k| self.at(k, of_nodes(u)).gap)
    }

    /// Returns whether any point is closed for the given displacements of the candidate nodes.
    pub fn is_closed(&self, displacement: [impl Fn(u32) -> Displacement; 2]) -> bool {
        let [lower, upper] = displacement;
        (0..self.slopes.len()).any(|k| self.at(k, [&lower as &dyn Fn(u32) -> _, &upper]).gap < 0.0)
    }

    /// Returns the total force like [`ContactInterface::force`].
    pub fn force(&self, displacement: [impl Fn(u32) -> Displacement; 2]) -> f64 {
        let [lower, upper] = displacement;
        let force = |(k, point): (usize, &ContactPoint)| {
            let gap = self.at(k, [&lower as &dyn Fn(u32) -> _, &upper]).gap;
            point.stiffness * point.area * (-gap).max(0.0)
        };
        self.interface.points.iter().enumerate().map(force).sum()
    }

    /// Adds a bound of the stiffness: that of [`ContactInterface::add_stiffness_bound`] times 1 + m², with the slope
    /// of the steeper arc, for the radial part of a spring. The rotation of the slope adds a few per cent where
    /// surfaces slip by a few per cent of a segment; the safety factor for opening and closing covers it.
    pub fn add_stiffness_bound(&self, side: usize, bound: &mut [f64]) {
        let steepest = |point: &ContactPoint| {
            let slopes = self.interface.surfaces.each_ref().map(|s| s.slope(point.radius));
            slopes[0].max(slopes[1])
        };
        self.interface.add_weighted_bound(
            side,
            self.interface.bound_factors[side],
            bound,
            |point| 1.0 + steepest(point).powi(2),
        );
    }

    /// Returns the contact radius like [`ContactInterface::contact_radius`].
    pub fn contact_radius(&self, u: [&[Displacement]; 2]) -> f64 {
        self.interface.radius_of(self.signed_pressure(u))
    }

    /// Returns nodal pressures like [`ContactInterface::nodal_pressure`].
    pub fn nodal_pressure<'a>(
        &'a self,
        u: [&'a [Displacement]; 2],
    ) -> impl Iterator<Item = (f64, f64)> + Clone + 'a {
        self.interface.at_nodes(self.interface.coarser(), self.signed_pressure(u))
    }

    /// Returns the pressure on the axis like [`ContactInterface::centre_pressure`].
    pub fn centre_pressure(&self, u: [&[Displacement]; 2]) -> f64 {
        self.radius_and_pressure(u).1
    }

    /// Returns radius and pressure like [`ContactInterface::radius_and_pressure`].
    pub fn radius_and_pressure(&self, u: [&[Displacement]; 2]) -> (f64, f64) {
        self.interface.radius_and_pressure_of(self.signed_pressure(u))
    }

    fn signed_pressure<'a>(
        &'a self,
        u: [&'a [Displacement]; 2],
    ) -> impl Iterator<Item = (f64, f64)> + Clone + 'a {
        self.interface
            .points
            .iter()
            .enumerate()
            .map(move |(k, point)| (point.radius, -point.stiffness * self.at(k, of_nodes(u)).gap))
    }
}

fn of_nodes<'a>(u: [&'a [Displacement]; 2]) -> [impl Fn(u32) -> Displacement + 'a; 2] {
    u.map(|u| move |node: u32| u[node as usize])
}

#[cfg(test)]
mod tests {
    use fem_mesh::{Side, SphereMesh};

    use super::*;
    use crate::surface::Surface;
    use crate::test_support::sphere;

    const RADII: [f64; 2] = [2.0, 1.0];
    const SIZE: f64 = 5e-3;

    fn meshes() -> [SphereMesh; 2] {
        [Side::Below, Side::Above]
            .map(|side| sphere(RADII[usize::from(side == Side::Above)], SIZE, 0.4, side))
    }

    /// Returns the largest gap within r = 0.3, with slip and without, of two surfaces that lie on one curved
    /// interface, y = κx²/2 at x = r + u_r, and that have moved along it by ε r/2 and −ε r. A rigid surface has not
    /// moved and is the interface.
    fn gaps_of_a_closed_interface(epsilon: f64, rigid: Option<usize>) -> [f64; 2] {
        let meshes = meshes();
        let surfaces = [0, 1].map(|side: usize| match rigid == Some(side) {
            true => Surface::rigid_sphere(RADII[side]).unwrap(),
            false => Surface::of_sphere(&meshes[side]),
        });
        let depth = |side: usize, r: f64| RADII[side] - (RADII[side].powi(2) - r * r).sqrt();
        // Where neither is rigid a parabola between both; else the rigid arc.
        let interface_at = |x: f64| match rigid {
            None => 0.1 * x * x,
            Some(side) => [-1.0, 1.0][side] * depth(side, x),
        };
        let u: [Vec<Displacement>; 2] = [0, 1].map(|side: usize| {
            if rigid == Some(side) {
                return vec![[0.0; 2]];
            }
            let mesh = &meshes[side];
            let mut u = vec![[0.0; 2]; mesh.nodes().len()];
            for &node in mesh.surface() {
                let r = mesh.nodes()[node as usize][0];
                let along = [0.5, -1.0][side] * epsilon * r;
                let own = [-1.0, 1.0][side] * depth(side, r);
                u[node as usize] = [along, interface_at(r + along) - own];
            }
            u
        });
        let [lower, upper] = surfaces;
        let interface = ContactInterface::new(lower, upper, 1.0, 0.0, 0.4).unwrap();
        let slipping = SlippingInterface::new(interface);
        let within = slipping.interface.points.iter().take_while(|point| point.radius < 0.3);
        let slips: Vec<Slip> =
            (0..within.count()).map(|k| slipping.at(k, of_nodes([&u[0], &u[1]]))).collect();
        let largest = |gap: &dyn Fn(&Slip) -> f64| {
            slips.iter().map(|slip| gap(slip).abs()).fold(0.0, f64::max)
        };
        [largest(&|slip| slip.gap), largest(&|slip| slip.gap - slip.slope * slip.relative)]
    }

    /// Surfaces that touch have a gap of second order in their slip; without slip the error is the slope times it.
    #[test]
    fn touching_surfaces_have_a_gap_of_second_order_in_slip() {
        // Linear displacement between nodes misses κh²/8 of the parabola, at ε = 0.
        let flat = gaps_of_a_closed_interface(0.0, None)[0];
        assert!(flat < 1.2 * (0.5 + 1.0) * SIZE.powi(2) / 8.0, "{flat:e}");
        for rigid in [None, Some(0), Some(1)] {
            let mesh = gaps_of_a_closed_interface(0.0, rigid)[0];
            let [first, plain] = gaps_of_a_closed_interface(0.04, rigid);
            let second = gaps_of_a_closed_interface(0.08, rigid)[0];
            // m Δu_r at r = 0.3, where the slope is 0.2 r, and −0.15 and 0.31 of the rigid arcs.
            let slip = match rigid {
                None => 0.2 * 0.3 * 0.06 * 0.3,
                Some(0) => 0.15 * 0.3 * 0.04,
                _ => 0.31 * 0.3 * 0.02,
            };
            assert!((plain / slip - 1.0).abs() < 0.15, "{rigid:?}: {plain:e} {slip:e}");
            assert!(first < mesh + 0.06 * plain, "{rigid:?}: {first:e} {plain:e}");
            assert!(second < mesh + 0.25 * plain, "{rigid:?}: {second:e} {plain:e}");
        }
    }

    /// The opening of a gap is its derivative. A gap is quadratic in the displacements, so that the central
    /// difference is exact to rounding.
    #[test]
    fn the_opening_of_a_gap_is_its_derivative() {
        for rigid in [None, Some(0)] {
            let meshes = meshes();
            let [lower, upper] = [0, 1].map(|side: usize| match rigid == Some(side) {
                true => Surface::rigid_sphere(RADII[side]).unwrap(),
                false => Surface::of_sphere(&meshes[side]),
            });
            let interface = ContactInterface::new(lower, upper, 1.0, 0.0, 0.4).unwrap();
            let slipping = SlippingInterface::new(interface);
            let ends = [[[0.02, -0.01], [0.03, 0.02]], [[-0.01, 0.015], [0.004, -0.02]]];
            for k in [0, 3, 40] {
                let found = slipping.gap_of_ends(k, ends).opening;
                for (entry, side) in (0..8).map(|entry| (entry, entry / 4)) {
                    let moved = |step: f64| {
                        let mut ends = ends;
                        ends[side][entry / 2 % 2][entry % 2] += step;
                        slipping.gap_of_ends(k, ends).gap
                    };
                    let step = 0.01;
                    let exact = (moved(step) - moved(-step)) / (2.0 * step);
                    let found = found[side][entry / 2 % 2][entry % 2];
                    // Rounding of gaps of size 0.1 over the step; turning is 100 times a difference.
                    assert!((found - exact).abs() < 1e-13, "{k} {entry}: {found} {exact}");
                }
            }
        }
    }
}
