//! The rungs of a ladder, judged together.

use fem_case::Accuracy;
use fem_collision::QuantityOfInterest;

use super::convergence::{Convergence, ObservedOrder};
use super::error_parts::{ErrorPart, ErrorSource};
use super::ladder::Ladder;
use super::limit::Limit;
use super::measurement::Measurement;
use super::rung::{Rung, Series};
use super::stress_places::relative_difference;

/// Fewer elements across the contact tell nothing of an order or a limit.
const FEWEST_ACROSS: f64 = 4.5;
/// Second order in a step that was halved, first order in a compliance that was quartered: what of the
/// difference is the error of the coarser.
const QUARTERED: f64 = 4.0 / 3.0;

/// What is known of the error of a rung.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Judged {
    /// Difference to the limit, in the order of [`QuantityOfInterest::ALL`]: the restitution's absolute, all others
    /// relative.
    pub errors: [Option<f64>; 6],
    /// The same without sign, and no smaller than that of any finer rung of its series: an error that
    /// passes through zero is luck.
    pub sure: [Option<f64>; 6],
    /// Root mean square error of σ_yy around the contact at the largest approach, over its own root mean
    /// square; none of the rung that it is told against.
    pub stress_error: Option<f64>,
    /// The same, and no smaller than that of any finer rung of its series.
    pub sure_stress_error: Option<f64>,
    /// Worst of restitution, contact time and peak force, of what is sure.
    pub worst: Option<f64>,
    /// Worst of these and the peak pressure in tolerances of the case, what is uncertain in the limits
    /// added.
    pub in_tolerances: Option<f64>,
    /// Whether no choice that is as fast is as near to the limit.
    pub is_on_frontier: bool,
}

/// The rungs of a ladder, judged together.
#[derive(Clone, Debug)]
pub struct Study {
    /// What the numbers tend to, in the order of [`QuantityOfInterest::ALL`].
    pub limits: [Option<Limit>; 6],
    /// What is known of each rung, in the order of the ladder; nothing of one that did not run.
    pub judged: Vec<Option<Judged>>,
    /// Observed orders of convergence in the size of the elements, in the order of [`QuantityOfInterest::ALL`]; none where
    /// levels do not tell one.
    pub orders: Vec<(Series, [Option<ObservedOrder>; 6])>,
    /// Where the error of explicit elements comes from, eight of them across the contact.
    pub parts: Vec<ErrorPart>,
    /// The rung that stresses are told against.
    pub finest_field: Option<usize>,
}

/// A rung with what it gave and the seconds that it took.
struct Run<'a> {
    index: usize,
    rung: &'a Rung,
    measurement: &'a Measurement,
    seconds: f64,
}

impl Study {
    /// Judges what rungs gave and the seconds that they took; `None` for those that did not run.
    pub fn of(
        ladder: &Ladder,
        measured: &[Option<(Measurement, f64)>],
        accuracy: &Accuracy,
    ) -> Self {
        let ran = ladder.rungs.iter().zip(measured).enumerate();
        let ran = ran.filter_map(|(index, (rung, measured))| {
            let (measurement, seconds) = measured.as_ref()?;
            Some(Run { index, rung, measurement, seconds: *seconds })
        });
        let ran: Vec<Run<'_>> = ran.filter(|run| run.measurement.is_complete).collect();
        let limits = QuantityOfInterest::ALL.map(|headline| {
            let of = |series| levels(&ran, series, headline, FEWEST_ACROSS);
            Limit::of(&of(Series::Condensed), &of(Series::CondensedSprings), &of(Series::Explicit))
        });
        let finest_field = finest_field(&ran, &limits);
        let reference = finest_field.and_then(|index| {
            let run = ran.iter().find(|run| run.index == index)?;
            run.measurement.stress.as_deref()
        });
        let mut judged = vec![None; ladder.rungs.len()];
        for run in &ran {
            let errors = QuantityOfInterest::ALL.map(|headline| {
                let limit = limits[headline as usize]?;
                let value = run.measurement.value(headline)?;
                Some((value - limit.value) / headline.scale(limit.value))
            });
            let sample =
                run.measurement.stress.as_deref().filter(|_| finest_field != Some(run.index));
            let stress_error = sample
                .zip(reference)
                .and_then(|(sample, reference)| relative_difference(sample, reference));
            judged[run.index] = Some(Judged {
                errors,
                sure: errors.map(|error| error.map(f64::abs)),
                stress_error,
                sure_stress_error: stress_error,
                ..Judged::default()
            });
        }
        take_luck_away(&ran, &mut judged);
        for judged in judged.iter_mut().flatten() {
            judged.worst = worst(&judged.sure);
            judged.in_tolerances = in_tolerances(&judged.sure, &limits, accuracy);
        }
        mark_frontier(&ran, &mut judged);
        let orders = Series::ALL.into_iter().filter(|series| series.is_over_element_size());
        let orders = orders.filter_map(|series| {
            let orders = QuantityOfInterest::ALL.map(|headline| {
                Convergence::of(&levels(&ran, series, headline, FEWEST_ACROSS))?.order
            });
            orders.iter().any(Option::is_some).then_some((series, orders))
        });
        let orders = orders.collect();
        let parts = parts(&ran, &limits);
        Self { limits, judged, orders, parts, finest_field }
    }

