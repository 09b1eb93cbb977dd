// What decides the bits of a result, as a digest. The build script and its test share this file.

use std::collections::BTreeSet;
use std::fs;
use std::io;
use std::path::{Path, PathBuf};

use sha2::{Digest, Sha256};

/// Bytes of the digest that go into its name.
const BYTES: usize = 8;
/// Folders and files of sources that no build but that of tests compiles.
const TESTS: [&str; 3] = ["tests", "tests.rs", "test_support.rs"];

/// The crates of the workspace that a crate stands on, itself among them, as far as their sources lie
/// beside it; a published crate has no neighbours, and its version stands for them.
pub fn crates_below(own: &Path) -> io::Result<BTreeSet<PathBuf>> {
    let (mut found, mut open) = (BTreeSet::new(), vec![own.to_path_buf()]);
    while let Some(folder) = open.pop() {
        let manifest = fs::read_to_string(folder.join("Cargo.toml"))?;
        let dependencies = manifest.split("[dev-dependencies]").next().unwrap_or_default();
        for line in dependencies.lines().filter(|line| line.starts_with("fem-")) {
            let end = line.find(['.', ' ', '=']).unwrap_or(line.len());
            let neighbour = folder.with_file_name(&line[..end]);
            if neighbour.join("src").is_dir() && !found.contains(&neighbour) {
                open.push(neighbour);
            }
        }
        found.insert(folder);
    }
    Ok(found)
}

/// What is looked at, folders with all that is in them: sources and manifests, the versions of other
/// people's crates, and the levels at which all is compiled.
pub fn inputs(own: &Path) -> io::Result<Vec<PathBuf>> {
    let below = crates_below(own)?;
    let of_crates = below.iter().flat_map(|folder| [folder.join("Cargo.toml"), folder.join("src")]);
    let of_workspace = ["Cargo.toml", "Cargo.lock"].map(|name| own.join("../..").join(name));
    Ok(of_crates.chain(of_workspace).filter(|path| path.exists()).collect())
}

/// The digest of all of it and of the machine that it is compiled for, whose mathematical functions are
/// its own.
pub fn digest(own: &Path, target: &str) -> io::Result<String> {
    let mut digest = Sha256::new();
    let mut take = |bytes: &[u8]| {
        digest.update((bytes.len() as u64).to_le_bytes());
        digest.update(bytes);
    };
    take(target.as_bytes());
    for path in inputs(own)? {
        let mut files = Vec::new();
        collect(&path, &mut files)?;
        files.sort();
        for file in files {
            let name = file.strip_prefix(own.parent().unwrap_or(own)).unwrap_or(&file);
            take(name.to_string_lossy().as_bytes());
            take(&fs::read(&file)?);
        }
    }
    Ok(digest.finalize().iter().take(BYTES).map(|byte| format!("{byte:02x}")).collect())
}

/// The files in a folder and in its folders; a file itself.
fn collect(path: &Path, files: &mut Vec<PathBuf>) -> io::Result<()> {
    if !path.is_dir() {
        files.push(path.to_path_buf());
        return Ok(());
    }
    for entry in fs::read_dir(path)? {
        let entry = entry?;
        if !TESTS.iter().any(|name| entry.file_name() == *name) {
            collect(&entry.path(), files)?;
        }
    }
    Ok(())
}
