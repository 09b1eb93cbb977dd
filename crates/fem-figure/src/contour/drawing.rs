//! Panels with bands, outlines, axes and a legend.

use std::fmt::Write;

use super::colours::band_colour;
use super::levels::Levels;
use super::region::{Cells, Region};
use super::section::Section;
use super::window::{PANEL_WIDTH, Window};
use crate::style::{FONT, GRID, INK, LETTER, number, words};

const LEFT: f64 = 68.0;
const TOP: f64 = 34.0;
const BOTTOM: f64 = 50.0;
const GAP: f64 = 18.0;
/// Smallest width of the legend; its heading may need more.
const LEGEND_WIDTH: f64 = 112.0;
const HEADING_SIZE: f64 = 14.0;
const SWATCH_WIDTH: f64 = 22.0;
/// Approximate number of intervals between ticks.
const N_TICKS: usize = 7;

/// The content of one window.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Panel {
    /// Title above the panel.
    pub title: String,
    /// The sections of the bodies.
    pub sections: Vec<Section>,
    /// Lines that a page can show over the bands of a frame, such as the mesh.
    pub lines: Vec<Vec<[f64; 2]>>,
}

/// Panels with a common window and scale, two in a row.
#[derive(Debug, Clone, PartialEq)]
pub struct Contour {
    /// The quantity with its unit, above the legend.
    pub quantity: String,
    /// Label of the horizontal axis, with its unit.
    pub x_label: String,
    /// Label of the vertical axis, with its unit.
    pub y_label: String,
    /// The visible range.
    pub window: Window,
    /// The limits of the bands.
    pub levels: Levels,
    /// The panels in reading order.
    pub panels: Vec<Panel>,
}

impl Contour {
    /// Draws all panels as a self-contained SVG document.
    pub fn svg(&self) -> String {
        let columns = self.panels.len().clamp(1, 2);
        let rows = self.panels.len().div_ceil(columns);
        let cell = [LEFT + PANEL_WIDTH + GAP, TOP + self.window.height() + BOTTOM];
        let heading = LETTER * HEADING_SIZE * (self.quantity.chars().count() + 2) as f64;
        let width = columns as f64 * cell[0] + LEGEND_WIDTH.max(heading);
        let height = rows as f64 * cell[1];
        let mut svg = format!(
            "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{width:.0}\" height=\"{height:.0}\" \
             viewBox=\"0 0 {width:.0} {height:.0}\" font-family=\"{FONT}\" font-size=\"13\" \
             fill=\"{INK}\">\n<rect width=\"100%\" height=\"100%\" fill=\"#fff\"/>\n\
             <clipPath id=\"panel\"><rect width=\"{PANEL_WIDTH}\" height=\"{:.1}\"/></clipPath>\n",
            self.window.height()
        );
        for (k, panel) in self.panels.iter().enumerate() {
            let (x, y) =
                ((k % columns) as f64 * cell[0] + LEFT, (k / columns) as f64 * cell[1] + TOP);
            let _ = writeln!(svg, "<g transform=\"translate({x:.1} {y:.1})\">");
            self.draw_panel(&mut svg, panel);
            svg += "</g>\n";
        }
        let _ = writeln!(svg, "<g transform=\"translate({:.1} {TOP})\">", columns as f64 * cell[0]);
        self.draw_legend(&mut svg, height - TOP - BOTTOM);
        svg += "</g>\n</svg>\n";
        svg
    }

    fn draw_panel(&self, svg: &mut String, panel: &Panel) {
        let height = self.window.height();
        let _ = writeln!(
            svg,
            "<text x=\"0\" y=\"-10\" font-size=\"14\">{}</text>\n<g clip-path=\"url(#panel)\">",
            words(&panel.title)
        );
        let Window { x, y } = self.window;
        for section in &panel.sections {
            self.draw_bands(svg, &section.within(x, y));
        }
        for section in &panel.sections {
            let points = section.outline_points();
            // A body without a field is rigid.
            let ground = if section.quads.is_empty() { GRID } else { "none" };
            let _ = writeln!(
                svg,
                "<path d=\"{}\" fill=\"{ground}\" stroke=\"{INK}\" stroke-width=\"1.1\"/>",
                self.window.line_path(points)
            );
        }
        svg.push_str("</g>\n");
        self.draw_axes(svg, height);
    }

