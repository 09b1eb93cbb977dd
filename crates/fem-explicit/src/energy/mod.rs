//! The balance of energy and momentum.
//!
//! ```text
//! ledger        balance of sampled instants, residuals
//! contact_work  the share of the contact, at every step
//! nodal_sums    sums over the nodes of a body
//! ```

mod contact_work;
mod ledger;
mod nodal_sums;

pub(crate) use contact_work::held_by;
pub(crate) use ledger::{EnergyGrowth, Ledger};
