//! Tests of relaxing elements: limit of small strain, energy, objectivity, and internal variables.

use fem_material::finite::{Viscoelastic, ViscousStrain};
use fem_material::{ActsOn, RelaxationStep};

use super::super::block::{load_three, place};
use super::super::hourglass::Deformed;
use super::super::internal_variables::FIELDS_PER_TERM;
use super::super::law::RelaxingLaw;
use super::*;
use crate::test_support::{March, relaxing_glass, scaled};

const MODES: [ActsOn; 2] = [ActsOn::All, ActsOn::Shear];

/// Every law, with every way to relax.
fn laws_and_modes() -> impl Iterator<Item = (HyperelasticLaw, ActsOn)> {
    HyperelasticLaw::ALL.into_iter().flat_map(|law| MODES.map(|acts_on| (law, acts_on)))
}

/// Terms that are fast and slow compared with the paths of the tests, and an equilibrium modulus.
const TERMS: [(f64, f64); 2] = [(0.3, 0.2), (0.5, 2.0)];

/// Shares of a deformation over time, up and back.
const PATH: [(f64, f64); 4] = [(0.05, 0.6), (0.2, 1.0), (1.0, 0.7), (0.1, -0.2)];

/// The difference to the small-strain element, whose terms relax alike, is of second order.
#[test]
fn small_strain_relaxation_is_the_limit() {
    let mesh = mesh();
    let shape = ragged(&mesh, 4);
    for acts_on in MODES {
        let material = relaxing_glass(&TERMS, acts_on);
        for law in HyperelasticLaw::ALL {
            let error = |scale: f64| {
                let small =
                    small_strain(mesh.nodes().len(), mesh.quads(), &geometries(&mesh), &material);
                let mut small = March::new(small, &mesh, PATH[0].0);
                let mut finite = March::new(stress(&mesh, &material, law), &mesh, PATH[0].0);
                for (time_step, share) in PATH {
                    let u = scaled(&shape, scale * share);
                    small.step(time_step, &u);
                    finite.step(time_step, &u);
                }
                let exact = vector(&small.forces());
                (vector(&finite.forces()) - &exact).amax() / exact.amax()
            };
            let (one, half) = (error(2e-5), error(1e-5));
            let order = (one / half).log2();
            assert!((order - 1.0).abs() < 0.01, "{law:?} {acts_on:?}: {order} {one:e} {half:e}");
        }
    }
}

/// A body that is deformed and held for a while.
fn held(law: HyperelasticLaw, acts_on: ActsOn) -> (SphereMesh, March) {
    let mesh = mesh();
    let stress = stress(&mesh, &relaxing_glass(&TERMS, acts_on), law);
    let mut march = March::new(stress, &mesh, 0.3);
    let u = deformed(&mesh);
    for share in [0.4, 1.0, 0.9] {
        march.step(0.3, &scaled(&u, share));
    }
    (mesh, march)
}

/// Forces are the derivative of the stored energy at fixed internal variables.
#[test]
fn forces_are_the_derivative_of_the_stored_energy() {
    for (law, acts_on) in laws_and_modes() {
        let (_, march) = held(law, acts_on);
        assert_forces_are_slopes(&march.forces(), &march.u, |u| march.energies(u).0, &law);
    }
}

/// Work of the forces is stored or dissipated, up to the second order of the step.
#[test]
fn work_of_relaxing_elements_is_stored_or_dissipated() {
    let mesh = mesh();
    let shape = deformed(&mesh);
    for (law, acts_on) in laws_and_modes() {
        let material = relaxing_glass(&TERMS, acts_on);
        let residual = |n: u32| {
            let time_step = 1.0 / f64::from(n);
            let mut march = March::new(stress(&mesh, &material, law), &mesh, time_step);
            let (mut work, mut dissipated) = (0.0, 0.0);
            let (mut f, mut power) = (vector(&march.forces()), 0.0);
            for k in 1..=n {
                let t = f64::from(k) * time_step;
                let before = vector(&march.u);
                // There, and a third of the way back.
                march.step(time_step, &scaled(&shape, t * t * (3.0 - 2.3 * t)));
                let (f_next, power_next) = (vector(&march.forces()), march.energies(&march.u).1);
                work -= 0.5 * (&f + &f_next).dot(&(vector(&march.u) - before));
                dissipated += 0.5 * time_step * (power + power_next);
                (f, power) = (f_next, power_next);
            }
            assert!(dissipated > 0.02 * work, "{law:?}: {dissipated} of {work}");
            (work - march.energies(&march.u).0 - dissipated) / work
        };
        let (coarse, fine) = (residual(40), residual(80));
        let order = (coarse / fine).abs().log2();
        assert!((order - 2.0).abs() < 0.2, "{law:?} {acts_on:?}: {order} {coarse:e} {fine:e}");
        assert!(fine.abs() < 1e-3, "{law:?} {acts_on:?}: {fine:e}");
    }
}

