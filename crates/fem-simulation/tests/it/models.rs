//! The table `[model]`: its values, faults and their places, overrides, and resolved cases.

use fem_case::schema::LawTable;
use fem_case::{CondensedOptions, ModelChoice};
use fem_collision::{Account, Collision};
use fem_laws::{EndRule, LawFamily, LawInput};
use fem_simulation::Simulation;

use crate::scene::{GLASS, case_of, collision_of, parse, simulation_of};

fn run(overrides: &[&str]) -> Collision {
    collision_of(GLASS, overrides)
}

fn model(value: &str) -> ModelChoice {
    let text = format!("{GLASS}\n[model]\n{value}\n");
    case_of::<&str>(&text, &[]).scene().model().clone()
}

fn law(value: &str) -> LawInput {
    match model(&format!("law = {{ {value} }}")) {
        ModelChoice::Law { law, .. } => law,
        other => panic!("{other:?}"),
    }
}

fn input(family: LawFamily, values: &[(&'static str, f64)]) -> LawInput {
    LawInput { family, values: values.to_vec() }
}

/// Asserts that the case with this `[model]` has this fault, at the place between «».
#[track_caller]
fn fault(marked: &str, message: &str, help: &str) {
    let (before, rest) = marked.split_once('«').expect("a mark");
    let (culprit, after) = rest.split_once('»').expect("the mark's end");
    let text = format!("{GLASS}\n[model]\n{before}{culprit}{after}\n");
    let made = parse::<&str>(&text, &[]).and_then(Simulation::new);
    let error = made.map(|_| ()).expect_err("a fault");
    assert!(error.message().contains(message), "{error}");
    assert!(error.help().unwrap_or("").contains(help), "{error}");
    assert_eq!(&text[error.span().unwrap()], culprit, "{error}");
    assert_eq!(error.line(), Some(text.lines().count()), "{error}");
}

#[test]
fn every_model_and_law_is_read() {
    assert_eq!(model("fem = {}"), ModelChoice::Fem);
    assert_eq!(model("condensed = {}"), ModelChoice::Condensed(CondensedOptions::default()));
    let expected = CondensedOptions { vibration_modes: 12, steps: 200, penalty_springs: true };
    let all = "condensed = { vibration_modes = 12, steps = 200, penalty_springs = true }";
    assert_eq!(model(all), ModelChoice::Condensed(expected));
    assert_eq!(model("hertz = {}"), ModelChoice::Hertz { finite_size: false });
    let ting = ModelChoice::Ting { finite_size: true, tolerance: 1e-6 };
    assert_eq!(model("ting = { finite_size = true, tolerance = 1e-6 }"), ting);
    let expected = ModelChoice::Law {
        law: input(LawFamily::KuwabaraKono, &[("a", 1e-6)]),
        end_rule: EndRule::ZeroForce,
        tolerance: 1e-8,
    };
    assert_eq!(model("law = { kuwabara_kono = { a = \"1 us\" } }"), expected);
    let expected = ModelChoice::Law {
        law: input(LawFamily::Hertz, &[]),
        end_rule: EndRule::ZeroOverlap,
        tolerance: 1e-5,
    };
    let inner = "law = { hertz = { end = \"zero_overlap\", tolerance = 1e-5 } }";
    let outer = "law = { hertz = {}, end = \"zero_overlap\", tolerance = 1e-5 }";
    assert_eq!([model(inner), model(outer)], [expected.clone(), expected]);
    let mut read = vec!["hertz"];
    for (value, expected) in [
        ("linear = { k = '10 N/um', c = '30 N s/m' }", "Linear k=1e7 c=3e1"),
        ("linear = { k = 1e7 }", "Linear k=1e7 c=0e0"),
        ("linear = { e = 0.9, contact_time = '60 us' }", "Linear e=9e-1 contact_time=6e-5"),
        ("linear = { k = 1e7, e = 0.9 }", "Linear k=1e7 e=9e-1"),
        (
            "power = { k = 3e9, gamma = 1.5, c = 1e4, n = 0.5 }",
            "Power k=3e9 gamma=1.5e0 c=1e4 n=5e-1",
        ),
        ("power = { k = 3e9, gamma = 1.5 }", "Power k=3e9 gamma=1.5e0 c=0e0 n=0e0"),
        ("kuwabara_kono = { eta_1 = '1 kPa s', eta_2 = 0 }", "KuwabaraKono eta_1=1e3 eta_2=0e0"),
        ("kuwabara_kono = {}", "KuwabaraKono"),
        ("hunt_crossley = { e = 0.9 }", "HuntCrossley e=9e-1"),
        ("tsuji = { e = 0.9 }", "Tsuji e=9e-1"),
        ("zhang_whiten = { alpha = 0.1 }", "ZhangWhiten alpha=1e-1"),
        ("falcon = { c = 500 }", "Falcon c=5e2"),
        ("hertz_dashpot = { c = '8 N s/m' }", "HertzDashpot c=8e0"),
        ("mishra_murty = { k = 1e10, c = 1 }", "MishraMurty k=1e10 c=1e0"),
        ("schwager_poeschel = { a = 1e-6 }", "SchwagerPoeschel a=1e-6"),
        (
            "schwager_poeschel = { eta_1 = 1e3, eta_2 = 2e3 }",
            "SchwagerPoeschel eta_1=1e3 eta_2=2e3",
        ),
        (
            "morgado_oppenheim = { eta_1 = 1e4, eta_2 = 0.2 }",
            "MorgadoOppenheim eta_1=1e4 eta_2=2e-1",
        ),
        ("bordbar_hyppanen = { a = '1 us', n = 0.65 }", "BordbarHyppanen a=1e-6 n=6.5e-1"),
        ("thornton = { yield_pressure = '1.6 GPa' }", "Thornton yield_pressure=1.6e9"),
        ("johnson = { yield_strength = '1 GPa' }", "Johnson yield_strength=1e9"),
        ("johnson = {}", "Johnson"),
        (
            "jackson_green = { yield_strength = 1e9, nu = 0.3 }",
            "JacksonGreen yield_strength=1e9 nu=3e-1",
        ),
        ("brake = {}", "Brake"),
        (
            "mean_pressure = { yield_strength = 1e9, hardening = '2 GPa' }",
            "MeanPressure yield_strength=1e9 hardening=2e9",
        ),
        (
            "mdr = { yield_strength = 1e9, radius_ratio = 0.5 }",
            "Mdr yield_strength=1e9 radius_ratio=5e-1",
        ),
        ("walton_braun = { e = 0.8, k1 = '1 N/um' }", "WaltonBraun e=8e-1 k1=1e6"),
        (
            "luding = { kp_over_k1 = 5, k1 = 1e6, phi_f = 0.05 }",
            "Luding kp_over_k1=5e0 k1=1e6 phi_f=5e-2",
        ),
    ] {
        let LawInput { family, values } = law(value);
        read.push(family.name());
        let values = values.iter().map(|(key, value)| format!(" {key}={value:e}"));
        assert_eq!(format!("{family:?}{}", values.collect::<String>()), expected);
    }
    let missing = LawTable::NAMES.iter().filter(|name| !read.contains(*name));
    assert_eq!(missing.collect::<Vec<_>>(), [&""; 0], "a law has no row above");
}

#[test]
fn faults_point_at_their_key() {
    fault("law = { kuwabara_kono = { a = «\"1 um\"» } }", "a must be a time", "10 us");
    fault("law = { linear = { k = «\"1 Pa\"» } }", "k must be a stiffness", "N/m");
    fault("law = { power = { k = «\"1 N/m\"», gamma = 1 } }", "k must be a plain number", "");
    fault("law = { kuwabara_kono = { «b» = 1 } }", "unknown key `b`", "a, eta_1, eta_2, end");
    fault("law = { «kuwabara» = {} }", "unknown key `kuwabara`", "did you mean `kuwabara_kono`");
    fault("law = { bordbar_hyppanen = «{ a = 1e-6 }» }", "`n` is missing", "n = ");
    fault("law = { linear = «{ c = 1 }» }", "`k` is missing", "N/m");
    fault("law = { linear = «{ e = 0.9 }» }", "`contact_time` is missing", "10 us");
    let help = "give k and c, or e and contact_time, or k and e";
    fault("law = { linear = { k = 1, c = 1, e = «0.9» } }", "both c and e", help);
    fault("law = { power = «{ k = 1, gamma = 1, c = 1 }» }", "`n` is missing", "");
    fault("law = { tsuji = { e = 0.9, alpha = «1» } }", "both e and alpha", "give e, or alpha");
    fault("law = { tsuji = { e = «1.1» } }", "e is 1.1", "at most 1");
    fault("law = { kuwabara_kono = { a = «-1» } }", "a is -1", "0 or greater");
    fault(
        "law = { kuwabara_kono = { a = 1, eta_1 = «1» } }",
        "both a and eta_1",
        "eta_1 and eta_2",
    );
    fault("law = { kuwabara_kono = «{ eta_1 = 1 }» }", "`eta_2` is missing", "Pa s");
    fault("law = { hertz = { end = «\"zero\"» } }", "which is not allowed", "zero_force");
    fault("law = { hertz = { tolerance = «0» } }", "tolerance is 0", "1e-10");
    fault("law = { hertz = { tolerance = 1e-5 }, tolerance = «1e-6» }", "given twice", "keep");
    fault("law = { zhang_whiten = { e = 0.9, end = «\"zero_overlap\"» } }", "zero force", "tsuji");
    fault("law = { hertz = {}, tsuji = «{ e = 1 }» }", "the keys hertz and tsuji", "exactly one");
    fault("law = «{}»", "names no law", "kuwabara_kono");
    fault("law = { hertz = «[]» }", "is an array", "table");
    fault("hertz = { finite_size = «1» }", "finite_size is an integer", "boolean");
    fault("ting = { tolerance = «\"1 m\"» }", "must be a plain number", "");
    fault("auto = { «best» = true }", "unknown key `best`", "");
    fault("condensed = { vibration_modes = «101» }", "vibration_modes is 101", "whole number");
    fault("condensed = { vibration_modes = «-1» }", "vibration_modes is -1", "whole number");
    fault("condensed = { vibration_modes = «1.5» }", "vibration_modes is 1.5", "whole number");
    fault("condensed = { «mesh» = 1 }", "unknown key `mesh`", "");
    fault("condensed = { steps = «49.0» }", "steps is 49", "whole number");
    fault("condensed = { steps = «\"many\"» }", "not a whole number", "such as 12");
    fault("law = { thornton = { yield_strength = «\"1 N\"» } }", "must be a pressure", "63 GPa");
    fault("law = { johnson = { end = «\"zero_overlap\"» } }", "zero force", "remove end");
    fault("law = { johnson = «{}» }", "needs a yield strength", "material.NAME.yield_strength");
    fault(
        "law = { luding = «{ kp_over_k1 = 0.5, k1 = 1, phi_f = 1 }» }",
        "kp_over_k1 must be in",
        "",
    );
    // The slow limit needs an equilibrium modulus, and this glass flows.
    fault("law = { kuwabara_kono = «{}» }", "flows", "give a");
}

#[test]
fn an_override_of_another_model_replaces_the_first() {
    let with_model = format!("{GLASS}\n[model.law.kuwabara_kono]\na = 1e-6\n");
    for text in [GLASS, &with_model] {
        let chosen = |overrides: &[&str]| case_of(text, overrides).scene().model().clone();
        assert!(matches!(chosen(&["model.ting={}"]), ModelChoice::Ting { .. }));
        assert!(matches!(
            chosen(&["model.ting.finite_size=true"]),
            ModelChoice::Ting { finite_size: true, .. }
        ));
        assert_eq!(chosen(&["model.ting={}", "model.fem={}"]), ModelChoice::Fem);
        assert_eq!(chosen(&["model={hertz={}}"]), ModelChoice::Hertz { finite_size: false });
        let tsuji = chosen(&["model.law.tsuji.e=0.9", "model.law.end='zero_overlap'"]);
        let ModelChoice::Law { law, end_rule, .. } = tsuji else { panic!("{tsuji:?}") };
        assert_eq!((law.family, end_rule), (LawFamily::Tsuji, EndRule::ZeroOverlap));
    }
    let kept = case_of(&with_model, &["model.law.kuwabara_kono.tolerance=1e-4"]);
    let expected = input(LawFamily::KuwabaraKono, &[("a", 1e-6)]);
    assert!(matches!(
        kept.scene().model(),
        ModelChoice::Law { law, tolerance: 1e-4, .. } if *law == expected
    ));
}

#[test]
fn resolved_case_of_a_model_gives_the_same_results() {
    for value in [
        "model.ting={}",
        "model.hertz={finite_size=true}",
        "model.law.hunt_crossley.e=0.9",
        "model.law={tsuji={e=0.9}, end='zero_overlap', tolerance=1e-6}",
        "model.law.linear={e=0.9, contact_time='60 us'}",
        "model.condensed={vibration_modes=4, penalty_springs=true, steps=300}",
    ] {
        let simulation = simulation_of(GLASS, &[value]);
        let text = simulation.resolved().to_toml().unwrap();
        let again = simulation_of::<&str>(&text, &[]);
        assert_eq!(again.resolved().to_toml().unwrap(), text);
        let (found, expected) = (again.run(&mut ()), run(&[value]));
        assert_eq!(found.restitution, expected.restitution);
        assert_eq!(found.history, expected.history);
        // The resolved case has no keys of finite elements that its model lacks.
        assert_eq!(text.contains("[mesh]"), value.contains("condensed"), "{text}");
        assert!(!text.contains("[time]"), "{text}");
    }
    let wanted = run(&["model.law={linear={k=1e7, e=0.5}, end='zero_overlap'}"]).restitution;
    assert!((wanted.unwrap() - 0.5).abs() < 1e-6, "{wanted:?}");
}

#[test]
fn the_slow_limit_of_the_materials() {
    // A tenth of the modulus decays in 0.1 µs, and the contact takes 60 µs.
    let slow = "material.glass.relaxation.terms=[{weight=0.1, relaxation_time='0.1 us'}]";
    let kelvin = run(&[slow, "model.law.kuwabara_kono={}"]);
    let ting = run(&[slow, "model.ting={}"]);
    let loss = |collision: &Collision| 1.0 - collision.restitution.unwrap();
    // The difference is of the next order, τ/T.
    assert!((loss(&kelvin) / loss(&ting) - 1.0).abs() < 5e-3);
    let times = [&kelvin, &ting].map(|collision| collision.contact_time.unwrap());
    assert!((times[0] / times[1] - 1.0).abs() < 1e-4, "{times:?}");
    // The viscosities of the series are η = ΣG_k τ_k, with the equilibrium modulus G∞ = 0.9 G.
    let viscosities = [
        "material.glass={density=2390, youngs_modulus=56.7e9, poissons_ratio=0.244}",
        "model.law.kuwabara_kono={eta_1=253.215434, eta_2=410.15625}",
    ];
    let given = run(&viscosities);
    let ratio = loss(&given) / loss(&kelvin);
    assert!((ratio - 1.0).abs() < 1e-6, "{ratio}");
}

#[test]
fn reduced_models_conserve_energy_and_momentum_in_any_frame() {
    let frames = [
        &["body.0.approach_speed=0.5"][..],
        &["body.0.approach_speed=0.2", "body.1.approach_speed=0.3"],
        &["body.1={name='wall', wall={}}"],
        &["body.0={name='wall', wall={}, approach_speed=0.5}", "body.1.approach_speed=0"],
        &["body.1.sphere.diameter='9 m'"],
    ];
    for model in ["model.ting={}", "model.hertz={}", "model.law.kuwabara_kono.a=2e-6"] {
        for frame in frames {
            let collision = run(&[&[model][..], frame].concat());
            let e = collision.restitution.unwrap();
            let after = collision.bodies.map(|body| body.velocity_after.unwrap());
            assert!((after[1] - after[0] - 0.5 * e).abs() < 1e-12, "{frame:?}");
            let last = collision.history.last().unwrap();
            assert!((last.velocity[0] - after[0]).abs() < 1e-12);
            assert!(collision.residual_relative.unwrap() < 1e-8, "{model} {frame:?}");
            // Both velocities follow from the relative one, so momentum is conserved by construction.
            assert_eq!(collision.momentum_residual_relative, None);
            let energy = |account| last.energy(account).unwrap_or_default();
            let (work, initial) = (energy(Account::WallWork), collision.initial_energy.unwrap());
            let parts =
                [Account::Kinetic, Account::ViscousDissipation, Account::Strain, Account::Radiated];
            let balance = parts.map(energy).iter().sum::<f64>() - initial - work;
            assert!(
                balance.abs() < 1e-8 * (initial + work.abs()),
                "{model} {frame:?}: {balance:e}"
            );
            // The contact has a thousand intervals, with a row at both ends.
            let contact_time = collision.contact_time.unwrap();
            let is_contact = |time: f64| time <= contact_time * (1.0 + 1e-12);
            assert_eq!(collision.history.iter().filter(|row| is_contact(row.time)).count(), 1001);
            assert!(collision.history.iter().any(|row| row.time == contact_time));
        }
    }
}

#[test]
fn swapped_bodies_give_the_same_results_in_reduced_models() {
    let swapped = [
        "body.0={name='target', sphere={diameter='15.9 mm'}, material='glass'}",
        "body.1={name='striker', sphere={diameter='22.2 mm'}, material='glass', approach_speed=0.5}",
    ];
    for model in ["model.ting={}", "model.hertz={finite_size=true}", "model.law.falcon.c=300"] {
        let (there, back) = (run(&[model]), run(&[&[model][..], &swapped].concat()));
        assert_eq!(there.restitution, back.restitution, "{model}");
        assert_eq!(there.contact_time, back.contact_time, "{model}");
        assert_eq!(there.peak_force, back.peak_force, "{model}");
        let after =
            |collision: &Collision| collision.bodies.map(|body| body.velocity_after.unwrap());
        assert_eq!(after(&there)[0], -after(&back)[1]);
    }
}

#[test]
fn extreme_scenes_give_numbers_or_a_reason() {
    let models = [
        "model.ting={}",
        "model.hertz={}",
        "model.law.kuwabara_kono.a=0",
        "model.law.kuwabara_kono.a=1e3",
        "model.law.bordbar_hyppanen={a=1e-6, n=1e-12}",
        "model.law.linear={k=1e7, c=1e12}",
        "model.law.power={k=1e-300, gamma=1e3, c=1e300, n=1e3}",
    ];
    for model in models {
        for speed in ["1e-9", "1", "1e3"] {
            // The masses are 1.2e-12 kg, 10 g and 1.2e6 kg.
            for diameter in ["1e-5", "0.02", "10"] {
                let speed = format!("body.0.approach_speed={speed}");
                let diameter = format!("body.0.sphere.diameter={diameter}");
                let case = case_of(GLASS, &[model, &speed, &diameter]);
                let Ok(simulation) = Simulation::new(case) else { continue };
                let collision = simulation.run(&mut ());
                let Some(restitution) = collision.restitution else {
                    assert!(!collision.is_complete(), "{model} {speed} {diameter}");
                    continue;
                };
                assert!((0.0..=1.0 + 1e-7).contains(&restitution), "{model}: {restitution}");
                for row in &collision.history {
                    let kinetic = row.energy(Account::Kinetic).unwrap();
                    let numbers = [row.time, row.contact_force, row.approach, kinetic];
                    assert!(numbers.iter().all(|x| x.is_finite()), "{model} {speed}: {row:?}");
                }
            }
        }
    }
}
