//! Masses of a body some of whose surface nodes carry none.
//!
//! An element moves the mass of a massless corner to the neighbouring corners, or to the opposite corner if those are
//! massless too. The sum stays. The move shifts the mass centre inward by some millionths of the radius; the factor
//!
//! ```math
//! 1 + \beta (y_i - \bar y)
//! ```
//!
//! on all masses brings it back, with the centre ȳ after the move.

use fem_element::QuadGeometry;
use fem_mesh::SphereMesh;

use crate::error::ModelError;

/// The massless nodes of a mesh.
#[derive(Debug)]
pub(crate) struct BoundaryMass {
    /// Empty if all nodes have mass.
    is_massless: Vec<bool>,
}

impl BoundaryMass {
    /// Takes the massless nodes of a mesh.
    ///
    /// # Errors
    /// No corner of an element has mass.
    pub fn new(mesh: &SphereMesh, massless: &[u32]) -> Result<Self, ModelError> {
        if massless.is_empty() {
            return Ok(Self { is_massless: Vec::new() });
        }
        let mut is_massless = vec![false; mesh.nodes().len()];
        massless.iter().for_each(|&node| is_massless[node as usize] = true);
        let bare = |quad: &[u32; 4]| quad.iter().all(|&node| is_massless[node as usize]);
        match mesh.quads().iter().position(bare) {
            Some(element) => Err(ModelError::NoInterior { element }),
            None => Ok(Self { is_massless }),
        }
    }

    /// Returns the massless nodes.
    pub fn nodes(&self) -> impl Iterator<Item = usize> {
        (0..self.is_massless.len()).filter(|&node| self.is_massless[node])
    }

    /// Returns the corners of a quad that receive the mass of a corner: itself if it keeps its mass.
    fn heirs(&self, quad: &[u32; 4], corner: usize) -> impl Iterator<Item = usize> {
        let has_mass =
            |corner: usize| !self.is_massless.get(quad[corner] as usize).is_some_and(|bare| *bare);
        let sides = [(corner + 3) % 4, (corner + 1) % 4].map(|side| has_mass(side).then_some(side));
        let [first, second] = match (has_mass(corner), sides) {
            (true, _) => [Some(corner), None],
            (false, [None, None]) => [Some((corner + 2) % 4), None],
            (false, sides) => sides,
        };
        first.into_iter().chain(second)
    }

    /// Returns the masses of the corners of an element (kg) after the move.
    pub fn of_corners(&self, quad: &[u32; 4], masses: [f64; 4]) -> [f64; 4] {
        if self.is_massless.is_empty() {
            return masses;
        }
        let mut moved = [0.0; 4];
        for (corner, mass) in masses.into_iter().enumerate() {
            let n_heirs = self.heirs(quad, corner).count() as f64;
            self.heirs(quad, corner).for_each(|heir| moved[heir] += mass / n_heirs);
        }
        moved
    }

    /// Returns the masses of the nodes (kg) after the move. Mass of a node beyond its shares of elements moves in
    /// proportion to those.
    pub fn of_nodes(
        &self,
        mesh: &SphereMesh,
        geometries: &[QuadGeometry],
        masses: Vec<f64>,
    ) -> Vec<f64> {
        if self.is_massless.is_empty() {
            return masses;
        }
        let elements = || mesh.quads().iter().zip(geometries);
        let mut volumes = vec![0.0; masses.len()];
        for (quad, geometry) in elements() {
            for (&node, volume) in quad.iter().zip(geometry.nodal_volumes) {
                volumes[node as usize] += volume;
            }
        }
        let mut moved = masses.clone();
        for (quad, geometry) in elements() {
            for (corner, volume) in geometry.nodal_volumes.into_iter().enumerate() {
                let node = quad[corner] as usize;
                let share = masses[node] * volume / volumes[node];
                let n_heirs = self.heirs(quad, corner).count() as f64;
                for heir in self.heirs(quad, corner).filter(|_| self.is_massless[node]) {
                    moved[quad[heir] as usize] += share / n_heirs;
                }
            }
        }
        self.nodes().for_each(|node| moved[node] = 0.0);
        // The far boundary of a half-space does not move, wherever the centre is.
        if !mesh.is_half_space() {
            restore_centre(mesh, &masses, &mut moved);
        }
        moved
    }
}

/// Brings the mass centre (along y) of masses back to where that of others of the same sum was.
fn restore_centre(mesh: &SphereMesh, before: &[f64], masses: &mut [f64]) {
    let heights = || mesh.nodes().iter().map(|node| node[1]);
    let moment = |masses: &[f64]| masses.iter().zip(heights()).map(|(m, y)| m * y).sum::<f64>();
    let centre = moment(masses) / masses.iter().sum::<f64>();
    let spread: f64 = masses.iter().zip(heights()).map(|(m, y)| m * (y - centre).powi(2)).sum();
    let factor = (moment(before) - moment(masses)) / spread;
    masses.iter_mut().zip(heights()).for_each(|(mass, y)| *mass *= 1.0 + factor * (y - centre));
}

#[cfg(test)]
mod tests {
    use fem_mesh::{Side, lump_mass};

    use super::*;
    use crate::test_support::{geometries, sphere};

    /// Mass and mass centre stay, to rounding; the nodes have none, and no other loses any that the
    /// factor does not take: at a surface, and of an element that keeps one corner.
    #[test]
    fn massless_boundary_keeps_mass_and_mass_centre() {
        let mesh = sphere(0.05, 0.2, Side::Above);
        let geometries = geometries(&mesh);
        let volumes: Vec<_> = geometries.iter().map(|geometry| geometry.nodal_volumes).collect();
        let before = lump_mass(&mesh, 3.0, &volumes);
        for massless in [&mesh.surface()[..5], &mesh.quads()[3][..3]] {
            let masses = BoundaryMass::new(&mesh, massless).unwrap();
            let after = masses.of_nodes(&mesh, &geometries, before.clone());
            let moment = |masses: &[f64], power: i32| -> f64 {
                masses.iter().zip(mesh.nodes()).map(|(m, node)| m * node[1].powi(power)).sum()
            };
            for power in [0, 1] {
                assert!((moment(&after, power) / moment(&before, power) - 1.0).abs() < 1e-14);
            }
            for (node, (after, before)) in after.iter().zip(&before).enumerate() {
                let is_massless = massless.contains(&(node as u32));
                // The move is of a thousandth of the mass by a twentieth of the radius, of a spread of a
                // fifth.
                assert!(if is_massless { *after == 0.0 } else { *after > before * (1.0 - 1e-3) });
            }
            // An element that has lost corners has all of its mass, on those that it has left.
            for (quad, geometry) in mesh.quads().iter().zip(&geometries) {
                let moved = masses.of_corners(quad, geometry.nodal_volumes);
                let sum: f64 = moved.iter().sum();
                assert!((sum / geometry.nodal_volumes.iter().sum::<f64>() - 1.0).abs() < 1e-14);
                for (node, moved) in quad.iter().zip(moved) {
                    assert!(moved == 0.0 || !massless.contains(node));
                }
            }
        }
    }

    #[test]
    fn an_element_without_mass_is_refused() {
        let mesh = sphere(0.25, 0.5, Side::Above);
        let refused = BoundaryMass::new(&mesh, &mesh.quads()[3]).unwrap_err();
        assert_eq!(refused, ModelError::NoInterior { element: 3 });
    }
}
