//! Parameters of contact laws from restitutions that were measured or computed, and back.
//!
//! ```text
//! Model ─┬─ Problem ─ Fit, Profile     parameters to e(v) and T(v), by least squares
//! pair,  └─ invert                     the parameter that gives one e at one speed
//! law
//!
//! spectrum                             a Prony series to e(v), and what the data leave open
//! ```
//!
//! Everything is SI.
//!
//! ```
//! use fem_data::estimate::{Model, Point, Problem};
//! use fem_laws::{EndRule, LawFamily, Pair, Partner};
//! use fem_material::{ElasticModuli, Material};
//!
//! # fn main() -> Result<(), Box<dyn std::error::Error>> {
//! let moduli = ElasticModuli::from_youngs_modulus_poissons_ratio(63e9, 0.244)?;
//! let glass = Material::new(2390.0, moduli, None)?;
//! let sphere = Partner::solid_sphere(15.9e-3, &glass);
//! let pair = Pair::new(sphere, sphere)?;
//!
//! // One measured restitution determines A, and leaves nothing to judge the law by.
//! let model = Model::new(&pair, [None, None], LawFamily::KuwabaraKono, EndRule::ZeroForce)?;
//! let points = [Point::new(0.5, 0.925)];
//! let fit = Problem::new(&model, &points, &["a"])?.fit(0.95)?;
//! assert!(fit.rms < 1e-8 && fit.estimates[0].interval.is_none());
//!
//! // The same number as an inverse problem.
//! let found = fem_data::estimate::invert(&model, 0, &fit.values, 0.5, 0.925)?;
//! assert!((found.solutions[0] / fit.values[0] - 1.0).abs() < 1e-6);
//! # Ok(())
//! # }
//! ```

mod error;
mod estimates;
mod inputs;
mod inverse;
mod least_squares;
mod model;
mod parameter;
mod problem;
mod profile;
mod robust;
pub mod spectrum;

pub use error::FitError;
pub use estimates::{Estimate, Fit};
pub use inputs::{InputPart, SPEED};
pub use inverse::{Inversion, invert};
pub use least_squares::{
    Accuracy, CONFIDENCE, Residuals, SumOfSquares, covariance, jacobian, minimise, quantile,
};
pub use model::{Model, Outcome};
pub use parameter::{ParameterError, check_value, find_parameter, loss_parameter, parse_value};
pub use problem::{Free, Problem};
pub use profile::{Profile, ProfilePoint};
pub use robust::{Fitted, Robustness, deviation_by_median, median, reweight};

pub use crate::table::Point;
