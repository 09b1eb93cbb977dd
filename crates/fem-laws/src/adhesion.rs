//! Adhesion of two elastic spheres: the speed below which they stick, and their impact above it.
//!
//! **Soft or large spheres** follow Johnson, Kendall and Roberts (1971; Johnson, *Contact Mechanics*, section 5.5). With the
//! work of adhesion Γ, force and approach at the contact radius a are
//!
//! ```math
//! P = \frac{4E^*a^3}{3R^*} - \sqrt{8\pi\Gamma E^*a^3}, \qquad
//! \delta = \frac{a^2}{R^*} - \sqrt{\frac{2\pi\Gamma a}{E^*}} .
//! ```
//!
//! The spheres snap into contact at δ = 0 and separate where dδ/da = 0. The integral of P dδ between the two is the energy that
//! an impact loses,
//!
//! ```math
//! W = (2\pi)^{5/3}\left(\tfrac3{10} + \tfrac15 2^{-8/3}\right)\left(\frac{\Gamma^5R^{*4}}{E^{*2}}\right)^{1/3}
//! = 7.0922\left(\frac{\Gamma^5R^{*4}}{E^{*2}}\right)^{1/3}, \qquad v_s = \sqrt{2W/m^*},
//! ```
//!
//! the 7.09 of Thornton and Ning (1998, *Powder Technology* 99, 154, eqs. 52 to 57). They stick below v_s. Losses of other
//! kinds are added (eq. 78), e² = e₀² − (v_s/v)².
//!
//! **Hard or small spheres** hardly deform. Derjaguin's approximation, F = 2πR* w(z), with the Lennard–Jones energy
//! w = Γ/3 [4(z₀/z)² − (z₀/z)⁸] gives the depth of their well. Its bottom is where F = 0, at z₀/4^(1/6),
//!
//! ```math
//! W = \int_{z_0/4^{1/6}}^\infty F\,\mathrm dz = 2\pi\,\tfrac87\,4^{1/6}\,R^*\Gamma z_0 = 2\pi\cdot1.4399\,R^*\Gamma z_0 .
//! ```
//!
//! In units of R*Γz₀ the first is 7.09 μ with Tabor's number μ = (R*Γ²/E*²z₀³)^(1/3), so they cross at μ = 1.28, where the
//! jump into contact begins. The larger one holds on either side. For hard spheres the attraction itself is reversible: any
//! other loss keeps spheres together that are slower than v_s, and W bounds the loss of faster ones.
//!
//! Limits: smooth, dry, elastic spheres; roughness and a viscoelastic surface energy change Γ by far more than the theories
//! differ.

use std::f64::consts::PI;

use crate::hertz::HertzImpact;
use crate::impact::ImpactQuantities;
use crate::numerics::bisection::last_where;
use crate::numerics::midpoint_sum;
use crate::pair::Pair;

/// Distance z₀ of two surfaces in contact, m: an atomic spacing. It matters to hard spheres alone.
pub const RANGE_OF_ATTRACTION: f64 = 0.4e-9;

/// Adhesion of a pair of spheres.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Adhesion {
    pair: Pair,
    work_of_adhesion: f64,
}

impl Adhesion {
    /// Creates the adhesion of a pair with a work of adhesion Γ ≥ 0, J/m².
    pub fn new(pair: &Pair, work_of_adhesion: f64) -> Self {
        Self { pair: *pair, work_of_adhesion }
    }

    /// Returns the pair of bodies.
    pub fn pair(&self) -> &Pair {
        &self.pair
    }

    /// Returns the work of adhesion Γ, J/m².
    pub fn work_of_adhesion(&self) -> f64 {
        self.work_of_adhesion
    }

    /// Returns Tabor's number μ: the deformation by attraction over the range of the attraction.
    pub fn tabor(&self) -> f64 {
        let strain = self.work_of_adhesion / (self.pair.contact_modulus() * RANGE_OF_ATTRACTION);
        (self.pair.effective_radius() / RANGE_OF_ATTRACTION * strain * strain).cbrt()
    }

    /// Returns whether Johnson, Kendall and Roberts' energy is the larger one, for soft or large spheres.
    pub fn is_jkr(&self) -> bool {
        jkr_energy() * self.tabor() > dmt_energy()
    }

