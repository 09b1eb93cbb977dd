//! The laws of DEM codes that fit e(v) and T(v), and their ranges of validity.

use std::collections::BTreeMap;

use fem_case::schema::BodyTable;
use fem_case::{Body, Case, Scene};
use fem_data::dem::{
    self, Export, Friction, FrictionLaw, LawOfSpeed, Sphere, fit_dissipation, fit_springs,
    restitution_of,
};
use fem_data::estimate::{FitError, Model, Outcome, Point, Problem};
use fem_laws::laws::{linear_from_restitution, tsuji_coefficient};
use fem_laws::{EndRule, LawFamily, MIN_RESTITUTION};

use super::chosen_law::{ChosenLaw, model_of};
use super::computed_curve::patch_rebound;
use super::impact_curve::ImpactCurve;
use super::law_fault::LawFault;
use fem_data::estimate::CONFIDENCE;

/// Restitutions nearer to 1 do not determine a law.
const LOSSLESS: f64 = 1e-7;

/// The laws of DEM codes, fitted to one curve.
#[derive(Clone, Debug)]
pub struct DemExport {
    /// The computed collisions that the laws are fitted to.
    pub curve: ImpactCurve,
    /// The content of the snippets.
    pub export: Export,
    /// The law with one e at all speeds on Hertz' spring and the linear one; the viscoelastic law and the constant dashpot; and, for
    /// bodies that dent, Luding's springs and LAMMPS' `mdr`.
    pub laws: Vec<FittedLaw>,
}

/// A law and the values of its parameters.
#[derive(Clone, Debug)]
pub struct FittedLaw {
    /// The bodies under it.
    pub model: Model,
    /// Values of its parameters, SI.
    pub values: Vec<f64>,
    /// First and last speed of validity (m/s) and the largest error of e; see [`ImpactCurve::validity`].
    pub validity: [f64; 3],
}

impl FittedLaw {
    /// Returns a law with its validity.
    fn judged(
        model: Model,
        values: Vec<f64>,
        curve: &ImpactCurve,
        tolerance: f64,
    ) -> Result<Self, FitError> {
        let made = |speed: f64| Ok(model.outcome(&values, speed)?.restitution);
        let validity = curve.validity(tolerance, made)?;
        Ok(Self { model, values, validity })
    }

    /// Returns the law's name as text.
    pub fn name(&self) -> &'static str {
        match self.model.family() {
            LawFamily::Tsuji => "one e for all speeds, Hertz",
            LawFamily::KuwabaraKono => "viscoelastic (Kuwabara-Kono)",
            LawFamily::HertzDashpot => "constant dashpot",
            LawFamily::Luding => "springs that dent (Luding)",
            LawFamily::Mdr => "mdr of LAMMPS",
            family => family.name(),
        }
    }

    /// Returns restitution and contact time at a speed, m/s.
    pub fn outcome(&self, speed: f64) -> Option<Outcome> {
        self.model.outcome(&self.values, speed).ok()
    }
}

impl DemExport {
    /// Fits all laws to a curve; `tolerance` is the largest error of e within a range of validity. The codes have no plate: its loss is
    /// one of the laws. Without any loss all dashpots are 0.
    ///
    /// # Errors
    /// The data do not determine a law, or friction is not computed in the case.
    pub fn of(case: &Case, curve: ImpactCurve, tolerance: f64) -> Result<Self, LawFault> {
        let plate = case.scene().bodies().iter().position(|body| body.plate().is_some());
        let on_block = plate.map(|side| case.scene().with_half_space(side));
        let scene = on_block.as_ref().unwrap_or(case.scene());
        let n = curve.points.len() as f64;
        // The mean is the best constant e.
        let e = curve.points.iter().map(|point| point.restitution).sum::<f64>() / n;
        if e < MIN_RESTITUTION {
            return Err(FitError::Insensitive { key: "alpha" }.into());
        }
        let is_lossless = e > 1.0 - LOSSLESS;
        let e = if is_lossless { 1.0 } else { e };
        let constant_validity = curve.validity(tolerance, |_| Ok(e))?;
        let (force, overlap) = (EndRule::ZeroForce, EndRule::ZeroOverlap);
        let constant = FittedLaw {
            model: model_of(scene, LawFamily::Tsuji, overlap)?,
            values: vec![tsuji_coefficient(e)?],
            validity: constant_validity,
        };
        let pair = *constant.model.pair();
        let contact_time = one_contact_time(&curve.points);
        let law = linear_from_restitution(&pair, e, contact_time, overlap)?;
        let linear = FittedLaw {
            model: model_of(scene, LawFamily::Linear, overlap)?,
            values: vec![law.stiffness(), law.damping()],
            validity: constant_validity,
        };
        let mut laws = vec![constant, linear];
        let points = timeless(&curve.points);
        for family in [LawFamily::KuwabaraKono, LawFamily::HertzDashpot] {
            let (model, key) = (model_of(scene, family, force)?, family.parameters()[0].key);
            let values = match is_lossless {
                true => vec![0.0],
                false => Problem::new(&model, &points, &[key])?.fit(CONFIDENCE)?.values,
            };
            laws.push(FittedLaw::judged(model, values, &curve, tolerance)?);
        }
        let has_strength = scene.bodies().iter().any(|body| body.yield_strength().is_some());
        let dents = has_strength || curve.law.is_some_and(LawFamily::is_elastic_plastic);
        if dents && !is_lossless {
            if let Some(values) = fit_springs(&pair, &curve.points)? {
                let model = model_of(scene, LawFamily::Luding, force)?;
                laws.push(FittedLaw::judged(model, values.to_vec(), &curve, tolerance)?);
            }
            laws.extend(by_mdr(case, &curve, tolerance));
        }
        let of_speed = |law: &FittedLaw| LawOfSpeed {
            name: law.model.family().name(),
            values: law.values.clone(),
            validity: law.validity,
        };
        let mut of_speed: Vec<LawOfSpeed> = laws[2..].iter().map(of_speed).collect();
        let hunt_crossley = match is_lossless {
            true => Some([0.0; 2]),
            false => fit_dissipation(&curve.points)?,
        };
        if let Some(values) = hunt_crossley {
            let made = |speed: f64| Ok(restitution_of(values[0] * speed));
            let validity = curve.validity(tolerance, made)?;
            of_speed.push(LawOfSpeed { name: "hunt_crossley", values: values.to_vec(), validity });
        }
        let friction = if dents { None } else { friction_of(case, &laws)? };
        let lacks_friction = dents && case.scene().friction() > 0.0;
        let export = Export {
            title: scene.title().replace(char::is_control, " "),
            spheres: spheres(scene),
            pair,
            speeds: curve.speeds(),
            tolerance,
            restitution: e,
            contact_time,
            validity: constant_validity,
            of_speed,
            bounds: curve.bounds.clone(),
            notes: notes(&curve, is_lossless, lacks_friction),
            band: curve.band.as_ref().map(|band| (band.confidence, band.widest())),
            friction,
        };
        Ok(Self { curve, export, laws })
    }
}

