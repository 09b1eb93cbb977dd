//! What a model is known by to a memory of one of its runs: a number that differs where masses,
//! materials, forces, steps or contact differ.

use std::fmt::{self, Write};

use crate::model::Model;

/// FNV-1a over what is written: the same on every machine.
struct Digest(u64);

impl Write for Digest {
    fn write_str(&mut self, text: &str) -> fmt::Result {
        for byte in text.bytes() {
            self.0 = (self.0 ^ u64::from(byte)).wrapping_mul(0x0100_0000_01b3);
        }
        Ok(())
    }
}

/// A number of sixteen digits.
const SMALLEST: u64 = 1_000_000_000_000_000;

/// The fingerprint of a model.
pub(crate) fn fingerprint(model: &Model) -> u64 {
    let mut digest = Digest(0xcbf2_9ce4_8422_2325);
    let searched = model.searched();
    // Numbers are written so that equal text is of equal bits; a digest takes all text.
    let _ = write!(digest, "{:?}{searched:?}{:?}", model.approach(), model.time_step());
    for body in model.bodies() {
        let masses = body
            .nodal_mass
            .iter()
            .fold(0, |sum: u64, mass| sum.rotate_left(5).wrapping_add(mass.to_bits()));
        let _ = write!(digest, "{:?}{:?}{masses}", body.material(), body.node_forces);
    }
    // Always sixteen digits: memories of one size take the same room as text.
    SMALLEST + digest.0 % (9 * SMALLEST)
}
