//! Converts numbers with a unit expression, `"22.2 mm"` or `"2390 kg/m^3"`, to SI.
//!
//! ```text
//! quantity = number expression
//! expression = factor { "*" | "/" | space  factor }        left to right; "·" and "×" are "*"
//! factor = ( "1" | [prefix] unit | "(" expression ")" ) [power]
//! power = "^" integer | "**" integer | integer | superscript     m^3, m**3, m3, m³, s^-1, s-1, s⁻¹
//! ```
//!
//! A space after a `/` is rejected, since "J/kg m" is ambiguous: write `J/(kg m)`.
//!
//! Powers of ten are kept apart from all other factors and added to the decimal exponent of the number. The correctly
//! rounding parser of the standard library then converts it once: `"22.2 mm"` is the double nearest to 0.0222 and
//! `"14 um"` is `14e-6` to the last bit. Other units (h, psi) add one rounding each for numerator and denominator.
//!
//! The crates uom (single units only) and `dyn_quantity` (no Pa, 2390.0000000000005 for "2.39 g/cm^3") do not serve.

use crate::quantity::unit_table::{UnitScale, find_unit, suggest_unit};

/// Exponents of metre, kilogram, second and byte.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Dimension(pub [i32; 4]);

/// The reason why a text is not a number with a unit.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum UnitError {
    /// The text does not begin with a number.
    #[error("it does not begin with a number")]
    NoNumber,
    /// The number has a decimal comma: `22,2 mm`.
    #[error("it has a decimal comma; write a point")]
    DecimalComma,
    /// A symbol is not a unit.
    #[error("`{symbol}` is not a known unit")]
    UnknownUnit {
        /// The symbol that was found.
        symbol: String,
        /// The nearest unit, if there is one.
        suggestion: Option<String>,
    },
    /// The expression has a syntax error.
    #[error("{0}")]
    Malformed(String),
    /// The value has no finite, non-zero double.
    #[error("it is out of the range of numbers")]
    OutOfRange,
}

/// Returns the value of `text` in SI, which is finite, and its dimension.
///
/// # Errors
/// The text is not a number with a unit ([`UnitError`]).
pub fn parse_quantity(text: &str) -> Result<(f64, Dimension), UnitError> {
    let text = text.trim();
    let (decimal, rest) = split_number(text)?;
    let mut parser = Parser { rest };
    let scale = parser.expression(0)?;
    if !parser.rest.is_empty() {
        return Err(UnitError::Malformed("it has a `)` without a `(`".to_string()));
    }
    let value = decimal.value(scale).ok_or(UnitError::OutOfRange)?;
    Ok((value, Dimension(scale.dimension)))
}

/// Returns the text after the number of `text`: its unit, empty for a plain number.
///
/// # Errors
/// The text does not begin with a number.
pub(crate) fn unit_of(text: &str) -> Result<&str, UnitError> {
    split_number(text.trim()).map(|(_, unit)| unit.trim())
}

/// A decimal number as text: sign and significand, with a separate exponent.
struct Decimal<'a> {
    negative: bool,
    significand: &'a str,
    exponent: i32,
}

impl Decimal<'_> {
    /// Returns the number times the unit; `None` if it over- or underflows.
    fn value(&self, scale: UnitScale) -> Option<f64> {
        let exponent = self.exponent.saturating_add(scale.ten);
        let size: f64 = format!("{}e{exponent}", self.significand).parse().ok()?;
        let size = size * scale.numerator / scale.denominator;
        let is_zero = !self.significand.bytes().any(|byte| (b'1'..=b'9').contains(&byte));
        if !size.is_finite() || (size == 0.0 && !is_zero) {
            return None;
        }
        Some(if self.negative { -size } else { size })
    }
}

