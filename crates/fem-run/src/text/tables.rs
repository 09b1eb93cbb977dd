//! Tables on stdout: aligned columns of text, wrapped to the width of the terminal.

use comfy_table::CellAlignment::{self, Left, Right};
use comfy_table::{ContentArrangement, Row, Table};
use fem_case::Scene;
use fem_case::engineering::show;
use fem_mesh::{Quality, SphereMesh};
use indicatif::HumanCount;

/// Returns a table without lines; long cells of the last column wrap.
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

/// Returns such a table below a header, whose cells `|` separates; `>` begins a column with numbers on the right.
pub fn headed<R: Into<Row>>(header: &str, rows: impl IntoIterator<Item = R>) -> String {
    let columns = header.split('|');
    let alignment: Vec<CellAlignment> =
        columns.clone().map(|name| if name.starts_with('>') { Right } else { Left }).collect();
    let names = Row::from(columns.map(|name| name.trim_start_matches('>')));
    table(&alignment, std::iter::once(names).chain(rows.into_iter().map(Into::into)))
}

pub fn pairs<const N: usize>(rows: [(&str, String); N]) -> String {
    table(&[Left, Left], rows.map(|(name, value)| [name.to_string(), value]))
}

pub fn show_value(value: f64, unit: &str) -> String {
    if ["s", "m/s"].contains(&unit) {
        show(value, unit)
    } else if (0.01..1e5).contains(&value.abs()) || value == 0.0 {
        let digits = (3 - value.abs().max(1e-9).log10().floor() as i32).clamp(0, 6) as usize;
        format!("{value:.digits$} {unit}").trim_end().to_string()
    } else {
        format!("{value:.4e} {unit}").trim_end().to_string()
    }
}

/// Returns the size and the quality of both meshes; a rigid body has none.
pub fn mesh_table(scene: &Scene, meshes: [Option<&SphereMesh>; 2]) -> String {
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
    headed(
        "body|>elements|>nodes|>smallest scaled Jacobian|>largest aspect ratio|edge lengths",
        rows,
    )
}
