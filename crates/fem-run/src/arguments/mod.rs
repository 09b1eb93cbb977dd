//! The command line.

pub mod case;
pub mod data;
pub mod law;

use std::ffi::OsString;
use std::path::Path;
use std::sync::LazyLock;
use std::time::Instant;

use clap::error::{ContextKind, ContextValue, ErrorKind};
use clap::{CommandFactory, FromArgMatches, Parser};
use fem_case::nearest;

use crate::commands::{Command, run};
use crate::text::{Failure, one_line};
use case::CaseArguments;

/// Computes the collision of two viscoelastic spheres, or of a sphere and a wall or a half-space.
///
/// Prints the result next to Hertz' closed form and writes summary.json, history.csv and ParaView files into
/// a folder.
#[derive(Debug, Parser)]
#[command(
    name = "fem-run",
    version = VERSION.as_str(),
    args_conflicts_with_subcommands = true,
    arg_required_else_help = true,
    override_usage = "fem-run [OPTIONS] CASE.toml\n       fem-run <COMMAND> …",
    after_help = AFTER_HELP
)]
pub struct Arguments {
    /// A job other than running a case.
    #[command(subcommand)]
    pub command: Option<Command>,
    /// The case to run.
    #[command(flatten)]
    pub input: Option<CaseArguments>,
    /// How to run it.
    #[command(flatten)]
    pub options: run::Options,
}

/// The version with the digest of the numerics: builds with the same digest give the same bits.
static VERSION: LazyLock<String> =
    LazyLock::new(|| format!("{} (numerics {})", env!("CARGO_PKG_VERSION"), fem::NUMERICS));

const AFTER_HELP: &str = "\
Exit status: 0 done; 1 the run failed (what was computed is kept, marked incomplete); 2 bad \
input, nothing written; 130 interrupted (kept, marked; a second Ctrl-C ends at once).
A case file with the name of a command runs as ./check.

Examples:
  fem-run new ball --material pmma --partner wall
  fem-run cases/glass_0.5ms.toml
  fem-run cases/glass_0.5ms.toml --set body.0.approach_speed='1 m/s'
  fem-run check cases/glass_0.5ms.toml";

/// The commands in the order of the help, by purpose.
const GROUPS: [(&str, &[&str]); 4] = [
    ("Run", &["new", "check", "mesh", "materials", "sweep", "accuracy", "report", "plot"]),
    ("Measure and fit", &["measure", "relaxation", "fit", "calibrate", "invert", "cradle"]),
    ("Hand over", &["export", "schema"]),
    ("For developers", &["validate", "completions", "man"]),
];

/// Returns the whole command line. Its help has the commands in groups, which clap does not offer.
pub fn command() -> clap::Command {
    let command = Arguments::command();
    let line = |name: &&str| {
        let about = command.find_subcommand(name).and_then(clap::Command::get_about);
        format!("  {name:<13}{}\n", about.cloned().unwrap_or_default())
    };
    let group = |(title, names): &(&str, &[&str])| {
        format!("{title}:\n{}\n", names.iter().map(line).collect::<String>())
    };
    let groups: String = GROUPS.iter().map(group).collect();
    let template = format!(
        "{{about-with-newline}}\n{{usage-heading}} {{usage}}\n\n{groups}\
         Help of one of them: fem-run COMMAND -h\n\nArguments:\n{{positionals}}\n\nOptions:\n{{options}}{{after-help}}"
    );
    command.help_template(template)
}

