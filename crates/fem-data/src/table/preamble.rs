//! Lines above the header of a record: settings of an oscilloscope, the name of a mass, a title.

use std::borrow::Cow;

use super::csv_dialect::{is_missing, is_unit, value_and_uncertainty, with_point};

/// Lines in which the first row of numbers is searched.
const SEARCHED: usize = 500;

/// The separator of the cells of a line.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Separator {
    Blanks,
    One(char),
}

impl Separator {
    /// Returns the separator of a row of numbers.
    pub fn of(line: &str) -> Self {
        match [';', '\t', ','].into_iter().find(|separator| line.contains(*separator)) {
            Some(separator) => Self::One(separator),
            None => Self::Blanks,
        }
    }

    pub fn cells(self, line: &str) -> impl Iterator<Item = &str> {
        let (by_blanks, by_one) = match self {
            Self::Blanks => (Some(line.split_whitespace()), None),
            Self::One(separator) => (None, Some(line.split(separator))),
        };
        let cells = by_blanks.into_iter().flatten().chain(by_one.into_iter().flatten());
        cells.map(|cell| cell.trim().trim_matches('"'))
    }
}

pub(super) fn is_number(cell: &str) -> bool {
    with_point(cell).parse::<f64>().is_ok() || value_and_uncertainty(cell).is_some()
}

/// Returns the text with the lines above the header made comments, so that all lines keep their numbers.
/// With `only_titles`, lines with as many cells as the header are kept.
pub(super) fn without_preamble(text: &str, only_titles: bool) -> Cow<'_, str> {
    let lines: Vec<&str> = text.lines().take(SEARCHED).collect();
    let is_row = |line: &str| {
        let mut cells = Separator::of(line).cells(line).filter(|cell| !cell.is_empty()).peekable();
        cells.peek().is_some() && cells.all(|cell| is_number(cell) || is_missing(cell))
    };
    let n_cells = |line: &str, separator: Separator| separator.cells(line).count();
    let Some(first) = (0..lines.len()).find(|k| {
        let separator = Separator::of(lines[*k]);
        let n_next = lines.get(k + 1).map(|next| n_cells(next, separator));
        is_row(lines[*k])
            && separator.cells(lines[*k]).any(is_number)
            && n_next.is_none_or(|n| n <= 1 || n == n_cells(lines[*k], separator))
    }) else {
        return without_titles(text);
    };
    let separator = Separator::of(lines[first]);
    // Rows may end in empty cells, and a header in the name of a column of comments.
    let n_used = |line: &str| {
        let used = |(k, cell): (usize, &str)| (!cell.is_empty()).then_some(k + 1);
        separator.cells(line).enumerate().filter_map(used).last().unwrap_or(0)
    };
    let is_comment = |line: &str| line.starts_with('#') || line.trim().is_empty();
    let above = |k: usize| (0..k).rev().find(|above| !is_comment(lines[*above]));
    let is_header = |k: &usize| {
        n_cells(lines[*k], separator) >= n_used(lines[first]).min(2) && !is_row(lines[*k])
    };
    let is_of_names = |k: &usize| !separator.cells(lines[*k]).any(is_number);
    let last = above(first).filter(is_header).filter(is_of_names);
    let Some(last) = last else {
        return match above(first) {
            None => with_commented_header(text, &lines[..=first], separator),
            Some(_) => text.into(),
        };
    };
    let is_units = separator.cells(lines[last]).any(is_unit)
        && separator.cells(lines[last]).all(|cell| is_missing(cell) || is_unit(cell));
    let names = above(last).filter(|above| is_units && is_header(above));
    let header = names.unwrap_or(last);
    let is_kept =
        |line: &&str| only_titles && n_cells(line, separator) >= n_cells(lines[header], separator);
    let mut above = lines[..header].iter().filter(|line| !is_comment(line)).peekable();
    if above.peek().is_none() || above.any(is_kept) {
        return text.into();
    }
    let commented = |(k, line): (usize, &str)| match k < header {
        true => format!("#{line}\n"),
        false => format!("{line}\n"),
    };
    text.lines().enumerate().map(commented).collect::<String>().into()
}

/// Returns the text with the lines of a title made comments: those with fewer cells above a header of names, where rows begin with
/// a name.
fn without_titles(text: &str) -> Cow<'_, str> {
    let n_cells = |line: &str, separator: Separator| separator.cells(line).count();
    let is_header = |line: &str| {
        let separator = Separator::of(line);
        let is_split = separator != Separator::Blanks && n_cells(line, separator) > 2;
        is_split && separator.cells(line).all(|cell| !cell.is_empty() && !is_number(cell))
    };
    let Some((n_titles, header)) = text.lines().enumerate().find(|line| is_header(line.1)) else {
        return text.into();
    };
    let separator = Separator::of(header);
    let is_title = |line: &str| n_cells(line, separator) < n_cells(header, separator);
    if n_titles == 0 || !text.lines().take(n_titles).all(is_title) {
        return text.into();
    }
    let commented = |(k, line): (usize, &str)| match k < n_titles {
        true => format!("#{line}\n"),
        false => format!("{line}\n"),
    };
    text.lines().enumerate().map(commented).collect::<String>().into()
}

/// Returns the text with a header in place of a comment that has a name for each column, as of Netzsch or `numpy.savetxt`; `lines`
/// end with the first row.
fn with_commented_header<'t>(text: &'t str, lines: &[&str], separator: Separator) -> Cow<'t, str> {
    let [above @ .., first] = lines else { return text.into() };
    let names = |line: &str| line.trim_start_matches('#').trim_start().to_string();
    let n_cells = separator.cells(first).count();
    let is_named = |line: &&str| {
        let line = names(line);
        n_cells > 1
            && separator.cells(&line).count() == n_cells
            && separator.cells(&line).all(|cell| !cell.is_empty() && !is_number(cell))
    };
    let Some(header) = above.iter().rposition(is_named) else { return text.into() };
    let line = |(k, line): (usize, &str)| match k == header {
        true => names(line) + "\n",
        false => format!("{line}\n"),
    };
    text.lines().enumerate().map(line).collect::<String>().into()
}
