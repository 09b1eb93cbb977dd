//! The elements at finite strain: derivatives, objectivity, patches, the limit of small strain.

use fem_material::finite::{AxisymmetricTensor, Number};
use fem_material::{ActsOn, ElasticModuli, PronySeries, PronyTerm};
use fem_mesh::Side;

use super::super::small_strain;
use super::block::Block;
use super::kernel::{Conjugate, Deformation};
use super::law::Law;
use super::*;
use crate::lanes::{Lanes, Plain, WIDE};
use crate::test_support::{
    assert_balance, assert_forces_are_slopes, geometries, ragged, sphere, still, unit_glass,
    unit_sphere, vector,
};

/// ν = 0.495 with the shear modulus of the unit glass.
fn nearly_incompressible() -> Material {
    let moduli = ElasticModuli::from_youngs_modulus_poissons_ratio(2.0 * 1.495, 0.495).unwrap();
    Material::new(1.0, moduli, None).unwrap()
}

/// 96 elements of four blocks' shapes.
fn mesh() -> SphereMesh {
    unit_sphere(8.0, Side::Above)
}

mod flow;
mod relaxation;

fn leading(n_elements: usize) -> Vec<usize> {
    (0..n_elements).collect()
}

fn every(mesh: &SphereMesh) -> Blocks {
    Blocks::pack(mesh, &geometries(mesh), &leading(mesh.quads().len()))
}

fn stress(
    mesh: &SphereMesh,
    material: &Material,
    law: HyperelasticLaw,
) -> Box<dyn FiniteStrainStress> {
    finite_strain(mesh, &geometries(mesh), &leading(mesh.quads().len()), material, law)
}

fn forces(stress: &dyn Stress, u: &Field) -> Vec<[f64; 2]> {
    let mut f = vec![[0.0; 2]; u.len()];
    stress.subtract_forces(&still(u), &[], &mut f).unwrap();
    f
}

fn energy(stress: &dyn Stress, u: &Field) -> f64 {
    let mut accounts = Accounts::default();
    stress.add_energies(&still(u), &[], &mut accounts);
    accounts.energies.get(Account::Strain).unwrap()
}

/// The cost of forces of elements near first touch: nodes are numbered from there, and at most 1.4 nodes per element
/// are cleared and added.
#[test]
fn elements_near_first_touch_have_the_first_nodes() {
    let mesh = sphere(0.02, 0.1, Side::Above);
    let middle = |element: &usize| {
        let corners = mesh.corners(*element);
        let [r, y] = [0, 1].map(|axis: usize| corners.iter().map(|x| x[axis]).sum::<f64>() / 4.0);
        r.hypot(y)
    };
    for radius in [0.2, 0.5, 1.0] {
        let n = mesh.quads().len();
        let near: Vec<_> = (0..n).filter(|element| middle(element) <= radius).collect();
        let nodes = Blocks::pack(&mesh, &geometries(&mesh), &near).nodes();
        assert!(nodes.start == 0 && nodes.len() > near.len(), "{nodes:?}");
        assert!(5 * nodes.len() < 7 * near.len(), "{radius}: {nodes:?} of {}", near.len());
    }
    assert_eq!(every(&mesh).nodes(), 0..mesh.nodes().len());
    assert_eq!(Blocks::pack(&mesh, &geometries(&mesh), &[]).nodes(), 0..0);
}

/// Stretched by a third along y, pressed by a quarter along r, sheared, and ragged.
fn deformed(mesh: &SphereMesh) -> Vec<[f64; 2]> {
    let noise = ragged(mesh, 3);
    let places = mesh.nodes().iter().zip(&noise);
    places
        .map(|([r, y], n)| {
            [r * (0.1 * y - 0.25) + 0.03 * n[0], 0.33 * y + 0.2 * r * r + 0.03 * n[1]]
        })
        .collect()
}

/// Forces of every law are the slope of its energy, in a patch where no element is like another.
#[test]
fn finite_strain_forces_are_the_derivative_of_the_energy() {
    let mesh = mesh();
    let u = deformed(&mesh);
    for law in HyperelasticLaw::ALL {
        let stress = stress(&mesh, &unit_glass(), law);
        assert_forces_are_slopes(&forces(&*stress, &u), &u, |u| energy(&*stress, u), &law);
    }
}

