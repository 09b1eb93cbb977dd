//! Comparison of the results of all variants.

use fem_case::Accuracy;
use fem_collision::QuantityOfInterest;
use fem_simulation::tolerance_of;

use super::convergence::{Convergence, Limit, ObservedOrder};
use super::measurement::Measurement;
use super::measurement::relative_difference;
use super::series::Series;
use super::variants::{Variant, Variants};

/// Fewest elements across the contact of levels that are used for orders and limits.
const MIN_ACROSS: f64 = 4.5;
/// Error of the coarser result as a multiple of the difference: for second order in a step that was halved,
/// or first order in a compliance that was quartered.
const QUARTERED: f64 = 4.0 / 3.0;

/// One number per quantity of interest, in the order of [`QuantityOfInterest::ALL`].
type Numbers = [Option<f64>; 6];

/// The comparison of all variants.
#[derive(Clone, Debug)]
pub struct Study<'a> {
    /// The variants whose collision ended by itself, in order, with their errors.
    pub runs: Vec<VariantRun<'a>>,
    /// The limits, in the order of [`QuantityOfInterest::ALL`].
    pub limits: [Option<Limit>; 6],
    /// Observed orders of convergence in the element size, in the order of [`QuantityOfInterest::ALL`];
    /// `None` if the levels do not determine one.
    pub orders: Vec<(Series, [Option<ObservedOrder>; 6])>,
    /// Sources of the error of explicit elements, with eight of them across the contact.
    pub parts: Vec<ErrorPart>,
}

/// A variant with its results.
#[derive(Clone, Copy, Debug)]
pub struct VariantRun<'a> {
    /// The computed variant.
    pub variant: &'a Variant,
    /// The measured results.
    pub measurement: &'a Measurement,
    /// Its run time, s.
    pub seconds: f64,
    /// Errors of the results.
    pub errors: VariantErrors,
}

/// The errors of a variant.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct VariantErrors {
    /// Differences from the limits, in the order of [`QuantityOfInterest::ALL`]: the restitution's absolute,
    /// all others relative.
    pub signed: Numbers,
    /// The same without sign, and no smaller than that of any finer variant of its series: an error that
    /// passes through zero is a coincidence.
    pub monotone: Numbers,
    /// Relative root mean square error of σ_yy around the contact at the largest approach; `None` for the
    /// reference variant.
    pub stress: Option<f64>,
    /// The same, and no smaller than that of any finer variant of its series.
    pub monotone_stress: Option<f64>,
    /// Largest of the monotone errors of restitution, contact time and peak force.
    pub worst: Option<f64>,
    /// Largest of these and the peak pressure over the tolerances of the case, with the uncertainties of
    /// the limits added.
    pub in_tolerances: Option<f64>,
    /// Whether no variant that is as fast is as close to the limit.
    pub is_on_frontier: bool,
}

/// The source of an error of explicit elements.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ErrorSource {
    /// The finite size of elements, from condensed bodies on the same mesh.
    Mesh,
    /// The compliance of the penalty springs, extrapolated from a run with four times their stiffness.
    ContactSprings,
    /// The mass that is moved for longer steps, against a run without it. Its key in files is "added mass".
    MovedMass,
    /// The finite time step, of second order, from half the step.
    TimeStep,
    /// Waves and large strains, which condensed bodies lack.
    LeftOutByCondensed,
    /// The assumption of small strains, against a run at finite strain, both with springs between nodes
    /// that have mass.
    SmallStrain,
}

impl ErrorSource {
    /// Returns its name for readers.
    pub fn name(self) -> &'static str {
        match self {
            Self::Mesh => "mesh",
            Self::ContactSprings => "contact springs",
            Self::MovedMass => "added mass",
            Self::TimeStep => "time step",
            Self::LeftOutByCondensed => "left out by condensed",
            Self::SmallStrain => "small strain",
        }
    }
}

/// An error and its source.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ErrorPart {
    /// The source of the error.
    pub source: ErrorSource,
    /// Its contribution to each quantity, in the order of [`QuantityOfInterest::ALL`]: the restitution's
    /// absolute, all others relative.
    pub errors: Numbers,
}

impl<'a> Study<'a> {
    /// The quantities whose largest error ranks variants.
    pub const MAIN_QUANTITIES: [QuantityOfInterest; 3] = [
        QuantityOfInterest::Restitution,
        QuantityOfInterest::ContactTime,
        QuantityOfInterest::PeakForce,
    ];

