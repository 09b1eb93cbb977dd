//! Colours, numbers and words.

use std::fmt::Write;

/// Colours that stay apart for colour-blind eyes (Okabe and Ito 2008), used in turn.
pub const COLOURS: [&str; 7] =
    ["#0072B2", "#D55E00", "#009E73", "#CC79A7", "#E69F00", "#56B4E9", "#000000"];
/// For what stands beside the data: a closed form, a limit.
pub const GREY: &str = "#555555";

/// Colours along a number, dark blue to yellow: samples of viridis (van der Walt and Smith 2015), even in
/// lightness and apart for colour-blind eyes; its light end, which paper does not show, is left out.
const SEQUENCE: [[u8; 3]; 7] = [
    [68, 1, 84],
    [70, 50, 127],
    [54, 92, 141],
    [39, 127, 142],
    [31, 161, 135],
    [74, 194, 109],
    [159, 218, 58],
];

/// `#rrggbb` of the k-th of n curves that a number tells apart: no two of them alike.
pub fn colour_along(k: usize, n: usize) -> String {
    let place = k as f64 / n.saturating_sub(1).max(1) as f64 * (SEQUENCE.len() - 1) as f64;
    let from = (place.floor() as usize).min(SEQUENCE.len() - 2);
    let share = (place - from as f64).clamp(0.0, 1.0);
    let channel = |c: usize| {
        let [a, b] = [SEQUENCE[from][c], SEQUENCE[from + 1][c]].map(f64::from);
        (a + share * (b - a)).round() as u8
    };
    format!("#{:02x}{:02x}{:02x}", channel(0), channel(1), channel(2))
}

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
    fn no_two_curves_along_a_number_are_alike() {
        for n in [1, 2, 8, 40] {
            let colours: std::collections::BTreeSet<String> =
                (0..n).map(|k| colour_along(k, n)).collect();
            assert_eq!(colours.len(), n);
        }
        assert_eq!((colour_along(0, 9), colour_along(8, 9)), ("#440154".into(), "#9fda3a".into()));
    }

    #[test]
    fn ticks_are_short() {
        for (value, expected) in
            [(0.1 + 0.2, "0.3"), (0.0, "0"), (1e-7, "1e-7"), (-2.5e8, "-2.5e8"), (1000.0, "1000")]
        {
            assert_eq!(tick(value), expected);
        }
    }
}
