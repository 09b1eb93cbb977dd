//! The contact law to compile, compiled: beside the models that it stands for, and under motions that are no impacts.

use std::path::PathBuf;
use std::process::{Command, Stdio};
use std::sync::OnceLock;

use fem_case::Case;
use fem_data::dem::{PAIR_CHECK, Repulsion};
use fem_laws::{NormalSprings, PairRelaxation, TangentialContact};
use fem_simulation::Reduced;
use fem_study::laws::LawExport;

const GLASS: &str = "density = 2390, youngs_modulus = 63e9, poissons_ratio = 0.244";

/// Cases of every kind of law, with their names.
fn cases() -> Vec<(&'static str, Case)> {
    let ball = |name: &'static str, material: &str, partner: &str, rest: &str| {
        let text = format!(
            "[material]\nm = {{ {material} }}\n[[body]]\nname = 'floor'\n{partner}\n[[body]]\nname = 'ball'\n\
             sphere.diameter = 0.01\nmaterial = 'm'\napproach_speed = 0.5\n{rest}"
        );
        (name, Case::parse("ball.toml", &text, std::path::Path::new("."), &[]).unwrap())
    };
    let three = "relaxation = { acts_on = 'shear', terms = [{ weight = 0.2, relaxation_time = 3e-6 }, \
                 { weight = 0.2, relaxation_time = 3e-5 }, { weight = 0.2, relaxation_time = 1e-3 }] }";
    let like = "sphere.diameter = 0.02\nmaterial = 'm'";
    let elastic = "elastic = true";
    let text = "scene.temperature = '40 degC'\n[[body]]\nname = 'floor'\nwall = {}\n[[body]]\nname = 'ball'\n\
                sphere.diameter = 0.01\nmaterial = 'lib:pvb'\napproach_speed = 0.3\n[model.ting]\nfinite_size = false";
    let transition = Case::parse("pvb.toml", text, std::path::Path::new("."), &[]).unwrap();
    vec![
        ("transition", transition),
        ball("elastic", &format!("{GLASS}, {elastic}"), like, ""),
        ball("relaxing", &format!("{GLASS}, {three}"), like, ""),
        ball(
            "rubbing",
            &format!("{GLASS}, {three}"),
            like,
            "[contact]\nfriction = 0.2\n[model.ting]\nfinite_size = true",
        ),
        ball(
            "plate",
            &format!("{GLASS}, {elastic}"),
            "plate = { thickness = 0.003 }\nmaterial = 'm'",
            "",
        ),
        ball("block", &format!("{GLASS}, {elastic}"), "half_space = {}\nmaterial = 'm'", ""),
        ball("sticking", &format!("{GLASS}, {elastic}, surface_energy = 0.5"), like, ""),
        ball(
            "denting",
            "density = 7800, youngs_modulus = 210e9, poissons_ratio = 0.3, yield_strength = 4e8, flow = {}",
            like,
            "",
        ),
    ]
}

