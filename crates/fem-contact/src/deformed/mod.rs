//! Frictionless penalty contact between the deformed surfaces, for strains and slopes that are not small.
//!
//! Each surface is a curve r → y(r). Its nodes are at (R + u_r, y₀(R) + u_y); between two nodes the true arc y₀ is
//! carried along, with R and u linear in the share s of the segment. The springs act on the overlap of the
//! curves along y,
//!
//! ```math
//! \Pi = \int \tfrac12 k \langle -g \rangle^2\, 2\pi r\, dr, \qquad
//! g(r) = y^{upper}(r) - y^{lower}(r), \qquad k = f E^* / h
//! ```
//!
//! over the radius r of the *deformed* surfaces. The forces are −∂Π/∂u with all that depends on u: the shape
//! functions at a given r, and the Gauss points and their weights, which move with the ends of their interval. A
//! surface that moves by δ changes its height at a given radius by δy − y' δr, so
//!
//! ```math
//! f = -k g\; 2\pi r\, dr\; (\mp y', \pm 1) = p\, n\, dA, \qquad p = k \langle -g \rangle :
//! ```
//!
//! p is the true pressure, on the true area and along the true normal of either surface, though the overlap is
//! measured along y. Along the normal the overlap is g cos φ and the penalty k / cos φ; at a slope of 1 the
//! penalty factor is in effect 1.4 times as large. k is per *deformed* area, so that p follows from g alone, and h is
//! a length of the undeformed meshes, so that compression does not stiffen a spring.
//!
//! The common refinement of both curves is rebuilt in every configuration. An interval of it appears and vanishes
//! with length zero, when a node of one surface passes one of the other. So Π is continuous for any sliding, and
//! the energy balance of a run is limited by its time step alone. Short intervals are not merged.
//!
//! Forces along y are equal and opposite to rounding. Radial forces balance up to the difference of both slopes:
//! each is normal to its own surface.
//!
//! Limits: the part of a surface that can touch has to be a function of the radius. Where it folds (r does not
//! grow from node to node) the search ends, and [`ContactForces`] reports whether the surfaces touch there. The
//! arc between two nodes is carried along y, not along the normal: where the surface turns by φ, the arc's height
//! over its chord is 1/cos φ of the true one, of second order in h.
//!
//! Dashpots ([`DeformedInterface::with_damping`]) damp the oscillation of nodes on the springs.
//!
//! Three Gauss points integrate a closed interval exactly (r g² is of the fifth degree), so that Π has no kink
//! where nodes pass each other in the contact. With two points, coincident nodes of like meshes were held
//! together by a radial force, twenty times as stiff as the springs.
//!
//! [`ContactForces`]: crate::ContactForces

mod bound;
mod common_refinement;
mod damping;
mod forces;
mod pressure_recovery;
mod segment;

use crate::error::ContactError;
use crate::interface::{bound_factors, check_springs, share_by_mass};
use crate::surface::Surface;

/// The deformed surfaces of two bodies, and the springs between them.
#[derive(Debug, Clone, PartialEq)]
pub struct DeformedInterface {
    surfaces: [Surface; 2],
    /// Number of nodes of each surface that can touch, one more than lie within the candidate
    /// radius.
    n_nodes: [usize; 2],
    /// Gap between the poles, m.
    gap: f64,
    /// Penalty factor times contact modulus, Pa.
    stiffness: f64,
    candidate_radius: f64,
    bound_factors: [f64; 2],
    /// Impedance of the dashpots, Pa s/m; 0 without dashpots.
    impedance: f64,
}

impl DeformedInterface {
    /// Creates an interface like [`ContactInterface::new`](crate::ContactInterface::new); all
    /// lengths are those of the undeformed bodies.
    ///
    /// # Errors
    /// Two rigid bodies or planes; a radius or a stiffness that is not positive and finite.
    pub fn new(
        lower: Surface,
        upper: Surface,
        stiffness: f64,
        gap: f64,
        candidate_radius: f64,
    ) -> Result<Self, ContactError> {
        check_springs([&lower, &upper], stiffness, candidate_radius)?;
        let surfaces = [lower, upper];
        let n_nodes = surfaces.each_ref().map(|surface| {
            let inside = surface.radii.partition_point(|&r| r < candidate_radius * (1.0 - 1e-9));
            (inside + 1).clamp(2, surface.radii.len())
        });
        let ends = [0, 1].map(|side: usize| surfaces[side].radii[n_nodes[side] - 1]);
        let bound_factors = bound_factors(&surfaces);
        let candidate_radius = ends[0].min(ends[1]);
        Ok(Self {
            surfaces,
            n_nodes,
            gap,
            stiffness,
            candidate_radius,
            bound_factors,
            impedance: 0.0,
        })
    }

    /// Shares springs by mass against a rigid sphere, as
    /// [`ContactInterface::with_rigid_mass`](crate::ContactInterface::with_rigid_mass) does.
    #[must_use]
    pub fn with_rigid_mass(mut self, ratio: f64) -> Self {
        share_by_mass(&self.surfaces, ratio, &mut self.bound_factors);
        self
    }

    /// Returns the undeformed radius of the candidate region, m.
    pub fn candidate_radius(&self) -> f64 {
        self.candidate_radius
    }

    /// Returns the number of integration points of the undeformed surfaces.
    pub fn n_points(&self) -> usize {
        self.points([|_| [0.0; 2]; 2]).count()
    }

    /// Returns the candidate nodes of a side (0 lower, 1 upper).
    pub fn candidate_nodes(&self, side: usize) -> impl Iterator<Item = u32> + '_ {
        let n = if self.surfaces[side].is_rigid() { 1 } else { self.n_nodes[side] };
        self.surfaces[side].nodes[..n].iter().copied()
    }
}
