//! The accounts of the energy ledger and the energy in each.
//!
//! ```math
//! \text{residual} = \sum \text{held} + \sum \text{lost} - E_0 - \sum \text{given}
//! ```
//!
//! An account is one variant here and one line in [`LINES`]; summaries, histories, sweeps and
//! reports read it from there. The part of a model that computes the energy fills it. An account
//! that the model does not fill is blank in a history and null in a summary, or absent from both
//! ([`ShownIn`]).

use serde::{Deserialize, Serialize};

/// A form of energy in the balance of a collision.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize, Deserialize)]
pub enum Account {
    /// Kinetic energy of the bodies without walls; for a half-space relative to its far boundary.
    Kinetic,
    /// Strain energy of the bodies, or energy in the spring of a contact law.
    Strain,
    /// Energy in the springs of a penalty contact.
    Contact,
    /// Energy dissipated by relaxation of the bodies, or by the dashpot of a contact law.
    ViscousDissipation,
    /// Work done by a moving wall, or at the far boundary of a moving half-space.
    WallWork,
    /// Energy dissipated by the artificial bulk viscosity of elements.
    BulkViscosity,
    /// Energy dissipated by the dashpots of a penalty contact.
    ContactDamping,
    /// Energy radiated by waves that do not return, in models without elastic waves of their own.
    Radiated,
    /// Potential energy of the upper body: m g times the height of its mass centre above that at
    /// first touch.
    Potential,
    /// Energy that earlier contacts left in the bodies, in vibrations and in stress that had not
    /// relaxed. The next contact is computed as if the bodies were at rest.
    LeftBefore,
    /// Kinetic energy of the separation that adhesion prevents.
    Adhesion,
    /// Energy dissipated by plastic flow.
    PlasticWork,
    /// Energy given to the bending waves of a plate, in models without elastic waves of their own.
    Plate,
    /// Work of friction between surfaces that slide on each other.
    Friction,
    /// Energy dissipated by relaxation under the tangential force of an oblique impact.
    TangentialRelaxation,
}

/// The side of the energy balance on which an account is entered.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum BalanceSide {
    /// Energy stored in the bodies, which can be recovered.
    Held,
    /// Energy that has been dissipated.
    Lost,
    /// Energy supplied from outside.
    Given,
}

/// The result files in which an account appears.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ShownIn {
    /// The account appears in every summary and every history.
    Always,
    /// The account appears in every summary and in no history.
    InSummary,
    /// The account belongs to an optional effect and appears only in the results of collisions that
    /// fill it. Its column follows those that every history has.
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
    (Account::Adhesion, "adhesion", BalanceSide::Lost, ShownIn::WhereFilled),
    (Account::PlasticWork, "plastic_work", BalanceSide::Lost, ShownIn::WhereFilled),
    (Account::Plate, "plate", BalanceSide::Lost, ShownIn::WhereFilled),
    (Account::Friction, "friction", BalanceSide::Lost, ShownIn::InSummary),
    (Account::TangentialRelaxation, "tangential_relaxation", BalanceSide::Lost, ShownIn::InSummary),
];

impl Account {
    /// Returns all accounts in the order of the balance.
    pub fn all() -> impl Iterator<Item = Self> {
        LINES.iter().map(|(account, ..)| *account)
    }

    /// Returns the name used in result files, without the unit.
    pub fn name(self) -> &'static str {
        LINES[self as usize].1
    }

    /// Returns the side of the balance on which the account is entered.
    pub fn side(self) -> BalanceSide {
        LINES[self as usize].2
    }

    /// Returns the result files in which the account appears.
    pub fn shown(self) -> ShownIn {
        LINES[self as usize].3
    }
}

/// Returns the key of an account in files, with its unit.
pub fn energy_key(account: Account) -> String {
    format!("{}_j", account.name())
}

/// Energy in each account, J, or power into each account, W.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct EnergyLedger([Option<f64>; LINES.len()]);

