//! How far members of a sweep are from what they converge to, over what makes them finer: both axes
//! logarithmic, so that a power of the element size, the step or a tolerance is a straight line of its order.

use fem::accuracy::{Convergence, ObservedOrder};
use fem::sweep::column_words;
use fem_figure::{Axis, Chart, Curve as Line, GREY};

use super::picture_curves::Curve;

/// Errors below this are rounding and noise, and drawn there.
const LEAST: f64 = 1e-6;
/// No axis shows less than this ratio of errors.
const LEAST_RATIO: f64 = 10.0;
/// Orders that a title names one by one.
const MOST_ORDERS: usize = 3;
/// Levels that say anything about convergence.
const FEWEST_LEVELS: usize = 3;

/// Keys of a case that its numbers converge with, by their last parts, and whether a larger value is finer.
const KEYS: [(&[&str], bool); 7] = [
    (&["mesh", "contact_element_size"], false),
    (&["contact", "penalty_factor"], true),
    (&["time", "step_factor"], false),
    (&["time", "mass_scaling"], false),
    (&["accuracy", "tolerance"], false),
    (&["condensed", "steps"], true),
    (&["ting", "tolerance"], false),
];

/// What makes members of a sweep finer: h, or 1/n of a number n.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Fineness {
    is_reciprocal: bool,
}

impl Fineness {
    /// Of a varied key; none of one that is physics.
    pub fn of(key: &str) -> Option<Self> {
        let parts: Vec<&str> = key.split('.').collect();
        let known = KEYS.into_iter().find(|(ending, _)| parts.ends_with(ending));
        known.map(|(_, is_reciprocal)| Self { is_reciprocal })
    }

    /// h of the key's value.
    fn of_value(self, value: f64) -> f64 {
        if self.is_reciprocal { value.recip() } else { value }
    }
}

/// A curve and what it converges to.
pub struct Converging {
    /// The key's values.
    places: Vec<f64>,
    found: Convergence,
    /// Errors over the key's values, relative but for the restitution.
    errors: Vec<(f64, f64)>,
    /// What errors are told in.
    scale: f64,
}

impl Converging {
    /// None of a curve with fewer than three levels, or none of them finer than others.
    pub fn of(fineness: Fineness, column: &str, curve: &Curve) -> Option<Self> {
        let usable = curve.points.iter().filter(|(x, y, _)| *x > 0.0 && y.is_finite());
        let levels: Vec<(f64, f64)> = usable.map(|(x, y, _)| (fineness.of_value(*x), *y)).collect();
        let mut sizes: Vec<f64> = levels.iter().map(|(h, _)| *h).collect();
        sizes.sort_by(f64::total_cmp);
        sizes.dedup();
        if sizes.len() < FEWEST_LEVELS || sizes.len() < levels.len() {
            return None;
        }
        let found = Convergence::of(&levels)?;
        let scale = if column == "restitution" { 1.0 } else { found.limit.abs() };
        // The finest level has no error against itself.
        let told = levels.iter().filter(|(h, _)| found.is_extrapolated || *h > sizes[0]);
        let error = |(h, q): &(f64, f64)| {
            (fineness.of_value(*h), ((q - found.limit).abs() / scale).max(LEAST))
        };
        let mut errors: Vec<(f64, f64)> = told.map(error).collect();
        errors.sort_by(|a, b| a.0.total_cmp(&b.0));
        let places = curve.points.iter().map(|point| point.0).collect();
        (scale > 0.0 && scale.is_finite()).then_some(Self { places, found, errors, scale })
    }

    /// The line of the observed order at the levels' places, where it is above the noise.
    fn line(&self, fineness: Fineness) -> Vec<(f64, f64)> {
        let Some(ObservedOrder { order, factor, .. }) = self.found.order else { return Vec::new() };
        let power = |x: f64| factor * fineness.of_value(x).powf(order);
        // The finest member has no error against itself.
        let sizes = self.places.iter().map(|x| power(*x));
        let finest = sizes.fold(f64::INFINITY, f64::min);
        let reference = if self.found.is_extrapolated { 0.0 } else { finest };
        let error = |x: f64| (power(x) - reference) / self.scale;
        let places = self.errors.iter().map(|(x, _)| (*x, error(*x)));
        places.filter(|(_, error)| *error >= LEAST).collect()
    }

    /// What the curve converges to, over its places; empty where it is the finest member itself.
    pub fn limit(&self) -> Vec<(f64, f64)> {
        if !self.found.is_extrapolated {
            return Vec::new();
        }
        self.places.iter().map(|x| (*x, self.found.limit)).collect()
    }
}

