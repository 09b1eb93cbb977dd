//! The error of a difference between two results, without what both share.
//!
//! Two runs on the same mesh with the same settings err in the same direction by nearly as much, and two that neglect
//! the same effects do so too. Of a shared error counts only how much the two differ, relative to their values, and
//! [`REMAINDER`] of the smaller one; errors that are not shared are added.

use fem::results::Parts;
use fem_collision::QuantityOfInterest;
use serde_json::{Map, Value};

use super::stored_result::StoredResult;
use crate::answer::error_scale;

/// The share of the smaller error that remains in a difference. In 144 differences of elastic and relaxing glass pairs
/// of other weight, modulus and speed, on meshes of 40 to 75 µm against fine ones, in `condensed` and `fem`, the error
/// was at most the difference of both errors and 0.4 of the smaller one.
const REMAINDER: f64 = 0.5;

/// Which errors two results share.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct SharedErrors {
    /// Whether they have the same bodies' sizes, mesh, time step and contact.
    pub discretisation: bool,
    /// Whether they have the same model and neglect the same effects.
    pub model: bool,
}

impl SharedErrors {
    /// Compares the cases and the effects of two results.
    pub fn of(one: &StoredResult, other: &StoredResult) -> Self {
        let is_same = |get: &dyn Fn(&StoredResult) -> Value| get(one) == get(other);
        let has_same_model = is_same(&|result| key(result, "model"));
        let has_same_mesh = is_same(&|result| {
            let numerics = ["mesh", "time", "contact"].map(|name| key(result, name));
            let mut numerics = Value::from(numerics.to_vec());
            // How far fine elements reach follows from the scene.
            if let Some(mesh) = numerics[0].as_object_mut() {
                mesh.remove("refined_radius");
            }
            numerics
        });
        let has_same_sizes = is_same(&|result| {
            let bodies = key(result, "body");
            let shape = |body: &Value| {
                let mut shape = body.as_object().cloned().unwrap_or_default();
                shape.retain(|name, _| !["name", "material", "approach_speed"].contains(&&**name));
                Value::from(shape)
            };
            Value::from(bodies.as_array().into_iter().flatten().map(shape).collect::<Vec<_>>())
        });
        let model = has_same_model && is_same(&|result| Value::from(neglected(result)));
        Self { discretisation: has_same_model && has_same_mesh && has_same_sizes, model }
    }

    /// Returns the error of the difference of two values with these errors, in the unit of the second value; `None` if
    /// a part is not known.
    pub fn of_difference(
        self,
        own: (f64, Parts),
        from: (f64, Parts),
        quantity: QuantityOfInterest,
    ) -> Option<f64> {
        let scale = |value: f64| error_scale(value, quantity);
        let joined = |is_shared: bool, part: &dyn Fn(&Parts) -> Option<f64>| {
            let [a, b] = [part(&own.1)? / scale(own.0), part(&from.1)? / scale(from.0)];
            let error = if is_shared { (a - b).abs() + REMAINDER * a.min(b) } else { a + b };
            Some(error * scale(from.0))
        };
        let inputs = joined(false, &|parts| Some(parts.input.unwrap_or(0.0)))?;
        let discretisation = joined(self.discretisation, &|parts| parts.discretisation)?;
        Some(discretisation + joined(self.model, &|parts| parts.model)? + inputs)
    }
}

/// Returns a table of the case, null if there is none.
fn key(result: &StoredResult, name: &str) -> Value {
    result.summary.get("case").and_then(|case| case.get(name)).cloned().unwrap_or_default()
}

/// Returns the names of the effects that are off and not known to change nothing.
fn neglected(result: &StoredResult) -> Vec<String> {
    let changes_nothing = |effect: &Map<String, Value>| {
        let changes = effect.get("error_if_left_out").and_then(Value::as_object);
        changes.is_some_and(|changes| changes.values().all(|size| size.as_f64() == Some(0.0)))
    };
    let effects = result.list("effects").iter().filter_map(Value::as_object);
    let off = effects.filter(|effect| effect.get("active") == Some(&Value::Bool(false)));
    let names =
        off.filter(|effect| !changes_nothing(effect)).filter_map(|effect| effect.get("name"));
    names.filter_map(|name| name.as_str().map(String::from)).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn shared_errors_cancel_and_others_add() {
        let parts = |discretisation, model| Parts {
            discretisation: Some(discretisation),
            model: Some(model),
            ..Parts::default()
        };
        let of = |discretisation, model| {
            let shared = SharedErrors { discretisation, model };
            let (own, from) = ((200.0, parts(2.0, 4.0)), (100.0, parts(1.2, 2.0)));
            shared.of_difference(own, from, QuantityOfInterest::ContactTime).unwrap()
        };
        // Relative errors of 1 and 1.2 %, and of 2 and 2 %, of 100.
        assert!((of(false, false) - 6.2).abs() < 1e-12, "{}", of(false, false));
        assert!((of(true, false) - (0.2 + 0.5 + 4.0)).abs() < 1e-12);
        assert!((of(true, true) - (0.2 + 0.5 + 1.0)).abs() < 1e-12);
        let unknown = (1.0, Parts { model: None, ..parts(1.0, 0.0) });
        let shared = SharedErrors { discretisation: true, model: true };
        let difference = shared.of_difference(unknown, unknown, QuantityOfInterest::PeakForce);
        assert_eq!(difference, None);
    }
}
