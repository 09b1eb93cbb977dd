//! The restitutions that DEM codes make of the exported numbers, by integrating the codes' own formulas.

use std::f64::consts::PI;

use crate::common::{glass, glass_model};
use fem_data::dem::{
    self, CODE_LAWS, Export, FrictionLaw, Grain, LawOfSpeed, PairOfGrains, PatchRebound, Snippet,
    Sphere, TsujiVersion, characteristic_velocity, dissipation_of, fit_dissipation, fit_springs,
    grain_snippets, hertz_mindlin_entry, hooke_stiffness, mfix_entry, mfix_outcome, newton_entry,
    restitution_of, tsuji_entry, tsuji_outcome, viscel_entry, viscoelastic_damping, yade_betan,
};
use fem_data::estimate::Point;
use fem_laws::laws::{kuwabara_kono, linear, linear_from_restitution, power, tsuji};
use fem_laws::{EndRule, HertzImpact, LawFamily, LawImpact, Pair, Partner};

fn export() -> Export {
    let glass = glass(None);
    let sphere = |diameter| Sphere {
        diameter,
        density: glass.density(),
        youngs_modulus: glass.instantaneous().youngs_modulus(),
        poissons_ratio: glass.instantaneous().poissons_ratio(),
    };
    let validity = [0.1, 1.0, 0.004];
    Export {
        title: "Glass".to_string(),
        spheres: vec![sphere(22.2e-3), sphere(15.9e-3)],
        pair: *glass_model(LawFamily::Tsuji, None).pair(),
        speeds: (0.1, 1.0),
        tolerance: 0.01,
        restitution: 0.92,
        contact_time: 64e-6,
        validity,
        of_speed: vec![law_of_speed("kuwabara_kono", &[1e-6])],
        bounds: Vec::new(),
        notes: Vec::new(),
        band: None,
        friction: None,
    }
}

/// Beside a linear spring a linear tangential one is an oscillator of (k_t/k_n)(m*/m_t) times its frequency as long as it sticks; a patch
/// that slides throughout loses (m*/m_t)(1 + e); and the stiffness that made a rebound comes back.
#[test]
fn friction_laws_make_their_closed_forms_and_come_back() {
    let model = glass_model(LawFamily::Linear, None);
    let normal = (&model, &[2e7, 0.0][..]);
    let rebound = |friction: f64, before: &[f64], after: Vec<f64>| PatchRebound {
        friction,
        modulus: 3e10,
        mass_ratio: 3.5,
        speed: 1.0,
        before: before.to_vec(),
        after,
    };
    let made = |of: &PatchRebound, law, factor| of.fit(law, Some(factor), normal).unwrap().after;
    // Surfaces that always stick.
    let sticking = rebound(1e6, &[1e-9], vec![0.0]);
    for factor in [0.2f64, 0.7, 1.1] {
        let wanted = 1e-9 * (PI * (3.5 * factor).sqrt()).cos();
        let [found] = made(&sticking, FrictionLaw::Linear, factor)[..] else { panic!() };
        // The last of a thousand steps ends without a load: half of it is 0.0024 of the velocity.
        assert!((found - wanted).abs() < 3e-3 * 1e-9, "{factor}: {found} {wanted}");
    }
    let angles = [0.3, 1.0, 2.0, 4.0, 12.0];
    use FrictionLaw::{Linear, Mindlin, MindlinForce, MindlinRescaleForce, Sliding};
    for law in [Linear, Mindlin, MindlinForce, MindlinRescaleForce, Sliding] {
        let any = rebound(0.1, &angles, vec![0.0; 5]);
        let after = made(&any, law, 0.7);
        // The first steps stick.
        assert!((after[4] - (12.0 - 7.0)).abs() < 1e-3, "{law:?}: {after:?}");
        if law != Sliding {
            let known = rebound(0.1, &angles, after.clone());
            let fitted = known.fit(law, None, normal).unwrap();
            assert!((fitted.factor / 0.7 - 1.0).abs() < 1e-3, "{law:?}: {fitted:?}");
        }
    }
    let bounced: Vec<f64> = angles.iter().map(|x| f64::max(-0.4 * x, x - 3.5 * 1.9)).collect();
    assert!((rebound(0.1, &angles, bounced).walton(0.9).factor - 0.4).abs() < 1e-9);
}

