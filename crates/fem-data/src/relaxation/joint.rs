//! Shifts of all blocks by one least squares: a single series meets the moduli of all temperatures.
//!
//! The unknowns are ln a_T of every block but the reference, ln b_T if it is asked for, and the moduli of a series with terms at given
//! times. The moduli are found by non-negative least squares for given shifts, and the shifts by steps of Gauss and Newton with the
//! derivatives of the residuals less what the moduli can follow (variable projection: Golub & Pereyra, *SIAM J. Numer. Anal.* 10 (1973)
//! 413; Kaufman, *BIT* 15 (1975) 49), damped as in [`SumOfSquares`]. The steps of a round end when the misfit falls by less than a
//! hundredth of its value per degree of freedom.
//!
//! Storage and loss modulus differ in their accuracy, and those of a point may be correlated, as by the force that both are measured with.
//! The covariance of both residuals of a point is found from the residuals themselves (seemingly unrelated regressions: Zellner, *J. Am.
//! Stat. Assoc.* 57 (1962) 348), so that a loss modulus with resonances of the instrument counts little.
//!
//! In the first round losses count over |E*|: a resonance of the instrument lies at one frequency of all temperatures, and relative to a
//! small loss it would hold the blocks at their frequencies.
//!
//! Limits: residuals of different points are taken as independent.

use nalgebra::{Cholesky, DMatrix, DVector, Matrix2};

use crate::estimate::spectrum::bounded::{Linear, non_negative};
use crate::estimate::{Accuracy, SumOfSquares};
use crate::table::{ModulusPoint, TestKind};

use super::series::{Observations, ROUNDING, compressed_by_products, grid, joined};
use super::superposition::{Block, REACH, reduced};

/// Terms per decade of the series of all blocks.
const DENSITY: f64 = 2.0;
/// Rounds after which the times of the series and the covariance of the residuals follow the shifts.
const N_ROUNDS: usize = 5;
/// Accuracy of a shift, ln; and the gain of the last step, in squares of the scatter of a modulus: parameters of smaller ones move by a
/// tenth of their uncertainty.
const ACCURACY: Accuracy =
    Accuracy { of_parameters: 1e-5, of_sum: 0.01, n_steps: 30, longest_step: 1.0 };

/// Returns the terms whose times, within a reach of ln τ about those given, and moduli meet the points best. Residuals of losses count
/// over `loss_scale`.
pub(super) fn vary_times(
    kind: TestKind,
    points: &[ModulusPoint],
    loss_scale: f64,
    times: &[f64],
    reach: f64,
) -> impl Iterator<Item = (f64, f64)> {
    let points = points.to_vec();
    let shift_of = vec![None; points.len()];
    let joint = Joint {
        kind,
        points,
        shift_of,
        moving: vec![],
        reference: 0,
        blocks: &mut [],
        has_vertical: false,
    };
    let whitening = Matrix2::from_diagonal(&nalgebra::Vector2::new(1.0, loss_scale.recip()));
    let problem = Problem { joint: &joint, times, reach, whitening, is_first: false };
    let (found, solved) = problem.best(&times.iter().map(|time| time.ln()).collect::<Vec<_>>());
    let moduli = solved.moduli.iter().copied().collect::<Vec<f64>>();
    found.into_iter().map(f64::exp).zip(moduli)
}

/// All moduli with the blocks that they are of.
pub(super) struct Joint<'a> {
    kind: TestKind,
    points: Vec<ModulusPoint>,
    /// The parameter of the shift of each point; none of the reference.
    shift_of: Vec<Option<usize>>,
    /// The blocks that are shifted, by rising temperature.
    pub(super) moving: Vec<usize>,
    pub(super) reference: usize,
    blocks: &'a mut [Block],
    has_vertical: bool,
}

/// The linear problem of the moduli at given shifts with its solution, whitened.
struct Solved {
    observations: Observations,
    linear: Linear,
    moduli: DVector<f64>,
    residuals: DVector<f64>,
}

