//! Members that are made in code: a case, values, and a function that puts a value into the case.

use super::members::Members;
use super::runner::{Runner, most_expensive_first};
use fem_case::{Case, CaseError, CaseFile};
use fem_simulation::SharedModels;
use fem_simulation::results::Summary;

/// Variations of a case, one per value.
///
/// ```
/// use fem_case::schema::{BodyTable, MaterialTable};
/// use fem_study::sweep::{Members, Variations};
/// use fem_case::{Case, CaseFile};
///
/// let ice = MaterialTable::from_youngs_modulus_poissons_ratio("917 kg/m^3", "9.3 GPa", 0.33);
/// let ball = BodyTable::sphere("ball", "2 cm", "ice").approaching("1 m/s");
/// let case =
///     Case::of(CaseFile::of_bodies(BodyTable::wall("floor"), ball).with_material("ice", ice))?;
///
/// // All combinations of two keys; the last key varies fastest.
/// let values = [0.1, 1.0].into_iter().flat_map(|speed| [0.31, 0.33].map(|ratio| (speed, ratio)));
/// let members = Variations::of(&case, values, |file, (speed, ratio)| {
///     file.body[1].approach_speed = Some(speed.into());
///     let ice = file.material.get_mut("ice").unwrap();
///     ice.poissons_ratio = Some(ratio.into());
/// });
/// assert_eq!(members.n_members(), 4);
/// assert_eq!(members.case(1)?.scene().approach_speed(), 0.1);
/// # Ok::<(), fem_case::CaseError>(())
/// ```
#[derive(Clone, Debug)]
pub struct Variations<'c, V, F> {
    case: &'c Case,
    values: Vec<V>,
    edit: F,
}

impl<'c, V: Clone, F: Fn(&mut CaseFile, V)> Variations<'c, V, F> {
    /// Creates one member per value, in order; `edit` puts the value into the case.
    pub fn of(case: &'c Case, values: impl IntoIterator<Item = V>, edit: F) -> Self {
        Self { case, values: values.into_iter().collect(), edit }
    }

    /// Returns the value of each member.
    pub fn values(&self) -> &[V] {
        &self.values
    }
}

impl<V, F> Members for Variations<'_, V, F>
where
    V: Clone + Sync,
    F: Fn(&mut CaseFile, V) + Sync,
{
    fn n_members(&self) -> usize {
        self.values.len()
    }

    fn build<T>(
        &self,
        index: usize,
        make: impl Fn(Case) -> Result<T, CaseError>,
    ) -> Result<T, CaseError> {
        make(self.case.edited(|file| (self.edit)(file, self.values[index].clone()))?)
    }
}

/// Returns the summaries of a case for each value, in their order; `edit` puts a value into the case.
///
/// The members run on all threads of the current rayon pool, and equal bodies share their factors.
/// Fields are not computed. For histories, fields or an observer use a [`Runner`].
///
/// # Errors
/// Each value may make an invalid case, or one that its model does not support.
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
/// let summaries = fem_study::sweep::sweep(&case, speeds, |file, speed| {
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
    let shared = SharedModels::default();
    let runner = Runner::new(&members, &shared).without_fields();
    let kept = runner.run(&most_expensive_first(&members), &(), |ran| ran.summary());
    kept.into_iter().map(|(_, summary)| summary).collect()
}
