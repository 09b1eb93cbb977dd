//! Instants that do not fit the flights on both sides of them: a late tap, a hand that stops the ball.
//!
//! A wrong instant makes the flight before it longer and the one after it shorter. Without it, a smooth series through the
//! other flights fits better; whether by more than scattering instants would is judged by the F test of two nested fits.

use statrs::distribution::{ChiSquared, ContinuousCDF, FisherSnedecor};

use super::bounce_times::Instants;
use super::series::{
    CHANCE, FEWEST_FREEDOM, FlightSpan, Misfit, Scatter, drops, fewest_terms, scatter,
};

/// Flights whose ends are tried, those with the largest residuals.
const TRIED: usize = 6;
/// Ratio of two scatters of few flights that is no difference.
const AS_LITTLE: f64 = 1.5;
/// Most instants that are left out.
const MOST: usize = 8;
/// Largest share of the instants that is left out.
const LARGEST_SHARE: f64 = 0.25;

/// Returns the flights between instants without those that end at bad ones, and the indices of bad instants at the ends of a drop; one
/// between two flights lies within a span of two.
///
/// A late instant looks like the end of a drop or like a missing one, so two readings compete: that of [`flight_spans`], and one drop
/// with all its instants. The one that keeps more flights is taken, if they scatter as little.
pub(super) fn good_flights(
    instants: &Instants,
    told_apart: Vec<FlightSpan>,
    known: Option<f64>,
) -> (Vec<FlightSpan>, Vec<usize>) {
    let (starts, instants) = (&instants.starts, &instants.values[..]);
    let n = instants.len().saturating_sub(1);
    let lasts = |from: usize| instants.get(from + 1).map_or(0.0, |end| end - instants[from]);
    // The pause before a drop and its first flight are longer than the last flight of the drop before.
    let begins = |from: usize| {
        let before = from.checked_sub(1).map_or(0.0, lasts);
        let is_told = told_apart.iter().any(|span| span.n_flights == 0 && span.from == from);
        starts.contains(&(from + 1))
            || is_told && [from, from + 1].into_iter().all(|from| lasts(from) > before)
    };
    let whole: Vec<FlightSpan> = (0..n)
        .map(|from| FlightSpan { from, to: from + 1, n_flights: usize::from(!begins(from)) })
        .collect();
    let is_false = told_apart.iter().any(|span| span.n_flights == 0 && !begins(span.from));
    let [told_apart, whole] =
        [told_apart.clone(), whole].map(|spans| without_bad_instants(instants, spans, known));
    let kept = |found: &(Vec<FlightSpan>, Vec<usize>)| {
        found.0.iter().filter(|span| span.n_flights == 1).count()
    };
    let spread = |found: &(Vec<FlightSpan>, Vec<usize>)| {
        scatter(instants, &found.0).map_or(f64::INFINITY, |scatter| scatter.uncertainty)
    };
    let is_better =
        kept(&whole) > kept(&told_apart) && spread(&whole) <= AS_LITTLE * spread(&told_apart);
    if is_better || is_false { whole } else { told_apart }
}

