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

/// Returns the line of a text around an offset.
pub(crate) fn line_at(text: &str, offset: usize) -> &str {
    let (before, after) = text.split_at_checked(offset).unwrap_or((text, ""));
    let start = before.rfind('\n').map_or(0, |at| at + 1);
    let end = after.find('\n').map_or(text.len(), |at| before.len() + at);
    &text[start..end]
}

/// Returns the number with a decimal comma that a line gives to a key, with a point: `0.2` of `gap = 0,2`.
pub(crate) fn decimal_comma(line: &str) -> Option<String> {
    line.split('=').skip(1).find_map(|after| {
        let after = after.trim_start();
        let is_part = |c: char| c.is_ascii_digit() || c == ',' || c == '-';
        let number = &after[..after.find(|c| !is_part(c)).unwrap_or(after.len())];
        let (whole, decimals) = number.split_once(',')?;
        let is_number = !whole.is_empty() && !decimals.is_empty() && !decimals.contains(',');
        is_number.then(|| format!("{whole}.{decimals}"))
    })
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
