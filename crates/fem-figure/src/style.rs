//! Colours, numbers and words.

use std::fmt::Write;

/// Colours that stay apart for colour-blind eyes (Okabe and Ito 2008), used in turn.
pub const COLOURS: [&str; 7] =
    ["#0072B2", "#D55E00", "#009E73", "#CC79A7", "#E69F00", "#56B4E9", "#000000"];
/// For what stands beside the data: a closed form, a limit.
pub const GREY: &str = "#555555";

/// A tick's number: as short as it can be said, rounding errors left out.
pub fn tick(value: f64) -> String {
    let rounded: f64 = format!("{value:.9e}").parse().unwrap_or(value);
    let size = rounded.abs();
    if size == 0.0 || (1e-4..1e6).contains(&size) {
        rounded.to_string()
    } else {
        format!("{rounded:e}")
    }
}

/// Text and lines.
pub(crate) const INK: &str = "#1c2126";
/// Text and lines of less weight, and lines behind the data.
pub(crate) const DIM: &str = "#5a626b";
pub(crate) const GRID: &str = "#dfe3e8";
/// Fonts of what is drawn here.
pub(crate) const FONT: &str = "DejaVu Sans, Arial, Helvetica, sans-serif";

/// Text that is safe in SVG.
fn escaped(text: &str) -> String {
    text.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;").replace('"', "&quot;")
}

/// With a true minus sign.
pub(crate) fn number(value: f64) -> String {
    tick(value).replace('-', "\u{2212}")
}

/// Text for SVG; letters after `_` are set below the line.
pub(crate) fn words(text: &str) -> String {
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
            "<tspan dy=\"3.5\" font-size=\"0.75em\">{}</tspan><tspan dx=\"{gap}\" \
             dy=\"-3.5\">{rest}</tspan>",
            escaped(below)
        );
    }
    words
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ticks_are_short() {
        for (value, expected) in
            [(0.1 + 0.2, "0.3"), (0.0, "0"), (1e-7, "1e-7"), (-2.5e8, "-2.5e8"), (1000.0, "1000")]
        {
            assert_eq!(tick(value), expected);
        }
    }
}
