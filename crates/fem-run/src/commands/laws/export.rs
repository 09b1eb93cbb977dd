//! `fem-run export CASE`: input snippets for DEM codes from measured, fitted or computed restitutions.

use std::collections::BTreeSet;
use std::path::PathBuf;

use fem::fit::dem::{BAND_FILE, Snippet, grain_snippets};
use fem::laws::{DemExport, ImpactCurve, LawExport, PairExport, StoredFit};
use fem::measured::{Restitutions, Table};
use fem_case::Case;
use fem_report::law_figures::{compiled_law_figure, export_figure};
use serde_json::Value;

use super::export_text::{
    export_text, law_json, law_note, law_text, pairs_csv, pairs_json, pairs_text,
};
use crate::arguments::case::CaseArguments;
use crate::arguments::data::RestitutionArguments;
use crate::arguments::law::{parse_length, parse_share, parse_speed};
use crate::result_folder::Origin;
use crate::result_folder::command_output::OutputArguments;
use crate::text::failure::Failure;
use crate::text::run_report::Detail;
use crate::text::shown;
use crate::text::standard_output;

/// Error of e up to which the one e of a pair counts as valid by default.
const PAIRS_TOLERANCE: f64 = 0.01;

/// Write input for DEM codes that reproduces the restitutions
///
/// For LAMMPS, LIGGGHTS, YADE, MercuryDPM, Lethe, MFIX-DEM and, in robotics, Drake, MuJoCo and Newton. The restitutions come from
/// the sweep.csv of a sweep over speeds, from a measurement, from a law fitted to one or, without --data
/// and --fit, from the case: its contact law or, in place of another model, the law mean_pressure where bodies flow and
/// Ting's or Hertz' model elsewhere. Each snippet states the speeds for which it is valid.
#[derive(clap::Args, Debug)]
pub struct Arguments {
    #[command(flatten)]
    input: CaseArguments,
    /// Restitutions, optionally with contact times: a CSV file, such as a sweep's sweep.csv
    #[arg(long, value_name = "FILE", conflicts_with = "speeds")]
    data: Option<PathBuf>,
    #[command(flatten)]
    restitutions: RestitutionArguments,
    /// The result of fem-run fit, its folder or its fit.json: the fitted law gives the restitutions, over the
    /// speeds of its data
    #[arg(long, value_name = "DIR", conflicts_with_all = ["data", "materials", "diameters"])]
    fit: Option<PathBuf>,
    /// Range of speeds to compute, such as '5 cm/s..2 m/s' [default: a decade around that of the case, or the
    /// speeds of the fit]
    #[arg(long, value_name = "LOW..HIGH", value_parser = parse_speeds)]
    speeds: Option<(f64, f64)>,
    /// Write one table for all pairs of spheres of these materials, of the case or lib:NAME [default with
    /// --diameters: those of the case]
    #[arg(long, value_name = "NAMES", value_delimiter = ',', conflicts_with = "data")]
    materials: Vec<String>,
    /// Write one table for all pairs of spheres of these diameters, such as '1 mm,2 mm' [default with
    /// --materials: those of the case]
    #[arg(long, value_name = "LENGTHS", value_delimiter = ',', value_parser = parse_length,
        conflicts_with = "data")]
    diameters: Vec<f64>,
    /// Write the computed pair itself, as a contact law in one C header, pair_CASE.h, with e(v) and T(v) [default of --speeds: a
    /// decade on both sides of the speed of the case]
    #[arg(long, conflicts_with_all = ["data", "fit", "materials", "diameters", "tolerance"])]
    law: bool,
    /// Largest error of the restitution at which a snippet counts as valid [default: 0.01 or, if it is larger,
    /// three standard deviations of the data from a smooth curve, or the rms error of the fit]
    #[arg(long, value_name = "E", value_parser = parse_share)]
    tolerance: Option<f64>,
    /// Print everything: also the numbers in each file that decide on the loss
    #[arg(long, short, conflicts_with = "quiet")]
    verbose: bool,
    #[command(flatten)]
    output: OutputArguments,
}

/// The parts of an export, of one pair or of all pairs of some grains.
struct Exported {
    warnings: Vec<String>,
    numbers: Value,
    /// The table of all pairs.
    table: Option<Vec<u8>>,
    /// The files for the codes, and the table of the band, by name.
    texts: Vec<(String, String)>,
    /// The figure of one pair, export.svg.
    figure: Option<String>,
    /// The printed text.
    shown: String,
}

