//! Energy that a force pulse leaves in the vibrations of a sphere.
//!
//! A force F(t) on the pole drives each spheroidal mode by itself, M q̈ + Mω²q = F U(R), and
//! leaves in it
//!
//! ```math
//! E_n = \frac{U_n(R)^2}{2M_n}\left|\int F(t)\,e^{i\omega_nt}\,\mathrm dt\right|^2, \qquad
//! M_n = \rho\int|\mathbf u_n|^2\,\mathrm dV
//!   = \frac{4\pi\rho}{2l+1}\int_0^R\!\left[U_n^2+l(l+1)V_n^2\right]r^2\,\mathrm dr ,
//! ```
//!
//! u_r = U P_l, u_θ = V dP_l/dθ. The force is Hertz' and acts on a point: the sum is over waves
//! longer than the contact, which is all that a pulse of Hertz' shape excites.

use fem_laws::HertzImpact;
use fem_material::Material;

use crate::studies::vibration::{ElasticSphere, Vibration};

/// Number of points over half of a pulse.
const N_TIMES: usize = 4000;
/// Number of intervals over the radius for Simpson's rule.
const N_RADII: usize = 200;

/// A Hertz pulse, even about its middle.
pub struct Pulse {
    interval: f64,
    /// Forces at the middles of the intervals from the largest force to separation, N.
    forces: Vec<f64>,
}

impl Pulse {
    pub fn new(impact: &HertzImpact) -> Self {
        let half = 0.5 * impact.contact_time();
        let interval = half / N_TIMES as f64;
        let force = |k: usize| impact.at(half + (k as f64 + 0.5) * interval).force;
        Self { interval, forces: (0..N_TIMES).map(force).collect() }
    }

    /// Returns |∫ F e^{iωt} dt|, N s.
    fn spectrum(&self, omega: f64) -> f64 {
        let phase = omega * self.interval;
        let sum: f64 = (self.forces.iter().enumerate())
            .map(|(k, force)| force * (phase * (k as f64 + 0.5)).cos())
            .sum();
        2.0 * self.interval * sum.abs()
    }
}

/// A mode of one sphere, and the energy (J) that a pulse leaves in it.
pub struct Excited {
    pub degree: usize,
    pub overtone: usize,
    pub frequency: f64,
    pub energy: f64,
}

/// Returns all modes of a sphere (radius in m) up to a frequency ω R/c_s.
pub fn excite(material: &Material, radius: f64, pulse: &Pulse, up_to: f64) -> Vec<Excited> {
    let sphere = ElasticSphere::new(material.instantaneous().poissons_ratio());
    // The lowest frequency of a degree l is above l, that of surface waves 0.9 (l + 1/2).
    let degrees = 0..=(1.2 * up_to) as usize;
    let mass = material.density() * radius.powi(3);
    let mut all = Vec::new();
    for degree in degrees {
        for (overtone, mode) in sphere.vibrations(degree, up_to).iter().enumerate() {
            let omega = mode.frequency * material.shear_wave_speed() / radius;
            let energy = 0.5 * pulse.spectrum(omega).powi(2) * compliance(mode, degree) / mass;
            all.push(Excited { degree, overtone, frequency: mode.frequency, energy });
        }
    }
    all
}

/// Returns U(1)²/∫|u|² dV of the unit sphere.
fn compliance(mode: &Vibration, degree: usize) -> f64 {
    let l = degree as f64;
    let density = |r: f64| {
        let [radial, polar] = mode.radial_parts(r);
        r * r * (radial * radial + l * (l + 1.0) * polar * polar)
    };
    let step = 1.0 / N_RADII as f64;
    let weight = |k: usize| match k {
        N_RADII => 1.0,
        _ if k % 2 == 1 => 4.0,
        _ => 2.0,
    };
    // The first term of Simpson's rule, at the centre, is zero.
    let integral: f64 =
        (1..=N_RADII).map(|k| weight(k) * density(k as f64 * step)).sum::<f64>() * step / 3.0;
    let volume = 4.0 * std::f64::consts::PI / (2.0 * l + 1.0) * integral;
    mode.radial_parts(1.0)[0].powi(2) / volume
}
