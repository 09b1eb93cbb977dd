//! Finite strain near first touch, small strain elsewhere.
//!
//! Strains under a contact of radius a fall as (a/r)² with the distance r from its centre, and the correction of the
//! energy by finite strain is of third order in them. The share of the correction beyond a radius R,
//!
//! ```math
//! \int_R^\infty \left(\frac ar\right)^6 r^2\, dr \sim \left(\frac aR\right)^3 ,
//! ```
//!
//! is chosen by R; an element at small strain costs a third of one at finite strain. Elements of both kinds store
//! energies of their own and meet at nodes, so energy and momentum are conserved as with one kind alone.

use std::fmt;

use fem_collision::SmallStrain;
use fem_element::QuadGeometry;
use fem_material::Material;
use fem_material::finite::HyperelasticLaw;
use fem_mesh::SphereMesh;

use super::finite::finite_strain;
use super::small_strain;
use super::traits::{
    Collapse, FiniteStrainStress, LumpedElement, SmallStrainStress, StrainMeasure, Stress,
    UnstableElement,
};
use crate::part::{Accounts, Field, Motion, NodalField, Part};

/// The stress of a body of which some elements are at finite strain. Its history is that of the near elements, of
/// elements and of nodes, followed by that of the far ones.
struct PartlyFinite {
    near: Box<dyn FiniteStrainStress>,
    /// Numbers of the near elements, ascending.
    near_elements: Vec<usize>,
    far: Box<dyn SmallStrainStress>,
    far_elements: Vec<FarElement>,
    material: Material,
}

struct FarElement {
    number: usize,
    quad: [u32; 4],
    geometry: QuadGeometry,
}

/// Makes the stress of a material that follows a law at finite strain in elements whose centres are within a radius (m)
/// of first touch, and is at small strain in the others. Elements at small strain do not flow: a body that flows and has
/// no element within the radius is at finite strain everywhere.
pub(super) fn finite_strain_within(
    radius: f64,
    mesh: &SphereMesh,
    geometries: &[QuadGeometry],
    material: &Material,
    law: HyperelasticLaw,
) -> Box<dyn Stress> {
    let is_near = |element: &usize| {
        let corners = mesh.corners(*element);
        let [r, y] = [0, 1].map(|axis: usize| corners.iter().map(|x| x[axis]).sum::<f64>() / 4.0);
        r.hypot(y) <= radius
    };
    let (mut near_elements, mut others): (Vec<_>, Vec<_>) =
        (0..geometries.len()).partition(is_near);
    if near_elements.is_empty() {
        if material.flow().is_none() {
            return small_strain(mesh.nodes().len(), mesh.quads(), geometries, material);
        }
        std::mem::swap(&mut near_elements, &mut others);
    }
    let near = finite_strain(mesh, geometries, &near_elements, material, law);
    if others.is_empty() {
        return near;
    }
    let of = |&number: &usize| FarElement {
        number,
        quad: mesh.quads()[number],
        geometry: geometries[number],
    };
    let far_elements: Vec<_> = others.iter().map(of).collect();
    let quads: Vec<_> = far_elements.iter().map(|element| element.quad).collect();
    let of_far: Vec<_> = far_elements.iter().map(|element| element.geometry).collect();
    let far = small_strain(mesh.nodes().len(), &quads, &of_far, material);
    let material = material.clone();
    Box::new(PartlyFinite { near, near_elements, far, far_elements, material })
}

impl PartlyFinite {
    fn n_near(&self) -> usize {
        self.near.n_element_history() + self.near.n_history()
    }

    /// Returns the fields of the near elements, and those of the others.
    fn split<'a>(&self, history: &'a [NodalField]) -> (&'a [NodalField], &'a [NodalField]) {
        // Bounds are also computed without history.
        history.split_at(self.n_near().min(history.len()))
    }

    fn split_mut<'a>(
        &self,
        history: &'a mut [NodalField],
    ) -> (&'a mut [NodalField], &'a mut [NodalField]) {
        history.split_at_mut(self.n_near())
    }

    /// Moves the values of the near elements to the numbers of these in the body; far elements get another value.
    fn spread<T: Copy>(&self, values: &mut Vec<T>, of_far: T) {
        values.resize(self.near_elements.len() + self.far_elements.len(), of_far);
        // In descending order no entry is overwritten before it has been moved.
        for (k, &number) in self.near_elements.iter().enumerate().rev() {
            values[number] = values[k];
        }
        for element in &self.far_elements {
            values[element.number] = of_far;
        }
    }

    /// Returns a collapse with the number of its element in the body.
    fn collapse(&self, collapse: Collapse) -> Collapse {
        Collapse { element: self.near_elements[collapse.element], ..collapse }
    }
}

