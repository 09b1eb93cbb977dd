//! Free vibrations of a body, the inertia that a quasi-static contact lacks.
//!
//! Lanczos' method is applied to the flexibility of the free body, G = P K⁻¹ Pᵀ, in the inner product of the masses:
//! G M φ = φ/ω². The projection P removes the mean motion. The first vector is the response to a load on the
//! contact pole, so that the modes excited by the contact converge first. Vectors are fully orthogonalised, and modes
//! normalised to φᵀMφ = 1.

use faer::Mat;

use crate::condensation::condensed_body::CondensedBody;
use crate::condensation::dense::symmetric_eigen;
use crate::error::CondensedError;

/// Lanczos vectors per mode. With [`VECTORS_MORE`] they are sufficient for frequencies exact to 1e-6.
const VECTORS_PER_MODE: usize = 3;
/// Lanczos vectors in addition to [`VECTORS_PER_MODE`], for any number of modes.
const VECTORS_MORE: usize = 20;
/// Number of modes that are computed at first, if more are requested.
const FIRST_MODES: usize = 12;
/// Relative residual of a mode's flexibility below which the mode has converged.
const CONVERGED_RESIDUAL: f64 = 1e-3;
/// Smallest length of a shear wave of a mode's frequency, over the longest element edge. The mesh does not resolve
/// shorter waves: with them a glass pair loses ten times too much energy at 50 m/s.
const ELEMENTS_PER_WAVE: f64 = 2.5;

/// Modes of free vibration.
#[derive(Debug, Clone)]
pub(crate) struct Vibrations {
    /// Squares ω² of the angular frequencies in rising order, 1/s².
    pub squared_frequency: Vec<f64>,
    /// Share θ of the deviatoric energy.
    pub deviatoric_share: Vec<f64>,
    /// Inward displacement of the contact nodes over ω, m/√J.
    pub contact: Mat<f64>,
    /// Displacement of all equations over ω, that of the ground last, m/√J.
    pub fields: Mat<f64>,
}

impl Vibrations {
    /// Computes the lowest `n_modes` modes, as far as the mesh resolves them. `shear_speed` is the speed of shear
    /// waves, m/s.
    ///
    /// # Errors
    /// Missing memory; a stiffness that is not positive definite to rounding.
    pub fn new(
        body: &CondensedBody,
        shear_speed: f64,
        n_modes: usize,
    ) -> Result<Self, CondensedError> {
        // A wave of frequency ω is 2π c/ω long.
        let shortest = ELEMENTS_PER_WAVE * longest_edge(body);
        let least = (shortest / (std::f64::consts::TAU * shear_speed)).powi(2);
        let mut lanczos = Lanczos::new(body, n_modes);
        // Vectors beyond those of the resolved modes are unresolved modes and finally rounding. So the number of
        // vectors grows only until all resolved modes are known.
        let mut asked = n_modes.min(FIRST_MODES);
        let converged = loop {
            lanczos.extend(VECTORS_PER_MODE * asked + VECTORS_MORE)?;
            let converged = lanczos.converged(asked, least)?;
            if converged.is_all || asked == n_modes || lanczos.is_over() {
                break converged;
            }
            asked = (2 * asked).min(n_modes);
        };
        Ok(lanczos.modes(&converged))
    }
}

/// Flexibilities 1/ω² of converged modes in falling order, and their shapes in Lanczos vectors.
struct ConvergedModes {
    flexibilities: Vec<f64>,
    shapes: Mat<f64>,
    /// Whether these are all modes that the mesh resolves.
    is_all: bool,
}

/// Lanczos vectors of the flexibility of a free body.
struct Lanczos<'a> {
    body: &'a CondensedBody,
    /// `count` vectors, orthonormal in the masses, and their products with the masses.
    basis: Mat<f64>,
    weighted: Mat<f64>,
    projected: Mat<f64>,
    count: usize,
    /// Product of the flexibility and the last vector.
    load: Mat<f64>,
    last_norm: f64,
    has_broken_down: bool,
}

impl<'a> Lanczos<'a> {
    /// Creates the iteration with space for the vectors of `n_modes` modes.
    fn new(body: &'a CondensedBody, n_modes: usize) -> Self {
        let n = body.mass_of_equation.len();
        let n_vectors = (VECTORS_PER_MODE * n_modes + VECTORS_MORE).min(n / 2);
        Self {
            body,
            basis: Mat::zeros(n, n_vectors),
            weighted: Mat::zeros(n, n_vectors),
            projected: Mat::zeros(n_vectors, n_vectors),
            count: 0,
            load: body.balanced_load(&Mat::full(1, 1, 1.0)),
            last_norm: 0.0,
            has_broken_down: false,
        }
    }

    /// Returns whether there are no more vectors.
    fn is_over(&self) -> bool {
        self.has_broken_down || self.count == self.basis.ncols()
    }

