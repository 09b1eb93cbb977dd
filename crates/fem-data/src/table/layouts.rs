//! Layouts of instruments and programs as tables below a header: titles and settings above it, no header, settings beside the samples,
//! blocks of rows below a temperature. Lines are left out or rewritten; each keeps its number.

use std::borrow::Cow;

use super::column_roles::{TEMPERATURES, is_one_of, other_ending};
use super::csv_dialect::{is_missing, is_unit, value_and_uncertainty, with_point};

/// A line of a text with its number, from 1.
pub(super) type Line<'t> = (u64, Cow<'t, str>);

/// Lines in which the settings of an oscilloscope are searched.
const SETTINGS: usize = 50;
/// Lines in which the first row of numbers is searched.
const PREAMBLE: usize = 500;

/// Returns the lines of a table, or of the record of an instrument, from the header on and without comments, and the separator of
/// their cells.
pub(super) fn table_lines(text: &str, is_record: bool) -> (Vec<Line<'_>>, u8) {
    let lines: Vec<Line<'_>> = (1..).zip(text.lines().map(Cow::from)).collect();
    let layouts: &[Layout] = if is_record { &LAYOUTS } else { &[] };
    let lines = layouts.iter().find_map(|layout| layout(&lines)).unwrap_or(lines);
    separated(without_preamble(lines, !is_record))
}

/// Returns lines without comments, and the separator of their cells: the most frequent of semicolons, tabs and commas in the header, the first
/// of these if counts are equal; tabs in place of blanks if columns are separated by blanks only. A line `sep=;`, which spreadsheets
/// write, is not the header.
pub(super) fn separated(mut lines: Vec<Line<'_>>) -> (Vec<Line<'_>>, u8) {
    lines.retain(|(_, line)| !is_comment(line));
    let first = lines.first().map_or("", |(_, line)| line.trim_end());
    if let [separator] = *first.strip_prefix("sep=").unwrap_or("").as_bytes() {
        lines.remove(0);
        return (lines, separator);
    }
    let n_words = |line: &Line<'_>| line.1.split_whitespace().count();
    // A header of two words in one name has more words than the row below.
    if let [header, row, ..] = &lines[..]
        && separator_of(first).is_none()
        && n_words(header) > 1
        && n_words(row) == n_words(header)
    {
        let tabs = |line: &str| line.split_whitespace().collect::<Vec<_>>().join("\t");
        return (lines.iter().map(|(n, line)| (*n, tabs(line).into())).collect(), b'\t');
    }
    // If counts are equal, `max_by_key` takes the last.
    let count = |separator: &u8| first.bytes().filter(|byte| byte == separator).count();
    let separator = [b',', b'\t', b';'].into_iter().max_by_key(count).unwrap_or(b',');
    (lines, separator)
}

pub(super) fn is_comment(line: &str) -> bool {
    line.starts_with('#') || line.trim().is_empty()
}

pub(super) fn is_number(cell: &str) -> bool {
    with_point(cell).parse::<f64>().is_ok() || value_and_uncertainty(cell).is_some()
}

/// Returns the cells of a line, which are separated by a character, or by blanks.
fn cells(line: &str, separator: Option<char>) -> impl Iterator<Item = &str> {
    let by_blanks = separator.is_none().then(|| line.split_whitespace());
    let by_one = separator.map(|separator| line.split(separator));
    let cells = by_blanks.into_iter().flatten().chain(by_one.into_iter().flatten());
    cells.map(|cell| cell.trim().trim_matches('"'))
}

/// Returns the separator of a row of numbers, which may have decimal commas; `None` for blanks.
fn separator_of(line: &str) -> Option<char> {
    [';', '\t', ','].into_iter().find(|separator| line.contains(*separator))
}

/// Returns the record of an instrument as a table below a header, if it has the layout.
type Layout = for<'t> fn(&[Line<'t>]) -> Option<Vec<Line<'t>>>;

const LAYOUTS: [Layout; 4] = [labels, columns_of_settings, steps, intervals];

/// Returns the first lines.
fn first_lines<'a>(lines: &'a [Line<'_>]) -> impl Iterator<Item = &'a str> {
    lines.iter().take(SETTINGS).map(|(_, line)| &**line)
}

/// Returns lines rewritten, without those of which nothing is left.
fn rewritten<'t>(
    lines: &[Line<'_>],
    mut row: impl FnMut(usize, &str) -> Option<String>,
) -> Vec<Line<'t>> {
    let rows = lines.iter().enumerate();
    rows.filter_map(|(k, (n, line))| Some((*n, row(k, line)?.into()))).collect()
}

/// The label track of an audio editor: begin, end and label, separated by tabs, without a header.
fn labels<'t>(lines: &[Line<'t>]) -> Option<Vec<Line<'t>>> {
    let is_label = |line: &str| {
        let cells: Vec<&str> = line.split('\t').collect();
        cells.len() == 3 && cells[..2].iter().all(|cell| is_number(cell))
    };
    // A spectral selection is a line of its own, which begins with a backslash.
    let is_kept = |line: &str| !line.trim().is_empty() && !line.starts_with('\\');
    let is_track = is_label(&lines.first()?.1)
        && first_lines(lines).filter(|line| is_kept(line)).all(is_label);
    let labels = lines.iter().filter(|(_, line)| is_kept(line)).cloned();
    is_track.then(|| std::iter::once((1, "time_s\tend_s\tlabel".into())).chain(labels).collect())
}

