//! Comparison of the results of all variants.

use fem_case::Accuracy;
use fem_collision::QuantityOfInterest;

use super::convergence::{Convergence, ObservedOrder};
use super::error_parts::{ErrorPart, ErrorSource};
use super::limit::Limit;
use super::measurement::Measurement;
use super::stress_places::relative_difference;
use super::variant::{Series, Variant};
use super::variants::Variants;

/// Levels with fewer elements across the contact are not used for orders and limits.
const FEWEST_ACROSS: f64 = 4.5;
/// Error of the coarser result as a multiple of the difference: for second order in a step that was halved,
/// or first order in a compliance that was quartered.
const QUARTERED: f64 = 4.0 / 3.0;

/// The errors of a variant.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct VariantErrors {
    /// Difference to the limit, in the order of [`QuantityOfInterest::ALL`]: the restitution's absolute, all others
    /// relative.
    pub errors: [Option<f64>; 6],
    /// The same without sign, and no smaller than that of any finer variant of its series: an error that
    /// passes through zero is a coincidence.
    pub sure: [Option<f64>; 6],
    /// Relative root mean square error of σ_yy around the contact at the largest approach; `None` for the
    /// reference variant.
    pub stress_error: Option<f64>,
    /// The same, and no smaller than that of any finer variant of its series.
    pub sure_stress_error: Option<f64>,
    /// Largest of the monotone errors of restitution, contact time and peak force.
    pub worst: Option<f64>,
    /// Largest of these and the peak pressure over the tolerances of the case, with the uncertainties of
    /// the limits added.
    pub in_tolerances: Option<f64>,
    /// Whether no variant that is as fast is as close to the limit.
    pub is_on_frontier: bool,
}

/// The comparison of all variants.
#[derive(Clone, Debug)]
pub struct Study {
    /// The limits, in the order of [`QuantityOfInterest::ALL`].
    pub limits: [Option<Limit>; 6],
    /// Errors of each variant, in the order of the variants; `None` if it did not run.
    pub judged: Vec<Option<VariantErrors>>,
    /// Observed orders of convergence in the size of the elements, in the order of
    /// [`QuantityOfInterest::ALL`]; `None` where the levels do not determine one.
    pub orders: Vec<(Series, [Option<ObservedOrder>; 6])>,
    /// Sources of the error of explicit elements, with eight of them across the contact.
    pub parts: Vec<ErrorPart>,
    /// The reference variant of stresses.
    pub finest_field: Option<usize>,
}

/// A variant with its results and its run time in seconds.
struct Run<'a> {
    index: usize,
    variant: &'a Variant,
    measurement: &'a Measurement,
    seconds: f64,
}

