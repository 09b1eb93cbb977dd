//! `[material.NAME]`: fem-material decides whether a material is possible; here its errors are given a position.

use fem_material::{ElasticModuli, FlowRule, Material, MaterialError, ModuliInput, PronyTerm};

use super::Check;
use super::relaxation::series;
use crate::error::CaseError;
use crate::quantity::range::Range;
use crate::quantity::{Quantity, Stress};
use crate::scene::body::MeasuredBand;
use crate::schema::{MaterialTable, RelaxationTable};
use crate::source::toml_syntax::join;

/// The numbers of a material's table.
pub(super) struct CheckedMaterial {
    pub material: Material,
    /// Yield strength, Pa.
    pub yield_strength: Option<f64>,
    /// Whether the material is meant to be elastic.
    pub is_elastic: bool,
    /// Surface energy, J/m².
    pub surface_energy: Option<f64>,
    /// What is known of the data of the relaxation.
    pub measured: Option<MeasuredBand>,
}

impl Check<'_> {
    /// Returns the numbers of the table at `path`.
    pub(super) fn material(
        &self,
        path: &str,
        table: &MaterialTable,
    ) -> Result<CheckedMaterial, CaseError> {
        let at = |key: &str| join(path, key);
        let density = self.number(&at("density"), &table.density, Range::ANY)?;
        let modulus = |key: &str, quantity: &Option<Quantity<Stress>>| {
            self.optional(&at(key), quantity.as_ref(), Range::ANY)
        };
        let ratio = table.poissons_ratio.as_ref();
        let input = ModuliInput {
            youngs_modulus: modulus("youngs_modulus", &table.youngs_modulus)?,
            shear_modulus: modulus("shear_modulus", &table.shear_modulus)?,
            bulk_modulus: modulus("bulk_modulus", &table.bulk_modulus)?,
            poissons_ratio: self.optional(&at("poissons_ratio"), ratio, Range::ANY)?,
        };
        let n_terms = table.relaxation.as_ref().map_or(0, |relaxation| relaxation.terms.len());
        let place = |error| self.material_error(path, &error, n_terms);
        let elastic = ElasticModuli::from_two(input).map_err(place)?;
        let checked = table.relaxation.as_ref().map(|it| self.relaxation(path, it)).transpose()?;
        let relaxation = checked.as_ref().map(series).transpose().map_err(place)?;
        let material = Material::new(density, elastic, relaxation).map_err(place)?;
        let material = match table.hyperelastic {
            Some(law) => material.with_law(law.into()),
            None => material,
        };
        let (strength, energy) = (table.yield_strength.as_ref(), table.surface_energy.as_ref());
        let reported = self.optional(&at("yield_strength"), strength, Range::POSITIVE)?;
        let material = match (&table.flow, reported) {
            (Some(flow), _) => {
                let rule = self.flow(&at("flow"), flow, reported, place)?;
                material.with_flow(rule).map_err(place)?
            }
            // A material that relaxes or has another law than Hencky's does not flow.
            (None, Some(strength)) => {
                let rule = FlowRule::perfect(strength).map_err(place)?;
                material.clone().with_flow(rule).unwrap_or(material)
            }
            (None, None) => material,
        };
        let yield_strength = material.flow().map(FlowRule::yield_strength).or(reported);
        Ok(CheckedMaterial {
            material,
            yield_strength,
            is_elastic: table.elastic.unwrap_or_default(),
            surface_energy: self.optional(&at("surface_energy"), energy, Range::SURFACE_ENERGY)?,
            measured: checked.map(|relaxation| relaxation.measured),
        })
    }

    pub(super) fn relaxation_terms(
        &self,
        path: &str,
        table: &RelaxationTable,
    ) -> Result<Vec<PronyTerm>, CaseError> {
        let mut terms = Vec::new();
        for (index, term) in table.terms.iter().enumerate() {
            let at_term = format!("{path}.relaxation.terms.{index}");
            let at = |key: &str| join(&at_term, key);
            let weight = self.number(&at("weight"), &term.weight, Range::ANY)?;
            let relaxation_time = match (&term.decay_rate, &term.relaxation_time) {
                (Some(rate), None) => {
                    1.0 / self.number(&at("decay_rate"), rate, Range::POSITIVE)?
                }
                (None, Some(time)) => self.number(&at("relaxation_time"), time, Range::POSITIVE)?,
                (Some(_), Some(_)) => {
                    let message = "both decay_rate and relaxation_time are given";
                    let (rate, time) = (at("decay_rate"), at("relaxation_time"));
                    let error = self.conflict(&time, &[&rate], message);
                    return Err(
                        error.with_help("keep one of the two: each is the inverse of the other")
                    );
                }
                (None, None) => {
                    let message = "neither decay_rate nor relaxation_time is given";
                    let example = "decay_rate = \"2708 1/s\" or relaxation_time = \"369.3 us\"";
                    let error = self.error(&at_term, message);
                    return Err(error.with_help(format!("write {example}")));
                }
            };
            terms.push(PronyTerm { weight, relaxation_time });
        }
        Ok(terms)
    }

    /// Creates an error that points at the key of a material error. If it is about several keys, the first one listed
    /// here is blamed unless an override gave another.
    fn material_error(&self, path: &str, error: &MaterialError, n_terms: usize) -> CaseError {
        let at = |key: &str| join(path, key);
        let at_term = |index: usize, key: &str| at(&format!("relaxation.terms.{index}.{key}"));
        let (keys, help) = match error {
            MaterialError::NotPositive { quantity, .. }
            | MaterialError::Negative { quantity, .. } => (vec![at(quantity)], None),
            MaterialError::PoissonsRatio { .. } => (
                vec![at("poissons_ratio")],
                Some("every stable isotropic solid has -1 < poissons_ratio < 0.5"),
            ),
            MaterialError::ImpliedPoissonsRatio { other, .. } => {
                (vec![at(other), at("youngs_modulus")], None)
            }
            MaterialError::ModuliCount { given } => {
                let third = given.get(2).map_or(path.to_string(), |key| at(key));
                let given = given.iter().map(|key| at(key));
                let help =
                    "give exactly two: the other moduli of an isotropic solid follow from them";
                ([third].into_iter().chain(given).collect(), Some(help))
            }
            MaterialError::NoRelaxationTerms => (vec![at("relaxation.terms")], None),
            MaterialError::RelaxationWeight { index, .. } => {
                (vec![at_term(*index, "weight")], Some("a weight is G_k/G_0, from 0 to 1"))
            }
            MaterialError::RelaxationWeightSum { .. } => {
                let weights = (0..n_terms).map(|index| at_term(index, "weight"));
                let help = "a weight is G_k/G_0; the rest to 1 is the share that never relaxes";
                ([at("relaxation.terms")].into_iter().chain(weights).collect(), Some(help))
            }
            MaterialError::RelaxationTime { index, .. } => {
                let is_given = |key: &String| self.document.has(key);
                let keys = ["relaxation_time", "decay_rate"].map(|key| at_term(*index, key));
                (keys.into_iter().filter(is_given).collect(), None)
            }
            MaterialError::FlowWithRelaxation => (
                vec![at("flow"), at("relaxation")],
                Some("a material flows or relaxes: remove one of the two tables"),
            ),
            MaterialError::FlowWithLaw { .. } => (
                vec![at("hyperelastic"), at("flow")],
                Some("leave hyperelastic out, or remove the table flow"),
            ),
            MaterialError::FlowStress { .. } => (
                vec![at("flow.hardening")],
                Some(
                    "softening is not computed: end the table at the largest stress, which holds beyond it",
                ),
            ),
            MaterialError::HardeningExponent { .. }
            | MaterialError::FlowRows { .. }
            | MaterialError::FlowStrain { .. } => (vec![at("flow.hardening")], None),
        };
        let keys: Vec<_> = keys.iter().map(String::as_str).collect();
        let default = keys.first().copied().unwrap_or(path);
        let error = self.conflict(default, &keys, error.to_string());
        match help {
            Some(help) => error.with_help(help),
            None => error,
        }
    }
}