    /// Compares the results and run times (s) of the variants; `None` for those that did not run.
    pub fn of(
        variants: &'a Variants,
        measured: &'a [Option<(Measurement, f64)>],
        accuracy: &Accuracy,
    ) -> Self {
        let runs = variants.all.iter().zip(measured).filter_map(|(variant, measured)| {
            let (measurement, seconds) = measured.as_ref()?;
            let errors = VariantErrors::default();
            Some(VariantRun { variant, measurement, seconds: *seconds, errors })
        });
        let mut runs: Vec<_> = runs.filter(|run| run.measurement.is_complete).collect();
        let limits = QuantityOfInterest::ALL.map(|quantity| {
            let of = |series| levels(&runs, series, quantity);
            Limit::of(&of(Series::Condensed), &of(Series::CondensedSprings), &of(Series::Explicit))
        });
        set_errors(&mut runs, &limits);
        make_monotone(&mut runs);
        for VariantRun { errors, .. } in &mut runs {
            errors.worst = worst(&errors.monotone);
            errors.in_tolerances = in_tolerances(&errors.monotone, &limits, accuracy);
        }
        mark_frontier(&mut runs);
        let orders = Series::over_element_size().filter_map(|series| {
            let order = |quantity| Convergence::of(&levels(&runs, series, quantity))?.order;
            let orders = QuantityOfInterest::ALL.map(order);
            orders.iter().any(Option::is_some).then_some((series, orders))
        });
        let (orders, parts) = (orders.collect(), parts(&runs, &limits));
        Self { runs, limits, orders, parts }
    }

    /// Returns the fastest variant within the case's tolerances for which `serves` is true.
    pub fn cheapest_within(
        &self,
        serves: impl Fn(&VariantRun<'a>) -> bool,
    ) -> Option<&VariantRun<'a>> {
        let within = |run: &&VariantRun<'a>| {
            let is_within = run.errors.in_tolerances.is_some_and(|share| share <= 1.0);
            run.variant.series.is_choice() && serves(run) && is_within
        };
        self.runs.iter().filter(within).min_by(|a, b| a.seconds.total_cmp(&b.seconds))
    }
}

/// Returns the runs of a series.
fn of_series<'r, 'a>(
    runs: &'r [VariantRun<'a>],
    series: Series,
) -> impl Iterator<Item = &'r VariantRun<'a>> {
    runs.iter().filter(move |run| run.variant.series == series)
}

/// Returns the values of a series over its element size.
fn levels(
    runs: &[VariantRun<'_>],
    series: Series,
    quantity: QuantityOfInterest,
) -> Vec<(f64, f64)> {
    let level = |run: &VariantRun<'_>| {
        run.variant.elements_across.filter(|across| *across >= MIN_ACROSS)?;
        Some((run.variant.value?, run.measurement.value(quantity)?))
    };
    of_series(runs, series).filter_map(level).collect()
}

