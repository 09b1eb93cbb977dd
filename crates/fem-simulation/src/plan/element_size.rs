//! The a-priori mesh rule: element size and mass scaling for the tolerance of a case.
//!
//! With k elements across the contact radius and the share μ of moved mass, the peak force has an error of at most
//!
//! ```math
//! \Bigl|\frac{\Delta F}{F}\Bigr| \le \frac{C}{k^2} + \tfrac12 \mu .
//! ```
//!
//! - **Springs between the surfaces**: C = 0.05 + 0.10 s. The second term is the oscillation of the force with the place of
//!   the contact's edge between two nodes ([`mesh_offset`](crate::plan::mesh_offset)); theory bounds it by 3/16. Its
//!   share s is 1 on meshes that are not offset, and otherwise the difference of the bodies' shares in the contact
//!   compliance. The errors of the other quantities are smaller: 0.06/k² for the contact time, 0.04/k² for the restitution
//!   and 0.45/k² for the peak pressure.
//! - **Nodes that touch exactly**: C = 0.05. The oscillation is known and subtracted from the peak force
//!   (`fem-condensed/src/contact/elastic_impact.rs`). The errors are 0.05/k² for the contact time, 0.01/k² for the
//!   restitution and 0.12/k² for the peak pressure.
//!
//! The constants for springs are measured in 11 cases of this repository and 17 random scenes (walls, half-spaces, strong
//! relaxation, size ratios to 30, moduli to 1:30) against limits of fine meshes, with k = 3 to 11 and μ = 2e-4 to 2e-2
//! (docs/accuracy.md); those for nodes in the elastic and the relaxing glass pair with 90 element sizes, k = 4 to 17. The
//! claim `error_bars` tests the rule on random scenes.
//!
//! - **Bodies that flow plastically**: an error c/k with the constants of the error estimate (`error/calibration.rs`), which
//!   has 0.6 of the tolerance.
//!
//! If the oscillation remains, the element size is chosen so that it passes through zero: k = n + 0.35.

use fem_case::{Accuracy, CondensedOptions, ModelChoice, Scene};
use fem_collision::QuantityOfInterest;

use crate::effects::{FiniteStrain, MAX_MOVED_MASS};
use crate::error::calibration::Calibration;
use crate::estimate::Estimate;
use crate::quantity_errors::tolerance_of;

/// The bounds of the errors for one kind of contact.
struct ContactBounds {
    /// Error of the peak force times k² without the oscillation.
    smooth_error: f64,
    /// Error of the peak force times k² by the oscillation.
    oscillating_error: f64,
    /// Bounds of the errors of [`BOUNDED_QUANTITIES`] over that of the force.
    over_force_error: [f64; 4],
    /// Fewest elements across the contact radius.
    min_across: f64,
    /// Least share of the elements that later contacts under gravity have.
    share_of_later_contacts: f64,
}

/// Springs between the surfaces: with 3.5 elements the radius of relaxing bodies has an error of 8 %.
const SPRINGS: ContactBounds = ContactBounds {
    smooth_error: 0.05,
    oscillating_error: 0.10,
    over_force_error: [1.0, 0.4, 0.3, 3.0],
    min_across: 4.0,
    share_of_later_contacts: 1.0,
};
/// Nodes that touch exactly: with 4.5 elements the error of the radius is up to 1.2 %, with 5.5 0.7 %. The mesh stays under gravity.
const NODES: ContactBounds = ContactBounds {
    smooth_error: 0.05,
    oscillating_error: 0.0,
    over_force_error: [1.0, 1.0, 0.2, 2.4],
    min_across: 5.45,
    share_of_later_contacts: 0.75,
};
/// Share of the tolerance for the mesh. The rest is for moved mass, and without it for relaxation, which moves the
/// contact's edge.
const TOLERANCE_SHARE_OF_MESH: f64 = 0.75;
/// Moved mass over the tolerance: the force changes by half of its share.
const MASS_OVER_TOLERANCE: f64 = 0.5;
/// Moved mass on a plate that bends over that elsewhere: moved mass takes part in the motion of the plate, and changes the
/// restitution four times as much.
const MASS_ON_PLATE: f64 = 0.2;
/// Most elements across the contact radius: 0.01 % of the force with springs and the whole oscillation.
const MAX_ACROSS: f64 = 45.0;
/// Share of the tolerance at finite strain on one mesh: contact time and pressure of soft balls on walls have twice the
/// error above.
const TOLERANCE_SHARE_AT_FINITE_STRAIN: f64 = 0.5;
/// Approach speed over the shear wave speed below which waves cross the body many times during the contact. In faster
/// impacts the first and last touch are waves of a few elements' length, which bulk viscosity damps. Soft balls on walls
/// at 0.06, 0.17 and 0.56, ν = 0.2 to 0.49, are within the tolerance with 7, 11 and 17 elements across the contact.
pub(crate) const MACH_OF_SLOW_IMPACTS: f64 = 0.03;
/// Place of the edge between two nodes at which the oscillation passes through zero.
const ZERO_OF_OSCILLATION: f64 = 0.35;
/// Share of the tolerance for the place of the contact's edge between two nodes, if bodies flow plastically.
const TOLERANCE_SHARE_OF_EDGE: f64 = 0.6;
/// The quantities that the rule bounds.
const BOUNDED_QUANTITIES: [QuantityOfInterest; 4] = [
    QuantityOfInterest::PeakForce,
    QuantityOfInterest::ContactTime,
    QuantityOfInterest::Restitution,
    QuantityOfInterest::PeakPressure,
];

