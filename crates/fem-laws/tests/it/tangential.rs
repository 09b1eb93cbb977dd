//! Oblique impacts of spheres with friction.

use fem_laws::{
    FiniteSize, HertzImpact, Impact, NormalSprings, Pair, PairRelaxation, Partner,
    TangentialContact, Ting,
};
use fem_material::{ActsOn, ElasticModuli, Material, PronySeries, PronyTerm};

const FRICTION: f64 = 0.1;

fn material(nu: f64, relaxation: Option<PronySeries>) -> Material {
    let moduli = ElasticModuli::from_youngs_modulus_poissons_ratio(70e9, nu).unwrap();
    Material::new(2500.0, moduli, relaxation).unwrap()
}

/// Like spheres at 1 m/s with the friction 0.1.
struct Like {
    contact: TangentialContact,
    normal: NormalSprings,
    impact: Impact,
    /// k_t/k_n and χ.
    ratio: f64,
    chi: f64,
}

impl Like {
    fn new(nu: f64, n_steps: usize) -> Self {
        Self::of(material(nu, None), n_steps, None)
    }

    /// `chi` other than that of spheres by a mass of the patch other than theirs.
    fn of(material: Material, n_steps: usize, chi: Option<f64>) -> Self {
        let sphere = Partner::solid_sphere(0.01, &material);
        let pair = Pair::new(sphere, sphere).unwrap();
        let relaxation = PairRelaxation::new(Some(&material), Some(&material)).unwrap();
        let impact = match material.relaxation() {
            None => HertzImpact::new(&pair, 1.0).unwrap().impact(),
            Some(_) => Ting::new(&pair, relaxation.clone()).impact(1.0).unwrap(),
        };
        let normal =
            NormalSprings::of_impact(&impact, &pair, &relaxation, None, 0.0, n_steps).unwrap();
        let bodies = [Some(&material); 2];
        let ratio =
            PairRelaxation::tangential(bodies[0], bodies[1]).unwrap().0 / pair.contact_modulus();
        let chi = chi.unwrap_or(1.75 * ratio);
        let mass = 0.5 * pair.effective_mass() * ratio / chi;
        let contact = TangentialContact::new(bodies, mass, FRICTION).unwrap();
        Self { contact, normal, impact, ratio, chi }
    }

    /// ψ₂ of ψ₁.
    fn rebound(&self, psi: f64) -> f64 {
        let unit = FRICTION / self.ratio;
        let impact = self.contact.impact(&self.normal, psi * unit);
        let energy = psi * psi;
        assert!(impact.residual < 1e-12 * energy, "{psi} {}", impact.residual);
        impact.velocity / unit
    }
}

#[test]
fn probe() {
    let started = std::time::Instant::now();
    let like = Like::new(0.3, 400);
    println!("normal {:?}", started.elapsed());
    let started = std::time::Instant::now();
    println!("{}", like.rebound(2.0));
    println!("tangential {:?}", started.elapsed());
    for n in [200, 400, 800, 1600, 3200] {
        println!("{n}");
        for (chi, limit, stick) in
            [(1.0, -0.375, -0.5589865), (1.4412, 0.232, -0.7847582), (1.75, 0.387, -0.8327618)]
        {
            let like = Like::of(material(0.3, None), n, Some(chi));
            let unit = FRICTION / like.ratio;
            let et = like.rebound(1e-3) / 1e-3;
            let contact = like.contact.clone().with_friction(1e6);
            let at = contact
                .impact(&like.normal, unit)
                .history
                .iter()
                .max_by(|a, b| {
                    a.time
                        .min(like.impact.contact_time.unwrap() - a.time)
                        .total_cmp(&b.time.min(like.impact.contact_time.unwrap() - b.time))
                })
                .unwrap()
                .velocity
                / unit;
            println!("{chi} {} {}", et - limit, at - stick);
        }
    }
    for weights in [
        vec![(0.3, 1e-6)],
        vec![(0.2, 1e-6), (0.3, 1e-5), (0.3, 1e-3)],
        vec![(0.3, 1e-12)],
        vec![(0.3, 1e3)],
    ] {
        for acts in [ActsOn::All, ActsOn::Shear] {
            let terms = weights
                .iter()
                .map(|(weight, relaxation_time)| PronyTerm {
                    weight: *weight,
                    relaxation_time: *relaxation_time,
                })
                .collect();
            let m = material(0.3, Some(PronySeries::new(terms, acts).unwrap()));
            let started = std::time::Instant::now();
            let like = Like::of(m, 400, None);
            let took = started.elapsed();
            let started = std::time::Instant::now();
            let values = [0.1, 1.0, 3.0].map(|psi| like.rebound(psi));
            println!(
                "{weights:?} {acts:?} e {} {values:?} {took:?} {:?} T {}",
                like.impact.restitution,
                started.elapsed() / 3,
                like.impact.contact_time.unwrap()
            );
        }
    }
    let _ = FiniteSize::MAX_CONTACT_RATIO;
    let like = Like::new(0.3, 400);
    println!("{:?} chi {}", [0.1, 1.0, 3.0].map(|psi| like.rebound(psi)), like.chi);
}
