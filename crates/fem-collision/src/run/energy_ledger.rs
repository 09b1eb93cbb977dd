//! The accounts of the energy ledger, and what is in them.
//!
//! ```math
//! \text{residual} = \sum \text{held} + \sum \text{lost} - E_0 - \sum \text{given}
//! ```
//!
//! An account is one variant here and one line in [`LINES`], from which summaries, histories, sweeps
//! and reports take it; what fills it is the part of a model that knows the energy. An account that
//! nobody fills is blank in a history and null in a summary, or absent from both: [`ShownIn`].

use serde::{Deserialize, Serialize};

/// A place where the energy of a collision can be.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize, Deserialize)]
pub enum Account {
    /// Motion of the bodies, walls not counted; of a half-space relative to what is far away.
    Kinetic,
    /// Deformation of the bodies, or the spring of a contact law.
    Strain,
    /// Springs of a penalty contact.
    Contact,
    /// Relaxation of the bodies, or the dashpot of a contact law.
    ViscousDissipation,
    /// Work of a moving wall, or of a half-space that moves far away.
    WallWork,
    /// Artificial viscosity of elements.
    BulkViscosity,
    /// Dashpots of a penalty contact.
    ContactDamping,
    /// Waves that leave a body for good, of a model without the body's own waves.
    Radiated,
    /// Weight of the upper body: m g times the height of its mass centre above that at first touch.
    Potential,
    /// What earlier contacts have left in the bodies, vibrations and all that had not relaxed yet: the
    /// next contact is computed as if they were at rest.
    LeftBefore,
}

/// On which side of the balance an account stands.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum BalanceSide {
    /// The bodies have it and can give it back.
    Held,
    /// It has left them for good.
    Lost,
    /// It has come to them from outside.
    Given,
}

/// Which files show an account.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ShownIn {
    /// Every summary and every history.
    Always,
    /// Every summary, and no history.
    InSummary,
    /// The summary, history and report of a collision that fills it, and no other: the account of an
    /// effect. Its column stands behind those that every history has.
    WhereFilled,
}

/// Each account, its name in files, its side, the files that show it; in the order in which a balance
/// adds them up.
const LINES: &[(Account, &str, BalanceSide, ShownIn)] = &[
    (Account::Kinetic, "kinetic", BalanceSide::Held, ShownIn::Always),
    (Account::Strain, "strain", BalanceSide::Held, ShownIn::Always),
    (Account::Contact, "contact", BalanceSide::Held, ShownIn::Always),
    (Account::ViscousDissipation, "viscous_dissipation", BalanceSide::Lost, ShownIn::Always),
    (Account::WallWork, "wall_work", BalanceSide::Given, ShownIn::InSummary),
    (Account::BulkViscosity, "bulk_viscosity", BalanceSide::Lost, ShownIn::WhereFilled),
    (Account::ContactDamping, "contact_damping", BalanceSide::Lost, ShownIn::WhereFilled),
    (Account::Radiated, "radiated", BalanceSide::Lost, ShownIn::WhereFilled),
    (Account::Potential, "potential", BalanceSide::Held, ShownIn::WhereFilled),
    (Account::LeftBefore, "left_before", BalanceSide::Held, ShownIn::WhereFilled),
];

impl Account {
    /// All of them, in the order of a balance.
    pub fn all() -> impl Iterator<Item = Self> {
        LINES.iter().map(|(account, ..)| *account)
    }

    /// Its name in files, without the unit.
    pub fn name(self) -> &'static str {
        LINES[self as usize].1
    }

    /// Its side of the balance.
    pub fn side(self) -> BalanceSide {
        LINES[self as usize].2
    }

    /// Which files show it.
    pub fn shown(self) -> ShownIn {
        LINES[self as usize].3
    }
}

/// What is in each account, J; or the power that goes into each, W.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct EnergyLedger([Option<f64>; LINES.len()]);

impl EnergyLedger {
    /// Nothing in any account.
    pub const EMPTY: Self = Self([None; LINES.len()]);

