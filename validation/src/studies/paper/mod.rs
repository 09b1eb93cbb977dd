//! The figures and numbers of Bordbar & Hyppänen (2007), and the functions that their studies share.

pub(super) mod contact_stress;
pub(super) mod contact_time;
pub(super) mod contours;
pub(super) mod pairings;
pub(super) mod restitution;
pub(super) mod solid;
pub(super) mod velocities;

use std::sync::Arc;

use fem::Plan;
use fem_case::Case;
use serde::Deserialize;

use crate::{ExplicitRun, Laboratory, StudyError, studies::order::fitted_order};

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Speeds {
    speeds: Vec<f64>,
    elements_per_contact_radius: f64,
}

impl Speeds {
    fn run_elastic(&self, laboratory: &Laboratory) -> Result<Vec<Arc<ExplicitRun>>, StudyError> {
        let elements = self.elements_per_contact_radius;
        let elastic = laboratory.case("elastic")?;
        let case = |speed: &f64| case_at(&elastic, *speed, elements);
        laboratory.run_all(self.speeds.iter().map(case).collect::<Result<_, _>>()?)
    }
}

/// Returns the case at an approach speed (m/s) of its first body, with a number of elements across its largest
/// contact radius.
fn case_at(case: &Case, speed: f64, elements: f64) -> Result<Case, StudyError> {
    let case = case.edited(|file| file.body[0].approach_speed = Some(speed.into()))?;
    let size = Plan::of_case(&case)?.estimate.contact_radius / elements;
    Ok(case.edited(|file| {
        file.mesh.get_or_insert_default().contact_element_size = Some(size.into());
    })?)
}

/// Returns the exponent p of the least-squares fit y ∝ xᵖ; NaN if a number is not positive.
fn exponent(points: &[(f64, f64)]) -> f64 {
    let is_positive = points.iter().all(|point| point.1 > 0.0);
    if is_positive { fitted_order(points.iter().copied()) } else { f64::NAN }
}

/// Returns the place between two positive numbers at which a function falls through a value, to rounding; NaN if it
/// does not.
fn falls_through(
    target: f64,
    (mut low, mut high): (f64, f64),
    value: impl Fn(f64) -> Result<f64, StudyError>,
) -> Result<f64, StudyError> {
    let brackets = value(low)? > target && value(high)? < target;
    if !brackets {
        return Ok(f64::NAN);
    }
    while high > low * (1.0 + 1e-12) {
        let middle = (low * high).sqrt();
        if value(middle)? > target { low = middle } else { high = middle }
    }
    Ok(low)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn exponents_of_powers_are_exact() {
        let points: Vec<_> = [0.1f64, 0.5, 1.3, 2.0].map(|x| (x, 3.0 * x.powf(-0.2))).into();
        assert!((exponent(&points) + 0.2).abs() < 1e-14);
        assert!(exponent(&[(1.0, 1.0), (2.0, -1.0)]).is_nan());
    }

    #[test]
    fn crossings_are_found_or_nan() {
        let root = falls_through(0.5, (1e-6, 1e6), |x| Ok(1.0 / (1.0 + x))).unwrap();
        assert!((root - 1.0).abs() < 1e-11);
        for bounds in [(2.0, 3.0), (0.1, 0.5)] {
            assert!(falls_through(0.5, bounds, |x| Ok(1.0 / (1.0 + x))).unwrap().is_nan());
        }
        assert!(falls_through(0.5, (0.1, 9.0), |_| Ok(f64::NAN)).unwrap().is_nan());
    }
}
