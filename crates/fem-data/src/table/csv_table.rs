//! CSV tables with a header: cells as numbers, and errors with their line; also long records, as instruments and programs
//! export them, with lines above the header and rows of millions.
//!
//! Lines that begin with `#` are comments. A name may end in a unit, `speed_cm_s`, or have it in
//! brackets, `speed [cm/s]`, or in a row of units below the names. Without one a cell is a bare SI number or has its own
//! unit, `5 cm/s`. Cells are separated by commas, semicolons, tabs or blanks; with the latter three numbers may have
//! decimal commas.

use std::borrow::Cow;
use std::fmt::Display;

use fem_case::{Dimension, nearest, parse_quantity};
use fem_material::engineering::number;

use super::cells::Cells;
use super::column_roles::{
    UnitSuffix, bare, before_brackets, column_names, ending_of, is_key, is_one_of, readings,
    uncertainty_of,
};
use super::csv_dialect::{
    column_name, is_mean, is_missing, value_and_uncertainty, with_point, with_signs_named,
    with_units,
};
use super::data_error::{DataError, one_line};
use super::layouts::{Line, table_lines};

/// A table in memory with its cells as text, which are kept in one string.
///
/// ```
/// use fem_data::table::Table;
///
/// let table = Table::parse("e.csv", "# glass\nspeed_cm_s, e\n50, 0.925\n")?;
/// let speed = table.require("speed", "speed_m_s")?;
/// assert_eq!(table.number(0, speed, [1, 0, -1])?, 0.5);
///
/// let error = table.number(0, speed, [0, 0, 1]).unwrap_err();
/// assert_eq!(error.place(), "e.csv:3");
/// # Ok::<(), fem_data::table::DataError>(())
/// ```
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Table {
    name: String,
    header: Vec<String>,
    header_line: u64,
    cells: Cells,
    has_decimal_commas: bool,
    /// Columns that the user has renamed.
    named: Vec<usize>,
    /// Columns that have decimal logarithms: `log(t/s)`.
    logarithmic: Vec<usize>,
    /// Sentences about lines of the text that are left out.
    left_out: Vec<String>,
}

/// The numbers of one column.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct NumberColumn {
    /// The values, SI; `NaN` for a cell without a value.
    pub values: Vec<f64>,
    /// The step of the last digit that the column has, SI.
    pub resolution: f64,
}

/// The beginnings of `.xlsx`, `.ods` and other packed files, and of `.xls`, read as Latin-1.
const PACKED: [&str; 2] = ["PK\u{3}\u{4}", "\u{d0}\u{cf}\u{11}\u{e0}"];

/// Similarity of names above which one is the other misspelt, such as `diameter1` and `uncertanty`, but not
/// `contact_radius` for `contact_time`.
const MISSPELT: f64 = 0.9;

/// The dimension of a bare number.
const PLAIN: Dimension = Dimension([0; 4]);

impl Table {
    /// Returns the table with another name of a column, if it has that column.
    pub(super) fn with_name(mut self, column: &str, name: &str) -> Self {
        let found = self.header.iter_mut().find(|header| *header == column);
        found.into_iter().for_each(|header| *header = name.to_string());
        self
    }

    /// Parses a text; messages refer to it by `name`. Lines above the header, such as a title, are skipped.
    ///
    /// # Errors
    /// The text is no CSV, or has no row.
    pub fn parse(name: &str, text: &str) -> Result<Self, DataError> {
        Self::read(name, text, false)
    }

    /// Parses the record of an instrument: the settings of an oscilloscope beside its samples are left out, and rows may be
    /// longer or shorter than the header.
    ///
    /// # Errors
    /// Those of [`Table::parse`].
    ///
    /// ```
    /// use fem_data::table::Table;
    ///
    /// let text = "mass_A\nt;y\ns;cm\n0,00;12,5\n0,01;\n0,02;12,7\n";
    /// let track = Table::of_record("track.txt", text)?;
    /// let y = track.find("y")?.expect("a column");
    /// let heights = track.numbers(y, [1, 0, 0])?;
    /// assert_eq!(heights.values[2], 0.127);
    /// assert!(heights.values[1].is_nan());
    /// assert_eq!(heights.resolution, 0.001);
    /// # Ok::<(), fem_data::table::DataError>(())
    /// ```
    pub fn of_record(name: &str, text: &str) -> Result<Self, DataError> {
        Self::read(name, text, true)
    }

