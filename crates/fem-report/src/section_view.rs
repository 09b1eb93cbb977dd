//! Deformed bodies in section with their stress along the axis: what of them is seen, and how it is drawn.

use fem_case::engineering::Unit;
use fem_figure::contour::{Contour, Levels, Panel, Section, Window};

/// Bands over the largest stress, about.
const N_BANDS: usize = 11;
/// How far from the axis is seen, over the largest contact radius, or the largest approach if that is larger; and
/// how far into a body over that.
const HALF_WIDTH: f64 = 2.6;
const DEPTH: f64 = 0.85;
/// The same of a body that a rigid one presses.
const DEPTH_ON_RIGID: f64 = 1.1;
/// What is seen of a rigid body, over half of the width.
const DEPTH_OF_RIGID: f64 = 0.15;
/// A body whose width is less than so many windows is seen whole, with so much room around it.
pub const WHOLE: f64 = 1.7;
const ROOM: f64 = 1.06;
/// Largest height over width of a window.
const TALLEST: f64 = 1.25;
/// Outlines are straight where a curve is no farther from them than this share of the window's width.
const STRAIGHT: f64 = 5e-4;

/// How far from the axis is seen (m) of a contact with these largest radius and approach, m; `None` of none.
pub fn nearness(radius: f64, approach: f64) -> Option<f64> {
    let near = HALF_WIDTH * radius.max(approach);
    (near > 0.0 && near.is_finite()).then_some(near)
}

/// What is seen, m.
pub struct View {
    /// From the axis to the edge.
    pub half_width: f64,
    /// Of the lower and the upper body.
    pub depths: [f64; 2],
}

impl View {
    /// Of deformed bodies, none of a rigid one; what is near reaches to a distance, m.
    fn of(sections: &[[Section; 2]], near: f64) -> Self {
        let largest = |side: usize, axis: usize| {
            let of_side = sections.iter().flat_map(|both| both[side].outline_points());
            of_side.fold(0.0f64, |most, point| most.max(point[axis].abs()))
        };
        let [lower, upper] = [0, 1].map(|side: usize| {
            let width = largest(side, 0);
            (width > 0.0).then(|| (width, (width < WHOLE * near).then(|| largest(side, 1))))
        });
        let across = [lower, upper].into_iter().flatten().map(|(width, whole)| match whole {
            Some(_) => ROOM * width,
            None => near,
        });
        let half_width = across.fold(0.0, f64::max);
        let is_beside_rigid = lower.is_none() || upper.is_none();
        let depth = if is_beside_rigid { DEPTH_ON_RIGID } else { DEPTH };
        let depths = [lower, upper].map(|body| match body {
            None => DEPTH_OF_RIGID * half_width,
            Some((_, Some(height))) => ROOM * height,
            Some((_, None)) => depth * half_width,
        });
        let tall = (depths[0] + depths[1]) / (2.0 * TALLEST);
        Self { half_width: half_width.max(tall), depths }
    }

    fn window(&self, unit: &Unit) -> Window {
        let [width, below, above] =
            [self.half_width, self.depths[0], self.depths[1]].map(|length| unit.scaled(length));
        Window { x: (-width, width), y: (-below, above) }
    }
}

/// Half sections (m, Pa) of both bodies, a panel a frame with its title; `rigid` gives that of a body without
/// elements by frame and side.
pub fn picture(
    mut sections: Vec<[Section; 2]>,
    titles: Vec<String>,
    near: f64,
    rigid: impl Fn(usize, usize, &View) -> Option<Section>,
) -> Contour {
    let view = View::of(&sections, near);
    let ranges = sections.iter().flatten().filter_map(|section| seen(section, &view).range());
    let (smallest, largest) =
        ranges.fold((0.0f64, 0.0f64), |(from, to), range| (from.min(range.0), to.max(range.1)));
    for (k, both) in sections.iter_mut().enumerate() {
        for (side, section) in both.iter_mut().enumerate() {
            *section = match section.quads.is_empty() {
                true => rigid(k, side, &view).unwrap_or_default(),
                false => section.rounded(2.0 * STRAIGHT * view.half_width),
            };
        }
    }
    let length = Unit::fitting(view.half_width, "m");
    let stress = Unit::fitting(largest.max(-smallest), "Pa");
    let panel = |(title, sections): (String, [Section; 2])| Panel {
        title,
        sections: sections.map(|section| scaled(section, &length, &stress)).into(),
    };
    Contour {
        quantity: format!("σ_yy [{}]", stress.symbol()),
        x_label: format!("r [{}]", length.symbol()),
        y_label: format!("y [{}]", length.symbol()),
        window: view.window(&length),
        levels: Levels::about_zero(stress.scaled(smallest), stress.scaled(largest), N_BANDS),
        panels: titles.into_iter().zip(sections).map(panel).collect(),
    }
}

/// A picture of half sections as one of whole ones.
pub fn whole(contour: Contour) -> Contour {
    let panel = |panel: Panel| Panel {
        sections: panel.sections.iter().map(Section::mirrored).collect(),
        ..panel
    };
    Contour { panels: contour.panels.into_iter().map(panel).collect(), ..contour }
}

/// Heights measured from the middle between the poles, where outlines begin.
pub fn centred(both: &mut [Section; 2]) {
    let pole = |section: &Section| Some(section.points[*section.outline.first()? as usize][1]);
    let poles: Vec<f64> = both.iter().filter_map(pole).collect();
    let middle = poles.iter().sum::<f64>() / poles.len().max(1) as f64;
    both.iter_mut().flat_map(|section| &mut section.points).for_each(|point| point[1] -= middle);
}

/// What lies in the window, of which the scale is.
fn seen(section: &Section, view: &View) -> Section {
    let is_seen = |quad: &&[u32; 4]| {
        quad.iter().any(|point| {
            let [r, y] = section.points[*point as usize];
            r < view.half_width && (-view.depths[0]..view.depths[1]).contains(&y)
        })
    };
    Section { quads: section.quads.iter().filter(is_seen).copied().collect(), ..section.clone() }
}

fn scaled(mut section: Section, length: &Unit, stress: &Unit) -> Section {
    section.points.iter_mut().flatten().for_each(|x| *x = length.scaled(*x));
    section.values.iter_mut().for_each(|value| *value = stress.scaled(*value));
    section
}
