//! The contact problem of an instant, the contact radius and pressure that follow from it, and the static compression of two elastic
//! bodies by a constant force.

pub(crate) mod complementarity;
pub(crate) mod disc_contact;
pub(crate) mod elastic_impact;
pub(crate) mod pressure;
pub(crate) mod profile;

use fem_collision::{StaticContact, Stop};

use crate::contact::disc_contact::DiscContactSolver;
use crate::contact::pressure::Pressures;
use crate::error::CondensedError;
use crate::operators::slip::motion;
use crate::pair::CondensedPair;

impl CondensedPair {
    /// Computes the static equilibrium of the bodies under a force (N), without relaxation.
    ///
    /// # Errors
    /// A contact that reaches the end of the condensed region; no contact state.
    pub fn pressed(&self, force: f64) -> Result<StaticContact, CondensedError> {
        let n = self.points.len();
        let beyond = || CondensedError::ContactBeyondCandidates { radius: self.candidate_radius() };
        let approach = self.curve.approach(force).ok_or_else(beyond)?;
        let overlap: Vec<f64> =
            self.points.iter().map(|point| approach - point.initial_gap).collect();
        let mut forces = vec![0.0; n];
        let contact = DiscContactSolver::new(self.compliance.clone())
            .solve(&overlap, &mut forces)
            .map_err(|_| Stop::NoContactState { time: 0.0 })?;
        if contact.n_closed > self.most_closed(n) {
            return Err(beyond());
        }
        let force = forces.iter().sum();
        let moved = self.inputs().each_ref().map(|input| {
            input.material().map_or(0.0, |material| force * motion(material.instantaneous()))
        });
        let (radius, pressure) =
            self.radius_and_pressure(&contact, &forces, moved, &mut Pressures::default());
        Ok(StaticContact {
            force,
            approach,
            contact_radius: Some(radius),
            centre_pressure: Some(pressure),
        })
    }
}
