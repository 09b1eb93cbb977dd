//! A series of flights between bounces: instants that are missing or too many, and the scatter of the others.
//!
//! The flights of a ball whose restitution varies little from bounce to bounce are nearly a geometric series. A flight
//! that is longer than its neighbours allow by the sum of a second or a third flight spans several bounces; one that is
//! too short ends at an instant that is no bounce. A time that fits neither way is no flight: another drop begins after it.

use std::cmp::Ordering;

use nalgebra::DVector;
use statrs::distribution::{ContinuousCDF, FisherSnedecor};

use crate::estimate::{CONFIDENCE, median, quantile};

/// A flight between two instants of a record.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FlightSpan {
    /// Index of the instant at its beginning.
    pub from: usize,
    /// Index of the instant at its end.
    pub to: usize,
    /// Number of flights of the ball in it; above 1 if instants are missing, 0 between two drops.
    pub n_flights: usize,
}

/// Most flights of the ball between two instants, and most instants that are no bounce in one flight, plus one.
const MAX_JOINED: usize = 3;
/// Misfit at which a time between two instants is that between two drops: e times more or less than any number of flights.
const BETWEEN_DROPS: f64 = 1.0;
/// Ratio of a flight to the one before from which one of both is none: no ball gains energy, and shorter flights scatter.
const LARGEST_RATIO: f64 = 1.05;
/// Spans that are looked at after one to decide about it.
const LOOK_AHEAD: usize = 2;
/// Ratios of flights on either side that decide what is usual.
const NEIGHBOURS: usize = 3;
/// Fewest flights in which missing instants are searched.
const FEWEST: usize = 4;
/// Most terms of the polynomial through the logarithms of flight times.
pub(super) const MAX_TERMS: usize = 5;
/// Fewest degrees of freedom of a polynomial that is no line, and of the fit without a bad instant.
pub(super) const FEWEST_FREEDOM: f64 = 2.0;
/// Steps of the fit to the durations, from their logarithms.
const NEWTON_STEPS: usize = 4;
/// Probability below which a fit is not better by chance: with one more term, or without a bad instant. Of 2,600 records with one to
/// three bad instants 15 have a restitution that is off by more than three bars.
pub(super) const CHANCE: f64 = 1e-3;

/// Returns the flights between increasing instants.
pub(super) fn flight_spans(instants: &[f64]) -> Vec<FlightSpan> {
    let n = instants.len().saturating_sub(1);
    if n < FEWEST {
        return (0..n).map(|from| FlightSpan { from, to: from + 1, n_flights: 1 }).collect();
    }
    let lasts: Vec<f64> = instants.windows(2).map(|pair| pair[1] - pair[0]).collect();
    // The ratio of the flight k + 1 to the flight k, and what its neighbours have in the median.
    let ratios: Vec<f64> = lasts.windows(2).map(|pair| pair[1] / pair[0]).collect();
    let usual = |k: usize| {
        let k = k.min(ratios.len() - 1);
        let (from, to) = (k.saturating_sub(NEIGHBOURS), (k + NEIGHBOURS + 1).min(ratios.len()));
        median(&ratios[from..to]).clamp(0.02, 0.999)
    };
    let unusual = |k: usize| (ratios[k] / usual(k)).ln().abs();
    // A flight with usual ratios on both sides is one of the ball; the others follow from it in both directions.
    let sum = |k: &usize| unusual(k - 1) + unusual(*k);
    let anchor = (1..n - 1).min_by(|a, b| sum(a).total_cmp(&sum(b))).unwrap_or(1);
    let after = steps(&lasts[anchor..], |k| usual(anchor + k));
    let before: Vec<f64> = lasts[..=anchor].iter().rev().copied().collect();
    let before = steps(&before, |k| 1.0 / usual(anchor.saturating_sub(k + 1)));
    let mut spans = Vec::new();
    let mut from = anchor;
    for (n_steps, n_flights) in before {
        spans.push(FlightSpan { from: from - n_steps, to: from, n_flights });
        from -= n_steps;
    }
    spans.reverse();
    spans.push(FlightSpan { from: anchor, to: anchor + 1, n_flights: 1 });
    let mut from = anchor + 1;
    for (n_steps, n_flights) in after {
        spans.push(FlightSpan { from, to: from + n_steps, n_flights });
        from += n_steps;
    }
    leave_impossible_out(&mut spans, instants, usual);
    spans
}

