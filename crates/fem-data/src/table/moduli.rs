//! Moduli over frequency or time, as instruments of dynamic mechanical analysis and relaxation tests export them.

use std::f64::consts::{PI, TAU};

use fem_material::ZERO_CELSIUS;

use super::column_roles::{
    ANGULAR_FREQUENCIES, FREQUENCIES, PRESSURE, TEMPERATURES, bare, before_brackets, ending_of,
    is_one_of,
};
use super::csv_dialect::column_name;
use super::csv_table::Table;
use super::data_error::DataError;
use super::layouts::with_temperature_column;

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
    Temperature,
    Storage,
    Loss,
    Complex,
    Relaxation,
    LossFactor,
    Phase,
    Stress,
    Strain,
}

/// Names of columns by their meaning.
const NAMES: [(Role, &str); 7] = [
    (Role::Stress, "stress tensile_stress shear_stress σ τ oscillation_stress"),
    (Role::Strain, "strain tensile_strain shear_strain ε γ oscillation_strain"),
    (Role::Frequency, FREQUENCIES),
    (Role::AngularFrequency, ANGULAR_FREQUENCIES),
    (
        Role::LossFactor,
        "tan_delta tan_δ tanδ tandelta tan(delta) tan(δ) tand tan_del loss_factor damping_factor",
    ),
    (Role::Phase, "phase phase_angle delta δ loss_angle phase_lag"),
    (Role::Time, "time t step_time"),
];

/// Names of moduli that may be of Young or of shear, and the ends of names that begin with `e` or `g`, `e'`, `g_stor`, or are one of
/// these.
const MODULI: [(Role, &str, &str); 4] = [
    (
        Role::Storage,
        "storage_modulus storage stor._modulus storage_mod.",
        "' ′ ’ _stor _storage _prime 1 `",
    ),
    (Role::Loss, "loss_modulus loss loss_mod.", "'' ″ \" ′′ ’’ ” _loss _double_prime 2 ``"),
    (
        Role::Complex,
        "complex_modulus dynamic_modulus absolute_modulus modulus",
        "* _star _complex _comp _abs",
    ),
    (Role::Relaxation, "relaxation_modulus modulus relaxation relax._modulus", " (t) _relax"),
];

impl Role {
    /// Returns the meaning of a column by its name, and the modulus that it says.
    fn of(header: &str, has_frequency: bool) -> Option<(Self, Option<Modulus>)> {
        if temperature_scale(header, has_frequency).is_some() {
            return Some((Self::Temperature, None));
        }
        let name = bare(header);
        let named = NAMES.into_iter().find(|(role, names)| {
            is_one_of(name, names) && !(*role == Self::Time && has_frequency)
        });
        if let Some((role, _)) = named {
            return Some((role, None));
        }
        let (young, shear) = (Some(Modulus::Young), Some(Modulus::Shear));
        let prefixes = [("shear_", shear), ("young's_", young), ("tensile_", young), ("", None)];
        let split = |(prefix, modulus)| Some((name.strip_prefix(prefix)?, modulus));
        let (words, modulus) = prefixes.into_iter().find_map(split)?;
        MODULI.into_iter().find_map(|(role, names, ends)| {
            // The word modulus alone belongs to a complex modulus over frequency and to a relaxation test over time.
            let is_other = words == "modulus" && (role == Self::Complex) != has_frequency;
            if is_one_of(words, names) && !is_other {
                return Some((role, modulus));
            }
            // "|e*|" is written with bars, "e_stor." with a point.
            let ends_so = |name: &str, letter| {
                name.strip_prefix(letter).is_some_and(|end| is_one_of(end, ends))
            };
            [("e", young), ("g", shear)].into_iter().find_map(|(letter, modulus)| {
                let is_it = ends_so(name, letter) || ends_so(name.trim_matches(['|', '.']), letter);
                is_it.then_some((role, modulus))
            })
        })
    }

    fn is_abscissa(self) -> bool {
        matches!(self, Self::Frequency | Self::AngularFrequency | Self::Time)
    }
}

