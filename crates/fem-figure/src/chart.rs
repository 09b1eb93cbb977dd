//! One panel of curves over an axis.

use crate::clip::runs;
use crate::curve::{Curve, LineStyle, Mark};
use crate::style::COLOURS;

/// An axis with its label, unit, kind and range.
#[derive(Debug, Clone, PartialEq)]
pub struct Axis {
    pub(crate) label: String,
    /// Number of the label's units per unit of the values.
    scale: f64,
    pub(crate) is_logarithmic: bool,
    pub(crate) range: Option<(f64, f64)>,
}

impl Axis {
    /// Creates a linear axis; the label names quantity and unit.
    pub fn new(label: impl Into<String>) -> Self {
        Self { label: label.into(), scale: 1.0, is_logarithmic: false, range: None }
    }

    /// Multiplies all values by the number of the label's units per unit of the values.
    pub fn scaled_by(mut self, scale: f64) -> Self {
        self.scale = scale;
        self
    }

    /// Makes the axis logarithmic; points that are not positive are left out.
    pub fn logarithmic(mut self) -> Self {
        self.is_logarithmic = true;
        self
    }

    /// Sets the range of the axis, independent of the data.
    pub fn from_to(mut self, from: f64, to: f64) -> Self {
        self.range = Some((self.scale * from, self.scale * to));
        self
    }

    /// Whether the axis is logarithmic.
    pub fn is_logarithmic(&self) -> bool {
        self.is_logarithmic
    }

    pub(crate) fn shows(&self, value: f64) -> bool {
        self.has_place(value) && self.range.is_none_or(|(from, to)| (from..=to).contains(&value))
    }

    /// Whether the axis can show a value, within its range or not.
    pub(crate) fn has_place(&self, value: f64) -> bool {
        value.is_finite() && (!self.is_logarithmic || value > 0.0)
    }

    /// Returns the position of a value along the axis.
    pub(crate) fn along(&self, value: f64) -> f64 {
        if self.is_logarithmic { value.ln() } else { value }
    }

    /// Returns the value at a position along the axis.
    pub(crate) fn value(&self, along: f64) -> f64 {
        if self.is_logarithmic { along.exp() } else { along }
    }
}

/// An area between two curves.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Band {
    pub(crate) label: String,
    /// Points (x, one end, the other end).
    pub(crate) points: Vec<(f64, f64, f64)>,
    pub(crate) colour: &'static str,
}

/// The visible part of a curve.
pub(crate) struct VisibleCurve<'a> {
    pub(crate) curve: &'a Curve,
    pub(crate) points: Vec<(f64, f64)>,
    /// Pieces of its line.
    pub(crate) runs: Vec<Vec<(f64, f64)>>,
    pub(crate) colour: &'a str,
    pub(crate) style: LineStyle,
}

/// A panel of curves and bands.
#[derive(Debug, Clone, PartialEq)]
pub struct Chart {
    pub(crate) x: Axis,
    pub(crate) y: Axis,
    pub(crate) title: Option<String>,
    pub(crate) bands: Vec<Band>,
    curves: Vec<Curve>,
}

impl Chart {
    /// Creates a panel without curves.
    pub fn new(x: Axis, y: Axis) -> Self {
        Self { x, y, title: None, bands: Vec::new(), curves: Vec::new() }
    }

    /// Sets the title above the panel.
    pub fn titled(mut self, title: impl Into<String>) -> Self {
        self.title = Some(title.into());
        self
    }

    /// Adds a curve.
    pub fn with(mut self, mut curve: Curve) -> Self {
        let (x, y) = (self.x.scale, self.y.scale);
        curve.points.iter_mut().for_each(|point| *point = (x * point.0, y * point.1));
        curve.errors.iter_mut().for_each(|error| *error *= y);
        self.curves.push(curve);
        self
    }

    /// Adds a shaded area behind the curves, by finite points (x, one end, the other end).
    pub fn with_band(
        mut self,
        label: impl Into<String>,
        points: Vec<(f64, f64, f64)>,
        colour: &'static str,
    ) -> Self {
        let (x, y) = (self.x.scale, self.y.scale);
        let points = points.into_iter().map(|(at, from, to)| (x * at, y * from, y * to)).collect();
        self.bands.push(Band { label: label.into(), points, colour });
        self
    }

    /// Whether there is no point to draw.
    pub(crate) fn is_empty(&self) -> bool {
        self.drawn().all(|drawn| drawn.points.is_empty())
    }

    /// Returns the visible part of each curve.
    pub(crate) fn drawn(&self) -> impl Iterator<Item = VisibleCurve<'_>> {
        self.curves.iter().enumerate().map(|(k, curve)| {
            let visible = |(x, y): &&(f64, f64)| self.x.shows(*x) && self.y.shows(*y);
            let style = curve.style.unwrap_or(LineStyle::of_curve(k));
            VisibleCurve {
                curve,
                points: curve.points.iter().filter(visible).copied().collect(),
                runs: if curve.mark == Mark::Points { Vec::new() } else { runs(self, curve) },
                colour: curve.colour.as_deref().unwrap_or(COLOURS[k % COLOURS.len()]),
                style,
            }
        })
    }
}
