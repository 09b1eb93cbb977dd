//! Time stepping of the relative motion.
//!
//! ```math
//! m^*\ddot\delta = m^*g - F, \qquad F = \mathbf 1^T\mathbf p, \qquad
//! \mathbf g = \mathbf g_0 - \delta + \sum_i \mathbf u_i \ge 0
//! ```
//!
//! Newmark's formulas have γ = 1/2 and β = 1/12 ([`BETA`]). The approach at the end of a step depends
//! on the force there, which adds β Δt²/m* to every entry of the compliance. Relaxing modes and modes of vibration
//! ([`ViscoelasticModes`]) add to it in the same way. So one contact problem with a constant matrix is solved per
//! step.

use fem_collision::{StepInstant, Stop};
use fem_material::{ActsOn, PronySeries};

use crate::contact::disc_contact::{ContactDisc, DiscContactSolver};
use crate::error::CondensedError;
use crate::operators::body_operator::BodyOperator;
use crate::operators::plate::PlateDashpot;
use crate::operators::radiation::WaveRadiation;
use crate::operators::viscoelastic_modes::{BETA, ViscoelasticModes, ViscoelasticState};
use crate::pair::CondensedPair;
use crate::settings::ContactModel;
use crate::settings::Damping;

/// Share of the kinetic energy up to which the work correction is applied at once.
const SMALL_SHARE: f64 = 1e-2;

/// State of one body in addition to its elastic compliance.
#[derive(Debug, Clone, Default)]
pub(crate) struct BodyState {
    /// Relaxing modes, if the body relaxes.
    pub springs: Option<ViscoelasticModes>,
    /// Slip of its surface, if included.
    pub slip: Option<ViscoelasticModes>,
    /// Static response of the modes of vibration, which is subtracted, and their dynamic response.
    pub vibration: Option<[ViscoelasticModes; 2]>,
}

/// Relative motion and contact of both bodies.
#[derive(Debug, Clone)]
pub(crate) struct ImpactMotion<'a> {
    pair: &'a CondensedPair,
    pub time_step: f64,
    pub step: usize,
    pub approach: f64,
    pub rate: f64,
    acceleration: f64,
    /// Gravity, m/s²; 0 if absent.
    gravity: f64,
    pub sides: [BodyState; 2],
    /// Work of points that join and leave which is not corrected yet, J.
    excess_work: f64,
    /// Momentum correction of the last step for points that joined or left, N s.
    pub momentum_of_joining: f64,
    /// Contribution of these points to the change of the force per step at the end of the step, N.
    pub missed_slope: f64,
    /// Radiated waves of the bodies, if included.
    waves: Option<WaveRadiation>,
    /// A plate that bends, if included.
    plate: Option<PlateDashpot>,
    solver: DiscContactSolver,
    /// Largest number of closed points with which the contact certainly ends before the last point.
    most_closed: usize,
    overlap: Vec<f64>,
    /// Forces at the points, N.
    pub forces: Vec<f64>,
    pub force: f64,
    pub contact: ContactDisc,
}

