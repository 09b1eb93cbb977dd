//! The Cholesky factor of a narrow stiffness, K = L Lᵀ, with a border.
//!
//! Nodes ring by ring leave a band: an equation knows of those within some distance alone, and so do the
//! columns of L. The border are the last equations, of the contact, which any equation may know of. All of it
//! is loops over columns in memory, without the search and the small matrices of fronts ([`crate::fronts`]),
//! which need fewer operations where the band is wide.
//!
//! Columns are eliminated some at a time ([`WIDTH`]); what they take from those after them is summed in the
//! order of the columns, whatever the processor's lanes: where it has multiply-and-add all lanes give the same
//! bits.

use faer::Mat;
use multiversion::multiversion;
use multiversion::target::target_cfg_f;

use crate::dense::cholesky;
use crate::elements::{ElementEquations, Lower};
use crate::error::CondensedError;
use crate::factor::Elimination;

/// Columns that are eliminated together.
const WIDTH: usize = 8;
/// Rows that a loop treats together; columns are filled up with zeros to a multiple of it, and as many numbers
/// before their diagonals may hold anything.
const LANES: usize = 8;

/// Some rows of the columns that are eliminated together.
type Rows = [[f64; LANES]; WIDTH];

/// The factor: the columns of the band, and below them the rows of the border.
#[derive(Debug)]
pub(crate) struct BandFactor {
    /// Equations in the band.
    n_band: usize,
    half_width: usize,
    /// Numbers from the diagonal of a column to that of the next.
    stride: usize,
    /// Column by column: [`LANES`] numbers, from the diagonal down, zeros behind the band.
    band: Vec<f64>,
    border: Border,
}

/// Rows below a band, column by column; those before the first column are zero.
#[derive(Debug)]
struct Border {
    first: usize,
    n_rows: usize,
    /// Numbers from a column to the next: rows and zeros behind them.
    stride: usize,
    columns: Vec<f64>,
    /// Of the border's own equations, before their elimination: columns of the same length.
    corner: Vec<f64>,
    /// Their factor.
    factor: Mat<f64>,
}

impl Border {
    /// The factor of the equations that are left.
    fn factored(&self) -> Result<Mat<f64>, CondensedError> {
        let left = Mat::from_fn(self.n_rows, self.n_rows, |i, j| {
            self.corner[i.min(j) * self.stride + i.max(j)]
        });
        cholesky(&left).ok_or(CondensedError::NotPositiveDefinite)
    }

    /// Overwrites a right-hand side with the solution of L y = b.
    fn substitute(&self, right: &mut [f64]) {
        for i in 0..self.n_rows {
            let known: f64 = (0..i).map(|j| self.factor[(i, j)] * right[j]).sum();
            right[i] = (right[i] - known) / self.factor[(i, i)];
        }
    }
}

/// The band of a matrix, and how far its border reaches.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Profile {
    pub n_band: usize,
    /// Equations below the diagonal that a column knows of at most.
    pub half_width: usize,
    /// First column that knows of the border.
    first: usize,
}

impl Profile {
    /// Of the elements' equations, the last `n_border` of which are the border.
    pub fn new(elements: &[ElementEquations], n: usize, n_border: usize) -> Self {
        let n_band = n - n_border;
        let mut profile = Self { n_band, half_width: 0, first: n_band };
        for element in elements {
            let solved = || element.solved(n).map(|equation| equation as usize);
            let Some(least) = solved().min() else { continue };
            if let Some(greatest) = solved().filter(|&equation| equation < n_band).max() {
                profile.half_width = profile.half_width.max(greatest - least);
                if solved().any(|equation| equation >= n_band) {
                    profile.first = profile.first.min(least);
                }
            }
        }
        // Columns that are eliminated together all have a border, or none.
        profile.first = profile.first / WIDTH * WIDTH;
        profile
    }
}

impl BandFactor {
    /// Eliminates elements whose matrices are made in their order; y of L y = b is found on the way for the
    /// right-hand side that is given.
    ///
    /// # Errors
    /// A matrix that is not positive definite; missing memory.
    pub fn eliminate(
        profile: Profile,
        elements: &[ElementEquations],
        mut matrix: impl FnMut(usize) -> Lower,
        mut right: Vec<f64>,
        n_trailing: usize,
    ) -> Result<Elimination<Self>, CondensedError> {
        let n = right.len();
        let mut factor = Self::zeros(profile, n - profile.n_band)?;
        for (number, element) in elements.iter().enumerate() {
            factor.add_element(element, &matrix(number), n);
        }
        // The last columns reach beyond the band.
        let border = right.split_off(profile.n_band);
        right.resize(profile.n_band + factor.stride, 0.0);
        let mut of_border = padded(border);
        if !eliminate_columns(&mut factor, &mut right, &mut of_border) {
            return Err(CondensedError::NotPositiveDefinite);
        }
        factor.border.factor = factor.border.factored()?;
        factor.border.substitute(&mut of_border);
        let n_border = factor.border.n_rows;
        right.truncate(profile.n_band);
        right.extend_from_slice(&of_border[..n_border]);
        let first = n_border - n_trailing;
        let corner = factor.border.factor.submatrix(first, first, n_trailing, n_trailing);
        let trailing = corner.to_owned();
        Ok(Elimination { factor: Some(factor), trailing, forward: right })
    }

