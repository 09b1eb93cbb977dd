//! Sections of both deformed bodies with a field, such as their axial stress σ_yy. All such pictures of runs are drawn here.
//!
//! Sections are half sections (r ≥ 0) in metres, pascals and per cent. Heights are measured from the middle of the
//! contact.

use fem::{Simulation, Snapshot};
use fem_case::engineering::Unit;
use fem_figure::contour::{Contour, Levels, Panel, Section, Window};

/// Index of σ_yy among (σ_rr, σ_yy, σ_θθ, σ_ry).
const AXIAL: usize = 1;
/// Number of colour bands over the larger side of the stress range, about.
const N_BANDS: usize = 11;
/// Half width of the window over the largest contact radius, or over the largest approach if that is
/// larger; and the depth of the window in each body over its half width.
const HALF_WIDTH: f64 = 2.6;
const DEPTH: f64 = 0.85;
/// Depth in a body that is pressed by a rigid one.
const DEPTH_BESIDE_RIGID: f64 = 1.1;
/// Depth to which a rigid body is drawn.
const DEPTH_OF_RIGID: f64 = 0.15;
/// A body narrower than this many half widths is shown whole, with this margin around it.
pub(crate) const HALF_WIDTHS_OF_WHOLE_BODY: f64 = 1.7;
/// Half widths over the radius of a body that is shown whole.
const MARGIN_FACTOR: f64 = 1.06;
/// Largest height of a window over its width.
const TALLEST: f64 = 1.25;
/// Largest distance of an outline from the curve that it stands for, over the width of the window.
const STRAIGHT: f64 = 5e-4;

/// A field that is drawn in bands of colour.
#[derive(Clone, Copy, Debug)]
pub struct DrawnField {
    /// Name of its array in the files of a result.
    pub array: &'static str,
    /// Its name beside the scale.
    name: &'static str,
    /// Its SI unit; `None` for a share in per cent.
    unit: Option<&'static str>,
}

impl DrawnField {
    /// The axial stress.
    pub const AXIAL_STRESS: Self = Self { array: "sigma_yy", name: "σ_yy", unit: Some("Pa") };
    /// The equivalent plastic strain.
    pub const PLASTIC_STRAIN: Self =
        Self { array: "plastic_strain", name: "plastic strain", unit: None };

    /// Returns the factor of the values in files, which are SI and shares.
    pub fn factor(&self) -> f64 {
        if self.unit.is_some() { 1.0 } else { 100.0 }
    }
}

/// Returns the half width of the window (m) for a contact with this largest radius and approach (m);
/// `None` without a contact.
pub fn half_width(radius: f64, approach: f64) -> Option<f64> {
    let width = HALF_WIDTH * radius.max(approach);
    (width > 0.0 && width.is_finite()).then_some(width)
}

/// The visible part of a section, m.
pub struct SectionWindow {
    /// Distance from the axis to the right edge.
    pub half_width: f64,
    /// Depths below and above the contact, in the lower and in the upper body.
    pub depths: [f64; 2],
}

impl SectionWindow {
    /// A window for these deformed bodies; a rigid body has an empty section. Bodies that are not shown
    /// whole are shown up to `near` (m) from the axis.
    fn fitting(sections: &[[Section; 2]], near: f64) -> Self {
        let largest = |side: usize, axis: usize| {
            let points = sections.iter().flat_map(|both| both[side].outline_points());
            points.fold(0.0f64, |most, point| most.max(point[axis].abs()))
        };
        let [lower, upper] = [0, 1].map(|side: usize| {
            let width = largest(side, 0);
            (width > 0.0).then(|| {
                (width, (width < HALF_WIDTHS_OF_WHOLE_BODY * near).then(|| largest(side, 1)))
            })
        });
        let widths = [lower, upper].into_iter().flatten().map(|(width, whole)| match whole {
            Some(_) => MARGIN_FACTOR * width,
            None => near,
        });
        let half_width = widths.fold(0.0, f64::max);
        let is_beside_rigid = lower.is_none() || upper.is_none();
        let depth = if is_beside_rigid { DEPTH_BESIDE_RIGID } else { DEPTH };
        let depths = [lower, upper].map(|body| match body {
            None => DEPTH_OF_RIGID * half_width,
            Some((_, Some(height))) => MARGIN_FACTOR * height,
            Some((_, None)) => depth * half_width,
        });
        let tall = (depths[0] + depths[1]) / (2.0 * TALLEST);
        Self { half_width: half_width.max(tall), depths }
    }

    /// A square window that reaches this far (m) from the contact to every side.
    pub fn square(half_width: f64) -> Self {
        Self { half_width, depths: [half_width; 2] }
    }

    fn scaled(&self, unit: &Unit) -> Window {
        let [width, below, above] =
            [self.half_width, self.depths[0], self.depths[1]].map(|length| unit.scaled(length));
        Window { x: (-width, width), y: (-below, above) }
    }

    /// Returns the quads of a section that lie in the window.
    fn visible(&self, section: &Section) -> Section {
        let is_visible = |quad: &&[u32; 4]| {
            quad.iter().any(|point| {
                let [r, y] = section.points[*point as usize];
                r < self.half_width && (-self.depths[0]..self.depths[1]).contains(&y)
            })
        };
        let quads = section.quads.iter().filter(is_visible).copied().collect();
        Section { quads, ..section.clone() }
    }
}

