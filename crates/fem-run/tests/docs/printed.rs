//! Checks that quoted output, numbers in the text and lists of files on pages agree with the commands above them.

use std::fs;
use std::path::Path;

use crate::common::Place;
use crate::pages::{Page, root};
use crate::shell::{commands, words};

/// Commands that take longer than two seconds, or read the output of such a command.
const SLOW: [&str; 12] = [
    "calibrate cases/polymer_drop.toml",
    "measure validation/data/plate_drops.csv",
    "calibrate cases/ice_2cm.toml",
    "calibrate validation/data/polymer_ball.toml",
    "--law all --out runs/ice_all",
    "export cases/",
    "export mine.toml",
    "invert cases/glass_0.5ms_elastic_bulk.toml",
    "sweep cases/sweep_speed.toml",
    "sweep cases/sweep_glass.toml",
    "sweep cases/sweep_temperature.toml",
    "runs/sweep_glass/sweep.csv",
];
/// Commands that are not run here: shards are partial.
const LEFT_OUT: [&str; 2] = ["--shard", "--help"];

/// Pages, commands, and numbers that the command prints and the text quotes.
const SAID: [(&str, &str, &[&str]); 7] = [
    ("docs/gallery.md", "cases/glass_0.5ms_elastic.toml", &["less than 4e-4"]),
    (
        "docs/calibrate.md",
        "calibrate cases/glass_0.5ms.toml --data validation/data/paper_glass.csv --verbose",
        &["0.1110", "355.6 µs"],
    ),
    ("docs/calibrate.md", "cases/glass_0.5ms.toml --set model.condensed={}", &["0.9277"]),
    ("docs/fits.md", "invert cases/glass_0.5ms.toml --restitution 0.92", &["958.8 ns", "2982 1/s"]),
    (
        "docs/fits.md",
        "fit cases/ice_2cm.toml --data validation/data/bridges_ice.csv --law bordbar_hyppanen \
         --param n=0.65 --compare kuwabara_kono --at 1 cm/s --out runs/ice_paper",
        &["0.0404"],
    ),
    (
        "docs/fits.md",
        "fit cases/ice_2cm.toml --data validation/data/bridges_ice.csv --law bordbar_hyppanen \
         --param n=0.7",
        &["0.0325"],
    ),
    (
        "docs/fits.md",
        "fit cases/ice_2cm.toml --data validation/data/bridges_ice.csv --law bordbar_hyppanen \
         --param n=0.8",
        &["0.0364"],
    ),
];

/// Which commands are run.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Pace {
    Quick,
    Slow,
}

/// How a shown number agrees with a printed one.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Digits {
    /// All digits: explicit elements and laws give the same bits on any processor.
    All,
    /// Within one unit of the last digit: the factorisation of condensed bodies depends on the processor in its last bits.
    ButLast,
}

/// Returns when a command is run, if at all.
fn pace(arguments: &str) -> Option<Pace> {
    let is_among = |parts: &[&str]| parts.iter().any(|part| arguments.contains(part));
    match (is_among(&LEFT_OUT), is_among(&SLOW)) {
        (true, _) => None,
        (_, true) => Some(Pace::Slow),
        (_, false) => Some(Pace::Quick),
    }
}

/// Returns a folder with the repository's cases and data.
pub fn place() -> Place {
    let place = Place::new();
    for folder in ["cases", "validation/data"] {
        fs::create_dir_all(place.path(folder)).unwrap();
        for entry in fs::read_dir(root().join(folder)).unwrap() {
            let entry = entry.unwrap();
            fs::copy(entry.path(), place.path(Path::new(folder).join(entry.file_name()))).unwrap();
        }
    }
    place
}

/// The output of the commands of a page.
struct Session {
    page: Page,
    place: Place,
    wanted: Pace,
    printed: Vec<(String, String)>,
}

/// Runs the commands of a page in order and compares the quoted output.
fn check(path: &str, wanted: Pace, digits: Digits) {
    let (page, printed) = (Page::load(path), Vec::new());
    let mut session = Session { page, place: place(), wanted, printed };
    session.check_blocks(digits);
    assert!(!session.printed.is_empty(), "{path}: no {wanted:?} command");
    session.check_numbers();
    session.check_files();
}

impl Session {
    fn check_blocks(&mut self, digits: Digits) {
        let mut last = None;
        for block in self.page.blocks() {
            for command in commands(&self.page, &block) {
                let Some(arguments) = command.arguments() else { continue };
                let arguments = arguments.join(" ");
                last = pace(&arguments);
                if last == Some(self.wanted) {
                    let ran = self.place.succeed(command.arguments().unwrap());
                    self.printed.push((arguments, ran.stdout));
                }
            }
            if block.language == "text" && last == Some(self.wanted) {
                let (path, line, shown) = (&self.page.path, block.line, &block.text);
                let (_, printed) = self.printed.last().unwrap();
                let is_printed = contains(printed, shown, digits);
                assert!(is_printed, "{path}:{line} shows\n{shown}\nprinted is\n{printed}");
            }
        }
    }

