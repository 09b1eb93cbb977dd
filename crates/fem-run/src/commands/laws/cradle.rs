//! `fem-run cradle`: velocities and restitution from the angles of a Newton's cradle.

use std::path::PathBuf;

use comfy_table::CellAlignment::Left;
use fem::fit::cradle::{Cradle, Measured, STANDARD_GRAVITY, Swing, Trial, masses_of_balls};
use fem::measured::{Kind, Table, cradle_trials};
use fem_report::law_figures::cradle_figure;
use serde_json::{Value, json};

use crate::{
    arguments::{
        case::stem_of,
        data::{ColumnArguments, of_kind},
    },
    result_folder::command_output::OutputArguments,
    text::{Failure, headed, show_measured, standard_output, table},
};

/// Compute the restitution from the angles of a Newton's cradle
///
/// The first ball is released at the angle alpha and strikes the second, at rest, which rises to beta. A
/// single trial is printed; a CSV file of trials also gives a table, cradle.csv, which fit reads, and a
/// plot. Uncertainties (`30 deg ± 0.5 deg`) are standard uncertainties, independent, propagated in first
/// order.
#[derive(clap::Args, Debug)]
pub struct Arguments {
    /// Distance from the pivot to a ball's centre, such as '20 cm ± 1 mm'
    #[arg(long, value_name = "LENGTH", value_parser = of_kind(Kind::Length))]
    length: Measured,
    /// Diameters of the first and the second ball, of the same material: '22.2 mm,15.9 mm'
    #[arg(long, value_name = "D1,D2", value_delimiter = ',', num_args = 1..=2,
        value_parser = of_kind(Kind::Length), conflicts_with = "masses")]
    diameters: Vec<Measured>,
    /// Masses of the first and the second ball: '13.7 g ± 0.1 g,5.03 g'
    #[arg(long, value_name = "M1,M2", value_delimiter = ',', num_args = 1..=2,
        value_parser = of_kind(Kind::Mass), required_unless_present = "diameters")]
    masses: Vec<Measured>,
    /// Angle from which the first ball is released: '20 deg ± 0.2 deg'
    #[arg(long, value_name = "ANGLE", value_parser = of_kind(Kind::Angle), required_unless_present = "data",
        conflicts_with = "data")]
    alpha: Option<Measured>,
    /// Angle to which the second ball rises
    #[arg(long, value_name = "ANGLE", value_parser = of_kind(Kind::Angle), required_unless_present = "data",
        conflicts_with = "data")]
    beta: Option<Measured>,
    /// Trials: a CSV file with the columns alpha_deg and beta_deg (or _rad), optionally
    /// alpha_uncertainty_deg and beta_uncertainty_deg
    #[arg(long, value_name = "FILE")]
    data: Option<PathBuf>,
    #[command(flatten)]
    columns: ColumnArguments,
    /// Uncertainty of angles without one
    #[arg(long, value_name = "ANGLE", value_parser = of_kind(Kind::Angle))]
    angle_uncertainty: Option<Measured>,
    /// Acceleration of free fall [default: 9.80665 m/s^2]
    #[arg(long, value_name = "G", value_parser = of_kind(Kind::Acceleration))]
    gravity: Option<Measured>,
    #[command(flatten)]
    output: OutputArguments,
}

pub fn execute(arguments: &Arguments) -> Result<(), Failure> {
    let cradle = cradle(arguments)?;
    let Some(path) = &arguments.data else {
        let (trial, swing) = single(&cradle, arguments)?;
        if arguments.output.quiet {
            return Ok(());
        }
        return standard_output::print(&one(&cradle, &trial, &swing));
    };
    let swings = swings(&cradle, &arguments.columns.read(path)?, arguments)?;
    let origin = arguments.columns.origin("cradle", None, Some(path));
    let mut output = arguments.output.claim(&stem_of(path), "cradle", origin)?;
    let header = [
        "speed_m_s",
        "restitution",
        "restitution_uncertainty",
        "speed_uncertainty_m_s",
        "first_after_m_s",
        "second_after_m_s",
        "alpha_rad",
        "beta_rad",
    ];
    let has_uncertainty = swings.iter().all(|(_, swing)| swing.restitution.uncertainty > 0.0);
    let rows = swings.iter().map(|(trial, swing)| {
        vec![
            Some(swing.before.value),
            Some(swing.restitution.value),
            has_uncertainty.then_some(swing.restitution.uncertainty),
            has_uncertainty.then_some(swing.before.uncertainty),
            Some(swing.first_after.value),
            Some(swing.second_after.value),
            Some(trial.release.value),
            Some(trial.rise.value),
        ]
    });
    output.write_table("cradle.csv", &header, rows);
    output.write("cradle.svg", cradle_figure(&swings));
    let [first, second] = cradle.masses;
    let numbers = json!({
        "data": path.display().to_string(),
        "trials": swings.len(),
        "length_m": cradle.length.value,
        "mass_ratio": second.value / first.value,
        "gravity_m_s2": cradle.gravity.value,
    });
    output.publish(&numbers, |_| many(&cradle, &swings))
}

