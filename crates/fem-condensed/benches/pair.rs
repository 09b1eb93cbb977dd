//! The condensed glass pair: its factor, and a collision of one that is factored.

use divan::Bencher;
use fem_collision::BodyInput;
use fem_condensed::{CondensedPair, PairSettings};
use fem_material::{ActsOn, ElasticModuli, Material, PronySeries, PronyTerm};
use fem_mesh::{HalfDisc, Side};

type Error = Box<dyn std::error::Error>;

/// Largest contact radius of the pair at 0.5 m/s, m.
const CONTACT_RADIUS: f64 = 0.22307e-3;
/// Elements of the contact, µm.
const SIZES: [u32; 3] = [60, 28, 14];

fn main() {
    divan::main();
}

fn inputs(micrometres: u32) -> Result<[BodyInput; 2], Error> {
    let moduli = ElasticModuli::from_youngs_modulus_poissons_ratio(63e9, 0.244)?;
    let glass = Material::new(2390.0, moduli, None)?;
    let sphere = |diameter: f64, side| -> Result<BodyInput, Error> {
        let disc = HalfDisc {
            radius: 0.5 * diameter,
            contact_element_size: 1e-6 * f64::from(micrometres),
            refined_radius: 1.2 * CONTACT_RADIUS,
            growth: None,
            edge: None,
        };
        let mesh = disc.build()?.on_side(side);
        Ok(BodyInput::Sphere { mesh, material: glass.clone() })
    };
    Ok([sphere(22.2e-3, Side::Below)?, sphere(15.9e-3, Side::Above)?])
}

fn pair(inputs: [BodyInput; 2]) -> CondensedPair {
    CondensedPair::new(inputs, PairSettings::new(1.5 * CONTACT_RADIUS)).expect("a pair")
}

#[divan::bench(args = SIZES)]
fn factor(bencher: Bencher<'_, '_>, micrometres: u32) {
    let inputs = inputs(micrometres).expect("two spheres");
    bencher.with_inputs(|| inputs.clone()).bench_local_values(pair);
}

fn collision(bencher: Bencher<'_, '_>, micrometres: u32, relaxation: Option<&PronySeries>) {
    let pair = pair(inputs(micrometres).expect("two spheres"));
    pair.prepare(0.5, [relaxation; 2]).expect("a basis");
    bencher.bench_local(|| pair.impact(0.5, [relaxation; 2], CondensedPair::N_STEPS));
}

fn series(acts_on: ActsOn) -> PronySeries {
    let term = PronyTerm { weight: 1.0, relaxation_time: 1.0 / 2708.0 };
    PronySeries::new(vec![term], acts_on).expect("a series")
}

#[divan::bench(args = SIZES)]
fn elastic_collision(bencher: Bencher<'_, '_>, micrometres: u32) {
    collision(bencher, micrometres, None);
}

#[divan::bench(args = SIZES)]
fn relaxing_collision(bencher: Bencher<'_, '_>, micrometres: u32) {
    collision(bencher, micrometres, Some(&series(ActsOn::All)));
}

#[divan::bench(args = SIZES)]
fn shear_collision(bencher: Bencher<'_, '_>, micrometres: u32) {
    collision(bencher, micrometres, Some(&series(ActsOn::Shear)));
}
