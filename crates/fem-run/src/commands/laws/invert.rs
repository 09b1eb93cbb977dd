//! `fem-run invert CASE --restitution 0.92`: the parameter of a law that gives a restitution.

use fem::fit::cradle::Measured;
use fem::fit::{FitError, InputPart};
use fem::laws::{FrictionFit, LawFault, LawInversion, family_of, needs_more, strength_words};
use fem::measured::Rebounds;
use fem_case::Case;
use fem_case::engineering::{number, show};
use fem_laws::LawFamily;
use serde_json::{Value, json};

use super::fit_text::{relative, with_error};
use super::friction::{self, ReboundArguments};
use crate::arguments::case::CaseArguments;
use crate::arguments::law::{
    LawArguments, find_key, parse_family, parse_measured_share, parse_speed,
};
use crate::text::standard_output;
use crate::text::{Failure, headed, show_value};

/// Find the parameter of a law, or friction, that gives a rebound
///
/// The case gives the two bodies and the speed. For the law `ting` the parameter is the decay rate of the
/// bodies' relaxation. Without --law, the case's law is used, or else all laws that need only one
/// parameter, mean_pressure first if a body has a yield strength.
#[derive(clap::Args, Debug)]
pub struct Arguments {
    #[command(flatten)]
    input: CaseArguments,
    /// The restitution, between 0 and 1, or in %; with its standard uncertainty, '0.92 ± 0.01', the
    /// parameter has one too
    ///
    /// Beside a rebound with friction it is the restitution along the axis, in place of the computed one.
    #[arg(long, value_name = "E", allow_negative_numbers = true, value_parser = parse_measured_share)]
    restitution: Option<Measured>,
    #[command(flatten)]
    rebound: ReboundArguments,
    /// The law [default: that of the case's model, or else all]
    #[arg(long, value_name = "LAW", value_parser = parse_family)]
    law: Option<LawFamily>,
    /// The parameter to find [default: the damping parameter]
    #[arg(long, value_name = "KEY")]
    find: Option<String>,
    #[command(flatten)]
    values: LawArguments,
    /// The approach speed [default: that of the case]
    #[arg(long, value_name = "SPEED", value_parser = parse_speed)]
    speed: Option<f64>,
    /// Print nothing but errors and warnings
    #[arg(long, short)]
    quiet: bool,
}

/// A law, and its parameter or the reason why none gives the restitution.
type Answer = (LawFamily, Result<LawInversion, String>);

pub fn execute(arguments: &Arguments) -> Result<(), Failure> {
    let case = arguments.input.load_and_warn()?;
    if let Some(data) = rebound(arguments, &case)? {
        let fit = FrictionFit::of(&case, &data)?;
        standard_output::warn(fit.warnings());
        return if arguments.quiet {
            Ok(())
        } else {
            standard_output::print(&friction::text(&fit))
        };
    }
    let restitution = restitution(arguments)?;
    let (speed, answers) = answers(arguments, &case, restitution)?;
    if arguments.quiet {
        return Ok(());
    }
    let (mut rows, mut parts, mut notes) = (Vec::new(), Vec::new(), String::new());
    for (family, answer) in &answers {
        match answer {
            Ok(solved) => {
                rows.extend(lines(solved));
                let at_reference =
                    |(value, _)| solved.strength_at_reference_rate(case.scene(), value);
                let found = solved.solutions().into_iter().filter_map(at_reference);
                notes.extend(found.map(|it| format!("\n{}\n", strength_words(it))));
                parts.extend(parts_of(solved));
            }
            Err(reason) => {
                let [none, dash] = [String::new(), "-".into()];
                rows.push([family.name().into(), none.clone(), dash, reason.clone(), none]);
            }
        }
    }
    let parts = match parts.is_empty() {
        true => String::new(),
        false => "\n".to_string() + &headed("uncertain input|law|parameter|>change", parts),
    };
    standard_output::print(&format!(
        "restitution {} at {}\n\n{}{parts}{notes}",
        restitution.value,
        show(speed, "m/s"),
        headed("law|parameter|>value|>SI|>contact time", rows)
    ))
}

pub fn numbers(arguments: &Arguments, case: &Case) -> Result<Value, Failure> {
    if let Some(data) = rebound(arguments, case)? {
        return Ok(FrictionFit::of(case, &data)?.numbers(&arguments.input.name()));
    }
    let restitution = restitution(arguments)?;
    let (speed, answers) = answers(arguments, case, restitution)?;
    let mut solutions = Vec::new();
    let mut unsolved = serde_json::Map::new();
    for (family, answer) in answers {
        match answer {
            Ok(solved) => {
                let all = solved.solutions().into_iter().enumerate();
                solutions.extend(all.map(|(k, (value, contact_time))| {
                    let at_reference = solved.strength_at_reference_rate(case.scene(), value);
                    json!({
                        "law": family.name(),
                        "parameter": solved.parameter().key,
                        "value": value,
                        "standard_error": solved.standard_error(k),
                        "inputs": solved.input_numbers(k),
                        "range_by_law": solved.by_law[k],
                        "at_least": solved.at_least(k),
                        "contact_time_s": contact_time,
                        "strength_at_reference_rate_pa": at_reference,
                    })
                }));
            }
            Err(reason) => {
                unsolved.insert(family.name().to_string(), reason.into());
            }
        }
    }
    let wanted = restitution.value;
    Ok(
        json!({ "restitution": wanted, "speed_m_s": speed, "solutions": solutions, "unsolved": unsolved }),
    )
}

/// Returns the rebound that gives the coefficient of friction, if there is one.
fn rebound(arguments: &Arguments, case: &Case) -> Result<Option<Rebounds>, Failure> {
    arguments.rebound.rebound(case, arguments.speed, arguments.restitution)
}

