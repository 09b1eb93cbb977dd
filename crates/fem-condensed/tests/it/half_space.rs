//! A ball on a half-space, and waves that leave it.

use crate::common::{
    GLASS, POLYMER, assert_balance, assert_close, assert_pulse, assert_restitution, explicit,
    glass, hertz_pulse, material, sphere,
};
use fem_collision::{
    Account, Approach, BodyInput, Collision, Frame, OutputRequest, SnapshotInstant,
    SnapshotRequest, far_radius_at_rest, far_radius_of_waves,
};
use fem_condensed::{CondensedError, CondensedPair, ContactModel, Damping, PairSettings};
use fem_contact::ContactError;
use fem_laws::{
    FiniteSize, HertzImpact, Pair, PairRelaxation, Partner, Ting, plate_lambda, radiated_share,
    radiation_coefficient,
};
use fem_material::{ActsOn, Material};
use fem_mesh::{QuarterDisc, Side};

const RADIUS: f64 = 5e-3;
/// Steps over the contact that leave 1e-8 of the energy to the step.
const MANY_STEPS: usize = 1000;

/// A ball that strikes a half-space from above.
struct Ball {
    ball: Material,
    block: Material,
    speed: f64,
    /// Elements across the contact radius.
    elements: f64,
    /// Far radius of the half-space over that of a balance.
    reach: f64,
}

impl Ball {
    fn of_glass(speed: f64) -> Self {
        Self { ball: glass(), block: glass(), speed, elements: 8.0, reach: 1.0 }
    }

    /// A sphere so large that closed forms see a half-space.
    fn pair(&self) -> Pair {
        let plane_strain_modulus = self.block.instantaneous().plane_strain_modulus();
        let block = Partner::Sphere { radius: 1e9, mass: 1e30, plane_strain_modulus };
        Pair::new(block, Partner::solid_sphere(2.0 * RADIUS, &self.ball)).unwrap()
    }

    fn hertz(&self) -> HertzImpact {
        HertzImpact::new(&self.pair(), self.speed).unwrap()
    }

    fn half_space(&self, far_radius: f64) -> BodyInput {
        let contact_radius = self.hertz().max_contact_radius();
        let disc = QuarterDisc {
            far_radius,
            contact_element_size: contact_radius / self.elements,
            refined_radius: 1.2 * contact_radius,
            growth: None,
            edge: None,
        };
        let mesh = disc.build().unwrap().on_side(Side::Below);
        BodyInput::HalfSpace { mesh, material: self.block.clone() }
    }

    fn sphere(&self) -> BodyInput {
        let contact_radius = self.hertz().max_contact_radius();
        let size = contact_radius / self.elements;
        let mesh = sphere(RADIUS, size, 1.2 * contact_radius, Side::Above);
        BodyInput::Sphere { mesh, material: self.ball.clone() }
    }

    fn condensed_with(&self, settings: PairSettings) -> CondensedPair {
        let far_radius = self.reach * far_radius_at_rest(self.hertz().max_contact_radius());
        CondensedPair::new([self.half_space(far_radius), self.sphere()], settings).unwrap()
    }

    fn settings(&self) -> PairSettings {
        PairSettings::new(1.5 * self.hertz().max_contact_radius())
    }

    fn condensed(&self) -> CondensedPair {
        self.condensed_with(self.settings())
    }

    /// γ of the half-space, s m/N.
    fn radiation(&self) -> f64 {
        let moduli = self.block.instantaneous();
        radiation_coefficient(moduli.poissons_ratio())
            / (moduli.shear_modulus() * self.block.shear_wave_speed())
    }

    /// Damping by this many times its radiation.
    fn damping(&self, times: f64) -> Damping<'static> {
        Damping { radiation: [Some(times * self.radiation()), None], ..Damping::default() }
    }

    fn initial_energy(&self) -> f64 {
        0.5 * self.pair().effective_mass() * self.speed * self.speed
    }

    /// The same in explicit elements, with the mesh's own waves.
    fn explicit(&self) -> Collision {
        let (hertz, candidate_radius) = (self.hertz(), 1.5 * self.hertz().max_contact_radius());
        let far_radius = far_radius_of_waves(&self.block, hertz.contact_time(), candidate_radius);
        let bodies = [self.half_space(far_radius), self.sphere()];
        let stiffness = 10.0 * self.pair().contact_modulus();
        explicit(bodies, &hertz, stiffness, &OutputRequest::quantities())
    }
}

