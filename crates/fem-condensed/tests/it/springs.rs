//! Penalty springs of any stiffness: softer than the bodies up to far stiffer than the elements.

use crate::common::{GLASS, POLYMER, STEEL, Scene, collide, glass, material};
use fem_collision::Collision;
use fem_condensed::{CondensedPair, ContactModel, PairSettings};
use fem_material::ActsOn::All;

/// Times E* a spring's stiffness per area over the element size, at a factor of 1.
const USUAL: f64 = 20.0;
/// From springs that are softer than the bodies up to those that leave no overlap; closely where more
/// Gauss points begin to close than there are nodes to move.
const FACTORS: [f64; 19] = [
    1e-3, 1e-2, 0.1, 0.5, 2.0, 7.0, 15.0, 22.0, 27.0, 33.0, 45.0, 60.0, 80.0, 110.0, 145.0, 170.0,
    300.0, 2e3, 1e4,
];

fn springs(scene: &Scene, elements: f64, factor: f64) -> Collision {
    let stiffness = factor * USUAL * scene.pair().contact_modulus();
    // Soft springs make the contact half as wide again.
    let radius = 2.5 * scene.hertz().max_contact_radius();
    let contact = ContactModel::Springs(stiffness);
    let settings = PairSettings { contact, ..PairSettings::new(radius) };
    collide(&CondensedPair::new(scene.inputs(elements), settings).unwrap(), scene.speed)
}

fn scenes() -> Vec<(&'static str, Scene)> {
    let polymer = material(POLYMER, All, &[]);
    let relaxing = material(GLASS, All, &[(1.0, 2708.0)]);
    vec![
        ("pair", Scene::paper(glass(), glass())),
        ("wall", Scene { bodies: [None, Some((15.9e-3, glass()))], speed: 0.5 }),
        (
            "unlike",
            Scene {
                bodies: [Some((5e-3, polymer)), Some((22.2e-3, material(STEEL, All, &[])))],
                speed: 0.1,
            },
        ),
        ("relaxing", Scene::paper(relaxing.clone(), relaxing)),
    ]
}

/// A spring in series with the bodies adds its compliance: the changes of contact time and force are of first order
/// in 1/k, which falls with the element size. Times the factor they are up to 1.3e-3 and 1.0e-3 with eight
/// elements; those of stiff springs scatter by 5e-5. A contact that ends at the last point has a
/// time 27 % too long.
#[test]
fn the_effect_of_springs_falls_with_their_stiffness() {
    for (name, scene) in scenes() {
        let elements: &[f64] = if name == "pair" { &[5.0, 8.0, 13.0] } else { &[8.0] };
        for &elements in elements {
            let values = |collision: Collision| {
                // Up to 2.1e-4, of points that close within a step.
                let residual = collision.residual_relative.unwrap();
                assert!(residual < 5e-4, "{name} {elements}: {residual:.1e}");
                [collision.contact_time.unwrap(), collision.peak_force.unwrap()]
            };
            let [time, force] = values(springs(&scene, elements, 1e5));
            // Down to the difference between nodes and Gauss points, springs are exact contact.
            let exact = scene.collide(&scene.condensed(elements)).contact_time.unwrap();
            let off = (time / exact - 1.0).abs();
            assert!(off < 1.5e-3 || elements < 8.0, "{name} {elements}: {time:e} {exact:e}");
            for factor in FACTORS {
                let found = values(springs(&scene, elements, factor));
                let off = [found[0] / time - 1.0, 1.0 - found[1] / force];
                let most = 1.5e-3 * (8.0 / elements) / factor + 1e-4;
                assert!(
                    off.iter().all(|off| off.abs() < most),
                    "{name}, {elements} elements, factor {factor}: {off:?} of {most:.1e}"
                );
            }
        }
    }
}

/// A region that ends inside of the contact is detected for any pattern of closed points: the same
/// collision in a larger region, or none.
#[test]
fn too_small_candidate_region_is_detected_for_any_spring_stiffness() {
    let scene = Scene::paper(glass(), glass());
    let contact_radius = scene.hertz().max_contact_radius();
    for factor in FACTORS {
        let stiffness = factor * USUAL * scene.pair().contact_modulus();
        let contact = ContactModel::Springs(stiffness);
        let at = |radius: f64| {
            let settings = PairSettings { contact, ..PairSettings::new(radius) };
            CondensedPair::new(scene.inputs(8.0), settings)
                .and_then(|pair| pair.impact(scene.speed, pair.relaxations(), 100))
        };
        // Soft springs make the contact half as wide again.
        let whole = at(2.5 * contact_radius).unwrap().contact_time.unwrap();
        for share in [0.3, 0.45, 0.6, 0.75, 0.8, 0.85, 0.9, 0.95, 1.0] {
            if let Ok(found) = at(share * contact_radius) {
                let off = found.contact_time.unwrap() / whole - 1.0;
                assert!(off.abs() < 1e-4, "factor {factor}, {share} of the contact: {off:.1e}");
            }
        }
    }
}
