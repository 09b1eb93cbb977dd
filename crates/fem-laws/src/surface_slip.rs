//! Compliance that slip between surfaces of unlike materials adds to Hertz' contact.
//!
//! A pressure p moves the surface of a half-space inward by what it encloses (Boussinesq's u_r = −tF/4πr of
//! a point force, as a field of sources in the plane; of Hertz' pressure Johnson, *Contact Mechanics*, 1985,
//! eq. 3.41b), and a traction q along r moves what it encloses down (Betti):
//!
//! ```math
//! u_r(r) = -\frac t{2r}\int_0^r p\,s\,\mathrm ds, \qquad
//! u_n(r) = -\frac t2\int_r^\infty q\,\mathrm ds, \qquad t = \frac{1-2\nu}\mu .
//! ```
//!
//! Bodies of the shares s_i of the contact's compliance meet on an interface of slope m = κr. Where their
//! surfaces slip by Δu_r the gap is wider by m Δu_r, and pressure normal to the interface has the traction
//! ±mp. With the radius r of a point of each body weighted by the shares, so that bending the interface does
//! no work in first order,
//!
//! ```math
//! m\,\Delta u_r + u_n = \tfrac12\kappa\,(t_2-t_1)\Bigl[\int_0^r p\,s\,\mathrm ds + \int_r^a p\,s\,\mathrm ds\Bigr]
//! = c\,F, \qquad
//! c = \frac{\kappa\,(t_2-t_1)}{4\pi}, \qquad \kappa = \frac{s_1}{R_2}-\frac{s_2}{R_1}
//! ```
//!
//! everywhere alike, body 1 below body 2. So in first order of a/R slip is a spring in series with Hertz'
//! contact, of the compliance c, which may be negative: radius and pressure go with the force as they do
//! without, and
//!
//! ```math
//! \delta = \delta_{\text{Hertz}} + cF, \qquad
//! \frac{\Delta F}F = -\frac34\,\frac{cF}\delta, \qquad
//! \frac{\Delta T}T = \frac{11}8\,\frac{\mathrm B(\frac85,\frac12)}{\mathrm B(\frac25,\frac12)}\,\frac{cF}\delta
//! = 0.566\,\frac{cF}\delta, \qquad \frac{cF}\delta = \frac4{3\pi}\,a\,|\kappa\beta|
//! ```
//!
//! of an impact, with Dundurs' β. The first follows from ½cF² added to Hertz' energy, the second from the
//! action ½c∫F²dt. Between like bodies t is the same, on a rigid plane κ = 0. Frictionless.
//!
//! Relaxing bodies have t of their moduli in Carson's transform: falling as 1/μ with constant ν, and
//! t = 3/(3K+μ) with an elastic bulk modulus. κ stays that of the instantaneous moduli.

use std::f64::consts::PI;

use fem_material::{ActsOn, Material, PronyTerm};
use statrs::function::beta::beta;

use crate::difference::RelativeError;
use crate::finite_size::correction::{Correction, RelaxingCorrection};
use crate::pair::compliance_shares;
use crate::pair_relaxation::PairRelaxation;

/// One of the two surfaces: its curvature and its compliance.
#[derive(Debug, Clone, PartialEq)]
pub struct SlipSurface {
    /// 1/m; 0 of a plane.
    curvature: f64,
    /// None of a rigid body.
    material: Option<Material>,
}

impl SlipSurface {
    /// Creates a surface of a curvature, 1/m, and a material; `None` is rigid.
    pub fn new(curvature: f64, material: Option<&Material>) -> Self {
        Self { curvature, material: material.cloned() }
    }

    /// Returns (1 − ν)/μ, 1/Pa.
    fn normal(&self) -> f64 {
        self.material.as_ref().map_or(0.0, |material| {
            let now = material.instantaneous();
            (1.0 - now.poissons_ratio()) / now.shear_modulus()
        })
    }

    /// Returns (1 − 2ν)/μ before any relaxation, 1/Pa.
    fn tangential(&self) -> f64 {
        self.material.as_ref().map_or(0.0, |material| tangential_compliance(material, 1.0))
    }

    /// Returns g_k t at s = −p_k of a term of the contact's relaxation.
    fn fading(&self, term: &PronyTerm) -> f64 {
        let Some(material) = &self.material else { return 0.0 };
        let left = material.relaxation().map_or(1.0, |series| {
            let rate = term.relaxation_time.recip();
            let terms = series.terms().iter().filter(|own| own.weight > 0.0);
            let decaying: f64 =
                terms.map(|own| own.weight * (rate / (rate - own.relaxation_time.recip()))).sum();
            series.equilibrium_weight() + decaying
        });
        let fading = term.weight * tangential_compliance(material, left);
        if fading.is_finite() { fading } else { 0.0 }
    }
}

