//! Sections of the deformed bodies with σ_yy, for figures.

use fem_case::engineering::Unit;
use fem_collision::Snapshot;
use fem_figure::contour::{Contour, Levels, Panel, Section, Window};

use crate::run::ExplicitRun;

/// Index of σ_yy among (σ_rr, σ_yy, σ_θθ, σ_ry).
const AXIAL: usize = 1;
const MILLI: f64 = 1e3;
/// Approximate number of colour bands over the largest stress.
const N_BANDS: usize = 11;

/// Returns half sections of both bodies at an instant, in mm, with σ_yy over a unit (Pa); empty for a rigid body.
pub fn halves(run: &ExplicitRun, snapshot: &Snapshot, unit: f64) -> [Section; 2] {
    let mut halves: [Section; 2] = Default::default();
    let bodies = run.model.bodies().iter().zip(&snapshot.bodies);
    for (k, (body, fields)) in bodies.enumerate() {
        let Some(mesh) = body.mesh() else { continue };
        let stress = body.stress(fields, Some(&snapshot.contact)).points;
        let nodes = mesh.nodes().iter().zip(snapshot.displacement(k));
        halves[k] = Section {
            points: nodes
                .map(|(x, u)| [0, 1].map(|axis: usize| MILLI * (x[axis] + u[axis])))
                .collect(),
            values: stress.iter().map(|stress| stress[AXIAL] / unit).collect(),
            quads: mesh.quads().to_vec(),
            outline: mesh.surface().to_vec(),
        };
    }
    halves
}

pub fn range(halves: &[Section; 2]) -> (f64, f64) {
    let values = || halves.iter().flat_map(|half| half.values.iter().copied());
    if values().any(f64::is_nan) {
        return (f64::NAN, f64::NAN);
    }
    (values().fold(f64::INFINITY, f64::min), values().fold(f64::NEG_INFINITY, f64::max))
}

/// Returns the title of a panel: its letter, its instant, and the smallest stress, Pa.
pub fn title(letter: char, instant: &str, smallest: f64) -> String {
    let smallest = Unit::fitting(smallest, "Pa").with_digits(3).show(smallest);
    format!("({letter}) {instant}, σ_yy ≥ {}", smallest.replace('-', "\u{2212}"))
}

/// Returns the figure of panels in a window (mm) as SVG; `ranges` are those of σ_yy in a unit.
pub fn figure(
    unit: &str,
    window: Window,
    ranges: impl Iterator<Item = (f64, f64)>,
    panels: Vec<Panel>,
) -> String {
    let (smallest, largest) =
        ranges.fold((0.0f64, 0.0f64), |(from, to), (a, b)| (from.min(a), to.max(b)));
    let contour = Contour {
        quantity: format!("σ_yy [{unit}]"),
        x_label: "r [mm]".into(),
        y_label: "y [mm]".into(),
        window,
        levels: Levels::about_zero(smallest, largest, N_BANDS),
        panels,
    };
    contour.svg()
}