/// With friction every file has its coefficient and says what it makes of the rebound, and without it says so.
#[test]
fn files_hold_friction_or_name_its_absence() {
    let smooth = export();
    for snippet in smooth.snippets().unwrap() {
        assert!(snippet.text.contains("Without friction"), "{}", snippet.text);
    }
    let before = vec![1.0, 9.0];
    let (after, speed) = (vec![0.1, 2.0], 1.0);
    let rebound =
        PatchRebound { friction: 0.125, modulus: 3e10, mass_ratio: 3.5, speed, before, after };
    let normal = glass_model(LawFamily::Tsuji, None);
    let fitted = dem::heads().filter_map(|head| {
        let (law, given) = head.friction?;
        Some((head.name, rebound.fit(law, given, (&normal, &[0.1])).unwrap()))
    });
    let fitted = fitted.collect();
    let rough = Export { friction: Some(dem::Friction { rebound, fitted }), ..export() };
    for snippet in rough.snippets().unwrap() {
        if snippet.code == "MuJoCo" {
            assert!(snippet.text.contains("Without friction"), "{}", snippet.text);
            continue;
        }
        // YADE takes an angle, arctan 0.125.
        let has = |text: &str| snippet.text.contains(text);
        assert!(has("0.1243549945") || has("0.125"), "{}", snippet.text);
        assert!(has("Friction 0.125, ") && has(" rms, "), "{}", snippet.text);
    }
}

fn law_of_speed(name: &'static str, values: &[f64]) -> LawOfSpeed {
    LawOfSpeed { name, values: values.to_vec(), validity: [0.1, 1.0, 0.004] }
}

/// Luding's springs come back from their restitutions and contact times, up to the fastest of them, and the files hold the
/// stiffnesses of LIGGGHTS, whose loops over time are integrated here: `normal_model_hooke_hysteresis.h`.
#[test]
fn springs_that_dent_come_back_and_make_their_restitution() {
    let pair = export().pair;
    let (k1, kp, phi) = (2e7, 6e7, 0.004);
    let mass = pair.effective_mass();
    let until = kp / (kp - k1) * phi * 2.0 * pair.effective_radius();
    let fastest = until * f64::sqrt(k1 / mass);
    let made = |speed: f64| {
        // A step of the code: the history is the largest overlap.
        let (mut overlap, mut rate, mut largest) = (0.0f64, speed, 0.0f64);
        let (step, mut time) = (1e-5 * PI * f64::sqrt(mass / k1), 0.0);
        loop {
            overlap += 0.5 * step * rate;
            largest = largest.max(overlap);
            let k2 = k1 + (kp - k1) * largest / until;
            let back = k2 * (overlap - largest) + k1 * largest;
            let force = if back >= k1 * overlap { k1 * overlap } else { back };
            if force < 0.0 {
                return (-rate / speed, time);
            }
            rate -= step * force / mass;
            overlap += 0.5 * step * rate;
            time += step;
        }
    };
    let points: Vec<Point> = [0.1, 0.3, 0.6, 0.999]
        .into_iter()
        .map(|share| {
            let (restitution, time) = made(share * fastest);
            Point { contact_time: Some(time), ..Point::new(share * fastest, restitution) }
        })
        .collect();
    let springs = fit_springs(&pair, &points).unwrap().unwrap();
    let [ratio, loading, depth] = springs;
    assert!((loading / k1 - 1.0).abs() < 1e-3, "{springs:?}");
    // Beyond the fastest of the data only the slope of the stiffness is meant.
    let slope = |ratio: f64, depth: f64| (ratio - 1.0).powi(2) / (ratio * depth);
    let found = slope(ratio, depth);
    assert!((found / slope(kp / k1, phi) - 1.0).abs() < 1e-3, "{springs:?}");
    let export = Export { of_speed: vec![law_of_speed("luding", &springs)], ..export() };
    let of_liggghts = of_code("LIGGGHTS", &export);
    let velocity = entry(&of_liggghts, "liggghts_hooke_hysteresis.in", "characteristicVelocity");
    assert!((hooke_stiffness(&pair, velocity) / loading - 1.0).abs() < 1e-9);
    // No loss is no dent.
    let lossless =
        points.iter().map(|point| Point { restitution: 1.0, ..*point }).collect::<Vec<_>>();
    assert_eq!(fit_springs(&pair, &lossless).unwrap(), None);
}

