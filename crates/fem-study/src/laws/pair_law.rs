//! The computed pair as a contact law that other codes compile.
//!
//! Elastic pairs are Hertz' with finite size; pairs that relax, plates and friction are springs ([`ContactSprings`]); pairs that flow are
//! a table of the law `mean_pressure`, or of the law of the case that dents. The law is run beside the model that it stands for.

use std::f64::consts::PI;

use fem_case::engineering::{number, show};
use fem_case::{Case, ModelChoice, Scene};
use fem_data::dem::{DentTable, PairLaw, Repulsion, ShearSprings};
use fem_data::estimate::FitError;
use fem_data::relaxation::reduced_series;
use fem_laws::{
    Adhesion, ContactSprings, EndRule, HertzImpact, ImpactQuantities, LawFamily, LawInput, Pair,
    PairRelaxation, SpringProfile, radiation_damping,
};
use fem_simulation::{
    Reduced, bounds_of_closed_forms, computed_flow, radiating_half_spaces,
    restitution_with_adhesion, surfaces_slip,
};

use super::chosen_law::plate_of;
use super::computed_curve::{relaxes, stand_in};
use super::law_fault::LawFault;

/// Speeds of the tables of e and T.
const N_SPEEDS: usize = 17;
/// Factor between the speed of the case and the ends of the range.
const RANGE: f64 = 10.0;
/// Factor by which the upper end shrinks until the model has a result of a contact that is not as wide as the bodies.
const SHRINK: f64 = 0.75;
/// Its largest contact radius over R*: Hertz' theory of half-spaces errs by several per cent there.
const WIDEST: f64 = 0.5;
/// Relative tolerance of the complex modulus of the reduced series, and factor by which its frequencies reach beyond π/T of both ends.
const SERIES_TOLERANCE: f64 = 2e-4;
const SERIES_MARGIN: f64 = 3.0;
/// Steps per contact of the check, and the slowest contact time over the fastest relaxation time of a series: a sixth of 50 steps.
const N_STEPS: f64 = 100.0;
const FASTEST: f64 = 300.0;
/// Rows of the table of a law that dents, to three times the largest approach.
const N_KNOTS: usize = 64;
const DEEPER: f64 = 3.0;
/// A speed at which any adhesion holds bodies together, m/s.
const STILL: f64 = 1e-9;

/// A contact law to compile and its errors beside the model that it stands for.
#[derive(Clone, Debug)]
pub struct LawExport {
    /// The law and the text of its header.
    pub law: PairLaw,
    /// The model that it stands for.
    pub model: String,
    /// Largest errors of the law over the speeds at 100 steps per contact: of e, and of T and F relative.
    pub errors: [f64; 3],
    /// Largest contact radius over the effective radius.
    pub contact_ratio: f64,
    /// The impacts of that model at the speeds of the law's curve, without adhesion.
    pub impacts: Vec<ImpactQuantities>,
    /// Restitution of the law at these speeds, at 100 steps per contact.
    pub made: Vec<f64>,
}

/// The results of the model at a speed.
#[derive(Clone, Copy, Debug)]
struct Computed {
    speed: f64,
    quantities: ImpactQuantities,
    /// Error of the restitution by the model, if it is known.
    error: Option<f64>,
}

impl Computed {
    /// Returns the contact time, s; that of Hertz where the bodies stay together.
    fn time_scale(&self, pair: &Pair) -> f64 {
        let hertz =
            || HertzImpact::new(pair, self.speed).map_or(f64::NAN, |hertz| hertz.contact_time());
        Some(self.quantities.contact_time).filter(|time| time.is_finite()).unwrap_or_else(hertz)
    }

    /// Returns restitution, contact time over the time scale, and largest force (N) of a law.
    fn made_by(&self, repulsion: &Repulsion, pair: &Pair) -> [f64; 3] {
        let time = self.time_scale(pair);
        let [e, contact_time, force] =
            repulsion.impact(pair.effective_mass(), self.speed, time / N_STEPS);
        [e, contact_time / time, force]
    }

    /// Returns the errors by a pull-off force (N) over a distance (m), which begins and ends half a step early or late: of e, and of T
    /// relative, which has the time over that distance; of bodies that stay together, which never part, 0.
    fn errors_of_parting(&self, [force, reach]: [f64; 2], pair: &Pair) -> [f64; 2] {
        let (time, away) = (self.time_scale(pair), self.speed * self.quantities.restitution);
        if away == 0.0 {
            return [0.0; 2];
        }
        let step = time / N_STEPS;
        [0.5 * step * force / (pair.effective_mass() * self.speed), reach / (away * time)]
    }

