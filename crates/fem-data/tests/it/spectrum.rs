//! Prony series from restitutions of Ting's model: a known series is found as far as the data determine
//! it, which the intervals show.

use fem_data::estimate::FitError;
use fem_data::estimate::spectrum::{
    SpectrumFit, SpectrumProblem, SpeedExponent, SpeedPoint, speed_exponent,
};
use fem_laws::{Pair, PairRelaxation, Partner, Ting};
use fem_material::{ActsOn, ElasticModuli, Material, PronySeries, PronyTerm};

/// Speeds over two decades, which span a factor of 2.5 in contact time.
const SPEEDS: [f64; 6] = [0.02, 0.05, 0.12, 0.3, 0.8, 2.0];
/// Relaxation times of the series; contact times are 48 to 120 µs.
const TRUE: [(f64, f64); 2] = [(0.05, 20e-6), (0.25, 300e-6)];
const GRID: [f64; 5] = [5e-6, 20e-6, 80e-6, 300e-6, 1200e-6];

fn restitutions(terms: &[(f64, f64)]) -> Result<Vec<f64>, FitError> {
    let moduli = ElasticModuli::from_youngs_modulus_poissons_ratio(63e9, 0.244).unwrap();
    let terms = terms
        .iter()
        .map(|&(weight, relaxation_time)| PronyTerm { weight, relaxation_time })
        .collect();
    let series = PronySeries::new(terms, ActsOn::All).unwrap();
    let glass = Material::new(2390.0, moduli, Some(series)).unwrap();
    let sphere = |diameter| Partner::solid_sphere(diameter, &glass);
    let pair = Pair::new(sphere(22.2e-3), sphere(15.9e-3))?;
    let relaxation = PairRelaxation::new(Some(&glass), Some(&glass))?;
    let ting = Ting::new(&pair, relaxation).with_tolerance(1e-7)?;
    SPEEDS.iter().map(|speed| Ok(ting.impact(*speed)?.restitution)).collect()
}

fn fit(
    measured: &[f64],
    uncertainties: Option<&[f64]>,
    times: &[f64],
    regularisation: f64,
) -> Result<SpectrumFit, FitError> {
    let model = |weights: &[f64]| {
        restitutions(&weights.iter().copied().zip(times.iter().copied()).collect::<Vec<_>>())
    };
    let problem = SpectrumProblem {
        restitutions: &model,
        measured,
        collisions: &(0..measured.len()).collect::<Vec<_>>(),
        uncertainties,
        times,
        regularisation,
        is_robust: false,
        prior: None,
    };
    problem.fit(0.95)
}

/// With the right relaxation times and no noise the weights are found.
#[test]
fn weights_are_found_at_their_own_times() {
    let measured = restitutions(&TRUE).unwrap();
    let found = fit(&measured, None, &TRUE.map(|term| term.1), 0.0).unwrap();
    for (weight, (expected, _)) in found.weights.iter().zip(TRUE) {
        // The least ridge and the differences of the Jacobian stop at 1e-6 of a weight.
        assert!((weight - expected).abs() < 1e-5, "{:?}", found.weights);
    }
    assert!(found.rms < 1e-7, "{}", found.rms);
}

/// On a grid of more times the restitutions and the combinations that the data determine are reproduced;
/// the true weights lie in all ranges.
#[test]
fn restitutions_and_determined_combinations_are_found_on_a_grid() {
    let measured = restitutions(&TRUE).unwrap();
    let found = fit(&measured, None, &GRID, 1e-4).unwrap();
    for (e, measured) in found.restitutions.iter().zip(&measured) {
        assert!((e - measured).abs() < 1e-4, "{e} {measured}");
    }
    let of_grid = |time: &f64| TRUE.iter().find(|term| term.1 == *time).map_or(0.0, |term| term.0);
    let expected: Vec<f64> = GRID.iter().map(of_grid).collect();
    let n_determined = found.resolution.n_determined();
    assert!((1..GRID.len()).contains(&n_determined), "{n_determined}");
    for combination in found.resolution.combinations.iter().filter(|c| c.is_determined) {
        let value: f64 = combination.coefficients.iter().zip(&expected).map(|(v, w)| v * w).sum();
        let away = (combination.value - value).abs();
        assert!(away < 2.0 * combination.standard_error, "{combination:?}, true {value}");
    }
    for (range, expected) in found.weight_ranges.iter().zip(&expected) {
        assert!(range.low - 1e-6 <= *expected && *expected <= range.high + 1e-6, "{range:?}");
    }
}

