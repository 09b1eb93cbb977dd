//! Finite strain in the step: the critical step of deformed bodies, and how it is followed.

use fem_collision::{Approach, BodyInput, StepInstant, Stop};
use fem_contact::{ContactInterface, Surface};
use fem_material::finite::HyperelasticLaw;
use fem_mesh::{Side, SphereMesh};

use crate::contact::{Contact, Springs};
use crate::model::{ExplicitBodies, ModelParts};
use crate::run::{advance, step_demand, update_forces, update_time_step};
use crate::settings::Settings;
use crate::state::{Scratch, State};
use crate::test_support::{
    far_apart, glass_sphere, largest_eigenvalue, ragged, settings, started, tangent,
    upper_at_finite_strain,
};

/// Bound over true critical step, 2/ω_max of the assembled tangent, at rest, in large stretch and
/// compression, and in a ragged deformation, of every law.
#[test]
fn the_critical_step_of_a_deformed_body_is_safe_and_tight() {
    for law in HyperelasticLaw::ALL {
        let bodies = [BodyInput::Wall, glass_sphere(6.0, Side::Above)];
        let (model, mut state) = far_apart(bodies, &settings(), upper_at_finite_strain(law));
        let body = &model.bodies()[1];
        let mesh = body.mesh().unwrap().clone();
        let noise = ragged(&mesh, 3);
        let still = (0.0, 0.0, 0.0);
        for (radial, axial, rough) in
            [still, (0.3, -0.5, 0.0), (-0.3, 0.8, 0.0), (-0.2, -0.2, 0.0), (0.1, -0.3, 0.03)]
        {
            let nodes = mesh.nodes().iter().zip(&noise);
            state.bodies[1].displacement = nodes
                .map(|([r, y], n)| [radial * r + rough * n[0], axial * y + rough * n[1]])
                .collect();
            let mut scratch = Scratch::new(&model);
            let critical = step_demand(&model, &state, &mut scratch).critical_time_step;
            let ratio =
                critical * largest_eigenvalue(&tangent(&model, &state, &[1]), &[body]).sqrt() / 2.0;
            // Safe, and 14 to 22 % below: as at small strain, and some per cent for the power mean of
            // the eigenvalues of an element.
            assert!(ratio <= 1.0 && ratio > 0.77, "{law:?} {radial} {axial} {rough}: {ratio}");
        }
    }
}

/// Bodies at first touch, the upper one at finite strain, on springs of a stiffness.
fn with_deformed_upper(bodies: [BodyInput; 2], contact_stiffness: f64) -> (ExplicitBodies, State) {
    let settings =
        Settings { contact_stiffness, candidate_radius: 0.7, step_factor: 1.0, ..settings() };
    let parts = upper_at_finite_strain(HyperelasticLaw::NeoHooke);
    started(bodies, Approach::at(1.0).unwrap(), &settings, parts)
}

/// Returns displacements that widen a sphere by a third and flatten it where it was within 0.8 of the axis, for
/// `sign` −1 of the lower body and 1 of the upper.
fn flattened(mesh: &SphereMesh, sign: f64) -> Vec<[f64; 2]> {
    let displacement = |&[r, y]: &[f64; 2]| {
        let depth = 1.0 - (1.0 - r * r).max(0.36).sqrt();
        [0.33 * r, sign * (-depth * (1.0 - (sign * y - depth)).max(0.0) - 1e-3)]
    };
    mesh.nodes().iter().map(displacement).collect()
}

/// Returns the critical step of a state with many closed points.
fn critical_step_in_contact(model: &ExplicitBodies, state: &State) -> f64 {
    let mut scratch = Scratch::new(model);
    let contact = update_forces(model, state, &mut scratch).unwrap();
    assert!(contact.n_closed > 10, "{contact:?}");
    step_demand(model, state, &mut scratch).critical_time_step
}

/// A sphere is flattened on a wall, with all of its near surface in contact: the springs grow with the
/// area of the surface, and are in the bound. They are stiffer and softer than the elements.
#[test]
fn the_critical_step_of_a_flattened_body_is_safe() {
    // As without contact where elements decide; springs that decide are taken twice for opening and closing:
    // a factor √2 more. The springs of the undeformed surface would leave 0.73.
    for (stiffness, range) in [(1.0, 0.6..0.8), (100.0, 0.45..0.6)] {
        let bodies = [BodyInput::Wall, glass_sphere(6.0, Side::Above)];
        let (model, mut state) = with_deformed_upper(bodies, stiffness);
        let body = &model.bodies()[1];
        state.bodies[1].displacement = flattened(body.mesh().unwrap(), 1.0);
        let critical = critical_step_in_contact(&model, &state);
        let ratio =
            critical * largest_eigenvalue(&tangent(&model, &state, &[1]), &[body]).sqrt() / 2.0;
        assert!(range.contains(&ratio), "{stiffness}: {ratio}");
    }
}

