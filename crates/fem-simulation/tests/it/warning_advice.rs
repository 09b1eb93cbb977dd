//! Advice of warnings: each advised change is parsed from the warning and made in the case. The warning then disappears or
//! its number becomes smaller, and no warning of the same cause replaces it.
//!
//! Advice after stops and rejections is tested in `stop_advice.rs`, on an energy residual and on limits in
//! `failure_messages.rs`.

use fem_simulation::{Simulation, WarningKinds};

use crate::scene::{ELASTIC_GLASS as GLASS, SOFT_SPHERE as SOFT, simulation_of};

const CONDENSED: &str = "model={condensed={}}";
const RUBBER: &str =
    "material.rubber={density=1100, youngs_modulus='1.5 MPa', poissons_ratio=0.49}";

const STEEL: &str = "material.glass={density=7850, youngs_modulus='210 GPa', poissons_ratio=0.3}";

const EARLY: &str =
    "material.glass.relaxation={acts_on='all', terms=[{weight=0.99, relaxation_time='0.3 us'}]}";
const FALLING: &str = "gravity={acceleration=9.81}";
const BLOCK: &str = "body.0={name='block', half_space={}, material='glass'}";
const HELD: &str =
    "body.0={name='floor', sphere={diameter='22.2 mm'}, material='glass', held=true}";

