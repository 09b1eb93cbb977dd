//! Keys, columns and order of the energy accounts in files. They follow from the table of [`Account`].

use fem_collision::{Account, EnergyLedger, ShownIn, energy_key};
use serde::ser::{Serialize, SerializeMap, Serializer};

/// The ledger at the end of a run, J; `None` is written as `null`.
#[derive(Clone, Debug, serde::Serialize)]
pub struct Energy {
    /// Energy at the start, without that of walls.
    pub initial_j: Option<f64>,
    /// Energy of each account, under [`energy_key`].
    #[serde(flatten)]
    pub accounts: Accounts,
    /// Elastic energy of the residual stress of bodies that flowed, a part of the strain energy; without it none flowed.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub locked_in_j: Option<f64>,
    /// Energy of a plate of elements, a part of kinetic and strain energy; other models have it as an account.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub plate_j: Option<f64>,
    /// Energy residual: stored + dissipated − initial − external work.
    pub residual_j: Option<f64>,
    /// Largest residual of the run over the initial kinetic energy in the centre-of-mass frame.
    pub residual_relative: Option<f64>,
}

impl Energy {
    /// Returns the energy of an account at the end, J.
    pub fn get(&self, account: Account) -> Option<f64> {
        self.accounts.0.get(account)
    }
}

/// Energy of each account at the end, J. Each account has a key; an account that is not computed is `null`, or left out if
/// it is shown only if filled.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Accounts(pub EnergyLedger);

impl Serialize for Accounts {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let mut map = serializer.serialize_map(None)?;
        for account in in_summary(&self.0, Account::shown) {
            map.serialize_entry(&energy_key(account), &self.0.get(account))?;
        }
        map.end()
    }
}

/// Returns the accounts that the summary of this ledger shows.
fn in_summary(
    ledger: &EnergyLedger,
    shown: fn(Account) -> ShownIn,
) -> impl Iterator<Item = Account> {
    Account::all()
        .filter(move |account| shown(*account) != ShownIn::WhereFilled || ledger.has(*account))
}

/// Returns the accounts with a column in a history of these ledgers: those of every history, and those that only this one
/// has.
#[cfg(feature = "files")]
pub(super) fn in_history<'l>(
    ledgers: impl Iterator<Item = &'l EnergyLedger> + Clone,
    shown: fn(Account) -> ShownIn,
) -> [Vec<Account>; 2] {
    let is_filled = |account: &Account| ledgers.clone().any(|ledger| ledger.has(*account));
    let those = |kind| Account::all().filter(move |account| shown(*account) == kind);
    [those(ShownIn::Always).collect(), those(ShownIn::WhereFilled).filter(is_filled).collect()]
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Stands in for [`Account::shown`]: the contact's account is shown only if it is filled.
    fn contact_where_filled(account: Account) -> ShownIn {
        if account == Account::Contact { ShownIn::WhereFilled } else { account.shown() }
    }

    #[test]
    fn an_effect_that_is_off_has_no_key() {
        let off = EnergyLedger::EMPTY.with(Account::Kinetic, 1.0);
        let on = off.with(Account::Contact, 0.0);
        let has = |ledger| {
            in_summary(ledger, contact_where_filled).any(|account| account == Account::Contact)
        };
        assert!(!has(&off) && has(&on));
        // Accounts that every summary shows are there, filled or not.
        let n_always = |shown: fn(Account) -> ShownIn| {
            Account::all().filter(|account| shown(*account) != ShownIn::WhereFilled).count()
        };
        assert_eq!(in_summary(&off, contact_where_filled).count(), n_always(contact_where_filled));
        assert_eq!(in_summary(&off, Account::shown).count(), n_always(Account::shown));
    }

    #[cfg(feature = "files")]
    #[test]
    fn a_history_has_a_column_of_an_effect_that_fills_one_row() {
        let off = EnergyLedger::EMPTY.with(Account::Kinetic, 1.0);
        let on = off.with(Account::Contact, 0.5);
        let every = vec![Account::Kinetic, Account::Strain, Account::ViscousDissipation];
        let columns =
            |books: [&EnergyLedger; 2]| in_history(books.into_iter(), contact_where_filled);
        assert_eq!(columns([&off, &off]), [every.clone(), Vec::new()]);
        assert_eq!(columns([&off, &on]), [every, vec![Account::Contact]]);
    }
}
