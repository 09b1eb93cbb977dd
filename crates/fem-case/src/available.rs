//! Which models and numerical effects this version has. The schema knows the names of more: a
//! case that asks for one of those is told so, rather than that the key is unknown.

use crate::document::Document;
use crate::error::CaseError;
use crate::key_path::join;
use crate::schema::{EffectsTable, Switch};

/// Names of models that `[model]` knows and this version has not: to build one, take its name out
/// and give it a variant in `model.rs`, its keys in `model_tables.rs` and `validate/models.rs`, and
/// an arm in `simulation.rs`.
pub(crate) const UNAVAILABLE_MODELS: &[&str] = &["auto"];

/// Names of effects that `[effects]` can turn on.
const EFFECTS: &[&str] = &[];

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
