//! `fem-run invert CASE --restitution 0.92`: the parameter of a law that gives it.

use comfy_table::CellAlignment::{Left, Right};
use fem_case::Case;
use fem_fit::{FitError, Inversion, Model, Problem, invert};
use fem_laws::{Family, Role};

use crate::case_arguments::CaseArguments;
use crate::engineering::show;
use crate::failure::Failure;
use crate::reduced::{
    LawArguments, family_of, find_key, find_loss, from_fit_error, parse_family, parse_speed,
    show_value,
};
use crate::standard_output;
use crate::tables::table;

/// Find the parameter of a law that gives a wanted restitution at one speed
///
/// The case gives the two bodies and the speed. For the law `ting` it is the decay rate of the
/// bodies' relaxation. Without --law, the law of the case's model, or else all laws that need no
/// more than one number.
#[derive(clap::Args, Debug)]
pub struct Arguments {
    #[command(flatten)]
    input: CaseArguments,
    /// The restitution that is wanted, between 0 and 1
    #[arg(long, value_name = "E")]
    restitution: f64,
    /// The law [default: that of the case's model, or else all]
    #[arg(long, value_name = "LAW", value_parser = parse_family)]
    law: Option<Family>,
    /// The parameter to find [default: the one that damps]
    #[arg(long, value_name = "KEY")]
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
    let speed = arguments.speed.unwrap_or_else(|| case.scene.approach_speed());
    let wanted = arguments.restitution;
    if !(wanted > 0.0 && wanted < 1.0) {
        let message = format!("--restitution {wanted}: it must be greater than 0 and less than 1");
        return Err(Failure::bad_input(message));
    }
    let mut rows = vec![["law", "parameter", "value", "SI", "contact time"].map(String::from)];
    let law = arguments.law.or_else(|| family_of(&case));
    let options =
        [("--param", !arguments.values.param.is_empty()), ("--find", arguments.find.is_some())];
    if let (None, Some((option, _))) = (law, options.iter().find(|(_, is_given)| *is_given)) {
        let message = format!("{option}: of which law?");
        return Err(Failure::bad_input(message).with_help("name it with --law"));
    }
    let families: Vec<Family> = law.map_or(Family::ALL.to_vec(), |law| vec![law]);
    let mut is_found = false;
    for family in families {
        match solve(arguments, &case, family, speed) {
            Ok(solved) => {
                is_found = true;
                rows.extend(lines(&solved, speed));
            }
            Err(failure) if law.is_some() => return Err(failure),
            // Of all laws, those that cannot are told so in the table.
            Err(_) if needs_more(family) => {}
            Err(failure) => {
                let reason = failure.to_string();
                let short = reason.split(':').next().unwrap_or("").to_string();
                rows.push([family.name().into(), String::new(), "-".into(), short, String::new()]);
            }
        }
    }
    if !is_found {
        let message = format!("no law gives a restitution of {wanted} at {}", show(speed, "m/s"));
        return Err(
            Failure::bad_input(message).with_help("ask for one law, --law, to see its reach")
        );
    }
    if arguments.quiet {
        return Ok(());
    }
    standard_output::print(&format!(
        "restitution {wanted} at {}\n\n{}",
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
    let mut others =
        family.parameters().iter().enumerate().filter(|(index, _)| Some(*index) != loss);
    loss.is_none()
        || others.any(|(_, parameter)| parameter.default.is_none() && parameter.role != Role::Speed)
}

fn solve(
    arguments: &Arguments,
    case: &Case,
    family: Family,
    speed: f64,
) -> Result<Solved, Failure> {
    let chosen = arguments.values.choose(case, family)?;
    let index = match &arguments.find {
        Some(key) => find_key(family, key, "--find")?,
        None => find_loss(family)?,
    };
    // A speed is that of the collision.
    let is_known = |other: usize| other == index || family.parameters()[other].role == Role::Speed;
    if let Some(key) = chosen.missing(is_known) {
        let message = format!("{} needs a value of {key}", family.name());
        return Err(Failure::bad_input(message).with_help(format!("give it, --param {key}=VALUE")));
    }
    let at_speed = [fem_fit::Point::new(speed, arguments.restitution)];
    let problem = Problem::new(&chosen.model, &at_speed, &[]).map_err(from_fit_error)?;
    let values = chosen.values(&problem.values);
    let model = chosen.model;
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
