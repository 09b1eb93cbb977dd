//! A Prony series from moduli: non-negative moduli of Maxwell elements on a grid of relaxation times.
//!
//! The moduli M_∞ and M_k of the model of `fem_material::prony` are linear in the data, so that for given relaxation
//! times they are a problem of non-negative least squares. The residuals are relative,
//!
//! ```math
//! \frac{M'(\omega_i)-\hat M'_i}{\hat M'_i}, \qquad
//! \frac{M''(\omega_i)-\hat M''_i}{\sqrt{\hat M_i''^2+(0.01\,\hat M'_i)^2}},
//! ```
//!
//! since an instrument measures a force amplitude to a share and a phase to an angle. If both scatter differently about the series, it is
//! found once more with each over its own scatter. The grid is the one of several spacings
//! and positions with the least Bayesian information criterion (Schwarz, *Ann. Stat.* 6 (1978) 461), n ln(S/n) + p ln n with
//! the sum of squares S of n residuals and p < n parameters. Terms are then removed, and their times varied, as long as it falls.
//!
//! A smooth spectrum with one term per decade gives a loss modulus that is wavy by 2/cosh(π²/ln 10) = 5.5 %, with two per
//! decade by 0.08 %: data that are better than that ask for more than one.
//!
//! Limits: moduli of terms faster than the highest frequency are determined by its loss modulus alone, those of terms slower
//! than the lowest by its storage modulus. The uncertainties of the glassy and the rubbery modulus allow for terms up to a decade beyond
//! the frequencies.

use nalgebra::{Cholesky, DMatrix, DVector};

use fem_material::maxwell_element;

use crate::estimate::covariance;
use crate::estimate::spectrum::bounded::{Linear, non_negative};
use crate::table::{ModulusPoint, TestKind};

use super::joint::vary_times;

/// Share of the storage modulus that is the least scale of a residual of the loss modulus: phases are measured to about
/// half a degree.
const PHASE_RESOLUTION: f64 = 0.01;
/// Grids reach beyond the data by this factor of time.
const MARGIN: f64 = 3.0;
/// Factor of time beyond the data of terms that the glassy and the rubbery modulus may have.
const BEYOND: f64 = 10.0;
/// Terms per decade of the grids.
const DENSITIES: [f64; 4] = [0.5, 1.0, 1.5, 2.0];
/// Positions of a grid, in shares of its spacing.
const POSITIONS: [f64; 2] = [0.0, 0.5];
/// The least rms of relative residuals that counts: rounding of printed numbers.
pub(super) const ROUNDING: f64 = 1e-8;
/// Terms whose times differ by a smaller factor are one.
const MIN_RATIO: f64 = 1.3;
/// Ratio of the scatter of both moduli below which they count alike: that of forty points is known to a sixth.
const LEAST_CONTRAST: f64 = 1.25;
/// Residuals per parameter that show the scatter of either modulus.
const MIN_ROWS: usize = 3;
/// Most products of residuals and terms for which the times are varied.
const MAX_VARIED: usize = 40_000;

/// Least share of a column that the columns before it leave if it is distinguished from them by products.
const MIN_PIVOT: f64 = 1e-5;

/// A Maxwell element that was found.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FittedTerm {
    /// Relaxation time, s.
    pub relaxation_time: f64,
    /// Modulus, Pa, > 0.
    pub modulus: f64,
    /// Standard uncertainty of the modulus, Pa, with all other moduli and times free.
    pub uncertainty: f64,
}

/// A series that was found.
#[derive(Clone, Debug, PartialEq)]
pub struct FittedSeries {
    /// Equilibrium modulus, Pa, ≥ 0.
    pub equilibrium_modulus: f64,
    /// Its standard uncertainty, Pa.
    pub equilibrium_uncertainty: f64,
    /// Terms by rising relaxation time.
    pub terms: Vec<FittedTerm>,
    /// Standard uncertainty of the sum of all moduli, Pa. It allows for terms up to ten times faster than the data, and not for those
    /// that are faster still, of which the data show nothing.
    pub instantaneous_uncertainty: f64,
    /// Standard uncertainty of the loss modulus at each point over its value, without that of shifts.
    pub loss_uncertainties: Vec<f64>,
    /// Standard uncertainty of the storage modulus at the highest measured frequency over its value.
    pub fastest_uncertainty: f64,
    /// Root mean square of the relative residuals.
    pub rms: f64,
}

