//! The accuracy study: the variants of a scene and their comparison.

use fem::accuracy::{ErrorSource, Measurement, Series, Study, Variants};
use fem::{Case, ErrorEstimator, Simulation};
use fem_case::Accuracy;
use fem_collision::QuantityOfInterest;
use std::sync::LazyLock;

use crate::scene::case_of;

const BALL: &str = "material.ice = { density = 917, youngs_modulus = 9.3e9, poissons_ratio = 0.33 }
    body = [{ name = 'ball', sphere.diameter = '2 cm', material = 'ice', approach_speed = 0.2 },
            { name = 'floor', wall = {} }]";

fn case(text: &str) -> Case {
    case_of::<&str>(text, &[])
}

/// Each variant of an oblique impact has its friction and is accepted by a run, so that explicit elements are none.
#[test]
fn variants_of_an_oblique_impact_have_its_friction() {
    let variants =
        Variants::of(&case(include_str!("../../../../cases/oblique_glass.toml"))).unwrap();
    assert!(variants.all.iter().any(|variant| variant.series == Series::Condensed));
    for variant in &variants.all {
        assert_eq!(variant.case.scene().friction(), 0.15);
        assert!(!variant.is_explicit() && Simulation::new(variant.case.clone()).is_ok());
    }
}

/// The variants of the ball and the results of those that are cheap or have the common element size.
type Results = (Variants, Vec<Option<(Measurement, f64)>>);

static MEASURED: LazyLock<Results> = LazyLock::new(|| {
    let variants = Variants::of(&case(BALL)).unwrap();
    let measure = |variant: &fem::accuracy::Variant| {
        let across = variant.elements_across.unwrap_or_default();
        let is_needed = variant.element_updates <= 4_000_000 || variant.has_common_elements;
        let measure = || Measurement::of(variant, variants.contact_radius, &mut ()).unwrap();
        (is_needed && across < 17.0).then(|| (measure(), 1.0 + across))
    };
    let measured = variants.all.iter().map(measure).collect();
    (variants, measured)
});

/// Returns the study of the variants with a limited number of element updates.
fn study(most_updates: u64, accuracy: &Accuracy) -> Study<'static> {
    let (variants, measured) = &*MEASURED;
    let pairs = variants.all.iter().zip(measured);
    let cheap = pairs.map(|(variant, result)| {
        result.clone().filter(|_| variant.element_updates <= most_updates)
    });
    Study::of(variants, cheap.collect::<Vec<_>>().leak(), accuracy)
}

/// The limit of an elastic ball on a wall is Hertz' closed form with the finite size of the ball, which is accurate
/// to 0.05 % in contact time and force at this contact radius of 0.03 ball radii. The error falls with the element
/// size.
#[test]
fn accuracy_limit_equals_theory_and_errors_fall_with_element_size() {
    let study = study(4_000_000, &case(BALL).scene().accuracy());
    let (variants, measured) = &*MEASURED;
    let mut theory =
        variants.all.iter().zip(measured).filter(|(variant, _)| variant.series == Series::Hertz);
    let theory = &theory.next_back().unwrap().1.as_ref().unwrap().0;
    for quantity in [
        QuantityOfInterest::ContactTime,
        QuantityOfInterest::PeakForce,
        QuantityOfInterest::MaxApproach,
    ] {
        let limit = study.limits[quantity as usize].unwrap();
        let error = limit.value / theory.value(quantity).unwrap() - 1.0;
        assert!(error.abs() < 7e-4, "{quantity:?} {error:e} {limit:?}");
        // Without the finite size the error would exceed 0.3 %.
        assert!(limit.uncertainty < 1e-3 * limit.value, "{quantity:?} {limit:?}");
    }
    let restitution = study.limits[QuantityOfInterest::Restitution as usize].unwrap();
    assert!((restitution.value - 1.0).abs() < 1e-4, "{restitution:?}");

    let errors = |series| {
        let of_series = study.runs.iter().filter(move |run| run.variant.series == series);
        of_series.map(|run| run.errors)
    };
    let condensed: Vec<_> = errors(Series::Condensed).map(|errors| errors.monotone).collect();
    assert_eq!(condensed.len(), 7);
    for quantity in QuantityOfInterest::ALL {
        let errors: Vec<f64> =
            condensed.iter().map(|sure| sure[quantity as usize].unwrap()).collect();
        assert!(errors.is_sorted_by(|coarse, fine| coarse >= fine), "{quantity:?} {errors:?}");
    }
    // Force and pressure converge with first order or better: the error of three elements across is several times that of
    // eight.
    for quantity in [QuantityOfInterest::PeakForce, QuantityOfInterest::PeakPressure] {
        let k = quantity as usize;
        assert!(condensed[0][k].unwrap() > 2.5 * condensed[4][k].unwrap(), "{quantity:?}");
    }
    for series in [Series::Condensed, Series::Explicit] {
        let stress: Vec<f64> = errors(series).filter_map(|errors| errors.monotone_stress).collect();
        let is_falling = stress.is_sorted_by(|coarse, fine| coarse >= fine);
        assert!(stress.len() >= 3 && is_falling, "{stress:?}");
    }
    let stress: Vec<_> = errors(Series::Condensed).map(|errors| errors.stress).collect();
    let (coarse, fine) = (stress[0], stress[5]);
    assert!(coarse > fine.map(|fine| 3.0 * fine), "{coarse:?} {fine:?}");
}

