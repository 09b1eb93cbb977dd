//! Many collisions, and the library as a whole, through its public interface, in one program.

mod accuracy;
mod calibrate;
mod data_sheets;
mod laws;
mod measured_data;
mod public_interface;
// The other functions are for tests of one collision.
#[allow(dead_code)]
#[path = "../../../fem-simulation/tests/it/scene.rs"]
mod scene;
mod sweep;
