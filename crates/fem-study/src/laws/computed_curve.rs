//! Restitution and contact time over speed by closed forms, and what is not known of them.

use std::mem::discriminant;

use fem_case::engineering::show;
use fem_case::schema::{HertzTable, ModelTable, TingTable};
use fem_case::{Body, Case, ModelChoice, Scene, WorkOfAdhesion};
use fem_data::dem::PatchRebound;
use fem_data::estimate::Point;
use fem_laws::{Adhesion, LawFamily};
use fem_simulation::{
    FlowingImpact, ObliqueResponse, Reduced, bounds_of_closed_forms, computed_flow,
    restitution_with_adhesion,
};

use super::chosen_law::plate_of;
use super::impact_curve::{ImpactCurve, speeds_between};
use super::law_fault::LawFault;

/// Impact angles at which the rebound of the patch is computed.
const N_ANGLES: usize = 20;
/// Largest tan θ/μ of them; beyond about 7 (1 + e)/2 the surfaces slide throughout.
const WIDEST_ANGLE: f64 = 9.0;

impl ImpactCurve {
    /// Computes the curve with the case's contact law or, in place of any other model, with the mean-pressure law where bodies flow
    /// and Ting's or Hertz' model elsewhere, from one speed to another, m/s, or over a decade around that of the case. Speeds at which
    /// the bodies stick are left out, and so are those at which the restitution is a bound, unless bounds are taken as they are.
    ///
    /// # Errors
    /// The bodies stick or the restitution is a bound at most speeds; the case has no such model; or a collision cannot be computed.
    pub fn computed(
        case: &Case,
        speeds: Option<(f64, f64)>,
        as_elastic: bool,
    ) -> Result<Self, LawFault> {
        let scene = case.scene();
        // No closed form has the base of a bonded plate.
        plate_of(scene)?;
        let (own, decade) = (scene.approach_speed(), 10f64.sqrt());
        let range = speeds.unwrap_or((own / decade, own * decade));
        let impacts = ComputedImpacts { case, reduced: reduced(case) };
        let kinds = speeds_between(range).map(|speed| Ok((speed, impacts.at(speed, as_elastic)?)));
        let kinds: Vec<(f64, Kind)> = kinds.collect::<Result<_, LawFault>>()?;
        let kept = kinds.iter().filter_map(|(_, kind)| match kind {
            Kind::Computed(impact) | Kind::Bound(Some(impact)) => Some(*impact),
            Kind::Bound(None) | Kind::Sticks => None,
        });
        let kept: Vec<ComputedImpact> = kept.collect();
        let Unknown { bounds, mut left_out, fault, has_own } = Unknown::of(scene, &kinds);
        if let Some(fault) = fault.filter(|_| kept.len() < 2) {
            return Err(fault);
        }
        let curve = Self::of(&scene.pair()?, kept.iter().map(|impact| impact.point).collect())?;
        let (slowest, fastest) = curve.speeds();
        let is_outside = has_own || !(slowest..=fastest).contains(&own);
        if !left_out.is_empty() && is_outside {
            left_out.push(format!(
                "the speed of the case, {}, is outside of the speeds of this export, {}",
                show(own, "m/s"),
                between(slowest, fastest)
            ));
        }
        let is_law = matches!(scene.model(), ModelChoice::Law { .. });
        let elastic = scene.bodies().iter().filter(|body| body.is_meant_elastic() && !is_law);
        let mut meant_elastic: Vec<String> =
            elastic.filter_map(|body| body.material_name().map(String::from)).collect();
        meant_elastic.dedup();
        let flows = kept.iter().any(|impact| impact.flows);
        let law = flows.then_some(LawFamily::MeanPressure);
        let scatter = kept.iter().map(|impact| impact.error).fold(0.0, f64::max);
        Ok(Self { law, scatter, bounds, left_out, meant_elastic, ..curve })
    }
}

/// The speeds of a computed curve at which the restitution is not known, as texts.
#[derive(Default)]
struct Unknown {
    /// The speeds of bounds that are taken as they are, with the reasons.
    bounds: Vec<String>,
    /// The speeds that are left out, with the reasons.
    left_out: Vec<String>,
    /// The error if too few speeds are left.
    fault: Option<LawFault>,
    /// Whether the speed of the case is among those that are left out.
    has_own: bool,
}

