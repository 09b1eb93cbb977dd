//! Small collisions of every kind, for work on this crate alone: it builds in seconds, where the command takes minutes.
//! `cargo run -p fem-explicit --example scenes` prints, for each scene, the restitution, the steps and a digest of
//! all numbers of the result, which a change of the code that should not change results leaves as it is.

#![allow(clippy::disallowed_macros, reason = "an example prints what it computes")]

use fem_collision::{Approach, BodyInput, Expectation, OutputRequest, SnapshotRequest};
use fem_explicit::{
    BulkViscosity, ExplicitBodies, ModelParts, NodeForce, Settings, SmallStrainContact,
    ViscosityCoefficients, Weight, collide,
};
use fem_material::finite::HyperelasticLaw;
use fem_material::{ActsOn, ElasticModuli, Material, PronySeries, PronyTerm};
use fem_mesh::{HalfDisc, Side};

type Error = Box<dyn std::error::Error>;

/// A pair of spheres, or a sphere on a wall, with its parts.
struct Scene {
    name: &'static str,
    materials: [Material; 2],
    on_wall: bool,
    speed: f64,
    parts: ModelParts,
}

fn material(youngs_modulus: f64, terms: &[f64], acts_on: ActsOn) -> Result<Material, Error> {
    let moduli = ElasticModuli::from_youngs_modulus_poissons_ratio(youngs_modulus, 0.244)?;
    let term = |&weight: &f64| PronyTerm { weight, relaxation_time: 1e-4 * weight };
    let series = (!terms.is_empty())
        .then(|| PronySeries::new(terms.iter().map(term).collect(), acts_on))
        .transpose()?;
    Ok(Material::new(2390.0, moduli, series)?)
}

fn input(material: Material, side: Side) -> Result<BodyInput, Error> {
    let disc = HalfDisc {
        radius: 10e-3,
        contact_element_size: 0.15e-3,
        refined_radius: 0.5e-3,
        growth: None,
        edge: None,
    };
    Ok(BodyInput::Sphere { mesh: disc.build()?.on_side(side), material })
}

impl Scene {
    fn run(self) -> Result<(), Error> {
        let [lower, upper] = self.materials;
        let modulus = lower.instantaneous().youngs_modulus();
        let lower = if self.on_wall { BodyInput::Wall } else { input(lower, Side::Below)? };
        let bodies = [lower, input(upper, Side::Above)?];
        let settings = Settings {
            contact_stiffness: 10.0 * modulus,
            candidate_radius: 1.2e-3,
            step_factor: 0.9,
            mass_scaling: 2e-4,
            mass_times: [1.0; 2],
        };
        let approach = Approach::new([0.0, -self.speed], 0.0)?;
        let model = ExplicitBodies::with_parts(bodies, approach, &settings, self.parts)?;
        let hertz = 80e-6 * (0.5 / self.speed).powf(0.2) * (63e9 / modulus).powf(0.4);
        let expected = Expectation { contact_time: hertz, approach: 0.3 * self.speed * hertz };
        let request =
            OutputRequest { snapshots: SnapshotRequest::Count(4), ..OutputRequest::history() };
        let collision = collide(&model, expected, &request, &mut ());
        let bytes = postcard::to_allocvec(&collision)?;
        let digest = bytes.iter().fold(0xcbf2_9ce4_8422_2325_u64, |digest, &byte| {
            (digest ^ u64::from(byte)).wrapping_mul(0x0100_0000_01b3)
        });
        let steps = collision.steps.unwrap_or_default();
        let restitution = collision.restitution.unwrap_or(f64::NAN);
        println!("{:40} {restitution:9.6} {steps:7} {digest:016x}", self.name);
        Ok(())
    }
}

fn main() -> Result<(), Error> {
    let glass = || material(63e9, &[], ActsOn::All);
    let relaxing = |acts_on| material(63e9, &[0.4, 0.3], acts_on);
    let at_finite_strain = |law, within| ModelParts {
        finite_strain: [Some(law), Some(law)],
        finite_strain_within: within,
        ..ModelParts::default()
    };
    let scene = |name, material: Material, parts| Scene {
        name,
        materials: [material.clone(), material],
        on_wall: false,
        speed: 0.5,
        parts,
    };
    let method = |method| ModelParts { method, penalty_factor: 1.0, ..ModelParts::default() };
    scene("penalty springs", glass()?, method(SmallStrainContact::Penalty)).run()?;
    scene("node to surface", glass()?, method(SmallStrainContact::NodeToSurface)).run()?;
    scene("massless boundary", glass()?, method(SmallStrainContact::Massless)).run()?;
    let massless = || method(SmallStrainContact::Massless);
    scene("all moduli relax", relaxing(ActsOn::All)?, massless()).run()?;
    scene("shear relaxes", relaxing(ActsOn::Shear)?, massless()).run()?;
    let unlike = |name, method| -> Result<Scene, Error> {
        let materials = [material(63e9, &[], ActsOn::All)?, material(6e9, &[], ActsOn::All)?];
        let parts =
            ModelParts { surface_slip: true, method, penalty_factor: 1.0, ..ModelParts::default() };
        Ok(Scene { name, materials, on_wall: false, speed: 0.5, parts })
    };
    unlike("slipping surfaces, massless", SmallStrainContact::Massless)?.run()?;
    unlike("slipping surfaces, penalty", SmallStrainContact::Penalty)?.run()?;
    let mut with_forces = method(SmallStrainContact::Massless);
    let BodyInput::Sphere { mesh, material: of_mesh } = input(glass()?, Side::Above)? else {
        return Err("a sphere has a mesh".into());
    };
    let usual = ViscosityCoefficients::default();
    let viscosity = BulkViscosity::new(&mesh, &of_mesh, usual, 5.0)?;
    let forces: [Box<dyn NodeForce>; 2] = [Box::new(Weight::new(9.81)), Box::new(viscosity)];
    with_forces.node_forces[1].extend(forces);
    let on_wall =
        Scene { on_wall: true, ..scene("wall, weight, viscosity", glass()?, with_forces) };
    on_wall.run()?;
    for (name, law) in [
        ("neo-Hooke", HyperelasticLaw::NeoHooke),
        ("Saint Venant-Kirchhoff", HyperelasticLaw::SaintVenantKirchhoff),
        ("Hencky", HyperelasticLaw::Hencky),
    ] {
        Scene { speed: 50.0, ..scene(name, glass()?, at_finite_strain(law, None)) }.run()?;
    }
    let law = HyperelasticLaw::NeoHooke;
    let near = at_finite_strain(law, Some(1e-3));
    Scene { speed: 5.0, ..scene("neo-Hooke within 1 mm", glass()?, near) }.run()?;
    for (name, terms) in [("one relaxing term", &[0.5][..]), ("two relaxing terms", &[0.4, 0.3])] {
        let soft = material(63e9, terms, ActsOn::Shear)?;
        let near = at_finite_strain(law, Some(1e-3));
        Scene { speed: 5.0, ..scene(name, soft, near) }.run()?;
    }
    Ok(())
}
