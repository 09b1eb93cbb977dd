//! Chart axes of physical quantities: values in SI, drawn in a unit with the prefix that fits them.

use fem_case::engineering::Unit;
use fem_figure::Axis;

/// SI units that take a prefix on an axis; all others are written as they are.
const PREFIXED: [&str; 6] = ["m", "m/s", "s", "N", "Pa", "J"];
/// Positive values that span this ratio go on a logarithmic axis.
pub(crate) const DECADE: f64 = 10.0;
/// Positive values that span this ratio have the unit without a prefix.
const MANY: f64 = 1e4;

/// Returns a linear axis `name [unit]` for values of this size; an empty symbol stands for no unit.
pub fn quantity_axis(name: impl AsRef<str>, symbol: &str, largest: f64) -> Axis {
    let name = name.as_ref();
    if PREFIXED.contains(&symbol) {
        let unit = Unit::fitting(largest, symbol);
        return Axis::new(format!("{name} [{}]", unit.symbol())).scaled_by(unit.scaled(1.0));
    }
    Axis::new(if symbol.is_empty() { name.to_string() } else { format!("{name} [{symbol}]") })
}

/// Returns an axis for these values, without a prefix if they span many decades, and logarithmic if they are positive and span
/// at least this ratio.
pub(crate) fn fitting_axis(
    name: impl AsRef<str>,
    symbol: &str,
    values: impl Iterator<Item = f64>,
    logarithmic_from: f64,
) -> Axis {
    let (from, to) = range(values);
    let has_prefix = !(from > 0.0 && to > MANY * from);
    let largest = if has_prefix { to.abs().max(from.abs()) } else { 1.0 };
    let axis = quantity_axis(name, symbol, largest);
    if from > 0.0 && to >= logarithmic_from * from { axis.logarithmic() } else { axis }
}

/// Returns the smallest and the largest finite value; (∞, −∞) without any.
pub(crate) fn range(values: impl Iterator<Item = f64>) -> (f64, f64) {
    let finite = values.filter(|value| value.is_finite());
    finite.fold((f64::INFINITY, f64::NEG_INFINITY), |(from, to), value| {
        (from.min(value), to.max(value))
    })
}
