//! The kinds of records, and the names of their columns.

use crate::table::{DROP_HEIGHTS, DataError, RESTITUTIONS, Table, is_numbered};

/// The kinds of records.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum RecordKind {
    /// The instants at which a bouncing ball touches the plate.
    Bounces,
    /// The height of a ball over time.
    Track,
    /// The force of impacts over time.
    Force,
    /// A sound or another trace in which bounces are onsets.
    Sound,
}

impl RecordKind {
    /// All kinds of records, in the order of the documentation.
    pub const ALL: [Self; 4] = [Self::Bounces, Self::Track, Self::Force, Self::Sound];

    /// Returns the name of the kind: `bounces`.
    pub fn name(self) -> &'static str {
        match self {
            Self::Bounces => "bounces",
            Self::Track => "track",
            Self::Force => "force",
            Self::Sound => "sound",
        }
    }

    /// Returns the columns of the kind.
    fn columns(self) -> &'static str {
        match self {
            Self::Bounces => "time_s",
            Self::Track => "time_s, y_m",
            Self::Force => "time_s, force_n",
            Self::Sound => "a WAV file, or time_s, signal",
        }
    }

    /// Recognises the kind of a record by its columns.
    ///
    /// # Errors
    /// The columns are those of no kind.
    pub(super) fn of(columns: &Table) -> Result<Self, DataError> {
        let has = |names: &[&str]| columns.find(names).map(|found| found.is_some());
        let drops = columns.header().iter().any(|name| is_numbered(name, &NUMBERED));
        if !has(&TIMES)? && (has(&EVENTS)? || has(&INTERVALS)? || drops) {
            return Ok(Self::Bounces);
        }
        let is_timed = has(&TIMES)? || has(&FRAMES)?;
        if is_timed {
            let second =
                [(&FORCES[..], Self::Force), (&HEIGHTS, Self::Track), (&SIGNALS, Self::Sound)];
            for (names, kind) in second {
                if has(names)? {
                    return Ok(kind);
                }
            }
            return Ok(Self::Bounces);
        }
        let found = columns.header().join(", ");
        let kinds = Self::ALL.map(|kind| format!("{} ({})", kind.name(), kind.columns()));
        let message = format!("the columns {found} are those of no record");
        let help = match has(&RESTITUTIONS)? || has(DROP_HEIGHTS[0])? {
            true => format!(
                "these are restitutions already: fem-run fit CASE.toml --data {}",
                columns.name()
            ),
            false => format!(
                "a record is one of {}; name the columns so, or say which they are, --columns time=COLUMN",
                kinds.join(", ")
            ),
        };
        Err(columns.header_fault(message).with_help(help))
    }
}

/// Names of a column of instants.
pub(super) const TIMES: [&str; 14] = [
    "time",
    "t",
    "instant",
    "bounce_time",
    "impact_time",
    "event_time",
    "elapsed_time",
    "timestamp",
    "time_stamp",
    "second",
    "seconds",
    "s",
    "x_value",
    "x-axis",
];
/// Names of a column of instants, or of the numbers of bounces.
pub(super) const EVENTS: [&str; 2] = ["bounce", "impact"];
/// Names of a column of flight times, or of the numbers of flights.
pub(super) const INTERVALS: [&str; 9] = [
    "interval",
    "interval_#",
    "interval_number",
    "flight",
    "flight_#",
    "flight_number",
    "flight_time",
    "time_of_flight",
    "duration",
];
/// Names of columns with a number each: the instants of a drop in a row, or drops side by side.
pub(super) const NUMBERED: [&str; 10] =
    ["start", "stop", "lap", "tap", "bounce", "impact", "t", "drop", "trial", "run"];
/// Those whose columns are drops.
pub(super) const DROPS: [&str; 3] = ["drop", "trial", "run"];

/// Names of a column of the uncertainties of instants.
pub(super) const TIME_UNCERTAINTIES: [&str; 3] = ["time_uncertainty", "t_uncertainty", "u(t)"];
/// Names of a column of the numbers of frames.
pub(super) const FRAMES: [&str; 6] =
    ["frame", "frames", "frame_number", "frame_#", "image", "slice"];
/// Names of a column of heights.
pub(super) const HEIGHTS: [&str; 6] = ["height", "y", "position", "h", "z", "position_y"];
/// Names of a column of the uncertainties of heights.
pub(super) const HEIGHT_UNCERTAINTIES: [&str; 4] =
    ["height_uncertainty", "y_uncertainty", "u(y)", "position_uncertainty"];
/// Names of a column of forces.
pub(super) const FORCES: [&str; 3] = ["force", "f", "load"];
/// Names of a column of amplitudes.
pub(super) const SIGNALS: [&str; 27] = [
    "signal",
    "amplitude",
    "voltage",
    "sound",
    "level",
    "pressure",
    "acceleration",
    "sample",
    "volt",
    "volts",
    "value",
    "ch1",
    "ch2",
    "ch3",
    "ch4",
    "channel_1",
    "channel_2",
    "channel_3",
    "channel_4",
    "channel_a",
    "channel_b",
    "channel_c",
    "channel_d",
    "1",
    "2",
    "3",
    "4",
];
