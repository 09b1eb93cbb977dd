//! Quantities with an uncertainty: `"70 ± 2 GPa"`, `"70 GPa ± 3 %"`, or a table `{ value = "70 GPa", uncertainty = "2 GPa" }`,
//! which is read as such a text.

use crate::quantity::units::{Dimension, UnitError, parse_quantity, unit_of};

/// Signs between a value and its uncertainty.
pub(super) const SIGNS: [&str; 3] = ["±", "+/-", "+-"];
/// The unit of a relative uncertainty.
const RELATIVE: &str = "%";

/// Returns the value of a text in SI, its uncertainty if it has one, and the dimension. A unit that only one of the two has
/// is that of both.
///
/// # Errors
/// A value or an uncertainty that is no quantity, of different dimensions; a negative uncertainty.
pub(crate) fn parse(text: &str) -> Result<(f64, Option<f64>, Dimension), UnitError> {
    let Some((value, spread)) = SIGNS.iter().find_map(|sign| text.split_once(sign)) else {
        let (value, dimension) = parse_quantity(text)?;
        return Ok((value, None, dimension));
    };
    let malformed = |message: &str| Err(UnitError::Malformed(message.to_string()));
    let Ok(unit_of_spread) = unit_of(spread) else {
        return malformed("no number follows the ±");
    };
    let unit = unit_of(value)?;
    if unit_of_spread != RELATIVE && unit_of_spread.contains(RELATIVE) {
        return malformed("its uncertainty is a share and has a unit: write one of both");
    }
    let is_relative = unit_of_spread == RELATIVE && unit != RELATIVE;
    let value = match unit {
        "" if !is_relative => format!("{value} {unit_of_spread}"),
        _ => value.to_string(),
    };
    let (value, dimension) = parse_quantity(&value)?;
    let (spread, dimension_of_spread) = match unit_of_spread {
        "" => parse_quantity(&format!("{spread} {unit}"))?,
        _ => parse_quantity(spread)?,
    };
    match is_relative {
        _ if spread < 0.0 => malformed("its uncertainty is negative"),
        true => Ok((value, Some(spread * value.abs()), dimension)),
        false if dimension_of_spread != dimension => malformed("its uncertainty has another unit"),
        false => Ok((value, Some(spread), dimension)),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_uncertainty_has_a_unit_of_its_own_or_that_of_the_value() {
        for (text, value, spread) in [
            ("70 ± 2 GPa", 70e9, 2e9),
            ("70 GPa ± 2 GPa", 70e9, 2e9),
            ("70 GPa ± 0.03", 70e9, 3e7),
            ("70 ± 0.03 GPa", 70e9, 3e7),
            ("70 GPa +- 500 MPa", 70e9, 5e8),
            ("70 GPa +/- 3 %", 70e9, 2.1e9),
            ("-0.2 ± 0.01", -0.2, 0.01),
            ("0.2 ± 3 %", 0.2, 0.006),
            ("20 % ± 1 %", 0.2, 0.01),
            ("0 m/s ± 1 cm/s", 0.0, 0.01),
        ] {
            let (found, uncertainty, _) = parse(text).unwrap();
            assert_eq!(found, value, "{text}");
            assert!((uncertainty.unwrap() - spread).abs() < 1e-12 * spread, "{text}");
        }
        assert_eq!(parse("70 GPa").unwrap().1, None);
        for text in [
            "70 GPa ± -2 GPa",
            "70 GPa ± 2 mm",
            "± 2 GPa",
            "70 GPa ±",
            "1 ± 2 ± 3 m",
            "70 GPa ± 3 % GPa",
            "70 ± 3 %GPa",
            "70 GPa ± 3 GPa %",
        ] {
            assert!(parse(text).is_err(), "{text}");
        }
        let error = parse("70 ± GPa").unwrap_err();
        assert_eq!(error.to_string(), "no number follows the ±");
    }
}
