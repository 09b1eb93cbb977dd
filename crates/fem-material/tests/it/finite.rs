//! Laws of finite strain: stress is the derivative of the energy, Hooke at small strain.

use fem_material::ElasticModuli;
use fem_material::finite::{AxisymmetricTensor, Hyperelastic, HyperelasticLaw};

/// Random numbers in −1 .. 1, the same on every machine (Knuth's linear congruence).
struct Random(u64);

impl Random {
    fn next(&mut self) -> f64 {
        self.0 =
            self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 11) as f64 / (1u64 << 52) as f64 - 1.0
    }

    /// A displacement gradient with components up to `size`.
    fn gradient(&mut self, size: f64) -> AxisymmetricTensor {
        from_array(std::array::from_fn(|_| size * self.next()))
    }
}

fn from_array([rr, ry, yr, yy, tt]: [f64; 5]) -> AxisymmetricTensor {
    AxisymmetricTensor { rr, ry, yr, yy, tt }
}

fn to_array(t: &AxisymmetricTensor) -> [f64; 5] {
    [t.rr, t.ry, t.yr, t.yy, t.tt]
}

fn solid(law: HyperelasticLaw, nu: f64) -> Hyperelastic {
    Hyperelastic::new(law, &ElasticModuli::from_youngs_modulus_poissons_ratio(2.0, nu).unwrap())
}

/// Central differences over 2δ err by δ²/6 W''' and by rounding of W over δ: at δ = 1e-5 both are
/// below 1e-9 of the stiffness, for the largest modulus K = 67 E that is used here 1e-7.
#[test]
fn stress_is_the_derivative_of_the_energy() {
    let delta = 1e-5;
    let mut random = Random(1);
    for nu in [0.0, 0.244, 0.45, 0.495] {
        let solid = solid(HyperelasticLaw::NeoHooke, nu);
        for _ in 0..200 {
            let h = random.gradient(0.4);
            let stress = to_array(&solid.first_piola(&h).unwrap());
            for k in 0..5 {
                let energy = |shift: f64| {
                    let mut moved = to_array(&h);
                    moved[k] += shift;
                    solid.energy(&from_array(moved)).unwrap()
                };
                let slope = (energy(delta) - energy(-delta)) / (2.0 * delta);
                assert!((slope - stress[k]).abs() < 2e-7, "{k}: {slope} {}", stress[k]);
            }
        }
    }
}
