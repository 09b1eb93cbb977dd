//! The Cholesky factor of a body's stiffness, K = L Lᵀ, by the multifrontal method (Duff & Reid 1983).
//!
//! A front is a set of equations that are eliminated together, and the later equations that this couples. Each
//! element is added to the front that eliminates the first of its equations. The Schur complement of a front is
//! added to the front that eliminates the first of its later equations. So the whole matrix is not assembled, and
//! all operations are on dense matrices.

use std::ops::Range;

use dyn_stack::{MemBuffer, MemStack};
use faer::linalg::cholesky::llt::factor::{
    LltParams, LltRegularization, cholesky_in_place, cholesky_in_place_scratch,
};
use faer::linalg::matmul::matmul;
use faer::linalg::matmul::triangular::{self, BlockStructure};
use faer::linalg::triangular_solve::{
    solve_lower_triangular_in_place, solve_upper_triangular_in_place,
};
use faer::prelude::{Reborrow, ReborrowMut};
use faer::{Accum, ColMut, Mat, MatMut, MatRef, Par, Spec, dyn_stack};

use crate::condensation::numbering::{ElementEquations, Lower};
use crate::error::CondensedError;

/// Index of a front that does not exist.
const NONE: u32 = u32::MAX;

/// The factor of a matrix that is given in the order of elimination.
#[derive(Debug)]
pub(crate) struct Factor {
    fronts: Vec<Front>,
    /// Later equations of each front in rising order.
    later: Vec<u32>,
    values: Vec<f64>,
}

/// The results of an elimination.
#[derive(Debug)]
pub(crate) struct Elimination {
    /// Factor L, if it is kept.
    pub factor: Option<Factor>,
    /// Lower triangle of the factor's last columns.
    pub trailing: Mat<f64>,
    /// Solution y of L y = b for the given right-hand side.
    pub forward: Vec<f64>,
}

/// Columns of the factor that have the same later equations.
#[derive(Debug, Clone)]
struct Front {
    columns: Range<usize>,
    /// Range in the list of later equations.
    later: Range<usize>,
    /// Range of the values, column by column, the later equations below the front's own.
    values: Range<usize>,
}

/// Symbolic factorisation: the elements and the fronts that add to each front.
struct Symbolic {
    fronts: Vec<Front>,
    later: Vec<u32>,
    /// Elements in the order of the fronts, and the end of those of each front.
    elements: Vec<u32>,
    ends: Vec<usize>,
    /// Last child of each front, and the previous child of the same parent.
    last_child: Vec<u32>,
    before: Vec<u32>,
}

impl Elimination {
    /// Factors a stiffness whose element matrices are computed on request. `ends` has the end of each set
    /// of equations that are eliminated together; the last set includes the `n_trailing` last columns. Without
    /// `keeps_factor` only the columns of one front are in memory.
    ///
    /// # Errors
    /// A matrix that is not positive definite; missing memory.
    pub fn new(
        ends: &[usize],
        elements: &[ElementEquations],
        mut matrix: impl FnMut(usize) -> Lower,
        right: Vec<f64>,
        n_trailing: usize,
        keeps_factor: bool,
    ) -> Result<Self, CondensedError> {
        let symbolic = Symbolic::new(ends, elements);
        let sizes = symbolic.fronts.iter().map(|front| front.values.len());
        let n_values = if keeps_factor { sizes.sum() } else { sizes.max().unwrap_or(0) };
        let mut values = Vec::new();
        values.try_reserve_exact(n_values).map_err(|_| CondensedError::OutOfMemory)?;
        values.resize(n_values, 0.0);
        let widest = symbolic.fronts.iter().map(|front| front.columns.len()).max().unwrap_or(0);
        let params: Spec<LltParams, f64> = Spec::default();
        let request = cholesky_in_place_scratch::<f64>(widest, Par::Seq, params);
        let mut memory = MemBuffer::try_new(request).map_err(|_| CondensedError::OutOfMemory)?;
        let mut place = vec![0; right.len()];
        let mut left: Vec<Vec<f64>> = vec![Vec::new(); symbolic.fronts.len()];
        // Memory of finished fronts is used again, because new pages are expensive.
        let mut free: Vec<Vec<f64>> = Vec::new();
        let (mut forward, mut trailing, mut below) = (right, Mat::new(), Vec::new());
        let mut places = Vec::new();
        for (number, front) in symbolic.fronts.iter().enumerate() {
            let own = front.columns.len();
            let later = &symbolic.later[front.later.clone()];
            let n_rows = own + later.len();
            front.columns.clone().enumerate().for_each(|(k, equation)| place[equation] = k);
            later.iter().enumerate().for_each(|(k, &row)| place[row as usize] = own + k);
            let panel = match keeps_factor {
                true => &mut values[front.values.clone()],
                false => &mut values[..front.values.len()],
            };
            if !keeps_factor {
                panel.fill(0.0);
            }
            let rest = cleared(free.pop().unwrap_or_default(), later.len());
            let mut sum = Sum { own, n_rows, panel, rest };
            for &element in symbolic.elements_of(number) {
                sum.add_element(&elements[element as usize], &matrix(element as usize), &place);
            }
            let mut child = symbolic.last_child[number];
            while child != NONE {
                let rows = &symbolic.later[symbolic.fronts[child as usize].later.clone()];
                let of_child = std::mem::take(&mut left[child as usize]);
                sum.add_front(rows, &of_child, &place, &mut places);
                free.push(of_child);
                child = symbolic.before[child as usize];
            }
            sum.eliminate(MemStack::new(&mut memory), params)?;
            solve_front(sum.panel, front.columns.clone(), later, &mut forward, &mut below);
            if number + 1 == symbolic.fronts.len() {
                let first = own.saturating_sub(n_trailing);
                trailing = Mat::from_fn(own - first, own - first, |i, j| {
                    if i < j { 0.0 } else { sum.panel[(first + j) * n_rows + first + i] }
                });
            }
            left[number] = sum.rest;
        }
        let Symbolic { fronts, later, .. } = symbolic;
        let factor = keeps_factor.then_some(Factor { fronts, later, values });
        Ok(Self { factor, trailing, forward })
    }
}

