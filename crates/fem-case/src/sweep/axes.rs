//! `[vary]`: dotted keys and their values, with their positions in the sweep file.
//!
//! A key is one string in quotes (`"body.0.approach_speed" = […]`) or TOML's own nesting
//! (`body.0.approach_speed = […]`); both mean the same. A string with commas links keys that change
//! together. Values are a list, a range or the rows of a table (`sweep::values`).

use std::ops::Range;
use std::path::Path;

use toml::Spanned;
use toml::de::{DeTable, DeValue};

use crate::error::CaseError;
use crate::source::document::Document;
use crate::source::overrides::{Assignment, parse_path};
use crate::source::toml_syntax::{quote_key, shift};
use crate::sweep::values::{ReadRows, ValuesReader, is_values, rounded, split_unit};

/// The parts of a key with their positions.
type KeyPath = Vec<Spanned<String>>;

/// Keys that change together, usually one, and their values.
#[derive(Clone, Debug)]
pub struct Axis {
    /// The keys, at least one.
    pub keys: Vec<SweptKey>,
    /// The values, at least one.
    pub values: Vec<AxisValue>,
    pub(crate) span: Range<usize>,
}

/// A varied key.
#[derive(Clone, Debug)]
pub struct SweptKey {
    /// The dotted key.
    pub key: String,
    path: KeyPath,
}

/// One value of an axis, for each of its keys.
#[derive(Clone, Debug)]
pub struct AxisValue {
    /// The value of each key as written, without quotes, or one value for all keys.
    texts: Vec<String>,
    /// How the texts become TOML.
    source: Source,
    /// The bytes of the value in the sweep file.
    pub(crate) span: Range<usize>,
}

/// The origin of a value.
#[derive(Clone, Debug)]
enum Source {
    /// The sweep file contains the value as TOML.
    Written,
    /// The value comes from a range or a table.
    Generated,
}

impl SweptKey {
    fn new(path: KeyPath) -> Self {
        let parts: Vec<String> = path.iter().map(|part| quote_key(part.get_ref())).collect();
        Self { key: parts.join("."), path }
    }

    /// Returns the parts of the key without quotes.
    pub fn parts(&self) -> impl Iterator<Item = &str> {
        self.path.iter().map(|part| part.get_ref().as_str())
    }

    /// Returns whether this key is `other` or a table or array around it.
    pub(crate) fn contains(&self, other: &[Spanned<String>]) -> bool {
        let same = |(a, b): (&Spanned<String>, &Spanned<String>)| {
            canonical_part(a.get_ref()) == canonical_part(b.get_ref())
        };
        self.path.len() <= other.len() && self.path.iter().zip(other).all(same)
    }
}

impl AxisValue {
    /// Creates a value that the sweep file contains.
    fn written(text: String, span: Range<usize>) -> Self {
        Self { texts: vec![text], source: Source::Written, span }
    }

    /// Creates a value of a range or of a table.
    pub(crate) fn made(texts: Vec<String>, span: Range<usize>) -> Self {
        Self { texts, source: Source::Generated, span }
    }

    /// Returns the value of a key of the axis as written.
    pub fn text(&self, key: usize) -> &str {
        let text = self.texts.get(key).or(self.texts.last());
        text.map_or("", String::as_str)
    }

    /// Returns the value of a key for display: numbers of a range or a table are rounded to five digits.
    pub fn displayed(&self, key: usize) -> String {
        let text = self.text(key);
        match self.source {
            Source::Generated => rounded(text).filter(|short| short.len() < text.len()),
            Source::Written => None,
        }
        .unwrap_or_else(|| text.to_string())
    }

    /// Returns the value of a key; its spans count from the beginning of the sweep file `text`.
    fn value<'t>(&'t self, key: usize, text: &'t str) -> Option<Spanned<DeValue<'t>>> {
        match self.source {
            Source::Written => {
                let value = DeValue::parse(&text[self.span.clone()]).ok()?;
                Some(shift(value, self.span.start))
            }
            Source::Generated => {
                let text = self.text(key);
                // Anything else is text, such as 0.5 m/s.
                let number = DeValue::parse(text).ok().map(Spanned::into_inner);
                let is_plain = |value: &DeValue<'_>| {
                    matches!(value, DeValue::Integer(_) | DeValue::Float(_) | DeValue::Boolean(_))
                };
                let value = number.filter(is_plain).unwrap_or(DeValue::String(text.into()));
                Some(Spanned::new(self.span.clone(), value))
            }
        }
    }
}

