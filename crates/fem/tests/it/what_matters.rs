//! One rule decides which effects matter, so that no face shows a collision as elastic that a warning calls something else:
//! every warning of physics belongs to an effect that matters, over all pairs of library materials.

use fem::Simulation;
use fem_case::library::materials;
use fem_case::schema::{BodyTable, ModelTable};
use fem_case::{Case, CaseFile};
use fem_collision::QuantityOfInterest;

const SPEEDS: [&str; 4] = ["1 cm/s", "10 cm/s", "1 m/s", "10 m/s"];
/// Longest warning that is read in one look.
const MAX_LENGTH: usize = 230;

/// Words of warnings, and the effects of which one must matter where a warning has the word.
const OF_WORDS: [(&str, &[&str]); 9] = [
    ("yields from", &["plastic flow"]),
    ("plastic flow", &["plastic flow"]),
    ("waves", &["partner waves", "vibration"]),
    ("vibrations", &["vibration"]),
    ("contact radius", &["finite strain"]),
    ("elastic law", &["finite strain"]),
    ("no relaxation for", &["material loss"]),
    ("stick", &["adhesion"]),
    ("slip", &["surface slip"]),
];

/// Returns the summary of a ball on another one of a material, or on a half-space.
fn summary(
    materials: [&str; 2],
    diameter: &str,
    on_block: bool,
    speed: &str,
    model: ModelTable,
) -> fem::Summary {
    let [lower, upper] = materials.map(|name| format!("lib:{name}"));
    let lower = match on_block {
        true => BodyTable::half_space("lower", lower),
        false => BodyTable::sphere("lower", diameter, lower),
    };
    let upper = BodyTable::sphere("upper", diameter, upper).approaching(speed);
    let mut file = CaseFile::of_bodies(lower, upper);
    file.model = Some(model);
    let simulation = Simulation::new(Case::of(file).unwrap()).unwrap();
    simulation.summary(&simulation.run(&mut ()))
}

/// Where yield or adhesion takes a tenth of the restitution, an estimate leads.
fn check_numbers(of: &str, summary: &fem::Summary) {
    let is_decided = summary.effects.iter().any(|it| {
        let change = it.error_if_left_out.and_then(|change| change.restitution);
        ["plastic flow", "adhesion"].contains(&it.decision.name) && change > Some(0.1)
    });
    let sticks = summary.warnings.iter().any(|warning| warning.contains("the bodies would stick"));
    assert!(summary.estimate.is_some() || !is_decided && !sticks, "{of}: {:?}", summary.warnings);
    let Some(estimate) = &summary.estimate else { return };
    let matters = |it: &fem::results::EffectSummary| {
        it.decision.name == estimate.effect && it.decision.matters && !it.decision.active
    };
    assert!(summary.effects.iter().any(matters), "{of}: {}", estimate.effect);
    for quantity in QuantityOfInterest::ALL {
        let Some([low, high]) = estimate.range(quantity) else { continue };
        assert!(0.0 <= low && low <= high, "{of}: {quantity:?}: {low:e} to {high:e}");
    }
    let [low, high] = estimate.range(QuantityOfInterest::Restitution).unwrap();
    assert!(low + high < 1.9 && high <= 1.0, "{of}: {low} to {high}");
    // The warning of the effect that decides comes first.
    let first = &summary.warnings.iter().find(|it| !it.contains("the diameter")).unwrap();
    let word = if estimate.effect == "adhesion" { "stick" } else { "plastic flow" };
    assert!(first.contains(word), "{of}: {:?}", summary.warnings);
}

fn check(of: &str, summary: &fem::Summary) {
    check_numbers(of, summary);
    let matters = |name: &str| {
        summary.effects.iter().any(|it| it.decision.name == name && it.decision.matters)
    };
    for (k, warning) in summary.warnings.iter().enumerate() {
        assert!(
            warning.chars().count() <= MAX_LENGTH,
            "{of}: {}: {warning}",
            warning.chars().count()
        );
        assert!(!summary.warnings[..k].contains(warning), "{of}: twice: {warning}");
        for (word, names) in OF_WORDS.iter().filter(|(word, _)| warning.contains(word)) {
            assert!(names.iter().any(|name| matters(name)), "{of}: {word}: {warning}");
        }
    }
    // What changes the result most is warned of, if the user can change it.
    let is_told = summary.warnings.iter().any(|warning| warning.contains("plastic flow"));
    assert!(!matters("plastic flow") || is_told, "{of}: {:?}", summary.warnings);
}

/// Over all pairs by Hertz' theory, and by Ting's for a material that relaxes, on a sphere and on a block of its own.
#[test]
fn effects_that_are_warned_of_matter() {
    let names: Vec<&str> = materials().keys().map(String::as_str).collect();
    let relaxes = |name: &str| materials()[name].material.relaxation.is_some();
    let check_at = |speed: &str| {
        for (k, first) in names.iter().enumerate() {
            for second in &names[k..] {
                let of = format!("{first}, {second}, {speed}");
                check(&of, &summary([first, second], "10 mm", false, speed, ModelTable::hertz()));
            }
            check(
                &format!("dust of {first}, {speed}"),
                &summary([first, first], "2 um", false, speed, ModelTable::hertz()),
            );
            let model = if relaxes(first) { ModelTable::ting() } else { ModelTable::hertz() };
            check(
                &format!("{first}, block, {speed}"),
                &summary([first, first], "10 mm", true, speed, model),
            );
        }
    };
    std::thread::scope(|scope| {
        let threads = SPEEDS.map(|speed| scope.spawn(move || check_at(speed)));
        threads.into_iter().for_each(|thread| thread.join().unwrap());
    });
}