/// A uniform stretch: the stress of the law everywhere, no force on any node inside, energy W V.
#[test]
fn a_large_uniform_stretch_is_exact() {
    let mesh = mesh();
    let on_surface: Vec<_> = mesh.surface().to_vec();
    let volume: f64 = geometries(&mesh).iter().map(|geometry| geometry.volume).sum();
    for material in [unit_glass(), nearly_incompressible()] {
        for law in HyperelasticLaw::ALL {
            let solid = Hyperelastic::new(law, material.instantaneous());
            for (radial, axial) in [(0.6, -0.5), (-0.4, 1.2), (-0.3, -0.3), (0.4, 0.0)] {
                let u: Vec<_> =
                    mesh.nodes().iter().map(|[r, y]| [radial * r, 3.0 + axial * y]).collect();
                let stress = stress(&mesh, &material, law);
                let h =
                    AxisymmetricTensor { rr: radial, yy: axial, tt: radial, ..Default::default() };
                let exact = solid.cauchy(&h).unwrap();
                let scale = material.instantaneous().bulk_modulus();
                let mut cells = Vec::new();
                stress.update_cauchy_stress(&u, &[], &mut cells);
                for [rr, yy, tt, ry] in cells {
                    // Rounding of a translation of 3 over elements of 1/8 against the stiffness.
                    for error in [rr - exact.rr, yy - exact.yy, tt - exact.tt, ry] {
                        assert!(error.abs() < 1e-12 * scale, "{law:?}: {error:e}");
                    }
                }
                let f = forces(&*stress, &u);
                for node in (0..f.len()).filter(|&node| !on_surface.contains(&(node as u32))) {
                    // On the axis the sum of the hoop forces is taken up by the axis.
                    let radial =
                        if mesh.axis().contains(&(node as u32)) { 0.0 } else { f[node][0] };
                    // The same, of forces of stress times element size.
                    assert!(
                        radial.abs() + f[node][1].abs() < 1e-12 * scale,
                        "{node}: {:?}",
                        f[node]
                    );
                }
                let stored = energy(&*stress, &u) / (volume * solid.energy(&h).unwrap());
                assert!((stored - 1.0).abs() < 1e-12, "{law:?}: {stored}");
            }
        }
    }
}

/// A quad far from the axis and no two of whose sides are alike.
fn far_quad() -> Block {
    let corners = [[10.0, 0.1], [10.9, -0.1], [11.2, 1.0], [9.9, 0.8]];
    let mut block = Block::EMPTY;
    block.put(0, &[0, 1, 2, 3], &QuadGeometry::new(&corners));
    block
}

fn tensor([rr, ry, yr, yy, tt]: [f64; 5]) -> AxisymmetricTensor<Plain<WIDE>> {
    let splat = Plain::<WIDE>::splat;
    AxisymmetricTensor { rr: splat(rr), ry: splat(ry), yr: splat(yr), yy: splat(yy), tt: splat(tt) }
}

fn first([rr, ry, yr, yy, tt]: [Plain<WIDE>; 5]) -> [f64; 5] {
    [rr, ry, yr, yy, tt].map(|lanes| lanes.to_array()[0])
}

/// A deformation gradient (rr, ry, yr, yy, tt) and an amplitude.
const F: [f64; 5] = [0.6, 0.3, -0.2, 1.5, 1.2];
const Q: [f64; 2] = [0.2, -0.3];

/// Returns the derivatives for a deformed quad with an hourglass amplitude: stress (rr, ry, yr, yy, tt) and amplitude
/// forces.
fn conjugate_with<W: Law>(
    law: &W,
    internal: &W::Internal<Plain<WIDE>>,
    [rr, ry, yr, yy, tt]: [f64; 5],
    q: [f64; 2],
) -> ([f64; 5], [f64; 2]) {
    let h = tensor([rr - 1.0, ry, yr, yy - 1.0, tt - 1.0]);
    let strain = Deformation { h, q: (Plain::<WIDE>::splat(q[0]), Plain::<WIDE>::splat(q[1])) };
    let Conjugate { stress, q } = strain.conjugate(&far_quad(), law, internal);
    let stress = first([stress.rr, stress.ry, stress.yr, stress.yy, stress.tt]);
    (stress, [q.0.to_array()[0], q.1.to_array()[0]])
}

fn conjugate(law: &impl Law, f: [f64; 5], q: [f64; 2]) -> ([f64; 5], [f64; 2]) {
    conjugate_with(law, &law.undeformed(), f, q)
}

fn turn([x, y]: [f64; 2], angle: f64) -> [f64; 2] {
    let (sin, cos) = angle.sin_cos();
    [cos * x - sin * y, sin * x + cos * y]
}

/// The meridian part of a tensor after a rotation.
fn turned([rr, ry, yr, yy, tt]: [f64; 5], angle: f64) -> [f64; 5] {
    let ([rr, yr], [ry, yy]) = (turn([rr, yr], angle), turn([ry, yy], angle));
    [rr, ry, yr, yy, tt]
}