/// Returns n columns whose lower triangle is zero, in the given memory if it is large enough.
fn cleared(mut values: Vec<f64>, n: usize) -> Vec<f64> {
    if values.len() < n * n {
        return vec![0.0; n * n];
    }
    for j in 0..n {
        values[j * n + j..(j + 1) * n].fill(0.0);
    }
    values
}

/// Solves L y = b for one right-hand side and the columns of a front, and updates b of its later equations. `below`
/// is work space.
fn solve_front(
    panel: &[f64],
    columns: Range<usize>,
    later: &[u32],
    right: &mut [f64],
    below: &mut Vec<f64>,
) {
    below.clear();
    below.extend(later.iter().map(|&row| right[row as usize]));
    let own = &mut right[columns];
    let n_rows = own.len() + later.len();
    for (k, column) in panel.chunks_exact(n_rows.max(1)).enumerate() {
        let (of_own, of_later) = column.split_at(own.len());
        let value = own[k] / of_own[k];
        own[k] = value;
        own[k + 1..].iter_mut().zip(&of_own[k + 1..]).for_each(|(to, entry)| *to -= entry * value);
        below.iter_mut().zip(of_later).for_each(|(to, entry)| *to -= entry * value);
    }
    later.iter().zip(below).for_each(|(&row, value)| right[row as usize] = *value);
}

/// Solves Lᵀ x = y for one right-hand side and the columns of a front, with x of its later equations known.
fn solve_front_transposed(
    panel: &[f64],
    columns: Range<usize>,
    later: &[u32],
    right: &mut [f64],
    below: &mut Vec<f64>,
) {
    below.clear();
    below.extend(later.iter().map(|&row| right[row as usize]));
    let own = &mut right[columns];
    let n_rows = own.len() + later.len();
    let dot = |some: &[f64], others: &[f64]| -> f64 {
        some.iter().zip(others).map(|(x, entry)| x * entry).sum()
    };
    for (k, column) in panel.chunks_exact(n_rows.max(1)).enumerate().rev() {
        let (of_own, of_later) = column.split_at(own.len());
        let known = dot(&own[k + 1..], &of_own[k + 1..]) + dot(below, of_later);
        own[k] = (own[k] - known) / of_own[k];
    }
}

impl Factor {
    /// Overwrites the right-hand sides with the solutions of K x = b.
    pub fn solve(&self, mut right: MatMut<'_, f64>) {
        self.solve_lower(right.rb_mut());
        self.solve_transposed(right);
    }

    /// Overwrites the right-hand sides with the solutions of L y = b.
    pub fn solve_lower(&self, mut right: MatMut<'_, f64>) {
        if let Some(right) = single(right.rb_mut()) {
            let mut below = Vec::new();
            for front in &self.fronts {
                let (panel, columns, later) = self.columns(front);
                solve_front(panel, columns, later, right, &mut below);
            }
            return;
        }
        let mut below = self.workspace(right.ncols());
        for front in &self.fronts {
            let (top, bottom) = self.panel(front).split_at_row(front.columns.len());
            let mut own = right.rb_mut().subrows_mut(front.columns.start, front.columns.len());
            solve_lower_triangular_in_place(top, own.rb_mut(), Par::Seq);
            let later = &self.later[front.later.clone()];
            let mut below = below.as_mut().subrows_mut(0, later.len());
            matmul(below.rb_mut(), Accum::Replace, bottom, own.rb(), 1.0, Par::Seq);
            for (from, mut to) in below.rb().col_iter().zip(right.rb_mut().col_iter_mut()) {
                for (value, &row) in from.iter().zip(later) {
                    to[row as usize] -= value;
                }
            }
        }
    }