    /// Returns the errors of a law that makes these: of e, and of T and F relative.
    fn errors_of(&self, [e, time_ratio, force]: [f64; 3]) -> [f64; 3] {
        let Self { quantities, .. } = self;
        let parts = quantities.contact_time.is_finite() && time_ratio.is_finite();
        let of_time = if parts { (time_ratio - 1.0).abs() } else { 0.0 };
        [(e - quantities.restitution).abs(), of_time, (force / quantities.peak_force - 1.0).abs()]
    }
}

impl LawExport {
    /// Returns the law of a case's bodies under a name, from one speed to another, m/s, or over a decade on both sides of that of the case.
    ///
    /// # Errors
    /// The header has no form for an effect of the case, the model has no result, or its restitution is a bound at the speed of the case,
    /// unless bounds are taken as they are.
    pub fn of(
        case: &Case,
        name: &str,
        speeds: Option<(f64, f64)>,
        as_elastic: bool,
    ) -> Result<Self, LawFault> {
        let source = Source::of(case, speeds)?;
        let scene = source.case.scene();
        let bounds = bounds_of_closed_forms(scene, scene.approach_speed());
        if !(as_elastic || bounds.is_empty()) {
            return Err(LawFault::Bound(bounds));
        }
        let pair = scene.pair().map_err(FitError::from)?;
        let repulsion = source.repulsion(&pair)?;
        let adhesion = adhesion_of(scene, &pair);
        let made = source.computed.iter().map(|at| at.made_by(&repulsion, &pair));
        let made: Vec<[f64; 3]> = made.collect();
        let errors = source.computed.iter().zip(&made).map(|(at, made)| {
            let [e, time, force] = at.errors_of(*made);
            let [of_e, of_time] = adhesion.map_or([0.0; 2], |it| at.errors_of_parting(it, &pair));
            [e + of_e, time + of_time, force]
        });
        let errors: Vec<[f64; 3]> = errors.collect();
        let largest = |k: usize| errors.iter().map(|error| error[k]).fold(0.0, f64::max);
        let point = |at: &Computed| {
            let e = restitution_with_adhesion(scene, at.speed, at.quantities.restitution);
            [at.speed, e, at.quantities.contact_time]
        };
        let curve: Vec<[f64; 3]> = source.computed.iter().map(point).collect();
        let widest = source.computed.iter().map(|at| at.quantities.max_contact_radius);
        let contact_ratio = widest.fold(0.0, f64::max) / pair.effective_radius();
        let law =
            PairLaw { name: name.to_string(), head: Vec::new(), pair, repulsion, adhesion, curve };
        let errors_all = [0, 1, 2].map(largest);
        let impacts = source.computed.iter().map(|at| at.quantities).collect();
        let made = source.computed.iter().zip(made);
        let made =
            made.map(|(at, [e, ..])| restitution_with_adhesion(scene, at.speed, e)).collect();
        let model = source.model_words();
        let export = Self { law, model, errors: errors_all, contact_ratio, impacts, made };
        let head = export.head(scene, &source.computed, &errors);
        Ok(Self { law: PairLaw { head, ..export.law }, ..export })
    }

    /// Returns the ends of the range of speeds, m/s.
    pub fn speeds(&self) -> [f64; 2] {
        [0, self.law.curve.len() - 1].map(|k| self.law.curve[k][0])
    }