impl Study {
    /// Compares the results and run times (s) of the variants; `None` for those that did not run.
    pub fn of(
        variants: &Variants,
        measured: &[Option<(Measurement, f64)>],
        accuracy: &Accuracy,
    ) -> Self {
        let ran = variants.all.iter().zip(measured).enumerate();
        let ran = ran.filter_map(|(index, (variant, measured))| {
            let (measurement, seconds) = measured.as_ref()?;
            Some(Run { index, variant, measurement, seconds: *seconds })
        });
        let ran: Vec<Run<'_>> = ran.filter(|run| run.measurement.is_complete).collect();
        let limits = QuantityOfInterest::ALL.map(|quantity| {
            let of = |series| levels(&ran, series, quantity, FEWEST_ACROSS);
            Limit::of(&of(Series::Condensed), &of(Series::CondensedSprings), &of(Series::Explicit))
        });
        let finest_field = finest_field(&ran, &limits);
        let reference = finest_field.and_then(|index| {
            let run = ran.iter().find(|run| run.index == index)?;
            run.measurement.stress.as_deref()
        });
        let mut judged = vec![None; variants.all.len()];
        for run in &ran {
            let errors = QuantityOfInterest::ALL.map(|quantity| {
                let limit = limits[quantity as usize]?;
                let value = run.measurement.value(quantity)?;
                Some((value - limit.value) / quantity.scale(limit.value))
            });
            let sample =
                run.measurement.stress.as_deref().filter(|_| finest_field != Some(run.index));
            let stress_error = sample
                .zip(reference)
                .and_then(|(sample, reference)| relative_difference(sample, reference));
            judged[run.index] = Some(VariantErrors {
                errors,
                sure: errors.map(|error| error.map(f64::abs)),
                stress_error,
                sure_stress_error: stress_error,
                ..VariantErrors::default()
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
            let orders = QuantityOfInterest::ALL.map(|quantity| {
                Convergence::of(&levels(&ran, series, quantity, FEWEST_ACROSS))?.order
            });
            orders.iter().any(Option::is_some).then_some((series, orders))
        });
        let orders = orders.collect();
        let parts = parts(&ran, &limits);
        Self { limits, judged, orders, parts, finest_field }
    }

    /// Returns the fastest of some variants that is within the tolerances of the case.
    pub fn cheapest_within(
        &self,
        variants: &Variants,
        measured: &[Option<(Measurement, f64)>],
        serves: impl Fn(usize) -> bool,
    ) -> Option<usize> {
        let within = |k: &usize| {
            let judged = self.judged[*k].and_then(|judged| judged.in_tolerances);
            let is_choice = variants.all[*k].series.is_choice();
            is_choice && serves(*k) && judged.is_some_and(|share| share <= 1.0)
        };
        let seconds = |k: &usize| measured[*k].as_ref().map_or(f64::INFINITY, |ran| ran.1);
        let within = (0..self.judged.len()).filter(within);
        within.min_by(|a, b| seconds(a).total_cmp(&seconds(b)))
    }
}

/// Returns the values of a series over its element size.
fn levels(
    ran: &[Run<'_>],
    series: Series,
    quantity: QuantityOfInterest,
    fewest_across: f64,
) -> Vec<(f64, f64)> {
    let of_series = ran.iter().filter(|run| run.variant.series == series);
    let level = |run: &Run<'_>| {
        run.variant.elements_across.filter(|across| *across >= fewest_across)?;
        Some((run.variant.value?, run.measurement.value(quantity)?))
    };
    of_series.filter_map(level).collect()
}

/// Returns the variant with the finest field: of condensed bodies, or of explicit elements where their
/// results differ.
fn finest_field(ran: &[Run<'_>], limits: &[Option<Limit>; 6]) -> Option<usize> {
    /// Relative difference of explicit elements above which their field is used.
    const SEEN: f64 = 2e-3;
    let adds = QuantityOfInterest::ALL.into_iter().zip(limits).any(|(quantity, limit)| {
        let Some(limit) = limit else { return false };
        let is_sure = limit.condensed.is_some_and(|condensed| condensed != limit.value);
        is_sure && limit.added.is_some_and(|added| added.abs() > SEEN * quantity.scale(limit.value))
    });
    let finest = |series| {
        let fields = ran.iter().filter(|run| run.variant.series == series);
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
    three.into_iter().try_fold(0.0, |worst: f64, quantity| {
        errors[quantity as usize].map(|error| worst.max(error.abs()))
    })
}

fn in_tolerances(
    errors: &[Option<f64>; 6],
    limits: &[Option<Limit>; 6],
    accuracy: &Accuracy,
) -> Option<f64> {
    worst(errors)?;
    let shares = QuantityOfInterest::ALL.into_iter().filter_map(|quantity| {
        let (error, limit) = (errors[quantity as usize]?, limits[quantity as usize]?);
        let uncertain = limit.uncertainty / quantity.scale(limit.value);
        Some((error.abs() + uncertain) / tolerance(quantity, accuracy)?)
    });
    Some(shares.fold(0.0, f64::max))
}

/// Returns the tolerance of the case for a quantity; `None` if it has none.
fn tolerance(quantity: QuantityOfInterest, accuracy: &Accuracy) -> Option<f64> {
    match quantity {
        QuantityOfInterest::Restitution => Some(accuracy.restitution),
        QuantityOfInterest::ContactTime => Some(accuracy.contact_time),
        QuantityOfInterest::PeakForce => Some(accuracy.peak_force),
        QuantityOfInterest::PeakPressure => Some(accuracy.peak_pressure),
        QuantityOfInterest::MaxApproach | QuantityOfInterest::MaxContactRadius => None,
    }
}

/// Makes each error at least that of any finer variant of the same series.
fn take_luck_away(ran: &[Run<'_>], judged: &mut [Option<VariantErrors>]) {
    for series in Series::ALL.into_iter().filter(|series| series.is_over_element_size()) {
        let mut of_series: Vec<&Run<'_>> =
            ran.iter().filter(|run| run.variant.series == series).collect();
        let size = |run: &Run<'_>| run.variant.value.unwrap_or(f64::INFINITY);
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

/// Marks, from the fastest on, each variant that is closer to the limit than all before it.
fn mark_frontier(ran: &[Run<'_>], judged: &mut [Option<VariantErrors>]) {
    let mut by_time: Vec<&Run<'_>> =
        ran.iter().filter(|run| run.variant.series.is_choice()).collect();
    by_time.sort_by(|a, b| a.seconds.total_cmp(&b.seconds));
    let mut nearest = f64::INFINITY;
    for run in by_time {
        let Some(judged) = judged[run.index].as_mut() else { continue };
        let Some(worst) = judged.worst.filter(|worst| *worst < nearest) else { continue };
        nearest = worst;
        judged.is_on_frontier = true;
    }
}

/// Returns the sources of errors, as far as the variants that show them have run.
fn parts(ran: &[Run<'_>], limits: &[Option<Limit>; 6]) -> Vec<ErrorPart> {
    let is_common =
        |run: &&Run<'_>| run.variant.elements_across.is_none() || run.variant.has_common_elements;
    let of = |series, value: Option<f64>| {
        let of_series = ran.iter().filter(|run| run.variant.series == series).filter(is_common);
        let mut same = of_series.filter(|run| value.is_none_or(|_| run.variant.value == value));
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
