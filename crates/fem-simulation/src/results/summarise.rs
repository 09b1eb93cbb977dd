//! Builds the summary of a collision.

use fem_case::{ModelChoice, Spot};
use fem_collision::{
    Account, BalanceSide, Bounce, Collision, EnergyLedger, PROGRAM, QuantityOfInterest, RestState,
    Status, energy_key,
};
use fem_laws::ImpactQuantities;

use super::dent::{DentSummary, dents};
use super::energy::{Accounts, Energy};
use super::input_uncertainty::input_uncertainty;
use super::measured::MeasuredSummary;
use super::summary::{
    AdhesionSummary, BodySummary, BounceSummary, CostSummary, EffectSummary, Parts, PerQuantity,
    PlateSummary, Quantities, RestSummary, Summary, Uncertainty,
};
use super::tangential;
use super::uncertainty::uncertainty;
use crate::effects::{AdhesionEffect, EffectDecision, EffectDecisions, FiniteStrain};
use crate::error::{ComputedCollision, ErrorEstimate};
use crate::estimate::Estimate;
use crate::estimate::plate_impact::PlateImpact;
use crate::results::relaxation_band::least_coverage;
use crate::simulation::Simulation;
use crate::simulation::identity::NUMERICS;

impl ComputedCollision {
    /// Returns all warnings about the collision.
    pub fn warnings(&self) -> Vec<String> {
        self.simulation.warnings_with(&self.collision, &self.errors)
    }

    /// Returns the summary with all warnings, without cost and files.
    pub fn summary(&self) -> Summary {
        let Self { simulation, collision, errors } = self;
        let cost = CostSummary::default();
        Summary::of(simulation, collision, errors, cost, self.warnings(), Vec::new())
    }
}

impl Simulation {
    /// Returns the summary of a collision, with its errors and all warnings, without its cost and files.
    pub fn summary(&self, collision: &Collision) -> Summary {
        let errors = self.estimate_errors(collision);
        let warnings = self.warnings_with(collision, &errors);
        Summary::of(self, collision, &errors, CostSummary::default(), warnings, Vec::new())
    }
}

impl Summary {
    /// Returns the summary of a collision with its estimated errors. `cost` has the times that the caller measured,
    /// `warnings` and `files` are those so far. Numbers that are not finite become `None`, and one more warning lists
    /// them.
    pub fn of(
        simulation: &Simulation,
        collision: &Collision,
        errors: &ErrorEstimate,
        cost: CostSummary,
        warnings: Vec<String>,
        files: Vec<String>,
    ) -> Self {
        let mut numbers = Numbers { not_finite: Vec::new() };
        let updates = collision.element_updates.filter(|updates| *updates > 0);
        let quantities = quantities(collision, &mut numbers);
        let effects = effects(simulation, collision, &errors.decisions);
        let inputs = input_uncertainty(simulation, collision, &quantities);
        let uncertainty =
            uncertainty(simulation, collision, errors, &quantities, &effects, inputs.as_ref());
        let status =
            |quantity| Status::of(quantities.number(quantity), uncertainty.of(quantity).model);
        Self {
            status: PerQuantity::by(status),
            uncertainty: Uncertainty {
                axial: uncertainty,
                tangential: tangential::parts(
                    collision,
                    uncertainty.of(QuantityOfInterest::Restitution),
                    uncertainty.of(QuantityOfInterest::MaxContactRadius),
                    inputs.as_ref().map_or(&[], |inputs| &inputs.across[..]),
                ),
            },
            tangential: tangential::quantities(simulation.case().scene(), collision),
            collision: quantities,
            peak_force_raw_n: numbers.finite_if_any("peak_force_raw_n", collision.peak_force_raw),
            radius_and_pressure: radius_and_pressure(&effects),
            elastic_null: errors.elastic_null,
            stress_error: errors.stress_error,
            measured_restitution: measured_restitution(simulation, collision),
            contact_episodes: collision.contact_episodes,
            hertz: hertz(simulation.estimate(&collision.approach), &mut numbers),
            energy: energy(simulation, collision, &mut numbers),
            momentum_residual_relative: numbers
                .finite_if_any("momentum_residual_relative", collision.momentum_residual_relative),
            bounces: bounces(simulation, collision, errors, &mut numbers),
            adhesion: adhesion(simulation, collision, &mut numbers),
            plate: plate(simulation, collision, &mut numbers),
            relaxation_coverage: least_coverage(
                simulation.case().scene(),
                simulation.setup().estimate.contact_time,
            ),
            dent: dent(simulation, collision),
            rest: collision.rest.as_ref().map(|rest| at_rest(rest, &mut numbers)),
            bodies: [0, 1].map(|side| body(simulation, collision, side, &mut numbers)).to_vec(),
            time_step_s: numbers.finite_if_any("time_step_s", collision.time_step),
            steps: collision.steps,
            element_updates: collision.element_updates,
            cost: CostSummary {
                ns_per_element_update: updates.map(|updates| 1e9 * cost.solve_s / updates as f64),
                all_element_updates: all_element_updates(simulation, collision, errors),
                factor_bytes: collision.factor_bytes,
                ..cost
            },
            effects,
            coarser_meshes: Some(simulation.levels().to_vec()).filter(|levels| !levels.is_empty()),
            models_considered: Some(simulation.considered().to_vec())
                .filter(|considered| !considered.is_empty()),
            complete: collision.is_complete(),
            stopped_because: collision.stop().map(ToString::to_string),
            program: PROGRAM,
            version: env!("CARGO_PKG_VERSION"),
            numerics: NUMERICS,
            made_from: simulation.input_digest(&collision.approach),
            source: None,
            files,
            case: simulation.resolved_at(&collision.approach),
            warnings: warnings.into_iter().chain(numbers.warning()).collect(),
        }
    }
}

