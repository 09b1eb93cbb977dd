//! `fem-run fit CASE --data E.csv --law NAME`: parameters of a law from measured restitutions.

use std::path::PathBuf;

use fem::fit::dem::CODE_LAWS;
use fem::fit::{Free, Problem};
use fem::laws::{ChosenLaw, FrictionFit, LawFit, LawRanking, family_of, parse_value};
use fem::measured::{Rebounds, Restitutions, Table};
use fem_case::Case;
use fem_laws::LawFamily;
use fem_report::law_figures::{fit_figure, histories_figure};
use serde_json::Value;

use super::fit_text::{answer, fit_text, next_steps, ranking_csv, ranking_text};
use super::friction;
use crate::arguments::case::{CaseArguments, stem_of};
use crate::arguments::data::RestitutionArguments;
use crate::arguments::law::{
    End, LawArguments, find_key, of_value, parse_confidence, parse_family, parse_speed, split,
};
use crate::jobs::value_of;
use crate::result_folder::command_output::OutputArguments;
use crate::text::failure::Failure;
use crate::text::run_report::Detail;
use crate::text::standard_output;

/// Fit a contact law to restitutions, or friction to rebound angles
///
/// The case gives the two bodies, a CSV file the restitutions. Writes fit.json, residuals.csv, fit.svg and
/// histories.svg, and prints values with their confidence intervals. Rebound angles, spins or tangential velocities
/// over the impact angle give the coefficient of friction instead, with the model of the case.
#[derive(clap::Args, Debug)]
pub struct Arguments {
    #[command(flatten)]
    input: CaseArguments,
    /// Restitutions: a CSV file with the columns speed_m_s (or speed_cm_s) and restitution, or lib:ice for
    /// those of the materials library
    ///
    /// A column restitution_uncertainty weights them. The sweep.csv of a sweep over speeds has this form. For the
    /// friction: impact_angle_deg, and rebound_angle_deg, spin_after_rad_s or tangential_velocity_after_m_s.
    #[arg(long, value_name = "FILE")]
    data: PathBuf,
    #[command(flatten)]
    restitutions: RestitutionArguments,
    /// The law, such as bordbar_hyppanen or ting; `all` finds the law that explains the data best [default:
    /// that of the case's model, or all]
    #[arg(long, value_name = "LAW", value_parser = parse_wanted)]
    law: Option<Wanted>,
    /// Find the best law among those that this code has
    #[arg(long = "for", value_name = "CODE", conflicts_with = "law",
        value_parser = CODE_LAWS.map(|(code, _)| code))]
    code: Option<String>,
    /// Parameters to fit, such as a,n, or friction [default: the damping parameter]
    #[arg(long, value_name = "KEYS", value_delimiter = ',')]
    free: Vec<String>,
    #[command(flatten)]
    values: LawArguments,
    /// Bounds of a free parameter, such as n=0.3..1.5; may be repeated
    #[arg(long, value_name = "KEY=LOW..HIGH")]
    bounds: Vec<String>,
    /// Draw the error over this free parameter with all others refitted [default: n if it is free]
    #[arg(long, value_name = "KEY")]
    profile: Option<String>,
    /// Also fit this law, with its damping free, for comparison; may be repeated
    #[arg(long, value_name = "LAW", value_parser = parse_family)]
    compare: Vec<LawFamily>,
    /// Also fit the column contact_time_s
    #[arg(long)]
    contact_time: bool,
    /// Fit robustly: points far from the curve count little, and are listed
    #[arg(long)]
    robust: bool,
    /// Confidence level of the intervals
    #[arg(long, value_name = "P", default_value_t = 0.95, allow_negative_numbers = true,
        value_parser = parse_confidence)]
    confidence: f64,
    /// Speed for which histories are drawn [default: the middle of the data]
    #[arg(long, value_name = "SPEED", value_parser = parse_speed)]
    at: Option<f64>,
    /// Print everything: all laws of a ranking with their values
    #[arg(long, short, conflicts_with = "quiet")]
    verbose: bool,
    #[command(flatten)]
    output: OutputArguments,
}

#[derive(Clone, Copy, Debug)]
enum Wanted {
    One(LawFamily),
    All,
}

fn parse_wanted(name: &str) -> Result<Wanted, String> {
    match name {
        "all" => Ok(Wanted::All),
        name => parse_family(name).map(Wanted::One).map_err(|told| format!("{told}; or all")),
    }
}

pub fn execute(arguments: &Arguments) -> Result<(), Failure> {
    let case = arguments.input.load_and_warn()?;
    let table = arguments.restitutions.read(&arguments.data)?;
    if finds_friction(arguments, &table)? {
        return with_friction(&case, &table, |fit| write_friction(arguments, &case, fit));
    }
    fitted(arguments, &case, &table, |found| write(arguments, &case, found))
}

