//! `[material.NAME.relaxation]`: Prony terms at the temperature of the case, and the files that name them.

use std::path::Path;

use fem_material::{PronySeries, PronyTerm, ShiftLaw, ZERO_CELSIUS};
use serde::Deserialize;

use super::Check;
use crate::case::text_at;
use crate::error::CaseError;
use crate::quantity::range::Range;
use crate::quantity::{Quantity, QuantityKind};
use crate::scene::body::MeasuredBand;
use crate::schema::{BandTable, CaseFile, RelaxationTable};
use crate::source::document::Document;
use crate::source::toml_syntax::{join, quote_key};

/// The keys of `shift`, of which one is given.
const LAWS: &str = "wlf, arrhenius or table";

/// Replaces the TOML files that relaxations name by their keys, so that a case does not depend on other files.
///
/// # Errors
/// A file that cannot be read or has another content, or keys beside `file`.
pub(crate) fn read_relaxation_files(
    document: &Document,
    file: &mut CaseFile,
    folder: &Path,
) -> Result<(), CaseError> {
    for (name, material) in &mut file.material {
        let Some(relaxation) = &mut material.relaxation else { continue };
        let Some(path) = relaxation.file.clone() else { continue };
        let key = join(&join("material", &quote_key(name)), "relaxation");
        let is_alone = *relaxation == RelaxationTable { file: Some(path.clone()), ..empty() };
        if !is_alone {
            let error = document.error_at(&key, "relaxation has file and other keys");
            return Err(error.with_help("the file has acts_on, terms and all other keys"));
        }
        let help = "fem-run relaxation writes such a file: acts_on = \"all\" and terms = [{ weight = 0.5, \
                    relaxation_time = \"1 ms\" }]";
        let fault =
            |message: String| document.error_at(&join(&key, "file"), message).with_help(help);
        let text = text_at(&folder.join(&path), &path)
            .map_err(|error| fault(format!("{path}: {}", error.message())))?;
        let read = toml::de::Deserializer::parse(&text).map(RelaxationTable::deserialize);
        let table = read.and_then(|table| table).map_err(|error| {
            let before = error.span().map_or("", |span| text.get(..span.start).unwrap_or(""));
            let line = 1 + before.matches('\n').count();
            fault(format!("{path}:{line}: {}", error.message()))
        })?;
        if table.file.is_some() {
            return Err(fault(format!("{path} names another file")));
        }
        *relaxation = table;
    }
    Ok(())
}

fn empty() -> RelaxationTable {
    RelaxationTable {
        file: None,
        acts_on: None,
        terms: Vec::new(),
        reference_temperature: None,
        shift: None,
        band: None,
        youngs_modulus: None,
        shear_modulus: None,
    }
}

/// A relaxation at the temperature of the case.
pub(super) struct CheckedRelaxation {
    pub terms: Vec<PronyTerm>,
    pub acts_on: fem_material::ActsOn,
    pub measured: MeasuredBand,
}

