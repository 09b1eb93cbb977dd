//! A glass ball on a half-space.

use std::sync::LazyLock;

use fem_collision::{
    Account, Approach, BodyInput, Collision, Ending, Expectation, OutputRequest,
    far_radius_of_waves,
};
use fem_contact::ContactError;
use fem_explicit::{ExplicitBodies, ModelError, Run, Settings, collide};
use fem_material::{ActsOn, Material, PronySeries, PronyTerm};
use fem_mesh::{QuarterDisc, Side};

use crate::common::{CONTACT_MODULUS, Hertz, elastic, settings, sphere, sphere_mass};

const RADIUS: f64 = 5e-3;
const DENSITY: f64 = 2390.0;

fn glass(relaxation: Option<PronySeries>) -> Material {
    let moduli = *elastic(63e9, 0.244, DENSITY).instantaneous();
    Material::new(DENSITY, moduli, relaxation).unwrap()
}

fn mass() -> f64 {
    sphere_mass(RADIUS, DENSITY)
}

fn hertz(speed: f64) -> Hertz {
    Hertz::new(RADIUS, mass(), CONTACT_MODULUS, speed)
}

/// A ball that meets a half-space.
#[derive(Clone)]
struct Ball {
    speed: f64,
    /// Velocities of both bodies along +y, m/s.
    drift: f64,
    /// Far radius over that which waves do not reach.
    reach: f64,
    /// Growth of the rings of the half-space.
    growth: Option<f64>,
    /// Radius in which contact is looked for over Hertz' contact radius.
    candidates: f64,
    mass_scaling: f64,
    /// Side of the half-space.
    relaxation: Option<PronySeries>,
    half_space: Side,
}

impl Default for Ball {
    fn default() -> Self {
        Self {
            speed: 5.0,
            drift: 0.0,
            reach: 1.0,
            growth: None,
            candidates: 1.5,
            mass_scaling: 2e-4,
            relaxation: None,
            half_space: Side::Below,
        }
    }
}

impl Ball {
    fn model(&self) -> ExplicitBodies {
        let Hertz { contact_radius, time, .. } = hertz(self.speed);
        let (size, refined_radius) = (contact_radius / 6.0, 1.2 * contact_radius);
        let candidate_radius = self.candidates * contact_radius;
        let far_radius = far_radius_of_waves(&glass(None), time, candidate_radius);
        let block = QuarterDisc {
            far_radius: self.reach * far_radius,
            contact_element_size: size,
            refined_radius,
            growth: self.growth,
            edge: None,
        };
        let other = match self.half_space {
            Side::Below => Side::Above,
            Side::Above => Side::Below,
        };
        let block = BodyInput::HalfSpace {
            mesh: block.build().unwrap().on_side(self.half_space),
            material: glass(self.relaxation.clone()),
        };
        let mesh = sphere(RADIUS, size, refined_radius, other);
        let ball = BodyInput::Sphere { mesh, material: glass(None) };
        let (bodies, velocities) = match self.half_space {
            Side::Below => ([block, ball], [0.0, -self.speed]),
            Side::Above => ([ball, block], [self.speed, 0.0]),
        };
        let velocities = velocities.map(|velocity| velocity + self.drift);
        let usual = settings(10.0 * CONTACT_MODULUS, candidate_radius);
        let settings = Settings { mass_scaling: self.mass_scaling, ..usual };
        ExplicitBodies::new(bodies, Approach::new(velocities, 0.0).unwrap(), &settings).unwrap()
    }

    fn expected(&self) -> Expectation {
        hertz(self.speed).expected()
    }

    fn run(&self) -> Collision {
        collide(&self.model(), self.expected(), &OutputRequest::quantities(), &mut ())
    }
}

/// The collision of the default ball, with which several tests compare theirs.
static DEFAULT_RUN: LazyLock<Collision> = LazyLock::new(|| Ball::default().run());

/// Returns 1 − e².
fn loss(run: &Collision) -> f64 {
    let e = run.restitution.unwrap();
    1.0 - e * e
}