/// Every file states that a restitution is a bound, and what else is to say of it.
#[test]
fn files_state_bounds_and_notes() {
    let of_speed = vec![
        law_of_speed("kuwabara_kono", &[1e-6]),
        law_of_speed("hertz_dashpot", &[8.0]),
        law_of_speed("hunt_crossley", &[0.1, 0.01]),
    ];
    let comments = |text: &str| vec![text.to_string()];
    let of = |bounds: Vec<String>, notes: Vec<String>| {
        let export = Export { bounds, notes, of_speed: of_speed.clone(), ..export() };
        let all = export.snippets().unwrap();
        let codes: std::collections::BTreeSet<_> = all.iter().map(|one| one.code).collect();
        assert_eq!(codes.len(), 9);
        all
    };
    for snippet in of(comments("no damping is known"), comments("slow speeds are left out")) {
        let text = &snippet.text;
        assert!(text.contains("WARNING: no damping is known"), "{text}");
        assert!(text.contains(" slow speeds are left out"), "{text}");
        assert!(!text.contains("e is good"), "{text}");
    }
    for snippet in of(Vec::new(), Vec::new()) {
        assert!(!snippet.text.contains("WARNING") && snippet.text.contains("e is good"));
    }

    let sphere = export().spheres[0];
    let grain = |material: &str| Grain { material: material.to_string(), sphere };
    let pair = |grains, bounds, notes| PairOfGrains {
        grains,
        pair: export().pair,
        restitution: 0.9,
        bounds,
        notes,
    };
    let grains = [grain("glass"), grain("steel")];
    let (bounds, notes) = (comments("no damping is known"), comments("slow speeds are left out"));
    let pairs = [
        pair([0, 0], Vec::new(), notes),
        pair([0, 1], bounds.clone(), Vec::new()),
        pair([1, 1], bounds, Vec::new()),
    ];
    let files = grain_snippets(&grains, &pairs);
    assert_eq!(files.len(), 3);
    for (name, text) in files {
        let warning = "# WARNING: e of 1 2, 2 2: no damping is known\n";
        assert_eq!(text.matches(warning).count(), 1, "{name}: {text}");
        assert!(text.contains("# e of 1 1: slow speeds are left out\n"), "{name}: {text}");
        assert!(grain_snippets(&grains, &pairs[..1]).iter().all(|one| !one.1.contains("WARNING")));
    }
}

fn of_code(code: &str, export: &Export) -> Vec<Snippet> {
    let mut all = export.snippets().unwrap();
    all.retain(|snippet| snippet.code == code);
    all
}

fn entry(snippets: &[Snippet], name: &str, key: &str) -> f64 {
    let snippet = snippets.iter().find(|snippet| snippet.name == name).unwrap();
    snippet.entries.iter().find(|(found, _)| *found == key).unwrap().1
}