/// Parses the command line. For help, version or an invalid command line it prints text and ends the
/// process.
pub fn parse(words: impl IntoIterator<Item = OsString>) -> Arguments {
    let parsed = command()
        .try_get_matches_from(words)
        .and_then(|matches| Arguments::from_arg_matches(&matches));
    let error = match parsed {
        Ok(arguments) => return arguments,
        Err(error) => error,
    };
    let mut command = command();
    let names = names_of(&command).join(", ");
    let (word, text) = match error.kind() {
        // `help exprt`; elsewhere a word that is no command is taken as a case.
        ErrorKind::InvalidSubcommand => {
            let word = match error.get(ContextKind::InvalidSubcommand) {
                Some(ContextValue::String(word)) => word.clone(),
                _ => String::new(),
            };
            let text = format!("{word:?} is not a command; the commands are {names}");
            (word, text)
        }
        // clap takes the second of two cases for a command.
        ErrorKind::ArgumentConflict if error.to_string().contains("the subcommand") => {
            let word = std::env::args().nth(1).unwrap_or_default();
            let text = match Path::new(&word).exists() {
                true => "only one case can be run at a time, and a command must be the first word"
                    .to_string(),
                false => format!("{word:?} is neither a case file nor a command"),
            };
            (word, format!("{text}; the commands are {names}"))
        }
        _ => error.exit(),
    };
    let text = match (other_word(&word), near_command(&word)) {
        (Some(way), _) => format!("{word} is not a command: {way}"),
        (None, Some(near)) => format!("{text}; did you mean {near}?"),
        (None, None) => text,
    };
    command.error(error.kind(), text).exit()
}

/// Returns how to do what a word means that is no command but that other programs have; `None` for any other word or for an
/// existing file.
fn other_word(word: &str) -> Option<&'static str> {
    const WORDS: [(&[&str], &str); 6] = [
        (&["run", "solve", "simulate", "start"], "run a case with fem-run CASE.toml"),
        (&["compare", "diff"], "fem-run report A B compares the results in the folders A and B"),
        (&["init", "create"], "fem-run new NAME writes a case"),
        (&["list", "library"], "fem-run materials lists the library"),
        (&["convergence", "study"], "fem-run accuracy CASE.toml compares meshes and models"),
        (
            &["show", "view", "open"],
            "fem-run report FOLDER writes a page, fem-run plot FOLDER a figure",
        ),
    ];
    let way = WORDS.iter().find(|(words, _)| words.contains(&word)).map(|(_, way)| *way);
    way.filter(|_| !Path::new(word).exists())
}

fn names_of(command: &clap::Command) -> Vec<String> {
    command.get_subcommands().map(|command| command.get_name().to_string()).collect()
}

/// Returns the command that a word probably means; `None` for a command or an existing file, also without `.toml`.
fn near_command(word: &str) -> Option<String> {
    // With 0.85, `chek`, `sweeps` and `mateirals` mean commands, `glass` and `case` do not.
    let names = names_of(&command());
    let is_file = [word, &format!("{word}.toml")].iter().any(|name| Path::new(name).exists());
    let is_word = !word.contains(['.', '/', '\\']) && !is_file;
    let near = nearest(word, &names, 0.85).filter(|_| is_word);
    near.map(str::to_string)
}

impl Arguments {
    pub fn execute(self, started: Instant) -> Result<(), Failure> {
        match (self.command, self.input) {
            (Some(command), _) => command.execute(self::command),
            (None, Some(input)) => match (other_word(&input.name()), near_command(&input.name())) {
                (Some(way), _) => Err(Failure::bad_input(format!(
                    "{}: there is no such file and no such command",
                    one_line(&input.name())
                ))
                .with_help(way)),
                (None, Some(near)) => Err(Failure::bad_input(format!(
                    "{}: there is no such file and no such command",
                    one_line(&input.name())
                ))
                .with_help(format!("did you mean fem-run {near}?"))),
                (None, None) => run::execute(&input, &self.options, started),
            },
            // clap prints its help if there are no arguments at all.
            (None, None) => Ok(()),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn help_lists_each_command_once_on_one_line() {
        let mut grouped: Vec<&str> = GROUPS.iter().flat_map(|(_, names)| *names).copied().collect();
        let command = command();
        let mut names = names_of(&command);
        grouped.sort_unstable();
        names.sort_unstable();
        assert_eq!(grouped, names);
        let help = command.clone().render_help().to_string();
        for name in names {
            let line = help.lines().find(|line| line.starts_with(&format!("  {name} "))).unwrap();
            assert!(line.len() <= 80, "{line}");
        }
    }
}
