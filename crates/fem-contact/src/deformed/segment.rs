//! A segment of a deformed surface.

use crate::surface::Surface;

/// Generous bound of the rounding error of a parabola.
const ROUNDED: f64 = 1.0 - 1e-9;

/// A segment in its current position, a curve r → y(r). A rigid body has one, the whole surface.
#[derive(Debug, Clone, Copy)]
pub(super) struct Segment<'a> {
    surface: &'a Surface,
    /// Number of its inner node along the surface.
    pub index: usize,
    /// 1 if depth is along +y (upper body), −1 if along −y (lower body).
    sign: f64,
    /// Current distances of its ends from the axis, m.
    pub radii: [f64; 2],
    /// 1 / (outer less inner radius), 1/m; 0 for a rigid body.
    per_length: f64,
    /// Displacement along y of its inner end, plus the gap for the upper body, and its change to the
    /// outer end, m.
    rise: f64,
    rise_change: f64,
    /// Undeformed radius of its inner end and its change to the outer end, m.
    reference: f64,
    reference_change: f64,
}

/// A point of a segment in its current position.
#[derive(Debug, Clone, Copy)]
pub(super) struct SurfacePoint {
    /// Shape function of the outer node; the inner node has 1 minus this.
    pub share: f64,
    /// Height y, m.
    pub height: f64,
    /// Slope of the surface, dy/dr.
    pub slope: f64,
}

impl<'a> Segment<'a> {
    /// Creates the segment between two nodes with displacements (u_r, u_y), m. `sign` is the direction of its
    /// depth along y, `gap` (m) a translation along y. `None` if r does not grow.
    pub fn new(
        surface: &'a Surface,
        index: usize,
        [inner, outer]: [[f64; 2]; 2],
        sign: f64,
        gap: f64,
    ) -> Option<Self> {
        let [start, end] = [surface.radii[index], surface.radii[index + 1]];
        let is_rigid = surface.is_rigid();
        let radii = if is_rigid { [start, end] } else { [start + inner[0], end + outer[0]] };
        (radii[1] > radii[0]).then(|| Self {
            surface,
            index,
            sign,
            radii,
            per_length: if is_rigid { 0.0 } else { (radii[1] - radii[0]).recip() },
            rise: inner[1] + gap,
            rise_change: outer[1] - inner[1],
            reference: start,
            reference_change: end - start,
        })
    }

    /// Returns its inner and outer node.
    pub fn nodes(&self) -> [u32; 2] {
        [self.surface.nodes[self.index], self.surface.nodes[self.index + 1]]
    }

    /// Returns the shape function of its outer node at a radius, m; 0 for a rigid body.
    pub fn share(&self, r: f64) -> f64 {
        (r - self.radii[0]) * self.per_length
    }

    /// Returns a lower bound of its distance from y = 0 at a radius (m), m, positive on its body's side. An arc is
    /// deeper than its parabola, κr²/(1 + cos) > κr²/2, which needs neither a root nor a division.
    pub fn least_depth(&self, r: f64) -> f64 {
        let share = self.share(r);
        let reference = match self.surface.is_rigid() {
            true => r,
            false => self.reference + share * self.reference_change,
        };
        let rise = self.rise + share * self.rise_change;
        self.sign * rise + ROUNDED * 0.5 * self.surface.curvature * reference * reference
    }

    /// Returns its point at a radius, m.
    pub fn at(&self, r: f64) -> SurfacePoint {
        let share = self.share(r);
        if self.surface.is_rigid() {
            let (depth, slope) = self.surface.arc(r);
            let height = self.rise + self.sign * depth;
            return SurfacePoint { share: 0.0, height, slope: self.sign * slope };
        }
        let (depth, slope) = self.surface.arc(self.reference + share * self.reference_change);
        let height = self.rise + share * self.rise_change + self.sign * depth;
        let change = self.rise_change + self.sign * slope * self.reference_change;
        SurfacePoint { share, height, slope: change * self.per_length }
    }

    /// Returns whether its body is rigid and so moves along y alone.
    pub fn is_rigid(&self) -> bool {
        self.surface.is_rigid()
    }
}
