//! The folder of a sweep: `sweep.json`, which identifies it, the results of members in `members/`, table
//! and figure. Several processes may write into it at the same time.
//!
//! A member has a folder of its own, or a line in a [member file](super::member_store).

use std::fs::{self, File};
use std::io::{self, Read, Write};
use std::path::{Path, PathBuf};

use fem::results::{HISTORY_FILE, PROGRAM, SUMMARY_FILE};
use fem_case::Keep;
use serde_json::Value;

use super::member_store::{MemberFile, MemberStore, ShardFilter};
use super::shard::Shard;
use crate::result_folder::Origin;
use crate::result_folder::recover_leftovers;
use crate::result_folder::whole_file::{MadeFolders, PREFIX, unwritten, write_streamed};
use crate::text::{Failure, shown};

/// The manifest: the varied keys, and the values and identities of the members.
pub const MANIFEST_FILE: &str = "sweep.json";
pub const FIGURE_FILE: &str = "sweep.svg";
const MEMBERS: &str = "members";
/// Summaries that are in memory at the same time.
const AT_ONCE: usize = 1024;
/// Bytes of a manifest that have the program and the source of the sweep.
const HEAD: u64 = 16 << 10;

#[derive(Debug)]
pub struct SweepFolder {
    path: PathBuf,
    /// What the sweep is made from; without it, or with force, the folder may be that of any sweep.
    origin: Option<Origin>,
    store: MemberStore,
}

impl SweepFolder {
    /// Opens a folder, which may not exist yet; `filter` selects the member files that are read.
    pub fn at(out: &Path, filter: ShardFilter) -> Self {
        let store = MemberStore::of(out.join(MEMBERS), filter);
        Self { path: out.to_path_buf(), origin: None, store }
    }

    /// Restricts the folder to a sweep of this origin.
    #[must_use]
    pub fn only_of(self, origin: &Origin) -> Self {
        Self { origin: Some(origin.clone()), ..self }
    }

    /// Returns the source of the sweep in the folder if it is another one than this. The manifest of an older version
    /// names no source.
    pub fn other_sweep(&self) -> Option<String> {
        let head = manifest_head(&self.path);
        let text = |key: &str| -> Option<String> {
            let at = head.find(&format!("\"{key}\":"))? + key.len() + 3;
            let mut values = serde_json::Deserializer::from_str(&head[at..]).into_iter();
            values.next()?.ok()
        };
        let (made_from, source) = (text("made_from")?, text("source"));
        let origin = self.origin.as_ref()?;
        let is_same = origin.is_same(Some(&made_from), source.as_deref(), &self.path);
        (!is_same).then(|| source.unwrap_or_default())
    }

    /// Checks whether the folder can be claimed, without writing.
    pub fn check(&self) -> Result<(), Failure> {
        let out = &self.path;
        let named = shown(out);
        let refuse = |found: &str| {
            Err(Failure::bad_input(format!("{named}: {found}")).with_help(
                "name another folder with --out, or move this one away; only a folder of fem-run \
                 sweep can be continued",
            ))
        };
        if out.file_name().is_none() {
            return refuse("this is not the name of a folder");
        }
        match fs::metadata(out) {
            Ok(metadata) if !metadata.is_dir() => return refuse("a file is in the way"),
            Ok(_) => match is_ours(out) {
                Ok(true) => {}
                Ok(false) => return refuse("this folder holds something other than a sweep"),
                Err(error) => return refuse(&format!("this folder cannot be read: {error}")),
            },
            Err(error) if error.kind() == io::ErrorKind::NotADirectory => {
                return refuse("a file is in the way");
            }
            Err(_) => {}
        }
        match self.other_sweep() {
            None => Ok(()),
            Some(source) => {
                let message = format!("{named}: this folder holds another sweep: {source}");
                Err(Failure::bad_input(message).with_help(
                    "name another folder with --out, or replace the table of that sweep with --force; its \
                     members stay",
                ))
            }
        }
    }

