//! Tests of flowing elements: closed forms, the limit without flow, the energy balance with an hourglass shape.

use fem_material::FlowRule;

use super::*;
use crate::test_support::{March, scaled};

const YIELD: f64 = 0.02;

fn flowing(yield_strength: f64) -> Material {
    unit_glass().with_flow(FlowRule::perfect(yield_strength).unwrap()).unwrap()
}

fn march(mesh: &SphereMesh, material: &Material) -> March {
    March::new(stress(mesh, material, HyperelasticLaw::Hencky), mesh, 0.1)
}

/// Returns stored energy and plastic work, J.
fn energies(march: &March) -> [f64; 2] {
    let mut accounts = Accounts::default();
    march.stress.add_energies(&still(&march.u), &march.history, &mut accounts);
    [Account::Strain, Account::PlasticWork].map(|account| accounts.energies.get(account).unwrap())
}

/// A body that is stretched without change of volume: Y everywhere, and plastic work Y (a − Y/3G) per volume.
#[test]
fn a_uniform_stretch_flows_as_the_closed_form() {
    let (mesh, material) = (mesh(), flowing(YIELD));
    let volume: f64 = geometries(&mesh).iter().map(|geometry| geometry.volume).sum();
    let mut march = march(&mesh, &material);
    let (n_steps, total) = (20, 0.3);
    for k in 1..=n_steps {
        let a = total * f64::from(k) / f64::from(n_steps);
        let (radial, axial) = ((-0.5 * a).exp_m1(), a.exp_m1());
        let u: Vec<_> = mesh.nodes().iter().map(|[r, y]| [radial * r, axial * y]).collect();
        march.step(0.1, &u);
    }
    let mut cells = Vec::new();
    let StrainMeasure::Finite(finite) = march.stress.strain_measure() else { panic!() };
    finite.update_cauchy_stress(&march.u, &march.history, &mut cells);
    for [rr, yy, tt, ry] in cells {
        // Uniaxial: σ_yy − σ_rr = Y.
        for error in [yy - rr - YIELD, rr - tt, ry] {
            assert!(error.abs() < 1e-10, "{error:e}");
        }
    }
    let g = material.instantaneous().shear_modulus();
    let [stored, work] = energies(&march);
    let exact = volume * YIELD * (total - YIELD / (3.0 * g));
    assert!((work / exact - 1.0).abs() < 1e-10, "{work} {exact}");
    let exact = volume * YIELD * YIELD / (6.0 * g);
    assert!((stored / exact - 1.0).abs() < 1e-9, "{stored} {exact}");
}

/// A yield strength that is never reached gives the bits of Hencky's law, forces and energy, and no plastic work.
#[test]
fn without_flow_elements_have_the_bits_of_henckys_law() {
    let mesh = mesh();
    let u = deformed(&mesh);
    let mut march = march(&mesh, &flowing(1e6));
    march.step(0.1, &scaled(&u, 0.5));
    march.step(0.1, &u);
    let elastic = stress(&mesh, &unit_glass(), HyperelasticLaw::Hencky);
    assert!(march.forces() == forces(&*elastic, &u));
    assert_eq!(energies(&march), [energy(&*elastic, &u), 0.0]);
    let bounds = [(&march.stress, &march.history[..]), (&(elastic as Box<dyn Stress>), &[])];
    let [of_flowing, of_elastic] = bounds.map(|(stress, history)| {
        let mut bound = vec![0.0; u.len()];
        let finite = stress.strain_measure().finite().unwrap();
        finite.add_stiffness_bound(&still(&u), history, &mut bound);
        bound
    });
    assert!(of_flowing == of_elastic);
}

/// The work against the forces of a ragged body, whose hourglass shapes flow too, is the stored energy and the plastic
/// work; of first order in the step, since the return takes the direction at the end of a step.
#[test]
fn work_is_stored_energy_and_plastic_work() {
    let mesh = mesh();
    let shape = deformed(&mesh);
    let residual = |n_steps: u32| {
        let mut march = march(&mesh, &flowing(YIELD));
        let (mut work, mut last) = (0.0, march.forces());
        for k in 1..=n_steps {
            // Up to 0.3 of the shape and back to 0.1.
            let part = f64::from(k) / f64::from(n_steps);
            let u = scaled(&shape, if part < 0.6 { 0.5 * part } else { 0.6 - 0.5 * part });
            let before = march.u.clone();
            march.step(0.1, &u);
            let forces = march.forces();
            for (node, (f, g)) in forces.iter().zip(&last).enumerate() {
                for axis in 0..2 {
                    work -= 0.5 * (f[axis] + g[axis]) * (u[node][axis] - before[node][axis]);
                }
            }
            last = forces;
        }
        let [stored, plastic] = energies(&march);
        assert!(plastic > 0.3 * work, "{stored} {plastic}");
        (work - stored - plastic) / work
    };
    let (coarse, fine) = (residual(200), residual(400));
    assert!(coarse.abs() < 2e-3 && (coarse / fine).abs() > 1.7, "{coarse:e} {fine:e}");
}

/// Flow needs finite strain with Hencky's law, and a material that does not relax.
#[test]
fn flow_without_its_law_is_an_error() {
    let mesh = mesh();
    let of = |choice| {
        crate::stress::stress_of_body(&mesh, &geometries(&mesh), &flowing(YIELD), choice).err()
    };
    let choice = |law| Some(crate::stress::FiniteStrainChoice { law, within: None });
    let error = |law| Some(crate::error::ModelError::FlowWithoutHencky { law });
    assert_eq!(of(None), error("none"));
    assert_eq!(of(choice(HyperelasticLaw::NeoHooke)), error("neo-hooke"));
    assert_eq!(of(choice(HyperelasticLaw::Hencky)), None);
}
