//! Refinement of a field for smooth bands: each quad becomes four, with values on a cubic along each side.

use super::section::{Section, Sides};

impl Section {
    /// Returns the section with each quad divided into four, `n` times.
    ///
    /// Values at the middles of sides are those of the cubic with the values and slopes of both ends (Hermite). The
    /// slopes at a point are the mean over its quads, weighted by their areas; on the axis of a half section the
    /// field is symmetric and has no slope across it. The value in a quad's middle is Coons' patch of its sides.
    /// A linear field stays linear, and the given points keep their values.
    pub fn refined(&self, n: usize) -> Self {
        (0..n).fold(self.clone(), |section, _| section.divided())
    }

    fn divided(&self) -> Self {
        let slopes = self.slopes();
        let mut fine = Self { quads: Vec::with_capacity(4 * self.quads.len()), ..self.clone() };
        let neighbours = Sides::of(&self.quads, self.points.len());
        let mut middles: Vec<[u32; 4]> = Vec::with_capacity(self.quads.len());
        for quad in &self.quads {
            let sides = [0, 1, 2, 3].map(|k: usize| {
                let [a, b] = [quad[k], quad[(k + 1) % 4]];
                let known =
                    neighbours.find([b, a]).and_then(|(cell, k)| Some(middles.get(cell)?[k]));
                known.unwrap_or_else(|| {
                    let (ends, way) = ([a as usize, b as usize], self.way(a, b));
                    let bend = [0, 1].map(|x: usize| slopes[ends[0]][x] - slopes[ends[1]][x]);
                    let value = 0.5 * (self.values[ends[0]] + self.values[ends[1]]);
                    let value = value + (bend[0] * way[0] + bend[1] * way[1]) / 8.0;
                    fine.add(ends.map(|end| self.points[end]), value)
                })
            });
            middles.push(sides);
            let mean = |numbers: [f64; 4]| numbers.iter().sum::<f64>() / 4.0;
            let value = 2.0 * mean(sides.map(|point| fine.values[point as usize]))
                - mean(quad.map(|point| self.values[point as usize]));
            let place = [0, 2].map(|k: usize| fine.points[sides[k] as usize]);
            let middle = fine.add(place, value);
            let part = |k: usize| [quad[k], sides[k], middle, sides[(k + 3) % 4]];
            fine.quads.extend([0, 1, 2, 3].map(part));
        }
        fine
    }

    /// Adds a point in the middle between two places.
    fn add(&mut self, [a, b]: [[f64; 2]; 2], value: f64) -> u32 {
        self.points.push([0, 1].map(|x: usize| 0.5 * (a[x] + b[x])));
        self.values.push(value);
        self.points.len() as u32 - 1
    }

    fn way(&self, from: u32, to: u32) -> [f64; 2] {
        let [from, to] = [from, to].map(|point| self.points[point as usize]);
        [to[0] - from[0], to[1] - from[1]]
    }

    /// Returns the slopes of the field at each point.
    fn slopes(&self) -> Vec<[f64; 2]> {
        // A quad's slopes times twice its area, from its diagonals, and twice the areas.
        let mut sums = vec![([0.0; 2], 0.0); self.points.len()];
        for quad in self.finite_quads() {
            let [a, b] = [self.way(quad[0], quad[2]), self.way(quad[1], quad[3])];
            let [va, vb] = [[quad[0], quad[2]], [quad[1], quad[3]]]
                .map(|[from, to]| self.values[to as usize] - self.values[from as usize]);
            let slopes = [va * b[1] - vb * a[1], vb * a[0] - va * b[0]];
            for point in quad {
                let (sum, area) = &mut sums[point as usize];
                *area += a[0] * b[1] - a[1] * b[0];
                *sum = [sum[0] + slopes[0], sum[1] + slopes[1]];
            }
        }
        let slope = |(([x, y], area), point): (([f64; 2], f64), &[f64; 2])| match area == 0.0 {
            true => [0.0; 2],
            false if point[0] == 0.0 => [0.0, y / area],
            false => [x / area, y / area],
        };
        sums.into_iter().zip(&self.points).map(slope).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::super::region::Region;
    use super::*;

    /// The unit square beside the axis in n × n skewed quads.
    fn square(n: usize, field: impl Fn([f64; 2]) -> f64) -> Section {
        let at = |i: usize, j: usize| (j * (n + 1) + i) as u32;
        let place = |k: usize| {
            let [i, j] = [k % (n + 1), k / (n + 1)];
            let skew = |k: usize| if k.is_multiple_of(n) { 0.0 } else { 0.1 * (i + 2 * j) as f64 };
            [
                (i as f64 + skew(i).sin() * 0.2) / n as f64,
                (j as f64 + skew(j).cos() * 0.2) / n as f64,
            ]
        };
        let points: Vec<[f64; 2]> = (0..(n + 1) * (n + 1)).map(place).collect();
        let quads = (0..n * n).map(|k| (k % n, k / n));
        Section {
            values: points.iter().map(|point| field(*point)).collect(),
            quads: quads
                .map(|(i, j)| [at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)])
                .collect(),
            outline: (0..=n).map(|i| at(i, n)).collect(),
            points,
        }
    }

    #[test]
    fn refining_keeps_given_points_and_linear_fields() {
        let coarse = square(4, |[_, y]| 3.0 * y - 1.0);
        let fine = coarse.refined(2);
        assert_eq!(fine.quads.len(), 16 * coarse.quads.len());
        assert_eq!(fine.values[..25], coarse.values[..]);
        for (point, value) in fine.points.iter().zip(&fine.values) {
            assert!((value - (3.0 * point[1] - 1.0)).abs() < 1e-12);
        }
        assert_eq!(Region::at_most(&fine, f64::INFINITY).loops.len(), 1);
        assert_eq!(coarse.refined(0), coarse);
    }

    /// Between the points, the values of a curved field that is even in r are nearer to it than those of straight lines.
    #[test]
    fn curved_fields_are_closer_than_by_straight_lines() {
        let field = |[x, y]: [f64; 2]| (3.0 * x * x).cos() * (2.0 * y).exp();
        let coarse = square(8, field);
        let fine = coarse.refined(2);
        let is_inside = |p: &[f64; 2]| p.iter().all(|x| (0.0..0.85).contains(x));
        let inside = fine.points.iter().zip(&fine.values).filter(|(point, _)| is_inside(point));
        let cubic = inside.map(|(point, value)| (value - field(*point)).abs()).fold(0.0, f64::max);
        let linear = |quad: &[u32; 4]| {
            let sum: f64 = quad.iter().map(|point| coarse.values[*point as usize]).sum();
            let place = [0, 1].map(|x: usize| {
                quad.iter().map(|point| coarse.points[*point as usize][x]).sum::<f64>() / 4.0
            });
            if is_inside(&place) { (sum / 4.0 - field(place)).abs() } else { 0.0 }
        };
        let linear = coarse.quads.iter().map(linear).fold(0.0, f64::max);
        assert!(cubic < 0.3 * linear, "{cubic} {linear}");
    }

    #[test]
    fn lines_of_a_mesh_have_each_side_once() {
        let mesh = square(3, |_| 0.0);
        let lines = mesh.lines();
        assert_eq!(lines.iter().map(|line| line.len() - 1).sum::<usize>(), 2 * 3 * 4);
        assert!(lines.len() < 8, "{}", lines.len());
    }
}