/// Returns both bodies at an instant from the fields in memory; a rigid body has an empty section.
/// `None` if no body has elements.
pub fn sections(simulation: &Simulation, snapshot: &Snapshot) -> Option<[Section; 2]> {
    let mut both = [0, 1].map(|side| section(simulation, snapshot, side).unwrap_or_default());
    centre(&mut both);
    both.iter().any(|section| !section.quads.is_empty()).then_some(both)
}

fn section(simulation: &Simulation, snapshot: &Snapshot, side: usize) -> Option<Section> {
    let body = simulation.stress(snapshot, side)?;
    let moved = body.mesh.nodes().iter().zip(snapshot.displacement(side));
    Some(Section {
        points: moved.map(|([r, y], u)| [r + u[0], y + u[1]]).collect(),
        values: body.field.points.iter().map(|stress| stress[AXIAL]).collect(),
        quads: body.mesh.quads().to_vec(),
        outline: body.mesh.surface().to_vec(),
    })
}

/// Shifts heights so that they are measured from the middle between the poles, where the outlines begin.
pub(crate) fn centre(both: &mut [Section; 2]) {
    let pole = |section: &Section| Some(section.points[*section.outline.first()? as usize][1]);
    let poles: Vec<f64> = both.iter().filter_map(pole).collect();
    let middle = poles.iter().sum::<f64>() / poles.len().max(1) as f64;
    both.iter_mut().flat_map(|section| &mut section.points).for_each(|point| point[1] -= middle);
}

/// Returns the picture of one panel per frame, in a window and on a scale of the field that fit all frames.
///
/// `near` comes from [`half_width`]; `rigid` returns the section of a rigid body by frame and side.
pub fn contour_of_frames(
    field: DrawnField,
    mut sections: Vec<[Section; 2]>,
    titles: Vec<String>,
    near: f64,
    rigid: impl Fn(usize, usize, &SectionWindow) -> Option<Section>,
) -> Contour {
    let window = SectionWindow::fitting(&sections, near);
    let ranges = sections.iter().flatten().filter_map(|section| window.visible(section).range());
    let range =
        ranges.fold((0.0f64, 0.0f64), |(from, to), range| (from.min(range.0), to.max(range.1)));
    for (k, both) in sections.iter_mut().enumerate() {
        for (side, section) in both.iter_mut().enumerate().filter(|(_, body)| body.quads.is_empty())
        {
            *section = rigid(k, side, &window).unwrap_or_default();
        }
    }
    contour(field, sections, titles, &window, range)
}

/// Most quads of a refined section, which limits the time to draw it.
const MAX_QUADS: usize = 12_000;

/// Returns the visible part of a section with its outline rounded and its field refined, so that bands are smooth.
fn smooth(section: &Section, window: &SectionWindow) -> Section {
    let width = window.half_width;
    let [below, above] = window.depths;
    let rounded = section.rounded(2.0 * STRAIGHT * width).within((0.0, width), (-below, above));
    let n_levels = (0..=2).rev().find(|n| rounded.quads.len() << (2 * n) <= MAX_QUADS);
    rounded.refined(n_levels.unwrap_or(0))
}

/// Returns the picture of one panel per frame in this window; `range` is the smallest and the largest
/// value of the scale, Pa or per cent.
pub fn contour(
    field: DrawnField,
    sections: Vec<[Section; 2]>,
    titles: Vec<String>,
    window: &SectionWindow,
    range: (f64, f64),
) -> Contour {
    let length = Unit::fitting(window.half_width, "m");
    let unit = field.unit.map(|unit| Unit::fitting(range.1.max(-range.0), unit));
    let of_field = |value: f64| unit.as_ref().map_or(value, |unit| unit.scaled(value));
    let scaled = |mut section: Section| {
        section.points.iter_mut().flatten().for_each(|x| *x = length.scaled(*x));
        section.values.iter_mut().for_each(|value| *value = of_field(*value));
        section
    };
    let panel = |(title, both): (String, [Section; 2])| {
        let lines = both.iter().flat_map(|section| scaled(window.visible(section)).lines());
        let lines = lines.collect();
        let drawn = |section: Section| match section.quads.is_empty() {
            true => scaled(section),
            false => scaled(smooth(&section, window)),
        };
        Panel { title, sections: both.map(drawn).into(), lines }
    };
    Contour {
        quantity: format!("{} [{}]", field.name, unit.as_ref().map_or("%", Unit::symbol)),
        x_label: format!("r [{}]", length.symbol()),
        y_label: format!("y [{}]", length.symbol()),
        window: window.scaled(&length),
        levels: Levels::about_zero(of_field(range.0), of_field(range.1), N_BANDS),
        panels: titles.into_iter().zip(sections).map(panel).collect(),
    }
}

/// Returns a picture of half sections as one of whole sections.
pub fn mirrored(contour: Contour) -> Contour {
    let panel = |panel: Panel| Panel {
        sections: panel.sections.iter().map(Section::mirrored).collect(),
        ..panel
    };
    Contour { panels: contour.panels.into_iter().map(panel).collect(), ..contour }
}
