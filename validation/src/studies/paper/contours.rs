//! Fig. 14: σ_yy in section at four instants, on the deformed bodies.

use fem_collision::{Snapshot, SnapshotInstant};
use fem_figure::contour::{Panel, Region, Section, Window};
use serde::Deserialize;

use crate::{ExplicitRun, Figure, Findings, Laboratory, StudyError, studies::sections};

const MILLI: f64 = 1e3;
const GIGA: f64 = 1e-9;
const GIGA_PASCAL: f64 = 1e9;
/// Share of Hertz' p₀ at which the stressed region ends.
const STRESSED: f64 = 0.1;

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Parameters {
    /// Half of the picture's width and height, m.
    half_width: f64,
    half_height: f64,
}

pub fn study(laboratory: &Laboratory) -> Result<Findings, StudyError> {
    let parameters: Parameters = laboratory.parameters()?;
    let run = laboratory.run_all(vec![laboratory.case("elastic")?])?.remove(0);
    let instants = SnapshotInstant::OF_CONTACT.map(|label| {
        let found = run.collision.snapshots.iter().find(|snapshot| snapshot.label == Some(label));
        found.map(|snapshot| Instant::of(&run, label, snapshot))
    });
    let missing = || StudyError::parameters("the case does not keep the four named snapshots");
    let instants = instants.into_iter().collect::<Option<Vec<_>>>().ok_or_else(missing)?;
    let mut findings = Findings::new();
    measure(&run, &instants, &mut findings);
    let half = [parameters.half_width, parameters.half_height].map(|length| MILLI * length);
    findings.figures.push(draw(&instants, half));
    Ok(findings)
}

/// The bodies at one instant: half sections in mm, with σ_yy in GPa.
struct Instant {
    label: SnapshotInstant,
    time: f64,
    halves: [Section; 2],
    /// Stress at the contact pole of each body, GPa.
    poles: [f64; 2],
}

impl Instant {
    fn of(run: &ExplicitRun, label: SnapshotInstant, snapshot: &Snapshot) -> Self {
        let mut halves = sections::halves(run, snapshot, GIGA_PASCAL);
        let bodies = run.model.bodies();
        let poles = [0, 1].map(|k: usize| {
            bodies[k].mesh().map_or(f64::NAN, |mesh| halves[k].values[mesh.surface()[0] as usize])
        });
        // Heights are measured from the middle between the poles.
        let pole = |k: usize| {
            let section: &Section = &halves[k];
            section.outline.first().map_or(0.0, |point| section.points[*point as usize][1])
        };
        let middle = 0.5 * (pole(0) + pole(1));
        for point in halves.iter_mut().flat_map(|half| &mut half.points) {
            point[1] -= middle;
        }
        Self { label, time: snapshot.time, halves, poles }
    }

    /// Smallest and largest σ_yy, GPa; NaN if any point's is.
    fn range(&self) -> (f64, f64) {
        sections::range(&self.halves)
    }

    /// Returns the area of the half section where σ_yy is at most `level`, mm².
    fn area_at_most(&self, level: f64) -> f64 {
        self.halves.iter().map(|half| Region::at_most(half, level).area()).sum()
    }
}

fn measure(run: &ExplicitRun, instants: &[Instant], findings: &mut Findings) {
    let hertz = run.hertz;
    let peak = GIGA * hertz.peak_pressure();
    let at_force = peak * (run.peak_force() / hertz.peak_force()).cbrt();
    for instant in instants {
        let name = instant.label.name().replace('-', "_");
        let (smallest, largest) = instant.range();
        findings.measure(format!("{name}.time_share"), instant.time / hertz.contact_time());
        findings.measure(format!("{name}.smallest"), smallest / GIGA);
        findings.measure(format!("{name}.smallest_over_hertz"), -smallest / at_force);
        findings.measure(format!("{name}.tension_over_hertz"), largest / at_force);
        let [lower, upper] = instant.poles;
        findings.measure(format!("{name}.pole_mismatch"), (lower - upper).abs() / peak);
    }
    let [compression, maximum, separation, last] = instants else { return };
    let stressed = |instant: &Instant| instant.area_at_most(-STRESSED * peak);
    findings.measure("stressed_over_mid_compression", stressed(maximum) / stressed(compression));
    findings.measure("last_over_maximum", {
        let (smallest, largest) = last.range();
        largest.max(-smallest) / -maximum.range().0
    });
    findings.measure("mirror_difference", difference(compression, separation));
}

/// Returns the root mean square difference of two fields over that of the first.
fn difference(first: &Instant, second: &Instant) -> f64 {
    let values = |instant: &Instant| instant.halves.clone().map(|half| half.values).concat();
    let (first, second) = (values(first), values(second));
    let square: f64 = first.iter().zip(&second).map(|(a, b)| (a - b).powi(2)).sum();
    (square / first.iter().map(|a| a * a).sum::<f64>()).sqrt()
}

fn draw(instants: &[Instant], [half_width, half_height]: [f64; 2]) -> Figure {
    let panel = |(instant, letter): (&Instant, char)| {
        let name = instant.label.name().replace('-', " ");
        let name = format!("{name}, {:.1} µs", 1e6 * instant.time);
        Panel {
            title: sections::title(letter, &name, instant.range().0 / GIGA),
            sections: instant.halves.iter().map(Section::mirrored).collect(),
            ..Panel::default()
        }
    };
    let window = Window { x: (-half_width, half_width), y: (-half_height, half_height) };
    let panels = instants.iter().zip('a'..).map(panel).collect();
    Figure {
        name: "contours".into(),
        caption: "Fig. 14 of the paper, computed and drawn here: stress in the direction of the \
                  contact, σ_yy, in section around the contact; tension positive. The lines are \
                  the outlines of the deformed bodies, true to scale (not magnified); y is \
                  measured from the middle of the contact."
            .into(),
        svg: sections::figure("GPa", window, instants.iter().map(Instant::range), panels),
    }
}
