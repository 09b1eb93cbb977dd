//! A step of a sphere that nothing touches: forces of its elements and motion of its nodes. Divan
//! counts elements: the inverse of its throughput is the time of an element update.

#[path = "bodies/mod.rs"]
mod bodies;
#[path = "plain/mod.rs"]
mod plain;

use bodies::{Error, Kind, glass, mesh};
use divan::Bencher;
use divan::counter::ItemsCount;
use fem_material::ActsOn;
use plain::Plain;

/// Elements of the contact, µm: what 1 % needs, what 0.1 % needs, the paper's.
const SIZES: [u32; 3] = [60, 28, 14];

fn main() {
    divan::main();
}

fn size(micrometres: u32) -> f64 {
    1e-6 * f64::from(micrometres)
}

fn step(bencher: Bencher<'_, '_>, kind: Kind, micrometres: u32) {
    let mut sphere = kind.sphere(size(micrometres)).expect("a sphere");
    let elements = ItemsCount::new(sphere.body().n_elements());
    bencher.counter(elements).bench_local(|| sphere.step());
}

/// The measure of the others.
#[divan::bench(args = SIZES)]
fn plain_code(bencher: Bencher<'_, '_>, micrometres: u32) {
    let run = || -> Result<(Plain, usize, f64), Error> {
        let (mesh, glass) = (mesh(size(micrometres))?, glass(&[], ActsOn::All)?);
        let time_step = Kind::Elastic.sphere(size(micrometres))?.time_step();
        Ok((Plain::new(&mesh, &glass), mesh.quads().len(), time_step))
    };
    let (mut sphere, n_elements, time_step) = run().expect("a sphere");
    bencher.counter(ItemsCount::new(n_elements)).bench_local(|| sphere.step(time_step));
}

#[divan::bench(args = SIZES)]
fn elastic(bencher: Bencher<'_, '_>, micrometres: u32) {
    step(bencher, Kind::Elastic, micrometres);
}

#[divan::bench(args = SIZES)]
fn unordered(bencher: Bencher<'_, '_>, micrometres: u32) {
    step(bencher, Kind::Unordered, micrometres);
}

#[divan::bench(args = SIZES)]
fn relaxing(bencher: Bencher<'_, '_>, micrometres: u32) {
    step(bencher, Kind::Relaxing, micrometres);
}

#[divan::bench(args = SIZES)]
fn three_terms(bencher: Bencher<'_, '_>, micrometres: u32) {
    step(bencher, Kind::ThreeTerms, micrometres);
}

#[divan::bench(args = SIZES)]
fn relaxing_shear(bencher: Bencher<'_, '_>, micrometres: u32) {
    step(bencher, Kind::RelaxingShear, micrometres);
}

#[divan::bench(args = SIZES)]
fn finite_strain(bencher: Bencher<'_, '_>, micrometres: u32) {
    step(bencher, Kind::FiniteStrain, micrometres);
}

#[divan::bench(args = SIZES)]
fn finite_relaxing(bencher: Bencher<'_, '_>, micrometres: u32) {
    step(bencher, Kind::FiniteRelaxing, micrometres);
}
