//! Everything that is drawn or laid out from results.
//!
//! ```text
//! result folder ── report ─────────┐
//! collision ────── section_view ───┼─ fem-figure ─ SVG, in HTML pages or alone
//! sweep's members ─ sweep ─────────┤
//! fits, exports ── law_figures ────┤
//! records ──────── record_figures ─┤
//! moduli ───────── relaxation_figure
//! accuracy study ─ accuracy ───────┘
//! ```
//!
//! [`report`] makes the report page of one run and the comparison of several, [`sweep`] the figure of a sweep, [`answer`] the cells of its table,
//! [`law_figures`] those of fits, calibrations and exports, [`record_figures`] those of measured records, [`relaxation_figure`] that of a Prony series from moduli, [`accuracy`] the page, table and figure of an accuracy
//! study. [`section_view`] draws the axial stress in both
//! bodies, for the report page, for a failed run and for the page in the browser. Nothing is computed
//! here but Hertz' curves.

#[cfg(feature = "files")]
pub mod accuracy;
pub mod answer;
pub mod law_figures;
pub mod number_text;
pub mod quantity_axis;
#[cfg(feature = "files")]
pub mod record_figures;
#[cfg(feature = "files")]
pub mod relaxation_figure;
#[cfg(feature = "files")]
pub mod report;
pub mod section_view;
pub mod sweep;