    fn read(name: &str, text: &str, is_record: bool) -> Result<Self, DataError> {
        let text = text.trim_start_matches('\u{feff}');
        if PACKED.iter().any(|mark| text.starts_with(mark)) {
            let error =
                DataError::new(name, "this is a spreadsheet or another packed file, not text");
            return Err(error.with_help("save the table as CSV, and name that file"));
        }
        Self::of_lines(name, table_lines(text, is_record), is_record)
    }

    /// Reads lines from the header on, whose cells are separated by a character. Rows of a table are as long as the header; those of
    /// a record have any length.
    pub(super) fn of_lines(
        name: &str,
        (lines, separator): (Vec<Line<'_>>, u8),
        is_record: bool,
    ) -> Result<Self, DataError> {
        let name = one_line(name);
        let header_line = lines.first().map_or(1, |(line, _)| *line);
        let (header, mut cells) = grid(&name, lines, separator, is_record)?;
        let names: Vec<String> = header.iter().map(|cell| column_name(cell)).collect();
        let mut header = with_signs_named(names.clone());
        let mut units = None;
        if cells.n_rows() > 1
            && let Some(with_units) = with_units(&header, &cells.row(0), &cells.row(1))
        {
            header = with_units;
            units = Some(cells.row(0));
        }
        let mean = |row: &[&str]| {
            let first = row.iter().find(|cell| !cell.is_empty())?;
            is_mean(first).then(|| first.to_string())
        };
        let mut left_out = Vec::new();
        cells.retain(|line, row| {
            if let Some(word) = mean(row) {
                left_out.push(format!("line {line} is left out: {word}"));
                return false;
            }
            // Instruments repeat names and units above each step.
            let is_name = |(cell, name): (&&str, &String)| {
                cell.parse::<f64>().is_err() && column_name(cell) == **name
            };
            !row.iter().zip(&names).all(is_name)
                && units.as_deref().is_none_or(|units| row != units)
        });
        let cells = split_uncertainties(&mut header, cells);
        let logarithmic = logarithms(&mut header);
        if cells.n_rows() == 0 {
            return Err(DataError::new(&name, "there is no row below the header"));
        }
        let (has_decimal_commas, named) = (separator != b',', Vec::new());
        let table = Self {
            name,
            header,
            header_line,
            cells,
            has_decimal_commas,
            named,
            logarithmic,
            left_out,
        };
        table.check_header()?;
        table.check_decimal_signs()?;
        Ok(table)
    }

    /// Rejects two columns of the same name, of which a reader would take one.
    fn check_header(&self) -> Result<(), DataError> {
        let first = |name: &String| self.header.iter().position(|other| other == name);
        let mut twice = (0..self.header.len()).filter_map(|second| {
            let name = &self.header[second];
            let first = first(name).filter(|first| !name.is_empty() && *first < second)?;
            Some((name, first + 1, second + 1))
        });
        let Some((name, first, second)) = twice.next() else { return Ok(()) };
        let message = format!("the columns {first} and {second} have the same name, {name}");
        Err(self.header_fault(message).in_column(name).with_help("rename one of the two"))
    }

    /// Rejects a comma in a number if other numbers of the table have points: one of the two separates thousands.
    fn check_decimal_signs(&self) -> Result<(), DataError> {
        let with = |sign: char| {
            let columns = 0..self.header.len();
            let mut cells =
                (0..self.n_rows()).flat_map(|row| columns.clone().map(move |it| (row, it)));
            let is_it =
                |cell: &str| cell.contains(sign) && parse_quantity(&with_point(cell)).is_ok();
            cells.find(|(row, column)| is_it(self.text(*row, *column)))
        };
        if self.has_decimal_commas
            && let (Some(point), Some(comma)) = (with('.'), with(','))
        {
            let [point, with_comma] = [point, comma].map(|(row, column)| self.text(row, column));
            let message = format!("\"{with_comma}\" has a comma, and \"{point}\" a point");
            return Err(self.fault(comma.0, message).with_help(
                "write all numbers with decimal points or all with decimal commas, and no separator of thousands",
            ));
        }
        Ok(())
    }

    /// Returns the table with columns renamed: `speed` for a column `v`. A name without a unit keeps that of the header.
    ///
    /// # Errors
    /// The header does not have a column, or no column is read by a name.
    ///
    /// ```
    /// use fem_data::table::Table;
    ///
    /// let table = Table::parse("e.csv", "v_cm_s;COR\n50;0,925\n")?;
    /// let table = table.renamed(&[("speed", "v_cm_s"), ("restitution", "cor")])?;
    /// assert_eq!(table.header(), ["speed_cm_s", "restitution"]);
    /// # Ok::<(), fem_data::table::DataError>(())
    /// ```
    pub fn renamed(mut self, names: &[(&str, &str)]) -> Result<Self, DataError> {
        let found = self.header.clone();
        for (name, old) in names {
            let wanted = column_name(old);
            let Some(column) = position(&found, &wanted) else {
                let message = format!("there is no column {old}; found are {}", found.join(", "));
                let near = nearest(&wanted, &found, 0.8);
                let near = near.map_or(String::new(), |near| format!("did you mean {near}? "));
                let help = format!("{near}write --columns {name}=COLUMN with one that is there");
                return Err(self.header_fault(message).with_help(help));
            };
            let name = column_name(name);
            let known = column_names();
            if !readings(&name).any(|reading| known.contains(&reading) || is_key(reading)) {
                let near = nearest(bare(&name), &known, 0.8);
                let near = near.map_or(String::new(), |near| format!("did you mean {near}? "));
                let help = format!("{near}a column may be {}", known.join(", "));
                let message = format!("--columns {name}={old}: {name} is no meaning of a column");
                return Err(DataError::new(&self.name, message).with_help(help));
            }
            let unit = ending_of(&found[column]).filter(|_| ending_of(&name).is_none());
            let name = name + unit.map_or("", |unit| unit.text);
            // Its uncertainty, perhaps of the same cells, is renamed with it.
            let own = uncertainty_of(&found[column]);
            if let Some(uncertainty) = found.iter().position(|other| *other == own) {
                self.header[uncertainty] = uncertainty_of(&name);
            }
            self.header[column] = name;
            self.named.push(column);
        }
        Ok(self)
    }

    /// Returns the column of a name, which may lack the unit if only one column fits.
    pub(super) fn position(&self, name: &str) -> Option<usize> {
        position(&self.header, name)
    }

    /// Returns the name of the table, in one line.
    pub fn name(&self) -> &str {
        &self.name
    }

    /// Returns sentences about what of the text is left out.
    pub fn left_out(&self) -> &[String] {
        &self.left_out
    }

    /// Returns the number of rows.
    pub fn n_rows(&self) -> usize {
        self.cells.n_rows()
    }

    /// Returns the names of the columns, in lower case.
    pub fn header(&self) -> &[String] {
        &self.header
    }

    /// Returns the column that has one of these names, which are separated by blanks, with or without the ending of a unit or another
    /// text in brackets.
    ///
    /// # Errors
    /// Two columns have one.
    pub fn find(&self, names: &str) -> Result<Option<usize>, DataError> {
        let is_it = |column: &usize| {
            readings(&self.header[*column]).any(|reading| is_one_of(reading, names))
        };
        if let Some(named) = self.named.iter().copied().find(is_it) {
            return Ok(Some(named));
        }
        let is_before_brackets =
            |column: &usize| is_one_of(before_brackets(&self.header[*column]), names);
        match self.only((0..self.header.len()).filter(is_it))? {
            None => self.only((0..self.header.len()).filter(is_before_brackets)),
            found => Ok(found),
        }
    }

    /// Returns the only one of these columns, if there is one.
    pub(super) fn only(
        &self,
        mut columns: impl Iterator<Item = usize>,
    ) -> Result<Option<usize>, DataError> {
        match (columns.next(), columns.next()) {
            (Some(first), Some(second)) => {
                let [first, second] = [first, second].map(|column| &self.header[column]);
                let message = format!("the columns {first} and {second} mean the same");
                let help =
                    format!("keep one of the two, or choose, such as --columns NAME={first}");
                Err(self.header_fault(message).with_help(help))
            }
            (first, _) => Ok(first),
        }
    }

    /// Returns the column that has one of these names; messages use the first of them.
    ///
    /// # Errors
    /// No column has one of the names, or two have.
    pub fn require(&self, names: &str, example: &str) -> Result<usize, DataError> {
        self.find(names)?.ok_or_else(|| {
            let name = names.split(' ').next().unwrap_or(names);
            let found = self.header.join(", ");
            let one_cell = match self.header.len() {
                1 => "; cells are separated by commas, semicolons, tabs or blanks",
                _ => "",
            };
            self.header_fault(format!("there is no column {name}; found are {found}")).with_help(
                format!(
                    "name a column {example}, or say which it is, --columns {name}=COLUMN{one_cell}"
                ),
            )
        })
    }

    /// Returns the names of the columns that are neither read nor known.
    ///
    /// # Errors
    /// The name of a column is nearly that of one that would be read.
    pub fn unread(
        &self,
        read: &[usize],
        optional: &[&str],
        is_known: impl Fn(&str) -> bool,
    ) -> Result<Vec<String>, DataError> {
        let mut unread = Vec::new();
        for (column, header) in self.header.iter().enumerate() {
            let bare = bare(header);
            let is_empty =
                header.is_empty() && (0..self.n_rows()).all(|row| self.is_missing(row, column));
            if is_empty || read.contains(&column) || is_known(header) || is_known(bare) {
                continue;
            }
            // `contact_time_spread` and `mass_uncertainty` are names of their own.
            let is_own = |near: &str| {
                bare.starts_with(&format!("{near}_")) || bare.ends_with(&format!("_{near}"))
            };
            if let Some(near) = nearest(bare, optional, MISSPELT).filter(|near| !is_own(near)) {
                let help = format!(
                    "did you mean `{near}`? columns that may be given are {}; rename one that is \
                     not to be read",
                    optional.join(", ")
                );
                let error = self.header_fault(format!("unknown column {header}"));
                return Err(error.in_column(header).with_help(help));
            }
            unread.push(one_line(header));
        }
        Ok(unread)
    }

    /// Returns the text of a cell.
    pub fn text(&self, row: usize, column: usize) -> &str {
        self.cells.cell(row, column)
    }

    /// Whether a cell has no value: it is empty, `nan`, `n/a`, `-`, ….
    pub fn is_missing(&self, row: usize, column: usize) -> bool {
        is_missing(self.text(row, column))
    }

    /// Whether numbers may have decimal commas.
    pub(super) fn has_decimal_commas(&self) -> bool {
        self.has_decimal_commas
    }

    /// Returns the line of a row in the text.
    pub fn line(&self, row: usize) -> u64 {
        self.cells.line(row)
    }

    /// Returns a cell as a number of a dimension (exponents of metre, kilogram, second), SI.
    ///
    /// # Errors
    /// The cell has another text.
    pub fn number(&self, row: usize, column: usize, dimension: [i32; 3]) -> Result<f64, DataError> {
        self.value(row, column, dimension, ending_of(&self.header[column]))
    }

    /// Returns a cell as a number of a dimension in a column whose name ends in a unit.
    fn value(
        &self,
        row: usize,
        column: usize,
        dimension: [i32; 3],
        ending: Option<UnitSuffix>,
    ) -> Result<f64, DataError> {
        let (text, header) = (self.text(row, column), &self.header[column]);
        let fault = |found: String| {
            self.fault(row, format!("{header} is \"{text}\", {found}")).in_column(header)
        };
        let cell = self.with_point(text);
        let plain = cell.parse::<f64>().ok().filter(|value| value.is_finite());
        let read = plain.map_or_else(|| parse_quantity(&cell), |value| Ok((value, PLAIN)));
        let (value, found) = read.map_err(|_| {
            let fault = fault("which is not a number".to_string());
            match (text.contains('.'), text.contains(',')) {
                (true, true) => fault.with_help("remove the separator of thousands: 1000,5 or 1000.5"),
                (false, true) if !self.has_decimal_commas => fault.with_help(
                    "cells that are separated by commas have decimal points, 0.5; separate them by semicolons or tabs \
                     to write 0,5",
                ),
                _ => fault,
            }
        })?;
        let [m, kg, s] = dimension;
        let is_bare = found == PLAIN;
        match ending {
            Some(ending) if ending.dimension != dimension => {
                let message = format!(
                    "in a column whose name ends in {}, a unit of another dimension",
                    ending.text
                );
                Err(fault(message).with_help("the ending of a column's name is its unit"))
            }
            Some(ending) if is_bare && self.logarithmic.contains(&column) => {
                Ok(10f64.powf(value) * ending.scale)
            }
            Some(ending) if is_bare => Ok(value * ending.scale),
            None if is_bare && dimension != [0; 3] && header.contains(['[', '(']) => {
                let message = format!("the unit of {header} is not known");
                Err(self.header_fault(message).in_column(header).with_help(
                    "name the column with a unit in SI or with one of its prefixes, such as time [ms], y [cm] or force [N]",
                ))
            }
            None if is_bare || found.0 == [m, kg, s, 0] => Ok(value),
            Some(_) => Err(fault("but the column's name has the unit already".to_string())),
            None => Err(fault("which is of another dimension".to_string())),
        }
    }

    /// Returns a number with a decimal point.
    fn with_point<'a>(&self, text: &'a str) -> Cow<'a, str> {
        if self.has_decimal_commas { with_point(text) } else { text.into() }
    }

    /// Returns the numbers of a column of a dimension (exponents of metre, kilogram, second), SI, one for each row.
    ///
    /// # Errors
    /// A cell has another text, or the unit of the column is of another dimension.
    pub fn numbers(&self, column: usize, dimension: [i32; 3]) -> Result<NumberColumn, DataError> {
        let ending = ending_of(&self.header[column]);
        let (mut values, mut last_digit) = (Vec::with_capacity(self.n_rows()), None);
        for row in 0..self.n_rows() {
            if self.is_missing(row, column) {
                values.push(f64::NAN);
                continue;
            }
            last_digit = last_digit.max(decimals(&self.with_point(self.text(row, column))));
            values.push(self.value(row, column, dimension, ending)?);
        }
        let scale = ending.map_or(1.0, |ending| ending.scale);
        let resolution = last_digit.map_or(0.0, |n| scale * 10f64.powi(-n));
        Ok(NumberColumn { values, resolution })
    }

    /// Whether a column is in pixels.
    pub(crate) fn is_in_pixels(&self, column: usize) -> bool {
        ending_of(&self.header[column]).is_some_and(|ending| ending.is_pixel())
    }

    /// Returns the numbers of a column whatever its dimension, as of a signal whose unit does not matter.
    ///
    /// # Errors
    /// A cell is no number.
    pub fn plain(&self, column: usize) -> Result<NumberColumn, DataError> {
        let ending = ending_of(&self.header[column]);
        self.numbers(column, ending.map_or([0; 3], |ending| ending.dimension))
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
        match last.is_none_or(|last| time > *last) {
            true => Ok(()),
            false => {
                Err(self.fault(row, format!("the time {time} s does not increase")).with_help(help))
            }
        }
    }

    /// Returns an error about a row.
    pub fn fault(&self, row: usize, message: impl Display) -> DataError {
        DataError::new(&self.name, message).in_line(self.line(row))
    }

    /// Returns an error about a cell, whose value is not allowed.
    pub(super) fn cell_fault(
        &self,
        row: usize,
        column: usize,
        value: f64,
        help: &str,
    ) -> DataError {
        let header = &self.header[column];
        self.fault(row, format!("{header} is {}", number(value, 5)))
            .in_column(header)
            .with_help(help)
    }

    /// Returns an error about the names of columns.
    pub fn header_fault(&self, message: impl Display) -> DataError {
        DataError::new(&self.name, message).in_line(self.header_line)
    }
}