    fn zeros(profile: Profile, n_rows: usize) -> Result<Self, CondensedError> {
        let Profile { n_band, half_width, first } = profile;
        let zeros = |n: usize| {
            let mut values = Vec::new();
            values.try_reserve_exact(n).map_err(|_| CondensedError::OutOfMemory)?;
            values.resize(n, 0.0);
            Ok::<_, CondensedError>(values)
        };
        let stride = LANES + WIDTH + half_width + LANES;
        let border_stride = n_rows.next_multiple_of(LANES);
        Ok(Self {
            n_band,
            half_width,
            stride,
            band: zeros((n_band + 1) * stride)?,
            border: Border {
                first,
                n_rows,
                stride: border_stride,
                columns: zeros((n_band - first) * border_stride)?,
                corner: zeros(n_rows * border_stride)?,
                factor: Mat::new(),
            },
        })
    }

    fn add_element(&mut self, element: &ElementEquations, matrix: &Lower, n: usize) {
        let mut entries = matrix.iter();
        for (k, &one) in element.equations.iter().enumerate() {
            for (&other, value) in element.equations[..=k].iter().zip(entries.by_ref()) {
                let (row, column) = (one.max(other) as usize, one.min(other) as usize);
                if row < self.n_band {
                    self.band[column * self.stride + LANES + row - column] += value;
                } else if row >= n {
                    // The ground's, or fixed.
                } else if column < self.n_band {
                    let start = (column - self.border.first) * self.border.stride;
                    self.border.columns[start + row - self.n_band] += value;
                } else {
                    let start = (column - self.n_band) * self.border.stride;
                    self.border.corner[start + row - self.n_band] += value;
                }
            }
        }
    }

    /// Overwrites right-hand sides, column by column, with the solutions of L y = b.
    pub fn solve_lower(&self, right: &mut [f64]) {
        let mut of_band = right[..self.n_band].to_vec();
        of_band.resize(self.n_band + self.stride, 0.0);
        let mut of_border = padded(right[self.n_band..].to_vec());
        substitute(self, &mut of_band, &mut of_border);
        self.border.substitute(&mut of_border);
        right[..self.n_band].copy_from_slice(&of_band[..self.n_band]);
        right[self.n_band..].copy_from_slice(&of_border[..self.border.n_rows]);
    }

    /// Overwrites a right-hand side with the solution of Lᵀ x = y.
    pub fn solve_transposed(&self, right: &mut [f64]) {
        let (corner, n_rows) = (&self.border.factor, self.border.n_rows);
        let mut of_border = padded(right[self.n_band..].to_vec());
        for i in (0..n_rows).rev() {
            let known: f64 = (i + 1..n_rows).map(|j| corner[(j, i)] * of_border[j]).sum();
            of_border[i] = (of_border[i] - known) / corner[(i, i)];
        }
        let mut of_band = right[..self.n_band].to_vec();
        of_band.resize(self.n_band + self.stride, 0.0);
        substitute_back(self, &mut of_band, &of_border);
        right[..self.n_band].copy_from_slice(&of_band[..self.n_band]);
        right[self.n_band..].copy_from_slice(&of_border[..n_rows]);
    }

    /// Bytes of the factor's values.
    pub fn bytes(&self) -> usize {
        8 * (self.band.len() + self.border.columns.len() + 2 * self.border.corner.len())
    }

    /// A column from its diagonal down, zeros behind it.
    fn column(&self, column: usize) -> &[f64] {
        &self.band[column * self.stride + LANES..][..self.stride - LANES]
    }

    /// Rows of the border in a column, zeros behind them; none before the first one.
    fn border_column(&self, column: usize) -> &[f64] {
        match column.checked_sub(self.border.first) {
            Some(k) => &self.border.columns[k * self.border.stride..][..self.border.stride],
            None => &[],
        }
    }

