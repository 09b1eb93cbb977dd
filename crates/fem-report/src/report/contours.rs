//! The axial stress around the contact at the snapshots, and the plastic strain of the unloaded bodies, from their files.

use std::collections::{HashMap, HashSet};

use fem_case::engineering::Unit;
use fem_figure::contour::{Contour, Section};
use fem_vtk::{Numbers, VtuFile};

use fem_collision::SnapshotInstant;

use super::pressure_chart::instant_name;
use super::stored_result::{FieldFile, StoredResult};
use crate::section_view::{
    DrawnField, HALF_WIDTHS_OF_WHOLE_BODY, SectionWindow, centre, contour_of_frames, half_width,
};

/// Distance from the axis and from the pole up to which elements are kept, over the window's half width.
const KEPT: f64 = 2.5;

/// The kept part of a body's mesh, the same for all frames.
struct BodyPart {
    /// Indices of its points in the file.
    points: Vec<usize>,
    /// Their undeformed positions (r, y), m.
    places: Vec<[f64; 2]>,
    /// Elements by indices into `points`.
    quads: Vec<[u32; 4]>,
    /// Indices of the elements in the file.
    cells: Vec<usize>,
    /// The surface from the pole outward.
    outline: Vec<u32>,
}

impl BodyPart {
    /// Returns the means at the points of values of the cells of a file.
    fn means_of_cells(&self, values: &[f64]) -> Option<Vec<f64>> {
        let mut sums = vec![(0.0, 0.0); self.points.len()];
        for (quad, &cell) in self.quads.iter().zip(&self.cells) {
            let value = values.get(cell)?;
            for point in quad {
                let (sum, n) = &mut sums[*point as usize];
                (*sum, *n) = (*sum + value, *n + 1.0);
            }
        }
        Some(sums.into_iter().map(|(sum, n)| if n > 0.0 { sum / n } else { 0.0 }).collect())
    }
}

/// Returns the picture of one panel per frame, at most `most_frames` evenly spaced snapshots, in half
/// sections; `None` for a result without fields.
pub fn contour_of_result(result: &StoredResult, most_frames: usize) -> Option<Contour> {
    let chosen = chosen_frames(result, most_frames).into_iter();
    let chosen = chosen.filter_map(|k| result.frames.get(k)).collect();
    contour_of(result, DrawnField::AXIAL_STRESS, chosen)
}

/// Returns the picture of the equivalent plastic strain of the unloaded bodies; `None` for a result without.
pub fn contour_of_dent(result: &StoredResult) -> Option<Contour> {
    let label = SnapshotInstant::AfterSeparation.name();
    let frame = result.frames.iter().find(|frame| frame.label == label)?;
    contour_of(result, DrawnField::PLASTIC_STRAIN, vec![frame])
}

fn contour_of(
    result: &StoredResult,
    field: DrawnField,
    chosen: Vec<&FieldFile>,
) -> Option<Contour> {
    let radius = result.number(&["max_contact_radius_m"]).unwrap_or(0.0);
    let near = half_width(radius, result.number(&["max_approach_m"]).unwrap_or(0.0))?;
    let first = VtuFile::open(&chosen.first()?.path).ok()?;
    let bodies = bodies(&first, near)?;
    // Files are read in parallel, because those of fine meshes take most of the time of a page.
    let sections: Option<Vec<[Section; 2]>> = std::thread::scope(|scope| {
        let bodies = &bodies;
        let readers: Vec<_> = chosen
            .iter()
            .map(|frame| scope.spawn(move || sections(bodies, frame, field)))
            .collect();
        readers.into_iter().map(|reader| reader.join().ok().flatten()).collect()
    });
    let start = result.first_touch();
    let time = Unit::fitting(result.last_touch() - start, "s").with_digits(3);
    let title = |frame: &&FieldFile| {
        format!("{}, {}", instant_name(&frame.label), time.show(frame.time - start))
    };
    let titles = chosen.iter().map(title).collect();
    let rigid = |k: usize, side: usize, window: &SectionWindow| {
        rigid_section(result, side, chosen[k], window)
    };
    let mut contour = contour_of_frames(field, sections?, titles, near, rigid);
    if let Some(error) =
        stress_error(result).filter(|_| field.array == DrawnField::AXIAL_STRESS.array)
    {
        contour.x_label = format!("{}; {error}", contour.x_label);
    }
    if let [lower, upper] = short_names(result).as_slice() {
        contour.y_label = format!("{lower} \u{2190} {} \u{2192} {upper}", contour.y_label);
    }
    Some(contour)
}

