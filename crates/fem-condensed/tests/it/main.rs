//! A collision of condensed spheres from outside, in one program: linked once, its tests run side by side.

mod common;
mod convergence;
mod explicit_agreement;
mod half_space;
mod history_rows;
mod known_limits;
mod no_separation;
mod quantities;
mod rejected_inputs;
mod rigid;
mod snapshots;
mod springs;
mod unlike_meshes;

/// The private solvers of the contact problem, compiled into this program with the tests in their files: the crate has no
/// unit tests, so that it is not compiled twice.
#[allow(dead_code, reason = "the crate uses all of them")]
#[path = "../../src/contact"]
mod contact {
    pub(crate) mod complementarity;
    pub(crate) mod disc_contact;
}
#[allow(dead_code, reason = "the crate uses all of it")]
#[path = "../../src/condensation"]
mod condensation {
    pub(crate) mod dense;
}
