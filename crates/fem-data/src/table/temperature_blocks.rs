//! Blocks of rows below lines with a temperature, `Temperature: 25 °C`, as a column of temperatures.

use std::fmt::Write;

use super::column_roles::{TEMPERATURES, other_ending};
use super::csv_dialect::{is_missing, separator, with_point};

/// Returns the temperature of a line that has nothing else, with the ending of its unit.
fn heading(line: &str) -> Option<(f64, &'static str)> {
    let plain = line.trim_matches(|c: char| c.is_whitespace() || "#;,[]\"".contains(c));
    let start = plain.find(|c: char| c.is_ascii_digit() || "+-".contains(c))?;
    let (name, value) = plain.split_at(start);
    let name = name.trim().to_lowercase();
    let bare = name.trim_end_matches([':', '=', ',', ';', '\t', ' ']);
    let end = value.rfind(|c: char| c.is_ascii_digit())? + 1;
    let number = with_point(&value[..end]).parse::<f64>().ok()?;
    let unit = value[end..].trim_matches(|c: char| c.is_whitespace() || ";,[]()".contains(c));
    let is_named = TEMPERATURES.contains(&bare) && (bare.len() > 1 || bare != name);
    match other_ending(unit).filter(|it| ["_degc", "_kelvin", "_degf"].contains(it)) {
        Some(ending) if is_named || bare.is_empty() => Some((number, ending)),
        None if unit.is_empty() && is_named => Some((number, "_degc")),
        _ => None,
    }
}

/// Returns a text whose blocks of rows have temperatures above them with a column of these instead; the lines keep their numbers. Names
/// and units of the columns may stand above all blocks or above each. `is_header` is true of the line of the names. `None` if a row has no
/// temperature above it, or the units of the temperatures differ.
pub(super) fn with_temperature_column(
    text: &str,
    is_header: impl Fn(&str) -> bool,
) -> Option<String> {
    let header = text.lines().position(|line| heading(line).is_none() && is_header(line))?;
    let mut lines = text.lines().skip(header);
    let (names, next) = (lines.next()?, lines.next()?);
    let separator = match names.contains([',', ';', '\t']) {
        true => char::from(separator(names).0),
        false => ' ',
    };
    let is_number = |cell: &str| with_point(cell.trim()).parse::<f64>().is_ok();
    let is_row = |line: &str| {
        let mut cells = line.split(separator).map(str::trim).filter(|cell| !cell.is_empty());
        let first = cells.next();
        !line.starts_with('#') && first.is_some_and(|cell| is_number(cell) || is_missing(cell))
    };
    let has_units = !is_row(next) && heading(next).is_none() && !next.trim().is_empty();
    let has_commas =
        separator != ',' && text.lines().any(|line| is_row(line) && line.contains(','));
    let mut unit = None;
    let mut temperature = None;
    let mut all = String::new();
    for (k, line) in text.lines().enumerate() {
        if let Some((value, ending)) = heading(line) {
            if *unit.get_or_insert(ending) != ending {
                return None;
            }
            let value = format!("{value}");
            temperature = Some(if has_commas { value.replace('.', ",") } else { value });
            writeln!(all, "#{line}").ok()?;
        } else if k == header {
            // The unit is that of the headings, which may come later.
            writeln!(all, "{line}{separator}temperature\u{0}").ok()?;
        } else if k == header + 1 && has_units {
            writeln!(all, "{line}{separator}-").ok()?;
        } else if k > header && is_row(line) {
            writeln!(all, "{line}{separator}{}", temperature.as_ref()?).ok()?;
        } else {
            writeln!(all, "#{line}").ok()?;
        }
    }
    Some(all.replace('\u{0}', unit?))
}
