//! The shortest way to a sweep: a case, values, and what each of them changes.

use fem_case::{Case, CaseError, CaseFile};

use super::order::dearest_first;
use super::runner::Runner;
use super::variations::Variations;
use fem_simulation::Shared;
use fem_simulation::results::Summary;

/// Returns the summaries of a case with one value after the other put in, in the order of the values.
///
/// The members run on all threads of the current rayon pool, and equal bodies share their factors.
/// Fields are not computed. Who wants histories or fields, or to look on and end all of it, uses a
/// [`Runner`].
///
/// # Errors
/// Each value on its own may make no valid case, or one that its model does not support.
///
/// ```
/// use fem_case::schema::{ActsOn, BodyTable, MaterialTable, ModelTable, TermTable};
/// use fem_case::{Case, CaseFile};
///
/// let rubber = MaterialTable::from_youngs_modulus_poissons_ratio("1100 kg/m^3", "10 MPa", 0.45)
///     .relaxing(ActsOn::Shear, [TermTable::with_relaxation_time(0.5, "1 ms")]);
/// let ball = BodyTable::sphere("ball", "2 cm", "rubber").approaching("1 m/s");
/// let case = Case::of(
///     CaseFile::of_bodies(ball, BodyTable::wall("floor"))
///         .with_material("rubber", rubber)
///         .with_model(ModelTable::ting()),
/// )?;
///
/// let speeds = [0.25, 0.5, 1.0];
/// let summaries = fem_study::sweep(&case, speeds, |file, speed| {
///     file.body[0].approach_speed = Some(speed.into());
/// });
/// let mut restitutions = Vec::new();
/// for summary in summaries {
///     restitutions.extend(summary?.collision.restitution);
/// }
/// // The faster, the shorter the contact, and the less of the stress relaxes in it.
/// assert!(restitutions.len() == 3 && restitutions.is_sorted());
/// # Ok::<(), fem_case::CaseError>(())
/// ```
pub fn sweep<V: Clone + Sync>(
    case: &Case,
    values: impl IntoIterator<Item = V>,
    edit: impl Fn(&mut CaseFile, V) + Sync,
) -> Vec<Result<Summary, CaseError>> {
    let members = Variations::of(case, values, edit);
    let shared = Shared::default();
    let runner = Runner::new(&members, &shared).without_fields();
    let kept = runner.run(&dearest_first(&members), &(), |ran| ran.summary());
    kept.into_iter().map(|(_, summary)| summary).collect()
}