/// 1 − e².
fn loss(run: &Collision) -> f64 {
    let e = run.restitution.unwrap();
    1.0 - e * e
}

/// a/R → 0: Hertz. The mesh is 5e-5 and 2e-3 off, as between spheres.
#[test]
fn slow_ball_on_a_half_space_equals_hertz() {
    let ball = Ball::of_glass(1e-7);
    let (pair, hertz) = (ball.condensed(), ball.hertz());
    let run = pair.impact(ball.speed, [None; 2], CondensedPair::N_STEPS).unwrap();
    assert_pulse(&run, hertz_pulse(&hertz), [1e-4, 3e-3, 1e-3]);
    assert!((run.restitution.unwrap() - 1.0).abs() < 1e-7);
    assert_eq!(pair.masses()[0], f64::INFINITY);
    let bodies = run.bodies;
    assert_eq!((bodies[0].mass, bodies[0].velocity_after), (None, Some(ball.speed)));
    assert_eq!(run.energies.get(Account::Radiated), None);
}

/// A compliance κ less, at a share ε = κF/δ of the largest approach, adds 5/4 ε (δ/δ_m)³ to the energy
/// (δ/δ_m)^(5/2) of Hertz' spring: perturbation of the action gives a contact time that is
/// 11/8 B(8/5, 1/2)/B(2/5, 1/2) ε = 0.5656 ε shorter. The far boundary takes between once and
/// (3 − 2ν)/(2 − 2ν) = 1.66 times 4a/(3πR) of the block's compliance, half of the whole.
#[test]
fn the_far_boundary_takes_the_compliance_of_the_closed_form() {
    let time = |reach: f64| {
        let ball = Ball { reach, ..Ball::of_glass(1e-7) };
        ball.condensed().elastic_impact(ball.speed).unwrap().contact_time
    };
    let (near, here, far) = (time(1e-2), time(1.0), time(1e2));
    // 8a/(3πR) = 1e-4 at a hundredth of the far radius.
    let expected = -0.5656 * 0.25e-4;
    let found = (near / far - 1.0) / expected;
    assert!(found > 1.0 && found < 1.66, "{found}");
    assert!((here / far - 1.0).abs() < 0.6e-6, "{:e}", here / far - 1.0);
}

/// Relaxing half-spaces: Ting's solution, e to 1e-4 as between spheres.
#[test]
fn a_relaxing_half_space_is_ting() {
    let speed = 1e-7;
    let time = Ball::of_glass(speed).hertz().contact_time();
    for acts_on in [ActsOn::All, ActsOn::Shear] {
        let block = material(GLASS, acts_on, &[(1.0, 0.17 / time)]);
        let ball = Ball { block, elements: 12.0, ..Ball::of_glass(speed) };
        let pair = ball.condensed();
        let run = pair.impact(speed, pair.relaxations(), CondensedPair::N_STEPS).unwrap();
        let relaxation = PairRelaxation::new(Some(&ball.block), Some(&ball.ball)).unwrap();
        let ting = Ting::new(&ball.pair(), relaxation).impact(speed).unwrap();
        assert!(ting.restitution < 0.98, "{acts_on:?}");
        assert_restitution("Ting", &run, ting.restitution, 1e-4);
        assert_close("contact time", run.contact_time.unwrap(), ting.contact_time.unwrap(), 3e-4);
        assert_balance("Ting", &run, 1e-4);
    }
}

/// Slow: what Hertz' pulse radiates (Hunter 1957), and nothing else changes.
#[test]
fn slow_ball_loses_the_radiated_energy_of_the_hertz_pulse() {
    let ball = Ball::of_glass(1e-4);
    let pair = ball.condensed();
    let elastic = pair.impact(ball.speed, [None; 2], MANY_STEPS).unwrap();
    let run = pair.impact(ball.speed, ball.damping(1.0), MANY_STEPS).unwrap();
    let expected = radiated_share(&ball.hertz(), &ball.block);
    // Contacts join node by node: a pulse in small steps.
    assert_close("loss", loss(&run), expected, 1e-2);
    let radiated = run.energies.get(Account::Radiated).unwrap() / ball.initial_energy();
    assert_close("radiated", radiated, loss(&run), 1e-2);
    assert_close("peak force", run.peak_force.unwrap(), elastic.peak_force.unwrap(), 1e-4);
    assert_close("time", run.contact_time.unwrap(), elastic.contact_time.unwrap(), 1e-4);
    let left = run.bodies[0].vibration_energy.unwrap() / ball.initial_energy();
    assert!((left - radiated).abs() < 1e-12);
}

