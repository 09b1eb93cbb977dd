//! Layouts of instruments and programs as tables below a header: titles and settings above it, no header, settings beside the samples,
//! blocks of rows below a temperature. A line that is no row becomes a comment, so that all lines keep their numbers.

use std::borrow::Cow;

use super::column_roles::{TEMPERATURES, is_one_of, other_ending};
use super::csv_dialect::{is_missing, is_unit, value_and_uncertainty, with_point};

/// Lines in which the settings of an oscilloscope are searched.
const SETTINGS: usize = 50;
/// Lines in which the first row of numbers is searched.
const PREAMBLE: usize = 500;

/// Returns the text with other lines; a line without another one becomes a comment.
fn with_lines<'t>(
    text: &'t str,
    mut line: impl FnMut(usize, &'t str) -> Option<Cow<'t, str>>,
) -> String {
    let mut all = String::with_capacity(text.len() + text.len() / 8);
    for (k, old) in text.lines().enumerate() {
        match line(k, old) {
            Some(new) => all.push_str(&new),
            None => all.extend(["#", old]),
        }
        all.push('\n');
    }
    all
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

/// Returns the separator of the cells of a table, from its header: the most frequent of semicolons, tabs
/// and commas; the first of these if counts are equal. A line `sep=;`, which spreadsheets write, is not the
/// header.
pub(super) fn separator(text: &str) -> (u8, &str) {
    if let Some((first, rest)) = text.split_once('\n')
        && let [separator] = first.trim_end().strip_prefix("sep=").unwrap_or("").as_bytes()
    {
        return (*separator, rest);
    }
    let header = text.lines().find(|line| !is_comment(line)).unwrap_or("");
    let count = |separator: &u8| header.bytes().filter(|byte| byte == separator).count();
    // If counts are equal, `max_by_key` takes the last.
    let separator = [b',', b'\t', b';'].into_iter().max_by_key(count).unwrap_or(b',');
    (separator, text)
}

/// Returns a text whose columns are separated by blanks only with tabs instead; any other text is unchanged.
pub(super) fn tabs_for_blanks(text: &str) -> Cow<'_, str> {
    let mut rows = text.lines().filter(|line| !is_comment(line));
    let (Some(header), Some(first)) = (rows.next(), rows.next()) else { return text.into() };
    let n_words = |line: &str| line.split_whitespace().count();
    let has_separator = separator_of(header).is_some() || header.starts_with("sep=");
    // A header of two words in one name has more words than the row below.
    if has_separator || n_words(header) < 2 || n_words(first) != n_words(header) {
        return text.into();
    }
    let tabs = |line: &str| line.split_whitespace().collect::<Vec<_>>().join("\t");
    let line = |_, line| Some(if is_comment(line) { line.into() } else { tabs(line).into() });
    with_lines(text, line).into()
}

/// Returns the record of an instrument as a table below a header, and the number of lines that were added above it.
pub(super) fn as_table(text: &str) -> (Cow<'_, str>, u64) {
    let lines: Vec<&str> = text.lines().take(SETTINGS).collect();
    if let Some(text) = labels(text, &lines).or_else(|| columns_of_settings(text, &lines)) {
        return (text.into(), 1);
    }
    let found = steps(text, &lines).or_else(|| intervals(text, &lines));
    (found.map_or(text.into(), Cow::Owned), 0)
}

/// The label track of an audio editor: begin, end and label, separated by tabs, without a header.
fn labels(text: &str, lines: &[&str]) -> Option<String> {
    let is_label = |line: &&str| {
        let cells: Vec<&str> = line.split('\t').collect();
        cells.len() == 3 && cells[..2].iter().all(|cell| is_number(cell))
    };
    // A spectral selection is a line of its own, which begins with a backslash.
    let mut labels = lines.iter().filter(|line| !line.trim().is_empty() && !line.starts_with('\\'));
    let is_track = lines.first().is_some_and(is_label) && labels.all(is_label);
    is_track.then(|| "time_s\tend_s\tlabel\n".to_string() + &text.replace("\n\\", "\n#"))
}

