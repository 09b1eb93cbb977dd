//! The estimated effect of the inertia of the bodies' deformation, and the limits of models without it.

use fem_simulation::effects::{Effect, NeglectError, Vibration};

use crate::scene::simulation_of as simulation;

/// A ball with its Young's modulus (Pa), Poisson's ratio, density (kg/m³), diameter (m) and speed (m/s).
#[derive(Clone, Copy)]
struct Ball([f64; 4], f64);

impl Ball {
    fn body(self, name: &str, speed: f64) -> String {
        let Self([youngs_modulus, poissons_ratio, density, diameter], _) = self;
        format!(
            "[material.{name}]\nyoungs_modulus={youngs_modulus}\npoissons_ratio={poissons_ratio}\n\
             density={density}\n[[body]]\nname='{name}'\nmaterial='{name}'\n\
             sphere={{diameter={diameter}}}\napproach_speed={speed}\n"
        )
    }

    fn on_wall(self) -> String {
        format!("[[body]]\nname='floor'\nwall={{}}\n{}", self.body("ball", self.1))
    }

    fn on(self, other: Self) -> String {
        other.body("lower", other.1) + &self.body("upper", self.1)
    }
}

/// Returns the estimated changes: shares of contact time and peak force, and the restitution.
fn estimated(text: &str) -> [f64; 3] {
    let simulation = simulation(text, &["model.hertz={}"]);
    let estimate = &simulation.setup().estimate;
    let error = Vibration.neglect_error(simulation.case().scene(), estimate).unwrap();
    let NeglectError { restitution, contact_time_s, peak_force_n } = error;
    let (time, force) = (estimate.hertz.contact_time(), estimate.hertz.peak_force());
    [restitution.unwrap(), contact_time_s.unwrap() / time, peak_force_n.unwrap() / force]
}

const PLASTIC: Ball = Ball([1.73105e9, 0.37453, 1204.54, 3.8326e-3], 3.03273);
const SOFT: Ball = Ball([371_421.0, 0.40975, 903.512, 2.22775e-3], 1.60258);
const OF_SOFT: Ball = Ball([867_851.0, 0.45197, 1035.99, 4.80943e-3], 0.0);

/// A pair of like bodies has the estimate of a wall impact at half the speed.
#[test]
fn like_bodies_have_the_estimate_of_a_wall_at_half_the_speed() {
    for Ball(numbers, speed) in [PLASTIC, SOFT] {
        let pair = estimated(&Ball(numbers, speed).on(Ball(numbers, 0.0)));
        let wall = estimated(&Ball(numbers, 0.5 * speed).on_wall());
        for (pair, wall) in pair.into_iter().zip(wall) {
            assert!((pair / wall - 1.0).abs() < 1e-9, "{pair} {wall}");
        }
    }
}

/// The second term of the modes' response grows with the power 4/5 of the speed.
#[test]
fn the_estimate_grows_with_the_power_of_the_modal_response() {
    let Ball(numbers, speed) = PLASTIC;
    let [slow, fast] = [0.1, 1.0].map(|share| estimated(&Ball(numbers, share * speed).on_wall()));
    for k in [1, 2] {
        let power = (fast[k] / slow[k]).log10();
        assert!((power - 0.8).abs() < 1e-6, "{power}");
    }
}

/// The estimate agrees with the recorded difference between explicit elements at small strain and quasi-static bodies:
/// a ball on a wall at 0.42 % of its shear wave speed with a tolerance of 0.2 %, and an unlike pair at 13 % with 0.4 %.
#[test]
fn the_estimate_agrees_with_explicit_elements() {
    for (text, found) in [
        (PLASTIC.on_wall(), [0.000_29, f64::NAN, 16.563 / 16.373 - 1.0]),
        (SOFT.on(OF_SOFT), [0.0208, 0.0606, 0.0837]),
    ] {
        for (estimated, found) in estimated(&text).into_iter().zip(found) {
            let ratio = estimated / found;
            assert!(ratio.is_nan() || (0.5..2.0).contains(&ratio), "{estimated} {found}");
        }
    }
    // The estimate for the ball on the wall is not below the computed loss.
    assert!(estimated(&PLASTIC.on_wall())[0] > 0.000_29);
}

/// A small ball leaves its waves in a large one, which hardly moves. The losses are recorded from explicit elements at
/// small strain and a tolerance of 0.2 %, with waves that cross the large ball 3.0, 4.6, 4.4 and 8.0 times during the
/// contact.
#[test]
fn the_loss_in_a_large_body_agrees_with_explicit_elements() {
    for (ball, large, found) in [
        (Ball([2e11, 0.28, 7800.0, 6e-3], 1.1), [1.3e9, 0.12, 1100.0, 30e-3], 3.18e-4),
        (Ball([7e10, 0.2, 2500.0, 9e-3], 6.0), [4e9, 0.05, 1500.0, 12e-3], 2.13e-4),
        (Ball([3e9, 0.0, 1200.0, 20e-3], 10.0), [2e9, 0.3, 1200.0, 20e-3], 3.39e-4),
        (Ball([2.1e11, 0.29, 7800.0, 8e-3], 0.3), [7e10, 0.2, 2500.0, 20e-3], 6.1e-6),
    ] {
        let ratio = estimated(&ball.on(Ball(large, 0.0)))[0] / found;
        assert!((1.0 / 3.0..3.0).contains(&ratio), "{large:?} {ratio}");
    }
}

/// Modes are advised if they help, and explicit elements otherwise.
#[test]
fn modes_are_advised_where_they_help() {
    let Ball(numbers, speed) = SOFT;
    for share in [0.01, 0.05, 0.1, 0.3, 1.0, 3.0] {
        let text = Ball(numbers, share * speed).on(OF_SOFT);
        let warnings = simulation(&text, &["model.condensed={}"]).warnings_before();
        let says = |words: &str| warnings.iter().any(|warning| warning.contains(words));
        let mach = 0.1327 * share;
        assert_eq!(says("vibration_modes ="), mach > 0.005 && mach < 0.02, "{share} {warnings:?}");
        assert_eq!(says("steep fronts"), mach > 0.02, "{share} {warnings:?}");
    }
}

/// The plan warns of an approach faster than shear waves.
#[test]
fn an_approach_faster_than_shear_waves_is_warned_of() {
    let Ball(numbers, speed) = SOFT;
    for (share, is_told) in [(0.5, false), (7.0, false), (8.0, true), (30.0, true)] {
        for text in [
            Ball(numbers, share * speed).on(OF_SOFT),
            Ball(numbers, share * speed).on(Ball(numbers, 0.0)),
            Ball(numbers, share * speed).on_wall(),
        ] {
            let fem = ["model.fem={}", "mesh.contact_element_size='0.1 mm'"];
            let warnings = simulation(&text, &fem).warnings_before();
            let says = warnings.iter().any(|warning| warning.contains("times that of the shear"));
            assert_eq!(says, is_told, "{share} {warnings:?}");
        }
    }
}
