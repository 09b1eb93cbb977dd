//! The constants of the error estimate.
//!
//! `fem-validate error_bars` calibrates them: it draws random scenes, judges their error bars, and tabulates on its
//! page, for each row and quantity below, the edge constant in use and the one with which 98 % of the bars hold. The
//! values below were fitted on the scenes in `validation/error_bars/old_and_new.csv`. Arrays are in the order of
//! [`QuantityOfInterest::ALL`](fem_collision::QuantityOfInterest::ALL): restitution, contact time, peak force, approach,
//! contact radius, peak pressure. Errors of the restitution are absolute, all others relative.

use crate::estimate::Estimate;
use crate::plan::element_size::MACH_OF_SLOW_IMPACTS;

/// Calibrated constants for one kind of reference run.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Calibration {
    /// Name of this row of constants in the table of the claim.
    pub name: &'static str,
    /// The reference runs whose distances are added; all but the first may be unknown.
    pub against: &'static [Reference],
    /// Safety factors on the estimated errors; 0 where the reference run says nothing of the error.
    pub safety_factor: [f64; 6],
    /// Constant c of the error c (h/a)ᵖ that the place of the contact's edge between two nodes causes.
    pub edge: [f64; 6],
    /// Increase of c with the share of the modulus that is lost within one contact time.
    pub edge_of_relaxed: [f64; 6],
    /// Power p of the element size.
    pub edge_power: i32,
    /// Scatter of the quantities on any mesh, however fine.
    pub scatter: [f64; 6],
    /// Errors per share of the mass that is moved for a longer time step.
    pub moved_mass: [f64; 6],
}

/// The reference runs whose limit a distance is taken from.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Reference {
    /// Condensed bodies on the same mesh, and their limit on finer ones.
    Condensed,
    /// The model itself with longer elements.
    Coarser,
}

/// Constants for explicit elements whose reference runs are condensed bodies on three meshes.
pub(super) const EXPLICIT: Calibration = Calibration {
    name: "EXPLICIT",
    against: &[Reference::Condensed],
    safety_factor: [1.25; 6],
    edge: [0.002, 0.008, 0.008, 0.01, 0.05, 0.1],
    edge_of_relaxed: [0.0; 6],
    edge_power: 2,
    scatter: SCATTER_AT_SMALL_STRAIN,
    moved_mass: MOVED_MASS,
};

/// Constants for explicit elements at large strain or with waves, which have a coarser run of their own. Elements that are
/// flattened at the contact scatter more; the 98 scenes of the seeds 3 and 11 to 16 of `fem-validate soft_random` gave
/// the constants, with which 94 of them hold in all quantities.
pub(super) const COARSER_RUN: Calibration = Calibration {
    name: "COARSER_RUN",
    against: &[Reference::Coarser, Reference::Condensed],
    safety_factor: [1.5; 6],
    edge: [0.002, 0.03, 0.01, 0.01, 0.04, 0.1],
    edge_of_relaxed: [0.0; 6],
    edge_power: 2,
    scatter: [1e-4, 4.5e-3, 2e-3, 1e-4, 8e-3, 8e-3],
    moved_mass: MOVED_MASS,
};

/// Constants for explicit elements on a plate that bends, with a coarser run of their own. Moved mass takes part in the motion of
/// the plate: on 2, 3, 5 and 8 mm of steel 0.5 % of it lowers the restitution by 1.0, 0.7, 0.5 and 0.2 thousandths. The limits of
/// fine meshes are 3e-4 and 5e-4 below the exact layer on 5 and 2 mm (`validation/plate_layer/layer.py`).
pub(super) const PLATE: Calibration = Calibration {
    name: "PLATE",
    scatter: [5e-4, 4.5e-3, 2e-3, 1e-4, 8e-3, 8e-3],
    moved_mass: [0.2, 0.25, 0.4, 0.45, 0.1, 0.2],
    ..COARSER_RUN
};

/// Constants for explicit elements that flow plastically, with a coarser run of their own. The force of such a contact is a
/// staircase (`fem-mesh/src/contact_edge.rs`), so its errors fall with the first power of the element size. 454 random scenes
/// gave the constants of both rows, and 680 more those of the pressure; `validation/random_scenes/flow.csv` has others. Radius and
/// pressure of a run with two elements across the contact differ by several times the error of the run with four, so their bars
/// depend on the elements across the contact alone.
const FLOW: Calibration = Calibration {
    name: "FLOW",
    // Elastic condensed bodies show nothing of the error of flow.
    against: &[Reference::Coarser],
    safety_factor: [1.0, 1.0, 1.0, 1.0, 0.0, 0.0],
    edge: [0.03, 0.03, 0.021, 0.002, 0.09, 0.24],
    edge_of_relaxed: [0.0; 6],
    edge_power: 1,
    scatter: [2e-4, 5e-4, 5e-4, 2e-4, 1e-3, 5e-3],
    moved_mass: MOVED_MASS,
};

