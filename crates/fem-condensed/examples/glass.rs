//! Cost and accuracy of the paper's glass pair: `cargo run --release -p fem-condensed --example
//! glass`. It prints one line per mesh and model; the limits are 62.818 µs, 107.99 N, 10.681 µm, 0.92763, 0.94811.

#![allow(
    clippy::disallowed_methods,
    clippy::disallowed_macros,
    reason = "an example prints what it times"
)]

use std::time::Instant;

use fem_collision::BodyInput;
use fem_condensed::{CondensedError, CondensedPair, PairSettings};
use fem_material::{ActsOn, ElasticModuli, Material, PronySeries, PronyTerm};
use fem_mesh::{HalfDisc, MeshError, Side, SphereMesh};

const CONTACT_RADIUS: f64 = 0.22307e-3;

fn mesh(diameter: f64, size: f64, side: Side) -> Result<SphereMesh, MeshError> {
    let disc = HalfDisc {
        radius: 0.5 * diameter,
        contact_element_size: size,
        refined_radius: 1.2 * CONTACT_RADIUS,
        growth: None,
        edge: None,
    };
    Ok(disc.build()?.on_side(side))
}

fn milliseconds(since: Instant) -> f64 {
    1e3 * since.elapsed().as_secs_f64()
}

fn known(value: Option<f64>) -> f64 {
    value.unwrap_or(f64::NAN)
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let moduli = ElasticModuli::from_youngs_modulus_poissons_ratio(63e9, 0.244)?;
    let glass = Material::new(2390.0, moduli, None)?;
    let term = PronyTerm { weight: 1.0, relaxation_time: 1.0 / 2708.0 };
    let all = PronySeries::new(vec![term], ActsOn::All)?;
    let shear = PronySeries::new(vec![term], ActsOn::Shear)?;
    for size in [60e-6, 30e-6, 28e-6, 15e-6, 7.5e-6] {
        let start = Instant::now();
        let sphere = |diameter, side| -> Result<BodyInput, MeshError> {
            Ok(BodyInput::Sphere { mesh: mesh(diameter, size, side)?, material: glass.clone() })
        };
        let inputs = [sphere(22.2e-3, Side::Below)?, sphere(15.9e-3, Side::Above)?];
        let meshed = milliseconds(start);
        let pair = CondensedPair::new(inputs, PairSettings::new(1.5 * CONTACT_RADIUS))?;
        println!(
            "{:.1} µm: {} equations, {} contact nodes, factor {:.1} MB; mesh {meshed:.1} ms, \
             condensed {:.1} ms",
            1e6 * size,
            pair.n_equations(),
            pair.n_points(),
            1e-6 * pair.factor_bytes() as f64,
            milliseconds(start) - meshed
        );
        for (name, series) in [("elastic", None), ("all", Some(&all)), ("shear", Some(&shear))] {
            let collide = || -> Result<_, CondensedError> {
                let start = Instant::now();
                let run = pair.impact(0.5, [series; 2], CondensedPair::N_STEPS)?;
                Ok((run, milliseconds(start)))
            };
            let (run, first) = collide()?;
            let (_, again) = collide()?;
            println!(
                "  {name:7} e {:.6}  T {:.4} µs  F {:.3} N  approach {:.4} µm  a {:.4} mm  p0 {:.4} \
                 GPa  first {first:.2} ms, again {again:.3} ms",
                known(run.restitution),
                1e6 * known(run.contact_time),
                known(run.peak_force),
                1e6 * known(run.max_approach),
                1e3 * known(run.max_contact_radius),
                1e-9 * known(run.peak_pressure)
            );
        }
        let start = Instant::now();
        let mut mean = 0.0;
        for k in 0..1000 {
            let speed = 0.1 + 4e-4 * f64::from(k);
            mean += 1e-3
                * pair
                    .impact(speed, [Some(&all); 2], CondensedPair::N_STEPS)?
                    .restitution
                    .unwrap_or(f64::NAN);
        }
        println!("  a thousand speeds {:.0} ms, mean e {mean:.5}", milliseconds(start));
    }
    Ok(())
}