/// Most results whose stresses are drawn next to each other.
const MAX_RESULTS: usize = 6;

/// Ratio of the largest stresses of two results from which one scale would blank the picture of the lower ones.
const ONE_SCALE: f64 = 4.0;

/// Returns pictures of one panel per result at its peak force, in one window: one picture on one scale or, where that would
/// blank a panel, one picture per result. There is none unless at least two results have fields, and at most `MAX_RESULTS`.
pub fn contours_at_peak(results: &[StoredResult]) -> Vec<Contour> {
    let mut shown: Vec<(&StoredResult, &FieldFile)> = Vec::new();
    let (mut stresses, mut widest) = (Vec::new(), 0.0f64);
    for result in results {
        let frame = chosen_frames(result, 1).pop().and_then(|k| result.frames.get(k));
        let radius = result.number(&["max_contact_radius_m"]).unwrap_or(0.0);
        let near = half_width(radius, result.number(&["max_approach_m"]).unwrap_or(0.0));
        let Some((frame, near)) = frame.zip(near) else { continue };
        let bodies = VtuFile::open(&frame.path).ok().and_then(|file| bodies(&file, near));
        let of = |bodies: [BodyPart; 2]| sections(&bodies, frame, DrawnField::AXIAL_STRESS);
        let Some(both) = bodies.and_then(of) else { continue };
        shown.push((result, frame));
        stresses.push(both);
        widest = widest.max(near);
    }
    if !(2..=MAX_RESULTS).contains(&shown.len()) {
        return Vec::new();
    }
    let largest = |sections: &[Section; 2]| {
        let values = sections.iter().flat_map(|section| &section.values);
        values.fold(0.0f64, |most, value| most.max(value.abs()))
    };
    let peaks: Vec<f64> = stresses.iter().map(largest).collect();
    let highest = peaks.iter().copied().fold(0.0, f64::max);
    let fit_one_scale = peaks.iter().all(|peak| ONE_SCALE * peak > highest);
    let picture = |first: usize, stresses: Vec<[Section; 2]>| {
        let of = &shown[first..first + stresses.len()];
        let titles = of.iter().map(|(result, _)| result.name.clone()).collect();
        let rigid = |k: usize, side: usize, window: &SectionWindow| {
            let (result, frame) = of[k];
            rigid_section(result, side, frame, window)
        };
        contour_of_frames(DrawnField::AXIAL_STRESS, stresses, titles, widest, rigid)
    };
    match fit_one_scale {
        true => vec![picture(0, stresses)],
        false => stresses.into_iter().enumerate().map(|(k, one)| picture(k, vec![one])).collect(),
    }
}

/// Returns the error of the stress near the contact, for a picture.
fn stress_error(result: &StoredResult) -> Option<String> {
    let [mean, most] =
        ["l2", "max"].map(|key| Some(100.0 * result.number(&["stress_error", key])?));
    Some(format!(
        "stress \u{b1} {:.0} % (rms), \u{b1} {:.0} % of its largest anywhere",
        mean?, most?
    ))
}

/// Returns the names of the bodies, shortened to the room beside an axis.
fn short_names(result: &StoredResult) -> Vec<String> {
    const MAX_LETTERS: usize = 14;
    let short = |name: String| match name.chars().count() {
        0..=MAX_LETTERS => name,
        _ => name.chars().take(MAX_LETTERS - 1).chain(['\u{2026}']).collect(),
    };
    result.body_names().into_iter().map(short).collect()
}

