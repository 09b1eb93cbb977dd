//! The friction laws of DEM codes in an oblique impact, and the tangential stiffness with which each comes nearest to the computed rebound.
//!
//! A code keeps one displacement s, or one force T, where the real contact sticks inside a ring that slides. With the contact radius a,
//! the normal load F, the tangential modulus G\* of the pair (8 times LAMMPS' own, [`fem_laws::TangentialContact`]) and k = f 2G\*a:
//!
//! | law | tangential force | at its limit μF | when the contact shrinks |
//! |---|---|---|---|
//! | [`Mindlin`](FrictionLaw::Mindlin) | k s | s = μF/k | |
//! | [`MindlinForce`](FrictionLaw::MindlinForce) | ∫k ds | T = μF | |
//! | [`MindlinRescaleForce`](FrictionLaw::MindlinRescaleForce) | ∫k ds | T = μF | T falls as a |
//! | [`Linear`](FrictionLaw::Linear) | f k_n s | s = μF/(f k_n) | |
//! | [`Sliding`](FrictionLaw::Sliding) | none until the patch stands, and then what keeps it there | T = μF | |
//!
//! The results are compared as y = v_t′/(μv_n) over x = v_t/(μv_n), v_t and v_t′ the velocity of the patch before and after, v_n the
//! approach speed; they depend on μ through x alone.

use fem_laws::{ImpactPath, LawError};

use crate::estimate::Model;

/// Steps of a contact.
const N_STEPS: usize = 1000;
/// Factors on the stiffness among which the best one is searched.
const FACTORS: (f64, f64) = (0.2, 3.0);
/// Factors in equal ratios at which the search begins.
const N_FACTORS: usize = 12;

/// How a code computes a tangential force; the table is above.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum FrictionLaw {
    /// Displacement times the stiffness of the present contact.
    Mindlin,
    /// The stiffness of the present contact times each increment of displacement.
    MindlinForce,
    /// As [`FrictionLaw::MindlinForce`], but the force falls with the radius of a contact that shrinks.
    MindlinRescaleForce,
    /// A linear spring.
    Linear,
    /// No spring: the patch slides until it stands.
    Sliding,
}

/// The rebound of the patch over the angle, to which laws are fitted.
#[derive(Debug, Clone, PartialEq)]
pub struct PatchRebound {
    /// Coulomb's coefficient of friction μ.
    pub friction: f64,
    /// Tangential modulus G\* of the pair before relaxation, Pa.
    pub modulus: f64,
    /// m\* over the mass of the patch.
    pub mass_ratio: f64,
    /// Approach speed, m/s.
    pub speed: f64,
    /// x: velocity of the patch before over μv_n.
    pub before: Vec<f64>,
    /// y: velocity of the patch after over μv_n.
    pub after: Vec<f64>,
}

/// A law with its best or its fixed stiffness.
#[derive(Debug, Clone, PartialEq)]
pub struct FittedFriction {
    /// The tangential law of the code.
    pub law: FrictionLaw,
    /// f: the stiffness over that of Mindlin, of a linear spring over k_n; 0 of [`FrictionLaw::Sliding`].
    pub factor: f64,
    /// y that the law makes.
    pub after: Vec<f64>,
    /// √(Σ (y − y_i)²/N).
    pub rms: f64,
    /// Largest |y − y_i|.
    pub worst: f64,
}

/// A normal impact as the tangential law sees it, in equal steps.
struct Loads {
    step: f64,
    /// Load (N) and contact radius (m) at the end of each step.
    at: Vec<[f64; 2]>,
}

impl FrictionLaw {
    /// Returns the law of a word of the snippets.
    pub(super) fn of_word(word: &str) -> Option<Self> {
        Some(match word {
            "mindlin" => Self::Mindlin,
            "mindlin/force" => Self::MindlinForce,
            "mindlin_rescale/force" => Self::MindlinRescaleForce,
            "linear" => Self::Linear,
            "sliding" => Self::Sliding,
            _ => return None,
        })
    }
}

impl Loads {
    fn of(model: &Model, values: &[f64], speed: f64) -> Result<Self, LawError> {
        let impact = model.impact(values, speed)?;
        let law = model.law(values).transpose()?;
        let path = ImpactPath::new(&impact, model.pair(), law.as_ref());
        let end = impact.history.last().map_or(0.0, |instant| instant.time);
        let step = end / N_STEPS as f64;
        let at = (1..=N_STEPS).filter_map(|k| path.at(k as f64 * step));
        let at = at.map(|instant| {
            let radius = (model.pair().effective_radius() * instant.approach.max(0.0)).sqrt();
            [instant.force.abs(), radius]
        });
        Ok(Self { step, at: at.collect() })
    }
}