impl<'a> ImpactMotion<'a> {
    /// Creates the state at first touch at a relative speed (m/s), with the first `n_points` points.
    ///
    /// # Errors
    /// Modes of a relaxing shear modulus that cannot be computed.
    pub fn new(
        pair: &'a CondensedPair,
        speed: f64,
        damping: Damping<'_>,
        time_step: f64,
        n_points: usize,
    ) -> Result<Self, CondensedError> {
        let of_spring = |i: usize, j: usize| if i == j { pair.spring_compliance[i] } else { 0.0 };
        let mut compliance = faer::Mat::from_fn(n_points, n_points, of_spring);
        add_to_all(&mut compliance, BETA * time_step * time_step / pair.reduced_mass);
        let mut sides = [BodyState::default(), BodyState::default()];
        for (which, state) in sides.iter_mut().enumerate() {
            let Some(side) = &pair.sides[which] else { continue };
            let series = damping.relaxations[which];
            let shear_blocks = pair.shear_blocks(series, speed)?;
            *state = BodyState::new(side, series, shear_blocks, time_step, n_points)?;
            match &state.springs {
                Some(springs) => springs.add_compliance(&mut compliance),
                None => compliance += side.compliance.as_ref().submatrix(0, 0, n_points, n_points),
            }
            for chain in state.vibration.iter().flatten() {
                chain.add_compliance(&mut compliance);
            }
            let material = pair.inputs()[which].material();
            if let Some((slip, material)) = pair.settings().slip.zip(material) {
                let series = series.filter(|series| series.relaxes());
                let moduli = material.instantaneous();
                let chain = slip.mode(which, moduli, series, time_step, n_points);
                chain.add_compliance(&mut compliance);
                state.slip = Some(chain);
            }
        }
        let waves = WaveRadiation::new(damping.radiation, pair.curve.punch_stiffness(), time_step);
        let plate = damping.plate_mobility.map(|mobility| PlateDashpot::new(mobility, time_step));
        let of_waves = waves.as_ref().map(WaveRadiation::compliance);
        let of_plate = plate.as_ref().map(PlateDashpot::compliance);
        [of_waves, of_plate].into_iter().flatten().for_each(|it| add_to_all(&mut compliance, it));
        let open = pair.points[..n_points].iter().map(|point| -point.initial_gap).collect();
        Ok(Self {
            pair,
            excess_work: 0.0,
            momentum_of_joining: 0.0,
            missed_slope: 0.0,
            waves,
            plate,
            time_step,
            step: 0,
            approach: 0.0,
            rate: speed,
            acceleration: 0.0,
            gravity: 0.0,
            sides,
            solver: DiscContactSolver::new(compliance).opened(open),
            most_closed: pair.most_closed(n_points),
            overlap: vec![0.0; n_points],
            forces: vec![0.0; n_points],
            force: 0.0,
            contact: ContactDisc { n_closed: 0 },
        })
    }

    /// Returns the mobility of a plate that bends, m/(N s).
    pub fn plate_mobility(&self) -> Option<f64> {
        self.plate.as_ref().map(PlateDashpot::mobility)
    }

    /// Adds gravity along the approach, m/s².
    pub fn with_gravity(self, gravity: f64) -> Self {
        Self { acceleration: gravity, gravity, ..self }
    }

    pub fn time(&self) -> f64 {
        self.step as f64 * self.time_step
    }

    pub fn n_fallbacks(&self) -> usize {
        self.solver.n_fallbacks
    }

    /// Returns the slip q of each side, m²; 0 without slip.
    pub fn slipped(&self) -> [f64; 2] {
        self.sides.each_ref().map(|state| state.slip.as_ref().map_or(0.0, |c| c.displacement_at(0)))
    }

    /// Returns the overlap on the axis that the forces of the last step had to remove, m; ≤ 0 without contact.
    pub fn axis_overlap(&self) -> f64 {
        self.overlap[0]
    }

    /// Returns the oscillation of the force as nodes enter the contact one at a time, N: its difference from that of
    /// the continuum at this approach, reduced by radiation. In a growing contact it depends on the approach as
    /// without relaxation (Ting 1966), and its share of the force is the elastic one. Springs at Gauss points have 0.
    pub fn force_oscillation(&self) -> f64 {
        if self.contact.n_closed == 0 || self.pair.settings().contact != ContactModel::Exact {
            return 0.0;
        }
        let of_waves = self.waves.as_ref().map_or(0.0, WaveRadiation::displacement);
        let of_plate = self.plate.as_ref().map_or(0.0, PlateDashpot::displacement);
        let approach = self.approach - of_waves - of_plate;
        let elastic = self.pair.curve.force(approach);
        let lasting = if elastic > self.force { self.force / elastic } else { 1.0 };
        lasting * self.pair.curve.force_oscillation(approach)
    }

    /// Returns the largest overlap of the penalty springs and its distance from the axis, m; `None` for exact
    /// contact.
    pub fn largest_overlap(&self) -> Option<(f64, f64)> {
        let CondensedPair { spring_compliance, points, .. } = self.pair;
        let closed = self.forces[..self.contact.n_closed].iter();
        let overlaps = closed.zip(spring_compliance).zip(points);
        overlaps
            .map(|((force, compliance), point)| (force * compliance, point.radius))
            .filter(|(overlap, _)| *overlap > 0.0)
            .max_by(|a, b| a.0.total_cmp(&b.0))
    }