impl FittedSeries {
    /// Returns the sum of all moduli, Pa.
    pub fn instantaneous_modulus(&self) -> f64 {
        self.equilibrium_modulus + self.terms.iter().map(|term| term.modulus).sum::<f64>()
    }

    /// Returns d ln M″/d ln ω of an oscillation of an angular frequency, rad/s.
    pub(super) fn loss_slope(&self, angular_frequency: f64) -> f64 {
        let of = |part: fn(TestKind, f64, f64) -> [f64; 2]| -> f64 {
            let terms = self.terms.iter();
            let loss = |term: &FittedTerm| {
                term.modulus
                    * part(TestKind::Oscillation, angular_frequency, term.relaxation_time)[1]
            };
            terms.map(loss).sum()
        };
        of(slope) / of(element)
    }

    /// Returns storage and loss modulus at an angular frequency (rad/s), or relaxation modulus and 0 at a time (s), Pa.
    pub fn moduli(&self, kind: TestKind, at: f64) -> [f64; 2] {
        self.terms.iter().fold([self.equilibrium_modulus, 0.0], |sum, term| {
            let of_term = element(kind, at, term.relaxation_time);
            [0, 1].map(|part: usize| sum[part] + term.modulus * of_term[part])
        })
    }
}

/// Returns what a Maxwell element of modulus 1 has of both moduli.
fn element(kind: TestKind, at: f64, relaxation_time: f64) -> [f64; 2] {
    match kind {
        TestKind::Oscillation => maxwell_element(at * relaxation_time),
        TestKind::Relaxation => [(-at / relaxation_time).exp(), 0.0],
    }
}

/// Returns the derivative of [`element`] by ln τ.
fn slope(kind: TestKind, at: f64, relaxation_time: f64) -> [f64; 2] {
    let [storage, loss] = element(kind, at, relaxation_time);
    match kind {
        // x²/(1 + x²) has the slope 2 x²/(1 + x²)² and x/(1 + x²) has x (1 − x²)/(1 + x²)².
        TestKind::Oscillation => [2.0 * storage * (1.0 - storage), loss * (1.0 - 2.0 * storage)],
        TestKind::Relaxation => [at / relaxation_time * storage, 0.0],
    }
}

/// A modulus that is to be met.
#[derive(Clone, Copy)]
struct Row {
    at: f64,
    part: usize,
    value: f64,
    scale: f64,
}

/// Moduli of terms at given times; the last modulus is that of equilibrium.
#[derive(Clone)]
struct Candidate {
    times: Vec<f64>,
    moduli: Vec<f64>,
    /// Parameters per term: its modulus, and its time if that is varied.
    per_term: usize,
    criterion: f64,
}

impl Candidate {
    fn n_parameters(&self) -> usize {
        self.per_term * self.times.len() + 1
    }

    /// Returns the relative standard uncertainty of a part of the complex modulus at an angular frequency, 1/s, by the covariance of the
    /// moduli, and of the times if it has these.
    fn relative_uncertainty(&self, covariance: &DMatrix<f64>, rate: f64, part: usize) -> f64 {
        let n = self.times.len();
        let mut slopes = DVector::zeros(covariance.nrows());
        slopes[n] = [1.0, 0.0][part];
        let mut modulus = self.moduli[n] * slopes[n];
        for k in 0..n {
            let time = self.times[k];
            slopes[k] = element(TestKind::Oscillation, rate, time)[part];
            modulus += self.moduli[k] * slopes[k];
            if slopes.len() > n + 1 {
                slopes[n + 1 + k] = self.moduli[k] * slope(TestKind::Oscillation, rate, time)[part];
            }
        }
        let variance = (slopes.transpose() * covariance * slopes)[0];
        variance.max(0.0).sqrt() / modulus
    }
}

pub(super) struct Observations {
    kind: TestKind,
    /// The factor of the scales of losses.
    loss_scale: f64,
    rows: Vec<Row>,
}

/// The triangular factor of the columns of terms at given times, of equilibrium, of the derivatives of the terms by ln τ, and of the
/// moduli. Problems of some of these columns have its columns.
struct Compressed {
    n_rows: usize,
    n_terms: usize,
    factor: DMatrix<f64>,
}