/// Tektronix: settings in the first three columns, time and voltage in the fourth and the fifth, without a header.
fn columns_of_settings<'t>(lines: &[Line<'t>]) -> Option<Vec<Line<'t>>> {
    let samples = |line: &str| -> Option<String> {
        let [time, voltage] = cells(line, Some(',')).skip(3).take(2).collect::<Vec<_>>()[..] else {
            return None;
        };
        (is_number(time) && is_number(voltage)).then(|| format!("{time},{voltage}"))
    };
    let has_settings = lines.first()?.1.starts_with(|c: char| c.is_alphabetic());
    let is_scope = has_settings && first_lines(lines).all(|line| samples(line).is_some());
    let rows = || rewritten(lines, |_, line| samples(line));
    is_scope.then(|| std::iter::once((1, "time_s,ch1".into())).chain(rows()).collect())
}

/// RheoCompass: intervals of rows that begin with an empty cell, below names that follow `Interval data:`, a blank line and units.
fn intervals<'t>(lines: &[Line<'t>]) -> Option<Vec<Line<'t>>> {
    const NAMES: &str = "Interval data:";
    let names =
        first_lines(lines).find_map(|line| line.trim_start_matches('"').strip_prefix(NAMES))?;
    let separator = names.trim_start_matches('"').chars().next()?;
    let (mut n_names, mut n_units) = (0, 0);
    let row = |_, line: &str| {
        let (first, rest) = line.split_once(separator).unwrap_or((line, ""));
        let is_names = first.trim_matches('"') == NAMES;
        let is_row = first.is_empty() && n_names > 0 && !rest.trim().is_empty();
        let is_units = is_row && rest.contains('[');
        n_names += usize::from(is_names);
        n_units += usize::from(is_units);
        // Names and units stand above each interval.
        let is_kept = is_names && n_names == 1 || is_row && !(is_units && n_units > 1);
        is_kept.then(|| rest.to_string())
    };
    Some(rewritten(lines, row))
}

/// Rigol: numbers of samples, with start and increment of the time beside the names of the channels.
fn steps<'t>(lines: &[Line<'t>]) -> Option<Vec<Line<'t>>> {
    let cells = |line: &str| -> Vec<String> {
        cells(line, separator_of(line)).map(str::to_lowercase).collect()
    };
    let place = |line: &str| {
        let cells = cells(line);
        let column = |name: &str| cells.iter().position(|cell| cell == name);
        Some([column("start")?, column("increment")?])
    };
    let (header, columns) =
        first_lines(lines).enumerate().find_map(|(k, line)| Some((k, place(line)?)))?;
    let settings = cells(&lines.get(header + 1)?.1);
    let [start, increment] = columns.map(|k| settings.get(k)?.parse::<f64>().ok());
    let (start, increment) = (start?, increment?);
    let n_channels = columns.into_iter().min()?;
    let row = |k: usize, line: &str| {
        let cells = cells(line);
        let channels = cells[cells.len().min(1)..cells.len().min(n_channels)].join(",");
        if k == header {
            return Some(format!("time_s,{channels}"));
        }
        let number = cells.first()?.parse::<f64>().ok().filter(|_| k > header)?;
        Some(format!("{:.12e},{channels}", start + number * increment))
    };
    Some(rewritten(lines, row))
}

