//! Ellipticity of a law, from its acoustic tensor.
//!
//! A small wave m sin(N·X) on top of a deformation has the stiffness m·Q m,
//!
//! ```math
//! Q_{ik}(N) = A_{iJkL} N_J N_L, \qquad A = \frac{\partial P}{\partial F}
//! ```
//!
//! (Truesdell & Noll 1965, section 71; Ogden 1984, section 6.2.7). Where the least eigenvalue of Q
//! over all N is not positive, ellipticity is lost: strain localises in a band that depends on the
//! mesh. N and m lie in the meridian plane, because bodies of revolution without twist have no others.

/// Number of directions over half a turn. Q is linear in the sine and cosine of twice the angle, so the error of its
/// least eigenvalue is at most ½ (2 · ½ π/64)² of the range of Q, 0.1 %.
const N_DIRECTIONS: usize = 64;
/// Cosine and sine of π/64: written out, so that directions are the same on all machines.
const NEXT: [f64; 2] = [0.998_795_456_205_172_4, 0.049_067_674_327_418_015];

/// Returns the least eigenvalue of the acoustic tensor over all directions of the meridian plane, for the stiffness A
/// of the components rr, ry, yr, yy, in the unit of A.
pub fn least_acoustic_stiffness(tangent: &[[f64; 4]; 4]) -> f64 {
    let (mut least, mut direction) = (f64::INFINITY, [1.0, 0.0]);
    for _ in 0..N_DIRECTIONS {
        // Component iJ of P is at 2 i + J.
        let q = |i: usize, k: usize| {
            let row = |a: usize| {
                let column = |b: usize| tangent[2 * i + a][2 * k + b] * direction[b];
                direction[a] * (column(0) + column(1))
            };
            row(0) + row(1)
        };
        let (rr, yy, ry) = (q(0, 0), q(1, 1), 0.5 * (q(0, 1) + q(1, 0)));
        let half = 0.5 * (rr - yy);
        least = f64::min(least, 0.5 * (rr + yy) - (half * half + ry * ry).sqrt());
        let ([c, s], [next_c, next_s]) = (direction, NEXT);
        direction = [c * next_c - s * next_s, s * next_c + c * next_s];
    }
    least
}
