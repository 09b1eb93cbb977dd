//! σ_yy around the contact at the snapshots, from their files.

use std::collections::{HashMap, HashSet};

use fem_case::engineering::Unit;
use fem_figure::contour::{Contour, Section};
use fem_vtk::{Numbers, VtuFile};

use super::profile::instant;
use super::record::{Frame, Record};
use super::view::{View, WHOLE, centred, nearness, picture};

/// How far from the axis and the pole elements are kept, over half of the window's width.
const KEPT: f64 = 2.5;
/// A body of all frames, as far as it is seen.
struct Body {
    /// Which points of the file it has.
    points: Vec<usize>,
    /// (r, y) of them, m.
    places: Vec<[f64; 2]>,
    /// Of its own points.
    quads: Vec<[u32; 4]>,
    /// From the pole on.
    outline: Vec<u32>,
}

/// The picture, one panel a frame, at most so many evenly over the snapshots, of half sections; `None` of a
/// result without fields.
pub fn contour(record: &Record, most_frames: usize) -> Option<Contour> {
    let chosen: Vec<&Frame> =
        chosen(record, most_frames).into_iter().filter_map(|k| record.frames.get(k)).collect();
    let radius = record.number(&["max_contact_radius_m"]).unwrap_or(0.0);
    let near = nearness(radius, record.number(&["max_approach_m"]).unwrap_or(0.0))?;
    let first = VtuFile::open(&chosen.first()?.path).ok()?;
    let bodies = bodies(&first, near)?;
    // Files of fine meshes take most of a page's time.
    let sections: Option<Vec<[Section; 2]>> = std::thread::scope(|scope| {
        let bodies = &bodies;
        let readers: Vec<_> =
            chosen.iter().map(|frame| scope.spawn(move || sections(bodies, frame))).collect();
        readers.into_iter().map(|reader| reader.join().ok().flatten()).collect()
    });
    let start = record.first_touch();
    let time = Unit::fitting(record.last_touch() - start, "s").with_digits(3);
    let title =
        |frame: &&Frame| format!("{}, {}", instant(&frame.label), time.show(frame.time - start));
    let titles = chosen.iter().map(title).collect();
    let rigid = |k: usize, side: usize, view: &View| rigid(record, side, chosen[k], view);
    let mut contour = picture(sections?, titles, near, rigid);
    if let [lower, upper] = names(record).as_slice() {
        contour.y_label = format!("{lower} \u{2190} {} \u{2192} {upper}", contour.y_label);
    }
    Some(contour)
}

/// Of the lower and the upper body, so much of them as an axis has room for.
fn names(record: &Record) -> Vec<String> {
    const MOST: usize = 14;
    let name = |body: &serde_json::Value| Some(body.get("name")?.as_str()?.to_string());
    let short = |name: String| match name.chars().count() {
        0..=MOST => name,
        _ => name.chars().take(MOST - 1).chain(['\u{2026}']).collect(),
    };
    record.list("bodies").iter().filter_map(name).map(short).collect()
}

/// At most so many frames evenly, that nearest to the largest force among them.
pub fn chosen(record: &Record, most: usize) -> Vec<usize> {
    let n = record.frames.len().min(most);
    let mut chosen: Vec<usize> =
        (0..n).map(|k| k * (record.frames.len() - 1) / (n - 1).max(1)).collect();
    let peak = record.peak_time();
    let distance = |k: &usize| (record.frames[*k].time - peak).abs();
    let fullest = (0..record.frames.len()).min_by(|a, b| distance(a).total_cmp(&distance(b)));
    if let Some(fullest) = fullest
        && let Some(nearest) = chosen.iter_mut().min_by_key(|k| k.abs_diff(fullest))
    {
        *nearest = fullest;
    }
    chosen
}