impl Compressed {
    fn of(observations: &Observations, times: &[f64]) -> Self {
        let n = times.len();
        let Linear { a, b } = observations.linear_of_all(times);
        let mut all = a.resize_horizontally(2 * n + 2, 0.0);
        all.columns_mut(n + 1, n).copy_from(&observations.slopes(times));
        all.set_column(2 * n + 1, &b);
        Self { n_rows: all.nrows(), n_terms: n, factor: all.qr().r() }
    }

    /// Returns the problem of the moduli of some terms and of equilibrium.
    fn linear(&self, numbers: &[usize]) -> Linear {
        let kept: Vec<usize> = numbers.iter().copied().chain([self.n_terms]).collect();
        let b = self.factor.column(2 * self.n_terms + 1).into_owned();
        Linear { a: self.factor.select_columns(&kept), b }
    }

    /// Returns the covariance of the moduli of some terms and of equilibrium, and of their times if these are varied.
    fn covariance(&self, numbers: &[usize], found: &Candidate) -> Option<DMatrix<f64>> {
        let mut linear = self.linear(numbers);
        let misfit = linear.misfit(&found.moduli);
        if found.per_term == 2 {
            let n = linear.a.ncols();
            linear.a = linear.a.resize_horizontally(n + numbers.len(), 0.0);
            for (k, number) in numbers.iter().enumerate() {
                let slope = self.factor.column(self.n_terms + 1 + number) * found.moduli[k];
                linear.a.set_column(n + k, &slope);
            }
        }
        let freedom = self.n_rows.saturating_sub(found.n_parameters()).max(1) as f64;
        covariance(&linear.a, misfit / freedom)
    }
}

impl Observations {
    /// Returns the moduli over themselves; a loss angle is resolved to that of instruments.
    pub fn of(kind: TestKind, points: &[ModulusPoint]) -> Self {
        Self::with_resolution(kind, points, PHASE_RESOLUTION)
    }

    /// Returns the storage moduli over themselves and the loss moduli over |E*|, about as force and displacement are measured.
    pub fn over_magnitude(kind: TestKind, points: &[ModulusPoint]) -> Self {
        Self::with_resolution(kind, points, 1.0)
    }

    fn with_resolution(kind: TestKind, points: &[ModulusPoint], resolution: f64) -> Self {
        let rows = points.iter().flat_map(|point| {
            let ModulusPoint { at, storage, loss, .. } = *point;
            let storage_row = Row { at, part: 0, value: storage, scale: storage };
            let loss_scale = loss.hypot(resolution * storage);
            let loss_row = Row { at, part: 1, value: loss, scale: loss_scale };
            let is_oscillation = kind == TestKind::Oscillation;
            [Some(storage_row), is_oscillation.then_some(loss_row)]
        });
        Self { kind, loss_scale: 1.0, rows: rows.flatten().collect() }
    }

    /// Returns the measured modulus of a row over its scale.
    pub fn relative(&self, row: usize) -> f64 {
        self.rows[row].value / self.rows[row].scale
    }

    /// Returns a matrix over the scales of the rows with a column per time.
    fn columns(&self, times: &[f64], of: fn(TestKind, f64, f64) -> [f64; 2]) -> DMatrix<f64> {
        let n_parts = if self.kind == TestKind::Oscillation { 2 } else { 1 };
        let mut matrix = DMatrix::zeros(self.rows.len(), times.len());
        let columns = matrix.as_mut_slice().chunks_exact_mut(self.rows.len());
        for (column, time) in columns.zip(times) {
            let points = self.rows.chunks_exact(n_parts);
            for (cells, rows) in column.chunks_exact_mut(n_parts).zip(points) {
                let parts = of(self.kind, rows[0].at, *time);
                for ((cell, row), part) in cells.iter_mut().zip(rows).zip(parts) {
                    *cell = part / row.scale;
                }
            }
        }
        matrix
    }

    /// Returns the derivatives of the moduli over their scales by ln τ of terms of modulus 1.
    pub fn slopes(&self, times: &[f64]) -> DMatrix<f64> {
        self.columns(times, slope)
    }

    /// Returns the criterion of a sum of squares.
    fn criterion(&self, misfit: f64, n_parameters: usize) -> f64 {
        if n_parameters >= self.rows.len() {
            return f64::INFINITY;
        }
        let n = self.rows.len() as f64;
        n * (misfit / n + ROUNDING * ROUNDING).ln() + n_parameters as f64 * n.ln()
    }