fn measured_restitution(
    simulation: &Simulation,
    collision: &Collision,
) -> Option<Vec<MeasuredSummary>> {
    let speed = simulation.estimate(&collision.approach)?.hertz.approach_speed();
    let measured = simulation.case().scene().measured_restitutions().iter();
    Some(measured.map(|it| MeasuredSummary::at(speed, it)).collect::<Vec<_>>())
        .filter(|all| !all.is_empty())
}

/// Returns the element updates of a collision, of coarser meshes before it, and of all reference runs; `None` for a model
/// without element updates.
fn all_element_updates(
    simulation: &Simulation,
    collision: &Collision,
    errors: &ErrorEstimate,
) -> Option<u64> {
    let before = simulation.levels().iter().filter_map(|level| level.element_updates);
    Some(collision.element_updates? + before.sum::<u64>() + errors.element_updates)
}

fn effects(
    simulation: &Simulation,
    collision: &Collision,
    decisions: &EffectDecisions,
) -> Vec<EffectSummary> {
    let estimate = simulation.estimate(&collision.approach);
    let summary = |decision: &EffectDecision| {
        let neglect_error =
            estimate.as_ref().and_then(|estimate| simulation.neglect_error(decision, estimate));
        EffectSummary { decision: decision.clone(), error_if_left_out: neglect_error }
    };
    decisions.all.iter().map(summary).collect()
}

/// Returns whether radius and pressure are those of the deformed bodies.
fn radius_and_pressure(effects: &[EffectSummary]) -> &'static str {
    let is_finite = |effect: &EffectSummary| {
        effect.decision.name == FiniteStrain::NAME && effect.decision.active
    };
    if effects.iter().any(is_finite) { "true" } else { "nominal" }
}

/// Keeps numbers that are not finite out of the summary.
struct Numbers {
    /// Keys of the numbers that are not finite.
    not_finite: Vec<String>,
}

impl Numbers {
    /// Lists the numbers that are not finite, which have one cause.
    fn warning(self) -> Option<String> {
        let keys = self.not_finite.join(", ");
        (!keys.is_empty()).then(|| format!("not finite, and left out: {keys}"))
    }

    fn finite(&mut self, key: &str, value: f64) -> Option<f64> {
        if !value.is_finite() {
            self.not_finite.push(key.to_string());
        }
        value.is_finite().then_some(value)
    }

    fn finite_if_any(&mut self, key: &str, value: Option<f64>) -> Option<f64> {
        value.and_then(|value| self.finite(key, value))
    }
}

fn quantities(collision: &Collision, numbers: &mut Numbers) -> Quantities {
    Quantities::by(|quantity| numbers.finite_if_any(quantity.key(), quantity.of(collision)))
}

