//! Writes the snapshots as VTK files: one grid with both bodies per instant, and a collection of them.
//!
//! Positions and displacements are doubles, since strains are small differences of them. Stresses, pressures and velocities
//! have single precision.

use std::path::Path;

use fem_case::Field;
use fem_collision::{
    Collision, Snapshot, SnapshotInstant, SnapshotRequest, StressRecovery, did_not_occur,
    invariants,
};
use fem_material::Material;
use fem_mesh::SphereMesh;
use fem_vtk::{VtuGrid, VtuWriter, pad_vectors, write_collection};

use crate::simulation::Simulation;

/// The stress arrays, in the order of [`GridStress`]. Viewers show the first one by default.
const STRESSES: [Field; 6] = [
    Field::SigmaYy,
    Field::SigmaRr,
    Field::SigmaTt,
    Field::SigmaRy,
    Field::Pressure,
    Field::VonMises,
];

/// The bodies to be drawn.
struct Drawing<'a> {
    meshes: [Option<&'a SphereMesh>; 2],
    materials: [Option<&'a Material>; 2],
    /// Gap at the start, m.
    gap: f64,
}

impl<'a> Drawing<'a> {
    fn of(simulation: &'a Simulation, collision: &Collision) -> Self {
        Self {
            meshes: simulation.model().meshes(),
            materials: simulation.case().scene().bodies().each_ref().map(|body| body.material()),
            gap: start_gap(simulation, collision),
        }
    }

    /// Returns the bodies with a mesh: side, mesh and material.
    fn meshed(&self) -> impl Iterator<Item = (usize, &'a SphereMesh, &'a Material)> {
        let both = self.meshes.into_iter().zip(self.materials).enumerate();
        both.filter_map(|(side, (mesh, material))| Some((side, mesh?, material?)))
    }
}

/// Returns the gap of the surfaces at time 0, m; for a falling ball, that of its first touch.
fn start_gap(simulation: &Simulation, collision: &Collision) -> f64 {
    if collision.approach == simulation.setup().approach {
        return simulation.case().scene().gap().unwrap_or(fem_case::defaults::GAP);
    }
    collision.approach.gap()
}

/// The arrays of a grid of both bodies, the second body's points after the first's.
struct GridArrays {
    points: Vec<[f64; 3]>,
    quads: Vec<[u32; 4]>,
    /// Side (0 or 1) of each cell.
    body: Vec<i32>,
    /// Side (0 or 1) of each point.
    body_of_points: Vec<i32>,
}

/// The parts that all snapshots share.
struct Scene<'a> {
    grid: VtuGrid<'a>,
    arrays: &'a GridArrays,
    case: &'a fem_case::Scene,
    /// Materials of the bodies with a mesh.
    recoveries: Vec<StressRecovery<'a>>,
}