    /// Returns the linear problem of the moduli of terms at these times and of equilibrium.
    pub fn linear_of_all(&self, times: &[f64]) -> Linear {
        let k = times.len();
        let mut a = self.columns(times, element).insert_column(k, 0.0);
        for (cell, row) in a.column_mut(k).iter_mut().zip(&self.rows) {
            *cell = [1.0, 0.0][row.part] / row.scale;
        }
        let b = DVector::from_iterator(a.nrows(), self.rows.iter().map(|r| r.value / r.scale));
        Linear { a, b }
    }

    fn linear(&self, times: &[f64]) -> Linear {
        self.linear_of_all(times).compressed()
    }

    /// Returns the moduli of terms at these times, without terms that have none.
    fn solve(&self, times: &[f64], per_term: usize) -> Candidate {
        let all: Vec<usize> = (0..times.len()).collect();
        self.solve_of(&self.linear(times), &all, times, per_term).0
    }

    /// Returns the moduli of those of the terms that are given by their numbers, without terms that have none, and the numbers that remain.
    fn solve_of(
        &self,
        linear: &Linear,
        numbers: &[usize],
        times: &[f64],
        per_term: usize,
    ) -> (Candidate, Vec<usize>) {
        let moduli = non_negative(&linear.a, &linear.b);
        let kept: Vec<usize> = (0..numbers.len()).filter(|k| moduli[*k] > 0.0).collect();
        let mut found = Candidate {
            times: kept.iter().map(|k| times[numbers[*k]]).collect(),
            moduli: kept.iter().map(|k| moduli[*k]).chain([moduli[numbers.len()]]).collect(),
            per_term,
            criterion: 0.0,
        };
        let misfit = linear.misfit(moduli.as_slice());
        found.criterion = self.criterion(misfit, found.n_parameters());
        (found, kept.iter().map(|k| numbers[*k]).collect())
    }

    /// Returns the covariance of the moduli, with the times free if they are varied.
    fn covariance(&self, candidate: &Candidate) -> Option<DMatrix<f64>> {
        let all: Vec<usize> = (0..candidate.times.len()).collect();
        Compressed::of(self, &candidate.times).covariance(&all, candidate)
    }

    /// Returns a candidate without the terms that the data do not ask for.
    fn pruned(&self, mut best: Candidate) -> Candidate {
        let compressed = Compressed::of(self, &best.times);
        let times = best.times.clone();
        let mut numbers: Vec<usize> = (0..times.len()).collect();
        while numbers.len() > 1 {
            let Some(covariance) = compressed.covariance(&numbers, &best) else { break };
            let significance = |k: usize| best.moduli[k] / covariance[(k, k)].max(0.0).sqrt();
            let least = (0..numbers.len())
                .min_by(|i, j| significance(*i).total_cmp(&significance(*j)))
                .unwrap_or(0);
            let mut without = numbers.clone();
            without.remove(least);
            let linear = compressed.linear(&without);
            let (fewer, left) = self.solve_of(&linear, &without, &times, best.per_term);
            if fewer.criterion > best.criterion {
                break;
            }
            (best, numbers) = (fewer, left);
        }
        best
    }

    /// Returns a candidate whose times are varied too, if that is better.
    fn varied(&self, points: &[ModulusPoint], best: Candidate) -> Candidate {
        let n = best.times.len();
        if self.rows.len() * n > MAX_VARIED || 2 * n + 1 >= self.rows.len() {
            return best;
        }
        let times =
            joined(vary_times(self.kind, points, self.loss_scale, &best.times, MARGIN.ln()));
        let varied = self.pruned(self.solve(&times, 2));
        let varied = if varied.times.len() < n { self.varied(points, varied) } else { varied };
        // A grid of the best position has times that were chosen too.
        let with_times = Candidate { per_term: 2, ..best.clone() };
        let n_more = (with_times.n_parameters() - best.n_parameters()) as f64;
        let criterion = best.criterion + n_more * (self.rows.len() as f64).ln();
        if varied.criterion < criterion { varied } else { best }
    }
}

