//! `[vary]`: dotted keys and the list of values of each, with their places in the sweep file.
//!
//! A key is one string in quotes (`"body.0.approach_speed" = […]`) or TOML's own nesting
//! (`body.0.approach_speed = […]`); both mean the same.

use std::ops::Range;

use toml::Spanned;
use toml::de::{DeTable, DeValue};

use crate::document::Document;
use crate::error::CaseError;
use crate::key_path::quote_key;
use crate::overrides::{Assignment, parse_path};
use crate::toml_text::shift;

/// A varied key and its values.
#[derive(Clone, Debug)]
pub struct Axis {
    /// The dotted key.
    pub key: String,
    /// Its values, at least one.
    pub elements: Vec<Element>,
    pub(crate) path: Vec<Spanned<String>>,
    pub(crate) span: Range<usize>,
}

/// One value of a list.
#[derive(Clone, Debug)]
pub struct Element {
    /// The value as written, a string without its quotes.
    pub text: String,
    /// Its bytes in the sweep file.
    pub(crate) span: Range<usize>,
}

impl Axis {
    /// The parts of the key, quotes removed.
    pub fn parts(&self) -> impl Iterator<Item = &str> {
        self.path.iter().map(|part| part.get_ref().as_str())
    }

    /// The assignment of an element; spans count from the beginning of the sweep file `text`.
    pub(crate) fn assignment<'t>(&self, element: usize, text: &'t str) -> Option<Assignment<'t>> {
        let span = self.elements[element].span.clone();
        let value = DeValue::parse(&text[span.clone()]).ok()?;
        let value = shift(value, span.start);
        Some(Assignment { path: self.path.clone(), value })
    }

    /// Whether this key is `other` or a table or array around it.
    pub(crate) fn contains(&self, other: &[Spanned<String>]) -> bool {
        let same = |(a, b): (&Spanned<String>, &Spanned<String>)| {
            canonical_part(a.get_ref()) == canonical_part(b.get_ref())
        };
        self.path.len() <= other.len() && self.path.iter().zip(other).all(same)
    }
}

/// `00` is the same index as `0`.
fn canonical_part(part: &str) -> &str {
    let is_index = !part.is_empty() && part.bytes().all(|byte| byte.is_ascii_digit());
    let digits = part.trim_start_matches('0');
    match (is_index, digits) {
        (false, _) => part,
        (true, "") => "0",
        (true, digits) => digits,
    }
}

/// Reads `[vary]` of the sweep file `text`.
pub(crate) fn read_axes(
    document: &Document,
    text: &str,
    root: &DeTable<'_>,
) -> Result<Vec<Axis>, CaseError> {
    let reader = Reader { document, text };
    let mut axes = Vec::new();
    match root.get("vary").map(Spanned::get_ref) {
        Some(DeValue::Table(table)) => {
            for (key, value) in table {
                let path = reader.path(key.get_ref(), key.span())?;
                reader.collect(path, key.span(), value, &mut axes)?;
            }
        }
        Some(_) => {
            return Err(document.error_at("vary", "vary is not a table").with_help(EXAMPLE));
        }
        None => {}
    }
    if axes.is_empty() {
        return Err(document.error_at("vary", "the sweep varies no key").with_help(EXAMPLE));
    }
    for (index, axis) in axes.iter().enumerate() {
        for other in &axes[..index] {
            reader.check_apart(axis, other)?;
        }
    }
    Ok(axes)
}

const EXAMPLE: &str =
    "write a table [vary] with lines such as \"body.0.approach_speed\" = [\"0.1 m/s\", \"1 m/s\"]";

struct Reader<'a> {
    document: &'a Document,
    text: &'a str,
}

impl Reader<'_> {
    /// The parts of a key that stands directly in `[vary]`.
    fn path(&self, key: &str, span: Range<usize>) -> Result<Vec<Spanned<String>>, CaseError> {
        let raw = &self.text[span.clone()];
        let is_quoted = raw.starts_with(['"', '\'']);
        if !is_quoted {
            return Ok(vec![Spanned::new(span, key.to_string())]);
        }
        // Escapes in the key move its characters; then all of it stands for each of its parts.
        let is_exact = raw.get(1..raw.len() - 1) == Some(key);
        let place = |part: Range<usize>| if is_exact { part } else { span.clone() };
        let (parts, _) = parse_path(&format!("{key}="), span.start + 1).map_err(|fault| {
            self.document.error_on(place(fault.span), fault.message).with_help(EXAMPLE)
        })?;
        let placed = |part: Spanned<String>| {
            let span = place(part.span());
            Spanned::new(span, part.into_inner())
        };
        Ok(parts.into_iter().map(placed).collect())
    }

    /// Adds the axes at and below a value.
    fn collect(
        &self,
        path: Vec<Spanned<String>>,
        span: Range<usize>,
        value: &Spanned<DeValue<'_>>,
        axes: &mut Vec<Axis>,
    ) -> Result<(), CaseError> {
        let parts: Vec<String> = path.iter().map(|part| quote_key(part.get_ref())).collect();
        let key = parts.join(".");
        match value.get_ref() {
            DeValue::Table(table) => {
                if table.is_empty() {
                    let error = self.document.error_on(span, format!("{key} has no list"));
                    return Err(error.with_help(EXAMPLE));
                }
                for (key, value) in table {
                    let mut path = path.clone();
                    path.push(Spanned::new(key.span(), key.get_ref().to_string()));
                    self.collect(path, key.span(), value, axes)?;
                }
            }
            DeValue::Array(array) => {
                if array.is_empty() {
                    let error = self.document.error_on(value.span(), format!("{key}: no values"));
                    return Err(error.with_help("a list holds at least one value"));
                }
                let elements = array.iter().map(|element| self.element(&key, element));
                let elements = elements.collect::<Result<_, _>>()?;
                axes.push(Axis { key, elements, path, span });
            }
            _ => {
                let error = self.document.error_on(value.span(), format!("{key} is not a list"));
                return Err(error.with_help("put the values in brackets: [\"0.1 m/s\", \"1 m/s\"]"));
            }
        }
        Ok(())
    }

    fn element(&self, key: &str, value: &Spanned<DeValue<'_>>) -> Result<Element, CaseError> {
        let span = value.span();
        let raw = self.text.get(span.clone()).unwrap_or_default();
        // The parser says where a table of [[…]] begins, not where it ends.
        if DeValue::parse(raw).is_err() {
            let error = self.document.error_on(span, format!("{key} is not a list in brackets"));
            return Err(error.with_help("write tables as [{ … }, { … }]"));
        }
        let text = value.get_ref().as_str().unwrap_or(raw).to_string();
        Ok(Element { text, span })
    }

    fn check_apart(&self, axis: &Axis, other: &Axis) -> Result<(), CaseError> {
        let message = match (axis.contains(&other.path), other.contains(&axis.path)) {
            (false, false) => return Ok(()),
            (true, true) => format!("{} is varied twice", axis.key),
            (true, false) => format!("{} contains {}, which is varied too", axis.key, other.key),
            (false, true) => format!("{} is part of {}, which is varied too", axis.key, other.key),
        };
        let help = "vary each of them alone, or only the outer one with whole tables as values";
        Err(self.document.error_on(axis.span.clone(), message).with_help(help))
    }
}
