//! Random scenes: results are finite or a key is rejected, units do not matter, momentum is conserved, energy does
//! not grow, and no restitution is above 1. The scenes are the same on every machine.

use std::path::Path;

use fastrand::Rng;
use fem_case::Case;
use fem_collision::{BalanceSide, Collision};
use fem_simulation::effects::NeglectError;
use fem_simulation::{Cost, Simulation};

/// A material in SI; terms of weight and rate over a guess of the inverse contact time.
#[derive(Clone, Debug)]
struct Stuff {
    density: f64,
    modulus: f64,
    poissons_ratio: f64,
    acts_on: &'static str,
    terms: Vec<(f64, f64)>,
}

/// A striker and a partner; the second diameter is 0 of a wall.
#[derive(Clone, Debug)]
struct Pair {
    stuff: [Stuff; 2],
    diameters: [f64; 2],
    mach: f64,
    gap: f64,
}

/// SI values of the units of length, mass and time.
type Units = [f64; 3];

fn within(random: &mut Rng, from: f64, to: f64) -> f64 {
    from + (to - from) * random.f64()
}

/// Returns a number with a uniform decadic logarithm.
fn decades(random: &mut Rng, from: f64, to: f64) -> f64 {
    10f64.powf(within(random, from, to))
}

fn stuff(random: &mut Rng) -> Stuff {
    let n_terms = random.usize(..3);
    let mut term = || (within(random, 0.01, 0.3), decades(random, -3.0, 1.0));
    let terms = (0..n_terms).map(|_| term()).collect();
    Stuff {
        density: decades(random, 2.0, 4.5),
        modulus: decades(random, 6.0, 11.5),
        poissons_ratio: within(random, -0.4, 0.49),
        acts_on: if random.bool() { "all" } else { "shear" },
        terms,
    }
}

fn pair(random: &mut Rng) -> Pair {
    let diameter = decades(random, -4.0, 0.0);
    let ratio = if random.usize(..5) == 0 { 0.0 } else { decades(random, -1.0, 1.0) };
    Pair {
        stuff: [stuff(random), stuff(random)],
        diameters: [diameter, diameter * ratio],
        mach: decades(random, -6.0, -3.0),
        gap: if random.bool() { 0.0 } else { decades(random, -9.0, 3.0) },
    }
}

impl Pair {
    fn wave_speed(&self) -> f64 {
        let speeds = self.stuff.each_ref().map(|stuff| (stuff.modulus / stuff.density).sqrt());
        speeds[0].min(speeds[1])
    }

    /// Returns the case in other units, as numbers without a unit.
    fn text(&self, model: &str, [metre, kilogram, second]: Units) -> String {
        let (length, speed) = (1.0 / metre, second / metre);
        let pressure = metre * second * second / kilogram;
        let time = self.diameters[0] / self.wave_speed() * self.mach.powf(-0.2);
        let material = |k: usize| {
            let Stuff { density, modulus, poissons_ratio, acts_on, terms } = &self.stuff[k];
            let terms: Vec<String> = terms
                .iter()
                .map(|(weight, rate)| {
                    format!("{{weight={weight:e}, decay_rate={:e}}}", rate / time * second)
                })
                .collect();
            let relaxation = match terms.is_empty() {
                true => String::new(),
                false => {
                    format!("relaxation={{acts_on='{acts_on}', terms=[{}]}}\n", terms.join(","))
                }
            };
            format!(
                "[material.m{k}]\ndensity={:e}\nyoungs_modulus={:e}\npoissons_ratio={poissons_ratio:e}\n\
                 {relaxation}",
                density * metre.powi(3) / kilogram,
                modulus * pressure,
            )
        };
        let [first, second] = self.diameters.map(|diameter| diameter * length);
        let sphere = |k: usize, diameter: f64| {
            format!("sphere={{diameter={diameter:e}}}\nmaterial='m{k}'\n")
        };
        let partner = if second > 0.0 { sphere(1, second) } else { "wall={}\n".to_string() };
        format!(
            "{}{}[[body]]\nname='a'\n{}approach_speed={:e}\n[[body]]\nname='b'\n{partner}\
             [start]\ngap={:e}\n[model.{model}\n",
            material(0),
            material(1),
            sphere(0, first),
            self.mach * self.wave_speed() * speed,
            self.gap * length,
        )
    }
}

fn simulation(text: &str) -> Result<Simulation, String> {
    let case = Case::parse("any.toml", text, Path::new("."), &[]).map_err(|e| e.to_string())?;
    Simulation::new(case).map_err(|error| error.to_string())
}

fn run(text: &str) -> Result<(Simulation, Collision), String> {
    let simulation = simulation(text)?.without_snapshots();
    let collision = simulation.run(&mut ());
    match collision.stop() {
        Some(stop) => Err(stop.to_string()),
        None => Ok((simulation, collision)),
    }
}

/// Returns restitution, and contact time and peak force over those of Hertz.
fn numbers(simulation: &Simulation, collision: &Collision) -> Vec<f64> {
    let hertz = &simulation.setup().estimate.hertz;
    let time = collision.contact_time.map(|time| time / hertz.contact_time());
    let force = collision.peak_force.map(|force| force / hertz.peak_force());
    [collision.restitution, time, force].into_iter().flatten().collect()
}

const MODELS: [&str; 4] =
    ["ting]", "ting]\nfinite_size=true", "law]\nhertz={}", "law]\ntsuji={e=0.8}"];

