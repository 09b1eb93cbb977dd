//! Frictionless penalty contact between the surfaces where they are now.
//!
//! For strains and slopes that are not small. Each surface is a curve r → y(r): its nodes are at
//! (R + u_r, y₀(R) + u_y), and between two of them the true arc y₀ is carried along, R and u linear
//! in the share s of the segment. The springs act on what the curves overlap along y,
//!
//! ```math
//! \Pi = \int \tfrac12 k \langle -g \rangle^2\, 2\pi r\, dr, \qquad
//! g(r) = y^{upper}(r) - y^{lower}(r), \qquad k = f E^* / h
//! ```
//!
//! over the radius r of the *moved* surfaces, and the forces are −∂Π/∂u, by everything that moves: the
//! shape functions at a given r, the Gauss points, which move with the ends of their piece, and their
//! weights. A surface that moves by δ changes its height at a given radius by δy − y' δr, so
//!
//! ```math
//! f = -k g\; 2\pi r\, dr\; (\mp y', \pm 1) = p\, n\, dA, \qquad p = k \langle -g \rangle :
//! ```
//!
//! p is the true pressure, on the true area and along the true normal of either surface, though the
//! overlap is along y: measured along the normal it is g cos φ and the penalty k / cos φ, for
//! slopes of 1 as if the penalty factor was 1.4 times as large. k is of *moved* area, so that p follows
//! from g alone, and h is a length of the undeformed meshes, so that a spring is not stiffer for
//! being squeezed.
//!
//! The common refinement of both curves is made anew in every configuration, by walking along
//! both. A piece of it is born and dies at length zero, when a node of one surface passes one of the
//! other, so Π is continuous however far the surfaces slide, and the energy of a run is as exact as
//! its time step is fine. Pieces are never merged: a sliver costs as much as another piece and has
//! its share of the force.
//!
//! Forces along y are equal and opposite to rounding. Radial ones are so up to the slope of the
//! overlap, y' of one surface less that of the other: both are exact normals of their own surface.
//!
//! Limits: the part of a surface that can touch has to be a graph over the radius. Where it turns
//! over (r does not grow any more from node to node) the search ends; [`ContactForces`] reports
//! whether something touches there. The arc between two nodes is carried along y, not along the
//! normal: on a coarse mesh where the surface turns by φ, the arc's height over its chord is 1/cos
//! φ of the true one, of second order in h.
//!
//! Springs alone ring; dashpots beside them take that ([`MovedInterface::with_damping`]).
//!
//! Three Gauss points integrate a closed piece exactly (r g² is of the fifth degree), so that Π has
//! no kink where nodes pass each other in the contact. With two, coincident nodes of like meshes
//! were held together by a radial force of up to 1e-3 of theirs, twenty times as stiff as the
//! springs.
//!
//! [`ContactForces`]: crate::ContactForces

mod bound;
mod common_refinement;
mod damping;
mod forces;
mod pressure_recovery;
mod segment;

use crate::error::ContactError;
use crate::interface::{check_springs, share_by_mass, springs};
use crate::surface::Surface;

/// The moved surfaces of two bodies, and the springs between them.
#[derive(Debug, Clone, PartialEq)]
pub struct MovedInterface {
    surfaces: [Surface; 2],
    /// Number of nodes of each surface that can touch, one more than lie within the candidate
    /// radius.
    n_nodes: [usize; 2],
    /// Gap between the poles, m.
    gap: f64,
    /// Penalty factor times contact modulus, Pa.
    stiffness: f64,
    candidate_radius: f64,
    springs: [f64; 2],
    /// Impedance of the dashpots, Pa s/m; 0 without dashpots.
    impedance: f64,
}

impl MovedInterface {
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
        let springs = springs(&surfaces);
        let candidate_radius = ends[0].min(ends[1]);
        Ok(Self { surfaces, n_nodes, gap, stiffness, candidate_radius, springs, impedance: 0.0 })
    }

    /// Shares springs by mass beside a rigid sphere, as
    /// [`ContactInterface::with_rigid_mass`](crate::ContactInterface::with_rigid_mass) does.
    #[must_use]
    pub fn with_rigid_mass(mut self, ratio: f64) -> Self {
        share_by_mass(&self.surfaces, ratio, &mut self.springs);
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
