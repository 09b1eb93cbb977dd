//! The dialects of the cells of measured tables: encodings, decimal commas, units, and cells without a value.

use std::borrow::Cow;

use fem_case::parse_quantity;

use super::column_roles::{
    SIGNS, bare, ending_of, ending_of_unit, is_one_of, uncertainty_of, with_ending,
};

/// Returns the text of a file: UTF-16, recognised by its byte order mark or its zeros, UTF-8, or else Latin-1.
pub fn decode(bytes: &[u8]) -> String {
    let of_pairs = |bytes: &[u8], read: fn([u8; 2]) -> u16| {
        let units = bytes.chunks_exact(2).map(|pair| read([pair[0], pair[1]]));
        char::decode_utf16(units).map(|c| c.unwrap_or(char::REPLACEMENT_CHARACTER)).collect()
    };
    match bytes {
        [0xff, 0xfe, rest @ ..] => return of_pairs(rest, u16::from_le_bytes),
        [0xfe, 0xff, rest @ ..] => return of_pairs(rest, u16::from_be_bytes),
        // A text begins with two ASCII letters.
        [a, 0, b, 0, ..] if *a > 0 && *b > 0 => return of_pairs(bytes, u16::from_le_bytes),
        [0, a, 0, b, ..] if *a > 0 && *b > 0 => return of_pairs(bytes, u16::from_be_bytes),
        _ => {}
    }
    match std::str::from_utf8(bytes) {
        Ok(text) => text.to_string(),
        Err(_) => bytes.iter().copied().map(char::from).collect(),
    }
}

/// Returns the name of a column in the spelling of lookups: in lower case, with `_` for spaces and with a unit as an ending.
/// `Impact speed [cm/s]` is `impact_speed_cm_s`, and so are `Impact speed in cm/s` and `Impact speed / (cm/s)`.
/// `log(t/s)` is `log_t_s`.
pub(super) fn column_name(header: &str) -> String {
    let header = header.trim();
    let logarithm = ["log10(", "log(", "lg("].iter().find_map(|log| header.strip_prefix(log));
    if let Some(inner) = logarithm.and_then(|rest| rest.strip_suffix(')')) {
        return format!("log_{}", column_name(inner));
    }
    let joined = |name: &str| name.to_lowercase().split_whitespace().collect::<Vec<_>>().join("_");
    let is_none = |unit: &str| ["-", "1", ""].contains(&unit);
    for (before, after) in [("[", "]"), ("(", ")"), (" in ", ""), (",", ""), ("/", "")] {
        let Some((name, unit)) = header.split_once(before) else { continue };
        let name = joined(name.trim().trim_end_matches(['/', ',']).trim_end_matches(" in"));
        let unit = unit.trim().trim_end_matches(after).trim();
        match ending_of_unit(unit) {
            Some(ending) => return with_ending(&name, ending),
            None if is_none(unit) && !after.is_empty() => return name,
            None => {}
        }
    }
    joined(header)
}

/// Returns the header with the names of columns that are only a sign, `±`, completed by the column before.
pub(super) fn with_signs_named(header: Vec<String>) -> Vec<String> {
    let mut named: Vec<String> = Vec::new();
    for name in header {
        let before = named.last().filter(|_| SIGNS.contains(&bare(&name)));
        let completed = before.map(|before| match ending_of(&name) {
            Some(unit) => uncertainty_of(&format!("{}{}", bare(before), unit.text)),
            None => uncertainty_of(before),
        });
        named.push(completed.unwrap_or(name));
    }
    named
}

/// Returns a value and its uncertainty from a cell such as `0.91 ± 0.02` or `30 ± 0.5 cm/s`, each with its unit; `None` for
/// any other cell. An uncertainty in per cents is a share of the value.
pub(super) fn value_and_uncertainty(cell: &str) -> Option<[String; 2]> {
    // A record has millions of plain numbers.
    if !cell.contains(['±', '+', '(']) {
        return None;
    }
    let Some((value, uncertainty)) = SIGNS.iter().find_map(|sign| cell.split_once(sign)) else {
        return of_last_digits(cell);
    };
    let (value, uncertainty) = (value.trim(), uncertainty.trim());
    let number = |text: &str| with_point(text).parse::<f64>().ok();
    let (Some(bare), None) = (number(value), number(uncertainty)) else {
        return Some([value.to_string(), uncertainty.to_string()]);
    };
    if let Some(share) = uncertainty.strip_suffix('%').and_then(|share| number(share.trim())) {
        let own = format!("{:?}", bare.abs() * share * 1e-2);
        let own = if value.contains(',') { own.replace('.', ",") } else { own };
        return Some([value.to_string(), own]);
    }
    let is_digit = |c: char| c.is_ascii_digit() || ".,eE+-".contains(c);
    let unit = uncertainty.trim_start_matches(is_digit).trim();
    Some([format!("{value} {unit}"), uncertainty.to_string()])
}