    /// Overwrites the right-hand sides with the solutions of Lᵀ x = y.
    pub fn solve_transposed(&self, mut right: MatMut<'_, f64>) {
        if let Some(right) = single(right.rb_mut()) {
            let mut below = Vec::new();
            for front in self.fronts.iter().rev() {
                let (panel, columns, later) = self.columns(front);
                solve_front_transposed(panel, columns, later, right, &mut below);
            }
            return;
        }
        let mut below = self.workspace(right.ncols());
        for front in self.fronts.iter().rev() {
            let (top, bottom) = self.panel(front).split_at_row(front.columns.len());
            let later = &self.later[front.later.clone()];
            let mut below = below.as_mut().subrows_mut(0, later.len());
            for (from, to) in right.rb().col_iter().zip(below.rb_mut().col_iter_mut()) {
                for (value, &row) in to.iter_mut().zip(later) {
                    *value = from[row as usize];
                }
            }
            let mut own = right.rb_mut().subrows_mut(front.columns.start, front.columns.len());
            matmul(own.rb_mut(), Accum::Add, bottom.transpose(), below.rb(), -1.0, Par::Seq);
            solve_upper_triangular_in_place(top.transpose(), own, Par::Seq);
        }
    }

    /// Returns work space for the later equations of the largest front.
    fn workspace(&self, n_columns: usize) -> Mat<f64> {
        let longest = self.fronts.iter().map(|front| front.later.len()).max();
        Mat::zeros(longest.unwrap_or(0), n_columns)
    }

    /// Returns the values, the own equations and the later equations of a front.
    fn columns(&self, front: &Front) -> (&[f64], Range<usize>, &[u32]) {
        let later = &self.later[front.later.clone()];
        (&self.values[front.values.clone()], front.columns.clone(), later)
    }

    fn panel(&self, front: &Front) -> MatRef<'_, f64> {
        let (values, columns, later) = self.columns(front);
        MatRef::from_column_major_slice(values, columns.len() + later.len(), columns.len())
    }

    /// Returns the size of the factor's values and indices in bytes.
    pub fn bytes(&self) -> usize {
        8 * self.values.len() + 4 * self.later.len()
    }
}

/// Returns the only column of a matrix; `None` if there are more.
fn single(right: MatMut<'_, f64>) -> Option<&mut [f64]> {
    let is_single = right.ncols() == 1;
    is_single.then(|| right.col_mut(0).try_as_col_major_mut())?.map(ColMut::as_slice_mut)
}

impl Symbolic {
    fn new(ends: &[usize], elements: &[ElementEquations]) -> Self {
        let n_fronts = ends.len();
        let n = ends.last().copied().unwrap_or(0);
        let mut front_of = vec![0_u32; n];
        let starts = [0].iter().chain(ends);
        for (front, (&start, &end)) in starts.zip(ends).enumerate() {
            front_of[start..end].fill(front as u32);
        }
        let (elements_of, element_ends) = by_front(elements, &front_of, n_fronts);
        let mut symbolic = Self {
            fronts: Vec::with_capacity(n_fronts),
            later: Vec::new(),
            elements: elements_of,
            ends: element_ends,
            last_child: vec![NONE; n_fronts],
            before: vec![NONE; n_fronts],
        };
        let (mut start, mut n_values) = (0, 0);
        let mut seen_by = vec![NONE; n];
        let mut rows = Vec::new();
        for (number, &end) in ends.iter().enumerate() {
            rows.clear();
            let mut see = |equation: u32| {
                let seen = &mut seen_by[equation as usize];
                if equation as usize >= end && *seen != number as u32 {
                    *seen = number as u32;
                    rows.push(equation);
                }
            };
            for &element in symbolic.elements_of(number) {
                elements[element as usize].solved(n).for_each(&mut see);
            }
            let mut child = symbolic.last_child[number];
            while child != NONE {
                let later = symbolic.fronts[child as usize].later.clone();
                symbolic.later[later].iter().copied().for_each(&mut see);
                child = symbolic.before[child as usize];
            }
            rows.sort_unstable();
            if let Some(&first) = rows.first() {
                let parent = front_of[first as usize] as usize;
                symbolic.before[number] = symbolic.last_child[parent];
                symbolic.last_child[parent] = number as u32;
            }
            let first_later = symbolic.later.len();
            symbolic.later.extend_from_slice(&rows);
            let more = (end - start) * (end - start + rows.len());
            symbolic.fronts.push(Front {
                columns: start..end,
                later: first_later..symbolic.later.len(),
                values: n_values..n_values + more,
            });
            (start, n_values) = (end, n_values + more);
        }
        symbolic
    }

