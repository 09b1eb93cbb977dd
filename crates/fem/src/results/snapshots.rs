//! The snapshots as VTK files: one grid with both bodies an instant, and a collection of them.

use std::path::Path;

use fem_collision::{Collision, Label, Snapshot, SnapshotRequest, StressRecovery, invariants};
use fem_material::Material;
use fem_mesh::SphereMesh;
use fem_vtk::{VtuGrid, VtuWriter, pad_vectors, write_collection};

use crate::simulation::Simulation;

/// Names of the stress arrays, in the order of [`GridStress`]; readers show the first at first.
const STRESSES: [&str; 6] =
    ["sigma_yy", "sigma_rr", "sigma_tt", "sigma_ry", "pressure", "von_mises"];

/// What is drawn of a collision.
struct Drawing<'a> {
    meshes: [Option<&'a SphereMesh>; 2],
    materials: [Option<&'a Material>; 2],
    /// m.
    gap: f64,
    request: &'a SnapshotRequest,
    snapshots: &'a [Snapshot],
    is_complete: bool,
}

impl<'a> Drawing<'a> {
    fn of(simulation: &'a Simulation, collision: &'a Collision) -> Self {
        Self {
            meshes: simulation.model().meshes(),
            materials: simulation.case().scene().bodies().each_ref().map(|body| body.material()),
            gap: start_gap(simulation, collision),
            request: &simulation.want().snapshots,
            snapshots: &collision.snapshots,
            is_complete: collision.is_complete(),
        }
    }

    /// Bodies with a mesh, and which side they are on.
    fn meshed(&self) -> impl Iterator<Item = (usize, &'a SphereMesh, &'a Material)> {
        let both = self.meshes.into_iter().zip(self.materials).enumerate();
        both.filter_map(|(side, (mesh, material))| Some((side, mesh?, material?)))
    }
}

/// Of the surfaces at time 0, m; the approach of a ball that falls is that of its first touch.
fn start_gap(simulation: &Simulation, collision: &Collision) -> f64 {
    if collision.approach == simulation.setup().approach {
        return simulation.case().scene().gap().unwrap_or_default();
    }
    collision.approach.gap()
}

/// The arrays of a grid of both bodies, the second body's points after the first's.
struct GridArrays {
    points: Vec<[f64; 3]>,
    quads: Vec<[u32; 4]>,
    /// 0 or 1 for each cell.
    body: Vec<i32>,
}

/// What all snapshots share.
struct Scene<'a> {
    grid: VtuGrid<'a>,
    body: &'a [i32],
    /// Of the bodies with a mesh.
    recoveries: Vec<StressRecovery<'a>>,
}

/// Six arrays of one value a cell or point.
type GridStress = [Vec<f64>; 6];

/// Writes all snapshots of a collision and their collection into `folder`.
///
/// Returns the names of the files, and warnings about snapshots that are left out.
///
/// # Errors
/// The file system.
pub fn write_snapshots(
    folder: &Path,
    stem: &str,
    simulation: &Simulation,
    collision: &Collision,
) -> Result<(Vec<String>, Vec<String>), fem_vtk::Error> {
    let drawing = &Drawing::of(simulation, collision);
    if drawing.snapshots.is_empty() {
        return Ok((Vec::new(), Vec::new()));
    }
    let arrays = GridArrays::of(drawing);
    let scene = Scene {
        grid: VtuGrid::new(&arrays.points, &arrays.quads),
        body: &arrays.body,
        recoveries: drawing.meshed().map(|(_, mesh, _)| StressRecovery::new(mesh)).collect(),
    };
    let (mut series, mut warnings): (Vec<(f64, String)>, _) = (Vec::new(), Vec::new());
    for snapshot in drawing.snapshots {
        let label = label(snapshot, drawing.request);
        if snapshot.label == Some(Label::LastContact) && !drawing.is_complete {
            warnings.push(format!("the run ended before the instant \"{label}\"; it is left out"));
            continue;
        }
        // Viewers draw two files of one time on top of each other.
        if let Some((time, earlier)) = series.last()
            && snapshot.time <= *time
        {
            warnings.push(format!(
                "the snapshot \"{label}\" is of the same instant as {earlier}; it is left out"
            ));
            continue;
        }
        let name = format!("{stem}_{}_{label}.vtu", series.len());
        match write_snapshot(&folder.join(&name), &scene, drawing, snapshot) {
            Err(error @ fem_vtk::Error::NotFinite { .. }) => {
                warnings.push(format!("the snapshot \"{label}\" is left out: {error}"));
            }
            result => {
                result?;
                series.push((snapshot.time, name));
            }
        }
    }
    let mut files: Vec<String> = series.iter().map(|(_, name)| name.clone()).collect();
    if !series.is_empty() {
        let collection = format!("{stem}.pvd");
        write_collection(folder.join(&collection), &series)?;
        files.extend([collection, format!("{stem}.vtu.series")]);
    }
    Ok((files, warnings))
}

fn label(snapshot: &Snapshot, request: &SnapshotRequest) -> &'static str {
    match (snapshot.label, request) {
        (Some(label), _) => label.name(),
        (None, SnapshotRequest::Times(_)) => "time",
        (None, _) => "even",
    }
}

fn write_snapshot(
    path: &Path,
    scene: &Scene<'_>,
    drawing: &Drawing<'_>,
    snapshot: &Snapshot,
) -> Result<(), fem_vtk::Error> {
    let (mut displacement, mut velocity) = (Vec::new(), Vec::new());
    let (mut cells, mut points) = (GridStress::default(), GridStress::default());
    for ((side, _, material), recovery) in drawing.meshed().zip(&scene.recoveries) {
        let fields = &snapshot.bodies[side];
        displacement.extend(pad_vectors(snapshot.displacement(side).as_flattened()));
        velocity.extend(pad_vectors(fields.velocity.as_flattened()));
        let stress = recovery.stress(material, fields);
        append_stress(&mut cells, &stress.cells);
        append_stress(&mut points, &stress.points);
    }
    let mut writer = VtuWriter::on(&scene.grid)
        .time(snapshot.time)
        .point_data("displacement", 3, &displacement)
        .point_data("velocity", 3, &velocity);
    for (k, name) in STRESSES.into_iter().enumerate() {
        writer = writer.point_data(name, 1, &points[k]).cell_data(name, 1, &cells[k]);
    }
    writer.cell_data("body", 1, scene.body).write(path)
}

fn append_stress(arrays: &mut GridStress, stresses: &[[f64; 4]]) {
    for stress in stresses {
        let (pressure, von_mises) = invariants(*stress);
        let [rr, yy, tt, ry] = *stress;
        for (array, value) in arrays.iter_mut().zip([yy, rr, tt, ry, pressure, von_mises]) {
            array.push(value);
        }
    }
}

impl GridArrays {
    /// Reference positions (r, y, 0), half of the start gap between each body and y = 0.
    fn of(drawing: &Drawing<'_>) -> Self {
        let mut arrays = Self { points: Vec::new(), quads: Vec::new(), body: Vec::new() };
        for (side, mesh, _) in drawing.meshed() {
            let shift = if side == 0 { -0.5 * drawing.gap } else { 0.5 * drawing.gap };
            let first = arrays.points.len() as u32;
            arrays.points.extend(mesh.nodes().iter().map(|[r, y]| [*r, y + shift, 0.0]));
            arrays.quads.extend(mesh.quads().iter().map(|quad| quad.map(|node| first + node)));
            arrays.body.extend(mesh.quads().iter().map(|_| side as i32));
        }
        arrays
    }
}
