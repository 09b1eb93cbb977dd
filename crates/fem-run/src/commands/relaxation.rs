//! `fem-run relaxation DATA`: a Prony series from moduli over frequency or time.

use std::path::PathBuf;

use clap::builder::{PossibleValuesParser, TypedValueParser};
use fem::fit::cradle::Measured;
use fem::measured::{Kind, Modulus, ModulusTable, TestKind, decode};
use fem::relaxation::{Block, FoundRelaxation, RelaxationSettings};
use fem::{GAS_CONSTANT, ShiftLaw, ZERO_CELSIUS};
use fem_case::engineering::{Unit, show};
use fem_report::relaxation_figure::relaxation_figure;
use serde_json::Value;

use crate::arguments::case::stem_of;
use crate::arguments::data::{ColumnArguments, of_kind, read_bytes};
use crate::arguments::law::parse_share;
use crate::result_folder::command_output::OutputArguments;
use crate::result_folder::whole_file::OwnedFileKind;
use crate::text::{Failure, hanging, headed, show_measured, shown, standard_output};

/// The table of a relaxation, of which `--out` may ask for a copy.
const TABLE: OwnedFileKind = OwnedFileKind {
    what: "table",
    extension: "toml",
    marker: "# Prony series by",
    option: "--out",
};

/// Most rows of a table that is printed without -v.
const MOST_ROWS: usize = 4;

/// Turn moduli over frequency or time into a Prony series
///
/// The data are a CSV file of dynamic mechanical analysis, frequency with storage and loss modulus or tan delta, or of a relaxation
/// test, time with modulus. Writes NAME.relaxation.toml (the table relaxation of a material), relaxation.json, relaxation.csv and
/// relaxation.svg, and prints the Prony series with the glassy and the rubbery modulus.
#[derive(clap::Args, Debug)]
pub struct Arguments {
    /// The data: a CSV file with the columns frequency, E' and E'' (G' and G'' of shear; or tan_delta), or time and E(t)
    #[arg(value_name = "DATA")]
    file: PathBuf,
    /// The modulus that was measured [default: by the columns]
    #[arg(long, value_name = "MODULUS", value_parser = moduli())]
    modulus: Option<Modulus>,
    /// Elastic bulk modulus, so that only the shear modulus relaxes [default: Poisson's ratio is constant]
    #[arg(long, value_name = "MODULUS", value_parser = of_kind(Kind::Modulus))]
    bulk_modulus: Option<Measured>,
    /// Terms of the series per decade of time [default: by the data]
    #[arg(long, value_name = "NUMBER", value_parser = parse_density)]
    terms_per_decade: Option<f64>,
    /// Temperature to which the moduli of other temperatures are shifted [default: that in the middle]
    #[arg(long, value_name = "TEMPERATURE", value_parser = of_kind(Kind::Temperature),
        allow_hyphen_values = true)]
    reference_temperature: Option<Measured>,
    /// Scale the moduli of each temperature too
    #[arg(long)]
    vertical_shift: bool,
    /// Density of the material, for its table
    #[arg(long, value_name = "DENSITY", value_parser = of_kind(Kind::Density))]
    density: Option<Measured>,
    /// Poisson's ratio of the material, for its table
    #[arg(long, value_name = "NUMBER", value_parser = parse_share, conflicts_with = "bulk_modulus")]
    poissons_ratio: Option<f64>,
    /// Print everything: all temperatures and terms
    #[arg(long, short, conflicts_with = "quiet")]
    verbose: bool,
    #[command(flatten)]
    columns: ColumnArguments,
    #[command(flatten)]
    output: OutputArguments,
}

fn moduli() -> impl TypedValueParser<Value = Modulus> {
    PossibleValuesParser::new(["young", "shear"]).map(|name| match name.as_str() {
        "shear" => Modulus::Shear,
        _ => Modulus::Young,
    })
}

/// Parses a number of terms per decade; above 4 neighbouring terms cannot be told apart.
fn parse_density(text: &str) -> Result<f64, String> {
    let density = parse_share(text).ok().filter(|density| (0.1..=4.0).contains(density));
    density.ok_or_else(|| "give a number from 0.1 to 4".to_string())
}

