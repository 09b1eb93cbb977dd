//! Numbers as text: with errors, with powers of ten, with thin spaces between thousands.

use fem_case::engineering::Unit;

/// Digits of a number whose error is known: as many as give the error two, but no more than this.
const MAX_DIGITS: usize = 6;

/// Returns three digits: `0.0718`, `9.09 × 10⁻⁵`.
pub fn power_of_ten(value: f64) -> String {
    with_digits(&format!("{value:.2e}"))
}

/// Returns two digits: `0.21`, `1.0 × 10⁻⁹`.
pub fn rounded(size: f64) -> String {
    with_digits(&format!("{size:.1e}"))
}

/// Writes `1.5e-7` as `1.5 × 10⁻⁷`, and numbers of ordinary size without an exponent.
fn with_digits(text: &str) -> String {
    let parts =
        text.split_once('e').and_then(|(digits, power)| Some((digits, power.parse::<i32>().ok()?)));
    match parts {
        Some((digits, power)) if !(-4..=3).contains(&power) => {
            let raised = |digit: char| match digit {
                '-' => '⁻',
                '1' => '¹',
                '2' => '²',
                '3' => '³',
                '4'..='9' => {
                    char::from_u32('⁰' as u32 + digit as u32 - '0' as u32).unwrap_or(digit)
                }
                _ => '⁰',
            };
            let power: String = power.to_string().chars().map(raised).collect();
            format!("{digits}\u{a0}×\u{a0}10{power}").replace('-', "\u{2212}")
        }
        _ => text.parse().map_or(text.to_string(), fem_figure::tick).replace('-', "\u{2212}"),
    }
}

/// Returns a number with its error: `62.46 ± 0.21`.
pub fn with_error(value: f64, error: Option<f64>) -> String {
    let before = if value == 0.0 { 1 } else { value.abs().log10().floor() as i64 + 1 };
    let most = (MAX_DIGITS as i64 - before.max(1)).max(0);
    let plain = (4 - before.max(0)).clamp(0, 8) as usize;
    match error.filter(|error| *error > 0.0 && error.is_finite()) {
        None => format!("{value:.plain$}"),
        Some(error) => {
            let decimals = (1 - error.log10().floor() as i64).clamp(0, most) as usize;
            let error = if error < 0.5 * 10f64.powi(-(decimals as i32)) {
                rounded(error)
            } else {
                format!("{error:.decimals$}")
            };
            format!("{value:.decimals$} ± {error}")
        }
    }
}

/// Returns a count with a separator between thousands.
pub fn grouped(count: f64, separator: char) -> String {
    let digits = format!("{count:.0}");
    let mut text = String::new();
    for (k, digit) in digits.chars().enumerate() {
        if k > 0 && (digits.len() - k).is_multiple_of(3) {
            text.push(separator);
        }
        text.push(digit);
    }
    text
}

/// Returns an elapsed time, given in seconds, with three digits; clocks do not resolve less than 1 ms.
pub fn elapsed(seconds: f64) -> String {
    match seconds {
        seconds if seconds < 1e-3 => "less than 1 ms".to_string(),
        seconds => Unit::fitting(seconds, "s").with_digits(3).show(seconds),
    }
}

/// Returns text in one line without control characters, which is safe to show on a terminal.
pub fn one_line(text: &str) -> String {
    text.replace(char::is_control, "\u{fffd}")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn powers_of_ten_are_written_out() {
        for (value, expected) in [
            (0.0718, "0.0718"),
            (9.087e-5, "9.09\u{a0}×\u{a0}10⁻⁵"),
            (9.087e-4, "0.000909"),
            (-3.8e-17, "−3.80\u{a0}×\u{a0}10⁻¹⁷"),
            (0.0, "0"),
            (12_345.0, "1.23\u{a0}×\u{a0}10⁴"),
        ] {
            assert_eq!(power_of_ten(value), expected);
        }
    }

    #[test]
    fn a_number_has_the_digits_of_its_error() {
        for (value, error, expected) in [
            (62.459_09, Some(0.2134), "62.46 ± 0.21"),
            (0.927_891_2, Some(1.9e-4), "0.92789 ± 0.00019"),
            (104.586, Some(12.3), "105 ± 12"),
            (969.801, Some(0.0), "969.8"),
            (62.459_09, None, "62.46"),
            (0.927_891_2, None, "0.9279"),
            (62.459_09, Some(1e-9), "62.4591 ± 1.0\u{a0}×\u{a0}10⁻⁹"),
        ] {
            assert_eq!(with_error(value, error), expected);
        }
    }

    #[test]
    fn short_times_and_large_counts_are_readable() {
        assert_eq!(
            [0.0, 4e-4, 0.0123].map(elapsed),
            ["less than 1 ms", "less than 1 ms", "12.3 ms"]
        );
        assert_eq!(
            [7.0, 1234.0, 1_234_567.0].map(|n| grouped(n, ',')),
            ["7", "1,234", "1,234,567"]
        );
    }
}
