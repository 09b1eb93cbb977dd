//! The loading half of a viscoelastic contact, kept so that unloading can look back into it.
//!
//! All quantities are dimensionless (see [`crate::ting`]). A Maxwell element k remembers three
//! drives, each M_k(t) = ∫₀ᵗ e^(−b_k(t−s)) f(s) ds: of u^(3/2) the force, of u the condition on
//! t₁, of √u the pressure on the axis.

use crate::finite_size::correction::Correction;
use crate::numerics::exp;
use crate::plate::SINKING_LAMBDA;
use crate::ting::collocation::dot;
use crate::ting::collocation::{
    Interpolation, POINTS, Vector, double_integral, evaluate, fading_moments, integral,
};
use crate::ting::radiation_compliance::Radiation;

/// Memory of a Maxwell element for d(u^(3/2)), du and d√u.
pub(crate) type Memory = [f64; 3];

/// Indices into [`Memory`].
pub(crate) const FORCE: usize = 0;
pub(crate) const SURFACE: usize = 1;
pub(crate) const PRESSURE: usize = 2;

/// One Maxwell element of the contact.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Element {
    /// Weight g_k of the element.
    pub weight: f64,
    /// Rate b_k of the element.
    pub rate: f64,
    /// Finite size: of the memory of the force, without its weight.
    pub correction: Correction,
}

/// The constants of one collision.
#[derive(Debug, Clone)]
pub(crate) struct Contact {
    /// Equilibrium weight g∞.
    pub equilibrium: f64,
    pub elements: Vec<Element>,
    /// Finite size: of u^(3/2) itself.
    pub correction: Correction,
    /// Waves that leave, if they do.
    pub radiation: Option<Radiation>,
    /// A thin plate in series, if there is one.
    pub plate: Option<Plate>,
    /// Acceleration of the approach by gravity; 0 without gravity.
    pub gravity: f64,
    /// Accuracy of the iterations.
    pub accuracy: IterationAccuracy,
}

/// Accuracy of the iterations of a collision.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct IterationAccuracy {
    /// Change of the rate, of 1, at which those of a step end.
    pub rate: f64,
    /// Newton's for Hertz' approach: from an error of 1e-2 to 1e-4, 1e-8, 1e-16.
    pub n_newton: usize,
    /// Change of t₁ over the time of loading at which the search for it ends.
    pub equivalent_time: f64,
}

impl IterationAccuracy {
    /// To rounding: the force has an error of its slope 1.5 √u u̇ ≤ 2 times that of t₁.
    pub const FULL: Self = Self { rate: 1e-14, n_newton: 4, equivalent_time: 1e-13 };

    /// Accuracy for a collision that only estimates an effect.
    pub const FORECAST: Self = Self { rate: 1e-8, n_newton: 3, equivalent_time: 1e-9 };
}

/// A thin plate as a dashpot in series.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Plate {
    /// β, whose dimensionless value is Zener's λ.
    pub mobility: f64,
    /// δ̇ at first touch.
    pub first_rate: f64,
}

impl Plate {
    /// Returns whether the ball sinks in with the plate.
    pub fn takes_all(&self) -> bool {
        self.mobility >= SINKING_LAMBDA
    }

    /// Returns the deflection w = β ∫F dt, which the motion gives: the impulse is what it has lost of its rate.
    pub fn deflection(&self, rate: f64, gravity: f64, time: f64) -> f64 {
        self.mobility * (self.first_rate + gravity * time - rate)
    }
}

impl Contact {
    /// Returns whether the contact's own approach lags behind that of the mass centres.
    pub fn has_far_field(&self) -> bool {
        self.radiation.is_some() || self.plate.is_some()
    }

    /// Returns the deflection of the plate at a rate of the approach and a time; 0 without a plate.
    pub fn deflection(&self, rate: f64, time: f64) -> f64 {
        self.plate.map_or(0.0, |plate| plate.deflection(rate, self.gravity, time))
    }

    /// Returns the rate of that deflection under a force.
    pub fn deflection_rate(&self, force: f64) -> f64 {
        self.plate.map_or(0.0, |plate| plate.mobility * force)
    }

    /// Returns Hertz' approach u at δ, with the internal variables of the elements.
    pub fn hertz_approach(&self, approach: f64, memory: &[Memory]) -> f64 {
        self.inverted(approach, &self.remembered(memory)).0
    }

    /// Returns u and ∂u/∂δ at δ, with the internal variables of the finite size.
    pub fn inverted(&self, approach: f64, remembered: &Correction) -> (f64, f64) {
        self.correction.hertz_approach_after(self.accuracy.n_newton, approach, remembered)
    }

