//! Collisions at finite strain: contact laws of soft bodies, and their stress fields.

pub mod contours;
pub mod laws;
