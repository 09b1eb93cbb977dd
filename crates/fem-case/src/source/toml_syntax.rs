//! TOML syntax: dotted paths of keys (`body.0.sphere.diameter`, `material."my glass".density`), spans
//! relative to another start, and single-line messages.

use std::ops::Range;

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

/// Returns the span of the line of a text around an offset.
fn line_around(text: &str, offset: usize) -> Range<usize> {
    let (before, after) = text.split_at_checked(offset).unwrap_or((text, ""));
    let start = before.rfind('\n').map_or(0, |at| at + 1);
    let end = after.find('\n').map_or(text.len(), |at| before.len() + at);
    start..end
}

/// Returns the line that causes a syntax error at an offset, and what to write in it. It is the line of the offset, or the
/// one before it, which may have an open quote.
pub(crate) fn syntax_help(text: &str, offset: usize) -> (Range<usize>, String) {
    const CURLY: [char; 7] = ['“', '”', '„', '‘', '’', '«', '»'];
    let own = line_around(text, offset);
    let before = line_around(text, own.start.saturating_sub(1));
    let of = |line: &Range<usize>| -> Option<String> {
        // A comment may have any signs.
        let line = text[line.clone()].split('#').next().unwrap_or_default();
        if line.contains(CURLY) {
            return Some(format!("write straight quotes: {}", line.replace(CURLY, "\"").trim()));
        }
        if !line.matches('"').count().is_multiple_of(2) {
            return Some(
                "a quote is missing: a string has one at both ends, \"22.2 mm\"".to_string(),
            );
        }
        if let Some(number) = decimal_comma(line) {
            return Some(format!(
                "a decimal comma? write {number}; a value with a unit is a string in quotes, \"{number} mm\""
            ));
        }
        let bare = text.get(offset..)?.lines().next()?.split(['#', ',', '}', ']']).next()?.trim();
        let is_words =
            bare.starts_with(|c: char| c.is_alphanumeric()) && !bare.contains(['=', '"', '\'']);
        (is_words && line.contains(bare)).then(|| format!("write it in quotes: \"{bare}\""))
    };
    let quote = |line: &Range<usize>| of(line).filter(|help| help.contains("quote"));
    match (of(&own), quote(&before)) {
        (Some(help), _) => (own, help),
        (None, Some(help)) => (before, help),
        (None, None) => {
            let help = "the file must be TOML: one `key = value` per line; a value with a unit is a string in \
                        quotes, \"22.2 mm\"";
            (own, help.to_string())
        }
    }
}

/// Returns what a file is for that is of another format than TOML.
pub(crate) fn other_format(name: &str, text: &str) -> Option<&'static str> {
    let ends_in = |ending: &str| name.to_lowercase().ends_with(ending);
    if text.trim_start().starts_with('{') {
        return Some(
            "this is JSON, such as the summary of a result: name the TOML file of the case; fem-run report FOLDER draws a result",
        );
    }
    [".csv", ".tsv", ".dat"].into_iter().any(ends_in).then_some(
        "this is a table: name the TOML file of a case; fem-run fit, calibrate and export read tables, with --data",
    )
}

/// Returns the number with a decimal comma that a line gives to a key, with a point: `0.2` of `gap = 0,2`.
fn decimal_comma(line: &str) -> Option<String> {
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