/// Returns at most `most` evenly spaced frames, among them the one nearest to the peak force.
pub fn chosen_frames(result: &StoredResult, most: usize) -> Vec<usize> {
    let n = result.frames.len().min(most);
    let mut chosen: Vec<usize> =
        (0..n).map(|k| k * (result.frames.len() - 1) / (n - 1).max(1)).collect();
    let peak = result.peak_time();
    let distance = |k: &usize| (result.frames[*k].time - peak).abs();
    let fullest = (0..result.frames.len()).min_by(|a, b| distance(a).total_cmp(&distance(b)));
    if let Some(fullest) = fullest
        && let Some(nearest) = chosen.iter_mut().min_by_key(|k| k.abs_diff(fullest))
    {
        *nearest = fullest;
    }
    chosen
}

/// Returns the visible part of a rigid body, where the other body's pole is at height 0; `None` if the
/// files do not contain the gap.
fn rigid_section(
    result: &StoredResult,
    side: usize,
    frame: &FieldFile,
    window: &SectionWindow,
) -> Option<Section> {
    const N: u32 = 48;
    let contact = result.contacts.iter().find(|contact| contact.time == frame.time)?;
    let shape = result.summary.get("case")?.get("body")?.get(side)?;
    let diameter = shape.get("sphere").and_then(|sphere| sphere.get("diameter"));
    let radius = diameter.and_then(serde_json::Value::as_f64).map_or(f64::INFINITY, |d| 0.5 * d);
    let sign = if side == 0 { -1.0 } else { 1.0 };
    let end = (1.4 * window.half_width).min(radius);
    let floor = contact.gap + 1.3 * window.depths[side];
    let along = (0..=N).map(|k| end * f64::from(k) / f64::from(N));
    let depth = |r: f64| r * (r / radius) / (1.0 + (1.0 - (r / radius).powi(2)).max(0.0).sqrt());
    let mut points: Vec<[f64; 2]> = along.map(|r| [r, sign * (contact.gap + depth(r))]).collect();
    points.push([end, sign * floor.max(contact.gap + depth(end))]);
    let outline = (0..points.len() as u32).collect();
    Some(Section { values: vec![0.0; points.len()], points, quads: Vec::new(), outline })
}

/// Returns both bodies of a file. A body that is not shown whole is cut off at [`KEPT`] half widths from
/// the contact.
fn bodies(file: &VtuFile, near: f64) -> Option<[BodyPart; 2]> {
    let mesh = file.quad_mesh().ok()?;
    let body = file.cell_data("body").ok()?;
    let sides = body.as_integer()?;
    let body = |side: i64| {
        // The lower body's pole is its highest point, the upper's its lowest.
        let sign = if side == 0 { 1.0 } else { -1.0 };
        let place = |point: u32| {
            let [r, y, _] = mesh.points[point as usize];
            [r, y]
        };
        let of_side = mesh.quads.iter().zip(sides).enumerate();
        let of_side = of_side.filter(|(_, (_, of))| **of == side);
        let quads: Vec<(usize, &[u32; 4])> =
            of_side.map(|(cell, (quad, _))| (cell, quad)).collect();
        let corners = || quads.iter().flat_map(|(_, quad)| quad.iter());
        let heights = corners().map(|p| sign * place(*p)[1]);
        let pole = heights.fold(f64::NEG_INFINITY, f64::max);
        let width = corners().map(|p| place(*p)[0]);
        let is_whole = width.fold(0.0, f64::max) < HALF_WIDTHS_OF_WHOLE_BODY * near;
        let is_near = |(_, quad): &(usize, &[u32; 4])| {
            quad.iter().any(|point| {
                let [r, y] = place(*point);
                is_whole || r < KEPT * near && pole - sign * y < KEPT * near
            })
        };
        let (cells, quads): (Vec<usize>, Vec<[u32; 4]>) =
            quads.into_iter().filter(is_near).map(|(cell, quad)| (cell, *quad)).unzip();
        let mut number = vec![None; mesh.points.len()];
        quads.iter().flatten().for_each(|point| number[*point as usize] = Some(0));
        let mut points: Vec<u32> = Vec::new();
        for (point, own) in number.iter_mut().enumerate().filter(|(_, own)| own.is_some()) {
            *own = Some(points.len() as u32);
            points.push(point as u32);
        }
        let renumbered = |quad: &[u32; 4]| quad.map(|k| number[k as usize].unwrap_or_default());
        let quads: Vec<[u32; 4]> = quads.iter().map(renumbered).collect();
        let places: Vec<[f64; 2]> = points.iter().map(|point| place(*point)).collect();
        let outline = outline(&quads, &places, sign);
        let points = points.iter().map(|k| *k as usize).collect();
        BodyPart { points, places, quads, cells, outline }
    };
    Some([body(0), body(1)])
}

