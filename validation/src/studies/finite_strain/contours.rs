//! Sections of soft bodies on a wall with σ_yy at four instants, which are labels or times.
//!
//! Measures for each run and instant, from the upper body's σ_yy where it touches the wall on the axis, the contact
//! pressure there and the deformed surface:
//!
//! - `RUN.INSTANT.smallest`: the largest compression, Pa;
//! - `RUN.INSTANT.into_wall`: the penetration of the surface into the wall, over the largest approach;
//! - `RUN.pole_over_pressure`: −σ_yy at the pole over the contact pressure on the axis at the largest approach;
//! - `RUN.last_over_maximum`: the largest compression at the last contact over that at the largest approach;
//! - `RUN.height`: the remaining height on the axis at the largest approach, over the diameter;
//! - `RUN.front_speed`, if the instants are times: the speed in the undeformed body, from the first instant to the last,
//!   of the place on the axis where −σ_yy is a tenth of its largest value there, m/s.

use fem_collision::{Snapshot, SnapshotInstant};
use fem_figure::contour::{Panel, Section, Window};

use crate::{ExplicitRun, Figure, Findings, Laboratory, StudyError, studies::sections};

const MILLI: f64 = 1e3;
const MEGA: f64 = 1e6;
/// Index of the upper body; the wall is the lower one.
const UPPER: usize = 1;
/// Extent of the picture in radii of the ball: to each side, below the wall, above it.
const WIDTH: f64 = 1.45;
const BELOW: f64 = 0.12;
const ABOVE: f64 = 2.15;

pub fn study(laboratory: &Laboratory) -> Result<Findings, StudyError> {
    let (names, cases) = laboratory.cases()?;
    let runs = laboratory.run_all(cases)?;
    let mut findings = Findings::new();
    for (name, run) in names.into_iter().zip(&runs) {
        let instants: Vec<&Snapshot> = run.collision.snapshots.iter().collect();
        let labels: Vec<_> = instants.iter().map(|snapshot| snapshot.label).collect();
        if labels == SnapshotInstant::OF_CONTACT.map(Some) {
            measure(name, run, &instants, &mut findings);
        } else if labels == [None; SnapshotInstant::OF_CONTACT.len()] {
            findings.measure(format!("{name}.front_speed"), front_speed(run, &instants));
        } else {
            return Err(StudyError::parameters(
                "a case does not keep the four named snapshots, or four",
            ));
        }
        findings.figures.push(draw(name, run, &instants));
    }
    Ok(findings)
}

fn measure(name: &str, run: &ExplicitRun, instants: &[&Snapshot], findings: &mut Findings) {
    let mut smallest = Vec::new();
    for (snapshot, label) in instants.iter().zip(SnapshotInstant::OF_CONTACT) {
        let halves = sections::halves(run, snapshot, 1.0);
        let instant = label.name().replace('-', "_");
        smallest.push(sections::range(&halves).0);
        findings.measure(format!("{name}.{instant}.smallest"), sections::range(&halves).0);
        let lowest = |half: &Section| {
            let outline = half.outline.iter().map(|point| half.points[*point as usize][1]);
            outline.fold(f64::INFINITY, f64::min)
        };
        let into_wall = -lowest(&halves[UPPER]) / MILLI / run.max_approach();
        findings.measure(format!("{name}.{instant}.into_wall"), into_wall);
        if label == SnapshotInstant::Maximum {
            let Some(mesh) = run.model.bodies()[UPPER].mesh() else { continue };
            let half = &halves[UPPER];
            let pole = -half.values[mesh.surface()[0] as usize];
            let near = run.collision.history.iter().min_by(|a, b| {
                let away = |time: f64| (time - snapshot.time).abs();
                away(a.time).total_cmp(&away(b.time))
            });
            let pressure = near.and_then(|row| row.centre_pressure).unwrap_or(f64::NAN);
            findings.measure(format!("{name}.pole_over_pressure"), pole / pressure);
            let axis = || mesh.axis().iter().map(|node| half.points[*node as usize][1]);
            let height =
                axis().fold(f64::NEG_INFINITY, f64::max) - axis().fold(f64::INFINITY, f64::min);
            let diameter = 2.0 * MILLI * run.smallest_radius();
            findings.measure(format!("{name}.height"), height / diameter);
        }
    }
    if let [_, maximum, _, last] = smallest[..] {
        findings.measure(format!("{name}.last_over_maximum"), last / maximum);
    }
}

/// Returns the speed of the stress front, m/s.
fn front_speed(run: &ExplicitRun, instants: &[&Snapshot]) -> f64 {
    let Some(mesh) = run.model.bodies()[UPPER].mesh() else { return f64::NAN };
    let place = |snapshot: &Snapshot| {
        let half = &sections::halves(run, snapshot, 1.0)[UPPER];
        let mut axis: Vec<_> = mesh
            .axis()
            .iter()
            .map(|node| (mesh.nodes()[*node as usize][1], -half.values[*node as usize]))
            .collect();
        axis.sort_by(|a, b| b.0.total_cmp(&a.0));
        let tenth = 0.1 * axis.iter().map(|point| point.1).fold(0.0, f64::max);
        let front = axis.windows(2).find(|pair| pair[1].1 >= tenth);
        front.map_or(f64::NAN, |pair| {
            let share = (tenth - pair[0].1) / (pair[1].1 - pair[0].1);
            pair[0].0 + share * (pair[1].0 - pair[0].0)
        })
    };
    let (first, last) = (instants[0], instants[instants.len() - 1]);
    (place(last) - place(first)) / (last.time - first.time)
}

fn draw(name: &str, run: &ExplicitRun, instants: &[&Snapshot]) -> Figure {
    let radius = MILLI * run.smallest_radius();
    let halves: Vec<_> =
        instants.iter().map(|snapshot| sections::halves(run, snapshot, MEGA)).collect();
    let wall = Section {
        points: vec![[-2.0 * radius, 0.0], [2.0 * radius, 0.0]],
        values: vec![0.0; 2],
        quads: Vec::new(),
        outline: vec![0, 1],
    };
    let panel = |(k, letter): (usize, char)| {
        let label = instants[k].label.map(|label| format!("{}, ", label.name().replace('-', " ")));
        let instant = format!("{}{:.2} ms", label.unwrap_or_default(), 1e3 * instants[k].time);
        Panel {
            title: sections::title(letter, &instant, sections::range(&halves[k]).0 * MEGA),
            sections: vec![halves[k][UPPER].mirrored(), wall.clone()],
            ..Panel::default()
        }
    };
    let window =
        Window { x: (-WIDTH * radius, WIDTH * radius), y: (-BELOW * radius, ABOVE * radius) };
    let panels = (0..instants.len()).zip('a'..).map(panel).collect();
    let title = run.case.file().title.clone().unwrap_or_default();
    Figure {
        name: name.into(),
        caption: format!(
            "{title}, at finite strain: true stress in the direction of the contact, σ_yy, in section, \
             tension positive. The lines are the outline of the deformed ball, true to scale, and the wall."
        ),
        svg: sections::figure("MPa", window, halves.iter().map(sections::range), panels),
    }
}
