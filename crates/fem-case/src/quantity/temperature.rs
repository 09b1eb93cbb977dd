//! Temperatures: numbers on a scale with an offset, `23 degC`.

/// Scales of temperature: name, kelvin per degree, and kelvin at its zero.
const SCALES: [(&str, f64, f64); 8] = [
    ("degC", 1.0, 273.15),
    ("°C", 1.0, 273.15),
    ("ºC", 1.0, 273.15),
    ("C", 1.0, 273.15),
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
