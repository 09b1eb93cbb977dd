//! Moduli over frequency or time, as instruments of dynamic mechanical analysis and relaxation tests export them.

use std::f64::consts::{PI, TAU};

use fem_material::ZERO_CELSIUS;

use super::column_roles::{
    ANGULAR_FREQUENCIES, COMPLEX_ENDS, COMPLEX_MODULI, FREQUENCIES, LOSS_ENDS, LOSS_FACTORS,
    LOSS_MODULI, PHASES, PRESSURE, RELAXATION_ENDS, RELAXATION_MODULI, SHORT_TEMPERATURES,
    STORAGE_ENDS, STORAGE_MODULI, TEMPERATURES, TIMES, bare, ending_of,
};
use super::csv_dialect::column_name;
use super::csv_table::Table;
use super::data_error::DataError;
use super::number_columns::without_preamble;
use super::temperature_blocks::with_temperature_column;

/// Temperatures of measurements, K.
const SENSIBLE_TEMPERATURES: std::ops::RangeInclusive<f64> = 50.0..=1500.0;
/// The largest bare modulus, Pa, that is taken for one in another unit: gels have more.
const SMALLEST_BARE_MODULUS: f64 = 1e4;
/// The largest loss factor of a solid; that of the softest rubber at its glass transition is about 3.
const LARGEST_LOSS_FACTOR: f64 = 10.0;

/// The modulus that was measured.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Modulus {
    /// Young's modulus E, from bending, tension or compression.
    Young,
    /// The shear modulus G.
    Shear,
}

impl Modulus {
    /// Both, in the order of the documentation.
    pub const ALL: [Self; 2] = [Self::Young, Self::Shear];

    /// Returns the key of the modulus in a case.
    pub fn key(self) -> &'static str {
        match self {
            Self::Young => "youngs_modulus",
            Self::Shear => "shear_modulus",
        }
    }

    /// Returns its symbol, E or G.
    pub fn symbol(self) -> &'static str {
        match self {
            Self::Young => "E",
            Self::Shear => "G",
        }
    }
}

/// The kind of test.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum TestKind {
    /// Storage and loss modulus over the frequency of an oscillation.
    Oscillation,
    /// The modulus over the time after a step of strain.
    Relaxation,
}

impl TestKind {
    /// Returns its name in files.
    pub fn word(self) -> &'static str {
        match self {
            Self::Oscillation => "oscillation",
            Self::Relaxation => "relaxation",
        }
    }
}

/// One row of a table of moduli.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ModulusPoint {
    /// Angular frequency of an oscillation, rad/s, or time after the step, s.
    pub at: f64,
    /// Storage modulus, or relaxation modulus, Pa.
    pub storage: f64,
    /// Loss modulus, Pa; 0 in a relaxation test.
    pub loss: f64,
    /// Temperature, K, if the table has it.
    pub temperature: Option<f64>,
    /// Line of the row.
    pub line: u64,
}

impl ModulusPoint {
    /// Returns the magnitude of the complex modulus, Pa.
    pub fn magnitude(&self) -> f64 {
        self.storage.hypot(self.loss)
    }
}

/// Moduli over frequency or time, with the temperature of each row.
#[derive(Clone, Debug, PartialEq)]
pub struct ModulusTable {
    /// The name of the table.
    pub name: String,
    /// The kind of test.
    pub kind: TestKind,
    /// The modulus that was measured.
    pub modulus: Modulus,
    /// Whether the table says which modulus it is.
    pub modulus_is_named: bool,
    /// The rows, in the order of the table.
    pub points: Vec<ModulusPoint>,
    /// The columns that are not read.
    pub unread: Vec<String>,
}

/// The meaning of a column.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Role {
    Frequency,
    AngularFrequency,
    Time,
    Temperature(&'static str),
    Storage(Option<Modulus>),
    Loss(Option<Modulus>),
    Complex(Option<Modulus>),
    Relaxation(Option<Modulus>),
    LossFactor,
    Phase,
}

