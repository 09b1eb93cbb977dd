//! Measured data: what tables, records and data sheets say of a material or a contact. It knows laws and materials, and
//! no model that computes a collision.
//!
//! ```text
//! table        numbers from text, with the place of every fault: restitutions, moduli, long records
//! estimate     least squares: contact laws and Prony series from restitutions
//! instruments  bounce times, heights, sound, forces and angles to restitutions with their errors
//! relaxation   moduli over frequency or time to a Prony series
//! dem          the numbers that DEM codes, Drake, MuJoCo and Newton ask for
//! ```

pub mod dem;
pub mod estimate;
pub mod instruments;
pub mod relaxation;
pub mod table;