    /// Advances the motion by one step.
    ///
    /// # Errors
    /// No contact state is found, the motion is not finite, or the contact reaches the last point (with springs the
    /// last element).
    pub fn advance(&mut self) -> Result<(), Stop> {
        let dt = self.time_step;
        let (approach, n_closed) = (self.approach, self.contact.n_closed);
        let predicted = self.approach + dt * self.rate + (0.5 - BETA) * dt * dt * self.acceleration;
        for (overlap, point) in self.overlap.iter_mut().zip(&self.pair.points) {
            *overlap = predicted - point.initial_gap;
        }
        for state in &mut self.sides {
            for chain in state.chains_mut() {
                chain.subtract_past(&mut self.overlap);
            }
        }
        let of_waves = self.waves.as_ref().map(WaveRadiation::past_displacement);
        let of_plate = self.plate.as_ref().map(PlateDashpot::past_displacement);
        for displacement in of_waves.into_iter().chain(of_plate) {
            self.overlap.iter_mut().for_each(|overlap| *overlap -= displacement);
        }
        let none = Stop::NoContactState { time: (self.step + 1) as f64 * dt };
        // Numbers that are not finite would close all points, which is not a large contact.
        if !self.overlap.iter().all(|overlap| overlap.is_finite()) {
            return Err(none);
        }
        self.contact = self.solver.solve(&self.overlap, &mut self.forces).map_err(|_| none)?;
        if self.contact.n_closed > self.most_closed {
            let radius = self.pair.points[self.forces.len() - 1].radius;
            let (time, step) = (self.time(), self.step as u64);
            return Err(Stop::ContactBeyondCandidates { at: StepInstant { time, step }, radius });
        }
        for state in &mut self.sides {
            for chain in state.chains_mut() {
                chain.advance(&self.forces[..self.contact.n_closed]);
            }
        }
        self.force = self.forces.iter().sum();
        if let Some(waves) = &mut self.waves {
            waves.advance(self.force);
        }
        if let Some(plate) = &mut self.plate {
            plate.advance(self.force);
        }
        let acceleration = self.gravity - self.force / self.pair.reduced_mass;
        self.approach = predicted + BETA * dt * dt * acceleration;
        self.rate += 0.5 * dt * (self.acceleration + acceleration);
        self.acceleration = acceleration;
        self.step += 1;
        self.give_back(approach, n_closed);
        Ok(())
    }

    /// Corrects the rate for the work of points that join or leave within a step, where the slope of the force
    /// changes. Newmark's formulas integrate the force over the approach by the trapezoidal rule, and conserve
    ///
    /// ```math
    /// \tfrac12 m^*\dot\delta^2 + W + \tfrac1{12}\Delta t^2 k\dot\delta^2, \qquad k = W'' .
    /// ```
    ///
    /// Point k joins at the share ξ of the step and adds s² to the slope k. The energy then has an error of
    /// s² Δδ² [½ ξ(1 − ξ) − 1/12] with a mean of zero, which is returned to the rate; the sign is opposite for a point
    /// that leaves. Near the turning point, where the rate vanishes, the correction is postponed. The arguments are
    /// the approach and the number of closed points before the step.
    fn give_back(&mut self, approach: f64, n_closed: usize) {
        let bends = self.solver.bends(n_closed, self.contact.n_closed);
        let change = self.approach - approach;
        self.excess_work += bends.work * change * change;
        self.missed_slope = bends.missed * change;
        let mass = self.pair.reduced_mass;
        let (squared, more) = (self.rate * self.rate, 2.0 * self.excess_work / mass);
        self.momentum_of_joining = 0.0;
        if more != 0.0 && more.abs() < SMALL_SHARE * squared {
            let rate = (squared + more).sqrt().copysign(self.rate);
            self.momentum_of_joining = mass * (rate - self.rate);
            (self.rate, self.excess_work) = (rate, 0.0);
        }
    }

