//! `[[body]]` as written.

use crate::quantity::{Angle, Length, Mass, Quantity, Rate, Speed};
use crate::schema::macros::keywords;
use serde::{Deserialize, Serialize};

/// `[[body]]`: a name, exactly one shape, and for all but a wall a material.
#[derive(Clone, Debug, PartialEq, Deserialize, Serialize)]
#[cfg_attr(all(test, feature = "schema"), derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields, expecting = "a table [[body]]")]
pub struct BodyTable {
    /// A unique name of letters, digits, `_` and `-`.
    pub name: String,
    /// The name of a `[material.NAME]`.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub material: Option<String>,
    /// Speed toward the other body; 0 if absent, negative if the body recedes.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub approach_speed: Option<Quantity<Speed>>,
    /// Velocity across the axis, along the same x for both bodies; 0 if absent.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub tangential_speed: Option<Quantity<Speed>>,
    /// Angle of the velocity against the axis in place of `tangential_speed`, which is then the approach speed times its tangent.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub impact_angle: Option<Quantity<Angle>>,
    /// Angular velocity of a sphere, right-handed about x × y, where y is from the first body to the second; 0 if absent.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub spin: Option<Quantity<Rate>>,
    /// Whether the mass centre of a sphere is fixed.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub held: Option<bool>,
    /// A solid sphere.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub sphere: Option<SphereTable>,
    /// A rigid plane of infinite mass.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub wall: Option<EmptyTable>,
    /// The table of a deformable half-space.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub half_space: Option<EmptyTable>,
    /// A deformable plate.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub plate: Option<PlateTable>,
}

impl BodyTable {
    /// Creates a solid sphere at rest, made of `[material.NAME]`.
    pub fn sphere(
        name: impl Into<String>,
        diameter: impl Into<Quantity<Length>>,
        material: impl Into<String>,
    ) -> Self {
        let sphere = Some(SphereTable::new(diameter));
        Self { sphere, ..Self::without_shape(name.into(), Some(material.into())) }
    }

    /// Creates a rigid plane at rest.
    pub fn wall(name: impl Into<String>) -> Self {
        Self { wall: Some(EmptyTable {}), ..Self::without_shape(name.into(), None) }
    }

    /// Creates a half-space at rest, made of `[material.NAME]`.
    pub fn half_space(name: impl Into<String>, material: impl Into<String>) -> Self {
        let half_space = Some(EmptyTable {});
        Self { half_space, ..Self::without_shape(name.into(), Some(material.into())) }
    }

    /// Creates an unbounded plate at rest, free below, made of `[material.NAME]`.
    pub fn plate(
        name: impl Into<String>,
        thickness: impl Into<Quantity<Length>>,
        material: impl Into<String>,
    ) -> Self {
        let plate = Some(PlateTable::new(thickness));
        Self { plate, ..Self::without_shape(name.into(), Some(material.into())) }
    }

    fn without_shape(name: String, material: Option<String>) -> Self {
        Self {
            name,
            material,
            approach_speed: None,
            tangential_speed: None,
            impact_angle: None,
            spin: None,
            held: None,
            sphere: None,
            wall: None,
            half_space: None,
            plate: None,
        }
    }

    /// Returns this body, moving toward the other one.
    pub fn approaching(self, speed: impl Into<Quantity<Speed>>) -> Self {
        Self { approach_speed: Some(speed.into()), ..self }
    }

    /// Replaces a plate by a half-space of its material.
    pub fn make_plate_half_space(&mut self) {
        if self.plate.take().is_some() {
            self.half_space = Some(EmptyTable {});
        }
    }

    /// Returns this sphere with a fixed mass centre.
    pub fn held(self) -> Self {
        Self { held: Some(true), ..self }
    }
}

/// `sphere = { … }`.
#[derive(Clone, Debug, PartialEq, Deserialize, Serialize)]
#[cfg_attr(all(test, feature = "schema"), derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields, expecting = "a table such as { diameter = \"22.2 mm\" }")]
pub struct SphereTable {
    /// Diameter, > 0.
    pub diameter: Quantity<Length>,
    /// Mass, > 0, of a striker that is heavier than its tip; that of the material's density if absent. Models without elements have
    /// it.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub mass: Option<Quantity<Mass>>,
    /// A mesh file instead of the built-in mesh; relative to the case file.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub mesh: Option<String>,
}

impl SphereTable {
    /// Creates a sphere with the built-in mesh.
    pub fn new(diameter: impl Into<Quantity<Length>>) -> Self {
        Self { diameter: diameter.into(), mass: None, mesh: None }
    }
}

/// `plate = { … }`.
#[derive(Clone, Debug, PartialEq, Deserialize, Serialize)]
#[cfg_attr(all(test, feature = "schema"), derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields, expecting = "a table such as { thickness = \"5 mm\" }")]
pub struct PlateTable {
    /// Thickness, > 0.
    pub thickness: Quantity<Length>,
    /// Diameter, > 0; an absent one is unbounded.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub diameter: Option<Quantity<Length>>,
    /// Support of the face away from the contact; free if absent.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub support: Option<PlateSupport>,
}

impl PlateTable {
    /// Creates an unbounded plate that is free below.
    pub fn new(thickness: impl Into<Quantity<Length>>) -> Self {
        Self { thickness: thickness.into(), diameter: None, support: None }
    }
}

keywords! {
    /// Support of the face of a plate away from the contact.
    PlateSupport {
        /// Nothing: the face is free of stress.
        Free = "free",
        /// A rigid base, to which the face is bonded.
        Bonded = "bonded",
    }
}

/// A table without keys, whose presence selects something.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Deserialize, Serialize)]
#[cfg_attr(all(test, feature = "schema"), derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields, expecting = "an empty table, {}")]
pub struct EmptyTable {}
