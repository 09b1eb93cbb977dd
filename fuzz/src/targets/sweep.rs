//! A sweep file and its members.

use std::fs;
use std::io::Write;

use fem::sweep::load;
use tempfile::{NamedTempFile, TempDir, tempdir};

use super::{cases, files};
use crate::mutate::{Random, change_text};
use crate::trial::{Taken, Target, rejected};

/// A sweep with a range, linked keys and a table.
const MADE: &str = r#"case = "glass_0.5ms.toml"

[vary]
"body.0.sphere.diameter, body.1.sphere.diameter" = ["1 cm", 2e-2]
"body.0.approach_speed" = { from = "5 cm/s", to = "2 m/s", n = 5, log = true }
"body.1.approach_speed" = { table = "speeds.csv", columns = ["v"] }
"#;

/// A sweep with features that those of the repository lack.
const ALL: &str = r#"case = "glass_0.5ms.toml"
combine = "paired"
keep = "all"
max_members = 100

[vary]
"body.0.approach_speed" = ["0.16 m/s", 0.25]
"model" = [{ ting = {} }, { law = { tsuji = { e = 0.9 } } }]
"mesh" = [{ growth = 1.3 }, {}]
"material.glass.relaxation.terms.0.weight" = [0.5, 1]

[plot]
x = "body.0.approach_speed"
y = ["restitution", "contact_time_s"]
series = "model"
"#;

pub struct SweepText {
    seeds: Vec<Vec<u8>>,
    /// A folder with the cases that sweeps name.
    folder: TempDir,
}

impl SweepText {
    /// # Panics
    /// No folder to write to.
    pub fn new() -> Self {
        let folder = tempdir().expect("a folder");
        for (name, text) in files("cases", "toml") {
            fs::write(folder.path().join(name), text).expect("a file");
        }
        fs::write(folder.path().join("speeds.csv"), "v\n0\n5 cm/s\n").expect("a file");
        let shipped = files("cases", "toml").into_iter();
        let sweeps = shipped.filter(|(name, _)| name.starts_with("sweep")).map(|(_, text)| text);
        let mut seeds: Vec<Vec<u8>> = sweeps.collect();
        seeds.extend([ALL, MADE].map(|text| text.as_bytes().to_vec()));
        // Further words for mutations.
        seeds.extend(cases().into_iter().take(2));
        Self { seeds, folder }
    }
}

impl Target for SweepText {
    fn make(&self, random: &mut Random) -> Vec<u8> {
        let mut text = self.seeds[random.below(4)].clone();
        change_text(&mut text, &self.seeds, random);
        text
    }

    fn take(&self, input: &[u8]) -> Result<Taken, String> {
        let file = NamedTempFile::new_in(self.folder.path()).and_then(|mut file| {
            file.write_all(input)?;
            Ok(file)
        });
        let file = file.map_err(|error| error.to_string())?;
        let sweep = match load(file.path(), &[]) {
            Err(error) => return rejected(&error.to_string()),
            Ok(sweep) => sweep,
        };
        let n = sweep.n_members();
        for member in [0, 1, n / 2, n.saturating_sub(1)].into_iter().filter(|k| *k < n) {
            if sweep.describe(member).is_empty() {
                return Err(format!("member {member} has no words"));
            }
            if let Err(error) = sweep.build(member, Ok) {
                rejected(&error.to_string())?;
            }
        }
        Ok(Taken::Accepted)
    }
}
