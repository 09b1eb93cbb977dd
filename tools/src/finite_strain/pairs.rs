//! Pairs other than a sphere and a rigid wall: the changes by finite strain, and the plan's estimates.

use rayon::prelude::*;

use fem::effects::{Effect, FiniteStrain, NeglectError};

use super::collide::{Changes, Fault, Numbers, alike, signed, simulation, speed};

const STRAINS: [f64; 3] = [0.2, 0.4, 0.7];
const POISSONS_RATIOS: [f64; 2] = [0.2, 0.45];
const RADIUS: f64 = 0.01;
const DENSITY: f64 = 1000.0;
const YOUNGS_MODULUS: f64 = 1e7;
const STEEL: [f64; 3] = [7850.0, 2e11, 0.3];
/// Modulus of the harder of two unlike soft bodies over that of the other.
const HARDER: f64 = 3.0;

/// Two bodies, each with its index in [`materials`].
struct Pair {
    name: &'static str,
    /// Radius over that of the ball; `None` for a half-space.
    partner: (Option<f64>, usize),
    ball: usize,
}

const PAIRS: [Pair; 6] = [
    Pair { name: "ball on a half-space of its own", partner: (None, 0), ball: 0 },
    Pair { name: "ball on a harder half-space", partner: (None, 1), ball: 0 },
    Pair { name: "harder ball on a half-space", partner: (None, 0), ball: 1 },
    Pair { name: "steel ball on a half-space", partner: (None, 0), ball: 2 },
    Pair { name: "ball on one of its own, 1:3", partner: (Some(3.0), 0), ball: 0 },
    Pair { name: "ball on a harder one", partner: (Some(1.0), 1), ball: 0 },
];

/// Returns density, Young's modulus and Poisson's ratio of the soft, the harder and the steel body.
fn materials(nu: f64) -> [[f64; 3]; 3] {
    [[DENSITY, YOUNGS_MODULUS, nu], [DENSITY, HARDER * YOUNGS_MODULUS, nu], STEEL]
}

pub fn table() -> Result<String, Fault> {
    let scenes: Vec<(&Pair, f64, f64)> = PAIRS
        .iter()
        .flat_map(|pair| POISSONS_RATIOS.map(|nu| STRAINS.map(|strain| (pair, nu, strain))))
        .flatten()
        .collect();
    let lines: Vec<String> = scenes
        .par_iter()
        .map(|(pair, nu, strain)| pair.line(*nu, *strain))
        .collect::<Result<_, _>>()?;
    let head = "| pair | ν | a/R\\* | Δe | ΔT | ΔF | foretold: e | T | F |\n\
                |---|---|---|---|---|---|---|---|---|\n";
    Ok(format!("{head}{}", lines.concat()))
}

impl Pair {
    fn line(&self, nu: f64, strain: f64) -> Result<String, Fault> {
        let text = self.text(nu, strain);
        let switched = |switch: &str| {
            let mut set = alike(strain, self.radius(), nu);
            set.push(format!("effects.finite_strain='{switch}'"));
            simulation(&text, &set)
        };
        let (off, on) = (switched("off")?, switched("on")?);
        let stopped = || format!("{} stopped at a/R* = {strain}, ν = {nu}", self.name);
        let [without, with] = [&off, &on].map(Numbers::of);
        let changes = with.ok_or_else(stopped)?.against(&without.ok_or_else(stopped)?);
        let Changes { restitution, time, force, .. } = changes;
        let foretold = foretold(&off)?;
        let hertz = &off.setup().estimate.hertz;
        let share = |of: Option<f64>, whole: f64| {
            of.map_or("?".to_string(), |size| format!("{:.2}", 100.0 * size / whole))
        };
        Ok(format!(
            "| {} | {nu} | {strain} | {} | {} | {} | {:.3} | {} | {} |\n",
            self.name,
            signed(restitution, 3),
            signed(100.0 * time, 2),
            signed(100.0 * force, 2),
            foretold.restitution.unwrap_or(f64::NAN),
            share(foretold.contact_time_s, hertz.contact_time()),
            share(foretold.peak_force_n, hertz.peak_force()),
        ))
    }

    /// Returns the effective radius, m.
    fn radius(&self) -> f64 {
        in_series(RADIUS, self.partner.0.map(|ratio| ratio * RADIUS))
    }

    fn text(&self, nu: f64, strain: f64) -> String {
        let materials = materials(nu);
        let (ratio, other) = self.partner;
        let mass =
            |radius: f64, density: f64| 4.0 / 3.0 * std::f64::consts::PI * density * radius.powi(3);
        let compliance = |material: usize| {
            let [_, youngs_modulus, nu] = materials[material];
            (1.0 - nu * nu) / youngs_modulus
        };
        let partner = ratio.map(|ratio| ratio * RADIUS);
        let hertz = [
            self.radius(),
            in_series(
                mass(RADIUS, materials[self.ball][0]),
                partner.map(|radius| mass(radius, materials[other][0])),
            ),
            1.0 / (compliance(self.ball) + compliance(other)),
        ];
        let mut text = String::new();
        for (k, [density, youngs_modulus, nu]) in materials.iter().enumerate() {
            text += &format!(
                "[material.m{k}]\ndensity = {density}\nyoungs_modulus = {youngs_modulus:e}\n\
                 poissons_ratio = {nu}\nhyperelastic = \"neo-hooke\"\n"
            );
        }
        let shape = partner.map_or("half_space = {}".to_string(), |radius| {
            format!("sphere = {{ diameter = {} }}", 2.0 * radius)
        });
        text + &format!(
            "[[body]]\nname = \"partner\"\n{shape}\nmaterial = \"m{other}\"\n\
             [[body]]\nname = \"ball\"\nsphere = {{ diameter = {} }}\nmaterial = \"m{}\"\n\
             approach_speed = {}\n",
            2.0 * RADIUS,
            self.ball,
            speed(strain, hertz),
        )
    }
}

/// Returns 1/(1/a + 1/b), or a if there is no b.
fn in_series(a: f64, b: Option<f64>) -> f64 {
    1.0 / (1.0 / a + b.map_or(0.0, |b| 1.0 / b))
}

/// Returns the plan's estimate of the changes without finite strain.
fn foretold(simulation: &fem::Simulation) -> Result<NeglectError, Fault> {
    let estimate = &simulation.setup().estimate;
    let neglect_error = FiniteStrain.neglect_error(simulation.case().scene(), estimate);
    Ok(neglect_error.ok_or("nothing is foretold")?)
}
