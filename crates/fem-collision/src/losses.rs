//! Energies that are lost at a known power, summed by the trapezoidal rule.

use serde::{Deserialize, Serialize};

use crate::account::Book;

/// Running sums of lost energies.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Losses {
    energies: Book,
    power: Option<Book>,
}

impl Losses {
    /// Takes the powers (W) at an instant, so long after the last one (s).
    #[inline]
    pub fn advance(&mut self, time: f64, power: Book) {
        for (account, now) in power.entries() {
            let lost = match &self.power {
                Some(last) => 0.5 * (last.get(account).unwrap_or(0.0) + now) * time,
                None => 0.0,
            };
            self.energies.add(account, lost);
        }
        self.power = Some(power);
    }

    /// What was lost since the first instant, J.
    pub fn energies(&self) -> Book {
        self.energies
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::account::Account;

    /// The rule is exact for a power that grows in proportion to time.
    #[test]
    fn powers_are_summed_from_the_first_instant() {
        let mut losses = Losses::default();
        let mut time = 0.0;
        for step in [0.5, 0.25, 0.125] {
            losses.advance(step, Book::EMPTY.with(Account::ViscousDissipation, 2.0 * time));
            time += step;
        }
        // The first instant counts from nothing: t² from 0 to the last one.
        let last = time - 0.125;
        let first_step = 0.5;
        let lost = losses.energies().get(Account::ViscousDissipation).unwrap();
        let by_hand = 0.5 * (2.0 * first_step) * 0.25 + 0.5 * (1.0 + 2.0 * last) * 0.125;
        assert_eq!(lost, by_hand);
    }
}