fn split_number(text: &str) -> Result<(Decimal<'_>, &str), UnitError> {
    let negative = text.starts_with(['-', '\u{2212}']);
    let unsigned = text.strip_prefix(['-', '+', '\u{2212}']).unwrap_or(text);
    let digits_of = |text: &str| text.bytes().take_while(u8::is_ascii_digit).count();
    let whole = digits_of(unsigned);
    let fraction = match unsigned[whole..].strip_prefix('.') {
        Some(after) => 1 + digits_of(after),
        None => 0,
    };
    if whole + fraction.saturating_sub(1) == 0 {
        return Err(UnitError::NoNumber);
    }
    let (significand, mut rest) = unsigned.split_at(whole + fraction);
    let mut exponent = 0;
    if let Some(after) = rest.strip_prefix(['e', 'E']) {
        let sign = usize::from(after.starts_with(['-', '+']));
        let digits = digits_of(&after[sign..]);
        if digits > 0 {
            let (text, after) = after.split_at(sign + digits);
            let limit = if text.starts_with('-') { i32::MIN } else { i32::MAX };
            exponent = text.parse().unwrap_or(limit);
            rest = after;
        }
    }
    if rest.starts_with(',') {
        return Err(UnitError::DecimalComma);
    }
    Ok((Decimal { negative, significand, exponent }, rest))
}

const DEEPEST_PARENTHESIS: usize = 8;
const MAX_POWER: i32 = 30;

struct Parser<'a> {
    rest: &'a str,
}