impl Check<'_> {
    /// Returns the relaxation of a material at the temperature of the case. `path` is that of the material.
    pub(super) fn relaxation(
        &self,
        path: &str,
        table: &RelaxationTable,
    ) -> Result<CheckedRelaxation, CaseError> {
        let at = |key: &str| format!("{path}.relaxation.{key}");
        let Some(acts_on) = table.acts_on else {
            let place = format!("{path}.relaxation");
            let error = self.error(&place, format!("the key `acts_on` is missing in {place}"));
            return Err(error.with_help("write acts_on = \"all\" or acts_on = \"shear\""));
        };
        let mut terms = self.relaxation_terms(path, table)?;
        let reference = table.reference_temperature.as_ref();
        let reference = self.optional(&at("reference_temperature"), reference, Range::POSITIVE)?;
        let law = self.shift_law(&at("shift"), table)?;
        let mut measured =
            MeasuredBand { reference_temperature: reference, ..MeasuredBand::default() };
        if let Some(band) = &table.band {
            self.band(&at("band"), band, &mut measured)?;
        }
        let (young, shear) = (table.youngs_modulus.as_ref(), table.shear_modulus.as_ref());
        measured.youngs_modulus = self.optional(&at("youngs_modulus"), young, Range::POSITIVE)?;
        measured.shear_modulus = self.optional(&at("shear_modulus"), shear, Range::POSITIVE)?;
        if let Some(law) = law {
            let Some(reference) = reference else {
                let error = self.error(&at("shift"), "shift needs reference_temperature");
                return Err(error.with_help("it is the temperature of the relaxation times"));
            };
            let temperature = self.temperature.unwrap_or(reference);
            let Some(log10) = law.log10_shift(temperature, reference) else {
                let message = format!(
                    "{path}.relaxation.shift has no value at the temperature {:.1} degC",
                    temperature - ZERO_CELSIUS
                );
                let help = "a table holds between its temperatures, and the law of Williams, Landel and Ferry on one side of its \
                            pole at reference_temperature - c2";
                return Err(self
                    .conflict(&at("shift"), &["scene.temperature"], message)
                    .with_help(help));
            };
            let factor = 10f64.powf(log10);
            for term in &mut terms {
                // Shifts may be of many decades.
                term.relaxation_time = (term.relaxation_time * factor).clamp(1e-300, 1e300);
            }
            measured.frequencies =
                measured.frequencies.map(|band| band.map(|frequency| frequency / factor));
            for row in &mut measured.loss_uncertainty {
                row.0 /= factor;
            }
            measured.temperature = Some(temperature);
            measured.shift = Some(law);
        }
        Ok(CheckedRelaxation { terms, acts_on: acts_on.into(), measured })
    }

    fn band(
        &self,
        path: &str,
        band: &BandTable,
        measured: &mut MeasuredBand,
    ) -> Result<(), CaseError> {
        let at = |key: &str| join(path, key);
        let from = self.number(&at("from"), &band.from, Range::POSITIVE)?;
        let to = self.number(&at("to"), &band.to, Range::POSITIVE)?;
        if to <= from {
            let error = self.error(&at("to"), "the band ends below its beginning");
            return Err(error.with_help("band.to is above band.from"));
        }
        measured.frequencies = Some([from, to]);
        let (rows, of) = (&band.loss_uncertainty, "frequencies");
        measured.loss_uncertainty = self.rows(&at("loss_uncertainty"), rows, of, Range::SHARE)?;
        Ok(())
    }

    fn shift_law(
        &self,
        path: &str,
        table: &RelaxationTable,
    ) -> Result<Option<ShiftLaw>, CaseError> {
        let Some(shift) = &table.shift else { return Ok(None) };
        let at = |key: &str| join(path, key);
        let law = match (&shift.wlf, &shift.arrhenius, &shift.table) {
            (Some(wlf), None, None) => {
                let c1 = self.number(&at("wlf.c1"), &wlf.c1, Range::ANY)?;
                let c2 = self.number(&at("wlf.c2"), &wlf.c2, Range::ANY)?;
                if c2 == 0.0 {
                    let error = self.error(&at("wlf.c2"), "c2 is 0");
                    return Err(error.with_help("c2 is a number of kelvin, such as 51.6"));
                }
                ShiftLaw::Wlf { c1, c2 }
            }
            (None, Some(arrhenius), None) => ShiftLaw::Arrhenius {
                activation_temperature: self.number(
                    &at("arrhenius.activation_temperature"),
                    &arrhenius.activation_temperature,
                    Range::NOT_NEGATIVE,
                )?,
            },
            (None, None, Some(rows)) => {
                ShiftLaw::Table(self.rows(&at("table"), rows, "temperatures", Range::ANY)?)
            }
            _ => {
                let error = self.error(path, "shift is exactly one law");
                return Err(error.with_help(format!("keep one of {LAWS}")));
            }
        };
        Ok(Some(law))
    }

    /// Returns the rows of a table over rising values > 0, which `what` names.
    fn rows<X: QuantityKind, Y: QuantityKind>(
        &self,
        path: &str,
        rows: &[(Quantity<X>, Quantity<Y>)],
        what: &str,
        allowed: Range,
    ) -> Result<Vec<(f64, f64)>, CaseError> {
        let mut points: Vec<(f64, f64)> = Vec::new();
        for (k, (x, y)) in rows.iter().enumerate() {
            let of = |part: usize| format!("{path}.{k}.{part}");
            let x = self.number(&of(0), x, Range::POSITIVE)?;
            let y = self.number(&of(1), y, allowed)?;
            if points.last().is_some_and(|last| x <= last.0) {
                let error = self.error(&of(0), format!("the {what} do not rise"));
                return Err(error.with_help("write the lowest first"));
            }
            points.push((x, y));
        }
        Ok(points)
    }
}

/// Returns an error if the case has a temperature on which nothing depends.
pub(super) fn check_temperature(check: &Check<'_>, file: &CaseFile) -> Result<(), CaseError> {
    let depends = |table: &RelaxationTable| table.shift.is_some();
    let mut relaxations = file.material.values().filter_map(|table| table.relaxation.as_ref());
    if check.temperature.is_some() && !relaxations.any(depends) {
        let error = check.error("scene.temperature", "no material depends on the temperature");
        return Err(error.with_help(
            "give a relaxation reference_temperature and shift, as fem-run relaxation finds them, or leave temperature out",
        ));
    }
    Ok(())
}

/// Creates the series of a relaxation; terms beyond seven in an octave of rates cost time and change nothing.
pub(super) fn series(
    checked: &CheckedRelaxation,
) -> Result<PronySeries, fem_material::MaterialError> {
    PronySeries::new(checked.terms.clone(), checked.acts_on).map(PronySeries::merged)
}
