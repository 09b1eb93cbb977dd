//! A sample of the relative motion, and the row of the history that follows from it.

use fem_collision::{Account, EnergyLedger, Frame, HistoryRow};

use crate::run::between_steps::StepParabola;

/// The relative motion at one instant. SI units.
#[derive(Debug, Clone, Copy)]
pub(crate) struct MotionSample {
    /// Time since first touch, s.
    pub time: f64,
    /// Whether the bodies are in contact or at first touch.
    pub touches: bool,
    pub contact_force: f64,
    /// Contact force without its oscillation ([`crate::motion::ImpactMotion::force_oscillation`]), N.
    pub even_force: f64,
    pub contact_radius: f64,
    pub approach: f64,
    pub centre_pressure: f64,
    /// Rate of the approach, m/s.
    pub rate: f64,
    /// Energy stored in the bodies, J.
    pub strain: f64,
    /// Energy stored in penalty springs, J.
    pub contact: f64,
    /// Power dissipated by relaxation, W.
    pub power: f64,
    /// Energy dissipated by relaxation, J.
    pub dissipated: f64,
    /// Power radiated from each body, W, if included.
    pub radiated_power: Option<[f64; 2]>,
    /// Radiated energy, J.
    pub radiated: Option<f64>,
    /// Power that goes into a plate, W, if included.
    pub plate_power: Option<f64>,
    /// Energy that has gone into a plate, J.
    pub plate: Option<f64>,
    /// Residual of the energy balance, J.
    pub residual: f64,
    /// Kinetic energy of each body relative to its mass centre, J.
    pub vibration: [f64; 2],
}

impl MotionSample {
    /// Interpolates at a share of the step to the next sample. The sample before this one is given if the contact has
    /// not begun or ended since. If the contact ends within the step, the force is zero from that share on.
    pub fn within(
        before: Option<&Self>,
        begin: &Self,
        end: &Self,
        opens: Option<f64>,
        theta: f64,
    ) -> Self {
        let over = |get: fn(&Self) -> f64| StepParabola::new(before.map(get), get(begin), get(end));
        let at = |get: fn(&Self) -> f64| over(get).at(theta);
        let of_contact = |get: fn(&Self) -> f64| match opens {
            Some(share) if theta < share => (1.0 - theta / share) * get(begin),
            Some(_) => 0.0,
            None => at(get),
        };
        // Nothing is radiated, and no plate bends, before first touch.
        let of_waves = |get: &dyn Fn(&Self) -> Option<f64>| {
            let end = get(end)?;
            Some(StepParabola::new(before.and_then(get), get(begin).unwrap_or(0.0), end).at(theta))
        };
        let power_of = |side: usize| of_waves(&|sample| Some(sample.radiated_power?[side]));
        Self {
            time: begin.time + theta * (end.time - begin.time),
            touches: opens.map_or(end.touches, |share| theta < share),
            contact_force: of_contact(|sample| sample.contact_force),
            even_force: of_contact(|sample| sample.even_force),
            contact_radius: of_contact(|sample| sample.contact_radius),
            centre_pressure: of_contact(|sample| sample.centre_pressure),
            approach: at(|sample| sample.approach),
            rate: at(|sample| sample.rate),
            strain: at(|sample| sample.strain),
            contact: at(|sample| sample.contact),
            power: at(|sample| sample.power),
            dissipated: at(|sample| sample.dissipated),
            radiated_power: power_of(0).zip(power_of(1)).map(|(lower, upper)| [lower, upper]),
            radiated: of_waves(&|sample| sample.radiated),
            plate_power: of_waves(&|sample| sample.plate_power),
            plate: of_waves(&|sample| sample.plate),
            vibration: [at(|sample| sample.vibration[0]), at(|sample| sample.vibration[1])],
            residual: at(|sample| sample.residual),
        }
    }

    /// Returns the energy that is lost to relaxation, waves and a plate, J.
    pub fn lost(&self) -> f64 {
        self.dissipated + self.radiated.unwrap_or(0.0) + self.plate.unwrap_or(0.0)
    }

    /// Returns the energy in each account, J.
    pub fn energies(&self, frame: &Frame) -> EnergyLedger {
        let [lower, upper] = self.vibration;
        let mut ledger = EnergyLedger::EMPTY
            .with(Account::Kinetic, frame.kinetic(self.rate) + lower + upper)
            .with(Account::Strain, self.strain)
            .with(Account::Contact, self.contact)
            .with(Account::ViscousDissipation, self.dissipated)
            .with(Account::WallWork, frame.wall_work(self.rate));
        let of_effects = [
            (Account::Radiated, self.radiated),
            (Account::Plate, self.plate),
            (Account::Potential, frame.potential(self.approach)),
        ];
        for (account, energy) in of_effects {
            if let Some(energy) = energy {
                ledger.add(account, energy);
            }
        }
        ledger
    }

    /// Returns the row of the history.
    pub fn row(&self, frame: &Frame) -> HistoryRow {
        HistoryRow {
            time: frame.approach.first_touch() + self.time,
            contact_force: self.contact_force,
            contact_radius: Some(self.contact_radius),
            approach: self.approach,
            centre_pressure: Some(self.centre_pressure),
            velocity: frame.velocities(self.rate),
            energies: self.energies(frame),
            residual: Some(self.residual),
            vibration: self.vibration,
            tangential: None,
        }
    }
}