/// Returns speed before, restitution and velocities after with their uncertainties, of one trial or of each
/// trial of a table.
pub fn numbers(arguments: &Arguments, table: Option<&Table>) -> Result<Value, Failure> {
    let cradle = cradle(arguments)?;
    let of = |(trial, swing): &(Trial, Swing)| {
        json!({
            "alpha_rad": trial.release.value,
            "beta_rad": trial.rise.value,
            "speed_m_s": swing.before.value,
            "speed_uncertainty_m_s": swing.before.uncertainty,
            "restitution": swing.restitution.value,
            "restitution_uncertainty": swing.restitution.uncertainty,
            "first_after_m_s": swing.first_after.value,
            "second_after_m_s": swing.second_after.value,
        })
    };
    match table {
        Some(table) => Ok(swings(&cradle, table, arguments)?.iter().map(of).collect()),
        None => Ok(of(&single(&cradle, arguments)?)),
    }
}

fn single(cradle: &Cradle, arguments: &Arguments) -> Result<(Trial, Swing), Failure> {
    // clap requires both angles if there is no file.
    let (Some(alpha), Some(beta)) = (arguments.alpha, arguments.beta) else {
        return Err(Failure::bad_input("--alpha and --beta are missing"));
    };
    let [release, rise] = [alpha, beta].map(|angle| with_default(angle, arguments));
    let trial = Trial { release, rise };
    let swing = cradle.swing(&trial)?;
    Ok((trial, swing))
}

fn cradle(arguments: &Arguments) -> Result<Cradle, Failure> {
    let pair = |values: &[Measured], option: &str| match values {
        [first, second] => Ok([*first, *second]),
        _ => Err(Failure::bad_input(format!("{option} needs two values, one per ball"))
            .with_help(format!("write {option} A,B"))),
    };
    let masses = if arguments.diameters.is_empty() {
        pair(&arguments.masses, "--masses")?
    } else {
        masses_of_balls(pair(&arguments.diameters, "--diameters")?)
    };
    let gravity = arguments.gravity.unwrap_or(Measured::exact(STANDARD_GRAVITY));
    Ok(Cradle { gravity, length: arguments.length, masses })
}

fn with_default(angle: Measured, arguments: &Arguments) -> Measured {
    match arguments.angle_uncertainty {
        Some(Measured { value, .. }) if angle.uncertainty == 0.0 => {
            Measured { uncertainty: value, ..angle }
        }
        _ => angle,
    }
}

fn swings(
    cradle: &Cradle,
    table: &Table,
    arguments: &Arguments,
) -> Result<Vec<(Trial, Swing)>, Failure> {
    let trials = cradle_trials(table)?.into_iter().enumerate().map(|(row, trial)| {
        let [release, rise] =
            [trial.release, trial.rise].map(|angle| with_default(angle, arguments));
        let trial = Trial { release, rise };
        let swing = cradle.swing(&trial).map_err(|error| table.fault(row, error))?;
        Ok((trial, swing))
    });
    trials.collect()
}

fn one(cradle: &Cradle, trial: &Trial, swing: &Swing) -> String {
    let rows = [
        ["u", "first ball before", &show_measured(swing.before, "m/s")].map(String::from),
        ["v1", "first ball after", &show_measured(swing.first_after, "m/s")].map(String::from),
        ["v2", "second ball after", &show_measured(swing.second_after, "m/s")].map(String::from),
        ["e", "restitution", &show_measured(swing.restitution, "")].map(String::from),
    ];
    let mut text = table(&[Left, Left, Left], rows);
    if swing.restitution.uncertainty > 0.0 {
        let names = ["alpha", "beta", "the first mass", "the second mass"];
        let shares = names.iter().zip(swing.shares).filter(|(_, share)| *share >= 0.005);
        let shares: Vec<_> =
            shares.map(|(name, share)| format!("{name} ({:.0} %)", 100.0 * share)).collect();
        let shares = shares.join(", ");
        text += &format!("\nFirst-order uncertainty; the variance of e comes from {shares}.\n");
    }
    if let Some(doubt) = cradle.doubt(trial, swing) {
        text += &format!("warning: {doubt}\n");
    }
    text
}

fn many(cradle: &Cradle, swings: &[(Trial, Swing)]) -> String {
    let rows = swings.iter().map(|(trial, swing)| {
        [
            format!("{:.2} deg", trial.release.value.to_degrees()),
            format!("{:.2} deg", trial.rise.value.to_degrees()),
            show_measured(swing.before, "m/s"),
            show_measured(swing.first_after, "m/s"),
            show_measured(swing.second_after, "m/s"),
            show_measured(swing.restitution, ""),
        ]
    });
    let mut text = headed(">alpha|>beta|>u|>v1|>v2|>restitution", rows);
    for (trial, swing) in swings {
        if let Some(doubt) = cradle.doubt(trial, swing) {
            let alpha = trial.release.value.to_degrees();
            text += &format!("warning: alpha = {alpha:.2} deg: {doubt}\n");
        }
    }
    text
}