/// In runs of LAMMPS of 22 July 2025 an entered 0.92 makes 0.94322 and 0.889 makes 0.92014 (`.ci/check_dem.py`); here
/// its formula is integrated.
#[test]
fn lammps_tsuji_restitution_exceeds_the_entered_one() {
    let pair = export().pair;
    let alpha = |e: f64| {
        1.2728 - 4.2783 * e + 11.087 * e * e - 22.348 * e.powi(3) + 27.467 * e.powi(4)
            - 18.022 * e.powi(5)
            + 4.8218 * e.powi(6)
    };
    let made = |entered: f64| {
        let law = tsuji(&pair, alpha(entered)).unwrap();
        let model = LawImpact::new(&pair, law).with_end_rule(EndRule::ZeroOverlap);
        model.impact(0.5).unwrap().restitution
    };
    for (entered, lammps) in [(0.92, 0.94322), (0.889, 0.92014)] {
        // LAMMPS with 20 000 steps per contact has an error of 2e-5.
        assert!((made(entered) - lammps).abs() < 3e-5, "{entered}: {}", made(entered));
        assert!((tsuji_outcome(entered, TsujiVersion::Plain) - made(entered)).abs() < 1e-7);
    }
    let entered = tsuji_entry(0.92, TsujiVersion::Plain).unwrap();
    assert!((entered - 0.889).abs() < 5e-4, "{entered}");
    assert!((made(entered) - 0.92).abs() < 1e-7);
    assert_eq!(entry(&of_code("LAMMPS", &export()), "lammps_tsuji.in", "e"), entered);
    // With the factor √2 the entered value nearly equals the restitution.
    let corrected = tsuji_entry(0.92, TsujiVersion::RootTwo).unwrap();
    assert!((corrected - 0.92).abs() < 2e-3, "{corrected}");
    for wanted in [0.3, 0.5, 0.7, 0.95, 0.99] {
        for version in [TsujiVersion::Plain, TsujiVersion::RootTwo] {
            if let Some(entered) = tsuji_entry(wanted, version) {
                assert!((tsuji_outcome(entered, version) - wanted).abs() < 1e-12);
            }
        }
    }
    assert_eq!(tsuji_entry(1e-9, TsujiVersion::Plain), None);
}

/// The dashpot η m* √(R* ξ) is Kuwabara and Kono's, and η of other sizes is another one: with the
/// masses as the cube of the size it goes as D⁻³.
#[test]
fn lammps_eta_depends_on_the_sizes() {
    let pair = export().pair;
    let eta = viscoelastic_damping(&pair, 1e-6).unwrap();
    let law = kuwabara_kono(&pair, 1e-6).unwrap();
    let damping = eta * pair.effective_mass() * pair.effective_radius().sqrt();
    assert!((damping / law.damping() - 1.0).abs() < 1e-14);
    let expected = 2.0 * pair.contact_modulus() * 1e-6 / pair.effective_mass();
    assert!((eta / expected - 1.0).abs() < 1e-14);
    let glass = glass(None);
    let sphere = |diameter| Partner::solid_sphere(diameter, &glass);
    let twice = Pair::new(sphere(44.4e-3), sphere(31.8e-3)).unwrap();
    assert!((eta / viscoelastic_damping(&twice, 1e-6).unwrap() - 8.0).abs() < 1e-12);
    let snippets = of_code("LAMMPS", &export());
    assert_eq!(entry(&snippets, "lammps_viscoelastic.in", "eta"), eta);
    // The spheres differ, and a damping is of one pair.
    assert!(snippets[1].text.contains("Fitted for contacts of 1 with 2 alone"), "{snippets:?}");
}

