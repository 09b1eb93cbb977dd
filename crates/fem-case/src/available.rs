//! Which models and numerical effects this version has. The schema knows the names of more: a
//! case that asks for one of those is told so, rather than that the key is unknown.

use crate::document::{Document, join};
use crate::error::CaseError;
use crate::explain::listed;
use crate::schema::{EffectsTable, ModelTable, Switch};

/// How the collision is computed.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[non_exhaustive]
pub enum Model {
    /// Explicit finite elements.
    #[default]
    Fem,
}

/// Names of effects that `[effects]` can turn on.
const EFFECTS: &[&str] = &[];

/// The model that `[model]` chooses; absent, explicit finite elements.
pub(crate) fn model(document: &Document, table: Option<&ModelTable>) -> Result<Model, CaseError> {
    let Some(ModelTable { fem, condensed, ting, hertz, law, auto }) = table else {
        return Ok(Model::default());
    };
    let given = [
        ("fem", fem.is_some()),
        ("condensed", condensed.is_some()),
        ("ting", ting.is_some()),
        ("hertz", hertz.is_some()),
        ("law", law.is_some()),
        ("auto", auto.is_some()),
    ];
    let given: Vec<_> = given.iter().filter(|(_, is_given)| *is_given).map(|(n, _)| *n).collect();
    match given.as_slice() {
        ["fem"] => Ok(Model::Fem),
        [other] => Err(document
            .error_at(
                &join("model", other),
                format!("model `{other}` is not available in this version"),
            )
            .with_help("the model here is fem = {}")),
        [] => Err(document
            .error_at("model", "model names no model")
            .with_help("write fem = {}, or leave [model] out")),
        [.., last] => {
            let paths: Vec<_> = given.iter().map(|name| join("model", name)).collect();
            let paths: Vec<_> = paths.iter().map(String::as_str).collect();
            let culprit = join("model", last);
            let message = format!("model has the keys {}", listed(&given));
            Err(document
                .error_at(document.blamed(&culprit, &paths), message)
                .with_help("exactly one model computes the collision"))
        }
    }
}

/// Refuses effects that are forced on and do not exist.
pub(crate) fn effects(
    document: &Document,
    table: Option<&EffectsTable>,
) -> Result<EffectsTable, CaseError> {
    let effects = table.copied().unwrap_or_default();
    let EffectsTable { finite_strain, mirror_symmetry, bulk_viscosity } = effects;
    let switches = [
        ("finite_strain", finite_strain),
        ("mirror_symmetry", mirror_symmetry),
        ("bulk_viscosity", bulk_viscosity),
    ];
    for (name, switch) in switches {
        if switch == Some(Switch::On) && !EFFECTS.contains(&name) {
            let message = format!("effect `{name}` is not available in this version");
            let error = document.error_at(&join("effects", name), message);
            return Err(error.with_help("write \"auto\" or \"off\", or leave it out"));
        }
    }
    Ok(effects)
}