    /// Puts energy (J) into an account beside what is there.
    #[inline]
    pub fn add(&mut self, account: Account, energy: f64) {
        let entry = &mut self.0[account as usize];
        *entry = Some(entry.map_or(energy, |there| there + energy));
    }

    /// This book with an energy (J) put into an account beside what is there.
    #[must_use]
    #[inline]
    pub fn with(mut self, account: Account, energy: f64) -> Self {
        self.add(account, energy);
        self
    }

    /// This book with what is in another one beside what is there.
    #[must_use]
    pub fn and(self, other: &Self) -> Self {
        other.entries().fold(self, |book, (account, energy)| book.with(account, energy))
    }

    /// What is in an account; `None` of one that nobody fills.
    pub fn get(&self, account: Account) -> Option<f64> {
        self.0[account as usize]
    }

    /// The accounts that are filled, and what is in them, in the order of a balance.
    pub fn entries(&self) -> impl Iterator<Item = (Account, f64)> {
        Account::all().zip(self.0).filter_map(|(account, energy)| Some((account, energy?)))
    }

    /// Whether an account is filled.
    pub fn has(&self, account: Account) -> bool {
        self.get(account).is_some()
    }

    /// What is in all accounts of a side, J; `None` if none of them is filled.
    pub fn total(&self, side: BalanceSide) -> Option<f64> {
        let own = self.entries().filter(|(account, _)| account.side() == side);
        own.map(|(_, energy)| energy).reduce(|sum, energy| sum + energy)
    }

    /// What does not add up, J: held and lost less what was there at the start (J) and what was given
    /// since.
    pub fn residual(&self, initial: f64) -> f64 {
        let on = |side: BalanceSide| {
            let own = self.entries().filter(move |(account, _)| account.side() == side);
            own.map(|(_, energy)| energy)
        };
        let total = on(BalanceSide::Held)
            .chain(on(BalanceSide::Lost))
            .fold(0.0, |sum, energy| sum + energy);
        on(BalanceSide::Given).fold(total - initial, |left, energy| left - energy)
    }
}

/// Running sums of lost energies.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct DissipatedEnergies {
    energies: EnergyLedger,
    power: Option<EnergyLedger>,
}

impl DissipatedEnergies {
    /// Takes the powers (W) at an instant, so long after the last one (s).
    #[inline]
    pub fn advance(&mut self, time: f64, power: EnergyLedger) {
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
    pub fn energies(&self) -> EnergyLedger {
        self.energies
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// `name` and `side` index the table by the variant.
    #[test]
    fn lines_are_in_the_order_of_the_variants() {
        for (k, (account, ..)) in LINES.iter().enumerate() {
            assert_eq!(*account as usize, k);
        }
    }

    #[test]
    fn the_residual_is_what_held_lost_and_given_leave() {
        let mut book = EnergyLedger::EMPTY.with(Account::Kinetic, 3.0).with(Account::WallWork, 0.5);
        assert_eq!(book.residual(2.5), 0.0);
        book.add(Account::ViscousDissipation, 0.25);
        book.add(Account::Kinetic, -0.5);
        assert_eq!(book.residual(2.5), -0.25);
        assert_eq!(book.get(Account::Kinetic), Some(2.5));
        assert_eq!(book.get(Account::Strain), None);
        assert_eq!(book.entries().count(), 3);
        assert_eq!(book.total(BalanceSide::Held), Some(2.5));
        assert_eq!(EnergyLedger::EMPTY.total(BalanceSide::Held), None);
    }

    #[test]
    fn what_is_no_number_stays_in_the_residual() {
        let book = EnergyLedger::EMPTY.with(Account::Kinetic, 1.0).with(Account::Strain, f64::NAN);
        assert!(book.residual(1.0).is_nan());
    }

    /// The rule is exact for a power that grows in proportion to time.
    #[test]
    fn powers_are_summed_from_the_first_instant() {
        let mut losses = DissipatedEnergies::default();
        let mut time = 0.0;
        for step in [0.5, 0.25, 0.125] {
            losses.advance(step, EnergyLedger::EMPTY.with(Account::ViscousDissipation, 2.0 * time));
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
