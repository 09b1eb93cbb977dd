//! Rounding of polygonal outlines into the curves that they approximate.

use super::section::{Section, Sides};

/// Cosine of the smallest angle between two sides that is a corner: 40 degrees.
const CORNER: f64 = 0.766;

impl Section {
    /// Bends sides of the outline outward where a smooth curve through its points is farther from them than
    /// `tolerance` (in the units of the points). Corners stay, and so do sides that would be bent inward.
    ///
    /// The curve is that of Catmull and Rom (1974) over the lengths of the sides; an outline that ends on
    /// the axis is continued by its mirror image. Two points per side reduce the deviation to a ninth of a
    /// straight side.
    pub fn rounded(&self, tolerance: f64) -> Self {
        let mut rounded = Self { outline: Vec::new(), ..self.clone() };
        let sides = Sides::of(&self.quads, self.points.len());
        for (k, pair) in self.outline.windows(2).enumerate() {
            let [a, b] = [pair[0], pair[1]];
            rounded.outline.push(a);
            let Some(bent) = self.bent(k) else { continue };
            let [from, to] = [a, b].map(|point| self.points[point as usize]);
            let off = distances(from, to, bent);
            // Outward is to the right of a side that quads run along, and to the left otherwise.
            let outward = if sides.find([a, b]).is_some() { -1.0 } else { 1.0 };
            if off.iter().any(|off| outward * off < tolerance) {
                continue;
            }
            let first = rounded.points.len() as u32;
            let [start, end] = [a, b].map(|point| self.values[point as usize]);
            rounded.points.extend(bent);
            rounded.values.extend([start + (end - start) / 3.0, end + (start - end) / 3.0]);
            let lens = [a, first, first + 1, b];
            let against = [b, first + 1, first, a];
            rounded.quads.push(if outward < 0.0 { lens } else { against });
            rounded.outline.extend([first, first + 1]);
        }
        rounded.outline.extend(self.outline.last());
        rounded
    }

    /// Returns the curve at one and two thirds of the k-th side of the outline; `None` at a corner.
    fn bent(&self, k: usize) -> Option<[[f64; 2]; 2]> {
        let k = k as isize;
        let (before, after) = (self.along(k - 1), self.along(k + 2));
        let (from, to) = (self.along(k)?, self.along(k + 1)?);
        let side = OutlineSide::of(from, to)?;
        let slope = |other: Option<OutlineSide>| match other {
            Some(other) if !other.is_corner(side) => Some(other.slope_with(side)),
            // Beyond an end the curve is straight.
            None => Some(side.direction),
            _ => None,
        };
        let start = slope(before.and_then(|point| OutlineSide::of(point, from)))?;
        let end = slope(after.and_then(|point| OutlineSide::of(to, point)))?;
        Some([1.0 / 3.0, 2.0 / 3.0].map(|t: f64| {
            let (s, length) = (1.0 - t, side.length);
            [0, 1].map(|x: usize| {
                s * s * (1.0 + 2.0 * t) * from[x]
                    + t * t * (1.0 + 2.0 * s) * to[x]
                    + length * s * t * (s * start[x] - t * end[x])
            })
        }))
    }

    /// Returns the k-th point of the outline, beyond an end on the axis that of the mirror image.
    fn along(&self, k: isize) -> Option<[f64; 2]> {
        let last = self.outline.len() as isize - 1;
        let inside = if k < 0 { -k } else { k.min(2 * last - k) };
        let point = self.points[*self.outline.get(usize::try_from(inside).ok()?)? as usize];
        if inside == k {
            return Some(point);
        }
        let end = self.points[self.outline[if k < 0 { 0 } else { last as usize }] as usize];
        (end[0] == 0.0).then_some([-point[0], point[1]])
    }
}

/// A side of the outline.
#[derive(Clone, Copy)]
struct OutlineSide {
    direction: [f64; 2],
    length: f64,
}

impl OutlineSide {
    fn of(from: [f64; 2], to: [f64; 2]) -> Option<Self> {
        let along = [to[0] - from[0], to[1] - from[1]];
        let length = along[0].hypot(along[1]);
        (length > 0.0).then(|| Self { direction: along.map(|x| x / length), length })
    }

