//! A Prony series from restitutions, and what the data leave open of it.
//!
//! The relaxation times τ_k are given; found are the weights w_k = G_k/G_0, those that minimise
//!
//! ```math
//! \sum_i \left(\frac{e_i(\mathbf w)-\hat e_i}{\rho_i}\right)^2 + \lambda^2\sum_k w_k^2,
//! \qquad w_k \ge 0, \quad \sum_k w_k \le 1,
//! ```
//!
//! ρ_i the uncertainty over the rms uncertainty (1 without), λ in units of e: a weight of 1 costs as
//! much as an error of λ at one point (Tikhonov's ridge; Honerkamp & Weese, *Rheol. Acta* 32 (1993)
//! 65, for relaxation spectra). By Gauss and Newton, each linear problem an exact non-negative least
//! squares (`bounded`).
//!
//! A mild loss is linear in the weights, 1 − e ≈ Σ w_k φ(T/τ_k), and φ is broad: φ ∝ T/τ for terms
//! slower than the contact, τ/T for faster ones. Over the narrow range of T that speeds make
//! (T ∝ v^(−1/5)) the columns are nearly parallel, and few combinations of weights are determined
//! ([`Resolution`]); what a single weight can be is asked with all others free ([`Range`]).
//!
//! Limits: the relaxation times are not searched; intervals follow the curved collision by chords,
//! the statistics are those of independent normal errors.

mod bounded;
mod fit;
mod problem;
mod ranges;
mod repeats;
mod resolution;
mod solve;
mod speed_exponent;

pub use fit::{MODEL_ERROR, SpectrumFit};
pub use problem::{Restitutions, SpectrumProblem, root_mean_square};
pub use ranges::Range;
pub use repeats::PureError;
pub use resolution::{Combination, Resolution};
pub use speed_exponent::{SpeedExponent, SpeedPoint, speed_exponent};
