//! Validation: turns a case as written into a scene. Units are converted, limits checked and names resolved; each fault
//! points at its key.

mod bodies;
pub(crate) mod flow;
pub(crate) mod gravity;
mod materials;
mod models;
mod output;
pub(crate) mod relaxation;

use std::cell::RefCell;
use std::path::Path;

use self::relaxation::check_temperature;
use crate::error::CaseError;
use crate::quantity::range::Range;
use crate::quantity::{Quantity, QuantityKind};
use crate::scene::{Accuracy, Limits, MeshSettings, Scene, UncertainInput, defaults};
use crate::schema::CaseFile;
use crate::schema::accuracy_table::{AccuracyTable, ToleranceValue};
use crate::source::document::Document;
use crate::source::toml_syntax::join;

/// The number at a key of a table of the case.
macro_rules! number {
    ($check:ident, $table:ident.$key:ident, $allowed:expr) => {
        $check.optional(
            concat!(stringify!($table), ".", stringify!($key)),
            $table.$key.as_ref(),
            $allowed,
        )?
    };
}

/// Returns the scene of a case, or its first fault.
///
/// Relative mesh files are looked for in `folder`.
pub(crate) fn validate(
    document: &Document,
    file: &CaseFile,
    stem: &str,
    folder: &Path,
) -> Result<Scene, CaseError> {
    let mut check = Check { document, folder, temperature: None, inputs: RefCell::default() };
    let temperature = file.scene.as_ref().and_then(|scene| scene.temperature.as_ref());
    check.temperature = check.optional("scene.temperature", temperature, Range::POSITIVE)?;
    check_temperature(&check, file)?;
    let start = file.start.clone().unwrap_or_default();
    let mesh = file.mesh.clone().unwrap_or_default();
    let contact = file.contact.clone().unwrap_or_default();
    let time = file.time.clone().unwrap_or_default();
    let output = file.output.clone().unwrap_or_default();
    let limits = file.limits.clone().unwrap_or_default();
    let bodies = check.bodies(file)?;
    let gap = number!(check, start.gap, Range::NOT_NEGATIVE);
    let gravity = check.gravity(file, &bodies, gap.unwrap_or(defaults::GAP))?;
    let probes = check.probes(&output.probe, &bodies)?;
    let scene = Scene {
        title: file.title.clone().unwrap_or_else(|| stem.to_string()),
        bodies,
        temperature: check.temperature,
        gap,
        gravity,
        mesh: MeshSettings {
            contact_element_size: number!(check, mesh.contact_element_size, Range::POSITIVE),
            refined_radius: number!(check, mesh.refined_radius, Range::POSITIVE),
            growth: number!(check, mesh.growth, Range::GROWTH),
            far_radius: number!(check, mesh.far_radius, Range::POSITIVE),
            staggered: mesh.staggered,
        },
        contact_method: contact.method,
        penalty_factor: number!(check, contact.penalty_factor, Range::POSITIVE),
        work_of_adhesion: number!(check, contact.work_of_adhesion, Range::WORK_OF_ADHESION),
        friction: number!(check, contact.friction, Range::NOT_NEGATIVE).unwrap_or_default(),
        step_factor: number!(check, time.step_factor, Range::STEP_FACTOR),
        mass_scaling: number!(check, time.mass_scaling, Range::MASS_SCALING),
        snapshots: output.snapshots.as_ref().map(|value| check.snapshots(value)).transpose()?,
        probes,
        fields: output.fields,
        wants_report: output.report.unwrap_or(defaults::REPORT),
        model: check.model(file.model.as_ref())?,
        accuracy: check.accuracy(file.accuracy.as_ref())?,
        effects: file.effects.unwrap_or_default(),
        limits: Limits {
            elements: number!(check, limits.elements, Range::COUNT).map(|count| count as u64),
            element_updates: number!(check, limits.element_updates, Range::COUNT)
                .map(|count| count as u64),
            memory: number!(check, limits.memory, Range::COUNT).map(|bytes| bytes as u64),
        },
        refinement: 1.0,
        inputs: Vec::new(),
    };
    Ok(Scene { inputs: check.measured_inputs()?, ..scene })
}

