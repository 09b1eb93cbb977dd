//! What two answers to one collision differ by.

use crate::hertz::HertzImpact;
use crate::impact::Impact;

/// Differences of two collisions' results, the first's less the second's; also the error of leaving
/// something out, estimated.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct Difference {
    /// Of the restitution.
    pub restitution: f64,
    /// Of the contact time, s; `None` if bodies stay together in either.
    pub contact_time: Option<f64>,
    /// Of the largest force, N.
    pub peak_force: f64,
}

impl Difference {
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
    pub fn of(&self, hertz: &HertzImpact) -> Difference {
        Difference {
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
