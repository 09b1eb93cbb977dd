//! The normal contact of a collision as independent springs along the line of sliding.
//!
//! The spring at the distance x from the axis carries the line load, N/m,
//!
//! ```math
//! q(x,t) = 2\int_x^a\frac{r\,p(r,t)}{\sqrt{r^2-x^2}}\,\mathrm dr, \qquad F(t) = 2\int_0^a q(x,t)\,\mathrm dx
//! ```
//!
//! (Popov & Heß, *Method of Dimensionality Reduction in Contact Mechanics and Friction*, 2015). Under Hertz' contact of
//! relaxing bodies it is what a spring of the modulus E*(t) holds that was first pressed at the time t_x, when a² = x²:
//!
//! ```math
//! q(x,t) = \int_{t_x}^{t_1}E^*(t-s)\,\dot u(s)\,\mathrm ds, \qquad u = a^2/R^*,
//! ```
//!
//! with the t₁ of [`crate::Ting`]: the loading until then alone.

use fem_material::RelaxationStep;

use crate::error::{LawError, positive};
use crate::impact::{Impact, ImpactPath};
use crate::laws::ContactLaw;
use crate::numerics::exp;
use crate::pair::Pair;
use crate::pair_relaxation::PairRelaxation;

/// Pressure (Pa) at distances from the axis (m), from there outward.
type Profile = Vec<(f64, f64)>;

/// Number of intervals in which line loads of a mesh are kept between axis and edge.
const KNOTS: usize = 64;

/// The loads of all springs over a collision, at equal steps of time from first touch to the end of contact. A spring stands where the
/// edge of the growing contact is at the end of each step, so that it is reached there and not within a step.
#[derive(Debug, Clone, PartialEq)]
pub struct NormalSprings {
    /// Time between two instants, s.
    pub(super) time_step: f64,
    /// Distances from the axis, m.
    pub(super) places: Vec<f64>,
    /// Lengths on both sides of the axis that the springs stand for, m.
    pub(super) lengths: Vec<f64>,
    /// Line loads, N/m, of all springs at one instant after the other.
    loads: Vec<f64>,
    /// Number of springs that have been reached until each instant, from the axis outward.
    reached: Vec<usize>,
    /// The springs of a coarser reading, if the loads come from a mesh.
    coarse: Option<Box<NormalSprings>>,
}

impl NormalSprings {
    /// Number of steps of a contact by default. With half as many the velocity of the rebounding contact patch changes by up to 8e-4 of
    /// the speed of approach times the coefficient of friction; this falls with the square of the step.
    pub const N_STEPS: usize = 256;

    /// Creates the springs of an impact by a model of one degree of freedom, of which `relaxation` is that of its modulus and `law` its
    /// contact law; gravity is along the approach, m/s². Under a law the load is distributed as under Hertz' contact.
    ///
    /// # Errors
    /// Bodies that stay together; a model without a contact radius.
    pub fn of_impact(
        impact: &Impact,
        pair: &Pair,
        relaxation: &PairRelaxation,
        law: Option<&ContactLaw>,
        gravity: f64,
        n_steps: usize,
    ) -> Result<Self, LawError> {
        let contact_time = positive("contact time", impact.contact_time.unwrap_or(0.0))?;
        positive("contact radius", impact.max_contact_radius)?;
        let path = ImpactPath::new(impact, pair, law).with_gravity(gravity);
        // The contact ends within a step, so that springs that are reached at the ends of steps are not left there too where the
        // motion is symmetric: those on the edge would be open half a step too early.
        let time_step = contact_time / (n_steps as f64 + 0.5);
        let instants = (0..n_steps + 2).map(|step| path.at(step as f64 * time_step));
        let instants: Vec<_> = instants.map(Option::unwrap_or_default).collect();
        let last = impact.history.last().copied().unwrap_or_default();
        let first_rate = instants[0].approach_rate;
        let momentum = first_rate - last.approach_rate + gravity * contact_time;
        let radius = pair.effective_radius();
        let radii: Vec<_> = instants.iter().map(|instant| instant.contact_radius).collect();
        let indentations = radii.iter().map(|contact| contact * contact / radius);
        let mut relaxing = RelaxingSprings::new(relaxation, time_step, indentations.collect());
        let forces = instants.iter().map(|instant| instant.force).collect();
        let springs = Self::new(time_step, &radii, forces, |step, places, loads| {
            relaxing.press(step, &|spring| places[spring].powi(2) / radius, loads);
        });
        Ok(springs.scaled_to(pair.effective_mass() * momentum))
    }

