//! The contact pressure between nodes, from the axis to the edge.
//!
//! The force on a node over its area is the mean of the pressure over its hat function, not the pressure at the
//! node, and the hat of the outermost node reaches beyond the edge. So the pressure is Hertz' ellipse of the force F
//! and the radius a, times a ratio that is linear between the nodes inside,
//!
//! ```math
//! p(r) = \frac{3F}{2\pi a^2} \sqrt{1 - x} \; q(r) \, (1 + c x), \qquad x = r^2 / a^2
//! ```
//!
//! where q at a node is the mean pressure over that of the ellipse, on the axis the recovered pressure over that of
//! the ellipse. Beyond the last node inside, q is constant. The constant c makes the total force that of the nodes;
//! it corrects 1 or 2 %, the discretisation errors near the axis and at the edge. The pressure is zero at the edge.

use std::f64::consts::{FRAC_PI_2, PI};

use super::nodal_means;

/// Gauss points and weights on −1..1 for polynomials up to the seventh degree.
const GAUSS: [[f64; 2]; 4] = [
    [-0.861_136_311_594_052_6, 0.347_854_845_137_453_85],
    [-0.339_981_043_584_856_26, 0.652_145_154_862_546_1],
    [0.339_981_043_584_856_26, 0.652_145_154_862_546_1],
    [0.861_136_311_594_052_6, 0.347_854_845_137_453_85],
];

/// Number of parts of each interval between neighbours for integrals.
const PARTS_PER_INTERVAL: usize = 4;

/// The contact pressure as a function of the distance from the axis.
#[derive(Debug, Clone)]
pub struct PressureCurve {
    /// Contact radius a, m.
    edge: f64,
    /// Hertz' pressure 3F/2πa², Pa.
    on_axis: f64,
    /// (r in m, q) of the nodes inside, from the axis outward.
    ratios: Vec<(f64, f64)>,
    /// Constant c, which restores the force.
    slope: f64,
}

impl PressureCurve {
    /// Creates the curve from nodes from the axis outward (r in m, p in Pa), the contact radius (m) and the force
    /// (N); `None` without contact. The first node has the pressure on the axis, the others the mean over their
    /// hat functions.
    pub fn new(nodes: &[(f64, f64)], edge: f64, force: f64) -> Option<Self> {
        if !(edge > 0.0 && edge.is_finite() && force > 0.0 && force.is_finite()) {
            return None;
        }
        let mut curve = Self {
            edge,
            on_axis: 1.5 * force / (PI * edge * edge),
            ratios: Vec::new(),
            slope: 0.0,
        };
        // If the recovered radius is slightly too large, a node inside has no pressure.
        let last = nodes.iter().rposition(|(_, pressure)| *pressure > 0.0).unwrap_or(0);
        let mut ratios = Vec::new();
        for (k, cell) in nodal_means(nodes.iter().copied())
            .enumerate()
            .take(last + 1)
            .take_while(|(_, c)| c.radius < edge)
        {
            let mean = match (k, cell.neighbours) {
                (0, _) => 1.0,
                (_, [inner, outer]) => {
                    let inner = inner.unwrap_or(0.0);
                    curve.ellipse_mean(
                        inner,
                        cell.radius,
                        outer.unwrap_or(2.0 * cell.radius - inner),
                    )
                }
            };
            ratios.push((cell.radius, cell.pressure / (curve.on_axis * mean)));
        }
        curve.ratios = ratios;
        let [without, rising] = curve.forces();
        curve.slope = if rising > 0.0 { (force - without) / rising } else { 0.0 };
        Some(curve)
    }

    /// Returns the pressure (Pa) at a distance from the axis, m.
    pub fn at(&self, radius: f64) -> f64 {
        let x = (radius / self.edge).powi(2);
        if x >= 1.0 {
            return 0.0;
        }
        self.on_axis * (1.0 - x).sqrt() * self.ratio(radius) * (1.0 + self.slope * x)
    }

    fn ratio(&self, radius: f64) -> f64 {
        let outer = self.ratios.partition_point(|(node, _)| *node <= radius);
        match (outer.checked_sub(1).and_then(|k| self.ratios.get(k)), self.ratios.get(outer)) {
            (Some((from, inner)), Some((to, outer))) => {
                inner + (radius - from) / (to - from) * (outer - inner)
            }
            (Some((_, ratio)), None) | (None, Some((_, ratio))) => *ratio,
            (None, None) => 0.0,
        }
    }

    /// Returns the mean of √(1 − x), zero outside, over the hat function of a node.
    fn ellipse_mean(&self, inner: f64, node: f64, outer: f64) -> f64 {
        let (mut sum, mut area) = (0.0, 0.0);
        for neighbour in [inner, outer] {
            let share = |r: f64| (r - neighbour) / (node - neighbour);
            let [from, to] = [neighbour.min(node), neighbour.max(node)];
            sum += self.integral(from, to, |r, x| share(r) * (1.0 - x).sqrt());
            area += PI * (to - from) * (node + (neighbour - node) / 3.0);
        }
        sum / area
    }

    /// Returns ∫ p 2πr dr without the factor 1 + c x, and the same integral times x, N.
    fn forces(&self) -> [f64; 2] {
        let starts = self.ratios.iter().map(|(node, _)| *node);
        let ends = starts.clone().skip(1).chain([self.edge]);
        starts.zip(ends).fold([0.0; 2], |sums, (from, to)| {
            let density = |r: f64, x: f64| self.on_axis * (1.0 - x).sqrt() * self.ratio(r);
            let rising = |r: f64, x: f64| x * density(r, x);
            [sums[0] + self.integral(from, to, density), sums[1] + self.integral(from, to, rising)]
        })
    }

