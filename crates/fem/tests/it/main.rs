//! The library from outside, in one program: linked once, its tests run side by side.

mod approaches;
mod auto;
mod bulk_viscosity;
mod calibrate;
mod coarse;
mod condensed;
mod courses;
mod effects;
mod folded_terms;
mod front_door;
mod half_space;
mod laws;
mod left_out;
mod measured;
mod mirror_symmetry;
mod models;
mod paper;
mod partner_waves;
mod plan;
mod plastic_yield;
mod refusals_in_code;
mod remedies;
mod rigid_partner;
mod stress;
mod sweep;
mod together;
