//! An override `KEY=VALUE`: one value put into the tree of a case before it is validated.
//!
//! KEY is a dotted path in TOML's key syntax (`material."my glass".density`), an index from 0 in
//! an array. VALUE is a TOML value. Text that is none is taken as a string whose quotes a shell has removed, unless it
//! begins like a table, an array or a string. Absent keys and tables are added; array elements are not. The name of a
//! model or a law, `model=ting`, selects its defaults.

use std::borrow::Cow;
use std::ops::Range;

use toml::Spanned;
use toml::de::{DeString, DeTable, DeValue};
use toml::map::{Entry, VacantEntry};

use crate::schema::model_tables::choice_at;
use crate::source::toml_syntax::{first_line, is_bare, quote_key, shift};

/// The largest number of parts of a key, more than any key of a case has: it limits recursion over the tree.
const DEEPEST_PATH: usize = 32;

/// An error of an override: the position in its text, the message, and the suggested fix.
pub(crate) struct OverrideError {
    pub(crate) span: Range<usize>,
    pub(crate) message: String,
    pub(crate) help: String,
}

/// A parsed override.
pub(crate) struct Assignment<'t> {
    pub(crate) path: Vec<Spanned<String>>,
    pub(crate) value: Spanned<DeValue<'t>>,
}

impl Assignment<'_> {
    /// Returns this override with all of its spans moved by `start`.
    pub(crate) fn shifted(self, start: usize) -> Self {
        let move_part = |part: Spanned<String>| {
            let span = part.span();
            Spanned::new(span.start + start..span.end + start, part.into_inner())
        };
        Self {
            path: self.path.into_iter().map(move_part).collect(),
            value: shift(self.value, start),
        }
    }
}

/// Returns the key of an override, for its name; all of the text if there is no `=` after a key.
pub(crate) fn key_text(text: &str) -> &str {
    let mut quote = None;
    for (index, c) in text.char_indices() {
        match (quote, c) {
            (None, '=') => return text[..index].trim(),
            (None, '"' | '\'') => quote = Some(c),
            (Some(open), c) if c == open => quote = None,
            _ => {}
        }
    }
    text.trim()
}

/// Splits an override into path and value. Its spans and those of an error count from `offset`.
pub(crate) fn parse(text: &str, offset: usize) -> Result<Assignment<'_>, OverrideError> {
    let (path, equals) = parse_path(text, offset)?;
    let raw = &text[equals + 1..];
    let start = equals + 1 + (raw.len() - raw.trim_start().len());
    let raw = raw.trim();
    let value_fault = |span: Range<usize>, message: String| OverrideError {
        span: offset + span.start..offset + span.end,
        message,
        help: "write a TOML value: 0.5, true, [1, 2], {}, or a string in quotes that the shell \
               does not remove: KEY='\"1 m/s\"'"
            .to_string(),
    };
    if raw.is_empty() {
        let message = "there is no value after `=`".to_string();
        return Err(value_fault(equals..equals + 1, message));
    }
    let value = match DeValue::parse(raw) {
        Ok(value) => value,
        Err(_) if is_unquoted(raw) => Spanned::new(0..raw.len(), DeValue::String(raw.into())),
        Err(error) => {
            let message = format!("`{raw}` is not a TOML value: {}", first_line(error.message()));
            return Err(value_fault(start..start + raw.len(), message));
        }
    };
    Ok(Assignment { path, value: shift(value, offset + start) })
}

/// Returns whether a text can only be meant as a string: `1 m/s`, `14um` or `off`, but not half of a table.
fn is_unquoted(raw: &str) -> bool {
    !raw.starts_with(['{', '[', '"', '\'']) && !raw.contains(|c: char| c.is_control() || c == '=')
}

/// Returns the parts of the key and the position of the `=` after it.
pub(crate) fn parse_path(
    text: &str,
    offset: usize,
) -> Result<(Vec<Spanned<String>>, usize), OverrideError> {
    let fault = |span: Range<usize>, message: &str| OverrideError {
        span: offset + span.start..offset + span.end,
        message: message.to_string(),
        help: "write KEY=VALUE with a dotted key, such as mesh.contact_element_size=28e-6 or \
               body.0.sphere.diameter='\"10 mm\"'"
            .to_string(),
    };
    let mut path = Vec::new();
    let mut at = 0;
    loop {
        at += text[at..].len() - text[at..].trim_start().len();
        let rest = &text[at..];
        let (part, length) = match rest.chars().next() {
            Some(quote @ ('"' | '\'')) => quoted_part(rest, quote)
                .ok_or_else(|| fault(at..text.len(), "a quoted key has no end or is not TOML"))?,
            _ => {
                let length = rest.find(|c| !is_bare(c)).unwrap_or(rest.len());
                (rest[..length].to_string(), length)
            }
        };
        let next = at + length + (rest[length..].len() - rest[length..].trim_start().len());
        let after = text[next..].chars().next();
        if length == 0 {
            let message = match after {
                None | Some('=' | '.') => "a part of the key is empty".to_string(),
                Some(c) => format!("`{c}` is not allowed in a key without quotes"),
            };
            return Err(fault(at..at + after.map_or(0, char::len_utf8), &message));
        }
        path.push(Spanned::new(offset + at..offset + at + length, part));
        if path.len() > DEEPEST_PATH {
            return Err(fault(0..next, "the key has too many parts"));
        }
        match after {
            Some('.') => at = next + 1,
            Some('=') => return Ok((path, next)),
            None => return Err(fault(0..text.len(), "there is no `=` after the key")),
            Some(c) => {
                let message = format!("`{c}` is not allowed in a key without quotes");
                return Err(fault(next..next + c.len_utf8(), &message));
            }
        }
    }
}

