//! Materials. What makes one impossible is known to fem-material; here its errors get a place.

use fem_material::{ElasticModuli, Material, MaterialError, ModuliInput, PronySeries, PronyTerm};

use super::{ANY, Check, POSITIVE};
use crate::document::join;
use crate::error::CaseError;
use crate::schema::{ActsOn, MaterialTable, RelaxationTable};

impl Check<'_> {
    /// The material of the table at `path`.
    pub(super) fn material(
        &self,
        path: &str,
        table: &MaterialTable,
    ) -> Result<Material, CaseError> {
        let at = |key: &str| join(path, key);
        let density = self.number(&at("density"), &table.density, ANY)?;
        let (youngs_modulus, shear_modulus) = (&table.youngs_modulus, &table.shear_modulus);
        let (bulk_modulus, poissons_ratio) = (&table.bulk_modulus, &table.poissons_ratio);
        let input = ModuliInput {
            youngs_modulus: self.optional(&at("youngs_modulus"), youngs_modulus.as_ref(), ANY)?,
            shear_modulus: self.optional(&at("shear_modulus"), shear_modulus.as_ref(), ANY)?,
            bulk_modulus: self.optional(&at("bulk_modulus"), bulk_modulus.as_ref(), ANY)?,
            poissons_ratio: self.optional(&at("poissons_ratio"), poissons_ratio.as_ref(), ANY)?,
        };
        let elastic =
            ElasticModuli::from_two(input).map_err(|error| self.material_error(path, &error))?;
        let relaxation = match &table.relaxation {
            Some(relaxation) => Some(self.relaxation(path, relaxation)?),
            None => None,
        };
        Material::new(density, elastic, relaxation)
            .map_err(|error| self.material_error(path, &error))
    }

    fn relaxation(&self, path: &str, table: &RelaxationTable) -> Result<PronySeries, CaseError> {
        let mut terms = Vec::new();
        for (index, term) in table.terms.iter().enumerate() {
            let at_term = format!("{path}.relaxation.terms.{index}");
            let at = |key: &str| join(&at_term, key);
            let weight = self.number(&at("weight"), &term.weight, ANY)?;
            let relaxation_time = match (&term.decay_rate, &term.relaxation_time) {
                (Some(rate), None) => 1.0 / self.number(&at("decay_rate"), rate, POSITIVE)?,
                (None, Some(time)) => self.number(&at("relaxation_time"), time, POSITIVE)?,
                (given, _) => {
                    let (path, message) = match given {
                        Some(_) => (
                            at("relaxation_time"),
                            "both decay_rate and relaxation_time are given",
                        ),
                        None => (at_term, "neither decay_rate nor relaxation_time is given"),
                    };
                    return Err(self.error(&path, message).with_help(
                        "write one of decay_rate = \"2708 1/s\" and relaxation_time = \"369.3 us\"; \
                         each is the other's inverse",
                    ));
                }
            };
            terms.push(PronyTerm {
                weight,
                relaxation_time,
            });
        }
        let acts_on = match table.acts_on {
            ActsOn::All => fem_material::ActsOn::All,
            ActsOn::Shear => fem_material::ActsOn::Shear,
        };
        PronySeries::new(terms, acts_on).map_err(|error| self.material_error(path, &error))
    }

    /// Points at the key that a material error is about.
    fn material_error(&self, path: &str, error: &MaterialError) -> CaseError {
        let term = |index: usize| format!("relaxation.terms.{index}");
        let terms = "relaxation.terms".to_string();
        let (key, help) = match error {
            MaterialError::NotPositive { quantity, .. } => (quantity.to_string(), None),
            MaterialError::Negative { quantity, .. } => (quantity.to_string(), None),
            MaterialError::PoissonsRatio { .. } => (
                "poissons_ratio".to_string(),
                Some("every stable isotropic solid has -1 < poissons_ratio < 0.5"),
            ),
            MaterialError::ImpliedPoissonsRatio { other, .. } => (other.to_string(), None),
            MaterialError::ModuliCount { given } => (
                // The third, if there is one.
                given.get(2).map_or(String::new(), |key| key.to_string()),
                Some("any two fix an isotropic solid; the others follow from them"),
            ),
            MaterialError::NoRelaxationTerms => (terms, None),
            MaterialError::RelaxationWeight { index, .. } => (
                join(&term(*index), "weight"),
                Some("a weight is G_k/G_0, from 0 to 1"),
            ),
            MaterialError::RelaxationWeightSum { .. } => (
                terms,
                Some("a weight is G_k/G_0; what they leave of 1 never relaxes"),
            ),
            MaterialError::RelaxationTime { index, .. } => {
                let is_time =
                    |key: &&str| self.document.has(&join(path, &join(&term(*index), key)));
                let key = Some("relaxation_time")
                    .filter(is_time)
                    .unwrap_or("decay_rate");
                (join(&term(*index), key), None)
            }
        };
        let path = if key.is_empty() {
            path.to_string()
        } else {
            join(path, &key)
        };
        let error = self.error(&path, error.to_string());
        match help {
            Some(help) => error.with_help(help),
            None => error,
        }
    }
}
