//! The dents that plastic flow leaves: their profile, depth and radius, and the size of the plastic zone.
//!
//! All lengths are those of the unloaded bodies ([`Collision::unloaded`]). The profile is measured from the mass centre of
//! a sphere, from the middle of a plate's far face, or from the far boundary of a half-space, so that the depth is how much the pole has
//! come closer to it.

use fem_collision::{BodyFields, Collision};
use fem_mesh::SphereMesh;
use serde::Serialize;

use crate::simulation::Simulation;

/// Equivalent plastic strain at the edge of the plastic zone: the offset that defines a yield strength in tension, Rp0.2.
const EDGE_OF_PLASTIC_ZONE: f64 = 0.002;
/// Share of the largest contact radius within which a parabola is fitted for the radius of the crown.
const CROWN_OVER_CONTACT: f64 = 0.5;
/// Inward displacement of the surface over the depth at which the dent ends.
const EDGE_OF_DENT: f64 = 0.1;
/// Range of the profile over the largest contact radius.
const PROFILE_OVER_CONTACT: f64 = 3.0;

/// The dent of a body, SI.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct DentSummary {
    /// Name of the body in the case.
    pub body: String,
    /// How much the pole has come closer to the mass centre, to the far face of a plate or to the far boundary of a half-space.
    pub depth_m: Option<f64>,
    /// Radius at which the surface is displaced inward by a tenth of the depth.
    pub radius_m: Option<f64>,
    /// Radius of curvature of the surface within half of the largest contact radius; negative where it is concave.
    pub crown_radius_m: Option<f64>,
    /// Largest equivalent plastic strain.
    pub max_plastic_strain: Option<f64>,
    /// Distance from the axis of the element that has it, before the collision.
    pub max_plastic_strain_r_m: Option<f64>,
    /// Depth of that element, before the collision.
    pub max_plastic_strain_depth_m: Option<f64>,
    /// Depth of the zone with a plastic strain above 0.2 %, before the collision.
    pub plastic_zone_depth_m: Option<f64>,
    /// Radius of that zone.
    pub plastic_zone_radius_m: Option<f64>,
}

/// The profile of a dent: rows of distance from the axis, and y of the surface before and after the collision, m. The pole
/// was at 0.
pub type DentProfile = Vec<[f64; 3]>;

/// Returns side and dent of each body that flowed, with its profile.
pub fn dents(
    simulation: &Simulation,
    collision: &Collision,
) -> Vec<(usize, DentSummary, DentProfile)> {
    let Some(unloaded) = &collision.unloaded else { return Vec::new() };
    let contact_radius = collision.max_contact_radius.unwrap_or(0.0);
    let meshes = simulation.model().meshes();
    let bodies = unloaded.bodies.iter().zip(meshes).enumerate();
    let flowed = bodies.filter(|(_, (fields, _))| fields.plastic.iter().any(|at| at[0] > 0.0));
    let dent = |(side, (fields, mesh)): (usize, (&BodyFields, Option<&SphereMesh>))| {
        let mesh = mesh?;
        let inward = if side == 0 { -1.0 } else { 1.0 };
        let profile = profile(mesh, &fields.displacement, PROFILE_OVER_CONTACT * contact_radius);
        let depths: Vec<[f64; 2]> =
            profile.iter().map(|[r, before, after]| [*r, inward * (after - before)]).collect();
        let (depth, radius) = extent(&depths);
        let crown = crown(&profile, CROWN_OVER_CONTACT * contact_radius).map(|c| inward / c);
        let (strain, place) = largest_strain(mesh, &fields.plastic);
        let zone = plastic_zone(mesh, &fields.plastic);
        let finite = |value: f64| Some(value).filter(|value| value.is_finite());
        let summary = DentSummary {
            body: simulation.case().scene().bodies()[side].name().to_string(),
            depth_m: depth.and_then(finite),
            radius_m: radius.and_then(finite),
            crown_radius_m: crown.and_then(finite),
            max_plastic_strain: finite(strain),
            max_plastic_strain_r_m: finite(place[0]),
            max_plastic_strain_depth_m: finite(place[1].abs()),
            plastic_zone_depth_m: finite(zone[1]),
            plastic_zone_radius_m: finite(zone[0]),
        };
        Some((side, summary, profile))
    };
    flowed.filter_map(dent).collect()
}

/// Returns the surface nodes from the axis out to a radius, after the collision and relative to the mass centre.
fn profile(mesh: &SphereMesh, displacement: &[[f64; 2]], widest: f64) -> DentProfile {
    let shift = shift_of_body(mesh, displacement);
    let nodes = || mesh.surface().iter().map(|node| *node as usize);
    let surface: Vec<[f64; 2]> = nodes().map(|node| mesh.nodes()[node]).collect();
    let moved = nodes().map(|node| {
        let ([r, y], [u_r, u_y]) = (mesh.nodes()[node], displacement[node]);
        [r + u_r, y + u_y - shift]
    });
    let within = moved.take_while(|[r, _]| *r <= widest);
    within.map(|[r, y]| [r, height(&surface, r), y]).collect()
}

