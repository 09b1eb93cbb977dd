//! The effects of a result: which are on, which are off, and why.

use fem_case::engineering::show;
use serde_json::Value;

use super::stored_result::StoredResult;
use crate::number_text::rounded;

/// Explanation of each effect in one sentence.
const EXPLANATIONS: [(&str, &str); 16] = [
    (
        "viscoelasticity",
        "The material relaxes while it is compressed and gives back less energy than it took.",
    ),
    ("finite strain", "At large strains the change of shape changes stiffness and contact."),
    ("surface slip", "Surfaces of unlike materials slide on each other as they deform."),
    ("plastic yield", "Above its strength a material flows plastically; that is not computed."),
    ("partner waves", "Waves that do not return from a large body in time carry energy away."),
    ("mirror symmetry", "Two equal bodies are computed as one body against a plane."),
    ("rigid partner", "A much stiffer partner is treated as rigid."),
    ("hourglass control", "Elements with one stress point get the stiffness that they lack."),
    ("bulk viscosity", "Steep wave fronts of fast impacts are spread over a few elements."),
    ("gravity", "Weight acts before, during and after the contact."),
    ("contact search", "Contact is searched for as far out as it can reach."),
    ("mass scaling", "Mass is moved to the lightest nodes, which allows longer time steps."),
    ("dashpot", "The law's dashpot resists the approach and dissipates energy."),
    ("finite size", "A sphere also deforms as a whole, not only at its contact."),
    ("vibration", "A struck body keeps vibrating and retains that energy."),
    ("penalty springs", "Penalty springs keep the surfaces apart and are slightly compliant."),
];

/// An effect of a result.
pub struct EffectEntry {
    pub name: String,
    pub is_on: bool,
    pub explanation: &'static str,
    pub reason: String,
    /// The change of the results without it.
    pub neglect_error: String,
}

/// Effects of the numerical method, which are not physics.
const NUMERICAL: [&str; 5] =
    ["contact search", "mass scaling", "hourglass control", "mirror symmetry", "bulk viscosity"];

/// Returns the physical effects that are on, the numerical ones that are on, and those that are off.
pub fn effects(result: &StoredResult) -> [Vec<EffectEntry>; 3] {
    let effect = |value: &Value| {
        let text = |key: &str| value.get(key).and_then(Value::as_str).unwrap_or_default();
        let name = text("name").to_string();
        let explanation =
            EXPLANATIONS.iter().find(|(known, _)| *known == name).map_or("", |(_, text)| text);
        let is_on = value.get("active").and_then(Value::as_bool).unwrap_or(false);
        let neglect_error = value.get("error_if_left_out").map(neglect_error).unwrap_or_default();
        EffectEntry { name, is_on, explanation, reason: text("reason").to_string(), neglect_error }
    };
    let (on, off): (Vec<EffectEntry>, Vec<EffectEntry>) =
        result.list("effects").iter().map(effect).partition(|effect| effect.is_on);
    let is_physical = |effect: &EffectEntry| !NUMERICAL.contains(&effect.name.as_str());
    let (physical, numerical) = on.into_iter().partition(is_physical);
    [physical, numerical, off]
}

/// Returns `e by 0.072, T by 0.39 µs, F by 3.5 N`, without what does not change.
fn neglect_error(neglect_error: &Value) -> String {
    let number =
        |key: &str| neglect_error.get(key).and_then(Value::as_f64).filter(|size| *size != 0.0);
    let parts = [
        number("restitution").map(|size| format!("e by {}", rounded(size))),
        number("contact_time_s").map(|size| format!("T by {}", two_digits(size, "s"))),
        number("peak_force_n").map(|size| format!("F by {}", two_digits(size, "N"))),
    ];
    parts.into_iter().flatten().collect::<Vec<_>>().join(", ")
}

fn two_digits(size: f64, unit: &str) -> String {
    let rounded: f64 = format!("{size:.1e}").parse().unwrap_or(size);
    let shown = show(rounded, unit);
    match shown.split_once(' ') {
        Some((number, unit)) if number.contains('.') => {
            format!("{} {unit}", number.trim_end_matches('0').trim_end_matches('.'))
        }
        _ => shown,
    }
}