/// Marks flights as none that are neighbours of a shorter flight before or a longer one after: of both the one that fits its other
/// neighbour less. `usual(k)` is the usual ratio of the durations k + 1 and k.
fn leave_impossible_out(spans: &mut [FlightSpan], instants: &[f64], usual: impl Fn(usize) -> f64) {
    // The first or the last flight of the ball in a span, s.
    let flight = |span: &FlightSpan, e: f64, k: i32| {
        let sum: f64 = (0..span.n_flights).map(|k| e.powi(k as i32)).sum();
        (instants[span.to] - instants[span.from]) * e.powi(k) / sum
    };
    let misfit = |spans: &[FlightSpan], k: usize| {
        let [before, after] = [spans.get(k)?, spans.get(k + 1)?];
        let e = usual(before.from);
        let are_flights = before.n_flights > 0 && after.n_flights > 0;
        let ratio = flight(after, e, 0) / flight(before, e, before.n_flights as i32 - 1);
        are_flights.then(|| (ratio, (ratio / e).ln().abs()))
    };
    // Between a flight and a longer one no bounces are missing.
    for k in 1..spans.len().saturating_sub(1) {
        let lasts = |k: usize| instants[spans[k].to] - instants[spans[k].from];
        if spans[k].n_flights > 1 && lasts(k + 1) > LARGEST_RATIO * lasts(k - 1) {
            spans[k].n_flights = 0;
        }
    }
    for k in 0..spans.len().saturating_sub(1) {
        let Some((ratio, own)) = misfit(spans, k) else { continue };
        let e = usual(spans[k].from);
        if ratio < LARGEST_RATIO || own < 0.5 * (1.0 + e).ln() {
            continue;
        }
        let fit_of = |k: Option<usize>| k.and_then(|k| misfit(spans, k)).map(|(_, misfit)| misfit);
        let [before, after] = [fit_of(k.checked_sub(1)), fit_of(Some(k + 1))];
        let [before, after] = [before, after].map(|misfit| misfit.unwrap_or(f64::INFINITY));
        // Of a single flight and several the several are none.
        let is_first = match spans[k].n_flights.cmp(&spans[k + 1].n_flights) {
            Ordering::Greater => true,
            Ordering::Less => false,
            Ordering::Equal => before >= after,
        };
        spans[if is_first { k } else { k + 1 }].n_flights = 0;
    }
}

/// Returns the spans of each drop.
pub(super) fn drops(spans: &[FlightSpan]) -> impl Iterator<Item = &[FlightSpan]> {
    spans.split(|span| span.n_flights == 0).filter(|drop| !drop.is_empty())
}

/// Goes along durations, the first of which is one flight of the ball. Returns, for each span after it, how many durations
/// it joins and how many flights it has; `usual(k)` is the ratio of two flights after the duration k.
fn steps(lasts: &[f64], usual: impl Fn(usize) -> f64) -> Vec<(usize, usize)> {
    let (mut found, mut at, mut last) = (Vec::new(), 1, lasts[0]);
    while at < lasts.len() {
        let step = best_step(lasts, &usual, at, last, LOOK_AHEAD);
        found.push(step.choice);
        (at, last) = (step.at, step.last);
    }
    found
}

/// A span after others.
struct Step {
    choice: (usize, usize),
    /// The duration after it.
    at: usize,
    /// The last flight of the ball in it, s; NaN between two drops.
    last: f64,
    /// Logarithm of its duration over what is usual, and of those after it, with a penalty for unusual spans.
    misfit: f64,
}

/// Returns the step at a duration, after the flight `last` (s), that makes it and the `ahead` next ones most usual.
fn best_step(
    lasts: &[f64],
    usual: &impl Fn(usize) -> f64,
    at: usize,
    last: f64,
    ahead: usize,
) -> Step {
    let e = usual(at - 1);
    // What is nearly usual is not questioned, since restitutions scatter.
    let penalty = 0.5 * (1.0 + e.min(1.0 / e)).ln();
    let step = |(n_steps, n_flights): (usize, usize)| {
        let whole: f64 = lasts[at..at + n_steps].iter().sum();
        // The sum of the flights over the first of them.
        let sum: f64 = (0..n_flights).map(|k| e.powi(k as i32)).sum();
        let own = match (n_steps, n_flights) {
            (_, 0) => BETWEEN_DROPS,
            // The first flight of a drop has any duration.
            (1, 1) if last.is_nan() => 0.0,
            (1, 1) => (whole / (last * e)).ln().abs(),
            _ => (whole / (last * e * sum)).ln().abs() + penalty,
        };
        let last =
            if n_flights == 0 { f64::NAN } else { whole * e.powi(n_flights as i32 - 1) / sum };
        let at = at + n_steps;
        let next = (ahead > 0 && at < lasts.len())
            .then(|| best_step(lasts, usual, at, last, ahead - 1).misfit);
        Step { choice: (n_steps, n_flights), at, last, misfit: own + next.unwrap_or(0.0) }
    };
    let mut best = step((1, 1));
    if best.misfit <= penalty || last.is_nan() {
        return best;
    }
    let longer = (2..=MAX_JOINED).map(|m| (1, m));
    let joined = (2..=MAX_JOINED.min(lasts.len() - at)).map(|n_steps| (n_steps, 1));
    for other in longer.chain(joined).chain([(1, 0)]).map(step) {
        if other.misfit < best.misfit {
            best = other;
        }
    }
    best
}

