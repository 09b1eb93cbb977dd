//! Measured data: restitutions from text with names and units, with the place of every error.
//!
//! ```text
//! quantity          20 cm ± 1 mm
//! data_error ─┬─ restitutions ─ pairs ──────── e(v) of one pair of bodies, or of several
//!             │
//!             └─ column_roles ─ csv_table ─┬── restitution_table
//!                speed_cm_s     CSV        ├── sweep_table: results of sweeps, values of swept keys
//!                layouts: as one table      └── moduli: storage and loss over frequency
//! ```
//!
//! Callers pass texts and their names; nothing is opened here.

mod cells;
mod column_roles;
mod csv_dialect;
mod csv_table;
mod data_error;
mod layouts;
mod library_data;
mod moduli;
mod pairs;
mod quantity;
mod rebounds;
mod restitution_table;
mod restitutions;
mod sweep_table;

pub(crate) use column_roles::{DROP_HEIGHTS, RESTITUTIONS, is_numbered};
pub use csv_dialect::decode;
pub use csv_table::{NumberColumn, Table};
pub use data_error::DataError;
pub use library_data::{is_of_library, library_table};
pub use moduli::{Modulus, ModulusPoint, ModulusTable, TestKind};
pub use pairs::{MeasuredPair, MeasuredPairs};
pub use quantity::{Kind, Measured, NotMeasured, impossible_restitution, parse_measured};
pub use rebounds::{Incidence, Rebound, ReboundQuantity, Rebounds};
pub use restitutions::{
    ACCEPTED_BOUNDS, MAX_RESTITUTION, MAX_UNCERTAINTY, Point, Restitutions, UncertaintyError,
    UnevenUncertainties,
};
pub use sweep_table::{COLUMNS, STATUS, TANGENTIAL, UNCERTAINTIES, energy_column, rows_below};
