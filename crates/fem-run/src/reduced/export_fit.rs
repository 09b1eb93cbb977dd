//! From e(v) and T(v) to the laws that DEM codes have, and where each is good.

use fem::Reduced;
use fem_case::{Body, Case};
use fem_fit::dem::{Dashpot, Elastic, Export, Sphere};
use fem_fit::{FitError, Model, Outcome, Point, Problem};
use fem_laws::{EndRule, Family, HertzImpact, Pair};

use super::bodies::model_of;

/// The data, in the order of the speed, with a contact time each.
pub struct Curve {
    pub points: Vec<Point>,
    /// Whether the times are Hertz', for want of data.
    pub has_hertz_times: bool,
}

/// A law and its values, to draw.
pub struct Drawn {
    pub name: &'static str,
    pub model: Model,
    pub values: Vec<f64>,
}

impl Drawn {
    /// At a speed, m/s.
    pub fn outcome(&self, speed: f64) -> Option<Outcome> {
        self.model.outcome(&self.values, speed).ok()
    }
}

impl Curve {
    /// Sorted; points without a contact time get Hertz' with instantaneous moduli.
    ///
    /// # Errors
    /// Speeds without a Hertz impact.
    pub fn of(pair: &Pair, mut points: Vec<Point>) -> Result<Self, FitError> {
        points.sort_by(|a, b| a.speed.total_cmp(&b.speed));
        let has_hertz_times = points.iter().any(|point| point.contact_time.is_none());
        for point in &mut points {
            if has_hertz_times {
                let hertz = HertzImpact::new(pair, point.speed)?;
                point.contact_time = Some(hertz.contact_time());
            }
            point.restitution_uncertainty = None;
        }
        Ok(Self { points, has_hertz_times })
    }

    /// Computed by a reduced model at these speeds, m/s.
    ///
    /// # Errors
    /// Collisions that cannot be computed.
    pub fn computed(reduced: &Reduced, speeds: &[f64]) -> Result<Self, FitError> {
        let point = |speed: &f64| {
            let impact = reduced.impact(*speed)?;
            Ok(Point {
                contact_time: impact.contact_time,
                ..Point::new(*speed, impact.restitution)
            })
        };
        let points: Vec<Point> = speeds.iter().map(point).collect::<Result<_, FitError>>()?;
        Self::of(&reduced.scene().pair()?, points)
    }

    /// From, to, and the largest error of a law's e: the longest run of neighbouring speeds at which
    /// it is within the tolerance.
    fn validity(
        &self,
        model: &Model,
        values: &[f64],
        tolerance: f64,
    ) -> Result<[f64; 3], FitError> {
        let mut worst = 0.0f64;
        let mut runs: Vec<(usize, usize)> = Vec::new();
        for (index, point) in self.points.iter().enumerate() {
            let outcome = model.outcome(values, point.speed)?;
            let error = (outcome.restitution - point.restitution).abs();
            worst = worst.max(error);
            if error > tolerance {
                continue;
            }
            match runs.last_mut() {
                Some(run) if run.1 + 1 == index => run.1 = index,
                _ => runs.push((index, index)),
            }
        }
        let longest = runs.iter().max_by_key(|run| run.1 - run.0);
        // An empty range where there is none.
        let (from, to) = longest.map_or((f64::INFINITY, 0.0), |(first, last)| {
            (self.points[*first].speed, self.points[*last].speed)
        });
        Ok([from, to, worst])
    }
}

/// All laws fitted to the curve.
///
/// # Errors
/// Data that do not determine them.
pub fn fit_export(
    case: &Case,
    spheres: Vec<Sphere>,
    curve: &Curve,
    tolerance: f64,
) -> Result<(Export, Vec<Drawn>), FitError> {
    let only_e: Vec<Point> =
        curve.points.iter().map(|point| Point { contact_time: None, ..*point }).collect();
    let fitted = |family, points: &[Point], free: &[&str], end_rule| {
        let model = model_of(case, family, end_rule)?;
        let values = Problem::new(&model, points, free)?.fit(0.95)?.values;
        let validity = curve.validity(&model, &values, tolerance)?;
        Ok::<_, FitError>((model, values, validity))
    };
    let overlap = EndRule::ZeroOverlap;
    let (tsuji, alpha, tsuji_validity) = fitted(Family::Tsuji, &only_e, &["alpha"], overlap)?;
    let (kelvin, a, kelvin_validity) =
        fitted(Family::KuwabaraKono, &only_e, &["a"], EndRule::ZeroForce)?;
    let (linear, k_c, linear_validity) =
        fitted(Family::Linear, &curve.points, &["k", "c"], overlap)?;
    let speed = curve.points[0].speed;
    let of_tsuji = tsuji.outcome(&alpha, speed)?;
    let of_linear = linear.outcome(&k_c, speed)?;
    let export = Export {
        title: case.scene.title.replace(char::is_control, " "),
        spheres,
        pair: *tsuji.pair(),
        speeds: (speed, curve.points[curve.points.len() - 1].speed),
        tolerance,
        hertz: Elastic { restitution: of_tsuji.restitution, validity: tsuji_validity },
        dissipation_time: (a[0], kelvin_validity),
        linear: Dashpot {
            restitution: of_linear.restitution,
            contact_time: of_linear.contact_time.unwrap_or(f64::INFINITY),
            validity: linear_validity,
        },
    };
    let drawn = vec![
        Drawn { name: "one e for all speeds, Hertz", model: tsuji, values: alpha },
        Drawn { name: "viscoelastic (Kuwabara-Kono)", model: kelvin, values: a },
        Drawn { name: "linear", model: linear, values: k_c },
    ];
    Ok((export, drawn))
}

/// The spheres of a case: two, or one and a wall.
pub fn spheres_of(case: &Case) -> Vec<Sphere> {
    let sphere = |body: &Body| {
        let (diameter, material) = (body.diameter()?, body.material()?);
        Some(Sphere {
            diameter,
            density: material.density(),
            youngs_modulus: material.instantaneous().youngs_modulus(),
            poissons_ratio: material.instantaneous().poissons_ratio(),
        })
    };
    case.scene.bodies.iter().filter_map(sphere).collect()
}
