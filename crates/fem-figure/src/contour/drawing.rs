//! Panels with bands, outlines, axes and a legend.

use std::fmt::Write;

use super::colours::band_colour;
use super::levels::Levels;
use super::paths;
use super::region::Region;
use super::section::Section;
use super::window::{PANEL_WIDTH, Window};
use crate::style::{FONT, escaped, tick};

const LEFT: f64 = 62.0;
const TOP: f64 = 34.0;
const BOTTOM: f64 = 50.0;
const GAP: f64 = 18.0;
const LEGEND_WIDTH: f64 = 112.0;
const SWATCH_WIDTH: f64 = 22.0;
/// Intervals between ticks, about.
const N_TICKS: usize = 7;
const INK: &str = "#1c2126";

/// What is drawn in one window.
#[derive(Debug, Clone, PartialEq)]
pub struct Panel {
    /// Above the panel.
    pub title: String,
    /// The bodies.
    pub sections: Vec<Section>,
}

/// Panels of one window and one scale, two in a row.
#[derive(Debug, Clone, PartialEq)]
pub struct Contour {
    /// What is drawn, with its unit: above the legend.
    pub quantity: String,
    /// Label of the horizontal axis, with its unit.
    pub x_label: String,
    /// Label of the vertical axis, with its unit.
    pub y_label: String,
    /// What is seen.
    pub window: Window,
    /// Where bands begin and end.
    pub levels: Levels,
    /// In the order of reading.
    pub panels: Vec<Panel>,
}

impl Contour {
    /// A self-contained SVG document.
    pub fn svg(&self) -> String {
        let columns = self.panels.len().clamp(1, 2);
        let rows = self.panels.len().div_ceil(columns);
        let cell = [LEFT + PANEL_WIDTH + GAP, TOP + self.window.height() + BOTTOM];
        let width = columns as f64 * cell[0] + LEGEND_WIDTH;
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
            let points = section.outline.iter().map(|point| section.points[*point as usize]);
            let _ = writeln!(
                svg,
                "<path d=\"{}\" fill=\"none\" stroke=\"{INK}\" stroke-width=\"1.1\"/>",
                paths::of_line(points, &self.window)
            );
        }
        svg.push_str("</g>\n");
        self.draw_axes(svg, height);
    }

    /// From the neutral band outward, each region over the one before.
    fn draw_bands(&self, svg: &mut String, section: &Section) {
        let (edges, neutral) = (self.levels.edges(), self.levels.neutral());
        let mut draw = |band: usize, region: Region| {
            if !region.loops.is_empty() {
                let data = paths::of_region(&region, &self.window);
                let _ = writeln!(svg, "<path fill=\"{}\" d=\"{data}\"/>", self.colour(band));
            }
        };
        draw(neutral, Region::whole(section));
        for band in (0..neutral).rev() {
            draw(band, Region::at_most(section, edges[band + 1]));
        }
        for band in neutral + 1..edges.len() - 1 {
            draw(band, Region::at_least(section, edges[band]));
        }
    }

    /// Of a band, by its distance from the neutral one.
    fn colour(&self, band: usize) -> String {
        let neutral = self.levels.neutral() as f64;
        let n_bands = self.levels.edges().len() as f64 - 1.0;
        let largest = neutral.max(n_bands - 1.0 - neutral).max(1.0);
        band_colour((band as f64 - neutral) / largest)
    }

    fn draw_axes(&self, svg: &mut String, height: f64) {
        let _ = writeln!(
            svg,
            "<rect width=\"{PANEL_WIDTH}\" height=\"{height:.1}\" fill=\"none\" stroke=\"{INK}\"/>"
        );
        let ticks = |(from, to): (f64, f64)| {
            let step = Levels::about_zero(0.0, to - from, N_TICKS).step();
            let (first, last) = ((from / step).ceil() as i64, (to / step).floor() as i64);
            (first..=last).map(move |k| k as f64 * step)
        };
        for value in ticks(self.window.x) {
            let [x, _] = self.window.place([value, 0.0]);
            let _ = writeln!(
                svg,
                "<path d=\"M{x:.1} {height:.1}v5\" stroke=\"{INK}\"/><text x=\"{x:.1}\" \
                 y=\"{:.1}\" text-anchor=\"middle\">{}</text>",
                height + 19.0,
                number(value)
            );
        }
        for value in ticks(self.window.y) {
            let [_, y] = self.window.place([0.0, value]);
            let _ = writeln!(
                svg,
                "<path d=\"M0 {y:.1}h-5\" stroke=\"{INK}\"/><text x=\"-9\" y=\"{:.1}\" \
                 text-anchor=\"end\">{}</text>",
                y + 4.5,
                number(value)
            );
        }
        let _ = writeln!(
            svg,
            "<text x=\"{:.1}\" y=\"{:.1}\" text-anchor=\"middle\">{}</text>\
             <text transform=\"translate(-44 {:.1}) rotate(-90)\" text-anchor=\"middle\">{}</text>",
            0.5 * PANEL_WIDTH,
            height + 38.0,
            words(&self.x_label),
            0.5 * height,
            words(&self.y_label)
        );
    }

    /// Bands from the highest down, with numbers at their ends.
    fn draw_legend(&self, svg: &mut String, height: f64) {
        let edges = self.levels.edges();
        let n_bands = edges.len() - 1;
        let size = (height / n_bands as f64).min(34.0);
        let _ = writeln!(
            svg,
            "<text x=\"0\" y=\"-10\" font-size=\"14\">{}</text>",
            words(&self.quantity)
        );
        for band in 0..n_bands {
            let y = (n_bands - 1 - band) as f64 * size;
            let _ = writeln!(
                svg,
                "<rect y=\"{y:.1}\" width=\"{SWATCH_WIDTH}\" height=\"{size:.1}\" fill=\"{}\" \
                 stroke=\"{INK}\" stroke-width=\"0.5\"/>",
                self.colour(band)
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

/// With a true minus sign.
fn number(value: f64) -> String {
    tick(value).replace('-', "\u{2212}")
}

/// Text for SVG; letters after `_` are set below the line.
fn words(text: &str) -> String {
    let mut parts = text.split('_');
    let mut words = escaped(parts.next().unwrap_or_default());
    for part in parts {
        let end = part.find(|c: char| !c.is_alphanumeric()).unwrap_or(part.len());
        let (below, rest) = part.split_at(end);
        // A first space in a span is dropped; an empty span would not bring the line back up.
        let (gap, rest) = rest.strip_prefix(' ').map_or((0, rest), |rest| (4, rest));
        let rest = if rest.is_empty() { "\u{200b}".to_string() } else { escaped(rest) };
        let _ = write!(
            words,
            "<tspan dy=\"3.5\" font-size=\"75%\">{}</tspan><tspan dx=\"{gap}\" \
             dy=\"-3.5\">{rest}</tspan>",
            escaped(below)
        );
    }
    words
}