/// Returns (1 − 2ν)/μ (1/Pa) after relaxation to a share of the shear modulus.
fn tangential_compliance(material: &Material, left: f64) -> f64 {
    let now = material.instantaneous();
    match material.relaxation().map(|series| series.acts_on()) {
        Some(ActsOn::Shear) => 3.0 / (3.0 * now.bulk_modulus() + left * now.shear_modulus()),
        Some(ActsOn::All) | None => now.tangential_compliance() / left,
    }
}

/// Slip of the surfaces of two bodies.
#[derive(Debug, Clone, PartialEq)]
pub struct SurfaceSlip {
    faces: [SlipSurface; 2],
    /// Curvature κ of the interface, 1/m.
    curvature: f64,
    /// Shares s of both bodies in the slip.
    shares: [f64; 2],
}

impl SurfaceSlip {
    /// Creates the slip of two bodies, the lower one first; at most one is rigid.
    pub fn new(faces: [SlipSurface; 2]) -> Self {
        let shares = compliance_shares(faces.each_ref().map(SlipSurface::normal));
        let curvature = shares[0] * faces[1].curvature - shares[1] * faces[0].curvature;
        Self { faces, curvature, shares }
    }

    /// Returns c before any relaxation, m/N; negative where the stiffer body is the more curved one.
    pub fn compliance(&self) -> f64 {
        let [lower, upper] = self.faces.each_ref().map(SlipSurface::tangential);
        self.compliance_of(upper - lower)
    }

    /// Returns κ of the interface, 1/m, positive if it rises from the axis outward.
    pub fn curvature(&self) -> f64 {
        self.curvature
    }

    /// Returns the shares s of the contact's compliance, lower body first.
    pub fn shares(&self) -> [f64; 2] {
        self.shares
    }

    /// Returns the compliance for t₂ − t₁, 1/Pa.
    fn compliance_of(&self, mismatch: f64) -> f64 {
        self.curvature * mismatch / (4.0 * PI)
    }

    /// Returns κβ, 1/m, with the sign of c.
    pub fn mismatch(&self) -> f64 {
        self.curvature * self.dundurs_beta()
    }

    /// Returns Dundurs' second parameter β before any relaxation, positive if the upper body's tangential compliance is the larger one.
    pub fn dundurs_beta(&self) -> f64 {
        let [lower, upper] = self.faces.each_ref().map(SlipSurface::tangential);
        let compliance: f64 = self.faces.iter().map(SlipSurface::normal).sum();
        0.5 * (upper - lower) / compliance
    }

    /// Returns the signed changes by slip of an elastic impact whose largest contact radius (m) is given.
    pub fn change(&self, contact_radius: f64) -> RelativeError {
        let share = 4.0 / (3.0 * PI) * contact_radius * self.mismatch();
        RelativeError {
            restitution: 0.0,
            contact_time: 11.0 / 8.0 * beta(1.6, 0.5) / beta(0.4, 0.5) * share,
            peak_force: -0.75 * share,
        }
    }

    /// Returns the correction in units of `length`, where the force is `force` u^(3/2) and relaxes as `relaxation`.
    pub(crate) fn correction(
        &self,
        length: f64,
        force: f64,
        relaxation: &PairRelaxation,
    ) -> RelaxingCorrection {
        let of = |mismatch: f64| Correction {
            alpha: force * self.compliance_of(mismatch) / length,
            beta: 0.0,
        };
        let terms = relaxation.terms().iter();
        let fading: Vec<_> = terms
            .map(|term| {
                let [lower, upper] = self.faces.each_ref().map(|face| face.fading(term));
                of(upper - lower)
            })
            .collect();
        let [lower, upper] = self.faces.each_ref().map(SlipSurface::tangential);
        let mut equilibrium = of(upper - lower);
        for fading in &fading {
            equilibrium.add(fading, -1.0);
        }
        RelaxingCorrection { equilibrium, fading }
    }
}

#[cfg(test)]
mod tests {
    use fem_material::{ElasticModuli, PronySeries};

    use super::*;
    use crate::hertz::HertzImpact;
    use crate::pair::{Pair, Partner};
    use crate::ting::Ting;

