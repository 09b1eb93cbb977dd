//! Chart axes of physical quantities, in a unit with the prefix that fits the values.

use fem_case::engineering::Unit;
use fem_figure::{Axis, Chart};

/// SI units that take a prefix on an axis; all others are written as they are.
const PREFIXED: [&str; 6] = ["m", "m/s", "s", "N", "Pa", "J"];
/// Positive values that span this ratio go on a logarithmic axis.
const LOGARITHMIC_FROM: f64 = 10.0;

/// Positive values that span this ratio have the unit without a prefix.
const MANY: f64 = 1e4;

/// One quantity along an axis: its name, its unit and whether the axis is logarithmic.
#[derive(Debug)]
pub struct QuantityAxis {
    name: String,
    symbol: &'static str,
    /// `None` for a quantity whose unit takes no prefix.
    unit: Option<Unit>,
    is_positive: bool,
    is_logarithmic: bool,
    range: Option<(f64, f64)>,
}

impl QuantityAxis {
    /// A linear axis for values of this size (SI); an empty symbol stands for no unit.
    pub fn linear(name: impl Into<String>, symbol: &'static str, largest: f64) -> Self {
        let unit = PREFIXED.contains(&symbol).then(|| Unit::fitting(largest, symbol));
        let name = name.into();
        Self { name, symbol, unit, is_positive: false, is_logarithmic: false, range: None }
    }

    /// An axis for these values (SI), logarithmic if they are positive and span a decade, and without a prefix if they span many.
    pub fn fitting(
        name: impl Into<String>,
        symbol: &'static str,
        values: impl Iterator<Item = f64>,
    ) -> Self {
        let (from, to) = range(values);
        Self {
            is_positive: from > 0.0,
            is_logarithmic: from > 0.0 && to >= LOGARITHMIC_FROM * from,
            ..Self::linear(
                name,
                symbol,
                if to > MANY * from && from > 0.0 { 1.0 } else { to.abs().max(from.abs()) },
            )
        }
    }

    /// The same axis, logarithmic.
    pub fn logarithmic(mut self) -> Self {
        self.is_logarithmic = true;
        self
    }

    /// The same axis, logarithmic if its values are positive.
    pub fn logarithmic_if_positive(mut self) -> Self {
        self.is_logarithmic |= self.is_positive;
        self
    }

    /// The same axis, not logarithmic.
    pub fn not_logarithmic(mut self) -> Self {
        self.is_logarithmic = false;
        self
    }

    /// The same axis from one value to another (SI).
    pub fn from_to(mut self, from: f64, to: f64) -> Self {
        self.range = Some((self.scaled(from), self.scaled(to)));
        self
    }

    /// Whether the axis is logarithmic.
    pub fn is_logarithmic(&self) -> bool {
        self.is_logarithmic
    }

    /// Returns a value (SI) in the axis' unit.
    pub fn scaled(&self, value: f64) -> f64 {
        self.unit.as_ref().map_or(value, |unit| unit.scaled(value))
    }

    /// Returns points (x, y) in SI in the units of this axis and of a vertical one.
    pub fn points(&self, y: &Self, points: &[(f64, f64)]) -> Vec<(f64, f64)> {
        points.iter().map(|point| (self.scaled(point.0), y.scaled(point.1))).collect()
    }

    /// Returns the axis for a chart, labelled `name [unit]`.
    pub fn axis(&self) -> Axis {
        let label = match self.unit.as_ref().map_or(self.symbol, Unit::symbol) {
            "" => self.name.clone(),
            symbol => format!("{} [{symbol}]", self.name),
        };
        let axis = Axis::new(label);
        let axis = if self.is_logarithmic { axis.logarithmic() } else { axis };
        match self.range {
            Some((from, to)) => axis.from_to(from, to),
            None => axis,
        }
    }
}

/// Returns an empty chart with these axes.
pub fn chart_axes(x: &QuantityAxis, y: &QuantityAxis) -> Chart {
    Chart::new(x.axis(), y.axis())
}

/// Returns the smallest and the largest finite value; (∞, −∞) without any.
pub(crate) fn range(values: impl Iterator<Item = f64>) -> (f64, f64) {
    let finite = values.filter(|value| value.is_finite());
    finite.fold((f64::INFINITY, f64::NEG_INFINITY), |(from, to), value| {
        (from.min(value), to.max(value))
    })
}
