//! The axial stress σ_yy in both bodies at an instant.

use fem::{Collision, Simulation, Snapshot};
use fem_case::engineering::show;
use fem_figure::contour::Section;
use fem_report::section_view::{DrawnField, SectionWindow, contour, sections};
use serde::Serialize;

/// Tension at the edge of a contact of two spheres over the peak pressure, about: the least tension that
/// the scale covers.
const TENSION_OVER_PRESSURE: f64 = 0.1;

/// The picture of an instant.
#[derive(Clone, Debug, Serialize)]
pub struct StressPicture {
    /// The bodies, as SVG.
    pub svg: String,
    /// The colour scale of all instants, as SVG.
    pub bar: String,
    /// Rules of a style sheet for a dark ground.
    pub dark_rules: String,
    /// Smallest and largest σ_yy, Pa.
    pub range_pa: (f64, f64),
}

/// Returns the picture of the instant `index`; `half_width` is that of the window over the largest contact
/// radius. `None` if no body has elements, or there is no such instant.
pub fn picture(
    simulation: &Simulation,
    collision: &Collision,
    index: usize,
    half_width: f64,
) -> Option<StressPicture> {
    let snapshot = collision.snapshots.get(index)?;
    let radius = collision.max_contact_radius.filter(|radius| *radius > 0.0)?;
    let peak = collision.peak_pressure?;
    let both = sections(simulation, snapshot)?;
    let ranges = both.iter().filter_map(Section::range);
    let range_pa = ranges.fold((0.0, 0.0), |(a, b): (f64, f64), (c, d)| (a.min(c), b.max(d)));
    let window = SectionWindow::square((half_width * radius).min(extent(simulation)));
    let title = title(simulation, snapshot);
    let scale = (-peak, TENSION_OVER_PRESSURE * peak);
    let contour = contour(DrawnField::AXIAL_STRESS, vec![both], vec![title], &window, scale);
    let (svg, bar, dark_rules) = (contour.frames().pop()?, contour.bar(), contour.dark_rules());
    Some(StressPicture { svg, bar, dark_rules, range_pa })
}

/// Returns the diameter (m) of the larger sphere with elements, the largest half width of a window.
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
