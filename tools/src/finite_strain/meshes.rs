//! Soft spheres on meshes of half and twice the plan's resolution.

use rayon::prelude::*;

use super::collide::{Fault, Numbers, signed, simulation};

const BALL: &str = include_str!("../../../validation/soft_spheres/ball_on_wall.toml");
const TWO_BALLS: &str = include_str!("../../../validation/soft_spheres/two_balls.toml");
const STEEL: &str = include_str!("../../../validation/soft_spheres/steel_on_rubber.toml");

const NU_49: &str = "material.rubber.poissons_ratio=0.49";
const RELAXING: &str = "material.rubber.relaxation={ acts_on = 'shear', terms = \
                        [{ weight = 0.3, relaxation_time = '1 ms' }] }";
const SLOW: &str = "body.1.approach_speed='1 m/s'";
const MIDDLE: &str = "body.1.approach_speed='3 m/s'";
const FAST: &str = "body.1.approach_speed='10 m/s'";

const SCENES: [(&str, &str, &[&str]); 12] = [
    ("on a wall, ν = 0.45, 1 m/s", BALL, &[SLOW]),
    ("on a wall, ν = 0.45, 3 m/s", BALL, &[MIDDLE]),
    ("on a wall, ν = 0.45, 10 m/s", BALL, &[FAST]),
    ("on a wall, ν = 0.49, 1 m/s", BALL, &[NU_49, SLOW]),
    ("on a wall, ν = 0.49, 3 m/s", BALL, &[NU_49, MIDDLE]),
    ("on a wall, ν = 0.49, 10 m/s", BALL, &[NU_49, FAST]),
    ("relaxing, ν = 0.45, 1 m/s", BALL, &[RELAXING, SLOW]),
    ("relaxing, ν = 0.45, 3 m/s", BALL, &[RELAXING, MIDDLE]),
    ("relaxing, ν = 0.49, 10 m/s", BALL, &[NU_49, RELAXING, FAST]),
    ("steel, 10 mm, on it, 3 m/s", STEEL, &[]),
    (
        "of 10 mm, struck by steel of 30 mm, 3 m/s",
        STEEL,
        &["body.0.sphere.diameter='10 mm'", "body.1.sphere.diameter='30 mm'"],
    ),
    ("on one of 20 mm, three times as stiff, 5 m/s", TWO_BALLS, &[]),
];

/// Element sizes over the plan's.
const SIZES: [f64; 3] = [2.0, 1.0, 0.5];

pub fn table() -> Result<String, Fault> {
    let lines: Vec<String> = SCENES
        .par_iter()
        .map(|(name, text, set)| line(name, text, set))
        .collect::<Result<_, _>>()?;
    let head = "| ball of rubber, 30 mm | e | 2 h: Δe | ΔT | ΔF | h: Δe | ΔT | ΔF |\n\
                |---|---|---|---|---|---|---|---|\n";
    Ok(format!("{head}{}", lines.concat()))
}

fn line(name: &str, text: &str, set: &[&str]) -> Result<String, Fault> {
    let set: Vec<String> = set.iter().map(|key| (*key).to_string()).collect();
    let usual = simulation(text, &set)?;
    let plan = usual.setup().elements.as_ref().ok_or("no elements")?;
    let size = plan.plan.contact_element_size;
    let numbers = SIZES.map(|factor| {
        let size = format!("mesh.contact_element_size={}", factor * size);
        let set: Vec<String> = set.iter().cloned().chain([size]).collect();
        let numbers = Numbers::of(&simulation(text, &set)?);
        numbers.ok_or_else(|| Fault::from(format!("{name}: stopped at {factor} h")))
    });
    let [coarse, usual, fine] = numbers;
    let fine = fine?;
    let mut cells = vec![name.to_string(), format!("{:.4}", fine.restitution)];
    for numbers in [coarse?, usual?] {
        let changes = numbers.against(&fine);
        cells.push(signed(changes.restitution, 4));
        cells.extend([changes.time, changes.force].map(|share| signed(100.0 * share, 2)));
    }
    Ok(format!("| {} |\n", cells.join(" | ")))
}
