//! `fem-run measure FILE`: restitutions over speed from a record as it is measured.

use std::path::PathBuf;

use clap::builder::{PossibleValuesParser, TypedValueParser};
use fem::fit::cradle::Measured;
use fem::measured::Kind;
use fem::records::{
    BounceTimes, ForceRecord, IMPACT_COLUMNS, Impact, Record, RecordKind, Rig,
    TimeUncertaintySource, Track,
};
use fem_case::engineering::{Unit, show};
use fem_report::record_figures::record_figure;
use serde_json::Value;

use crate::arguments::case::stem_of;
use crate::arguments::data::{ColumnArguments, of_kind, read_bytes};
use crate::arguments::law::parse_share;
use crate::result_folder::command_output::OutputArguments;
use crate::result_folder::whole_file::OwnedFileKind;
use crate::text::{Failure, hanging, headed, show_measured, shown, standard_output};

/// The table of impacts, of which `--out` may ask for a copy.
const TABLE: OwnedFileKind = OwnedFileKind {
    what: "table",
    extension: "csv",
    marker: "speed_m_s,restitution,restitution_uncertainty,speed_uncertainty_m_s,time_s",
    option: "--out",
};

/// Turn a record of a bouncing ball into restitutions over speed
///
/// The record is a CSV file of the instants at which the ball touches the plate, of its height over time, or of the force of
/// impacts over time; or it is a sound (WAV). Writes measure.csv, which fit and
/// calibrate read, measure.json and measure.svg, and prints the table. Values may carry a standard uncertainty: '20 cm ± 1 mm'.
#[derive(clap::Args, Debug)]
pub struct Arguments {
    /// The record: a CSV file with the columns time_s (the instants of bounces); time_s and y_m; or time_s and force_n;
    /// or a WAV file
    #[arg(value_name = "FILE")]
    file: PathBuf,
    /// The kind of record [default: by its columns]
    #[arg(long, value_name = "KIND", value_parser = kinds())]
    kind: Option<RecordKind>,
    #[command(flatten)]
    columns: ColumnArguments,
    #[command(flatten)]
    rig: RigArguments,
    #[command(flatten)]
    output: OutputArguments,
}

/// Options for the rig, which the record does not show.
#[derive(clap::Args, Debug)]
struct RigArguments {
    /// Acceleration of free fall [default: 9.80665 m/s^2]
    #[arg(long, value_name = "G", value_parser = of_kind(Kind::Acceleration))]
    gravity: Option<Measured>,
    /// Height of the drop, from the ball's lowest point to the plate; it gives the speed of the first impact
    #[arg(long, value_name = "LENGTH", value_parser = of_kind(Kind::Length))]
    height: Option<Measured>,
    /// Diameter of the ball; with the density it gives the air drag, which is neglected otherwise
    #[arg(long, value_name = "LENGTH", value_parser = of_kind(Kind::Length))]
    diameter: Option<Measured>,
    /// Density of the ball
    #[arg(long, value_name = "DENSITY", value_parser = of_kind(Kind::Density))]
    density: Option<Measured>,
    /// Contact time of a bounce, by which flights are shorter than the time between two bounces [default: 0]
    #[arg(long, value_name = "TIME", value_parser = of_kind(Kind::Time))]
    contact_time: Option<Measured>,
    /// Standard uncertainty of an instant [default: by the scatter of the flights]
    #[arg(long, value_name = "TIME", value_parser = of_kind(Kind::Time))]
    time_uncertainty: Option<Measured>,
    /// Instant at which the ball comes to rest, a check of the bounces
    #[arg(long, value_name = "TIME", value_parser = of_kind(Kind::Time))]
    rest: Option<Measured>,
    /// Mass of the moving body, for a record of the force
    #[arg(long, value_name = "MASS", value_parser = of_kind(Kind::Mass))]
    mass: Option<Measured>,
    /// Mass between the force sensor and the contact if the moving body carries the sensor
    #[arg(long, value_name = "MASS", value_parser = of_kind(Kind::Mass))]
    sensor_mass: Option<Measured>,
    /// Approach speed of the first impact, for a record of the force; --height of a drop gives it too
    #[arg(long, value_name = "SPEED", value_parser = of_kind(Kind::Speed))]
    speed: Option<Measured>,
    /// Frames per second of a track with a column of frames
    #[arg(long, value_name = "RATE", value_parser = of_kind(Kind::Rate))]
    frame_rate: Option<Measured>,
    /// Length of a pixel of a track in pixels [default: by gravity]
    #[arg(long, value_name = "LENGTH", value_parser = of_kind(Kind::Length))]
    scale: Option<Measured>,
    /// Relative standard uncertainty of the calibration of the force, such as '1 %'
    #[arg(long, value_name = "SHARE", value_parser = parse_share)]
    force_uncertainty: Option<f64>,
}

