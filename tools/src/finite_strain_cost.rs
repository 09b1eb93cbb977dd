//! Cost of an element update at finite strain over that at small strain, of one body that vibrates: `cargo run
//! --release -p fem-tools -- finite_strain_cost`. It prints one line per law: nanoseconds (the least of
//! many turns, in which all laws alternate), and the ratio.

use std::time::Instant;

use crate::Error;
use fem_explicit::FreeMotion;
use fem_material::finite::HyperelasticLaw;
use fem_material::{ActsOn, ElasticModuli, Material, PronySeries, PronyTerm};
use fem_mesh::HalfDisc;

const TURNS: u32 = 200;
const STEPS_A_TURN: u32 = 40;

/// A body and the least time that an element of it took, ns.
struct Timed {
    name: String,
    sphere: FreeMotion,
    least: f64,
}

impl Timed {
    fn new(
        disc: &HalfDisc,
        material: &Material,
        law: Option<HyperelasticLaw>,
    ) -> Result<Self, Error> {
        let mesh = disc.build()?;
        let mut sphere = match law {
            None => FreeMotion::new(mesh, material, 0.9)?,
            Some(law) => FreeMotion::at_finite_strain(mesh, material, law, 0.9)?,
        };
        sphere.set_velocity(|[r, y]| [r, y - disc.radius]);
        let n_terms = material.relaxation().map_or(0, |series| series.terms().len());
        let name = law.map_or("small strain", HyperelasticLaw::name);
        Ok(Self { name: format!("{name}, {n_terms} terms"), sphere, least: f64::INFINITY })
    }

    fn take_turn(&mut self) {
        let start = Instant::now();
        for _ in 0..STEPS_A_TURN {
            self.sphere.step();
        }
        let updates = f64::from(STEPS_A_TURN) * self.sphere.body().n_elements() as f64;
        self.least = self.least.min(1e9 * start.elapsed().as_secs_f64() / updates);
    }
}

/// Prints the cost of each law.
pub fn run(_: &[String]) -> Result<(), Error> {
    // The default mesh of the glass pair's larger sphere.
    let disc = HalfDisc {
        radius: 11.1e-3,
        contact_element_size: 28e-6,
        refined_radius: 0.27e-3,
        growth: None,
        edge: None,
    };
    let moduli = ElasticModuli::from_youngs_modulus_poissons_ratio(63e9, 0.244)?;
    let relaxing = |weights: &[f64]| {
        let term = |&weight: &f64| PronyTerm { weight, relaxation_time: 1e-4 * weight };
        PronySeries::new(weights.iter().map(term).collect(), ActsOn::All)
    };
    for relaxation in [None, Some(relaxing(&[0.5])?), Some(relaxing(&[0.4, 0.3, 0.2])?)] {
        let glass = Material::new(2390.0, moduli, relaxation)?;
        let laws = std::iter::once(None).chain(HyperelasticLaw::ALL.map(Some));
        let mut all: Vec<_> =
            laws.map(|law| Timed::new(&disc, &glass, law)).collect::<Result<_, _>>()?;
        for _ in 0..TURNS {
            all.iter_mut().for_each(Timed::take_turn);
        }
        for Timed { name, least, .. } in &all {
            println!("{name:35} {least:7.2} ns {:6.2}", least / all[0].least);
        }
    }
    Ok(())
}