/// Tektronix: settings in the first three columns, time and voltage in the fourth and the fifth, without a header.
fn columns_of_settings(text: &str, lines: &[&str]) -> Option<String> {
    let samples = |line: &str| -> Option<String> {
        let [time, voltage] = cells(line, Some(',')).skip(3).take(2).collect::<Vec<_>>()[..] else {
            return None;
        };
        (is_number(time) && is_number(voltage)).then(|| format!("{time},{voltage}"))
    };
    let has_settings = lines.first()?.starts_with(|c: char| c.is_alphabetic());
    let is_scope = has_settings && lines.iter().all(|line| samples(line).is_some());
    let row = |_, line: &str| Some(samples(line).unwrap_or_default().into());
    is_scope.then(|| "time_s,ch1\n".to_string() + &with_lines(text, row))
}

/// RheoCompass: intervals of rows that begin with an empty cell, below names that follow `Interval data:`, a blank line and units.
fn intervals(text: &str, lines: &[&str]) -> Option<String> {
    const NAMES: &str = "Interval data:";
    let names = lines.iter().find_map(|line| line.trim_start_matches('"').strip_prefix(NAMES))?;
    let separator = names.trim_start_matches('"').chars().next()?;
    let (mut n_names, mut n_units) = (0, 0);
    let row = |_, line: &'_ str| {
        let (first, rest) = line.split_once(separator).unwrap_or((line, ""));
        let is_names = first.trim_matches('"') == NAMES;
        let is_row = first.is_empty() && n_names > 0 && !rest.trim().is_empty();
        let is_units = is_row && rest.contains('[');
        n_names += usize::from(is_names);
        n_units += usize::from(is_units);
        // Names and units stand above each interval.
        let is_kept = is_names && n_names == 1 || is_row && !(is_units && n_units > 1);
        is_kept.then(|| rest.to_string().into())
    };
    Some(with_lines(text, row))
}

/// Rigol: numbers of samples, with start and increment of the time beside the names of the channels.
fn steps(text: &str, lines: &[&str]) -> Option<String> {
    let cells = |line: &str| -> Vec<String> {
        cells(line, separator_of(line)).map(str::to_lowercase).collect()
    };
    let place = |line: &&str| {
        let cells = cells(line);
        let column = |name: &str| cells.iter().position(|cell| cell == name);
        Some([column("start")?, column("increment")?])
    };
    let header = lines.iter().position(|line| place(line).is_some())?;
    let columns = place(&lines[header])?;
    let settings = cells(lines.get(header + 1)?);
    let [start, increment] = columns.map(|k| settings.get(k)?.parse::<f64>().ok());
    let (start, increment) = (start?, increment?);
    let n_channels = columns.into_iter().min()?;
    let row = |k: usize, line: &str| {
        let cells = cells(line);
        let channels = cells[cells.len().min(1)..cells.len().min(n_channels)].join(",");
        if k == header {
            return Some(format!("time_s,{channels}").into());
        }
        let number = cells.first()?.parse::<f64>().ok().filter(|_| k > header)?;
        Some(format!("{:.12e},{channels}", start + number * increment).into())
    };
    Some(with_lines(text, row))
}

/// Returns the text with the lines above the header made comments. With `only_titles`, lines with as many cells as the header are
/// kept.
pub(super) fn without_preamble(text: &str, only_titles: bool) -> Cow<'_, str> {
    let lines: Vec<&str> = text.lines().take(PREAMBLE).collect();
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
        return without_titles(text);
    };
    let separator = separator_of(lines[first]);
    let cells = |k: usize| cells(lines[k], separator);
    let above = |k: usize| (0..k).rev().find(|above| !is_comment(lines[*above]));
    let Some(last) = above(first) else {
        return with_commented_header(text, &lines[..=first], separator);
    };
    // Rows may end in empty cells, and a header in the name of a column of comments.
    let n_used = cells(first).enumerate().filter(|(_, cell)| !cell.is_empty()).last();
    let n_used = n_used.map_or(0, |(k, _)| k + 1);
    let is_header = |k: &usize| cells(*k).count() >= n_used.min(2) && !is_row(lines[*k]);
    if !is_header(&last) || cells(last).any(is_number) {
        return text.into();
    }
    let is_units =
        cells(last).any(is_unit) && cells(last).all(|cell| is_missing(cell) || is_unit(cell));
    let header = above(last).filter(|above| is_units && is_header(above)).unwrap_or(last);
    let is_kept = |k: usize| only_titles && cells(k).count() >= cells(header).count();
    let mut titles = (0..header).filter(|k| !is_comment(lines[*k])).peekable();
    match titles.peek().is_none() || titles.any(is_kept) {
        true => text.into(),
        false => below(text, header),
    }
}

