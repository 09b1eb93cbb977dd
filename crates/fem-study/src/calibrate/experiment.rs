//! One pair of bodies and its speeds: the restitutions that a series makes.
//!
//! The condensed model factors the pair once, on a mesh for all of its speeds. The refined block and the
//! condensed region are those of the largest contact (instantaneous moduli); elements are small
//! enough for the smallest contact, unless the case gives their size.

use fem_case::engineering::show;
use fem_case::{Body, Case, CaseError};
use fem_data::estimate::FitError;
use fem_laws::HertzImpact;
use fem_material::PronyTerm;

use super::fault::CalibrationFault;
use super::pair_model::{Evaluator, PairModel};
use super::settings::CalibrationModel;
use super::speed_span::{SpeedDoubt, SpeedSpan};
use super::target::Target;
use crate::laws::plate_of;
use fem_data::table::{MeasuredPair, MeasuredPairs};
use fem_simulation::{Condensed, Model, SharedModels};

/// The key of the element size, which the error names if no mesh can be made.
const OF_ELEMENT_SIZE: [&str; 3] =
    ["mesh.contact_element_size", "limits.memory", "output.snapshots"];

/// A pair, its data and its model.
#[derive(Debug)]
pub struct Experiment {
    /// Indices of its points in the data.
    pub points: Vec<usize>,
    /// Approach speeds, m/s.
    pub speeds: Vec<f64>,
    /// Hertz' contact times with instantaneous moduli, s.
    pub contact_times: Vec<f64>,
    /// Diameters of the bodies, m; a wall has none.
    pub diameters: [Option<f64>; 2],
    /// Elements across the smallest and the largest contact radius; `None` without a mesh.
    pub elements_across: Option<(f64, f64)>,
    /// The fastest speed, if it is too fast for the quasi-static model.
    pub doubt: Option<SpeedDoubt>,
    /// Warnings on the limits of the model.
    pub warnings: Vec<String>,
    model: PairModel,
}

impl Experiment {
    /// Makes the model of a case with the bodies and the speeds of the data.
    ///
    /// # Errors
    /// The case is invalid, or the mesh or the factor cannot be made.
    pub fn new(
        case: &Case,
        measured: &MeasuredPairs,
        pair: &MeasuredPair,
        target: &Target,
        model: CalibrationModel,
    ) -> Result<Self, CalibrationFault> {
        let speed = |point: &usize| measured.data.points[*point].speed;
        let speeds: Vec<f64> = pair.points.iter().map(speed).collect();
        let case = case.edited(|file| pair.resize(file))?;
        let span = SpeedSpan::of(case.scene(), &speeds)?;
        let made = match model {
            CalibrationModel::Condensed => condensed(&case, &span)?,
            CalibrationModel::Ting => {
                let size = case.scene().finite_size()?;
                size.check(span.fastest.max_contact_radius()).map_err(|error| {
                    let is_fastest = |point: &&usize| speed(point) == span.speeds().1;
                    let point = pair.points.iter().find(is_fastest).unwrap_or(&pair.points[0]);
                    measured.data.fault(*point, error).with_help(format!(
                        "{} is too fast for the sizes and the moduli: is the unit of the speeds \
                         right?",
                        show(span.speeds().1, "m/s")
                    ))
                })?;
                Made {
                    evaluator: Evaluator::Ting(*span.fastest.pair(), plate_of(case.scene())?),
                    elements_across: None,
                    warnings: Vec::new(),
                    is_quasi_static: false,
                }
            }
        };
        Ok(Self {
            points: pair.points.clone(),
            contact_times: speeds.iter().map(|speed| span.contact_time(*speed)).collect(),
            speeds,
            diameters: case.scene().bodies().each_ref().map(Body::diameter),
            elements_across: made.elements_across,
            doubt: span.doubt(case.scene()).filter(|_| !made.is_quasi_static),
            warnings: made.warnings,
            model: PairModel::new(case.scene(), target, made.evaluator),
        })
    }

    /// Returns the restitutions at its speeds with these terms in the calibrated material.
    ///
    /// # Errors
    /// A collision cannot be computed.
    pub fn restitutions(&self, terms: &[PronyTerm]) -> Result<Vec<f64>, FitError> {
        self.model.restitutions(terms, &self.speeds)
    }

    /// Returns the fastest speed, m/s, if its contact is beyond the limits of the model with these terms in the calibrated material.
    pub fn too_fast(&self, terms: &[PronyTerm]) -> Option<f64> {
        let fastest = self.speeds.iter().copied().reduce(f64::max)?;
        self.model.check(terms, fastest).is_err().then_some(fastest)
    }