/// Returns a quoted key at the beginning of `text`, and its length with the quotes.
fn quoted_part(text: &str, quote: char) -> Option<(String, usize)> {
    let mut is_escaped = false;
    for (index, c) in text.char_indices().skip(1) {
        if is_escaped {
            is_escaped = false;
        } else if c == '\\' && quote == '"' {
            is_escaped = true;
        } else if c == quote {
            let value = DeValue::parse(&text[..=index]).ok()?;
            return Some((value.get_ref().as_str()?.to_string(), index + 1));
        }
    }
    None
}

/// Inserts the value into the tree.
pub(crate) fn apply<'t>(
    root: &mut DeTable<'t>,
    assignment: Assignment<'t>,
) -> Result<(), OverrideError> {
    let Assignment { path, mut value } = assignment;
    expand_all(&mut path.iter().map(|part| part.get_ref().clone()).collect(), &mut value);
    let Some((last, parents)) = path.split_last() else {
        return Ok(());
    };
    drop_alternatives(root, &path);
    let mut place = Place::Table(root);
    for (index, part) in parents.iter().enumerate() {
        let child = match place.child(&path, index)? {
            Child::Value(value) => value,
            Child::Absent(entry) => {
                entry.insert(Spanned::new(part.span(), DeValue::Table(DeTable::new())))
            }
        };
        place = Place::of(child, part)?;
    }
    if let Place::Table(table) = &mut place {
        // An insertion over an old key would keep that key's position in the file.
        table.remove(last.get_ref().as_str());
    }
    match place.child(&path, parents.len())? {
        Child::Value(old) => *old = value,
        Child::Absent(entry) => {
            entry.insert(value);
        }
    }
    Ok(())
}

/// Replaces or removes the value at a path, if there is one. The new value has the span of the old one, or of the
/// nearest one around it.
pub(crate) fn repair<'t>(root: &mut DeTable<'t>, path: &[String], value: Option<&'t str>) {
    let Some((last, parents)) = path.split_last() else { return };
    let mut place = Place::Table(root);
    let mut span = 0..0;
    for part in parents {
        let part = Spanned::new(span.clone(), part.clone());
        let Ok(Child::Value(child)) = place.child(std::slice::from_ref(&part), 0) else { return };
        span = child.span();
        let Ok(inner) = Place::of(child, &part) else { return };
        place = inner;
    }
    let new = value.and_then(|text| DeValue::parse(text).ok());
    let moved = |new: Spanned<DeValue<'t>>, span: Range<usize>| {
        Spanned::new(span.clone(), shift(new, span.start).into_inner())
    };
    match (place, new) {
        (Place::Table(table), new) => {
            let span = table.remove(last.as_str()).map_or(span, |old| old.span());
            if let Some(new) = new {
                let key = Spanned::new(span.clone(), Cow::Owned(last.clone()));
                table.insert(key, moved(new, span));
            }
        }
        (Place::Array(array), Some(new)) => {
            if let Some(old) = last.parse().ok().and_then(|index: usize| array.get_mut(index)) {
                *old = moved(new, old.span());
            }
        }
        (Place::Array(_), None) => {}
    }
}

/// Replaces the names of choices in a file, such as a model, by their tables.
pub(crate) fn expand_choices(root: &mut DeTable<'_>) {
    for (key, value) in root.iter_mut() {
        expand_all(&mut vec![key.get_ref().to_string()], value);
    }
}

/// Replaces the names of choices in the value at a path.
fn expand_all(path: &mut Vec<String>, value: &mut Spanned<DeValue<'_>>) {
    expand_choice(&path.iter().map(String::as_str).collect::<Vec<_>>(), value);
    if let DeValue::Table(table) = value.get_mut() {
        for (key, value) in table.iter_mut() {
            path.push(key.get_ref().to_string());
            expand_all(path, value);
            path.pop();
        }
    }
}

