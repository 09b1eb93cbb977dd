//! Effect of finite strain on one body of a collision.

use fem_case::Scene;
use fem_explicit::MAX_FINITE_STRAIN_TERMS;
use fem_material::Material;
use fem_material::finite::{AxisymmetricTensor, Hyperelastic, HyperelasticLaw};

use super::departure::{Deformation, Departure, FLATTEST};
use crate::estimate::Estimate;

/// Largest Poisson's ratio that elements can compute at large strain. Its time step is a seventh of that at 0.495, with
/// K = 5000 G as for natural rubber; beyond it the volume is nearly fixed and the time step vanishes.
const MAX_POISSONS_RATIO: f64 = 0.4999;
/// Change over the tolerance below which a body stays at small strain.
const OWN_SHARE: f64 = 0.1;

/// A deformable body to which finite strain matters.
pub(super) struct BodyStrain<'a> {
    pub name: &'a str,
    pub material: &'a Material,
    /// Share of the contact's compliance.
    pub share: f64,
    pub deformation: Deformation,
    /// Change of the collision by the body's own strain, elastic and without waves.
    pub departure: Departure,
}

impl<'a> BodyStrain<'a> {
    /// Returns both bodies of a scene, with `None` for a rigid one.
    pub fn of_both(scene: &'a Scene, estimate: &Estimate) -> [Option<Self>; 2] {
        let shares = scene.compliance_shares();
        let radius = estimate.strain * estimate.hertz.pair().effective_radius();
        [0, 1].map(|side: usize| {
            let (body, share) = (&scene.bodies()[side], shares[side]);
            let material = body.material()?;
            let flatness = body.diameter().map_or(0.0, |diameter| 2.0 * radius / diameter);
            let strain = share * estimate.strain;
            let deformation = Deformation { strain, flatness: flatness.max(strain) };
            let nu = material.instantaneous().poissons_ratio();
            let laws = [Some(material.law()), None];
            let departure = share * Departure::up_to(laws, nu, deformation);
            Some(Self { name: body.name(), material, share, deformation, departure })
        })
    }

    /// Returns the hyperelastic laws that the case leaves open.
    pub fn possible_laws(&self) -> Vec<HyperelasticLaw> {
        let is_given = self.material.named_law().is_some() || self.material.flow().is_some();
        if is_given { vec![self.material.law()] } else { HyperelasticLaw::ALL.to_vec() }
    }

    /// Returns whether the body is flatter than all reference spheres, so that there is no estimate.
    pub fn is_beyond(&self) -> bool {
        self.deformation.flatness > FLATTEST
    }

    /// Returns the spread of the contact time over the possible laws, as a share.
    pub fn spread(&self) -> f64 {
        let nu = self.material.instantaneous().poissons_ratio();
        let times = self.possible_laws().into_iter();
        let times = times.map(|law| Departure::of(law, nu, self.deformation).contact_time);
        let (least, most) =
            times.fold((f64::INFINITY, f64::NEG_INFINITY), |(a, b), t| (a.min(t), b.max(t)));
        self.share * (most - least)
    }

    /// Returns the largest difference of a possible law from the computed one; `None` is small strain.
    pub fn law_error(&self, computed: Option<HyperelasticLaw>) -> Departure {
        let nu = self.material.instantaneous().poissons_ratio();
        let laws = self.possible_laws().into_iter();
        let each = laws.map(|law| Departure::up_to([Some(law), computed], nu, self.deformation));
        self.share * each.fold(Departure::default(), Departure::or)
    }

    /// Returns whether the law loses ellipticity at the linear strain under the middle of Hertz' contact, σ_yy = −p and
    /// σ_rr = σ_θθ = −(½ + ν) p (Johnson 1985, section 3.4).
    pub fn is_unstable(&self, pressure: f64) -> bool {
        // Flow bounds the stress of a body.
        if self.material.law().is_always_elliptic() || self.material.flow().is_some() {
            return false;
        }
        let moduli = self.material.instantaneous();
        let (nu, pressed) = (moduli.poissons_ratio(), pressure / moduli.youngs_modulus());
        let beside = (0.5 + nu) * pressed;
        let (yy, rr) = (2.0 * nu * beside - pressed, nu * (pressed + beside) - beside);
        let strain = AxisymmetricTensor { rr, yy, tt: rr, ry: 0.0, yr: 0.0 };
        let stiffness =
            Hyperelastic::new(self.material.law(), moduli).least_acoustic_stiffness(&strain);
        // A strain that inverts the material counts as unstable.
        !stiffness.is_ok_and(|stiffness| stiffness > 0.0)
    }

    /// Returns whether elements can compute the body at large strain.
    pub fn is_supported(&self) -> bool {
        // A ratio that follows from two moduli is rounded.
        let nu = self.material.instantaneous().poissons_ratio();
        nu <= MAX_POISSONS_RATIO + 1e-9 && self.n_terms() <= MAX_FINITE_STRAIN_TERMS
    }

    /// Returns the number of Prony terms with a history.
    pub fn n_terms(&self) -> usize {
        self.material.relaxation().map_or(0, |series| series.terms().len())
    }

    pub fn why_unsupported(&self) -> String {
        let n_terms = self.n_terms();
        if n_terms > MAX_FINITE_STRAIN_TERMS {
            return format!(
                "{} relaxes with {n_terms} terms, but elements support only {MAX_FINITE_STRAIN_TERMS} at \
                 large strain",
                self.name
            );
        }
        let nu = (self.material.instantaneous().poissons_ratio() * 1e9).round() / 1e9;
        format!(
            "Poisson's ratio {nu} of {} is above {MAX_POISSONS_RATIO}, the largest that elements \
             support at large strain",
            self.name
        )
    }

    /// Returns whether finite strain of the body is worth its cost.
    pub fn matters(&self, scene: &Scene) -> bool {
        self.departure.over(&scene.accuracy()) > OWN_SHARE
    }
}
