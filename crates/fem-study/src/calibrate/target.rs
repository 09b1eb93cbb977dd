//! The material that is calibrated.

use fem_case::{Case, schema};
use fem_material::{ActsOn, PronySeries};

use super::fault::CalibrationFault;

/// The material that is calibrated.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Target {
    /// Its name in the case.
    pub material: String,
    /// Which of its moduli relax.
    pub acts_on: ActsOn,
    /// The bodies that are made of it.
    pub sides: [bool; 2],
}

impl Target {
    /// Returns the material of this name, or the only one. The moduli that relax are the given ones, those of the case,
    /// or all.
    ///
    /// # Errors
    /// No body is made of a material of this name, or there are two materials and none is named.
    pub fn of(
        case: &Case,
        name: Option<&str>,
        acts_on: Option<schema::ActsOn>,
    ) -> Result<Self, CalibrationFault> {
        let own =
            |side: usize| case.file().body.get(side).and_then(|body| body.material.as_deref());
        let own = [own(0), own(1)];
        let mut names: Vec<&str> = own.into_iter().flatten().collect();
        names.dedup();
        let materials = || names.iter().map(ToString::to_string).collect();
        let material = match (name, &names[..]) {
            (Some(name), _) if names.contains(&name) => name,
            (None, [only]) => only,
            (Some(name), _) => {
                let (name, materials) = (name.to_string(), materials());
                return Err(CalibrationFault::OtherMaterial { name, materials });
            }
            (None, _) => return Err(CalibrationFault::TwoMaterials { materials: materials() }),
        };
        let sides = own.map(|own| own == Some(material));
        let bodies = case.scene().bodies().iter().zip(sides).filter(|(_, is_it)| *is_it);
        let series = bodies.filter_map(|(body, _)| body.material()?.relaxation()).next();
        let acts_on =
            acts_on.map(ActsOn::from).or(series.map(PronySeries::acts_on)).unwrap_or(ActsOn::All);
        Ok(Self { material: material.to_string(), acts_on, sides })
    }
}

#[cfg(test)]
mod tests {
    use fem_case::CaseFile;
    use fem_case::schema::{BodyTable, MaterialTable};

    use super::*;

    fn case(lower: &str, upper: &str) -> Case {
        let material =
            || MaterialTable::from_youngs_modulus_poissons_ratio(2390.0, "63 GPa", 0.244);
        let ball = |name, of| BodyTable::sphere(name, "1 cm", of).approaching("1 m/s");
        let file = CaseFile::of_bodies(ball("lower", lower), ball("upper", upper));
        Case::of(file.with_material("glass", material()).with_material("ice", material())).unwrap()
    }

    #[test]
    fn the_only_material_needs_no_name() {
        let target = Target::of(&case("glass", "glass"), None, None).unwrap();
        assert_eq!((target.material.as_str(), target.sides), ("glass", [true, true]));
        assert_eq!(target.acts_on, ActsOn::All);
    }

    #[test]
    fn one_of_two_materials_is_named() {
        let case = case("glass", "ice");
        let target = Target::of(&case, Some("ice"), Some(schema::ActsOn::Shear)).unwrap();
        assert_eq!((target.sides, target.acts_on), ([false, true], ActsOn::Shear));
        let materials = vec!["glass".to_string(), "ice".to_string()];
        let refused = Target::of(&case, None, None);
        assert_eq!(refused, Err(CalibrationFault::TwoMaterials { materials: materials.clone() }));
        let refused = Target::of(&case, Some("steel"), None);
        let name = "steel".to_string();
        assert_eq!(refused, Err(CalibrationFault::OtherMaterial { name, materials }));
    }
}
