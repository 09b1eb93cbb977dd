//! The two bodies: name, shape, material, approach.

use std::collections::BTreeMap;
use std::f64::consts::FRAC_PI_2;

use fem_material::Material;
use fem_material::engineering::show;

use super::Check;
use super::materials::CheckedMaterial;
use crate::error::CaseError;
use crate::library;
use crate::quantity::range::Range;
use crate::scene::body::{Body, Plate, Shape};
use crate::scene::defaults;
use crate::schema::{BodyTable, CaseFile, PlateTable, SphereTable};
use crate::source::explain::{listed, near};
use crate::source::toml_syntax::{is_bare, join, quote_key};

/// Returns the library's name of a body's material.
fn library_material(file: &CaseFile, body: &BodyTable) -> Option<&'static str> {
    let name = body.material.as_ref()?;
    library::name_of(name, file.material.get(name)?)
}

impl Check<'_> {
    /// Returns the two bodies.
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
                "write exactly two [[body]] tables, the lower one first; wall = {} is a rigid plane, \
                 half_space = {} a semi-infinite body, plate = { thickness = \"5 mm\" } a plate",
            ));
        };
        let (lower_shape, lower_speed) = self.body("body.0", lower, &materials)?;
        let (upper_shape, upper_speed) = self.body("body.1", upper, &materials)?;
        self.distinct(lower, upper)?;
        // A falling body may start at rest or move up.
        if file.gravity.is_none() {
            self.approach([lower_speed, upper_speed])?;
        }
        // Adding to 0 gives a body at rest the velocity 0, never -0.
        let lower = ("body.0", lower, lower_shape, 0.0 + lower_speed);
        let upper = ("body.1", upper, upper_shape, 0.0 - upper_speed);
        let body = |(path, table, shape, velocity): (&str, &BodyTable, _, f64)| {
            let own_mass = table.sphere.as_ref().and_then(|sphere| sphere.mass.as_ref());
            let material = table.material.as_ref().and_then(|name| materials.get(name.as_str()));
            Ok(Body {
                name: table.name.clone(),
                shape,
                own_mass: self.optional(&join(path, "sphere.mass"), own_mass, Range::POSITIVE)?,
                velocity,
                tangential_velocity: self.tangential_velocity(path, table, velocity.abs())?,
                spin: self.spin(path, table)?,
                held: table.held.unwrap_or_default(),
                yield_strength: material.and_then(|material| material.yield_strength),
                is_elastic: material.is_some_and(|material| material.is_elastic),
                surface_energy: material.and_then(|material| material.surface_energy),
                material_name: table.material.clone(),
                library_material: library_material(file, table),
                measured: material.and_then(|material| material.measured.clone()),
            })
        };
        Ok([body(lower)?, body(upper)?])
    }

    /// Returns the velocity across the axis, m/s, of a body with this speed along it, m/s.
    fn tangential_velocity(
        &self,
        path: &str,
        table: &BodyTable,
        speed: f64,
    ) -> Result<f64, CaseError> {
        let [at_speed, at_angle] = ["tangential_speed", "impact_angle"].map(|key| join(path, key));
        let given = self.optional(&at_speed, table.tangential_speed.as_ref(), Range::ANY)?;
        let Some(written) = table.impact_angle.as_ref() else {
            return Ok(given.unwrap_or_default());
        };
        let angle = self.number(&at_angle, written, Range::ANY)?;
        if angle.abs() >= FRAC_PI_2 {
            let message = format!("impact_angle is {written}");
            return Err(self.error(&at_angle, message).with_help(
                "impact_angle must be between -90 deg and 90 deg: write it with its unit, such as \"30 deg\"",
            ));
        }
        if given.is_some() {
            let message = "both tangential_speed and impact_angle are given";
            return Err(self
                .conflict(&at_angle, &[&at_speed], message)
                .with_help("keep one of them"));
        }
        if angle != 0.0 && speed == 0.0 {
            let message = format!("\"{}\" has an impact_angle and no approach_speed", table.name);
            return Err(self.error(&at_angle, message).with_help(
                "the angle is that of the velocity against the axis: give approach_speed, or tangential_speed in place of the angle",
            ));
        }
        Ok(speed * angle.tan())
    }

    /// Returns the spin of a sphere, rad/s.
    fn spin(&self, path: &str, table: &BodyTable) -> Result<f64, CaseError> {
        let at = join(path, "spin");
        let spin = self.optional(&at, table.spin.as_ref(), Range::ANY)?.unwrap_or_default();
        match flat(table) {
            Some(flat) if spin != 0.0 => {
                let message = format!("a {} does not spin", flat.replace('_', "-"));
                Err(self.error(&at, message).with_help("give its tangential_speed, or remove spin"))
            }
            _ => Ok(spin),
        }
    }

    /// Checks that two bodies have names of their own, and that one of them is a sphere.
    fn distinct(&self, lower: &BodyTable, upper: &BodyTable) -> Result<(), CaseError> {
        if lower.name == upper.name {
            let message = format!("both bodies have the name \"{}\"", upper.name);
            let error = self.conflict("body.1.name", &["body.0.name"], message);
            return Err(error.with_help("give each its own name"));
        }
        let (Some(below), Some(above)) = (flat(lower), flat(upper)) else { return Ok(()) };
        let noun = |key: &str| key.replace('_', "-");
        let message = match below == above {
            true => format!("both bodies are {}s", noun(below)),
            false => format!("one body is a {} and the other a {}", noun(below), noun(above)),
        };
        let keys = [join("body.0", below), join("body.1", above)];
        Err(self
            .conflict(&keys[1], &[&keys[0]], message)
            .with_help("one body must be a sphere: write sphere = { diameter = \"22.2 mm\" } here"))
    }

    /// Checks that bodies with these approach speeds, m/s, meet.
    fn approach(&self, [lower, upper]: [f64; 2]) -> Result<(), CaseError> {
        if lower + upper > 0.0 {
            return Ok(());
        }
        let keys = ["body.0.approach_speed", "body.1.approach_speed"];
        let is_first_at_fault = lower <= upper && self.document.has(keys[0]);
        let culprit = keys[usize::from(!is_first_at_fault)];
        let message = format!(
            "the bodies do not approach: their approach speeds, {} and {}, add up to {}",
            show(lower, "m/s"),
            show(upper, "m/s"),
            show(lower + upper, "m/s")
        );
        Err(self.conflict(culprit, &keys, message).with_help(
            "approach_speed is positive toward the other body; the sum must be greater than 0",
        ))
    }

    /// Returns the shape and the approach speed, m/s.
    fn body(
        &self,
        path: &str,
        table: &BodyTable,
        materials: &BTreeMap<&str, CheckedMaterial>,
    ) -> Result<(Shape, f64), CaseError> {
        let at = |key: &str| join(path, key);
        if table.name.is_empty() || !table.name.chars().all(is_bare) {
            return Err(self
                .error(&at("name"), format!("\"{}\" is not a valid body name", table.name))
                .with_help("a name is made of letters A-Z a-z, digits, _ and -"));
        }
        let shape = match self.shape_key(path, table)? {
            Key::Sphere(sphere) => {
                let at_sphere = at("sphere");
                let diameter =
                    self.number(&join(&at_sphere, "diameter"), &sphere.diameter, Range::POSITIVE)?;
                if sphere.mesh.as_ref().is_some_and(String::is_empty) {
                    let error = self.error(&join(&at_sphere, "mesh"), "mesh is an empty path");
                    return Err(error.with_help("name a mesh file, or remove the key"));
                }
                let mesh = sphere.mesh.as_ref().map(|mesh| self.folder.join(mesh));
                let material = self.material_of(path, table, materials)?;
                Shape::Sphere { diameter, mesh, material }
            }
            Key::HalfSpace => {
                Shape::HalfSpace { material: self.material_of(path, table, materials)? }
            }
            Key::Plate(plate) => {
                let plate = self.plate(&at("plate"), plate)?;
                Shape::Plate { plate, material: self.material_of(path, table, materials)? }
            }
            Key::Wall => {
                if table.material.is_some() {
                    let error =
                        self.conflict(&at("material"), &[&at("wall")], "a wall has no material");
                    let help = "a wall is rigid: remove the key, or write half_space = {} for a deformable body";
                    return Err(error.with_help(help));
                }
                Shape::Wall
            }
        };
        let allowed = if flat(table).is_some() { Range::NOT_NEGATIVE } else { Range::ANY };
        let speed = self.optional(&at("approach_speed"), table.approach_speed.as_ref(), allowed)?;
        Ok((shape, speed.unwrap_or(defaults::APPROACH_SPEED)))
    }

    fn plate(&self, path: &str, table: &PlateTable) -> Result<Plate, CaseError> {
        let at = |key: &str| join(path, key);
        Ok(Plate {
            thickness: self.number(&at("thickness"), &table.thickness, Range::POSITIVE)?,
            diameter: self.optional(&at("diameter"), table.diameter.as_ref(), Range::POSITIVE)?,
            support: table.support.unwrap_or(defaults::PLATE_SUPPORT),
        })
    }

    /// Returns the only shape of a body.
    fn shape_key<'t>(&self, path: &str, table: &'t BodyTable) -> Result<Key<'t>, CaseError> {
        let given: Vec<(&str, Key)> = [
            table.sphere.as_ref().map(|sphere| ("sphere", Key::Sphere(sphere))),
            table.wall.map(|_| ("wall", Key::Wall)),
            table.half_space.map(|_| ("half_space", Key::HalfSpace)),
            table.plate.as_ref().map(|plate| ("plate", Key::Plate(plate))),
        ]
        .into_iter()
        .flatten()
        .collect();
        let name = &table.name;
        match given.as_slice() {
            [(_, key)] => Ok(*key),
            [] => Err(self
                .error(path, format!("\"{name}\" is neither sphere, wall, half_space nor plate"))
                .lacking("sphere")
                .with_help(
                    "write sphere = { diameter = \"22.2 mm\" }, wall = {}, half_space = {} or \
                     plate = { thickness = \"5 mm\" }",
                )),
            [(first, _), .., (last, _)] => {
                let names: Vec<&str> = given.iter().map(|(name, _)| *name).collect();
                let keys = [join(path, last), join(path, "sphere.diameter"), join(path, first)];
                Err(self
                    .conflict(
                        &keys[0],
                        &[&keys[1], &keys[2]],
                        format!("\"{name}\" has more than one shape: {}", listed(&names)),
                    )
                    .with_help("keep one of them"))
            }
        }
    }

    fn material_of(
        &self,
        path: &str,
        table: &BodyTable,
        materials: &BTreeMap<&str, CheckedMaterial>,
    ) -> Result<Material, CaseError> {
        let is_own = |name: &&str| !library::is_of_library(name);
        let names: Vec<_> = materials.keys().copied().filter(is_own).collect();
        let known = match names.as_slice() {
            [] => "the case has no [material.NAME] table".to_string(),
            names => format!("the case has {}", listed(names)),
        };
        let Some(name) = &table.material else {
            return Err(self
                .error(path, format!("the key `material` is missing in {path}"))
                .lacking("material")
                .with_help(format!("name a material; {known}")));
        };
        let material = materials.get(name.as_str()).map(|checked| checked.material.clone());
        material.ok_or_else(|| {
            let error =
                self.error(&join(path, "material"), format!("there is no material \"{name}\""));
            if library::is_of_library(name) {
                let bare = name.trim_start_matches(library::PREFIX);
                let near = library::nearest_to(bare);
                let near =
                    near.map_or(String::new(), |near| format!("did you mean `lib:{near}`? "));
                let names = library::names();
                let help = format!("the library has {}", names.join(", "));
                return error.with_help(format!("{near}{help}"));
            }
            let near = match (near(name, &names), library::nearest_to(name)) {
                (own, Some(near)) if own.is_empty() => format!("did you mean `lib:{near}`? "),
                (own, _) => own,
            };
            error.with_help(format!("{near}{known}"))
        })
    }
}

/// The shape of a body as written.
#[derive(Clone, Copy)]
enum Key<'t> {
    Sphere(&'t SphereTable),
    Wall,
    HalfSpace,
    Plate(&'t PlateTable),
}

/// Returns the key of a wall, a half-space or a plate.
fn flat(table: &BodyTable) -> Option<&'static str> {
    let wall = table.wall.map(|_| "wall");
    let half_space = table.half_space.map(|_| "half_space");
    wall.or(half_space).or(table.plate.as_ref().map(|_| "plate"))
}