/// Sets the differences of all results from the limits, and of all fields from the finest field.
fn set_errors(runs: &mut [VariantRun<'_>], limits: &[Option<Limit>; 6]) {
    let finest = finest_field(runs, limits);
    let reference = finest.and_then(|finest| runs[finest].measurement.stress.as_deref());
    for (index, run) in runs.iter_mut().enumerate() {
        let signed = QuantityOfInterest::ALL.map(|quantity| {
            let limit = limits[quantity as usize]?;
            let value = run.measurement.value(quantity)?;
            Some((value - limit.value) / quantity.scale(limit.value))
        });
        let sample = run.measurement.stress.as_deref().filter(|_| finest != Some(index));
        let stress = sample.zip(reference).and_then(|(own, all)| relative_difference(own, all));
        let monotone = signed.map(|error| error.map(f64::abs));
        run.errors = VariantErrors {
            signed,
            monotone,
            stress,
            monotone_stress: stress,
            ..VariantErrors::default()
        };
    }
}

/// Returns the index of the run with the finest field: of condensed bodies, or of explicit elements if their
/// results differ.
fn finest_field(runs: &[VariantRun<'_>], limits: &[Option<Limit>; 6]) -> Option<usize> {
    /// Relative difference of explicit elements above which their field is used.
    const SEEN: f64 = 2e-3;
    let adds = QuantityOfInterest::ALL.into_iter().zip(limits).any(|(quantity, limit)| {
        let Some(limit) = limit else { return false };
        let is_clear = limit.condensed.is_some_and(|condensed| condensed != limit.value);
        let scale = quantity.scale(limit.value);
        is_clear && limit.added.is_some_and(|added| added.abs() > SEEN * scale)
    });
    let finest = |series| {
        let has_field =
            |run: &VariantRun<'_>| run.variant.series == series && run.measurement.stress.is_some();
        let fields = (0..runs.len()).filter(|index| has_field(&runs[*index]));
        fields.max_by_key(|index| runs[*index].measurement.elements)
    };
    let (condensed, explicit) = (finest(Series::Condensed), finest(Series::Explicit));
    if adds { explicit.or(condensed) } else { condensed.or(explicit) }
}

/// Returns the largest error of restitution, contact time and peak force.
fn worst(errors: &Numbers) -> Option<f64> {
    Study::MAIN_QUANTITIES.into_iter().try_fold(0.0, |worst: f64, quantity| {
        errors[quantity as usize].map(|error| worst.max(error.abs()))
    })
}

/// Returns the largest error over its tolerance, with the uncertainty of its limit.
fn in_tolerances(
    errors: &Numbers,
    limits: &[Option<Limit>; 6],
    accuracy: &Accuracy,
) -> Option<f64> {
    worst(errors)?;
    let shares = QuantityOfInterest::ALL.into_iter().filter_map(|quantity| {
        let (error, limit) = (errors[quantity as usize]?, limits[quantity as usize]?);
        let uncertain = limit.uncertainty / quantity.scale(limit.value);
        Some((error.abs() + uncertain) / tolerance_of(accuracy, quantity)?)
    });
    Some(shares.fold(0.0, f64::max))
}

/// Makes each error at least that of any finer variant of the same series.
fn make_monotone(runs: &mut [VariantRun<'_>]) {
    for series in Series::over_element_size() {
        let mut of_series: Vec<_> =
            runs.iter_mut().filter(|run| run.variant.series == series).collect();
        let size = |run: &VariantRun<'_>| run.variant.value.unwrap_or(f64::INFINITY);
        of_series.sort_by(|a, b| size(a).total_cmp(&size(b)));
        let mut worst = [None; 7];
        for VariantRun { errors, .. } in of_series {
            let own = errors.monotone.iter_mut().chain([&mut errors.monotone_stress]);
            for (worst, own) in worst.iter_mut().zip(own) {
                *own = own.map(|own| worst.map_or(own, |worst: f64| worst.max(own)));
                *worst = own.or(*worst);
            }
        }
    }
}

/// Marks, from the fastest on, each variant that is closer to the limit than all before it.
fn mark_frontier(runs: &mut [VariantRun<'_>]) {
    let mut by_time: Vec<_> =
        runs.iter_mut().filter(|run| run.variant.series.is_choice()).collect();
    by_time.sort_by(|a, b| a.seconds.total_cmp(&b.seconds));
    let mut nearest = f64::INFINITY;
    for VariantRun { errors, .. } in by_time {
        let Some(worst) = errors.worst.filter(|worst| *worst < nearest) else { continue };
        nearest = worst;
        errors.is_on_frontier = true;
    }
}

/// Returns the sources of errors, as far as the variants that show them have run.
fn parts(runs: &[VariantRun<'_>], limits: &[Option<Limit>; 6]) -> Vec<ErrorPart> {
    let values = |series, value: Option<f64>| {
        let mut same = of_series(runs, series).filter(|run| {
            let variant = run.variant;
            (variant.elements_across.is_none() || variant.has_common_elements)
                && (value.is_none() || variant.value == value)
        });
        same.next().map(|run| run.measurement.values)
    };
    let of_limits = |part: fn(Limit) -> Option<f64>| limits.map(|limit| limit.and_then(part));
    let limit_values = of_limits(|limit| Some(limit.value));
    let part = |source, values: Option<Numbers>, others: Option<Numbers>, factor: f64| {
        let (values, others) = (values?, others?);
        let errors = QuantityOfInterest::ALL.map(|quantity| {
            let k = quantity as usize;
            Some(factor * (values[k]? - others[k]?) / quantity.scale(limit_values[k]?))
        });
        errors.iter().any(Option::is_some).then_some(ErrorPart { source, errors })
    };
    let base = values(Series::Explicit, None);
    let condensed = Some(of_limits(|limit| limit.condensed));
    let explicit = Some(of_limits(|limit| Some(limit.condensed? + limit.added?)));
    let stiffer = values(Series::PenaltyFactor, Some(4.0));
    let unscaled = values(Series::MassScaling, Some(0.0));
    let strained = values(Series::FiniteStrain, None);
    // If finite strain is always on, both are the same.
    let small_strain = values(Series::Penalty, None).filter(|_| base != strained);
    let all = [
        part(ErrorSource::Mesh, values(Series::Condensed, None), condensed, 1.0),
        part(ErrorSource::ContactSprings, base, stiffer, QUARTERED),
        part(ErrorSource::MovedMass, base, unscaled, 1.0),
        part(ErrorSource::TimeStep, base, values(Series::StepFactor, Some(0.45)), QUARTERED),
        part(ErrorSource::LeftOutByCondensed, condensed, explicit, 1.0),
        part(ErrorSource::SmallStrain, small_strain, strained, 1.0),
    ];
    all.into_iter().flatten().collect()
}