    /// Rows from one below the diagonal of a column that may not be zero, filled up.
    fn n_below(&self) -> usize {
        self.half_width.next_multiple_of(LANES)
    }
}

/// Filled up with zeros.
fn padded(mut values: Vec<f64>) -> Vec<f64> {
    values.resize(values.len().next_multiple_of(LANES), 0.0);
    values
}

/// Factors all columns in place and solves L y = b on the way, but for the border's own equations; false if the
/// band is not positive definite.
#[multiversion(targets("x86_64+avx512f+avx2+fma", "x86_64+avx2+fma"))]
fn eliminate_columns(factor: &mut BandFactor, right: &mut [f64], of_border: &mut [f64]) -> bool {
    if target_cfg_f!(any(target_feature = "fma", target_arch = "aarch64")) {
        factor.eliminate_on::<true>(right, of_border)
    } else {
        factor.eliminate_on::<false>(right, of_border)
    }
}

/// L y = b in the band, b of the border less what that takes.
#[multiversion(targets("x86_64+avx512f+avx2+fma", "x86_64+avx2+fma"))]
fn substitute(factor: &BandFactor, right: &mut [f64], of_border: &mut [f64]) {
    if target_cfg_f!(any(target_feature = "fma", target_arch = "aarch64")) {
        factor.substitute_on::<true>(right, of_border);
    } else {
        factor.substitute_on::<false>(right, of_border);
    }
}

/// Lᵀ x = y in the band, x of the border known.
#[multiversion(targets("x86_64+avx512f+avx2+fma", "x86_64+avx2+fma"))]
fn substitute_back(factor: &BandFactor, right: &mut [f64], of_border: &[f64]) {
    if target_cfg_f!(any(target_feature = "fma", target_arch = "aarch64")) {
        factor.substitute_back_on::<true>(right, of_border);
    } else {
        factor.substitute_back_on::<false>(right, of_border);
    }
}

impl BandFactor {
    #[inline(always)]
    fn eliminate_on<const FUSED: bool>(
        &mut self,
        right: &mut [f64],
        of_border: &mut [f64],
    ) -> bool {
        let Self { n_band, half_width, stride, .. } = *self;
        let Border { first, stride: border_stride, .. } = self.border;
        let n_own = (half_width + 1).next_multiple_of(LANES);
        let mut rows = vec![[[0.0; LANES]; WIDTH]; half_width.div_ceil(LANES)];
        let mut border_rows = vec![[[0.0; LANES]; WIDTH]; border_stride / LANES];
        for start in (0..n_band).step_by(WIDTH) {
            let width = WIDTH.min(n_band - start);
            let (panel, after) = self.band[start * stride..].split_at_mut(width * stride);
            // All columns that are eliminated together know of the border, or none.
            let border_stride = if start >= first { border_stride } else { 0 };
            let place = start.saturating_sub(first) * border_stride;
            let (of_panel, of_after) =
                self.border.columns[place..].split_at_mut(width * border_stride);
            for k in 0..width {
                let (before, own) = panel.split_at_mut(k * stride);
                let own = &mut own[LANES..stride];
                let (border_before, border) = of_panel.split_at_mut(k * border_stride);
                let border = &mut border[..border_stride];
                for (j, column) in before.chunks_exact(stride).enumerate() {
                    let column = &column[LANES + k - j..];
                    subtract::<FUSED>(&mut own[..n_own], column[0], column);
                    subtract::<FUSED>(border, column[0], &border_before[j * border_stride..]);
                }
                let squared = own[0];
                // What is no number is not positive.
                if !(squared > 0.0 && squared < f64::INFINITY) {
                    return false;
                }
                let diagonal = squared.sqrt();
                let scale = diagonal.recip();
                own.iter_mut().chain(&mut *border).for_each(|entry| *entry *= scale);
                own[0] = diagonal;
                let value = right[start + k] * scale;
                right[start + k] = value;
                subtract::<FUSED>(&mut right[start + k + 1..], value, &own[1..=n_own]);
                subtract::<FUSED>(of_border, value, border);
            }
            if width < WIDTH {
                border_rows.fill([[0.0; LANES]; WIDTH]);
            }
            for (k, column) in of_panel.chunks_exact(border_stride.max(1)).enumerate() {
                put(&mut border_rows, k, column);
            }
            if border_stride > 0 {
                let columns = self.border.corner.chunks_exact_mut(border_stride);
                for (i, column) in columns.enumerate() {
                    let factors = border_rows[i / LANES].map(|rows| rows[i % LANES]);
                    subtract_all::<FUSED>(column, &factors, &border_rows);
                }
            }
            if width < WIDTH {
                break;
            }
            for (k, column) in panel.chunks_exact(stride).enumerate() {
                put(&mut rows, k, &column[LANES + WIDTH - k..]);
            }
            let n_after = half_width.min(n_band - start - WIDTH);
            for (k, column) in after.chunks_exact_mut(stride).take(n_after).enumerate() {
                let (begin, lane) = (k / LANES, k % LANES);
                let factors = rows[begin].map(|rows| rows[lane]);
                subtract_all::<FUSED>(&mut column[LANES - lane..], &factors, &rows[begin..]);
                if border_stride > 0 {
                    let to = &mut of_after[k * border_stride..][..border_stride];
                    subtract_all::<FUSED>(to, &factors, &border_rows);
                }
            }
        }
        true
    }