/// Returns Hertz' quantities with instantaneous moduli; `None` if closed forms are not finite.
fn hertz(estimate: Option<Estimate>, numbers: &mut Numbers) -> Quantities {
    let hertz = estimate.map(|estimate| ImpactQuantities::from(&estimate.hertz).in_order());
    Quantities::by(|quantity| {
        let number = hertz.map(|hertz| hertz[quantity as usize]);
        numbers.finite_if_any(&format!("hertz.{}", quantity.key()), number)
    })
}

fn energy(simulation: &Simulation, collision: &Collision, numbers: &mut Numbers) -> Energy {
    let mut at_end =
        |key: &str, value: Option<f64>| numbers.finite_if_any(&format!("energy.{key}"), value);
    let initial_j = at_end("initial_j", collision.initial_energy);
    let locked_in = collision.bodies.iter().filter_map(|body| body.locked_in).reduce(|a, b| a + b);
    let accounts =
        collision.energies.entries().fold(EnergyLedger::EMPTY, |ledger, (account, energy)| {
            let finite = at_end(&energy_key(account), Some(energy));
            finite.map_or(ledger, |energy| ledger.with(account, energy))
        });
    Energy {
        initial_j,
        accounts: Accounts(accounts),
        locked_in_j: at_end("locked_in_j", locked_in),
        plate_j: at_end("plate_j", plate_energy(simulation, collision)),
        residual_j: at_end("residual_j", collision.residual),
        residual_relative: at_end("residual_relative", collision.residual_relative),
    }
}

/// Returns the energy of a plate of elements at the end, J: what is not the ball's.
fn plate_energy(simulation: &Simulation, collision: &Collision) -> Option<f64> {
    let is_plate = |side: &usize| simulation.case().scene().bodies()[*side].plate().is_some();
    let side = [0, 1].into_iter().find(is_plate)?;
    let (plate, ball) = (&collision.bodies[side], &collision.bodies[1 - side]);
    if plate.elements.is_none() || collision.energies.get(Account::Plate).is_some() {
        return None;
    }
    let held = collision.energies.total(BalanceSide::Held)?;
    // A landing speed has the potential energy.
    let landing = |bounce: &Bounce| bounce.restitution * bounce.speed_before;
    let speed = collision.bounces.last().map(landing).or(ball.velocity_after)?;
    let inner = [ball.vibration_energy, ball.locked_in].into_iter().flatten().sum::<f64>();
    Some(held - 0.5 * ball.mass? * speed.powi(2) - inner)
}

/// Returns the contacts of a case with gravity.
fn bounces(
    simulation: &Simulation,
    collision: &Collision,
    errors: &ErrorEstimate,
    numbers: &mut Numbers,
) -> Option<Vec<BounceSummary>> {
    simulation.case().scene().gravity()?;
    let measured = simulation.case().scene().measured_restitutions();
    let bars = collision.bounces.iter().zip(&errors.of_bounces);
    let mut bars: Vec<Parts> =
        bars.map(|(bounce, error)| bar_of(simulation, bounce, errors, *error)).collect();
    // A law keeps no dent, and what a contact on one returns is not known.
    let keeps_none = matches!(simulation.case().scene().model(), ModelChoice::Law { law, .. }
        if law.family.strength_parameter().is_some());
    if keeps_none && simulation.case().scene().gravity()?.spot == Some(Spot::Same) {
        bars.iter_mut().skip(1).for_each(|bar| bar.model = None);
    }
    let contacts = collision.bounces.iter().enumerate().map(|(k, bounce)| {
        let mut number = |key: &str, value: Option<f64>| {
            numbers.finite_if_any(&format!("bounces.{k}.{key}"), value)
        };
        BounceSummary {
            speed_before_m_s: number("speed_before_m_s", Some(bounce.speed_before)),
            restitution: number("restitution", Some(bounce.restitution)),
            restitution_uncertainty: bars.get(k).copied().unwrap_or_default(),
            measured_restitution: measured.iter().find_map(|it| it.at(bounce.speed_before)),
            contact_time_s: number("contact_time_s", bounce.contact_time),
            peak_force_n: number("peak_force_n", bounce.peak_force),
            time_s: number("time_s", Some(bounce.time)),
        }
    });
    Some(contacts.collect())
}