    /// The fastest of some rungs that is within the tolerances of the case.
    pub fn cheapest_within(
        &self,
        ladder: &Ladder,
        measured: &[Option<(Measurement, f64)>],
        serves: impl Fn(usize) -> bool,
    ) -> Option<usize> {
        let within = |k: &usize| {
            let judged = self.judged[*k].and_then(|judged| judged.in_tolerances);
            let is_choice = ladder.rungs[*k].series.is_choice();
            is_choice && serves(*k) && judged.is_some_and(|share| share <= 1.0)
        };
        let seconds = |k: &usize| measured[*k].as_ref().map_or(f64::INFINITY, |ran| ran.1);
        let within = (0..self.judged.len()).filter(within);
        within.min_by(|a, b| seconds(a).total_cmp(&seconds(b)))
    }
}

/// Values of a series over the size of its elements.
fn levels(
    ran: &[Run<'_>],
    series: Series,
    headline: QuantityOfInterest,
    fewest_across: f64,
) -> Vec<(f64, f64)> {
    let of_series = ran.iter().filter(|run| run.rung.series == series);
    let level = |run: &Run<'_>| {
        run.rung.elements_across.filter(|across| *across >= fewest_across)?;
        Some((run.rung.value?, run.measurement.value(headline)?))
    };
    of_series.filter_map(level).collect()
}

