//! Contact laws: fitted to restitutions, inverted for one restitution, ranked, and exported to DEM codes.
//!
//! ```text
//! parameter ─ law_fault ─ chosen_law ─┬─ law_fit ─ stored_fit
//! keys and                a case's    ├─ law_inversion
//! values as               law, what   ├─ law_ranking
//! text                    is given    └─ impact_curve ─ dem_export ─┬─ stored_export
//!                                        e(v), T(v)                └─ pair_export
//! ```

mod chosen_law;
mod dem_export;
mod impact_curve;
mod law_fault;
mod law_fit;
mod law_inversion;
mod law_ranking;
mod pair_export;
mod parameter;
mod stored_export;
mod stored_fit;

pub use chosen_law::{ChosenLaw, StandIn, family_of, model_of};
pub use dem_export::{DemExport, FittedLaw};
pub use impact_curve::ImpactCurve;
pub use law_fault::LawFault;
pub use law_fit::LawFit;
pub use law_inversion::{LawInversion, needs_more};
pub use law_ranking::{LawRanking, RankedLaw};
pub use pair_export::{FittedPair, PairExport, PairNumbers};
pub use parameter::{ParameterError, check_value, find_parameter, loss_parameter, parse_value};

pub use crate::fit::FitError;
pub use fem_laws::{EndRule, LawFamily};