impl Role {
    /// Returns the meaning of a column by its name.
    fn of(header: &str, has_frequency: bool) -> Option<Self> {
        let unit = ending_of(header).map_or("", |ending| ending.text);
        let is_temperature = ["_degc", "_degf", "_kelvin"].contains(&unit);
        if let Some((_, unit)) = SHORT_TEMPERATURES.iter().find(|(name, _)| *name == header) {
            return Some(Self::Temperature(unit));
        }
        let name = bare(header);
        // The letter t alone is a time if there is no frequency.
        if TEMPERATURES.contains(&name)
            && (is_temperature || (unit.is_empty() && (name != "t" || has_frequency)))
        {
            return Some(Self::Temperature(if is_temperature { unit } else { "_degc" }));
        }
        if FREQUENCIES.contains(&name) {
            return Some(Self::Frequency);
        }
        if ANGULAR_FREQUENCIES.contains(&name) {
            return Some(Self::AngularFrequency);
        }
        if LOSS_FACTORS.contains(&name) {
            return Some(Self::LossFactor);
        }
        if PHASES.contains(&name) {
            return Some(Self::Phase);
        }
        if TIMES.contains(&name) && !has_frequency {
            return Some(Self::Time);
        }
        let (modulus, words) = match name {
            _ if name.starts_with("shear_") => (Some(Modulus::Shear), &name["shear_".len()..]),
            _ if name.starts_with("young's_") => (Some(Modulus::Young), &name["young's_".len()..]),
            _ if name.starts_with("tensile_") => (Some(Modulus::Young), &name["tensile_".len()..]),
            _ => (None, name),
        };
        let letters = [("e", Modulus::Young), ("g", Modulus::Shear)];
        let by_letter = |ends: &[&str]| {
            let of = |(letter, modulus)| {
                let end = name.strip_prefix(letter)?;
                ends.contains(&end).then_some(modulus)
            };
            letters.into_iter().find_map(of)
        };
        let kinds: [(OfModulus, &[&str], &[&str]); 4] = [
            (Self::Storage, &STORAGE_MODULI, &STORAGE_ENDS),
            (Self::Loss, &LOSS_MODULI, &LOSS_ENDS),
            (Self::Complex, &COMPLEX_MODULI, &COMPLEX_ENDS),
            (Self::Relaxation, &RELAXATION_MODULI, &RELAXATION_ENDS),
        ];
        // "|e*|" is written with bars, "e_stor." with a point.
        let plain = name.trim_matches(['|', '.']);
        kinds.into_iter().find_map(|(kind, names, ends)| {
            // The word modulus alone belongs to a complex modulus over frequency and to a relaxation test over time.
            let is_other =
                words == "modulus" && (kind(None) == Self::Complex(None)) != has_frequency;
            if names.contains(&words) && !is_other {
                return Some(kind(modulus));
            }
            let found = by_letter(ends).or_else(|| {
                let (letter, modulus) = letters.into_iter().find(|it| plain.starts_with(it.0))?;
                ends.contains(&plain.strip_prefix(letter)?).then_some(modulus)
            });
            found.map(|modulus| kind(Some(modulus)))
        })
    }

    fn is_abscissa(self) -> bool {
        matches!(self, Self::Frequency | Self::AngularFrequency | Self::Time)
    }

    fn is_of_modulus(self) -> bool {
        matches!(self, Self::Storage(_) | Self::Loss(_) | Self::Complex(_) | Self::Relaxation(_))
    }

    fn modulus(self) -> Option<Modulus> {
        match self {
            Self::Storage(of) | Self::Loss(of) | Self::Complex(of) | Self::Relaxation(of) => of,
            _ => None,
        }
    }
}

/// The role of a column of this modulus, if the column says which it is.
type OfModulus = fn(Option<Modulus>) -> Role;

/// The columns that a table may have.
const COLUMNS: &str = "a table has a frequency [Hz] or omega [rad/s], and E' [MPa] with E'' [MPa] or tan_delta, or |E*| [MPa] \
                       with tan_delta; or a time [s] and E(t) [MPa]; G for shear; name the columns so, or say which they \
                       are, --columns storage_modulus=COLUMN";

/// The units that a table may have.
const UNITS: &str = "units are Hz, kHz, rad/s; s, ms, min, h; Pa, kPa, MPa, GPa, psi, ksi, dyn/cm^2, N/mm^2; °C, K, °F";