    #[inline(always)]
    fn substitute_on<const FUSED: bool>(&self, right: &mut [f64], of_border: &mut [f64]) {
        let n_below = self.n_below();
        for k in 0..self.n_band {
            let column = self.column(k);
            let value = right[k] / column[0];
            right[k] = value;
            subtract::<FUSED>(&mut right[k + 1..], value, &column[1..=n_below]);
            subtract::<FUSED>(of_border, value, self.border_column(k));
        }
    }

    #[inline(always)]
    fn substitute_back_on<const FUSED: bool>(&self, right: &mut [f64], of_border: &[f64]) {
        let n_below = self.n_below();
        for k in (0..self.n_band).rev() {
            let column = self.column(k);
            let sums = dot::<FUSED>([0.0; LANES], &column[1..=n_below], &right[k + 1..]);
            let sums = dot::<FUSED>(sums, self.border_column(k), of_border);
            right[k] = (right[k] + sums.iter().sum::<f64>()) / column[0];
        }
    }
}

/// to ← to − factor · from, over the length of the shorter one, in whole lanes.
#[inline(always)]
fn subtract<const FUSED: bool>(to: &mut [f64], factor: f64, from: &[f64]) {
    let (to, from) = (to.as_chunks_mut::<LANES>().0, from.as_chunks::<LANES>().0);
    for (to, from) in to.iter_mut().zip(from) {
        for (to, from) in to.iter_mut().zip(from) {
            *to = less::<FUSED>(*to, factor, *from);
        }
    }
}

/// Puts a column among the rows of those that are eliminated together.
#[inline(always)]
fn put(rows: &mut [Rows], k: usize, column: &[f64]) {
    for (rows, column) in rows.iter_mut().zip(column.as_chunks::<LANES>().0) {
        rows[k] = *column;
    }
}

/// to ← to − Σ factor · from of all columns that are eliminated together, in their order, over the length of the
/// shorter one.
#[inline(always)]
fn subtract_all<const FUSED: bool>(to: &mut [f64], factors: &[f64; WIDTH], from: &[Rows]) {
    for (to, rows) in to.as_chunks_mut::<LANES>().0.iter_mut().zip(from) {
        let mut sum = *to;
        for (factor, column) in factors.iter().zip(rows) {
            for (sum, entry) in sum.iter_mut().zip(column) {
                *sum = less::<FUSED>(*sum, *factor, *entry);
            }
        }
        *to = sum;
    }
}

/// sums − Σ one · other, lane by lane, over the length of the shorter one.
#[inline(always)]
fn dot<const FUSED: bool>(mut sums: [f64; LANES], one: &[f64], other: &[f64]) -> [f64; LANES] {
    let (one, other) = (one.as_chunks::<LANES>().0, other.as_chunks::<LANES>().0);
    for (one, other) in one.iter().zip(other) {
        for (sum, (one, other)) in sums.iter_mut().zip(one.iter().zip(other)) {
            *sum = less::<FUSED>(*sum, *one, *other);
        }
    }
    sums
}

