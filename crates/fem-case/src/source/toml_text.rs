//! Helpers for readers of TOML: spans that count from elsewhere, messages of one line.

use toml::Spanned;
use toml::de::{DeArray, DeTable, DeValue};

/// The same value with all of its spans moved by `start`.
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

/// The parser's messages may go on with a list of what it expected.
pub(crate) fn first_line(message: &str) -> String {
    message.lines().next().unwrap_or("not TOML").to_string()
}
