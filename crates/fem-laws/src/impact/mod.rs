//! The result of a collision, of the same form for every model, and its interpolation in time.

mod path;
mod quantities;

pub use path::ImpactPath;
pub use quantities::ImpactQuantities;

/// Restitution below which bodies count as staying together, in every model: they part with less than a thousandth of their speed of
/// approach, as slowly as bodies of elements creep that have come to rest.
pub const MIN_RESTITUTION: f64 = 1e-3;

/// Share of the speed of approach, by motion and by energy, below which the integration of a law ends: its largest approach is then final.
pub(crate) const AT_REST: f64 = 1e-6;

/// Summary and history of one collision, from first touch to the end of contact.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Impact {
    /// Relative velocity after over before; 0 if the bodies stay together.
    pub restitution: f64,
    /// s; `None` if the bodies stay together for ever.
    pub contact_time: Option<f64>,
    /// Largest force, N.
    pub peak_force: f64,
    /// Largest approach, m.
    pub max_approach: f64,
    /// Largest contact radius, m.
    pub max_contact_radius: f64,
    /// Largest pressure on the axis, Pa; `None` for a model without a pressure distribution.
    pub peak_pressure: Option<f64>,
    /// In the order of time, denser where the state changes faster; the first instant is first
    /// touch, the last the end of contact.
    pub history: Vec<ImpactInstant>,
}

/// State of a contact at one instant.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct ImpactInstant {
    /// After first touch, s.
    pub time: f64,
    /// Approach δ, m.
    pub approach: f64,
    /// Rate of the approach δ̇, m/s.
    pub approach_rate: f64,
    /// Contact force, N; positive in compression.
    pub force: f64,
    /// Contact radius a, m.
    pub contact_radius: f64,
    /// Pressure on the axis, Pa; `None` for a model without a pressure distribution.
    pub centre_pressure: Option<f64>,
    /// ∫F dδ since first touch: what the motion has given to the contact, J.
    pub work: f64,
    /// Energy stored in the contact, J, from the state; `None` if the model does not compute it.
    pub strain_energy: Option<f64>,
    /// Energy dissipated in the bodies, J, from the state; `None` if the model does not compute it.
    pub dissipated: Option<f64>,
    /// Energy radiated as waves, J, from the state; `None` for a model without radiation.
    pub radiated: Option<f64>,
    /// Energy given to the bending waves of a plate, J, from the state; `None` without a plate. Where all four are known they
    /// add up to the work.
    pub plate: Option<f64>,
}

impl Impact {
    /// Returns the impact with the restitution and the contact time (s) of bodies that part, or stay together where too little of the
    /// speed comes back.
    pub(crate) fn parted(self, restitution: f64, contact_time: f64) -> Self {
        match restitution < MIN_RESTITUTION {
            true => Self { restitution: 0.0, contact_time: None, ..self },
            false => Self { restitution, contact_time: Some(contact_time), ..self },
        }
    }

    /// Returns the quantities of interest with a peak pressure, Pa, which not every model computes.
    pub fn quantities(&self, peak_pressure: f64) -> ImpactQuantities {
        ImpactQuantities {
            restitution: self.restitution,
            contact_time: self.contact_time.unwrap_or(f64::INFINITY),
            peak_force: self.peak_force,
            max_approach: self.max_approach,
            max_contact_radius: self.max_contact_radius,
            peak_pressure,
        }
    }

    /// Returns the energy radiated as waves, J; `None` for a model without radiation.
    pub fn radiated(&self) -> Option<f64> {
        self.history.last()?.radiated
    }
}

impl ImpactInstant {
    /// Returns the state at first touch at a relative speed, m/s; `pressure` and `energies` are whether the model
    /// computes them.
    pub(crate) fn first_touch(speed: f64, pressure: bool, energies: bool) -> Self {
        Self {
            time: 0.0,
            approach: 0.0,
            approach_rate: speed,
            force: 0.0,
            contact_radius: 0.0,
            centre_pressure: pressure.then_some(0.0),
            work: 0.0,
            strain_energy: energies.then_some(0.0),
            dissipated: energies.then_some(0.0),
            radiated: None,
            plate: None,
        }
    }
}
