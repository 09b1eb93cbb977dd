//! Sums over the nodes of a body in one pass: eight nodes at once, summed in the same order on all processors.

use crate::lanes::{ROW_PLACES, RowKernel, RowLanes, WIDE, run_row_lanes};
use crate::part::Field;

/// Sums over the nodes of a body; vectors along y.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub(crate) struct NodalSums {
    /// Σ m u, kg m.
    pub first_moment: f64,
    /// Σ m v at t_n − Δt/2, N s.
    pub momentum: f64,
    /// Σ v·(m v + Δt f), twice the kinetic energy of the leapfrog scheme at t_n, J.
    pub twice_kinetic: f64,
    /// Σ f, N.
    pub force: f64,
}

/// Fields on the nodes of a body.
#[derive(Clone, Copy)]
pub(crate) struct Nodes<'a> {
    /// Masses of the nodes, kg.
    pub mass: &'a [f64],
    /// Displacements of the nodes, m.
    pub displacement: &'a Field,
    /// Velocities at t_n − Δt/2, m/s.
    pub velocity: &'a Field,
    /// Forces on the nodes, N.
    pub forces: &'a Field,
}

impl NodalSums {
    /// Sums over nodes whose next step takes a time, s; velocities are relative to an axial one (m/s).
    pub fn of(nodes: Nodes<'_>, time_step: f64, far_velocity: f64) -> Self {
        let mut sums = Self::default();
        run_row_lanes(Summing { nodes, time_step, far_velocity }, &mut sums);
        sums
    }

    /// Adds one node.
    fn add(&mut self, kernel: &Summing<'_>, node: usize) {
        let Summing { nodes: Nodes { mass, displacement, velocity, forces }, .. } = kernel;
        let (m, [v_r, v_y], [f_r, f_y]) = (mass[node], velocity[node], forces[node]);
        let v_y = v_y - kernel.far_velocity;
        self.first_moment += m * displacement[node][1];
        self.momentum += m * v_y;
        self.twice_kinetic +=
            v_r * (m * v_r + kernel.time_step * f_r) + v_y * (m * v_y + kernel.time_step * f_y);
        self.force += f_y;
    }
}

/// The loop over the nodes.
struct Summing<'a> {
    nodes: Nodes<'a>,
    time_step: f64,
    far_velocity: f64,
}

impl RowKernel for Summing<'_> {
    type Output = NodalSums;

    #[inline(always)]
    fn on<L: RowLanes>(self, sums: &mut NodalSums) {
        let Nodes { mass, displacement, velocity, forces } = self.nodes;
        let n = mass.len();
        assert!([displacement, velocity, forces].iter().all(|field| field.len() >= n));
        let (time_step, far) = (L::splat(self.time_step), L::splat(self.far_velocity));
        let zero = L::splat(0.0);
        let (mut moment, mut momentum, mut kinetic, mut force) = (zero, zero, zero, zero);
        for (eight, mass) in mass.as_chunks::<WIDE>().0.iter().enumerate() {
            let first = WIDE * eight;
            // SAFETY: all fields have been checked to be as long as the masses.
            let (u, v, f) = unsafe {
                (
                    L::load_row(displacement, first),
                    L::load_row(velocity, first),
                    L::load_row(forces, first),
                )
            };
            let m = L::load(&in_row_order(mass));
            let v = (v.0, v.1 - far);
            let (m_r, m_y) = (m * v.0, m * v.1);
            moment = moment.plus_product(m, u.1);
            momentum = momentum + m_y;
            kinetic = kinetic
                .plus_product(v.0, m_r.plus_product(time_step, f.0))
                .plus_product(v.1, m_y.plus_product(time_step, f.1));
            force = force + f.1;
        }
        *sums = NodalSums {
            first_moment: total(moment),
            momentum: total(momentum),
            twice_kinetic: total(kinetic),
            force: total(force),
        };
        for node in n / WIDE * WIDE..n {
            sums.add(&self, node);
        }
    }
}

/// Returns the numbers of eight nodes in the order of [`RowLanes::load_row`].
#[inline(always)]
fn in_row_order(values: &[f64; WIDE]) -> [f64; WIDE] {
    let mut placed = [0.0; WIDE];
    for (to, place) in placed.iter_mut().zip(ROW_PLACES) {
        *to = values[place];
    }
    placed
}

/// Returns the sum of the lanes.
#[inline(always)]
fn total<L: RowLanes>(lanes: L) -> f64 {
    let numbers: [f64; WIDE] = lanes.to_array();
    numbers.iter().sum()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Against sums of one node after the other, for any number of nodes; the numbers are small integers over
    /// 8, whose sums have no rounding.
    #[test]
    fn nodal_sums_equal_sequential_sums() {
        for n in 0..19_usize {
            let number = |k: usize, a: usize| ((a * k * k + 3 * k + a) % 17) as f64 / 8.0 - 1.0;
            let field = |a: usize| -> Vec<[f64; 2]> {
                (0..n).map(|k| [number(k, a), number(k, a + 1)]).collect()
            };
            let (m, u, v, f): (Vec<_>, _, _, _) =
                ((0..n).map(|k| number(k, 2) + 1.5).collect(), field(3), field(5), field(7));
            let (time_step, far) = (0.25, 0.5);
            let mut plain = NodalSums::default();
            for k in 0..n {
                let v = [v[k][0], v[k][1] - far];
                plain.first_moment += m[k] * u[k][1];
                plain.momentum += m[k] * v[1];
                plain.twice_kinetic += m[k] * (v[0] * v[0] + v[1] * v[1])
                    + time_step * (v[0] * f[k][0] + v[1] * f[k][1]);
                plain.force += f[k][1];
            }
            let nodes = Nodes { mass: &m, displacement: &u, velocity: &v, forces: &f };
            assert_eq!(NodalSums::of(nodes, time_step, far), plain, "{n}");
        }
    }
}
