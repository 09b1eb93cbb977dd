//! From the case as written to a scene: units converted, limits checked, names resolved, each
//! fault pointed at.

mod accuracy;
mod bodies;
pub(crate) mod gravity;
mod materials;
mod models;
mod probes;
mod snapshots;

use std::path::Path;

use crate::error::CaseError;
use crate::quantity::{Quantity, QuantityKind};
use crate::scene::{Limits, MeshSettings, Scene};
use crate::schema::CaseFile;
use crate::source::document::Document;

/// Numbers that a key allows.
pub(crate) struct Allowed {
    words: &'static str,
    test: fn(f64) -> bool,
}

const fn allowed(words: &'static str, test: fn(f64) -> bool) -> Allowed {
    Allowed { words, test }
}

const ANY: Allowed = allowed("any number", |_| true);
const POSITIVE: Allowed = allowed("greater than 0", |x| x > 0.0);
const NOT_NEGATIVE: Allowed = allowed("0 or greater", |x| x >= 0.0);
const ABOVE_ONE: Allowed = allowed("greater than 1", |x| x > 1.0);
const STEP_FACTOR: Allowed = allowed("greater than 0 and at most 1", |x| x > 0.0 && x <= 1.0);
const MASS_SCALING: Allowed = allowed("from 0 (none) to 0.1", |x| (0.0..=0.1).contains(&x));
/// Whole numbers up to where doubles still count without gaps.
const COUNT: Allowed =
    allowed("a whole number from 1 to 9e15", |x| (1.0..=9e15).contains(&x) && x.fract() == 0.0);

/// The scene of a case, or its first fault.
///
/// Mesh files are looked for beside the case, in `folder`.
pub(crate) fn validate(
    document: &Document,
    file: &CaseFile,
    stem: &str,
    folder: &Path,
) -> Result<Scene, CaseError> {
    let check = Check { document, folder };
    let bodies = check.bodies(file)?;
    let gap = file.start.as_ref().and_then(|start| start.gap.as_ref());
    let gap = check.optional("start.gap", gap, NOT_NEGATIVE)?;
    let gravity = check.gravity(file, &bodies, gap.unwrap_or_default())?;
    let mesh = file.mesh.clone().unwrap_or_default();
    let contact = file.contact.clone().unwrap_or_default();
    let time = file.time.clone().unwrap_or_default();
    let limits = file.limits.clone().unwrap_or_default();
    let snapshots = file.output.as_ref().and_then(|output| output.snapshots.as_ref());
    let probes = file.output.as_ref().map_or(&[][..], |output| &output.probe);
    let probes = check.probes(probes, &bodies)?;
    let count = |key: &str, value| -> Result<Option<u64>, CaseError> {
        Ok(check.optional(key, value, COUNT)?.map(|count| count as u64))
    };
    Ok(Scene {
        title: file.title.clone().unwrap_or_else(|| stem.to_string()),
        bodies,
        gap,
        gravity,
        mesh: MeshSettings {
            contact_element_size: check.optional(
                "mesh.contact_element_size",
                mesh.contact_element_size.as_ref(),
                POSITIVE,
            )?,
            refined_radius: check.optional(
                "mesh.refined_radius",
                mesh.refined_radius.as_ref(),
                POSITIVE,
            )?,
            growth: check.optional("mesh.growth", mesh.growth.as_ref(), ABOVE_ONE)?,
            far_radius: check.optional("mesh.far_radius", mesh.far_radius.as_ref(), POSITIVE)?,
            staggered: mesh.staggered,
        },
        contact_method: contact.method,
        penalty_factor: check.optional(
            "contact.penalty_factor",
            contact.penalty_factor.as_ref(),
            POSITIVE,
        )?,
        step_factor: check.optional("time.step_factor", time.step_factor.as_ref(), STEP_FACTOR)?,
        mass_scaling: check.optional(
            "time.mass_scaling",
            time.mass_scaling.as_ref(),
            MASS_SCALING,
        )?,
        snapshots: snapshots.map(|value| check.snapshots(value)).transpose()?,
        probes,
        fields: file.output.as_ref().and_then(|output| output.fields.clone()),
        wants_report: file.output.as_ref().and_then(|output| output.report).unwrap_or(true),
        model: check.model(file.model.as_ref())?,
        accuracy: check.accuracy(file.accuracy.as_ref())?,
        effects: file.effects.unwrap_or_default(),
        limits: Limits {
            elements: count("limits.elements", limits.elements.as_ref())?,
            element_updates: count("limits.element_updates", limits.element_updates.as_ref())?,
            memory: check
                .optional("limits.memory", limits.memory.as_ref(), COUNT)?
                .map(|bytes| bytes as u64),
        },
        refinement: 1.0,
    })
}

pub(crate) struct Check<'a> {
    document: &'a Document,
    folder: &'a Path,
}

impl Check<'_> {
    fn error(&self, path: &str, message: impl Into<String>) -> CaseError {
        self.document.error_at(path, message)
    }

    /// An error at one of several keys that contradict each other; see [`Document::blamed`].
    fn conflict(&self, default: &str, others: &[&str], message: impl Into<String>) -> CaseError {
        self.error(self.document.blamed(default, others), message)
    }

    fn number<K: QuantityKind>(
        &self,
        path: &str,
        quantity: &Quantity<K>,
        allowed: Allowed,
    ) -> Result<f64, CaseError> {
        let key = path.rsplit('.').find(|part| part.parse::<usize>().is_err()).unwrap_or(path);
        let value = quantity.si().map_err(|error| {
            let (message, help) = quantity.explain(&error, key);
            self.error(path, message).with_help(help)
        })?;
        if (allowed.test)(value) {
            Ok(value)
        } else {
            Err(self
                .error(path, format!("{key} is {quantity}"))
                .with_help(format!("{key} must be {}", allowed.words)))
        }
    }

    pub(crate) fn optional<K: QuantityKind>(
        &self,
        path: &str,
        quantity: Option<&Quantity<K>>,
        allowed: Allowed,
    ) -> Result<Option<f64>, CaseError> {
        quantity.map(|quantity| self.number(path, quantity, allowed)).transpose()
    }
}