pub fn execute(arguments: &Arguments) -> Result<(), Failure> {
    let case = arguments.input.load_and_warn()?;
    let table =
        arguments.data.as_deref().map(|path| arguments.restitutions.read(path)).transpose()?;
    let exported = exported(arguments, &case, table.as_ref())?;
    standard_output::warn(exported.warnings);
    let mut output =
        arguments.output.claim(&arguments.input.stem(), "export", arguments.origin(&case))?;
    exported.table.iter().for_each(|table| output.write("pairs.csv", table));
    exported.texts.iter().for_each(|(name, text)| output.write(name, text));
    exported.figure.iter().for_each(|figure| output.write("export.svg", figure));
    output.publish(&exported.numbers, |_| exported.shown)
}

/// Fits to a table in memory and returns the numbers, each snippet with its text.
pub fn numbers(
    arguments: &Arguments,
    case: &Case,
    table: Option<&Table>,
) -> Result<Value, Failure> {
    let table =
        table.cloned().map(|table| arguments.restitutions.name_columns(table)).transpose()?;
    let Exported { mut numbers, texts, .. } = exported(arguments, case, table.as_ref())?;
    numbers["texts"] = texts.into_iter().collect();
    Ok(numbers)
}

fn exported(
    arguments: &Arguments,
    case: &Case,
    table: Option<&Table>,
) -> Result<Exported, Failure> {
    let name = arguments.input.name();
    if !(arguments.materials.is_empty() && arguments.diameters.is_empty()) {
        return pairs(arguments, case, &name);
    }
    if arguments.law {
        return law(arguments, case, &name);
    }
    let (fitted, snippets) = fitted(arguments, case, table)?;
    let ImpactCurve { bounds, left_out, band, .. } = &fitted.curve;
    // Those of a fit are among its own warnings.
    let bounds = bounds.iter().filter(|_| arguments.fit.is_none());
    let warnings = bounds.chain(left_out).cloned().collect();
    let texts = snippets.iter().map(|snippet| (snippet.name, snippet.text.clone()));
    let texts = texts.chain(band.as_ref().map(|band| (BAND_FILE, band.csv())));
    let texts = texts.map(|(name, text)| (name.to_string(), text)).collect();
    let detail = if arguments.verbose { Detail::All } else { Detail::Short };
    let mut shown = export_text(&fitted, &snippets, detail);
    shown += &law_note(&fitted, arguments.data.is_some());
    if fitted.curve.has_hertz_times {
        shown += "\nThe data have no contact times: the linear models use those of Hertz.\n";
    }
    if fitted.export.spheres.len() < 2 {
        shown += "\nLIGGGHTS and YADE get no file: their walls need a material or a radius.\n";
    }
    let numbers = fitted.numbers(&name, &snippets);
    let figure = Some(export_figure(&fitted));
    Ok(Exported { warnings, numbers, table: None, texts, figure, shown })
}

/// Writes the pair as a C header, which is named after the case.
fn law(arguments: &Arguments, case: &Case, name: &str) -> Result<Exported, Failure> {
    let stem = arguments.input.stem();
    let identifier = stem.replace(|c: char| !c.is_ascii_alphanumeric(), "_");
    let export =
        LawExport::of(case, &identifier, arguments.speeds, arguments.restitutions.as_elastic)?;
    let own = own_laws(case, &export);
    let (fitted, best) =
        own.as_ref().map_or((&[][..], &[][..]), |(fitted, best)| (&fitted.laws[..], &best[..]));
    Ok(Exported {
        warnings: Vec::new(),
        numbers: law_json(&export, best, name),
        table: None,
        texts: [(export.law.file_name(), export.law.header())]
            .into_iter()
            .chain(export.law.hosts())
            .collect(),
        figure: Some(compiled_law_figure(&export, fitted)),
        shown: law_text(&export, best),
    })
}

/// Fits the codes' own laws to the pair at the speeds of its law, and returns them with the best file of each code; `None` if no law of
/// theirs has a loss like this.
fn own_laws(case: &Case, export: &LawExport) -> Option<(DemExport, Vec<Snippet>)> {
    let [slow, fast] = export.speeds();
    let curve = ImpactCurve::computed(case, Some((slow, fast)), true).ok()?;
    let tolerance = curve.default_tolerance();
    let fitted = DemExport::of(case, curve, tolerance).ok()?;
    let mut best = ranked(&fitted).ok()?;
    let mut codes = BTreeSet::new();
    best.retain(|snippet| codes.insert(snippet.code));
    Some((fitted, best))
}