    /// Adds vectors up to a number.
    fn extend(&mut self, n_vectors: usize) -> Result<(), CondensedError> {
        while self.count < n_vectors && !self.is_over() {
            self.add_vector()?;
        }
        Ok(())
    }

    fn add_vector(&mut self) -> Result<(), CondensedError> {
        let (k, masses) = (self.count, &self.body.mass_of_equation);
        self.body.solve_balanced(&mut self.load)?;
        // The first pass gives the projection of G, the second removes rounding errors. Both remove the mean motion,
        // which is not in the range of G: its rounding errors would grow by half with each vector.
        for pass in 0..2 {
            self.body.remove_mean_motion(&mut self.load);
            let done = self.weighted.as_ref().subcols(0, k);
            let shares = done.transpose() * &self.load;
            self.load -= self.basis.as_ref().subcols(0, k) * &shares;
            if pass == 0 && k > 0 {
                for j in 0..k {
                    self.projected[(j, k - 1)] = shares[(j, 0)];
                    self.projected[(k - 1, j)] = shares[(j, 0)];
                }
            }
        }
        self.body.remove_mean_motion(&mut self.load);
        let squares = masses.iter().enumerate().map(|(i, mass)| mass * self.load[(i, 0)].powi(2));
        let norm = squares.sum::<f64>().sqrt();
        if norm <= 0.0 || norm.is_nan() {
            self.has_broken_down = true;
            return Ok(());
        }
        for (i, mass) in masses.iter().enumerate() {
            self.basis[(i, k)] = self.load[(i, 0)] / norm;
            self.weighted[(i, k)] = mass * self.basis[(i, k)];
            self.load[(i, 0)] = self.weighted[(i, k)];
        }
        (self.count, self.last_norm) = (k + 1, norm);
        Ok(())
    }

    /// Returns the lowest converged modes, at most `n_modes`, with flexibilities of at least `least`, s².
    fn converged(&self, n_modes: usize, least: f64) -> Result<ConvergedModes, CondensedError> {
        // The last vector's own column of the projection is not known and left out.
        let m = usize::saturating_sub(self.count, 1);
        let projected = self.projected.as_ref().submatrix(0, 0, m, m).to_owned();
        let (values, vectors) =
            symmetric_eigen(&projected).ok_or(CondensedError::NotPositiveDefinite)?;
        // The largest flexibilities are the lowest frequencies. The component of the next vector in a mode is the
        // residual of its flexibility.
        let has_converged =
            |j: usize| self.last_norm * vectors[(m - 1, j)].abs() <= CONVERGED_RESIDUAL * values[j];
        let converged = (0..m).rev().take(n_modes).take_while(|&j| has_converged(j));
        let chosen: Vec<usize> = converged.take_while(|&j| values[j] >= least).collect();
        let next = m.checked_sub(chosen.len() + 1);
        Ok(ConvergedModes {
            flexibilities: chosen.iter().map(|&j| values[j]).collect(),
            shapes: Mat::from_fn(m, chosen.len(), |i, j| vectors[(i, chosen[j])]),
            is_all: next.is_none_or(|j| values[j] < least && has_converged(j)),
        })
    }

    fn modes(&self, converged: &ConvergedModes) -> Vibrations {
        let (body, m, n_modes) =
            (self.body, converged.shapes.nrows(), converged.flexibilities.len());
        let n = body.mass_of_equation.len();
        let squared_frequency = converged.flexibilities.iter().map(|value| value.recip()).collect();
        let scaled = Mat::from_fn(m, n_modes, |i, j| {
            converged.shapes[(i, j)] * converged.flexibilities[j].max(0.0).sqrt()
        });
        let fields = self.basis.as_ref().subcols(0, m) * scaled;
        let forces = body.apply_deviatoric(&fields);
        let deviatoric_share = (0..n_modes)
            .map(|j| (0..n).map(|i| fields[(i, j)] * forces[(i, j)]).sum::<f64>().clamp(0.0, 1.0))
            .collect();
        let first = body.numbering.first_contact();
        let contact = Mat::from_fn(body.numbering.n_contact, n_modes, |i, j| {
            body.inward * fields[(first + i, j)]
        });
        Vibrations { squared_frequency, deviatoric_share, contact, fields }
    }
}

/// Returns the length of the longest edge of a body's elements, m.
fn longest_edge(body: &CondensedBody) -> f64 {
    let nodes = body.mesh.nodes();
    let edges = body.mesh.quads().iter().flat_map(|quad| {
        (0..4).map(move |k| {
            let [a, b] = [quad[k], quad[(k + 1) % 4]].map(|node| nodes[node as usize]);
            (b[0] - a[0]).hypot(b[1] - a[1])
        })
    });
    edges.fold(0.0, f64::max)
}
