//! Effects of the materials: relaxation, unknown losses, finite strain plastic flow and its rate.

mod finite_strain;
mod material_loss;
mod plastic_flow;
mod rate_dependence;
mod viscoelasticity;