/// Returns the parts of the error bar of the restitution of one contact, with the errors by inputs and neglected effects at its own speed.
fn bar_of(
    simulation: &Simulation,
    bounce: &Bounce,
    errors: &ErrorEstimate,
    discretisation: Option<f64>,
) -> Parts {
    let Some(contact) = bounce.collision() else { return Parts::default() };
    let values = quantities(&contact, &mut Numbers { not_finite: Vec::new() });
    let effects = effects(simulation, &contact, &errors.decisions);
    let quantity = QuantityOfInterest::Restitution;
    let inputs = input_uncertainty(simulation, &contact, &values);
    let parts = uncertainty(simulation, &contact, errors, &values, &effects, inputs.as_ref());
    Parts { discretisation, ..parts.of(quantity) }
}

/// Returns the dents of bodies that flowed.
fn dent(simulation: &Simulation, collision: &Collision) -> Option<Vec<DentSummary>> {
    let dents = dents(simulation, collision);
    let summaries: Vec<DentSummary> = dents.into_iter().map(|(_, dent, _)| dent).collect();
    Some(summaries).filter(|dents| !dents.is_empty())
}

/// Returns the adhesion that the case gives.
fn adhesion(
    simulation: &Simulation,
    collision: &Collision,
    numbers: &mut Numbers,
) -> Option<AdhesionSummary> {
    let adhesion = AdhesionEffect::given(simulation.case().scene())?;
    let speed = simulation.estimate(&collision.approach)?.hertz.approach_speed();
    let mut number = |key: &str, value| numbers.finite(&format!("adhesion.{key}"), value);
    Some(AdhesionSummary {
        sticking_speed_m_s: number("sticking_speed_m_s", adhesion.sticking_speed()),
        work_of_adhesion_j_m2: number("work_of_adhesion_j_m2", adhesion.work_of_adhesion()),
        tabor: number("tabor", adhesion.tabor()),
        sticks: speed < adhesion.sticking_speed(),
    })
}

/// Returns the impact on the plate of the case.
fn plate(
    simulation: &Simulation,
    collision: &Collision,
    numbers: &mut Numbers,
) -> Option<PlateSummary> {
    let estimate = simulation.estimate(&collision.approach)?;
    let plate = PlateImpact::of(simulation.case().scene(), &estimate)?;
    let mut number = |key: &str, value| numbers.finite(&format!("plate.{key}"), value);
    let edge = Some(plate.edge_return).filter(|time| time.is_finite());
    Some(PlateSummary {
        lambda: number("lambda", plate.lambda),
        regime: plate.regime.word(),
        wave_travel_over_thickness: number("wave_travel_over_thickness", plate.thicknesses),
        edge_return_over_contact_time: edge
            .and_then(|time| number("edge_return_over_contact_time", time)),
    })
}

fn at_rest(rest: &RestState, numbers: &mut Numbers) -> RestSummary {
    let mut number =
        |key: &str, value: Option<f64>| numbers.finite_if_any(&format!("rest.{key}"), value);
    RestSummary {
        time_s: number("time_s", Some(rest.time)),
        static_force_n: number("static_force_n", Some(rest.contact.force)),
        contact_radius_m: number("contact_radius_m", rest.contact.contact_radius),
        approach_m: number("approach_m", Some(rest.contact.approach)),
        centre_pressure_pa: number("centre_pressure_pa", rest.contact.centre_pressure),
    }
}

fn body(
    simulation: &Simulation,
    collision: &Collision,
    side: usize,
    numbers: &mut Numbers,
) -> BodySummary {
    let (named, body) = (&simulation.case().scene().bodies()[side], &collision.bodies[side]);
    let mut number = |key: &str, value: Option<f64>| {
        numbers.finite_if_any(&format!("{key} of {}", named.name()), value)
    };
    BodySummary {
        name: named.name().to_string(),
        elements: body.elements,
        nodes: body.nodes,
        mass_kg: number("mass_kg", body.mass),
        added_mass_kg: number("added_mass_kg", body.moved_mass),
        velocity_before_m_s: number(
            "velocity_before_m_s",
            Some(collision.approach.velocities()[side]),
        ),
        velocity_after_m_s: number("velocity_after_m_s", body.velocity_after),
        velocity_tangential_after_m_s: number(
            "velocity_tangential_after_m_s",
            collision.tangential.map(|it| it.velocities[side]),
        ),
        spin_after_rad_s: number("spin_after_rad_s", collision.tangential.map(|it| it.spins[side])),
        vibration_energy_j: number("vibration_energy_j", body.vibration_energy),
    }
}
