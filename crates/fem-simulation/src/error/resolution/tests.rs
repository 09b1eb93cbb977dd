//! What is known of meshes without a look at each element is what that look says.

use std::path::Path;

use fem_case::Case;

use super::*;
use crate::simulation::Simulation;

const CASE: &str = "
    [material.ball]
    density = 2000
    youngs_modulus = 1e10
    poissons_ratio = 0.3
    [[body]]
    name = 'lower'
    sphere.diameter = 0.02
    material = 'ball'
    approach_speed = 0.1
    [[body]]
    name = 'upper'
    sphere.diameter = 0.02
    material = 'ball'
    [model]
    condensed = {}
    [effects]
    finite_strain = 'off'
";

fn simulation(set: &[String]) -> Simulation {
    let case = Case::parse("case.toml", CASE, Path::new("."), set).unwrap();
    Simulation::new(case).unwrap()
}

/// Over Poisson's ratios, sizes, speeds, blocks as wide as the contact, walls and half-spaces: where it is known that
/// nothing is to be said, every element says so, too; and where so few elements are across that a word is due, it is not
/// known.
#[test]
fn what_is_known_as_fine_is_fine() {
    let (mut known, mut unknown) = (0, 0);
    let other = "body.1={ name='upper', sphere.diameter=0.002, material='ball' }";
    let block = "body.1={ name='upper', half_space={}, material='ball' }";
    let wall = "body.1={ name='upper', wall={} }";
    for poissons_ratio in [-0.5, 0.0, 0.3, 0.49] {
        for partner in ["title='two balls'", other, block, wall] {
            for speed in [1e-3, 0.1, 3.0] {
                for across in [2.5, 3.4, 4.6, 5.45, 9.0] {
                    let set = [
                        format!("material.ball.poissons_ratio={poissons_ratio}"),
                        format!("body.0.approach_speed={speed}"),
                        partner.to_string(),
                    ];
                    let radius = simulation(&set).setup().estimate.contact_radius;
                    let size = format!("mesh.contact_element_size={:e}", radius / across);
                    let refined = format!("mesh.refined_radius={:e}", 1.0001 * radius);
                    let set = [&set[..], &[size, refined]].concat();
                    let simulation = simulation(&set);
                    let (scene, meshes) = (simulation.case().scene(), simulation.model().meshes());
                    let plan = &simulation.setup().elements.as_ref().unwrap().plan;
                    let all = Resolution::of(scene, meshes, radius).unwrap();
                    if known_as_fine(scene, plan, meshes, radius) {
                        assert!(all.is_fine() && !all.is_none_at_all(), "{set:?}: {all:?}");
                        known += 1;
                    } else {
                        assert!(across < 5.0, "{set:?}: {all:?}");
                        unknown += 1;
                    }
                }
            }
        }
    }
    assert!(known > 100 && unknown > 80, "{known} {unknown}");
}

/// Meshes that are told how to grow, or have a block that ends within the contact, are looked at.
#[test]
fn what_is_told_otherwise_is_looked_at() {
    let radius = simulation(&[]).setup().estimate.contact_radius;
    let fine = format!("mesh.contact_element_size={:e}", radius / 8.0);
    let narrow = format!("mesh.refined_radius={:e}", 0.5 * radius);
    for (set, known) in [
        (vec![fine.clone()], true),
        (vec![fine.clone(), "mesh.growth=1.5".to_string()], false),
        (vec![fine, narrow], false),
    ] {
        let simulation = simulation(&set);
        let (scene, meshes) = (simulation.case().scene(), simulation.model().meshes());
        let plan = &simulation.setup().elements.as_ref().unwrap().plan;
        assert_eq!(known_as_fine(scene, plan, meshes, radius), known, "{set:?}");
    }
}
