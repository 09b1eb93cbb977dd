//! Forces and energy of the springs between moved surfaces.

use std::f64::consts::PI;

use super::MovedInterface;
use super::common_refinement::{GAUSS, Piece, Point};
use crate::evaluate::ContactForces;

impl MovedInterface {
    /// Adds the contact forces (N) of displacements `u` (m) to `f`; both are given for the lower and
    /// the upper body, one pair (r, y) a node.
    ///
    /// They are exactly −∂Π/∂u of the energy in the penalty springs. Nothing is allocated.
    pub fn add_forces(&self, u: [&[[f64; 2]]; 2], mut f: [&mut [[f64; 2]]; 2]) -> ContactForces {
        let mut total = ContactForces::default();
        let mut pieces = self.pieces(u.map(|u| move |node: u32| u[node as usize]));
        for piece in pieces.by_ref() {
            for gauss in GAUSS {
                total.at_limit = add_point(&piece, gauss, &mut f, &mut total);
            }
        }
        if let Some((turn, overlaps)) = pieces.turn() {
            total.turn = (overlaps || total.at_limit).then_some(turn);
            total.at_limit = false;
        }
        total
    }

    /// Whether any point is closed for the given displacements (u_r, u_y) of the candidate nodes, m.
    pub fn is_closed(&self, displacement: [impl Fn(u32) -> [f64; 2]; 2]) -> bool {
        let is_closed =
            |piece: Piece<'_>| GAUSS.into_iter().any(|gauss| piece.closed_point(gauss).is_some());
        self.pieces(displacement).any(is_closed)
    }
}

/// Adds the spring of a Gauss point, if it is closed; whether it is.
fn add_point(
    piece: &Piece<'_>,
    gauss: [f64; 2],
    f: &mut [&mut [[f64; 2]]; 2],
    total: &mut ContactForces,
) -> bool {
    let point = piece.closed_point(gauss);
    if let Some(point) = &point {
        add_spring(piece, gauss, point, f, total);
    }
    point.is_some()
}

/// Adds the spring of a point that is closed.
fn add_spring(
    piece: &Piece<'_>,
    [offset, weight]: [f64; 2],
    point: &Point,
    f: &mut [&mut [[f64; 2]]; 2],
    total: &mut ContactForces,
) {
    let pressure = -piece.stiffness * point.gap;
    let force = piece.add_pressure(point, pressure, f);
    // The point and its area move with the ends of the piece: r_g = (1 ∓ offset)/2 of them,
    // A = 2π r_g (r_1 − r_0)/2.
    let half = weight * 0.5 * (piece.radii[1] - piece.radii[0]);
    let overlap_slope = point.places[1].slope - point.places[0].slope;
    let energy_per_area = -0.5 * pressure * point.gap;
    let by_point = force * overlap_slope - energy_per_area * (2.0 * PI * half);
    let by_length = energy_per_area * (PI * weight * point.radius);
    for (end, sign) in piece.ends.into_iter().zip([-1.0, 1.0]) {
        if let Some((side, node)) = end {
            f[side][node as usize][0] +=
                by_point * (0.5 * (1.0 + sign * offset)) - sign * by_length;
        }
    }
    total.force += force;
    total.energy += energy_per_area * point.area;
    total.n_closed += 1;
    total.note_overlap(point.gap, point.radius);
}

impl Piece<'_> {
    /// Adds a pressure (Pa) at a point to the forces (N) of both bodies, along the normal of each; its
    /// force along y, N. At a given radius a surface rises by N (δy − y' δr).
    pub fn add_pressure(&self, point: &Point, pressure: f64, f: &mut [&mut [[f64; 2]]; 2]) -> f64 {
        let force = pressure * point.area;
        for (side, sign) in [-1.0, 1.0].into_iter().enumerate() {
            let (segment, place) = (&self.segments[side], &point.places[side]);
            let along_y = sign * force;
            let along_r = if segment.is_rigid() { 0.0 } else { -along_y * place.slope };
            let [inner, outer] = segment.nodes().map(|node| node as usize);
            f[side][outer][0] += place.share * along_r;
            f[side][outer][1] += place.share * along_y;
            f[side][inner][0] += (1.0 - place.share) * along_r;
            f[side][inner][1] += (1.0 - place.share) * along_y;
        }
        force
    }

    /// Velocity (r, y) of a side at a point, m/s, for those of its nodes.
    pub fn velocity(&self, point: &Point, side: usize, v: &[[f64; 2]]) -> [f64; 2] {
        let (segment, place) = (&self.segments[side], &point.places[side]);
        let [inner, outer] = segment.nodes().map(|node| v[node as usize]);
        [0, 1].map(|axis: usize| (1.0 - place.share) * inner[axis] + place.share * outer[axis])
    }

    /// How fast the material of a side moves away from the tangent at a point along +y, m/s: N (ẏ − y' ṙ),
    /// for velocities (m/s) of its nodes.
    pub fn rate_of_height(&self, point: &Point, side: usize, v: &[[f64; 2]]) -> f64 {
        let [along_r, along_y] = self.velocity(point, side, v);
        match self.segments[side].is_rigid() {
            true => along_y,
            false => along_y - point.places[side].slope * along_r,
        }
    }
}
