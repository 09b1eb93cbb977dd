//! `fem-run materials`: the library of materials, and one of them as a case has it.

use fem_case::CaseFile;
use fem_case::engineering::{number, show};
use fem_case::library::{Material, find, materials, nearest_to, table_text};
use fem_case::schema::BodyTable;
use fem_case::{Case, CaseError};
use textwrap::{Options, WordSeparator, WordSplitter};

use crate::text::{Failure, headed, standard_output};

/// List the materials that a case can name as "lib:NAME", or print one of them
///
/// One material is printed as the table of a case, with its source and its range of validity, to be copied
/// into a case and changed there. A case with material = "lib:NAME" needs no table.
#[derive(clap::Args, Debug)]
pub struct Arguments {
    /// A material of the list
    name: Option<String>,
}

pub fn execute(arguments: &Arguments) -> Result<(), Failure> {
    match &arguments.name {
        None => standard_output::print(&list()?),
        Some(name) => standard_output::print(&one(name)?),
    }
}

/// Returns a material of the library as a table of a case, with source and range as comments; `lib:` before
/// the name is optional.
pub fn one(name: &str) -> Result<String, Failure> {
    let name = name.strip_prefix("lib:").unwrap_or(name);
    let found = find(name).and_then(|(name, entry)| Some((name, entry, table_text(name)?)));
    let Some((name, Material { title, source, range, measured, .. }, text)) = found else {
        let near = nearest_to(name).map_or(String::new(), |near| format!("did you mean {near}? "));
        let all: Vec<&str> = materials().keys().map(String::as_str).collect();
        let message = format!("the library has no material {name:?}");
        return Err(
            Failure::bad_input(message).with_help(format!("{near}it has {}", all.join(", ")))
        );
    };
    let width = Options::new(100).initial_indent("# ").subsequent_indent("# ");
    let width = width.word_separator(WordSeparator::AsciiSpace);
    let width = width.word_splitter(WordSplitter::NoHyphenation);
    let comment = |text: &str| textwrap::fill(text, &width);
    let lines = [title.clone(), format!("Source: {source}."), format!("Range: {range}.")];
    let mut comments: Vec<String> = lines.iter().map(|line| comment(line)).collect();
    for it in measured {
        let details = [Some(&it.bodies), it.size.as_ref(), it.temperature.as_ref()];
        let details: Vec<&str> = details.into_iter().flatten().map(String::as_str).collect();
        let (name, law) = (&it.name, it.law_text());
        comments.push(comment(&format!("Measured, {name}: {law}; {}.", details.join(", "))));
        comments.push(comment(&format!("    {}.", it.source)));
    }
    if let [first, ..] = &measured[..] {
        comments.push(comment(&format!(
            "As data: fem-run fit CASE --data lib:{name}{}.",
            match measured.len() {
                1 => String::new(),
                _ => format!(", or lib:{name}/{} for one of several", first.name),
            }
        )));
    }
    Ok(format!("{}\n{text}", comments.join("\n")))
}

fn list() -> Result<String, CaseError> {
    let mut rows = Vec::new();
    for (name, entry) in materials() {
        let floor = BodyTable::wall("floor");
        let ball = BodyTable::sphere("ball", 0.01, format!("lib:{name}")).approaching(1.0);
        let case = Case::of(CaseFile::of_bodies(floor, ball))?;
        let Some(material) = case.scene().bodies()[1].material() else { continue };
        let moduli = material.instantaneous();
        rows.push([
            name.clone(),
            format!("{} kg/m^3", number(material.density(), 5)),
            show(moduli.youngs_modulus(), "Pa"),
            format!("{:.4}", moduli.poissons_ratio()),
            if material.relaxation().is_some() { "yes" } else { "no" }.to_string(),
            if entry.measured.is_empty() { "no" } else { "yes" }.to_string(),
            entry.title.clone(),
        ]);
    }
    let list = headed("name|>density|>Young's|>Poisson's|relaxes|measured|what", rows);
    Ok(format!(
        "{list}\nIn a case: material = \"lib:NAME\". Source and range: fem-run materials NAME\n"
    ))
}
