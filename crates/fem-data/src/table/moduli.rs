//! Moduli over frequency or time, as instruments of dynamic mechanical analysis and relaxation tests export them.

use std::f64::consts::{PI, TAU};

use fem_material::ZERO_CELSIUS;

use super::column_roles::{
    ANGULAR_FREQUENCIES, COMPLEX_ENDS, COMPLEX_MODULI, FREQUENCIES, LOSS_ENDS, LOSS_FACTORS,
    LOSS_MODULI, PHASES, PRESSURE, RELAXATION_ENDS, RELAXATION_MODULI, SHORT_TEMPERATURES,
    STORAGE_ENDS, STORAGE_MODULI, STRAINS, STRESSES, TEMPERATURES, TIMES, bare, before_brackets,
    ending_of,
};
use super::csv_dialect::column_name;
use super::csv_table::Table;
use super::data_error::DataError;
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
    Stress,
    Strain,
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
        let plain: [(&[&str], Self); 6] = [
            (&STRESSES, Self::Stress),
            (&STRAINS, Self::Strain),
            (&FREQUENCIES, Self::Frequency),
            (&ANGULAR_FREQUENCIES, Self::AngularFrequency),
            (&LOSS_FACTORS, Self::LossFactor),
            (&PHASES, Self::Phase),
        ];
        if let Some((_, role)) = plain.into_iter().find(|(names, _)| names.contains(&name)) {
            return Some(role);
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
        let kinds: [(OfModulus, &[&str], &[&str]); 4] = [
            (Self::Storage, &STORAGE_MODULI, &STORAGE_ENDS),
            (Self::Loss, &LOSS_MODULI, &LOSS_ENDS),
            (Self::Complex, &COMPLEX_MODULI, &COMPLEX_ENDS),
            (Self::Relaxation, &RELAXATION_MODULI, &RELAXATION_ENDS),
        ];
        // "|e*|" is written with bars, "e_stor." with a point.
        let spellings = [name, name.trim_matches(['|', '.'])];
        let by_letter = |ends: &[&str]| {
            let of = |(letter, modulus): (&str, Modulus)| {
                let ends_so =
                    |name: &&str| name.strip_prefix(letter).is_some_and(|end| ends.contains(&end));
                spellings.iter().any(ends_so).then_some(modulus)
            };
            letters.into_iter().find_map(of)
        };
        kinds.into_iter().find_map(|(kind, names, ends)| {
            // The word modulus alone belongs to a complex modulus over frequency and to a relaxation test over time.
            let is_other =
                words == "modulus" && (kind(None) == Self::Complex(None)) != has_frequency;
            if names.contains(&words) && !is_other {
                return Some(kind(modulus));
            }
            by_letter(ends).map(|modulus| kind(Some(modulus)))
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

/// Returns the error that a table has no column of a quantity, or one of an unknown unit, which keeps the brackets in its name.
fn missing_column(table: &Table, what: &str, has_frequency: bool) -> DataError {
    let is_of_unknown_unit = |header: &&String| {
        header.ends_with([')', ']'])
            && Role::of(before_brackets(header), has_frequency).is_some()
            && Role::of(header, has_frequency).is_none()
    };
    if let Some(header) = table.header().iter().find(is_of_unknown_unit) {
        let message = format!("the unit of the column {header} is not known");
        return table.header_fault(message).with_help(UNITS);
    }
    let found = table.header().join(", ");
    let message = format!("there is no column of {what}; found are {found}");
    table.header_fault(message).with_help(COLUMNS)
}

/// The columns that the rows of a table are read from, each with its role.
struct Columns<'a> {
    table: &'a Table,
    abscissa: (usize, Role),
    temperature: Option<(usize, Role)>,
    /// One modulus of a relaxation test; of an oscillation a modulus and the loss modulus or factor.
    moduli: Vec<(usize, Role)>,
}

impl<'a> Columns<'a> {
    fn of(table: &'a Table) -> Result<Self, DataError> {
        let is_frequency = |name: &String| {
            let name = bare(name);
            FREQUENCIES.contains(&name) || ANGULAR_FREQUENCIES.contains(&name)
        };
        let has_frequency = table.header().iter().any(is_frequency);
        let role = |header: &String| Role::of(header, has_frequency);
        let roles: Vec<Option<Role>> = table.header().iter().map(role).collect();
        let find = |is: fn(Role) -> bool| {
            let fits = |column: &usize| roles[*column].is_some_and(is);
            let found = table.only((0..roles.len()).filter(fits))?;
            Ok::<_, DataError>(found.and_then(|column| Some((column, roles[column]?))))
        };
        let missing = |what: &str| missing_column(table, what, has_frequency);
        let known = (0..roles.len()).filter_map(|column| Some((column, roles[column]?)));
        let mut abscissae: Vec<_> = known.filter(|(_, role)| role.is_abscissa()).collect();
        if let [first, second] = abscissae[..]
            && agree(table, first, second)
        {
            abscissae.pop();
        }
        table.only(abscissae.iter().map(|(column, _)| *column))?;
        let temperature = find(|role| matches!(role, Role::Temperature(_)))?;
        let Some(abscissa) = abscissae.first().copied() else {
            let error = missing("a frequency or a time");
            return Err(match temperature {
                Some(_) => error.with_help(
                    "a ramp of temperature needs its frequency: add a column frequency_hz",
                ),
                None => error,
            });
        };
        let storage = find(|role| matches!(role, Role::Storage(_)))?;
        let loss = find(|role| matches!(role, Role::Loss(_)))?;
        let complex = find(|role| matches!(role, Role::Complex(_)))?;
        let factor = match find(|role| role == Role::LossFactor)? {
            None => find(|role| role == Role::Phase)?,
            factor => factor,
        };
        let relaxation = find(|role| matches!(role, Role::Relaxation(_)))?;
        let [stress, strain] = match abscissa.1 {
            Role::Time => [find(|role| role == Role::Stress)?, find(|role| role == Role::Strain)?],
            _ => [None; 2],
        };
        let moduli = match (storage, loss, complex, factor) {
            _ if abscissa.1 == Role::Time => match (relaxation, stress, strain) {
                (Some(modulus), ..) => vec![modulus],
                (None, Some((stress, _)), Some(strain)) => {
                    vec![(stress, Role::Relaxation(None)), strain]
                }
                _ => return Err(missing("the relaxation modulus, or of stress and strain")),
            },
            (Some(first), Some(second), ..)
            | (Some(first), None, _, Some(second))
            | (None, _, Some(first), Some(second)) => vec![first, second],
            (Some(_), ..) => return Err(missing("the loss modulus or of tan δ")),
            (None, ..) => return Err(missing("the storage modulus")),
        };
        Ok(Self { table, abscissa, temperature, moduli })
    }

    /// Returns the columns that are read.
    fn read(&self) -> impl Iterator<Item = usize> {
        self.moduli.iter().chain([&self.abscissa]).chain(&self.temperature).map(|it| it.0)
    }

    /// Returns the modulus that the columns say; `given` is that of the caller.
    fn named_modulus(&self, given: Option<Modulus>) -> Result<Option<Modulus>, DataError> {
        let named = || self.moduli.iter().filter_map(|(_, role)| role.modulus());
        let found = named().next();
        if named().any(|other| Some(other) != found) {
            let message = "one modulus is Young's and the other one of shear";
            return Err(self.table.header_fault(message).with_help("both are of one test"));
        }
        if let (Some(given), Some(found)) = (given, found)
            && given != found
        {
            let message = format!("the columns are of the {}", found.key().replace('_', " "));
            return Err(self.table.header_fault(message).with_help("leave out --modulus"));
        }
        Ok(found)
    }

    /// Returns the point of a row; `None` if a cell has no value.
    fn point(&self, row: usize) -> Result<Option<ModulusPoint>, DataError> {
        if self.read().any(|column| self.table.is_missing(row, column)) {
            return Ok(None);
        }
        let (column, role) = self.moduli[0];
        let first = self.modulus(row, column)?;
        let [storage, loss] = match self.moduli[1..] {
            [(column, Role::Loss(_)), ..] => {
                let loss = self.modulus(row, column)?;
                if loss > LARGEST_LOSS_FACTOR * first {
                    let help = "a solid has a loss factor of at most 10: are the columns exchanged, or of different units?";
                    return Err(self.table.cell_fault(row, column, loss, help));
                }
                [first, loss]
            }
            [(column, Role::Strain), ..] => {
                let strain = self.table.number(row, column, [0; 3])?;
                if !(strain.abs() > 0.0 && strain.is_finite()) {
                    return Err(self.table.cell_fault(row, column, strain, "the strain is not 0"));
                }
                [first / strain.abs(), 0.0]
            }
            [(column, of_factor), ..] => {
                let factor = self.loss_factor(row, column, of_factor)?;
                let is_complex = matches!(role, Role::Complex(_));
                let storage = if is_complex { first / factor.hypot(1.0) } else { first };
                [storage, storage * factor]
            }
            [] => [first, 0.0],
        };
        let temperature = match self.temperature {
            Some((column, Role::Temperature(unit))) => Some(self.kelvin(row, column, unit)?),
            _ => None,
        };
        let at = abscissa_at(self.table, row, self.abscissa)?;
        Ok(Some(ModulusPoint { at, storage, loss, temperature, line: self.table.line(row) }))
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
}

/// Largest relative difference of two columns of one quantity, which are rounded.
const ROUNDED: f64 = 1e-3;

/// Whether two columns of frequencies have the same ones in all rows.
fn agree(table: &Table, first: (usize, Role), second: (usize, Role)) -> bool {
    (0..table.n_rows()).all(|row| {
        match [first, second].map(|column| abscissa_at(table, row, column)) {
            [Ok(one), Ok(other)] => (one / other - 1.0).abs() < ROUNDED,
            // A row without numbers is read, or not, as any other.
            _ => true,
        }
    })
}

/// Returns an angular frequency, rad/s, or a time, s, > 0.
fn abscissa_at(table: &Table, row: usize, (column, role): (usize, Role)) -> Result<f64, DataError> {
    let header = &table.header()[column];
    let dimension = if role == Role::Time { [0, 0, 1] } else { [0, 0, -1] };
    let value = table.number(row, column, dimension)?;
    // The reciprocal second of an angular frequency is no cycle.
    let is_phase_rate = role == Role::AngularFrequency
        && ending_of(header).is_none_or(|ending| ending.text == "_per_s");
    if !(value > 0.0 && value.is_finite()) {
        return Err(table.cell_fault(row, column, value, "it is above 0"));
    }
    Ok(if role == Role::Time || is_phase_rate { value } else { TAU * value })
}

impl Columns<'_> {
    /// Returns a temperature, K.
    fn kelvin(&self, row: usize, column: usize, unit: &str) -> Result<f64, DataError> {
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
            whole => Table::of_record(name, text).or(whole),
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
        let table = Self::table(name, text.trim_start_matches('\u{feff}'))?.renamed(names)?;
        let columns = Columns::of(&table)?;
        let named = modulus.or(columns.named_modulus(modulus)?);
        let points = (0..table.n_rows()).filter_map(|row| columns.point(row).transpose());
        let points = points.collect::<Result<Vec<_>, _>>()?;
        if points.is_empty() {
            return Err(table.header_fault("no row has all its values").with_help(COLUMNS));
        }
        let is_unread = |column: &usize| !columns.read().any(|read| read == *column);
        let unread = (0..table.header().len()).filter(is_unread);
        Ok(Self {
            name: table.name().to_string(),
            kind: match columns.abscissa.1 {
                Role::Time => TestKind::Relaxation,
                _ => TestKind::Oscillation,
            },
            modulus: named.unwrap_or(Modulus::Young),
            modulus_is_named: named.is_some(),
            points,
            unread: unread.map(|column| table.header()[column].clone()).collect(),
        })
    }
}
