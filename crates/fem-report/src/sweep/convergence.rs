//! Convergence of a sweep's members over the key that controls their resolution. Both axes are logarithmic, so
//! an error that is a power of the element size, the time step or a tolerance is a straight line.

use fem::accuracy::{Convergence, ObservedOrder};
use fem::sweep::column_words;
use fem_figure::{Axis, Chart, Curve as Line, GREY};

use super::curves::SweepCurve;

/// Smaller errors are rounding and noise; they are drawn here.
const MIN_DRAWN_ERROR: f64 = 1e-6;
/// Smallest ratio of errors that an axis spans.
const MIN_RATIO: f64 = 10.0;
/// Most orders that a title lists one by one.
const MAX_ORDERS: usize = 3;
/// Fewest levels that show convergence.
const MIN_LEVELS: usize = 3;

/// Keys that control the resolution, by their last parts, and whether a larger value is finer.
const KEYS: [(&[&str], bool); 7] = [
    (&["mesh", "contact_element_size"], false),
    (&["contact", "penalty_factor"], true),
    (&["time", "step_factor"], false),
    (&["time", "mass_scaling"], false),
    (&["accuracy", "tolerance"], false),
    (&["condensed", "steps"], true),
    (&["ting", "tolerance"], false),
];

/// A varied key that controls the resolution: a size h, or a number n with h = 1/n.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct ResolutionKey {
    is_reciprocal: bool,
}

impl ResolutionKey {
    /// Returns the resolution key of a varied key; `None` if it is physics.
    pub fn of(key: &str) -> Option<Self> {
        let parts: Vec<&str> = key.split('.').collect();
        let known = KEYS.into_iter().find(|(ending, _)| parts.ends_with(ending));
        known.map(|(_, is_reciprocal)| Self { is_reciprocal })
    }

    /// Returns h for a value of the key, and the value for h.
    fn of_value(self, value: f64) -> f64 {
        if self.is_reciprocal { value.recip() } else { value }
    }
}

/// A curve and its limit.
pub struct ConvergingCurve {
    /// Values of the key.
    places: Vec<f64>,
    found: Convergence,
    /// Errors over the key's values, relative except for the restitution.
    errors: Vec<(f64, f64)>,
    /// Scale of relative errors.
    scale: f64,
}

impl ConvergingCurve {
    /// Extrapolates a curve; `None` if it has fewer than three levels, or two of the same size.
    pub fn of(resolution: ResolutionKey, column: &str, curve: &SweepCurve) -> Option<Self> {
        let usable = curve.points.iter().filter(|(x, y, _)| *x > 0.0 && y.is_finite());
        let levels: Vec<(f64, f64)> =
            usable.map(|(x, y, _)| (resolution.of_value(*x), *y)).collect();
        let mut sizes: Vec<f64> = levels.iter().map(|(h, _)| *h).collect();
        sizes.sort_by(f64::total_cmp);
        sizes.dedup();
        if sizes.len() < MIN_LEVELS || sizes.len() < levels.len() {
            return None;
        }
        let found = Convergence::of(&levels)?;
        let scale = if column == "restitution" { 1.0 } else { found.limit.abs() };
        // The finest level is the reference and has no error.
        let estimated = levels.iter().filter(|(h, _)| found.is_extrapolated || *h > sizes[0]);
        let error = |(h, q): &(f64, f64)| {
            (resolution.of_value(*h), ((q - found.limit).abs() / scale).max(MIN_DRAWN_ERROR))
        };
        let mut errors: Vec<(f64, f64)> = estimated.map(error).collect();
        errors.sort_by(|a, b| a.0.total_cmp(&b.0));
        let places = curve.points.iter().map(|point| point.0).collect();
        (scale > 0.0 && scale.is_finite()).then_some(Self { places, found, errors, scale })
    }

    /// Returns the line of the observed order, where it is above the noise.
    fn order_line(&self, resolution: ResolutionKey) -> Vec<(f64, f64)> {
        let Some(ObservedOrder { order, factor, .. }) = self.found.order else { return Vec::new() };
        let power = |x: f64| factor * resolution.of_value(x).powf(order);
        // Without a limit the finest member is the reference.
        let sizes = self.places.iter().map(|x| power(*x));
        let finest = sizes.fold(f64::INFINITY, f64::min);
        let reference = if self.found.is_extrapolated { 0.0 } else { finest };
        let error = |x: f64| (power(x) - reference) / self.scale;
        let places = self.errors.iter().map(|(x, _)| (*x, error(*x)));
        places.filter(|(_, error)| *error >= MIN_DRAWN_ERROR).collect()
    }

    /// Returns the extrapolated limit over the key's values; empty if the limit is the finest member itself.
    pub fn limit(&self) -> Vec<(f64, f64)> {
        if !self.found.is_extrapolated {
            return Vec::new();
        }
        self.places.iter().map(|x| (*x, self.found.limit)).collect()
    }
}