impl Solved {
    fn misfit(&self) -> f64 {
        self.residuals.norm_squared()
    }

    /// Returns the columns of the terms that have a modulus.
    fn passive(&self) -> DMatrix<f64> {
        let kept = (0..self.moduli.len()).filter(|k| self.moduli[*k] > 0.0);
        self.linear.a.select_columns(&kept.collect::<Vec<_>>())
    }
}

impl<'a> Joint<'a> {
    pub fn new(
        kind: TestKind,
        points: &[ModulusPoint],
        blocks: &'a mut [Block],
        reference: usize,
        has_vertical: bool,
    ) -> Self {
        let moving: Vec<usize> = (0..blocks.len()).filter(|block| *block != reference).collect();
        let of_block = |block: &usize| moving.iter().position(|it| it == block);
        let all = (0..blocks.len()).flat_map(|block| {
            blocks[block].points.iter().map(move |k| (points[*k], block)).collect::<Vec<_>>()
        });
        let (points, shift_of) = all.map(|(point, block)| (point, of_block(&block))).unzip();
        Self { kind, points, shift_of, moving, reference, blocks, has_vertical }
    }

    /// Refines the shifts of the blocks, and returns the covariance of ln a_T of all but the reference and which of these shifts the
    /// moduli determine.
    pub fn refine(&mut self) -> (DMatrix<f64>, Vec<bool>) {
        let n = self.moving.len();
        let n_shifts = n * (1 + usize::from(self.has_vertical));
        let at = |k: usize| {
            let block = &self.blocks[self.moving[k % n]];
            if k < n { block.ln_shift } else { block.ln_vertical }
        };
        let mut shifts: Vec<f64> = (0..n_shifts).map(at).collect();
        let mut whitening = Matrix2::identity();
        let mut covariance = DMatrix::zeros(n, n);
        let mut times = grid(self.kind, &self.reduced(&shifts), DENSITY, 0.0);
        for round in 0..N_ROUNDS {
            let n_parameters = n_shifts + 2 * times.len() + 1;
            let is_varied = round > 0 && n_parameters < self.n_parts() * self.points.len();
            let start: Vec<f64> = match is_varied {
                false => shifts.clone(),
                true => shifts.iter().copied().chain(times.iter().map(|time| time.ln())).collect(),
            };
            let is_first = round == 0;
            let reach = f64::INFINITY;
            let problem = Problem { joint: self, times: &times, reach, whitening, is_first };
            let (found, solved) = problem.best(&start);
            covariance = problem.covariance(&found, &solved).view((0, 0), (n, n)).into_owned();
            whitening = match is_first {
                true => {
                    let relative = problem.relative_residuals(&found, &solved);
                    self.whitening(&relative, &whitening)
                }
                false => self.whitening(&solved.residuals, &whitening),
            };
            let all = problem.times(&found);
            times = joined(all.iter().copied().zip(solved.moduli.iter().copied()));
            shifts.copy_from_slice(&found[..n_shifts]);
        }
        let determined = self.determined(&shifts, &whitening);
        for (k, block) in self.moving.iter().enumerate() {
            let block = &mut self.blocks[*block];
            block.ln_shift = shifts[k];
            block.ln_vertical = shifts.get(n + k).copied().unwrap_or(0.0);
        }
        (covariance, determined)
    }

    /// Returns the least misfit of a series on a grid with these shifts, and its degrees of freedom.
    pub(super) fn misfit_on_grid(
        &self,
        shifts: &[f64],
        whitening: &Matrix2<f64>,
        density: f64,
    ) -> (f64, f64) {
        let times = grid(self.kind, &self.reduced(shifts), density, 0.0);
        let (whitening, reach) = (*whitening, f64::INFINITY);
        let problem = Problem { joint: self, times: &times, reach, whitening, is_first: false };
        let solved = problem.solve(shifts);
        let n_parameters = solved.passive().ncols() + shifts.len();
        (solved.misfit(), solved.residuals.len().saturating_sub(n_parameters).max(1) as f64)
    }