/// LIGGGHTS' k_n stores the energy ½ m* V² at Hertz' approach for V; its contact with the chosen V
/// has the wanted time and restitution.
#[test]
fn liggghts_hooke_has_the_contact_time() {
    let pair = export().pair;
    let hertz = HertzImpact::new(&pair, 0.7).unwrap();
    let stored = hooke_stiffness(&pair, 0.7) * hertz.max_approach().powi(2);
    assert!((stored / (pair.effective_mass() * 0.49) - 1.0).abs() < 1e-12);
    let snippets = of_code("LIGGGHTS", &export());
    let velocity = entry(&snippets, "liggghts_hooke.in", "characteristicVelocity");
    let stiffness = hooke_stiffness(&pair, velocity);
    assert!((characteristic_velocity(&pair, stiffness) / velocity - 1.0).abs() < 1e-12);
    let ratio = 1.0 + (PI / 0.92f64.ln()).powi(2);
    let damping = (4.0 * pair.effective_mass() * stiffness / ratio).sqrt();
    let law = linear(stiffness, damping).unwrap();
    let model = LawImpact::new(&pair, law).with_end_rule(EndRule::ZeroOverlap);
    let impact = model.impact(0.5).unwrap();
    assert!((impact.restitution - 0.92).abs() < 1e-7);
    assert!((impact.contact_time.unwrap() / 64e-6 - 1.0).abs() < 1e-7);
}

/// Runs of YADE 2023.02a: en = 0.92 makes 0.91972 and 0.7 makes 0.69977 with Hertz–Mindlin; with ViscEl uncorrected tc
/// and en make 0.92130 and 0.71820.
#[test]
fn yade_makes_the_observed_restitutions() {
    let pair = export().pair;
    let stiffness = 2.0 * pair.contact_modulus() * pair.effective_radius().sqrt();
    for (en, seen) in [(0.92, 0.91972), (0.7, 0.69977)] {
        let damping = 2.0 * yade_betan(en) * (pair.effective_mass() * stiffness).sqrt();
        let law = power(stiffness * 2.0 / 3.0, 1.5, damping, 0.25).unwrap();
        let made = LawImpact::new(&pair, law).impact(0.5).unwrap().restitution;
        // YADE's time step.
        assert!((made - seen).abs() < 3e-5, "{en}: {made}");
    }
    for wanted in [0.3, 0.7, 0.92, 0.97] {
        let damping = 2.0
            * yade_betan(hertz_mindlin_entry(&pair, wanted).unwrap())
            * (pair.effective_mass() * stiffness).sqrt();
        let law = power(stiffness * 2.0 / 3.0, 1.5, damping, 0.25).unwrap();
        let made = LawImpact::new(&pair, law).impact(0.5).unwrap().restitution;
        assert!((made - wanted).abs() < 1e-7, "{wanted}: {made}");
    }
    let made = |tc: f64, en: f64| {
        let mass = pair.effective_mass();
        let stiffness = mass * (PI * PI + en.ln().powi(2)) / (tc * tc);
        let law = linear(stiffness, -2.0 * mass * en.ln() / tc).unwrap();
        LawImpact::new(&pair, law).impact(0.5).unwrap()
    };
    assert!((made(64e-6, 0.92).restitution - 0.92130).abs() < 3e-5);
    assert!((made(64e-6, 0.7).restitution - 0.71820).abs() < 3e-5);
    let law_of = |e| linear_from_restitution(&pair, e, 64e-6, EndRule::ZeroForce).unwrap();
    let (tc, en) = viscel_entry(&pair, &law_of(0.92)).unwrap();
    let corrected = made(tc, en);
    assert!((corrected.restitution - 0.92).abs() < 1e-7);
    assert!((corrected.contact_time.unwrap() / 64e-6 - 1.0).abs() < 1e-7);
    assert!(tc > 64e-6 && en < 0.92);
    let snippets = of_code("YADE", &export());
    assert_eq!(entry(&snippets, "yade_viscel.py", "en"), en);
    assert_eq!(viscel_entry(&pair, &law_of(0.05)), None);
    assert_eq!(of_code("YADE", &Export { restitution: 0.05, ..export() }).len(), 1);
}

