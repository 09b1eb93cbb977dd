//! The shipped schemas are those of the structs that read the files.

use std::{env, fs};

use fem_case::json_schema::{of_cases, of_sweeps};

/// With `UPDATE=1` in the environment the test writes the files instead.
#[test]
fn shipped_schemas_are_current() {
    for (name, schema) in [("case", of_cases()), ("sweep", of_sweeps())] {
        let path = format!("{}/schemas/{name}.json", env!("CARGO_MANIFEST_DIR"));
        let text = format!("{schema:#}\n");
        if env::var_os("UPDATE").is_some() {
            fs::write(&path, &text).unwrap();
        }
        let is_current = fs::read_to_string(&path).is_ok_and(|shipped| shipped == text);
        assert!(is_current, "UPDATE=1 cargo test -p fem-case --features schema writes {path}");
    }
}