/// Returns the factor from a standard deviation with few degrees of freedom to the standard uncertainty, twice which is the
/// half-width of a 95 % interval: Student's quantile over that of the normal distribution.
pub(super) fn widened(freedom: f64) -> f64 {
    quantile(CONFIDENCE, Some(freedom.max(1.0))) / quantile(CONFIDENCE, None)
}

/// The scatter of instants about a smooth series of flights.
#[derive(Clone, Debug, PartialEq)]
pub struct Scatter {
    /// Standard uncertainty of an instant, s. Twice this is the half-width of a 95 % interval, by Student's quantile for the few
    /// flights.
    pub uncertainty: f64,
    /// Effective number of degrees of freedom.
    pub freedom: f64,
    /// Duration less that of the smooth series, s, of each flight; `None` for one that spans several.
    pub residuals: Vec<Option<f64>>,
}

/// Returns the scatter of instants that makes single flights differ from durations T_k whose logarithm is a polynomial over the
/// number of the bounce, one for each drop; `None` for fewer than three flights. The degree from 1 to 4 with the smallest
/// uncertainty is taken, which counts the degrees of freedom; a higher one needs [`FEWEST_FREEDOM`] of them, because the smallest of
/// several vague estimates is too small.
pub(super) fn scatter(instants: &[f64], spans: &[FlightSpan]) -> Option<Scatter> {
    let of = |n_terms: usize| {
        let whole = Misfit::of_all(instants, spans, n_terms)?;
        let freedom = whole.freedom();
        let uncertainty = widened(freedom) * (whole.squares / whole.trace).sqrt();
        let residual = |span: &FlightSpan| {
            let found = whole.residuals.iter().find(|(from, _)| *from == span.from);
            found.map(|(_, residual)| *residual)
        };
        Some(Scatter { uncertainty, freedom, residuals: spans.iter().map(residual).collect() })
    };
    of(fewest_terms(instants, spans))
}

/// Returns the number of terms of the polynomial: three, or two of few flights, and more only if chance hardly makes the fit so much
/// better. Terms that follow the scatter of few flights, or a bad instant at their end, would make bars several times too small.
pub(super) fn fewest_terms(instants: &[f64], spans: &[FlightSpan]) -> usize {
    let misfit = |n_terms| Misfit::of_all(instants, spans, n_terms);
    let is_free = |found: &Misfit| found.freedom() >= FEWEST_FREEDOM;
    let Some(mut best) = misfit(3).filter(is_free) else { return 2 };
    let mut n_best = 3;
    // A record that has lost instants may have more bad ones.
    let is_whole = spans.len() + 1 == instants.len();
    let chance = if is_whole { CHANCE } else { 0.1 * CHANCE };
    for n_terms in 4..=MAX_TERMS {
        let Some(more) = misfit(n_terms).filter(is_free) else { break };
        let of_terms = (best.squares - more.squares) / (best.trace - more.trace);
        let ratio = (of_terms * more.trace / more.squares).max(0.0);
        if FisherSnedecor::new(1.0, more.freedom()).is_ok_and(|f| f.sf(ratio) < chance) {
            (best, n_best) = (more, n_terms);
        }
    }
    n_best
}

/// The misfit of single flights of a drop, and that which scattering instants would have.
pub(super) struct Misfit {
    /// Sum of the squared residuals, s².
    pub squares: f64,
    /// Its mean over the variance of an instant, the trace of MV.
    pub trace: f64,
    /// The trace of (MV)², by which the degrees of freedom are counted.
    trace_of_square: f64,
    /// Residual, s, of each flight, with the index of the instant at its beginning.
    residuals: Vec<(usize, f64)>,
}