/// Returns the files of an export, that with the least error first.
fn ranked(fitted: &DemExport) -> Result<Vec<Snippet>, Failure> {
    let mut snippets = fitted.export.snippets()?;
    snippets.sort_by(|one, other| one.validity[2].total_cmp(&other.validity[2]));
    Ok(snippets)
}

fn pairs(arguments: &Arguments, case: &Case, name: &str) -> Result<Exported, Failure> {
    let tolerance = arguments.checked_tolerance()?.unwrap_or(PAIRS_TOLERANCE);
    let Arguments { materials, diameters, speeds, .. } = arguments;
    let as_elastic = arguments.restitutions.as_elastic;
    let export = PairExport::of(case, materials, diameters, *speeds, tolerance, as_elastic)?;
    let rows = export.numbers();
    Ok(Exported {
        warnings: export.warnings(),
        numbers: pairs_json(&export, name, &rows)?,
        table: Some(pairs_csv(&rows)?),
        texts: grain_snippets(&export.grains, &export.of_codes())
            .into_iter()
            .map(|(name, text)| (name.to_string(), text))
            .collect(),
        figure: None,
        shown: pairs_text(&export, &rows),
    })
}

impl Arguments {
    fn origin(&self, case: &Case) -> Origin {
        let data = self.data.as_deref();
        let origin = self.restitutions.origin("export", Some((&self.input, case)), data);
        let grains: Vec<String> = self
            .materials
            .iter()
            .cloned()
            .chain(self.diameters.iter().map(|d| d.to_string()))
            .collect();
        let origin = origin.with_inputs(&grains);
        self.fit_file().into_iter().fold(origin, |origin, file| origin.with_data_file(&file))
    }

    /// Returns the path of the fit.json.
    fn fit_file(&self) -> Option<PathBuf> {
        let path = self.fit.as_ref()?;
        Some(if path.is_dir() { path.join("fit.json") } else { path.clone() })
    }

    fn stored_fit(&self, case: &Case) -> Result<Option<StoredFit>, Failure> {
        let Some(path) = self.fit_file() else { return Ok(None) };
        let name = path.display().to_string();
        let text = std::fs::read_to_string(&path).map_err(|error| {
            Failure::bad_input(format!("--fit {}: {error}", shown(&path))).with_help(
                "name the folder of a fit: fem-run fit CASE --data FILE writes runs/FILE_fit",
            )
        })?;
        Ok(Some(StoredFit::read(case, &name, &text)?))
    }

    fn checked_tolerance(&self) -> Result<Option<f64>, Failure> {
        match self.tolerance {
            Some(tolerance) if !(tolerance > 0.0 && tolerance < 1.0) => {
                let message = format!("--tolerance must be between 0 and 1, found {tolerance:?}");
                Err(Failure::bad_input(message)
                    .with_help("give the largest error of e, such as 0.01"))
            }
            tolerance => Ok(tolerance),
        }
    }
}

fn fitted(
    arguments: &Arguments,
    case: &Case,
    table: Option<&Table>,
) -> Result<(DemExport, Vec<Snippet>), Failure> {
    let tolerance = arguments.checked_tolerance()?;
    let curve = match (table, arguments.stored_fit(case)?) {
        (None, Some(fit)) => {
            standard_output::warn(fit.warnings.iter().map(|text| format!("the fit: {text}")));
            ImpactCurve::fitted(&fit, arguments.speeds)?
        }
        (None, None) => {
            ImpactCurve::computed(case, arguments.speeds, arguments.restitutions.as_elastic)?
        }
        (Some(table), _) => {
            let data = Restitutions::read_with_contact_times(table, case.scene())?;
            ImpactCurve::measured(case.scene(), &data)?
        }
    };
    let tolerance = tolerance.unwrap_or_else(|| curve.default_tolerance());
    let fitted = DemExport::of(case, curve, tolerance)?;
    let snippets = ranked(&fitted)?;
    Ok((fitted, snippets))
}

fn parse_speeds(text: &str) -> Result<(f64, f64), String> {
    let (low, high) = text.split_once("..").ok_or("write LOW..HIGH, such as '5 cm/s..2 m/s'")?;
    let (low, high) = (parse_speed(low)?, parse_speed(high)?);
    if low < high { Ok((low, high)) } else { Err("the range is empty".to_string()) }
}