/// Returns the ending of the scale of a column of temperatures, which is °C without one.
fn temperature_scale(header: &str, has_frequency: bool) -> Option<&'static str> {
    let letters = [("_c", "_degc"), ("_k", "_kelvin"), ("_f", "_degf")];
    let by_letter = |(letter, _): &(&str, &str)| {
        header.strip_suffix(letter).is_some_and(|name| is_one_of(name, "temperature temp t"))
    };
    let name = bare(header);
    match (letters.into_iter().find(by_letter), ending_of(header).map(|ending| ending.text)) {
        (Some((_, scale)), _) => Some(scale),
        _ if !is_one_of(name, TEMPERATURES) => None,
        // The letter t alone is a time if there is no frequency.
        (None, None) => (name != "t" || has_frequency).then_some("_degc"),
        (None, scale) => scale.filter(|it| ["_degc", "_degf", "_kelvin"].contains(it)),
    }
}

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

/// A column with its role.
type Column = (usize, Role);

/// The columns that the rows of a table are read from.
struct Columns<'a> {
    table: &'a Table,
    abscissa: Column,
    temperature: Option<usize>,
    /// One modulus of a relaxation test; of an oscillation a modulus and the loss modulus or factor.
    moduli: Vec<Column>,
    /// The modulus that these columns say.
    named: Option<Modulus>,
}

impl<'a> Columns<'a> {
    /// Finds the columns; `given` is the modulus of the caller.
    fn of(table: &'a Table, given: Option<Modulus>) -> Result<Self, DataError> {
        let is_frequency = |name: &String| {
            is_one_of(bare(name), FREQUENCIES) || is_one_of(bare(name), ANGULAR_FREQUENCIES)
        };
        let has_frequency = table.header().iter().any(is_frequency);
        let roles: Vec<_> =
            table.header().iter().map(|header| Role::of(header, has_frequency)).collect();
        let of = |column: usize| roles[column].map(|(role, _)| role);
        let find = |role: Role| -> Result<Option<Column>, DataError> {
            let found = table.only((0..roles.len()).filter(|column| of(*column) == Some(role)))?;
            Ok(found.map(|column| (column, role)))
        };
        let missing = |what: &str| missing_column(table, what, has_frequency);
        let known = (0..roles.len()).filter_map(|column| Some((column, of(column)?)));
        let mut abscissae: Vec<Column> = known.filter(|(_, role)| role.is_abscissa()).collect();
        if let [first, second] = abscissae[..]
            && agree(table, first, second)
        {
            abscissae.pop();
        }
        table.only(abscissae.iter().map(|(column, _)| *column))?;
        let temperature = find(Role::Temperature)?.map(|(column, _)| column);
        let Some(abscissa) = abscissae.first().copied() else {
            let error = missing("a frequency or a time");
            return Err(match temperature {
                Some(_) => error.with_help(
                    "a ramp of temperature needs its frequency: add a column frequency_hz",
                ),
                None => error,
            });
        };
        let moduli = if abscissa.1 == Role::Time {
            let columns = [Role::Relaxation, Role::Stress, Role::Strain].map(find);
            match columns {
                [Ok(Some(modulus)), Ok(_), Ok(_)] => vec![modulus],
                [Ok(None), Ok(Some((stress, _))), Ok(Some(strain))] => {
                    vec![(stress, Role::Relaxation), strain]
                }
                [Err(error), ..] | [_, Err(error), _] | [.., Err(error)] => return Err(error),
                _ => return Err(missing("the relaxation modulus, or of stress and strain")),
            }
        } else {
            let factor = find(Role::LossFactor)?;
            let factor = if factor.is_none() { find(Role::Phase)? } else { factor };
            match (find(Role::Storage)?, find(Role::Loss)?, find(Role::Complex)?, factor) {
                (Some(first), Some(second), ..)
                | (Some(first), None, _, Some(second))
                | (None, _, Some(first), Some(second)) => vec![first, second],
                (Some(_), ..) => return Err(missing("the loss modulus or of tan δ")),
                (None, ..) => return Err(missing("the storage modulus")),
            }
        };
        let said: Vec<_> = moduli.iter().filter_map(|(column, _)| roles[*column]?.1).collect();
        let named = agreed(table, &said, given)?;
        Ok(Self { table, abscissa, temperature, moduli, named })
    }