/// The columns of a table by their roles.
struct Columns<'a> {
    table: &'a Table,
    roles: Vec<(usize, Role)>,
}

impl Columns<'_> {
    fn find(&self, is: impl Fn(Role) -> bool) -> Result<Option<usize>, DataError> {
        let mut found = self.roles.iter().filter(|(_, role)| is(*role)).map(|(column, _)| *column);
        match (found.next(), found.next()) {
            (Some(first), Some(second)) => {
                let [first, second] = [first, second].map(|column| &self.table.header()[column]);
                let message = format!("the columns {first} and {second} mean the same");
                Err(self.table.header_fault(message).with_help("keep one of the two"))
            }
            (first, _) => Ok(first),
        }
    }

    /// Returns a modulus, Pa, > 0.
    fn modulus(&self, row: usize, column: usize) -> Result<f64, DataError> {
        let value = self.table.number(row, column, PRESSURE)?;
        if !(value > 0.0 && value.is_finite()) {
            return Err(self.table.cell_fault(row, column, value, "a modulus is above 0"));
        }
        let is_bare = ending_of(&self.table.header()[column]).is_none()
            && self.table.text(row, column).parse::<f64>().is_ok();
        if is_bare && value < SMALLEST_BARE_MODULUS {
            let help = "a bare number is in Pa: name the unit in the header, such as E' [MPa] or storage_modulus_mpa";
            return Err(self.table.cell_fault(row, column, value, help));
        }
        Ok(value)
    }

    /// Returns an angular frequency, rad/s, or a time, s, > 0.
    fn abscissa(&self, row: usize, column: usize, role: Role) -> Result<f64, DataError> {
        let header = &self.table.header()[column];
        let dimension = if role == Role::Time { [0, 0, 1] } else { [0, 0, -1] };
        let value = self.table.number(row, column, dimension)?;
        // The reciprocal second of an angular frequency is no cycle.
        let is_phase_rate = role == Role::AngularFrequency
            && ending_of(header).is_none_or(|ending| ending.text == "_per_s");
        if !(value > 0.0 && value.is_finite()) {
            return Err(self.table.cell_fault(row, column, value, "it is above 0"));
        }
        Ok(if role == Role::Time || is_phase_rate { value } else { TAU * value })
    }

    /// Returns a temperature, K.
    fn temperature(&self, row: usize, column: usize, unit: &str) -> Result<f64, DataError> {
        let value = self.table.number(row, column, [0; 3])?;
        let kelvin = match unit {
            "_kelvin" => value,
            "_degf" => (value - 32.0) / 1.8 + ZERO_CELSIUS,
            _ => value + ZERO_CELSIUS,
        };
        if !SENSIBLE_TEMPERATURES.contains(&kelvin) {
            let help = "temperatures are in °C unless the header has [K] or [°F]";
            return Err(self.table.cell_fault(row, column, value, help));
        }
        Ok(kelvin)
    }

    /// Returns the loss factor of a row by one of its columns.
    fn loss_factor(&self, row: usize, column: usize, role: Role) -> Result<f64, DataError> {
        let value = self.table.number(row, column, [0; 3])?;
        let header = &self.table.header()[column];
        let factor = match (role, ending_of(header)) {
            (Role::Phase, None) => (value * PI / 180.0).tan(),
            (Role::Phase, Some(_)) => value.tan(),
            _ => value,
        };
        let is_phase = role == Role::Phase;
        if !(0.0..=LARGEST_LOSS_FACTOR).contains(&factor) {
            let help = match is_phase {
                true => "a phase angle is from 0 to 84 degrees, without a unit in degrees",
                false => {
                    "a loss factor is E''/E', from 0 to 10; an angle is a column phase_deg, and per cents are tan_delta [%]"
                }
            };
            return Err(self.table.cell_fault(row, column, value, help));
        }
        Ok(factor)
    }
}