/// value − factor · other.
#[inline(always)]
fn less<const FUSED: bool>(value: f64, factor: f64, other: f64) -> f64 {
    if FUSED { (-factor).mul_add(other, value) } else { value - factor * other }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A symmetric matrix of bars, each of 4 equations that lie close to each other or in the border, held by
    /// a diagonal: its elements, the first free numbers being the ground's.
    fn bars(n: usize, n_border: usize, reach: usize) -> Vec<(ElementEquations, Lower)> {
        let mut seed = 12_345_u32;
        let mut random = |below: usize| {
            seed = seed.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
            (seed >> 8) as usize % below
        };
        let n_band = n - n_border;
        (0..n)
            .map(|first| {
                let mut equations: [u32; 8] = std::array::from_fn(|k| match k {
                    0 => first as u32,
                    1 if first + 1 == n_band => n as u32,
                    2 if first > n_band / 2 => (n_band + random(n_border)) as u32,
                    _ => (first.min(n_band.saturating_sub(1 + reach)) + random(reach + 1)) as u32,
                });
                // No element has an equation twice.
                for k in 1..8 {
                    if equations[..k].contains(&equations[k]) {
                        equations[k] = u32::MAX;
                    }
                }
                // vᵀv + 1 is positive definite.
                let shape: [f64; 8] = std::array::from_fn(|_| random(2000) as f64 / 1000.0 - 1.0);
                let mut entries = [0.0; 36];
                let places = (0..8).flat_map(|i| (0..=i).map(move |j| (i, j)));
                for (entry, (i, j)) in entries.iter_mut().zip(places) {
                    *entry = shape[i] * shape[j] + if i == j { 1.0 } else { 0.0 };
                }
                (ElementEquations { equations }, entries)
            })
            .collect()
    }

    /// K x of what the elements add up to.
    fn times(bars: &[(ElementEquations, Lower)], x: &[f64]) -> Vec<f64> {
        let mut product = vec![0.0; x.len()];
        for (element, matrix) in bars {
            let places = (0..8).flat_map(|i| (0..=i).map(move |j| (i, j)));
            for (value, (i, j)) in matrix.iter().zip(places) {
                let [row, column] = [i, j].map(|k: usize| element.equations[k] as usize);
                if row.max(column) < x.len() {
                    product[row] += value * x[column];
                    if i != j {
                        product[column] += value * x[row];
                    }
                }
            }
        }
        product
    }

    /// Bands of all widths and lengths, with panels that are not full: solutions put back, y of the elimination
    /// that of the substitution, and the trailing block that of the solutions.
    #[test]
    fn the_factor_solves_for_what_it_was_made_of() {
        for (n, n_border, reach) in [
            (2, 1, 0),
            (9, 1, 3),
            (16, 8, 7),
            (61, 5, 8),
            (200, 20, 37),
            (333, 9, 64),
            (40, 10, 29),
        ] {
            let bars = bars(n, n_border, reach);
            let elements: Vec<_> = bars.iter().map(|(element, _)| *element).collect();
            let x: Vec<f64> = (0..n).map(|i| ((i * i) % 17) as f64 - 8.0).collect();
            let right = times(&bars, &x);
            let profile = Profile::new(&elements, n, n_border);
            let matrix = |number: usize| bars[number].1;
            let made =
                BandFactor::eliminate(profile, &elements, matrix, right.clone(), n_border).unwrap();
            let factor = made.factor.unwrap();
            let mut solved = right.clone();
            factor.solve_lower(&mut solved);
            let close = |one: &[f64], other: &[f64]| {
                // Rounding times the condition of the matrix.
                let error = one.iter().zip(other).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
                assert!(error < 1e-10, "{n} {n_border} {reach}: {error:e}");
            };
            close(&solved, &made.forward);
            factor.solve_transposed(&mut solved);
            close(&solved, &x);
            // (L₂₂ L₂₂ᵀ)⁻¹ is the trailing block of the inverse.
            for k in 0..n_border {
                let mut unit = vec![0.0; n];
                unit[n - n_border + k] = 1.0;
                factor.solve_lower(&mut unit);
                factor.solve_transposed(&mut unit);
                let lower = &made.trailing;
                let upper = |i: usize| -> f64 {
                    (i..n_border).map(|j| lower[(j, i)] * unit[n - n_border + j]).sum()
                };
                let back: Vec<f64> = (0..n_border)
                    .map(|i| (0..=i).map(|j| lower[(i, j)] * upper(j)).sum())
                    .collect();
                let expected: Vec<f64> =
                    (0..n_border).map(|i| if i == k { 1.0 } else { 0.0 }).collect();
                close(&back, &expected);
            }
        }
    }

    #[test]
    fn what_is_not_positive_definite_is_refused() {
        let mut bars = bars(61, 5, 8);
        let elements: Vec<_> = bars.iter().map(|(element, _)| *element).collect();
        let profile = Profile::new(&elements, 61, 5);
        for value in [-1e3, f64::NAN] {
            for number in [0, 30, 60] {
                let before = bars[number].1[0];
                bars[number].1[0] = value;
                let matrix = |number: usize| bars[number].1;
                let made = BandFactor::eliminate(profile, &elements, matrix, vec![0.0; 61], 5);
                assert!(matches!(made, Err(CondensedError::NotPositiveDefinite)));
                bars[number].1[0] = before;
            }
        }
    }
}