impl Axis {
    /// Returns the keys, separated by commas.
    pub fn name(&self) -> String {
        let keys: Vec<&str> = self.keys.iter().map(|key| key.key.as_str()).collect();
        keys.join(", ")
    }

    /// Returns the assignments of a value; their spans count from the beginning of the sweep file `text`.
    pub(crate) fn assignments<'t>(
        &'t self,
        value: usize,
        text: &'t str,
    ) -> impl Iterator<Item = Assignment<'t>> {
        let value = &self.values[value];
        self.keys.iter().enumerate().filter_map(|(k, key)| {
            Some(Assignment { path: key.path.clone(), value: value.value(k, text)? })
        })
    }
}

/// Returns an index without leading zeros: `00` is the same index as `0`.
fn canonical_part(part: &str) -> &str {
    let is_index = !part.is_empty() && part.bytes().all(|byte| byte.is_ascii_digit());
    let digits = part.trim_start_matches('0');
    match (is_index, digits) {
        (false, _) => part,
        (true, "") => "0",
        (true, digits) => digits,
    }
}

/// Reads `[vary]` of the sweep file `text`. `tables` is the folder of CSV files and their reader. Errors are added to
/// `faults`.
pub(crate) fn read_axes(
    document: &Document,
    text: &str,
    tables: (&Path, &ReadRows),
    root: &DeTable<'_>,
    faults: &mut Vec<CaseError>,
) -> Vec<Axis> {
    let reader = Reader { document, text, tables };
    let (mut axes, n_before) = (Vec::new(), faults.len());
    match root.get("vary").map(Spanned::get_ref) {
        Some(DeValue::Table(table)) => {
            for (key, value) in table {
                match reader.paths(key.get_ref(), key.span()) {
                    Ok(paths) => reader.collect(paths, key.span(), value, &mut axes, faults),
                    Err(fault) => faults.push(fault),
                }
            }
        }
        Some(_) => {
            faults.push(document.error_at("vary", "vary is not a table").with_help(EXAMPLE));
        }
        None => {}
    }
    // A case in place of a sweep has faults of its own.
    if axes.is_empty() && faults.len() == n_before && !document.has("body") {
        faults.push(document.error_at("vary", "the sweep varies no key").with_help(EXAMPLE));
    }
    let keys = axes.iter().flat_map(|axis| axis.keys.iter().map(|key| (key, &axis.span)));
    let keys: Vec<_> = keys.collect();
    for (index, (key, span)) in keys.iter().enumerate() {
        let apart = |(other, _): &(&SweptKey, _)| reader.check_apart(key, other, span).err();
        faults.extend(keys[..index].iter().find_map(apart));
    }
    axes
}

const EXAMPLE: &str =
    "write a table [vary] with lines such as \"body.0.approach_speed\" = [\"0.1 m/s\", \"1 m/s\"]";

struct Reader<'a> {
    document: &'a Document,
    text: &'a str,
    tables: (&'a Path, &'a ReadRows),
}

