//! Properties of every law.

use fem_material::finite::{AxisymmetricTensor, HyperelasticLaw};

use super::{
    Random, cauchy_of, components, deformation, distance, gradient_of, moduli, product, rotation,
    solid, tensor,
};

const RATIOS: [f64; 5] = [-0.3, 0.0, 0.244, 0.45, 0.495];

/// Central differences over 2δ err by δ²/6 W''' and by rounding of W over δ; both are 1e-10 of the
/// stiffness at δ = 1e-5, and the stiffness is up to 3K = 200 E/2 times a few.
#[test]
fn piola_stress_is_the_derivative_of_the_energy() {
    let delta = 1e-5;
    let mut random = Random(1);
    for (law, nu) in all() {
        let solid = solid(law, nu);
        for _ in 0..100 {
            let h = random.gradient(0.4);
            let stress = components(&solid.first_piola(&h).unwrap());
            for k in 0..5 {
                let energy = |shift: f64| {
                    let mut moved = components(&h);
                    moved[k] += shift;
                    solid.energy(&tensor(moved)).unwrap()
                };
                let slope = (energy(delta) - energy(-delta)) / (2.0 * delta);
                let error = (slope - stress[k]).abs();
                assert!(error < 3e-7, "{law:?} {nu} {k}: {slope} {}", stress[k]);
            }
        }
    }
}

/// W(QF) = W(F) and P(QF) = Q P(F); of an isotropic solid also P(FQ) = P(F) Q. Rounding, 1e-16 of
/// the largest stiffness, which is some hundred.
#[test]
fn a_rotation_of_the_meridian_plane_rotates_the_stress() {
    let mut random = Random(2);
    for (law, nu) in all() {
        let solid = solid(law, nu);
        for _ in 0..100 {
            let h = random.gradient(0.4);
            let turn = rotation(3.0 * random.next());
            let stress = components(&solid.first_piola(&h).unwrap());
            let energy = solid.energy(&h).unwrap();
            let f = deformation(&h);
            for (turned, expected) in [
                (product(turn, f), product(turn, stress)),
                (product(f, turn), product(stress, turn)),
            ] {
                let turned = gradient_of(turned);
                let found = components(&solid.first_piola(&turned).unwrap());
                for (found, expected) in found.iter().zip(expected) {
                    assert!((found - expected).abs() < 1e-12, "{law:?} {nu}");
                }
                assert!((solid.energy(&turned).unwrap() - energy).abs() < 1e-12, "{law:?} {nu}");
            }
        }
    }
}

/// P Fᵀ/J is symmetric and is what `cauchy` gives.
#[test]
fn cauchy_stress_is_that_of_the_deformed_area() {
    let mut random = Random(3);
    for (law, nu) in all() {
        let solid = solid(law, nu);
        let h = random.gradient(0.4);
        let expected = cauchy_of(components(&solid.first_piola(&h).unwrap()), &h);
        let found = solid.cauchy(&h).unwrap();
        let found = [found.rr, found.ry, found.ry, found.yy, found.tt];
        for (found, expected) in found.iter().zip(expected) {
            assert!((found - expected).abs() < 1e-12, "{law:?} {nu}");
        }
    }
}

/// Hooke's stress of the strain e, by the components of P.
fn hooke(nu: f64, h: &AxisymmetricTensor) -> [f64; 5] {
    let [rr, yy, tt, ry] = moduli(nu).stress([h.rr, h.yy, h.tt, h.ry + h.yr]);
    [rr, ry, ry, yy, tt]
}

/// The difference to Hooke's law is the second order of strain: it is four times less at half of
/// the strain. At 1e-3 the third order changes the exponent by some thousandths.
#[test]
fn laws_differ_from_hookes_at_second_order_in_strain() {
    let mut random = Random(4);
    for (law, nu) in all() {
        let solid = solid(law, nu);
        let direction = random.gradient(1.0);
        let error = |size: f64| {
            let h = tensor(components(&direction).map(|x| size * x));
            distance(components(&solid.first_piola(&h).unwrap()), hooke(nu, &h))
        };
        let order = (error(1e-3) / error(5e-4)).log2();
        assert!((order - 2.0).abs() < 0.02, "{law:?} {nu}: order {order}");
    }
}

/// At a strain of 1e-9 stress keeps seven digits from the second order alone, and the energy what
/// rounding of 1e-16 over the strain leaves. A body at rest has none of either.
#[test]
fn stress_at_tiny_strain_keeps_its_digits() {
    let mut random = Random(5);
    for (law, nu) in all() {
        let solid = solid(law, nu);
        let h = tensor(components(&random.gradient(1.0)).map(|x| 1e-9 * x));
        let expected = hooke(nu, &h);
        let error = distance(components(&solid.first_piola(&h).unwrap()), expected);
        assert!(error < 3e-8 * distance(expected, [0.0; 5]), "{law:?} {nu}: {error}");
        let energy = moduli(nu).strain_energy_density([h.rr, h.yy, h.tt, h.ry + h.yr]);
        let error = solid.energy(&h).unwrap() / energy - 1.0;
        assert!(error.abs() < 1e-6, "{law:?} {nu}: {error}");
        assert_eq!(components(&solid.first_piola(&tensor([0.0; 5])).unwrap()), [0.0; 5]);
        assert_eq!(solid.energy(&tensor([0.0; 5])).unwrap(), 0.0);
    }
}

/// J at and below zero, both factors of J below zero, and what is no number.
#[test]
fn inverted_material_is_an_error() {
    for law in HyperelasticLaw::ALL {
        let solid = solid(law, 0.3);
        for f in [
            [1.0, 0.0, 0.0, 0.0, 1.0],
            [1.0, 0.0, 0.0, -0.5, 1.0],
            [1.0, 2.0, 2.0, 1.0, 1.0],
            [1.0, 0.0, 0.0, -1.0, -1.0],
            [f64::NAN, 0.0, 0.0, 1.0, 1.0],
            [f64::INFINITY, 0.0, 0.0, 1.0, 1.0],
        ] {
            let h = gradient_of(f);
            assert!(solid.first_piola(&h).is_err(), "{law:?} {f:?}");
            assert!(solid.energy(&h).is_err());
            assert!(solid.cauchy(&h).is_err());
            assert!(solid.tangent(&h).is_err());
            assert!(solid.largest_stiffness(&h).is_err());
        }
        // A thousandth of the volume still has a stress.
        let stress = solid.first_piola(&gradient_of([1.0, 0.0, 0.0, 1e-3, 1.0])).unwrap();
        assert!(components(&stress).iter().all(|x| x.is_finite()), "{law:?}");
    }
    let error = solid(HyperelasticLaw::NeoHooke, 0.3)
        .energy(&gradient_of([1.0, 0.0, 0.0, -0.5, 1.0]))
        .unwrap_err();
    assert_eq!(
        error.to_string(),
        "the material is turned inside out: its volume is -0.5 times the undeformed one"
    );
}

fn all() -> impl Iterator<Item = (HyperelasticLaw, f64)> {
    HyperelasticLaw::ALL.into_iter().flat_map(|law| RATIOS.map(|nu| (law, nu)))
}