/// The same for impacts so fast that waves are on top of the contact force.
const FAST_FLOW: Calibration =
    Calibration { name: "FAST_FLOW", edge: [0.03, 0.07, 0.1, 0.002, 0.12, 0.36], ..FLOW };

impl Calibration {
    /// Returns the constants for condensed bodies, or for explicit elements that need a reference run of their own or do not.
    pub(super) fn of(estimate: &Estimate, is_explicit: bool, needs_own: bool) -> &'static Self {
        match (is_explicit, needs_own) {
            (false, _) => &CONDENSED,
            (true, false) => &EXPLICIT,
            (true, true) if estimate.flow.is_some() => Self::of_flow(estimate),
            (true, true) if estimate.bends => &PLATE,
            (true, true) => &COARSER_RUN,
        }
    }

    /// Returns the constants for explicit elements that flow plastically.
    pub(crate) fn of_flow(estimate: &Estimate) -> &'static Self {
        if estimate.mach > MACH_OF_SLOW_IMPACTS { &FAST_FLOW } else { &FLOW }
    }
}

/// Constants for condensed bodies with one coarser run. Each node that comes into contact meets the unrelaxed modulus, so
/// the force of bodies that lose much of it is a staircase: of 1817 random scenes on walls, blocks, like and unlike balls, 98 %
/// of those that lose more than half of their modulus hold with the constants of relaxed bodies. 392 scenes of the claim gave
/// the factors and the constant of the radius: with factors of 1.25, 98 % of time, force and radius have 0.74, 0.49 and 0.58 of
/// their bars.
pub(super) const CONDENSED: Calibration = Calibration {
    name: "CONDENSED",
    against: &[Reference::Coarser],
    safety_factor: [1.5, 1.25, 1.25, 1.5, 1.25, 1.5],
    edge: [0.002, 0.011, 0.004, 0.032, 0.4, 0.45],
    edge_of_relaxed: [0.014, 0.03, 0.2, 0.0, 1.0, 0.1],
    edge_power: 2,
    scatter: SCATTER_AT_SMALL_STRAIN,
    moved_mass: MOVED_MASS,
};

/// Scatter of the quantities at small strain.
const SCATTER_AT_SMALL_STRAIN: [f64; 6] = [2e-5, 1e-4, 2e-4, 1e-4, 1e-3, 5e-4];

/// Errors per share of the mass that is moved for a longer time step.
pub(super) const MOVED_MASS: [f64; 6] = [0.05, 0.25, 0.4, 0.45, 0.1, 0.2];

/// Order of convergence with the element size that the extrapolation assumes.
pub(super) const ORDER: f64 = 1.9;

/// Errors due to contact chatter over the square root of the force's scatter over its peak, and over that scatter. Those of
/// restitution, contact time and radius are measured for penalty factors of 3 to 3000 between glass and steel at 0.05 to 20 m/s.
pub(super) const CHATTER: [[f64; 2]; 6] =
    [[0.0055, 0.0], [0.02, 0.0], [0.0, 1.0], [0.0, 0.0], [0.0, 0.55], [0.0, 1.0]];

/// Least relative error if the contact is narrower than an element.
pub(super) const UNRESOLVED_ERROR: f64 = 0.5;

/// Below this ratio of the contact radius at the largest pressure to the largest contact radius the pressure peak counts as
/// early. Bodies that keep half of their moduli have a ratio above 0.8.
pub(super) const EARLY: f64 = 0.5;
/// Elements across the contact at an early pressure peak below which it is not resolved.
pub(super) const FEW_AT_PRESSURE: f64 = 4.0;
/// Error of a pressure that the elements do not resolve, over its distance from that of closed forms.
pub(super) const CLOSED_FORM_PRESSURE: f64 = 1.1;

/// Error of closed forms, which is rounding.
pub(super) const CLOSED_FORM: f64 = 1e-12;
/// Errors of approach, radius and pressure of a contact law over its tolerance: they are read from sampled instants.
pub(super) const SAMPLED_PER_TOLERANCE: f64 = 20.0;