/// The surface of a rigid body where the other body's pole is at 0, with its inside as far as it is seen;
/// `None` where the files do not tell the gap.
fn rigid(record: &Record, side: usize, frame: &Frame, view: &View) -> Option<Section> {
    const N: u32 = 48;
    let contact = record.contacts.iter().find(|contact| contact.time == frame.time)?;
    let shape = record.summary.get("case")?.get("body")?.get(side)?;
    let diameter = shape.get("sphere").and_then(|sphere| sphere.get("diameter"));
    let radius = diameter.and_then(serde_json::Value::as_f64).map_or(f64::INFINITY, |d| 0.5 * d);
    let sign = if side == 0 { -1.0 } else { 1.0 };
    let (end, floor) = ((1.4 * view.half_width).min(radius), contact.gap + 1.3 * view.depths[side]);
    let along = (0..=N).map(|k| end * f64::from(k) / f64::from(N));
    let depth = |r: f64| r * (r / radius) / (1.0 + (1.0 - (r / radius).powi(2)).max(0.0).sqrt());
    let mut points: Vec<[f64; 2]> = along.map(|r| [r, sign * (contact.gap + depth(r))]).collect();
    points.push([end, sign * floor.max(contact.gap + depth(end))]);
    let outline = (0..points.len() as u32).collect();
    Some(Section { values: vec![0.0; points.len()], points, quads: Vec::new(), outline })
}

/// Both bodies of a file, without what is further than [`KEPT`] from where they touch of one that is not seen whole.
fn bodies(file: &VtuFile, near: f64) -> Option<[Body; 2]> {
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
        let of_side = mesh.quads.iter().zip(sides).filter(|(_, of)| **of == side);
        let quads: Vec<&[u32; 4]> = of_side.map(|(quad, _)| quad).collect();
        let heights = quads.iter().flat_map(|quad| quad.iter()).map(|p| sign * place(*p)[1]);
        let pole = heights.fold(f64::NEG_INFINITY, f64::max);
        let width = quads.iter().flat_map(|quad| quad.iter()).map(|p| place(*p)[0]);
        let is_whole = width.fold(0.0, f64::max) < WHOLE * near;
        let is_near = |quad: &&[u32; 4]| {
            quad.iter().any(|point| {
                let [r, y] = place(*point);
                is_whole || r < KEPT * near && pole - sign * y < KEPT * near
            })
        };
        let quads: Vec<[u32; 4]> = quads.into_iter().filter(is_near).copied().collect();
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
        Body { points: points.iter().map(|k| *k as usize).collect(), places, quads, outline }
    };
    Some([body(0), body(1)])
}

/// The bodies deformed, heights measured from the middle between the poles; `None` of a file that cannot be
/// read or is of another mesh.
fn sections(bodies: &[Body; 2], frame: &Frame) -> Option<[Section; 2]> {
    let file = VtuFile::open(&frame.path).ok()?;
    let values = |name: &str| match file.point_data(name).ok()?.values {
        Numbers::Float(values) => Some(values),
        Numbers::Integer(_) => None,
    };
    let (moved, stress) = (values("displacement")?, values("sigma_yy")?);
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
            section.values.push(*stress.get(point)?);
        }
        both.push(section);
    }
    let mut both: [Section; 2] = both.try_into().ok()?;
    centred(&mut both);
    Some(both)
}

/// The points along the border from the pole on; sides on the axis are no border. `sign` is 1 of the body
/// whose pole is its highest point, −1 of that whose pole is its lowest.
fn outline(quads: &[[u32; 4]], points: &[[f64; 2]], sign: f64) -> Vec<u32> {
    let ends = |a: u32, b: u32| [a.min(b), a.max(b)];
    let sides = |quad: &[u32; 4]| [0, 1, 2, 3].map(|k: usize| ends(quad[k], quad[(k + 1) % 4]));
    let mut all: Vec<[u32; 2]> = quads.iter().flat_map(sides).collect();
    all.sort_unstable();
    let is_on_axis = |point: u32| points[point as usize][0] == 0.0;
    // A side of one element alone.
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