/// Fits to a table in memory and returns the numbers.
pub fn numbers(arguments: &Arguments, case: &Case, table: &Table) -> Result<Value, Failure> {
    let table = arguments.restitutions.name_columns(table.clone())?;
    let name = arguments.input.name();
    if finds_friction(arguments, &table)? {
        return with_friction(case, &table, |fit| value_of(&fit.numbers(&name)));
    }
    fitted(arguments, case, &table, |found| value_of(&found.fitted.numbers(&name)))
}

/// Returns whether the coefficient of friction is fitted to a table of rebounds; options of laws are rejected beside it.
fn finds_friction(arguments: &Arguments, table: &Table) -> Result<bool, Failure> {
    let of_laws = [
        ("--law", arguments.law.is_some()),
        ("--for", arguments.code.is_some()),
        ("--param", !arguments.values.param.is_empty()),
        ("--end", arguments.values.end.is_some()),
        ("--bounds", !arguments.bounds.is_empty()),
        ("--profile", arguments.profile.is_some()),
        ("--compare", !arguments.compare.is_empty()),
        ("--contact-time", arguments.contact_time),
        ("--robust", arguments.robust),
    ];
    let given = of_laws.iter().find(|(_, is_given)| *is_given);
    let is_asked = friction::is_asked(&arguments.free, table, given.is_some())?;
    match given.filter(|_| is_asked) {
        Some((option, _)) => {
            let message = format!("{option} belongs to a law, and --free friction fits none");
            Err(Failure::bad_input(message).with_help("leave one of the two out"))
        }
        None => Ok(is_asked),
    }
}

/// Fits the coefficient of friction, and applies `then` to the result.
fn with_friction<T>(
    case: &Case,
    table: &Table,
    then: impl FnOnce(&FrictionFit<'_>) -> Result<T, Failure>,
) -> Result<T, Failure> {
    let data = Rebounds::read(table)?;
    then(&FrictionFit::of(case, &data)?)
}

fn write_friction(
    arguments: &Arguments,
    case: &Case,
    fit: &FrictionFit<'_>,
) -> Result<(), Failure> {
    let from_case = Some((&arguments.input, case));
    let origin = arguments.restitutions.origin("fit", from_case, Some(&arguments.data));
    let mut output = arguments.output.claim(&stem_of(&arguments.data), "fit", origin)?;
    output.write_table("residuals.csv", &FrictionFit::RESIDUAL_COLUMNS, fit.residuals());
    standard_output::warn(fit.warnings());
    output.publish(&fit.numbers(&arguments.input.name()), |_| friction::text(fit))
}

struct Found<'a> {
    fitted: LawFit<'a>,
    law: &'a ChosenLaw,
    ranking: Option<LawRanking>,
}