fn kinds() -> impl TypedValueParser<Value = RecordKind> {
    let kind = |name: String| RecordKind::ALL.into_iter().find(|kind| kind.name() == name);
    PossibleValuesParser::new(RecordKind::ALL.map(RecordKind::name))
        .try_map(move |name| kind(name).ok_or("this is no kind of record"))
}

impl RigArguments {
    fn rig(&self) -> Rig {
        Rig {
            gravity: self.gravity,
            drop_height: self.height,
            diameter: self.diameter,
            density: self.density,
            contact_time: self.contact_time,
            time_uncertainty: self.time_uncertainty.map(|given| given.value),
            rest: self.rest,
            mass: self.mass,
            sensor_mass: self.sensor_mass,
            speed: self.speed,
            frame_rate: self.frame_rate,
            scale: self.scale,
            force_uncertainty: self.force_uncertainty,
        }
    }
}

impl Arguments {
    fn read(&self, bytes: &[u8]) -> Result<Record, Failure> {
        let (name, names) = (self.file.display().to_string(), self.columns.names()?);
        Ok(Record::read(&name, bytes, self.kind, &names, &self.rig.rig())?)
    }
}

pub fn execute(arguments: &Arguments) -> Result<(), Failure> {
    let (path, rig) = (&arguments.file, arguments.rig.rig());
    let record = arguments.read(&read_bytes(path)?)?;
    let origin = arguments.columns.origin("measure", None, Some(path));
    let stem = stem_of(path);
    let mut output = arguments.output.claim_with_copy(&stem, "measure", origin, TABLE)?;
    let rows = record.impacts().iter().map(Impact::row);
    output.write_table("measure.csv", &IMPACT_COLUMNS, rows);
    output.write("measure.svg", record_figure(&record, &rig));
    standard_output::warn(record.warnings().iter().cloned());
    let numbers = record.numbers(&path.display().to_string(), &rig);
    output.publish(&numbers, |kept| {
        let next = kept.path("measure.csv").map_or(String::new(), |table| {
            format!("\nFit a law to it:\n    fem-run fit CASE.toml --data {}\n", shown(&table))
        });
        answer(&record) + &impacts_table(record.impacts()) + &details(&record, &rig) + &next
    })
}

/// Measures a record in memory and returns the numbers with the picture.
pub fn numbers(arguments: &Arguments, bytes: &[u8]) -> Result<Value, Failure> {
    let (record, rig) = (arguments.read(bytes)?, arguments.rig.rig());
    let mut numbers = record.numbers(&arguments.file.display().to_string(), &rig);
    numbers["svg"] = record_figure(&record, &rig).into();
    Ok(numbers)
}

/// Returns the first line: how many restitutions, and their range.
fn answer(record: &Record) -> String {
    let impacts = record.impacts();
    let fastest = impacts.iter().max_by(|a, b| a.speed.value.total_cmp(&b.speed.value));
    let slowest = impacts.iter().min_by(|a, b| a.speed.value.total_cmp(&b.speed.value));
    let of = |impact: &Impact| {
        let e = show_measured(impact.restitution, "");
        let speed = impact.speed.value;
        format!("{e} at {}", Unit::fitting(speed, "m/s").with_digits(3).show(speed))
    };
    match (fastest, slowest) {
        (Some(one), _) if impacts.len() == 1 => format!("restitution {}\n\n", of(one)),
        (Some(fastest), Some(slowest)) => {
            let n = impacts.len();
            hanging(&format!("{n} restitutions: {} to {}\n\n", of(fastest), of(slowest)))
        }
        _ => String::new(),
    }
}

