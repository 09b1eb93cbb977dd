//! `fem-run materials`: the library of materials, and one of them as a case has it.

use fem_case::CaseFile;
use fem_case::engineering::number;
use fem_case::library::{Material, find, materials, nearest_to, table_text};
use fem_case::schema::BodyTable;
use fem_case::{Case, CaseError};

use crate::text::{Failure, headed, standard_output, wrapped, wrapped_at};

/// List the materials of the library, or print one of them
///
/// A case names them as material = "lib:NAME". One material is printed as the table of a case, with its source and its range of validity, to be copied
/// into a case and changed there. A case with material = "lib:NAME" needs no table.
#[derive(clap::Args, Debug)]
pub struct Arguments {
    /// A material of the list
    name: Option<String>,
    /// List density, moduli and the whole name of each material
    #[arg(long, short)]
    verbose: bool,
}

pub fn execute(arguments: &Arguments) -> Result<(), Failure> {
    match &arguments.name {
        None => standard_output::print(&list(arguments.verbose)?),
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
    let comment = |text: &str| wrapped_at(80, "# ", &format!("# {text}"));
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

/// Returns the list, short or with all properties.
fn list(is_whole: bool) -> Result<String, CaseError> {
    /// Columns of the short list.
    const N_COLUMNS: usize = 3;
    let mut rows = Vec::new();
    for (name, entry) in materials() {
        let floor = BodyTable::wall("floor");
        let ball = BodyTable::sphere("ball", 0.01, format!("lib:{name}")).approaching(1.0);
        let case = Case::of(CaseFile::of_bodies(floor, ball))?;
        let Some(material) = case.scene().bodies()[1].material() else { continue };
        let moduli = material.instantaneous();
        rows.push([
            name.clone(),
            number(moduli.youngs_modulus() / 1e9, 3),
            format!("{:.3}", moduli.poissons_ratio()),
            number(material.density(), 5),
            entry.title.clone(),
        ]);
    }
    let list = if is_whole {
        headed("name|>E/GPa|>Poisson's|>kg/m^3|", rows)
    } else {
        let n_rows = rows.len().div_ceil(N_COLUMNS);
        let cells = |k: usize| {
            let places = (k..rows.len()).step_by(n_rows);
            places.flat_map(|place| rows[place][..2].to_vec()).collect::<Vec<_>>()
        };
        headed(&["name|>E/GPa"; N_COLUMNS].join("|"), (0..n_rows).map(cells))
    };
    let named = |is_meant: fn(&Material) -> bool| {
        let meant = materials().iter().filter(|(_, entry)| is_meant(entry));
        meant.map(|(name, _)| name.as_str()).collect::<Vec<_>>().join(", ")
    };
    let relaxing =
        wrapped(&format!("Relaxing: {}", named(|entry| entry.material.relaxation.is_some())));
    let measured = named(|entry| !entry.measured.is_empty());
    let more = if is_whole { "" } else { "All properties: fem-run materials -v\n" };
    Ok(format!(
        "{list}\n{relaxing}\nWith measured restitutions: {measured}\n\
         In a case: material = \"lib:NAME\". Source and range: fem-run materials NAME\n{more}"
    ))
}
