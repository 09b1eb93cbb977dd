//! Energy of the hourglass shape in a deformed element.
//!
//! A field that the mean gradient does not see, u = q φ with the amplitude q = γ·u and φ = ξη/4 less its
//! mean gradient, adds q ⊗ ∇φ to the deformation gradient. To second order in q the isochoric energy
//! G/2 (J^(−2/3) F:F − 3), integrated over the element, grows by
//!
//! ```math
//! E_h = \frac G2 J^{-2/3}\, A : \hat q \otimes \hat q, \qquad
//! A = \mathrm{tr} M\; C - \tfrac23 (M C + C M) + \tfrac59\, \mathrm{tr}_3 C\; M, \qquad \hat q = \bar F^{-1} q
//! ```
//!
//! with M = ∫ ∇φ ⊗ ∇φ dV ([`hourglass_measures`](fem_element::QuadGeometry::hourglass_measures)), C = F̄ᵀF̄
//! in the meridian and tr₃ C with its hoop. That energy is polyconvex, so E_h is positive for every q and
//! F̄: a compressed element stiffens against hourglassing as the material does. It takes q and F̄ to R q
//! and R F̄ without change, is the small-strain element's at F̄ = 1, and leaves the volume free, as there.
//! Shapes of all laws have it.
//!
//! **Relaxation.** Each term of weight g_k keeps an amplitude â_k that has flown, stores
//! g_k E_h of q̂ − â_k, flows by (q̂ − â_k)/τ_k, which is exact in a step of even growth, and dissipates
//! 2 g_k E_h/τ_k: at small strain the term of the small-strain element. All terms together are one E_h of
//!
//! ```math
//! S = g_\infty \hat q \otimes \hat q + \sum_k g_k (\hat q - \hat a_k) \otimes (\hat q - \hat a_k), \qquad
//! p = \hat q - \sum_k g_k \hat a_k
//! ```
//!
//! in the places of q̂ ⊗ q̂ and, for the derivative by q, of q̂.

use fem_material::finite::{AxisymmetricTensor, Number, inverse_cube_root};

/// Derivatives of the hourglass energy by the amplitude (N) and by F̄ (J).
pub(super) struct HourglassForce<N> {
    pub q: (N, N),
    pub stress: AxisymmetricTensor<N>,
}

/// Amplitudes in the undeformed element, with what of them has flown: q̂, p, and S as rr, yy, ry.
#[derive(Clone, Copy)]
pub(super) struct Amplitudes<N> {
    pub own: (N, N),
    mean: (N, N),
    square: [N; 3],
}

impl<N: Number> Amplitudes<N> {
    /// Starts with the weight of the part that does not relax; terms are added.
    #[inline(always)]
    pub fn new(own: (N, N), equilibrium_weight: f64) -> Self {
        Self { own, mean: own, square: square(N::splat(equilibrium_weight), own) }
    }

    /// Adds a term of a weight, of which an amplitude has flown.
    #[inline(always)]
    pub fn add_term(&mut self, weight: f64, flown: (N, N)) {
        let weight = N::splat(weight);
        let elastic = (self.own.0 - flown.0, self.own.1 - flown.1);
        self.mean = (
            self.mean.0.minus_product(weight, flown.0),
            self.mean.1.minus_product(weight, flown.1),
        );
        let [sum_rr, sum_yy, sum_ry] = self.square;
        let (r, y) = (weight * elastic.0, weight * elastic.1);
        self.square = [
            sum_rr.plus_product(r, elastic.0),
            sum_yy.plus_product(y, elastic.1),
            sum_ry.plus_product(r, elastic.1),
        ];
    }
}

/// Returns w x ⊗ x as rr, yy, ry.
#[inline(always)]
fn square<N: Number>(weight: N, x: (N, N)) -> [N; 3] {
    let (r, y) = (weight * x.0, weight * x.1);
    [r * x.0, y * x.1, r * x.1]
}

/// Returns A : B of symmetric plane tensors.
#[inline(always)]
fn dot<N: Number>(a: [N; 3], b: [N; 3]) -> N {
    let off = a[2] * b[2];
    (off + off).plus_product(a[0], b[0]).plus_product(a[1], b[1])
}

/// Deformed elements, as the hourglass shape needs them.
pub(super) struct Deformed<N> {
    /// Deformation gradient F̄.
    f: AxisymmetricTensor<N>,
    /// 1/J, and 1/J of the meridian plane.
    inverse: N,
    inverse_area: N,
    /// ½ G J^(−2/3), Pa.
    scale: N,
    /// M: rr, yy, ry, m.
    measures: [N; 3],
    /// A: rr, yy, ry, m.
    stiffness: [N; 3],
}

