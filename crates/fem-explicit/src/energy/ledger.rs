//! The running account of energy and momentum.
//!
//! At time t_n the leapfrog scheme conserves, for a linear system and to
//! rounding,
//!
//! ```math
//! E_n = \tfrac12 v_{n-1/2} \cdot M v_{n+1/2} + \tfrac12 u_n \cdot K u_n ,
//! ```
//!
//! so kinetic energy is reported in this form. The parts of the bodies compute from the state what they store, are
//! given and dissipate. The residual is stored + dissipated − initial − external work; a run stops where it grows too
//! large. Powers are integrated by the trapezoidal rule over the sampled instants. Between them the contact alone is
//! followed ([`ContactWork`]), which is the source of spurious energy if there is one.
//!
//! A half-space has infinite mass and keeps its velocity V far away, as a wall does. Its kinetic energy and momentum
//! are those of its nodes relative to V; the support of its far boundary gives it momentum and, in that frame, no
//! energy.

use fem_collision::{
    Account, BalanceSide, DissipatedEnergies, EnergyLedger, HistoryRow, MAX_RESIDUAL, StepInstant,
    nan_aware_max, nan_aware_max_abs,
};
use fem_contact::ContactForces;
use serde::{Deserialize, Serialize};

use super::contact_work::ContactWork;
use super::nodal_sums::{NodalSums, Nodes};
use crate::body::{Body, BodyState};
use crate::model::ExplicitBodies;
use crate::part::Accounts;
use crate::state::{Scratch, State};

/// Total energy over initial energy beyond which a run is unstable.
const ENERGY_LIMIT: f64 = 1.05;

/// Running sums and worst imbalances.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub(crate) struct Ledger {
    /// Kinetic energy at the start, walls and half-spaces not counted, J.
    pub initial: f64,
    /// The same in the frame of the centre of mass, J.
    pub initial_relative: f64,
    /// Worst imbalance of energy over `initial_relative`.
    pub worst_residual: f64,
    /// Largest spurious energy at any step, over `initial_relative`.
    pub growth: f64,
    /// When the imbalance first exceeded the limit of a valid run.
    pub beyond: Option<StepInstant>,
    /// Worst drift of momentum over Σ m|v| at the start (over m times the speed of
    /// approach if a wall meets a body at rest).
    pub worst_momentum: f64,
    /// Initial momentum of the bodies, and the impulses of forces on their nodes and of the support of a half-space
    /// since, up to t_n − Δt/2, N s.
    given_momentum: f64,
    momentum_scale: f64,
    /// ∫ F dt up to t_n − Δt/2, N s.
    impulse: f64,
    losses: DissipatedEnergies,
    /// Energies of the bodies at first touch: the residual stress of an earlier contact, and what it dissipated, which is not
    /// counted again.
    inherited: EnergyLedger,
    /// Time of the last balance, s.
    last_time: f64,
    /// Result of the last balance.
    last_balance: LastBalance,
    /// Its change since by the contact.
    pub since: ContactWork,
}

/// The result of a balance.
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize, Deserialize)]
struct LastBalance {
    /// Energy residual, J.
    residual: f64,
    /// Energy dissipated until then, J.
    lost: f64,
    /// Drift of momentum, N s.
    drift: f64,
}

/// The growth of the energy beyond its limit, or to a value that is not finite.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct EnergyGrowth {
    /// Time since the start of the case, s.
    pub time: f64,
    pub step: u64,
    /// Total energy over initial energy.
    pub ratio: f64,
}

/// Kinetic energies, momentum and centre of one body; of a half-space relative to what is far away.
struct BodyBalance {
    kinetic: f64,
    vibration: f64,
    /// At t_n − Δt/2, N s.
    momentum: f64,
    velocity: f64,
    displacement: f64,
}