/// The result of the a-priori mesh rule.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MeshRule {
    /// Elements across the contact radius.
    pub across: f64,
    /// Largest moved mass over the lighter body's mass.
    pub mass_scaling: f64,
    /// The error of the force on the finest mesh, if the scene asks for a finer one.
    pub error_on_finest_mesh: Option<f64>,
    /// Whether the tolerance alone asks for a finer mesh than the finest.
    pub is_for_tolerance: bool,
    /// The quantity that needs the smallest elements, and its tolerance.
    pub limiting_quantity: (QuantityOfInterest, f64),
}

impl MeshRule {
    /// Applies the rule to a scene, on one mesh or on staggered meshes.
    pub fn of(scene: &Scene, estimate: &Estimate, is_staggered: bool) -> Self {
        // Condensed bodies have no finite strain.
        let is_finite = *scene.model() == ModelChoice::Fem && FiniteStrain::is_on(scene, estimate);
        let share = if is_finite && !is_staggered { TOLERANCE_SHARE_AT_FINITE_STRAIN } else { 1.0 };
        let at_nodes = touches_at_nodes(scene.model());
        let bounds = if at_nodes { &NODES } else { &SPRINGS };
        let later = scene.gravity().map_or(1.0, |_| bounds.share_of_later_contacts);
        let (least, limiting_quantity) = tolerance(&scene.accuracy(), &bounds.over_force_error);
        let tolerance = share * least;
        let [lower, upper] = scene.compliance_shares();
        let oscillating = if is_staggered { (lower - upper).abs() } else { 1.0 };
        let error = bounds.smooth_error + bounds.oscillating_error * oscillating;
        let asked_for = match estimate.flow {
            Some(_) => {
                let Accuracy { restitution, peak_force, .. } = scene.accuracy();
                let [e, _, force, ..] = Calibration::of_flow(estimate).edge;
                (e / restitution).max(force / peak_force) / TOLERANCE_SHARE_OF_EDGE
            }
            None => (error / (TOLERANCE_SHARE_OF_MESH * tolerance)).sqrt() / later,
        };
        let for_waves = (estimate.mach / MACH_OF_SLOW_IMPACTS).cbrt().max(1.0);
        let for_tolerance = asked_for.max(bounds.min_across);
        let asked_for = scene.refinement() * for_waves * for_tolerance;
        let across = asked_for.min(MAX_ACROSS);
        let across = match is_staggered || at_nodes {
            true => across,
            false => (across - ZERO_OF_OSCILLATION).ceil() + ZERO_OF_OSCILLATION,
        };
        let error_on_finest_mesh = error / (TOLERANCE_SHARE_OF_MESH * MAX_ACROSS * MAX_ACROSS);
        let of_plate = if estimate.bends && estimate.flow.is_none() { MASS_ON_PLATE } else { 1.0 };
        let mass = MASS_OVER_TOLERANCE * tolerance.max(error_on_finest_mesh);
        Self {
            across,
            mass_scaling: of_plate * mass.min(MAX_MOVED_MASS),
            error_on_finest_mesh: (asked_for > MAX_ACROSS).then_some(error_on_finest_mesh),
            is_for_tolerance: for_tolerance > MAX_ACROSS,
            limiting_quantity,
        }
    }

    /// Returns the share of moved mass that suits `across` elements across the contact on one mesh.
    pub fn mass_scaling_beside(across: f64) -> f64 {
        let error = SPRINGS.smooth_error + SPRINGS.oscillating_error;
        let tolerance = error / (TOLERANCE_SHARE_OF_MESH * across * across);
        (MASS_OVER_TOLERANCE * tolerance).min(MAX_MOVED_MASS)
    }
}

/// Returns whether the bodies touch exactly, at their nodes.
pub(crate) fn touches_at_nodes(model: &ModelChoice) -> bool {
    matches!(model, ModelChoice::Condensed(CondensedOptions { penalty_springs: false, .. }))
}

