//! The case of a result as a list of keys, and the keys in which cases differ.

use serde_json::Value;

/// Returns all keys of a case by their dotted paths, with their values.
pub fn keys(value: &Value) -> Vec<(String, String)> {
    let mut keys = Vec::new();
    flatten("", value, &mut keys);
    keys
}

fn flatten(path: &str, value: &Value, keys: &mut Vec<(String, String)>) {
    let join = |key: &str| if path.is_empty() { key.to_string() } else { format!("{path}.{key}") };
    match value {
        Value::Object(map) if !map.is_empty() => {
            map.iter().for_each(|(key, value)| flatten(&join(key), value, keys));
        }
        Value::Array(list) if list.iter().any(Value::is_object) => {
            let items = list.iter().enumerate();
            items.for_each(|(k, value)| flatten(&join(&k.to_string()), value, keys));
        }
        _ => keys.push((path.to_string(), value.to_string())),
    }
}

/// Returns the keys whose values differ between cases, with the values; a case without the key has a blank.
pub fn differences(cases: &[&Value]) -> Vec<(String, Vec<String>)> {
    let all: Vec<Vec<(String, String)>> = cases.iter().map(|case| keys(case)).collect();
    let mut paths: Vec<&String> = Vec::new();
    for (path, _) in all.iter().flatten() {
        if !paths.contains(&path) {
            paths.push(path);
        }
    }
    let value = |case: &[(String, String)], path: &str| {
        let found = case.iter().find(|(known, _)| known == path);
        found.map_or(String::new(), |(_, value)| value.clone())
    };
    let row = |path: &String| (path.clone(), all.iter().map(|case| value(case, path)).collect());
    let rows = paths.into_iter().map(row);
    let differ = |values: &[String]| values.iter().any(|value| *value != values[0]);
    let rows = rows.filter(|(_, values): &(String, Vec<String>)| differ(values));
    rows.map(|(path, values)| {
        let short: Vec<String> = values.iter().map(|value| shortened(value)).collect();
        let values = if differ(&short) { short } else { values };
        (path, values)
    })
    .collect()
}

/// Returns six digits of a computed number, and any other value unchanged.
fn shortened(value: &str) -> String {
    let digits = value.chars().filter(char::is_ascii_digit).count();
    match value.parse::<f64>() {
        Ok(number) if digits > 8 => {
            let rounded = format!("{number:.5e}").parse().unwrap_or(number);
            fem_figure::tick(rounded)
        }
        _ => value.to_string(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Six digits are shown, unless the values differ only beyond them.
    #[test]
    fn computed_numbers_are_short() {
        let of = |size: f64| serde_json::json!({ "size": size });
        let row = |a: f64, b: f64| differences(&[&of(a), &of(b)]).remove(0).1;
        assert_eq!(row(0.0000557680508041031, 0.02), ["5.57681e-5", "0.02"]);
        assert_eq!(row(0.123456789, 0.123456788), ["0.123456789", "0.123456788"]);
    }

    #[test]
    fn differing_keys_are_found() {
        let one = serde_json::json!({"title": "a", "body": [{"v": 1.0}, {"v": 2.0}], "x": [1, 2]});
        let other = serde_json::json!({"title": "a", "body": [{"v": 1.0}, {"v": 3.0}], "y": {}});
        let expected = [("body.1.v", ["2.0", "3.0"]), ("x", ["[1,2]", ""]), ("y", ["", "{}"])];
        let expected =
            expected.map(|(path, values)| (path.to_string(), values.map(String::from).to_vec()));
        assert_eq!(differences(&[&one, &other]), expected);
    }
}
