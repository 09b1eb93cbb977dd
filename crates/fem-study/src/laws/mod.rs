//! Contact laws: fitted to restitutions, inverted for one restitution, ranked, and exported to DEM codes.
//!
//! ```text
//! law_fault ─ chosen_law ─┬─ law_fit ─ stored
//!             a case's    ├─ law_inversion
//!             law, what   ├─ law_ranking
//!             is given    └─ impact_curve ─ dem_export ─┬─ stored
//!                            e(v), T(v)                └─ pair_export
//! ```
//!
//! ```
//! use fem_case::schema::{BodyTable, MaterialTable};
//! use fem_case::{Case, CaseFile};
//! use fem_study::laws::{ChosenLaw, DemExport, ImpactCurve, LawFamily, LawFit, LawInversion};
//! use fem_data::table::Restitutions;
//!
//! let ice = MaterialTable::from_youngs_modulus_poissons_ratio("917 kg/m^3", "9.3 GPa", 0.33);
//! let ball = BodyTable::sphere("ball", "2 cm", "ice").approaching("0.1 m/s");
//! let case =
//!     Case::of(CaseFile::of_bodies(BodyTable::wall("floor"), ball).with_material("ice", ice))?;
//! let measured = Restitutions::of("ice", &[(0.05, 0.7), (0.1, 0.62), (0.2, 0.55), (0.4, 0.45)]);
//!
//! // The dissipation of a law with a given exponent, fitted to the data.
//! let law = ChosenLaw::of(&case, LawFamily::BordbarHyppanen, &[("n", 0.65)], None)?;
//! let fit = LawFit::of(&measured, law.problem(&measured.points, &["a"])?, 0.95)?;
//! assert!(fit.fit.rms < 0.05 && fit.fit.estimates[0].key == "a");
//!
//! // The damping coefficient that makes e = 0.9 at 0.1 m/s.
//! let law = ChosenLaw::of(&case, LawFamily::Tsuji, &[], None)?;
//! let found = LawInversion::of(&law, None, 0.1, 0.9)?;
//! let [(alpha, _)] = found.solutions()[..] else { panic!("one solution") };
//! assert_eq!(found.parameter().key, "alpha");
//! assert!((found.model.outcome(&[alpha], 0.1)?.restitution - 0.9).abs() < 1e-8);
//!
//! // Input of DEM codes.
//! let curve = ImpactCurve::measured(case.scene(), &measured)?;
//! let export = DemExport::of(&case, curve, 0.01)?.export;
//! assert!((export.restitution - 0.58).abs() < 1e-6);
//! assert!(export.snippets()?.iter().any(|snippet| snippet.code == "LAMMPS"));
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod chosen_law;
mod computed_curve;
mod dem_export;
mod friction_fit;
mod impact_curve;
mod law_fault;
mod law_fit;
mod law_inversion;
mod law_ranking;
mod pair_export;
mod pair_law;
mod stored;
mod stored_fit;

pub(crate) use chosen_law::plate_of;
pub use chosen_law::{ChosenLaw, StandIn, family_of, model_of, strength_words};
pub use dem_export::{DemExport, FittedLaw};
pub use fem_data::estimate::{
    ParameterError, check_value, find_parameter, loss_parameter, parse_value,
};
pub use friction_fit::{FrictionFit, FrictionRow, PatchMotion};
pub use impact_curve::ImpactCurve;
pub use law_fault::LawFault;
pub use law_fit::LawFit;
pub use law_inversion::{LawInversion, needs_more};
pub use law_ranking::{LawRanking, RankedLaw};
pub use pair_export::{FittedPair, PairExport, PairNumbers};
pub use pair_law::LawExport;
pub use stored_fit::{RestitutionBand, StoredFit};

pub use fem_data::estimate::FitError;
pub use fem_laws::{EndRule, LawFamily};