/// A rotation of the meridian part turns stress and amplitude forces with it, and nothing else.
#[test]
fn a_rotation_turns_stress_and_hourglass_forces() {
    for law in HyperelasticLaw::ALL {
        let solid = Hyperelastic::new(law, unit_glass().instantaneous());
        let (stress, force) = conjugate(&solid, F, Q);
        for angle in [0.1, 1.0, 2.5, -2.0] {
            let (found, found_force) = conjugate(&solid, turned(F, angle), turn(Q, angle));
            let (expected, expected_force) = (turned(stress, angle), turn(force, angle));
            let all = found.iter().chain(&found_force);
            for (found, expected) in all.zip(expected.iter().chain(&expected_force)) {
                // Rounding: the volume is 60, the stiffness 3.
                assert!((found - expected).abs() < 1e-12, "{law:?} {angle}: {found} {expected}");
            }
        }
        // A rotation alone gives none.
        let (stress, force) = conjugate(&solid, turned([1.0, 0.0, 0.0, 1.0, 1.0], 0.7), [0.0; 2]);
        assert!(stress.iter().chain(&force).all(|x| x.abs() < 1e-12), "{law:?} {stress:?}");
    }
}

/// The difference to the small-strain element is of second order in the displacement.
#[test]
fn small_strain_is_the_limit() {
    let mesh = mesh();
    for material in [unit_glass(), nearly_incompressible()] {
        let small = small_strain(mesh.nodes().len(), mesh.quads(), &geometries(&mesh), &material);
        let shape = ragged(&mesh, 4);
        for law in HyperelasticLaw::ALL {
            let finite = stress(&mesh, &material, law);
            let error = |scale: f64| {
                let u: Vec<_> = shape.iter().map(|u| u.map(|u| scale * u)).collect();
                let exact = vector(&forces(&*small, &u));
                (vector(&forces(&*finite, &u)) - &exact).amax() / exact.amax()
            };
            let (one, half) = (error(2e-5), error(1e-5));
            let order = (one / half).log2();
            // The force itself is of first order.
            assert!((order - 1.0).abs() < 0.01, "{law:?}: {order} {one:e} {half:e}");
        }
    }
}

/// A rigid translation gives exactly no force. Axial momentum: the forces of any deformation sum to zero.
#[test]
fn finite_strain_internal_forces_balance() {
    let mesh = mesh();
    for law in HyperelasticLaw::ALL {
        let stress = stress(&mesh, &unit_glass(), law);
        let u = vec![[0.0, 1.234_567e3]; mesh.nodes().len()];
        assert!(forces(&*stress, &u).iter().flatten().all(|f| *f == 0.0), "{law:?}");
        assert_eq!(energy(&*stress, &u), 0.0, "{law:?}");
        assert_balance(&forces(&*stress, &deformed(&mesh)));
    }
}

/// An inverted element, or one whose displacement is not a number, is reported by its number.
#[test]
fn a_collapsed_element_is_named() {
    let mesh = mesh();
    for law in HyperelasticLaw::ALL {
        let stress = stress(&mesh, &unit_glass(), law);
        let collapse_of = |u: &Field| {
            stress.subtract_forces(&still(u), &[], &mut vec![[0.0; 2]; u.len()]).unwrap_err()
        };
        // J = 1 − 2 c y: inside out at the far pole, and most at y = 2.
        let c = 0.3;
        let u: Vec<_> = mesh.nodes().iter().map(|[_, y]| [0.0, -c * y * y]).collect();
        let height = |element: usize| mesh.corners(element).iter().map(|x| 0.25 * x[1]).sum();
        let heights: Vec<f64> = (0..mesh.quads().len()).map(height).collect();
        let top = (0..heights.len()).max_by(|&a, &b| heights[a].total_cmp(&heights[b])).unwrap();
        let collapse = collapse_of(&u);
        assert_eq!(collapse.element, top, "{law:?}");
        // The mean over the volume is not that of the corners.
        assert!((collapse.volume_ratio - (1.0 - 2.0 * c * heights[top])).abs() < 0.02);
        assert!(collapse.volume_ratio < 0.0, "{collapse:?}");
        // All of it beyond the axis: J = 1.
        let u: Vec<_> = mesh.nodes().iter().map(|[r, _]| [-2.0 * r, 0.0]).collect();
        let collapse = collapse_of(&u);
        // Rounding.
        assert!((collapse.volume_ratio + 1.0).abs() < 1e-12, "{law:?} {collapse:?}");
        for wrong in [f64::NAN, f64::INFINITY] {
            let mut u = deformed(&mesh);
            u[mesh.quads()[5][2] as usize][1] = wrong;
            let collapse = collapse_of(&u);
            assert!(mesh.quads()[collapse.element].contains(&mesh.quads()[5][2]), "{law:?}");
        }
    }
}

