//! A body with elements at small and at finite strain equals a body of a single kind where strains are small.

use fem_collision::Account;
use fem_material::{ActsOn, FlowRule};
use fem_mesh::Side;

use super::*;
use crate::stress::{FiniteStrainChoice, stress_of_body};
use crate::test_support::{
    March, assert_forces_are_slopes, geometries, ragged, relaxing_glass, scaled, still, unit_glass,
    unit_sphere,
};

const LAW: HyperelasticLaw = HyperelasticLaw::NeoHooke;

fn mesh() -> SphereMesh {
    unit_sphere(8.0, Side::Above)
}

fn materials() -> [Material; 3] {
    let terms = [(0.3, 0.7), (0.2, 5.0)];
    [unit_glass(), relaxing_glass(&terms, ActsOn::All), relaxing_glass(&terms, ActsOn::Shear)]
}

/// Forces, stored energy, power and stress of the elements.
type Answer = (Vec<[f64; 2]>, f64, f64, Vec<[f64; 4]>);

fn answer(stress: Box<dyn Stress>, mesh: &SphereMesh, u: &Field) -> Answer {
    let mut march = March::new(stress, mesh, 0.1);
    (1..=4).for_each(|k| march.step(0.1, &scaled(u, 0.25 * f64::from(k))));
    let ((stored, power), mut cauchy) = (march.energies(u), Vec::new());
    if let Some(finite) = march.stress.strain_measure().finite() {
        finite.update_cauchy_stress(u, &march.history, &mut cauchy);
    }
    (march.forces(), stored, power, cauchy)
}

fn finite(stress: &dyn Stress) -> &dyn FiniteStrainStress {
    stress.strain_measure().finite().unwrap()
}

/// As far as the body goes, and not at all: the bits of one kind alone.
#[test]
fn finite_strain_radius_of_zero_or_beyond_the_body_gives_one_kind() {
    let mesh = mesh();
    let (geometries, u) = (geometries(&mesh), scaled(&ragged(&mesh, 3), 0.02));
    for material in materials() {
        let near = finite_strain_within(f64::INFINITY, &mesh, &geometries, &material, LAW);
        let all = finite_strain_within(3.0, &mesh, &geometries, &material, LAW);
        assert!(answer(near, &mesh, &u) == answer(all, &mesh, &u));
        let none = finite_strain_within(1e-3, &mesh, &geometries, &material, LAW);
        assert!(none.strain_measure().finite().is_none());
    }
}

/// A body that flows has elements at finite strain, however small the radius: those at small strain do not flow.
#[test]
fn a_body_that_flows_has_elements_at_finite_strain() {
    let mesh = mesh();
    let material = unit_glass().with_flow(FlowRule::perfect(1e-3).unwrap()).unwrap();
    let stress = |within| {
        let choice = FiniteStrainChoice { law: HyperelasticLaw::Hencky, within };
        stress_of_body(&mesh, &geometries(&mesh), &material, Some(choice)).unwrap()
    };
    for (within, is_partly) in [(1e-3, false), (0.7, true)] {
        let stress = stress(Some(within));
        assert!(stress.strain_measure().finite().is_some(), "{within}");
        assert_eq!(format!("{stress:?}").starts_with("PartlyFinite"), is_partly, "{stress:?}");
    }
}

/// Where all is small both kinds are the same, whichever element has which: forces, energies, stresses at
/// the places of the elements; and where nothing is small they are not.
#[test]
fn finite_and_small_strain_elements_agree_at_small_strain_only() {
    let mesh = mesh();
    let geometries = geometries(&mesh);
    for material in materials() {
        for (size, is_small) in [(1e-7, true), (0.02, false)] {
            let u = scaled(&ragged(&mesh, 3), size);
            let whole = answer(
                finite_strain_within(f64::INFINITY, &mesh, &geometries, &material, LAW),
                &mesh,
                &u,
            );
            let partly = finite_strain_within(0.7, &mesh, &geometries, &material, LAW);
            let text = format!("{partly:?}");
            let (forces, stored, power, cauchy) = answer(partly, &mesh, &u);
            let of = |x: &[[f64; 2]]| x.iter().flatten().fold(0.0, |a: f64, b| a.max(b.abs()));
            let largest = of(&whole.0);
            let change: Vec<_> =
                forces.iter().zip(&whole.0).map(|(f, g)| [f[0] - g[0], f[1] - g[1]]).collect();
            let stress = whole.3.iter().flatten().fold(0.0, |a: f64, b| a.max(b.abs()));
            let apart = cauchy
                .iter()
                .flatten()
                .zip(whole.3.iter().flatten())
                .fold(0.0, |a: f64, (x, y)| a.max((x - y).abs()));
            let errors = [
                of(&change) / largest,
                (stored / whole.1 - 1.0).abs(),
                if whole.2 > 0.0 { (power / whole.2 - 1.0).abs() } else { 0.0 },
                apart / stress,
            ];
            // 1e-7 a size and eight elements across: strains of 1e-6.
            let is_same = errors.iter().all(|error| *error < 1e-5);
            assert_eq!(is_same, is_small, "{text}: {errors:?}");
        }
    }
}

/// Forces are the derivative of the energy of both kinds together.
#[test]
fn partly_finite_forces_are_the_derivative_of_the_energy() {
    let mesh = mesh();
    let (geometries, u) = (geometries(&mesh), scaled(&ragged(&mesh, 3), 0.02));
    let stress = finite_strain_within(0.7, &mesh, &geometries, &unit_glass(), LAW);
    let energy = |u: &Field| {
        let mut accounts = Accounts::default();
        stress.add_energies(&still(u), &[], &mut accounts);
        accounts.energies.get(Account::Strain).unwrap()
    };
    let mut forces = vec![[0.0; 2]; u.len()];
    stress.subtract_forces(&still(&u), &[], &mut forces).unwrap();
    assert_forces_are_slopes(&forces, &u, energy, &LAW);
}

/// A collapsed element has its number in the body.
#[test]
fn an_element_is_named_by_its_number_in_the_body() {
    let mesh = mesh();
    let geometries = geometries(&mesh);
    let stress = finite_strain_within(0.7, &mesh, &geometries, &unit_glass(), LAW);
    for element in [5, 17, 40] {
        let mut u = vec![[0.0; 2]; mesh.nodes().len()];
        let middle = mesh.corners(element).iter().map(|x| x[1]).sum::<f64>() / 4.0;
        for &node in &mesh.quads()[element] {
            u[node as usize][1] = -1.5 * (mesh.nodes()[node as usize][1] - middle);
        }
        let middle = mesh.corners(element).iter().map(|x| x[0]).sum::<f64>() / 4.0;
        let is_near = middle.hypot(mesh.corners(element).iter().map(|x| x[1]).sum::<f64>() / 4.0);
        let most = finite(&*stress).most_compressed(&u);
        let whole = finite_strain_within(f64::INFINITY, &mesh, &geometries, &unit_glass(), LAW);
        let own = finite(&*whole).most_compressed(&u);
        assert_eq!(is_near <= 0.7, most == own, "{element}: {most:?} {own:?}");
    }
}