impl Ledger {
    /// Starts at first touch.
    pub fn new(model: &ExplicitBodies, state: &State) -> Self {
        let moving = || model.bodies().iter().filter(|body| body.is_free());
        let sum = |value: &dyn Fn(&Body) -> f64| moving().map(value).sum::<f64>();
        let inverse_mass: f64 = sum(&Body::inverse_mass_of_centre);
        let momentum: f64 = sum(&|body| body.mass() * body.velocity.abs());
        let momentum_before = |(body, state): (&Body, &BodyState)| {
            match (body.is_free(), body.node_forces.is_empty()) {
                (true, true) => body.mass() * body.velocity,
                // Half a step before first touch the forces had acted for a shorter time.
                (true, false) => body.sum_mass(&state.velocity),
                (false, _) => momentum_relative_to(body.velocity, body, state),
            }
        };
        let states = model.bodies().iter().zip(&state.bodies);
        let moved = states.filter(|(body, _)| !body.is_wall());
        // A wall can bring all of the motion to a body at rest.
        let momentum_of_approach = sum(&Body::mass) * model.approach().speed();
        Self {
            initial: sum(&kinetic_before),
            initial_relative: 0.5 * model.approach().speed().powi(2) / inverse_mass,
            worst_residual: 0.0,
            growth: 0.0,
            beyond: None,
            worst_momentum: 0.0,
            given_momentum: moved.map(momentum_before).sum(),
            momentum_scale: if momentum > 0.0 { momentum } else { momentum_of_approach },
            impulse: 0.0,
            losses: DissipatedEnergies::default(),
            inherited: EnergyLedger::EMPTY,
            last_time: model.approach().first_touch(),
            last_balance: LastBalance::default(),
            since: ContactWork::default(),
        }
    }

    /// Takes the energies that the bodies have in a state for those at first touch.
    pub fn inherit(&mut self, model: &ExplicitBodies, state: &State) {
        self.inherited = energies_of_parts(model, state).energies;
    }

    /// Follows the share of the contact in every state, whose forces are in `scratch`, whether or not the state is
    /// sampled.
    ///
    /// # Errors
    /// The energy is not finite or has grown.
    pub fn follow(
        &mut self,
        model: &ExplicitBodies,
        state: &State,
        scratch: &Scratch,
        contact: &ContactForces,
    ) -> Result<(), EnergyGrowth> {
        self.since.end_step(model, state, scratch, contact);
        self.note(state);
        self.check_energy(self.residual(), state.time, state.step)
    }

    /// Returns the present residual, as far as it comes from the contact, J.
    pub fn residual(&self) -> f64 {
        self.last_balance.residual + self.since.energy
    }

    /// Updates the largest residuals of energy and momentum.
    fn note(&mut self, state: &State) {
        let LastBalance { lost, drift, .. } = self.last_balance;
        let residual = self.residual();
        self.worst_residual =
            nan_aware_max_abs(self.worst_residual, residual / self.initial_relative);
        self.growth = nan_aware_max(self.growth, (residual - lost) / self.initial_relative);
        // A residual that is not a number is above every limit.
        let is_balanced = self.worst_residual <= MAX_RESIDUAL;
        if self.beyond.is_none() && !is_balanced {
            self.beyond = Some(StepInstant { time: state.time, step: state.step });
        }
        let drift = (drift + self.since.momentum) / self.momentum_scale;
        self.worst_momentum = nan_aware_max_abs(self.worst_momentum, drift);
    }

    /// Adds the impulses over a time (s) of the forces in `scratch` and of the contact (N): over the step from t_n to
    /// t_n+1, or over the time by which half a step has become shorter.
    pub fn push(&mut self, model: &ExplicitBodies, scratch: &Scratch, force: f64, time: f64) {
        self.impulse += time * force;
        for (side, body) in model.bodies().iter().enumerate() {
            if body.is_pushed() {
                self.given_momentum += time * scratch.resultants[side];
            }
            for &node in body.held_nodes() {
                self.given_momentum -= time * scratch.forces[side][node as usize][1];
            }
        }
    }

    /// Returns ∫ F dt of the contact up to half a step before the state, N s.
    pub fn impulse(&self) -> f64 {
        self.impulse
    }