/// At e = 0.92 and 0.5 m/s Hertz' contact ends 1.4 to 2.6 µs earlier at zero force than at zero
/// overlap (the project's reference calculation); a linear one of 64 µs by 2 asin(ζ)/ω.
#[test]
fn contact_times_of_the_two_ends_differ() {
    let pair = export().pair;
    let difference = |law| {
        let time = |end_rule| {
            let model = LawImpact::new(&pair, law).with_end_rule(end_rule);
            model.impact(0.5).unwrap().contact_time.unwrap()
        };
        time(EndRule::ZeroOverlap) - time(EndRule::ZeroForce)
    };
    for family in [LawFamily::Tsuji, LawFamily::KuwabaraKono] {
        let model = glass_model(family, None);
        let found = fem_data::estimate::invert(&model, 0, &[1.0], 0.5, 0.92).unwrap().solutions[0];
        let microseconds = 1e6 * difference(model.law(&[found]).unwrap().unwrap());
        // Printed to two digits.
        assert!((1.35..2.65).contains(&microseconds), "{family:?} {microseconds}");
    }
    let (mass, ratio) = (pair.effective_mass(), 0.02653f64);
    let frequency = PI / 64e-6 / (1.0 - ratio * ratio).sqrt();
    let law = linear(mass * frequency * frequency, 2.0 * ratio * mass * frequency).unwrap();
    let exact = 2.0 * ratio.asin() * 64e-6 / PI;
    assert!((difference(law) / exact - 1.0).abs() < 1e-5);
}

/// Integrates the Hertzian dashpots of MFIX and MercuryDPM as their sources write them; the restitution of a law is
/// accurate to 1e-8.
#[test]
fn hertzian_dashpots_of_mfix_and_mercury_make_the_stated_restitution() {
    let pair = export().pair;
    let made = |alpha: f64| {
        let law = tsuji(&pair, alpha).unwrap();
        let model = LawImpact::new(&pair, law).with_end_rule(EndRule::ZeroOverlap);
        model.impact(0.5).unwrap().restitution
    };
    for e in [0.3_f64, 0.9, 0.99] {
        let sine = -e.ln() / PI.hypot(e.ln());
        assert!((made(2.0 * sine) - mfix_outcome(e)).abs() < 1e-7, "{e}");
        let entry = mfix_entry(e).unwrap();
        assert!(entry < e && (mfix_outcome(entry) - e).abs() < 1e-12, "{e}: {entry}");
        let square = e.ln().powi(2);
        assert!((made((5.0 * square / (square + PI * PI)).sqrt()) - e).abs() < 1e-7, "{e}");
    }
    assert_eq!(mfix_entry(1e-3), None);
    let snippets = of_code("MFIX-DEM", &export());
    let entered = entry(&snippets, "mfix_hertzian.dat", "des_en_input");
    assert_eq!(Some(entered), mfix_entry(0.92));
    // LSD: eta of its k makes e of the linear law at zero overlap.
    let stiffness = entry(&snippets, "mfix_lsd.dat", "kn");
    let loss = -0.92_f64.ln();
    let damping = 2.0 * (stiffness * pair.effective_mass()).sqrt() * loss / PI.hypot(loss);
    let law = linear(stiffness, damping).unwrap();
    let impact =
        LawImpact::new(&pair, law).with_end_rule(EndRule::ZeroOverlap).impact(0.5).unwrap();
    assert!((impact.restitution - 0.92).abs() < 1e-7, "{}", impact.restitution);
    assert!((impact.contact_time.unwrap() / 64e-6 - 1.0).abs() < 1e-7);
}

