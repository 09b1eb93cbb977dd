//! Panels side by side with one legend.

use kuva::backend::svg::SvgBackend;
use kuva::plot::legend::LegendEntry;
use kuva::prelude::Figure;

use crate::chart::Chart;

const PANEL_WIDTH: f64 = 480.0;
const PANEL_HEIGHT: f64 = 340.0;
/// Height of a legend entry.
const ENTRY_HEIGHT: f64 = 18.0;
/// Characters of the longest label per blank that is appended to it.
const LETTERS_A_BLANK: usize = 10;

/// Returns the number of legend entries that fit beside `n_charts` charts.
pub fn legend_room(n_charts: usize) -> usize {
    let n_rows = n_charts.max(1).div_ceil(n_columns(n_charts));
    (n_rows as f64 * PANEL_HEIGHT / ENTRY_HEIGHT) as usize - 1
}

fn n_columns(n_charts: usize) -> usize {
    if n_charts <= 1 { 1 } else { 2 }
}

/// Draws the charts, two in a row, as one SVG document; `None` if there is no point to draw.
///
/// Curves of the same name share a legend entry.
pub fn svg(charts: &[Chart]) -> Option<String> {
    let charts: Vec<&Chart> = charts.iter().filter(|chart| !chart.is_empty()).collect();
    if charts.is_empty() {
        return None;
    }
    let room = legend_room(charts.len());
    let mut legend: Vec<LegendEntry> = Vec::new();
    for entry in charts.iter().flat_map(|chart| chart.legend()) {
        let is_known = legend.iter().any(|known| known.label == entry.label);
        if !is_known && legend.len() < room {
            legend.push(entry);
        }
    }
    // kuva sizes the box for a smaller font than it draws, so the longest label is padded.
    if let Some(longest) = legend.iter_mut().max_by_key(|entry| entry.label.chars().count()) {
        let n_blanks = longest.label.chars().count() / LETTERS_A_BLANK;
        longest.label.push_str(&"\u{2002}".repeat(n_blanks));
    }
    let columns = n_columns(charts.len());
    let (plots, layouts): (Vec<_>, Vec<_>) = charts.iter().map(|chart| chart.draw()).unzip();
    let mut figure = Figure::new(charts.len().div_ceil(columns), columns)
        .with_plots(plots)
        .with_layouts(layouts)
        .with_cell_size(PANEL_WIDTH, PANEL_HEIGHT);
    if !legend.is_empty() {
        figure = figure.with_shared_legend().with_shared_legend_entries(legend);
    }
    Some(renumber(&SvgBackend::new().render_scene(&figure.render())) + "\n")
}

/// Numbers the clip paths from 0. kuva continues their numbers from one picture of a process to the next;
/// the same picture must have the same bytes.
fn renumber(svg: &str) -> String {
    const CLIP: &str = "kuva-clip-";
    let mut parts = svg.split(CLIP);
    let mut text = parts.next().unwrap_or_default().to_string();
    let mut known: Vec<&str> = Vec::new();
    for part in parts {
        let end = part.find(|c: char| !c.is_ascii_digit()).unwrap_or(part.len());
        let (number, rest) = part.split_at(end);
        let index = known.iter().position(|other| *other == number).unwrap_or_else(|| {
            known.push(number);
            known.len() - 1
        });
        text += &format!("{CLIP}{index}{rest}");
    }
    text
}
