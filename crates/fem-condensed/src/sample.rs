//! One instant of the relative motion, and what it is of both bodies.

use fem_collision::{Account, Book, Frame, Row};

/// One instant of the relative motion.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Sample {
    /// Since first touch, s.
    pub time: f64,
    /// N.
    pub contact_force: f64,
    /// m.
    pub contact_radius: f64,
    /// m.
    pub approach: f64,
    /// Pa.
    pub centre_pressure: f64,
    /// Of the approach, m/s.
    pub rate: f64,
    /// Stored in the bodies, J.
    pub strain: f64,
    /// Stored in penalty springs, J.
    pub contact: f64,
    /// That relaxation takes, W.
    pub power: f64,
    /// J.
    pub dissipated: f64,
    /// That waves take out of each body, W, if any leave it.
    pub radiated_power: Option<[f64; 2]>,
    /// Gone with waves, J.
    pub radiated: Option<f64>,
    /// J.
    pub residual: f64,
    /// Kinetic energy of each body relative to its mass centre, J.
    pub vibration: [f64; 2],
}

impl Sample {
    /// The end of the contact between two steps, where the force is zero; the rest linearly.
    pub fn between(before: &Self, after: &Self, time: f64) -> Self {
        let part = (time - before.time) / (after.time - before.time);
        let mean = |get: fn(&Self) -> f64| (1.0 - part) * get(before) + part * get(after);
        Self {
            time,
            contact_force: 0.0,
            contact_radius: 0.0,
            centre_pressure: 0.0,
            approach: mean(|sample| sample.approach),
            rate: mean(|sample| sample.rate),
            strain: mean(|sample| sample.strain),
            contact: mean(|sample| sample.contact),
            power: mean(|sample| sample.power),
            dissipated: mean(|sample| sample.dissipated),
            radiated_power: after.radiated_power,
            radiated: before.radiated.zip(after.radiated).map(|(a, b)| (1.0 - part) * a + part * b),
            residual: mean(|sample| sample.residual),
            vibration: [0, 1]
                .map(|side| (1.0 - part) * before.vibration[side] + part * after.vibration[side]),
        }
    }

    /// What is in each account, J.
    pub fn energies(&self, frame: &Frame) -> Book {
        let [lower, upper] = self.vibration;
        let mut book = Book::EMPTY
            .with(Account::Kinetic, frame.kinetic(self.rate) + lower + upper)
            .with(Account::Strain, self.strain)
            .with(Account::Contact, self.contact)
            .with(Account::ViscousDissipation, self.dissipated)
            .with(Account::WallWork, frame.wall_work(self.rate));
        let of_effects = [
            (Account::Radiated, self.radiated),
            (Account::Potential, frame.potential(self.approach)),
        ];
        for (account, energy) in of_effects {
            if let Some(energy) = energy {
                book.add(account, energy);
            }
        }
        book
    }

    /// The same of both bodies.
    pub fn row(&self, frame: &Frame) -> Row {
        Row {
            time: frame.approach.first_touch() + self.time,
            contact_force: self.contact_force,
            contact_radius: Some(self.contact_radius),
            approach: self.approach,
            centre_pressure: Some(self.centre_pressure),
            velocity: frame.velocities(self.rate),
            energies: self.energies(frame),
            residual: Some(self.residual),
            vibration: self.vibration,
        }
    }
}
