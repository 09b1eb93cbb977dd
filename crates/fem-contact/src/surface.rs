//! One side of the contact: the candidate part of a boundary.

use fem_mesh::SphereMesh;

use crate::error::ContactError;

/// Upper limit on the slope of an arc, reached at 0.7 radii: no contact at small strain is so large.
pub(crate) const STEEPEST: f64 = 1.0;

/// The projection of a contact point on one body's surface.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SurfaceProjection {
    /// Nodes at the inner and the outer end of the segment.
    pub nodes: [u32; 2],
    /// Their shape functions at the point; they sum to 1.
    pub shape: [f64; 2],
}

/// The touching side of a body.
#[derive(Debug, Clone, PartialEq)]
pub struct Surface {
    /// Nodes from the axis outward; a rigid body has its one node twice.
    pub(crate) nodes: Vec<u32>,
    /// Their distances from the axis, m; a rigid body's second is where it ends, of a plane infinite.
    pub(crate) radii: Vec<f64>,
    /// 1 / radius of the arc, 1/m; 0 for a plane.
    pub(crate) curvature: f64,
}

impl Surface {
    /// Creates the near hemisphere of a sphere, or the plane of a half-space.
    pub fn of_sphere(mesh: &SphereMesh) -> Self {
        let (mut nodes, mut radii) = (Vec::new(), Vec::new());
        for &node in mesh.surface() {
            let r = mesh.nodes()[node as usize][0];
            if radii.last().is_some_and(|&last| r <= last) {
                break;
            }
            nodes.push(node);
            radii.push(r);
        }
        Self { nodes, radii, curvature: mesh.radius().recip() }
    }

    /// Creates the rigid plane y = 0: a body of one node, number 0.
    pub fn wall() -> Self {
        Self { nodes: vec![0, 0], radii: vec![0.0, f64::INFINITY], curvature: 0.0 }
    }

    /// Creates the near hemisphere of a rigid sphere: a body of one node, number 0, that moves as a whole.
    ///
    /// # Errors
    /// A radius (m) that is not positive and finite.
    pub fn rigid_sphere(radius: f64) -> Result<Self, ContactError> {
        // The curvature has to be finite too.
        if !(radius > 0.0 && radius.is_normal()) {
            return Err(ContactError::NotPositive {
                name: "radius of a rigid sphere",
                value: radius,
            });
        }
        Ok(Self { nodes: vec![0, 0], radii: vec![0.0, radius], curvature: radius.recip() })
    }

    /// Returns whether the body is rigid: a wall or a rigid sphere.
    pub fn is_rigid(&self) -> bool {
        self.nodes.get(1) == self.nodes.first()
    }

    /// Returns whether this is the rigid plane, which is fixed.
    pub fn is_wall(&self) -> bool {
        self.is_rigid() && self.curvature == 0.0
    }

    /// Returns whether this is a plane, of a wall or a half-space.
    pub fn is_plane(&self) -> bool {
        self.curvature == 0.0
    }

    /// Returns the nodes with r ≤ `radius` (m), from the axis outward; a rigid body has one.
    pub fn nodes_within(&self, radius: f64) -> &[u32] {
        let n = if self.is_rigid() {
            1
        } else {
            self.radii.partition_point(|&r| r <= radius * (1.0 + 1e-12))
        };
        &self.nodes[..n]
    }

    /// Projects a point on its segment, which [`Surface::locate`] has found.
    pub(crate) fn project(&self, (segment, share): (usize, f64)) -> SurfaceProjection {
        SurfaceProjection {
            nodes: [self.nodes[segment], self.nodes[segment + 1]],
            shape: [1.0 - share, share],
        }
    }

    /// Returns sine and cosine of the arc's angle at r (m) from the axis.
    fn angle(&self, r: f64) -> (f64, f64) {
        let sine = self.curvature * r;
        (sine, (1.0 - sine * sine).max(0.0).sqrt())
    }

    /// Returns the distance of the true arc from the plane through its pole, m.
    pub(crate) fn depth(&self, r: f64) -> f64 {
        self.arc(r).0
    }

    /// Returns the depth of the true arc (m) and its slope, the tangent of the arc's angle.
    pub(crate) fn arc(&self, r: f64) -> (f64, f64) {
        let (sine, cosine) = self.angle(r);
        (sine * r / (1.0 + cosine), sine / cosine)
    }

    /// Returns the slope of the true arc, dy/dr upward from the pole of an upper body, at most [`STEEPEST`].
    pub(crate) fn slope(&self, r: f64) -> f64 {
        let (sine, cosine) = self.angle(r);
        // At the equator without division by zero.
        if sine < STEEPEST * cosine { sine / cosine } else { STEEPEST }
    }

    /// Returns the largest radius that the surface covers, m.
    pub(crate) fn extent(&self) -> f64 {
        self.radii[self.radii.len() - 1]
    }

    /// Finds the segment that contains r: (index of its inner node, share of its outer node).
    pub(crate) fn locate(&self, r: f64) -> (usize, f64) {
        if self.is_rigid() {
            return (0, 0.0);
        }
        let outer = self.radii.partition_point(|&x| x < r).clamp(1, self.radii.len() - 1);
        let (start, end) = (self.radii[outer - 1], self.radii[outer]);
        (outer - 1, (r - start) / (end - start))
    }

    /// Returns the length of a segment along r, m.
    pub(crate) fn segment_length(&self, segment: usize) -> f64 {
        self.radii[segment + 1] - self.radii[segment]
    }
}
