//! The units that a case file may use, and the SI prefixes.
//!
//! A unit is `numerator / denominator * 10^ten` in SI. The power of ten is separate so that `units` can convert decimal
//! numbers without rounding.

use std::f64::consts::PI;

/// The value of a unit in SI: `numerator / denominator * 10^ten`, and its dimension.
#[derive(Clone, Copy, Debug)]
pub(crate) struct UnitScale {
    pub(crate) ten: i32,
    pub(crate) numerator: f64,
    pub(crate) denominator: f64,
    pub(crate) dimension: [i32; 4],
}

impl UnitScale {
    pub(crate) const ONE: UnitScale =
        UnitScale { ten: 0, numerator: 1.0, denominator: 1.0, dimension: [0; 4] };

    pub(crate) fn times(self, other: UnitScale) -> UnitScale {
        let mut dimension = self.dimension;
        for (exponent, more) in dimension.iter_mut().zip(other.dimension) {
            *exponent = exponent.saturating_add(more);
        }
        UnitScale {
            ten: self.ten.saturating_add(other.ten),
            numerator: self.numerator * other.numerator,
            denominator: self.denominator * other.denominator,
            dimension,
        }
    }

    pub(crate) fn power(self, power: i32) -> UnitScale {
        let (numerator, denominator) = if power < 0 {
            (self.denominator, self.numerator)
        } else {
            (self.numerator, self.denominator)
        };
        let size = power.saturating_abs();
        UnitScale {
            ten: self.ten.saturating_mul(power),
            numerator: numerator.powi(size),
            denominator: denominator.powi(size),
            dimension: self.dimension.map(|exponent| exponent.saturating_mul(power)),
        }
    }
}

pub(crate) struct Unit {
    pub symbol: &'static str,
    pub prefixable: bool,
    pub scale: UnitScale,
}

const fn unit(symbol: &'static str, dimension: [i32; 4], ten: i32) -> Unit {
    let scale = UnitScale { ten, numerator: 1.0, denominator: 1.0, dimension };
    Unit { symbol, prefixable: true, scale }
}

const fn plain_unit(symbol: &'static str, dimension: [i32; 4], ten: i32, ratio: [f64; 2]) -> Unit {
    let scale = UnitScale { ten, numerator: ratio[0], denominator: ratio[1], dimension };
    Unit { symbol, prefixable: false, scale }
}

const NUMBER: [i32; 4] = [0; 4];
const LENGTH: [i32; 4] = [1, 0, 0, 0];
const MASS: [i32; 4] = [0, 1, 0, 0];
const TIME: [i32; 4] = [0, 0, 1, 0];
const SPEED: [i32; 4] = [1, 0, -1, 0];
const FORCE: [i32; 4] = [1, 1, -2, 0];
const PRESSURE: [i32; 4] = [-1, 1, -2, 0];
const BYTES: [i32; 4] = [0, 0, 0, 1];

/// The units, all exact by definition. lbf = lb g_n = 0.45359237 · 9.80665 N, and psi = lbf/in².
pub(crate) const UNITS: &[Unit] = &[
    unit("m", LENGTH, 0),
    unit("g", MASS, -3),
    unit("s", TIME, 0),
    unit("N", FORCE, 0),
    unit("Pa", PRESSURE, 0),
    unit("J", [2, 1, -2, 0], 0),
    unit("W", [2, 1, -3, 0], 0),
    unit("Hz", [0, 0, -1, 0], 0),
    unit("t", MASS, 3),
    unit("dyn", FORCE, -5),
    unit("L", [3, 0, 0, 0], -3),
    unit("l", [3, 0, 0, 0], -3),
    unit("bar", PRESSURE, 5),
    unit("B", BYTES, 0),
    plain_unit("%", NUMBER, -2, [1.0, 1.0]),
    plain_unit("rad", NUMBER, 0, [1.0, 1.0]),
    plain_unit("deg", NUMBER, 0, [PI, 180.0]),
    plain_unit("°", NUMBER, 0, [PI, 180.0]),
    plain_unit("rpm", [0, 0, -1, 0], 0, [PI, 30.0]),
    plain_unit("min", TIME, 1, [6.0, 1.0]),
    plain_unit("h", TIME, 2, [36.0, 1.0]),
    plain_unit("d", TIME, 2, [864.0, 1.0]),
    plain_unit("in", LENGTH, -4, [254.0, 1.0]),
    plain_unit("ft", LENGTH, -4, [3048.0, 1.0]),
    plain_unit("cc", [3, 0, 0, 0], -6, [1.0, 1.0]),
    plain_unit("fps", SPEED, -4, [3048.0, 1.0]),
    plain_unit("mph", SPEED, -5, [44704.0, 1.0]),
    plain_unit("tonne", MASS, 3, [1.0, 1.0]),
    plain_unit("lb", MASS, -8, [45359237.0, 1.0]),
    plain_unit("lbm", MASS, -8, [45359237.0, 1.0]),
    plain_unit("lbf", FORCE, -13, [45359237.0 * 980665.0, 1.0]),
    plain_unit("kgf", FORCE, -5, [980665.0, 1.0]),
    plain_unit("psi", PRESSURE, -5, [45359237.0 * 980665.0, 64516.0]),
    plain_unit("ksi", PRESSURE, -2, [45359237.0 * 980665.0, 64516.0]),
    plain_unit("Msi", PRESSURE, 1, [45359237.0 * 980665.0, 64516.0]),
    plain_unit("atm", PRESSURE, 0, [101325.0, 1.0]),
    plain_unit("KiB", BYTES, 0, [1024.0, 1.0]),
    plain_unit("MiB", BYTES, 0, [1048576.0, 1.0]),
    plain_unit("GiB", BYTES, 0, [1073741824.0, 1.0]),
    plain_unit("TiB", BYTES, 0, [1099511627776.0, 1.0]),
];