/// v/c₀ = 1e-3, where the pulse is another already: explicit elements, whose half-space has waves of its
/// own. A few thousandths of the loss measured.
#[test]
fn fast_ball_loss_equals_that_of_explicit_elements() {
    let ball = Ball { elements: 6.0, ..Ball::of_glass(5.0) };
    let reference = ball.explicit();
    let pair = ball.condensed();
    // The ledger closes to the order of the time step.
    for (n_steps, imbalance) in [(CondensedPair::N_STEPS, 1e-4), (MANY_STEPS, 4e-6)] {
        let run = pair.impact(ball.speed, ball.damping(1.0), n_steps).unwrap();
        assert_close("loss", loss(&run), loss(&reference), 2e-2);
        let time = reference.contact_time.unwrap();
        assert_close("contact time", run.contact_time.unwrap(), time, 5e-3);
        assert_close("peak force", run.peak_force.unwrap(), reference.peak_force.unwrap(), 1e-2);
        assert_balance("explicit", &run, imbalance);
        assert!(run.momentum_residual_relative.unwrap() < 1e-12);
    }
}

/// Without radiation bodies are elastic to the bit; a small coefficient has a small effect.
#[test]
fn zero_radiation_is_elastic_and_small_radiation_loss_is_linear() {
    let ball = Ball::of_glass(5.0);
    let pair = ball.condensed();
    let run = |damping: Damping<'_>| pair.impact(ball.speed, damping, MANY_STEPS).unwrap();
    let off = pair.impact(ball.speed, [None; 2], MANY_STEPS).unwrap();
    assert_eq!(run(ball.damping(0.0)), off);
    assert!(!off.energies.has(Account::Radiated));
    let [small, half] = [1e-2, 5e-3].map(|times| loss(&run(ball.damping(times))) - loss(&off));
    // First order, up to the second: 5 % at the whole coefficient.
    assert!(small > 0.0 && (small / half - 2.0).abs() < 2e-3, "{small:e} {half:e}");
    // Shares of two bodies add up, here of the ball too.
    let radiation = [Some(0.25 * ball.radiation()), Some(0.75 * ball.radiation())];
    let both = run(Damping { radiation, ..Damping::default() });
    let whole = run(ball.damping(1.0));
    assert_restitution("two shares", &both, whole.restitution.unwrap(), 1e-12);
    // What a block has of it stays in it; what a sphere has is gone, and no vibration.
    let radiated = both.energies.get(Account::Radiated).unwrap();
    let [lower, upper] = both.bodies.map(|body| body.vibration_energy.unwrap());
    assert!((lower / radiated - 0.25).abs() < 1e-3, "{}", lower / radiated);
    assert!(upper < 1e-9 * radiated, "{upper:e}");
}

/// With relaxation, modes of the ball and penalty springs; a soft ball and a hard block.
#[test]
fn radiation_adds_to_losses_by_relaxation_modes_and_springs() {
    let polymer = || material(POLYMER, ActsOn::Shear, &[(0.3, 2e4), (0.3, 2e3)]);
    for (ball, block) in [(polymer(), glass()), (glass(), polymer()), (polymer(), polymer())] {
        let ball = Ball { ball, block, speed: 2.0, elements: 6.0, reach: 1.0 };
        let springs = ContactModel::Springs(10.0 * ball.pair().contact_modulus());
        for contact in [ContactModel::Exact, springs] {
            let settings = PairSettings { contact, vibration_modes: 12, ..ball.settings() };
            let pair = ball.condensed_with(settings);
            assert!(pair.frequencies()[0].is_empty() && !pair.frequencies()[1].is_empty());
            let relaxations = pair.relaxations();
            let quiet = pair.impact(ball.speed, relaxations, MANY_STEPS).unwrap();
            let damping = Damping { relaxations, ..ball.damping(1.0) };
            let run = pair.impact(ball.speed, damping, MANY_STEPS).unwrap();
            assert_balance("with springs", &run, 2e-5);
            // Losses add up to first order: relaxation makes the pulse another.
            let radiated = run.energies.get(Account::Radiated).unwrap() / ball.initial_energy();
            let sum = loss(&quiet) + radiated;
            assert!((loss(&run) / sum - 1.0).abs() < 0.05, "{} {sum}", loss(&run));
        }
    }
}

