//! The loops over elements and nodes in which a run spends its time.
//!
//! Each is compiled for several instruction sets and chosen at run time. None
//! uses fused multiply-add, so the bits of a result do not depend on the
//! machine.

use multiversion::multiversion;

use crate::block::{Block, LANES, Lanes};

/// A field of pairs (r, y), one a node.
pub(crate) type Field = [[f64; 2]];

/// Bulk and shear modulus, Pa.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Moduli {
    pub bulk: f64,
    pub shear: f64,
}

/// Strains of eight elements times the square root of their volume, and their
/// hourglass amplitudes.
struct Strain {
    rr: Lanes,
    yy: Lanes,
    tt: Lanes,
    ry: Lanes,
    hourglass_r: Lanes,
    hourglass_y: Lanes,
}

/// Displacements at the corners: radial at all four, and both relative to
/// corner 3.
struct Corners {
    r: [Lanes; 4],
    dr: [Lanes; 3],
    dy: [Lanes; 3],
}

impl Corners {
    #[inline(always)]
    fn gather(block: &Block, field: &Field) -> Self {
        let mut r = [[0.0; LANES]; 4];
        let mut y = [[0.0; LANES]; 4];
        for a in 0..4 {
            for lane in 0..LANES {
                let [value_r, value_y] = field[block.corners[a][lane] as usize];
                r[a][lane] = value_r;
                y[a][lane] = value_y;
            }
        }
        let mut dr = [[0.0; LANES]; 3];
        let mut dy = [[0.0; LANES]; 3];
        for a in 0..3 {
            for lane in 0..LANES {
                dr[a][lane] = r[a][lane] - r[3][lane];
                dy[a][lane] = y[a][lane] - y[3][lane];
            }
        }
        Self { r, dr, dy }
    }

    #[inline(always)]
    fn strain(&self, block: &Block) -> Strain {
        let mut e = Strain {
            rr: [0.0; LANES],
            yy: [0.0; LANES],
            tt: [0.0; LANES],
            ry: [0.0; LANES],
            hourglass_r: [0.0; LANES],
            hourglass_y: [0.0; LANES],
        };
        for a in 0..3 {
            for lane in 0..LANES {
                let (dr, dy) = (self.dr[a][lane], self.dy[a][lane]);
                e.rr[lane] += block.gradient_r[a][lane] * dr;
                e.yy[lane] += block.gradient_y[a][lane] * dy;
                e.ry[lane] += block.gradient_y[a][lane] * dr + block.gradient_r[a][lane] * dy;
                e.hourglass_r[lane] += block.hourglass[a][lane] * dr;
                e.hourglass_y[lane] += block.hourglass[a][lane] * dy;
            }
        }
        for a in 0..4 {
            for lane in 0..LANES {
                e.tt[lane] += block.hoop[a][lane] * self.r[a][lane];
            }
        }
        e
    }

    #[inline(always)]
    fn dilatation(&self, block: &Block) -> Lanes {
        let mut dilatation = [0.0; LANES];
        for a in 0..3 {
            for lane in 0..LANES {
                dilatation[lane] += block.gradient_r[a][lane] * self.dr[a][lane]
                    + block.gradient_y[a][lane] * self.dy[a][lane];
            }
        }
        for a in 0..4 {
            for lane in 0..LANES {
                dilatation[lane] += block.hoop[a][lane] * self.r[a][lane];
            }
        }
        dilatation
    }
}

/// Subtracts the internal forces of the shear field `w`, and of the bulk field
/// where it is another, from `f`.
#[inline(always)]
fn subtract_forces<const SPLIT: bool>(
    blocks: &[Block],
    moduli: Moduli,
    bulk_field: &Field,
    w: &Field,
    f: &mut Field,
) {
    let Moduli { bulk, shear } = moduli;
    for block in blocks {
        let corners = Corners::gather(block, w);
        let e = corners.strain(block);
        let dilatation = if SPLIT {
            Corners::gather(block, bulk_field).dilatation(block)
        } else {
            std::array::from_fn(|lane| e.rr[lane] + e.yy[lane] + e.tt[lane])
        };
        let mut force_r = [[0.0; LANES]; 4];
        let mut force_y = [[0.0; LANES]; 4];
        let mut hoop_stress = [0.0; LANES];
        for lane in 0..LANES {
            let trace = e.rr[lane] + e.yy[lane] + e.tt[lane];
            let mean = bulk * dilatation[lane] - (2.0 / 3.0) * shear * trace;
            let s_rr = mean + 2.0 * shear * e.rr[lane];
            let s_yy = mean + 2.0 * shear * e.yy[lane];
            let s_ry = shear * e.ry[lane];
            hoop_stress[lane] = mean + 2.0 * shear * e.tt[lane];
            let [k_rr, k_yy, k_ry] = [0, 1, 2].map(|k: usize| block.hourglass_stiffness[k][lane]);
            let (q_r, q_y) = (e.hourglass_r[lane], e.hourglass_y[lane]);
            let hourglass_r = shear * (k_rr * q_r + k_ry * q_y);
            let hourglass_y = shear * (k_ry * q_r + k_yy * q_y);
            for a in 0..3 {
                let (g_r, g_y) = (block.gradient_r[a][lane], block.gradient_y[a][lane]);
                let gamma = block.hourglass[a][lane];
                force_r[a][lane] = g_r * s_rr + g_y * s_ry + gamma * hourglass_r;
                force_y[a][lane] = g_y * s_yy + g_r * s_ry + gamma * hourglass_y;
            }
        }
        for lane in 0..LANES {
            force_r[3][lane] = -(force_r[0][lane] + force_r[1][lane] + force_r[2][lane]);
            force_y[3][lane] = -(force_y[0][lane] + force_y[1][lane] + force_y[2][lane]);
        }
        for a in 0..4 {
            for lane in 0..LANES {
                force_r[a][lane] += block.hoop[a][lane] * hoop_stress[lane];
            }
        }
        for lane in 0..LANES {
            for a in 0..4 {
                let node = &mut f[block.corners[a][lane] as usize];
                node[0] -= force_r[a][lane];
                node[1] -= force_y[a][lane];
            }
        }
    }
}