/// Hunter (1957): what Hertz' pulse radiates, C/(μ c_s) ∫Ḟ² dt over the energy with
/// ∫Ḟ² dt = (9/5) B(4/5, 3/2) F² v/δ; C(0.244) = 0.14950 by numerical integration of Miller & Pursey's
/// (1955) admittance. To first order in the loss; 4.5 % more at 1.7 %, 2.6 % more at 0.7 %.
#[test]
fn the_loss_of_a_ball_is_hunters_radiation() {
    for (speed, radiated, tolerance) in [(5.0, 1.7307e-2, 0.06), (1.0, 6.589e-3, 0.04)] {
        let run = match speed == Ball::default().speed {
            true => DEFAULT_RUN.clone(),
            false => Ball { speed, ..Ball::default() }.run(),
        };
        assert_eq!(run.ending, Ending::Parted);
        assert!(run.warnings.is_empty(), "{:?}", run.warnings);
        let found = loss(&run);
        assert!((found / radiated - 1.0).abs() < tolerance, "{speed}: {found:e}");
        // The half-space has it, and the ball vibrates with less than a hundredth of it: no energy is
        // elsewhere. Half of what waves carry is kinetic but near the contact.
        let initial = 0.5 * mass() * speed * speed;
        let left = run.bodies.map(|body| body.vibration_energy.unwrap() / initial);
        assert!((left[0] / found - 1.0).abs() < 0.01 && left[1] < 0.01 * found, "{left:?}");
        // Leapfrog's order, as between spheres; momentum to rounding.
        assert!(run.residual_relative.unwrap() < 2e-6, "{:?}", run.residual_relative);
        assert!(run.momentum_residual_relative.unwrap() < 1e-12);
        // A half-space has no mass, and keeps its velocity.
        assert_eq!((run.bodies[0].mass, run.bodies[0].velocity_after), (None, Some(0.0)));
        assert!((run.bodies[1].mass.unwrap() / mass() - 1.0).abs() < 1e-12);
    }
}

/// A sphere is a half-space as long as its waves have not come back: one of forty times the radius,
/// across which pressure waves need 1.5 contact times.
#[test]
fn a_partner_forty_times_larger_is_a_half_space() {
    let model = Ball::default().model();
    let [_, ball] = model.bodies();
    let contact_radius = hertz(5.0).contact_radius;
    let partner = sphere(40.0 * RADIUS, contact_radius / 6.0, 1.2 * contact_radius, Side::Below);
    let bodies = [partner, ball.mesh().unwrap().clone()]
        .map(|mesh| BodyInput::Sphere { mesh, material: glass(None) });
    let usual = settings(10.0 * CONTACT_MODULUS, 1.5 * contact_radius);
    let settings = Settings { mass_scaling: 0.0, ..usual };
    let large = ExplicitBodies::new(bodies, *model.approach(), &settings).unwrap();
    let expected = Ball::default().expected();
    let large = collide(&large, expected, &OutputRequest::quantities(), &mut ());
    // R* is 1/41 smaller: 1.5 % less at the power 3/5 of the loss on R*. The sphere's curvature has a
    // part in its waves, a per cent as well.
    let ratio = loss(&large) / loss(&DEFAULT_RUN);
    assert!(ratio > 0.97 && ratio < 1.0, "{ratio}");
}

/// Neither the far boundary nor the coarse elements there reflect waves: twice the radius, and rings that grow half
/// as fast, change the loss by a thousandth, the noise of the contact force.
#[test]
fn no_waves_return() {
    let loss_of = |ball: Ball| loss(&ball.run());
    let here = loss(&DEFAULT_RUN);
    for ball in [Ball { reach: 0.5, ..Ball::default() }, Ball { reach: 2.0, ..Ball::default() }] {
        let there = loss_of(ball);
        assert!((there / here - 1.0).abs() < 1e-3, "{there:e} {here:e}");
    }
    let finer = loss_of(Ball { growth: Some(1.05), ..Ball::default() });
    assert!((finer / here - 1.0).abs() < 5e-3, "{finer:e} {here:e}");
}

/// Waves that return from a far boundary that is too near are reported.
#[test]
fn a_far_boundary_that_is_too_near_is_reported() {
    let run = Ball { reach: 0.2, ..Ball::default() }.run();
    assert!(
        run.warnings.len() == 1 && run.warnings[0].contains("set mesh.far_radius = \""),
        "{:?}",
        run.warnings
    );
    // What holds it takes momentum and no energy.
    assert!(run.residual_relative.unwrap() < 2e-6);
    assert!(run.momentum_residual_relative.unwrap() < 1e-12);
}

