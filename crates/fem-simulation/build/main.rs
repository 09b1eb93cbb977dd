//! Gives the crate an identity of the numerics that it is built with.

#![allow(clippy::disallowed_macros, reason = "a build script talks to cargo by printing")]

mod digest;

use std::env;
use std::error::Error;
use std::path::PathBuf;

fn main() -> Result<(), Box<dyn Error>> {
    let own = PathBuf::from(env::var("CARGO_MANIFEST_DIR")?);
    let target = env::var("TARGET")?;
    // Looked at again where one of these changes, and else not: nothing else is built anew for it.
    for input in digest::inputs(&own)? {
        println!("cargo:rerun-if-changed={}", input.display());
    }
    println!("cargo:rerun-if-changed=build");
    println!("cargo:rustc-env=FEM_NUMERICS={}", digest::digest(&own, &target)?);
    println!("cargo:rustc-env=FEM_NUMERICS_TARGET={target}");
    Ok(())
}