impl Reader<'_> {
    /// Returns the parts of the keys that are directly in `[vary]`.
    fn paths(&self, key: &str, span: Range<usize>) -> Result<Vec<KeyPath>, CaseError> {
        let raw = &self.text[span.clone()];
        let is_quoted = raw.starts_with(['"', '\'']);
        if !is_quoted {
            return Ok(vec![vec![Spanned::new(span, key.to_string())]]);
        }
        // Escapes in the key shift its characters; then each part has the span of the whole key.
        let is_exact = raw.get(1..raw.len() - 1) == Some(key);
        let place = |part: Range<usize>| if is_exact { part } else { span.clone() };
        let mut start = span.start + 1;
        let mut paths = Vec::new();
        for one in linked(key) {
            let (parts, _) = parse_path(&format!("{one}="), start).map_err(|fault| {
                self.document.error_on(place(fault.span), fault.message).with_help(EXAMPLE)
            })?;
            start += one.len() + 1;
            let placed = |part: Spanned<String>| {
                let span = place(part.span());
                Spanned::new(span, part.into_inner())
            };
            paths.push(parts.into_iter().map(placed).collect());
        }
        Ok(paths)
    }

    /// Adds the axes at and below a value.
    fn collect(
        &self,
        paths: Vec<KeyPath>,
        span: Range<usize>,
        value: &Spanned<DeValue<'_>>,
        axes: &mut Vec<Axis>,
        faults: &mut Vec<CaseError>,
    ) {
        let keys: Vec<_> = paths.iter().cloned().map(SweptKey::new).collect();
        let axis = |values| Axis { keys: keys.clone(), values, span: span.clone() };
        let name = axis(Vec::new()).name();
        let reader = ValuesReader { document: self.document, tables: self.tables, name: &name };
        match value.get_ref() {
            DeValue::Table(table) if is_values(table) => {
                let names: Vec<&str> = keys.iter().map(|key| key.key.as_str()).collect();
                match reader.read(table, value.span(), &names) {
                    Ok(values) => axes.push(axis(values)),
                    Err(fault) => faults.push(fault),
                }
            }
            DeValue::Table(table) => {
                if table.is_empty() {
                    let error = self.document.error_on(span, format!("{name} has no values"));
                    return faults.push(error.with_help(EXAMPLE));
                }
                for (key, value) in table {
                    let mut paths = paths.clone();
                    for path in &mut paths {
                        path.push(Spanned::new(key.span(), key.get_ref().to_string()));
                    }
                    self.collect(paths, key.span(), value, axes, faults);
                }
            }
            DeValue::Array(array) => {
                if array.is_empty() {
                    let error =
                        self.document.error_on(value.span(), format!("{name} has no values"));
                    return faults.push(error.with_help("write at least one value"));
                }
                let values = array.iter().map(|value| self.written(&name, value));
                match values.collect::<Result<_, _>>() {
                    Ok(values) => axes.push(axis(values)),
                    Err(fault) => faults.push(fault),
                }
            }
            _ => {
                let error = self.document.error_on(value.span(), format!("{name} is not a list"));
                let list = "put the values in brackets: [\"0.1 m/s\", \"1 m/s\"]".to_string();
                let range = value.get_ref().as_str().and_then(range_of);
                faults.push(error.with_help(range.unwrap_or(list)));
            }
        }
    }

    fn written(&self, key: &str, value: &Spanned<DeValue<'_>>) -> Result<AxisValue, CaseError> {
        let span = value.span();
        let raw = self.text.get(span.clone()).unwrap_or_default();
        // The parser gives the start of a table [[…]], but not its end.
        if DeValue::parse(raw).is_err() {
            let error = self.document.error_on(span, format!("{key} is not a list in brackets"));
            return Err(error.with_help("write tables as [{ … }, { … }]"));
        }
        let text = value.get_ref().as_str().unwrap_or(raw).to_string();
        Ok(AxisValue::written(text, span))
    }

    fn check_apart(
        &self,
        key: &SweptKey,
        other: &SweptKey,
        span: &Range<usize>,
    ) -> Result<(), CaseError> {
        let message = match (key.contains(&other.path), other.contains(&key.path)) {
            (false, false) => return Ok(()),
            (true, true) => format!("{} is varied twice", key.key),
            (true, false) => format!("{} contains {}, which is varied too", key.key, other.key),
            (false, true) => format!("{} is part of {}, which is varied too", key.key, other.key),
        };
        let help = "vary only one of them; the values of the outer key can be whole tables";
        Err(self.document.error_on(span.clone(), message).with_help(help))
    }
}

/// Returns how to write the range that a text such as `0.1..2 m/s` means.
fn range_of(text: &str) -> Option<String> {
    let (from, to) = text.split_once("..")?;
    let (first, own) = split_unit(from.trim());
    let (last, unit) = split_unit(to.trim_start_matches(['.', '=']).trim());
    let own = if own.is_empty() { unit } else { own };
    let end = |number: f64, unit: &str| match unit {
        "" => number.to_string(),
        unit => format!("\"{number} {unit}\""),
    };
    let is_range = first.is_finite() && last.is_finite();
    is_range.then(|| {
        format!("write a range: {{ from = {}, to = {}, n = 10 }}", end(first, own), end(last, unit))
    })
}

/// Returns the keys that commas link, in order; a comma in quotes is part of a key.
fn linked(keys: &str) -> Vec<&str> {
    let (mut quote, mut start, mut found) = (None, 0, Vec::new());
    for (index, c) in keys.char_indices() {
        match (quote, c) {
            (None, ',') => {
                found.push(&keys[start..index]);
                start = index + 1;
            }
            (None, '"' | '\'') => quote = Some(c),
            (Some(open), c) if c == open => quote = None,
            _ => {}
        }
    }
    found.push(&keys[start..]);
    found
}
