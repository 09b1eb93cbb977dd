//! The snapshots as VTK files: one grid with both bodies an instant, and a collection of them.

use std::path::Path;

use fem_case::{Outcome, Simulation};
use fem_field::{Label, Snapshot, SnapshotRequest, StressField, invariants};
use fem_material::Material;
use fem_mesh::SphereMesh;
use fem_vtk::{VtuWriter, pad_vectors, write_collection};

/// Names of the stress arrays, in the order of [`GridStress`]; readers show the first at first.
const STRESSES: [&str; 6] =
    ["sigma_yy", "sigma_rr", "sigma_tt", "sigma_ry", "pressure", "von_mises"];

/// What is drawn of a collision.
pub struct Drawing<'a> {
    meshes: [Option<&'a SphereMesh>; 2],
    materials: [Option<&'a Material>; 2],
    /// m.
    gap: f64,
    request: &'a SnapshotRequest,
    snapshots: &'a [Snapshot],
    is_complete: bool,
}

impl<'a> Drawing<'a> {
    /// Of finite elements; other models have no fields.
    pub fn of(simulation: &'a Simulation, outcome: &'a Outcome) -> Option<Self> {
        let (meshes, plan) = match simulation {
            Simulation::Fem(problem) => {
                (problem.model.bodies().each_ref().map(|body| body.mesh()), &problem.plan)
            }
            Simulation::Condensed(condensed) => (condensed.meshes(), &condensed.plan),
            Simulation::Reduced(_) => return None,
        };
        Some(Self {
            meshes,
            materials: simulation.case().scene.bodies.each_ref().map(|body| body.material()),
            gap: plan.gap,
            request: &plan.snapshots,
            snapshots: &outcome.snapshots,
            is_complete: outcome.halt.is_none(),
        })
    }

    /// Bodies with a mesh, and which side they are on.
    fn meshed(&self) -> impl Iterator<Item = (usize, &'a SphereMesh, &'a Material)> {
        let both = self.meshes.into_iter().zip(self.materials).enumerate();
        both.filter_map(|(side, (mesh, material))| Some((side, mesh?, material?)))
    }
}

/// A grid of both bodies, the second body's points after the first's.
struct Grid {
    points: Vec<[f64; 3]>,
    quads: Vec<[u32; 4]>,
    /// 0 or 1 for each cell.
    body: Vec<i32>,
}

/// Six arrays of one value a cell or point.
type GridStress = [Vec<f64>; 6];

/// Writes all snapshots and their collection into `folder`.
///
/// Returns the names of the files, and warnings about snapshots that are left out.
///
/// # Errors
/// The file system.
pub fn write_snapshots(
    folder: &Path,
    stem: &str,
    drawing: &Drawing<'_>,
) -> Result<(Vec<String>, Vec<String>), fem_vtk::Error> {
    let grid = Grid::of(drawing);
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
        match write_snapshot(&folder.join(&name), &grid, drawing, snapshot) {
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
    grid: &Grid,
    drawing: &Drawing<'_>,
    snapshot: &Snapshot,
) -> Result<(), fem_vtk::Error> {
    let (mut displacement, mut velocity) = (Vec::new(), Vec::new());
    let (mut cells, mut points) = (GridStress::default(), GridStress::default());
    for (side, mesh, material) in drawing.meshed() {
        let fields = &snapshot.bodies[side];
        displacement.extend(pad_vectors(fields.displacement.as_flattened()));
        velocity.extend(pad_vectors(fields.velocity.as_flattened()));
        let stress = StressField::of(mesh, material, fields);
        append_stress(&mut cells, &stress.cells);
        append_stress(&mut points, &stress.points);
    }
    let mut writer = VtuWriter::new(&grid.points, &grid.quads)
        .time(snapshot.time)
        .point_data("displacement", 3, &displacement)
        .point_data("velocity", 3, &velocity);
    for (k, name) in STRESSES.into_iter().enumerate() {
        writer = writer.point_data(name, 1, &points[k]).cell_data(name, 1, &cells[k]);
    }
    writer.cell_data("body", 1, &grid.body).write(path)
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

impl Grid {
    /// Reference positions (r, y, 0), half of the start gap between each body and y = 0.
    fn of(drawing: &Drawing<'_>) -> Self {
        let mut grid = Self { points: Vec::new(), quads: Vec::new(), body: Vec::new() };
        for (side, mesh, _) in drawing.meshed() {
            let shift = if side == 0 { -0.5 * drawing.gap } else { 0.5 * drawing.gap };
            let first = grid.points.len() as u32;
            grid.points.extend(mesh.nodes().iter().map(|[r, y]| [*r, y + shift, 0.0]));
            grid.quads.extend(mesh.quads().iter().map(|quad| quad.map(|node| first + node)));
            grid.body.extend(mesh.quads().iter().map(|_| side as i32));
        }
        grid
    }
}