    /// Returns the points at the reference temperature.
    fn reduced(&self, shifts: &[f64]) -> Vec<ModulusPoint> {
        let n = self.moving.len();
        let of = |(point, shift): (&ModulusPoint, &Option<usize>)| match shift {
            Some(k) => {
                let ln_vertical = if self.has_vertical { shifts[n + k] } else { 0.0 };
                reduced(self.kind, point, shifts[*k], ln_vertical)
            }
            None => *point,
        };
        self.points.iter().zip(&self.shift_of).map(of).collect()
    }

    fn n_parts(&self) -> usize {
        if self.kind == TestKind::Oscillation { 2 } else { 1 }
    }

    /// Multiplies the rows of each point with the factor of the inverse covariance of its residuals.
    fn whiten(&self, rows: &mut DMatrix<f64>, whitening: &Matrix2<f64>) {
        for mut column in rows.column_iter_mut() {
            if self.n_parts() == 2 {
                for k in 0..column.len() / 2 {
                    let (storage, loss) = (column[2 * k], column[2 * k + 1]);
                    column[2 * k] = whitening[(0, 0)] * storage;
                    column[2 * k + 1] = whitening[(1, 0)] * storage + whitening[(1, 1)] * loss;
                }
            }
        }
    }

    /// Returns the factor of the inverse covariance of the residuals of a point, relative to the largest.
    fn whitening(&self, residuals: &DVector<f64>, before: &Matrix2<f64>) -> Matrix2<f64> {
        let Some(back) = before.try_inverse() else { return *before };
        if self.n_parts() == 1 {
            return *before;
        }
        let mut sum = Matrix2::zeros();
        for pair in residuals.as_slice().chunks_exact(2) {
            let plain = back * nalgebra::Vector2::new(pair[0], pair[1]);
            sum += plain * plain.transpose();
        }
        let covariance = sum / self.points.len() as f64;
        let covariance =
            covariance + Matrix2::identity() * (1e-6 * covariance.trace() + ROUNDING * ROUNDING);
        let factor = Cholesky::new(covariance).and_then(|factor| factor.l().try_inverse());
        factor.unwrap_or(*before)
    }
}

/// The least squares of one round. Its parameters are the shifts, and ln of the relaxation times from the second round on.
struct Problem<'a> {
    joint: &'a Joint<'a>,
    times: &'a [f64],
    /// Largest change of ln of a relaxation time from that in `times`.
    reach: f64,
    whitening: Matrix2<f64>,
    /// Whether losses count over |E*|.
    is_first: bool,
}

impl SumOfSquares for Problem<'_> {
    type At = Solved;

    fn at(&self, parameters: &[f64]) -> Option<Solved> {
        Some(self.solve(parameters))
    }

    fn residuals<'p>(&self, at: &'p Solved) -> &'p DVector<f64> {
        &at.residuals
    }

    fn slopes(&self, parameters: &[f64], at: &Solved) -> Option<DMatrix<f64>> {
        Some(self.derivatives(parameters, at))
    }
}

