//! Random scenes within small strain, which every model supports: linear materials and finite spheres.
//!
//! Sizes span two decades and their ratio three, moduli four and three, densities one and three;
//! Poisson's ratios are −0.3 to 0.48, speeds 1e-6 to 5e-4 of the slower wave speed. A body has up to three
//! Prony terms with rates of 0.01 to 10 over an estimate of the contact time. A tenth of the scenes has a
//! wall, a tenth identical bodies, a tenth a half-space.

use super::Random;

struct Drawn {
    table: String,
    wave_speed: f64,
}

/// Draws a material; `contact_time` is an estimate, s.
fn material(random: &mut Random, contact_time: f64, stiffness: f64, density: f64) -> Drawn {
    let poissons_ratio = random.within(-0.3, 0.48);
    let acts_on = if random.next() < 0.5 { "all" } else { "shear" };
    let n_terms = (random.next() * 4.0) as usize;
    let total = random.within(0.02, 0.9);
    let terms: Vec<String> = (0..n_terms)
        .map(|_| {
            let rate = random.decades(-2.0, 1.0) / contact_time;
            let weight = total / n_terms as f64;
            format!("{{weight={weight:.4},decay_rate={rate:.4e}}}")
        })
        .collect();
    let relaxation = match terms.is_empty() {
        true => String::new(),
        false => format!(",relaxation={{acts_on='{acts_on}',terms=[{}]}}", terms.join(",")),
    };
    let table = format!(
        "{{density={density:.4e},youngs_modulus={stiffness:.4e},\
         poissons_ratio={poissons_ratio:.3}{relaxation}}}"
    );
    Drawn { table, wave_speed: (stiffness / density).sqrt() }
}

/// Range of the ratios of the bodies' sizes and stiffnesses.
#[derive(Clone, Copy, PartialEq)]
pub(super) enum Ratios {
    /// Up to thirty.
    Usual,
    /// Thirty to two hundred in size, up to 1e4 in stiffness: one of the bodies is often nearly rigid.
    Extreme,
}

impl Ratios {
    fn size(self, random: &mut Random) -> f64 {
        match self {
            Self::Usual => random.decades(-1.5, 1.5),
            Self::Extreme if random.next() < 0.5 => random.decades(-2.3, -1.5),
            Self::Extreme => random.decades(1.5, 2.3),
        }
    }

    fn stiffness(self, random: &mut Random) -> f64 {
        match self {
            Self::Usual => random.decades(-1.5, 1.5),
            Self::Extreme => random.decades(-4.0, 4.0),
        }
    }
}

/// Returns the overrides that make a random scene of a case of two spheres.
pub(super) fn overrides(random: &mut Random, ratios: Ratios) -> Vec<String> {
    let diameters = {
        let first = random.decades(-3.0, -1.0);
        [first, first * ratios.size(random)]
    };
    let (stiffness, density) = (random.decades(7.0, 11.0), random.decades(3.0, 4.0));
    let stiffnesses = [stiffness, stiffness * ratios.stiffness(random)];
    let densities = [density, density * random.decades(-1.5, 1.5)];
    let slowest = [0, 1].map(|k| (stiffnesses[k] / densities[k]).sqrt());
    let slowest = slowest[0].min(slowest[1]);
    let mach = random.decades(-6.0, -3.3);
    let smallest = diameters[0].min(diameters[1]);
    // Hertz' contact time of equal spheres.
    let contact_time = 2.0 * smallest / slowest * mach.powf(-0.2);
    let partner = random.next();
    let mut set = Vec::new();
    let mut drawn = Vec::new();
    for k in 0..2 {
        let made = material(random, contact_time, stiffnesses[k], densities[k]);
        set.push(format!("material.m{k}={}", made.table));
        drawn.push(made.wave_speed);
    }
    let sphere = |name: &str, diameter: f64, material: &str, speed: f64| {
        format!(
            "{{name='{name}',sphere={{diameter={diameter:.4e}}},material='{material}',\
             approach_speed={speed:.4e}}}"
        )
    };
    let speed = mach * drawn[0].min(drawn[1]);
    set.push(format!("body.0={}", sphere("a", diameters[0], "m0", speed)));
    set.push(match partner {
        wall if wall < 0.1 => "body.1={name='b',wall={}}".to_string(),
        twin if twin < 0.2 => format!("body.1={}", sphere("b", diameters[0], "m0", 0.0)),
        block if block < 0.3 => "body.1={name='b',half_space={},material='m1'}".to_string(),
        _ => format!("body.1={}", sphere("b", diameters[1], "m1", 0.0)),
    });
    set
}
