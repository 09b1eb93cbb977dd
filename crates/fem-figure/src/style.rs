//! Colours and numbers.

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

/// Fonts of what is drawn here.
pub(crate) const FONT: &str = "DejaVu Sans, Arial, Helvetica, sans-serif";

/// Text that is safe in SVG.
pub(crate) fn escaped(text: &str) -> String {
    text.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;").replace('"', "&quot;")
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