    /// Returns the columns that are read.
    fn read(&self) -> impl Iterator<Item = usize> {
        let columns = self.moduli.iter().chain([&self.abscissa]).map(|(column, _)| *column);
        columns.chain(self.temperature)
    }

    /// Returns the point of a row; `None` if a cell has no value.
    fn point(&self, row: usize) -> Result<Option<ModulusPoint>, DataError> {
        if self.read().any(|column| self.table.is_missing(row, column)) {
            return Ok(None);
        }
        let (column, role) = self.moduli[0];
        let first = self.modulus(row, column)?;
        let [storage, loss] = match self.moduli.get(1).copied() {
            None => [first, 0.0],
            Some((column, Role::Loss)) => {
                let loss = self.modulus(row, column)?;
                if loss > LARGEST_LOSS_FACTOR * first {
                    let help = "a solid has a loss factor of at most 10: are the columns exchanged, or of different units?";
                    return Err(self.table.cell_fault(row, column, loss, help));
                }
                [first, loss]
            }
            Some((column, Role::Strain)) => {
                let strain = self.table.number(row, column, [0; 3])?;
                if !(strain.abs() > 0.0 && strain.is_finite()) {
                    return Err(self.table.cell_fault(row, column, strain, "the strain is not 0"));
                }
                [first / strain.abs(), 0.0]
            }
            Some((column, of_factor)) => {
                let factor = self.loss_factor(row, column, of_factor)?;
                let is_complex = role == Role::Complex;
                let storage = if is_complex { first / factor.hypot(1.0) } else { first };
                [storage, storage * factor]
            }
        };
        let temperature = self.temperature.map(|column| self.kelvin(row, column)).transpose()?;
        let at = abscissa_at(self.table, row, self.abscissa)?;
        Ok(Some(ModulusPoint { at, storage, loss, temperature, line: self.table.line(row) }))
    }

    /// Returns a modulus, Pa, > 0.
    fn modulus(&self, row: usize, column: usize) -> Result<f64, DataError> {
        let value = self.table.number(row, column, PRESSURE)?;
        let is_bare = ending_of(&self.table.header()[column]).is_none()
            && self.table.text(row, column).parse::<f64>().is_ok();
        let help = match value > 0.0 && value.is_finite() {
            false => "a modulus is above 0",
            true if is_bare && value < SMALLEST_BARE_MODULUS => {
                "a bare number is in Pa: name the unit in the header, such as E' [MPa] or storage_modulus_mpa"
            }
            true => return Ok(value),
        };
        Err(self.table.cell_fault(row, column, value, help))
    }

    /// Returns a temperature, K.
    fn kelvin(&self, row: usize, column: usize) -> Result<f64, DataError> {
        let value = self.table.number(row, column, [0; 3])?;
        let kelvin = match temperature_scale(&self.table.header()[column], true) {
            Some("_kelvin") => value,
            Some("_degf") => (value - 32.0) / 1.8 + ZERO_CELSIUS,
            _ => value + ZERO_CELSIUS,
        };
        match SENSIBLE_TEMPERATURES.contains(&kelvin) {
            true => Ok(kelvin),
            false => {
                let help = "temperatures are in °C unless the header has [K] or [°F]";
                Err(self.table.cell_fault(row, column, value, help))
            }
        }
    }