impl Arguments {
    fn find(&self, bytes: &[u8]) -> Result<FoundRelaxation, Failure> {
        let (name, names) = (self.file.display().to_string(), self.columns.names()?);
        let table = ModulusTable::parse(&name, &decode(bytes), &names, self.modulus)?;
        let bulk_modulus = self.bulk_modulus.map(|bulk| bulk.value);
        let settings = RelaxationSettings {
            terms_per_decade: self.terms_per_decade,
            bulk_modulus,
            reference_temperature: self.reference_temperature.map(|it| it.value),
            has_vertical_shift: self.vertical_shift,
        };
        Ok(FoundRelaxation::of(table, settings)?)
    }

    fn name(&self) -> String {
        stem_of(&self.file)
    }

    fn material(&self, found: &FoundRelaxation) -> String {
        let density = self.density.map(|density| density.value);
        found.material_toml(&self.name(), density, self.poissons_ratio)
    }
}

pub fn execute(arguments: &Arguments) -> Result<(), Failure> {
    let path = &arguments.file;
    let found = arguments.find(&read_bytes(path)?)?;
    let origin = arguments.columns.origin("relaxation", None, Some(path));
    let name = arguments.name();
    let mut output = arguments.output.claim_with_copy(&name, "relaxation", origin, TABLE)?;
    let file = format!("{name}.relaxation.toml");
    output.write(&file, found.relaxation_toml());
    let rows = found.rows().map(|row| row.into_iter().map(Some).collect::<Vec<_>>());
    output.write_table("relaxation.csv", found.columns(), rows);
    output.write("relaxation.svg", relaxation_figure(&found));
    standard_output::warn(found.warnings());
    output.publish(&found.numbers(), |kept| {
        let table = kept.path(&file).map_or(String::new(), |path| {
            let (material, path) = (arguments.material(&found), shown(&path).replace('\\', "/"));
            let other = other_temperature(&found);
            format!("\n{material}relaxation = {{ file = \"{path}\" }}\n{other}")
        });
        let most = if arguments.verbose { usize::MAX } else { MOST_ROWS };
        answer(&found) + &shifts(&found, most) + &terms(&found, most) + &table
    })
}

/// Fits moduli in memory and returns the numbers with the picture and the tables to paste.
pub fn numbers(arguments: &Arguments, bytes: &[u8]) -> Result<Value, Failure> {
    let found = arguments.find(bytes)?;
    let mut numbers = found.numbers();
    numbers["svg"] = relaxation_figure(&found).into();
    numbers["relaxation_toml"] = found.relaxation_toml().into();
    numbers["material_toml"] = arguments.material(&found).into();
    Ok(numbers)
}

/// Returns the number of terms, the glassy and the rubbery modulus, and what the data are.
fn answer(found: &FoundRelaxation) -> String {
    let series = &found.series;
    let modulus = |value: f64, uncertainty: f64| {
        let unit = Unit::fitting(value.max(uncertainty), "Pa");
        let [value, uncertainty] = [value, uncertainty].map(|it| unit.scaled(it));
        show_measured(Measured { value, uncertainty }, unit.symbol())
    };
    let [from, to] = found.band();
    let symbol = found.modulus().symbol();
    let n = series.terms.len();
    let terms = if n == 1 { "1 term".to_string() } else { format!("{n} terms") };
    let constant = match found.bulk_modulus {
        Some(_) => "elastic bulk modulus",
        None => "constant Poisson's ratio",
    };
    let of_test = match found.table.kind {
        TestKind::Oscillation => "",
        TestKind::Relaxation => " (1/2πt)",
    };
    format!(
        "{terms}, {constant}; the series misses {} moduli by {:.2} % (rms)\n\n\
         glassy modulus {symbol}0: {}\nrubbery modulus {symbol}∞: {}\nmeasured band: {} to {}{of_test}\n",
        found.points.len() * if found.table.kind == TestKind::Oscillation { 2 } else { 1 },
        100.0 * series.rms,
        modulus(series.instantaneous_modulus(), series.instantaneous_uncertainty),
        modulus(series.equilibrium_modulus, series.equilibrium_uncertainty),
        show(from, "Hz"),
        show(to, "Hz"),
    ) + &found
        .temperature
        .map_or(String::new(), |kelvin| format!("temperature: {:.1} °C\n", kelvin - ZERO_CELSIUS))
        + "\n"
}

