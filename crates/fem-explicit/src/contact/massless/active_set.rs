//! The active set: the springs that are closed where the boundary is in balance.
//!
//! The boundary problem is the minimum of
//!
//! ```math
//! \phi(x) = \tfrac12\, x \cdot K x - R \cdot x
//!   + \sum_j \tfrac12\, k_j \langle -(g_j + b_j \cdot x) \rangle^2
//! ```
//!
//! over the changes x of the nodes without mass, with their stiffness K in a step, the forces R that are missing to
//! their balance, and gaps g that the change opens by b·x. φ is convex and piecewise quadratic. For a given active set
//! x solves one linear system; the springs whose gap is negative there are the next active set. The iteration ends
//! where the set does not change, which is exactly the minimum: after one iteration in most steps, more where the
//! contact grows or shrinks (Newton's method; Qi & Sun 1993). Should the sets repeat in a cycle, steps are damped so
//! that φ falls, which converges for any convex φ of this kind (Sun 1997).

use super::skyline::Skyline;

/// Number of iterations without a line search; at most three have been seen.
const FREE_ITERATIONS: usize = 10;
/// Largest number of iterations; a solution that has not converged by then continues in the next step.
const MAX_ITERATIONS: usize = 100;
/// Bisections of the line search, down to rounding.
const HALVINGS: usize = 60;

/// A spring between the surfaces.
#[derive(Debug, Clone)]
pub(super) struct Spring {
    /// Its stiffness, N/m.
    pub stiffness: f64,
    /// b: rows of the unknowns, and how much the gap opens per change.
    pub opening: Vec<(usize, f64)>,
}

impl Spring {
    fn first_row(&self) -> usize {
        self.opening.iter().map(|(row, _)| *row).min().unwrap_or(usize::MAX)
    }

    pub fn opens_by(&self, x: &[f64]) -> f64 {
        self.opening.iter().map(|&(row, share)| share * x[row]).sum()
    }
}

/// The matrix K and the springs.
#[derive(Debug, Clone)]
pub(super) struct Problem {
    pub stiffness: Skyline,
    pub springs: Vec<Spring>,
}

/// Buffers for a solution, and the active set.
#[derive(Debug)]
pub(super) struct ActiveSet {
    /// Missing forces R, N.
    pub lacking: Vec<f64>,
    /// Gaps g, m.
    pub gaps: Vec<f64>,
    /// Change x, m.
    pub change: Vec<f64>,
    is_closed: Vec<bool>,
    /// The factor for the springs that were closed in the last iteration, and their set.
    factor: Skyline,
    factored: Option<Vec<bool>>,
    line: Line,
}

impl ActiveSet {
    /// Allocates the buffers for a problem.
    pub fn new(problem: &Problem) -> Self {
        let (n, n_springs) = (problem.stiffness.n_rows(), problem.springs.len());
        Self {
            lacking: vec![0.0; n],
            gaps: vec![0.0; n_springs],
            change: vec![0.0; n],
            is_closed: vec![false; n_springs],
            factor: problem.stiffness.clone(),
            factored: None,
            line: Line::new(n),
        }
    }

    /// Solves for x, given R and g. `None` if the matrix is not positive.
    pub fn solve(&mut self, problem: &Problem) -> Option<()> {
        self.close_by_gaps();
        for _ in 0..FREE_ITERATIONS {
            self.solve_closed(problem)?;
            if !self.close_by_change(problem) {
                return Some(());
            }
        }
        self.search_lines(problem)
    }

    /// Discards the factor if it contains closed springs, whose directions have changed since.
    pub fn forget_closed(&mut self) {
        self.factored.take_if(|factored| factored.contains(&true));
    }

    /// Closes the springs whose gap is negative before any change.
    fn close_by_gaps(&mut self) {
        for (is_closed, gap) in self.is_closed.iter_mut().zip(&self.gaps) {
            *is_closed = *gap < 0.0;
        }
    }

    /// Closes the springs whose gap is negative after the change. Returns whether the set has changed.
    fn close_by_change(&mut self, problem: &Problem) -> bool {
        let mut differ = false;
        for ((spring, gap), is_closed) in
            problem.springs.iter().zip(&self.gaps).zip(&mut self.is_closed)
        {
            let closes = gap + spring.opens_by(&self.change) < 0.0;
            differ |= closes != *is_closed;
            *is_closed = closes;
        }
        differ
    }

    /// Solves for the change with the present set.
    fn solve_closed(&mut self, problem: &Problem) -> Option<()> {
        self.update_factor(problem)?;
        self.change.copy_from_slice(&self.lacking);
        for ((spring, gap), is_closed) in
            problem.springs.iter().zip(&self.gaps).zip(&self.is_closed)
        {
            if *is_closed {
                let force = -spring.stiffness * gap;
                for &(row, share) in &spring.opening {
                    self.change[row] += share * force;
                }
            }
        }
        self.factor.solve(&mut self.change);
        Some(())
    }

