//! Rules for all texts of the program, wherever they are in its sources.

use std::path::PathBuf;

use crate::workspace_structure::{root, sources};

/// Returns the sources of all crates with their paths, without the tests in them.
fn crates() -> Vec<(PathBuf, String)> {
    let is_product = |path: &PathBuf| path.to_string_lossy().contains("/src/");
    let all = sources(root().join("crates")).into_iter().filter(|(path, _)| is_product(path));
    let code = |text: String| text.split("#[cfg(test)]").next().unwrap_or_default().to_string();
    all.map(|(path, text)| (path, code(text))).collect()
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
    let (mut n, mut faults) = (0, Vec::new());
    let echoes =
        ["fem-case/", "fem-material/", "fem-contact/", "fem-vtk/", "estimate/parameter.rs"];
    for (path, code) in crates() {
        let path = path.display().to_string();
        if !echoes.iter().any(|echo| path.contains(echo)) {
            n += code.matches("#[error(").count();
            faults.extend(unrounded_fields(&code).iter().map(|it| format!("{path}: {it}")));
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
    let crates = crates();
    let mut faults = Vec::new();
    for (path, code) in &crates {
        let found = exponents_before_units(code).into_iter();
        faults.extend(found.map(|found| format!("{}: {found}", path.display())));
    }
    assert!(crates.len() > 100, "{} sources", crates.len());
    assert!(faults.is_empty(), "{}", faults.join("\n"));
}