    /// Returns ∫ f(r, x) 2πr dr up to the edge, integrated over θ in r = a sin θ, in which an ellipse is smooth.
    fn integral(&self, from: f64, to: f64, f: impl Fn(f64, f64) -> f64) -> f64 {
        let angle = |r: f64| (r / self.edge).clamp(0.0, 1.0).asin();
        let (from, step) = (angle(from), (angle(to) - angle(from)) / PARTS_PER_INTERVAL as f64);
        let mut sum = 0.0;
        for part in 0..PARTS_PER_INTERVAL {
            for [place, weight] in GAUSS {
                let (sin, cos) = (from + step * (part as f64 + 0.5 * (1.0 + place))).sin_cos();
                let r = self.edge * sin;
                sum += 0.5 * weight * step * f(r, sin * sin) * 2.0 * PI * r * self.edge * cos;
            }
        }
        sum
    }
}

/// Returns n − 1 radii (m) inside of an edge (m), denser towards it. Linear interpolation between 32 of them
/// carries the force of an ellipse to 0.1 %.
pub fn places_inside(edge: f64, n: usize) -> impl Iterator<Item = f64> {
    (1..n).map(move |k| edge * (FRAC_PI_2 * k as f64 / n as f64).sin())
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Means over hats of a profile over x that ends at 1, and its force; hats by a fine sum.
    fn means(profile: impl Fn(f64) -> f64, size: f64, n: usize) -> (Vec<(f64, f64)>, f64) {
        let at = |r: f64| if r < 1.0 { profile(r * r) } else { 0.0 };
        let mean = |k: usize| {
            let node = k as f64 * size;
            let (mut sum, mut area) = (0.0, 0.0);
            for i in 0..20_000 {
                let r = node + size * ((f64::from(i) + 0.5) / 10_000.0 - 1.0);
                if r > 0.0 {
                    let weight = (1.0 - (r - node).abs() / size) * r;
                    (sum, area) = (sum + weight * at(r), area + weight);
                }
            }
            (node, if k == 0 { profile(0.0) } else { sum / area })
        };
        let ring = |i: u32| {
            let r = (f64::from(i) + 0.5) / 1e5;
            2.0 * PI * r * at(r) / 1e5
        };
        ((0..n).map(mean).collect(), (0..100_000).map(ring).sum())
    }

    /// ∫ p 2πr dr of straight lines between places.
    fn load(curve: &PressureCurve, places: impl Iterator<Item = f64>) -> f64 {
        let rows: Vec<[f64; 2]> = places.map(|r| [r, r * curve.at(r)]).collect();
        rows.windows(2).map(|w| PI * (w[1][0] - w[0][0]) * (w[0][1] + w[1][1])).sum()
    }

    /// Hertz' profile, and profiles that relaxation has flattened and steepened by half, from 2.2 elements on. The
    /// ratio of Hertz' profile is constant; that of the others is most curved within the last element.
    #[test]
    fn pressure_profiles_are_recovered_from_hat_function_means() {
        for bend in [0.0, 0.5, -0.6] {
            let profile = |x: f64| (1.0 - x).sqrt() * (1.0 + bend * x);
            for (across, tolerance) in [(2.2, 0.08), (3.75, 0.06), (10.3, 0.015)] {
                let size = 1.0 / across;
                let (nodes, force) = means(profile, size, across as usize + 3);
                let curve = PressureCurve::new(&nodes, 1.0, force).unwrap();
                assert_eq!((curve.at(0.0), curve.at(1.0)), (1.0, 0.0));
                for r in places_inside(1.0, 50) {
                    let error = curve.at(r) - profile(r * r);
                    let tolerance = if bend == 0.0 { 0.02 * tolerance } else { tolerance };
                    assert!(error.abs() < tolerance, "{bend} {across} {r}: {error}");
                }
                let places = [0.0].into_iter().chain(places_inside(1.0, 2000)).chain([1.0]);
                let carried = load(&curve, places) / force;
                assert!((carried - 1.0).abs() < 1e-5, "{bend} {across}: {carried}");
            }
        }
    }

    #[test]
    fn sampled_elliptic_pressure_integrates_to_the_force() {
        let (nodes, force) = means(|x| (1.0 - x).sqrt(), 0.1, 13);
        let curve = PressureCurve::new(&nodes, 1.0, force).unwrap();
        let places = [0.0].into_iter().chain(places_inside(1.0, 32)).chain([1.0]);
        assert!((load(&curve, places) / force - 1.0).abs() < 1.1e-3);
    }

    /// A ring that presses, a single node, and nothing.
    #[test]
    fn pressure_of_a_ring_and_of_a_single_node_carries_the_force() {
        let ring = [(0.0, 0.0), (0.3, 0.0), (0.6, 1.0), (0.9, 0.5), (1.2, 0.0)];
        let curve = PressureCurve::new(&ring, 1.0, 2.0).unwrap();
        assert!(curve.at(0.2) == 0.0 && curve.at(0.6) > 0.0 && curve.at(1.0) == 0.0);
        let places = || [0.0].into_iter().chain(places_inside(1.0, 4000)).chain([1.0]);
        assert!((load(&curve, places()) / 2.0 - 1.0).abs() < 1e-4);
        let single = PressureCurve::new(&[(0.0, 3.0), (2.0, 0.0)], 1.0, 5.0).unwrap();
        assert_eq!(single.at(0.0), 3.0);
        assert!((load(&single, places()) / 5.0 - 1.0).abs() < 1e-4);
        assert!(PressureCurve::new(&ring, 0.0, 2.0).is_none());
        assert!(PressureCurve::new(&ring, 1.0, f64::NAN).is_none());
    }
}
