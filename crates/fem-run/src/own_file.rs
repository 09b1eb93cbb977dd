//! Single files that a command writes where its user says: a file of someone else is not replaced.

use std::fs::File;
use std::io::Read;
use std::path::Path;

use crate::failure::Failure;
use crate::standard_output::{self, one_line};
use crate::whole_file::write_whole;

/// Bytes at the beginning of a file within which its mark is.
const HEAD: u64 = 600;

/// A kind of file, and by what one of this program is known.
#[derive(Clone, Copy, Debug)]
pub struct OwnFile {
    /// What it is called.
    pub what: &'static str,
    /// The ending of its name.
    pub extension: &'static str,
    /// What stands in the first lines of each.
    pub mark: &'static str,
    /// The option that names it.
    pub option: &'static str,
}

impl OwnFile {
    /// Refuses a place where such a file may not go.
    ///
    /// # Errors
    /// A name that ends otherwise; something in the place that is no such file of this program.
    pub fn check(&self, path: &Path) -> Result<(), Failure> {
        let shown = one_line(&path.display().to_string());
        let Self { what, extension, option, .. } = self;
        let refused =
            |message: String, help: String| Err(Failure::bad_input(message).with_help(help));
        if path.extension().is_some_and(|found| !found.eq_ignore_ascii_case(extension)) {
            let message = format!("{shown}: a {what} of fem-run is a .{extension} file");
            return refused(message, format!("name a .{extension} file with {option}"));
        }
        if path.exists() && !self.is_own(path) {
            let message = format!("{shown}: this is no {what} of fem-run, and is not replaced");
            return refused(message, format!("name another file with {option}"));
        }
        Ok(())
    }

    fn is_own(&self, path: &Path) -> bool {
        let mut head = Vec::new();
        let read = File::open(path).and_then(|file| file.take(HEAD).read_to_end(&mut head));
        read.is_ok() && String::from_utf8_lossy(&head).contains(self.mark)
    }

    /// Writes such a file whole, and gives the line that says where it is; `-` is standard output, and
    /// there is no line then.
    ///
    /// # Errors
    /// See [`check`](Self::check); the file system.
    pub fn write(&self, path: &Path, text: &str) -> Result<Option<String>, Failure> {
        if path == Path::new("-") {
            standard_output::print(text)?;
            return Ok(None);
        }
        self.check(path)?;
        let shown = one_line(&path.display().to_string());
        let folder = path.parent().filter(|folder| !folder.as_os_str().is_empty());
        write_whole(path, folder.unwrap_or(Path::new(".")), text.as_bytes()).map_err(|error| {
            let help =
                format!("name a file in a folder that you may write to with {}", self.option);
            Failure::bad_input(format!("{shown}: {error}")).with_help(help)
        })?;
        let (first, rest) = self.what.split_at(1);
        Ok(Some(format!("{}{rest}: {shown}\n", first.to_uppercase())))
    }
}
