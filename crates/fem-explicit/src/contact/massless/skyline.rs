//! Symmetric positive matrices whose rows begin near the diagonal.

/// The lower half of a symmetric matrix: each row from its first entry to the diagonal.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Skyline {
    rows: Vec<Row>,
    values: Vec<f64>,
}

/// The beginning of a row.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Row {
    first_column: usize,
    /// Place of the first entry among the values.
    place: usize,
}

impl Row {
    /// Returns the places of the entries of row i left of the diagonal.
    fn before(self, i: usize) -> std::ops::Range<usize> {
        self.place..self.place + i - self.first_column
    }
}

impl Skyline {
    /// Makes a matrix of zeros whose rows begin at given columns.
    pub fn new(first_columns: impl IntoIterator<Item = usize>) -> Self {
        let mut place = 0;
        let rows = first_columns.into_iter().enumerate().map(|(i, first_column)| {
            let row = Row { first_column, place };
            place += i + 1 - first_column;
            row
        });
        let rows: Vec<_> = rows.collect();
        Self { rows, values: vec![0.0; place] }
    }

    /// Returns the number of rows.
    pub fn n_rows(&self) -> usize {
        self.rows.len()
    }

    /// Returns the stored entry (i, j), j ≤ i.
    pub fn entry(&mut self, i: usize, j: usize) -> &mut f64 {
        let Row { first_column, place } = self.rows[i];
        &mut self.values[place + j - first_column]
    }

    /// Copies the rows of another matrix from a row on.
    pub fn copy_rows(&mut self, from: usize, other: &Self) {
        let place = self.rows.get(from).map_or(self.values.len(), |row| row.place);
        self.values[place..].copy_from_slice(&other.values[place..]);
    }

    /// Overwrites the rows from a row on with those of Cholesky's factor, with its diagonal inverted; earlier rows have
    /// been factored before. The entries do not depend on where the factorisation begins.
    ///
    /// Returns `None` if the matrix is not positive.
    pub fn factor(&mut self, from: usize) -> Option<()> {
        for i in from..self.rows.len() {
            let row = self.rows[i];
            let (above, own) = self.values.split_at_mut(row.place);
            for j in row.first_column..i {
                let other = self.rows[j];
                let first = row.first_column.max(other.first_column);
                let left = &above[other.place + first - other.first_column
                    ..other.place + j - other.first_column];
                let right = &own[first - row.first_column..j - row.first_column];
                let sum: f64 = left.iter().zip(right).map(|(a, b)| a * b).sum();
                let inverse = above[other.place + j - other.first_column];
                let entry = &mut own[j - row.first_column];
                *entry = (*entry - sum) * inverse;
            }
            let n = i - row.first_column;
            let square: f64 = own[..n].iter().map(|a| a * a).sum();
            let pivot = own[n] - square;
            if !(pivot > 0.0 && pivot.is_finite()) {
                return None;
            }
            own[n] = pivot.sqrt().recip();
        }
        Some(())
    }

    /// Overwrites b with the solution of A x = b, this the factor of A.
    pub fn solve(&self, b: &mut [f64]) {
        for (i, row) in self.rows.iter().enumerate() {
            let left = &self.values[row.before(i)];
            let (before, own) = b.split_at_mut(i);
            let mut value = own[0];
            for (a, x) in left.iter().zip(&before[row.first_column..]) {
                value -= a * x;
            }
            own[0] = value * self.values[row.before(i).end];
        }
        for (i, row) in self.rows.iter().enumerate().rev() {
            let left = &self.values[row.before(i)];
            let (before, own) = b.split_at_mut(i);
            let value = own[0] * self.values[row.before(i).end];
            own[0] = value;
            for (a, x) in left.iter().zip(&mut before[row.first_column..]) {
                *x -= a * value;
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::test_support::noise;

    const FIRST: [usize; 7] = [0, 0, 1, 0, 3, 3, 2];

    fn matrix() -> Skyline {
        let mut matrix = Skyline::new(FIRST);
        for (i, &first) in FIRST.iter().enumerate() {
            (first..i).for_each(|j| *matrix.entry(i, j) = noise(7 * i + j));
            *matrix.entry(i, i) = 3.0;
        }
        matrix
    }

    fn product(matrix: &mut Skyline, x: &[f64]) -> Vec<f64> {
        let mut product = vec![0.0; x.len()];
        for (i, &first) in FIRST.iter().enumerate() {
            for j in first..=i {
                product[i] += *matrix.entry(i, j) * x[j];
                if j < i {
                    product[j] += *matrix.entry(i, j) * x[i];
                }
            }
        }
        product
    }

    #[test]
    fn skyline_factor_solves_the_system() {
        let x: Vec<_> = (0..7).map(|k| noise(k + 50)).collect();
        let mut b = product(&mut matrix(), &x);
        let mut factor = matrix();
        factor.factor(0).unwrap();
        factor.solve(&mut b);
        // Rounding of a matrix of condition 10.
        assert!(x.iter().zip(&b).all(|(x, b)| (x - b).abs() < 1e-15), "{x:?} {b:?}");
    }

    /// Rows before the first that changes are as they were, to the bit.
    #[test]
    fn refactoring_from_a_changed_row_equals_a_full_factor() {
        let (mut whole, mut part) = (matrix(), matrix());
        part.factor(0).unwrap();
        *whole.entry(5, 4) += 0.3;
        let changed = whole.clone();
        whole.factor(0).unwrap();
        part.copy_rows(5, &changed);
        part.factor(5).unwrap();
        assert_eq!(whole, part);
        *part.entry(6, 6) = 0.0;
        assert_eq!(part.factor(6), None);
    }
}