/// A fine sphere at small strain and a coarse one at finite strain, on stiff springs, both flattened: the springs that
/// grow with the area of the surfaces are in the step of the fine one, which does not change its own stiffness, and
/// whose light nodes need the shortest step.
#[test]
fn the_critical_step_beside_a_deformed_body_is_safe() {
    let bodies = [glass_sphere(8.0, Side::Below), glass_sphere(4.0, Side::Above)];
    let (model, mut state) = with_deformed_upper(bodies, 100.0);
    for (side, sign) in [(0, -1.0), (1, 1.0)] {
        let mesh = model.bodies()[side].mesh().unwrap();
        state.bodies[side].displacement = flattened(mesh, sign);
    }
    let critical = critical_step_in_contact(&model, &state);
    let bodies = model.bodies();
    let stiffness =
        largest_eigenvalue(&tangent(&model, &state, &[0, 1]), &[&bodies[0], &bodies[1]]);
    let ratio = critical * stiffness.sqrt() / 2.0;
    // As on a wall, where the springs decide; 0.62 without those that have grown.
    assert!((0.4..0.5).contains(&ratio), "{ratio}");
}

/// A very light rigid sphere with dashpots, under a ball at finite strain that has become wider by a third: the step is
/// that of the sphere, and shorter as the area of the surface is larger.
#[test]
fn critical_step_of_a_rigid_sphere_falls_with_its_partners_area() {
    let rigid = BodyInput::Rigid { radius: 1.0, mass: 1e-6 };
    let (model, mut state) = with_deformed_upper([rigid, glass_sphere(8.0, Side::Above)], 100.0);
    // Onto the rigid sphere, and into it a little.
    let place = |[r, y]: [f64; 2]| {
        let wider = 0.33 * r;
        let depth = |r: f64| 1.0 - (1.0 - r * r).max(0.36).sqrt();
        let down = depth(r + wider) + depth(r) + 1e-3;
        [wider, -down * (1.0 - (y - depth(r))).max(0.0)]
    };
    let nodes = model.bodies()[1].mesh().unwrap().nodes();
    state.bodies[1].displacement = nodes.iter().map(|node| place(*node)).collect();
    let ratio = critical_step_in_contact(&model, &state) / model.time_step();
    // What springs add to dashpots is 2e-5 of the step. Without the sphere it would be 2e4 times as long.
    assert!((ratio * 1.33f64.powi(2) - 1.0).abs() < 1e-4, "{ratio}");
}

/// Every step of a collision is below the critical one of the bodies as they are then, springs included.
#[test]
fn every_step_of_a_collision_is_stable() {
    let sphere = glass_sphere(4.0, Side::Above);
    // St Venant and Kirchhoff's law does not bear it: it softens in compression.
    for law in HyperelasticLaw::ALL.into_iter().take(3) {
        // Half of the speed of shear waves.
        let approach = Approach::new([0.0, -0.5], 0.0).unwrap();
        // On springs that do not follow the surface, which leave the least room.
        let mesh = sphere.mesh().unwrap();
        let upper = Surface::of_sphere(mesh);
        let springs = ContactInterface::new(Surface::wall(), upper, 1.0, 0.0, 0.9).unwrap();
        let contact = Some(Box::new(Springs::Undeformed(springs)) as Box<dyn Contact>);
        let parts = ModelParts { contact, ..upper_at_finite_strain(law) };
        let settings = Settings { candidate_radius: 0.9, ..settings() };
        let bodies = [BodyInput::Wall, sphere.clone()];
        let (model, mut state) = started(bodies, approach, &settings, parts);
        let mut scratch = Scratch::new(&model);
        let (mut largest, mut at_first) = (0.0f64, 0.0f64);
        for step in 0..400 {
            update_forces(&model, &state, &mut scratch).unwrap();
            update_time_step(&model, &mut state, &mut scratch).unwrap();
            if step % 20 == 0 {
                let stiffness =
                    largest_eigenvalue(&tangent(&model, &state, &[1]), &[&model.bodies()[1]]);
                let half = stiffness.sqrt() / 2.0;
                largest = largest.max(state.time_step(&model) * half);
                at_first = at_first.max(model.time_step() * half);
            }
            advance(&model, &mut state, &mut scratch);
        }
        // The step factor and what the bound leaves; the first step would have used that up.
        assert!(largest < 0.8 && largest > 0.65, "{law:?} {largest}");
        assert!(at_first > 0.9, "{law:?} {at_first}");
    }
}

