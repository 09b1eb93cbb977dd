//! Effects of the materials: relaxation, unknown losses, finite strain and plastic flow.

mod finite_strain;
mod material_loss;
mod plastic_flow;
mod viscoelasticity;
