//! Members that are made in code: a case, values, and what each of them changes.

use fem_case::{Case, CaseError, CaseFile};

use super::members::Members;

/// A case with one value after the other put in.
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
/// // Two keys, all with all; the last runs fastest.
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
    /// The members in which `edit` has put a value into the case, one a value, in their order.
    pub fn of(case: &'c Case, values: impl IntoIterator<Item = V>, edit: F) -> Self {
        Self { case, values: values.into_iter().collect(), edit }
    }

    /// The value of each member.
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
