//! Tables on stdout: columns of aligned text, wrapped to the width of a terminal.

use comfy_table::CellAlignment::{self, Left, Right};
use comfy_table::{ContentArrangement, Row, Table};
use fem_case::Scene;
use fem_case::engineering::show;
use fem_mesh::{Quality, SphereMesh};
use indicatif::HumanCount;

/// A table without lines, and the alignment of its columns; the last one wraps.
pub fn table<R: Into<Row>>(
    alignment: &[CellAlignment],
    rows: impl IntoIterator<Item = R>,
) -> String {
    let mut table = Table::new();
    table.load_style(comfy_table::presets::NOTHING);
    table.set_content_arrangement(ContentArrangement::Dynamic);
    table.add_rows(rows);
    for (column, alignment) in table.column_iter_mut().zip(alignment) {
        column.set_cell_alignment(*alignment);
        column.set_padding((0, 2));
    }
    table.trim_fmt() + "\n"
}

/// Two columns: what it is, and its value.
pub fn pairs<const N: usize>(rows: [(&str, String); N]) -> String {
    table(&[Left, Left], rows.map(|(name, value)| [name.to_string(), value]))
}

/// A parameter's value with its unit.
pub fn show_value(value: f64, unit: &str) -> String {
    let takes_prefix = ["s", "m/s"].contains(&unit);
    if takes_prefix {
        show(value, unit)
    } else if (0.01..1e5).contains(&value.abs()) || value == 0.0 {
        let digits = (3 - value.abs().max(1e-9).log10().floor() as i32).clamp(0, 6) as usize;
        format!("{value:.digits$} {unit}").trim_end().to_string()
    } else {
        format!("{value:.4e} {unit}").trim_end().to_string()
    }
}

/// Size and quality of each mesh; a rigid body has none.
pub fn mesh_table(scene: &Scene, meshes: [Option<&SphereMesh>; 2]) -> String {
    let header =
        ["body", "elements", "nodes", "smallest scaled Jacobian", "largest aspect", "edges"];
    let row = |name: &str, mesh: Option<&SphereMesh>| {
        let Some(mesh) = mesh else {
            return [name, "-", "-", "-", "-", "rigid"].map(String::from);
        };
        let quality = Quality::of(mesh);
        [
            name.to_string(),
            HumanCount(mesh.quads().len() as u64).to_string(),
            HumanCount(mesh.nodes().len() as u64).to_string(),
            format!("{:.3}", quality.min_scaled_jacobian),
            format!("{:.2}", quality.max_aspect_ratio),
            format!("{} to {}", show(quality.min_edge, "m"), show(quality.max_edge, "m")),
        ]
    };
    let bodies = scene.bodies().iter().zip(meshes);
    let rows = bodies.map(|(body, mesh)| row(body.name(), mesh));
    let rows = std::iter::once(header.map(String::from)).chain(rows);
    table(&[Left, Right, Right, Right, Right, Left], rows)
}
