//! CSV files with a header: cells as numbers, faults with file and line.
//!
//! Lines that begin with `#` are comments. A name may end in a unit, `speed_cm_s`; without one a
//! cell is a bare SI number or has its unit, `5 cm/s`.

use std::path::Path;

use fem_case::{nearest, parse_quantity};

use crate::failure::Failure;
use crate::standard_output::one_line;

/// A file in memory.
#[derive(Debug)]
pub struct CsvTable {
    name: String,
    header: Vec<String>,
    header_line: u64,
    rows: Vec<(u64, Vec<String>)>,
}

/// A cell that is a number.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Cell {
    /// SI.
    pub value: f64,
    /// Of the file.
    pub line: u64,
}

/// Endings of names, their units, and how many SI units they are.
const ENDINGS: [(&str, f64, [i32; 3]); 14] = [
    ("_cm_s", 1e-2, [1, 0, -1]),
    ("_mm_s", 1e-3, [1, 0, -1]),
    ("_km_h", 1.0 / 3.6, [1, 0, -1]),
    ("_m_s", 1.0, [1, 0, -1]),
    ("_us", 1e-6, [0, 0, 1]),
    ("_ms", 1e-3, [0, 0, 1]),
    ("_ns", 1e-9, [0, 0, 1]),
    ("_s", 1.0, [0, 0, 1]),
    ("_deg", std::f64::consts::PI / 180.0, [0; 3]),
    ("_mrad", 1e-3, [0; 3]),
    ("_rad", 1.0, [0; 3]),
    ("_percent", 1e-2, [0; 3]),
    ("_mm", 1e-3, [1, 0, 0]),
    ("_m", 1.0, [1, 0, 0]),
];

/// Similarity of names above which one is the other misspelt: `diameter1`, `uncertanty` are, and
/// `contact_radius` for `contact_time` is not.
const MISSPELT: f64 = 0.9;

/// A name without the ending of its unit.
fn bare(header: &str) -> &str {
    ENDINGS.iter().find_map(|(ending, ..)| header.strip_suffix(ending)).unwrap_or(header)
}

impl CsvTable {
    /// Reads a file.
    ///
    /// # Errors
    /// A file that cannot be read, is no CSV, or has no row.
    pub fn read(path: &Path) -> Result<Self, Failure> {
        let name = one_line(&path.display().to_string());
        let cannot = |error: &dyn std::fmt::Display| {
            Failure::bad_input(format!("{name}: this file cannot be read: {error}"))
                .with_help("name a CSV file with a header, such as validation/data/bridges_ice.csv")
        };
        let text = std::fs::read_to_string(path).map_err(|error| cannot(&error))?;
        let mut reader = csv::ReaderBuilder::new()
            .comment(Some(b'#'))
            .trim(csv::Trim::All)
            .from_reader(text.as_bytes());
        let header = reader.headers().map_err(|error| cannot(&error))?;
        let is_header = |line: &str| !line.trim().is_empty() && !line.starts_with('#');
        let header_line = text.lines().position(is_header).map_or(1, |above| above as u64 + 1);
        let header: Vec<String> =
            header.iter().map(|name| name.trim_start_matches('\u{feff}').to_lowercase()).collect();
        let mut rows = Vec::new();
        for record in reader.records() {
            let record = record.map_err(|error| {
                let line = error.position().map_or(0, csv::Position::line);
                let message = format!("{name}:{line}: {}", one_line(&error.to_string()));
                Failure::bad_input(message).with_help("every row has as many cells as the header")
            })?;
            let line = record.position().map_or(0, csv::Position::line);
            rows.push((line, record.iter().map(str::to_string).collect()));
        }
        if rows.is_empty() {
            return Err(Failure::bad_input(format!("{name}: there is no row below the header")));
        }
        Ok(Self { name, header, header_line, rows })
    }

    /// The file's name, to show.
    pub fn name(&self) -> &str {
        &self.name
    }

    /// How many rows.
    pub fn n_rows(&self) -> usize {
        self.rows.len()
    }

    /// The names of the columns, in lower case.
    pub fn header(&self) -> &[String] {
        &self.header
    }

