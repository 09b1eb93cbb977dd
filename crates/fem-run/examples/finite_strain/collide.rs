//! Collisions with and without finite strain.

use std::path::Path;

use fem::{Case, Simulation};
use fem_validate::Pulse;

/// Why there is no number.
pub type Fault = Box<dyn std::error::Error + Send + Sync>;

/// Elements across Hertz' contact radius, twice the plan's: what small strains change is small next to what meshes do.
const ELEMENTS: f64 = 16.0;

/// What a collision is known by.
#[derive(Clone, Copy, Debug)]
pub struct Numbers {
    pub restitution: f64,
    pub pulse: Pulse,
}

/// By how much one collision differs from another: of the restitution, and shares of time, force and pressure.
#[derive(Clone, Copy, Debug)]
pub struct Changes {
    pub restitution: f64,
    pub time: f64,
    pub force: f64,
    pub pressure: f64,
}

impl Numbers {
    /// Of a run that comes to its end; none of one that stops, such as of a body that collapses.
    pub fn of(simulation: &Simulation) -> Option<Self> {
        let collision = simulation.run(&mut ());
        let restitution = collision.restitution.filter(|_| collision.is_complete())?;
        let pulse = Pulse::of(&collision.history, collision.contact_time?);
        Some(Self { restitution, pulse })
    }

    /// What changes from another collision to this one.
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

/// Stiffness of springs over the usual one at which nodes with mass hardly ring on them; those of flat spheres that are
/// nearly incompressible ring less on usual ones.
const SOFT: f64 = 0.3;
const FLAT: f64 = 0.3;
const NEARLY_INCOMPRESSIBLE: f64 = 0.4;

/// The keys of runs that are compared, of a contact that Hertz foretells to be a share of a radius (m), and of a Poisson's
/// ratio: springs, which finite strain has for itself and small strain only if told, and next to no moved mass, of which
/// they would have unlike shares.
pub fn alike(strain: f64, radius: f64, poissons_ratio: f64) -> Vec<String> {
    let is_stiff = strain > FLAT && poissons_ratio > NEARLY_INCOMPRESSIBLE;
    vec![
        "contact.method='penalty'".to_string(),
        format!("contact.penalty_factor={}", if is_stiff { 1.0 } else { SOFT }),
        "time.mass_scaling=2e-4".to_string(),
        format!("mesh.contact_element_size={}", strain * radius / ELEMENTS),
    ]
}

/// A case of a text with some keys set, which keeps no snapshots.
pub fn simulation(text: &str, set: &[String]) -> Result<Simulation, Fault> {
    let case = Case::parse("scene.toml", text, Path::new("."), set)?;
    let mut simulation = Simulation::new(case)?;
    simulation.skip_snapshots();
    Ok(simulation)
}

/// At which Hertz' contact radius is this share of the effective radius, m/s:
/// (a/R*)⁵ = (δ/R*)^(5/2) = 15 m* v²/(16 E* R*³).
pub fn speed(strain: f64, [radius, mass, modulus]: [f64; 3]) -> f64 {
    (strain.powi(5) * 16.0 * modulus * radius.powi(3) / (15.0 * mass)).sqrt()
}

/// "+1.20"; nothing has no sign.
pub fn signed(number: f64, digits: usize) -> String {
    let text = format!("{number:+.digits$}").replace('-', "−");
    match text.contains(|digit: char| ('1'..='9').contains(&digit)) {
        true => text,
        false => "0".to_string(),
    }
}
