//! Cases with another relaxation of a material.

use fem_case::Case;
use fem_case::schema::{RelaxationTable, TermTable};

use crate::error::StudyError;

/// Returns the case with this relaxation of a material.
pub(super) fn with_relaxation(
    case: &Case,
    material: &str,
    relaxation: RelaxationTable,
) -> Result<Case, StudyError> {
    let table = case.file().material.get(material).cloned();
    let missing = || StudyError::parameters(format!("the case has no material `{material}`"));
    let mut table = table.ok_or_else(missing)?;
    table.relaxation = Some(relaxation);
    Ok(case.edited(|file| drop(file.material.insert(material.to_string(), table)))?)
}

/// Returns the case with this as the only Prony term of a material that relaxes, acting on the same moduli.
pub(super) fn with_term(case: &Case, material: &str, term: TermTable) -> Result<Case, StudyError> {
    let own = case.file().material.get(material).and_then(|table| table.relaxation.as_ref());
    let missing = || StudyError::parameters(format!("the case has no `{material}` that relaxes"));
    let acts_on = own.ok_or_else(missing)?.acts_on.ok_or_else(missing)?;
    with_relaxation(case, material, RelaxationTable::new(acts_on, [term]))
}