/// Returns the value and the uncertainty of `0.842(15)`, which is 0.842 ± 0.015.
fn of_last_digits(cell: &str) -> Option<[String; 2]> {
    let (value, digits) = cell.strip_suffix(')')?.split_once('(')?;
    let decimals = value.split_once(['.', ',']).map_or(0, |(_, decimals)| decimals.len());
    with_point(value).parse::<f64>().ok()?;
    let last =
        digits.parse::<u32>().ok().map(|digits| f64::from(digits) / 10f64.powi(decimals as i32));
    let uncertainty = last.map_or(digits.to_string(), |last| format!("{last:.decimals$}"));
    with_point(&uncertainty).parse::<f64>().ok()?;
    let uncertainty = if value.contains(',') { uncertainty.replace('.', ",") } else { uncertainty };
    Some([value.to_string(), uncertainty])
}

/// Whether a cell names what is computed from the rows above it. A record has millions of cells, which begin with a digit.
pub(super) fn is_mean(cell: &str) -> bool {
    const WORDS: &str = "mean|average|avg|mittelwert|mittel|moyenne|median|std|sd|standard deviation|standardabweichung";
    let is_word = |word: &str| cell.trim_end_matches([':', '.']).eq_ignore_ascii_case(word);
    cell.starts_with(char::is_alphabetic) && WORDS.split('|').any(is_word)
}

/// Whether a cell below a name is a unit, `cm`, `[cm]` or `(cm)`.
pub(super) fn is_unit(cell: &str) -> bool {
    // The unit of a signal does not matter.
    let unit = without_brackets(cell);
    is_one_of(unit, "V mV Volt Volts") || ending_of_unit(unit).is_some()
}

fn without_brackets(cell: &str) -> &str {
    cell.trim_start_matches(['[', '(']).trim_end_matches([']', ')']).trim()
}

/// Returns the names of columns with the units of the row below them, `speed` above `mm/s`, if that is a row of units:
/// each cell is a unit above a number or has no value, and at least one is a unit.
pub(super) fn with_units(
    header: &[String],
    row: &[String],
    next: &[String],
) -> Option<Vec<String>> {
    let is_number = |cell: &str| {
        parse_quantity(&with_point(cell)).is_ok() || value_and_uncertainty(cell).is_some()
    };
    // `1/MPa` is a unit.
    if row.iter().any(|cell| is_number(cell) && !cell.starts_with("1/")) {
        return None;
    }
    let unit = |cell: &String| match is_missing(cell) {
        true => None,
        false => ending_of_unit(without_brackets(cell)),
    };
    let units: Vec<Option<&str>> = row.iter().map(unit).collect();
    let fits = |(unit, below): (&Option<&str>, &String)| {
        unit.is_none() || is_number(below) || is_missing(below)
    };
    let is_row = units.iter().any(Option::is_some) && units.iter().zip(next).all(fits);
    let named = |(name, unit): (&String, &Option<&str>)| match unit {
        Some(unit) if !name.ends_with(unit) => with_ending(name, unit),
        _ => name.clone(),
    };
    is_row.then(|| header.iter().zip(&units).map(named).collect())
}

/// Whether a cell has no value.
pub(super) fn is_missing(cell: &str) -> bool {
    !cell.starts_with(|first: char| first.is_ascii_digit())
        && " nan na n/a n.a. #n/a null - --".split(' ').any(|word| cell.eq_ignore_ascii_case(word))
}

/// Returns a number with a decimal comma, such as `0,92` or `5,5 cm/s`, with a point; any other text is unchanged.
pub(super) fn with_point(cell: &str) -> Cow<'_, str> {
    let is_digit = |c: Option<char>| c.is_some_and(|c| c.is_ascii_digit());
    let Some((before, after)) = cell.split_once(',') else { return Cow::Borrowed(cell) };
    let is_decimal = is_digit(before.chars().last())
        && is_digit(after.chars().next())
        && !after.contains(',')
        && !before.contains('.');
    if is_decimal { Cow::Owned(format!("{before}.{after}")) } else { Cow::Borrowed(cell) }
}
