//! Parses numbers with their uncertainty: `20 cm ± 1 mm`, `30 +- 0.5 deg`, `13.7 g ± 1 %`.

use std::f64::consts::PI;

use fem_case::{parse_quantity, parse_temperature};

use super::column_roles::SIGNS;

/// A number with its standard uncertainty.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Measured {
    /// The best value.
    pub value: f64,
    /// Standard uncertainty, at least 0.
    pub uncertainty: f64,
}

impl Measured {
    /// Creates a value that is known exactly.
    pub fn exact(value: f64) -> Self {
        Self { value, uncertainty: 0.0 }
    }
}

/// Kinds of quantity of an experiment.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    /// A length, m.
    Length,
    /// A mass, kg.
    Mass,
    /// An acceleration, m/s².
    Acceleration,
    /// An angle, rad.
    Angle,
    /// A time, s.
    Time,
    /// A speed, m/s.
    Speed,
    /// A density, kg/m³.
    Density,
    /// A modulus of elasticity, Pa.
    Modulus,
    /// A temperature, K.
    Temperature,
    /// A rate, 1/s.
    Rate,
}

/// The reason why a text is no measured quantity.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum NotMeasured {
    /// The text is no number of this kind.
    #[error("{text:?} is not {}", kind.row().1)]
    OtherKind {
        /// The text as it was found.
        text: String,
        /// The kind of quantity that is expected.
        kind: Kind,
    },
    /// In radians the angle would be more than half a turn.
    #[error("{0:?} without a unit is in radians; write '{0} deg' for degrees")]
    BareDegrees(String),
    /// The uncertainty is negative.
    #[error("an uncertainty is at least 0")]
    NegativeUncertainty,
}

impl Kind {
    /// Returns the exponents of metre, kilogram, second and byte, and the words of messages.
    fn row(self) -> ([i32; 4], &'static str) {
        match self {
            Self::Length => ([1, 0, 0, 0], "a length, such as '20 cm' or '20 cm ± 1 mm'"),
            Self::Mass => ([0, 1, 0, 0], "a mass, such as '13.7 g' or '13.7 g ± 0.1 g'"),
            Self::Acceleration => ([1, 0, -2, 0], "an acceleration, such as '9.81 m/s^2'"),
            Self::Time => ([0, 0, 1, 0], "a time, such as '50 us' or '50 us ± 5 us'"),
            Self::Speed => ([1, 0, -1, 0], "a speed, such as '2 m/s' or '2 m/s ± 1 cm/s'"),
            Self::Density => ([-3, 1, 0, 0], "a density, such as '7800 kg/m^3'"),
            Self::Modulus => ([-1, 1, -2, 0], "a modulus, such as '5 GPa'"),
            Self::Temperature => ([0; 4], "a temperature, such as '23 degC'"),
            Self::Rate => ([0, 0, -1, 0], "a rate, such as '240 Hz'"),
            Self::Angle => ([0; 4], "an angle, such as '20 deg', '20 ± 0.5 deg' or '0.35 rad'"),
        }
    }
}

/// Units of angles in radians. Case files do not have them.
const ANGLES: [(&str, f64); 5] =
    [("deg", PI / 180.0), ("°", PI / 180.0), ("mrad", 1e-3), ("rad", 1.0), ("′", PI / 10_800.0)];

/// Parses a value with or without its uncertainty, SI.
///
/// # Errors
/// The text is no quantity of this kind.
///
/// ```
/// use fem_data::table::{Kind, parse_measured};
///
/// let length = parse_measured(Kind::Length, "20 cm ± 1 mm")?;
/// assert_eq!((length.value, length.uncertainty), (0.2, 0.001));
/// # Ok::<(), fem_data::table::NotMeasured>(())
/// ```
pub fn parse_measured(kind: Kind, text: &str) -> Result<Measured, NotMeasured> {
    let Some((value, uncertainty)) = SIGNS.iter().find_map(|sign| text.split_once(sign)) else {
        return Ok(Measured::exact(parse(kind, text)?));
    };
    let (value, uncertainty) = (value.trim(), uncertainty.trim());
    // `30 ± 0.5 deg`: one unit for both.
    let whole = match value.parse::<f64>() {
        Ok(_) => {
            let number = |c: char| c.is_ascii_digit() || ".eE+-".contains(c);
            let unit = uncertainty.trim_start_matches(number);
            if unit.trim() == "%" { value.to_string() } else { format!("{value}{unit}") }
        }
        Err(_) => value.to_string(),
    };
    let value = parse(kind, &whole)?;
    let uncertainty = match uncertainty.strip_suffix('%') {
        Some(share) => {
            let share: f64 = share.trim().parse().map_err(|_| wrong(kind, uncertainty))?;
            value.abs() * share * 1e-2
        }
        None if uncertainty.contains('%') => return Err(wrong(kind, text)),
        None => parse(kind, uncertainty)?,
    };
    match uncertainty {
        negative if negative < 0.0 => Err(NotMeasured::NegativeUncertainty),
        // A share of a large value may overflow.
        finite if finite.is_finite() => Ok(Measured { value, uncertainty }),
        _ => Err(wrong(kind, text)),
    }
}

fn parse(kind: Kind, text: &str) -> Result<f64, NotMeasured> {
    let text = text.trim();
    if kind == Kind::Temperature {
        return parse_temperature(text).ok_or_else(|| wrong(kind, text));
    }
    if kind == Kind::Angle
        && let Some((number, scale)) =
            ANGLES.iter().find_map(|(unit, scale)| Some((text.strip_suffix(unit)?, scale)))
    {
        let (number, dimension) = parse_quantity(number).map_err(|_| wrong(kind, text))?;
        return if dimension.0 == [0; 4] { Ok(number * scale) } else { Err(wrong(kind, text)) };
    }
    let (value, dimension) = parse_quantity(text).map_err(|_| wrong(kind, text))?;
    if kind == Kind::Angle && value > PI {
        return Err(NotMeasured::BareDegrees(text.to_string()));
    }
    let is_bare = dimension.0 == [0; 4] && !text.ends_with('%');
    if is_bare || dimension.0 == kind.row().0 { Ok(value) } else { Err(wrong(kind, text)) }
}

fn wrong(kind: Kind, text: &str) -> NotMeasured {
    NotMeasured::OtherKind { text: text.to_string(), kind }
}

/// Returns why no collision has a restitution: it is above 1 or below 0, by how much of its uncertainty if it has one.
pub fn impossible_restitution(e: Measured) -> Option<String> {
    let (side, excess) = match e.value {
        value if value > 1.0 => ("above 1", value - 1.0),
        value if value < 0.0 => ("below 0", -value),
        _ => return None,
    };
    let by = match e.uncertainty > 0.0 {
        true => format!(" by {:.1} of its uncertainty", excess / e.uncertainty),
        false => String::new(),
    };
    Some(format!("restitution {side}{by}"))
}