    /// Returns the comment at the head of the file.
    fn head(&self, scene: &Scene, computed: &[Computed], errors: &[[f64; 3]]) -> Vec<String> {
        let clean = |text: &str| text.replace("*/", "* /").replace(char::is_control, " ");
        let bodies = scene.bodies().each_ref().map(|body| {
            let size = body.diameter().map_or(String::new(), |d| format!(" {}", show(d, "m")));
            let material =
                body.material_name().map_or(", rigid".to_string(), |it| format!(" of {it}"));
            format!("{}{size}{material}", body.name())
        });
        let [slow, fast] = [computed[0].speed, computed[computed.len() - 1].speed];
        let [of_e, of_time, of_force] = self.errors;
        let mut head = vec![
            clean(scene.title()),
            clean(&bodies.join(", ")),
            String::new(),
            format!("Stands for: {}.", self.model),
            format!(
                "Checked from {} to {}, contact radius up to {} of R*, 100 steps per contact: e within {},",
                show(slow, "m/s"),
                show(fast, "m/s"),
                number(self.contact_ratio, 2),
                number(of_e, 2)
            ),
            format!(
                "contact time within {} % and largest force within {} % of that model. Take 50 steps or more.",
                number(100.0 * of_time, 2),
                number(100.0 * of_force, 2)
            ),
            String::new(),
            "   speed, m/s         e   +/- law   +/- model   contact time, s".to_string(),
        ];
        let rows = self.law.curve.iter().zip(computed).zip(errors).step_by(2);
        head.extend(rows.map(|(([speed, e, time], at), [error, ..])| {
            let model = at.error.map_or("unknown".to_string(), |error| format!("{error:.4}"));
            format!("{speed:>13.5e}  {e:.5}   {error:.5}   {model:>9}     {time:.5e}")
        }));
        head.extend([
            String::new(),
            format!(
                "Made by fem-run {}: fem-run export CASE --law. Licence: MIT or Apache-2.0.",
                env!("CARGO_PKG_VERSION")
            ),
        ]);
        head
    }
}

/// The bodies of a case under the model that the law stands for, and its results.
struct Source {
    case: Case,
    /// The law that dents, and its flow stress at the ends of the range.
    dents: Option<(Reduced, [f64; 2])>,
    computed: Vec<Computed>,
}

impl Source {
    fn of(case: &Case, speeds: Option<(f64, f64)>) -> Result<Self, LawFault> {
        plate_of(case.scene())?;
        let case = with_model(case)?;
        let own = case.scene().approach_speed();
        let at = |speed: f64| computed(&case, speed);
        let (slow, fast) = match speeds {
            Some(range) => range,
            None => {
                let mut fast = RANGE * own;
                let radius = case.scene().pair().map_err(FitError::from)?.effective_radius();
                let is_wide = |it: Computed| it.quantities.max_contact_radius > WIDEST * radius;
                while fast > own && at(fast).map_or(true, is_wide) {
                    fast = (SHRINK * fast).max(own);
                }
                (own / RANGE, fast)
            }
        };
        let share = |k: usize| k as f64 / (N_SPEEDS - 1) as f64;
        let computed = (0..N_SPEEDS).map(|k| at(slow * (fast / slow).powf(share(k))));
        let computed: Vec<Computed> = computed.collect::<Result<_, LawFault>>()?;
        let dents = dents(&case, [slow, fast])?;
        if dents.is_some() {
            check_dents(case.scene())?;
        }
        Ok(Self { case, dents, computed })
    }

    fn model_words(&self) -> String {
        match (&self.dents, self.case.scene().model()) {
            (_, ModelChoice::Law { law, .. }) => format!("the law {}", law.family.name()),
            (Some(_), _) => "the law mean_pressure, a fit to finite elements".to_string(),
            (None, ModelChoice::Ting { finite_size, .. }) => {
                format!("Ting's model{}", if *finite_size { " with finite size" } else { "" })
            }
            (None, ModelChoice::Hertz { finite_size: true }) => {
                "Hertz' model with finite size".to_string()
            }
            _ => "Hertz' model".to_string(),
        }
    }

