//! Rules for all texts of the program, wherever they are in its sources.

use std::fs;
use std::path::{Path, PathBuf};

/// Returns the sources of a crate, without the tests in them.
fn sources(folder: &Path) -> Vec<(PathBuf, String)> {
    let mut found = Vec::new();
    for entry in fs::read_dir(folder).expect("a folder of sources").flatten() {
        let path = entry.path();
        if path.is_dir() {
            found.extend(sources(&path));
        } else if path.extension().is_some_and(|end| end == "rs") {
            let text = fs::read_to_string(&path).expect("a source");
            let code = text.split("#[cfg(test)]").next().unwrap_or_default().to_string();
            found.push((path, code));
        }
    }
    found
}

/// Returns formats of numbers like `2.79e-5 m`: an exponent before a unit that takes a prefix.
fn exponents_before_units(text: &str) -> Vec<&str> {
    const UNITS: [&str; 10] = ["m", "s", "m/s", "Pa", "N", "J", "kg", "Hz", "bytes", "V"];
    let after = text.match_indices("e} ").filter(|(end, _)| {
        let format = text[..*end].rsplit('{').next().unwrap_or_default();
        format.split_once(':').is_some_and(|(_, digits)| {
            digits.chars().all(|c| c.is_ascii_digit() || ['.', '+'].contains(&c))
        })
    });
    after
        .filter_map(|(end, found)| {
            let rest = text[end + found.len()..].trim_start_matches(['\\', '\n', ' ']);
            let word = rest.split(|c: char| !c.is_ascii_alphabetic() && c != '/').next()?;
            UNITS.contains(&word).then(|| &text[text[..end].rfind('{').unwrap_or(0)..end + 2])
        })
        .collect()
}

/// Returns the fields of errors that their messages show with all digits of an `f64`: `{value:?}`, or `{0}` of `Growth(f64)`.
fn unrounded_fields(code: &str) -> Vec<&str> {
    let variants = code.split("#[error(").skip(1);
    variants
        .flat_map(|variant| {
            let (message, fields) = variant.split_once(")]\n").unwrap_or((variant, ""));
            let named = fields.match_indices(": f64").map(|(at, _)| &fields[..at]);
            let named = named.filter_map(|before| before.split([' ', '\n', '{']).next_back());
            let first = fields.lines().next().unwrap_or_default().contains("(f64").then_some("0");
            named.chain(first).filter(move |name| {
                let is_shown = [format!("{{{name}}}"), format!("{{{name}:?}}")];
                is_shown.iter().any(|shown| message.contains(shown))
                    && !message.contains(&format!("{name} = "))
            })
        })
        .collect()
}

/// An error shows a computed number with the digits that people read. Errors about input show what the user wrote.
#[test]
fn no_error_shows_all_digits_of_a_number() {
    let example = "#[error(\"{a} {b:?} {c}\", c = number(*c, 5))]\nOne { a: &str, b: f64, c: f64 },\n#[error(\"{0}\")]\nTwo(f64)";
    assert_eq!(unrounded_fields(example), ["b", "0"]);
    let crates = Path::new(env!("CARGO_MANIFEST_DIR")).with_file_name("");
    let (mut n, mut faults) = (0, Vec::new());
    for own in fs::read_dir(crates).expect("crates").flatten() {
        if ["fem-case", "fem-material", "fem-contact", "fem-vtk"]
            .iter()
            .any(|echoes| own.file_name() == *echoes)
        {
            continue;
        }
        let sources = sources(&own.path().join("src")).into_iter();
        for (path, code) in sources.filter(|it| !it.0.ends_with("estimate/parameter.rs")) {
            n += code.matches("#[error(").count();
            faults.extend(
                unrounded_fields(&code).iter().map(|it| format!("{}: {it}", path.display())),
            );
        }
    }
    assert!(n > 100, "{n} errors");
    assert!(faults.is_empty(), "{}", faults.join("\n"));
}

/// People read 27.9 µm, not 2.79e-5 m; `engineering::show` sets the prefixes. Input of other codes and
/// arguments of studies have no text around the number.
#[test]
fn no_text_has_an_exponent_before_a_unit() {
    assert_eq!(
        exponents_before_units("{size:.2e} m in place of {:.2e} m"),
        ["{size:.2e}", "{:.2e}"]
    );
    assert!(exponents_before_units("{x:.1e} element updates, {name} m, {e} m").is_empty());
    let mut faults = Vec::new();
    let crates = Path::new(env!("CARGO_MANIFEST_DIR")).with_file_name("");
    let mut n = 0;
    for own in fs::read_dir(crates).expect("crates").flatten() {
        for (path, code) in sources(&own.path().join("src")) {
            n += 1;
            for found in exponents_before_units(&code) {
                faults.push(format!("{}: {found}", path.display()));
            }
        }
    }
    assert!(n > 100, "{n} sources");
    assert!(faults.is_empty(), "{}", faults.join("\n"));
}
