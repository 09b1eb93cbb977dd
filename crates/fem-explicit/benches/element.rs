//! A step of a sphere that nothing touches: forces of its elements and motion of its nodes. Divan
//! counts elements: the inverse of its throughput is the time of an element update.

#[path = "bodies/mod.rs"]
mod bodies;
#[path = "plain/mod.rs"]
mod plain;

use bodies::{ELASTIC, KINDS, Kind, mesh_and_glass};
use divan::Bencher;
use divan::counter::ItemsCount;
use plain::Plain;

/// Elements of the contact, µm: what 1 % needs, what 0.1 % needs, the paper's.
const SIZES: [u32; 3] = [60, 28, 14];

fn main() {
    divan::main();
}

#[divan::bench(args = KINDS, consts = SIZES)]
fn step<const MICROMETRES: u32>(bencher: Bencher<'_, '_>, kind: Kind) {
    let mut sphere = kind.sphere(1e-6 * f64::from(MICROMETRES)).expect("a sphere");
    let elements = ItemsCount::new(sphere.body().n_elements());
    bencher.counter(elements).bench_local(|| sphere.step());
}

/// The measure of the others.
#[divan::bench(consts = SIZES)]
fn plain_code<const MICROMETRES: u32>(bencher: Bencher<'_, '_>) {
    let size = 1e-6 * f64::from(MICROMETRES);
    let (mesh, glass) = mesh_and_glass(size).expect("a sphere");
    let mut elastic = ELASTIC.sphere(size).expect("a sphere");
    let mut sphere = Plain::beside(&mesh, &glass, &mut elastic);
    bencher.counter(ItemsCount::new(mesh.quads().len())).bench_local(|| sphere.step());
}