/// Newton's dashpot acts in the approach only: its steps, as in `kernels_contact.py`, make the wanted restitution in the wanted time.
#[test]
fn newtons_stiffness_and_damping_make_restitution_and_contact_time() {
    let pair = export().pair;
    for (e, wanted) in [(0.92, 64e-6), (0.4, 1e-3), (0.2, 1e-5), (1.0, 1e-4)] {
        let [stiffness, damping] = newton_entry(&pair, e, wanted).unwrap();
        let (mut overlap, mut rate, mut time) = (0.0f64, 1.0f64, 0.0);
        let step = 1e-5 * wanted;
        loop {
            let force = stiffness * overlap + damping * rate.max(0.0);
            rate -= step * force / pair.effective_mass();
            overlap += step * rate;
            time += step;
            if overlap <= 0.0 {
                break;
            }
        }
        // Steps of first order in time.
        assert!((-rate / e - 1.0).abs() < 1e-4, "{e}: {rate}");
        assert!((time / wanted - 1.0).abs() < 1e-4, "{e}: {time}");
    }
}

/// Each code has the laws of its snippets that depend on speed, and one that makes one restitution.
#[test]
fn every_code_of_the_snippets_has_its_laws() {
    for snippet in export().snippets().unwrap() {
        let code = snippet.code.to_lowercase();
        let (_, laws) = CODE_LAWS.iter().find(|(name, _)| *name == code).unwrap();
        let has = |name: &str| laws.iter().any(|law| law.name() == name);
        match snippet.law {
            "constant" => assert!(has("tsuji") || has("linear"), "{code}"),
            law => assert!(has(law), "{code}: {law}"),
        }
    }
}

/// The input for unlike spheres has both spheres and names the pair of its numbers; that for equal ones does not.
#[test]
fn snippets_name_their_pair() {
    let all = |export: &Export| {
        let mut all = export.snippets().unwrap();
        all.retain(|snippet| !["Drake", "MuJoCo", "Newton"].contains(&snippet.code));
        all
    };
    let unlike = all(&export());
    assert_eq!(unlike.len(), 12);
    let note = "Fitted for contacts of 1 with 2 alone";
    for snippet in &unlike {
        assert!(snippet.text.contains(note), "{}", snippet.text);
    }
    let alike = Export { spheres: vec![export().spheres[0]; 2], ..export() };
    for snippet in all(&alike) {
        assert!(!snippet.text.contains(note), "{}", snippet.text);
    }
    let mercury = &of_code("MercuryDPM", &export())[0].text;
    assert!(mercury.contains("getMixedObject(first, second)"), "{mercury}");
    assert!(mercury.lines().take(4).all(|line| line.starts_with("// ")), "{mercury}");
    assert!(of_code("MercuryDPM", &alike)[0].text.contains("auto sphere ="));
}

