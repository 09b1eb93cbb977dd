//! Values of a varied key as a range, `{ from = "5 cm/s", to = "2 m/s", n = 40, log = true }` or with `step = "5 cm/s"` in
//! place of `n`, or as the rows of a CSV file, `{ table = "pairs.csv" }`.
//!
//! The values of a range, also of temperatures (`from = "-20 degC", to = "80 degC", step = "5 degC"`), are evenly
//! spaced, or have a constant ratio with `log`: x_k = from + (to − from) k / (n − 1), or from (to / from)^(k / (n − 1)).
//! The ends are as written; the values between have the unit of `to`. Each row of a table
//! is one value of all keys of the axis, from the columns of their names or from those in `columns`.

use std::ops::Range;
use std::path::Path;

use serde::Deserialize;
use toml::Spanned;
use toml::de::DeTable;

use crate::case::bytes_at;
use crate::error::CaseError;
use crate::quantity::uncertain::parse_temperature;
use crate::quantity::units::{Dimension, parse_quantity};
use crate::quantity::{Number, Quantity};
use crate::source::document::Document;
use crate::source::explain::explain;
use crate::sweep::axes::AxisValue;

/// The largest number of values of a range.
const MAX_VALUES: u64 = 10_000_000;
const RANGE: &str = "write { from = \"0.1 m/s\", to = \"2 m/s\", n = 10 }, perhaps with log = true, or with step = \"0.1 m/s\" \
                     in place of n";
/// Largest part of a step by which the last one may miss the end of a range.
const ROUNDING: f64 = 1e-9;
/// The dimension of a temperature, whose scales have an offset: both ends and the step have the same scale.
const ON_A_SCALE: Dimension = Dimension([0; 4]);

/// An error in a table of values.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct RowsFault {
    /// The value or text that was found, and its line.
    pub message: String,
    /// Allowed values, or the suggested fix.
    pub help: String,
}

/// Reads a table from its name for messages, its bytes and the names of columns; returns the cells of these columns, row
/// by row.
pub type ReadRows = dyn Fn(&str, &[u8], &[String]) -> Result<Vec<Vec<String>>, RowsFault>;