    /// Returns the loss factor of a row by one of its columns.
    fn loss_factor(&self, row: usize, column: usize, role: Role) -> Result<f64, DataError> {
        let value = self.table.number(row, column, [0; 3])?;
        let factor = match (role, ending_of(&self.table.header()[column])) {
            (Role::Phase, None) => (value * PI / 180.0).tan(),
            (Role::Phase, Some(_)) => value.tan(),
            _ => value,
        };
        let help = match role {
            _ if (0.0..=LARGEST_LOSS_FACTOR).contains(&factor) => return Ok(factor),
            Role::Phase => "a phase angle is from 0 to 84 degrees, without a unit in degrees",
            _ => {
                "a loss factor is E''/E', from 0 to 10; an angle is a column phase_deg, and per cents are tan_delta [%]"
            }
        };
        Err(self.table.cell_fault(row, column, value, help))
    }
}

/// Returns the modulus that all columns mean which say it, and which is the one of the caller, if that is given.
fn agreed(
    table: &Table,
    said: &[Modulus],
    given: Option<Modulus>,
) -> Result<Option<Modulus>, DataError> {
    let named = said.first().copied();
    if said.iter().any(|other| Some(*other) != named) {
        let message = "one modulus is Young's and the other one of shear";
        return Err(table.header_fault(message).with_help("both are of one test"));
    }
    if let (Some(given), Some(named)) = (given, named)
        && given != named
    {
        let message = format!("the columns are of the {}", named.key().replace('_', " "));
        return Err(table.header_fault(message).with_help("leave out --modulus"));
    }
    Ok(named)
}

/// Largest relative difference of two columns of one quantity, which are rounded.
const ROUNDED: f64 = 1e-3;

/// Whether two columns of frequencies have the same ones in all rows.
fn agree(table: &Table, first: Column, second: Column) -> bool {
    (0..table.n_rows()).all(|row| {
        match [first, second].map(|column| abscissa_at(table, row, column)) {
            [Ok(one), Ok(other)] => (one / other - 1.0).abs() < ROUNDED,
            // A row without numbers is read, or not, as any other.
            _ => true,
        }
    })
}

/// Returns an angular frequency, rad/s, or a time, s, > 0.
fn abscissa_at(table: &Table, row: usize, (column, role): Column) -> Result<f64, DataError> {
    let dimension = if role == Role::Time { [0, 0, 1] } else { [0, 0, -1] };
    let value = table.number(row, column, dimension)?;
    // The reciprocal second of an angular frequency is no cycle.
    let is_phase_rate = role == Role::AngularFrequency
        && ending_of(&table.header()[column]).is_none_or(|ending| ending.text == "_per_s");
    if !(value > 0.0 && value.is_finite()) {
        return Err(table.cell_fault(row, column, value, "it is above 0"));
    }
    Ok(if role == Role::Time || is_phase_rate { value } else { TAU * value })
}

impl ModulusTable {
    /// Returns the table of a text, without the lines above its header if there are any, and with a column of the temperatures above
    /// blocks of rows.
    fn table(name: &str, text: &str) -> Result<Table, DataError> {
        let has_role = |it: &String| Role::of(it, true).is_some();
        let has_temperature =
            |table: &Table| table.header().iter().any(|it| temperature_scale(it, true).is_some());
        let whole = Table::parse(name, text);
        let found = match whole {
            Ok(table) if table.header().iter().any(has_role) => Ok(table),
            whole => Table::of_record(name, text).or(whole),
        };
        if found.as_ref().is_ok_and(has_temperature) {
            return found;
        }
        let is_header = |line: &str| {
            let separators = if line.contains([',', ';', '\t']) { ",;\t" } else { " " };
            let cells = line.split(|c: char| separators.contains(c)).map(column_name);
            let roles: Vec<_> = cells.filter_map(|cell| Some(Role::of(&cell, false)?.0)).collect();
            let is_modulus = |it: &Role| MODULI.iter().any(|(role, ..)| role == it);
            roles.iter().any(is_modulus) && roles.iter().any(|it| it.is_abscissa())
        };
        let blocks = with_temperature_column(text, is_header);
        let blocks = blocks.and_then(|lines| Table::of_lines(name, lines, false).ok());
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
        let columns = Columns::of(&table, modulus)?;
        let named = modulus.or(columns.named);
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