/// Above as below, and in a moving frame: a half-space that moves does work on the ball.
#[test]
fn half_space_above_or_moving_gives_the_same_restitution() {
    let still = Ball { speed: 20.0, ..Ball::default() };
    let here = still.run();
    let above = Ball { half_space: Side::Above, ..still.clone() }.run();
    // Sums in another order: rounding, which the opening and closing of points multiplies.
    let difference = above.restitution.unwrap() - here.restitution.unwrap();
    assert!(difference.abs() < 1e-7, "{difference:e}");
    let moving = Ball { drift: 3.0, ..still }.run();
    assert!((moving.restitution.unwrap() - here.restitution.unwrap()).abs() < 1e-7);
    assert_eq!(moving.bodies[0].velocity_after, Some(3.0));
    assert!(moving.energies.get(Account::WallWork).unwrap() > 0.0);
    assert!(moving.residual_relative.unwrap() < 3e-6, "{:?}", moving.residual_relative);
    // Rounding of the velocity of 1e5 times the ball's mass.
    let drift = moving.momentum_residual_relative.unwrap();
    assert!(drift < 1e-9, "{drift:e}");
}

/// A half-space that relaxes loses what it radiates and what it dissipates; resumed from a restart
/// state it has the same bits.
#[test]
fn relaxing_half_space_adds_loss_and_resumes_to_the_bit() {
    for acts_on in [ActsOn::All, ActsOn::Shear] {
        let terms = vec![PronyTerm { weight: 0.5, relaxation_time: 1e-4 }];
        let series = PronySeries::new(terms, acts_on).unwrap();
        let ball = Ball { speed: 20.0, relaxation: Some(series), ..Ball::default() };
        let model = ball.model();
        let run = collide(&model, ball.expected(), &OutputRequest::quantities(), &mut ());
        let elastic = Ball { relaxation: None, ..ball.clone() }.run();
        let initial = 0.5 * mass() * 400.0;
        let dissipated = run.energies.get(Account::ViscousDissipation).unwrap() / initial;
        assert!(dissipated > 0.01, "{dissipated}");
        // Losses add up to first order: 1 % of the dissipation is still stored in springs.
        let sum = loss(&elastic) + dissipated;
        assert!((loss(&run) / sum - 1.0).abs() < 0.05, "{} {sum}", loss(&run));
        assert!(run.residual_relative.unwrap() < 2e-6, "{:?}", run.residual_relative);

        let mut first = Run::new(&model, ball.expected(), &OutputRequest::quantities());
        assert_eq!(first.advance(700), None);
        let mut second = Run::resume(&model, first.restart_state().clone()).unwrap();
        while second.advance(1000).is_none() {}
        assert_eq!(second.finish(), run);
    }
}

/// Bodies that stay together are recognised in time, also when waves have carried energy away: the half-space flows
/// after a fiftieth of the contact time. One that keeps a spring parts.
#[test]
fn radiated_waves_do_not_separate_bodies() {
    let ending = |weight: f64| {
        let time = 0.02 * hertz(20.0).time;
        let terms = vec![PronyTerm { weight, relaxation_time: time }];
        let series = PronySeries::new(terms, ActsOn::All).unwrap();
        let ball =
            Ball { speed: 20.0, relaxation: Some(series), candidates: 4.0, ..Ball::default() };
        ball.run()
    };
    let together = ending(1.0);
    assert_eq!(together.ending, Ending::Together);
    assert_eq!(together.warnings.len(), 1, "{:?}", together.warnings);
    assert_eq!(ending(0.9).ending, Ending::Parted);
}

/// The mass that may be moved in the half-space is a share of the mass of the ball.
#[test]
fn half_space_mass_scaling_is_limited_by_the_mass_of_the_ball() {
    let model = Ball::default().model();
    let [block, ball] = model.bodies();
    for body in [block, ball] {
        assert!(body.moved_mass() <= 2e-4 * ball.mass() && body.moved_mass() > 0.0);
    }
    assert!(model.time_step() > 1.5 * model.plain_time_step());
    let unscaled = Ball { mass_scaling: 0.0, ..Ball::default() }.model();
    assert_eq!(unscaled.bodies()[0].moved_mass(), 0.0);
    assert!(block.mass().is_infinite());
}

#[test]
fn half_space_rejects_a_plane_partner() {
    let block = |side: Side| {
        let disc = QuarterDisc {
            far_radius: 1.0,
            contact_element_size: 0.02,
            refined_radius: 0.1,
            growth: None,
            edge: None,
        };
        let mesh = disc.build().unwrap().on_side(side);
        BodyInput::HalfSpace { mesh, material: glass(None) }
    };
    let settings = Settings { mass_scaling: 0.0, ..settings(CONTACT_MODULUS, 0.1) };
    for upper in [BodyInput::Wall, block(Side::Above)] {
        let bodies = [block(Side::Below), upper];
        let refused =
            ExplicitBodies::new(bodies, Approach::at(1.0).unwrap(), &settings).unwrap_err();
        assert_eq!(refused, ModelError::Contact(ContactError::TwoPlanes));
    }
}