    fn is_corner(self, other: Self) -> bool {
        let [a, b] = [self.direction, other.direction];
        a[0] * b[0] + a[1] * b[1] < CORNER
    }

    /// Returns the slope of the parabola through two sides where they meet.
    fn slope_with(self, other: Self) -> [f64; 2] {
        let whole = self.length + other.length;
        let [own, others] = [other.length / whole, self.length / whole];
        [0, 1].map(|x: usize| own * self.direction[x] + others * other.direction[x])
    }
}

/// Returns the distances of points to the left of a line.
fn distances(from: [f64; 2], to: [f64; 2], points: [[f64; 2]; 2]) -> [f64; 2] {
    let [x, y] = [to[0] - from[0], to[1] - from[1]];
    points.map(|[a, b]| (x * (b - from[1]) - y * (a - from[0])) / x.hypot(y))
}

#[cfg(test)]
mod tests {
    use super::super::region::Region;
    use super::*;

    /// A half disc of n facets around one inner fan of quads, from the upper pole to the lower one.
    fn half_disc(n: usize) -> Section {
        let angle = |k: usize| std::f64::consts::PI * k as f64 / n as f64;
        let rim = (0..=n).map(|k| {
            let r = if k == 0 || k == n { 0.0 } else { angle(k).sin() };
            [r, angle(k).cos()]
        });
        let mut points: Vec<[f64; 2]> = rim.clone().collect();
        points.extend(rim.map(|[r, y]| [0.5 * r, 0.5 * y]));
        let (n, inner) = (n as u32, n as u32 + 1);
        Section {
            values: vec![1.0; points.len()],
            points,
            quads: (0..n).map(|k| [inner + k, inner + k + 1, k + 1, k]).collect(),
            outline: (0..=n).collect(),
        }
    }

    /// Ten facets of a half circle deviate by 1.2 % of the radius, rounded ones by less than 0.2 %; the
    /// area follows, without an edge inside.
    #[test]
    fn facets_of_a_circle_become_the_circle() {
        let coarse = half_disc(10);
        let round = coarse.rounded(1e-3);
        let farthest = |section: &Section| {
            let sides = section.outline.windows(2);
            let off = sides.map(|side| {
                let [a, b] = [0, 1].map(|k: usize| section.points[side[k] as usize]);
                1.0 - (0.5 * (a[0] + b[0])).hypot(0.5 * (a[1] + b[1]))
            });
            off.fold(0.0, f64::max)
        };
        assert!(farthest(&coarse) > 0.012 && farthest(&round) < 0.002, "{}", farthest(&round));
        let area = |section: &Section| Region::at_most(section, f64::INFINITY).area().abs();
        let ring = 0.5 * std::f64::consts::PI * 0.75;
        assert!((area(&coarse) / ring - 1.0).abs() > 0.01);
        let rest = area(&round) + 0.5 * 0.25 * 10.0 * (std::f64::consts::PI / 10.0).sin();
        assert!((rest / (0.5 * std::f64::consts::PI) - 1.0).abs() < 3e-3, "{rest}");
        assert_eq!(Region::at_most(&round, f64::INFINITY).loops.len(), 1);
        assert_eq!(coarse.rounded(0.1), coarse);
    }

    /// Corners of a square stay, and so does a dent.
    #[test]
    fn rounding_keeps_corners_and_dents() {
        let mut square = half_disc(2);
        assert_eq!(square.rounded(1e-6), square);
        square = half_disc(10);
        square.points.iter_mut().for_each(|[_, y]| *y = -*y);
        square.quads.iter_mut().for_each(|quad| quad.reverse());
        assert_eq!(square.rounded(1e-3).quads.len(), 20);
        // With the quads on the other side of the outline, a bulge is a dent.
        square.points[11..].iter_mut().flatten().for_each(|x| *x *= 4.0);
        square.quads.iter_mut().for_each(|quad| quad.reverse());
        assert_eq!(square.rounded(1e-3), square);
    }
}