/// Returns the laws of all cases, which all tests share.
fn laws() -> &'static [(&'static str, LawExport)] {
    static LAWS: OnceLock<Vec<(&'static str, LawExport)>> = OnceLock::new();
    let law = |(name, case): (&'static str, Case)| {
        (name, LawExport::of(&case, name, None, false).unwrap())
    };
    LAWS.get_or_init(|| cases().into_iter().map(law).collect())
}

/// A law compiled with the program of checks.
struct Compiled(PathBuf);

impl Compiled {
    /// Compiles a law by the compiler `cc`; `None`, with a printed reason, where there is none.
    #[expect(clippy::disallowed_macros, reason = "a test that is skipped says why")]
    fn of(export: &LawExport, flags: &[&str]) -> Option<Self> {
        // Tests run beside each other.
        let test = std::thread::current().name().unwrap_or_default().replace(':', "_");
        let folder = PathBuf::from(env!("CARGO_TARGET_TMPDIR")).join(test);
        std::fs::create_dir_all(&folder).unwrap();
        let law = &export.law;
        let [header, source] =
            [law.file_name(), "pair_check.c".to_string()].map(|it| folder.join(it));
        std::fs::write(&header, law.header()).unwrap();
        std::fs::write(&source, PAIR_CHECK).unwrap();
        let program =
            folder.join(format!("{}_{}", law.name, flags.concat().replace(['-', '=', ','], "_")));
        let mut command = Command::new("cc");
        command.args(["-std=c99", "-Wall", "-Wextra", "-pedantic", "-Werror", "-O2", "-include"]);
        command.arg(&header).arg(format!("-DPAIR=pair_{}", law.name)).args(flags);
        if matches!(law.repulsion, Repulsion::Springs(_, Some(_))) {
            command.arg("-DFRICTION");
        }
        let status = command.arg(&source).arg("-o").arg(&program).arg("-lm").status();
        let Ok(status) = status else {
            eprintln!("skipped: there is no compiler cc");
            return None;
        };
        assert!(status.success(), "{}", law.name);
        Some(Self(program))
    }

    /// Returns the numbers that the program writes, line by line, for words and an input.
    fn run(&self, words: &[String], input: &str) -> Vec<Vec<f64>> {
        use std::io::Write as _;
        let mut command = Command::new(&self.0);
        let mut child =
            command.args(words).stdin(Stdio::piped()).stdout(Stdio::piped()).spawn().unwrap();
        child.stdin.take().unwrap().write_all(input.as_bytes()).unwrap();
        let output = child.wait_with_output().unwrap();
        assert!(output.status.success(), "{:?}", self.0);
        let text = String::from_utf8(output.stdout).unwrap();
        let numbers = |line: &str| line.split(' ').map(|word| word.parse().unwrap()).collect();
        text.lines().map(numbers).collect()
    }
}

/// The law and the table lose the same energy by adhesion where bodies dent, or have not recovered, as they part. The bound is the law's own.
#[test]
fn sticking_bodies_part_where_they_last_pressed() {
    let relaxing = "youngs_modulus = 3e9, poissons_ratio = 0.35, surface_energy = 0.05, relaxation = { acts_on = 'all', \
                    terms = [{ weight = 0.2, relaxation_time = 1e-5 }] }";
    let denting =
        "youngs_modulus = 70e9, poissons_ratio = 0.3, yield_strength = 2e8, surface_energy = 0.5";
    for (name, diameter, speed, material) in
        [("dents", 1e-4, 0.5, denting), ("relaxes", 1e-3, 0.1, relaxing)]
    {
        let body = format!("[[body]]\nsphere.diameter = {diameter}\nmaterial = 'm'\n");
        let text = format!(
            "[material]\nm = {{ density = 2700, {material} }}\n{body}name = 'a'\n{body}name = 'b'\napproach_speed = {speed}"
        );
        let case = Case::parse("grains.toml", &text, std::path::Path::new("."), &[]).unwrap();
        let export = LawExport::of(&case, name, None, false).unwrap();
        let Some(compiled) = Compiled::of(&export, &[]) else { return };
        let line = |(point, impact): (&[f64; 3], &fem_laws::ImpactQuantities)| {
            format!("{:e} {:e}\n", point[0], impact.contact_time / 100.0)
        };
        let input: String = export.law.curve.iter().zip(&export.impacts).map(line).collect();
        let found = compiled.run(&words("impacts", &[]), &input);
        for (point, row) in export.law.curve.iter().zip(&found) {
            assert!((row[0] - point[1]).abs() < export.errors[0], "{name} {point:?} {row:?}");
        }
        assert!(export.errors[0] < 0.02, "{:?}", export.errors);
    }
}

fn words(mode: &str, numbers: &[f64]) -> Vec<String> {
    [mode.to_string()].into_iter().chain(numbers.iter().map(|it| format!("{it:e}"))).collect()
}

/// The bounds are the requirement. An integrator of second order has an error of (2π/n)²/24 in the time of n steps; a touch within a step
/// is known to half of it, 1 % of 50. A spring of twelve changes the force by (3/8)/12² = 0.26 %.
#[test]
fn compiled_law_has_the_impacts_of_its_model() {
    for (name, export) in laws() {
        let Some(compiled) = Compiled::of(export, &[]) else { return };
        let points: Vec<_> = export.law.curve.iter().zip(&export.impacts).step_by(4).collect();
        for (n_steps, of_e) in [(200.0, 0.001), (100.0, 0.001), (50.0, 0.002)] {
            let line = |([speed, ..], impact): &(&[f64; 3], &fem_laws::ImpactQuantities)| {
                format!("{speed:e} {:e}\n", impact.contact_time / n_steps)
            };
            let found =
                compiled.run(&words("impacts", &[]), &points.iter().map(line).collect::<String>());
            for ((point, impact), row) in points.iter().zip(&found) {
                let [_, e, time] = **point;
                let sticks = export.law.adhesion.is_some();
                // A pull-off force lengthens a slow contact, which the table leaves out.
                let of_time = if sticks { 0.1 } else { 0.015 };
                // Ting's model leaves part of the finite size out of the unloading: the claim pair_law has the limit.
                let of_size = 0.1 * (1.0 - e) * impact.max_contact_radius
                    / export.law.pair.effective_radius();
                assert!((row[0] - e).abs() < of_e + of_size, "{name} {n_steps} {point:?} {row:?}");
                assert!(
                    (row[1] / time - 1.0).abs() < of_time,
                    "{name} {n_steps} {point:?} {row:?}"
                );
                let force = row[2] / impact.peak_force - 1.0;
                assert!(sticks || force.abs() < 0.005, "{name} {n_steps} {point:?} {force}");
            }
        }
    }
}

/// The C text and the springs of the program are one law: they differ by the nine digits of the header's numbers.
#[test]
fn compiled_springs_are_those_of_the_program() {
    for (name, export) in laws() {
        let Repulsion::Springs(springs, _) = &export.law.repulsion else { continue };
        let Some(compiled) = Compiled::of(export, &[]) else { return };
        let (speed, step) = (0.7, export.impacts[8].contact_time / 77.0);
        let own = springs.impact(export.law.pair.effective_mass(), speed, step);
        let found = compiled.run(&words("impacts", &[]), &format!("{speed:e} {step:e}\n"));
        for (own, found) in own.iter().zip(&found[0]) {
            assert!((own / found - 1.0).abs() < 1e-7, "{name} {own:e} {found:e}");
        }
    }
}

/// Random motions with steps over five decades, pauses and separations, by double and single precision and with sanitizers: no work is given, along the axis
/// or across it. A motion of a 200th of the depth per step passes a spring's gap with an error of its work below 1e-4 of the whole; that
/// of a table of forces, which is no sum of straight lines, is 1e-3.
#[test]
fn random_motions_gain_no_energy() {
    for (name, export) in laws() {
        let middle = &export.impacts[8];
        let speed = export.law.curve[8][0];
        let sanitized = &["-fsanitize=address,undefined", "-fno-sanitize-recover=all"];
        for flags in [&[][..], &["-DPAIR_REAL=float"][..], sanitized] {
            let Some(compiled) = Compiled::of(export, flags) else { return };
            for seed in 0..2 {
                let motion =
                    [2e4, f64::from(seed), middle.max_approach, middle.contact_time, 3.0 * speed];
                let least = &compiled.run(&words("walk", &motion), "")[0];
                assert!(least[0] > -1e-3 && least[1] > -1e-3, "{name} {flags:?} {seed} {least:?}");
            }
        }
    }
}

/// The tangential force of the header beside that of the model of oblique impacts, from sticking to sliding; the friction of the header is
/// a circle and that of the model a line, which are one for a slip along x. The difference is that of 200 steps and of springs
/// whose finite size is of their own contact and not of the largest one.
#[test]
fn friction_is_that_of_the_model_of_oblique_impacts() {
    let (name, case) = cases().into_iter().find(|(name, _)| *name == "rubbing").unwrap();
    let (_, export) = laws().iter().find(|(own, _)| *own == name).unwrap();
    let Some(compiled) = Compiled::of(export, &[]) else { return };
    let scene = case.scene();
    let [lower, upper] = scene.bodies().each_ref().map(|body| body.material());
    let pair = scene.pair().unwrap();
    let mass = 2.0 / 7.0 * pair.effective_mass();
    let contact = TangentialContact::new([lower, upper], mass, scene.friction()).unwrap();
    let contact = contact.with_finite_size(scene.tangential_size().unwrap());
    let impact = Reduced::new(scene).unwrap().impact(0.5).unwrap();
    let relaxation = PairRelaxation::new(lower, upper).unwrap();
    let springs =
        NormalSprings::of_impact(&impact, &pair, &relaxation, None, 0.0, NormalSprings::N_STEPS)
            .unwrap();
    let step = impact.contact_time.unwrap() / 200.0;
    for velocity in [0.02, 0.05, 0.1, 0.2, 0.3, 0.5, 1.0] {
        let expected = contact.impact(&springs, velocity).velocity;
        let found = compiled.run(&words("oblique", &[0.5, step, velocity, mass]), "")[0][0];
        // In units of the friction times the speed.
        assert!((found - expected).abs() < 0.02 * 0.2 * 0.5, "{velocity} {found} {expected}");
    }
}

/// An effect that the header cannot hold is an error with a way out.
#[test]
fn effects_without_a_form_are_errors() {
    let (_, case) = cases().pop().unwrap();
    let rubs = case.edited(|file| file.contact.get_or_insert_default().friction = Some(0.2.into()));
    let fault = LawExport::of(&rubs.unwrap(), "x", None, false).unwrap_err();
    assert!(fault.to_string().contains("friction or plastic flow"), "{fault}");
}

/// The programs beside a header have its names, and bodies that stick have none for LIGGGHTS, whose contacts end at zero overlap.
#[test]
fn programs_beside_a_header_are_filled() {
    for (name, export) in laws() {
        let hosts = export.law.hosts();
        assert!(hosts.iter().all(|(file, text)| !format!("{file}{text}").contains("@name@")));
        let is_written = hosts.iter().any(|(file, _)| file.starts_with("normal_model_"));
        assert_eq!(is_written, export.law.adhesion.is_none(), "{name}");
    }
}
