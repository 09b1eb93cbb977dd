//! Rings around a block of cells in the quarter plane, from the axis to the surface.
//!
//! A block of m rows and n columns of cells has its free corner drawn in; around it lie rings of m + n cells, whose radii
//! are in geometric progression. The block's outline fades into circles as a power of the radius.

use std::f64::consts::{FRAC_PI_2, FRAC_PI_4};

/// Rows and columns of a block for the edge of a contact, over those of square cells. With as many elements a steel ball on a wall
/// at 100 times the speed of first yield has a third of the error in restitution and force; half as many rows change nothing.
const CELLS_FOR_EDGE: [f64; 2] = [0.6, 2.0];
/// Inward shift of the free corner of a block, so that the three cells that meet there have similar angles: the value
/// with the best scaled Jacobian.
const CORNER_DRAW: f64 = 0.1;
/// Power of the radius with which a block's outline fades into circles. A true
/// harmonic would fade with the fourth power (cos 4θ) and squeeze the rings at
/// the block's corner; 1.5 keeps cells squarest (aspect ratio 1.4).
const OUTLINE_DECAY: f64 = 1.5;

/// Returns the ratio of the radii of successive rings around m × m cells that makes their cells square.
pub(crate) fn default_growth(m: f64) -> f64 {
    1.0 + FRAC_PI_4 / m
}

/// Returns the share of a block's outline at a logarithmic distance x from it, of a length L:
/// sinh(p (L − x)) / sinh(p L), 1 at x = 0, 0 at x = L, e^{−p x} between.
pub(crate) fn fade(x: f64, length: f64) -> f64 {
    let p = OUTLINE_DECAY;
    (-p * x).exp() * (-2.0 * p * (length - x)).exp_m1() / (-2.0 * p * length).exp_m1()
}

/// Numbers of cells of a block along the axis and along the surface.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Block {
    /// Cells along the axis.
    pub rows: usize,
    /// Cells along the surface.
    pub columns: usize,
}

impl Block {
    /// Returns a block of m × m cells; for the edge of a contact with more columns and fewer rows, which show no less.
    pub fn new(m: f64, is_for_edge: bool) -> Self {
        let [rows, columns] = if is_for_edge { CELLS_FOR_EDGE } else { [1.0; 2] };
        Self { rows: (rows * m).ceil().max(2.0) as usize, columns: (columns * m).ceil() as usize }
    }

    /// Returns the number of cells of a ring around it.
    pub fn around(self) -> usize {
        self.rows + self.columns
    }

    /// Returns the number of its cells.
    pub fn n_cells(self) -> usize {
        self.rows * self.columns
    }

    /// Returns row and column of the node on its outline at a station.
    pub fn outline(self, station: usize) -> [usize; 2] {
        match station <= self.columns {
            true => [self.rows, station],
            false => [self.around() - station, self.columns],
        }
    }

    /// Returns the place of a node in the unit block.
    pub fn place(self, [row, column]: [usize; 2]) -> [f64; 2] {
        block_point(row as f64 / self.rows as f64, column as f64 / self.columns as f64)
    }

    /// Returns row and column of all nodes, row by row.
    pub fn nodes(self) -> impl Iterator<Item = [usize; 2]> {
        (0..=self.rows).flat_map(move |row| (0..=self.columns).map(move |column| [row, column]))
    }

    /// Returns row and column of the first node of all cells, row by row.
    pub fn cells(self) -> impl Iterator<Item = [usize; 2]> {
        (0..self.rows).flat_map(move |row| (0..self.columns).map(move |column| [row, column]))
    }

    /// Returns the number of a node in [`Block::nodes`].
    pub fn node(self, [row, column]: [usize; 2]) -> usize {
        row * (self.columns + 1) + column
    }
}

/// Data of a station (0 on the axis, the last on the surface), common to all rings.
pub(crate) struct Station {
    /// Eighths of a circle between the axis and this station.
    eighths: f64,
    circle_angle: f64,
    /// Deviation of a block's outline from the circle.
    outline_angle: f64,
    outline_log_radius: f64,
    is_on_axis: bool,
    is_on_surface: bool,
}

impl Station {
    /// Returns the angle between the surface and this station on a circle.
    pub fn depth_angle(&self) -> f64 {
        FRAC_PI_2 * (1.0 - 0.5 * self.eighths)
    }

    /// Returns all stations around a block.
    pub fn all(block: Block) -> Vec<Self> {
        (0..=block.around()).map(|k| Self::new(block, k)).collect()
    }

    fn new(block: Block, k: usize) -> Self {
        let [row, column] = block.outline(k);
        // An eighth of a circle faces each side.
        let eighths = match k <= block.columns {
            true => column as f64 / block.columns as f64,
            false => (2 * block.rows - row) as f64 / block.rows as f64,
        };
        let circle_angle = FRAC_PI_4 * eighths;
        let [bx, by] = block.place([row, column]);
        Self {
            eighths,
            circle_angle,
            outline_angle: by.atan2(bx) - circle_angle,
            outline_log_radius: bx.hypot(by).ln(),
            is_on_axis: k == 0,
            is_on_surface: k == block.around(),
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
fn block_point(u: f64, v: f64) -> [f64; 2] {
    let draw = 1.0 - CORNER_DRAW * u * u * v * v;
    [u * draw, v * draw]
}

/// Returns the counter-clockwise quad (in r, y) between rows i, i+1 (toward the far pole)
/// and columns j, j+1 (toward the surface).
pub(crate) fn quad(node: &impl Fn(usize, usize) -> u32, i: usize, j: usize) -> [u32; 4] {
    [node(i, j), node(i, j + 1), node(i + 1, j + 1), node(i + 1, j)]
}
