//! Random scenes that every model takes: linear, of finite spheres, within small strain.
//!
//! Sizes span two decades and their ratio three, moduli four and three, densities one and three;
//! Poisson's ratios are −0.3 to 0.48, speeds 1e-6 to 5e-4 of the slower wave speed. A body has up to three
//! terms of relaxation with rates of 0.01 to 10 over a guess of the contact time. A tenth of the scenes is
//! against a wall, a tenth of identical bodies, a tenth on a half-space.

/// A generator of numbers in [0, 1): SplitMix64, Steele et al. 2014.
pub(in crate::studies) struct Random(u64);

impl Random {
    pub fn new(seed: u64) -> Self {
        Self(seed)
    }

    fn next(&mut self) -> f64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        ((z ^ (z >> 31)) >> 11) as f64 * 2f64.powi(-53)
    }

    pub fn within(&mut self, from: f64, to: f64) -> f64 {
        from + (to - from) * self.next()
    }

    /// The numbers below `n`, shuffled (Fisher & Yates).
    pub fn order(&mut self, n: usize) -> Vec<usize> {
        let mut order: Vec<usize> = (0..n).collect();
        for k in (1..n).rev() {
            order.swap(k, (self.next() * (k + 1) as f64) as usize);
        }
        order
    }

    /// Ten to the power of what lies between.
    fn decades(&mut self, from: f64, to: f64) -> f64 {
        10f64.powf(self.within(from, to))
    }
}

/// A material and its wave speed.
struct Drawn {
    table: String,
    wave_speed: f64,
}

/// `contact_time` is a guess, s.
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
pub(in crate::studies) enum Ratios {
    /// Up to thirty.
    Usual,
    /// Thirty to two hundred in size, up to 1e4 in stiffness: one of them is often as good as rigid.
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

/// Returns random overrides of a case of two spheres.
pub(in crate::studies) fn overrides(random: &mut Random) -> Vec<String> {
    overrides_of(random, Ratios::Usual)
}

/// Returns random overrides with the given ranges of ratios.
pub(in crate::studies) fn overrides_of(random: &mut Random, ratios: Ratios) -> Vec<String> {
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
    // Hertz', of equal spheres.
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