/// Returns whether a table under `[vary]` is a range or a CSV file; no key of a case has these names.
pub(crate) fn is_values(table: &DeTable<'_>) -> bool {
    ["from", "to", "table"].iter().any(|key| table.contains_key(*key))
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct RangeTable {
    from: Spanned<Quantity<Number>>,
    to: Spanned<Quantity<Number>>,
    n: Option<Spanned<u64>>,
    step: Option<Spanned<Quantity<Number>>>,
    #[serde(default)]
    log: bool,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct RowsTable {
    table: Spanned<String>,
    columns: Option<Spanned<Vec<String>>>,
}

/// Reads the values of the keys of an axis.
pub(crate) struct ValuesReader<'a> {
    pub(crate) document: &'a Document,
    /// The folder of the sweep file, and the reader of tables.
    pub(crate) tables: (&'a Path, &'a ReadRows),
    /// The keys, separated by commas.
    pub(crate) name: &'a str,
}

impl ValuesReader<'_> {
    /// Returns the values of these keys that a table under `[vary]` gives.
    pub(crate) fn read(
        &self,
        table: &DeTable<'_>,
        span: Range<usize>,
        keys: &[&str],
    ) -> Result<Vec<AxisValue>, CaseError> {
        let tree = Spanned::new(span.clone(), table.clone());
        let tree = toml::de::Deserializer::from(tree);
        let explained = |error: toml::de::Error| match error.message().starts_with("missing field")
        {
            true => self.fault(
                span.clone(),
                error.message().replace("missing field", "there is no"),
                RANGE,
            ),
            false => explain(self.document, &error),
        };
        match table.contains_key("table") {
            true => self.rows(&RowsTable::deserialize(tree).map_err(explained)?, &span, keys),
            false => self.range(&RangeTable::deserialize(tree).map_err(explained)?, &span),
        }
    }

    fn fault(&self, span: Range<usize>, message: impl Into<String>, help: &str) -> CaseError {
        self.document.error_on(span, format!("{}: {}", self.name, message.into())).with_help(help)
    }

    fn range(&self, range: &RangeTable, span: &Range<usize>) -> Result<Vec<AxisValue>, CaseError> {
        let (first, last) = (self.end(&range.from)?, self.end(&range.to)?);
        let (start, unit) = match (first.unit == last.unit, first.in_unit_of(&last)) {
            (true, _) => (first.number, &first.unit),
            (false, Some(start)) => (start, &last.unit),
            (false, None) => {
                let message =
                    format!("the ends have the units {:?} and {:?}", first.unit, last.unit);
                let help =
                    "write both ends in units of the same quantity; a bare number is in SI units";
                return Err(self.fault(range.to.span(), message, help));
            }
        };
        let to = last.number;
        let (n, n_span) = match (&range.n, &range.step) {
            (Some(n), None) => (*n.get_ref(), n.span()),
            (None, Some(step)) => (self.count(step, (start, &last), range.log)?, step.span()),
            (Some(_), Some(step)) => {
                return Err(self.fault(step.span(), "a range has n or step, not both", RANGE));
            }
            (None, None) => {
                return Err(self.fault(span.clone(), "there is no `n` and no `step`", RANGE));
            }
        };
        if !(2..=MAX_VALUES).contains(&n) {
            let help =
                format!("n must be from 2 to {MAX_VALUES}; write a single value as a list, [1.0]");
            return Err(self.fault(n_span, format!("n is {n}"), &help));
        }
        if range.log && !(start > 0.0 && to > 0.0) {
            let end = if start > 0.0 { &range.to } else { &range.from };
            let help = "with log = true both ends must be greater than 0";
            return Err(self.fault(end.span(), "this end is not greater than 0", help));
        }
        let value = |k: u64| {
            let share = k as f64 / (n - 1) as f64;
            match k {
                0 => start,
                _ if k == n - 1 => to,
                _ if range.log => start * (to / start).powf(share),
                _ => start + (to - start) * share,
            }
        };
        let text = |k| match unit.as_str() {
            // The ends are as written.
            _ if k == 0 => first.text(),
            // TOML writes 1.0, not 1.
            "" => format!("{:?}", value(k)),
            unit => format!("{} {unit}", value(k)),
        };
        Ok((0..n).map(|k| AxisValue::made(vec![text(k)], span.clone())).collect())
    }

    /// Returns the number of values of a range from `start`, in the unit of its last value, at equal steps.
    fn count(
        &self,
        step: &Spanned<Quantity<Number>>,
        (start, last): (f64, &End),
        is_log: bool,
    ) -> Result<u64, CaseError> {
        let fault = |message: &str, help: &str| Err(self.fault(step.span(), message, help));
        if is_log {
            return fault("equal ratios have no step", "with log = true give n in place of step");
        }
        let size = self.end(step)?;
        let size = match size.unit == last.unit {
            true => Some(size.number),
            false => size.in_unit_of(last),
        };
        let n_steps = size.map_or(f64::NAN, |size| (last.number - start) / size);
        if !(n_steps > 0.0 && n_steps.is_finite()) {
            let help = "the step is a quantity like the ends, and leads from the first to the last";
            return fault("this step does not lead from the first to the last value", help);
        }
        if (n_steps - n_steps.round()).abs() > ROUNDING * n_steps.max(1.0) || n_steps < 0.5 {
            let help = format!(
                "end the range after a whole number of steps, or write n = {}",
                n_steps.round() + 1.0
            );
            return fault("the last step does not end at `to`", &help);
        }
        Ok(n_steps.round() as u64 + 1)
    }

    fn end(&self, bound: &Spanned<Quantity<Number>>) -> Result<End, CaseError> {
        let fault = |found: &str| self.fault(bound.span(), found, RANGE);
        let end = match bound.get_ref().text().map(str::trim) {
            None => {
                let number = bound.get_ref().si().unwrap_or(f64::NAN);
                End { number, unit: String::new(), si: number, dimension: None }
            }
            Some(text) => {
                let on_scale = parse_temperature(text).map(|kelvin| Ok((kelvin, ON_A_SCALE)));
                let si = on_scale.unwrap_or_else(|| parse_quantity(text));
                let (si, dimension) = si.map_err(|error| fault(&format!("{text:?}: {error}")))?;
                let (number, unit) = split_unit(text);
                End { number, unit: unit.to_string(), si, dimension: Some(dimension) }
            }
        };
        end.number.is_finite().then_some(end).ok_or_else(|| fault("this is not a number"))
    }

    fn rows(
        &self,
        rows: &RowsTable,
        span: &Range<usize>,
        keys: &[&str],
    ) -> Result<Vec<AxisValue>, CaseError> {
        let fault = |message: String, help: &str| self.fault(rows.table.span(), message, help);
        let wanted = match &rows.columns {
            None => keys.iter().map(ToString::to_string).collect(),
            Some(columns) if columns.get_ref().len() == keys.len() => columns.get_ref().clone(),
            Some(columns) => {
                let message =
                    format!("{} columns for {} keys", columns.get_ref().len(), keys.len());
                return Err(self.fault(
                    columns.span(),
                    message,
                    "name one column per key, in the order of the keys",
                ));
            }
        };
        let (folder, read_rows) = self.tables;
        let path = folder.join(rows.table.get_ref());
        let name = path.display().to_string();
        let bytes = bytes_at(&path, &name).map_err(|error| {
            let help = "give the path of a CSV file, relative to the sweep file";
            fault(format!("{name}: {}", error.message()), help)
        })?;
        let read = read_rows(&name, &bytes, &wanted);
        let read = read.map_err(|RowsFault { message, help }| fault(message, &help))?;
        Ok(read.into_iter().map(|texts| AxisValue::made(texts, span.clone())).collect())
    }
}

