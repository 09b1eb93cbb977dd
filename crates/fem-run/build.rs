//! Links the command at fixed addresses where the linker can: a relocatable program of this size spends a tenth of its
//! start on relocations.

#![allow(clippy::disallowed_macros, reason = "Cargo reads what a build script prints")]

fn main() {
    println!("cargo::rerun-if-changed=build.rs");
    let target = |part: &str| std::env::var(format!("CARGO_CFG_TARGET_{part}")).unwrap_or_default();
    if target("OS") == "linux" && target("ENV") == "gnu" {
        println!("cargo::rustc-link-arg-bins=-no-pie");
    }
}
