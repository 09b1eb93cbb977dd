//! Gaps and forces of the springs between two spheres that are pressed together.

use divan::Bencher;
use fem_contact::{ContactInterface, Surface};
use fem_mesh::{HalfDisc, Side};

/// Elements of the contact, µm.
const SIZES: [u32; 3] = [60, 28, 14];

fn main() {
    divan::main();
}

#[divan::bench(args = SIZES)]
fn forces(bencher: Bencher<'_, '_>, micrometres: u32) {
    let sphere = |radius, side| {
        let disc = HalfDisc {
            radius,
            contact_element_size: 1e-6 * f64::from(micrometres),
            refined_radius: 0.27e-3,
            growth: None,
            edge: None,
        };
        disc.build().expect("a mesh").on_side(side)
    };
    let meshes = [sphere(11.1e-3, Side::Below), sphere(7.95e-3, Side::Above)];
    let [lower, upper] = meshes.each_ref().map(Surface::of_sphere);
    let interface = ContactInterface::new(lower, upper, 1e15, 0.0, 0.33e-3).expect("a contact");
    // As deep as the approach of the pair.
    let displacement = |side: usize, y: f64| vec![[0.0, y]; meshes[side].nodes().len()];
    let u = [displacement(0, 5e-6), displacement(1, -5e-6)];
    let mut f = [displacement(0, 0.0), displacement(1, 0.0)];
    bencher.bench_local(|| {
        let [lower, upper] = &mut f;
        interface.add_forces([&u[0], &u[1]], [lower, upper])
    });
}