impl ModulusTable {
    /// Returns the table of a text, without the lines above its header if there are any, and with a column of the temperatures above
    /// blocks of rows.
    fn table(name: &str, text: &str) -> Result<Table, DataError> {
        let role = |header: &String| Role::of(header, true);
        let has_temperature = |table: &Table| {
            table.header().iter().any(|it| matches!(role(it), Some(Role::Temperature(_))))
        };
        let whole = Table::parse(name, text);
        let found = match whole {
            Ok(table) if table.header().iter().any(|it| role(it).is_some()) => Ok(table),
            whole => Table::parse(name, &without_preamble(text)).or(whole),
        };
        if found.as_ref().is_ok_and(has_temperature) {
            return found;
        }
        let is_header = |line: &str| {
            let separators = if line.contains([',', ';', '\t']) { ",;\t" } else { " " };
            let cells = line.split(|c: char| separators.contains(c)).map(column_name);
            let roles: Vec<Role> = cells.filter_map(|cell| Role::of(&cell, false)).collect();
            roles.iter().any(|it| it.is_of_modulus()) && roles.iter().any(|it| it.is_abscissa())
        };
        let blocks = with_temperature_column(text, is_header);
        let blocks = blocks.and_then(|text| Table::parse(name, &text).ok());
        blocks.filter(has_temperature).map_or(found, Ok)
    }

