//! Summaries of many members in one file, one line per member.
//!
//! Each process appends to a file of its own, `members/K-of-N.XXXXXX.jsonl` for shard K/N. A line is
//! `{"member":"ID","summary":{…}}`; an incomplete line, of a killed process, is ignored. Only the positions
//! of the lines are kept in memory.

use std::collections::HashMap;
use std::fs::{self, File};
use std::io::{self, BufRead, BufReader, Read, Seek, SeekFrom, Write};
use std::path::{Path, PathBuf};
use std::sync::Mutex;

use fem::results::{PROGRAM, Summary};
use serde::{Deserialize, Serialize};
use serde_json::Value;

use super::shard::Shard;

/// Approximate size of a line in bytes.
pub const LINE_BYTES: u64 = 5_000;
/// End of the names of member files.
const ENDING: &str = ".jsonl";

/// Which member files are read.
#[derive(Clone, Copy, Debug)]
pub enum ShardFilter {
    /// The files of all shards.
    All,
    /// The files of this shard, and those of shardings into another number, which had other members. The
    /// other shards of the same sharding hold none of its members.
    Shard(Shard),
}

impl ShardFilter {
    fn has(self, name: &str) -> bool {
        let Self::Shard(own) = self else { return true };
        let named = name.split('.').next().and_then(|shard| shard.split_once("-of-"));
        let shard = named.and_then(|(k, n)| format!("{k}/{n}").parse::<Shard>().ok());
        shard.is_none_or(|shard| shard == own || shard.step() != own.step())
    }
}

#[derive(Serialize)]
struct WrittenLine<'a> {
    member: &'a str,
    summary: &'a Summary,
}

/// The keys that make a line one of a member.
#[derive(Deserialize)]
struct Line<'a> {
    member: &'a str,
    #[serde(borrow)]
    summary: Head<'a>,
}

#[derive(Deserialize)]
struct Head<'a> {
    program: &'a str,
    #[serde(rename = "complete")]
    _complete: bool,
}

#[derive(Deserialize)]
struct Packed {
    summary: Value,
}

#[derive(Clone, Copy, Debug)]
struct LinePosition {
    file: u32,
    length: u32,
    start: u64,
}

#[derive(Debug)]
pub struct MemberStore {
    folder: PathBuf,
    filter: ShardFilter,
    /// Each with the number of bytes that have been read.
    files: Vec<(PathBuf, u64)>,
    places: HashMap<u64, LinePosition>,
    has_others: bool,
}

impl MemberStore {
    /// Opens the files in a folder, which may not exist yet.
    pub fn of(folder: PathBuf, filter: ShardFilter) -> Self {
        let (files, places) = (Vec::new(), HashMap::new());
        let mut store = Self { folder, filter, files, places, has_others: false };
        store.refresh();
        store
    }

    /// Reads what has been added; unreadable files count as empty.
    pub fn refresh(&mut self) {
        let entries = fs::read_dir(&self.folder).into_iter().flatten().filter_map(Result::ok);
        let mut new = Vec::new();
        for name in entries.filter_map(|entry| entry.file_name().into_string().ok()) {
            if !name.ends_with(ENDING) {
                self.has_others |= !name.starts_with('.');
            } else if self.filter.has(&name) {
                new.push(self.folder.join(name));
            }
        }
        new.sort_unstable();
        new.retain(|path| self.files.iter().all(|(known, _)| known != path));
        self.files.extend(new.into_iter().map(|path| (path, 0)));
        for file in 0..self.files.len() {
            let _ = self.scan(file);
        }
    }

    fn scan(&mut self, file: usize) -> io::Result<()> {
        let (path, seen) = &mut self.files[file];
        let mut pack = File::open(path)?;
        pack.seek(SeekFrom::Start(*seen))?;
        let mut pack = BufReader::with_capacity(1 << 20, pack);
        let mut line = Vec::new();
        loop {
            line.clear();
            let length = pack.read_until(b'\n', &mut line)?;
            if line.last() != Some(&b'\n') {
                return Ok(());
            }
            let read = serde_json::from_slice::<Line<'_>>(&line).ok();
            let read = read.filter(|line| line.summary.program == PROGRAM);
            let digest = read.and_then(|line| u64::from_str_radix(line.member, 16).ok());
            if let Some(digest) = digest
                && let (Ok(file), Ok(length)) = (u32::try_from(file), u32::try_from(length))
            {
                self.places.entry(digest).or_insert(LinePosition { file, length, start: *seen });
            }
            *seen += length as u64;
        }
    }

    /// Whether there are folders of members in addition to the files.
    pub fn has_others(&self) -> bool {
        self.has_others
    }

