//! Cases whose material relaxes otherwise than the file says.

use fem_case::Case;
use fem_case::schema::{RelaxationTable, TermTable};

use crate::error::StudyError;

/// The case with this relaxation in place of the material's own.
///
/// # Errors
/// No such material; a relaxation that cannot be.
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

/// The case with this as the only Prony term of a material that relaxes, on the same moduli.
///
/// # Errors
/// No such material, or an elastic one; a term that cannot be.
pub(super) fn with_term(case: &Case, material: &str, term: TermTable) -> Result<Case, StudyError> {
    let own = case.file().material.get(material).and_then(|table| table.relaxation.as_ref());
    let missing = || StudyError::parameters(format!("the case has no `{material}` that relaxes"));
    let acts_on = own.ok_or_else(missing)?.acts_on;
    with_relaxation(case, material, RelaxationTable { acts_on, terms: vec![term] })
}
