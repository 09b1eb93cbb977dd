//! Collisions of bodies that flow plastically.

use fem_collision::{Account, BodyInput, Collision, OutputRequest};
use fem_explicit::{ModelParts, collide};
use fem_material::FlowRule;
use fem_material::finite::HyperelasticLaw;
use fem_mesh::Side;

use crate::common::{
    Hertz, elastic, falling, settings, sphere, sphere_mass, upper_at_finite_strain,
};

/// A steel ball on a rigid wall: m, Pa, kg/m³.
const RADIUS: f64 = 5e-3;
const YIELD: f64 = 1e9;
const DENSITY: f64 = 7800.0;
const YOUNGS_MODULUS: f64 = 207e9;
const NU: f64 = 0.3;

fn contact_modulus() -> f64 {
    YOUNGS_MODULUS / (1.0 - NU * NU)
}

/// The speed of first yield, where p0 = 1.6 Y: v² = 26 (Y/E*)⁴ Y/ρ (Johnson 1985, Contact Mechanics, section 11.5).
fn yield_speed() -> f64 {
    (26.0 * (YIELD / contact_modulus()).powi(4) * YIELD / DENSITY).sqrt()
}

/// The collision at a speed, with five elements per contact radius of a mean pressure of 3 Y, or of Hertz if that is
/// smaller.
fn collision(speed: f64) -> Collision {
    let material = elastic(YOUNGS_MODULUS, NU, DENSITY);
    let material = material.with_flow(FlowRule::perfect(YIELD).unwrap()).unwrap();
    let mass = sphere_mass(RADIUS, DENSITY);
    let energy = 0.5 * mass * speed * speed;
    let hertz = Hertz::new(RADIUS, mass, contact_modulus(), speed);
    let plastic = (4.0 * RADIUS * energy / (3.0 * std::f64::consts::PI * YIELD)).powf(0.25);
    let radius = plastic.min(hertz.contact_radius);
    let mesh = sphere(RADIUS, radius / 5.0, 1.5 * radius, Side::Above);
    let settings = settings(20.0 * contact_modulus(), 2.5 * radius);
    let parts = ModelParts {
        finite_strain_within: Some(3.0 * radius),
        ..upper_at_finite_strain(Some(HyperelasticLaw::Hencky))
    };
    let bodies = [BodyInput::Wall, BodyInput::Sphere { mesh, material }];
    let model = falling(bodies, speed, &settings, parts);
    collide(&model, hertz.expected(), &OutputRequest::history(), &mut ())
}

/// Below first yield nothing is dissipated; above it the loss is plastic work, and energy and momentum balance. Five times
/// the speed of first yield keeps 0.91 of the speed; a mesh of five elements a contact radius is 0.03 off.
#[test]
fn a_steel_ball_loses_energy_from_first_yield_on() {
    for (times, least, most) in [(0.8, 0.9985, 1.0), (5.0, 0.88, 0.94), (50.0, 0.55, 0.75)] {
        let run = collision(times * yield_speed());
        let (residual, momentum) =
            (run.residual_relative.unwrap(), run.momentum_residual_relative.unwrap());
        assert!(residual < 1e-4 && momentum < 1e-12, "{times}: {residual:e} {momentum:e}");
        let restitution = run.restitution.unwrap();
        assert!((least..=most).contains(&restitution), "{times}: {restitution}");
        let work = run.energies.get(Account::PlasticWork).unwrap();
        let initial = run.initial_energy.unwrap();
        // What is not kinetic is plastic work, and some per cent of it elastic energy of residual stress.
        let lost = 1.0 - restitution * restitution;
        assert!((lost - work / initial).abs() < 0.08 && work / initial < lost + 1e-3, "{times}");
    }
}
