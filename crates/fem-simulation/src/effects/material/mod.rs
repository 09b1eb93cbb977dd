//! Effects of the materials: relaxation, unknown losses, finite strain and first yield.

mod finite_strain;
mod material_loss;
mod plastic_yield;
mod viscoelasticity;