/// Under equal pressure from all sides St Venant-Kirchhoff's law loses ellipticity in shear at λ² = 1/(1 + 2G/3K):
/// every element is unstable from there on and none before, also with relaxation. The element under the highest
/// pressure is reported. Neo-Hooke's law is not asked.
#[test]
fn the_element_that_has_lost_its_stability_is_named() {
    let mesh = mesh();
    let material = unit_glass();
    let moduli = material.instantaneous();
    let term = PronyTerm { weight: 0.5, relaxation_time: 1.0 };
    let series = PronySeries::new(vec![term], ActsOn::All).unwrap();
    let relaxing = Material::new(material.density(), *moduli, Some(series)).unwrap();
    let limit = (1.0 + 2.0 * moduli.shear_modulus() / (3.0 * moduli.bulk_modulus())).sqrt().recip();
    for material in [&material, &relaxing] {
        let stress = stress(&mesh, material, HyperelasticLaw::SaintVenantKirchhoff);
        let at = |stretch: f64, more: f64| {
            let of = |[r, y]: &[f64; 2]| [(stretch - 1.0) * r, (stretch - 1.0) * y - more * y * y];
            let u: Vec<_> = mesh.nodes().iter().map(of).collect();
            let n_fields = stress.n_element_history();
            let mut history = vec![vec![[0.0; 2]; mesh.quads().len()]; n_fields];
            history.extend(vec![vec![[0.0; 2]; u.len()]; stress.n_history()]);
            stress.start_deformed(&u, &mut history);
            stress.unstable_element(&u, &history)
        };
        assert!(stress.can_lose_stability());
        // Differences of the stress over 1e-6 know the slope to 1e-6 of it.
        assert_eq!(at(limit + 1e-4, 0.0), None);
        let found = at(limit - 1e-4, 0.0).unwrap();
        assert_eq!(found.law, "saint-venant-kirchhoff");
        assert!(found.stretches.iter().all(|x| (x - limit + 1e-4).abs() < 1e-9), "{found:?}");
        // Pressed most where y is largest.
        let found = at(limit + 1e-4, 1e-2).unwrap();
        let height =
            |element: usize| mesh.corners(element).iter().map(|x| 0.25 * x[1]).sum::<f64>();
        let top = (0..mesh.quads().len()).map(height).fold(f64::NEG_INFINITY, f64::max);
        assert!(height(found.element) > 0.9 * top, "{found:?}");
    }
    assert!(!stress(&mesh, &material, HyperelasticLaw::NeoHooke).can_lose_stability());
}

/// The strain rate of a uniformly stretched body, undeformed and deformed; where a node has a smaller allowance, the
/// elements around it decide.
#[test]
fn the_strain_rate_is_that_of_the_fastest_element() {
    let mesh = mesh();
    let stress = stress(&mesh, &unit_glass(), HyperelasticLaw::NeoHooke);
    let field = |[r, y]: [f64; 2]| -> Vec<[f64; 2]> {
        mesh.nodes().iter().map(|node| [r * node[0], y * node[1]]).collect()
    };
    let rest = field([0.0, 0.0]);
    for (strain, velocity, rate) in [
        ([0.0, 0.0], [0.5, -2.0], 2.0),
        ([0.0, 0.0], [3.0, -2.0], 3.0),
        // Ḟ F⁻¹: of what is there now.
        ([0.25, -0.5], [0.5, -2.0], 4.0),
        ([-0.75, 0.0], [0.5, -1.0], 2.0),
    ] {
        let (displacement, velocity) = (field(strain), field(velocity));
        let motion = Motion { velocity: &velocity, ..still(&displacement) };
        let found = stress.strain_rate(&motion);
        assert!((found / rate - 1.0).abs() < 1e-12, "{strain:?}: {found}");
        let mut room = vec![0.5; rest.len()];
        let urgency = stress.allowance_rate(&motion, &room);
        assert!((urgency / rate - 2.0).abs() < 1e-12, "{strain:?}: {urgency}");
        room[mesh.quads()[3][2] as usize] = 0.05;
        let urgency = stress.allowance_rate(&motion, &room);
        assert!((urgency / rate - 20.0).abs() < 1e-9, "{strain:?}: {urgency}");
    }
    let mut velocity = rest.clone();
    velocity[mesh.quads()[7][1] as usize][0] = f64::NAN;
    assert!(stress.strain_rate(&Motion { velocity: &velocity, ..still(&rest) }).is_nan());
}