    const RADII: [f64; 2] = [20e-3, 2e-3];

    fn moduli(youngs_modulus: f64, nu: f64) -> ElasticModuli {
        ElasticModuli::from_youngs_modulus_poissons_ratio(youngs_modulus, nu).unwrap()
    }

    fn materials() -> [Material; 2] {
        [(1200.0, 3e9, 0.2), (7850.0, 206e9, 0.3)]
            .map(|(density, e, nu)| Material::new(density, moduli(e, nu), None).unwrap())
    }

    fn relaxing(material: &Material, acts_on: ActsOn, weight: f64) -> Material {
        let terms = vec![
            PronyTerm { weight: 0.3 * weight, relaxation_time: 1e-5 },
            PronyTerm { weight: 0.7 * weight, relaxation_time: 3e-4 },
        ];
        let series = PronySeries::new(terms, acts_on).unwrap();
        Material::new(material.density(), *material.instantaneous(), Some(series)).unwrap()
    }

    fn slip(materials: [&Material; 2]) -> SurfaceSlip {
        SurfaceSlip::new([0, 1].map(|i| SlipSurface::new(RADII[i].recip(), Some(materials[i]))))
    }

    fn pair(materials: [&Material; 2]) -> Pair {
        let [first, second] = [0, 1].map(|i| Partner::solid_sphere(2.0 * RADII[i], materials[i]));
        Pair::new(first, second).unwrap()
    }

    /// Under Hertz' pressure the surface moves inward by Johnson's eq. 3.41b, and slope and radial traction together
    /// change the gap by the same amount at every radius.
    #[test]
    fn slip_changes_the_gap_by_a_constant() {
        let [lower, upper] = materials();
        let both = slip([&lower, &upper]);
        let (a, p0) = (1.0, 1.0);
        let pressure = |r: f64| p0 * (1.0 - r * r / (a * a)).max(0.0).sqrt();
        let n = 20_000;
        let ring = |k: usize| a * (k as f64 + 0.5) / n as f64;
        let enclosed = |to: f64| -> f64 {
            let rings = (0..n).map(ring).take_while(|s| *s < to);
            rings.map(|s| pressure(s) * s * a / n as f64).sum()
        };
        let all = enclosed(a);
        let force = 2.0 / 3.0 * PI * a * a * p0;
        assert!((2.0 * PI * all / force - 1.0).abs() < 1e-6);
        for r in [0.2, 0.5, 0.9] {
            let inward = |face: &SlipSurface| 0.5 * face.tangential() / r * enclosed(r);
            for (face, material) in both.faces.iter().zip([&lower, &upper]) {
                let (e, nu) = (
                    material.instantaneous().youngs_modulus(),
                    material.instantaneous().poissons_ratio(),
                );
                let johnson = (1.0 - 2.0 * nu) * (1.0 + nu) / (3.0 * e) * a * a / r
                    * p0
                    * (1.0 - (1.0 - r * r / (a * a)).powf(1.5));
                // The width of a ring.
                assert!((inward(face) / johnson - 1.0).abs() < 1e-3, "{r}");
            }
            // u_r of the lower less that of the upper body, by the slope, and what the traction ∓κ r p
            // along r of each moves down, outside of r.
            let slope = both.curvature * r;
            let [below, above] = both.faces.each_ref().map(inward);
            let outside = both.curvature * (all - enclosed(r));
            let [lower, upper] =
                both.faces.each_ref().map(|face| 0.5 * face.tangential() * outside);
            let gap = slope * (above - below) + (upper - lower);
            assert!((gap / (both.compliance() * force) - 1.0).abs() < 1e-3, "{r}: {gap:e}");
        }
    }