/// Returns the problem as [`Linear::compressed`] does, by the products of the columns, which is much faster; half of the digits of the
/// columns remain. If that is not enough to distinguish the columns, the result is that of [`Linear::compressed`].
pub(super) fn compressed_by_products(problem: &Linear) -> Linear {
    let n = problem.a.ncols();
    let mut whole = problem.a.clone().insert_column(n, 0.0);
    whole.set_column(n, &problem.b);
    let factor = Cholesky::new(whole.transpose() * &whole).map(|factor| factor.l().transpose());
    let is_enough = |r: &DMatrix<f64>| (0..n).all(|k| r[(k, k)] > MIN_PIVOT * r.column(k).norm());
    match factor.filter(is_enough) {
        Some(r) => Linear { a: r.columns(0, n).into_owned(), b: r.column(n).into_owned() },
        None => problem.compressed(),
    }
}

/// Returns the rising times of terms with a modulus > 0. Terms that are close to each other become one, as those on either side of a
/// term that is between the nodes of a grid do.
pub(super) fn joined(terms: impl Iterator<Item = (f64, f64)>) -> Vec<f64> {
    let mut times: Vec<(f64, f64)> = terms.filter(|it| it.1 > 0.0).collect();
    times.sort_by(|a, b| a.0.total_cmp(&b.0));
    let mut joined: Vec<(f64, f64)> = Vec::new();
    for (time, modulus) in times {
        match joined.last_mut() {
            Some(last) if time < MIN_RATIO * last.0 => {
                let sum = last.1 + modulus;
                let log = (last.1 * last.0.ln() + modulus * time.ln()) / sum;
                *last = (log.exp(), sum);
            }
            _ => joined.push((time, modulus)),
        }
    }
    joined.into_iter().map(|it| it.0).collect()
}

/// Returns relaxation times over the span of points, so many per decade, shifted by a share of their spacing.
pub(super) fn grid(
    kind: TestKind,
    points: &[ModulusPoint],
    density: f64,
    position: f64,
) -> Vec<f64> {
    let times = points.iter().map(|point| match kind {
        TestKind::Oscillation => point.at.recip(),
        TestKind::Relaxation => point.at,
    });
    let (first, last) = times.fold((f64::INFINITY, 0.0), |(first, last): (f64, f64), time| {
        (first.min(time), last.max(time))
    });
    let (first, last) = ((first / MARGIN).ln(), (last * MARGIN).ln());
    let spacing = std::f64::consts::LN_10 / density;
    let n = ((last - first) / spacing - position).floor().max(0.0) as usize + 1;
    (0..n).map(|k| (first + (k as f64 + position) * spacing).exp()).collect()
}

/// Returns the series that the points determine. `density` is the number of terms per decade; by default the data choose it.
pub fn fit_series(kind: TestKind, points: &[ModulusPoint], density: Option<f64>) -> FittedSeries {
    let plain = Observations::of(kind, points);
    let first = plain.best(points, density);
    let weighted = plain.weighted(&first);
    let found = match &weighted {
        Some(weighted) => weighted.series(&weighted.best(points, density)),
        None => plain.series(&first),
    };
    let misfit: f64 = plain.residuals(&found).map(|it| it * it).sum();
    FittedSeries { rms: (misfit / plain.rows.len() as f64).sqrt(), ..found }
}

impl Observations {
    /// Returns the moduli with the least criterion.
    fn best(&self, points: &[ModulusPoint], density: Option<f64>) -> Candidate {
        let densities = density.map_or(DENSITIES.to_vec(), |density| vec![density]);
        let grids = densities
            .iter()
            .flat_map(|d| POSITIONS.map(|position| grid(self.kind, points, *d, position)));
        let candidates = grids.map(|times| self.solve(&times, 1));
        let mut best: Option<Candidate> = None;
        for candidate in candidates {
            if best.as_ref().is_none_or(|best| candidate.criterion < best.criterion) {
                best = Some(candidate);
            }
        }
        let best = best.unwrap_or_else(|| self.solve(&[], 1));
        match density {
            None => self.varied(points, self.pruned(best)),
            Some(_) => best,
        }
    }

    /// Returns the residuals of a series over their scales.
    fn residuals(&self, series: &FittedSeries) -> impl Iterator<Item = f64> {
        self.rows
            .iter()
            .map(|row| (series.moduli(self.kind, row.at)[row.part] - row.value) / row.scale)
    }