/// Returns the contact time T, s, with the least Σ (T/T_i − 1)².
fn one_contact_time(points: &[Point]) -> f64 {
    let inverse = || points.iter().filter_map(|point| point.contact_time).map(f64::recip);
    inverse().sum::<f64>() / inverse().map(|rate| rate * rate).sum::<f64>()
}

/// Returns what a file must say of its restitutions apart from bounds.
fn notes(curve: &ImpactCurve, is_lossless: bool, lacks_friction: bool) -> Vec<String> {
    let elastic = curve.meant_elastic.iter().map(|name| {
        format!("the case means {name} to be elastic (elastic = true): e has no damping of it")
    });
    let lossless = is_lossless.then(|| "e is 1 at all speeds: nothing is lost".to_string());
    let rubbing = "the friction of bodies that dent is not computed and is left out";
    let smooth = lacks_friction.then(|| rubbing.to_string());
    curve.left_out.iter().cloned().chain(elastic).chain(lossless).chain(smooth).collect()
}

/// Fits the yield strength of LAMMPS' `mdr` to the restitutions; `None` if no strength makes them.
fn by_mdr(case: &Case, curve: &ImpactCurve, tolerance: f64) -> Option<FittedLaw> {
    let on_block =
        case.edited(|file| file.body.iter_mut().for_each(BodyTable::make_plate_half_space));
    let law = ChosenLaw::of(&on_block.ok()?, LawFamily::Mdr, &[], None).ok()?;
    let points = timeless(&curve.points);
    let values = law.problem(&points, &["yield_strength"]).ok()?.fit(CONFIDENCE).ok()?.values;
    let model = law.model().clone();
    FittedLaw::judged(model, values, curve, tolerance).ok()
}

/// Returns friction and the tangential law of each file, whose normal laws these are; `None` of a case without friction.
fn friction_of(case: &Case, laws: &[FittedLaw]) -> Result<Option<Friction>, LawFault> {
    if case.scene().friction() == 0.0 {
        return Ok(None);
    }
    let rebound = patch_rebound(case)?;
    let mut fitted = BTreeMap::new();
    for head in dem::heads() {
        let Some((law, given)) = head.friction else { continue };
        let family = match head.law {
            "constant" if head.is_linear => "linear",
            "constant" => "tsuji",
            name => name,
        };
        let normal = laws.iter().find(|law| law.model.family().name() == family);
        // Drake's dashpot is on a spring of its own; a sliding patch asks for the restitution alone.
        let Some(normal) = normal.or(laws.first().filter(|_| law == FrictionLaw::Sliding)) else {
            continue;
        };
        let fit =
            rebound.fit(law, given, (&normal.model, &normal.values)).map_err(FitError::from)?;
        fitted.insert(head.name, fit);
    }
    Ok(Some(Friction { rebound, fitted }))
}

/// Returns the points without their contact times.
fn timeless(points: &[Point]) -> Vec<Point> {
    points.iter().map(|point| Point { contact_time: None, ..*point }).collect()
}

/// Returns the spheres of a scene: two, or the one that strikes a wall.
fn spheres(scene: &Scene) -> Vec<Sphere> {
    let sphere = |body: &Body| {
        let sphere = Sphere::new(body.diameter()?, body.material()?);
        Some(Sphere { density: body.mean_density()?, ..sphere })
    };
    scene.bodies().iter().filter_map(sphere).collect()
}
