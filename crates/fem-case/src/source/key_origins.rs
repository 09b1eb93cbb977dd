//! Origins of the keys of a case by dotted path (`body.0.sphere.diameter`): a span of a text, or code.

use std::collections::BTreeMap;
use std::ops::Range;

use toml::de::{DeTable, DeValue};
use toml::{Spanned, Table, Value};

use crate::source::toml_syntax::{join, quote_key};

/// The origin of a key and its value.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) enum KeyOrigin {
    /// Spans of a text, in the offsets of [`Document`](crate::source::document::Document).
    Text { key: Range<usize>, value: Range<usize> },
    /// Code gave the value: with the whole case (0), or in its first, second, … edit.
    Code { edit: usize },
}

/// Origins of all keys that a case gives.
#[derive(Clone, Debug, Default)]
pub(crate) struct KeyOrigins {
    by_path: BTreeMap<String, KeyOrigin>,
    arrays: Vec<String>,
    n_edits: usize,
}

impl KeyOrigins {
    /// Returns the origins of the keys of a tree that was parsed.
    pub(crate) fn of_text(tree: &DeTable<'_>) -> Self {
        let mut origins = Self::default();
        for (key, value) in tree {
            origins.record(quote_key(key.get_ref()), key.span(), value);
        }
        origins
    }

    /// Returns the origins of the keys of a tree that code made.
    pub(crate) fn of_code(tree: &Table) -> Self {
        let mut origins = Self::default();
        for (key, value) in tree {
            origins.put(&quote_key(key), value);
        }
        origins
    }

    /// Returns the origins after an edit that made `before` into `after`: keys with another value come from the
    /// edit, and so do tables and arrays that lost a key; all others keep their origin.
    pub(crate) fn edited(&self, before: &Table, after: &Table) -> Self {
        let mut origins = self.clone();
        origins.n_edits += 1;
        origins.follow("", children_of_table(before), children_of_table(after));
        origins
    }

    /// Returns the origin of the key at a path, if the case gives it.
    pub(crate) fn get(&self, path: &str) -> Option<&KeyOrigin> {
        self.by_path.get(path)
    }

    /// Returns the origin of the key at a path, or else that of the nearest table around it.
    pub(crate) fn nearest(&self, mut path: &str) -> Option<&KeyOrigin> {
        loop {
            if let Some(origin) = self.get(path) {
                return Some(origin);
            }
            path = &path[..path.rfind('.')?];
        }
    }

    /// Returns the path whose value, or else whose key, has this span; the deepest of several.
    pub(crate) fn path_of(&self, span: &Range<usize>) -> Option<&str> {
        let deepest = |is_match: &dyn Fn(&KeyOrigin) -> bool| {
            let found = self.by_path.iter().filter(|(_, origin)| is_match(origin));
            found.map(|(path, _)| path.as_str()).max_by_key(|path| path.matches('.').count())
        };
        deepest(&|origin| matches!(origin, KeyOrigin::Text { value, .. } if value == span)).or_else(
            || deepest(&|origin| matches!(origin, KeyOrigin::Text { key, .. } if key == span)),
        )
    }

    /// Returns the paths of all keys.
    pub(crate) fn paths(&self) -> impl Iterator<Item = &str> {
        self.by_path.keys().map(String::as_str)
    }

    /// Returns the paths of all arrays in the texts.
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
        self.by_path.insert(path, KeyOrigin::Text { key, value: value.span() });
    }

    /// Records that code gave this value, with all that it contains.
    fn put(&mut self, path: &str, value: &Value) {
        self.by_path.insert(path.to_string(), KeyOrigin::Code { edit: self.n_edits });
        for (key, value) in children(value).unwrap_or_default() {
            self.put(&join(path, &key), value);
        }
    }

    /// Removes the origins at and below this path.
    fn forget(&mut self, path: &str) {
        let below = join(path, "");
        self.by_path.retain(|other, _| other != path && !other.starts_with(&below));
    }

    /// Updates the origins below a table or array that an edit changed.
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
                self.by_path.insert(path.to_string(), KeyOrigin::Code { edit: self.n_edits });
            }
        }
    }
}

/// Values by their keys or indices.
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
