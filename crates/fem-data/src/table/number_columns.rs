//! Columns of numbers from long records: tracks, traces and lists of instants, as instruments and programs export them.
//!
//! Lines above the header (`mass_A`, settings of an oscilloscope) are skipped. The header is read like that of any
//! [`Table`]; the numbers below it are read without keeping their text, since a record may have millions of them.

use std::borrow::Cow;

use fem_case::parse_quantity;

use super::column_roles::{before_brackets, ending_of};
use super::csv_dialect::{is_missing, is_unit, separator, tabs_for_blanks, with_point};
use super::csv_table::Table;
use super::data_error::DataError;

/// Rows that are read as a table, for the names of the columns.
const HEAD_ROWS: usize = 20;
/// Lines in which the first row of numbers is searched.
const SEARCHED: usize = 500;

/// A record of columns: its header, and the text below it.
#[derive(Clone, Debug)]
pub struct NumberColumns<'a> {
    head: Table,
    text: Cow<'a, str>,
    separator: Separator,
}

/// The numbers of one column.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct NumberColumn {
    /// The values, SI; `NaN` for a cell without a value.
    pub values: Vec<f64>,
    /// The step of the last digit that the record has, SI.
    pub resolution: f64,
}

#[derive(Clone, Copy, Debug, PartialEq)]
enum Separator {
    Blanks,
    One(char),
}

impl Separator {
    /// Returns the separator of a row of numbers.
    fn of(line: &str) -> Self {
        match [';', '\t', ','].into_iter().find(|separator| line.contains(*separator)) {
            Some(separator) => Self::One(separator),
            None => Self::Blanks,
        }
    }

    fn cells(self, line: &str) -> impl Iterator<Item = &str> {
        let (by_blanks, by_one) = match self {
            Self::Blanks => (Some(line.split_whitespace()), None),
            Self::One(separator) => (None, Some(line.split(separator))),
        };
        let cells = by_blanks.into_iter().flatten().chain(by_one.into_iter().flatten());
        cells.map(|cell| cell.trim().trim_matches('"'))
    }
}

fn is_number(cell: &str) -> bool {
    with_point(cell).parse::<f64>().is_ok()
}

/// Returns the text with the lines above the header made comments, so that all lines keep their numbers.
pub(super) fn without_preamble(text: &str) -> Cow<'_, str> {
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
        return text.into();
    };
    let separator = Separator::of(lines[first]);
    let is_header = |k: &usize| {
        n_cells(lines[*k], separator) == n_cells(lines[first], separator)
            && !lines[*k].trim().is_empty()
            && !lines[*k].starts_with('#')
            && !is_row(lines[*k])
    };
    let Some(last) = first.checked_sub(1).filter(is_header) else { return text.into() };
    let is_units = separator.cells(lines[last]).any(is_unit)
        && separator.cells(lines[last]).all(|cell| is_missing(cell) || is_unit(cell));
    let above = last.checked_sub(1).filter(|above| is_units && is_header(above));
    let header = above.unwrap_or(last);
    let is_comment = |line: &&str| line.starts_with('#') || line.trim().is_empty();
    if lines[..header].iter().all(is_comment) {
        return text.into();
    }
    let commented = |(k, line): (usize, &str)| match k < header {
        true => format!("#{line}\n"),
        false => format!("{line}\n"),
    };
    text.lines().enumerate().map(commented).collect::<String>().into()
}

impl<'a> NumberColumns<'a> {
    /// Reads the header of a text; messages refer to it by `name`.
    ///
    /// # Errors
    /// The text is no CSV, has no header, or has no row.
    ///
    /// ```
    /// use fem_data::table::NumberColumns;
    ///
    /// let text = "mass_A\nt;y\ns;cm\n0,00;12,5\n0,01;\n0,02;12,7\n";
    /// let track = NumberColumns::parse("track.txt", text)?;
    /// let y = track.find(&["y"])?.expect("a column");
    /// let heights = track.numbers(y, [1, 0, 0])?;
    /// assert_eq!(heights.values[2], 0.127);
    /// assert!(heights.values[1].is_nan());
    /// assert_eq!(heights.resolution, 0.001);
    /// # Ok::<(), fem_data::table::DataError>(())
    /// ```
    pub fn parse(name: &str, text: &'a str) -> Result<Self, DataError> {
        let text = without_preamble(text.trim_start_matches('\u{feff}'));
        let mut head = String::new();
        let mut n_rows = 0;
        for line in text.lines() {
            head.push_str(line);
            head.push('\n');
            n_rows += usize::from(!line.trim().is_empty() && !line.starts_with('#'));
            if n_rows > HEAD_ROWS {
                break;
            }
        }
        let (byte, _) = separator(&head);
        let separator = match tabs_for_blanks(&head) {
            Cow::Owned(_) => Separator::Blanks,
            Cow::Borrowed(_) => Separator::One(char::from(byte)),
        };
        Ok(Self { head: Table::parse(name, &head)?, text, separator })
    }

    /// Renames columns as [`Table::renamed`] does.
    ///
    /// # Errors
    /// The same as those of [`Table::renamed`].
    pub fn renamed(self, names: &[(&str, &str)]) -> Result<Self, DataError> {
        Ok(Self { head: self.head.renamed(names)?, ..self })
    }