/// Returns whether a key is that of a measured input.
fn is_measured(key: &str) -> bool {
    const TABLES: [&str; 5] = ["material.", "body.", "start.", "gravity.", "model.law."];
    ["contact.work_of_adhesion", "contact.friction", "scene.temperature"].contains(&key)
        || TABLES.iter().any(|table| key.starts_with(table))
}

/// Checks the tables of a case; `folder` is that of relative mesh files.
pub(crate) struct Check<'a> {
    document: &'a Document,
    folder: &'a Path,
    /// The temperature of the case, K.
    temperature: Option<f64>,
    /// The numbers with an uncertainty so far.
    inputs: RefCell<Vec<UncertainInput>>,
}

impl Check<'_> {
    /// Returns the tolerances of a case; 1 % by default.
    pub(super) fn accuracy(&self, table: Option<&AccuracyTable>) -> Result<Accuracy, CaseError> {
        let default = defaults::accuracy();
        let key = "accuracy.tolerance";
        match table.and_then(|table| table.tolerance.as_ref()) {
            None => Ok(default),
            Some(ToleranceValue::Share(share)) => {
                Ok(Accuracy::within(self.number(key, share, Range::TOLERANCE)?))
            }
            Some(ToleranceValue::Table(table)) => {
                macro_rules! share {
                    ($key:ident) => {
                        self.optional(
                            &join(key, stringify!($key)),
                            table.$key.as_ref(),
                            Range::TOLERANCE,
                        )?
                        .unwrap_or(default.$key)
                    };
                }
                Ok(Accuracy {
                    restitution: share!(restitution),
                    contact_time: share!(contact_time),
                    peak_force: share!(peak_force),
                    peak_pressure: share!(peak_pressure),
                })
            }
        }
    }
    /// Returns all numbers with an uncertainty.
    fn measured_inputs(&self) -> Result<Vec<UncertainInput>, CaseError> {
        let inputs = self.inputs.take();
        let Some(setting) = inputs.iter().find(|input| !is_measured(&input.key)) else {
            return Ok(inputs);
        };
        let key = &setting.key;
        let message = format!("{key} has no uncertainty: it is a setting, not a measured input");
        Err(self.error(key, message).with_help("write the number alone"))
    }

    fn error(&self, path: &str, message: impl Into<String>) -> CaseError {
        self.document.error_at(path, message)
    }

    /// Creates an error at one of several keys that contradict each other; see [`Document::blamed`].
    fn conflict(&self, default: &str, others: &[&str], message: impl Into<String>) -> CaseError {
        self.error(self.document.blamed(default, others), message)
    }

    /// Returns a number in SI if the key allows it.
    fn number<K: QuantityKind>(
        &self,
        path: &str,
        quantity: &Quantity<K>,
        allowed: Range,
    ) -> Result<f64, CaseError> {
        let key = path.rsplit('.').find(|part| part.parse::<usize>().is_err()).unwrap_or(path);
        let (value, uncertainty) = quantity.measured().map_err(|error| {
            let (message, help) = quantity.explain(&error, key);
            self.error(path, message).with_help(help)
        })?;
        if allowed.has(value) {
            if let Some(uncertainty) = uncertainty {
                let key = path.to_string();
                self.inputs.borrow_mut().push(UncertainInput { key, value, uncertainty });
            }
            Ok(value)
        } else {
            Err(self
                .error(path, format!("{key} is {quantity}"))
                .with_help(format!("{key} must be {}", allowed.words())))
        }
    }

    /// Returns the number of an optional key in SI if the key allows it.
    pub(crate) fn optional<K: QuantityKind>(
        &self,
        path: &str,
        quantity: Option<&Quantity<K>>,
        allowed: Range,
    ) -> Result<Option<f64>, CaseError> {
        quantity.map(|quantity| self.number(path, quantity, allowed)).transpose()
    }
}