    fn check_numbers(&self) {
        let path = &self.page.path;
        for (_, arguments, numbers) in SAID.iter().filter(|said| said.0 == path) {
            if pace(arguments) != Some(self.wanted) {
                continue;
            }
            let known = self.printed.iter().find(|(command, _)| command == arguments);
            let text = known.map(|(_, text)| text.clone());
            let text = text.unwrap_or_else(|| self.place.succeed(&words(arguments)).stdout);
            for number in *numbers {
                assert!(self.page.text.contains(number), "{path} does not say {number}");
                assert!(text.contains(number), "{path} says {number}; {arguments} prints\n{text}");
            }
        }
    }

    fn check_files(&self) {
        for (line, files) in self.page.first_columns("file") {
            let folder = self.folder_above(line);
            if self.place.path(&folder).exists() {
                // Files in subfolders count as their subfolder, once.
                let top = |file: &String| file.split('/').next().unwrap().to_string();
                let mut listed: Vec<String> = files.iter().map(top).collect();
                listed.sort();
                listed.dedup();
                assert_eq!(listed, self.place.list(&folder), "{}:{line}", self.page.path);
            }
        }
    }

    /// Returns the result folder named last above a line.
    fn folder_above(&self, line: usize) -> String {
        let code = self.page.code().into_iter().take_while(|code| code.line < line);
        let folders = code.filter(|code| code.text.starts_with("runs/"));
        folders.last().unwrap_or_else(|| panic!("{}:{line}", self.page.path)).text
    }
}

/// Whether the lines of `shown` follow each other in `printed`.
fn contains(printed: &str, shown: &str, digits: Digits) -> bool {
    let [printed, shown]: [Vec<&str>; 2] = [printed, shown].map(|text| text.lines().collect());
    let agree = |(printed, shown): (&&str, &&str)| match digits {
        Digits::All => printed == shown,
        Digits::ButLast => are_near(printed, shown),
    };
    printed.windows(shown.len()).any(|lines| lines.iter().zip(&shown).all(agree))
}

/// Whether two lines have the same words, and numbers that differ by one unit of the last digit.
fn are_near(printed: &str, shown: &str) -> bool {
    let [printed, shown]: [Vec<&str>; 2] = [printed, shown].map(|line| line.split(' ').collect());
    let agree = |(a, b): (&&str, &&str)| match (units(a), units(b)) {
        (Some(a), Some(b)) => a.form == b.form && a.units.abs_diff(b.units) <= 1,
        _ => a == b,
    };
    printed.len() == shown.len() && printed.iter().zip(&shown).all(agree)
}

/// A number in units of its last digit.
struct Units {
    units: i64,
    /// Number of decimals, and the text after the digits: an exponent, a bracket.
    form: (usize, String),
}

fn units(word: &str) -> Option<Units> {
    let n_digits = word.find(|c: char| !"-.0123456789".contains(c)).unwrap_or(word.len());
    let (digits, rest) = word.split_at(n_digits);
    let n_decimals = digits.split_once('.').map_or(0, |(_, decimals)| decimals.len());
    let units = digits.replace('.', "").parse().ok()?;
    Some(Units { units, form: (n_decimals, rest.to_string()) })
}

/// Every page with quoted output is checked here.
#[test]
fn pages_with_output_are_checked() {
    let shows = |page: &Page| {
        let blocks = page.blocks();
        let is_command = |block| commands(page, block).iter().any(|c| c.arguments().is_some());
        blocks.iter().any(is_command) && blocks.iter().any(|block| block.language == "text")
    };
    let pages: Vec<String> = Page::all().into_iter().filter(shows).map(|page| page.path).collect();
    let expected = [
        "README.md",
        "docs/calibrate.md",
        "docs/cradle.md",
        "docs/dma.md",
        "docs/fits.md",
        "docs/measure.md",
    ];
    assert_eq!(pages, expected);
}

#[test]
fn quick_output_on_pages_equals_printed_output() {
    check("docs/fits.md", Pace::Quick, Digits::All);
    check("docs/cradle.md", Pace::Quick, Digits::All);
    check("docs/measure.md", Pace::Quick, Digits::All);
    check("docs/dma.md", Pace::Quick, Digits::All);
    check("docs/calibrate.md", Pace::Quick, Digits::ButLast);
}

/// Includes the commands of pages that quote no output.
#[test]
#[ignore = "a minute; .ci/run runs it"]
fn slow_output_on_pages_equals_printed_output() {
    for page in [
        "README",
        "docs/what-do-you-have",
        "docs/why-balls-bounce",
        "docs/gallery",
        "docs/measurement-to-dem",
    ] {
        check(&format!("{page}.md"), Pace::Quick, Digits::All);
    }
    check("docs/fits.md", Pace::Slow, Digits::All);
    check("docs/sweeps.md", Pace::Slow, Digits::All);
    check("docs/dma.md", Pace::Slow, Digits::ButLast);
    check("docs/calibrate.md", Pace::Slow, Digits::ButLast);
}

#[test]
fn shown_lines_must_be_consecutive_in_the_printed_output() {
    let printed = "a\nb 1.25 m\nc\n";
    assert!(contains(printed, "b 1.25 m\nc\n", Digits::All));
    assert!(!contains(printed, "a\nc\n", Digits::All));
    assert!(!contains(printed, "b 1.24 m\n", Digits::All));
    assert!(contains(printed, "b 1.24 m\n", Digits::ButLast));
    for far in ["b 1.23 m\n", "b 12.4 m\n", "b 1.24 s\n", "b -1.25 m\n"] {
        assert!(!contains(printed, far, Digits::ButLast), "{far}");
    }
}
