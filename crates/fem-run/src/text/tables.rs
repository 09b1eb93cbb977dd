//! Tables on stdout: aligned columns of text, wrapped to the width of the terminal.

use comfy_table::CellAlignment::{self, Left, Right};
use comfy_table::{ColumnConstraint, ContentArrangement, Row, Table, Width};
use fem::fit::cradle::Measured;
use fem_case::Scene;
use fem_case::engineering::{show, takes_prefix};
use fem_mesh::{Quality, SphereMesh};
use fem_report::number_text::with_error;
use indicatif::HumanCount;
use textwrap::{Options, WordSeparator, WordSplitter};

/// Longest cells, in characters, that do not wrap where there is room.
const SHORT: usize = 28;
/// Blanks between two columns.
const GAP: u16 = 2;

/// Returns a table without lines; on a terminal long cells wrap between words.
pub fn table<R: Into<Row>>(
    alignment: &[CellAlignment],
    rows: impl IntoIterator<Item = R>,
) -> String {
    laid_out(Table::new(), alignment, rows)
}

fn laid_out<R: Into<Row>>(
    mut table: Table,
    alignment: &[CellAlignment],
    rows: impl IntoIterator<Item = R>,
) -> String {
    table.load_style(comfy_table::presets::NOTHING);
    table.set_content_arrangement(ContentArrangement::Dynamic);
    table.add_rows(rows);
    // The widths of the longest words, below which a column would break one, and those at which short cells do not wrap.
    let mut widths = vec![[0, 0]; alignment.len()];
    for row in table.row_iter() {
        for ([word, cell], own) in widths.iter_mut().zip(row.cell_iter()) {
            let text = own.content();
            let words = text.split_whitespace().map(|word| word.chars().count());
            *word = words.fold(*word, usize::max);
            *cell = text.chars().count().max(*cell);
        }
    }
    let unwrapped = |[word, cell]: &[usize; 2]| if *cell <= SHORT { *cell } else { *word };
    let gaps = usize::from(GAP) * widths.len().saturating_sub(1);
    let width = widths.iter().map(unwrapped).sum::<usize>() + gaps;
    let last = widths.len().saturating_sub(1);
    let fits = table.width().is_none_or(|available| width <= usize::from(available));
    let widths = widths.iter().map(|width| if fits { unwrapped(width) } else { width[0] });
    let columns = table.column_iter_mut().zip(alignment).zip(widths);
    for (k, ((column, alignment), width)) in columns.enumerate() {
        let gap = if k == last { 0 } else { GAP };
        column.set_cell_alignment(*alignment);
        column.set_padding((0, gap));
        let width = u16::try_from(width).unwrap_or(u16::MAX).saturating_add(gap);
        column.set_constraint(ColumnConstraint::LowerBoundary(Width::Fixed(width)));
    }
    table.trim_fmt() + "\n"
}

/// Returns a text whose lines break between words at the width of a small terminal.
pub fn wrapped(text: &str) -> String {
    wrapped_at(80, "", text)
}

/// Returns a text whose lines break between words at the width of the terminal, if there is one, and are indented where one goes on.
pub fn hanging(text: &str) -> String {
    let Some(width) = Table::new().width().map(usize::from) else { return text.to_string() };
    text.split_inclusive('\n').map(|line| wrapped_at(width, "    ", line)).collect()
}

/// Returns a text whose lines have at most this width where words allow it.
pub fn wrapped_at(width: usize, indent: &str, text: &str) -> String {
    let options = Options::new(width).subsequent_indent(indent).break_words(false);
    let options = options.word_separator(WordSeparator::AsciiSpace);
    textwrap::fill(text, options.word_splitter(WordSplitter::NoHyphenation))
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
    if takes_prefix(unit) {
        show(value, unit)
    } else if (0.01..1e5).contains(&value.abs()) || value == 0.0 {
        let digits = (3 - value.abs().max(1e-9).log10().floor() as i32).clamp(0, 6) as usize;
        format!("{value:.digits$} {unit}").trim_end().to_string()
    } else {
        format!("{value:.4e} {unit}").trim_end().to_string()
    }
}

/// Returns `0.9250 ± 0.0031`, with two digits of the uncertainty where the value has no more than six.
pub fn show_measured(Measured { value, uncertainty }: Measured, unit: &str) -> String {
    if uncertainty <= 0.0 {
        return format!("{value:.4} {unit}").trim_end().to_string();
    }
    format!("{} {unit}", with_error(value, Some(uncertainty))).trim_end().to_string()
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

#[cfg(test)]
mod tests {
    use super::*;

    /// A table that is wider than the terminal breaks between words, and is wider than it rather than breaking one.
    #[test]
    fn narrow_tables_break_between_words() {
        let header = ["code", "model", "input", "gives e", "valid from, to", "worst error", "file"];
        let row = [
            "MercuryDPM",
            "LinearViscoelasticSpecies",
            "stiffness 1.2345e5, dissipation 0.12345",
            "depends on v",
            "158.1 mm/s to 1.581 m/s",
            "0.0123",
            "lammps_coeff_restitution.in",
        ];
        for width in [80, 100, 120] {
            let mut narrow = Table::new();
            narrow.set_width(width);
            let text = laid_out(narrow, &[Left; 7], [header, row]);
            let found: Vec<&str> = text.split_whitespace().collect();
            for word in header.iter().chain(&row).flat_map(|cell| cell.split_whitespace()) {
                assert!(found.contains(&word), "{word} at {width}:\n{text}");
            }
        }
    }
}
