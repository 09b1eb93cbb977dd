//! One snapshot of a quadrilateral mesh with its data: what goes into a `.vtu`, and its checks.

use std::collections::BTreeSet;

use crate::encoding::Encoding;
use crate::error::Error;
use crate::grid::VtuGrid;
use crate::section::Section;
use crate::values::Values;

/// An array to write.
pub(crate) struct NamedArray<'a> {
    pub(crate) section: Section,
    pub(crate) name: &'a str,
    pub(crate) components: usize,
    pub(crate) values: Values<'a>,
}

/// Content of a file and the encoding of its bytes.
pub(crate) struct Contents<'a> {
    pub(crate) grid: VtuGrid<'a>,
    /// The snapshot's time, s.
    pub(crate) time: Option<f64>,
    pub(crate) encoding: Encoding,
    pub(crate) arrays: Vec<NamedArray<'a>>,
}

impl<'a> Contents<'a> {
    /// The arrays of a section, in the order in which they were added.
    pub(crate) fn of_section(&self, section: Section) -> impl Iterator<Item = &NamedArray<'a>> {
        self.arrays.iter().filter(move |array| array.section == section)
    }

    /// Checks that a file can be made of it.
    ///
    /// # Errors
    /// Those of [`crate::VtuWriter::write`] but for the file system.
    pub(crate) fn check(&self) -> Result<(), Error> {
        if self.grid.points.is_empty() || self.grid.quads.is_empty() {
            return Err(Error::Empty { what: "mesh".to_owned() });
        }
        check_finite(
            Section::Points,
            "Points",
            3,
            &Values::Float64(self.grid.points.as_flattened()),
        )?;
        self.check_connectivity()?;
        let mut names = BTreeSet::new();
        if let Some(time) = self.time {
            check_finite(Section::FieldData, "TimeValue", 1, &Values::Float64(&[time]))?;
            names.insert((Section::FieldData, "TimeValue"));
        }
        for array in &self.arrays {
            self.check_array(array)?;
            if !names.insert((array.section, array.name)) {
                return Err(Error::DuplicateName {
                    section: array.section.name(),
                    name: array.name.to_owned(),
                });
            }
        }
        Ok(())
    }

    fn check_connectivity(&self) -> Result<(), Error> {
        let n_points = self.grid.points.len();
        for (cell, corners) in self.grid.quads.iter().enumerate() {
            if let Some(corner) = corners.iter().position(|&point| point as usize >= n_points) {
                return Err(Error::Connectivity { cell, corner, point: corners[corner], n_points });
            }
        }
        Ok(())
    }

    fn check_array(&self, array: &NamedArray) -> Result<(), Error> {
        let &NamedArray { section, name, components, ref values } = array;
        if name.is_empty() || name.contains(char::is_control) {
            return Err(Error::Name { section: section.name(), name: name.to_owned() });
        }
        if components == 0 || (components == 2 && section != Section::FieldData) {
            return Err(Error::Components {
                section: section.name(),
                name: name.to_owned(),
                components,
            });
        }
        if values.len() == 0 {
            return Err(Error::Empty { what: format!("{} array {name:?}", section.name()) });
        }
        let (sound, expected) = match section {
            Section::FieldData => {
                (values.len().is_multiple_of(components), format!("a multiple of {components}"))
            }
            _ => self.expected_length(section, components, values.len()),
        };
        if !sound {
            return Err(Error::Length {
                section: section.name(),
                name: name.to_owned(),
                found: values.len(),
                expected,
            });
        }
        check_finite(section, name, components, values)
    }

    fn expected_length(&self, section: Section, components: usize, found: usize) -> (bool, String) {
        let (entities, count) = match section {
            Section::PointData => ("points", self.grid.points.len()),
            _ => ("cells", self.grid.quads.len()),
        };
        let expected = format!("{count} {entities} x {components} components");
        (count.checked_mul(components) == Some(found), expected)
    }
}

fn check_finite(
    section: Section,
    name: &str,
    components: usize,
    values: &Values,
) -> Result<(), Error> {
    match values.first_not_finite() {
        None => Ok(()),
        Some((position, value)) => Err(Error::NotFinite {
            section: section.name(),
            name: name.to_owned(),
            index: position / components,
            component: position % components,
            value,
        }),
    }
}