    /// Claims a new or empty folder or that of an earlier sweep, and writes the manifest. One that is there already may be left unchanged.
    pub fn claim(
        &self,
        replaces_manifest: bool,
        mark: impl FnOnce(&mut dyn Write) -> io::Result<()>,
    ) -> Result<(), Failure> {
        let has_one = self.path.join(MANIFEST_FILE).is_file();
        if !replaces_manifest && has_one && is_ours(&self.path).unwrap_or(false) {
            return Ok(());
        }
        self.check()?;
        let out = &self.path;
        let named = shown(out);
        recover_leftovers(out);
        recover_leftovers(&out.join(MEMBERS));
        let _made = MadeFolders::above(&out.join(MEMBERS));
        self.prepare(mark).map_err(|error| {
            let what = format!("{named}: a sweep");
            unwritten(&what, &error, "name a folder in a place that you may write to")
        })
    }

    /// The manifest is written first: it identifies the folder.
    fn prepare(&self, mark: impl FnOnce(&mut dyn Write) -> io::Result<()>) -> io::Result<()> {
        fs::create_dir_all(&self.path)?;
        self.write(MANIFEST_FILE, mark)?;
        fs::create_dir_all(self.path.join(MEMBERS))
    }

    pub fn path(&self) -> &Path {
        &self.path
    }

    pub fn member(&self, identity: &str) -> PathBuf {
        self.path.join(MEMBERS).join(identity)
    }

    pub fn pack(&self, shard: Shard) -> MemberFile {
        MemberFile::new(&self.path.join(MEMBERS), shard)
    }

    /// Whether everything that is to be kept of a member exists.
    pub fn has(&self, identity: &str, keep: Keep) -> bool {
        match keep {
            Keep::All => {
                self.member(identity).join(HISTORY_FILE).is_file()
                    && self.in_folder(identity).is_some()
            }
            Keep::Summary => self.store.has(identity) || self.in_folder(identity).is_some(),
            // The file system is not asked for a million missing folders.
            Keep::Packed => self.store.has(identity) || self.unpacked(identity).is_some(),
        }
    }

    pub fn refresh(&mut self) {
        self.store.refresh();
    }

    /// Returns the summaries of the given members, `None` for those that are not done. Summaries are read
    /// in portions.
    pub fn summaries<'a>(
        &'a self,
        mut identities: impl Iterator<Item = String> + 'a,
    ) -> impl Iterator<Item = Option<Value>> + 'a {
        std::iter::from_fn(move || {
            let some: Vec<String> = identities.by_ref().take(AT_ONCE).collect();
            (!some.is_empty()).then(|| {
                let packed = self.store.summaries(&some);
                let both = some.into_iter().zip(packed);
                both.map(|(identity, packed)| packed.or_else(|| self.unpacked(&identity)))
            })
        })
        .flatten()
    }

    fn unpacked(&self, identity: &str) -> Option<Value> {
        self.store.has_others().then(|| self.in_folder(identity)).flatten()
    }

    fn in_folder(&self, identity: &str) -> Option<Value> {
        let bytes = fs::read(self.member(identity).join(SUMMARY_FILE)).ok()?;
        let summary: Value = serde_json::from_slice(&bytes).ok()?;
        (summary["program"] == PROGRAM && summary["complete"].is_boolean()).then_some(summary)
    }

    /// Replaces a file in one step: readers see the old content or the new one.
    pub fn write(
        &self,
        name: &str,
        write: impl FnOnce(&mut dyn Write) -> io::Result<()>,
    ) -> io::Result<()> {
        write_streamed(&self.path.join(name), &self.path, write)
    }

    pub fn remove(&self, name: &str) {
        let _ = fs::remove_file(self.path.join(name));
    }
}

/// Whether the folder is empty or that of a sweep, perhaps one that another process is just creating.
fn is_ours(path: &Path) -> io::Result<bool> {
    if has_manifest(path) {
        return Ok(true);
    }
    for entry in fs::read_dir(path)? {
        if !entry?.file_name().to_string_lossy().starts_with(PREFIX) {
            // The manifest may have been written in the meantime.
            return Ok(has_manifest(path));
        }
    }
    Ok(true)
}

/// Whether there is a manifest. It begins with the program's name.
fn has_manifest(path: &Path) -> bool {
    let mut head = manifest_head(path);
    head.retain(|c| !c.is_ascii_whitespace());
    head.starts_with(&format!("{{\"program\":\"{PROGRAM}\","))
}

/// Returns the first keys of the manifest; that of a million members is too long to be read whole.
fn manifest_head(path: &Path) -> String {
    let mut head = Vec::new();
    let file = File::open(path.join(MANIFEST_FILE));
    let _ = file.and_then(|file| file.take(HEAD).read_to_end(&mut head));
    String::from_utf8_lossy(&head).into_owned()
}