    /// Draws the bands from the neutral one outward, each over the one before.
    fn draw_bands(&self, svg: &mut String, section: &Section) {
        bands(&self.levels, section, |band, region| {
            let data = self.window.region_path(&region);
            let colour = band_colour(self.levels.position(band));
            let _ = writeln!(svg, "<path fill=\"{colour}\" d=\"{data}\"/>");
        });
    }

    fn draw_axes(&self, svg: &mut String, height: f64) {
        let _ = writeln!(
            svg,
            "<rect width=\"{PANEL_WIDTH}\" height=\"{height:.1}\" fill=\"none\" stroke=\"{INK}\"/>"
        );
        let [across, up] = self.window.ticks(N_TICKS);
        for (x, number) in across {
            let _ = writeln!(
                svg,
                "<path d=\"M{x:.1} {height:.1}v5\" stroke=\"{INK}\"/><text x=\"{x:.1}\" \
                 y=\"{:.1}\" text-anchor=\"middle\">{number}</text>",
                height + 19.0
            );
        }
        for (y, number) in up {
            let _ = writeln!(
                svg,
                "<path d=\"M0 {y:.1}h-5\" stroke=\"{INK}\"/><text x=\"-9\" y=\"{:.1}\" \
                 text-anchor=\"end\">{number}</text>",
                y + 4.5
            );
        }
        let _ = writeln!(
            svg,
            "<text x=\"{:.1}\" y=\"{:.1}\" text-anchor=\"middle\">{}</text>\
             <text transform=\"translate(-53 {:.1}) rotate(-90)\" text-anchor=\"middle\">{}</text>",
            0.5 * PANEL_WIDTH,
            height + 38.0,
            words(&self.x_label),
            0.5 * height,
            words(&self.y_label)
        );
    }

    /// Draws the bands from the highest down, with numbers at their ends.
    fn draw_legend(&self, svg: &mut String, height: f64) {
        let edges = self.levels.edges();
        let n_bands = edges.len() - 1;
        let size = (height / n_bands as f64).min(34.0);
        let _ = writeln!(
            svg,
            "<text x=\"0\" y=\"-10\" font-size=\"{HEADING_SIZE}\">{}</text>",
            words(&self.quantity)
        );
        for band in 0..n_bands {
            let y = (n_bands - 1 - band) as f64 * size;
            let _ = writeln!(
                svg,
                "<rect y=\"{y:.1}\" width=\"{SWATCH_WIDTH}\" height=\"{size:.1}\" fill=\"{}\" \
                 stroke=\"{INK}\" stroke-width=\"0.5\"/>",
                band_colour(self.levels.position(band))
            );
        }
        for (k, edge) in edges.iter().enumerate() {
            let y = (n_bands - k) as f64 * size;
            let _ = writeln!(
                svg,
                "<text x=\"{:.1}\" y=\"{:.1}\">{}</text>",
                SWATCH_WIDTH + 8.0,
                y + 4.5,
                number(*edge)
            );
        }
    }
}

/// Visits the regions of all bands, from the neutral one outward, each to be drawn over those before.
pub(crate) fn bands(levels: &Levels, section: &Section, mut draw: impl FnMut(usize, Region)) {
    let (edges, neutral) = (levels.edges(), levels.neutral());
    let cells = Cells::of(section);
    let mut draw = |band: usize, region: Region| {
        if !region.loops.is_empty() {
            draw(band, region);
        }
    };
    draw(neutral, cells.at_most(f64::INFINITY));
    for band in (0..neutral).rev() {
        draw(band, cells.at_most(edges[band + 1]));
    }
    for band in neutral + 1..edges.len() - 1 {
        draw(band, cells.at_least(edges[band]));
    }
}
