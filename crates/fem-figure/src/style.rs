//! Colours, numbers and text.

use std::fmt::Write;

/// Colours that colour-blind readers can distinguish (Okabe and Ito 2008), used in turn.
pub const COLOURS: [&str; 7] =
    ["#0072B2", "#D55E00", "#009E73", "#CC79A7", "#E69F00", "#56B4E9", "#000000"];
/// The colour of references: closed forms and limits.
pub const GREY: &str = "#555555";

/// Samples of the colour map viridis (van der Walt and Smith 2015), dark blue to green, even in lightness
/// and distinguishable for colour-blind readers, without its light end, which is faint on paper.
const SEQUENCE: [[u8; 3]; 7] = [
    [68, 1, 84],
    [70, 50, 127],
    [54, 92, 141],
    [39, 127, 142],
    [31, 161, 135],
    [74, 194, 109],
    [159, 218, 58],
];

/// Returns the colour `#rrggbb` of the k-th of n curves that a number distinguishes; no two are equal.
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

/// Returns the number of a tick in its shortest form, without rounding errors.
pub fn tick(value: f64) -> String {
    let rounded = rounded(value);
    let size = rounded.abs();
    if size == 0.0 || (1e-4..1e6).contains(&size) {
        rounded.to_string()
    } else {
        format!("{rounded:e}")
    }
}

/// Removes rounding errors.
fn rounded(value: f64) -> f64 {
    format!("{value:.9e}").parse().unwrap_or(value)
}

/// The colour of text and lines.
pub(crate) const INK: &str = "#1c2126";
/// The colour of secondary text and lines.
pub(crate) const DIM: &str = "#5a626b";
pub(crate) const GRID: &str = "#dfe3e8";
pub(crate) const FONT: &str = "DejaVu Sans, Arial, Helvetica, sans-serif";

/// Approximate width of a character over the font size.
pub(crate) const LETTER: f64 = 0.56;

/// Escapes text for SVG and HTML.
pub fn escaped(text: &str) -> String {
    text.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;").replace('"', "&quot;")
}

/// Returns the number of a tick with a true minus sign.
pub(crate) fn number(value: f64) -> String {
    tick(value).replace('-', "\u{2212}")
}

/// Longest subscript of a symbol.
const LONGEST_BELOW: usize = 3;

/// Returns text for SVG. Characters after the `_` of a symbol of one letter, p_0 or σ_yy, become a
/// subscript; names such as glass_on_wall are unchanged.
pub(crate) fn words(text: &str) -> String {
    let mut words = String::new();
    let mut rest = text;
    while let Some(at) = rest.find('_') {
        let (before, after) = (&rest[..at], &rest[at + 1..]);
        let end = after.find(|c: char| !c.is_alphanumeric() && c != '_').unwrap_or(after.len());
        let below = &after[..end];
        let mut last = before.chars().rev();
        let is_symbol = last.next().is_some_and(char::is_alphabetic)
            && last.next().is_none_or(|c| !(c.is_alphanumeric() || c == '_' || c == '-'))
            && (1..=LONGEST_BELOW).contains(&below.chars().count())
            && !below.contains('_');
        words += &escaped(before);
        if !is_symbol {
            let _ = write!(words, "_{}", escaped(below));
            rest = &after[end..];
            continue;
        }
        // A space at the start of a span is dropped, and an empty span would not return to the
        // baseline.
        let (gap, onward) = after[end..].strip_prefix(' ').map_or((0, &after[end..]), |on| (4, on));
        let next = onward.find('_').map_or(onward.len(), |next| word_start(onward, next));
        let (line, onward) = onward.split_at(next);
        let line = if line.is_empty() { "\u{200b}".to_string() } else { escaped(line) };
        let _ = write!(
            words,
            "<tspan dy=\"3.5\" font-size=\"0.75em\">{}</tspan><tspan dx=\"{gap}\" \
             dy=\"-3.5\">{line}</tspan>",
            escaped(below)
        );
        rest = onward;
    }
    words + &escaped(rest)
}

/// Returns the start of the word at a position.
fn word_start(text: &str, place: usize) -> usize {
    text[..place].rfind(char::is_whitespace).map_or(0, |space| space + 1)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn gradient_colours_of_curves_are_distinct() {
        for n in [1, 2, 8, 40] {
            let colours: std::collections::BTreeSet<String> =
                (0..n).map(|k| colour_along(k, n)).collect();
            assert_eq!(colours.len(), n);
        }
        assert_eq!((colour_along(0, 9), colour_along(8, 9)), ("#440154".into(), "#9fda3a".into()));
    }

    #[test]
    fn only_symbols_have_subscripts() {
        let set = |text: &str| words(text).replace("\u{200b}", "");
        for name in
            ["glass_on_wall", "glass_0.5ms", "run_2", "a_long_name", "x-a_1b_2", "_", "run_a_1"]
        {
            assert_eq!(set(name), name);
        }
        for (text, below) in
            [("σ_yy [MPa]", "yy"), ("Pressure on the axis p_0", "0"), ("(E_kin)", "kin")]
        {
            assert!(set(text).contains(&format!("0.75em\">{below}</tspan>")), "{}", set(text));
        }
        assert_eq!(words("p_0 of a_b").matches("font-size").count(), 2);
        assert!(words("p_0 of glass_on_wall").contains("glass_on_wall"));
    }

    #[test]
    fn tick_labels_are_short() {
        for (value, expected) in
            [(0.1 + 0.2, "0.3"), (0.0, "0"), (1e-7, "1e-7"), (-2.5e8, "-2.5e8"), (1000.0, "1000")]
        {
            assert_eq!(tick(value), expected);
        }
    }
}
