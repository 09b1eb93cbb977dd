//! Elements drawn together where the edge of a contact is expected.
//!
//! The pressure on a body that flows plastically is almost uniform up to the edge of the contact, and linear elements bring
//! their nodes into contact one by one. So the force is a staircase, whose steps are in proportion to the width of
//! the elements at the edge. Elements inside of it have little to resolve, and those at the edge are narrower here at
//! their expense. Of an even spacing of nodes, those at v, 0 ≤ v ≤ 1, are moved to u,
//!
//! ```math
//! v\, N(1) = N(u), \qquad N'(u) = 1 + A \operatorname{sech}^2\frac{u - c}{w},
//! ```
//!
//! along the surface with the edge at c, and along the axis with c = 0, since the first yield is close below the surface while
//! the contact is small.

use crate::sphere_mesh::SphereMesh;

/// Nodes per length at c over those far from it, less 1: A.
const MORE: f64 = 2.0;
/// w along the surface: the radius of the contact is known to a tenth before the run.
const WIDTH_AT_EDGE: f64 = 0.15;
/// w along the axis.
const WIDTH_BELOW_SURFACE: f64 = 0.25;

impl SphereMesh {
    /// Moves nodes of a body above the plane y = 0, so that its elements within `reach` (m) of the contact pole are
    /// narrower around a radius `edge` (m), if there is one. Nodes on the surface stay on it. Nothing changes unless
    /// 0 < edge < reach and the reach is at most half of the sphere's radius.
    pub(crate) fn narrowed_at(mut self, edge: Option<f64>, reach: f64) -> Self {
        let radius = self.radius();
        let fits = |edge: &f64| *edge > 0.0 && *edge < reach && reach <= 0.5 * radius;
        let Some(edge) = edge.filter(fits) else { return self };
        // The surface's; a plane has an infinite radius.
        let depth_of = |r: f64| match radius.is_finite() {
            true => r * r / (radius + (radius * radius - r * r).sqrt()),
            false => 0.0,
        };
        let columns = Spacing { centre: edge / reach, width: WIDTH_AT_EDGE };
        let rows = Spacing { centre: 0.0, width: WIDTH_BELOW_SURFACE };
        self.move_nodes(|[r, y]| {
            if r >= 2.0 * reach {
                return [r, y];
            }
            let depth = y - depth_of(r);
            let [v, below] = [r / reach, depth / reach];
            let r = r + reach * fade(below) * columns.shift(v);
            [r, depth_of(r) + depth + reach * fade(v) * rows.shift(below)]
        });
        self
    }
}

/// Returns the share of a shift at a distance over the reach across it: 1 within the reach, 0 from twice the reach on.
fn fade(distance: f64) -> f64 {
    let beyond = (distance - 1.0).clamp(0.0, 1.0);
    (1.0 - beyond * beyond).powi(2)
}

/// An uneven spacing of nodes between 0 and 1.
struct Spacing {
    /// The place c of the narrowest elements.
    centre: f64,
    /// The width w.
    width: f64,
}

impl Spacing {
    /// Returns N(u), and its derivative.
    fn count(&self, u: f64) -> [f64; 2] {
        let at = |u: f64| ((u - self.centre) / self.width).tanh();
        let slope = 1.0 - at(u).powi(2);
        [u + MORE * self.width * (at(u) - at(0.0)), 1.0 + MORE * slope]
    }

    /// Returns u − v of the node that an even spacing has at v; 0 outside of 0 < v < 1.
    fn shift(&self, v: f64) -> f64 {
        if !(v > 0.0 && v < 1.0) {
            return 0.0;
        }
        let wanted = v * self.count(1.0)[0];
        // N grows: bisection, with Newton's step where it stays inside.
        let (mut low, mut high, mut u) = (0.0, 1.0, v);
        for _ in 0..100 {
            let [count, slope] = self.count(u);
            if count < wanted {
                low = u
            } else {
                high = u
            }
            let newton = u - (count - wanted) / slope;
            let next = if newton > low && newton < high { newton } else { 0.5 * (low + high) };
            if (next - u).abs() <= 4.0 * f64::EPSILON {
                return next - v;
            }
            u = next;
        }
        u - v
    }
}
