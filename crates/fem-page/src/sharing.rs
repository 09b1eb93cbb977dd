//! The shares of a collision's energy. Only the relative motion of the bodies can lose energy; their common motion is
//! changed by no collision.
//!
//! ```math
//! \tfrac12m_1v_1^2+\tfrac12m_2v_2^2
//! = \underbrace{\frac{(m_1v_1+m_2v_2)^2}{2(m_1+m_2)}}_\text{common}
//! + \underbrace{\tfrac12m^*(v_1-v_2)^2}_\text{relative},
//! \qquad \frac1{m^*} = \frac1{m_1}+\frac1{m_2}
//! ```
//!
//! (König's theorem). The rebound returns e² of the relative part. With a wall or a half-space at rest
//! all motion is relative motion. Energies of the bodies are those of the summary.

use fem::{Account, Collision, HistoryRow};
use serde::Serialize;

/// The shares of the energy at the end.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct EnergyShares {
    /// Energy of the common motion, the same before and after, J.
    pub common_j: f64,
    /// Energy of the relative motion before the collision, J: the most that a collision can dissipate.
    pub relative_j: f64,
    /// The parts into which it has turned, J: `rebound` first, then the remaining motion, `ringing`, then the other
    /// accounts by name.
    pub parts: Vec<(&'static str, f64)>,
}

/// The masses of two bodies that move along one line.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Masses([f64; 2]);

impl Masses {
    /// Reads the masses of a collision's bodies; a body without a mass has an infinite one.
    pub fn of(collision: &Collision) -> Self {
        Self(collision.bodies.each_ref().map(|body| body.mass.unwrap_or(f64::INFINITY)))
    }

    /// Returns the energies of the common and of the relative motion, J; `None` if a body of infinite mass
    /// moves.
    pub fn motions(self, [v1, v2]: [f64; 2]) -> Option<(f64, f64)> {
        let approach = v1 - v2;
        match self.0 {
            [m1, m2] if m1.is_finite() && m2.is_finite() => {
                let (momentum, mass) = (m1 * v1 + m2 * v2, m1 + m2);
                let relative = 0.5 * (m1 * m2 / mass) * approach * approach;
                Some((0.5 * momentum * momentum / mass, relative))
            }
            [m1, m2] => {
                let (mass, held) = if m1.is_finite() { (m1, v2) } else { (m2, v1) };
                (held == 0.0 && mass.is_finite()).then_some((0.0, 0.5 * mass * approach * approach))
            }
        }
    }
}

impl EnergyShares {
    /// Compares the first and the last row of a collision. `None` if gravity or a driven body does work, or
    /// if the energies are not known.
    pub(crate) fn of(collision: &Collision) -> Option<Self> {
        let (first, last) = (collision.history.first()?, collision.history.last()?);
        if last.energy(Account::Potential).is_some() || last.energy(Account::LeftBefore).is_some() {
            return None;
        }
        let masses = Masses::of(collision);
        let (common, relative) = masses.motions(first.velocity)?;
        let (_, rebound) = masses.motions(last.velocity)?;
        let ringing = last.energy(Account::Kinetic)? - common - rebound;
        let mut parts = vec![("rebound", rebound)];
        if ringing.abs() > SMALLEST * relative {
            parts.push(("ringing", ringing));
        }
        let others = Account::all()
            .filter(|account| !matches!(account, Account::Kinetic | Account::WallWork));
        for account in others {
            if let Some(energy) = last.energy(account) {
                parts.push((account.name(), energy));
            }
        }
        Some(Self { common_j: common, relative_j: relative, parts })
    }
}

/// Relative size of rounding errors of the motion.
const SMALLEST: f64 = 1e-9;

/// Returns the energy of the common motion in every row of a history, J; `None` if it changes or is not
/// known.
pub(crate) fn common_of(collision: &Collision) -> Option<f64> {
    let row: &HistoryRow = collision.history.first()?;
    if row.energy(Account::Potential).is_some() {
        return None;
    }
    Some(Masses::of(collision).motions(row.velocity)?.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// By hand: 1 kg at 3 m/s and 2 kg at rest have 1.5 J of common and 3 J of relative motion.
    #[test]
    fn common_and_relative_motion_add_up_to_the_kinetic_energy() {
        assert_eq!(Masses([1.0, 2.0]).motions([3.0, 0.0]), Some((1.5, 3.0)));
        assert_eq!(Masses([f64::INFINITY, 2.0]).motions([0.0, -3.0]), Some((0.0, 9.0)));
        assert_eq!(Masses([f64::INFINITY, 2.0]).motions([1.0, -3.0]), None);
        assert_eq!(Masses([f64::INFINITY; 2]).motions([0.0, -3.0]), None);
    }
}
