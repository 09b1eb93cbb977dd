//! Single panels for a page that shows them in turn and restyles them by classes.
//!
//! The sections of a frame are half sections, r ≥ 0, and are drawn with their mirror images. Bands have the
//! classes `.b0` (neutral), `.n1`, `.n2` … below and `.p1`, `.p2` … above zero; text and lines have those
//! of [`panel`](crate::panel). The lines of a panel have the class `.mesh` and are hidden unless a page shows them.

use std::fmt::Write;

use super::colours::{band_colour, dark_band_colour};
use super::drawing::{Contour, Panel, bands};
use super::levels::Levels;
use super::window::{PANEL_WIDTH, Window};
use crate::style::{DIM, FONT, GRID, INK, LETTER, number, words};

const LEFT: f64 = 60.0;
const RIGHT: f64 = 14.0;
const TOP: f64 = 8.0;
const BOTTOM: f64 = 40.0;
const FONT_SIZE: f64 = 12.5;
/// Most intervals between ticks.
const N_TICKS: usize = 9;
const BAR_HEIGHT: f64 = 12.0;
/// Most numbers on a bar.
const MAX_NUMBERS: usize = 9;

impl Contour {
    /// Draws each panel of half sections as a picture.
    pub fn frames(&self) -> Vec<String> {
        self.panels.iter().map(|panel| self.frame(panel)).collect()
    }

    /// Draws one panel.
    pub fn frame(&self, panel: &Panel) -> String {
        let height = self.window.height();
        let (width, whole) = (LEFT + PANEL_WIDTH + RIGHT, TOP + height + BOTTOM);
        let mut svg = format!(
            "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {width} {whole:.1}\" \
             width=\"{width}\" height=\"{whole:.1}\" font-family=\"{FONT}\" \
             font-size=\"{FONT_SIZE}\" role=\"img\">\n<title>{}</title>\n<svg x=\"{LEFT}\" \
             y=\"{TOP}\" width=\"{PANEL_WIDTH}\" height=\"{height:.1}\" overflow=\"hidden\">\n",
            words(&panel.title)
        );
        let Window { x, y } = self.window;
        for section in &panel.sections {
            bands(&self.levels, &section.within(x, y), |band, region| {
                let data = self.window.region_path(&region.mirrored());
                let _ = writeln!(svg, "<path {} d=\"{data}\"/>", fill(&self.levels, band));
            });
        }
        if !panel.lines.is_empty() {
            let lines = panel.lines.iter().map(|line| self.window.line_path(line.iter().copied()));
            let _ = writeln!(
                svg,
                "<path class=\"mesh\" visibility=\"hidden\" stroke=\"{DIM}\" stroke-width=\"0.5\" \
                 fill=\"none\" d=\"{}\"/>",
                lines.collect::<String>()
            );
        }
        for section in &panel.sections {
            let half: Vec<[f64; 2]> = section.outline_points().collect();
            let image: Vec<[f64; 2]> = half.iter().rev().map(|[r, y]| [-r, *y]).collect();
            // A body without a field is rigid.
            let (class, ground) = match section.quads.is_empty() {
                true => ("rigid ink", GRID),
                false => ("ink", "none"),
            };
            let _ = writeln!(
                svg,
                "<path class=\"{class} stroke\" stroke=\"{INK}\" stroke-width=\"1.1\" \
                 fill=\"{ground}\" d=\"{}\"/>",
                self.window.line_path(image.into_iter().chain(half))
            );
        }
        svg += "</svg>\n";
        self.draw_frame_axes(&mut svg, height);
        svg += "</svg>\n";
        svg
    }