impl<N: Number> Deformed<N> {
    /// Takes a displacement gradient, a shear modulus (Pa) and measures, m.
    #[inline(always)]
    pub fn of(h: &AxisymmetricTensor<N>, shear: N, measures: [N; 3]) -> Self {
        let one = N::splat(1.0);
        let f = AxisymmetricTensor {
            rr: one + h.rr,
            ry: h.ry,
            yr: h.yr,
            yy: one + h.yy,
            tt: one + h.tt,
        };
        let right = [
            (f.rr * f.rr).plus_product(f.yr, f.yr),
            (f.ry * f.ry).plus_product(f.yy, f.yy),
            (f.rr * f.ry).plus_product(f.yr, f.yy),
        ];
        let ninths = N::splat(5.0 / 9.0) * (right[0] + right[1]).plus_product(f.tt, f.tt);
        let [rr, yy, ry] = turned(measures, right);
        let stiffness = [
            rr.plus_product(ninths, measures[0]),
            yy.plus_product(ninths, measures[1]),
            ry.plus_product(ninths, measures[2]),
        ];
        let y = inverse_cube_root(one + h.volume_change());
        let y_y = y * y;
        let inverse = y_y * y;
        Self {
            inverse,
            inverse_area: inverse * f.tt,
            scale: N::splat(0.5) * shear * y_y,
            measures,
            stiffness,
            f,
        }
    }

    /// Pulls an amplitude back: F̄⁻¹ x.
    #[inline(always)]
    pub fn pull_back(&self, x: (N, N)) -> (N, N) {
        let Self { f, inverse_area: i, .. } = self;
        (*i * (f.yy * x.0).minus_product(f.ry, x.1), *i * (f.rr * x.1).minus_product(f.yr, x.0))
    }

    /// Pushes an amplitude force forward: F̄⁻ᵀ x.
    #[inline(always)]
    fn push_forward(&self, x: (N, N)) -> (N, N) {
        let Self { f, inverse_area: i, .. } = self;
        (*i * (f.yy * x.0).minus_product(f.yr, x.1), *i * (f.rr * x.1).minus_product(f.ry, x.0))
    }

    /// Returns the energy of amplitudes (m), J.
    #[inline(always)]
    pub fn energy(&self, amplitudes: &Amplitudes<N>) -> N {
        self.scale * dot(self.stiffness, amplitudes.square)
    }

    /// Returns the energy of one amplitude in the undeformed element (m), J.
    #[inline(always)]
    pub fn energy_of(&self, amplitude: (N, N)) -> N {
        self.scale * dot(self.stiffness, square(N::splat(1.0), amplitude))
    }

    /// Returns the derivatives of the energy at fixed internal variables.
    #[inline(always)]
    pub fn force(&self, amplitudes: &Amplitudes<N>) -> HourglassForce<N> {
        let Self { f, measures, stiffness, .. } = self;
        let Amplitudes { own, mean, square } = amplitudes;
        let twice = self.scale + self.scale;
        let (d_r, d_y) = self.push_forward((
            twice * (stiffness[0] * mean.0).plus_product(stiffness[2], mean.1),
            twice * (stiffness[2] * mean.0).plus_product(stiffness[1], mean.1),
        ));
        // Twice the derivative with respect to C at constant q̂.
        let hoop = N::splat(5.0 / 9.0) * dot(*measures, *square);
        let [rr, yy, ry] = turned(*measures, *square);
        let (b_rr, b_yy, b_ry) = (twice * (rr + hoop), twice * (yy + hoop), twice * ry);
        // And by F̄⁻ᵀ = cof F̄/J.
        let shape = N::splat(-2.0 / 3.0) * self.energy(amplitudes);
        let out = shape * self.inverse_area;
        let area = (f.rr * f.yy).minus_product(f.ry, f.yr);
        HourglassForce {
            q: (d_r, d_y),
            stress: AxisymmetricTensor {
                rr: (out * f.yy)
                    .plus_product(f.rr, b_rr)
                    .plus_product(f.ry, b_ry)
                    .minus_product(d_r, own.0),
                ry: (f.rr * b_ry)
                    .plus_product(f.ry, b_yy)
                    .minus_product(out, f.yr)
                    .minus_product(d_r, own.1),
                yr: (f.yr * b_rr)
                    .plus_product(f.yy, b_ry)
                    .minus_product(out, f.ry)
                    .minus_product(d_y, own.0),
                yy: (out * f.rr)
                    .plus_product(f.yr, b_ry)
                    .plus_product(f.yy, b_yy)
                    .minus_product(d_y, own.1),
                tt: (f.tt * (twice * hoop)).plus_product(shape * self.inverse, area),
            },
        }
    }
}

/// Returns tr M X − 2/3 (M X + X M) of symmetric plane tensors.
#[inline(always)]
fn turned<N: Number>(m: [N; 3], x: [N; 3]) -> [N; 3] {
    let (third, two_thirds) = (N::splat(1.0 / 3.0), N::splat(2.0 / 3.0));
    let (trace, four_thirds) = (m[0] + m[1], N::splat(4.0 / 3.0));
    let off = four_thirds * m[2] * x[2];
    [
        (trace.minus_product(four_thirds, m[0]) * x[0]) - off,
        (trace.minus_product(four_thirds, m[1]) * x[1]) - off,
        (third * trace * x[2]).minus_product(two_thirds * m[2], x[0] + x[1]),
    ]
}
