//! Materials, pairs and comparisons that several modules share.

use fem_laws::{Pair, Partner};
use fem_material::{ElasticModuli, Material};

pub fn assert_close(found: f64, expected: f64, relative: f64) {
    assert!(
        (found - expected).abs() <= relative * expected.abs(),
        "found {found:e}, expected {expected:e}"
    );
}

pub fn glass() -> Material {
    let moduli = ElasticModuli::from_youngs_modulus_poissons_ratio(63e9, 0.244).unwrap();
    Material::new(2390.0, moduli, None).unwrap()
}

pub fn glass_pair() -> Pair {
    let glass = glass();
    Pair::new(Partner::solid_sphere(22.2e-3, &glass), Partner::solid_sphere(15.9e-3, &glass))
        .unwrap()
}
