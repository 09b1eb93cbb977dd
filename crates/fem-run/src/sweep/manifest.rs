//! The manifest `sweep.json`: which sweep a folder holds, and which member is where.

use std::io::{self, Write};

use fem::results::PROGRAM;
use fem::sweep::Member;
use fem_case::Sweep;
use serde::ser::{Serialize, SerializeMap, Serializer};
use serde_json::{Value, json};

pub struct Manifest<'a> {
    pub sweep: &'a Sweep,
    pub members: &'a [Member],
    pub set: &'a [String],
    pub made_from: &'a str,
    pub source: Option<String>,
}

impl Manifest<'_> {
    /// Writes the manifest member by member.
    pub fn write(&self, to: &mut dyn Write) -> io::Result<()> {
        serde_json::to_writer_pretty(&mut *to, self)?;
        to.write_all(b"\n")
    }
}

impl Serialize for Manifest<'_> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let Self { sweep, members, set, made_from, source } = self;
        let places = sweep.keys().zip(sweep.places());
        let vary = places.map(|(swept, (axis, key))| {
            let values = sweep.axes[axis].values.iter().map(|element| element.text(key));
            (swept.key.clone(), values.collect::<Value>())
        });
        let mut map = serializer.serialize_map(None)?;
        map.serialize_entry("program", PROGRAM)?;
        map.serialize_entry("version", env!("CARGO_PKG_VERSION"))?;
        map.serialize_entry("made_from", made_from)?;
        map.serialize_entry("source", source)?;
        map.serialize_entry("case", &sweep.base_path().display().to_string())?;
        map.serialize_entry("set", set)?;
        map.serialize_entry("combine", sweep.combine.word())?;
        map.serialize_entry("keep", sweep.keep.word())?;
        map.serialize_entry("vary", &vary.collect::<Value>())?;
        map.serialize_entry("members", &MemberList(sweep, members))?;
        map.end()
    }
}

/// The members, each made when it is written: there may be a million.
struct MemberList<'a>(&'a Sweep, &'a [Member]);

impl Serialize for MemberList<'_> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let Self(sweep, members) = self;
        serializer.collect_seq(members.iter().map(|member| {
            let keys = sweep.keys().map(|swept| swept.key.clone());
            let values = keys.zip(sweep.values(member.index));
            json!({ "member": member.identity(), "values": values.collect::<Value>() })
        }))
    }
}