/// Shows the near stress and the number of elements of both kinds, for the fingerprint of a model.
impl fmt::Debug for PartlyFinite {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        let n = [self.near_elements.len(), self.far_elements.len()];
        write!(formatter, "PartlyFinite {{ {:?}, {n:?} }}", self.near)
    }
}

impl Part for PartlyFinite {
    fn n_history(&self) -> usize {
        self.near.n_history() + self.far.n_history()
    }

    fn set_time_step(&mut self, time_step: f64) {
        self.near.set_time_step(time_step);
        self.far.set_time_step(time_step);
    }
}

impl Stress for PartlyFinite {
    fn strain_measure(&self) -> StrainMeasure<'_> {
        StrainMeasure::Finite(self)
    }

    fn n_element_history(&self) -> usize {
        self.near.n_element_history()
    }

    /// Returns those of the elements at finite strain for all: undeformed, both kinds have the same stiffness.
    fn largest_eigenvalues(&self, elements: &[LumpedElement]) -> Vec<f64> {
        self.near.largest_eigenvalues(elements)
    }

    fn start_rigid(&self, displacement: &Field, history: &mut [NodalField]) {
        let (near, far) = self.split_mut(history);
        self.near.start_rigid(displacement, near);
        self.far.start_rigid(displacement, far);
    }

    fn start_deformed(&self, displacement: &Field, history: &mut [NodalField]) {
        let (near, far) = self.split_mut(history);
        self.near.start_deformed(displacement, near);
        self.far.start_deformed(displacement, far);
    }

    fn subtract_forces(
        &self,
        motion: &Motion<'_>,
        history: &[NodalField],
        forces: &mut Field,
    ) -> Result<(), Collapse> {
        let (near, far) = self.split(history);
        let done = self.near.subtract_forces(motion, near, forces);
        self.far.subtract_forces(motion, far, forces)?;
        done.map_err(|collapse| self.collapse(collapse))
    }

    fn advance(&self, motion: &Motion<'_>, history: &mut [NodalField]) {
        let (near, far) = self.split_mut(history);
        self.near.advance(motion, near);
        self.far.advance(motion, far);
    }

    fn add_energies(&self, motion: &Motion<'_>, history: &[NodalField], accounts: &mut Accounts) {
        let (near, far) = self.split(history);
        self.near.add_energies(motion, near, accounts);
        self.far.add_energies(motion, far, accounts);
    }
}

impl FiniteStrainStress for PartlyFinite {
    fn n_elements(&self) -> usize {
        self.near.n_elements()
    }

    /// Adds the bound of the elements at finite strain only, as does the next method: callers use its growth.
    fn add_undeformed_stiffness_bound(&self, bound: &mut [f64]) {
        self.near.add_undeformed_stiffness_bound(bound);
    }

    fn add_stiffness_bound(&self, motion: &Motion<'_>, history: &[NodalField], bound: &mut [f64]) {
        self.near.add_stiffness_bound(motion, self.split(history).0, bound);
    }

    fn strain_rate(&self, motion: &Motion<'_>) -> f64 {
        self.near.strain_rate(motion)
    }

    fn allowance_rate(&self, motion: &Motion<'_>, allowances: &[f64]) -> f64 {
        self.near.allowance_rate(motion, allowances)
    }

    fn most_compressed(&self, displacement: &Field) -> Collapse {
        self.collapse(self.near.most_compressed(displacement))
    }

    fn can_lose_stability(&self) -> bool {
        self.near.can_lose_stability()
    }

    fn unstable_element(&self, u: &Field, history: &[NodalField]) -> Option<UnstableElement> {
        let unstable = self.near.unstable_element(u, self.split(history).0)?;
        Some(UnstableElement { element: self.near_elements[unstable.element], ..unstable })
    }

    fn update_cauchy_stress(
        &self,
        displacement: &Field,
        history: &[NodalField],
        stress: &mut Vec<[f64; 4]>,
    ) {
        let (near, far) = self.split(history);
        self.near.update_cauchy_stress(displacement, near, stress);
        self.spread(stress, [0.0; 4]);
        let effective = self.far.effective().map_or(&[][..], |field| &far[field]);
        let small_strain = SmallStrain::of(&self.material, displacement, effective);
        for FarElement { number, quad, geometry } in &self.far_elements {
            stress[*number] = small_strain.stress(geometry, quad);
        }
    }

    /// Elements at small strain do not flow.
    fn update_plastic(&self, history: &[NodalField], plastic: &mut Vec<[f64; 2]>) {
        self.near.update_plastic(self.split(history).0, plastic);
        if !plastic.is_empty() {
            self.spread(plastic, [0.0; 2]);
        }
    }
}

#[cfg(test)]
mod tests;
