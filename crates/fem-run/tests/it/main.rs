//! The command as its users call it, in one program: linked once, its tests run side by side.

mod bad_input;
mod bounces;
mod calibrate;
mod common;
mod fit;
mod house;
mod models;
mod repeatability;
mod result_folder;
mod stopping;
mod sweep;
mod sweep_input;
mod terminal;
mod validate;