    /// Returns the energies in bodies, penalty springs and vibrations (J), and the power dissipated by relaxation and
    /// radiated (W).
    pub fn energies(&self) -> MotionEnergies {
        let n = self.contact.n_closed;
        let forces = &self.forces[..n];
        let mut energies = MotionEnergies::default();
        for ((state, side), vibration) in
            self.sides.iter().zip(&self.pair.sides).zip(&mut energies.vibration)
        {
            let Some(side) = side else { continue };
            if state.springs.is_none() {
                for i in 0..n {
                    let row: f64 = (0..n).map(|j| side.compliance[(j, i)] * forces[j]).sum();
                    energies.stored += 0.5 * forces[i] * row;
                }
            }
            for chain in state.chains() {
                let (stored, power) = chain.stored_and_dissipated();
                energies.stored += stored;
                energies.power += power;
                *vibration += chain.kinetic();
            }
        }
        if let Some(waves) = &self.waves {
            energies.stored += waves.stored();
            energies.radiated_power = Some(waves.power());
        }
        energies.plate_power = self.plate.as_ref().map(PlateDashpot::power);
        energies.contact = forces
            .iter()
            .zip(&self.pair.spring_compliance)
            .map(|(force, compliance)| 0.5 * compliance * force * force)
            .fold(0.0, |sum, energy| sum + energy);
        energies
    }
}

/// Energies of an instant.
#[derive(Debug, Clone, Copy, Default)]
pub(crate) struct MotionEnergies {
    pub stored: f64,
    pub contact: f64,
    pub power: f64,
    pub vibration: [f64; 2],
    /// Power that waves radiate from each body, W, if included.
    pub radiated_power: Option<[f64; 2]>,
    /// Power that goes into a plate that bends, W, if included.
    pub plate_power: Option<f64>,
}

impl BodyState {
    fn new(
        side: &BodyOperator,
        series: Option<&PronySeries>,
        shear_blocks: usize,
        time_step: f64,
        n_points: usize,
    ) -> Result<Self, CondensedError> {
        let series = series.filter(|series| series.relaxes());
        let rows = |matrix: &faer::Mat<f64>| matrix.as_ref().subrows(0, n_points).to_owned();
        let springs = match series {
            None => None,
            Some(series) if series.acts_on() == ActsOn::All => {
                // Φ is lower triangular, with a few more diagonals where meshes do not match: columns of nodes
                // farther out than those of these points are zero.
                let all = rows(&side.uniform);
                let n_modes = (0..all.ncols())
                    .rposition(|j| (0..n_points).any(|i| all[(i, j)] != 0.0))
                    .map_or(0, |j| j + 1);
                let shapes = all.as_ref().subcols(0, n_modes).to_owned();
                let share = vec![1.0; n_modes];
                Some(ViscoelasticModes::new(
                    ViscoelasticState::new(series, time_step),
                    shapes,
                    &share,
                ))
            }
            Some(series) => {
                let shear = side.shear(shear_blocks)?;
                let share = &shear.springs.deviatoric_share;
                Some(ViscoelasticModes::new(
                    ViscoelasticState::new(series, time_step),
                    rows(&shear.at_points),
                    share,
                ))
            }
        };
        let vibration = side.vibrations.as_ref().map(|vibrations| {
            let (memory, ones) = match series {
                None => (ViscoelasticState::elastic(), None),
                Some(series) => {
                    let uniform = series.acts_on() == ActsOn::All;
                    (ViscoelasticState::new(series, time_step), uniform.then_some(1.0))
                }
            };
            let modes = &vibrations.modes;
            let share: Vec<f64> =
                modes.deviatoric_share.iter().map(|&share| ones.unwrap_or(share)).collect();
            let springs = ViscoelasticModes::new(memory, rows(&vibrations.at_points), &share);
            let dynamic = springs.clone().with_inertia(&modes.squared_frequency, time_step);
            [springs.removed(), dynamic]
        });
        Ok(Self { springs, slip: None, vibration })
    }

    pub fn chains(&self) -> impl Iterator<Item = &ViscoelasticModes> {
        self.springs.iter().chain(&self.slip).chain(self.vibration.iter().flatten())
    }

    fn chains_mut(&mut self) -> impl Iterator<Item = &mut ViscoelasticModes> {
        self.springs.iter_mut().chain(&mut self.slip).chain(self.vibration.iter_mut().flatten())
    }
}

/// Adds a compliance, m/N, of the whole motion to that of all points.
fn add_to_all(compliance: &mut faer::Mat<f64>, added: f64) {
    for column in compliance.col_iter_mut() {
        column.iter_mut().for_each(|entry| *entry += added);
    }
}