    /// Returns the names of the columns.
    pub fn header(&self) -> &[String] {
        self.head.header()
    }

    /// Returns the name of the record.
    pub fn name(&self) -> &str {
        self.head.name()
    }

    /// Returns the column that has one of these names, with or without a unit.
    ///
    /// # Errors
    /// Two columns have one.
    pub fn find(&self, names: &[&str]) -> Result<Option<usize>, DataError> {
        if let Some(found) = self.head.find(names)? {
            return Ok(Some(found));
        }
        let is_it = |header: &String| names.contains(&before_brackets(header));
        Ok(self.header().iter().position(is_it))
    }

    /// Returns the column that has one of these names, as [`NumberColumns::find`] does; `wanted` describes it in the error that there
    /// is none, and `help` says how to name it.
    ///
    /// # Errors
    /// There is no such column, or two columns have one of the names.
    pub fn require(&self, names: &[&str], wanted: &str, help: &str) -> Result<usize, DataError> {
        self.find(names)?.ok_or_else(|| {
            let found = self.header().join(", ");
            self.header_fault(format!("there is no column {wanted}; found are {found}"))
                .with_help(help)
        })
    }

    /// Checks that the time of a row follows the last time, s.
    ///
    /// # Errors
    /// It does not; `help` says what to do.
    pub fn check_increase(
        &self,
        row: usize,
        last: Option<&f64>,
        time: f64,
        help: &str,
    ) -> Result<(), DataError> {
        if last.is_none_or(|last| time > *last) {
            return Ok(());
        }
        let message = format!("the time {time} s does not increase");
        let error = DataError::new(self.name(), message).with_help(help);
        Err(match self.lines().get(row) {
            Some(line) => error.in_line(*line),
            None => error,
        })
    }

    /// Returns the line of each row in the text.
    pub fn lines(&self) -> Vec<u64> {
        self.rows().map(|(line, _)| line).collect()
    }

    fn rows(&self) -> impl Iterator<Item = (u64, &str)> {
        let first = self.head.line(0);
        let lines = self.text.lines().enumerate().map(|(k, line)| (k as u64 + 1, line));
        lines.filter(move |(number, line)| {
            *number >= first && !line.trim().is_empty() && !line.starts_with('#')
        })
    }

    /// Returns the numbers of a column of a dimension (exponents of metre, kilogram, second), SI, one for each row.
    ///
    /// # Errors
    /// A cell has another text, or the unit of the column is of another dimension.
    pub fn numbers(&self, column: usize, dimension: [i32; 3]) -> Result<NumberColumn, DataError> {
        let header = &self.header()[column];
        let fault = |message: String| self.head.header_fault(message).in_column(header);
        let scale = match ending_of(header) {
            Some(ending) if ending.dimension == dimension => ending.scale,
            Some(_) => {
                let help = "the ending of a column's name is its unit";
                return Err(
                    fault(format!("{header} has a unit of another dimension")).with_help(help)
                );
            }
            None if header.contains(['[', '(']) => {
                let help = "name the column with a unit in SI or with one of its prefixes, such as \
                            time [ms], y [cm] or force [N]";
                return Err(fault(format!("the unit of {header} is not known")).with_help(help));
            }
            None => 1.0,
        };
        self.scaled(column, scale)
    }

    /// Returns the numbers of a column as they are written, whatever their unit.
    ///
    /// # Errors
    /// A cell is no number.
    pub fn plain(&self, column: usize) -> Result<NumberColumn, DataError> {
        self.scaled(column, 1.0)
    }

    fn scaled(&self, column: usize, scale: f64) -> Result<NumberColumn, DataError> {
        let header = &self.header()[column];
        let mut found = NumberColumn::default();
        let mut n_decimals = None;
        for (line, row) in self.rows() {
            let cell = self.separator.cells(row).nth(column).unwrap_or("");
            let text = match self.separator {
                Separator::One(',') => Cow::Borrowed(cell),
                _ => with_point(cell),
            };
            if let Ok(value) = text.parse::<f64>() {
                let decimals = decimals(&text);
                n_decimals = n_decimals.max(Some(decimals));
                found.values.push(scale * value);
            } else if is_missing(cell) {
                found.values.push(f64::NAN);
            } else if let (Ok((value, _)), true) = (parse_quantity(&text), scale == 1.0) {
                found.values.push(value);
            } else {
                let message = format!("{header} is \"{cell}\", which is not a number");
                let error = DataError::new(self.name(), message).in_line(line);
                let help = "write numbers with decimal points, or with decimal commas between \
                            semicolons or tabs; leave a cell without a value empty";
                return Err(error.in_column(header).with_help(help));
            }
        }
        found.resolution = n_decimals.map_or(0.0, |n| scale * 10f64.powi(-n));
        Ok(found)
    }

    /// Returns an error about the columns.
    pub fn header_fault(&self, message: String) -> DataError {
        self.head.header_fault(message)
    }
}

/// Returns the number of digits after the decimal point, less the exponent.
fn decimals(number: &str) -> i32 {
    let (mantissa, exponent) = number.split_once(['e', 'E']).unwrap_or((number, "0"));
    let digits = mantissa.split_once('.').map_or(0, |(_, after)| after.len() as i32);
    digits - exponent.parse::<i32>().unwrap_or(0)
}
