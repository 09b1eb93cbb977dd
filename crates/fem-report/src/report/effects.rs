//! Effects in plain words.

use fem_case::engineering::show;
use serde_json::Value;

use super::cards::rounded;
use super::record::Record;

/// What an effect is, said once and without a number.
const WORDS: [(&str, &str); 16] = [
    (
        "viscoelasticity",
        "A material that relaxes while it is squeezed gives back less than it took.",
    ),
    ("finite strain", "Where strains are not small, the changed shapes change the forces."),
    ("surface slip", "Unlike surfaces slide on each other as they spread."),
    ("plastic yield", "Beyond its strength a material flows; that is not computed."),
    ("partner waves", "Waves that do not come back from a large body in time take energy along."),
    ("mirror symmetry", "Of two like bodies one is computed, against a plane."),
    ("rigid partner", "A partner that hardly gives way is taken as rigid."),
    ("hourglass control", "Elements with one stress each get the stiffness that they lack."),
    ("bulk viscosity", "Steep fronts of fast impacts are spread over some elements."),
    ("gravity", "Weight acts before, during and after the contact."),
    ("contact search", "Contact is looked for as far out as it can reach."),
    ("mass scaling", "Mass is moved to the lightest nodes, for longer steps."),
    ("dashpot", "The law's damper resists the speed of the approach and takes energy."),
    ("finite size", "A sphere gives way as a whole, too, not at its contact alone."),
    ("vibration", "What is struck goes on ringing, and keeps that energy."),
    ("penalty springs", "Springs between the surfaces keep them apart, and give way a little."),
];

/// An effect of a result.
pub struct Effect {
    pub name: String,
    pub is_on: bool,
    pub words: &'static str,
    pub reason: String,
    /// By how much numbers change without it.
    pub worth: String,
}

/// Effects of the numbers alone.
const NUMERICAL: [&str; 5] =
    ["contact search", "mass scaling", "hourglass control", "mirror symmetry", "bulk viscosity"];

/// Those that are on, those of the numbers alone that are, and those that are off.
pub fn effects(record: &Record) -> [Vec<Effect>; 3] {
    let effect = |value: &Value| {
        let text = |key: &str| value.get(key).and_then(Value::as_str).unwrap_or_default();
        let name = text("name").to_string();
        let words = WORDS.iter().find(|(known, _)| *known == name).map_or("", |(_, words)| words);
        let is_on = value.get("active").and_then(Value::as_bool).unwrap_or(false);
        let worth = value.get("error_if_left_out").map(worth).unwrap_or_default();
        Effect { name, is_on, words, reason: text("reason").to_string(), worth }
    };
    let (on, off): (Vec<Effect>, Vec<Effect>) =
        record.list("effects").iter().map(effect).partition(|effect| effect.is_on);
    let is_physical = |effect: &Effect| !NUMERICAL.contains(&effect.name.as_str());
    let (physical, numerical) = on.into_iter().partition(is_physical);
    [physical, numerical, off]
}

/// `e by 0.072, T by 0.39 µs, F by 3.5 N`; nothing of what changes nothing.
fn worth(left_out: &Value) -> String {
    let number = |key: &str| left_out.get(key).and_then(Value::as_f64).filter(|size| *size != 0.0);
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