    /// Reads a table; messages refer to it by `name`, and `names` renames columns as [`Table::renamed`] does. `modulus` is the
    /// one that was measured if the columns do not say it; Young's modulus without both.
    ///
    /// # Errors
    /// A column is missing, a cell is no number or has a value that no solid has, or the columns contradict `modulus`.
    ///
    /// ```
    /// use fem_data::table::ModulusTable;
    ///
    /// let text = "f [Hz];E' [MPa];tan δ\n0,1;2000;0,05\n10;2400;0,04\n";
    /// let table = ModulusTable::parse("pmma.csv", text, &[], None)?;
    /// assert_eq!(table.points[0].loss, 100e6);
    /// assert!((table.points[1].at / 62.8318530718 - 1.0).abs() < 1e-11);
    /// # Ok::<(), fem_data::table::DataError>(())
    /// ```
    pub fn parse(
        name: &str,
        text: &str,
        names: &[(&str, &str)],
        modulus: Option<Modulus>,
    ) -> Result<Self, DataError> {
        let is_frequency = |name: &String| {
            let name = bare(name);
            FREQUENCIES.contains(&name) || ANGULAR_FREQUENCIES.contains(&name)
        };
        let table = Self::table(name, text.trim_start_matches('\u{feff}'))?.renamed(names)?;
        let has_frequency = table.header().iter().any(is_frequency);
        let roles = table.header().iter().enumerate();
        let roles: Vec<(usize, Role)> = roles
            .filter_map(|(column, header)| Some((column, Role::of(header, has_frequency)?)))
            .collect();
        let columns = Columns { table: &table, roles };
        let missing = |what: &str| {
            // A column of an unknown unit keeps the brackets in its name.
            let is_of_unknown_unit = |(column, header): &(usize, &String)| {
                let name = header.split(['[', '(']).next().map(|name| name.trim_end_matches('_'));
                let is_role = name.is_some_and(|name| Role::of(name, has_frequency).is_some());
                is_role
                    && header.ends_with([')', ']'])
                    && columns.roles.iter().all(|it| it.0 != *column)
            };
            if let Some((_, header)) = table.header().iter().enumerate().find(is_of_unknown_unit) {
                let message = format!("the unit of the column {header} is not known");
                return table.header_fault(message).with_help(UNITS);
            }
            let found = table.header().join(", ");
            let message = format!("there is no column of {what}; found are {found}");
            table.header_fault(message).with_help(COLUMNS)
        };
        let abscissa = columns.find(Role::is_abscissa)?;
        let abscissa = abscissa.ok_or_else(|| missing("a frequency or a time"))?;
        let temperature = columns.find(|role| matches!(role, Role::Temperature(_)))?;
        let storage = columns.find(|role| matches!(role, Role::Storage(_)))?;
        let loss = columns.find(|role| matches!(role, Role::Loss(_)))?;
        let complex = columns.find(|role| matches!(role, Role::Complex(_)))?;
        let factor = columns.find(|role| role == Role::LossFactor)?;
        let factor = match factor {
            Some(factor) => Some(factor),
            None => columns.find(|role| role == Role::Phase)?,
        };
        let relaxation = columns.find(|role| matches!(role, Role::Relaxation(_)))?;
        let role_of = |column: usize| columns.roles.iter().find(|it| it.0 == column).map(|it| it.1);
        let kind = match role_of(abscissa) {
            Some(Role::Time) => TestKind::Relaxation,
            _ => TestKind::Oscillation,
        };
        // Each row of moduli is read from two columns.
        let read = match (kind, storage, loss, complex, factor, relaxation) {
            (TestKind::Oscillation, Some(storage), Some(loss), ..) => vec![storage, loss],
            (TestKind::Oscillation, Some(storage), None, _, Some(factor), _) => {
                vec![storage, factor]
            }
            (TestKind::Oscillation, None, _, Some(complex), Some(factor), _) => {
                vec![complex, factor]
            }
            (TestKind::Oscillation, Some(_), None, ..) => {
                return Err(missing("the loss modulus or of tan δ"));
            }
            (TestKind::Oscillation, ..) => return Err(missing("the storage modulus")),
            (TestKind::Relaxation, .., Some(relaxation)) => vec![relaxation],
            (TestKind::Relaxation, ..) => return Err(missing("the relaxation modulus")),
        };
        let named: Vec<Modulus> =
            read.iter().filter_map(|column| role_of(*column)?.modulus()).collect();
        let of_columns = named.first().copied();
        if named.iter().any(|other| Some(*other) != of_columns) {
            let message = "one modulus is Young's and the other one of shear";
            return Err(table.header_fault(message).with_help("both are of one test"));
        }
        if let (Some(given), Some(found)) = (modulus, of_columns)
            && given != found
        {
            let message = format!("the columns are of the {}", found.key().replace('_', " "));
            return Err(table.header_fault(message).with_help("leave out --modulus"));
        }
        let mut points = Vec::new();
        for row in 0..table.n_rows() {
            let used = read.iter().chain([&abscissa]).chain(temperature.as_ref());
            if used.clone().any(|column| table.is_missing(row, *column)) {
                continue;
            }
            let first = columns.modulus(row, read[0])?;
            let second = match read.get(1) {
                None => 0.0,
                Some(column) => match role_of(*column) {
                    Some(Role::Loss(_)) => {
                        let value = columns.modulus(row, *column)?;
                        if value > LARGEST_LOSS_FACTOR * first {
                            let help = "a solid has a loss factor of at most 10: are the columns exchanged, or of different units?";
                            return Err(table.cell_fault(row, *column, value, help));
                        }
                        value
                    }
                    role => columns.loss_factor(row, *column, role.unwrap_or(Role::LossFactor))?,
                },
            };
            let [storage, loss] = match (storage, loss) {
                _ if kind == TestKind::Relaxation => [first, 0.0],
                (Some(_), Some(_)) => [first, second],
                (Some(_), None) => [first, first * second],
                // |E*| and tan δ.
                (None, _) => {
                    let storage = first / second.hypot(1.0);
                    [storage, storage * second]
                }
            };
            let temperature = match temperature.map(|column| (column, role_of(column))) {
                Some((column, Some(Role::Temperature(unit)))) => {
                    Some(columns.temperature(row, column, unit)?)
                }
                _ => None,
            };
            let role = role_of(abscissa).unwrap_or(Role::Frequency);
            let at = columns.abscissa(row, abscissa, role)?;
            points.push(ModulusPoint { at, storage, loss, temperature, line: table.line(row) });
        }
        if points.is_empty() {
            return Err(table.header_fault("no row has all its values").with_help(COLUMNS));
        }
        let is_read = |column: &usize| {
            read.contains(column) || *column == abscissa || Some(*column) == temperature
        };
        let unread = (0..table.header().len()).filter(|column| !is_read(column));
        let unread = unread.map(|column| table.header()[column].clone()).collect();
        Ok(Self {
            name: table.name().to_string(),
            kind,
            modulus: modulus.or(of_columns).unwrap_or(Modulus::Young),
            modulus_is_named: modulus.or(of_columns).is_some(),
            points,
            unread,
        })
    }
}
