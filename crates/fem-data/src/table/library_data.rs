//! Measured restitutions of the materials library as a table: `lib:ice`, or `lib:ice/hatzes-1988` for one of several.

use fem_case::library::{MeasuredRestitution, find, materials, nearest_to};

use super::csv_table::Table;
use super::data_error::DataError;

/// The prefix of data from the library.
const PREFIX: &str = "lib:";

/// Returns whether data are named in the library and not in a file.
pub fn is_of_library(name: &str) -> bool {
    name.starts_with(PREFIX)
}

/// Returns the points of a measurement of the library as a table, and a note on what they are. The scatter of the source is
/// the uncertainty of each point.
///
/// # Errors
/// The library has no such material or measurement.
///
/// ```
/// let (table, note) = fem_data::table::library_table("lib:ice")?;
/// assert_eq!((table.name(), table.n_rows()), ("lib:ice/bridges-1984", 12));
/// assert!(note.contains("0.32 (v / 1 cm/s)^-0.234"));
/// # Ok::<(), fem_data::table::DataError>(())
/// ```
pub fn library_table(name: &str) -> Result<(Table, String), DataError> {
    let bare = name.strip_prefix(PREFIX).unwrap_or(name);
    let (material, wanted) = bare.split_once('/').map_or((bare, None), |(m, w)| (m, Some(w)));
    let (material, all) =
        find(material).map_or((material, &[][..]), |(known, entry)| (known, &entry.measured[..]));
    let is_wanted = |it: &&MeasuredRestitution| wanted.is_none_or(|wanted| it.name == wanted);
    let Some(found) = all.iter().find(is_wanted) else {
        return Err(unknown(name, material, all));
    };
    let scatter = found.scatter();
    let mut text = "speed_m_s,restitution".to_string();
    text += if scatter.is_some() { ",restitution_uncertainty\n" } else { "\n" };
    let points = found.points();
    for (speed, restitution) in &points {
        let uncertainty = scatter.map_or(String::new(), |scatter| format!(",{scatter:?}"));
        text += &format!("{speed:?},{restitution:?}{uncertainty}\n");
    }
    let table = Table::parse(&format!("{PREFIX}{material}/{}", found.name), &text)?;
    let weights = match scatter {
        Some(scatter) => format!("its scatter of {scatter} is the uncertainty of each"),
        None => "its source gives no scatter, so all count alike".to_string(),
    };
    let others: Vec<&str> =
        all.iter().filter(|it| it.name != found.name).map(|it| it.name.as_str()).collect();
    let others = match others.is_empty() || wanted.is_some() {
        true => String::new(),
        false => format!("; other measurements: {}", others.join(", ")),
    };
    let n = match points.len() {
        1 => "1 point".to_string(),
        n => format!("{n} points in equal ratios of speed"),
    };
    let note = format!("{}: {n} of {}; {weights}{others}", table.name(), found.law_text());
    Ok((table, note))
}

fn unknown(name: &str, material: &str, all: &[MeasuredRestitution]) -> DataError {
    if let [first, ..] = all {
        let names: Vec<&str> = all.iter().map(|it| it.name.as_str()).collect();
        return DataError::new(name, format!("the library has no such measurement of {material}"))
            .with_help(format!("it has {}: {PREFIX}{material}/{}", names.join(", "), first.name));
    }
    let has_data = materials().iter().filter(|(_, entry)| !entry.measured.is_empty());
    let names: Vec<String> = has_data.map(|(known, _)| format!("{PREFIX}{known}")).collect();
    let near = nearest_to(material).map(|near| format!("{PREFIX}{near}"));
    let near = near.filter(|near| names.contains(near));
    let near = near.map_or(String::new(), |near| format!("did you mean {near}? "));
    DataError::new(name, "the library has no measured restitutions of this name").with_help(
        format!("{near}it has some for {}; any other name is that of a CSV file", names.join(", ")),
    )
}
