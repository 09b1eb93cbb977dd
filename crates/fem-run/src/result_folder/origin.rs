//! The origin of a result, which decides which older result it replaces.

use std::env;
use std::path::{Component, Path, PathBuf};

use fem::digest_of;
use fem_case::readable_name;

use super::existing_output::ExistingResult;

const STDIN: &str = "-";

/// The origin of a result: the digest of its inputs, and the files and overrides that they came from.
///
/// A result replaces an older one with the same digest, such as that of a copy of the case file, or with the same
/// [source](Self::source), such as that of the same case file before it was edited.
#[derive(Clone, Debug)]
pub struct Origin {
    command: String,
    made_from: String,
    /// Absolute paths; empty if an input has no file.
    files: Vec<PathBuf>,
    /// Overrides of the case file, and inputs that are no files.
    options: Vec<String>,
    has_files: bool,
}

impl Origin {
    /// Returns the origin of a result of `command` with this digest, which has no file yet.
    pub fn of_digest(command: &str, made_from: String) -> Self {
        let (files, options) = (Vec::new(), Vec::new());
        Self { command: command.to_string(), made_from, files, options, has_files: true }
    }

    /// Adds an input file. The standard input is no file: its content may be another one each time.
    #[must_use]
    pub fn with_file(mut self, path: &Path) -> Self {
        match path.as_os_str() == STDIN {
            true => self.has_files = false,
            false => self.files.push(absolute(path)),
        }
        self
    }

    /// Adds options, such as overrides of the case file.
    #[must_use]
    pub fn with_options(mut self, options: &[String]) -> Self {
        self.options.extend_from_slice(options);
        self
    }

    /// Adds an input file and its content.
    #[must_use]
    pub fn with_data_file(mut self, path: &Path) -> Self {
        let content = std::fs::read(path).unwrap_or_default();
        self.made_from = digest_of([self.made_from.as_bytes(), &content]);
        self.with_file(path)
    }

    /// Adds inputs that are neither files nor part of the digest.
    #[must_use]
    pub fn with_inputs(mut self, inputs: &[String]) -> Self {
        if !inputs.is_empty() {
            let all = std::iter::once(&self.made_from).chain(inputs);
            self.made_from = digest_of(all.map(String::as_bytes));
        }
        self.with_options(inputs)
    }

    /// Returns the digest.
    pub fn made_from(&self) -> &str {
        &self.made_from
    }

    /// Returns the command, the files as seen from `folder`, so that a project may be moved, and the options;
    /// `None` if an input has no file.
    pub fn source(&self, folder: &Path) -> Option<String> {
        if !self.has_files || self.files.is_empty() {
            return None;
        }
        let mut words = vec![self.command.clone()];
        words.extend(self.files.iter().map(|file| seen_from(&absolute(folder), file)));
        words.extend_from_slice(&self.options);
        Some(words.join(" "))
    }

    /// Returns whether this result may replace an older one in `folder`.
    pub fn replaces(&self, old: &ExistingResult, folder: &Path) -> bool {
        self.is_same(old.made_from(), old.source(), folder)
    }

    /// Returns whether a result in `folder` with this digest and source has this origin.
    pub fn is_same(&self, made_from: Option<&str>, source: Option<&str>, folder: &Path) -> bool {
        made_from == Some(&self.made_from)
            || source.is_some() && source == self.source(folder).as_deref()
    }

    /// Returns the folders for this result beside one of the same name that is taken, the best first: `ball-model=ting`,
    /// where that is easily typed, then `ball-2`, `ball-3` and so on.
    pub fn folders_beside(&self, taken: &Path) -> impl Iterator<Item = PathBuf> + use<> {
        let taken = taken.to_path_buf();
        let name = taken.file_name().unwrap_or_default().to_string_lossy().to_string();
        let readable = Some(self.distinction()).filter(|words| !words.is_empty());
        let numbers = (2..).map(|number: u64| number.to_string());
        readable
            .into_iter()
            .chain(numbers)
            .map(move |end| taken.with_file_name(format!("{name}-{end}")))
    }

    /// Returns what distinguishes this result's folder from one of the same name: the options or, without any, the
    /// folder of the first file; empty if that is no name to type.
    fn distinction(&self) -> String {
        let folder = self.files.first().and_then(|file| file.parent()?.file_name());
        let folder = folder.map(|name| name.to_string_lossy().to_string());
        let words = match self.options.as_slice() {
            [] => folder.unwrap_or_default(),
            all => all.join("-").replace("={}", ""),
        };
        if words.contains(['{', '[', '(', ',', ';']) {
            String::new()
        } else {
            readable_name(&words)
        }
    }
}

/// Returns an absolute path with the symbolic links of its existing part resolved.
fn absolute(path: &Path) -> PathBuf {
    let path = env::current_dir().map_or(path.to_path_buf(), |folder| folder.join(path));
    let existing = path.ancestors().find_map(|part| Some((part, part.canonicalize().ok()?)));
    match existing {
        Some((part, real)) => match path.strip_prefix(part) {
            Ok(rest) if !rest.as_os_str().is_empty() => real.join(rest),
            _ => real,
        },
        None => path,
    }
}

/// Returns an absolute path relative to a folder, with `/` between its parts on every system.
fn seen_from(folder: &Path, path: &Path) -> String {
    let (from, to): (Vec<Component<'_>>, Vec<Component<'_>>) =
        (folder.components().collect(), path.components().collect());
    let n_common = from.iter().zip(&to).take_while(|(a, b)| a == b).count();
    let up = std::iter::repeat_n("..".to_string(), from.len() - n_common);
    let down = to[n_common..].iter().map(|part| part.as_os_str().to_string_lossy().to_string());
    up.chain(down).collect::<Vec<_>>().join("/")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_source_names_its_files_as_seen_from_the_folder() {
        let of = |folder: &str, file: &str| seen_from(Path::new(folder), Path::new(file));
        assert_eq!(of("/a/runs/ice", "/a/ice.toml"), "../../ice.toml");
        assert_eq!(of("/b/runs/ice", "/b/cases/ice.toml"), "../../cases/ice.toml");
        assert_eq!(of("/x", "/y/ice.toml"), "../y/ice.toml");
    }

    #[test]
    fn the_standard_input_is_no_source() {
        let origin = Origin::of_digest("fit", "1".into()).with_file(Path::new("-"));
        assert_eq!(origin.with_file(Path::new("e.csv")).source(Path::new("runs/e")), None);
    }
}