/// Fields of a half-space: nothing moves far away, and the poles stay together.
#[test]
fn half_space_fields_vanish_far_away_and_poles_stay_together() {
    let ball = Ball::of_glass(1.0);
    let pair = ball.condensed();
    let request = OutputRequest {
        snapshots: SnapshotRequest::Labels(vec![SnapshotInstant::Maximum]),
        ..OutputRequest::quantities()
    };
    let still = pair.frame(1.0).unwrap();
    let frame = Frame { approach: Approach::new([3.0, 2.0], 0.0).unwrap(), ..still };
    let run = pair.collide(&frame, [None; 2], CondensedPair::N_STEPS, &request, &mut ()).unwrap();
    let snapshot = run.snapshot(SnapshotInstant::Maximum).unwrap();
    let [block, sphere] = [0, 1].map(|side| snapshot.displacement(side));
    let [lower, upper] = pair.inputs().each_ref().map(|input| input.mesh().unwrap());
    for &node in lower.far_boundary() {
        let [r, y] = block[node as usize];
        assert!(r == 0.0 && (y / (3.0 * snapshot.time) - 1.0).abs() < 1e-12);
    }
    let poles = [block[0][1], sphere[upper.axis()[0] as usize][1]];
    // Rounding times the condition of the stiffness.
    assert!((poles[0] - poles[1]).abs() < 1e-6 * snapshot.approach, "{poles:?}");
    // It pushes the ball along.
    assert!(run.energies.get(Account::WallWork).unwrap() > 0.0);
    assert_eq!(run.bodies[0].velocity_after, Some(3.0));
}

/// A plate of no mobility changes no bit. One of λ = 0.1 takes what Zener's equation says, with an error of second order in the
/// step.
#[test]
fn a_plate_takes_its_share_of_the_energy() {
    let ball = Ball::of_glass(1.0);
    let pair = ball.condensed();
    let run = |mobility: Option<f64>, steps| {
        let damping = Damping { plate_mobility: mobility, ..Damping::default() };
        pair.impact(1.0, damping, steps).unwrap()
    };
    let [without, still] = [None, Some(0.0)].map(|mobility| run(mobility, 200));
    assert_eq!(without.restitution, still.restitution);
    assert_eq!(without.history, still.history);
    let hertz = ball.hertz();
    let mobility = 0.1 / plate_lambda(&hertz, 1.0);
    let relaxation = PairRelaxation::new(Some(&ball.block), Some(&ball.ball)).unwrap();
    let size = FiniteSize::new(None, Some((RADIUS, &ball.ball))).unwrap();
    let closed = Ting::new(hertz.pair(), relaxation).with_finite_size(size);
    let closed = closed.with_plate(mobility).unwrap().impact(1.0).unwrap();
    let found = run(Some(mobility), 200);
    // Eight elements across the contact.
    let restitution = found.restitution.unwrap();
    assert_restitution("Zener", &found, closed.restitution, 3e-4);
    let plate = found.energies.get(Account::Plate).unwrap() / ball.initial_energy();
    assert!((plate + restitution.powi(2) - 1.0).abs() < 2e-5, "{plate}");
    let at = |steps| run(Some(mobility), steps).restitution.unwrap();
    let fine = at(1600);
    let error = |steps| at(steps) - fine;
    let order = (error(50) / error(100)).log2();
    assert!((1.7..2.3).contains(&order), "{order}");
}

#[test]
fn half_space_rejects_a_plane_partner_and_invalid_damping() {
    let ball = Ball::of_glass(1.0);
    for upper in [BodyInput::Wall, ball.half_space(1.0)] {
        let refused = CondensedPair::new([ball.half_space(1.0), upper], ball.settings());
        assert_eq!(refused.unwrap_err(), CondensedError::Contact(ContactError::TwoPlanes));
    }
    let pair = ball.condensed();
    for wrong in [-1e-15, f64::NAN, f64::INFINITY] {
        let damping = Damping { radiation: [None, Some(wrong)], ..Damping::default() };
        let refused = pair.impact(1.0, damping, 200).unwrap_err();
        assert!(matches!(refused, CondensedError::Setting { .. }), "{refused:?}");
        let damping = Damping { plate_mobility: Some(wrong), ..Damping::default() };
        assert!(pair.impact(1.0, damping, 200).is_err());
    }
}