/// Returns the lines from the header on. With `only_titles`, lines with as many cells as the header are kept above it.
fn without_preamble(mut all: Vec<Line<'_>>, only_titles: bool) -> Vec<Line<'_>> {
    let lines: Vec<&str> = all.iter().take(PREAMBLE).map(|(_, line)| &**line).collect();
    let is_row = |line: &str| {
        let mut cells = cells(line, separator_of(line)).filter(|cell| !cell.is_empty()).peekable();
        cells.peek().is_some() && cells.all(|cell| is_number(cell) || is_missing(cell))
    };
    let Some(first) = (0..lines.len()).find(|k| {
        let separator = separator_of(lines[*k]);
        let n_next = lines.get(k + 1).map(|next| cells(next, separator).count());
        is_row(lines[*k])
            && cells(lines[*k], separator).any(is_number)
            && n_next.is_none_or(|n| n <= 1 || n == cells(lines[*k], separator).count())
    }) else {
        let n_titles = n_titles(&lines);
        return all.split_off(n_titles);
    };
    let separator = separator_of(lines[first]);
    let cells = |k: usize| cells(lines[k], separator);
    let above = |k: usize| (0..k).rev().find(|above| !is_comment(lines[*above]));
    let Some(last) = above(first) else {
        if let Some(header) = commented_header(&lines[..=first], separator) {
            let names = lines[header].trim_start_matches('#').trim_start().to_string();
            all[header].1 = names.into();
        }
        return all;
    };
    // Rows may end in empty cells, and a header in the name of a column of comments.
    let n_used = cells(first).enumerate().filter(|(_, cell)| !cell.is_empty()).last();
    let n_used = n_used.map_or(0, |(k, _)| k + 1);
    let is_header = |k: &usize| cells(*k).count() >= n_used.min(2) && !is_row(lines[*k]);
    if !is_header(&last) || cells(last).any(is_number) {
        return all;
    }
    let is_units =
        cells(last).any(is_unit) && cells(last).all(|cell| is_missing(cell) || is_unit(cell));
    let header = above(last).filter(|above| is_units && is_header(above)).unwrap_or(last);
    let is_kept = |k: usize| only_titles && cells(k).count() >= cells(header).count();
    let has_kept = (0..header).any(|k| !is_comment(lines[k]) && is_kept(k));
    if has_kept { all } else { all.split_off(header) }
}

/// Returns the number of lines of a title: those with fewer cells above a header of names, where rows begin with a name.
fn n_titles(lines: &[&str]) -> usize {
    let n_cells = |line: &str, separator| cells(line, separator).count();
    let is_header = |line: &&str| {
        let separator = separator_of(line);
        separator.is_some() && n_cells(line, separator) > 2 && is_of_names(line, separator)
    };
    let Some(header) = lines.iter().position(is_header) else { return 0 };
    let separator = separator_of(lines[header]);
    let n_header = n_cells(lines[header], separator);
    let is_title = |line: &&str| n_cells(line, separator) < n_header;
    if lines[..header].iter().all(is_title) { header } else { 0 }
}

/// Whether each cell of a line is a name.
fn is_of_names(line: &str, separator: Option<char>) -> bool {
    cells(line, separator).all(|cell| !cell.is_empty() && !is_number(cell))
}

/// Returns the place of a comment that has a name for each column, as of Netzsch or `numpy.savetxt`; `lines` end with the first row.
fn commented_header(lines: &[&str], separator: Option<char>) -> Option<usize> {
    let (first, above) = lines.split_last()?;
    let n_cells = cells(first, separator).count();
    let is_named = |line: &&str| {
        let line = line.trim_start_matches('#').trim_start();
        n_cells > 1 && cells(line, separator).count() == n_cells && is_of_names(line, separator)
    };
    above.iter().rposition(is_named)
}

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
    let is_named = is_one_of(bare, TEMPERATURES) && (bare.len() > 1 || bare != name);
    match other_ending(unit).filter(|it| ["_degc", "_kelvin", "_degf"].contains(it)) {
        Some(ending) if is_named || bare.is_empty() => Some((number, ending)),
        None if unit.is_empty() && is_named => Some((number, "_degc")),
        _ => None,
    }
}

/// Returns a text whose blocks of rows have temperatures above them, `Temperature: 25 °C`, with a column of these instead, as
/// [`table_lines`] does. Names and units of the columns may stand above all blocks or above each. `is_header` is true of the line of the
/// names. `None` if a row has no temperature above it, or the units of the temperatures differ.
pub(super) fn with_temperature_column(
    text: &str,
    is_header: impl Fn(&str) -> bool,
) -> Option<(Vec<Line<'_>>, u8)> {
    let headings: Vec<_> = text.lines().map(heading).collect();
    let unit = headings.iter().flatten().next()?.1;
    if headings.iter().flatten().any(|heading| heading.1 != unit) {
        return None;
    }
    let lines: Vec<Line<'_>> = (1..).zip(text.lines().map(Cow::from)).collect();
    let header =
        lines.iter().zip(&headings).position(|(line, it)| it.is_none() && is_header(&line.1))?;
    let next = &*lines.get(header + 1)?.1;
    let separator = match separator_of(&lines[header].1) {
        None => ' ',
        Some(_) => char::from(separated(vec![lines[header].clone()]).1),
    };
    let is_row = |line: &str| {
        let first = line.split(separator).map(str::trim).find(|cell| !cell.is_empty());
        let is_value = |cell: &str| with_point(cell).parse::<f64>().is_ok() || is_missing(cell);
        !line.starts_with('#') && first.is_some_and(is_value)
    };
    let has_units = !is_row(next) && headings[header + 1].is_none() && !next.trim().is_empty();
    let has_commas =
        separator != ',' && text.lines().any(|line| is_row(line) && line.contains(','));
    let (mut temperature, mut is_complete) = (None, true);
    let rows = rewritten(&lines, |k, line| {
        let cell = if let Some((value, _)) = headings[k] {
            let value = value.to_string();
            temperature = Some(if has_commas { value.replace('.', ",") } else { value });
            return None;
        } else if k == header {
            format!("temperature{unit}")
        } else if k == header + 1 && has_units {
            "-".to_string()
        } else if k > header && is_row(line) {
            is_complete &= temperature.is_some();
            temperature.clone()?
        } else {
            return None;
        };
        Some(format!("{line}{separator}{cell}"))
    });
    is_complete.then(|| separated(rows))
}