/// Returns orthonormal polynomials over the places of flights, with weights.
fn polynomials(
    weights: &DVector<f64>,
    n_terms: usize,
    place: impl Fn(usize) -> f64,
) -> Vec<DVector<f64>> {
    let mut basis: Vec<DVector<f64>> = Vec::new();
    for power in 0..n_terms {
        let mut term =
            DVector::from_fn(weights.len(), |k, _| weights[k] * place(k).powi(power as i32));
        // Twice is enough (Kahan and Parlett).
        for _ in 0..2 {
            for known in &basis {
                term -= known * known.dot(&term);
            }
        }
        let length = term.norm();
        basis.push(term / length);
    }
    basis
}

impl Misfit {
    /// Returns the misfit of all drops; `None` if none has more flights than terms.
    pub fn of_all(instants: &[f64], spans: &[FlightSpan], n_terms: usize) -> Option<Self> {
        let all = drops(spans).filter_map(|drop| Self::about(instants, drop, n_terms));
        all.reduce(Self::with)
    }

    /// Returns the effective number of degrees of freedom.
    pub fn freedom(&self) -> f64 {
        (self.trace * self.trace / self.trace_of_square).max(1.0)
    }

    /// Returns the misfit of two drops.
    fn with(mut self, other: Self) -> Self {
        self.squares += other.squares;
        self.trace += other.trace;
        self.trace_of_square += other.trace_of_square;
        self.residuals.extend(other.residuals);
        self
    }

    /// Returns the misfit of a drop about a polynomial with `n_terms` terms, if it has more single flights.
    ///
    /// With independent errors of the instants, the errors of the durations have the covariance V, 2σ² on the diagonal and
    /// −σ² for flights that share an instant. The residuals of a fit with weights T_k are My, with the projector M, so that
    /// the sum of their squares has the mean σ² tr(MV) and the effective freedom (tr MV)²/tr(MVMV) (Satterthwaite 1946).
    fn about(instants: &[f64], spans: &[FlightSpan], n_terms: usize) -> Option<Self> {
        let singles: Vec<usize> = (0..spans.len()).filter(|k| spans[*k].n_flights == 1).collect();
        let n = singles.len();
        if n <= n_terms {
            return None;
        }
        let numbers: Vec<f64> = spans
            .iter()
            .scan(0, |number, span| {
                *number += span.n_flights;
                Some((*number - span.n_flights) as f64)
            })
            .collect();
        let durations = DVector::from_iterator(
            n,
            singles.iter().map(|k| instants[spans[*k].to] - instants[spans[*k].from]),
        );
        let middle = 0.5 * (numbers[singles[0]] + numbers[singles[n - 1]]);
        let place = |k: usize| (numbers[singles[k]] - middle) / (middle + 1.0);
        // Gauss and Newton: a flight that is much too short has the weight of its own place in the series.
        let mut fitted = durations.clone();
        let (mut basis, mut residuals) = (Vec::new(), durations.clone());
        for _ in 0..NEWTON_STEPS {
            basis = polynomials(&fitted, n_terms, place);
            let mut response = fitted.zip_map(&durations, |fit, own| fit * fit.ln() + own - fit);
            residuals.copy_from(&response);
            for known in &basis {
                residuals -= known * known.dot(&residuals);
            }
            response -= &residuals;
            fitted = response.zip_map(&fitted, |response, fit| (response / fit).exp());
        }
        let is_shared = |k: usize| spans[singles[k]].from == spans[singles[k - 1]].to;
        let covariance = |x: &DVector<f64>| {
            DVector::from_fn(n, |k, _| {
                let before = if k > 0 && is_shared(k) { x[k - 1] } else { 0.0 };
                let after = if k + 1 < n && is_shared(k + 1) { x[k + 1] } else { 0.0 };
                2.0 * x[k] - before - after
            })
        };
        let images: Vec<DVector<f64>> = basis.iter().map(covariance).collect();
        let n_shared = (1..n).filter(|k| is_shared(*k)).count();
        let mut trace = 2.0 * n as f64;
        let mut trace_of_square = 4.0 * n as f64 + 2.0 * n_shared as f64;
        for (term, image) in basis.iter().zip(&images) {
            trace -= term.dot(image);
            trace_of_square -= 2.0 * image.norm_squared();
            let cross = basis.iter().map(|other| other.dot(image).powi(2));
            trace_of_square += cross.sum::<f64>();
        }
        let begins = singles.iter().map(|k| spans[*k].from);
        Some(Self {
            squares: residuals.norm_squared(),
            trace,
            trace_of_square,
            residuals: begins.zip(residuals.iter().copied()).collect(),
        })
    }
}