    /// Returns the energy W that separates the spheres, J.
    pub fn separation_energy(&self) -> f64 {
        let unit = self.pair.effective_radius() * self.work_of_adhesion * RANGE_OF_ATTRACTION;
        unit * (jkr_energy() * self.tabor()).max(dmt_energy())
    }

    /// Returns the force that pulls the spheres off, N: 3πΓR*/2 of soft or large spheres (Johnson, eq. 5.49), 2πΓR* of hard or small ones,
    /// in Derjaguin's approximation.
    pub fn pull_off_force(&self) -> f64 {
        let factor = if self.is_jkr() { 1.5 } else { 2.0 };
        factor * PI * self.work_of_adhesion * self.pair.effective_radius()
    }

    /// Returns the sticking speed v_s, m/s, below which elastic spheres stay together.
    pub fn sticking_speed(&self) -> f64 {
        (2.0 * self.separation_energy() / self.pair.effective_mass()).sqrt()
    }

    /// Returns the restitution at an approach speed (m/s) of spheres whose restitution without adhesion is `without`; 0 if
    /// they stick.
    pub fn restitution(&self, speed: f64, without: f64) -> f64 {
        let share = self.sticking_speed() / speed;
        ((without - share) * (without + share)).max(0.0).sqrt()
    }

    /// Returns the impact of elastic spheres at an approach speed, m/s. Force, approach, radius and pressure are those of
    /// Johnson, Kendall and Roberts.
    pub fn impact(&self, speed: f64) -> ImpactQuantities {
        let (radius, modulus) = (self.pair.effective_radius(), self.pair.contact_modulus());
        let (mass, work) = (self.pair.effective_mass(), self.work_of_adhesion);
        let attraction = (8.0 * PI * work * modulus).sqrt();
        let rise = (2.0 * PI * work / modulus).sqrt();
        let force = |a: f64| 4.0 / 3.0 * modulus / radius * a.powi(3) - attraction * a.powf(1.5);
        let approach = |a: f64| a * a / radius - rise * a.sqrt();
        // The antiderivative of P dδ/da.
        let energy = |a: f64| {
            let cross = 2.0 / 3.0 * modulus * rise / radius + 2.0 * attraction / radius;
            8.0 / 15.0 * modulus * a.powi(5) / (radius * radius) - cross * a.powf(3.5) / 3.5
                + 0.25 * attraction * rise * a * a
        };
        let touch = (rise * radius).powf(2.0 / 3.0);
        let separation = (0.25 * rise * radius).powf(2.0 / 3.0);
        let initial = 0.5 * mass * speed * speed;
        let kinetic = |a: f64| initial - (energy(a) - energy(touch));
        let widest = last_where(touch, f64::MAX, |a| kinetic(a) > 0.0);
        // a = a_max − (a_max − a_end) x² removes the root of the speed at the turning point.
        let time = |end: f64| {
            midpoint_sum(|x| {
                let a = widest - (widest - end) * x * x;
                let rate = (2.0 * kinetic(a) / mass).sqrt();
                (2.0 * a / radius - 0.5 * rise / a.sqrt()) * 2.0 * x * (widest - end) / rate
            })
        };
        let restitution = self.restitution(speed, 1.0);
        let contact_time =
            if restitution > 0.0 { time(touch) + time(separation) } else { f64::INFINITY };
        let tension = (2.0 * work * modulus / (PI * widest)).sqrt();
        ImpactQuantities {
            restitution,
            contact_time,
            peak_force: force(widest),
            max_approach: approach(widest),
            max_contact_radius: widest,
            peak_pressure: 2.0 * modulus * widest / (PI * radius) - tension,
        }
    }

    /// Returns the relative changes of the six quantities by adhesion in an elastic impact, in the order of
    /// [`ImpactQuantities::in_order`]; that of the restitution is absolute.
    pub fn change(&self, hertz: &HertzImpact) -> [f64; 6] {
        self.impact(hertz.approach_speed()).change_from(&ImpactQuantities::from(hertz))
    }
}