    /// Creates the springs of a contact of a duration (s) from its forces (N) and pressures at equal steps, each given by pairs of r
    /// (m) and p (Pa) from the axis outward, between which the square of the pressure is linear in that of the radius.
    pub fn of_pressures(
        contact_time: f64,
        time_step: f64,
        forces: &[f64],
        profiles: &[Profile],
    ) -> Self {
        // The coarse reading finds the edge from its own pressures, as the mesh does from its own.
        let every_second = |profile: &Profile| -> Profile {
            let Some((edge, inner)) = profile.split_last() else { return Profile::new() };
            let mut kept: Profile = inner.iter().step_by(2).copied().collect();
            let found = match kept[..] {
                [.., (r, p), (s, q)] => (s * s + q * q * (s * s - r * r) / (p * p - q * q)).sqrt(),
                _ => edge.0,
            };
            let (least, most) = (kept.last().map_or(0.0, |it| it.0), 1.5 * edge.0);
            kept.push(if found > least && found < most { (found, 0.0) } else { *edge });
            kept
        };
        let fewer: Vec<_> = profiles.iter().step_by(2).map(every_second).collect();
        let half: Vec<_> = forces.iter().copied().step_by(2).collect();
        let coarse =
            Self::of_mesh(contact_time, 2.0 * time_step, (&half, &fewer), Self::N_STEPS / 2);
        let fine = Self::of_mesh(contact_time, time_step, (forces, profiles), Self::N_STEPS);
        Self { coarse: Some(Box::new(coarse)), ..fine }
    }

    fn of_mesh(
        contact_time: f64,
        time_step: f64,
        (forces, profiles): (&[f64], &[Profile]),
        n_steps: usize,
    ) -> Self {
        let radii: Vec<_> =
            profiles.iter().map(|profile| profile.last().map_or(0.0, |(r, _)| *r)).collect();
        let last = forces.len().min(profiles.len()).saturating_sub(1);
        let own_step = contact_time / (n_steps as f64 + 0.5);
        let place = |step: usize| {
            let at = (step as f64 * own_step / time_step).min(last as f64);
            let before = (at as usize).min(last.saturating_sub(1));
            (before, at - before as f64)
        };
        let between = |values: &[f64], (before, share): (usize, f64)| {
            let after = (before + 1).min(last);
            values[before] + share * (values[after] - values[before])
        };
        let of = |values: &[f64]| -> Vec<f64> {
            (0..n_steps + 2).map(|step| between(values, place(step))).collect()
        };
        // Line loads over the square of x/a, in which Hertz' are linear.
        let shapes = profiles.iter().zip(&radii).map(|(profile, radius)| {
            let at = |k: usize| (k as f64 / KNOTS as f64).sqrt() * radius;
            (0..=KNOTS).map(|k| line_load(profile, at(k))).collect::<Vec<_>>()
        });
        let shapes: Vec<_> = shapes.collect();
        let (edges, forces) = (of(&radii), of(forces));
        Self::new(own_step, &edges, forces, |step, places, loads| {
            let (before, share) = place(step);
            let (one, next) = (&shapes[before], &shapes[(before + 1).min(last)]);
            for (place, load) in places.iter().zip(loads) {
                let at = KNOTS as f64 * (place / edges[step]).powi(2);
                let knot = at as usize;
                let of = |shape: &[f64]| {
                    shape[knot] + (at - knot as f64) * (shape[knot + 1] - shape[knot])
                };
                let is_within = at < KNOTS as f64;
                *load = if is_within { (1.0 - share) * of(one) + share * of(next) } else { 0.0 };
            }
        })
    }

