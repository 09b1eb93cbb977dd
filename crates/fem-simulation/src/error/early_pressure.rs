//! The pressure of bodies that relax to little, which is largest when the contact is small.
//!
//! A sphere of which little lasts presses hardest within some relaxation times after first touch, when the contact is
//! a tenth or a hundredth as wide as it gets. Elements that divide the whole contact are few across that one, and where
//! they are fewer than two nothing of it is read ([`RESOLVING_ELEMENTS`]). What it is off by is told with the others, and
//! Ting's model tells what is missing. The mesh is made finer for it as for other errors, unless it would have to be
//! many times finer.

use fem_collision::{Collision, QuantityOfInterest, RESOLVING_ELEMENTS, longest_at_pole};
use fem_material::engineering::{Unit, show};

use crate::effects::percent;
use crate::simulation::Simulation;

/// Contact radius over its largest below which a pressure is early. Bodies that keep a half of their moduli press
/// hardest at more than 0.8.
const EARLY: f64 = 0.5;
/// Relative error of a pressure times the square of the number of elements across the contact: 16 % with 2.7,
/// 4 to 5 % with 4.2, 1.3 % with 5, of spheres that relax to 3 % and to nothing,
/// against Ting's.
const ERROR: f64 = 1.2;
/// What Ting's forecast of such a pressure is off by.
const OF_FORECAST: f64 = 0.05;
/// Elements across the contact that do: 1.3 %.
const ENOUGH: f64 = 5.0;
/// So many times shorter elements are within reach.
const REACH: f64 = 4.0;

/// A peak pressure that comes early.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct EarlyPressure {
    /// Radius of the contact then, m.
    radius: f64,
    /// By how much the one that is told may be off because of that, Pa.
    pub error: f64,
    /// Length of the elements, m.
    size: f64,
}

impl EarlyPressure {
    /// Of a collision of bodies with elements; none where the pressure is largest in the middle of the contact.
    pub fn of(simulation: &Simulation, collision: &Collision) -> Option<Self> {
        let size = longest_at_pole(simulation.model().meshes());
        let (told, largest) = (collision.peak_pressure?, collision.max_contact_radius?);
        let own = collision.peak_pressure_radius?;
        let softened = simulation.estimate(collision)?.softened;
        let (foretold, then) = (softened.sizes.peak_pressure, softened.pressure_radius);
        if then >= EARLY * softened.sizes.max_contact_radius {
            return None;
        }
        // What the elements have not seen.
        if then < (RESOLVING_ELEMENTS * size).min(EARLY * largest) && foretold > told {
            let error = (1.0 + OF_FORECAST) * foretold - told;
            return Some(Self { radius: then, error, size });
        }
        let share = ERROR * (size / own).powi(2);
        (own < EARLY * largest).then_some(Self { radius: own, error: share * told, size })
    }

    /// Whether elements that see it are so much shorter that none are tried.
    pub fn is_beyond_reach(&self) -> bool {
        self.radius / ENOUGH < self.size / REACH
    }

    /// That it is off by more than the case allows where no finer mesh is tried, and what helps.
    pub fn warning(simulation: &Simulation, collision: &Collision) -> Option<String> {
        let early = Self::of(simulation, collision).filter(Self::is_beyond_reach)?;
        let told = collision.peak_pressure?;
        let doubt = simulation.discretisation(collision).size(QuantityOfInterest::PeakPressure)?;
        let is_off = doubt / told > simulation.case().scene().accuracy().peak_pressure;
        is_off.then(|| {
            format!(
                "the pressure is largest early, when the contact is {} wide and {:.1} elements across: the peak \
                 pressure may be off by {}; write mesh.contact_element_size = \"{}\" to see it",
                show(early.radius, "m"),
                early.radius / early.size,
                percent(doubt / told),
                Unit::fitting(early.radius / ENOUGH, "m").with_digits(2).show(early.radius / ENOUGH)
            )
        })
    }
}
