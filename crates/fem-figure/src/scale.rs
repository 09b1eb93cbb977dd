//! Positions of values along an axis, and its ticks.

use crate::chart::Axis;
use crate::contour::Levels;

/// Free space beside the data of a linear axis, over their range.
const ROOM: f64 = 0.05;

/// Free space on a linear axis.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Room {
    /// The axis ends with the data.
    None,
    /// The axis extends to zero, with room on the other side.
    FromZero,
    /// There is room on both sides, but not beyond zero.
    Around,
}
/// Fewer ticks do not show a scale.
const FEWEST: usize = 3;

/// The range of an axis.
pub(crate) struct Scale {
    from: f64,
    to: f64,
    is_logarithmic: bool,
}

impl Scale {
    /// Returns the given range of the axis, or that of the data with some room; `None` if there is no value to show.
    pub fn of(axis: &Axis, values: impl Iterator<Item = f64>, room: Room) -> Option<Self> {
        let is_logarithmic = axis.is_logarithmic;
        let (mut from, mut to) = axis.range.unwrap_or((f64::INFINITY, f64::NEG_INFINITY));
        if axis.range.is_none() {
            for value in values.filter(|value| axis.shows(*value)) {
                (from, to) = (from.min(value), to.max(value));
            }
            if from > to {
                return None;
            }
            if is_logarithmic {
                let beside = (to / from).powf(ROOM).max(1.2);
                (from, to) = (from / beside, to * beside);
            } else if room != Room::None {
                if room == Room::FromZero {
                    (from, to) = (from.min(0.0), to.max(0.0));
                }
                let beside = ROOM * (to - from);
                let end = |at: f64, by: f64| {
                    let moved = at + by;
                    if at * moved < 0.0 || at == 0.0 { 0.0 } else { moved }
                };
                (from, to) = (end(from, -beside), end(to, beside));
            }
        }
        if from == to {
            (from, to) = (from - 1.0, to + 1.0);
        }
        let is_sound = from < to && (to - from).is_finite() && (!is_logarithmic || from > 0.0);
        is_sound.then_some(Self { from, to, is_logarithmic })
    }

    /// Returns the position of a value: 0 at the beginning of the axis, 1 at its end.
    pub fn share(&self, value: f64) -> f64 {
        match self.is_logarithmic {
            true => (value / self.from).ln() / (self.to / self.from).ln(),
            false => (value - self.from) / (self.to - self.from),
        }
    }

    /// Limits a value to the range.
    pub fn held(&self, value: f64) -> f64 {
        value.clamp(self.from, self.to)
    }

    /// Returns the values of ticks, at most about `n` on a linear axis.
    pub fn ticks(&self, n: usize) -> Vec<f64> {
        if !self.is_logarithmic {
            return ticks((self.from, self.to), n);
        }
        let range = (self.from, self.to);
        match narrow_step(range, n) {
            Some(_) => ticks(range, n),
            None => round_values(range, n),
        }
    }
}

/// Returns powers of ten within a positive range, and 2 and 5 times these if there are few.
fn round_values((from, to): (f64, f64), n: usize) -> Vec<f64> {
    let decades = (to / from).log10();
    let (first, last) = (from.log10().floor() as i32, to.log10().ceil() as i32);
    let stride = ((decades / n as f64).ceil() as usize).max(1);
    let with = |digits: &[f64]| -> Vec<f64> {
        let powers = (first..=last).step_by(stride);
        let all = powers.flat_map(|power| digits.iter().map(move |d| d * 10f64.powi(power)));
        all.filter(|value| (from..=to).contains(value)).collect()
    };
    let powers = with(&[1.0]);
    if powers.len() <= FEWEST { with(&[1.0, 2.0, 5.0]) } else { powers }
}

/// Returns the step of at most about `n` equidistant ticks for a logarithmic axis whose range has hardly any round value.
fn narrow_step((from, to): (f64, f64), n: usize) -> Option<f64> {
    let is_narrow = from > 0.0 && from < to && round_values((from, to), n).len() < FEWEST;
    is_narrow.then(|| Levels::about_zero(0.0, to - from, n).step())
}

/// Returns multiples of 1, 2 or 5 times a power of ten within a range, with at most `n` intervals; none for
/// a range without length.
pub(crate) fn ticks((from, to): (f64, f64), n: usize) -> Vec<f64> {
    let length = to - from;
    if !(length > 0.0 && length.is_finite()) {
        return Vec::new();
    }
    let step = Levels::about_zero(0.0, length, n).step();
    // A tick at the end of the range is kept in spite of rounding.
    let (first, last) = ((from / step - 1e-9).ceil() as i64, (to / step + 1e-9).floor() as i64);
    (first..=last).map(|k| k as f64 * step).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::chart::Chart;
    use crate::curve::Curve;

    #[test]
    fn ticks_are_round_and_within() {
        assert_eq!(ticks((0.0, 62.8), 7), [0.0, 10.0, 20.0, 30.0, 40.0, 50.0, 60.0]);
        assert_eq!(ticks((-0.3, 0.3), 3), [-0.2, 0.0, 0.2]);
        assert!(ticks((1.0, 1.0), 5).is_empty() && ticks((0.0, f64::NAN), 5).is_empty());
    }

    #[test]
    fn axis_from_zero_contains_zero_and_has_headroom() {
        let scale = Scale::of(&Axis::new("F"), [2.0, 100.0].into_iter(), Room::FromZero).unwrap();
        assert_eq!((scale.share(0.0), scale.share(105.0)), (0.0, 1.0));
        let free = Scale::of(&Axis::new("t"), [2.0, 100.0].into_iter(), Room::None).unwrap();
        assert_eq!((free.share(2.0), free.share(100.0)), (0.0, 1.0));
        assert!(Scale::of(&Axis::new("t"), [f64::NAN].into_iter(), Room::Around).is_none());
    }

    #[test]
    fn decades_are_equally_long() {
        let axis = Axis::new("h").logarithmic().from_to(0.01, 1.0);
        let scale = Scale::of(&axis, std::iter::empty(), Room::None).unwrap();
        assert!((scale.share(0.1) - 0.5).abs() < 1e-15);
        assert_eq!(scale.ticks(5).len(), 7);
    }

    #[test]
    fn narrow_logarithmic_axes_have_ticks() {
        for (range, expected) in [
            ((4.1, 4.9), vec![4.2, 4.4, 4.6, 4.8]),
            ((30.0, 60.0), vec![30.0, 40.0, 50.0, 60.0]),
            ((2.5, 12.0), vec![4.0, 6.0, 8.0, 10.0, 12.0]),
        ] {
            let axis = Axis::new("E").logarithmic().from_to(range.0, range.1);
            let found = Scale::of(&axis, std::iter::empty(), Room::None).unwrap().ticks(5);
            assert_eq!(found.len(), expected.len(), "{found:?}");
            assert!(found.iter().zip(expected).all(|(a, b)| (a / b - 1.0).abs() < 1e-12));
        }
        let curve = Curve::points("E", vec![(1.0, 4.2), (2.0, 4.8)]);
        let chart = Chart::new(Axis::new("f"), Axis::new("E").logarithmic()).with(curve);
        let svg = crate::svg(&[chart]).unwrap();
        assert!([">4<", ">4.5<", ">5<", ">5.5<"].iter().all(|tick| svg.contains(tick)));
    }
}