/// Returns the text with all lines above one made comments.
fn below(text: &str, header: usize) -> Cow<'_, str> {
    with_lines(text, |k, line| (k >= header).then(|| line.into())).into()
}

/// Returns the text with the lines of a title made comments: those with fewer cells above a header of names, where rows begin with
/// a name.
fn without_titles(text: &str) -> Cow<'_, str> {
    let n_cells = |line: &str, separator| cells(line, separator).count();
    let is_header = |line: &str| {
        let separator = separator_of(line);
        separator.is_some() && n_cells(line, separator) > 2 && is_of_names(line, separator)
    };
    let Some((n_titles, header)) = text.lines().enumerate().find(|line| is_header(line.1)) else {
        return text.into();
    };
    let separator = separator_of(header);
    let is_title = |line: &str| n_cells(line, separator) < n_cells(header, separator);
    match n_titles > 0 && text.lines().take(n_titles).all(is_title) {
        true => below(text, n_titles),
        false => text.into(),
    }
}

/// Whether each cell of a line is a name.
fn is_of_names(line: &str, separator: Option<char>) -> bool {
    cells(line, separator).all(|cell| !cell.is_empty() && !is_number(cell))
}

/// Returns the text with a header in place of a comment that has a name for each column, as of Netzsch or `numpy.savetxt`; `lines`
/// end with the first row.
fn with_commented_header<'t>(
    text: &'t str,
    lines: &[&str],
    separator: Option<char>,
) -> Cow<'t, str> {
    let [above @ .., first] = lines else { return text.into() };
    let names = |line: &'t str| line.trim_start_matches('#').trim_start();
    let n_cells = cells(first, separator).count();
    let is_named = |line: &&str| {
        let line = line.trim_start_matches('#').trim_start();
        n_cells > 1 && cells(line, separator).count() == n_cells && is_of_names(line, separator)
    };
    let Some(header) = above.iter().rposition(is_named) else { return text.into() };
    with_lines(text, |k, line| Some(if k == header { names(line) } else { line }.into())).into()
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

/// Returns a text whose blocks of rows have temperatures above them, `Temperature: 25 °C`, with a column of these instead. Names and
/// units of the columns may stand above all blocks or above each. `is_header` is true of the line of the names. `None` if a row has no
/// temperature above it, or the units of the temperatures differ.
pub(super) fn with_temperature_column(
    text: &str,
    is_header: impl Fn(&str) -> bool,
) -> Option<String> {
    let headings: Vec<_> = text.lines().map(heading).collect();
    let unit = headings.iter().flatten().next()?.1;
    if headings.iter().flatten().any(|heading| heading.1 != unit) {
        return None;
    }
    let header =
        text.lines().zip(&headings).position(|(line, it)| it.is_none() && is_header(line))?;
    let mut lines = text.lines().skip(header);
    let (names, next) = (lines.next()?, lines.next()?);
    let separator = separator_of(names).map_or(' ', |_| char::from(separator(names).0));
    let is_row = |line: &str| {
        let first = line.split(separator).map(str::trim).find(|cell| !cell.is_empty());
        let is_value = |cell: &str| with_point(cell).parse::<f64>().is_ok() || is_missing(cell);
        !line.starts_with('#') && first.is_some_and(is_value)
    };
    let has_units = !is_row(next) && headings[header + 1].is_none() && !next.trim().is_empty();
    let has_commas =
        separator != ',' && text.lines().any(|line| is_row(line) && line.contains(','));
    let (mut temperature, mut is_complete) = (None, true);
    let all = with_lines(text, |k, line| {
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
        Some(format!("{line}{separator}{cell}").into())
    });
    is_complete.then_some(all)
}