    /// Balances the state at t_n, whose forces are in `scratch`, and returns its row.
    pub fn balance(
        &mut self,
        model: &ExplicitBodies,
        state: &State,
        scratch: &Scratch,
        contact: &ContactForces,
    ) -> HistoryRow {
        let (bodies, time_step) = (model.bodies(), state.time_step(model));
        let [lower, upper] = [0, 1].map(|side: usize| {
            let (body, forces) = (&bodies[side], &scratch.forces[side]);
            balance_body(body, (state.time, time_step), &state.bodies[side], forces)
        });
        let mut accounts = energies_of_parts(model, state);
        let held_before = self.take_inherited_out(&mut accounts.energies);
        model.contact().add_energies(state.contact_history(model), &mut accounts);
        self.losses.advance(state.time - self.last_time, accounts.powers);
        self.last_time = state.time;

        let with_kinetic = |kinetic: f64| {
            accounts
                .energies
                .and(&self.losses.energies())
                .with(Account::Kinetic, kinetic)
                .with(Account::Contact, contact.energy)
                .with(Account::WallWork, self.wall_work(model, contact.force * time_step))
        };
        let energies = with_kinetic(lower.kinetic + upper.kinetic);
        let residual = match self.gained_by_rigid(model, contact.force * time_step) {
            Some((side, gained)) => {
                let (other, kinetic) = (&bodies[1 - side], [&lower, &upper][1 - side].kinetic);
                with_kinetic(kinetic + gained).residual(kinetic_before(other) + held_before)
            }
            None => energies.residual(self.initial + held_before),
        };
        let drift = self.drift(model, lower.momentum + upper.momentum);
        self.last_balance =
            LastBalance { residual, lost: energies.total(BalanceSide::Lost).unwrap_or(0.0), drift };
        self.since.restart();
        self.note(state);

        let history = state.contact_history(model);
        let (contact_radius, centre_pressure) =
            model.contact().radius_and_pressure(&state.motions(model), history);
        HistoryRow {
            time: state.time,
            contact_force: contact.force,
            contact_radius: Some(contact_radius),
            approach: lower.displacement - upper.displacement - model.approach().gap(),
            centre_pressure: Some(centre_pressure),
            velocity: [lower.velocity, upper.velocity],
            energies,
            residual: Some(residual),
            vibration: [lower.vibration, upper.vibration],
            tangential: None,
        }
    }

    /// Takes what bodies dissipated before first touch out of these energies, and returns what they stored then, J.
    fn take_inherited_out(&self, energies: &mut EnergyLedger) -> f64 {
        let mut held = 0.0;
        for (account, energy) in self.inherited.entries() {
            match account.side() {
                BalanceSide::Held => held += energy,
                _ => energies.add(account, -energy),
            }
        }
        held
    }

    /// Checks the energy of a row.
    ///
    /// # Errors
    /// It is not finite or has grown.
    pub fn check(&self, row: &HistoryRow, step: u64) -> Result<(), EnergyGrowth> {
        self.check_energy(row.residual.unwrap_or(f64::NAN), row.time, step)
    }

    fn check_energy(&self, residual: f64, time: f64, step: u64) -> Result<(), EnergyGrowth> {
        let ratio = 1.0 + residual / self.initial_relative;
        if ratio.is_finite() && ratio <= ENERGY_LIMIT {
            Ok(())
        } else {
            Err(EnergyGrowth { time, step, ratio })
        }
    }

    /// Returns whether the energy has added up so far.
    pub fn adds_up(&self) -> bool {
        self.beyond.is_none()
    }

    /// Returns whether it can belong to a run of a model in a state.
    pub fn fits(&self, model: &ExplicitBodies, state: &State) -> bool {
        let constants =
            |ledger: &Self| [ledger.initial, ledger.initial_relative, ledger.momentum_scale];
        constants(self) == constants(&Self::new(model, state)) && self.last_time <= state.time
    }

    /// Returns the work of a moving wall or half-space on the other body up to t_n, J; `next` is the impulse of the
    /// contact force over the next step, N s.
    fn wall_work(&self, model: &ExplicitBodies, next: f64) -> f64 {
        let impulse = self.impulse + 0.5 * next;
        let [lower, upper] = model.bodies();
        match (lower.is_free(), upper.is_free()) {
            (false, _) => impulse * lower.velocity,
            (_, false) => -impulse * upper.velocity,
            _ => 0.0,
        }
    }

