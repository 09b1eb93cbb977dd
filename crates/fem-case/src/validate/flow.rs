//! `[material.NAME.flow]`: the flow rule of a material, and the CSV files of flow stress that it may name.

use std::path::Path;

use fem_material::engineering::show;
use fem_material::{FlowPoint, FlowRule, Hardening, MaterialError, RateFactor};

use super::Check;
use crate::case::text_at;
use crate::error::CaseError;
use crate::quantity::range::Range;
use crate::quantity::{Number, Quantity, Stress};
use crate::scene::plausibility::YIELD_STRENGTHS;
use crate::schema::{CaseFile, FlowPoints, FlowTable, HardeningTable, RateTable};
use crate::source::document::Document;
use crate::source::toml_syntax::{join, quote_key};

/// Relative difference of two yield strengths that are the same number with different roundings.
const ROUNDING: f64 = 1e-6;

/// Replaces the CSV files that flow rules name by their rows, so that a case does not depend on other files.
///
/// # Errors
/// A file that cannot be read, or whose rows are not pairs of plastic strain and flow stress.
pub(crate) fn read_flow_tables(
    document: &Document,
    file: &mut CaseFile,
    folder: &Path,
) -> Result<(), CaseError> {
    for (name, material) in &mut file.material {
        let hardening = material.flow.as_mut().and_then(|flow| flow.hardening.as_mut());
        let Some(HardeningTable { table: Some(points), .. }) = hardening else { continue };
        let FlowPoints::File(path) = points else { continue };
        let key = join(&join("material", &quote_key(name)), "flow.hardening.table");
        let rows = rows_of(&folder.join(&*path), path)
            .map_err(|(message, help)| document.error_at(&key, message).with_help(help))?;
        *points = FlowPoints::Rows(rows);
    }
    Ok(())
}

type Row = (Quantity<Number>, Quantity<Stress>);

/// Returns the rows of a CSV file of plastic strain and flow stress, or a message with its help.
fn rows_of(path: &Path, name: &str) -> Result<Vec<Row>, (String, String)> {
    let help = "a CSV file has a header such as plastic_strain,flow_stress_mpa and two numbers a line, separated by \
                commas, semicolons, tabs or blanks";
    let fault = |message: String| (format!("{name}{message}"), help.to_string());
    let text = text_at(path, name).map_err(|error| fault(format!(": {}", error.message())))?;
    let lines = text.lines().enumerate().map(|(k, line)| (k + 1, line.trim()));
    let mut lines = lines.filter(|(_, line)| !line.is_empty() && !line.starts_with('#'));
    let Some((n_header, header)) = lines.next() else {
        return Err(fault(" is empty".to_string()));
    };
    let separator = [';', '\t', ',', ' '].into_iter().find(|c| header.contains(*c));
    let has_decimal_commas = separator != Some(',');
    let cells = |line: &str| -> Vec<String> {
        let parts = line.split(|c| separator.is_some_and(|separator| c == separator));
        let cells = parts.map(|cell| cell.trim().trim_matches('"')).filter(|cell| !cell.is_empty());
        let with_point = |cell: &str| match has_decimal_commas && !cell.contains('.') {
            true => cell.replacen(',', ".", 1),
            false => cell.to_string(),
        };
        cells.map(with_point).collect()
    };
    let header = cells(header);
    let [strain, stress] = header.as_slice() else {
        return Err(fault(format!(":{n_header} has {} columns, not two", header.len())));
    };
    if strain.parse::<f64>().is_ok() {
        return Err(fault(format!(":{n_header} is of numbers: there is no header")));
    }
    let [strain_unit, stress_unit] = [strain, stress].map(|header| unit_of(header));
    let rows = lines.map(|(n, line)| {
        let cells = cells(line);
        let [strain, stress] = cells.as_slice() else {
            return Err(fault(format!(":{n} has {} cells, not two", cells.len())));
        };
        let text = |cell: &str, unit: &str| format!("{cell} {unit}").trim_end().to_string();
        let strain: Quantity<Number> = match (strain_unit.as_str(), strain.parse::<f64>()) {
            ("%", Ok(value)) => Quantity::from_si(value / 100.0),
            ("", Ok(value)) => Quantity::from_si(value),
            _ => return Err(fault(format!(":{n}: \"{strain}\" is no plastic strain"))),
        };
        let stress: Quantity<Stress> = match (stress_unit.as_str(), stress.parse::<f64>()) {
            ("", Ok(value)) if !YIELD_STRENGTHS.contains(&value) => {
                let message = format!("{name}:{n}: the flow stress is {}", show(value, "Pa"));
                return Err((
                    message,
                    "name the unit in the header, such as flow_stress_mpa".into(),
                ));
            }
            ("", Ok(value)) => Quantity::from_si(value),
            (unit, _) => Quantity::from_text(&text(stress, unit)),
        };
        let is_read = stress.si().is_ok();
        is_read.then(|| (strain, stress.clone())).ok_or_else(|| {
            fault(format!(":{n}: \"{}\" is no flow stress", stress.text().unwrap_or_default()))
        })
    });
    rows.collect()
}