/// Six arrays with one value per cell or point.
type GridStress = [Vec<f32>; 6];

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
    let Shown { snapshots, mut warnings } = shown(simulation, collision);
    if snapshots.is_empty() {
        return Ok((Vec::new(), warnings));
    }
    let drawing = &Drawing::of(simulation, collision);
    let arrays = GridArrays::of(drawing);
    let scene = Scene {
        grid: VtuGrid::new(&arrays.points, &arrays.quads),
        arrays: &arrays,
        case: simulation.case().scene(),
        recoveries: drawing.meshed().map(|(_, mesh, _)| StressRecovery::new(mesh)).collect(),
    };
    let mut series: Vec<(f64, String)> = Vec::new();
    // Leading zeros keep many files in order by name.
    let digits = (snapshots.len() - 1).to_string().len();
    for (snapshot, label) in snapshots {
        let name = format!("{stem}_{:0digits$}_{label}.vtu", series.len());
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

fn write_snapshot(
    path: &Path,
    scene: &Scene<'_>,
    drawing: &Drawing<'_>,
    snapshot: &Snapshot,
) -> Result<(), fem_vtk::Error> {
    let (mut displacement, mut velocity, mut pressure) = (Vec::new(), Vec::new(), Vec::new());
    let (mut cells, mut points) = (GridStress::default(), GridStress::default());
    let (mut plastic_strain, mut plastic_work) = (Vec::new(), Vec::new());
    let flows = snapshot.bodies.iter().any(|fields| !fields.plastic.is_empty());
    for ((side, mesh, material), recovery) in drawing.meshed().zip(&scene.recoveries) {
        let fields = &snapshot.bodies[side];
        displacement.extend(pad_vectors(snapshot.displacement(side).as_flattened()));
        let velocities = pad_vectors(fields.velocity.as_flattened());
        velocity.extend(velocities.into_iter().map(|value| value as f32));
        pressure.extend(contact_pressure(snapshot, side, mesh));
        let stress = recovery.stress(material, fields, Some(&snapshot.contact));
        append_stress(&mut cells, &stress.cells);
        append_stress(&mut points, &stress.points);
        let none = [0.0; 2];
        let n_cells = if flows { mesh.quads().len() } else { 0 };
        for element in 0..n_cells {
            let [strain, work] = *fields.plastic.get(element).unwrap_or(&none);
            plastic_strain.push(strain as f32);
            plastic_work.push(work as f32);
        }
    }
    let mut writer = VtuWriter::on(&scene.grid).time(snapshot.time);
    let wants = |field: Field| scene.case.wants_field(field);
    if wants(Field::Displacement) {
        writer = writer.point_data(Field::Displacement.word(), 3, &displacement);
    }
    if wants(Field::Velocity) {
        writer = writer.point_data(Field::Velocity.word(), 3, &velocity);
    }
    for (k, field) in STRESSES.into_iter().enumerate().filter(|(_, field)| wants(*field)) {
        let name = field.word();
        writer = writer.point_data(name, 1, &points[k]).cell_data(name, 1, &cells[k]);
    }
    if wants(Field::ContactPressure) {
        writer = writer.point_data(Field::ContactPressure.word(), 1, &pressure);
    }
    for (field, values) in
        [(Field::PlasticStrain, &plastic_strain), (Field::PlasticWork, &plastic_work)]
    {
        if flows && wants(field) {
            writer = writer.cell_data(field.word(), 1, values);
        }
    }
    writer
        .point_data("body", 1, &scene.arrays.body_of_points)
        .cell_data("body", 1, &scene.arrays.body)
        .write(path)
}

/// Returns the contact pressure (Pa) at the nodes of a body: the profile's at surface nodes, 0 at all others.
fn contact_pressure(snapshot: &Snapshot, side: usize, mesh: &SphereMesh) -> Vec<f32> {
    let mut pressures = vec![0.0; mesh.nodes().len()];
    let places = &snapshot.contact.places;
    // Bodies at finite strain store their stress, and their profile is over the deformed positions.
    let is_moved = !snapshot.bodies[side].stress.is_empty();
    for &node in mesh.surface() {
        let node = node as usize;
        let moved = if is_moved { snapshot.bodies[side].displacement[node][0] } else { 0.0 };
        let radius = mesh.nodes()[node][0] + moved;
        if places.last().is_none_or(|last| last.radius < radius) {
            break;
        }
        pressures[node] = snapshot.contact.pressure_at(radius) as f32;
    }
    pressures
}

fn append_stress(arrays: &mut GridStress, stresses: &[[f64; 4]]) {
    for stress in stresses {
        let (pressure, von_mises) = invariants(*stress);
        let [rr, yy, tt, ry] = *stress;
        for (array, value) in arrays.iter_mut().zip([yy, rr, tt, ry, pressure, von_mises]) {
            array.push(value as f32);
        }
    }
}

impl GridArrays {
    /// Returns the arrays with reference positions (r, y, 0), half of the start gap between each body and y = 0.
    fn of(drawing: &Drawing<'_>) -> Self {
        let (points, quads) = (Vec::new(), Vec::new());
        let mut arrays = Self { points, quads, body: Vec::new(), body_of_points: Vec::new() };
        for (side, mesh, _) in drawing.meshed() {
            let shift = if side == 0 { -0.5 * drawing.gap } else { 0.5 * drawing.gap };
            let first = arrays.points.len() as u32;
            arrays.points.extend(mesh.nodes().iter().map(|[r, y]| [*r, y + shift, 0.0]));
            arrays.quads.extend(mesh.quads().iter().map(|quad| quad.map(|node| first + node)));
            arrays.body.extend(mesh.quads().iter().map(|_| side as i32));
            arrays.body_of_points.extend(mesh.nodes().iter().map(|_| side as i32));
        }
        arrays
    }
}

/// Snapshots in the order of time, each with the label of its files.
pub(super) struct Shown<'a> {
    pub snapshots: Vec<(&'a Snapshot, &'static str)>,
    /// Warnings about snapshots that are left out.
    pub warnings: Vec<String>,
}

/// Returns the snapshots to be written: without a last contact of an incomplete run, and without a second one of the same
/// instant, which viewers would draw on top of the first.
pub(super) fn shown<'a>(simulation: &Simulation, collision: &'a Collision) -> Shown<'a> {
    let request = &simulation.request().snapshots;
    let mut shown = Shown { snapshots: Vec::new(), warnings: Vec::new() };
    let asks_for_unloaded = matches!(request, SnapshotRequest::Labels(labels)
        if labels.contains(&SnapshotInstant::AfterSeparation));
    let unloaded = collision.unloaded.iter().filter(|_| asks_for_unloaded);
    if asks_for_unloaded && collision.unloaded.is_none() {
        shown.warnings.push(did_not_occur(SnapshotInstant::AfterSeparation));
    }
    for snapshot in collision.snapshots.iter().chain(unloaded) {
        let label = label(snapshot, request);
        if snapshot.label == Some(SnapshotInstant::LastContact) && !collision.is_complete() {
            let warning = format!("the run ended before the instant \"{label}\"; it is left out");
            shown.warnings.push(warning);
            continue;
        }
        if let Some((before, earlier)) = shown.snapshots.last()
            && snapshot.time <= before.time
        {
            shown.warnings.push(format!(
                "the snapshot \"{label}\" is of the same instant as \"{earlier}\"; it is left out"
            ));
            continue;
        }
        shown.snapshots.push((snapshot, label));
    }
    shown
}

fn label(snapshot: &Snapshot, request: &SnapshotRequest) -> &'static str {
    match (snapshot.label, request) {
        (Some(label), _) => label.name(),
        (None, SnapshotRequest::Times(_)) => "time",
        (None, _) => "even",
    }
}
