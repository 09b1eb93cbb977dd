//! Artificial viscosity that spreads steep fronts over several elements, a part of the step.
//!
//! Decided by the approach speed over the shear wave speed. The contact edge a = √(R* v t) first moves faster than
//! shear waves, up to R* v/(2 c_s): a steep front, behind which a mesh rings. At the limit of the speed that is a third
//! of an element, with eight elements across the contact radius, and it grows as v^(3/5). For an elastic glass pair
//! with springs on nodes with mass, ringing raises the largest force of a step by 1.3 % at 6e-3, 6 % at the limit and 8
//! % at 0.05. With a massless boundary force and pressure agree with those with viscosity to 0.1 % up to 0.06, so it is
//! not called for.
//!
//! Its own loss grows as v^(3/5): the strain rate is (a/R*)(c_s/c_p)²/T in the volume a³ over the time T, and elements
//! are a share of a, so that the share of the energy is
//!
//! ```math
//! \frac{\Delta e}{e_0} \propto \frac{\rho c_p h}{\frac12 m v^2}\Bigl(\frac a{R^*T}\,\frac{c_s^2}{c_p^2}\Bigr)^2 a^3 T
//! \propto \Bigl(\frac v{c_s}\Bigr)^{3/5}\frac{c_s^4}{c_p^4}.
//! ```
//!
//! The factors are measured: pairs, walls and half-spaces, ν from −0.4 to 0.45, elastic and relaxing, at
//! default settings and v/c_s from 3e-3 to 0.08, within a factor of three.

use fem_case::{Body, ContactMethod, Scene, Switch, defaults};
use fem_laws::RelativeError;
use fem_material::Material;

use crate::effects::decision::neglect_error::EffectStatus;
use crate::effects::decision::neglect_error::NeglectError;
use crate::effects::decision::relevance::Relevance;
use crate::effects::decision::relevance::{MACH_LIMIT, above, number};
use crate::effects::decision::{BulkViscosity, Effect, FiniteStrain};
use crate::estimate::Estimate;
use crate::quantity_errors::QuantityErrors;

/// Loss of restitution over (v/c_s)^(3/5) (c_s/c_p)⁴, and relative decrease of the peak force, which is a mean without ringing,
/// over (v/c_s)^(3/5); the largest force of a single step decreases by 0.6.
const BY_SMOOTHING: RelativeError =
    RelativeError { restitution: 0.005, contact_time: 0.0, peak_force: 0.02 };

/// Largest approach speed over shear wave speed for these coefficients, which were measured on pairs, walls and
/// half-spaces.
const MAX_MACH: f64 = 0.1;

impl BulkViscosity {
    /// Returns whether a model that supports it computes it, for an approach speed over the shear wave
    /// speed and possibly finite strain.
    pub(crate) fn is_on(scene: &Scene, mach: f64, is_finite: bool) -> bool {
        match scene.effects().bulk_viscosity {
            Some(Switch::On) => true,
            Some(Switch::Off) => false,
            None | Some(Switch::Auto) => is_needed(scene, mach, is_finite),
        }
    }
}

fn is_needed(scene: &Scene, mach: f64, is_finite: bool) -> bool {
    mach > MACH_LIMIT && rings(scene, is_finite)
}

/// Returns whether the contact rings without it. At finite strain springs act on nodes with mass.
fn rings(scene: &Scene, is_finite: bool) -> bool {
    is_finite
        || scene.contact_method().unwrap_or(defaults::CONTACT_METHOD) != ContactMethod::Massless
}

impl Effect for BulkViscosity {
    fn relevance(&self, scene: &Scene, estimate: &Estimate) -> Option<Relevance> {
        let is_finite = FiniteStrain::is_on(scene, estimate);
        let is_needed = is_needed(scene, estimate.mach, is_finite);
        let if_not_needed = match estimate.mach > MACH_LIMIT {
            true => "a contact without mass does not ring behind steep fronts",
            false => "too slow for steep fronts",
        };
        let warning = is_needed.then(|| {
            let speed = above(estimate, MACH_LIMIT);
            format!("{speed}, where steep fronts ring in the mesh, mostly in pressure")
        });
        Some(Relevance {
            is_needed,
            number: number(estimate),
            if_not_needed: if_not_needed.to_string(),
            open_error: String::new(),
            warning,
        })
    }

    /// It belongs to the mesh, not to the physical system.
    fn model_form_error(&self, _: &Scene, _: &Estimate, _: &EffectStatus) -> QuantityErrors {
        QuantityErrors::ZERO
    }

    /// The change of the contact time is not known, since ringing ends the contact. At finite strain the contact damps the
    /// ringing, and there is no estimate.
    fn neglect_error(&self, scene: &Scene, estimate: &Estimate) -> Option<NeglectError> {
        if FiniteStrain::is_on(scene, estimate) {
            return None;
        }
        let materials = scene.bodies().iter().filter_map(Body::material);
        let squared_ratio = |material: &Material| {
            let nu = material.instantaneous().poissons_ratio();
            (1.0 - 2.0 * nu) / (2.0 * (1.0 - nu))
        };
        let largest = materials.map(squared_ratio).fold(0.0, f64::max);
        let growth = Some(estimate.mach).filter(|mach| *mach <= MAX_MACH)?.powf(0.6);
        let smoothing = if rings(scene, false) { BY_SMOOTHING.peak_force } else { 0.0 };
        let changes = NeglectError::shares(estimate, 0.0, smoothing * growth);
        let loss = NeglectError::restitution(BY_SMOOTHING.restitution * growth * largest.powi(2));
        Some(NeglectError { restitution: loss.restitution, contact_time_s: None, ..changes })
    }
}