    /// The column that has one of these names, with or without the ending of a unit.
    ///
    /// # Errors
    /// Two that have.
    pub fn find(&self, names: &[&str]) -> Result<Option<usize>, Failure> {
        let is_it = |header: &str| {
            let bare = ENDINGS.iter().filter_map(|(ending, ..)| header.strip_suffix(ending));
            std::iter::once(header).chain(bare).any(|bare| names.contains(&bare))
        };
        let mut found = (0..self.header.len()).filter(|column| is_it(&self.header[*column]));
        let first = found.next();
        match (first, found.next()) {
            (Some(first), Some(second)) => {
                let (first, second) = (&self.header[first], &self.header[second]);
                Err(self
                    .fault(
                        self.header_line,
                        format!("the columns {first} and {second} mean the same"),
                    )
                    .with_help("keep one of the two"))
            }
            _ => Ok(first),
        }
    }

    /// As [`CsvTable::find`]; a column that must be there.
    ///
    /// # Errors
    /// None that has.
    pub fn require(&self, names: &[&str], example: &str) -> Result<usize, Failure> {
        self.find(names)?.ok_or_else(|| {
            let found = one_line(&self.header.join(", "));
            self.fault(
                self.header_line,
                format!("there is no column {}; found are {found}", names[0]),
            )
            .with_help(format!("name a column {example}"))
        })
    }

    /// Names of the columns that are neither read nor known otherwise.
    ///
    /// # Errors
    /// One whose name is nearly that of a column that would be read.
    pub fn unread(
        &self,
        read: &[usize],
        optional: &[&str],
        is_known: impl Fn(&str) -> bool,
    ) -> Result<Vec<String>, Failure> {
        let mut unread = Vec::new();
        for (column, header) in self.header.iter().enumerate() {
            let bare = bare(header);
            if read.contains(&column) || is_known(header) || is_known(bare) {
                continue;
            }
            // `contact_time_spread` and `mass_uncertainty` are names of their own.
            let is_own = |near: &str| {
                bare.starts_with(&format!("{near}_")) || bare.ends_with(&format!("_{near}"))
            };
            if let Some(near) = nearest(bare, optional, MISSPELT).filter(|near| !is_own(near)) {
                return Err(self
                    .fault(self.header_line, format!("unknown column {}", one_line(header)))
                    .with_help(format!(
                        "did you mean `{near}`? columns that may be given are {}; rename one that \
                         is not to be read",
                        optional.join(", ")
                    )));
            }
            unread.push(one_line(header));
        }
        Ok(unread)
    }

    /// A cell as it is.
    pub fn text(&self, row: usize, column: usize) -> &str {
        self.rows[row].1.get(column).map_or("", String::as_str)
    }

    /// The line of the header.
    pub fn header_line(&self) -> u64 {
        self.header_line
    }

    /// The line of a row.
    pub fn line(&self, row: usize) -> u64 {
        self.rows[row].0
    }

    /// A cell as a number of a dimension (metre, kilogram, second).
    ///
    /// # Errors
    /// Something else.
    pub fn number(&self, row: usize, column: usize, dimension: [i32; 3]) -> Result<Cell, Failure> {
        let (line, header) = (self.line(row), &self.header[column]);
        let text = self.text(row, column);
        let fault = |found: String| {
            let text = one_line(text);
            self.fault(line, format!("{header} is \"{text}\", {found}"))
        };
        let (value, found) =
            parse_quantity(text).map_err(|_| fault("which is not a number".into()))?;
        let ending = ENDINGS.iter().find(|(ending, ..)| header.ends_with(ending));
        let [m, kg, s] = dimension;
        let is_bare = found.0 == [0; 4];
        match ending {
            Some((ending, _, of_ending)) if *of_ending != dimension => {
                Err(fault(format!("in a column whose name ends in {ending}"))
                    .with_help("the ending of a column's name is its unit"))
            }
            Some((_, scale, _)) if is_bare => Ok(Cell { value: value * scale, line }),
            None if is_bare || found.0 == [m, kg, s, 0] => Ok(Cell { value, line }),
            Some(_) => Err(fault("but the column's name has the unit already".into())),
            None => Err(fault("which is of another dimension".into())),
        }
    }

    /// A fault in a line.
    pub fn fault(&self, line: u64, message: impl std::fmt::Display) -> Failure {
        Failure::bad_input(format!("{}:{line}: {message}", self.name))
    }
}
