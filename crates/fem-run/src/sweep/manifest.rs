//! The manifest `sweep.json`: which sweep a folder holds, and which member is where.

use std::io::{self, Write};

use fem::results::PROGRAM;
use fem::sweep::Member;
use fem_case::Sweep;
use serde::ser::{Serialize, SerializeMap, Serializer};

pub struct Manifest<'a> {
    pub sweep: &'a Sweep,
    pub members: &'a [Member],
    pub set: &'a [String],
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
        let Self { sweep, members, set } = self;
        let mut map = serializer.serialize_map(None)?;
        map.serialize_entry("program", PROGRAM)?;
        map.serialize_entry("version", env!("CARGO_PKG_VERSION"))?;
        map.serialize_entry("case", &sweep.base_path().display().to_string())?;
        map.serialize_entry("set", set)?;
        map.serialize_entry("combine", sweep.combine.word())?;
        map.serialize_entry("keep", sweep.keep.word())?;
        map.serialize_entry("vary", &KeyValues(sweep))?;
        map.serialize_entry("members", &MemberList(sweep, members))?;
        map.end()
    }
}

struct KeyValues<'a>(&'a Sweep);

impl Serialize for KeyValues<'_> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let places = self.0.keys().zip(self.0.places());
        serializer.collect_map(places.map(|(swept, (axis, key))| {
            let values = self.0.axes[axis].values.iter().map(|element| element.text(key));
            (&swept.key, values.collect::<Vec<_>>())
        }))
    }
}

struct MemberList<'a>(&'a Sweep, &'a [Member]);

impl Serialize for MemberList<'_> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.collect_seq(self.1.iter().map(|member| MemberEntry(self.0, member)))
    }
}

struct MemberEntry<'a>(&'a Sweep, &'a Member);

impl Serialize for MemberEntry<'_> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let mut map = serializer.serialize_map(Some(2))?;
        map.serialize_entry("member", &self.1.identity())?;
        map.serialize_entry("values", &MemberValues(self.0, self.1.index))?;
        map.end()
    }
}

struct MemberValues<'a>(&'a Sweep, usize);

impl Serialize for MemberValues<'_> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let keys = self.0.keys().map(|swept| &swept.key);
        serializer.collect_map(keys.zip(self.0.values(self.1)))
    }
}