/// SI prefixes; micro may be either Unicode micro sign or `u`.
pub(crate) const PREFIXES: &[(&str, i32)] = &[
    ("Q", 30),
    ("R", 27),
    ("Y", 24),
    ("Z", 21),
    ("E", 18),
    ("P", 15),
    ("T", 12),
    ("G", 9),
    ("M", 6),
    ("k", 3),
    ("h", 2),
    ("da", 1),
    ("d", -1),
    ("c", -2),
    ("m", -3),
    ("u", -6),
    ("\u{b5}", -6),
    ("\u{3bc}", -6),
    ("n", -9),
    ("p", -12),
    ("f", -15),
    ("a", -18),
    ("z", -21),
    ("y", -24),
    ("r", -27),
    ("q", -30),
];

/// Returns the unit of a symbol with or without a prefix. A unit without prefix takes precedence: min is not milli-inch.
pub(crate) fn find_unit(symbol: &str) -> Option<UnitScale> {
    if let Some(unit) = UNITS.iter().find(|unit| unit.symbol == symbol) {
        return Some(unit.scale);
    }
    for (prefix, ten) in PREFIXES {
        let Some(rest) = symbol.strip_prefix(prefix) else {
            continue;
        };
        let unit = UNITS.iter().find(|unit| unit.prefixable && unit.symbol == rest);
        if let Some(unit) = unit {
            return Some(UnitScale { ten: unit.scale.ten + ten, ..unit.scale });
        }
    }
    None
}

/// Returns the unit that an unknown symbol may mean: one with the same letters in another case ("Gpa" → "GPa"), or one with
/// this English name.
pub(crate) fn suggest_unit(symbol: &str) -> Option<String> {
    const NAMES: &[(&str, &str)] = &[
        ("meter", "m"),
        ("metre", "m"),
        ("micron", "um"),
        ("gram", "g"),
        ("sec", "s"),
        ("second", "s"),
        ("hour", "h"),
        ("hr", "h"),
        ("minute", "min"),
        ("inch", "in"),
        ("foot", "ft"),
        ("feet", "ft"),
        ("newton", "N"),
        ("pascal", "Pa"),
        ("joule", "J"),
        ("hertz", "Hz"),
        ("byte", "B"),
        ("percent", "%"),
        ("lbs", "lb"),
        ("dyne", "dyn"),
    ];
    let lower = symbol.to_lowercase();
    let prefixed = PREFIXES.iter().flat_map(|(prefix, _)| {
        let prefixable = UNITS.iter().filter(|unit| unit.prefixable);
        prefixable.map(move |unit| format!("{prefix}{}", unit.symbol))
    });
    let other_case = UNITS
        .iter()
        .map(|unit| unit.symbol.to_string())
        .chain(prefixed)
        .filter(|known| known.to_lowercase() == lower)
        .min_by_key(|known| strsim::levenshtein(known, symbol));
    other_case.or_else(|| {
        let singular = lower.strip_suffix('s').unwrap_or(&lower);
        let named = NAMES.iter().find(|(name, _)| *name == lower || *name == singular);
        named.map(|(_, symbol)| symbol.to_string())
    })
}