impl PatchRebound {
    /// Returns a law beside a normal law with these values, with a given factor on its stiffness or the best one. The stiffness of a
    /// linear normal law is the unit of a linear spring.
    ///
    /// # Errors
    /// The normal law rejects its values or the speed.
    pub fn fit(
        &self,
        law: FrictionLaw,
        given: Option<f64>,
        (model, values): (&Model, &[f64]),
    ) -> Result<FittedFriction, LawError> {
        let mass = model.pair().effective_mass() / self.mass_ratio;
        if law == FrictionLaw::Sliding {
            let lost = self.mass_ratio * (1.0 + model.impact(values, self.speed)?.restitution);
            let after = self.before.iter().map(|x| (x - lost).max(0.0)).collect();
            return Ok(self.judged(law, 0.0, after));
        }
        let loads = Loads::of(model, values, self.speed)?;
        let unit = match law {
            FrictionLaw::Linear => {
                model.law(values).transpose()?.map_or(0.0, |law| law.stiffness())
            }
            _ => 2.0 * self.modulus,
        };
        let scale = self.friction * self.speed;
        let made = |factor: f64| {
            let after = self
                .before
                .iter()
                .map(|x| loads.rebound(law, factor * unit, self.friction, mass, scale * x) / scale);
            self.judged(law, factor, after.collect())
        };
        if let Some(factor) = given {
            return Ok(made(factor));
        }
        let ratio = (FACTORS.1 / FACTORS.0).powf(1.0 / (N_FACTORS - 1) as f64);
        let tried = (0..N_FACTORS).map(|k| made(FACTORS.0 * ratio.powi(k as i32)));
        let best = tried.min_by(|one, other| one.rms.total_cmp(&other.rms));
        let Some(mut best) = best else { return Ok(made(1.0)) };
        // The neighbours of the best factor enclose the minimum.
        let mut width = ratio.ln();
        while width > 1e-4 {
            width *= 0.5;
            for side in [-width, width] {
                let next = made(best.factor * side.exp());
                if next.rms < best.rms {
                    best = next;
                }
            }
        }
        Ok(best)
    }

    /// Returns Walton's β₀ for a restitution e, by least squares of y = −β₀x of a patch that sticks, and x − (m\*/m_t)(1 + e) of one that
    /// slides throughout.
    pub fn walton(&self, restitution: f64) -> FittedFriction {
        let lost = self.mass_ratio * (1.0 + restitution);
        let made = |beta: f64| {
            let after = self.before.iter().map(|x| (-beta * x).max(x - lost)).collect();
            self.judged(FrictionLaw::Sliding, beta, after)
        };
        let tried = (0..=1000).map(|k| made(1e-3 * f64::from(k)));
        let best = tried.min_by(|one, other| one.rms.total_cmp(&other.rms));
        best.unwrap_or_else(|| made(0.0))
    }

    fn judged(&self, law: FrictionLaw, factor: f64, after: Vec<f64>) -> FittedFriction {
        let errors = || after.iter().zip(&self.after).map(|(made, wanted)| (made - wanted).abs());
        let rms = (errors().map(|error| error * error).sum::<f64>() / after.len() as f64).sqrt();
        let worst = errors().fold(0.0, f64::max);
        FittedFriction { law, factor, after, rms, worst }
    }
}

impl Loads {
    /// Returns the velocity of the patch after the impact, m/s, by the leapfrog of the codes.
    fn rebound(
        &self,
        law: FrictionLaw,
        stiffness: f64,
        friction: f64,
        mass: f64,
        before: f64,
    ) -> f64 {
        let (mut velocity, mut force, mut stretch, mut last_radius) = (before, 0.0, 0.0f64, 0.0);
        for [load, radius] in &self.at {
            velocity -= 0.5 * self.step * force / mass;
            let moved = self.step * velocity;
            let now = match law {
                FrictionLaw::Linear => stiffness,
                _ => stiffness * radius,
            };
            let limit = friction * load;
            force = match law {
                FrictionLaw::MindlinForce => force + now * moved,
                FrictionLaw::MindlinRescaleForce if *radius < last_radius => {
                    force * radius / last_radius + now * moved
                }
                FrictionLaw::MindlinRescaleForce => force + now * moved,
                _ => now * (stretch + moved),
            };
            force = force.clamp(-limit, limit);
            stretch = if now > 0.0 { force / now } else { 0.0 };
            last_radius = *radius;
            velocity -= 0.5 * self.step * force / mass;
        }
        velocity
    }
}