    fn repulsion(&self, pair: &Pair) -> Result<Repulsion, LawFault> {
        if let Some((reduced, strengths)) = &self.dents {
            return self.dent_table(reduced, *strengths).map(Repulsion::Dents);
        }
        let scene = self.case.scene();
        let finite_size = match scene.model() {
            ModelChoice::Ting { finite_size, .. } | ModelChoice::Hertz { finite_size } => {
                *finite_size
            }
            _ => false,
        };
        let is_ting = matches!(scene.model(), ModelChoice::Ting { .. });
        let profile = SpringProfile {
            finite_size: finite_size.then(|| scene.finite_size()).transpose()?,
            surface_slip: (is_ting && surfaces_slip(scene)).then(|| scene.surface_slip()),
        };
        let materials = scene.bodies().each_ref().map(|body| {
            let material = body.material()?;
            Some(if is_ting { material.clone() } else { material.without_relaxation() })
        });
        let [lower, upper] = materials.each_ref().map(Option::as_ref);
        let relaxation = PairRelaxation::new(lower, upper)?;
        let plate = plate_of(scene)?;
        let radii = [0, N_SPEEDS - 1].map(|k| self.computed[k].quantities.max_contact_radius);
        let radiating = match is_ting {
            true => radiating_half_spaces(scene, scene.approach_speed()),
            false => Vec::new(),
        };
        let is_plain = plate.is_none() && scene.friction() == 0.0 && radiating.is_empty();
        if relaxation.terms().is_empty() && is_plain {
            let [stiffness, first, second] = profile.elastic(pair, &relaxation, radii[1]);
            let widest = self.computed[N_SPEEDS - 1].quantities.max_approach.sqrt();
            return Ok(Repulsion::Hertz([stiffness, first, second, widest]));
        }
        let times = [0, N_SPEEDS - 1].map(|k| self.computed[k].time_scale(pair));
        let middle = PI / (times[0] * times[1]).sqrt();
        let reduced = |relaxation: &PairRelaxation| {
            let range = [PI / (SERIES_MARGIN * times[0]), SERIES_MARGIN * PI / times[1]];
            let (weight, terms) = (relaxation.equilibrium_weight(), relaxation.terms());
            reduced_series(weight, terms, range, times[0] / FASTEST, SERIES_TOLERANCE)
        };
        let springs = ContactSprings::new(pair, &relaxation, &profile, radii, middle)?;
        let (weight, terms) = reduced(&relaxation);
        let springs = springs.with_series(weight, terms);
        let hertz = HertzImpact::new(pair, scene.approach_speed())?;
        let mobility = plate.map_or(0.0, |plate| match finite_size {
            true => plate.mobility(&hertz),
            false => plate.thin_mobility(),
        });
        let springs =
            springs.on_plate(mobility).radiating(radiating.iter().map(radiation_damping).sum());
        let shear = match scene.friction() > 0.0 {
            true => {
                let (modulus, relaxation) = PairRelaxation::tangential(lower, upper)?;
                let size = finite_size.then(|| scene.tangential_size()).transpose()?;
                let (equilibrium_weight, terms) = reduced(&relaxation);
                let friction = scene.friction();
                let stiffnesses = springs.shear_stiffnesses(modulus, size.as_ref());
                Some(ShearSprings { friction, stiffnesses, equilibrium_weight, terms })
            }
            false => None,
        };
        Ok(Repulsion::Springs(springs, shear))
    }

    fn dent_table(&self, reduced: &Reduced, strengths: [f64; 2]) -> Result<DentTable, LawFault> {
        let missing = || LawFault::Unheld("the law has no rebound".into(), "remove [model]".into());
        let law = reduced.law().ok_or_else(missing)?;
        let [slow, fast] = [0, N_SPEEDS - 1].map(|k| self.computed[k]);
        let deepest = DEEPER * fast.quantities.max_approach;
        let first = law.first_yield().ok_or_else(missing)?;
        // A law without Hertz' beginning has its table from far below the slowest contact.
        let first = match law.elastic_exponent() == 1.5 && first.is_finite() {
            true => first,
            false => 1e-3 * slow.quantities.max_approach,
        };
        let log_ratio = (deepest / first).max(2.0).ln() / (N_KNOTS - 1) as f64;
        let knot = |k: usize| {
            let approach = first * (log_ratio * k as f64).exp();
            let [force, length, exponent] = law.indentation(approach).ok_or_else(missing)?;
            Ok([force.ln(), length / approach, exponent])
        };
        let knots = (0..N_KNOTS).map(knot).collect::<Result<_, LawFault>>()?;
        let rate_power = (strengths[1] / strengths[0]).ln() / (fast.speed / slow.speed).ln();
        let middle = (slow.speed * fast.speed).sqrt();
        let rate = [rate_power, middle];
        Ok(DentTable { stiffness: law.stiffness(), yield_approach: first, log_ratio, knots, rate })
    }
}

