//! Materials, pairs and comparisons that several modules share.

use fem_laws::{Pair, PairRelaxation, Partner};
use fem_material::{ActsOn, ElasticModuli, Material, PronySeries, PronyTerm};

pub fn assert_close(found: f64, expected: f64, relative: f64) {
    assert!(
        (found - expected).abs() <= relative * expected.abs(),
        "found {found:e}, expected {expected:e}"
    );
}

/// Young's modulus (Pa), Poisson's ratio and density (kg/m³).
pub const GLASS: [f64; 3] = [63e9, 0.244, 2390.0];
pub const STEEL: [f64; 3] = [210e9, 0.3, 7800.0];

pub fn moduli(youngs_modulus: f64, poissons_ratio: f64) -> ElasticModuli {
    ElasticModuli::from_youngs_modulus_poissons_ratio(youngs_modulus, poissons_ratio).unwrap()
}

/// Returns a material with Prony terms of weight and relaxation time (s); an elastic one without terms.
pub fn relaxing(
    [youngs_modulus, poissons_ratio, density]: [f64; 3],
    acts_on: ActsOn,
    terms: &[(f64, f64)],
) -> Material {
    let term = |&(weight, relaxation_time): &(f64, f64)| PronyTerm { weight, relaxation_time };
    let series = (!terms.is_empty())
        .then(|| PronySeries::new(terms.iter().map(term).collect(), acts_on).unwrap());
    Material::new(density, moduli(youngs_modulus, poissons_ratio), series).unwrap()
}

/// The same with terms of weight and decay rate (1/s).
pub fn decaying(constants: [f64; 3], acts_on: ActsOn, terms: &[(f64, f64)]) -> Material {
    let terms: Vec<_> = terms.iter().map(|(weight, rate)| (*weight, 1.0 / rate)).collect();
    relaxing(constants, acts_on, &terms)
}

pub fn elastic(constants: [f64; 3]) -> Material {
    relaxing(constants, ActsOn::All, &[])
}

pub fn glass() -> Material {
    elastic(GLASS)
}

pub fn steel() -> Material {
    elastic(STEEL)
}

pub fn relaxation_of(materials: [&Material; 2]) -> PairRelaxation {
    PairRelaxation::new(Some(materials[0]), Some(materials[1])).unwrap()
}

/// Returns the share of its instantaneous modulus in Carson's transform of a series at `s`, 1/s.
pub fn carson(equilibrium_weight: f64, terms: &[PronyTerm], s: f64) -> f64 {
    let decaying = terms.iter().map(|term| {
        let st = s * term.relaxation_time;
        term.weight * st / (1.0 + st)
    });
    equilibrium_weight + decaying.sum::<f64>()
}

/// Returns spheres of 22.2 and 15.9 mm of a material.
pub fn pair_of(material: &Material) -> Pair {
    let sphere = |diameter| Partner::solid_sphere(diameter, material);
    Pair::new(sphere(22.2e-3), sphere(15.9e-3)).unwrap()
}

pub fn glass_pair() -> Pair {
    pair_of(&glass())
}
