//! The accounts of energy as files show them: their keys, columns and order.
//!
//! All of it follows from the table of [`Account`].

use fem_collision::{Account, EnergyLedger, ShownIn};
use serde::ser::{Serialize, SerializeMap, Serializer};

/// The ledger at the end of a run, J; `None` is written as `null`.
#[derive(Clone, Debug, serde::Serialize)]
pub struct Energy {
    /// At the start, walls not counted.
    pub initial_j: Option<f64>,
    /// Energy of each account, under [`energy_key`].
    #[serde(flatten)]
    pub accounts: Accounts,
    /// Energy residual: stored + dissipated − initial − external work.
    pub residual_j: Option<f64>,
    /// Worst imbalance over the run / initial kinetic energy in the centre-of-mass frame.
    pub residual_relative: Option<f64>,
}

impl Energy {
    /// Energy of an account at the end, in joules.
    pub fn get(&self, account: Account) -> Option<f64> {
        self.accounts.0.get(account)
    }
}

/// What is in each account at the end, J: a key an account, `null` where nobody fills it, and no key
/// where an account that is shown where it is filled is not.
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

/// The name of an account in files, with its unit.
pub fn energy_key(account: Account) -> String {
    format!("{}_j", account.name())
}

/// The accounts that the summary of this book shows.
fn in_summary(book: &EnergyLedger, shown: fn(Account) -> ShownIn) -> impl Iterator<Item = Account> {
    Account::all()
        .filter(move |account| shown(*account) != ShownIn::WhereFilled || book.has(*account))
}

/// The accounts that a history of these books has a column of: those that every history has, and
/// those that only this one has.
#[cfg(feature = "files")]
pub(super) fn in_history<'b>(
    books: impl Iterator<Item = &'b EnergyLedger> + Clone,
    shown: fn(Account) -> ShownIn,
) -> [Vec<Account>; 2] {
    let is_filled = |account: &Account| books.clone().any(|book| book.has(*account));
    let those = |kind| Account::all().filter(move |account| shown(*account) == kind);
    [those(ShownIn::Always).collect(), those(ShownIn::WhereFilled).filter(is_filled).collect()]
}

#[cfg(test)]
mod tests {
    use super::*;

    /// An effect that stores what the springs of a contact do.
    fn made_up(account: Account) -> ShownIn {
        if account == Account::Contact { ShownIn::WhereFilled } else { account.shown() }
    }

    #[test]
    fn an_effect_that_is_off_leaves_no_word() {
        let off = EnergyLedger::EMPTY.with(Account::Kinetic, 1.0);
        let on = off.with(Account::Contact, 0.0);
        let has = |book| in_summary(book, made_up).any(|account| account == Account::Contact);
        assert!(!has(&off) && has(&on));
        // What every summary shows is there, filled or not.
        let n_always = |shown: fn(Account) -> ShownIn| {
            Account::all().filter(|account| shown(*account) != ShownIn::WhereFilled).count()
        };
        assert_eq!(in_summary(&off, made_up).count(), n_always(made_up));
        assert_eq!(in_summary(&off, Account::shown).count(), n_always(Account::shown));
    }

    #[cfg(feature = "files")]
    #[test]
    fn a_history_has_a_column_of_an_effect_that_fills_one_row() {
        let off = EnergyLedger::EMPTY.with(Account::Kinetic, 1.0);
        let on = off.with(Account::Contact, 0.5);
        let every = vec![Account::Kinetic, Account::Strain, Account::ViscousDissipation];
        let columns = |books: [&EnergyLedger; 2]| in_history(books.into_iter(), made_up);
        assert_eq!(columns([&off, &off]), [every.clone(), Vec::new()]);
        assert_eq!(columns([&off, &on]), [every, vec![Account::Contact]]);
    }
}
