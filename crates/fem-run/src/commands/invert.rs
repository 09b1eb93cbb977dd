//! `fem-run invert CASE --restitution 0.92`: the parameter of a law that gives it.

use comfy_table::CellAlignment::{Left, Right};
use fem_case::Case;
use fem_fit::{Family, FitError, Inversion, Model, Problem, invert};

use crate::arguments::CaseArguments;
use crate::engineering::show;
use crate::failure::Failure;
use crate::reduced::{
    LawArguments, approach_speed, find_key, from_fit_error, model_of, parse_family, parse_speed,
    show_value,
};
use crate::standard_output;
use crate::tables::table;

/// Find the parameter of a law that gives a wanted restitution at one speed
///
/// The case gives the two bodies and the speed. For the law `ting` it is the decay rate of the
/// bodies' relaxation. Without --law, all laws that need no more than one number.
#[derive(clap::Args, Debug)]
pub struct Arguments {
    #[command(flatten)]
    input: CaseArguments,
    /// The restitution that is wanted, between 0 and 1
    #[arg(long, value_name = "E")]
    restitution: f64,
    /// The law [default: all]
    #[arg(long, value_name = "LAW", value_parser = parse_family)]
    law: Option<Family>,
    /// The parameter to find [default: the one that damps]
    #[arg(long, value_name = "KEY", requires = "law")]
    find: Option<String>,
    #[command(flatten)]
    values: LawArguments,
    /// The approach speed [default: that of the case]
    #[arg(long, value_name = "SPEED", value_parser = parse_speed)]
    speed: Option<f64>,
    /// Print nothing but errors
    #[arg(long, short)]
    quiet: bool,
}

/// Solves and prints.
pub fn execute(arguments: &Arguments) -> Result<(), Failure> {
    let case = Case::load(&arguments.input.case, &arguments.input.set)?;
    let speed = arguments.speed.unwrap_or_else(|| approach_speed(&case.scene));
    let mut rows = vec![["law", "parameter", "value", "SI", "contact time"].map(String::from)];
    if arguments.law.is_none() && !arguments.values.param.is_empty() {
        return Err(Failure::bad_input("--param: of which law?").with_help("name it with --law"));
    }
    let families: Vec<Family> = arguments.law.map_or(Family::ALL.to_vec(), |law| vec![law]);
    for family in families {
        match solve(arguments, &case, family, speed) {
            Ok(solved) => rows.extend(lines(&solved, speed)),
            Err(failure) if arguments.law.is_some() => return Err(failure),
            // Of all laws, those that cannot are told so in the table.
            Err(_) if needs_more(family) => {}
            Err(failure) => {
                let reason = failure.to_string();
                let short = reason.split(':').next().unwrap_or("").to_string();
                rows.push([family.name().into(), String::new(), "-".into(), short, String::new()]);
            }
        }
    }
    if arguments.quiet {
        return Ok(());
    }
    standard_output::print(&format!(
        "restitution {} at {}\n\n{}",
        arguments.restitution,
        show(speed, "m/s"),
        table(&[Left, Left, Right, Right, Right], rows)
    ))
}

/// A model with the values that give the restitution.
struct Solved {
    model: Model,
    index: usize,
    values: Vec<f64>,
    inversion: Inversion,
}

/// Laws with numbers that no theory gives.
fn needs_more(family: Family) -> bool {
    let loss = family.loss_parameter();
    let mut others = family.parameters().iter().enumerate().filter(|(index, _)| *index != loss);
    others.any(|(_, parameter)| parameter.default.is_none() && parameter.unit != "m/s")
}

fn solve(
    arguments: &Arguments,
    case: &Case,
    family: Family,
    speed: f64,
) -> Result<Solved, Failure> {
    let model = model_of(case, family, arguments.values.end.rule()).map_err(from_fit_error)?;
    let index = match &arguments.find {
        Some(key) => find_key(family, key, "--find")?,
        None => family.loss_parameter(),
    };
    let settings = arguments.values.settings(family)?;
    let missing = family.parameters().iter().enumerate().find(|(other, parameter)| {
        let is_given = settings.iter().any(|setting| setting.index == *other);
        *other != index && !is_given && parameter.default.is_none() && parameter.unit != "m/s"
    });
    if let Some((_, parameter)) = missing {
        let message = format!("{} needs a value of {}", family.name(), parameter.key);
        return Err(Failure::bad_input(message)
            .with_help(format!("give it, --param {}=VALUE", parameter.key)));
    }
    let at_speed = [fem_fit::Point::new(speed, arguments.restitution)];
    let problem = Problem::new(&model, &at_speed, &[]).map_err(from_fit_error)?;
    let mut values = problem.values;
    for setting in settings {
        values[setting.index] = setting.value;
    }
    let inversion = invert(&model, index, &values, speed, arguments.restitution);
    let inversion = inversion.map_err(|error| match error {
        FitError::NoSolution { .. } if family == Family::HuntCrossley => {
            Failure::bad_input(error.to_string())
                .with_help("its coefficient holds for mild losses only; take another law")
        }
        error => from_fit_error(error),
    })?;
    Ok(Solved { model, index, values, inversion })
}

/// A line a solution, and one for each other rate of a body.
fn lines(solved: &Solved, speed: f64) -> Vec<[String; 5]> {
    let Solved { model, index, inversion, .. } = solved;
    let family = model.family();
    let parameter = &family.parameters()[*index];
    let line = |value: &f64| {
        let mut values = solved.values.clone();
        values[*index] = *value;
        let time = model.outcome(&values, speed).ok().and_then(|outcome| outcome.contact_time);
        [
            family.name().to_string(),
            parameter.key.to_string(),
            show_value(*value, parameter.unit),
            format!("{value:.6e}"),
            time.map_or("-".to_string(), |time| show(time, "s")),
        ]
    };
    inversion.solutions.iter().map(line).collect()
}
