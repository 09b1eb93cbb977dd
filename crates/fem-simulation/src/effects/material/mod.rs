//! Effects of the materials: relaxation, finite strain and first yield.

mod finite_strain;
mod plastic_yield;
mod viscoelasticity;
