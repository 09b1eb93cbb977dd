//! `fem-run completions SHELL`, `fem-run man` and `fem-run schema`.

use clap::Command;
use clap_complete::Shell;
use clap_mangen::Man;
use fem_case::{CASE_SCHEMA, SWEEP_SCHEMA};

use crate::text::{Failure, standard_output};

/// Print a script that completes fem-run's arguments in a shell
///
/// For bash: fem-run completions bash > ~/.local/share/bash-completion/completions/fem-run
#[derive(clap::Args, Debug)]
pub struct CompletionArguments {
    /// Shell for which to write completions
    shell: Shell,
}

pub fn complete(arguments: &CompletionArguments, mut command: Command) -> Result<(), Failure> {
    let mut script = Vec::new();
    clap_complete::generate(arguments.shell, &mut command, "fem-run", &mut script);
    standard_output::print(&String::from_utf8_lossy(&script))
}

/// Print the manual page of fem-run or of one of its commands
///
/// To read it: fem-run man | man -l -. To install it: fem-run man > ~/.local/share/man/man1/fem-run.1
#[derive(clap::Args, Debug)]
pub struct ManArguments {
    /// A command, such as check
    command: Option<String>,
}

/// Prints the page as troff; `whole` is the whole command line.
pub fn man(arguments: &ManArguments, mut whole: Command) -> Result<(), Failure> {
    whole.build();
    let page = match &arguments.command {
        None => whole.clone(),
        Some(name) => whole.find_subcommand(name).cloned().ok_or_else(|| {
            let names: Vec<&str> = whole.get_subcommands().map(Command::get_name).collect();
            Failure::bad_input(format!("fem-run has no command {name:?}"))
                .with_help(format!("the commands are {}", names.join(", ")))
        })?,
    };
    let title = page.get_bin_name().unwrap_or("fem-run").replace(' ', "-");
    let mut text = Vec::new();
    Man::new(page)
        .title(title)
        .source(concat!("fem-run ", env!("CARGO_PKG_VERSION")))
        .render(&mut text)
        .map_err(|error| Failure::failed(format!("the manual page: {error}")))?;
    standard_output::print(&String::from_utf8_lossy(&text))
}

/// Print the JSON schema of case files or of sweep files
///
/// Editors with TOML support (Even Better TOML, Taplo, Zed, Helix) use it to complete and check keys: save
/// it as fem-run.schema.json and begin a case with the line #:schema ./fem-run.schema.json, as fem-run new
/// does. The schema covers keys, types, words, units and ranges; fem-run check also checks how keys depend
/// on each other.
#[derive(clap::Args, Debug)]
pub struct SchemaArguments {
    /// The kind of file
    #[arg(value_enum, default_value_t = Of::Case)]
    of: Of,
}

#[derive(clap::ValueEnum, Clone, Copy, Debug)]
enum Of {
    /// Schema of case files
    Case,
    /// Schema of sweep files
    Sweep,
}

pub fn schema(arguments: &SchemaArguments) -> Result<(), Failure> {
    standard_output::print(match arguments.of {
        Of::Case => CASE_SCHEMA,
        Of::Sweep => SWEEP_SCHEMA,
    })
}