impl Unknown {
    fn of(scene: &Scene, kinds: &[(f64, Kind)]) -> Self {
        let (own, mut unknown) = (scene.approach_speed(), Self::default());
        for run in kinds.chunk_by(|one, next| discriminant(&one.1) == discriminant(&next.1)) {
            let ((slow, kind), (fast, _)) = (&run[0], &run[run.len() - 1]);
            let speeds = between(*slow, *fast);
            let reasons = || bounds_of_closed_forms(scene, own.max(*slow).min(*fast));
            let (text, fault) = match kind {
                Kind::Computed(_) => continue,
                Kind::Bound(Some(_)) => {
                    let reasons = reasons().join("; ");
                    let text = format!("{speeds} e is an upper bound, taken as it is: {reasons}");
                    unknown.bounds.push(text);
                    continue;
                }
                Kind::Bound(None) => {
                    let reasons = reasons();
                    let text = "the restitution is a bound and is left out";
                    let text = format!("{speeds} {text}: {}", reasons.join("; "));
                    (text, LawFault::Bound(reasons))
                }
                Kind::Sticks => {
                    let text = "which no dashpot states: these speeds are left out";
                    let text = format!("{speeds} the bodies {}, {text}", stick(scene));
                    (text, sticks(scene, &speeds))
                }
            };
            unknown.left_out.push(text);
            let is_own = (*slow..=*fast).contains(&own);
            unknown.has_own |= is_own;
            if is_own || unknown.fault.is_none() {
                unknown.fault = Some(fault);
            }
        }
        unknown
    }
}

/// Returns a range of speeds, m/s, as text.
fn between(slow: f64, fast: f64) -> String {
    format!("from {} to {}", show(slow, "m/s"), show(fast, "m/s"))
}

/// A computed point of a curve.
#[derive(Clone, Copy)]
struct ComputedImpact {
    point: Point,
    /// Error of the restitution by the law that stands in for elements.
    error: f64,
    flows: bool,
}

/// The kind of the restitution at a speed.
enum Kind {
    Computed(ComputedImpact),
    /// It is a bound, with its value if that is accepted.
    Bound(Option<ComputedImpact>),
    /// The bodies stay together.
    Sticks,
}

/// The collisions of a case by closed forms.
struct ComputedImpacts<'a> {
    case: &'a Case,
    /// The law or the elastic model of the case.
    reduced: Result<Reduced, LawFault>,
}

impl ComputedImpacts<'_> {
    fn reduced(&self) -> Result<&Reduced, LawFault> {
        self.reduced.as_ref().map_err(Clone::clone)
    }

    fn at(&self, speed: f64, as_elastic: bool) -> Result<Kind, LawFault> {
        let scene = self.case.scene();
        if restitution_with_adhesion(scene, speed, 1.0) <= 0.0 {
            return Ok(Kind::Sticks);
        }
        let is_bound = !bounds_of_closed_forms(scene, speed).is_empty();
        if is_bound && !as_elastic {
            return Ok(Kind::Bound(None));
        }
        let impact = self.computed(speed)?;
        Ok(match impact.point.restitution > 0.0 {
            true if is_bound => Kind::Bound(Some(impact)),
            true => Kind::Computed(impact),
            false => Kind::Sticks,
        })
    }

    /// Computes a collision: by the mean-pressure law where bodies flow, or else by the law or the elastic model. Beside a body that
    /// relaxes, a flowing one has the restitution of both losses as their product, of which half of the second one is uncertain.
    fn computed(&self, speed: f64) -> Result<ComputedImpact, LawFault> {
        let scene = self.case.scene();
        let is_law = matches!(scene.model(), ModelChoice::Law { .. });
        let (point, error, flows) = match computed_flow(scene, speed).filter(|_| !is_law) {
            None => {
                let impact = self.reduced()?.impact(speed)?;
                let point = Point::new(speed, impact.restitution);
                (Point { contact_time: impact.contact_time, ..point }, 0.0, false)
            }
            Some(FlowingImpact { quantities, errors, .. }) => {
                let relaxed = match relaxes(scene) {
                    true => self.reduced()?.impact(speed)?.restitution,
                    false => 1.0,
                };
                let own = quantities.restitution;
                let contact_time = Some(quantities.contact_time).filter(|time| time.is_finite());
                let point = Point { contact_time, ..Point::new(speed, relaxed * own) };
                (point, own * (errors[0] + 0.5 * (1.0 - relaxed)), true)
            }
        };
        let restitution = restitution_with_adhesion(scene, speed, point.restitution);
        Ok(ComputedImpact { point: Point { restitution, ..point }, error, flows })
    }
}