/// An end of a range as written and in SI. A bare number is in SI and has any dimension.
struct End {
    number: f64,
    unit: String,
    si: f64,
    dimension: Option<Dimension>,
}

impl End {
    /// Returns the number in the unit of another end of the same dimension.
    fn in_unit_of(&self, other: &Self) -> Option<f64> {
        let both = self.dimension.zip(other.dimension);
        let scale = match other.dimension {
            Some(_) => parse_quantity(&format!("1 {}", other.unit)).ok()?.0,
            None => 1.0,
        };
        both.is_none_or(|(own, other)| own == other).then_some(self.si / scale)
    }

    /// Returns the end as written.
    fn text(&self) -> String {
        match self.unit.as_str() {
            "" => format!("{:?}", self.number),
            unit => format!("{} {unit}", self.number),
        }
    }
}

/// Splits a quantity into its number and its unit as written.
pub(crate) fn split_unit(text: &str) -> (f64, &str) {
    let ends = text.char_indices().map(|(index, _)| index).chain([text.len()]).rev();
    let number = |end: usize| Some((text[..end].trim_end().parse().ok()?, text[end..].trim()));
    ends.filter(|end| *end > 0).find_map(number).unwrap_or((f64::NAN, text))
}

/// Returns a quantity rounded to five digits; `None` if the text is not a quantity.
pub(crate) fn rounded(text: &str) -> Option<String> {
    let (number, unit) = split_unit(text);
    let rounded: f64 = format!("{number:.4e}").parse().ok()?;
    let size = rounded.abs();
    let number = match rounded.is_finite() {
        true if size == 0.0 || (1e-4..1e6).contains(&size) => rounded.to_string(),
        true => format!("{rounded:e}"),
        false => return None,
    };
    Some(if unit.is_empty() { number } else { format!("{number} {unit}") })
}

#[cfg(test)]
mod tests {
    use toml::de::DeValue;

    use super::*;

    #[test]
    fn a_quantity_is_a_number_and_a_unit() {
        assert_eq!(split_unit("0.05 m/s"), (0.05, "m/s"));
        assert_eq!(split_unit("1e-3m"), (1e-3, "m"));
        assert_eq!(split_unit("5 1/s"), (5.0, "1/s"));
        assert_eq!(split_unit("2."), (2.0, ""));
    }

    #[test]
    fn quantities_are_rounded_to_five_digits() {
        for (text, expected) in [
            ("0.06640570446680345 m/s", Some("0.066406 m/s")),
            ("2 m/s", Some("2 m/s")),
            ("1234567.8", Some("1.2346e6")),
            ("0.30000000000000004", Some("0.3")),
            ("glass", None),
        ] {
            assert_eq!(rounded(text).as_deref(), expected);
        }
    }

    #[test]
    fn tables_of_a_case_are_not_values() {
        let is = |text: &str| match DeValue::parse(text).unwrap().into_inner() {
            DeValue::Table(table) => is_values(&table),
            _ => false,
        };
        assert!(is("{ from = 1, to = 2, n = 3 }") && is("{ table = 'a.csv' }"));
        assert!(!is("{ approach_speed = [1] }"));
    }
}
