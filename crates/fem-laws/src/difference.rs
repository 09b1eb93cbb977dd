//! Differences between two results of one collision, and the error of a rigid partner.

use crate::hertz::HertzImpact;
use crate::impact::Impact;
use crate::pair::{Pair, Partner};

/// Differences of two collisions' results, the first's less the second's; also the error of leaving
/// something out, estimated.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct ImpactDifference {
    /// Of the restitution.
    pub restitution: f64,
    /// Of the contact time, s; `None` if bodies stay together in either.
    pub contact_time: Option<f64>,
    /// Of the largest force, N.
    pub peak_force: f64,
}

impl ImpactDifference {
    /// `found` less `reference`: with `found` left something out, its error.
    pub fn of(found: &Impact, reference: &Impact) -> Self {
        let times = found.contact_time.zip(reference.contact_time);
        Self {
            restitution: found.restitution - reference.restitution,
            contact_time: times.map(|(found, reference)| found - reference),
            peak_force: found.peak_force - reference.peak_force,
        }
    }
}

/// The error of a result by a closed form: too large by so much, or off by up to so much where the form
/// says so.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct RelativeError {
    /// Of the restitution, absolute.
    pub restitution: f64,
    /// Of the contact time, relative.
    pub contact_time: f64,
    /// Of the largest force, relative.
    pub peak_force: f64,
}

impl RelativeError {
    /// Of the time, s, and the force, N, of an elastic impact.
    pub fn of(&self, hertz: &HertzImpact) -> ImpactDifference {
        ImpactDifference {
            restitution: self.restitution,
            contact_time: Some(self.contact_time * hertz.contact_time()),
            peak_force: self.peak_force * hertz.peak_force(),
        }
    }

    /// Whether none of the three is larger than another's, in size.
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
