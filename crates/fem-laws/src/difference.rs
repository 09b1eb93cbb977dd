//! Differences between two results of one collision, and the error of a rigid partner.

use crate::hertz::HertzImpact;
use crate::impact::Impact;
use crate::pair::{Pair, Partner};

/// The differences between the results of two collisions, first less second; also an estimated error of a
/// neglected effect.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct ImpactDifference {
    /// Difference of the restitution.
    pub restitution: f64,
    /// Difference of the contact time, s; `None` if bodies stay together in either.
    pub contact_time: Option<f64>,
    /// Difference of the largest force, N.
    pub peak_force: f64,
}

impl ImpactDifference {
    /// Returns `found` less `reference`: the error of `found` if it neglects an effect.
    pub fn of(found: &Impact, reference: &Impact) -> Self {
        let times = found.contact_time.zip(reference.contact_time);
        Self {
            restitution: found.restitution - reference.restitution,
            contact_time: times.map(|(found, reference)| found - reference),
            peak_force: found.peak_force - reference.peak_force,
        }
    }
}

/// Relative error of a result by a closed form; signed, or a bound where the form says so.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct RelativeError {
    /// Absolute error of the restitution.
    pub restitution: f64,
    /// Relative error of the contact time.
    pub contact_time: f64,
    /// Relative error of the largest force.
    pub peak_force: f64,
}

impl RelativeError {
    /// Returns the errors of an elastic impact: of its contact time, s, and force, N.
    pub fn of(&self, hertz: &HertzImpact) -> ImpactDifference {
        ImpactDifference {
            restitution: self.restitution,
            contact_time: Some(self.contact_time * hertz.contact_time()),
            peak_force: self.peak_force * hertz.peak_force(),
        }
    }

    /// Returns whether the magnitude of each error is at most that of the tolerance.
    pub fn is_within(&self, tolerance: &Self) -> bool {
        self.restitution.abs() <= tolerance.restitution
            && self.contact_time.abs() <= tolerance.contact_time
            && self.peak_force.abs() <= tolerance.peak_force
    }
}

/// Returns the error of taking this partner of the pair as rigid; `None` if the other one is rigid.
///
/// The contact lacks the body's share s = E*/E′ of its compliance, E′ = E/(1−ν²), so that E* becomes
/// E*/(1−s), and by Hertz' powers
///
/// ```math
/// \frac{\Delta T}T = (1-s)^{2/5}-1, \qquad \frac{\Delta F}F = (1-s)^{-2/5}-1.
/// ```
///
/// The restitution stays as long as the body is elastic and radiates nothing. A sphere's finite size is
/// of a smaller order, (a/R) s.
pub fn rigid_partner(pair: &Pair, partner: &Partner) -> Option<RelativeError> {
    let share = pair.contact_modulus() / partner.plane_strain_modulus();
    // E* of a pair with one rigid body is the other's E′ itself.
    (share < 1.0).then(|| {
        let logarithm = 0.4 * (-share).ln_1p();
        RelativeError {
            restitution: 0.0,
            contact_time: logarithm.exp_m1(),
            peak_force: (-logarithm).exp_m1(),
        }
    })
}
