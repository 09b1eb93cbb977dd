//! A series of many close relaxation times as one of fewer.
//!
//! The terms of an octave of rates are a discrete measure; the Gauss rule of this measure has positive weights and rates
//! within the octave, and meets the first 14 moments of the rates (W. Gautschi, *Orthogonal Polynomials*, 2004, section 2.2:
//! the recurrence of Stieltjes). Its error in e^(−rt) is that of the remainder, at most
//!
//! ```math
//! \frac{\max_t\,(r_0t)^{14}e^{-r_0t}}{14!}\,2\,4^{-14}\approx 8\cdot10^{-10}
//! ```
//!
//! of the octave's weight at any time.

use crate::prony::PronyTerm;

/// Terms that an octave of rates keeps.
const TERMS_PER_OCTAVE: usize = 7;

/// Returns terms of the same relaxation, within 1e-9 of their weight at any time; unchanged where no octave of rates has more
/// than seven terms.
pub(crate) fn merged(mut terms: Vec<PronyTerm>) -> Vec<PronyTerm> {
    let given = terms.clone();
    terms.retain(|term| term.weight > 0.0);
    terms.sort_by(|a, b| b.relaxation_time.total_cmp(&a.relaxation_time));
    let octaves = octaves(&terms);
    if octaves.iter().all(|octave| octave.len() <= TERMS_PER_OCTAVE) {
        return given;
    }
    octaves.into_iter().flat_map(gauss_rule).collect()
}

/// Splits terms, the slowest first, into runs whose rates differ by at most a factor of two.
fn octaves(terms: &[PronyTerm]) -> Vec<&[PronyTerm]> {
    let mut octaves = Vec::new();
    let mut rest = terms;
    while let Some(slowest) = rest.first() {
        let within = |term: &PronyTerm| term.relaxation_time >= 0.5 * slowest.relaxation_time;
        let (octave, faster) = rest.split_at(rest.partition_point(within));
        octaves.push(octave);
        rest = faster;
    }
    octaves
}

/// Returns the Gauss rule of an octave, or the octave if that is no longer.
fn gauss_rule(octave: &[PronyTerm]) -> Vec<PronyTerm> {
    if octave.len() <= TERMS_PER_OCTAVE {
        return octave.to_vec();
    }
    let slowest = octave[0].relaxation_time;
    // Rates from r₀ to 2 r₀ become −1 to 1.
    let measure: Vec<[f64; 2]> = octave
        .iter()
        .map(|term| [2.0 * slowest / term.relaxation_time - 3.0, term.weight])
        .collect();
    let recurrence = Recurrence::of(&measure);
    let mut nodes = Vec::new();
    for degree in 1..=recurrence.centres.len() {
        // The zeros of neighbouring degrees lie between each other.
        let mut ends = vec![-1.0];
        ends.append(&mut nodes);
        ends.push(1.0);
        nodes = ends.windows(2).map(|pair| recurrence.zero(degree, pair[0], pair[1])).collect();
    }
    nodes
        .into_iter()
        .map(|node| PronyTerm {
            weight: recurrence.weight(node),
            relaxation_time: 2.0 * slowest / (node + 3.0),
        })
        .collect()
}

/// x p̂_k = n_{k+1} p̂_{k+1} + c_k p̂_k + n_k p̂_{k−1}, the recurrence of the orthonormal polynomials of a measure.
struct Recurrence {
    /// The coefficients c_k.
    centres: Vec<f64>,
    /// The coefficients n_k, of which the first is the square root of the whole weight.
    norms: Vec<f64>,
}

impl Recurrence {
    /// Below this share of the octave a polynomial is zero at all points of the measure, up to rounding.
    const NO_MORE_POINTS: f64 = 1e-7;

    fn of(measure: &[[f64; 2]]) -> Self {
        let weight: f64 = measure.iter().map(|[_, weight]| weight).sum();
        let mut recurrence = Self { centres: Vec::new(), norms: vec![weight.sqrt()] };
        let mut before = vec![0.0; measure.len()];
        let mut values = vec![weight.sqrt().recip(); measure.len()];
        for degree in 0..TERMS_PER_OCTAVE {
            let mean = |of: &dyn Fn(usize, f64) -> f64| -> f64 {
                measure.iter().enumerate().map(|(k, [x, weight])| weight * of(k, *x)).sum()
            };
            let centre = mean(&|k, x| x * values[k] * values[k]);
            let coupling = recurrence.norms[degree];
            let next: Vec<f64> = (measure.iter().zip(&values).zip(&before))
                .map(|(([x, _], value), before)| (x - centre) * value - coupling * before)
                .collect();
            let norm = mean(&|k, _| next[k] * next[k]).sqrt();
            recurrence.centres.push(centre);
            if norm < Self::NO_MORE_POINTS {
                break;
            }
            recurrence.norms.push(norm);
            before =
                std::mem::replace(&mut values, next.iter().map(|value| value / norm).collect());
        }
        recurrence
    }

    /// Returns the monic polynomials p_0, p_1, … up to the degree of the rule at x, which are p̂_k n_0 … n_k.
    fn monic(&self, x: f64) -> impl Iterator<Item = f64> + '_ {
        let steps = self.centres.iter().zip(&self.norms);
        let later = steps.scan([0.0, 1.0], move |last, (centre, norm)| {
            *last = [last[1], (x - centre) * last[1] - norm.powi(2) * last[0]];
            Some(last[1])
        });
        std::iter::once(1.0).chain(later)
    }

    /// Returns the weight of the rule at one of its nodes, the inverse of the sum of p̂_k².
    fn weight(&self, node: f64) -> f64 {
        let scales = self.norms.iter().scan(1.0, |scale, norm| {
            *scale *= norm;
            Some(*scale)
        });
        let values = self.monic(node).take(self.centres.len()).zip(scales);
        values.map(|(value, scale)| (value / scale).powi(2)).sum::<f64>().recip()
    }

    /// Returns the zero of the polynomial of a degree that lies between two points.
    fn zero(&self, degree: usize, low: f64, high: f64) -> f64 {
        let value = |x: f64| self.monic(x).nth(degree).unwrap_or_default();
        let rises = value(high) > 0.0;
        let [mut low, mut high] = [low, high];
        while low.midpoint(high) > low && low.midpoint(high) < high {
            let middle = low.midpoint(high);
            if (value(middle) > 0.0) == rises {
                high = middle;
            } else {
                low = middle;
            }
        }
        high
    }
}