    /// Distributes the force at each step over the springs by shares that `share` writes for one step after the other from their
    /// places.
    fn new(
        time_step: f64,
        radii: &[f64],
        forces: Vec<f64>,
        mut share: impl FnMut(usize, &[f64], &mut [f64]),
    ) -> Self {
        let mut places = vec![0.0];
        let reached = radii.iter().map(|radius| {
            if *radius > places[places.len() - 1] {
                places.push(*radius);
            }
            places.len()
        });
        let reached = reached.collect();
        let lengths = lengths_of(&places);
        let n = places.len();
        let mut loads = vec![0.0; forces.len() * n];
        for (step, (loads, force)) in loads.chunks_exact_mut(n).zip(forces).enumerate() {
            share(step, &places, loads);
            let force = force.max(0.0);
            let sum: f64 = loads.iter().zip(&lengths).map(|(load, length)| load * length).sum();
            match sum > 0.0 {
                true => loads.iter_mut().for_each(|load| *load *= force / sum),
                false => loads[0] = force / lengths[0],
            }
        }
        Self { time_step, places, lengths, loads, reached, coarse: None }
    }

    /// Returns the sum of force times step, N s.
    fn impulse(&self) -> f64 {
        self.time_step * (0..=self.n_steps()).map(|step| self.force(step)).sum::<f64>()
    }

    /// Returns the springs with loads scaled to an impulse, N s, which the sum over the steps has up to their square.
    #[must_use]
    pub fn scaled_to(mut self, impulse: f64) -> Self {
        let scale = impulse / self.impulse();
        self.loads.iter_mut().for_each(|load| *load *= scale);
        self
    }

    /// Returns the number of steps.
    pub fn n_steps(&self) -> usize {
        self.loads.len() / self.places.len() - 1
    }

    /// Returns the line loads at the end of a step of the springs that have been reached until then, N/m.
    pub(super) fn at(&self, step: usize) -> &[f64] {
        &self.loads[step * self.places.len()..][..self.reached[step]]
    }

    /// Returns the force at the end of a step, N.
    pub fn force(&self, step: usize) -> f64 {
        self.at(step).iter().zip(&self.lengths).map(|(load, length)| load * length).sum()
    }

    /// Returns every second spring at every second step, or the springs of every second pressure of a mesh: of the change of an impact
    /// on them a quarter is the error of its discretisation, and changes by other causes take a quarter of the time.
    pub fn coarser(&self) -> Self {
        if let Some(coarse) = &self.coarse {
            return *coarse.clone();
        }
        let places: Vec<_> = self.places.iter().copied().step_by(2).collect();
        let rows = self.loads.chunks_exact(self.places.len()).step_by(2);
        let loads = rows.flat_map(|row| row.iter().copied().step_by(2)).collect();
        let reached = self.reached.iter().step_by(2).map(|n| n.div_ceil(2)).collect();
        let (time_step, lengths) = (2.0 * self.time_step, lengths_of(&places));
        let coarse = Self { time_step, lengths, places, loads, reached, coarse: None };
        coarse.scaled_to(self.impulse())
    }
}

/// Returns the lengths on both sides of the axis that springs at these places stand for, m.
fn lengths_of(places: &[f64]) -> Vec<f64> {
    let last = places.len() - 1;
    let length = |spring: usize| places[(spring + 1).min(last)] - places[spring.saturating_sub(1)];
    (0..places.len()).map(length).collect()
}

/// The springs of relaxing bodies, from the indentation in loading.
struct RelaxingSprings<'a> {
    relaxation: &'a PairRelaxation,
    time_step: f64,
    /// u of the contact radius at each step, m.
    indentations: Vec<f64>,
    /// Step of the largest contact.
    top: usize,
    /// Memory of each term at each step of loading, m.
    memories: Vec<Vec<f64>>,
    /// Part of it from before each spring was reached, faded until now, m.
    faded: Vec<Vec<f64>>,
}

/// A time in loading, in steps.
#[derive(Clone, Copy)]
struct LoadingTime {
    before: usize,
    /// Share of the step that follows.
    share: f64,
}

impl<'a> RelaxingSprings<'a> {
    fn new(relaxation: &'a PairRelaxation, time_step: f64, indentations: Vec<f64>) -> Self {
        let top =
            (0..indentations.len()).max_by(|a, b| indentations[*a].total_cmp(&indentations[*b]));
        let top = top.unwrap_or_default();
        let memories = relaxation.terms().iter().map(|term| {
            let of_step = RelaxationStep::new(term.relaxation_time, time_step);
            let mut memory = vec![0.0];
            for pair in indentations[..=top].windows(2) {
                let last = memory[memory.len() - 1];
                memory.push(of_step.advance(last, pair[1] - pair[0]));
            }
            memory
        });
        let memories: Vec<_> = memories.collect();
        let faded = vec![Vec::new(); memories.len()];
        Self { relaxation, time_step, indentations, top, memories, faded }
    }

