//! One rule decides which effects matter, so that no face shows a collision as elastic that a warning calls something else:
//! every warning of physics belongs to an effect that matters, over all pairs of library materials.

use fem_case::library::materials;
use fem_case::schema::{BodyTable, ModelTable};
use fem_case::{Case, CaseFile};
use fem_collision::QuantityOfInterest;
use fem_simulation::Simulation;
use fem_simulation::results::Status;

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
    ("damping", &["material loss"]),
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
) -> fem_simulation::Summary {
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

/// Status, error bar and warnings agree: a bound has no model-form error and a warning of what is missing; where yield or
/// adhesion would take a tenth of the restitution and the run lacks it, it is no computed number without an error bar.
fn check_numbers(of: &str, summary: &fem_simulation::Summary) {
    for quantity in QuantityOfInterest::ALL {
        let (status, parts) = (summary.status.of(quantity), summary.uncertainty.of(quantity));
        let number = summary.collision.number(quantity);
        assert_eq!(status, Status::of(number, parts.model), "{of}: {quantity:?}");
        assert!(parts.bound.is_none() || status == Status::Bound, "{of}: {quantity:?}");
    }
    let parts = summary.uncertainty.of(QuantityOfInterest::Restitution);
    let is_decided = summary.effects.iter().any(|it| {
        let change = it.error_if_left_out.and_then(|change| change.restitution);
        let names = ["plastic flow", "adhesion"];
        names.contains(&it.decision.name) && !it.decision.active && change > Some(0.1)
    });
    assert!(!is_decided || parts.model.is_none_or(|error| error > 0.1), "{of}: {parts:?}");
    let words = ["damping", "relaxes", "yields", "stick", "plastic flow", "contact radius"];
    let is_told = |it: &String| words.iter().any(|word| it.contains(word));
    assert!(parts.bound.is_none() || summary.warnings.iter().any(is_told), "{of}");
}

fn check(of: &str, summary: &fem_simulation::Summary) {
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
    let is_told = summary.warnings.iter().any(|warning| warning.contains("yields from"));
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