    /// Returns the finite-size correction for the memories of the elements.
    pub fn remembered(&self, memory: &[Memory]) -> Correction {
        let mut remembered = Correction::NONE;
        for (element, memory) in self.elements.iter().zip(memory) {
            remembered.add(&element.correction, memory[FORCE]);
        }
        remembered
    }
}

/// One step of the motion as polynomials of θ = (t − start)/length.
#[derive(Debug, Clone)]
pub(crate) struct Step {
    pub start: f64,
    pub length: f64,
    /// δ and δ̇ at the start.
    pub approach: f64,
    pub rate: f64,
    /// Force of the contact.
    pub gravity: f64,
    /// At the start, of each element.
    pub memory: Vec<Memory>,
    pub force: Vector,
    /// At the start; 0 without radiation.
    pub slow_force: f64,
    /// Time derivatives of u^(3/2), u and √u.
    pub drives: [Vector; 3],
}

impl Step {
    pub fn approach_at(&self, theta: f64) -> f64 {
        let given = 0.5 * self.gravity * theta * theta;
        let lost = self.length * (double_integral(&self.force, theta) - given);
        self.approach + self.length * (self.rate * theta - lost)
    }

    pub fn rate_at(&self, theta: f64) -> f64 {
        self.rate - self.length * (integral(&self.force, theta) - self.gravity * theta)
    }

    /// Returns the share of δ that is the contact's own.
    pub fn contact_approach_at(&self, contact: &Contact, theta: f64) -> f64 {
        let time = self.start + theta * self.length;
        let approach = self.approach_at(theta) - contact.deflection(self.rate_at(theta), time);
        match &contact.radiation {
            None => approach,
            Some(radiation) => {
                let slow_force = self.slow_force_at(radiation, theta);
                approach - radiation.approach(evaluate(&self.force, theta), slow_force)
            }
        }
    }

    /// Returns u̇ for this ∂u/∂δ of the contact, without the creep of the finite size, a few per cent of a
    /// per cent.
    pub fn hertz_rate_at(&self, contact: &Contact, compression: f64, theta: f64) -> f64 {
        match contact.has_far_field() {
            false => compression * self.rate_at(theta),
            true => evaluate(&self.drives[SURFACE], theta),
        }
    }

    /// Returns whether the contact grows.
    pub fn grows_at(&self, contact: &Contact, theta: f64) -> bool {
        self.hertz_rate_at(contact, 1.0, theta) > 0.0
    }

    /// Returns whether gravity has turned the motion back in unloading. On a plate, whose deflection outlasts the largest
    /// contact, it is that of the surfaces.
    pub fn turns_back_at(&self, contact: &Contact, theta: f64) -> bool {
        match contact.plate {
            None => self.rate_at(theta) >= 0.0,
            Some(_) => self.grows_at(contact, theta),
        }
    }

    /// Returns the force f.
    pub fn slow_force_at(&self, radiation: &Radiation, theta: f64) -> f64 {
        let z = radiation.rate * self.length;
        exp(-z * theta) * self.slow_force + z * dot(&fading_moments(theta, z), &self.force)
    }

    /// Returns γ ∫ḟ² dt from the start to θ.
    pub fn radiated_until(
        &self,
        radiation: &Radiation,
        interpolation: &Interpolation,
        theta: f64,
    ) -> f64 {
        let power = POINTS.map(|point| {
            let point = point * theta;
            let slow_force = self.slow_force_at(radiation, point);
            radiation.power(evaluate(&self.force, point), slow_force)
        });
        self.length * theta * integral(&interpolation.coefficients(&power), 1.0)
    }

    /// Returns ∫β F² dt from the start to θ: the energy that goes into the plate.
    pub fn plate_energy_until(
        &self,
        plate: &Plate,
        interpolation: &Interpolation,
        theta: f64,
    ) -> f64 {
        let power =
            POINTS.map(|point| plate.mobility * evaluate(&self.force, point * theta).powi(2));
        self.length * theta * integral(&interpolation.coefficients(&power), 1.0)
    }

    /// Returns ∫F dδ from the start to θ, exactly.
    pub fn work_until(&self, interpolation: &Interpolation, theta: f64) -> f64 {
        let power = POINTS.map(|point| {
            let point = point * theta;
            evaluate(&self.force, point) * self.rate_at(point)
        });
        self.length * theta * integral(&interpolation.coefficients(&power), 1.0)
    }

