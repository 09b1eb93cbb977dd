//! Case files: reads TOML with units into a validated scene, and writes it back.
//!
//! ```text
//! text, overrides ─ document ─ schema ─ validate ─ Scene
//!                   merged     CaseFile  units, limits,
//!                   tree with  as        names
//!                   positions  written
//!                              or made
//!                              in code
//! ```
//!
//! The cost of a scene, its effects and the collision itself belong to other crates. Cases from text and from code
//! ([`Case::of`], [`Case::edited`]) are validated alike. A body's `material = "lib:NAME"` comes from [`library`].
//!
//! Every fault is a [`CaseError`] with file (or override), line, column, the value that was found and the allowed values.
//! [`Case::load`] reads a file, [`Case::of`] takes a [`CaseFile`] made in code, and [`Case::edited`] changes a case. Faults
//! of code have a key instead of file and line:
//!
//! ```
//! # use std::path::Path;
//! let case = fem_case::Case::parse(
//!     "ball.toml",
//!     r#"
//!     [material.glass]
//!     density = "2.39 g/cm^3"
//!     youngs_modulus = "63 GPa"
//!     poissons_ratio = 0.244
//!
//!     [[body]]
//!     name = "ball"
//!     sphere = { diameter = "22.2 mm" }
//!     material = "glass"
//!     approach_speed = "50 cm/s"
//!
//!     [[body]]
//!     name = "floor"
//!     wall = {}
//!     "#,
//!     Path::new("."),
//!     &["body.0.sphere.diameter='1 cm'".to_string()],
//! )?;
//! assert_eq!(case.scene().title(), "ball, but diameter = 1 cm");
//! assert_eq!(case.scene().bodies()[0].diameter(), Some(0.01));
//! assert_eq!(case.scene().bodies()[0].velocity(), 0.5);
//!
//! let error = case.error_at("body.0.sphere.diameter", "too small for the mesh");
//! assert_eq!(error.source_name(), "--set body.0.sphere.diameter=…");
//! # Ok::<(), fem_case::CaseError>(())
//! ```

mod case;
mod case_edit;
mod error;
pub mod library;
mod quantity;
mod scene;
pub mod schema;
mod source;
mod sweep;
#[cfg(all(test, feature = "schema"))]
mod tests;
mod validate;

/// The JSON schema of case files, for editors that complete keys and mark errors.
pub const CASE_SCHEMA: &str = include_str!("../schemas/case.json");
/// The JSON schema of sweep files.
pub const SWEEP_SCHEMA: &str = include_str!("../schemas/sweep.json");

pub use case::{Case, read_data_file, text_at};
pub use case_edit::{central_change, half_difference};
pub use error::CaseError;
pub use fem_material::engineering;
pub use quantity::uncertain::parse_temperature;
pub use quantity::units::{Dimension, UnitError, parse_quantity};
pub use quantity::{
    Acceleration, Angle, Bytes, Count, Damping, Density, Length, Mass, Number, Quantity,
    QuantityError, QuantityInfo, QuantityKind, Rate, Speed, Stiffness, Stress, SurfaceEnergy, Time,
    Viscosity,
};
pub use scene::body::{Body, MeasuredBand, Plate, Shape};
pub use scene::defaults;
pub use scene::model::{CondensedOptions, ModelChoice};
pub use scene::plausibility::MAX_MODULUS_OF_POLYMERS;
pub use scene::{
    Accuracy, Gravity, Limits, MeshSettings, Probe, Scene, Snapshots, UncertainInput,
    WorkOfAdhesion, impact_speed,
};
pub use schema::{
    CaseFile, ContactMethod, EffectsTable, Field, PlateSupport, SnapshotLabel, Spot, Switch,
};
pub use source::changes::readable_name;
pub use source::nearest;
pub use sweep::Sweep;
pub use sweep::axes::{Axis, AxisValue, SweptKey};
pub use sweep::file::{Combine, Keep, PlotTable};
pub use sweep::values::{ReadRows, RowsFault};
