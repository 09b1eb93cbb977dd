//! What would make a sweep cheaper.

use fem_case::CaseError;

use super::identity::Member;
use super::members::Members;

/// What would make condensed members cheaper: a mesh that the case leaves open goes by the contact
/// that is expected, another one for each speed.
///
/// # Errors
/// A member that is no valid case.
pub fn advice(
    members: &(impl Members + ?Sized),
    left: &[&Member],
) -> Result<Option<&'static str>, CaseError> {
    let is_condensed = |member: &&&Member| {
        member.case.model.as_ref().is_some_and(|model| model.condensed.is_some())
    };
    let condensed: Vec<&Member> = left.iter().filter(is_condensed).copied().collect();
    let Some(first) = condensed.first() else { return Ok(None) };
    let Some(other) = condensed.iter().find(|member| member.case.mesh != first.case.mesh) else {
        return Ok(None);
    };
    let mesh = members.case(other.index)?.scene().mesh();
    let is_open = mesh.contact_element_size.is_none() || mesh.refined_radius.is_none();
    Ok(is_open.then_some(
        "members have meshes of their own; give mesh.contact_element_size and \
         mesh.refined_radius, and those of equal bodies share one factor",
    ))
}
