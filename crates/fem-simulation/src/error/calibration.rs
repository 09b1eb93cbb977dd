//! The constants of the error estimate, all of them.
//!
//! Safety factors and floors are calibrated on random scenes: `fem-run validate error_bars` draws scenes,
//! judges the error bars in them and prints, for each quantity, the constant of the edge that it needs. The scenes that the
//! constants below were fitted on are in `validation/error_bars/old_and_new.csv`. Arrays are in the order of
//! [`QuantityOfInterest::ALL`](fem_collision::QuantityOfInterest::ALL): restitution, contact time, peak force, approach, contact radius,
//! peak pressure; errors of the restitution are absolute, all others relative.

/// Calibrated constants of one kind of reference run.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Calibration {
    /// Safety factor on the estimated error.
    pub safety_factor: f64,
    /// Error that the place of the contact's edge between two nodes may add, times (a/h)².
    pub edge: [f64; 6],
}

/// Explicit elements whose reference runs are condensed bodies on three meshes.
pub(super) const EXPLICIT: Calibration =
    Calibration { safety_factor: 1.25, edge: [0.002, 0.008, 0.008, 0.01, 0.05, 0.1] };

/// Explicit elements at large strain or beside waves, with a coarser run of their own.
pub(super) const STRAINED: Calibration =
    Calibration { safety_factor: 2.0, edge: [0.01, 0.03, 0.01, 0.01, 0.04, 0.1] };

/// Condensed bodies, with one coarser run.
pub(super) const CONDENSED: Calibration =
    Calibration { safety_factor: 1.5, edge: [0.002, 0.011, 0.004, 0.032, 0.7, 0.45] };

/// Scatter of the quantities on any mesh, however fine.
pub(super) const SCATTER: [f64; 6] = [2e-5, 1e-4, 2e-4, 1e-4, 1e-3, 5e-4];

/// Error per share of mass that is added for a longer time step.
pub(super) const ADDED_MASS: [f64; 6] = [0.05, 0.25, 0.4, 0.45, 0.1, 0.2];

/// Order of convergence over the element size that the extrapolation assumes.
pub(super) const ORDER: f64 = 1.9;

/// Errors due to contact chatter. The restitution and the contact time change with the square root of the scatter of
/// the contact force over its peak, the contact radius with that scatter itself; measured for penalty factors of 3 to
/// 3000 between glass and steel at 0.05 to 20 m/s.
pub(super) const RESTITUTION_PER_ROOT_SCATTER: f64 = 0.0055;
/// Relative error of the contact time over the square root of the scatter.
pub(super) const TIME_PER_ROOT_SCATTER: f64 = 0.02;
/// Relative error of the contact radius over the scatter.
pub(super) const RADIUS_PER_SCATTER: f64 = 0.55;

/// Error of closed forms: rounding.
pub(super) const CLOSED_FORM: f64 = 1e-12;

/// Error of a pressure that elements do not resolve over its distance from that of closed forms.
pub(super) const CLOSED_FORM_PRESSURE: f64 = 1.1;

/// Errors of approach, radius and pressure of a contact law over its tolerance: they are read from sampled instants.
pub(super) const SAMPLED_PER_TOLERANCE: f64 = 20.0;