/// A case, its overrides, words of the warning, and the number of changes that the warning advises.
type Row = (&'static str, &'static [&'static str], &'static str, usize);

const ROWS: [Row; 32] = [
    (
        GLASS,
        &[
            "contact.method='penalty'",
            "contact.penalty_factor=30",
            "mesh.contact_element_size='40 um'",
        ],
        "scatters",
        1,
    ),
    (GLASS, &["contact.penalty_factor=0.02", "mesh.contact_element_size='60 um'"], "overlap", 1),
    (
        GLASS,
        &["contact.penalty_factor=0.02", "model={condensed={penalty_springs=true}}"],
        "overlap",
        1,
    ),
    (SOFT, &["contact.penalty_factor=30"], "scatters", 1),
    (SOFT, &["contact.penalty_factor=0.02"], "overlap", 1),
    (GLASS, &["mesh.growth=2"], "because of the mesh away", 2),
    (GLASS, &["mesh.growth=2", CONDENSED], "because of the mesh away", 2),
    (GLASS, &["mesh.refined_radius=1e-9", CONDENSED], "because of the mesh away", 2),
    (GLASS, &["mesh.contact_element_size='90 um'"], "because of the mesh", 2),
    (GLASS, &["mesh.contact_element_size='90 um'", CONDENSED], "because of the mesh", 2),
    (GLASS, &["mesh.contact_element_size='1 mm'"], "spans only", 2),
    (GLASS, &["mesh.contact_element_size='1 mm'", CONDENSED], "spans only", 2),
    (GLASS, &["mesh.contact_element_size='55 um'"], "because of the mesh", 2),
    (GLASS, &["time.mass_scaling=0.1"], "mass scaling moves", 1),
    (GLASS, &["time.mass_scaling=0.1"], "because of mass scaling", 2),
    (GLASS, &["accuracy.tolerance=1e-5", CONDENSED], "cannot be met", 1),
    (
        GLASS,
        &["accuracy.tolerance=1e-5", "mesh.contact_element_size='30 um'", CONDENSED],
        "on any mesh",
        1,
    ),
    (GLASS, &[CONDENSED, "body.0.approach_speed=20"], "inertia", 2),
    (GLASS, &[CONDENSED, "body.0.approach_speed=100"], "steep fronts", 1),
    (GLASS, &["model={condensed={vibration_modes=100}}"], "modes of vibration asked", 1),
    (GLASS, &[CONDENSED, "material.glass.poissons_ratio=-0.99"], "the body rings", 1),
    (GLASS, &["model={ting={}}", "body.0.approach_speed=200"], "own compliance", 1),
    (
        GLASS,
        &["model={hertz={finite_size=true}}", "material.glass.poissons_ratio=-0.9999"],
        "energy balance",
        1,
    ),
    (SOFT, &[RUBBER], "elastic laws differ", 1),
    (SOFT, &["material.rubber.hyperelastic='saint-venant-kirchhoff'"], "lose its stability", 1),
    (
        GLASS,
        &["contact.penalty_factor=1e-3", "mesh.contact_element_size='60 um'"],
        "so soft that the contact lasts",
        1,
    ),
    (GLASS, &[EARLY, CONDENSED], "largest early", 1),
    (
        GLASS,
        &[BLOCK, "body.1.approach_speed='0.5 m/s'", "mesh.far_radius='2 cm'"],
        "waves that were reflected",
        1,
    ),
    (GLASS, &[CONDENSED, STEEL], "as stiff and heavy as", 2),
    (SOFT, &["limits.element_updates=4e6"], "because of the mesh", 2),
    (
        GLASS,
        &[FALLING, HELD, "body.1.approach_speed='0.5 m/s'", "mesh.contact_element_size='90 um'"],
        "because of the mesh",
        2,
    ),
    (
        GLASS,
        &[
            FALLING,
            HELD,
            "body.1.approach_speed='0.5 m/s'",
            "accuracy.tolerance.peak_force='0.05 %'",
        ],
        "mesh.staggered = true",
        2,
    ),
];

/// Returns the simulation on the last mesh and all warnings, before and after the run.
fn computed_warnings(case: &str, set: &[String]) -> (Simulation, Vec<String>) {
    let simulation = simulation_of(case, set).without_snapshots();
    let mut all = simulation.warnings_before();
    let computed = simulation.run_within_tolerance(&mut ());
    all.extend(computed.warnings());
    (computed.simulation, all)
}

/// Returns the sets of overrides that follow each advised change: keys after `write`, `set`, `use` and `name` are
/// added, keys after `leave` are removed, and keys after `smaller` are halved.
fn remedies(warning: &str, simulation: &Simulation, set: &[&str]) -> Vec<Vec<String>> {
    let own = || set.iter().map(ToString::to_string);
    let with = |more: String| own().chain([more]).collect::<Vec<_>>();
    let first = warning.split("; also missed").next().unwrap();
    let advice = first.rsplit([';', ':']).next().unwrap();

    let value = |text: &str| {
        let text = text.split(" to see").next().unwrap().split(" or less").next().unwrap();
        text.split(" or more").next().unwrap().trim().to_string()
    };
    let mut all = Vec::new();
    for way in advice.split(", or ").flat_map(|way| way.split(" or use ")).map(str::trim) {
        if let Some((one, other)) = way.strip_prefix("write ").and_then(|it| it.split_once(" and "))
        {
            all.push(own().chain([one, other].map(String::from)).collect());
        } else if let Some((key, new)) = way
            .strip_prefix("write ")
            .or(way.strip_prefix("set "))
            .and_then(|it| it.split_once(" = "))
        {
            all.push(with(format!("{key}={}", value(new))));
        } else if let Some((key, new)) =
            way.strip_prefix("use a ").and_then(|it| it.split_once(" of "))
        {
            all.push(with(format!("{key}='{}'", value(new))));
        } else if let Some(models) = way.strip_prefix("use model ").or(way.strip_prefix("model ")) {
            for model in models.split(" or ") {
                all.push(with(format!("model={{{model}={{}}}}")));
            }
        } else if let Some(key) = way.strip_prefix("leave ").and_then(|it| it.split(" out").next())
        {
            let of_set = |set: &String| {
                let is_it = key == "it" && set.starts_with("mesh.");
                !is_it && !set.starts_with(key)
            };
            all.push(own().filter(of_set).collect());
        } else if way == "lower it" {
            all.push(with("mesh.growth=1.4".to_string()));
        } else if way.contains("smaller time.mass_scaling") {
            let halved = 0.5 * simulation.case().scene().mass_scaling().unwrap();
            all.push(with(format!("time.mass_scaling={halved}")));
        } else if way.contains("smaller mesh.contact_element_size") {
            let plan = &simulation.setup().elements.as_ref().unwrap().plan;
            all.push(with(format!(
                "mesh.contact_element_size={}",
                0.5 * plan.contact_element_size
            )));
        } else if way.contains("raise accuracy.tolerance") {
            all.push(with("accuracy.tolerance=0.3".to_string()));
        } else if let Some(key) = way.strip_prefix("raise ") {
            all.push(with(format!("{key}=1e9")));
        } else if way.ends_with(".elastic = true") {
            all.push(with(way.to_string()));
        } else if way.contains("yield_strength") {
            all.push(with("material.glass.yield_strength='20 GPa'".to_string()));
        } else if way.contains("hyperelastic") {
            all.push(with("material.rubber.hyperelastic='neo-hooke'".to_string()));
        } else {
            panic!("{way:?} of {warning}");
        }
    }
    all
}

/// Returns the first percentage in a warning, or the first number.
fn number(warning: &str) -> f64 {
    let words: Vec<&str> = warning.split_whitespace().collect();
    let percentage = words.windows(2).find(|pair| pair[1].starts_with('%')).map(|pair| pair[0]);
    let numbers = percentage.into_iter().chain(words);
    numbers.filter_map(|word| word.parse().ok()).next().unwrap_or(0.0)
}

#[test]
fn advice_of_a_sample_of_warnings_silences_them() {
    follow_advice(ROWS.iter().step_by(10));
}

#[test]
#[ignore = "takes many seconds; .ci/run runs it"]
fn advice_of_every_warning_silences_it() {
    follow_advice(ROWS.iter());
}

fn follow_advice<'a>(rows: impl Iterator<Item = &'a Row>) {
    for (case, set, words, n_remedies) in rows {
        let own: Vec<String> = set.iter().map(ToString::to_string).collect();
        let (simulation, before) = computed_warnings(case, &own);
        let warning = before.iter().find(|text| text.contains(words));
        let warning = warning.unwrap_or_else(|| panic!("{set:?}: no {words}: {before:#?}"));
        let ways = remedies(warning, &simulation, set);
        assert_eq!(ways.len(), *n_remedies, "{warning}: {ways:?}");
        let mut kinds = WarningKinds::default();
        kinds.add(0, warning);
        for way in ways {
            let (_, after) = computed_warnings(case, &way);
            let still = after.iter().find(|text| kinds.all()[0].is_of(text));
            let is_better = |still: &String| match warning.contains("resolves")
                || warning.contains("spans only")
            {
                true => number(still) > number(warning),
                false => number(still) < 0.7 * number(warning),
            };
            assert!(still.is_none_or(is_better), "{warning}\n{way:?}: {still:?}");
        }
    }
}

/// One warning reports a given mesh that is too coarse, and the element size that it advises ends it.
#[test]
fn the_advised_element_size_ends_the_warning() {
    for model in ["model={fem={}}", CONDENSED] {
        for size in ["90 um", "1 mm", "75 um", "0.2 mm"] {
            let size = format!("mesh.contact_element_size='{size}'");
            let (simulation, before) = computed_warnings(GLASS, &[size.clone(), model.to_string()]);
            let of_mesh: Vec<_> =
                before.iter().filter(|text| text.contains("mesh.contact_element_size")).collect();
            let last = of_mesh.last().unwrap_or_else(|| panic!("{size}: {before:#?}"));
            let others = of_mesh.iter().filter(|text| !text.contains("spans only"));
            assert!(others.count() <= 1, "{size}: {of_mesh:#?}");
            let way = remedies(last, &simulation, &[&size, model]).remove(0);
            let (_, after) = computed_warnings(GLASS, &way);
            assert_eq!(after, [""; 0], "{last} {way:?}");
        }
    }
}