    /// Returns the side of a rigid sphere that only the contact moves, and its gain of kinetic energy from first touch
    /// to t_n, J; `next` is as above.
    ///
    /// With the impulses J of the contact up to t_n ∓ Δt/2, ½ M v₋v₊ − ½ M v² = ½ v (J₋ + J₊) +
    /// J₋J₊/2M, without the cancellation by which the energy of a heavy sphere would be lost in rounding.
    fn gained_by_rigid(&self, model: &ExplicitBodies, next: f64) -> Option<(usize, f64)> {
        let is_moved = |body: &Body| body.mesh().is_none() && !body.is_wall() && !body.is_pushed();
        let side = model.bodies().iter().position(is_moved)?;
        let (body, sign) = (&model.bodies()[side], [-1.0, 1.0][side]);
        let before = sign * self.impulse;
        let after = before + sign * next;
        let gained = body.velocity * (before + after) + before * after / body.mass();
        Some((side, 0.5 * gained))
    }

    /// Returns the drift of the momentum of the bodies (N s), without walls, at t_n − Δt/2.
    fn drift(&self, model: &ExplicitBodies, momentum: f64) -> f64 {
        let [lower, upper] = model.bodies();
        let from_wall = match (lower.is_wall(), upper.is_wall()) {
            (true, _) => self.impulse,
            (_, true) => -self.impulse,
            _ => 0.0,
        };
        momentum - (self.given_momentum + from_wall)
    }
}

/// Returns what the parts of the bodies store, are given and dissipate.
fn energies_of_parts(model: &ExplicitBodies, state: &State) -> Accounts {
    let mut accounts = Accounts::default();
    for (side, (body, motion)) in model.bodies().iter().zip(state.motions(model)).enumerate() {
        body.add_energies(&motion, &state.bodies[side].history, &mut accounts);
    }
    accounts
}

/// Returns the kinetic energy at the start, J; for a body that is not free, relative to its own velocity.
fn kinetic_before(body: &Body) -> f64 {
    match body.is_free() {
        true => 0.5 * body.mass() * body.velocity.powi(2),
        false => 0.0,
    }
}

/// Returns the momentum of the nodes of a body relative to a velocity (m/s), N s.
fn momentum_relative_to(velocity: f64, body: &Body, state: &BodyState) -> f64 {
    let nodes = body.nodal_mass.iter().zip(&state.velocity);
    nodes.map(|(mass, v)| mass * (v[1] - velocity)).sum()
}

fn balance_body(
    body: &Body,
    (time, time_step): (f64, f64),
    state: &BodyState,
    forces: &[[f64; 2]],
) -> BodyBalance {
    if body.is_wall() {
        return BodyBalance {
            kinetic: 0.0,
            vibration: 0.0,
            momentum: 0.0,
            velocity: state.velocity[0][1],
            displacement: state.displacement[0][1],
        };
    }
    // Velocities of a free body are absolute.
    let far_velocity = if body.is_free() { 0.0 } else { body.velocity };
    let BodyState { displacement, velocity, .. } = state;
    let nodes = Nodes { mass: &body.nodal_mass, displacement, velocity, forces };
    let NodalSums { first_moment, momentum, twice_kinetic, force } =
        NodalSums::of(nodes, time_step, far_velocity);
    if !body.is_free() {
        return BodyBalance {
            kinetic: 0.5 * twice_kinetic,
            vibration: 0.5 * twice_kinetic,
            momentum,
            velocity: body.velocity,
            displacement: match body.held_node() {
                Some(node) => state.displacement[node][1],
                None => body.velocity * time,
            },
        };
    }
    let mass = body.mass();
    let before = momentum / mass;
    let after = before + time_step * force / mass;
    let vibration = 0.5 * (twice_kinetic - mass * before * after);
    BodyBalance {
        kinetic: 0.5 * twice_kinetic,
        // For a single node it is a rounding error.
        vibration: if body.mesh().is_some() { vibration } else { 0.0 },
        momentum,
        velocity: 0.5 * (before + after),
        displacement: first_moment / mass,
    }
}
