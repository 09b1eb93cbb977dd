//! Labels of the axes and curves of a sweep's figure.

/// Keys and their names with symbols.
const ROLES: [(&str, &str); 13] = [
    ("approach_speed", "impact speed v"),
    ("impact_angle", "impact angle θ"),
    ("diameter", "diameter D"),
    ("density", "density ρ"),
    ("youngs_modulus", "Young's modulus E"),
    ("shear_modulus", "shear modulus G"),
    ("bulk_modulus", "bulk modulus K"),
    ("poissons_ratio", "Poisson's ratio ν"),
    ("weight", "relaxation weight g"),
    ("decay_rate", "decay rate β"),
    ("relaxation_time", "relaxation time τ"),
    ("contact_element_size", "element size h"),
    ("penalty_factor", "penalty factor f"),
];

/// Returns the name of a key with its owner and symbol: `diameter of body 2 D`.
pub fn role(key: &str) -> String {
    let parts: Vec<&str> = key.split('.').collect();
    let last = parts.last().copied().unwrap_or_default();
    let owner = match parts.as_slice() {
        ["body", number, ..] => match number.parse::<usize>() {
            Ok(number) => format!(" of body {}", number + 1),
            Err(_) => String::new(),
        },
        ["material", name, ..] => format!(" of {name}"),
        _ => String::new(),
    };
    let role = ROLES.iter().find(|(known, _)| *known == last).map(|(_, role)| *role);
    match role {
        Some(role) if last == "approach_speed" => role.to_string(),
        Some(role) => match role.rsplit_once(' ') {
            // The symbol stays last: "diameter of body 1 D".
            Some((words, symbol)) => format!("{words}{owner} {symbol}"),
            None => format!("{role}{owner}"),
        },
        None => format!("{}{owner}", last.replace('_', " ")),
    }
}

/// Returns the name of linked keys, without an owner.
pub fn role_of_all(key: &str) -> String {
    let last = key.rsplit('.').next().unwrap_or(key);
    role(last)
}

/// Returns the symbol of a key; the last part of the key if it has no symbol.
pub fn key_symbol(key: &str) -> String {
    let last = key.rsplit('.').next().unwrap_or(key);
    let role = ROLES.iter().find(|(known, _)| *known == last).map(|(_, role)| *role);
    let symbol = role.and_then(|role| role.rsplit_once(' ')).map(|(_, symbol)| symbol);
    symbol.map_or_else(|| last.replace('_', " "), String::from)
}

/// Returns a value in short form: a table that contains only a name becomes that name, and
/// `{ law = { tsuji = { alpha = 1 } } }` becomes `tsuji (alpha = 1)`.
pub fn plain(value: &str) -> String {
    let Some(inner) = value.trim().strip_prefix('{').and_then(|rest| rest.strip_suffix('}')) else {
        return value.trim().to_string();
    };
    let inner = inner.trim();
    match inner.strip_prefix("law").map(|rest| rest.trim_start().trim_start_matches('=')) {
        Some(law) if law.trim_start().starts_with('{') => plain(law),
        _ => {
            let apart = inner.replace(['"', '\''], "").replace('=', " = ");
            let apart = apart.replace('{', " { ").replace('}', " } ");
            let words = apart.split_whitespace().collect::<Vec<_>>().join(" ");
            words.replace(" = { }", "").replace("= { ", "(").replace(" }", ")")
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn keys_have_the_names_of_their_roles() {
        for (key, expected) in [
            ("body.0.approach_speed", "impact speed v"),
            ("body.1.sphere.diameter", "diameter of body 2 D"),
            ("material.glass.youngs_modulus", "Young's modulus of glass E"),
            ("mesh.contact_element_size", "element size h"),
            ("time.step_factor", "step factor"),
        ] {
            assert_eq!(role(key), expected);
        }
    }

    #[test]
    fn curves_have_short_names() {
        assert_eq!(key_symbol("body.0.approach_speed"), "v");
        assert_eq!(key_symbol("body.1.sphere.diameter"), "D");
        assert_eq!(key_symbol("time.step_factor"), "step factor");
        for (value, expected) in [
            ("10 mm", "10 mm"),
            ("{ ting = {} }", "ting"),
            ("{condensed={}}", "condensed"),
            ("{ting={finite_size=true}}", "ting (finite_size = true)"),
            ("{ ting = { finite_size = true } }", "ting (finite_size = true)"),
            ("{ law = { kuwabara_kono = { a = \"1e-6 s\" } } }", "kuwabara_kono (a = 1e-6 s)"),
        ] {
            assert_eq!(plain(value), expected);
        }
    }
}
