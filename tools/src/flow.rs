//! Steel balls that flow plastically on a rigid wall, from the speed of first yield v_y on: the restitution, the plastic work,
//! and the elastic energy that stays locked in. `cargo run --release -p fem-tools -- flow 8` takes eight
//! elements per contact radius.

use std::f64::consts::PI;

use crate::Error;
use fem_collision::{Account, Approach, BodyInput, Expectation, OutputRequest};
use fem_explicit::{ExplicitBodies, ModelParts, Settings, collide};
use fem_material::finite::HyperelasticLaw;
use fem_material::{ElasticModuli, FlowRule, Material};
use fem_mesh::{HalfDisc, Side};

/// Radius, m; density, kg/m³; Young's modulus and yield strength, Pa; Poisson's ratio.
const RADIUS: f64 = 5e-3;
const DENSITY: f64 = 7800.0;
const YOUNGS_MODULUS: f64 = 207e9;
const YIELD_STRENGTH: f64 = 1e9;
const NU: f64 = 0.3;

/// Prints one line per speed.
pub fn run(words: &[String]) -> Result<(), Error> {
    let elements_per_radius = words.first().map_or(Ok(8.0), |text| text.parse())?;
    let contact_modulus = YOUNGS_MODULUS / (1.0 - NU * NU);
    // Johnson (1985), Contact Mechanics, section 11.5: p0 = 1.6 Y.
    let ratio = YIELD_STRENGTH / contact_modulus;
    let yield_speed = (26.0 * ratio.powi(4) * YIELD_STRENGTH / DENSITY).sqrt();
    println!(" v/v_y  restitution  plastic work  locked in   residual    steps  elements");
    for times in [1.0, 1.5, 2.0, 5.0, 10.0, 100.0] {
        let speed = times * yield_speed;
        let energy = 2.0 / 3.0 * PI * RADIUS.powi(3) * DENSITY * speed * speed;
        let approach = (15.0 * energy / (8.0 * RADIUS.sqrt() * contact_modulus)).powf(0.4);
        let plastic = (4.0 * RADIUS * energy / (3.0 * PI * YIELD_STRENGTH)).powf(0.25);
        let radius = plastic.min((RADIUS * approach).sqrt());
        let disc = HalfDisc {
            radius: RADIUS,
            contact_element_size: radius / elements_per_radius,
            refined_radius: 1.5 * radius,
            growth: None,
            edge: None,
        };
        let mesh = disc.build()?.on_side(Side::Above);
        let n_elements = mesh.quads().len();
        let moduli = ElasticModuli::from_youngs_modulus_poissons_ratio(YOUNGS_MODULUS, NU)?;
        let material = Material::new(DENSITY, moduli, None)?;
        let material = material.with_flow(FlowRule::perfect(YIELD_STRENGTH)?)?;
        let settings = Settings {
            contact_stiffness: 20.0 * contact_modulus,
            candidate_radius: 2.5 * radius,
            step_factor: 0.9,
            mass_scaling: 2e-4,
            mass_times: [1.0; 2],
        };
        let parts = ModelParts {
            finite_strain: [None, Some(HyperelasticLaw::Hencky)],
            finite_strain_within: Some(3.0 * radius),
            ..ModelParts::default()
        };
        let bodies = [BodyInput::Wall, BodyInput::Sphere { mesh, material }];
        let approaching = Approach::new([0.0, -speed], 0.0)?;
        let model = ExplicitBodies::with_parts(bodies, approaching, &settings, parts)?;
        let expected = Expectation { contact_time: 2.943 * approach / speed, approach };
        let run = collide(&model, expected, &OutputRequest::history(), &mut ());
        let share = |account| run.energies.get(account).map(|part| part / energy);
        println!(
            "{times:6.1} {:12.5} {:13.5} {:10.5} {:10.1e} {:8} {n_elements:9}",
            run.restitution.unwrap_or(f64::NAN),
            share(Account::PlasticWork).unwrap_or(f64::NAN),
            share(Account::Strain).unwrap_or(f64::NAN),
            run.residual_relative.unwrap_or(f64::NAN),
            run.steps.unwrap_or_default(),
        );
    }
    Ok(())
}