/// The entered modulus of a wall or a half-space makes the contact's E*: codes use
/// 1/E* = (1 − ν²)/E + 1/E_w. LAMMPS' wall has the modulus E/(2(1−ν²)) of what is entered (a sphere of 1 cm at 0.5 m/s reached
/// 6.337385 µm with its own modulus and Hertz' 5.208705 µm with twice it, release of 22 July 2025).
#[test]
fn walls_have_the_modulus_of_the_contact() {
    let glass = glass(None);
    let sphere = export().spheres[0];
    let of = |partner| {
        let pair = Pair::new(Partner::solid_sphere(sphere.diameter, &glass), partner).unwrap();
        Export { spheres: vec![sphere], pair, ..export() }
    };
    let key = |text: &str, key: &str| -> f64 {
        let line = text.lines().find(|line| line.contains(key)).unwrap();
        line.rsplit_once('=').unwrap().1.trim().parse().unwrap()
    };
    for (export, words) in
        [(of(Partner::Wall), "rigid wall"), (of(Partner::half_space(&glass)), "half-space")]
    {
        let snippets = of_code("MFIX-DEM", &export);
        let (mfix, lethe) = (&snippets[0].text, &of_code("Lethe", &export)[0].text);
        assert!(mfix.contains(words) && lethe.contains(words), "{mfix}{lethe}");
        let own = (1.0 - sphere.poissons_ratio.powi(2)) / sphere.youngs_modulus;
        for wall in [key(mfix, "ew_young"), key(lethe, "young modulus wall")] {
            let made = (own + wall.recip()).recip() / export.pair.contact_modulus();
            // A rigid wall is a million times as stiff, numbers have ten digits.
            assert!((made - 1.0).abs() < 2e-6, "{made}");
        }
        let snippets = of_code("LAMMPS", &export);
        assert_eq!(snippets.len(), 3);
        for snippet in &snippets {
            let command = snippet.text.lines().last().unwrap();
            let (start, rest) = command.split_once("hertz/material ").unwrap();
            assert_eq!(start, "fix wall all wall/gran granular ");
            let modulus: f64 = rest.split(' ').next().unwrap().parse().unwrap();
            let made = modulus / (2.0 * (1.0 - sphere.poissons_ratio.powi(2)));
            // Ten digits are written.
            assert!((made / export.pair.contact_modulus() - 1.0).abs() < 1e-9, "{command}");
        }
        assert!(of_code("LIGGGHTS", &export).is_empty() && of_code("YADE", &export).is_empty());
        // η = 2E*A/m of the sphere alone.
        let eta = entry(&snippets, "lammps_viscoelastic.in", "eta");
        let mass = fem_laws::sphere_mass(22.2e-3, 2390.0);
        assert!((eta * mass / (2e-6 * export.pair.contact_modulus()) - 1.0).abs() < 1e-12);
    }
}

/// Drake's equation of motion is stepped half-implicitly, with 20,000 steps per contact: accurate to 1e-4.
#[test]
fn drakes_restitution_is_that_of_the_motion() {
    for a in [0.03, 0.3, 2.0] {
        let (mut x, mut v, dt) = (0.0_f64, 1.0_f64, std::f64::consts::PI / 20_000.0);
        while x >= 0.0 {
            v -= dt * x * (1.0 + a * v).max(0.0);
            x += dt * v;
        }
        assert!((restitution_of(a) + v).abs() < 2e-4, "{a}: {} {v}", restitution_of(a));
    }
}

/// e = 1 − 2a/3 + O(a²).
#[test]
fn a_weak_drake_dashpot_is_that_of_hunt_and_crossley() {
    for a in [1e-2, 1e-3] {
        assert!((restitution_of(a) - (1.0 - 2.0 * a / 3.0)).abs() < a * a, "{a}");
    }
}

/// The dissipation that made the data is found; for data with another slope, no neighbour is better.
#[test]
fn drakes_dissipation_fits_best() {
    let of = |e: &dyn Fn(f64) -> f64| -> Vec<Point> {
        [0.05, 0.1, 0.3, 1.0, 4.0].iter().map(|v| Point::new(*v, e(*v))).collect()
    };
    let exact = fit_dissipation(&of(&|v| restitution_of(0.7 * v))).unwrap().unwrap();
    assert!((exact[0] / 0.7 - 1.0).abs() < 1e-6 && exact[1] < 1e-7, "{exact:?}");
    let points = of(&|v| 0.8 - 0.1 * v.ln());
    let best = fit_dissipation(&points).unwrap().unwrap();
    let sum = |d: f64| -> f64 {
        points.iter().map(|p| (restitution_of(d * p.speed) - p.restitution).powi(2)).sum()
    };
    for factor in [0.01, 0.1, 0.5, 0.99, 1.01, 2.0, 10.0] {
        assert!(sum(best[0]) < sum(factor * best[0]), "{factor}");
    }
    assert_eq!(fit_dissipation(&of(&|_| 1.0)), Ok(None));
}

#[test]
fn drakes_dissipation_inverts_its_restitution() {
    for e in [0.05, 0.5, 0.92, 0.999] {
        assert!((restitution_of(dissipation_of(e)) - e).abs() < 1e-6, "{e}");
    }
}