    /// Returns the restitution at a speed (m/s) with these terms in the calibrated material; 0 if the
    /// bodies do not separate.
    ///
    /// # Errors
    /// A collision cannot be computed.
    pub fn restitution(&self, terms: &[PronyTerm], speed: f64) -> Result<f64, FitError> {
        self.model.restitution(terms, speed)
    }
}

/// Returns the model of a pair and its speeds.
struct Made {
    evaluator: Evaluator,
    elements_across: Option<(f64, f64)>,
    warnings: Vec<String>,
    /// Whether the plan of the model accepts all speeds as quasi-static.
    is_quasi_static: bool,
}

/// Returns whether a plate of the case bends in the slowest contact of the data.
///
/// # Errors
/// A plate that is bonded below; a speed without a Hertz impact.
fn bends(case: &Case, slowest: f64) -> Result<bool, CalibrationFault> {
    let Some(plate) = plate_of(case.scene())? else { return Ok(false) };
    let slowest = HertzImpact::new(&case.scene().pair()?, slowest)?;
    Ok(plate.mobility_in(&slowest) != Ok(None))
}

/// Returns the model for the bodies and speeds of the data, and the data that it can compute: contacts that are too large for the first
/// order of the spheres' finite size are left out, unless they are half of them.
///
/// # Errors
/// A plate that is bonded below; a body or a speed without a Hertz impact.
pub fn chosen_model(
    case: &Case,
    measured: MeasuredPairs,
    given: Option<CalibrationModel>,
) -> Result<(CalibrationModel, MeasuredPairs), CalibrationFault> {
    let speeds = measured.data.points.iter().map(|point| point.speed);
    let slowest = speeds.fold(f64::INFINITY, f64::min);
    let model = match given {
        Some(given) => given,
        None if bends(case, slowest)? => CalibrationModel::Ting,
        None => CalibrationModel::Condensed,
    };
    if model == CalibrationModel::Condensed {
        return Ok((model, measured));
    }
    let mut is_kept = vec![true; measured.data.points.len()];
    for pair in &measured.pairs {
        let case = case.edited(|file| pair.resize(file))?;
        let (bodies, size) = (case.scene().pair()?, case.scene().finite_size()?);
        for point in &pair.points {
            let hertz = HertzImpact::new(&bodies, measured.data.points[*point].speed)?;
            is_kept[*point] = size.check(hertz.max_contact_radius()).is_ok();
        }
    }
    let n_kept = is_kept.iter().filter(|kept| **kept).count();
    let measured = if 2 * n_kept > is_kept.len() { measured.kept(&is_kept) } else { measured };
    Ok((model, measured))
}

fn condensed(case: &Case, span: &SpeedSpan) -> Result<Made, CalibrationFault> {
    if bends(case, span.speeds().0)? {
        return Err(CalibrationFault::Plate);
    }
    let is_given = case.gives("mesh.contact_element_size");
    let size = span.element_size(case.scene());
    let moving = usize::from(case.scene().bodies()[0].diameter().is_none());
    let fastest = case.edited(|file| {
        file.body[moving].approach_speed = Some(span.speeds().1.into());
        file.body[1 - moving].approach_speed = Some(0.0.into());
        if !is_given {
            file.mesh.get_or_insert_default().contact_element_size = Some(size.into());
        }
    })?;
    let condensed = Condensed::new(fastest.scene(), &SharedModels::default());
    let condensed = condensed.map_err(|refusal| {
        let error = refusal.in_case(&fastest);
        if is_given { error.into() } else { no_mesh(error, size, span) }
    })?;
    let plan = condensed.setup().elements.as_ref().map(|elements| &elements.plan);
    let made_size = plan.map_or(f64::NAN, |plan| plan.contact_element_size);
    // Their suggested model cannot be calibrated: the warning about the speed replaces them.
    let of_speed = condensed.speed_warnings();
    let mut warnings = condensed.setup().warnings();
    warnings.retain(|warning| !of_speed.contains(warning));
    Ok(Made {
        evaluator: Evaluator::Condensed(Box::new(condensed)),
        elements_across: Some(span.elements_across(made_size)),
        warnings,
        is_quasi_static: of_speed.is_empty(),
    })
}

/// Returns the error of a mesh whose elements are too small because of the speeds; other errors of a mesh are those of
/// the case.
fn no_mesh(error: CaseError, element_size: f64, span: &SpeedSpan) -> CalibrationFault {
    if !error.key().is_some_and(|key| OF_ELEMENT_SIZE.contains(&key)) {
        return error.into();
    }
    let reason = error.message().to_string();
    CalibrationFault::NoMesh { speeds: span.speeds(), element_size, reason }
}