/// The panel of a column; `drawn` gives a curve its colour, `horizontal` its place and the axis.
pub fn chart(
    fineness: Fineness,
    column: &str,
    converging: &[Option<Converging>],
    (x_axis, x_place): (Axis, &dyn Fn(f64) -> f64),
    drawn: &dyn Fn(Line, usize) -> Line,
) -> Chart {
    let all = || converging.iter().flatten();
    let largest = all().flat_map(|one| &one.errors).map(|(_, error)| *error).fold(LEAST, f64::max);
    let smallest = all().flat_map(|one| &one.errors).map(|(_, error)| *error);
    let smallest = smallest.fold(f64::INFINITY, f64::min).min(largest / LEAST_RATIO).max(LEAST);
    let words = column_words(column);
    let against = if all().any(|one| one.found.is_extrapolated) { "limit" } else { "finest" };
    let label = match column {
        "restitution" => format!("|{words} − {against}|"),
        _ => format!("|{words} / {against} − 1|"),
    };
    let largest = largest.max(LEAST_RATIO * smallest);
    let y_axis = Axis::new(label).logarithmic().from_to(smallest / 1.5, largest * 1.5);
    let mut chart = Chart::new(x_axis, y_axis).titled(title(&words, converging));
    let placed = |points: Vec<(f64, f64)>| -> Vec<(f64, f64)> {
        points.into_iter().map(|(x, error)| (x_place(x), error)).collect()
    };
    for (k, one) in converging.iter().enumerate() {
        let Some(one) = one else { continue };
        chart = chart.with(drawn(Line::points("", placed(one.errors.clone())), k));
        chart = chart.with(drawn(Line::dashed("", placed(one.line(fineness))), k));
    }
    let known = all().map(|one| one.found.uncertainty / one.scale).fold(0.0, f64::max);
    let ends = all().flat_map(|one| one.places.iter().copied());
    let (from, to) = ends.fold((f64::INFINITY, 0.0_f64), |(a, b), x| (a.min(x), b.max(x)));
    if known > smallest && known < largest && from < to {
        let line = placed(vec![(from, known), (to, known)]);
        chart = chart.with(Line::line("the reference is known to this", line).coloured(GREY));
    }
    if all().any(|one| one.found.order.is_some()) {
        chart = chart.with(Line::dashed("observed order", Vec::new()).coloured(GREY));
    }
    chart
}

/// The orders in words.
fn title(words: &str, converging: &[Option<Converging>]) -> String {
    let all = || converging.iter().flatten();
    if all().all(|one| one.errors.iter().all(|(_, error)| *error <= LEAST)) {
        return format!("{words}: all within {LEAST:e}");
    }
    let mut orders: Vec<ObservedOrder> = all().filter_map(|one| one.found.order).collect();
    orders.sort_by(|a, b| a.order.total_cmp(&b.order));
    let said = |seen: &ObservedOrder| format!("{:.1} ± {:.1}", seen.order, seen.standard_error);
    match orders.as_slice() {
        [] => format!("{words}: no order seen"),
        [one] => format!("{words}: order {}", said(one)),
        few if few.len() <= MOST_ORDERS => {
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

    fn curve(sizes: &[f64], value: impl Fn(f64) -> f64) -> Curve {
        let points = sizes.iter().map(|h| (*h, value(*h), 0.0)).collect();
        Curve { label: String::new(), number: None, points, reference: Vec::new() }
    }

    fn order(key: &str, values: &[f64], q: impl Fn(f64) -> f64) -> Option<f64> {
        let curve = curve(values, q);
        let converging = Converging::of(Fineness::of(key)?, "contact_time_s", &curve)?;
        converging.found.order.map(|seen| seen.order)
    }

    #[test]
    fn numerical_keys_have_orders_and_physics_has_none() {
        let size = "mesh.contact_element_size";
        let sizes = [80e-6, 56e-6, 40e-6, 28e-6, 20e-6];
        let found = order(size, &sizes, |h| 6e-5 + 2e3 * h * h).unwrap();
        assert!((found - 2.0).abs() < 1e-3, "{found}");
        // Of a number of steps the order is that of the step.
        let steps = [50.0, 100.0, 200.0, 400.0];
        let found = order("model.condensed.steps", &steps, |n| 6e-5 + 1e-5 / n).unwrap();
        assert!((found - 1.0).abs() < 1e-3, "{found}");
        assert_eq!(Fineness::of("body.0.approach_speed"), None);
        assert_eq!(Fineness::of("material.glass.youngs_modulus"), None);
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
        let converging = Converging::of(Fineness::of(size).unwrap(), "contact_time_s", &all);
        assert_eq!(title("T", &[converging]), "T: all within 1e-6");
        // Two levels are no sequence, and a size that is there twice is one over something else.
        assert_eq!(order(size, &sizes[..2], |h| h), None);
        assert_eq!(order(size, &[1.0, 1.0, 2.0, 3.0], |h| h), None);
    }
}
