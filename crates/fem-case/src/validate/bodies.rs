//! The two bodies: name, shape, material, approach.

use std::collections::BTreeMap;

use fem_material::Material;

use super::{ANY, Check, NOT_NEGATIVE, POSITIVE};
use crate::error::CaseError;
use crate::explain::{listed, near};
use crate::key_path::{is_bare, join, quote_key};
use crate::scene::{Body, Shape};
use crate::schema::{BodyTable, CaseFile};

impl Check<'_> {
    pub(super) fn bodies(&self, file: &CaseFile) -> Result<[Body; 2], CaseError> {
        let mut materials = BTreeMap::new();
        for (name, table) in &file.material {
            let path = join("material", &quote_key(name));
            materials.insert(name.as_str(), self.material(&path, table)?);
        }
        let [lower, upper] = file.body.as_slice() else {
            let count = file.body.len();
            let path = if count > 2 { "body.2" } else { "body" };
            let message = match count {
                0 => "the case has no [[body]]".to_string(),
                1 => "the case has only one [[body]]".to_string(),
                _ => format!("the case has {count} [[body]] tables"),
            };
            return Err(self.error(path, message).with_help(
                "exactly two bodies collide, the first below the second; a rigid plane is a body \
                 with wall = {}",
            ));
        };
        let (lower_shape, lower_speed) = self.body("body.0", lower, &materials)?;
        let (upper_shape, upper_speed) = self.body("body.1", upper, &materials)?;
        if lower.name == upper.name {
            let message = format!("both bodies have the name \"{}\"", upper.name);
            return Err(self
                .conflict("body.1.name", &["body.0.name"], message)
                .with_help("give each its own name"));
        }
        if lower_shape == Shape::Wall && upper_shape == Shape::Wall {
            return Err(self
                .conflict("body.1.wall", &["body.0.wall"], "both bodies are walls")
                .with_help("at most one is; write sphere = { diameter = \"22.2 mm\" } here"));
        }
        if lower_speed + upper_speed <= 0.0 {
            let keys = ["body.0.approach_speed", "body.1.approach_speed"];
            let is_first_at_fault = lower_speed <= upper_speed && self.document.has(keys[0]);
            let culprit = keys[usize::from(!is_first_at_fault)];
            let message = format!(
                "both bodies receding or at rest: the approach speeds {lower_speed:?} and \
                 {upper_speed:?} m/s add up to {:?}",
                lower_speed + upper_speed
            );
            return Err(self.conflict(culprit, &keys, message).with_help(
                "approach_speed is toward the other body; the sum must be greater than 0",
            ));
        }
        // Sums with 0, so that a body at rest has the velocity 0, never -0.
        let (lower_velocity, upper_velocity) = (0.0 + lower_speed, 0.0 - upper_speed);
        Ok([
            Body {
                name: lower.name.clone(),
                shape: lower_shape,
                velocity: lower_velocity,
                yield_strength: self.yield_strength(file, lower)?,
            },
            Body {
                name: upper.name.clone(),
                shape: upper_shape,
                velocity: upper_velocity,
                yield_strength: self.yield_strength(file, upper)?,
            },
        ])
    }

    /// Yield strength of the material that a body names, Pa.
    fn yield_strength(&self, file: &CaseFile, body: &BodyTable) -> Result<Option<f64>, CaseError> {
        let Some(name) = &body.material else { return Ok(None) };
        let path = join(&join("material", &quote_key(name)), "yield_strength");
        let given = file.material.get(name).and_then(|table| table.yield_strength.as_ref());
        self.optional(&path, given, POSITIVE)
    }

    /// Shape and approach speed.
    fn body(
        &self,
        path: &str,
        table: &BodyTable,
        materials: &BTreeMap<&str, Material>,
    ) -> Result<(Shape, f64), CaseError> {
        let at = |key: &str| join(path, key);
        if table.name.is_empty() || !table.name.chars().all(is_bare) {
            return Err(self
                .error(&at("name"), format!("\"{}\" is not a body's name", table.name))
                .with_help("a name is made of letters A-Z a-z, digits, _ and -"));
        }
        let shape = match (&table.sphere, &table.wall) {
            (Some(sphere), None) => {
                let at_sphere = at("sphere");
                let diameter =
                    self.number(&join(&at_sphere, "diameter"), &sphere.diameter, POSITIVE)?;
                if sphere.mesh.as_ref().is_some_and(String::is_empty) {
                    let error = self.error(&join(&at_sphere, "mesh"), "mesh is an empty path");
                    return Err(error.with_help("name a mesh file, or leave the key out"));
                }
                let mesh = sphere.mesh.as_ref().map(|mesh| self.folder.join(mesh));
                let material = self.material_of(path, table, materials)?;
                Shape::Sphere { diameter, mesh, material }
            }
            (None, Some(_)) => {
                if table.material.is_some() {
                    let error =
                        self.conflict(&at("material"), &[&at("wall")], "a wall has no material");
                    return Err(error.with_help("it is rigid; leave the key out"));
                }
                Shape::Wall
            }
            (Some(_), Some(_)) => {
                return Err(self
                    .conflict(
                        &at("wall"),
                        &[&at("sphere.diameter"), &at("sphere")],
                        format!("\"{}\" is both sphere and wall", table.name),
                    )
                    .with_help("keep one of the two"));
            }
            (None, None) => {
                return Err(self
                    .error(path, format!("\"{}\" is neither sphere nor wall", table.name))
                    .with_help("write sphere = { diameter = \"22.2 mm\" } or wall = {}"));
            }
        };
        let allowed = if shape == Shape::Wall { NOT_NEGATIVE } else { ANY };
        let speed = self.optional(&at("approach_speed"), table.approach_speed.as_ref(), allowed)?;
        Ok((shape, speed.unwrap_or(0.0)))
    }

    fn material_of(
        &self,
        path: &str,
        table: &BodyTable,
        materials: &BTreeMap<&str, Material>,
    ) -> Result<Material, CaseError> {
        let names: Vec<_> = materials.keys().copied().collect();
        let known = match names.as_slice() {
            [] => "the case has no [material.NAME] table".to_string(),
            names => format!("the case has {}", listed(names)),
        };
        let Some(name) = &table.material else {
            return Err(self
                .error(path, format!("the key `material` is missing in {path}"))
                .with_help(format!("name a material; {known}")));
        };
        materials.get(name.as_str()).cloned().ok_or_else(|| {
            let error = self.error(&join(path, "material"), format!("no material \"{name}\""));
            error.with_help(format!("{}{known}", near(name, &names)))
        })
    }
}