/// Computes 24 scenes with four models, in SI and in units that are powers of ten from it. Results agree within
/// the tolerance of the models' solvers, since rounding of the scene's numbers moves their steps.
#[test]
fn units_do_not_matter_and_momentum_and_energy_are_conserved() {
    let mut random = Rng::with_seed(1);
    let mut n_computed = 0;
    for pair in (0..24).map(|_| pair(&mut random)).collect::<Vec<_>>() {
        let units = [(); 3].map(|()| 10f64.powi(random.i32(-6..6)));
        for model in MODELS {
            let ours = run(&pair.text(model, [1.0; 3]));
            let theirs = run(&pair.text(model, units));
            let ((simulation, collision), theirs) = match (ours, theirs) {
                (Ok(ours), Ok((simulation, collision))) => (ours, numbers(&simulation, &collision)),
                (Err(_), Err(_)) => continue,
                (a, b) => panic!("{model}: {:?} {:?}", a.map(drop), b.map(drop)),
            };
            n_computed += 1;
            let found = numbers(&simulation, &collision);
            assert_eq!(found.len(), theirs.len());
            for (a, b) in found.iter().zip(&theirs) {
                assert!((a - b).abs() <= 1e-6 * a.abs().max(1.0), "{model}: {a} {b}");
            }
            assert!(found.iter().all(|number| number.is_finite()), "{model}: {found:?}");
            let restitution = collision.restitution.unwrap_or_default();
            assert!((0.0..=1.0 + 1e-7).contains(&restitution), "{model}: {restitution}");
            let momentum = collision.momentum_residual_relative.unwrap_or_default();
            assert!(momentum <= 1e-12, "{model}: {momentum}");
            let initial = collision.initial_energy.unwrap_or(f64::NAN);
            for row in &collision.history {
                let held = row.energies.total(BalanceSide::Held).unwrap_or_default();
                assert!(held <= initial * (1.0 + 1e-6), "{model} {}: {held}", row.time);
            }
        }
    }
    assert!(n_computed > 72, "{n_computed}");
}

/// Few scenes on coarse meshes, since each takes a tenth of a second.
#[test]
fn condensed_bodies_conserve_energy_and_momentum() {
    let mut random = Rng::with_seed(2);
    let mut n_computed = 0;
    for pair in (0..8).map(|_| pair(&mut random)) {
        let smallest =
            pair.diameters.into_iter().filter(|d| *d > 0.0).fold(f64::INFINITY, f64::min);
        let text = pair.text("condensed]", [1.0; 3]);
        let text = format!("{text}[mesh]\ncontact_element_size={:e}\n", 0.02 * smallest);
        let Ok((_, collision)) = run(&text) else { continue };
        n_computed += 1;
        let restitution = collision.restitution.unwrap_or_default();
        assert!((0.0..=1.0 + 1e-5).contains(&restitution), "{restitution}");
        let momentum = collision.momentum_residual_relative.unwrap_or_default();
        assert!(momentum <= 1e-9, "{momentum}");
        let residual = collision.residual_relative.unwrap_or_default();
        assert!(residual.abs() <= 2e-3, "{residual}");
    }
    assert!(n_computed > 4, "{n_computed}");
}

/// A case with numbers of any size ends with finite estimates or names the key to change, at 1e300 as at 1.
#[test]
fn check_of_extreme_sizes_gives_finite_estimates_or_a_key() {
    const TABLES: [&str; 5] =
        ["fem]", "condensed]", "ting]\nfinite_size=true", "auto]", "law]\nhertz={}"];
    const RELAXATIONS: [&str; 2] =
        ["", "relaxation={acts_on='shear', terms=[{weight=0.5, decay_rate=1e3}]}\n"];
    let mut random = Rng::with_seed(3);
    for _ in 0..150 {
        let [density, modulus, diameter, speed] =
            [(); 4].map(|()| format!("1e{:.0}", within(&mut random, -300.0, 300.0)));
        let model = TABLES[random.usize(..TABLES.len())];
        let relaxation = RELAXATIONS[random.usize(..2)];
        let text = format!(
            "[material.m]\ndensity={density}\nyoungs_modulus={modulus}\npoissons_ratio=0.3\n{relaxation}\
             [[body]]\nname='a'\nsphere={{diameter={diameter}}}\nmaterial='m'\napproach_speed={speed}\n\
             [[body]]\nname='b'\nwall={{}}\n[limits]\nelements=5000\n[model.{model}\n"
        );
        match simulation(&text) {
            Err(message) => {
                assert!(message.contains("any.toml") && message.len() > 20, "{message}")
            }
            Ok(simulation) => {
                let setup = simulation.setup();
                let hertz = &setup.estimate.hertz;
                assert!(hertz.contact_time() > 0.0 && hertz.contact_time().is_finite());
                assert!(hertz.peak_force() > 0.0 && hertz.peak_force().is_finite());
                if let Cost::Steps { seconds, time_step, .. } = setup.cost {
                    assert!(seconds.is_finite() && time_step > 0.0);
                }
                for plan in setup.elements.iter().map(|elements| &elements.plan) {
                    assert!(plan.contact_element_size > 0.0 && plan.candidate_radius > 0.0);
                    assert!((plan.contact_element_size + plan.candidate_radius).is_finite());
                }
                let neglected = setup.decisions.all.iter();
                for error in
                    neglected.filter_map(|one| simulation.neglect_error(one, &setup.estimate))
                {
                    let NeglectError { restitution, contact_time_s, peak_force_n } = error;
                    let is_number = |change: &f64| change.is_finite() && *change >= 0.0;
                    let told = [restitution, contact_time_s, peak_force_n];
                    assert!(told.iter().flatten().all(is_number), "{text}: {error:?}");
                    assert!(restitution.is_none_or(|change| change <= 1.0), "{text}: {error:?}");
                }
            }
        }
    }
}