/// Returns the names of the columns, and the cells of the rows below them.
fn grid(
    name: &str,
    lines: Vec<Line<'_>>,
    separator: u8,
    is_record: bool,
) -> Result<(Vec<String>, Cells), DataError> {
    let (mut text, mut numbers) = (String::new(), Vec::with_capacity(lines.len()));
    for (number, line) in lines {
        text.extend([&*line, "\n"]);
        numbers.push(number);
    }
    let mut reader = csv::ReaderBuilder::new();
    let reader = reader.delimiter(separator).flexible(true).trim(csv::Trim::All);
    let mut reader = reader.from_reader(text.as_bytes());
    let header: Vec<String> = match reader.headers() {
        Ok(header) => header.iter().map(str::to_string).collect(),
        Err(error) => return Err(DataError::new(name, error)),
    };
    let is_number = |cell: &String| parse_quantity(&with_point(cell)).is_ok();
    if !header.is_empty() && header.iter().all(is_number) {
        let error = DataError::new(name, "the first row is of numbers: there is no header");
        return Err(error.in_line(numbers[0]).with_help(
            "write a line above it that names the columns, such as speed_m_s,restitution or \
             frequency_hz,storage_modulus_mpa,loss_modulus_mpa",
        ));
    }
    let (mut cells, n_columns) = (Cells::new(header.len()), header.len());
    let mut record = csv::StringRecord::new();
    while reader.read_record(&mut record).map_err(|error| DataError::new(name, error))? {
        let first = record.position().map_or(1, csv::Position::line) as usize;
        let line = numbers.get(first - 1).copied().unwrap_or_default();
        // Spreadsheets end rows with empty cells.
        let n_empty = record.iter().rev().take_while(|cell| cell.is_empty()).count();
        let fits = record.len() >= n_columns && record.len() - n_empty <= n_columns;
        if !is_record && !fits {
            let n_cells = (record.len() - n_empty).max(record.len().min(n_columns));
            let message = format!("{n_cells} cells below a header of {n_columns}");
            let error = DataError::new(name, message).in_line(line);
            return Err(error.with_help("every row has as many cells as the header"));
        }
        cells.push(line, record.iter());
    }
    Ok((header, cells))
}

