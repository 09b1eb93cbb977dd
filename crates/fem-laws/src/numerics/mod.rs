//! Numerical tools of the closed forms: zeros of functions, and functions with the same bits everywhere.

pub mod bisection;
pub(crate) mod functions;
pub(crate) mod secular_equation;

/// Returns the integral of a smooth function from 0 to 1 by the midpoint rule, which asks for neither end.
pub(crate) fn midpoint_sum(value: impl Fn(f64) -> f64) -> f64 {
    const PANELS: u32 = 400;
    let width = f64::from(PANELS).recip();
    (0..PANELS).map(|k| value((f64::from(k) + 0.5) * width)).sum::<f64>() * width
}
