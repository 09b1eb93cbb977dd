//! Collisions with and without finite strain.

use std::path::Path;

use fem::{Case, Simulation};
use fem_validate::Pulse;

/// The error of an example.
pub type Fault = Box<dyn std::error::Error + Send + Sync>;

/// Elements across Hertz' contact radius, twice the plan's number, so that mesh errors are small beside
/// those of small strain.
const ELEMENTS: f64 = 16.0;

/// The results of a collision.
#[derive(Clone, Copy, Debug)]
pub struct Numbers {
    pub restitution: f64,
    pub pulse: Pulse,
}

/// Differences between two collisions: absolute for the restitution, relative for time, force and pressure.
#[derive(Clone, Copy, Debug)]
pub struct Changes {
    pub restitution: f64,
    pub time: f64,
    pub force: f64,
    pub pressure: f64,
}

impl Numbers {
    /// Returns the results of a complete run; `None` if it stopped, for example because a body collapsed.
    pub fn of(simulation: &Simulation) -> Option<Self> {
        let collision = simulation.run(&mut ());
        let restitution = collision.restitution.filter(|_| collision.is_complete())?;
        let pulse = Pulse::of(&collision.history, collision.contact_time?);
        Some(Self { restitution, pulse })
    }

    /// Returns the changes from another collision to this one.
    pub fn against(&self, other: &Self) -> Changes {
        let share = |own: f64, other: f64| own / other - 1.0;
        Changes {
            restitution: self.restitution - other.restitution,
            time: share(self.pulse.time, other.pulse.time),
            force: share(self.pulse.force, other.pulse.force),
            pressure: share(self.pulse.pressure, other.pulse.pressure),
        }
    }
}

/// Penalty factor for which nodes with mass hardly oscillate; flat, nearly incompressible spheres oscillate
/// less with the default.
const SOFT: f64 = 0.3;
const FLAT: f64 = 0.3;
const NEARLY_INCOMPRESSIBLE: f64 = 0.4;

/// Returns the settings of comparable runs for a contact of this radius (m) and Poisson's ratio: penalty
/// springs, which finite strain always has, and little mass scaling, which would differ between the runs.
pub fn alike(strain: f64, radius: f64, poissons_ratio: f64) -> Vec<String> {
    let is_stiff = strain > FLAT && poissons_ratio > NEARLY_INCOMPRESSIBLE;
    vec![
        "contact.method='penalty'".to_string(),
        format!("contact.penalty_factor={}", if is_stiff { 1.0 } else { SOFT }),
        "time.mass_scaling=2e-4".to_string(),
        format!("mesh.contact_element_size={}", strain * radius / ELEMENTS),
    ]
}

/// Returns a case from its text and overrides, without snapshots.
pub fn simulation(text: &str, set: &[String]) -> Result<Simulation, Fault> {
    let case = Case::parse("scene.toml", text, Path::new("."), set)?;
    Ok(Simulation::new(case)?.without_snapshots())
}

/// Returns the speed (m/s) at which Hertz' contact radius is this share of the effective radius: (a/R*)⁵ =
/// (δ/R*)^(5/2) = 15 m* v²/(16 E* R*³).
pub fn speed(strain: f64, [radius, mass, modulus]: [f64; 3]) -> f64 {
    (strain.powi(5) * 16.0 * modulus * radius.powi(3) / (15.0 * mass)).sqrt()
}

/// Returns a number with its sign, "+1.20"; zero has no sign.
pub fn signed(number: f64, digits: usize) -> String {
    let text = format!("{number:+.digits$}").replace('-', "−");
    match text.contains(|digit: char| ('1'..='9').contains(&digit)) {
        true => text,
        false => "0".to_string(),
    }
}