/// Returns the flights without those that end at bad instants, and those of them that are at an end of a drop.
///
/// Several bad instants hide one another: as many are taken out, one after the other, as make the fit of the rest least likely by
/// chance.
fn without_bad_instants(
    instants: &[f64],
    spans: Vec<FlightSpan>,
    known: Option<f64>,
) -> (Vec<FlightSpan>, Vec<usize>) {
    let mut best = (CHANCE, spans.clone(), Vec::new());
    let (mut rest, mut taken, mut n_ways) = (spans.clone(), Vec::new(), 1.0);
    let n = instants.len() as f64;
    for depth in 0..((LARGEST_SHARE * n) as usize).min(MOST) {
        let Some(whole) = scatter(instants, &rest) else { break };
        let tried = candidates(&whole, &rest).into_iter().filter_map(|instant| {
            let others = without(&rest, instant);
            Some((scatter(instants, &others)?.uncertainty, instant, others))
        });
        let Some((_, instant, others)) = tried.min_by(|a, b| a.0.total_cmp(&b.0)) else { break };
        // The last instant of a record is often a hand; any other one is one of many.
        let is_last = rest.last().is_some_and(|span| span.to == instant);
        n_ways *= if is_last { 1.0 } else { (n - depth as f64) / (depth + 1) as f64 };
        taken.push(instant);
        rest = others;
        let chance = n_ways * chance(instants, [&spans, &rest], known).unwrap_or(1.0);
        if chance < best.0 {
            best = (chance, rest.clone(), taken.clone());
        }
    }
    let (_, mut spans, mut at_ends) = best;
    // Flights beside a bad instant at the end of the record say nothing, and nothing judges the last instant.
    while let Some(span) = spans.pop_if(|span| span.n_flights > 1 && span.to - span.from > 1) {
        at_ends.push(span.to);
    }
    at_ends.sort_unstable();
    at_ends.retain(|instant| !spans.iter().any(|span| span.from < *instant && *instant < span.to));
    (spans, at_ends)
}

/// Returns the ends of the flights with the largest residuals.
fn candidates(whole: &Scatter, spans: &[FlightSpan]) -> Vec<usize> {
    let residuals = spans.iter().zip(&whole.residuals);
    let mut by_residual: Vec<(f64, &FlightSpan)> =
        residuals.filter_map(|(span, residual)| Some((residual.as_ref()?.abs(), span))).collect();
    by_residual.sort_by(|a, b| b.0.total_cmp(&a.0));
    let ends = by_residual.iter().take(TRIED).flat_map(|(_, span)| [span.from, span.to]);
    // A series with many terms follows a bad instant at its end, where no residual shows it.
    let outer = drops(spans).flat_map(|drop| [drop[0].from, drop[drop.len() - 1].to]);
    let mut ends: Vec<usize> = ends.chain(outer).collect();
    ends.sort_unstable();
    ends.dedup();
    ends
}

/// Returns the flights without an instant: one that lasts two, or none at an end of the record.
fn without(spans: &[FlightSpan], instant: usize) -> Vec<FlightSpan> {
    let mut rest: Vec<FlightSpan> = Vec::with_capacity(spans.len());
    for span in spans {
        match rest.last_mut() {
            Some(before) if span.from == instant => {
                let is_flight = before.n_flights > 0 && span.n_flights > 0;
                before.to = span.to;
                before.n_flights = if is_flight { before.n_flights + span.n_flights } else { 0 };
            }
            _ => rest.push(*span),
        }
    }
    rest.retain(|span| span.from != instant && span.to != instant);
    rest
}

/// Returns the probability that the flights that `rest` lacks fit as badly by chance; `None` if too few are left.
fn chance(instants: &[f64], [spans, rest]: [&[FlightSpan]; 2], known: Option<f64>) -> Option<f64> {
    let n_terms = fewest_terms(instants, rest);
    let [all, others] = [spans, rest].map(|spans| Misfit::of_all(instants, spans, n_terms));
    let (all, others) = (all?, others?);
    let freedom = others.freedom();
    let left_out = all.trace - others.trace;
    if freedom < FEWEST_FREEDOM || left_out <= 0.0 {
        return None;
    }
    let variance = known.map_or(others.squares / others.trace, |known| known * known);
    // Neighbouring flights, which share an instant, vary together by up to twice their mean variance.
    let ratio = (0.5 * (all.squares - others.squares) / left_out / variance).max(0.0);
    // Each flight has the variance of two instants.
    let n_flights = (0.5 * left_out).max(1.0);
    match (ratio.is_finite(), known) {
        (false, _) => Some(0.0),
        (_, None) => Some(FisherSnedecor::new(n_flights, freedom).ok()?.sf(ratio)),
        (_, Some(_)) => Some(ChiSquared::new(n_flights).ok()?.sf(ratio * n_flights)),
    }
}