/// Subtracts the internal forces (N) of one field from `f`.
#[multiversion(targets("x86_64+avx2", "aarch64+neon"))]
pub(crate) fn subtract_internal_forces(
    blocks: &[Block],
    moduli: Moduli,
    w: &Field,
    f: &mut Field,
) {
    subtract_forces::<false>(blocks, moduli, w, w, f);
}

/// Subtracts the internal forces (N) from `f`: bulk stress of `u`, deviatoric
/// stress of `w`.
#[multiversion(targets("x86_64+avx2", "aarch64+neon"))]
pub(crate) fn subtract_split_internal_forces(
    blocks: &[Block],
    moduli: Moduli,
    u: &Field,
    w: &Field,
    f: &mut Field,
) {
    subtract_forces::<true>(blocks, moduli, u, w, f);
}

/// Strain energy (J) of a field.
#[multiversion(targets("x86_64+avx2", "aarch64+neon"))]
pub(crate) fn strain_energy(blocks: &[Block], moduli: Moduli, field: &Field) -> f64 {
    let mut twice = [0.0; LANES];
    for block in blocks {
        let e = Corners::gather(block, field).strain(block);
        for lane in 0..LANES {
            let trace = e.rr[lane] + e.yy[lane] + e.tt[lane];
            let square = e.rr[lane] * e.rr[lane]
                + e.yy[lane] * e.yy[lane]
                + e.tt[lane] * e.tt[lane]
                + 0.5 * e.ry[lane] * e.ry[lane];
            let [k_rr, k_yy, k_ry] = [0, 1, 2].map(|k: usize| block.hourglass_stiffness[k][lane]);
            let (q_r, q_y) = (e.hourglass_r[lane], e.hourglass_y[lane]);
            let hourglass = k_rr * q_r * q_r + 2.0 * k_ry * q_r * q_y + k_yy * q_y * q_y;
            twice[lane] += moduli.bulk * trace * trace
                + moduli.shear * (2.0 * (square - trace * trace / 3.0) + hourglass);
        }
    }
    0.5 * twice.iter().sum::<f64>()
}

/// Central differences: v ← v + Δt f/m, u ← u + Δt v.
#[multiversion(targets("x86_64+avx2", "aarch64+neon"))]
pub(crate) fn advance_motion(
    time_step: f64,
    inverse_mass: &Field,
    f: &Field,
    v: &mut Field,
    u: &mut Field,
) {
    let (f, v, u) = (f.as_flattened(), v.as_flattened_mut(), u.as_flattened_mut());
    for (((v, u), f), inverse_mass) in
        v.iter_mut().zip(u).zip(f).zip(inverse_mass.as_flattened())
    {
        *v += time_step * (inverse_mass * f);
        *u += time_step * *v;
    }
}

/// Starts the effective displacement: w ← g∞ u.
#[multiversion(targets("x86_64+avx2", "aarch64+neon"))]
pub(crate) fn start_effective(equilibrium_weight: f64, u: &Field, w: &mut Field) {
    for (w, u) in w.as_flattened_mut().iter_mut().zip(u.as_flattened()) {
        *w = equilibrium_weight * u;
    }
}

/// Advances one Prony branch by a step of constant rate and adds its share:
/// q ← decay q + gain Δu, w ← w + weight q.
#[multiversion(targets("x86_64+avx2", "aarch64+neon"))]
pub(crate) fn advance_branch(
    decay: f64,
    gain_times_step: f64,
    weight: f64,
    v: &Field,
    q: &mut Field,
    w: &mut Field,
) {
    let (q, w) = (q.as_flattened_mut(), w.as_flattened_mut());
    for ((q, w), v) in q.iter_mut().zip(w).zip(v.as_flattened()) {
        *q = decay * *q + gain_times_step * v;
        *w += weight * *q;
    }
}