/// Fits, and applies `then` to the result.
fn fitted<T>(
    arguments: &Arguments,
    case: &Case,
    table: &Table,
    then: impl FnOnce(&Found<'_>) -> Result<T, Failure>,
) -> Result<T, Failure> {
    let data = match arguments.contact_time {
        true => Restitutions::read_with_contact_times(table, case.scene())?,
        false => Restitutions::read(table, case.scene())?,
    };
    let of_case = || family_of(case.scene()).map(Wanted::One).filter(|_| arguments.code.is_none());
    let wanted = arguments.law.or_else(of_case).unwrap_or(Wanted::All);
    let ranking = match wanted {
        Wanted::One(_) => None,
        Wanted::All => Some(ranked(arguments, case, &data)?),
    };
    let best = ranking.as_ref().and_then(|ranking| ranking.laws.first());
    let (family, free) = match (wanted, best) {
        (Wanted::One(family), _) => (family, arguments.free.clone()),
        (Wanted::All, Some(best)) => {
            (best.family(), best.free.iter().map(ToString::to_string).collect())
        }
        (Wanted::All, None) => return Err(Failure::failed("no law can be fitted")),
    };
    let law = arguments.values.choose(case, family)?;
    let problem = problem(arguments, &law, &data, &free)?;
    let profiled = profiled(arguments, &problem)?.copied();
    let mut fitted = LawFit::of(&data, problem, arguments.confidence)?.with_inputs(case, &law);
    if let Some(free) = &profiled {
        fitted = fitted.with_profile(free)?;
    }
    if let Some(ranking) = &ranking {
        fitted = fitted.compared_with_ranked(ranking);
    }
    let is_ranked = |family: &&LawFamily| {
        ranking.as_ref().is_some_and(|all| all.laws.iter().any(|law| law.family() == **family))
    };
    for family in arguments.compare.iter().filter(|family| !is_ranked(family)) {
        fitted = fitted.compared_with(*family)?;
    }
    then(&Found { fitted, law: &law, ranking })
}

fn write(arguments: &Arguments, case: &Case, found: &Found<'_>) -> Result<(), Failure> {
    let Found { fitted, law, ranking } = found;
    let from_case = Some((&arguments.input, case));
    let origin = arguments.restitutions.origin("fit", from_case, Some(&arguments.data));
    let mut output = arguments.output.claim(&stem_of(&arguments.data), "fit", origin)?;
    output.write_table("residuals.csv", &LawFit::RESIDUAL_COLUMNS, fitted.residuals());
    if let Some(ranking) = ranking {
        output.write("ranking.csv", ranking_csv(ranking));
    }
    output.write("fit.svg", fit_figure(fitted, ranking.as_ref()));
    let speed = arguments.at.unwrap_or_else(|| fitted.problem.middle_speed());
    let histories = histories_figure(case.scene(), law.model(), &fitted.fit.values, speed)?;
    output.write("histories.svg", histories);
    standard_output::warn(fitted.warnings());
    let detail = if arguments.verbose { Detail::All } else { Detail::Short };
    output.publish(&fitted.numbers(&arguments.input.name()), |kept| {
        answer(fitted, ranking.as_ref())
            + &ranking.as_ref().map_or(String::new(), |all| ranking_text(all, detail))
            + &fit_text(fitted, law, ranking.as_ref().filter(|_| detail == Detail::Short))
            + &next_steps(fitted, &arguments.input.name(), kept.folder())
    })
}

/// Ranks all laws; options of a single law are rejected.
fn ranked(arguments: &Arguments, case: &Case, data: &Restitutions) -> Result<LawRanking, Failure> {
    let of_one = [
        ("--free", &arguments.free),
        ("--param", &arguments.values.param),
        ("--bounds", &arguments.bounds),
    ];
    if let Some((option, _)) = of_one.iter().find(|(_, given)| !given.is_empty()) {
        return Err(Failure::bad_input(format!("{option} applies to a single law, not to all"))
            .with_help("leave it out, or name the law, such as --law kuwabara_kono"));
    }
    let of_code = CODE_LAWS.iter().find(|(code, _)| arguments.code.as_deref() == Some(code));
    let among = of_code.map_or(&LawFamily::ALL[..], |(_, laws)| laws);
    let end_rule = arguments.values.end.map(End::rule);
    Ok(LawRanking::of(case, data, among, end_rule, arguments.robust)?)
}

fn problem<'a>(
    arguments: &Arguments,
    law: &'a ChosenLaw,
    data: &'a Restitutions,
    free: &[String],
) -> Result<Problem<'a>, Failure> {
    for key in free {
        find_key(law.family(), key, "--free")?;
    }
    let free: Vec<&str> = free.iter().map(String::as_str).collect();
    let mut problem = law.problem(&data.points, &free)?.robust(arguments.robust);
    for text in &arguments.bounds {
        bound(&mut problem, law.family(), text)?;
    }
    Ok(problem)
}

fn bound(problem: &mut Problem<'_>, family: LawFamily, text: &str) -> Result<(), Failure> {
    let (key, range) = split(text, "--bounds")?;
    let index = find_key(family, key, "--bounds")?;
    let parameter = &family.parameters()[index];
    let fault = |found: &str| {
        Failure::bad_input(format!("--bounds {text:?}: {found}"))
            .with_help("write --bounds KEY=LOW..HIGH with LOW < HIGH, such as --bounds n=0.3..1.5")
    };
    let (low, high) = range.split_once("..").ok_or_else(|| fault("there is no `..`"))?;
    let low = parse_value(parameter, low).map_err(of_value("--bounds"))?;
    let high = parse_value(parameter, high).map_err(of_value("--bounds"))?;
    if low >= high {
        return Err(fault("the range is empty"));
    }
    let free = problem.free.iter_mut().find(|free| free.index == index);
    free.ok_or_else(|| fault("the parameter is not free"))?.bounds = (low, high);
    Ok(())
}

/// Returns the free parameter whose profile is drawn.
fn profiled<'p>(
    arguments: &Arguments,
    problem: &'p Problem<'_>,
) -> Result<Option<&'p Free>, Failure> {
    let find = |index: usize| problem.free.iter().find(|free| free.index == index);
    match &arguments.profile {
        None => Ok(problem.free.iter().find(|free| problem.parameter(free.index).key == "n")),
        Some(key) => {
            let free = find(find_key(problem.model.family(), key, "--profile")?);
            free.map(Some).ok_or_else(|| {
                Failure::bad_input(format!("--profile {key}: this parameter is not free"))
                    .with_help(format!("add it to --free, such as --free {key}"))
            })
        }
    }
}
