//! The material that is calibrated.

use fem_case::{Case, schema};
use fem_material::{ActsOn, PronySeries};

use super::fault::CalibrationFault;

/// Share of the compliance of the contact that makes the other body's loss small.
const NEARLY_ALL: f64 = 0.9;

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
    /// Returns the material of this name, or the only one, or the one that is far softer than the other. The moduli that relax are the given ones, those of the case,
    /// or all.
    ///
    /// # Errors
    /// No body is made of a material of this name, or there are two materials of like stiffness and none is named.
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
            // Of two materials the one that yields nearly all of the approach is measured.
            (None, _) => {
                let shares = case.scene().compliance_shares();
                let side = shares.iter().position(|share| *share > NEARLY_ALL);
                let soft = side.and_then(|side| own[side]);
                soft.ok_or_else(|| CalibrationFault::TwoMaterials { materials: materials() })?
            }
        };
        let sides = own.map(|own| own == Some(material));
        let bodies = case.scene().bodies().iter().zip(sides).filter(|(_, is_it)| *is_it);
        let series = bodies.filter_map(|(body, _)| body.material()?.relaxation()).next();
        let acts_on =
            acts_on.map(ActsOn::from).or(series.map(PronySeries::acts_on)).unwrap_or(ActsOn::All);
        Ok(Self { material: material.to_string(), acts_on, sides })
    }
}