impl Parser<'_> {
    fn expression(&mut self, depth: usize) -> Result<UnitScale, UnitError> {
        let mut total = UnitScale::ONE;
        let (mut is_first, mut has_divided) = (true, false);
        loop {
            self.rest = self.rest.trim_start();
            if self.rest.is_empty() || self.rest.starts_with(')') {
                return Ok(total);
            }
            let mut power = 1;
            if self.take(&["/"]).is_some() {
                power = -1;
                has_divided = true;
            } else if !is_first {
                let times = self.take(&["*", "\u{b7}", "\u{22c5}", "\u{d7}"]);
                if times.is_none() && has_divided {
                    let message = "a space after `/` is ambiguous; write `/ (… …)`";
                    return Err(UnitError::Malformed(message.to_string()));
                }
            }
            total = total.times(self.factor(depth)?.power(power));
            is_first = false;
        }
    }

    fn factor(&mut self, depth: usize) -> Result<UnitScale, UnitError> {
        self.rest = self.rest.trim_start();
        let scale = if self.take(&["("]).is_some() {
            if depth == DEEPEST_PARENTHESIS {
                return Err(UnitError::Malformed(
                    "its parentheses are nested too deeply".to_string(),
                ));
            }
            if self.rest.trim_start().starts_with(')') {
                return Err(UnitError::Malformed("its parentheses are empty".to_string()));
            }
            let inner = self.expression(depth + 1)?;
            if self.take(&[")"]).is_none() {
                return Err(UnitError::Malformed("a `)` is missing".to_string()));
            }
            inner
        } else {
            self.symbol()?
        };
        match self.power()? {
            Some(power) => Ok(scale.power(power)),
            None => Ok(scale),
        }
    }

    fn symbol(&mut self) -> Result<UnitScale, UnitError> {
        let is_symbol = |c: char| c.is_alphabetic() || c == '%' || c == '°';
        let end = self.rest.find(|c| !is_symbol(c)).unwrap_or(self.rest.len());
        let (symbol, rest) = self.rest.split_at(end);
        if !symbol.is_empty() {
            self.rest = rest;
            return find_unit(symbol).ok_or_else(|| UnitError::UnknownUnit {
                symbol: symbol.to_string(),
                suggestion: suggest_unit(symbol),
            });
        }
        let digits = self.rest.find(|c: char| !c.is_ascii_digit()).unwrap_or(self.rest.len());
        if &self.rest[..digits] == "1" {
            self.rest = &self.rest[digits..];
            return Ok(UnitScale::ONE);
        }
        Err(UnitError::Malformed(match self.rest.chars().next() {
            Some(found) => format!("there is `{found}` instead of a unit"),
            None => "a unit is missing at its end".to_string(),
        }))
    }

    /// Returns the power that follows a factor, if any.
    fn power(&mut self) -> Result<Option<i32>, UnitError> {
        let has_sign = self.take(&["^", "**"]).is_some();
        let mut text = String::new();
        let mut length = 0;
        for c in self.rest.chars() {
            let plain = plain_digit(c);
            match plain {
                Some(sign @ ('-' | '+')) if text.is_empty() => text.push(sign),
                Some(digit) if digit.is_ascii_digit() => text.push(digit),
                _ => break,
            }
            length += c.len_utf8();
        }
        if text.is_empty() && !has_sign {
            return Ok(None);
        }
        match text.parse() {
            Ok(power) if (-MAX_POWER..=MAX_POWER).contains(&power) => {
                self.rest = &self.rest[length..];
                Ok(Some(power))
            }
            _ => Err(UnitError::Malformed(format!(
                "a power is an integer from -{MAX_POWER} to {MAX_POWER}"
            ))),
        }
    }

    /// Consumes the longest of `tokens` that comes next.
    fn take(&mut self, tokens: &[&'static str]) -> Option<&'static str> {
        let found = tokens.iter().filter(|token| self.rest.starts_with(**token));
        let token = found.max_by_key(|token| token.len())?;
        self.rest = &self.rest[token.len()..];
        Some(token)
    }
}

/// Returns the plain digit or sign of a character, which may be a superscript.
fn plain_digit(c: char) -> Option<char> {
    Some(match c {
        '0'..='9' | '-' | '+' => c,
        '\u{207b}' | '\u{2212}' => '-',
        '\u{207a}' => '+',
        '\u{2070}' => '0',
        '\u{b9}' => '1',
        '\u{b2}' => '2',
        '\u{b3}' => '3',
        '\u{2074}'..='\u{2079}' => char::from(b'4' + (c as u32 - 0x2074) as u8),
        _ => return None,
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn value(text: &str) -> f64 {
        parse_quantity(text).unwrap_or_else(|error| panic!("{text}: {error}")).0
    }

    #[test]
    fn powers_of_ten_are_exact_to_the_last_bit() {
        // `==` on purpose: the module promises the nearest double.
        for (text, expected) in [
            ("22.2 mm", 0.0222),
            ("15.9 mm", 0.0159),
            ("22.2mm", 0.0222),
            ("63 GPa", 63e9),
            ("63e9 Pa", 63e9),
            ("25.3 GPa", 25.3e9),
            ("0.063 TPa", 63e9),
            ("2390 kg/m^3", 2390.0),
            ("2.39 g/cm^3", 2390.0),
            ("2.39 g/cm³", 2390.0),
            ("2.39 g/cm3", 2390.0),
            ("2.39 g cm^-3", 2390.0),
            ("2.39 g·cm⁻³", 2390.0),
            ("2.39 kg/L", 2390.0),
            ("2708 1/s", 2708.0),
            ("2.708e3 1/s", 2708.0),
            ("2708 /s", 2708.0),
            ("2708 s^-1", 2708.0),
            ("2708 s⁻¹", 2708.0),
            ("2708 s-1", 2708.0),
            ("2.708 kHz", 2708.0),
            ("2.708 1/ms", 2708.0),
            ("14 um", 14e-6),
            ("14 \u{b5}m", 14e-6),
            ("14 \u{3bc}m", 14e-6),
            ("1.676e-4 s", 1.676e-4),
            ("0.1676 ms", 1.676e-4),
            ("167.6 us", 1.676e-4),
            ("0.5 m/s", 0.5),
            ("50 cm/s", 0.5),
            ("-50 cm/s", -0.5),
            ("\u{2212}50 cm/s", -0.5),
            ("+.5 m/s", 0.5),
            ("5. m", 5.0),
            ("9.81 m/s**2", 9.81),
            ("1 N/mm^2", 1e6),
            ("1 MN/m**2", 1e6),
            ("1 kg/(m s^2)", 1.0),
            ("1 kg / ( m * s ) / s", 1.0),
            ("1 (m/s)^2", 1.0),
            ("3 %", 0.03),
            ("0.244", 0.244),
            ("8 GB", 8e9),
            ("8 GiB", 8.0 * 1024f64.powi(3)),
            ("  22.2   mm  ", 0.0222),
            ("0 mm", 0.0),
            ("5 bar", 5e5),
            ("5 mbar", 500.0),
            ("1.1e-9 t/mm^3", 1100.0),
            ("1.1e-9 tonne/mm^3", 1100.0),
            ("1.1 g/cc", 1100.0),
            ("1e7 dyn/cm^2", 1e6),
        ] {
            assert_eq!(value(text), expected, "{text}");
        }
    }

    #[test]
    fn other_units_have_their_defined_value() {
        // One rounding in the product and one in the quotient: 2 units in the last place.
        for (text, expected) in [
            ("36 km/h", 10.0),
            ("1 km/h", 1.0 / 3.6),
            ("1 psi", 6894.757293168361),
            ("1 ksi", 6894757.293168361),
            ("1 in", 0.0254),
            ("1 ft", 0.3048),
            ("1 mph", 0.44704),
            ("1 min", 60.0),
            ("2 h", 7200.0),
            ("1 d", 86400.0),
            ("1 Msi", 6894757293.168361),
            ("100 fps", 30.48),
            ("1 kgf/mm^2", 9806650.0),
            ("1 lbm/in^3", 27679.90471020312),
            ("1 lbf s^2/in^4", 10686895.178201316),
            ("1 atm", 101325.0),
            ("1 lb", 0.45359237),
            ("1 in^2", 6.4516e-4),
            ("1 in^-2", 1.0 / 6.4516e-4),
        ] {
            let relative = (value(text) / expected - 1.0).abs();
            assert!(relative <= 2.0 * f64::EPSILON, "{text}: {}", value(text));
        }
    }

    #[test]
    fn dimensions_are_those_of_the_expression() {
        let dimension = |text| parse_quantity(text).map(|(_, dimension)| dimension.0);
        assert_eq!(dimension("1 kg/m^3"), Ok([-3, 1, 0, 0]));
        assert_eq!(dimension("1 J/kg"), Ok([2, 0, -2, 0]));
        assert_eq!(dimension("1 (kg/(m s))^-1"), Ok([1, -1, 1, 0]));
        assert_eq!(dimension("1 m/m"), Ok([0; 4]));
        assert_eq!(dimension("3 GB"), Ok([0, 0, 0, 1]));
    }

    #[test]
    fn unknown_units_are_named_and_the_nearest_is_suggested() {
        for (text, found, nearest) in [
            ("63 Gpa", "Gpa", Some("GPa")),
            ("63 gpa", "gpa", Some("GPa")),
            ("3 furlong", "furlong", None),
            ("3 meters", "meters", Some("m")),
            ("3 dynes", "dynes", Some("dyn")),
            ("3 sec", "sec", Some("s")),
            ("5 kG", "kG", Some("kg")),
            ("5 cd", "cd", None),
            ("5 mmin", "mmin", None),
            ("5 nan", "nan", None),
        ] {
            let expected = UnitError::UnknownUnit {
                symbol: found.to_string(),
                suggestion: nearest.map(str::to_string),
            };
            assert_eq!(parse_quantity(text), Err(expected), "{text}");
        }
    }

    #[test]
    fn malformed_text_is_refused() {
        for text in ["", " ", "mm", "nan", "inf", "nan m", "-inf m", ".", ".e3 m", "- 3 m", "+"] {
            assert_eq!(parse_quantity(text), Err(UnitError::NoNumber), "{text:?}");
        }
        assert_eq!(parse_quantity("22,2 mm"), Err(UnitError::DecimalComma));
        for text in ["1e400 m", "1e-400 m", "1e99999999999 m", "1 km^30 km^30 km^30 km^30"] {
            assert_eq!(parse_quantity(text), Err(UnitError::OutOfRange), "{text:?}");
        }
        for text in [
            "1 m/",
            "1 /",
            "1 *m",
            "1 m**",
            "1 m^",
            "1 m^x",
            "1 m^1.5",
            "1 m^99",
            "1 (m",
            "1 m)",
            "1 ()",
            "1 (",
            "1 2 m",
            "1 J/kg m",
            "1 m!",
            "1 m//s",
            "1 m^--2",
            "1_000 m",
            "1 m^²^2",
            "1 (((((((((m)))))))))",
        ] {
            let found = parse_quantity(text);
            assert!(matches!(found, Err(UnitError::Malformed(_))), "{text:?}: {found:?}");
        }
    }
}
