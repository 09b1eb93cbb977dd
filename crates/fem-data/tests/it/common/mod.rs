//! The bodies of Bordbar & Hyppänen (2007) and of Bridges et al. (1984).

#![allow(dead_code, reason = "no test file uses all of it")]

use fem_data::estimate::{Model, Point};
use fem_laws::{EndRule, LawFamily, Pair, Partner};
use fem_material::{ActsOn, ElasticModuli, Material, PronySeries, PronyTerm};

/// Returns the glass of table 1, with a decay rate, 1/s.
pub fn glass(decay: Option<(f64, ActsOn)>) -> Material {
    let moduli = ElasticModuli::from_youngs_modulus_poissons_ratio(63e9, 0.244).unwrap();
    let series = decay.map(|(rate, acts_on)| {
        let term = PronyTerm { weight: 1.0, relaxation_time: 1.0 / rate };
        PronySeries::new(vec![term], acts_on).unwrap()
    });
    Material::new(2390.0, moduli, series).unwrap()
}

/// Returns the model of spheres of 22.2 mm and 15.9 mm.
pub fn glass_model(family: LawFamily, decay: Option<(f64, ActsOn)>) -> Model {
    let glass = glass(decay);
    let sphere = |diameter| Partner::solid_sphere(diameter, &glass);
    let pair = Pair::new(sphere(22.2e-3), sphere(15.9e-3)).unwrap();
    Model::new(&pair, [Some(glass.clone()), Some(glass)], family, EndRule::ZeroForce).unwrap()
}

/// Returns the model of two ice spheres of 2 cm.
pub fn ice_model(family: LawFamily) -> Model {
    let moduli = ElasticModuli::from_youngs_modulus_poissons_ratio(10e9, 0.3).unwrap();
    let ice = Material::new(1000.0, moduli, None).unwrap();
    let sphere = Partner::solid_sphere(2e-2, &ice);
    Model::new(&Pair::new(sphere, sphere).unwrap(), [None, None], family, EndRule::ZeroForce)
        .unwrap()
}

/// Returns e = 0.32 (v/[cm/s])^−0.234, at most 1, at 12 speeds from 0.02 to 5 cm/s (Bridges et al. 1984).
pub fn bridges() -> Vec<Point> {
    let speed = |i: i32| 0.02 * 250f64.powf(f64::from(i) / 11.0);
    (0..12).map(|i| Point::new(1e-2 * speed(i), (0.32 * speed(i).powf(-0.234)).min(1.0))).collect()
}