/// Returns the table of impacts; of a long one its first rows and its last.
fn impacts_table(impacts: &[Impact]) -> String {
    const SHOWN: usize = 16;
    let row = |impact: &Impact| {
        [
            show(impact.time, "s"),
            show_measured(impact.speed, "m/s"),
            show_measured(impact.restitution, ""),
        ]
    };
    let mut rows: Vec<[String; 3]> = impacts.iter().map(row).collect();
    if rows.len() > SHOWN {
        let n_hidden = rows.len() - SHOWN + 1;
        rows.splice(
            SHOWN - 2..rows.len() - 1,
            [["…".to_string(), format!("{n_hidden} more"), String::new()]],
        );
    }
    headed(">time|>speed|>restitution", rows) + "\n"
}

fn details(record: &Record, rig: &Rig) -> String {
    match record {
        Record::BounceTimes(bounces) => of_bounces(bounces, rig),
        Record::Track(track) => of_track(track, rig),
        Record::Force(force) => of_force(force),
        Record::Sound(sound) => {
            let (n, rate) = (sound.bounces.instants.values.len(), sound.signal.rate);
            format!("{n} bounces in a signal of {rate:.0} samples per second\n")
                + &of_bounces(&sound.bounces, rig)
        }
    }
}

/// The line about air drag of a record without size and density of the ball.
const DRAG_NEGLECTED: &str =
    "air drag neglected: --diameter and --density of the ball include it\n";

fn of_track(track: &Track, rig: &Rig) -> String {
    let gravity = match track.has_fitted_gravity {
        true => format!("fitted g: {}", show_measured(track.gravity, "m/s²")),
        false => format!("g: {:.4} m/s²", track.gravity.value),
    };
    let gravity = match track.pixel.filter(|_| rig.scale.is_none()) {
        Some(Measured { value, uncertainty }) => {
            let pixel = Measured { value: 1e3 * value, uncertainty: 1e3 * uncertainty };
            format!("scale by gravity: {} per pixel", show_measured(pixel, "mm"))
        }
        None => gravity,
    };
    let mut text = format!(
        "{} frames, {} flights; scatter of a frame: {}\n{gravity}\n",
        track.frames.times.len(),
        track.flights.len(),
        two_digits(track.noise, "m")
    );
    if rig.contact_time.is_none() {
        text += "contact time neglected: --contact-time includes it\n";
    }
    if rig.diameter.is_none() {
        text += DRAG_NEGLECTED;
    }
    text
}

fn of_force(force: &ForceRecord) -> String {
    const SHOWN: usize = 16;
    let time = |time: Option<f64>| time.map_or("-".to_string(), |time| show(time, "s"));
    let rows = force.pulses.iter().take(SHOWN).map(|pulse| {
        [
            show(pulse.time_s, "s"),
            show(pulse.peak_force_n, "N") + if pulse.is_clipped { ", clipped" } else { "" },
            time(pulse.contact_time_10_percent_s),
            time(pulse.contact_time_1_percent_s),
            show(pulse.impulse_n_s, "N·s"),
        ]
    });
    let header = ">pulse at|>peak force|>contact time at 10 %|>at 1 %|>impulse";
    let noise = two_digits(force.noise, "N");
    format!("{}\nnoise of a sample: {noise}\n", headed(header, rows))
}

fn two_digits(value: f64, unit: &str) -> String {
    Unit::fitting(value, unit).with_digits(2).show(value)
}

fn of_bounces(bounces: &BounceTimes, rig: &Rig) -> String {
    let source = match bounces.source {
        TimeUncertaintySource::Given => "as given",
        TimeUncertaintySource::Scatter => "by the scatter of the flights",
        TimeUncertaintySource::Digits => "by the last digit",
    };
    let uncertainty = two_digits(bounces.time_uncertainty, "s");
    let mut text = format!("standard uncertainty of an instant: {uncertainty}, {source}\n");
    if rig.contact_time.is_none() {
        text += &match 1e-4 * bounces.contact_time_slope {
            0.0 => "contact time neglected: --contact-time includes it\n".to_string(),
            change => format!(
                "contact time neglected: 100 µs would change the last restitution by {change:.1e}\n"
            ),
        };
    }
    if rig.diameter.is_none() {
        text += DRAG_NEGLECTED;
    }
    if let Some(rest) = bounces.predicted_rest {
        text += &format!(
            "predicted rest: {rest:.3} s, if the ball bounces on as in its last bounces\n"
        );
    }
    if let Some(e) = bounces.restitution_to_rest {
        text += &format!("mean restitution by the time to rest: {}\n", show_measured(e, ""));
    }
    text
}