/// Returns the deformed bodies at a frame; `None` if its file cannot be read or has another mesh.
fn sections(bodies: &[BodyPart; 2], frame: &FieldFile, field: DrawnField) -> Option<[Section; 2]> {
    let file = VtuFile::open(&frame.path).ok()?;
    let floats = |numbers: Numbers| match numbers {
        Numbers::Float(values) => Some(values),
        Numbers::Integer(_) => None,
    };
    let moved = floats(file.point_data("displacement").ok()?.values)?;
    let of_points = file.point_data(field.array).ok().and_then(|data| floats(data.values));
    let of_cells = match of_points {
        Some(_) => None,
        None => Some(floats(file.cell_data(field.array).ok()?.values)?),
    };
    let mut both = Vec::with_capacity(2);
    for body in bodies {
        let mut section = Section {
            quads: body.quads.clone(),
            outline: body.outline.clone(),
            ..Section::default()
        };
        for (&point, [r, y]) in body.points.iter().zip(&body.places) {
            let u = moved.get(3 * point..3 * point + 2)?;
            section.points.push([r + u[0], y + u[1]]);
        }
        section.values = match (&of_points, &of_cells) {
            (Some(values), _) => body
                .points
                .iter()
                .map(|&point| values.get(point).copied())
                .collect::<Option<_>>()?,
            (None, values) => body.means_of_cells(values.as_ref()?)?,
        };
        section.values.iter_mut().for_each(|value| *value *= field.factor());
        both.push(section);
    }
    let mut both: [Section; 2] = both.try_into().ok()?;
    centre(&mut both);
    Some(both)
}

/// Returns the points of the surface from the pole outward; the axis is no surface. `sign` is 1 for the body
/// whose pole is its highest point, −1 for the one whose pole is its lowest.
fn outline(quads: &[[u32; 4]], points: &[[f64; 2]], sign: f64) -> Vec<u32> {
    let ends = |a: u32, b: u32| [a.min(b), a.max(b)];
    let sides = |quad: &[u32; 4]| [0, 1, 2, 3].map(|k: usize| ends(quad[k], quad[(k + 1) % 4]));
    let mut all: Vec<[u32; 2]> = quads.iter().flat_map(sides).collect();
    all.sort_unstable();
    let is_on_axis = |point: u32| points[point as usize][0] == 0.0;
    // The border consists of the sides that belong to one element only.
    let border = all.chunk_by(|a, b| a == b).filter_map(|same| match same {
        [[a, b]] if !(is_on_axis(*a) && is_on_axis(*b)) => Some([*a, *b]),
        _ => None,
    });
    let mut next: HashMap<u32, Vec<u32>> = HashMap::new();
    for [a, b] in border {
        next.entry(a).or_default().push(b);
        next.entry(b).or_default().push(a);
    }
    let height = |point: u32| sign * points[point as usize][1];
    let on_axis = next.keys().copied().filter(|point| is_on_axis(*point));
    let Some(pole) = on_axis.max_by(|a, b| height(*a).total_cmp(&height(*b))) else {
        return Vec::new();
    };
    let mut line = vec![pole];
    let mut seen = HashSet::from([pole]);
    let mut here = pole;
    while let Some(onward) = next[&here].iter().copied().find(|point| seen.insert(*point)) {
        line.push(onward);
        here = onward;
    }
    line
}