/// Returns the tolerance of the peak force at which all tolerances are met, and the quantity that limits it with its own.
fn tolerance(accuracy: &Accuracy, bounds: &[f64; 4]) -> (f64, (QuantityOfInterest, f64)) {
    let first = (f64::INFINITY, (QuantityOfInterest::PeakForce, accuracy.peak_force));
    BOUNDED_QUANTITIES.into_iter().zip(bounds).fold(first, |least, (quantity, bound)| {
        match tolerance_of(accuracy, quantity) {
            Some(tolerance) if tolerance / bound < least.0 => {
                (tolerance / bound, (quantity, tolerance))
            }
            _ => least,
        }
    })
}

#[cfg(test)]
mod tests {
    use std::path::Path;

    use fem_case::Case;

    use super::*;
    use crate::plan::mesh_offset::finer_body;

    const GLASS: &str = include_str!("../../../../cases/glass_0.5ms_elastic.toml");
    const WALL: &str = "body.0={ name = 'striker', wall = {} }";
    const SMALL_STRAIN: &str = "effects.finite_strain='off'";

    fn mesh_rule(set: &[&str]) -> MeshRule {
        let set: Vec<String> = set.iter().chain([&SMALL_STRAIN]).map(ToString::to_string).collect();
        let case = Case::parse("glass.toml", GLASS, Path::new("."), &set).unwrap();
        let scene = case.scene();
        let estimate = Estimate::of(scene).unwrap();
        MeshRule::of(scene, &estimate, finer_body(scene).is_some())
    }

    /// k is √(0.05/0.75τ) on staggered meshes, the next n + 0.35 above √(0.15/0.75τ) on a wall, and √(0.05/0.75τ), at least
    /// 5.45, at nodes; µ is half of τ.
    #[test]
    fn a_tolerance_becomes_elements_and_mass() {
        for (set, tolerance, across, mass) in [
            (&[][..], "1 %", 4.0, 5e-3),
            (&[], "0.6 %", 4.0, 3e-3),
            (&[], "0.1 %", 8.165, 5e-4),
            (&[WALL, "body.1.approach_speed=0.5"], "1 %", 5.35, 5e-3),
            (&[WALL, "body.1.approach_speed=0.5"], "0.1 %", 14.35, 5e-4),
            (&["mesh.staggered=false"], "1 %", 5.35, 5e-3),
            (&["model.condensed={}"], "1 %", 5.45, 5e-3),
            (&["model.condensed={}"], "0.1 %", 8.165, 5e-4),
            (&["model.condensed.penalty_springs=true"], "1 %", 4.0, 5e-3),
            (&[], "20 %", 4.0, 1e-2),
        ] {
            let tolerance = format!("accuracy.tolerance='{tolerance}'");
            let found = mesh_rule(&[set, &[tolerance.as_str()]].concat());
            assert!((found.across - across).abs() < 1e-3, "{set:?} {tolerance}: {found:?}");
            assert!(
                (found.mass_scaling / mass - 1.0).abs() < 1e-9,
                "{set:?} {tolerance}: {found:?}"
            );
            assert_eq!(found.error_on_finest_mesh, None);
        }
    }

    /// A smaller tolerance never needs fewer elements, and the tightest of several tolerances counts.
    #[test]
    fn a_smaller_tolerance_needs_no_fewer_elements() {
        for set in [&[][..], &[WALL, "body.1.approach_speed=0.5"], &["model.condensed={}"]] {
            let mut before: Option<MeshRule> = None;
            for k in 0..60 {
                let tolerance = format!("accuracy.tolerance={:e}", 0.4 * 0.8_f64.powi(k));
                let now = mesh_rule(&[set, &[tolerance.as_str()]].concat());
                assert!(now.across <= MAX_ACROSS + 1.0 && now.across >= SPRINGS.min_across);
                if let Some(before) = before {
                    assert!(now.across >= before.across && now.mass_scaling <= before.mass_scaling);
                }
                before = Some(now);
            }
            assert!(before.unwrap().error_on_finest_mesh.is_some_and(|error| error < 2e-4));
        }
        let one = |key: &str, tolerance: f64| {
            mesh_rule(&[&format!("accuracy.tolerance.{key}={tolerance:e}")]).across
        };
        let of_force = one("peak_force", 1e-3);
        assert!((one("peak_pressure", 3e-3) - of_force).abs() < 1e-9);
        assert!((one("contact_time", 4e-4) - of_force).abs() < 1e-9);
        assert!((one("restitution", 3e-4) - of_force).abs() < 1e-9);
    }

    /// If only one body is compliant, staggering has no effect: the oscillation is that of a ball on a wall.
    #[test]
    fn stiff_partner_needs_the_element_size_of_a_wall() {
        let stiff = "material.stiff={ density=7800, youngs_modulus='63 TPa', poissons_ratio=0.3 }";
        let set = ["accuracy.tolerance='0.1 %'", stiff, "body.1.material='stiff'"];
        let across = mesh_rule(&[&set[..], &["effects.rigid_partner='off'"]].concat()).across;
        assert!((13.9..14.2).contains(&across), "{across}");
    }
}