/// The finest field of condensed bodies, or of explicit elements where these are something else.
fn finest_field(ran: &[Run<'_>], limits: &[Option<Limit>; 6]) -> Option<usize> {
    /// What explicit elements add is then seen in the field, too.
    const SEEN: f64 = 2e-3;
    let adds = QuantityOfInterest::ALL.into_iter().zip(limits).any(|(headline, limit)| {
        let Some(limit) = limit else { return false };
        let is_sure = limit.condensed.is_some_and(|condensed| condensed != limit.value);
        is_sure && limit.added.is_some_and(|added| added.abs() > SEEN * headline.scale(limit.value))
    });
    let finest = |series| {
        let fields = ran.iter().filter(|run| run.rung.series == series);
        let fields = fields.filter(|run| run.measurement.stress.is_some());
        fields.max_by_key(|run| run.measurement.elements).map(|run| run.index)
    };
    let (condensed, explicit) = (finest(Series::Condensed), finest(Series::Explicit));
    if adds { explicit.or(condensed) } else { condensed.or(explicit) }
}

fn worst(errors: &[Option<f64>; 6]) -> Option<f64> {
    let three = [
        QuantityOfInterest::Restitution,
        QuantityOfInterest::ContactTime,
        QuantityOfInterest::PeakForce,
    ];
    three.into_iter().try_fold(0.0, |worst: f64, headline| {
        errors[headline as usize].map(|error| worst.max(error.abs()))
    })
}

fn in_tolerances(
    errors: &[Option<f64>; 6],
    limits: &[Option<Limit>; 6],
    accuracy: &Accuracy,
) -> Option<f64> {
    worst(errors)?;
    let shares = QuantityOfInterest::ALL.into_iter().filter_map(|headline| {
        let (error, limit) = (errors[headline as usize]?, limits[headline as usize]?);
        let uncertain = limit.uncertainty / headline.scale(limit.value);
        Some((error.abs() + uncertain) / tolerance(headline, accuracy)?)
    });
    Some(shares.fold(0.0, f64::max))
}

/// The error that a case allows; none of what it says nothing about.
fn tolerance(headline: QuantityOfInterest, accuracy: &Accuracy) -> Option<f64> {
    match headline {
        QuantityOfInterest::Restitution => Some(accuracy.restitution),
        QuantityOfInterest::ContactTime => Some(accuracy.contact_time),
        QuantityOfInterest::PeakForce => Some(accuracy.peak_force),
        QuantityOfInterest::PeakPressure => Some(accuracy.peak_pressure),
        QuantityOfInterest::MaxApproach | QuantityOfInterest::MaxContactRadius => None,
    }
}

/// Makes each error at least that of any finer rung of the same series.
fn take_luck_away(ran: &[Run<'_>], judged: &mut [Option<Judged>]) {
    for series in Series::ALL.into_iter().filter(|series| series.is_over_element_size()) {
        let mut of_series: Vec<&Run<'_>> =
            ran.iter().filter(|run| run.rung.series == series).collect();
        let size = |run: &Run<'_>| run.rung.value.unwrap_or(f64::INFINITY);
        of_series.sort_by(|a, b| size(a).total_cmp(&size(b)));
        let mut worst = [None; 7];
        for run in of_series {
            let Some(judged) = judged[run.index].as_mut() else { continue };
            let sure = judged.sure.iter_mut().chain([&mut judged.sure_stress_error]);
            for (worst, sure) in worst.iter_mut().zip(sure) {
                // An error that is not there is below any that is.
                *sure = sure.map(|sure| worst.map_or(sure, |worst: f64| worst.max(sure)));
                *worst = sure.or(*worst);
            }
        }
    }
}

/// From the fastest on, each that is nearer to the limit than all before it.
fn mark_frontier(ran: &[Run<'_>], judged: &mut [Option<Judged>]) {
    let mut by_time: Vec<&Run<'_>> = ran.iter().filter(|run| run.rung.series.is_choice()).collect();
    by_time.sort_by(|a, b| a.seconds.total_cmp(&b.seconds));
    let mut nearest = f64::INFINITY;
    for run in by_time {
        let Some(judged) = judged[run.index].as_mut() else { continue };
        let Some(worst) = judged.worst.filter(|worst| *worst < nearest) else { continue };
        nearest = worst;
        judged.is_on_frontier = true;
    }
}

/// Where errors come from, as far as the rungs that tell it have run.
fn parts(ran: &[Run<'_>], limits: &[Option<Limit>; 6]) -> Vec<ErrorPart> {
    let is_common =
        |run: &&Run<'_>| run.rung.elements_across.is_none() || run.rung.has_common_elements;
    let of = |series, value: Option<f64>| {
        let of_series = ran.iter().filter(|run| run.rung.series == series).filter(is_common);
        let mut same = of_series.filter(|run| value.is_none_or(|_| run.rung.value == value));
        same.next().map(|run| run.measurement.values)
    };
    let limit_values = limits.map(|limit| limit.map(|limit| limit.value));
    let condensed_limits = limits.map(|limit| limit.and_then(|limit| limit.condensed));
    let base = of(Series::Explicit, None);
    let part = |source, values: Option<[Option<f64>; 6]>, others: Option<_>, factor| {
        let errors = ErrorPart::between(source, values?, others?, limit_values, factor);
        errors.errors.iter().any(Option::is_some).then_some(errors)
    };
    let without = limits.map(|limit| limit.and_then(|limit| Some(limit.condensed? + limit.added?)));
    let strained = of(Series::FiniteStrain, None);
    // Where it is on anyway both are the same.
    let small_strain = of(Series::Penalty, None).filter(|_| base != strained);
    let all = [
        part(ErrorSource::Mesh, of(Series::Condensed, None), Some(condensed_limits), 1.0),
        part(ErrorSource::ContactSprings, base, of(Series::PenaltyFactor, Some(4.0)), QUARTERED),
        part(ErrorSource::AddedMass, base, of(Series::MassScaling, Some(0.0)), 1.0),
        part(ErrorSource::TimeStep, base, of(Series::StepFactor, Some(0.45)), QUARTERED),
        part(ErrorSource::LeftOutByCondensed, Some(condensed_limits), Some(without), 1.0),
        part(ErrorSource::SmallStrain, small_strain, strained, 1.0),
    ];
    all.into_iter().flatten().collect()
}