/// Returns whether a body of a scene relaxes.
pub(super) fn relaxes(scene: &Scene) -> bool {
    let relaxes = |body: &Body| body.material().is_some_and(|it| it.relaxation().is_some());
    scene.bodies().iter().any(relaxes)
}

/// Returns what bodies do at speeds at which they do not part.
fn stick(scene: &Scene) -> String {
    let speed = match (scene.work_of_adhesion(), scene.pair()) {
        (WorkOfAdhesion::Given(work), Ok(pair)) => Adhesion::new(&pair, work).sticking_speed(),
        _ => 0.0,
    };
    match speed > 0.0 {
        true => format!("stick below {} by adhesion", show(speed, "m/s")),
        false => "stay together".to_string(),
    }
}

/// Returns the error for bodies that do not part at some speeds.
fn sticks(scene: &Scene, speeds: &str) -> LawFault {
    let message =
        format!("the bodies {}, and no dashpot states that: {speeds} e is 0", stick(scene));
    let mut help = "name speeds at which they part with --speeds LOW..HIGH".to_string();
    if matches!(scene.work_of_adhesion(), WorkOfAdhesion::Given(work) if work > 0.0) {
        help += ", or set contact.work_of_adhesion = 0 if sticking is not meant";
    }
    LawFault::Sticks(message, help)
}

/// Returns the case's own model or, in place of one with elements, Ting's if a body relaxes and Hertz' otherwise. On a plate it has the
/// finite thickness, unless the contact is too wide for that.
fn reduced(case: &Case) -> Result<Reduced, LawFault> {
    let of = |case: &Case| Reduced::new(case.scene()).map_err(|refusal| refusal.in_case(case));
    if !has_elements(case) {
        return Ok(of(case)?);
    }
    let has_plate = plate_of(case.scene())?.is_some();
    let relaxes = relaxes(case.scene());
    match has_plate.then(|| of(&stand_in(case, relaxes, true)?).map_err(LawFault::from)) {
        Some(Ok(sized)) => Ok(sized),
        _ => Ok(of(&stand_in(case, relaxes, false)?)?),
    }
}

/// Returns whether a case asks for a model with elements, or for any.
fn has_elements(case: &Case) -> bool {
    use ModelChoice::{Auto, Condensed, Fem};
    matches!(case.scene().model(), Fem | Condensed(_) | Auto)
}

/// Returns a case with Ting's model or Hertz', with or without finite size.
pub(super) fn stand_in(case: &Case, is_ting: bool, is_sized: bool) -> Result<Case, LawFault> {
    let finite_size = Some(is_sized);
    let (ting, hertz) = match is_ting {
        true => (Some(TingTable { finite_size, ..TingTable::default() }), None),
        false => (None, Some(HertzTable { finite_size })),
    };
    let model = ModelTable { ting, hertz, ..ModelTable::default() };
    Ok(case.edited(|file| file.model = Some(model))?)
}

/// Computes how the patch of an oblique impact rebounds over the angle, at the approach speed of a case with friction: of spheres of a
/// finite size, unless the contact is too wide for that.
pub(super) fn patch_rebound(case: &Case) -> Result<PatchRebound, LawFault> {
    let speed = case.scene().approach_speed();
    let of = |case: &Case| -> Result<ObliqueResponse, LawFault> {
        Ok(ObliqueResponse::of(case.scene(), speed).map_err(|refusal| refusal.in_case(case))?)
    };
    let patch = match has_elements(case) {
        true => {
            let relaxes = relaxes(case.scene());
            of(&stand_in(case, relaxes, true)?).or_else(|_| of(&stand_in(case, relaxes, false)?))?
        }
        false => of(case)?,
    };
    let friction = case.scene().friction();
    let scale = friction * speed;
    let before: Vec<f64> =
        (1..=N_ANGLES).map(|k| WIDEST_ANGLE * k as f64 / N_ANGLES as f64).collect();
    let after = before.iter().map(|x| patch.patch_after(friction, scale * x) / scale).collect();
    let (modulus, mass_ratio) = (patch.modulus(), patch.mass_ratio());
    Ok(PatchRebound { friction, modulus, mass_ratio, speed, before, after })
}