    pub fn memory_at(&self, element: usize, rate: f64, theta: f64) -> Memory {
        let z = rate * self.length;
        let decay = exp(-z * theta);
        let moments = fading_moments(theta, z);
        std::array::from_fn(|i| {
            decay * self.memory[element][i] + self.length * dot(&moments, &self.drives[i])
        })
    }

    /// Returns the internal variable of each element.
    pub fn memories(&self, contact: &Contact, theta: f64) -> Vec<Memory> {
        let elements = contact.elements.iter().enumerate();
        elements.map(|(k, element)| self.memory_at(k, element.rate, theta)).collect()
    }

    /// Returns g∞ u + Σ g_k ∫ e^(−b_k(t−s)) du: the force on a punch that has kept its first contact.
    pub fn surface_at(&self, contact: &Contact, theta: f64) -> f64 {
        let memories = self.memories(contact, theta);
        let remembered = contact.elements.iter().zip(&memories);
        contact.equilibrium
            * contact.hertz_approach(self.contact_approach_at(contact, theta), &memories)
            + remembered.map(|(element, memory)| element.weight * memory[SURFACE]).sum::<f64>()
    }
}

/// The steps of loading, up to the largest contact.
#[derive(Debug, Clone)]
pub(crate) struct Record {
    pub steps: Vec<Step>,
    /// Time of the largest contact: of the largest approach, unless waves leave or a plate bends.
    pub end: f64,
}

/// The shrinking contact at one instant of unloading.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct UnloadingContact {
    /// t₁, when the growing contact was as large.
    pub equivalent_time: f64,
    pub force: f64,
    /// Returns the approach u(t₁).
    pub hertz_approach: f64,
    /// On the axis.
    pub pressure: f64,
}

impl Record {
    /// Returns the contact at `time` in unloading: the t₁ at which the loading until then,
    /// faded since, equals the `surface` condition's part of now.
    pub fn shrunk(
        &self,
        contact: &Contact,
        time: f64,
        surface: f64,
        guess: f64,
    ) -> UnloadingContact {
        let (mut low, mut high) = (0.0, self.end);
        if surface <= 0.0 {
            return UnloadingContact {
                equivalent_time: 0.0,
                force: 0.0,
                hertz_approach: 0.0,
                pressure: 0.0,
            };
        }
        let mut t1 = guess.clamp(0.0, self.end);
        // Newton's method inside a bracket that bisection shrinks where it fails.
        for _ in 0..100 {
            let (value, slope, shrunk) = self.look_back(contact, time, t1);
            let excess = value - surface;
            if excess > 0.0 {
                high = t1;
            } else {
                low = t1;
            }
            let newton = t1 - excess / slope;
            let next = if newton > low && newton < high { newton } else { 0.5 * (low + high) };
            let settled = contact.accuracy.equivalent_time * self.end;
            if (next - t1).abs() <= settled || high - low <= settled {
                return shrunk;
            }
            t1 = next;
        }
        self.look_back(contact, time, t1).2
    }

    /// Returns the condition, its slope in t₁, and the contact.
    fn look_back(&self, contact: &Contact, time: f64, t1: f64) -> (f64, f64, UnloadingContact) {
        let index = self.steps.partition_point(|step| step.start <= t1).max(1) - 1;
        let step = &self.steps[index];
        let theta = (t1 - step.start) / step.length;
        let memories = step.memories(contact, theta);
        let remembered = contact.remembered(&memories);
        let approach = step.contact_approach_at(contact, theta);
        let (hertz, compression) = contact.inverted(approach, &remembered);
        let mut surface = contact.equilibrium * hertz;
        let mut force = contact.equilibrium * hertz * hertz.sqrt();
        let mut pressure = contact.equilibrium * hertz.sqrt();
        let mut relaxation = contact.equilibrium;
        for (element, memory) in contact.elements.iter().zip(&memories) {
            let faded = element.weight * exp(-element.rate * (time - t1));
            surface += faded * memory[SURFACE];
            force += faded * memory[FORCE];
            pressure += faded * memory[PRESSURE];
            relaxation += faded;
        }
        let slope = relaxation * step.hertz_rate_at(contact, compression, theta);
        (
            surface,
            slope,
            UnloadingContact { equivalent_time: t1, force, hertz_approach: hertz, pressure },
        )
    }
}

/// Returns the largest value on 0 ..= `end` of a polynomial that rises, then perhaps falls.
pub(crate) fn peak(coefficients: &Vector, end: f64) -> f64 {
    let rising = |theta: f64| crate::ting::collocation::derivative(coefficients, theta) > 0.0;
    let top = crate::numerics::bisection::last_where(0.0, end, rising);
    evaluate(coefficients, top).max(evaluate(coefficients, end))
}
