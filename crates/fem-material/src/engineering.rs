//! SI numbers in engineering notation: `65.12 µs`, `2.31 GPa`.

/// Standard gravity, m/s² (CGPM 1901).
pub const STANDARD_GRAVITY: f64 = 9.80665;

/// Prefixes of powers of 1000, and the power of the first.
const PREFIXES: [&str; 11] = ["a", "f", "p", "n", "µ", "m", "", "k", "M", "G", "T"];
const FIRST_POWER: i32 = -6;
/// Number of significant digits.
const DIGITS: i32 = 4;

/// A unit with a prefix, and its number per SI unit.
#[derive(Clone, Debug, PartialEq)]
pub struct Unit {
    symbol: String,
    scale: f64,
    decimals: usize,
}

impl Unit {
    /// Returns the unit in which `value` has one to three digits before the point.
    pub fn fitting(value: f64, symbol: &str) -> Self {
        let size = value.abs();
        let exponent = if size > 0.0 && size.is_finite() { size.log10().floor() as i32 } else { 0 };
        let last_power = FIRST_POWER + PREFIXES.len() as i32 - 1;
        let power = exponent.div_euclid(3).clamp(FIRST_POWER, last_power);
        let before_point = (exponent - 3 * power + 1).clamp(1, DIGITS);
        Self {
            symbol: format!("{}{symbol}", PREFIXES[(power - FIRST_POWER) as usize]),
            scale: 10f64.powi(-3 * power),
            decimals: (DIGITS - before_point) as usize,
        }
    }

    /// Shows `digits` digits instead of four.
    pub fn with_digits(mut self, digits: usize) -> Self {
        self.decimals = (self.decimals + digits).saturating_sub(DIGITS as usize);
        self
    }

    /// Returns the prefix with the unit: `µs`.
    pub fn symbol(&self) -> &str {
        &self.symbol
    }

    /// Converts an SI value to this unit.
    pub fn scaled(&self, value: f64) -> f64 {
        value * self.scale
    }

    /// Formats an SI value in this unit.
    pub fn show(&self, value: f64) -> String {
        format!("{:.*} {}", self.decimals, value * self.scale, self.symbol)
    }
}

/// Returns whether values of a parameter's unit are shown with the prefixes of [`show`]; those of compound units are not.
pub fn takes_prefix(unit: &str) -> bool {
    ["s", "m/s", "Pa"].contains(&unit)
}

/// Formats `value` in a fitting unit, or with an exponent if there is no prefix for it.
pub fn show(value: f64, symbol: &str) -> String {
    let exponent = value.abs().log10();
    let last_power = FIRST_POWER + PREFIXES.len() as i32;
    let has_prefix = (f64::from(3 * FIRST_POWER)..f64::from(3 * last_power)).contains(&exponent);
    match has_prefix || value == 0.0 || !value.is_finite() {
        true => Unit::fitting(value, symbol).show(value),
        false => format!("{} {symbol}", number(value, DIGITS as usize)),
    }
}

/// Formats a number without a unit, with `digits` significant digits: `0`, `0.034`, `5.4e-5`.
pub fn number(value: f64, digits: usize) -> String {
    let rounded: f64 = format!("{value:.*e}", digits.max(1) - 1).parse().unwrap_or(value);
    if rounded == 0.0 {
        "0".to_string()
    } else if (1e-3..1e5).contains(&rounded.abs()) || !rounded.is_finite() {
        rounded.to_string()
    } else {
        format!("{rounded:e}")
    }
}

/// Formats a range with two digits: `0.16 to 0.31`, `29 to 49 µs`; one number if both ends print alike.
pub fn range([low, high]: [f64; 2], symbol: &str) -> String {
    let unit = Unit::fitting(high, symbol);
    let scaled = |value: f64| if symbol.is_empty() { value } else { unit.scaled(value) };
    let [low, high] = [low, high].map(|value| number(scaled(value), 2));
    let ends = if low == high { high } else { format!("{low} to {high}") };
    match symbol {
        "" => ends,
        _ => format!("{ends} {}", unit.symbol()),
    }
}

/// Shortens a text that begins with a number of more than seven digits, `5.49602204001348 cm/s`, to five digits.
/// Other texts are unchanged.
pub fn shortened(text: &str) -> String {
    let is_part = |c: char| c.is_ascii_digit() || matches!(c, '.' | '-' | '+' | 'e');
    let end = text.find(|c: char| !is_part(c)).unwrap_or(text.len());
    let (digits, rest) = text.split_at(end);
    let n_digits =
        digits.split('e').next().unwrap_or("").matches(|c: char| c.is_ascii_digit()).count();
    match digits.parse::<f64>() {
        Ok(value) if n_digits > 7 => number(value, 5) + rest,
        _ => text.to_string(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_have_four_digits_and_a_prefix() {
        for (value, symbol, expected) in [
            (65.123e-6, "s", "65.12 µs"),
            (1.0e-3, "m", "1.000 mm"),
            (999.4, "N", "999.4 N"),
            (2.3119e9, "Pa", "2.312 GPa"),
            (0.0, "N", "0.000 N"),
            (-0.5, "m/s", "-500.0 mm/s"),
            (3e14, "Pa", "300.0 TPa"),
            (3e17, "Pa", "3e17 Pa"),
            (1.000_000_000_000_000_2e300, "Pa", "1e300 Pa"),
            (-1.234_56e-20, "J", "-1.235e-20 J"),
            (f64::NAN, "N", "NaN N"),
        ] {
            assert_eq!(show(value, symbol), expected);
        }
        assert_eq!(Unit::fitting(62.8212e-6, "s").with_digits(5).show(62.8212e-6), "62.821 µs");
    }

    #[test]
    fn ranges_have_two_digits_and_one_unit() {
        for (ends, symbol, expected) in [
            ([0.1643, 0.3141], "", "0.16 to 0.31"),
            ([29.27e-6, 49.22e-6], "s", "29 to 49 µs"),
            ([391.1, 1754.3], "N", "0.39 to 1.8 kN"),
            ([0.0, 0.0], "", "0"),
            ([1.434e-7, 1.434e-7], "N", "140 nN"),
        ] {
            assert_eq!(range(ends, symbol), expected);
        }
    }

    #[test]
    fn long_numbers_are_shortened_and_words_are_not() {
        for (text, expected) in [
            ("5.49602204001348 cm/s", "5.496 cm/s"),
            ("0.00012345678901", "1.2346e-4"),
            ("22.2 mm", "22.2 mm"),
            ("1000000", "1000000"),
            ("end", "end"),
            ("{ ting = {} }", "{ ting = {} }"),
        ] {
            assert_eq!(shortened(text), expected);
        }
    }

    #[test]
    fn plain_numbers_have_no_needless_exponent() {
        for (value, digits, expected) in [
            (0.0, 2, "0"),
            (-0.0, 2, "0"),
            (3.772_058, 7, "3.772058"),
            (0.034_21, 2, "0.034"),
            (5.432e-5, 2, "5.4e-5"),
            (99_999.0, 2, "1e5"),
            (-12.345, 3, "-12.3"),
            (f64::INFINITY, 2, "inf"),
        ] {
            assert_eq!(number(value, digits), expected);
        }
    }
}
