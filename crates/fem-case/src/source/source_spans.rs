//! Source spans of the keys of a case by dotted path (`body.0.sphere.diameter`): a stretch of a
//! text, or code.

use std::collections::BTreeMap;
use std::ops::Range;

use toml::de::{DeTable, DeValue};
use toml::{Spanned, Table, Value};

use crate::source::key_path::{join, quote_key};

/// Where a key and its value come from.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) enum Position {
    /// They stand in a text; see [`Document`](crate::source::document::Document) for the line of offsets.
    Text { key: Range<usize>, value: Range<usize> },
    /// Code gave the value: with the whole case (0), or in its first, second, … edit.
    Code { edit: usize },
}

/// The positions of all keys that a case gives.
#[derive(Clone, Debug, Default)]
pub(crate) struct Positions {
    by_path: BTreeMap<String, Position>,
    arrays: Vec<String>,
    n_edits: usize,
}

impl Positions {
    /// Of a tree that was parsed.
    pub(crate) fn of_text(tree: &DeTable<'_>) -> Self {
        let mut positions = Self::default();
        for (key, value) in tree {
            positions.record(quote_key(key.get_ref()), key.span(), value);
        }
        positions
    }

    /// Of a tree that stands in no text.
    pub(crate) fn of_code(tree: &Table) -> Self {
        let mut positions = Self::default();
        for (key, value) in tree {
            positions.put(&quote_key(key), value);
        }
        positions
    }

    /// After an edit that made `before` into `after`: keys with another value come from the edit,
    /// and so do tables and arrays that lost one; all others come from where they came.
    pub(crate) fn edited(&self, before: &Table, after: &Table) -> Self {
        let mut positions = self.clone();
        positions.n_edits += 1;
        positions.follow("", children_of_table(before), children_of_table(after));
        positions
    }

    /// Where the key at a path comes from, if the case gives it.
    pub(crate) fn get(&self, path: &str) -> Option<&Position> {
        self.by_path.get(path)
    }

    /// Where the key at a path comes from, or else the nearest table around it that has a place.
    pub(crate) fn nearest(&self, mut path: &str) -> Option<&Position> {
        loop {
            if let Some(position) = self.get(path) {
                return Some(position);
            }
            path = &path[..path.rfind('.')?];
        }
    }

    /// The path whose value or else key has this span; the deepest if several have.
    pub(crate) fn path_of(&self, span: &Range<usize>) -> Option<&str> {
        let deepest = |is_match: &dyn Fn(&Position) -> bool| {
            let found = self.by_path.iter().filter(|(_, position)| is_match(position));
            found.map(|(path, _)| path.as_str()).max_by_key(|path| path.matches('.').count())
        };
        deepest(&|position| matches!(position, Position::Text { value, .. } if value == span))
            .or_else(|| {
                deepest(&|position| matches!(position, Position::Text { key, .. } if key == span))
            })
    }

    /// The paths of all arrays that stand in a text.
    pub(crate) fn arrays(&self) -> &[String] {
        &self.arrays
    }

    fn record(&mut self, path: String, key: Range<usize>, value: &Spanned<DeValue<'_>>) {
        match value.get_ref() {
            DeValue::Table(table) => {
                for (key, value) in table {
                    self.record(join(&path, &quote_key(key.get_ref())), key.span(), value);
                }
            }
            DeValue::Array(array) => {
                self.arrays.push(path.clone());
                for (index, value) in array.iter().enumerate() {
                    self.record(join(&path, &index.to_string()), value.span(), value);
                }
            }
            _ => {}
        }
        self.by_path.insert(path, Position::Text { key, value: value.span() });
    }

    /// Code gave this value, with all that it holds.
    fn put(&mut self, path: &str, value: &Value) {
        self.by_path.insert(path.to_string(), Position::Code { edit: self.n_edits });
        for (key, value) in children(value).unwrap_or_default() {
            self.put(&join(path, &key), value);
        }
    }

    /// Nothing is given at this path any more, nor below.
    fn forget(&mut self, path: &str) {
        let below = join(path, "");
        self.by_path.retain(|other, _| other != path && !other.starts_with(&below));
    }

    /// From the keys of one table or array to those that an edit left in its place.
    fn follow(&mut self, path: &str, before: Children<'_>, after: Children<'_>) {
        for (key, value) in &after {
            let path = join(path, key);
            let old = before.get(key).copied();
            let same_type = old.filter(|old| old.same_type(value));
            if let Some((before, after)) = same_type.and_then(children).zip(children(value)) {
                self.follow(&path, before, after);
            } else if old != Some(value) {
                self.forget(&path);
                self.put(&path, value);
            }
        }
        for key in before.keys().filter(|key| !after.contains_key(*key)) {
            self.forget(&join(path, key));
            if !path.is_empty() {
                self.by_path.insert(path.to_string(), Position::Code { edit: self.n_edits });
            }
        }
    }
}

/// Keys or indices, and what they lead to.
type Children<'v> = BTreeMap<String, &'v Value>;

fn children(value: &Value) -> Option<Children<'_>> {
    match value {
        Value::Table(table) => Some(children_of_table(table)),
        Value::Array(array) => Some(
            array.iter().enumerate().map(|(index, value)| (index.to_string(), value)).collect(),
        ),
        _ => None,
    }
}

fn children_of_table(table: &Table) -> Children<'_> {
    table.iter().map(|(key, value)| (quote_key(key), value)).collect()
}