fn restitution(arguments: &Arguments) -> Result<Measured, Failure> {
    arguments.restitution.ok_or_else(|| {
        Failure::bad_input("neither --restitution nor a rebound is given")
            .with_help("write --restitution 0.92, or --rebound-angle '12 deg' for the friction")
    })
}

fn answers(
    arguments: &Arguments,
    case: &Case,
    restitution: Measured,
) -> Result<(f64, Vec<Answer>), Failure> {
    let speed = arguments.speed.unwrap_or_else(|| case.scene().approach_speed());
    let wanted = restitution.value;
    if !(wanted > 0.0 && wanted < 1.0) {
        let message =
            format!("--restitution must be greater than 0 and less than 1, found {wanted}");
        let help = match wanted > 1.2 && wanted < 100.0 {
            true => format!("{wanted} % is --restitution {}", wanted / 100.0),
            false => "it is the relative velocity after over before, such as 0.92".to_string(),
        };
        return Err(Failure::bad_input(message).with_help(help));
    }
    let law = arguments.law.or_else(|| family_of(case.scene()));
    let options =
        [("--param", !arguments.values.param.is_empty()), ("--find", arguments.find.is_some())];
    if let (None, Some((option, _))) = (law, options.iter().find(|(_, is_given)| *is_given)) {
        let message = format!("{option} needs a law");
        return Err(Failure::bad_input(message).with_help("name it with --law"));
    }
    let mut families: Vec<LawFamily> = law.map_or(LawFamily::ALL.to_vec(), |law| vec![law]);
    // The law that follows elements comes first for bodies that yield.
    let yields = case.scene().bodies().iter().any(|body| body.yield_strength().is_some());
    families.sort_by_key(|family| !(yields && *family == LawFamily::MeanPressure));
    let mut answers = Vec::new();
    for family in families {
        match solve(arguments, case, family, (speed, restitution)) {
            Ok(solved) => answers.push((family, Ok(solved))),
            Err(failure) if law.is_some() => return Err(failure),
            // Among all laws, those that need more parameters are left out.
            Err(_) if needs_more(family) => {}
            Err(failure) => {
                let reason = failure.to_string();
                let short = reason.split(':').next().unwrap_or("").to_string();
                answers.push((family, Err(short)));
            }
        }
    }
    if answers.iter().all(|(_, answer)| answer.is_err()) {
        let message = format!("no law gives a restitution of {wanted} at {}", show(speed, "m/s"));
        return Err(Failure::bad_input(message).with_help("name a law with --law to see its range"));
    }
    Ok((speed, answers))
}

fn solve(
    arguments: &Arguments,
    case: &Case,
    family: LawFamily,
    (speed, restitution): (f64, Measured),
) -> Result<LawInversion, Failure> {
    let law = arguments.values.choose(case, family)?;
    if let Some(key) = &arguments.find {
        find_key(family, key, "--find")?;
    }
    let key = arguments.find.as_deref();
    let solved = LawInversion::of(&law, key, speed, restitution.value);
    let solved = solved.map_err(|fault| match fault {
        LawFault::Fit(error @ FitError::NoSolution { .. }) if family == LawFamily::HuntCrossley => {
            Failure::bad_input(error.to_string())
                .with_help("its coefficient holds for small losses only; choose another law")
        }
        LawFault::Fit(error @ FitError::NoSolution { wanted, most, .. })
            if wanted > most && law.model().plate().is_some() =>
        {
            let help = "waves in the plate take the rest: check thickness, speed and support";
            Failure::bad_input(error.to_string()).with_help(help)
        }
        fault => fault.into(),
    });
    Ok(solved?.with_inputs(case, &law, restitution, arguments.speed))
}

fn lines(solved: &LawInversion) -> Vec<[String; 5]> {
    let parameter = solved.parameter();
    let line = |(k, (value, time)): (usize, (f64, Option<f64>))| {
        let shown = match (solved.at_least(k), solved.standard_error(k)) {
            (Some(least), _) => format!("≥ {}", show_value(least, parameter.unit)),
            (None, error @ Some(_)) => with_error(value, error, parameter.unit),
            (None, None) if solved.error_by_law(k).is_infinite() => {
                format!("{} ± ?", show_value(value, parameter.unit))
            }
            (None, None) => show_value(value, parameter.unit),
        };
        [
            solved.model.family().name().to_string(),
            parameter.key.to_string(),
            shown,
            number(value, 7),
            time.map_or("-".to_string(), |time| show(time, "s")),
        ]
    };
    solved.solutions().into_iter().enumerate().map(line).collect()
}

/// Returns the part of each uncertain input, and that of the law, in the error of each value.
fn parts_of(solved: &LawInversion) -> Vec<[String; 4]> {
    let parameter = solved.parameter();
    let shown = |change: &f64| match change.abs() {
        change if change.is_finite() => show_value(change, parameter.unit),
        _ => "no solution".to_string(),
    };
    let row = |by: String, changes: Vec<String>| {
        let law = solved.model.family().name().to_string();
        [by, law, parameter.key.to_string(), changes.join(", ")]
    };
    let by_input =
        |part: &InputPart| row(relative(&part.input), part.changes.iter().map(shown).collect());
    let dents = solved.by_law.iter().any(|(low, high)| low != high);
    let ends = |(low, high): &(f64, f64)| match high.is_finite() {
        true => {
            format!("{} to {}", show_value(*low, parameter.unit), show_value(*high, parameter.unit))
        }
        false if *low == 0.0 => "not known".to_string(),
        false => "any stronger body does not flow".to_string(),
    };
    let by_law =
        dents.then(|| row("the law itself".to_string(), solved.by_law.iter().map(ends).collect()));
    solved.inputs.iter().map(by_input).chain(by_law).collect()
}