/// With normal noise of a known size the 95 % intervals of both weights contain the truth in 6
/// trials about as often as they should. Bounds make them conservative.
#[test]
fn intervals_contain_the_truth_under_noise() {
    let exact = restitutions(&TRUE).unwrap();
    let size = 2e-3;
    let times = TRUE.map(|term| term.1);
    let mut random = 12345u64;
    let mut uniform = || {
        random = random.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
        (random >> 11) as f64 / (1u64 << 53) as f64
    };
    let mut held = 0;
    const TRIALS: usize = 6;
    for _ in 0..TRIALS {
        let mut noise = || (0..12).map(|_| uniform()).sum::<f64>() - 6.0;
        let measured: Vec<f64> = exact.iter().map(|e| e + size * noise()).collect();
        let found = fit(&measured, Some(&[size; SPEEDS.len()]), &times, 0.0).unwrap();
        let holds = |k: usize| {
            let range = found.weight_ranges[k];
            range.low <= TRUE[k].0 && TRUE[k].0 <= range.high
        };
        held += usize::from(holds(0)) + usize::from(holds(1));
    }
    // 11.4 of 12 are expected; the two of a trial are correlated.
    assert!(held >= 9, "{held} of {}", 2 * TRIALS);
    let narrow = fit(&exact, Some(&[size; SPEEDS.len()]), &times, 0.0).unwrap();
    // An interval that contains everything would pass, too.
    assert!(narrow.weight_ranges[1].high - narrow.weight_ranges[1].low < 0.2, "{narrow:?}");
}

/// One point and four terms determine one combination, and no single weight.
#[test]
fn one_point_determines_one_combination() {
    let model = |weights: &[f64]| {
        let terms: Vec<_> = weights.iter().copied().zip(GRID).collect();
        Ok(restitutions(&terms)?[4..5].to_vec())
    };
    let problem = |regularisation| SpectrumProblem {
        restitutions: &model,
        measured: &[0.925],
        collisions: &[0],
        uncertainties: None,
        times: &GRID[1..],
        regularisation,
        is_robust: false,
        prior: None,
    };
    assert!(matches!(
        problem(0.0).fit(0.95),
        Err(FitError::TooFewData { n_values: 1, n_free: 4, .. })
    ));
    let found = problem(1e-3).fit(0.95).unwrap();
    assert_eq!(found.resolution.n_determined(), 1);
    // The least of the ridge: 1e-3 of a weight is 1e-6 of the squares.
    assert!((found.restitutions[0] - 0.925).abs() < 1e-5, "{:?}", found.restitutions);
    for range in &found.weight_ranges {
        assert!(range.low == 0.0 && range.high > 0.0, "{range:?}");
    }
}

/// If the loss is larger than that of any weights of these times, the sum of the weights stays 1.
#[test]
fn weights_sum_to_at_most_one() {
    let measured = [0.1; SPEEDS.len()];
    let found = fit(&measured, None, &[3000e-6, 9000e-6], 0.0).unwrap();
    let sum: f64 = found.weights.iter().sum();
    assert!(sum <= 1.0 + 1e-12 && sum > 0.999, "{:?}", found.weights);
}

/// One restitution determines a sum of weights if its uncertainty is 0.01, but not if it is 0.2, and a
/// value of less than two standard errors may be zero.
#[test]
fn uncertain_weights_are_not_determined() {
    let measured = restitutions(&TRUE).unwrap();
    let of = |uncertainty: f64| {
        let uncertainties = vec![uncertainty; measured.len()];
        fit(&measured, Some(&uncertainties), &GRID, 1e-3).unwrap().resolution
    };
    let sharp = of(1e-4);
    for combination in &sharp.combinations {
        let [least, largest] = [f64::min, f64::max]
            .map(|fold| combination.coefficients.iter().copied().fold(0.0, fold));
        // 95 % of what is possible are within two errors on either side.
        let is_open = 4.0 * combination.standard_error > 0.5 * (largest - least);
        assert_eq!(combination.is_determined, !is_open, "{combination:?}");
    }
    assert!(sharp.n_determined() > of(0.2).n_determined());
    assert_eq!(of(0.9).n_determined(), 0);
    assert!(!sharp.combinations[0].may_be_zero() && of(0.9).combinations[0].may_be_zero());
}