impl EnergyLedger {
    /// A ledger without any filled account.
    pub const EMPTY: Self = Self([None; LINES.len()]);

    /// Adds energy (J) to an account.
    #[inline]
    pub fn add(&mut self, account: Account, energy: f64) {
        let entry = &mut self.0[account as usize];
        *entry = Some(entry.map_or(energy, |there| there + energy));
    }

    /// Returns this ledger with an energy (J) added to an account.
    #[must_use]
    #[inline]
    pub fn with(mut self, account: Account, energy: f64) -> Self {
        self.add(account, energy);
        self
    }

    /// Returns the sum of this ledger and another one.
    #[must_use]
    pub fn and(self, other: &Self) -> Self {
        other.entries().fold(self, |ledger, (account, energy)| ledger.with(account, energy))
    }

    /// Returns the energy in an account, or `None` if the model does not fill it.
    pub fn get(&self, account: Account) -> Option<f64> {
        self.0[account as usize]
    }

    /// Returns the filled accounts and their energies in the order of the balance.
    pub fn entries(&self) -> impl Iterator<Item = (Account, f64)> {
        Account::all().zip(self.0).filter_map(|(account, energy)| Some((account, energy?)))
    }

    /// Returns whether an account is filled.
    pub fn has(&self, account: Account) -> bool {
        self.get(account).is_some()
    }

    /// Returns the energy in all accounts of a side, J, or `None` if none of them is filled.
    pub fn total(&self, side: BalanceSide) -> Option<f64> {
        self.on(side).reduce(|sum, energy| sum + energy)
    }

    /// Returns the energy residual, J: stored + dissipated − initial − external work.
    pub fn residual(&self, initial: f64) -> f64 {
        let stored_and_dissipated = self.on(BalanceSide::Held).chain(self.on(BalanceSide::Lost));
        let total = stored_and_dissipated.fold(0.0, |sum, energy| sum + energy);
        self.on(BalanceSide::Given).fold(total - initial, |left, energy| left - energy)
    }

    /// Returns the energies on a side in the order of the balance.
    fn on(&self, side: BalanceSide) -> impl Iterator<Item = f64> {
        let own = self.entries().filter(move |(account, _)| account.side() == side);
        own.map(|(_, energy)| energy)
    }
}

/// Running sums of the dissipated energies.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct DissipatedEnergies {
    energies: EnergyLedger,
    power: Option<EnergyLedger>,
}

impl DissipatedEnergies {
    /// Adds the dissipation of a time step (s) that ends with these powers (W).
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

    /// Returns the energies dissipated since the first instant, J.
    pub fn energies(&self) -> EnergyLedger {
        self.energies
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// `name` and `side` use the number of an account as its index in the table.
    #[test]
    fn ledger_lines_are_in_the_order_of_the_accounts() {
        for (k, (account, ..)) in LINES.iter().enumerate() {
            assert_eq!(*account as usize, k);
        }
    }

    #[test]
    fn residual_is_held_energy_minus_supplied_energy() {
        let mut ledger =
            EnergyLedger::EMPTY.with(Account::Kinetic, 3.0).with(Account::WallWork, 0.5);
        assert_eq!(ledger.residual(2.5), 0.0);
        ledger.add(Account::ViscousDissipation, 0.25);
        ledger.add(Account::Kinetic, -0.5);
        assert_eq!(ledger.residual(2.5), -0.25);
        assert_eq!(ledger.get(Account::Kinetic), Some(2.5));
        assert_eq!(ledger.get(Account::Strain), None);
        assert_eq!(ledger.entries().count(), 3);
        assert_eq!(ledger.total(BalanceSide::Held), Some(2.5));
        assert_eq!(EnergyLedger::EMPTY.total(BalanceSide::Held), None);
        assert!(ledger.with(Account::Strain, f64::NAN).residual(1.0).is_nan());
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
