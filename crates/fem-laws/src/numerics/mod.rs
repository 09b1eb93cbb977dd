//! Numerical tools of the closed forms: zeros of functions, and functions with the same bits everywhere.

pub mod bisection;
pub(crate) mod functions;
pub(crate) mod secular_equation;