/// Returns the unit of a column's name: of `stress [MPa]`, `stress (MPa)` and `stress_mpa` it is MPa; empty without one.
fn unit_of(header: &str) -> String {
    let bracketed = header.split_once(['[', '(']).and_then(|(_, rest)| rest.split_once([']', ')']));
    if let Some((unit, _)) = bracketed {
        return unit.trim().to_string();
    }
    let endings = ["Pa", "kPa", "MPa", "GPa", "psi", "ksi"];
    let ending = header.rsplit(['_', ' ']).next().unwrap_or_default();
    let known = endings.into_iter().find(|unit| unit.eq_ignore_ascii_case(ending));
    known.filter(|_| ending.len() < header.len()).unwrap_or_default().to_string()
}

impl Check<'_> {
    /// Returns the flow rule of the table at `path`; `of_material` is the yield strength beside the density.
    pub(super) fn flow(
        &self,
        path: &str,
        table: &FlowTable,
        of_material: Option<f64>,
        place: impl Fn(MaterialError) -> CaseError,
    ) -> Result<FlowRule, CaseError> {
        let at = |key: &str| join(path, key);
        let own = &at("yield_strength");
        let own_strength = self.optional(own, table.yield_strength.as_ref(), Range::POSITIVE)?;
        let strength = own_strength.or(of_material);
        let needed = || {
            strength.ok_or_else(|| {
                let error =
                    self.error(path, format!("the key `yield_strength` is missing in {path}"));
                error.lacking("yield_strength").with_help("write yield_strength = \"235 MPa\"")
            })
        };
        let default = HardeningTable::default();
        let hardening = table.hardening.as_ref().unwrap_or(&default);
        let given = hardening.given();
        let at_hardening = |key: &str| join(&at("hardening"), key);
        if given.len() > 1 {
            let keys: Vec<String> = given.iter().map(|key| at_hardening(key)).collect();
            let keys: Vec<&str> = keys.iter().map(String::as_str).collect();
            let message = format!("more than one kind of hardening: {}", given.join(", "));
            let error = self.conflict(keys[keys.len() - 1], &keys, message);
            return Err(error.with_help("keep one of them"));
        }
        let hardening = match hardening {
            HardeningTable { modulus: Some(modulus), .. } => {
                let at = at_hardening("modulus");
                let modulus = self.number(&at, modulus, Range::NOT_NEGATIVE)?;
                Hardening::Linear { yield_strength: needed()?, modulus }
            }
            HardeningTable { swift: Some(swift), .. } => {
                let at = |key: &str| join(&at_hardening("swift"), key);
                Hardening::Swift {
                    yield_strength: needed()?,
                    strain: self.number(&at("strain"), &swift.strain, Range::POSITIVE)?,
                    exponent: {
                        let range = Range::HARDENING_EXPONENT;
                        self.number(&at("exponent"), &swift.exponent, range)?
                    },
                }
            }
            HardeningTable { table: Some(FlowPoints::Rows(rows)), .. } => Hardening::Table(
                self.flow_points(&at_hardening("table"), rows, own, [own_strength, strength])?,
            ),
            _ => Hardening::Linear { yield_strength: needed()?, modulus: 0.0 },
        };
        let rate = table.rate.as_ref().map(|rate| self.rate(&at("rate.johnson_cook"), rate));
        FlowRule::new(hardening, rate.transpose()?).map_err(place)
    }

    fn rate(&self, path: &str, table: &RateTable) -> Result<RateFactor, CaseError> {
        let at = |key: &str| join(path, key);
        let (c, reference) = (&table.johnson_cook.c, &table.johnson_cook.reference_rate);
        Ok(RateFactor {
            coefficient: self.number(&at("c"), c, Range::NOT_NEGATIVE)?,
            reference_rate: self.number(&at("reference_rate"), reference, Range::POSITIVE)?,
        })
    }

    /// Returns the points of a table, which begins at plastic strain 0 or with the yield strength. `own` is the key of the
    /// strength, and the strengths are that of the table and that which counts.
    fn flow_points(
        &self,
        path: &str,
        rows: &[(Quantity<Number>, Quantity<Stress>)],
        own: &str,
        [own_strength, strength]: [Option<f64>; 2],
    ) -> Result<Vec<FlowPoint>, CaseError> {
        let mut points = Vec::with_capacity(rows.len() + 1);
        for (k, (strain, stress)) in rows.iter().enumerate() {
            let at = |part: usize| format!("{path}.{k}.{part}");
            points.push(FlowPoint {
                plastic_strain: self.number(&at(0), strain, Range::NOT_NEGATIVE)?,
                flow_stress: self.number(&at(1), stress, Range::POSITIVE)?,
            });
        }
        let Some(first) = points.first().copied() else { return Ok(points) };
        match (first.plastic_strain > 0.0, own_strength, strength) {
            (true, _, Some(flow_stress)) => {
                points.insert(0, FlowPoint { plastic_strain: 0.0, flow_stress });
            }
            (true, _, None) => {
                let message =
                    format!("the table begins at plastic strain {}", first.plastic_strain);
                let help =
                    "begin with a row of plastic strain 0, or give yield_strength beside hardening";
                return Err(self.error(path, message).with_help(help));
            }
            (false, Some(given), _) if (given / first.flow_stress - 1.0).abs() > ROUNDING => {
                let message = format!(
                    "yield_strength is {}, and the flow stress at plastic strain 0 is {}",
                    show(given, "Pa"),
                    show(first.flow_stress, "Pa")
                );
                let error = self.conflict(own, &[path], message);
                return Err(
                    error.with_help("remove yield_strength, or the row of plastic strain 0")
                );
            }
            _ => {}
        }
        Ok(points)
    }
}