/// Repeats of a collision scatter about their own mean; with enough of them the misfit is relative to that scatter.
#[test]
fn repeats_give_the_pure_error() {
    let model =
        |weights: &[f64]| Ok([1.0, 1.0, 0.5, 0.2].map(|share| 1.0 - share * weights[0]).to_vec());
    let problem = |collisions: &[usize]| {
        let measured = &[0.90, 0.92, 0.70, 0.50];
        SpectrumProblem {
            restitutions: &model,
            measured,
            collisions,
            uncertainties: None,
            times: &[1e-4],
            regularisation: 0.0,
            is_robust: false,
            prior: None,
        }
        .fit(0.95)
        .unwrap()
    };
    assert_eq!(problem(&[0, 1, 2, 3]).pure_error, None);
    let found = problem(&[0, 0, 1, 2]);
    // ±0.01 about the mean, with one degree of freedom, which is too few for a misfit.
    let pure = found.pure_error.unwrap();
    assert!((pure.error - 0.02f64 / 2f64.sqrt()).abs() < 1e-15);
    assert_eq!((pure.degrees_of_freedom, found.misfit), (1, None));
}

#[test]
fn powers_of_several_pairs_are_found() {
    let point = |pair: usize, speed: f64| SpeedPoint {
        pair,
        speed,
        restitution: 1.0 - 0.1 * (pair as f64 + 1.0) * speed.powf(0.3),
    };
    let points: Vec<_> = (0..6).map(|k| point(k % 2, 0.1 * (k as f64 + 1.0))).collect();
    let found = speed_exponent(&points).unwrap();
    assert!((found.value - 0.3).abs() < 1e-12 && found.is_above(SpeedExponent::LIMIT));
    assert_eq!(speed_exponent(&points[..1]), None);
}

/// Two of twenty restitutions are far too small: with robust weights the sum of the weights of the series is within its
/// range, without them it is not.
#[test]
fn a_robust_series_leaves_gross_errors_out() {
    let clean = restitutions(&TRUE).unwrap();
    let mut measured: Vec<f64> = (0..18).map(|k| clean[k % SPEEDS.len()]).collect();
    for (k, e) in measured.iter_mut().enumerate() {
        // Scatter of 0.002 in both directions.
        *e += 0.002 * [1.0, -1.0, 0.3, -0.6, 0.7, -0.4, 0.2][k % 7];
    }
    measured[5] -= 0.2;
    measured[12] -= 0.15;
    let time = TRUE[1].1;
    let model = |weights: &[f64]| {
        let once = restitutions(&[TRUE[0], (weights[0], time)])?;
        Ok((0..18).map(|k| once[k % SPEEDS.len()]).collect())
    };
    let found = |is_robust: bool| {
        let problem = SpectrumProblem {
            restitutions: &model,
            measured: &measured,
            collisions: &(0..18).map(|k| k % SPEEDS.len()).collect::<Vec<_>>(),
            uncertainties: None,
            times: &[time],
            regularisation: 0.0,
            is_robust,
            prior: None,
        };
        problem.fit(0.95).unwrap()
    };
    let (plain, robust) = (found(false), found(true));
    let range = &robust.weight_ranges[0];
    assert!(range.low < TRUE[1].0 && TRUE[1].0 < range.high, "{range:?}");
    assert!((robust.weights[0] - TRUE[1].0).abs() < 0.01, "{}", robust.weights[0]);
    assert!((plain.weights[0] - TRUE[1].0).abs() > 0.05, "{}", plain.weights[0]);
    let far: Vec<usize> = robust.robustness.as_ref().unwrap().outliers().collect();
    assert_eq!(far, [5, 12]);
    assert!(robust.rms < 0.01 && plain.rms > 0.04, "{} {}", robust.rms, plain.rms);
}
