//! Sections of the deformed bodies with σ_yy, for figures.

use fem_collision::Snapshot;
use fem_figure::contour::Section;

use crate::run::ExplicitRun;

/// Index of σ_yy among (σ_rr, σ_yy, σ_θθ, σ_ry).
const AXIAL: usize = 1;
const MILLI: f64 = 1e3;

/// Returns half sections of both bodies at an instant, in mm, with σ_yy over a unit (Pa); empty for a rigid body.
pub fn halves(run: &ExplicitRun, snapshot: &Snapshot, unit: f64) -> [Section; 2] {
    let mut halves: [Section; 2] = Default::default();
    let bodies = run.model.bodies().iter().zip(&snapshot.bodies);
    for (k, (body, fields)) in bodies.enumerate() {
        let Some(mesh) = body.mesh() else { continue };
        let stress = body.stress(fields).points;
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

/// Returns the smallest and the largest value of both bodies; NaN if any value is.
pub fn range(halves: &[Section; 2]) -> (f64, f64) {
    let values = || halves.iter().flat_map(|half| half.values.iter().copied());
    if values().any(f64::is_nan) {
        return (f64::NAN, f64::NAN);
    }
    (values().fold(f64::INFINITY, f64::min), values().fold(f64::NEG_INFINITY, f64::max))
}