    /// Returns the moduli with scales of the losses that make their scatter about a series that of the storage moduli; `None` for a
    /// relaxation test, for few moduli, and if both scatter alike.
    fn weighted(&self, found: &Candidate) -> Option<Self> {
        if self.kind == TestKind::Relaxation || self.rows.len() < MIN_ROWS * found.n_parameters() {
            return None;
        }
        let mut squares = [ROUNDING * ROUNDING; 2];
        for (row, residual) in self.rows.iter().zip(self.residuals(&self.series(found))) {
            squares[row.part] += residual * residual;
        }
        let ratio = (squares[1] / squares[0]).sqrt();
        if ratio.max(ratio.recip()) < LEAST_CONTRAST {
            return None;
        }
        let rows = self.rows.iter().map(|row| {
            let factor = if row.part == 1 { ratio } else { 1.0 };
            Row { scale: factor * row.scale, ..*row }
        });
        Some(Self { kind: self.kind, loss_scale: ratio * self.loss_scale, rows: rows.collect() })
    }

    /// Returns the angular frequencies of the points, in a relaxation test the inverse times, 1/s.
    fn rates(&self) -> impl Iterator<Item = f64> {
        let rate = |row: &Row| match self.kind {
            TestKind::Oscillation => row.at,
            TestKind::Relaxation => row.at.recip(),
        };
        self.rows.iter().filter(|row| row.part == 0).map(rate)
    }

    /// Returns the standard uncertainties of the equilibrium modulus and of the sum of all moduli, Pa: the larger ones of those with
    /// all times free and of those with a term more on either side of the frequencies. Such a term has about the loss of one that is
    /// nearer, but not its modulus.
    fn uncertainties_of_ends(&self, best: &Candidate, own: Option<&DMatrix<f64>>) -> [f64; 2] {
        let n = best.times.len();
        let of_ends = |covariance: &DMatrix<f64>, n: usize| {
            let all = covariance.view((0, 0), (n + 1, n + 1)).sum();
            [covariance[(n, n)], all].map(|variance| variance.max(0.0).sqrt())
        };
        let own = own.map_or([f64::NAN; 2], |covariance| of_ends(covariance, n));
        let times: Vec<f64> = self.rates().map(f64::recip).collect();
        let mut wider = Candidate { per_term: 1, ..best.clone() };
        if self.kind == TestKind::Relaxation || wider.n_parameters() + 2 >= self.rows.len() {
            return own;
        }
        let first = times.iter().copied().fold(f64::INFINITY, f64::min) / BEYOND;
        let last = times.iter().copied().fold(0.0, f64::max) * BEYOND;
        for (at, time) in [(0, first), (n + 1, last)] {
            wider.times.insert(at, time);
            wider.moduli.insert(at, 0.0);
        }
        let Some(covariance) = self.covariance(&wider) else { return own };
        let wider = of_ends(&covariance, n + 2);
        [0, 1].map(|k: usize| own[k].max(wider[k]))
    }

    fn series(&self, best: &Candidate) -> FittedSeries {
        let n = best.times.len();
        // The data determine the times only so far as well, wherever the grid is.
        let with_times = Candidate { per_term: 2, ..best.clone() };
        let is_enough = with_times.n_parameters() < self.rows.len();
        let covariance = self.covariance(if is_enough { &with_times } else { best });
        let uncertainty = |k: usize| {
            covariance.as_ref().map_or(f64::NAN, |matrix| matrix[(k, k)].max(0.0).sqrt())
        };
        let [equilibrium_uncertainty, instantaneous_uncertainty] =
            self.uncertainties_of_ends(best, covariance.as_ref());
        let terms = (0..n).map(|k| FittedTerm {
            relaxation_time: best.times[k],
            modulus: best.moduli[k],
            uncertainty: uncertainty(k),
        });
        let loss_uncertainties = covariance.as_ref().map_or_else(Vec::new, |covariance| {
            self.rates().map(|rate| best.relative_uncertainty(covariance, rate, 1)).collect()
        });
        let fastest = covariance.as_ref().zip(self.rates().max_by(f64::total_cmp));
        let misfit = self.linear(&best.times).misfit(&best.moduli);
        FittedSeries {
            loss_uncertainties,
            fastest_uncertainty: fastest.map_or(f64::NAN, |(covariance, rate)| {
                best.relative_uncertainty(covariance, rate, 0)
            }),
            equilibrium_modulus: best.moduli[n],
            equilibrium_uncertainty,
            terms: terms.collect(),
            instantaneous_uncertainty,
            rms: (misfit / self.rows.len() as f64).sqrt(),
        }
    }
}