/// Replaces the name of a choice by its table: `ting` means `{ ting = {} }`.
fn expand_choice(path: &[&str], value: &mut Spanned<DeValue<'_>>) {
    let Some(choice) = choice_at(path) else { return };
    let is_choice = |name: &&str| choice.names.contains(name);
    let Some(name) = value.get_ref().as_str().filter(is_choice) else { return };
    let (span, name) = (value.span(), name.to_string());
    let mut table = DeTable::new();
    let inner = Spanned::new(span.clone(), DeValue::Table(DeTable::new()));
    table.insert(Spanned::new(span, Cow::Owned(name)), inner);
    *value.get_mut() = DeValue::Table(table);
}

/// Removes keys that exclude a key of the path, such as another model.
fn drop_alternatives(root: &mut DeTable<'_>, path: &[Spanned<String>]) {
    let mut names: Vec<&str> = Vec::new();
    let mut table = root;
    for part in path {
        let key = part.get_ref().as_str();
        let present: Vec<String> = table.iter().map(|(key, _)| key.get_ref().to_string()).collect();
        let choice = choice_at(&names);
        let is_excluded =
            |other: &&String| choice.as_ref().is_some_and(|c| c.is_between(key, other));
        for other in present.iter().filter(is_excluded) {
            table.remove(other.as_str());
        }
        names.push(key);
        table = match table.get_mut(key).map(Spanned::get_mut) {
            Some(DeValue::Table(inner)) => inner,
            _ => return,
        };
    }
}

/// A value that has values inside.
enum Place<'a, 't> {
    Table(&'a mut DeTable<'t>),
    Array(&'a mut [Spanned<DeValue<'t>>]),
}

enum Child<'a, 't> {
    Value(&'a mut Spanned<DeValue<'t>>),
    Absent(VacantEntry<'a, Spanned<DeString<'t>>, Spanned<DeValue<'t>>>),
}

/// Returns `did you mean …? ` for a part of a path that is no index of an array: the index of the table that has it as its
/// name, or else before it the index of a table that has this key.
fn meant_path(array: &[Spanned<DeValue<'_>>], path: &[Spanned<String>], part: usize) -> String {
    let mut parts: Vec<_> = path.iter().map(|part| quote_key(part.get_ref())).collect();
    let key = path[part].get_ref().as_str();
    let position = |is: &dyn Fn(&DeTable<'_>) -> bool| {
        let is_it = |value: &Spanned<DeValue<'_>>| value.get_ref().as_table().is_some_and(is);
        array.iter().position(is_it)
    };
    let named = |table: &DeTable<'_>| Some(table.get("name")?.get_ref().as_str()? == key);
    match position(&|table| named(table) == Some(true)) {
        Some(index) => parts[part] = index.to_string(),
        None => {
            let index = position(&|table| table.contains_key(key)).unwrap_or_default();
            parts.insert(part, index.to_string());
        }
    }
    format!("did you mean `{}`? ", parts.join("."))
}

impl<'a, 't> Place<'a, 't> {
    fn of(
        value: &'a mut Spanned<DeValue<'t>>,
        part: &Spanned<String>,
    ) -> Result<Self, OverrideError> {
        match value.get_mut() {
            DeValue::Table(table) => Ok(Place::Table(table)),
            DeValue::Array(array) => Ok(Place::Array(array)),
            _ => Err(OverrideError {
                span: part.span(),
                message: format!("`{}` is a single value without keys", part.get_ref()),
                help: "end the key here to replace the value".to_string(),
            }),
        }
    }

    /// Returns the value at the part of this index in a path.
    fn child(self, path: &[Spanned<String>], index: usize) -> Result<Child<'a, 't>, OverrideError> {
        let part = &path[index];
        let key = part.get_ref();
        match self {
            Place::Table(table) => {
                match table.entry(Spanned::new(part.span(), Cow::Owned(key.clone()))) {
                    Entry::Occupied(entry) => Ok(Child::Value(entry.into_mut())),
                    Entry::Vacant(entry) => Ok(Child::Absent(entry)),
                }
            }
            Place::Array(array) => {
                let length = array.len();
                let is_number = key.bytes().all(|byte| byte.is_ascii_digit());
                let indices = match length {
                    0 => "it is empty; replace the whole array".to_string(),
                    1 => "its only index is 0".to_string(),
                    _ => format!("its indices are 0 to {}", length - 1),
                };
                let meant = match is_number {
                    true => String::new(),
                    false => meant_path(array, path, index),
                };
                let number = key.parse::<usize>().ok().filter(|_| is_number);
                match number.and_then(|number| array.get_mut(number)) {
                    Some(value) => Ok(Child::Value(value)),
                    None => Err(OverrideError {
                        span: part.span(),
                        message: format!("`{key}` is not an index of this array of {length}"),
                        help: meant + &indices,
                    }),
                }
            }
        }
    }
}
