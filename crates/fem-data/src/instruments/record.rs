//! A record of any kind, from the bytes of a file to the table of impacts.

use serde_json::{Value, json};

use crate::table::Measured;
use crate::table::{DataError, Table, decode};

use super::bounce_times::{BounceTimes, Instants};
use super::force::{ForceRecord, Samples};
use super::impact::Impact;
use super::rig::Rig;
use super::roles::RecordKind;
use super::sound::{Signal, Sound};
use super::track::{Frames, Track};
use super::wav::{is_wav, read_wav};

/// A measured record and what it says.
#[derive(Clone, Debug, PartialEq)]
pub enum Record {
    /// The instants at which a bouncing ball touches the plate.
    BounceTimes(BounceTimes),
    /// The height of a ball over time.
    Track(Track),
    /// The force of impacts over time.
    Force(ForceRecord),
    /// A sound or another trace.
    Sound(Sound),
}

impl Record {
    /// Reads a record. Without a kind, the columns decide; `names` renames them, as in
    /// [`Table::renamed`](crate::table::Table::renamed).
    ///
    /// # Errors
    /// The record is of no kind, has an error, or does not support a restitution.
    pub fn read(
        name: &str,
        bytes: &[u8],
        kind: Option<RecordKind>,
        names: &[(&str, &str)],
        rig: &Rig,
    ) -> Result<Self, DataError> {
        if is_wav(bytes) {
            if kind.is_some_and(|kind| kind != RecordKind::Sound) {
                let error = DataError::new(name, "a WAV file is a record of the kind sound");
                return Err(error.with_help("leave out --kind"));
            }
            return Sound::of(read_wav(name, bytes)?, rig).map(Self::Sound);
        }
        let text = decode(bytes);
        let columns = Table::of_record(name, &text)?.renamed(names)?;
        let kind = match kind {
            Some(kind) => kind,
            None => RecordKind::of(&columns)?,
        };
        match kind {
            RecordKind::Bounces => {
                BounceTimes::of(Instants::read(&columns)?, rig).map(Self::BounceTimes)
            }
            RecordKind::Track => Track::of(Frames::read(&columns, rig)?, rig).map(Self::Track),
            RecordKind::Sound => Sound::of(Signal::read(&columns)?, rig).map(Self::Sound),
            RecordKind::Force => ForceRecord::of(Samples::read(&columns)?, rig).map(Self::Force),
        }
    }

    /// Returns the kind.
    pub fn kind(&self) -> RecordKind {
        match self {
            Self::BounceTimes(_) => RecordKind::Bounces,
            Self::Track(_) => RecordKind::Track,
            Self::Force(_) => RecordKind::Force,
            Self::Sound(_) => RecordKind::Sound,
        }
    }

    /// Returns the impacts in the order of the record.
    pub fn impacts(&self) -> &[Impact] {
        match self {
            Self::BounceTimes(bounces) => &bounces.impacts,
            Self::Track(track) => &track.impacts,
            Self::Force(force) => &force.impacts,
            Self::Sound(sound) => &sound.bounces.impacts,
        }
    }

    /// Returns what was left out, and what may be wrong.
    pub fn warnings(&self) -> &[String] {
        match self {
            Self::BounceTimes(bounces) => &bounces.warnings,
            Self::Track(track) => &track.warnings,
            Self::Force(force) => &force.warnings,
            Self::Sound(sound) => &sound.bounces.warnings,
        }
    }

    /// Returns the mean of the restitutions. Its uncertainty is that of bounces with their covariances; of other records it is the mean
    /// of the uncertainties, since mass, calibration and g are common to all.
    pub fn restitution(&self) -> Measured {
        let impacts = self.impacts();
        let mean = |of: fn(&Measured) -> f64| {
            impacts.iter().map(|impact| of(&impact.restitution)).sum::<f64>() / impacts.len() as f64
        };
        let bounces = match self {
            Self::BounceTimes(bounces) => bounces.mean_restitution(),
            Self::Sound(sound) => sound.bounces.mean_restitution(),
            Self::Track(_) | Self::Force(_) => None,
        };
        bounces.unwrap_or_else(|| Measured {
            value: mean(|e| e.value),
            uncertainty: mean(|e| e.uncertainty),
        })
    }

    /// Returns the instants of the bounces or pulses that were picked, s.
    pub fn events(&self) -> Vec<f64> {
        match self {
            Self::BounceTimes(bounces) => bounces.instants.values.clone(),
            Self::Sound(sound) => sound.bounces.instants.values.clone(),
            Self::Track(track) => track.impacts.iter().map(|impact| impact.time).collect(),
            Self::Force(force) => force.pulses.iter().map(|pulse| pulse.time_s).collect(),
        }
    }

    /// Returns all numbers for JSON, SI.
    pub fn numbers(&self, name: &str, rig: &Rig) -> Value {
        let velocity = |impact: &Impact| {
            let Impact { time, speed, restitution, .. } = impact;
            let after = restitution.value * speed.value;
            json!({ "time_s": time, "before_m_s": speed.value, "after_m_s": after })
        };
        let restitution = self.restitution();
        let details = match self {
            Self::BounceTimes(bounces) => bounces.numbers(),
            Self::Track(track) => track.numbers(),
            Self::Force(force) => force.numbers(),
            Self::Sound(sound) => sound.bounces.numbers(),
        };
        json!({
            "data": name,
            "kind": self.kind().name(),
            "gravity_m_s2": rig.gravity().value,
            "restitution": { "value": restitution.value, "uncertainty": restitution.uncertainty },
            "events": self.events(),
            "velocities": self.impacts().iter().map(velocity).collect::<Value>(),
            "impacts": self.impacts(),
            "record": details,
            "warnings": self.warnings(),
        })
    }
}
