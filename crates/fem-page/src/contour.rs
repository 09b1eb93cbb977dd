//! σ_yy in both bodies at an instant, with their mirror images in the axis.

use fem::{Collision, Simulation, Snapshot};
use fem_case::engineering::{Unit, show};
use fem_figure::contour::{Contour, Levels, Panel, Section, Window};
use serde::Serialize;

use crate::outline::between;

/// σ_yy among (σ_rr, σ_yy, σ_θθ, σ_ry).
const AXIAL: usize = 1;
/// Bands below zero, about.
const BANDS: usize = 10;
/// Of the largest pressure is the tension at the edge of a contact of two spheres, about: the least that
/// the scale shows.
const TENSION_OVER_PRESSURE: f64 = 0.1;

/// A picture of an instant.
#[derive(Clone, Debug, Serialize)]
pub struct Picture {
    /// The bodies.
    pub svg: String,
    /// The scale of all instants.
    pub bar: String,
    /// Rules of a style sheet for a dark ground.
    pub dark_rules: String,
    /// Smallest and largest σ_yy that is seen, Pa.
    pub range_pa: (f64, f64),
}

/// What of a collision is drawn; `half_width` of the window over the largest contact radius.
///
/// `None` where no body has elements, or there is no such instant.
pub fn picture(
    simulation: &Simulation,
    collision: &Collision,
    index: usize,
    half_width: f64,
) -> Option<Picture> {
    let snapshot = collision.snapshots.get(index)?;
    let radius = collision.max_contact_radius.filter(|radius| *radius > 0.0)?;
    let reach = (half_width * radius).min(extent(simulation));
    let length = Unit::fitting(reach, "m");
    let stress = Unit::fitting(collision.peak_pressure?, "Pa");
    let [lower, upper] = [0, 1].map(|side| section(simulation, snapshot, side, &length, &stress));
    let sections: Vec<Section> = lower.into_iter().chain(upper).collect();
    if sections.is_empty() {
        return None;
    }
    let reach = length.scaled(reach);
    let range = sections.iter().filter_map(Section::range);
    let range = range.fold((0.0, 0.0), |(a, b): (f64, f64), (c, d)| (a.min(c), b.max(d)));
    let largest = stress.scaled(collision.peak_pressure?);
    let contour = Contour {
        quantity: format!("σ_yy [{}]", stress.symbol()),
        x_label: format!("r [{}]", length.symbol()),
        y_label: format!("y [{}]", length.symbol()),
        window: Window { x: (-reach, reach), y: (-reach, reach) },
        levels: Levels::about_zero(-largest, TENSION_OVER_PRESSURE * largest, BANDS),
        panels: vec![Panel { title: title(simulation, snapshot), sections }],
    };
    let in_pascals = |value: f64| value / stress.scaled(1.0);
    Some(Picture {
        svg: contour.frames().pop()?,
        bar: contour.bar(),
        dark_rules: contour.dark_rules(),
        range_pa: (in_pascals(range.0), in_pascals(range.1)),
    })
}

/// Diameter of the larger sphere that has elements, m: no window shows more.
fn extent(simulation: &Simulation) -> f64 {
    let radii = simulation.model().meshes().into_iter().flatten().map(|mesh| mesh.radius());
    let largest = radii.filter(|radius| radius.is_finite()).fold(0.0, f64::max);
    if largest > 0.0 { 2.0 * largest } else { f64::INFINITY }
}

fn title(simulation: &Simulation, snapshot: &Snapshot) -> String {
    let names = simulation.case().scene().bodies().each_ref().map(|body| body.name());
    format!(
        "Axial stress in {} (below) and {} (above), {} after first touch",
        names[0],
        names[1],
        show(snapshot.time - simulation.case().scene().first_touch(), "s")
    )
}

/// Half of a body where it is at the instant, seen from the point of first touch; none of a rigid one.
fn section(
    simulation: &Simulation,
    snapshot: &Snapshot,
    side: usize,
    length: &Unit,
    stress: &Unit,
) -> Option<Section> {
    let body = simulation.stress(snapshot, side)?;
    let gap = simulation.case().scene().gap().unwrap_or_default();
    let shift = if side == 0 { -0.5 * gap } else { 0.5 * gap };
    let nodes = body.mesh.nodes().iter().zip(snapshot.displacement(side));
    let section = Section {
        points: nodes
            .map(|([r, y], [u, w])| [length.scaled(r + u), length.scaled(y + w + shift)])
            .collect(),
        values: body.field.points.iter().map(|point| stress.scaled(point[AXIAL])).collect(),
        quads: body.mesh.quads().to_vec(),
        outline: body.mesh.surface().to_vec(),
    };
    Some(with_smooth_outline(section))
}

/// With points between those of the outline where that turns: they belong to no quad.
fn with_smooth_outline(mut section: Section) -> Section {
    let chain: Vec<[f64; 2]> =
        section.outline.iter().map(|point| section.points[*point as usize]).collect();
    let n = chain.len();
    // Beyond an end on the axis the chain goes on as its mirror image.
    let beyond = |end: usize, next: usize| {
        let is_on_axis = chain[end][0] == 0.0;
        if is_on_axis { [-chain[next][0], chain[next][1]] } else { chain[end] }
    };
    let mut outline = Vec::with_capacity(n);
    for k in 0..n {
        outline.push(section.outline[k]);
        if k + 1 == n {
            break;
        }
        let before = if k == 0 { beyond(0, 1) } else { chain[k - 1] };
        let after = if k + 2 == n { beyond(n - 1, n - 2) } else { chain[k + 2] };
        for point in between([before, chain[k], chain[k + 1], after]) {
            outline.push(section.points.len() as u32);
            section.points.push(point);
            section.values.push(f64::NAN);
        }
    }
    section.outline = outline;
    section
}