    fn draw_frame_axes(&self, svg: &mut String, height: f64) {
        let _ = writeln!(
            svg,
            "<g transform=\"translate({LEFT} {TOP})\" fill=\"{DIM}\" class=\"dim\">\n<rect \
             class=\"dim stroke\" width=\"{PANEL_WIDTH}\" height=\"{height:.1}\" fill=\"none\" \
             stroke=\"{DIM}\"/>"
        );
        let [across, up] = self.window.ticks(N_TICKS);
        for (x, number) in across {
            let (end, base) = (height + 4.0, height + 18.0);
            let _ = writeln!(
                svg,
                "<path class=\"dim stroke\" stroke=\"{DIM}\" d=\"M{x:.1} {height:.1}V{end:.1}\"/>\
                 <text x=\"{x:.1}\" y=\"{base:.1}\" text-anchor=\"middle\">{number}</text>"
            );
        }
        for (y, number) in up {
            let base = y + 4.3;
            let _ = writeln!(
                svg,
                "<path class=\"dim stroke\" stroke=\"{DIM}\" d=\"M0 {y:.1}h-4\"/><text x=\"-8\" \
                 y=\"{base:.1}\" text-anchor=\"end\">{number}</text>"
            );
        }
        let (x, y) = (words(&self.x_label), words(&self.y_label));
        let _ = writeln!(
            svg,
            "<text x=\"{PANEL_WIDTH}\" y=\"{:.1}\" text-anchor=\"end\">{x}</text><text \
             transform=\"translate(-48 {:.1}) rotate(-90)\" text-anchor=\"middle\">{y}</text>\n</g>",
            height + 34.0,
            0.5 * height
        );
    }

    /// Draws the colour scale of all frames as a bar.
    pub fn bar(&self) -> String {
        let edges = self.levels.edges();
        let n_bands = edges.len() - 1;
        let (width, size) = (LEFT + PANEL_WIDTH + RIGHT, PANEL_WIDTH / n_bands as f64);
        let mut svg = format!(
            "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {width} 56\" \
             width=\"{width}\" height=\"56\" font-family=\"{FONT}\" font-size=\"{FONT_SIZE}\">\n\
             <text class=\"ink\" fill=\"{INK}\" x=\"{LEFT}\" y=\"14\" \
             font-weight=\"600\">{}</text>\n",
            words(&self.quantity)
        );
        for band in 0..n_bands {
            let x = LEFT + band as f64 * size;
            let _ = writeln!(
                svg,
                "<rect {} x=\"{x:.2}\" y=\"22\" width=\"{size:.2}\" height=\"{BAR_HEIGHT}\"/>",
                fill(&self.levels, band)
            );
        }
        let stride = edges.len().div_ceil(MAX_NUMBERS);
        // Counted from zero, which is between the edges of the neutral band.
        let first = self.levels.neutral() % stride;
        for (k, edge) in edges.iter().enumerate().skip(first).step_by(stride) {
            let text = number(*edge);
            // The number stays within the picture.
            let reach = 0.5 * LETTER * FONT_SIZE * text.chars().count() as f64;
            let x = (LEFT + k as f64 * size).min(width - reach);
            let _ = writeln!(
                svg,
                "<text class=\"dim\" fill=\"{DIM}\" x=\"{x:.1}\" y=\"50\" \
                 text-anchor=\"middle\">{text}</text>"
            );
        }
        svg += "</svg>\n";
        svg
    }

    /// Returns style rules for a dark ground, on which values far from zero are light.
    pub fn dark_rules(&self) -> String {
        let n_bands = self.levels.edges().len() - 1;
        let rule = |band: usize| {
            let colour = dark_band_colour(self.levels.position(band));
            format!(".{}{{fill:{colour}}}", class(&self.levels, band))
        };
        (0..n_bands).map(rule).collect()
    }
}

fn class(levels: &Levels, band: usize) -> String {
    let neutral = levels.neutral();
    match band.cmp(&neutral) {
        std::cmp::Ordering::Less => format!("n{}", neutral - band),
        std::cmp::Ordering::Equal => "b0".to_string(),
        std::cmp::Ordering::Greater => format!("p{}", band - neutral),
    }
}

fn fill(levels: &Levels, band: usize) -> String {
    let colour = band_colour(levels.position(band));
    format!("class=\"{}\" fill=\"{colour}\"", class(levels, band))
}