/// Gives columns of decimal logarithms the name of their quantity, `time_s` for `log_time_s`, and returns them.
fn logarithms(header: &mut [String]) -> Vec<usize> {
    let mut found = Vec::new();
    for (column, name) in header.iter_mut().enumerate() {
        let inner = ["log10_", "log_", "lg_"].iter().find_map(|log| name.strip_prefix(log));
        let Some(inner) = inner.map(str::to_string) else { continue };
        // The unit says that this is a quantity, and no name that begins so.
        if ending_of(&inner).is_some() {
            *name = inner;
            found.push(column);
        }
    }
    found
}

/// Splits the cells of columns with values like `0.91 ± 0.02`, and adds a column for the uncertainties.
fn split_uncertainties(header: &mut Vec<String>, cells: Cells) -> Cells {
    let has_two = |column: &usize| {
        let mut rows = 0..cells.n_rows();
        rows.any(|row| value_and_uncertainty(cells.cell(row, *column)).is_some())
            && !header.contains(&uncertainty_of(&header[*column]))
    };
    let columns: Vec<usize> = (0..header.len()).filter(has_two).collect();
    if columns.is_empty() {
        return cells;
    }
    let names: Vec<_> = columns.iter().map(|column| uncertainty_of(&header[*column])).collect();
    header.extend(names);
    let mut all = Cells::new(header.len());
    for row in 0..cells.n_rows() {
        let mut values = cells.row(row);
        for &column in &columns {
            let [value, uncertainty] = value_and_uncertainty(&values[column])
                .unwrap_or_else(|| [values[column].clone(), String::new()]);
            values[column] = value;
            values.push(uncertainty);
        }
        all.push(cells.line(row), values.iter().map(String::as_str));
    }
    all
}

/// Returns the number of digits of a bare number after the decimal point, less the exponent.
fn decimals(number: &str) -> Option<i32> {
    if !number.bytes().all(|byte| byte.is_ascii_digit() || b".eE+-".contains(&byte)) {
        return None;
    }
    let (mantissa, exponent) = number.split_once(['e', 'E']).unwrap_or((number, "0"));
    let digits = mantissa.split_once('.').map_or(0, |(_, after)| after.len() as i32);
    Some(digits - exponent.parse::<i32>().unwrap_or(0))
}

/// Returns the column of a name, which may lack the unit if only one column fits.
fn position(header: &[String], name: &str) -> Option<usize> {
    header.iter().position(|known| known == name).or_else(|| {
        let mut alike = (0..header.len()).filter(|k| bare(&header[*k]) == name);
        alike.next().filter(|_| alike.next().is_none())
    })
}