    /// Updates the factor for the present set, from the first row that changes.
    fn update_factor(&mut self, problem: &Problem) -> Option<()> {
        let springs = || problem.springs.iter().zip(&self.is_closed);
        let from = match &self.factored {
            None => Some(0),
            Some(before) => {
                let changed = springs().zip(before).filter(|((_, now), before)| now != before);
                changed.map(|((spring, _), _)| spring.first_row()).min()
            }
        };
        let Some(from) = from else { return Some(()) };
        self.factor.copy_rows(from, &problem.stiffness);
        for (spring, _) in springs().filter(|(_, is_closed)| **is_closed) {
            for &(i, of_i) in &spring.opening {
                for &(j, of_j) in spring.opening.iter().filter(|(j, _)| i >= from && *j <= i) {
                    *self.factor.entry(i, j) += spring.stiffness * of_i * of_j;
                }
            }
        }
        let mut factored = self.factored.take().unwrap_or_default();
        factored.clone_from(&self.is_closed);
        self.factor.factor(from)?;
        self.factored = Some(factored);
        Some(())
    }

    /// Iterates from no change on, with a line search in which φ falls.
    fn search_lines(&mut self, problem: &Problem) -> Option<()> {
        self.line.start.fill(0.0);
        self.line.pull.fill(0.0);
        self.close_by_gaps();
        for _ in 0..MAX_ITERATIONS {
            self.solve_closed(problem)?;
            self.line.aim(problem, &self.lacking, &self.gaps, &self.is_closed, &self.change);
            if !self.close_by_change(problem) {
                return Some(());
            }
            self.line.advance(problem, &self.lacking, &self.gaps, &self.change);
            self.change.copy_from_slice(&self.line.start);
            self.close_by_change(problem);
        }
        Some(())
    }
}

/// A line from one change, x, to another, y.
#[derive(Debug)]
struct Line {
    /// Start x, m.
    start: Vec<f64>,
    /// K x at the start, N.
    pull: Vec<f64>,
    /// K y at the end, N.
    pull_at_end: Vec<f64>,
}

impl Line {
    fn new(n: usize) -> Self {
        let zeros = || vec![0.0; n];
        Self { start: zeros(), pull: zeros(), pull_at_end: zeros() }
    }

    /// Sets the end y, where R (N), the closed springs at their gaps (m) and K are in balance.
    fn aim(
        &mut self,
        problem: &Problem,
        lacking: &[f64],
        gaps: &[f64],
        is_closed: &[bool],
        end: &[f64],
    ) {
        self.pull_at_end.copy_from_slice(lacking);
        for ((spring, gap), _) in
            problem.springs.iter().zip(gaps).zip(is_closed).filter(|(_, is_closed)| **is_closed)
        {
            let force = -spring.stiffness * (gap + spring.opens_by(end));
            for &(row, share) in &spring.opening {
                self.pull_at_end[row] += share * force;
            }
        }
    }

    /// Returns dφ/dt at a share t of the way.
    fn slope(&self, problem: &Problem, lacking: &[f64], gaps: &[f64], end: &[f64], t: f64) -> f64 {
        let Self { start, pull, pull_at_end } = self;
        let mut slope = 0.0;
        for i in 0..start.len() {
            let lack = (1.0 - t) * pull[i] + t * pull_at_end[i] - lacking[i];
            slope += (end[i] - start[i]) * lack;
        }
        for (spring, gap) in problem.springs.iter().zip(gaps) {
            let (from, to) = (spring.opens_by(start), spring.opens_by(end));
            let overlap = -(gap + (1.0 - t) * from + t * to);
            slope -= spring.stiffness * overlap.max(0.0) * (to - from);
        }
        slope
    }

    /// Moves towards y as far as φ falls.
    fn advance(&mut self, problem: &Problem, lacking: &[f64], gaps: &[f64], end: &[f64]) {
        let falls = |t: f64| self.slope(problem, lacking, gaps, end, t) <= 0.0;
        let (mut length, mut beyond) = (0.0, 1.0);
        if falls(1.0) {
            length = 1.0;
        } else {
            for _ in 0..HALVINGS {
                let middle = 0.5 * (length + beyond);
                *(if falls(middle) { &mut length } else { &mut beyond }) = middle;
            }
        }
        let Self { start, pull, pull_at_end } = self;
        start.iter_mut().zip(end).for_each(|(x, y)| *x += length * (y - *x));
        pull.iter_mut().zip(pull_at_end).for_each(|(x, y)| *x += length * (*y - *x));
    }
}

#[cfg(test)]
mod tests;