/// Returns W/(R*Γz₀μ) of Johnson, Kendall and Roberts.
fn jkr_energy() -> f64 {
    (2.0 * PI).powf(5.0 / 3.0) * (0.3 + 0.2 * 2f64.powf(-8.0 / 3.0))
}

/// Returns W/(R*Γz₀) of rigid spheres.
fn dmt_energy() -> f64 {
    2.0 * PI * 8.0 / 7.0 * 4f64.powf(1.0 / 6.0)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::pair::Partner;

    /// A sphere of a diameter (m), Young's modulus (Pa), Poisson's ratio and density (kg/m³).
    fn sphere([diameter, modulus, nu, density]: [f64; 4]) -> Partner {
        Partner::Sphere {
            radius: 0.5 * diameter,
            mass: crate::pair::sphere_mass(diameter, density),
            plane_strain_modulus: modulus / (1.0 - nu * nu),
        }
    }

    const POLYSTYRENE: [f64; 4] = [10e-6, 3.25e9, 0.34, 1050.0];

    fn on_wall(ball: [f64; 4], work: f64) -> Adhesion {
        Adhesion::new(&Pair::new(sphere(ball), Partner::Wall).unwrap(), work)
    }

    fn like(ball: [f64; 4], work: f64) -> Adhesion {
        Adhesion::new(&Pair::new(sphere(ball), sphere(ball)).unwrap(), work)
    }

    fn close(found: f64, expected: f64, relative: f64) {
        assert!((found / expected - 1.0).abs() < relative, "{found:e} {expected:e}");
    }

    /// Thornton and Ning (1998), eqs. 52 and 57: the constant 7.09, and for a sphere on a wall of one material
    /// v_s = 1.84 (Γ⁵/(ρ³E*²R⁵))^(1/6).
    #[test]
    fn sticking_speed_of_thornton_and_ning() {
        close(jkr_energy(), 7.09, 5e-4);
        let (diameter, density, work) = (POLYSTYRENE[0], POLYSTYRENE[3], 0.1f64);
        let adhesion = on_wall(POLYSTYRENE, work);
        assert!(adhesion.is_jkr());
        let modulus = adhesion.pair().contact_modulus();
        let below = density.powi(3) * modulus * modulus * (0.5 * diameter).powi(5);
        close(adhesion.sticking_speed(), 1.84 * (work.powi(5) / below).powf(1.0 / 6.0), 2e-3);
        close(adhesion.sticking_speed(), 0.141, 5e-3);
        // At ten times the sticking speed half a per cent is lost.
        close(adhesion.restitution(10.0 * adhesion.sticking_speed(), 1.0), 0.995, 1e-4);
    }

    /// The numerical integral of JKR's force over the approach.
    #[test]
    fn energy_is_the_integral_of_the_force() {
        let s = (8.0 * PI).sqrt();
        let rate = |a: f64| 2.0 * a - 0.5 * (2.0 * PI / a).sqrt();
        let force = |a: f64| 4.0 / 3.0 * a.powi(3) - s * a.powf(1.5);
        let (first, last) = ((2.0 * PI).cbrt(), (0.25 * (2.0 * PI).sqrt()).powf(2.0 / 3.0));
        let n = 20_000;
        let width = (first - last) / f64::from(n);
        let middles = (0..n).map(|k| last + (f64::from(k) + 0.5) * width);
        close(-middles.map(|a| force(a) * rate(a) * width).sum::<f64>(), jkr_energy(), 1e-7);
        // The largest pull is −3πΓR/2.
        let pull = (0..n).map(|k| force(0.1 + 1e-4 * f64::from(k))).fold(0.0, f64::min);
        close(pull, -1.5 * PI, 1e-6);
    }

    /// The numerical integral of Derjaguin's attraction 2πw over u = z₀/z, from infinity to where it vanishes, found by bisection.
    #[test]
    fn energy_of_hard_spheres_is_the_depth_of_their_well() {
        let force = |u: f64| 2.0 * PI / 3.0 * (4.0 * u.powi(2) - u.powi(8));
        let (mut attracted, mut repelled) = (1.0, 2.0);
        for _ in 0..60 {
            let middle = 0.5 * (attracted + repelled);
            *if force(middle) > 0.0 { &mut attracted } else { &mut repelled } = middle;
        }
        let n = 20_000;
        let width = attracted / f64::from(n);
        let middles = (0..n).map(|k| (f64::from(k) + 0.5) * width);
        // dz = −z₀ du/u².
        let depth: f64 = middles.map(|u| force(u) / (u * u) * width).sum();
        // The midpoint rule errs by 1/n².
        close(dmt_energy(), depth, 1e-7);
    }

    /// A time integration (RK4) of m* δ̈ = −P(a(δ)) from first touch to separation, in a script of its own.
    #[test]
    fn impacts_agree_with_a_time_integration() {
        let adhesion = on_wall(POLYSTYRENE, 0.1);
        for (speed, found) in [
            (0.2, [0.7078, 109.6e-9, 6.220e-6, 8.067e-9, 0.2729e-6, 98.4e6]),
            (0.5, [0.9593, 79.06e-9, 15.48e-6, 13.48e-9, 0.3234e-6, 124.4e6]),
            (2.0, [0.9975, 55.18e-9, 76.68e-6, 37.11e-9, 0.4805e-6, 202.7e6]),
        ] {
            // Four printed digits, three of the pressure.
            for (ours, theirs) in adhesion.impact(speed).in_order().into_iter().zip(found) {
                close(ours, theirs, 1e-3);
            }
        }
        let stuck = adhesion.impact(0.1);
        assert_eq!((stuck.restitution, stuck.contact_time), (0.0, f64::INFINITY));
        assert!(stuck.peak_force > 0.0 && stuck.max_contact_radius > 0.0);
    }

    #[test]
    fn without_adhesion_the_impact_is_hertz() {
        let adhesion = on_wall(POLYSTYRENE, 1e-12);
        let hertz = HertzImpact::new(adhesion.pair(), 1.0).unwrap();
        for change in adhesion.change(&hertz) {
            assert!(change.abs() < 1e-5, "{change:e}");
        }
        let none = on_wall(POLYSTYRENE, 0.0);
        assert_eq!((none.sticking_speed(), none.tabor()), (0.0, 0.0));
        assert_eq!(none.restitution(1.0, 0.9), 0.9);
    }

    /// v_s ∝ Γ^(5/6) of soft and Γ^(1/2) of hard spheres, continuous where they meet at Tabor's number 1.28.
    #[test]
    fn soft_and_hard_spheres_meet() {
        let power = |work: f64| {
            let speed = |work| like([1e-6, 72e9, 0.17, 2200.0], work).sticking_speed();
            (speed(1.01 * work) / speed(work)).ln() / 1.01f64.ln()
        };
        assert!((power(1e-3) - 0.5).abs() < 1e-9 && (power(1e3) - 5.0 / 6.0).abs() < 1e-9);
        let meeting = dmt_energy() / jkr_energy();
        assert!((meeting - 1.2757).abs() < 1e-4);
        let at = |tabor: f64| {
            let of_one = like([1e-6, 72e9, 0.17, 2200.0], 1.0).tabor();
            like([1e-6, 72e9, 0.17, 2200.0], (tabor / of_one).powf(1.5))
        };
        let [below, above] = [at(meeting * (1.0 - 1e-9)), at(meeting * (1.0 + 1e-9))];
        assert!(!below.is_jkr() && above.is_jkr());
        close(below.sticking_speed(), above.sticking_speed(), 1e-8);
        // Silica dust of a micrometre is hard: the attraction of rigid spheres holds it at 0.5 m/s, twice JKR's 0.27.
        let dust = like([1e-6, 72e9, 0.17, 2200.0], 0.1);
        assert!(!dust.is_jkr() && (0.35..0.6).contains(&dust.sticking_speed()));
    }

    /// Beads of glass, a ball of soft rubber.
    #[test]
    fn larger_bodies_stick_at_smaller_speeds() {
        close(like([1e-4, 70e9, 0.2, 2500.0], 0.1).sticking_speed(), 5.57e-3, 2e-3);
        close(on_wall([1e-3, 2e6, 0.5, 1100.0], 0.1).sticking_speed(), 33.1e-3, 2e-3);
        close(like([1e-3, 2e6, 0.5, 1100.0], 0.1).sticking_speed(), 37.1e-3, 2e-3);
    }
}
