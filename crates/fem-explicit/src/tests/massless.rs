//! The step and the balance of a boundary without mass.

use fem_collision::Approach;
use nalgebra::DMatrix;

use super::stability::{both_closed, pair, partly_closed};
use crate::contact::SmallStrainContact;
use crate::model::{ExplicitBodies, ModelParts};
use crate::run::{advance, update_forces};
use crate::settings::Settings;
use crate::state::{Scratch, State};
use crate::test_support::{relaxing_glass, settings, tangent, unit_glass};
use fem_contact::SlippingInterface;
use fem_material::{ActsOn, ElasticModuli, Material};

/// Rows (r, y) of the nodes of both bodies that have mass, with its root, and of those without that can
/// move.
fn rows(model: &ExplicitBodies) -> (Vec<(usize, f64)>, Vec<usize>) {
    let (mut heavy, mut bare, mut first) = (Vec::new(), Vec::new(), 0);
    for (side, body) in model.bodies().iter().enumerate() {
        let massless = model.contact().massless_nodes(side);
        let nodes = body.mesh().unwrap().nodes();
        for (node, place) in nodes.iter().enumerate() {
            for axis in 0..2 {
                let row = 2 * (first + node) + axis;
                if body.inverse_mass[node][axis] > 0.0 {
                    heavy.push((row, body.nodal_mass[node].sqrt()));
                } else if massless.contains(&(node as u32)) && (axis == 1 || place[0] > 0.0) {
                    bare.push(row);
                }
            }
        }
        first += nodes.len();
    }
    (heavy, bare)
}

/// Largest ω² of the nodes with mass, where those without are in balance with a stiffness.
fn largest_square(stiffness: &DMatrix<f64>, model: &ExplicitBodies) -> f64 {
    let (heavy, bare) = rows(model);
    let rows: Vec<usize> = heavy.iter().map(|(row, _)| *row).collect();
    let block = |a: &[usize], b: &[usize]| {
        DMatrix::from_fn(a.len(), b.len(), |i, j| stiffness[(a[i], b[j])])
    };
    let across = block(&bare, &rows);
    let inner = block(&bare, &bare).cholesky().expect("a boundary that resists").solve(&across);
    let mut of_heavy = block(&rows, &rows) - across.transpose() * inner;
    for (i, (_, of_i)) in heavy.iter().enumerate() {
        for (j, (_, of_j)) in heavy.iter().enumerate() {
            of_heavy[(i, j)] /= of_i * of_j;
        }
    }
    of_heavy.symmetric_eigenvalues().max()
}

/// Whatever is closed and however stiff: without the springs in the bound, and with the elements that
/// lost corners.
#[test]
fn massless_critical_step_is_safe_and_independent_of_springs() {
    for sizes in [[0.25, 0.25], [0.25, 0.125], [0.25, 0.05]] {
        let mut steps = Vec::new();
        for stiffness in [1.0, 100.0, 1e4] {
            let settings =
                Settings { contact_stiffness: stiffness, step_factor: 1.0, ..settings() };
            let of = |method| {
                let parts = ModelParts { method, ..ModelParts::default() };
                pair(sizes, &settings, [&unit_glass(); 2], parts)
            };
            let (model, springs) =
                (of(SmallStrainContact::Massless), of(SmallStrainContact::Penalty));
            for state in [both_closed(&springs), partly_closed(&springs)] {
                let square = largest_square(&tangent(&springs, &state, &[0, 1]), &model);
                let ratio = model.time_step() * square.sqrt() / 2.0;
                // As of bodies alone.
                assert!(ratio <= 1.0 && ratio > 0.7, "{stiffness} {sizes:?}: {ratio}");
            }
            steps.push(model.time_step());
        }
        assert!(steps.iter().all(|step| *step == steps[0]), "{steps:?}");
    }
}

/// Returns the largest unbalanced force at a massless node over the sixty steps after first touch, over the largest
/// force of elements, for straight and for slipping springs.
fn worst_lack(stiffness: f64, materials: [&Material; 2], slips_at: Option<f64>) -> f64 {
    let surface_slip = slips_at.is_some();
    let settings = Settings { contact_stiffness: stiffness, ..settings() };
    let approach = Approach::at(slips_at.unwrap_or(1.0)).unwrap();
    let model = |method, surface_slip| {
        let parts = ModelParts { method, surface_slip, ..ModelParts::default() };
        pair([0.125, 0.1], &settings, materials, parts).approaching(approach)
    };
    let straight = model(SmallStrainContact::Penalty, false).interface().expect("springs").clone();
    let slipping = SlippingInterface::new(straight.clone());
    let model = model(SmallStrainContact::Massless, surface_slip);
    let (mut state, mut scratch) = (State::at_first_touch(&model), Scratch::new(&model));
    let (mut n_closed, mut worst) = (0, 0.0f64);
    for _ in 0..60 {
        update_forces(&model, &state, &mut scratch).unwrap();
        advance(&model, &mut state, &mut scratch);
        let mut forces = scratch.forces.clone();
        for side in 0..2 {
            let body = &model.bodies()[side];
            let clock = state.clock(&model);
            state.bodies[side].update_internal_forces(body, clock, &mut forces[side]).unwrap();
        }
        let largest = forces.concat().as_flattened().iter().fold(0.0, |a: f64, b| a.max(b.abs()));
        let [lower, upper] = &mut forces;
        let u = state.bodies.each_ref().map(|body| body.displacement.as_slice());
        n_closed += match surface_slip {
            true => slipping.add_forces(u, [lower, upper]),
            false => straight.add_forces(u, [lower, upper]),
        }
        .n_closed;
        for side in 0..2 {
            for &node in model.contact().massless_nodes(side) {
                let on_axis = model.bodies()[side].mesh().unwrap().nodes()[node as usize][0] == 0.0;
                let [r, y] = forces[side][node as usize];
                let lack = if on_axis { y.abs() } else { r.abs().max(y.abs()) };
                worst = worst.max(lack / (1.0 + largest));
            }
        }
    }
    assert!(n_closed > 60, "{n_closed}");
    worst
}

/// At the end of each step nothing pulls at the bare nodes: what is handed over to their neighbours is
/// rounding of the forces of elements.
#[test]
fn massless_nodes_are_in_balance() {
    let relaxing = |acts_on| relaxing_glass(&[(0.4, 0.3), (0.5, 3.0)], acts_on);
    for glass in [unit_glass(), relaxing(ActsOn::All), relaxing(ActsOn::Shear)] {
        let lack = worst_lack(50.0, [&glass, &glass], None);
        // Rounding of displacements of size 0.1 times stiffness of size 1, and of the solution.
        assert!(lack < 1e-13, "{lack:e}");
    }
}

/// Nor where springs turn, by up to a tenth: to what ends the passes. In one pass it would be 1e-5.
#[test]
fn slipping_massless_nodes_are_in_balance() {
    let moduli = ElasticModuli::from_youngs_modulus_poissons_ratio(0.3, 0.0).unwrap();
    let soft = Material::new(1.0, moduli, None).unwrap();
    let relaxing = relaxing_glass(&[(0.4, 0.3), (0.5, 3.0)], ActsOn::Shear);
    for upper in [unit_glass(), relaxing] {
        for stiffness in [0.5, 50.0, 5e3] {
            let lack = worst_lack(stiffness, [&soft, &upper], Some(0.2));
            assert!(lack < 1e-7, "{stiffness}: {lack:e}");
        }
    }
}