    fn elements_of(&self, front: usize) -> &[u32] {
        let start = front.checked_sub(1).map_or(0, |before| self.ends[before]);
        &self.elements[start..self.ends[front]]
    }
}

/// Returns the elements in the order of the fronts that eliminate the first of their equations, and the end of those
/// of each front. Elements without equations belong to none.
fn by_front(
    elements: &[ElementEquations],
    front_of: &[u32],
    n_fronts: usize,
) -> (Vec<u32>, Vec<usize>) {
    let first = |element: &ElementEquations| {
        element.solved(front_of.len()).min().map(|first| front_of[first as usize] as usize)
    };
    let mut ends = vec![0; n_fronts];
    elements.iter().filter_map(first).for_each(|front| ends[front] += 1);
    let mut end = 0;
    for count in &mut ends {
        (end, *count) = (end + *count, end);
    }
    let mut all = vec![0; end];
    for (number, element) in elements.iter().enumerate() {
        if let Some(front) = first(element) {
            all[ends[front]] = number as u32;
            ends[front] += 1;
        }
    }
    (all, ends)
}

/// A front before its elimination: lower triangles, column by column.
struct Sum<'a> {
    own: usize,
    n_rows: usize,
    /// Columns of the front's own equations.
    panel: &'a mut [f64],
    /// Matrix of the later equations.
    rest: Vec<f64>,
}

impl Sum<'_> {
    /// Adds to an entry given by two indices in the front.
    fn add(&mut self, one: usize, other: usize, value: f64) {
        let (row, column) = (one.max(other), one.min(other));
        match column.checked_sub(self.own) {
            None => self.panel[column * self.n_rows + row] += value,
            Some(column) => {
                let n_later = self.n_rows - self.own;
                self.rest[column * n_later + row - self.own] += value;
            }
        }
    }

    fn add_element(&mut self, element: &ElementEquations, matrix: &Lower, place: &[usize]) {
        let places = element.equations.map(|equation| place.get(equation as usize).copied());
        let mut entries = matrix.iter();
        for (i, one) in places.iter().enumerate() {
            for (other, value) in places[..=i].iter().zip(entries.by_ref()) {
                if let (Some(one), Some(other)) = (*one, *other) {
                    self.add(one, other, *value);
                }
            }
        }
    }

    /// Adds the Schur complement of a child. `places` is work space.
    fn add_front(&mut self, rows: &[u32], left: &[f64], place: &[usize], places: &mut Vec<usize>) {
        places.clear();
        places.extend(rows.iter().map(|&row| place[row as usize]));
        let n = rows.len();
        for (j, &column) in places.iter().enumerate() {
            let (to, first) = match column.checked_sub(self.own) {
                None => (&mut self.panel[column * self.n_rows..][..self.n_rows], 0),
                Some(column) => {
                    let n_later = self.n_rows - self.own;
                    (&mut self.rest[column * n_later..][..n_later], self.own)
                }
            };
            for (value, &row) in left[j * n + j..(j + 1) * n].iter().zip(&places[j..]) {
                to[row - first] += value;
            }
        }
    }

    /// Factors the own columns and subtracts their product from the matrix of the later equations.
    fn eliminate(
        &mut self,
        memory: &mut MemStack,
        params: Spec<LltParams, f64>,
    ) -> Result<(), CondensedError> {
        let &mut Self { own, n_rows, .. } = self;
        let panel = MatMut::from_column_major_slice_mut(self.panel, n_rows, own);
        let (mut top, mut bottom) = panel.split_at_row_mut(own);
        let regularization = LltRegularization::default();
        cholesky_in_place(top.rb_mut(), regularization, Par::Seq, memory, params)
            .map_err(|_| CondensedError::NotPositiveDefinite)?;
        let n_later = n_rows - own;
        if n_later > 0 {
            solve_lower_triangular_in_place(top.rb(), bottom.rb_mut().transpose_mut(), Par::Seq);
            triangular::matmul(
                MatMut::from_column_major_slice_mut(
                    &mut self.rest[..n_later * n_later],
                    n_later,
                    n_later,
                ),
                BlockStructure::TriangularLower,
                Accum::Add,
                bottom.rb(),
                BlockStructure::Rectangular,
                bottom.rb().transpose(),
                BlockStructure::Rectangular,
                -1.0,
                Par::Seq,
            );
        }
        Ok(())
    }
}