/// A bound costs as much as ten updates: there is one in ten steps at most. Fast elements that do not decide on
/// the step would have one in three steps.
#[test]
fn critical_step_is_computed_at_most_every_tenth_step() {
    let bodies = [BodyInput::Wall, glass_sphere(16.0, Side::Above)];
    let settings = Settings { candidate_radius: 0.9, ..settings() };
    let approach = Approach::new([0.0, -0.3], 0.0).unwrap();
    let parts = upper_at_finite_strain(HyperelasticLaw::NeoHooke);
    let (model, mut state) = started(bodies, approach, &settings, parts);
    let mut scratch = Scratch::new(&model);
    let (mut n_steps, mut n_bounds) = (0, 0);
    while state.time < 3.0 {
        update_forces(&model, &state, &mut scratch).unwrap();
        n_steps += 1;
        n_bounds += u32::from(state.step_control.unwrap().is_bound_due(state.step));
        update_time_step(&model, &mut state, &mut scratch).unwrap();
        advance(&model, &mut state, &mut scratch);
    }
    assert!(10 * n_bounds < n_steps, "{n_bounds} of {n_steps}");
}

/// Every step of two spheres that flatten each other until their flanks bulge is below the critical one of
/// both, their contact included; and flanks that touch nothing ask for no shorter one.
#[test]
fn every_step_of_bulging_spheres_is_stable() {
    for (stiffness, range, least) in [(1.0, 0.7..0.8, 0.5), (20.0, 0.42..0.5, 0.9)] {
        let bodies = [glass_sphere(4.0, Side::Below), glass_sphere(5.0, Side::Above)];
        let approach = Approach::new([0.6, -0.6], 0.0).unwrap();
        let law = Some(HyperelasticLaw::NeoHooke);
        let parts = ModelParts { finite_strain: [law; 2], ..ModelParts::default() };
        let settings =
            Settings { contact_stiffness: stiffness, candidate_radius: 0.999, ..settings() };
        let (model, mut state) = started(bodies, approach, &settings, parts);
        let mut scratch = Scratch::new(&model);
        let (mut largest, mut shortest) = (0.0f64, 1.0f64);
        for step in 0..600 {
            update_forces(&model, &state, &mut scratch).unwrap();
            update_time_step(&model, &mut state, &mut scratch).unwrap();
            // Elements that are strained fast may ask for less.
            let critical = step_demand(&model, &state, &mut scratch).critical_time_step;
            let allowed = (model.step_factor() * critical).min(model.time_step());
            // Nothing looks ahead from the first steps, in which nothing is strained.
            if step > 4 {
                shortest = shortest.min(allowed / model.time_step());
            }
            if step % 20 == 0 {
                let time_step = state.time_step(&model).max(allowed);
                let [lower, upper] = model.bodies();
                let tangent = tangent(&model, &state, &[0, 1]);
                let stiffness = largest_eigenvalue(&tangent, &[lower, upper]);
                largest = largest.max(time_step * stiffness.sqrt() / 2.0);
            }
            advance(&model, &mut state, &mut scratch);
        }
        assert!(range.contains(&largest), "{stiffness} {largest}");
        assert!(shortest > least, "{stiffness} {shortest}");
    }
}

/// A flank that stands upright where it is closed: no step is short enough, and the stop names the contact and
/// the place, not the element that happens to be compressed most.
#[test]
fn too_short_a_step_names_the_contact_on_steep_flanks() {
    let law = Some(HyperelasticLaw::NeoHooke);
    let parts = ModelParts { finite_strain: [law; 2], ..ModelParts::default() };
    let settings = Settings { candidate_radius: 0.999, ..settings() };
    let bodies = [Side::Below, Side::Above].map(|side| glass_sphere(4.0, side));
    let (model, mut state) = started(bodies, Approach::at(1.0).unwrap(), &settings, parts);
    state.step = 100;
    let mut scratch = Scratch::new(&model);
    assert!(update_time_step(&model, &mut state.clone(), &mut scratch).is_ok());
    // As deep in each other as they are high, so that the flanks overlap, too.
    state.bodies[1].displacement.fill([0.0, -2.5]);
    let nodes = model.bodies()[1].mesh().unwrap().nodes();
    let candidates: Vec<_> = Surface::of_sphere(model.bodies()[1].mesh().unwrap())
        .nodes_within(1.0)
        .iter()
        .map(|&node| node as usize)
        .collect();
    let [.., inner, outer] = candidates[..] else { panic!() };
    state.bodies[1].displacement[outer][0] = nodes[inner][0] - nodes[outer][0] + 1e-9;
    let fault = update_time_step(&model, &mut state, &mut scratch).unwrap_err();
    let stop = fault.stop(&model, &state);
    // The springs of the flank hold a node of either body, and that which is lighter is named.
    let Stop::NoStepShortEnough {
        at: StepInstant { step: 100, .. },
        body,
        place,
        of_contact: true,
        ..
    } = stop
    else {
        panic!("{stop:?}")
    };
    assert!(place[0] >= nodes[inner][0], "{place:?}");
    let text = stop.to_string();
    let whose = ["lower", "upper"][body];
    let expected = format!("the contact, on steep flanks, at a node of the {whose} body");
    assert!(text.contains(&expected), "{text}");
}
