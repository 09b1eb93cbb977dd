//! Temperatures: numbers on a scale with an offset, `23 degC`.

use fem_material::ZERO_CELSIUS;

use crate::quantity::uncertain::SIGNS;

/// Scales of temperature: name, kelvin per degree, and kelvin at its zero.
pub(crate) const SCALES: [(&str, f64, f64); 8] = [
    ("degC", 1.0, ZERO_CELSIUS),
    ("°C", 1.0, ZERO_CELSIUS),
    ("ºC", 1.0, ZERO_CELSIUS),
    ("C", 1.0, ZERO_CELSIUS),
    ("degF", 5.0 / 9.0, 459.67 * 5.0 / 9.0),
    ("°F", 5.0 / 9.0, 459.67 * 5.0 / 9.0),
    ("F", 5.0 / 9.0, 459.67 * 5.0 / 9.0),
    ("K", 1.0, 0.0),
];

/// Returns a temperature with its scale, `23 degC`, `73 °F` or `296 K`, in K, above 0; `None` for any other text.
///
/// ```
/// assert_eq!(fem_case::parse_temperature("23 degC"), Some(296.15));
/// assert_eq!(fem_case::parse_temperature("20"), None);
/// ```
pub fn parse_temperature(text: &str) -> Option<f64> {
    let text = text.trim();
    let of = |(name, factor, zero): (&str, f64, f64)| {
        let number = text.strip_suffix(name)?.trim().replace('−', "-");
        Some(number.parse::<f64>().ok()? * factor + zero)
    };
    let kelvin = SCALES.into_iter().find_map(of)?;
    (kelvin > 0.0 && kelvin.is_finite()).then_some(kelvin)
}

/// Returns a temperature in K with its uncertainty, `23 ± 2 degC`; `None` for any other text.
pub(super) fn parse_uncertain(text: &str) -> Option<(f64, Option<f64>)> {
    let Some((value, spread)) = SIGNS.iter().find_map(|sign| text.split_once(sign)) else {
        return Some((parse_temperature(text)?, None));
    };
    let (value, spread) = (value.trim(), spread.trim());
    let (name, factor, _) = SCALES.into_iter().find(|scale| spread.ends_with(scale.0))?;
    let uncertainty = spread.strip_suffix(name)?.trim().parse::<f64>().ok()? * factor;
    let with_scale = format!("{value} {name}");
    let kelvin = parse_temperature(value).or_else(|| parse_temperature(&with_scale))?;
    (uncertainty >= 0.0 && uncertainty.is_finite()).then_some((kelvin, Some(uncertainty)))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn temperatures_have_a_scale() {
        for (text, kelvin) in [
            ("23 degC", 296.15),
            ("-20°C", 253.15),
            ("−20 C", 253.15),
            ("296.15 K", 296.15),
            ("73.4 °F", 296.15),
            ("32 degF", 273.15),
        ] {
            let found = parse_temperature(text).unwrap();
            assert!((found - kelvin).abs() < 1e-9, "{text}: {found}");
        }
        for text in ["", "23", "degC", "-300 degC", "nan K", "inf K", "20 m", "1e400 K", "--2 K"] {
            assert_eq!(parse_temperature(text), None, "{text}");
        }
        assert_eq!(parse_uncertain("23 ± 2 degC"), Some((296.15, Some(2.0))));
        assert_eq!(parse_uncertain("23 degC +- 2 K"), Some((296.15, Some(2.0))));
        assert_eq!(parse_uncertain("23 degC"), Some((296.15, None)));
        for text in ["23 ± 2", "23 degC ± -2 K", "± 2 K", "23 degC ±"] {
            assert_eq!(parse_uncertain(text), None, "{text}");
        }
    }
}