/// Returns the panel of a column over the axis `x`; `coloured` gives a line the colour of its curve.
pub fn convergence_chart(
    resolution: ResolutionKey,
    column: &str,
    converging: &[Option<ConvergingCurve>],
    x: Axis,
    coloured: &dyn Fn(Line, usize) -> Line,
) -> Chart {
    let all = || converging.iter().flatten();
    let largest =
        all().flat_map(|one| &one.errors).map(|(_, error)| *error).fold(MIN_DRAWN_ERROR, f64::max);
    let smallest = all().flat_map(|one| &one.errors).map(|(_, error)| *error);
    let smallest =
        smallest.fold(f64::INFINITY, f64::min).min(largest / MIN_RATIO).max(MIN_DRAWN_ERROR);
    let words = column_words(column);
    let against = if all().any(|one| one.found.is_extrapolated) { "limit" } else { "finest" };
    let label = match column {
        "restitution" => format!("|{words} − {against}|"),
        _ => format!("|{words} / {against} − 1|"),
    };
    let largest = largest.max(MIN_RATIO * smallest);
    let y_axis = Axis::new(label).logarithmic().from_to(smallest / 1.5, largest * 1.5);
    let mut chart = Chart::new(x, y_axis).titled(title(&words, converging));
    for (k, one) in converging.iter().enumerate() {
        let Some(one) = one else { continue };
        chart = chart.with(coloured(Line::points("", one.errors.clone()), k));
        chart = chart.with(coloured(Line::dashed("", one.order_line(resolution)), k));
    }
    let known = all().map(|one| one.found.uncertainty / one.scale).fold(0.0, f64::max);
    let ends = all().flat_map(|one| one.places.iter().copied());
    let (from, to) = ends.fold((f64::INFINITY, 0.0_f64), |(a, b), x| (a.min(x), b.max(x)));
    if known > smallest && known < largest && from < to {
        let line = vec![(from, known), (to, known)];
        chart = chart.with(Line::line("uncertainty of the limit", line).coloured(GREY));
    }
    if all().any(|one| one.found.order.is_some()) {
        chart = chart.with(Line::dashed("observed order", Vec::new()).coloured(GREY));
    }
    chart
}

/// Returns the title of a panel: the quantity and its observed orders.
fn title(words: &str, converging: &[Option<ConvergingCurve>]) -> String {
    let all = || converging.iter().flatten();
    if all().all(|one| one.errors.iter().all(|(_, error)| *error <= MIN_DRAWN_ERROR)) {
        return format!("{words}: all within {MIN_DRAWN_ERROR:e}");
    }
    let mut orders: Vec<ObservedOrder> = all().filter_map(|one| one.found.order).collect();
    orders.sort_by(|a, b| a.order.total_cmp(&b.order));
    let said = |seen: &ObservedOrder| format!("{:.1} ± {:.1}", seen.order, seen.standard_error);
    match orders.as_slice() {
        [] => format!("{words}: no order observed"),
        [one] => format!("{words}: order {}", said(one)),
        few if few.len() <= MAX_ORDERS => {
            let few: Vec<String> = few.iter().map(said).collect();
            format!("{words}: orders {}", few.join(", "))
        }
        [least, .., most] => {
            format!("{words}: orders {:.1} to {:.1}", least.order, most.order)
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn curve(sizes: &[f64], value: impl Fn(f64) -> f64) -> SweepCurve {
        let points = sizes.iter().map(|h| (*h, value(*h), 0.0)).collect();
        SweepCurve {
            label: String::new(),
            place: Vec::new(),
            number: None,
            points,
            bounds: Vec::new(),
            reference: Vec::new(),
        }
    }

    fn order(key: &str, values: &[f64], q: impl Fn(f64) -> f64) -> Option<f64> {
        let curve = curve(values, q);
        let converging = ConvergingCurve::of(ResolutionKey::of(key)?, "contact_time_s", &curve)?;
        converging.found.order.map(|seen| seen.order)
    }

    #[test]
    fn convergence_order_is_given_for_numerical_keys_only() {
        let size = "mesh.contact_element_size";
        let sizes = [80e-6, 56e-6, 40e-6, 28e-6, 20e-6];
        let found = order(size, &sizes, |h| 6e-5 + 2e3 * h * h).unwrap();
        assert!((found - 2.0).abs() < 1e-3, "{found}");
        // The order of a number of steps n refers to 1/n.
        let steps = [50.0, 100.0, 200.0, 400.0];
        let found = order("model.condensed.steps", &steps, |n| 6e-5 + 1e-5 / n).unwrap();
        assert!((found - 1.0).abs() < 1e-3, "{found}");
        assert_eq!(ResolutionKey::of("body.0.approach_speed"), None);
        assert_eq!(ResolutionKey::of("material.glass.youngs_modulus"), None);
    }

    #[test]
    fn noise_has_no_order() {
        let size = "mesh.contact_element_size";
        let sizes = [80e-6, 56e-6, 40e-6, 28e-6, 20e-6];
        let noise = |h: f64| 6e-5 * (1.0 + 1e-8 * (h * 1e9).sin());
        assert_eq!(order(size, &sizes, noise), None);
        let scattered = |h: f64| 6e-5 * (1.0 + 1e-2 * (h * 1e6).sin());
        assert_eq!(order(size, &sizes, scattered), None);
        let all = curve(&sizes, noise);
        let converging =
            ConvergingCurve::of(ResolutionKey::of(size).unwrap(), "contact_time_s", &all);
        assert_eq!(title("T", &[converging]), "T: all within 1e-6");
        // Two levels are too few; levels of equal size differ in another key.
        assert_eq!(order(size, &sizes[..2], |h| h), None);
        assert_eq!(order(size, &[1.0, 1.0, 2.0, 3.0], |h| h), None);
    }
}