/// Returns the case with the model that the law stands for: its own or, in place of elements, Ting's where a body relaxes and Hertz'
/// or a half-space radiates waves, and Hertz' elsewhere, of finite size unless the contact is too wide.
fn with_model(case: &Case) -> Result<Case, LawFault> {
    let scene = case.scene();
    match scene.model() {
        ModelChoice::Ting { .. } | ModelChoice::Hertz { .. } => return Ok(case.clone()),
        ModelChoice::Law { law, .. } if law.family.strength_parameter().is_some() => {
            return Ok(case.clone());
        }
        ModelChoice::Law { law, .. } => {
            let message = format!(
                "the header holds the computed pair, and law {} is a formula",
                law.family.name()
            );
            let help = "remove [model], or export the case without this option";
            return Err(LawFault::Unheld(message, help.into()));
        }
        _ => {}
    }
    let radiates = !radiating_half_spaces(scene, scene.approach_speed()).is_empty();
    let is_ting = radiates || relaxes(scene);
    let sized = stand_in(case, is_ting, true)?;
    match Reduced::new(sized.scene()) {
        Ok(_) => Ok(sized),
        Err(_) => stand_in(case, is_ting, false),
    }
}

/// Returns the results of the model at a speed, m/s, without adhesion.
fn computed(case: &Case, speed: f64) -> Result<Computed, LawFault> {
    let scene = case.scene();
    let is_law = matches!(scene.model(), ModelChoice::Law { .. });
    if let Some(flow) = computed_flow(scene, speed).filter(|_| !is_law) {
        let error = Some(flow.quantities.restitution * flow.errors[0]);
        return Ok(Computed { speed, quantities: flow.quantities, error });
    }
    let reduced = Reduced::new(scene).map_err(|refusal| refusal.in_case(case))?;
    let impact = reduced.impact(speed)?;
    let quantities = impact.quantities(impact.peak_pressure.unwrap_or(f64::NAN));
    Ok(Computed { speed, quantities, error: Reduced::model_error(scene, speed) })
}

/// Returns the law of a case that dents at the middle of two speeds (m/s), and its flow stress at both; `None` if nothing dents.
fn dents(case: &Case, speeds: [f64; 2]) -> Result<Option<(Reduced, [f64; 2])>, LawFault> {
    let scene = case.scene();
    let law = match scene.model() {
        ModelChoice::Law { law, .. } => law.clone(),
        _ if speeds.iter().any(|speed| computed_flow(scene, *speed).is_some()) => {
            LawInput { family: LawFamily::MeanPressure, values: Vec::new() }
        }
        _ => return Ok(None),
    };
    let family = law.family;
    let tolerance = fem_case::defaults::LAW_TOLERANCE;
    let model = ModelChoice::Law { law, end_rule: EndRule::ZeroForce, tolerance };
    let scene = scene.clone().with_model(model);
    let at = |speed: f64| {
        let scene = scene.touching_at(speed).unwrap_or_else(|| scene.clone());
        Reduced::new(&scene).map_err(|refusal| LawFault::from(refusal.in_case(case)))
    };
    let strength = |speed: f64| {
        let index = family.strength_parameter().unwrap_or_default();
        Ok::<_, LawFault>(at(speed)?.law_numbers().map_or(1.0, |numbers| numbers[index]))
    };
    let [slow, fast] = speeds;
    Ok(Some((at((slow * fast).sqrt())?, [strength(slow)?, strength(fast)?])))
}

/// Checks that the header holds what a case has beside flow.
fn check_dents(scene: &Scene) -> Result<(), LawFault> {
    let unheld = |message: &str, help: &str| Err(LawFault::Unheld(message.into(), help.into()));
    if relaxes(scene) {
        return unheld(
            "the header holds relaxation or plastic flow, and this case has both",
            "remove the relaxation of the bodies, or write effects.plastic_flow = \"off\"",
        );
    }
    if scene.bodies().iter().any(|body| body.plate().is_some()) {
        return unheld(
            "the header holds a plate or plastic flow, and this case has both",
            "write half_space = {} in place of the plate, or effects.plastic_flow = \"off\"",
        );
    }
    if scene.friction() > 0.0 {
        return unheld(
            "the header holds friction or plastic flow, and this case has both",
            "write contact.friction = 0, or effects.plastic_flow = \"off\"",
        );
    }
    Ok(())
}

/// Returns the pull-off force of the bodies, N, and the distance over which it takes the energy that parts them, m.
fn adhesion_of(scene: &Scene, pair: &Pair) -> Option<[f64; 2]> {
    (restitution_with_adhesion(scene, STILL, 1.0) < 1.0).then(|| {
        let adhesion = Adhesion::new(pair, scene.work_of_adhesion().value());
        let force = adhesion.pull_off_force();
        [force, adhesion.separation_energy() / force]
    })
}