    /// Returns the time in loading at which the indentation was this, m.
    fn loading_time(&self, indentation: f64) -> LoadingTime {
        let after = self.indentations[..=self.top].partition_point(|it| *it < indentation);
        let before = after.clamp(1, self.top.max(1)) - 1;
        let (low, high) =
            (self.indentations[before], self.indentations[(before + 1).min(self.top)]);
        let share = if high > low { (indentation - low) / (high - low) } else { 0.0 };
        LoadingTime { before, share: share.clamp(0.0, 1.0) }
    }

    /// Returns the memory of a term at a time in loading, m.
    fn memory(&self, term: usize, LoadingTime { before, share }: LoadingTime) -> f64 {
        let relaxation_time = self.relaxation.terms()[term].relaxation_time;
        let after = (before + 1).min(self.top);
        let change = self.indentations[after] - self.indentations[before];
        let part = RelaxationStep::new(relaxation_time, share * self.time_step);
        part.advance(self.memories[term][before], share * change)
    }

    /// Writes the loads over E*(0) at a step, where `gap` is the indentation at which each spring is reached; one step after the
    /// other.
    fn press(&mut self, step: usize, gap: &dyn Fn(usize) -> f64, loads: &mut [f64]) {
        let indentation = self.indentations[step];
        let reached = (0..loads.len()).take_while(|spring| gap(*spring) < indentation).count();
        let passed = |at: LoadingTime| (step as f64 - at.before as f64 - at.share) * self.time_step;
        let (now, known) = (self.loading_time(indentation), self.faded.first().map_or(0, Vec::len));
        let touched: Vec<_> =
            (known..reached).map(|spring| self.loading_time(gap(spring))).collect();
        loads[reached..].fill(0.0);
        for (spring, load) in loads[..reached].iter_mut().enumerate() {
            *load = self.relaxation.equilibrium_weight() * (indentation - gap(spring));
        }
        for (k, term) in self.relaxation.terms().iter().enumerate() {
            let rate = term.relaxation_time.recip();
            let fading = |at: LoadingTime| self.memory(k, at) * exp(-rate * passed(at));
            let (held, new) =
                (fading(now), touched.iter().map(|at| fading(*at)).collect::<Vec<_>>());
            let decay = exp(-rate * self.time_step);
            self.faded[k].iter_mut().for_each(|faded| *faded *= decay);
            self.faded[k].extend(new);
            for (load, faded) in loads[..reached].iter_mut().zip(&self.faded[k]) {
                *load += term.weight * (held - faded);
            }
        }
        loads[..reached].iter_mut().for_each(|load| *load = load.max(0.0));
    }
}

/// Returns q(x), N/m, of a pressure whose square is linear in r² between the given radii, as Hertz' is, and 0 outside.
fn line_load(profile: &[(f64, f64)], x: f64) -> f64 {
    if profile.last().is_none_or(|(outer, _)| *outer <= x) {
        return 0.0;
    }
    // ∫√(c − b s²) ds with s² = r² − x².
    let integral = |s: f64, c: f64, b: f64| {
        let root = (c - b * s * s).max(0.0).sqrt();
        let ratio = s * (b.abs() / c).sqrt();
        let turned = if b > 0.0 { ratio.min(1.0).asin() } else { ratio.asinh() };
        0.5 * s * if ratio > 1e-6 { root + c.sqrt() * turned / ratio } else { 2.0 * root }
    };
    let of_segment = |ends: &[(f64, f64)]| {
        let [(inner, p), (outer, q)] = [ends[0], ends[1]];
        let slope = (p * p - q * q) / (outer * outer - inner * inner);
        let at_place = p * p - slope * (x * x - inner * inner);
        let s = |r: f64| (r * r - x * x).max(0.0).sqrt();
        if at_place <= 0.0 {
            return 0.5 * (p + q) * (s(outer) - s(inner));
        }
        integral(s(outer), at_place, slope) - integral(s(inner), at_place, slope)
    };
    let segments = profile.windows(2).filter(|ends| ends[1].0 > x && ends[1].0 > ends[0].0);
    (2.0 * segments.map(of_segment).sum::<f64>()).max(0.0)
}
