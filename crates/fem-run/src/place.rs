//! Which folder a result goes into where the command line names none.

use std::path::{Path, PathBuf};

use crate::occupant::Occupant;
use crate::result_folder::Replaces;

/// Digits of the digest in the name of a folder.
const DIGITS: usize = 8;

/// Where a result goes.
#[derive(Debug)]
pub struct ResultPlace {
    /// The folder.
    pub out: PathBuf,
    /// The usual folder, where it holds the result of another case.
    pub taken: Option<PathBuf>,
}

impl ResultPlace {
    /// `out` if it is named; else `runs/<name>`, or where that holds what was made from something else,
    /// a folder beside it that bears this result's digest, `made_from`.
    pub fn of(out: Option<&Path>, name: &str, made_from: &str, replaces: &Replaces) -> Self {
        if let Some(out) = out {
            return Self { out: out.to_path_buf(), taken: None };
        }
        let usual = Path::new("runs").join(name);
        match Occupant::of(&usual) {
            Ok(Occupant::Result(old)) if !replaces.allows(&old) => {
                let digits = made_from.get(..DIGITS).unwrap_or(made_from);
                let out = usual.with_file_name(format!("{name}-{digits}"));
                Self { out, taken: Some(usual) }
            }
            _ => Self { out: usual, taken: None },
        }
    }
}
