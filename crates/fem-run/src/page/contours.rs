//! σ_yy around the contact at the snapshots, from their files.

use std::collections::{BTreeSet, HashMap, HashSet};

use fem_case::engineering::Unit;
use fem_figure::contour::{Contour, Levels, Panel, Section, Window};
use fem_vtk::{Numbers, VtuFile};

use super::curves::instant;
use super::record::{Frame, Record};

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
const WHOLE: f64 = 1.7;
const ROOM: f64 = 1.06;
/// Largest height over width of a window.
const TALLEST: f64 = 1.25;
/// How far from the axis and the pole elements are kept, over half of the window's width.
const KEPT: f64 = 2.5;
/// Outlines are straight where a curve is no farther from them than this share of the window's width.
const STRAIGHT: f64 = 5e-4;

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

/// What is seen, m.
struct View {
    half_width: f64,
    /// Of the lower and the upper body.
    depths: [f64; 2],
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

/// The picture, one panel a frame, at most so many evenly over the snapshots, of half sections; `None` of a
/// result without fields.
pub fn contour(record: &Record, most_frames: usize) -> Option<Contour> {
    let n = record.frames.len().min(most_frames);
    let chosen = (0..n).map(|k| k * (record.frames.len() - 1) / (n - 1).max(1));
    let chosen: Vec<&Frame> = chosen.filter_map(|k| record.frames.get(k)).collect();
    let radius = record.number(&["max_contact_radius_m"]).unwrap_or(0.0);
    let near = HALF_WIDTH * radius.max(record.number(&["max_approach_m"]).unwrap_or(0.0));
    if !(near > 0.0 && near.is_finite()) {
        return None;
    }
    let first = VtuFile::open(&chosen.first()?.path).ok()?;
    let bodies = bodies(&first, near)?;
    let sections: Option<Vec<[Section; 2]>> =
        chosen.iter().map(|frame| sections(&bodies, frame)).collect();
    let mut sections = sections?;
    let view = View::of(&sections, near);
    let ranges = sections.iter().flatten().filter_map(|section| seen(section, &view).range());
    let (smallest, largest) =
        ranges.fold((0.0f64, 0.0f64), |(from, to), range| (from.min(range.0), to.max(range.1)));
    for (both, frame) in sections.iter_mut().zip(&chosen) {
        for (side, section) in both.iter_mut().enumerate() {
            *section = match section.quads.is_empty() {
                true => rigid(record, side, frame, &view).unwrap_or_default(),
                false => section.rounded(2.0 * STRAIGHT * view.half_width),
            };
        }
    }
    let length = Unit::fitting(view.half_width, "m");
    let stress = Unit::fitting(largest.max(-smallest), "Pa");
    let start = record.first_touch();
    let time = Unit::fitting(record.last_touch() - start, "s").with_digits(3);
    let panel = |(frame, sections): (&&Frame, [Section; 2])| Panel {
        title: format!("{}, {}", instant(&frame.label), time.show(frame.time - start)),
        sections: sections.map(|section| scaled(section, &length, &stress)).into(),
    };
    Some(Contour {
        quantity: format!("σ_yy [{}]", stress.symbol()),
        x_label: format!("r [{}]", length.symbol()),
        y_label: format!("y [{}]", length.symbol()),
        window: view.window(&length),
        levels: Levels::about_zero(stress.scaled(smallest), stress.scaled(largest), N_BANDS),
        panels: chosen.iter().zip(sections).map(panel).collect(),
    })
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
        let points: BTreeSet<u32> = quads.iter().flatten().copied().collect();
        let number: HashMap<u32, u32> =
            points.iter().enumerate().map(|(new, old)| (*old, new as u32)).collect();
        let quads: Vec<[u32; 4]> = quads.iter().map(|quad| quad.map(|k| number[&k])).collect();
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
    let pole = |section: &Section| Some(section.points[*section.outline.first()? as usize][1]);
    let poles: Vec<f64> = both.iter().filter_map(pole).collect();
    let middle = poles.iter().sum::<f64>() / poles.len().max(1) as f64;
    both.iter_mut().flat_map(|section| &mut section.points).for_each(|point| point[1] -= middle);
    both.try_into().ok()
}

/// The points along the border from the pole on; sides on the axis are no border. `sign` is 1 of the body
/// whose pole is its highest point, −1 of that whose pole is its lowest.
fn outline(quads: &[[u32; 4]], points: &[[f64; 2]], sign: f64) -> Vec<u32> {
    let sides = |quad: &[u32; 4]| [0, 1, 2, 3].map(|k: usize| [quad[k], quad[(k + 1) % 4]]);
    let all: BTreeSet<[u32; 2]> = quads.iter().flat_map(sides).collect();
    let is_on_axis = |point: u32| points[point as usize][0] == 0.0;
    let border = all.iter().filter(|[a, b]| {
        let is_inside = all.contains(&[*b, *a]);
        !(is_inside || is_on_axis(*a) && is_on_axis(*b))
    });
    let mut next: HashMap<u32, Vec<u32>> = HashMap::new();
    for [a, b] in border {
        next.entry(*a).or_default().push(*b);
        next.entry(*b).or_default().push(*a);
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