/// Returns y of the undeformed surface at a distance from the axis, by lines between nodes.
fn height(surface: &[[f64; 2]], r: f64) -> f64 {
    let outer = surface.partition_point(|node| node[0] < r).clamp(1, surface.len().max(2) - 1);
    match (surface.get(outer - 1), surface.get(outer)) {
        (Some([r0, y0]), Some([r1, y1])) => y0 + (r - r0) / (r1 - r0) * (y1 - y0),
        _ => f64::NAN,
    }
}

/// Returns the displacement along y, m, of the mass centre of a sphere, and of the middle of a plate's far face, which moves as the
/// plate does; 0 for a half-space, whose far boundary is held.
fn shift_of_body(mesh: &SphereMesh, displacement: &[[f64; 2]]) -> f64 {
    if mesh.is_half_space() {
        let on_axis = mesh.nodes().iter().zip(displacement).filter(|(node, _)| node[0] == 0.0);
        let farthest = on_axis.max_by(|(a, _), (b, _)| a[1].abs().total_cmp(&b[1].abs()));
        return farthest.map_or(0.0, |(_, u)| u[1]);
    }
    let (mut moment, mut volume) = (0.0, 0.0);
    for (element, quad) in mesh.quads().iter().enumerate() {
        let corners = mesh.corners(element);
        let [r, _] = mean(&corners);
        let [ac, bd] = [(0, 2), (1, 3)].map(|(a, b): (usize, usize)| {
            [0, 1].map(|axis: usize| corners[b][axis] - corners[a][axis])
        });
        let own = r * (ac[0] * bd[1] - ac[1] * bd[0]).abs();
        let u = mean(&quad.map(|node| displacement[node as usize]));
        moment += own * u[1];
        volume += own;
    }
    moment / volume
}

fn mean(corners: &[[f64; 2]; 4]) -> [f64; 2] {
    [0, 1].map(|axis: usize| corners.iter().map(|x| x[axis]).sum::<f64>() / 4.0)
}

/// Returns the depth at the axis, and the radius where a share of it is left.
fn extent(depths: &[[f64; 2]]) -> (Option<f64>, Option<f64>) {
    let Some([_, depth]) = depths.first().copied() else { return (None, None) };
    let edge = EDGE_OF_DENT * depth;
    let radius = depths.windows(2).find_map(|pair| {
        let [[r0, d0], [r1, d1]] = [pair[0], pair[1]];
        (d0 > edge && d1 <= edge).then(|| r0 + (d0 - edge) / (d0 - d1) * (r1 - r0))
    });
    (Some(depth), radius)
}

/// Returns the curvature d²y/dr² of a parabola through the surface within a radius, by least squares.
fn crown(profile: &[[f64; 3]], within: f64) -> Option<f64> {
    let near: Vec<[f64; 2]> =
        profile.iter().take_while(|[r, ..]| *r <= within).map(|[r, _, y]| [r * r, *y]).collect();
    let n = near.len() as f64;
    if near.len() < 3 {
        return None;
    }
    let [x, y] = [0, 1].map(|k: usize| near.iter().map(|point| point[k]).sum::<f64>() / n);
    let covariance: f64 = near.iter().map(|[a, b]| (a - x) * (b - y)).sum();
    let variance: f64 = near.iter().map(|[a, _]| (a - x) * (a - x)).sum();
    Some(2.0 * covariance / variance)
}

/// Returns the largest plastic strain and the centre of its element.
fn largest_strain(mesh: &SphereMesh, plastic: &[[f64; 2]]) -> (f64, [f64; 2]) {
    let largest = plastic.iter().enumerate().max_by(|(_, a), (_, b)| a[0].total_cmp(&b[0]));
    largest.map_or((f64::NAN, [f64::NAN; 2]), |(element, [strain, _])| {
        (*strain, mean(&mesh.corners(element)))
    })
}

/// Returns radius and depth of the zone above the edge's plastic strain.
fn plastic_zone(mesh: &SphereMesh, plastic: &[[f64; 2]]) -> [f64; 2] {
    let flowed =
        plastic.iter().enumerate().filter(|(_, [strain, _])| *strain > EDGE_OF_PLASTIC_ZONE);
    let centres = flowed.map(|(element, _)| mean(&mesh.corners(element)));
    centres.fold([0.0; 2], |[r, depth], [own_r, y]| [r.max(own_r), depth.max(y.abs())])
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A sphere of radius 1 flattened to a crown of radius 5 within 0.1, whose depth is r²/2 (1 − 1/5) there.
    #[test]
    fn crown_and_edge_of_a_flattened_sphere() {
        let after = |r: f64| 0.5 * (r * r).max(0.2 * r * r + 0.008 * (1.0 - 1e-9));
        let rows: Vec<[f64; 3]> =
            (0..30).map(|k| 0.01 * f64::from(k)).map(|r| [r, 0.5 * r * r, after(r)]).collect();
        let curvature = crown(&rows, 0.05).unwrap();
        assert!((curvature - 0.2).abs() < 1e-9);
        let depths: Vec<[f64; 2]> = rows.iter().map(|[r, a, b]| [*r, b - a]).collect();
        let (depth, radius) = extent(&depths);
        assert!((depth.unwrap() - 0.004).abs() < 1e-9);
        // 0.004 − 0.4 r² is a tenth of 0.004 at r = √0.009; lines between nodes differ by up to a fiftieth of their distance.
        assert!((radius.unwrap() - 0.009_f64.sqrt()).abs() < 2e-4);
    }
}