/// Internal variables belong to the undeformed element: a rotation turns stress and amplitude forces.
#[test]
fn a_rotation_turns_relaxed_stress() {
    let series_of = relaxing_glass(&TERMS, ActsOn::All);
    let series = series_of.relaxation().unwrap();
    for law in HyperelasticLaw::ALL {
        let solid = Hyperelastic::new(law, series_of.instantaneous());
        let law =
            RelaxingLaw::of(&Viscoelastic::new(&solid, series), solid.shear_modulus(), series);
        let mut past = law.undeformed();
        let splat = Plain::<WIDE>::splat;
        let strain = |rr, yy, ry, volume| ViscousStrain {
            rr: splat(rr),
            yy: splat(yy),
            ry: splat(ry),
            volume_change: splat(volume),
        };
        past.metrics[0] = strain(-0.3, 0.4, 0.2, 0.1).inverse_metric();
        past.metrics[1] = strain(-0.1, 0.1, -0.1, -0.1).inverse_metric();
        past.amplitudes[0] = (splat(0.1), splat(0.2));
        past.amplitudes[1] = (splat(-0.1), splat(0.05));
        let at = |angle: f64| conjugate_with(&law, &past, turned(F, angle), turn(Q, angle));
        let (stress, force) = at(0.0);
        for angle in [0.1, 1.0, 2.5, -2.0] {
            let (expected, expected_force) = (turned(stress, angle), turn(force, angle));
            let (found, found_force) = at(angle);
            let all = found.iter().chain(&found_force);
            for (found, expected) in all.zip(expected.iter().chain(&expected_force)) {
                // Rounding: the volume is 60, the stiffness 3.
                assert!((found - expected).abs() < 1e-12, "{angle}: {found} {expected}");
            }
        }
    }
}

/// An amplitude on an undeformed element flows as a Maxwell element does, exactly.
#[test]
fn a_held_amplitude_relaxes_exactly() {
    let (mesh, hold) = (mesh(), 0.7);
    let material = relaxing_glass(&TERMS, ActsOn::Shear);
    let mut march = March::new(stress(&mesh, &material, HyperelasticLaw::NeoHooke), &mesh, 0.1);
    let (u, blocks) = (deformed(&mesh), every(&mesh));
    march.step(1e-12, &u);
    let at_once = march.history.clone();
    march.step(hold, &u);
    for (term, (_, time)) in TERMS.iter().enumerate() {
        let decay = RelaxationStep::new(*time, hold).decay;
        for element in 0..mesh.quads().len() {
            let (slots, lane) = blocks.slot(element);
            let all = blocks.checked(&[u.len()]);
            let block = &all[place(element, all.len()).0];
            // SAFETY: the field has been checked.
            let strain = unsafe { Deformation::<Plain<WIDE>>::gather(block, &u) };
            let unit = Plain::<WIDE>::splat(1.0);
            let measures = load_three(&block.measures);
            let own = Deformed::of(&strain.h, unit, measures).pull_back(strain.q);
            let own = (own.0.to_array()[lane], own.1.to_array()[lane]);
            let flown = slots.pair(lane, &march.history[FIELDS_PER_TERM * term + 2]);
            let before = slots.pair(lane, &at_once[FIELDS_PER_TERM * term + 2]);
            let error = (own.0 - flown[0]) - decay * (own.0 - before[0]);
            // Rounding of amplitudes of a hundredth.
            assert!(error.abs() < 1e-15, "{error:e}");
            assert!((own.0 - flown[0]).abs() <= own.0.abs());
        }
    }
}

/// Each element has a place of its own, also where lanes are empty.
#[test]
fn history_slots_store_each_element_once() {
    let mesh = mesh();
    let geometries = geometries(&mesh);
    for n_elements in [96, 95, 91, 89, 57, 12, 9, 7, 1] {
        let blocks = Blocks::pack(&mesh, &geometries, &leading(n_elements));
        let mut field = vec![[f64::NAN; 2]; n_elements];
        for place in 0..n_elements.div_ceil(WIDE) {
            let numbers =
                |shift: f64| std::array::from_fn(|lane| (10 * place + lane) as f64 + shift);
            let (first, second) = (numbers(0.0), numbers(0.5));
            let load = <Plain<WIDE> as Lanes<WIDE>>::load;
            blocks.slots(place).store(&mut field, load(&first), load(&second));
        }
        for element in 0..n_elements {
            let (slots, lane) = blocks.slot(element);
            let number = (10 * (element % n_elements.div_ceil(WIDE)) + lane) as f64;
            assert_eq!(slots.pair(lane, &field), [number, number + 0.5], "{element} {n_elements}");
            let (first, _) = slots.load::<Plain<WIDE>>(&field);
            assert_eq!(first.to_array()[lane], number);
        }
    }
}
