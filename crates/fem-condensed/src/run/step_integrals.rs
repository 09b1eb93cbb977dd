//! Integrals over the steps of a collision, and its samples between the steps.

use super::ImpactRun;
use crate::run::between_steps::StepParabola;
use crate::run::sample::MotionSample;

impl ImpactRun<'_> {
    /// Returns the sample at the end of a step with its integrals. `before` is the sample before `begin`, if the
    /// contact has not begun or ended since.
    pub(super) fn integrated(
        &mut self,
        before: Option<&MotionSample>,
        begin: Option<&MotionSample>,
        end: MotionSample,
    ) -> MotionSample {
        let time_step = self.motion.time_step;
        if end.radiated_power.is_some() {
            self.radiated.get_or_insert([0.0; 2]);
        }
        if end.plate_power.is_some() {
            self.plate.get_or_insert(0.0);
        }
        let mut rate = end.rate;
        if let Some(begin) = begin {
            let over = |get: &dyn Fn(&MotionSample) -> f64| {
                StepParabola::new(before.map(get), get(begin), get(&end)).integral(1.0) * time_step
            };
            self.dissipated += over(&|sample| sample.power);
            for (side, gone) in self.radiated.iter_mut().flatten().enumerate() {
                *gone += over(&|sample| sample.radiated_power.map_or(0.0, |both| both[side]));
            }
            if let Some(plate) = &mut self.plate {
                *plate += over(&|sample| sample.plate_power.unwrap_or(0.0));
            }
            // The impulse of the integrated motion, which changes its momentum.
            self.impulse += 0.5 * time_step * (begin.contact_force + end.contact_force);
            self.impulse -= self.motion.momentum_of_joining;
            if end.touches {
                rate += self.rate_of_third_order(before, begin, &end);
            }
        }
        self.missed_slope = self.motion.missed_slope;
        let radiated = self.radiated.map(|[lower, upper]| lower + upper);
        let (dissipated, plate) = (self.dissipated, self.plate);
        self.with_residual(MotionSample { rate, dissipated, radiated, plate, ..end })
    }

    /// Returns the correction of Newmark's rate with γ = 1/2, the trapezoidal rule, to third order: Δt Ḟ Δt/12 m*, m/s.
    /// Points that have joined are not part of the smooth slope.
    fn rate_of_third_order(
        &self,
        before: Option<&MotionSample>,
        begin: &MotionSample,
        end: &MotionSample,
    ) -> f64 {
        let missed = self.motion.missed_slope;
        let before = before.filter(|_| missed == 0.0 && self.missed_slope == 0.0);
        let force = |sample: &MotionSample| sample.contact_force;
        let change = StepParabola::new(before.map(force), force(begin), force(end));
        self.motion.time_step / 12.0 * (change.slope() + missed) / self.pair.reduced_mass
    }

    /// Adds the instants of a step, including its end, to pulse and history.
    pub(super) fn observe_within(
        &mut self,
        before: Option<MotionSample>,
        begin: Option<MotionSample>,
        end: MotionSample,
    ) {
        let (step, per_step) = (self.motion.step as u64, self.per_step);
        if let Some(begin) = begin {
            let opens = (begin.touches && !end.touches)
                .then(|| (self.last_contact - begin.time) / self.motion.time_step);
            let force = |sample: &MotionSample| sample.even_force;
            let even = StepParabola::new(before.as_ref().map(force), force(&begin), force(&end));
            for k in 1..per_step {
                let theta = k as f64 / per_step as f64;
                let within = MotionSample::within(before.as_ref(), &begin, &end, opens, theta);
                let impulse = self.even_impulse + self.motion.time_step * even.integral(theta);
                // Radius and pressure are those at the end of the step: the first facet is not part of the contact.
                self.pulse.observe(within.time, impulse, end.contact_radius, end.centre_pressure);
                if self.history.is_some() {
                    let row = self.with_residual(within).row(self.frame);
                    let instant = (step - 1) * per_step + k;
                    let touches = within.touches;
                    self.history.iter_mut().for_each(|it| it.follow(instant, touches, row));
                }
            }
            self.even_impulse += self.motion.time_step * even.integral(1.0);
        }
        self.pulse.observe(end.time, self.even_impulse, end.contact_radius, end.centre_pressure);
        if let Some(history) = &mut self.history {
            history.follow(step * per_step, self.was_closed, end.row(self.frame));
        }
    }

    /// Returns the sample with its energy residual.
    pub(super) fn with_residual(&self, sample: MotionSample) -> MotionSample {
        let MotionSample { rate, vibration: [lower, upper], strain, contact, .. } = sample;
        let kinetic = 0.5 * self.pair.reduced_mass * rate * rate + lower + upper;
        let lost = sample.lost();
        let potential = self.frame.potential(sample.approach).unwrap_or(0.0);
        let residual = kinetic + strain + contact + lost + potential - self.initial_energy;
        MotionSample { residual, ..sample }
    }
}