/// The fastest variant within the tolerance is chosen; variants of a single setting are not considered.
#[test]
fn the_cheapest_variant_within_the_tolerance_is_chosen() {
    let study = study(500_000, &case(BALL).scene().accuracy());
    let all = study.cheapest_within(|_| true).unwrap().variant;
    assert_eq!(all.series, Series::Hertz);
    let meshes = study.cheapest_within(|run| run.variant.elements_across.is_some());
    let meshes = meshes.unwrap().variant;
    assert_eq!(meshes.series, Series::Condensed);
    assert!(meshes.elements_across.unwrap() < 8.0, "{meshes:?}");
    let strict = self::study(500_000, &Accuracy::within(1e-6));
    assert!(strict.cheapest_within(|_| true).is_none());
}

/// Each part of the error has a value for each quantity. Compliant springs lengthen contact time and approach.
#[test]
fn accuracy_gives_the_error_of_each_source() {
    let study = study(u64::MAX, &case(BALL).scene().accuracy());
    let part = |source| study.parts.iter().find(|part| part.source == source).unwrap();
    for source in [ErrorSource::Mesh, ErrorSource::ContactSprings, ErrorSource::LeftOutByCondensed]
    {
        assert!(part(source).errors.iter().all(Option::is_some), "{source:?}");
    }
    let springs = part(ErrorSource::ContactSprings).errors;
    for quantity in [QuantityOfInterest::ContactTime, QuantityOfInterest::MaxApproach] {
        // About 0.1 % at the default stiffness: docs/contact.md.
        let error = springs[quantity as usize].unwrap();
        assert!((2e-4..5e-3).contains(&error), "{quantity:?} {error:e}");
    }
}

/// No two variants are equal, no variant has a setting that its scene does not read, and each model has one variant
/// with the common element size, from which the parts of the error follow.
#[test]
fn no_variant_occurs_twice() {
    let relaxing = BALL.replace(
        "poissons_ratio = 0.33 }",
        "poissons_ratio = 0.33, relaxation = { acts_on = 'all', terms = [{ weight = 0.5, decay_rate = 1e4 }] } }",
    );
    let unlike = relaxing.replace("wall = {}", "sphere.diameter = '3 cm', material = 'steel'")
        + "\nmaterial.steel = { density = 7800, youngs_modulus = 210e9, poissons_ratio = 0.3 }";
    let soft = BALL.replace("9.3e9", "1e6").replace("approach_speed = 0.2", "approach_speed = 2");
    for (text, slips, is_finite) in [
        (BALL, false, false),
        (&relaxing, false, false),
        (&unlike, true, false),
        (&soft, false, true),
    ] {
        let variants = Variants::of(&case(text)).unwrap().all;
        for (k, variant) in variants.iter().enumerate() {
            let same =
                variants[..k].iter().find(|other| other.case.scene() == variant.case.scene());
            assert!(same.is_none(), "{text}: {:?} {same:?}", variant.overrides());
        }
        let has = |series| variants.iter().any(|variant| variant.series == series);
        assert_eq!(has(Series::NodeToSurface), !slips && !is_finite, "{text}");
        assert_eq!([has(Series::Penalty), has(Series::FiniteStrain)], [!is_finite; 2], "{text}");
        for series in [Series::Condensed, Series::CondensedSprings, Series::Explicit] {
            let common = variants.iter().filter(|variant| variant.has_common_elements);
            assert_eq!(
                common.filter(|variant| variant.series == series).count(),
                1,
                "{text}: {series:?}"
            );
        }
    }
}

/// A mesh of the user's own cannot be refined: the other variants run, and the limit is not known.
#[test]
fn an_effect_that_a_scene_lacks_has_no_variant() {
    let variants = Variants::of(&case(BALL)).unwrap();
    let has =
        |variants: &Variants, series| variants.all.iter().any(|variant| variant.series == series);
    assert!(!has(&variants, Series::Ting) && has(&variants, Series::AsWritten));
    // The case as written is what a run of it computes.
    let own = variants.all.iter().find(|variant| variant.series == Series::AsWritten).unwrap();
    let simulation = Simulation::new(case(BALL)).unwrap();
    let run = ErrorEstimator::default().refine_before_run(simulation, || true).simulation;
    assert_eq!(own.case.file().mesh, run.resolved().mesh);
    let relaxing = BALL.replace(
        "poissons_ratio = 0.33 }",
        "poissons_ratio = 0.33, relaxation = { acts_on = 'all', terms = [{ weight = 0.5, decay_rate = 1e4 }] } }",
    );
    let relaxing = relaxing + "\n[mesh]\ncontact_element_size = 1e-4\n";
    let variants = Variants::of(&case(&relaxing)).unwrap();
    assert!(has(&variants, Series::Ting) && has(&variants, Series::AsWritten));
    let sizes = |series| {
        let of_series = variants.all.iter().filter(move |variant| variant.series == series);
        of_series.filter_map(|variant| variant.case.scene().mesh().contact_element_size)
    };
    assert_eq!(sizes(Series::AsWritten).collect::<Vec<_>>(), [1e-4]);
    // From coarse to fine.
    assert!(sizes(Series::Explicit).collect::<Vec<_>>().is_sorted_by(|a, b| a > b));
    let order = variants.cheapest_first();
    assert!(order.iter().map(|k| variants.all[*k].element_updates).is_sorted());
}