    pub fn has(&self, identity: &str) -> bool {
        self.place(identity).is_some()
    }

    fn place(&self, identity: &str) -> Option<LinePosition> {
        self.places.get(&u64::from_str_radix(identity, 16).ok()?).copied()
    }

    /// Returns the summaries of some members and opens each file once.
    pub fn summaries(&self, identities: &[String]) -> Vec<Option<Value>> {
        let mut found = vec![None; identities.len()];
        let place = |(k, identity): (usize, &String)| Some((self.place(identity)?, k));
        let mut places: Vec<_> = identities.iter().enumerate().filter_map(place).collect();
        places.sort_unstable_by_key(|(place, _)| (place.file, place.start));
        for of_file in places.chunk_by(|(a, _), (b, _)| a.file == b.file) {
            let (path, _) = &self.files[of_file[0].0.file as usize];
            let Ok(mut file) = File::open(path) else { continue };
            for (place, k) in of_file {
                found[*k] = read_at(&mut file, *place).ok();
            }
        }
        found
    }
}

fn read_at(file: &mut File, place: LinePosition) -> io::Result<Value> {
    let mut line = vec![0; place.length as usize];
    file.seek(SeekFrom::Start(place.start))?;
    file.read_exact(&mut line)?;
    Ok(serde_json::from_slice::<Packed>(&line)?.summary)
}

/// The member file of this process, created with its first line.
#[derive(Debug)]
pub struct MemberFile {
    folder: PathBuf,
    shard: Shard,
    file: Mutex<Option<File>>,
}

impl MemberFile {
    pub fn new(folder: &Path, shard: Shard) -> Self {
        Self { folder: folder.to_path_buf(), shard, file: Mutex::default() }
    }

    pub fn append(&self, identity: &str, summary: &Summary) -> io::Result<()> {
        let mut line = serde_json::to_vec(&WrittenLine { member: identity, summary })?;
        line.push(b'\n');
        // A thread that panicked has written whole lines.
        let mut file = self.file.lock().unwrap_or_else(std::sync::PoisonError::into_inner);
        let file = match &mut *file {
            Some(file) => file,
            none => none.insert(self.create()?),
        };
        let end = file.seek(SeekFrom::End(0))?;
        file.write_all(&line).inspect_err(|_| drop(file.set_len(end)))
    }

    fn create(&self) -> io::Result<File> {
        let name = format!("{}-of-{}.", self.shard.number(), self.shard.step());
        let mut builder = tempfile::Builder::new();
        builder.prefix(&name).suffix(ENDING);
        #[cfg(unix)]
        {
            use std::os::unix::fs::PermissionsExt;
            builder.permissions(fs::Permissions::from_mode(0o666));
        }
        Ok(builder.tempfile_in(&self.folder)?.keep().map_err(|kept| kept.error)?.0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn line(identity: &str, program: &str) -> String {
        format!(
            "{{\"member\":\"{identity}\",\"summary\":{{\"program\":\"{program}\",\"complete\":true}}}}\n"
        )
    }

    /// Complete lines of this program count, whatever else a file holds; the first line of a member counts.
    #[test]
    fn lines_that_are_whole_are_members() {
        let folder = tempfile::tempdir().unwrap();
        let [a, b, c] = ["00000000000000aa", "00000000000000bb", "00000000000000cc"];
        let path = folder.path().join("1-of-1.x.jsonl");
        let text =
            format!("{}{}nonsense\n{}", line(a, PROGRAM), line(b, "other"), &line(c, PROGRAM));
        fs::write(&path, &text[..text.len() - 3]).unwrap();
        let mut store = MemberStore::of(folder.path().to_path_buf(), ShardFilter::All);
        assert_eq!([a, b, c].map(|member| store.has(member)), [true, false, false]);
        // The rest of the last line comes later.
        fs::write(&path, &text).unwrap();
        store.refresh();
        assert!(store.has(c));
        let read = store.summaries(&[c, b, a].map(String::from));
        assert_eq!(read.iter().map(Option::is_some).collect::<Vec<_>>(), [true, false, true]);
    }

    #[test]
    fn shard_reads_its_own_packs_and_those_of_other_shard_counts() {
        let own = ShardFilter::Shard("2/3".parse().unwrap());
        let names = ["2-of-3.a.jsonl", "1-of-3.b.jsonl", "1-of-4.c.jsonl", "mine.jsonl"];
        assert_eq!(names.map(|name| own.has(name)), [true, false, true, true]);
        assert!(names.iter().all(|name| ShardFilter::All.has(name)));
    }
}
