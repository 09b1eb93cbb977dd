//! TOML syntax: dotted paths of keys (`body.0.sphere.diameter`, `material."my glass".density`), spans
//! relative to another start, and single-line messages.

use toml::Spanned;
use toml::de::{DeArray, DeTable, DeValue};

/// Returns `path.key`, or just the key at the root.
pub(crate) fn join(path: &str, key: &str) -> String {
    if path.is_empty() { key.to_string() } else { format!("{path}.{key}") }
}

/// Returns a key as one part of a dotted path: bare if TOML allows that, quoted if not.
pub(crate) fn quote_key(key: &str) -> String {
    if !key.is_empty() && key.chars().all(is_bare) { key.to_string() } else { format!("{key:?}") }
}

/// Returns whether a key may contain this character without quotes.
pub(crate) fn is_bare(c: char) -> bool {
    c.is_ascii_alphanumeric() || c == '_' || c == '-'
}

/// Returns a value with all of its spans moved by `start`.
pub(crate) fn shift(value: Spanned<DeValue<'_>>, start: usize) -> Spanned<DeValue<'_>> {
    let span = value.span();
    let value = match value.into_inner() {
        DeValue::Array(array) => {
            let items = array.into_iter().map(|item| shift(item, start));
            DeValue::Array(items.collect::<DeArray<'_>>())
        }
        DeValue::Table(table) => {
            let mut moved = DeTable::new();
            for (key, value) in table {
                let span = key.span();
                let key = Spanned::new(span.start + start..span.end + start, key.into_inner());
                moved.insert(key, shift(value, start));
            }
            DeValue::Table(moved)
        }
        scalar => scalar,
    };
    Spanned::new(span.start + start..span.end + start, value)
}

/// Returns the first line of a parser's message; a list of expected tokens may follow it.
pub(crate) fn first_line(message: &str) -> String {
    message.lines().next().unwrap_or("not TOML").to_string()
}