    /// Nothing between like materials, against a wall, or with Dundurs' β = 0; the order of the bodies is
    /// no matter; a stiffer body that is the more curved one makes the contact stiffer.
    #[test]
    fn slip_compliance_vanishes_for_like_bodies_and_has_the_right_sign() {
        let [soft, hard] = materials();
        let [a, b] = [1.0, 2.0];
        let of = |first: (f64, Option<&Material>), second: (f64, Option<&Material>)| {
            SurfaceSlip::new([first, second].map(|(c, m)| SlipSurface::new(c, m))).compliance()
        };
        assert_eq!(of((a, Some(&soft)), (b, Some(&soft))), 0.0);
        assert_eq!(of((0.0, None), (b, Some(&soft))), 0.0);
        assert_eq!(of((a, Some(&soft)), (b, Some(&hard))), of((b, Some(&hard)), (a, Some(&soft))));
        assert!(of((a, Some(&soft)), (b, Some(&hard))) < 0.0);
        assert!(of((0.0, Some(&soft)), (b, Some(&hard))) < 0.0);
        // A rigid sphere is the limit of a stiff one.
        let rigid = of((a, Some(&soft)), (b, None));
        let stiff = Material::new(1.0, moduli(1e18, 0.3), None).unwrap();
        assert!((of((a, Some(&soft)), (b, Some(&stiff))) / rigid - 1.0).abs() < 1e-7);
        let incompressible = Material::new(1.0, moduli(3e9, 0.499_999), None).unwrap();
        assert!(of((a, Some(&incompressible)), (b, None)).abs() < 1e-5 * rigid.abs());
        // The numbers: κ = −2/m of a rigid sphere of half a metre, t = 0.6/1.25 GPa.
        assert!((rigid / (-2.0 * 0.48e-9 / (4.0 * PI)) - 1.0).abs() < 1e-12);
    }

    /// The first order of an impact that is followed in time with the spring c in series.
    #[test]
    fn the_change_of_an_impact_is_that_of_a_spring_in_series() {
        let [lower, upper] = materials();
        let (pair, slip) = (pair([&lower, &upper]), slip([&lower, &upper]));
        let relaxation = PairRelaxation::new(Some(&lower), Some(&upper)).unwrap();
        let speed = 1e-3;
        let hertz = HertzImpact::new(&pair, speed).unwrap();
        let impact = Ting::new(&pair, relaxation).with_surface_slip(slip.clone());
        let impact = impact.with_tolerance(1e-10).unwrap().impact(speed).unwrap();
        let change = slip.change(hertz.max_contact_radius());
        let share = slip.compliance() * hertz.peak_force() / hertz.max_approach();
        assert!(change.contact_time < -1e-4 && change.peak_force > 1e-4, "{change:?}");
        assert!((change.peak_force / (-0.75 * share) - 1.0).abs() < 1e-9);
        assert!((change.contact_time / (0.565_6 * share) - 1.0).abs() < 1e-4);
        let time = impact.contact_time.unwrap() / hertz.contact_time() - 1.0;
        let force = impact.peak_force / hertz.peak_force() - 1.0;
        // The next order is of the share's size, 1e-3.
        assert!((time / change.contact_time - 1.0).abs() < 3e-3, "{time:e} {change:?}");
        assert!((force / change.peak_force - 1.0).abs() < 3e-3, "{force:e} {change:?}");
        assert!((impact.restitution - 1.0).abs() < 1e-9);
    }

    /// Long after a step the spring is that of the relaxed moduli over the relaxed contact; of bodies that
    /// relax alike with constant ν it follows the contact.
    #[test]
    fn the_spring_relaxes_with_its_bodies() {
        let [lower, upper] = materials();
        for acts_on in [ActsOn::All, ActsOn::Shear] {
            let soft = relaxing(&lower, acts_on, 0.6);
            let both = slip([&soft, &upper]);
            let relaxation = PairRelaxation::new(Some(&soft), Some(&upper)).unwrap();
            let found = both.correction(1.0, 1.0, &relaxation);
            let at_rest = slip([&soft.at_equilibrium().unwrap(), &upper]);
            let [t1, t2] = at_rest.faces.each_ref().map(SlipSurface::tangential);
            let expected = both.compliance_of(t2 - t1) * relaxation.equilibrium_weight();
            let equilibrium = found.equilibrium.alpha;
            assert!((equilibrium / expected - 1.0).abs() < 1e-12, "{equilibrium:e} {expected:e}");
            let all: f64 = found.fading.iter().map(|fading| fading.alpha).sum();
            assert!(((equilibrium + all) / both.compliance() - 1.0).abs() < 1e-12);
        }
        let alike = [&lower, &upper].map(|material| relaxing(material, ActsOn::All, 0.6));
        let both = slip(alike.each_ref());
        let relaxation = PairRelaxation::new(Some(&alike[0]), Some(&alike[1])).unwrap();
        let found = both.correction(1.0, 1.0, &relaxation);
        for fading in &found.fading {
            assert!(fading.alpha.abs() < 1e-12 * both.compliance().abs(), "{fading:?}");
        }
        assert!((found.equilibrium.alpha / both.compliance() - 1.0).abs() < 1e-12);
    }
}
