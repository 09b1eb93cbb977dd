//! Layouts of instruments and programs whose lines are no rows of a table: no header, or settings beside the samples.

use std::borrow::Cow;

use super::preamble::{Separator, is_number};

/// Lines in which the settings of an oscilloscope are searched.
const SEARCHED: usize = 50;

/// Returns the text as a table below a header, and the number of lines that were added above it.
pub(super) fn as_table(text: &str) -> (Cow<'_, str>, u64) {
    let lines: Vec<&str> = text.lines().take(SEARCHED).collect();
    let layouts = [
        labels as fn(&str, &[&str]) -> Option<(String, u64)>,
        columns_of_settings,
        steps,
        intervals,
    ];
    let found = layouts.into_iter().find_map(|layout| layout(text, &lines));
    found.map_or((text.into(), 0), |(text, n_added)| (text.into(), n_added))
}

/// The label track of an audio editor: begin, end and label, separated by tabs, without a header.
fn labels(text: &str, lines: &[&str]) -> Option<(String, u64)> {
    let is_label = |line: &&str| {
        let cells: Vec<&str> = line.split('\t').collect();
        cells.len() == 3 && cells[..2].iter().all(|cell| is_number(cell))
    };
    // A spectral selection is a line of its own, which begins with a backslash.
    let mut labels = lines.iter().filter(|line| !line.trim().is_empty() && !line.starts_with('\\'));
    let is_track = lines.first().is_some_and(is_label) && labels.all(is_label);
    is_track.then(|| ("time_s\tend_s\tlabel\n".to_string() + &text.replace("\n\\", "\n#"), 1))
}

/// Tektronix: settings in the first three columns, time and voltage in the fourth and the fifth, without a header.
fn columns_of_settings(text: &str, lines: &[&str]) -> Option<(String, u64)> {
    let samples = |line: &str| -> Option<String> {
        let cells: Vec<&str> = line.split(',').map(str::trim).collect();
        let [_, _, _, time, voltage, ..] = cells[..] else { return None };
        (is_number(time) && is_number(voltage)).then(|| format!("{time},{voltage}"))
    };
    let has_settings = lines.first()?.starts_with(|c: char| c.is_alphabetic());
    if !has_settings || !lines.iter().all(|line| samples(line).is_some()) {
        return None;
    }
    let rows = text.lines().map(|line| samples(line).unwrap_or_default() + "\n");
    Some(("time_s,ch1\n".to_string() + &rows.collect::<String>(), 1))
}

/// RheoCompass: intervals of rows that begin with an empty cell, below names that follow `Interval data:`, a blank line and units.
fn intervals(text: &str, lines: &[&str]) -> Option<(String, u64)> {
    const NAMES: &str = "Interval data:";
    let names = lines.iter().find_map(|line| line.trim_start_matches('"').strip_prefix(NAMES))?;
    let separator = names.trim_start_matches('"').chars().next()?;
    let (mut n_names, mut n_units) = (0, 0);
    let row = |line: &str| {
        let (first, rest) = line.split_once(separator).unwrap_or((line, ""));
        let is_names = first.trim_matches('"') == NAMES;
        let is_row = first.is_empty() && n_names > 0 && !rest.trim().is_empty();
        let is_units = is_row && rest.contains('[');
        n_names += usize::from(is_names);
        n_units += usize::from(is_units);
        // Names and units stand above each interval.
        match is_names && n_names == 1 || is_row && !(is_units && n_units > 1) {
            true => format!("{rest}\n"),
            false => format!("#{line}\n"),
        }
    };
    Some((text.lines().map(row).collect(), 0))
}

/// Rigol: numbers of samples, with start and increment of the time beside the names of the channels.
fn steps(text: &str, lines: &[&str]) -> Option<(String, u64)> {
    let cells = |line: &str| -> Vec<String> {
        Separator::of(line).cells(line).map(str::to_lowercase).collect()
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
    let row = |(k, line): (usize, &str)| {
        let cells = cells(line);
        let channels = cells[cells.len().min(1)..cells.len().min(n_channels)].join(",");
        let number = cells.first().and_then(|cell| cell.parse::<f64>().ok());
        match number {
            _ if k == header => format!("time_s,{channels}\n"),
            Some(number) if k > header => {
                format!("{:.12e},{channels}\n", start + number * increment)
            }
            _ => format!("#{line}\n"),
        }
    };
    Some((text.lines().enumerate().map(row).collect(), 0))
}
