//! Commands about contact laws and measured data.

mod calibrate;
mod dents;
mod fit;
mod measure;
mod relaxation;

use crate::common::Place;

/// Asserts that `command` with `more` rejects the data `csv`, in `bad.csv`, with these messages, and writes nothing.
fn rejects_data(place: &Place, command: &str, [csv, more, expected]: [&str; 3]) {
    place.write("bad.csv", csv);
    place.fails(2, (command, more)).tells(expected);
    assert!(!place.path("runs").exists());
}
