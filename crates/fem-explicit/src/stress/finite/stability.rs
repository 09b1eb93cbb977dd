//! Material stability: whether the law of an element still bears every wave, by the [`least_acoustic_stiffness`] of its
//! instantaneous tangent, elastic and relaxing branches together.

use fem_material::finite::{AxisymmetricTensor, Inverted, least_acoustic_stiffness};

use super::super::traits::UnstableElement;
use super::ElementResponse;
use super::block::Blocks;
use crate::part::{Field, NodalField};

/// Difference of a strain: the stress has a relative rounding error of 1e-16, and its slope changes over a strain of 1.
const STRAIN_STEP: f64 = 1e-6;

/// Returns the element with the least stiffness against a wave, if that is not positive. Collapsed elements are left out;
/// they are reported elsewhere.
pub(super) fn unstable_element<R: ElementResponse>(
    blocks: &Blocks,
    response: &R,
    u: &Field,
    history: &[NodalField],
) -> Option<UnstableElement> {
    let mut least = (0.0, None);
    for element in 0..blocks.n_elements() {
        let h = blocks.gradient(element, u);
        let slot = blocks.slot(element);
        let stress = |h: &AxisymmetricTensor| {
            let cauchy = response.cauchy(h, slot, history)?;
            // P = J σ F⁻ᵀ in the plane: the cofactors of F, times the hoop.
            let (f_rr, f_yy, f_tt) = (1.0 + h.rr, 1.0 + h.yy, 1.0 + h.tt);
            Ok([
                f_tt * (cauchy.rr * f_yy - cauchy.ry * h.ry),
                f_tt * (cauchy.ry * f_rr - cauchy.rr * h.yr),
                f_tt * (cauchy.ry * f_yy - cauchy.yy * h.ry),
                f_tt * (cauchy.yy * f_rr - cauchy.ry * h.yr),
            ])
        };
        let Ok(tangent) = tangent(&h, stress) else { continue };
        let stiffness = least_acoustic_stiffness(&tangent);
        if stiffness <= least.0 {
            least = (stiffness, Some((element, h)));
        }
    }
    let (element, h) = least.1?;
    let (stretches, law) = (h.principal_stretches(), response.law_name().name());
    Some(UnstableElement { element, stretches, law })
}

/// Returns the slopes of a stress with the components rr, ry, yr, yy.
fn tangent(
    h: &AxisymmetricTensor,
    stress: impl Fn(&AxisymmetricTensor) -> Result<[f64; 4], Inverted>,
) -> Result<[[f64; 4]; 4], Inverted> {
    let before = stress(h)?;
    let mut tangent = [[0.0; 4]; 4];
    for k in 0..4 {
        let mut moved = *h;
        let component = [&mut moved.rr, &mut moved.ry, &mut moved.yr, &mut moved.yy];
        *component[k] += STRAIN_STEP;
        let after = stress(&moved)?;
        for (row, (after, before)) in tangent.iter_mut().zip(after.iter().zip(before)) {
            row[k] = (after - before) / STRAIN_STEP;
        }
    }
    Ok(tangent)
}