/// Returns the table of shift factors, if it has no more than `most` rows, with the laws that were fitted to them.
fn shifts(found: &FoundRelaxation, most: usize) -> String {
    let Some(superposition) = &found.superposition else { return String::new() };
    let log10 = |ln: f64| ln / std::f64::consts::LN_10;
    let celsius = |kelvin: f64| format!("{:.1} °C", kelvin - ZERO_CELSIUS);
    let row = |block: &Block| {
        let [value, uncertainty] = [block.ln_shift, block.shift_uncertainty].map(log10);
        let shift = match uncertainty > 0.0 {
            true => show_measured(Measured { value, uncertainty }, ""),
            false => "0".to_string(),
        };
        [celsius(block.temperature), shift]
    };
    let mut rows: Vec<(f64, [String; 2])> =
        superposition.blocks.iter().map(|block| (block.temperature, row(block))).collect();
    rows.extend(
        superposition
            .left_out
            .iter()
            .map(|kelvin| (*kelvin, [celsius(*kelvin), "not determined".to_string()])),
    );
    rows.sort_by(|a, b| a.0.total_cmp(&b.0));
    let mut text = match &rows[..] {
        [first, .., last] if rows.len() > most => {
            let n = rows.len();
            format!("{n} temperatures, {} to {}; -v lists them\n", first.1[0], last.1[0])
        }
        _ => headed(">temperature|>log10 a_T", rows.into_iter().map(|(_, row)| row)) + "\n",
    };
    let measured = |value: f64, uncertainty: f64, unit: &str| {
        show_measured(Measured { value, uncertainty }, unit)
    };
    for fitted in [&superposition.wlf, &superposition.arrhenius].into_iter().flatten() {
        let u = &fitted.uncertainties;
        let line = match &fitted.law {
            ShiftLaw::Wlf { c1, c2 } => {
                format!("WLF: C1 = {}, C2 = {}", measured(*c1, u[0], ""), measured(*c2, u[1], "K"))
            }
            ShiftLaw::Arrhenius { activation_temperature } => {
                let energy = |kelvin: f64| 1e-3 * GAS_CONSTANT * kelvin;
                let energy = measured(energy(*activation_temperature), energy(u[0]), "kJ/mol");
                format!("Arrhenius: activation energy {energy}")
            }
            ShiftLaw::Table(_) => String::new(),
        };
        let misfit = fitted.largest_deviation;
        text += &hanging(&format!("{line}; misses log10 a_T by up to {misfit:.2}\n"));
    }
    text + "\n"
}

/// Returns the line by which a case uses the series at another temperature, here the measured one that is farthest away.
fn other_temperature(found: &FoundRelaxation) -> String {
    let Some(superposition) = &found.superposition else { return String::new() };
    let reference = found.temperature.unwrap_or_default();
    let distance = |block: &&Block| (block.temperature - reference).abs();
    let far = superposition.blocks.iter().max_by(|a, b| distance(a).total_cmp(&distance(b)));
    far.map_or(String::new(), |far| {
        let celsius = far.temperature - ZERO_CELSIUS;
        format!("# at another temperature, above all tables: scene.temperature = \"{celsius:.0} degC\"\n")
    })
}

/// Returns the table of terms, if it has no more than `most` rows.
fn terms(found: &FoundRelaxation, most: usize) -> String {
    if let [first, .., last] = &found.series.terms[..]
        && found.series.terms.len() > most
    {
        let [first, last] = [first, last].map(|term| show(term.relaxation_time, "s"));
        return format!("relaxation times: {first} to {last}; -v lists them\n");
    }
    let whole = found.series.instantaneous_modulus();
    let row = |term: &fem::relaxation::FittedTerm| {
        let [value, uncertainty] = [term.modulus, term.uncertainty].map(|it| it / whole);
        [show(term.relaxation_time, "s"), show_measured(Measured { value, uncertainty }, "")]
    };
    headed(">relaxation time|>weight", found.series.terms.iter().map(row))
}
