//! Rings around a block of cells in the quarter plane, from the axis to the surface.
//!
//! A block of m × m cells has its free corner drawn in; around it lie rings of 2 m cells, whose radii
//! are in geometric progression. The block's outline fades into circles as a power of the radius.

/// Inward shift of the free corner of a block, so that the three cells that meet there have similar angles: the value
/// with the best scaled Jacobian.
const CORNER_DRAW: f64 = 0.1;
/// Power of the radius with which a block's outline fades into circles. A true
/// harmonic would fade with the fourth power (cos 4θ) and squeeze the rings at
/// the block's corner; 1.5 keeps cells squarest (aspect ratio 1.4).
const OUTLINE_DECAY: f64 = 1.5;

/// Returns the ratio of the radii of successive rings around m × m cells that makes their cells square.
pub(crate) fn default_growth(m: f64) -> f64 {
    1.0 + std::f64::consts::FRAC_PI_4 / m
}

/// Returns the share of a block's outline at a logarithmic distance x from it, of a length L:
/// sinh(p (L − x)) / sinh(p L), 1 at x = 0, 0 at x = L, e^{−p x} between.
pub(crate) fn fade(x: f64, length: f64) -> f64 {
    let p = OUTLINE_DECAY;
    (-p * x).exp() * (-2.0 * p * (length - x)).exp_m1() / (-2.0 * p * length).exp_m1()
}

/// Data of a station (0 on the axis, 2 m on the surface), common to all rings.
pub(crate) struct Station {
    circle_angle: f64,
    /// Deviation of a block's outline from the circle.
    outline_angle: f64,
    outline_log_radius: f64,
    is_on_axis: bool,
    is_on_surface: bool,
}

impl Station {
    /// Returns station k around blocks of m × m cells.
    pub fn new(m: usize, k: usize) -> Self {
        let circle_angle = std::f64::consts::FRAC_PI_4 * k as f64 / m as f64;
        let [bx, by] = if k <= m {
            block_point(1.0, k as f64 / m as f64)
        } else {
            block_point((2 * m - k) as f64 / m as f64, 1.0)
        };
        Self {
            circle_angle,
            outline_angle: by.atan2(bx) - circle_angle,
            outline_log_radius: bx.hypot(by).ln(),
            is_on_axis: k == 0,
            is_on_surface: k == 2 * m,
        }
    }
}

/// An inner ring.
pub(crate) struct Ring {
    /// Half-width of the near block.
    pub near: f64,
    /// Logarithm of the ring's radius over it.
    pub log_radius: f64,
    /// Weight of the near block's outline in the ring's.
    pub near_share: f64,
    /// Weight of the far block's outline in the ring's.
    pub far_share: f64,
}

impl Ring {
    /// Returns the position of a station in the quarter plane.
    pub fn point(&self, station: &Station) -> [f64; 2] {
        let Self { near_share, far_share, .. } = *self;
        let deviation = (near_share - far_share) * station.outline_log_radius;
        let radius = self.near * (self.log_radius + deviation).exp();
        if station.is_on_axis {
            return [radius, 0.0];
        }
        if station.is_on_surface {
            return [0.0, radius];
        }
        let angle = station.circle_angle + (near_share + far_share) * station.outline_angle;
        [radius * angle.cos(), radius * angle.sin()]
    }
}

/// Maps the unit block to one with its free corner drawn in; its two fixed edges and their
/// spacing stay as they are.
pub(crate) fn block_point(u: f64, v: f64) -> [f64; 2] {
    let draw = 1.0 - CORNER_DRAW * u * u * v * v;
    [u * draw, v * draw]
}

/// Returns the counter-clockwise quad (in r, y) between rows i, i+1 (toward the far pole)
/// and columns j, j+1 (toward the surface).
pub(crate) fn quad(node: &impl Fn(usize, usize) -> u32, i: usize, j: usize) -> [u32; 4] {
    [node(i, j), node(i, j + 1), node(i + 1, j + 1), node(i + 1, j)]
}