impl Problem<'_> {
    fn n_shifts(&self) -> usize {
        self.joint.moving.len() * (1 + usize::from(self.joint.has_vertical))
    }

    /// Returns the relaxation times by the parameters, s.
    fn times(&self, parameters: &[f64]) -> Vec<f64> {
        let varied: Vec<f64> = parameters[self.n_shifts()..].iter().map(|ln| ln.exp()).collect();
        if varied.is_empty() { self.times.to_vec() } else { varied }
    }

    /// Returns the parameters with the least misfit, relaxation times within their reach.
    fn best(&self, start: &[f64]) -> (Vec<f64>, Solved) {
        let n_varied = start.len() - self.n_shifts();
        let reach = |time: &f64| (time.ln() - self.reach, time.ln() + self.reach);
        let of_times = self.times[..n_varied].iter().map(reach);
        let free = std::iter::repeat_n((f64::NEG_INFINITY, f64::INFINITY), self.n_shifts());
        let bounds: Vec<(f64, f64)> = free.chain(of_times).collect();
        let found = self.minimise(start, &bounds, ACCURACY);
        found.unwrap_or_else(|| (start.to_vec(), self.solve(start)))
    }

    /// Returns the covariance of the parameters.
    fn covariance(&self, found: &[f64], solved: &Solved) -> DMatrix<f64> {
        let n = found.len();
        let slopes = self.derivatives(found, solved);
        let freedom = solved.residuals.len().saturating_sub(solved.passive().ncols() + n).max(1);
        let variance = solved.misfit() / freedom as f64 + ROUNDING * ROUNDING;
        // Prior knowledge of a decade and a half keeps shifts finite that the data do not determine.
        let prior = DMatrix::identity(n, n) / REACH.powi(2);
        let information = slopes.transpose() * &slopes / variance + prior;
        Cholesky::new(information)
            .map_or_else(|| DMatrix::identity(n, n) * REACH.powi(2), |factor| factor.inverse())
    }

    fn solve(&self, parameters: &[f64]) -> Solved {
        let times = self.times(parameters);
        let points = self.joint.reduced(parameters);
        let observations = match self.is_first {
            true => Observations::over_magnitude(self.joint.kind, &points),
            false => Observations::of(self.joint.kind, &points),
        };
        let plain = observations.linear_of_all(&times);
        let n = plain.a.ncols();
        let mut rows = plain.a.insert_column(n, 0.0);
        rows.set_column(n, &plain.b);
        self.joint.whiten(&mut rows, &self.whitening);
        let linear = Linear { b: rows.column(n).into_owned(), a: rows.remove_column(n) };
        let small = compressed_by_products(&linear);
        let moduli = non_negative(&small.a, &small.b);
        let residuals = &linear.a * &moduli - &linear.b;
        Solved { observations, linear, moduli, residuals }
    }

    /// Returns the residuals of the moduli that were found over the measured ones.
    fn relative_residuals(&self, parameters: &[f64], solved: &Solved) -> DVector<f64> {
        let points = self.joint.reduced(parameters);
        let Linear { a, b } =
            Observations::of(self.joint.kind, &points).linear_of_all(&self.times(parameters));
        a * &solved.moduli - b
    }

    /// Returns the derivatives of the residuals by the parameters less what the moduli follow.
    fn derivatives(&self, parameters: &[f64], solved: &Solved) -> DMatrix<f64> {
        let (joint, times) = (self.joint, self.times(parameters));
        let n = joint.moving.len();
        let mut of_times = solved.observations.slopes(&times);
        for (mut column, modulus) in of_times.column_iter_mut().zip(&solved.moduli) {
            column *= *modulus;
        }
        let of_shift = of_times.column_sum();
        let mut slopes = DMatrix::zeros(solved.residuals.len(), parameters.len());
        for i in 0..slopes.nrows() {
            if let Some(k) = joint.shift_of[i / joint.n_parts()] {
                slopes[(i, k)] = of_shift[i];
                if joint.has_vertical {
                    slopes[(i, n + k)] = solved.observations.relative(i);
                }
            }
        }
        let n_varied = parameters.len() - self.n_shifts();
        slopes.columns_mut(self.n_shifts(), n_varied).copy_from(&of_times.columns(0, n_varied));
        joint.whiten(&mut slopes, &self.whitening);
        let passive = solved.passive();
        let transposed = passive.transpose();
        let followed = match Cholesky::new(&transposed * &passive) {
            Some(factor) => passive * factor.solve(&(transposed * &slopes)),
            None => {
                let q = passive.qr().q();
                &q * (q.transpose() * &slopes)
            }
        };
        slopes - followed
    }
}
