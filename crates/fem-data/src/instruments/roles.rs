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

    /// Returns the name of the kind, `bounces`.
    pub fn name(self) -> &'static str {
        self.row()[0]
    }

    /// Returns the name of the kind, and its columns.
    fn row(self) -> [&'static str; 2] {
        match self {
            Self::Bounces => ["bounces", "time_s"],
            Self::Track => ["track", "time_s, y_m"],
            Self::Force => ["force", "time_s, force_n"],
            Self::Sound => ["sound", "a WAV file, or time_s, signal"],
        }
    }

    /// Recognises the kind of a record by its columns.
    ///
    /// # Errors
    /// The columns are those of no kind.
    pub(super) fn of(columns: &Table) -> Result<Self, DataError> {
        let has = |names: &str| columns.find(names).map(|found| found.is_some());
        let is_timed = has(TIMES)?;
        let is_drop = |name: &String| is_numbered(name, NUMBERED);
        if !is_timed && (has(EVENTS)? || has(INTERVALS)? || columns.header().iter().any(is_drop)) {
            return Ok(Self::Bounces);
        }
        if is_timed || has(FRAMES)? {
            for (names, kind) in
                [(FORCES, Self::Force), (HEIGHTS, Self::Track), (SIGNALS, Self::Sound)]
            {
                if has(names)? {
                    return Ok(kind);
                }
            }
            return Ok(Self::Bounces);
        }
        let found = columns.header().join(", ");
        let message = format!("the columns {found} are those of no record");
        let help = match has(RESTITUTIONS)? || has(DROP_HEIGHTS[0])? {
            true => format!(
                "these are restitutions already: fem-run fit CASE.toml --data {}",
                columns.name()
            ),
            false => format!(
                "a record is one of {}; name the columns so, or say which they are, --columns time=COLUMN",
                Self::ALL
                    .map(Self::row)
                    .map(|[name, columns]| format!("{name} ({columns})"))
                    .join(", ")
            ),
        };
        Err(columns.header_fault(message).with_help(help))
    }
}

/// Names of a column of instants.
pub(super) const TIMES: &str = "time t instant bounce_time impact_time event_time elapsed_time timestamp time_stamp second \
    seconds s x_value x-axis";
/// Names of a column of instants, or of the numbers of bounces.
pub(super) const EVENTS: &str = "bounce impact";
/// Names of a column of flight times, or of the numbers of flights.
pub(super) const INTERVALS: &str = "interval interval_# interval_number flight flight_# flight_number flight_time \
    time_of_flight duration";
/// Names of columns with a number each: the instants of a drop in a row, or drops side by side.
pub(super) const NUMBERED: &str = "start stop lap tap bounce impact t drop trial run";
/// Those whose columns are drops.
pub(super) const DROPS: &str = "drop trial run";
/// Names of a column of the uncertainties of instants.
pub(super) const TIME_UNCERTAINTIES: &str = "time_uncertainty t_uncertainty u(t)";
/// Names of a column of the numbers of frames.
pub(super) const FRAMES: &str = "frame frames frame_number frame_# image slice";
/// Names of a column of heights.
pub(super) const HEIGHTS: &str = "height y position h z position_y";
/// Names of a column of the uncertainties of heights.
pub(super) const HEIGHT_UNCERTAINTIES: &str =
    "height_uncertainty y_uncertainty u(y) position_uncertainty";
/// Names of a column of forces.
pub(super) const FORCES: &str = "force f load";
/// Names of a column of amplitudes.
pub(super) const SIGNALS: &str = "signal amplitude voltage sound level pressure acceleration sample volt volts value ch1 ch2 \
    ch3 ch4 channel_1 channel_2 channel_3 channel_4 channel_a channel_b channel_c channel_d 1 2 3 4";
