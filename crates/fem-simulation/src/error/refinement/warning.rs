//! What is said of a collision that misses its tolerance.

use fem_collision::{Collision, QuantityOfInterest};

use super::kept::{Kept, is_of_noise};
use super::miss::Miss;
use super::{ORDER, ROOM, STEPS, length};
use crate::error::FEW;
use crate::results::diagnostics::overlap_warning;
use crate::simulation::Simulation;

/// The same with fewer elements than [`FEW`] across the contact.
const ORDER_OF_FEW: f64 = 3.0;
/// Elements that would have to be smaller by more are named to nobody: what they are off by nobody has seen, and a
/// tolerance that needs them is one of rounding.
const MOST_NAMED: f64 = 100.0;
/// The key of their length.
const SIZE: &str = "mesh.contact_element_size";

impl Simulation {
    /// What is to be known of a collision that misses its tolerance, and why its mesh is no finer.
    pub(crate) fn miss_warning(&self, collision: &Collision) -> Option<String> {
        let plan = &self.setup().elements.as_ref()?.plan;
        let missed = self.all_missed(collision);
        let Some(miss) = missed.first() else { return self.untold(collision) };
        // One word a cause.
        if self.is_unresolved(collision)
            || overlap_warning(self, collision).is_some()
            || is_of_noise(miss, collision)
        {
            return None;
        }
        // One word a cause: that one names what does for both.
        if self.finest_needed(collision).is_some()
            && self.mesh_warning_after(collision).is_some_and(|warning| warning.contains(SIZE))
        {
            return None;
        }
        let finer = self.finer_by(&missed, collision);
        let others: Vec<String> = missed[1..].iter().map(|other| other.beside(miss)).collect();
        let others = match others.is_empty() {
            true => String::new(),
            false => format!("; also missed: {}", others.join(", ")),
        };
        let what = miss.in_words();
        let mut cause = "the mesh";
        let size = length(plan.contact_element_size / finer);
        let write = format!("write mesh.contact_element_size = \"{size}\"");
        let remedy = match self.finer_or_kept(miss, Some(collision)) {
            // A setting that is at fault comes first, whatever is asked.
            Err(Kept::Scatter(_)) if plan.is_out_of_reach => return None,
            Err(Kept::Scatter(scatter)) => {
                return Some(format!(
                    "{what}, and by {} on any mesh: allow more in accuracy.tolerance{others}",
                    miss.number(scatter)
                ));
            }
            kept if finer > MOST_NAMED && !matches!(kept, Err(Kept::Setting(_))) => {
                return Some(format!(
                    "{what} because of {cause}, and no mesh can be told that does: allow more in \
                     accuracy.tolerance{others}"
                ));
            }
            // Who has the course decides.
            Ok(_) => write,
            Err(Kept::Given) => write,
            Err(Kept::Setting(setting)) => {
                // One word a cause.
                let of_mesh = self.mesh_warning_after(collision);
                if of_mesh.is_some_and(|warning| warning.contains(setting.key())) {
                    return None;
                }
                cause = setting.in_words();
                format!("leave {} out", setting.key())
            }
            Err(Kept::FromFile) => "use meshes that are finer at the contact".to_string(),
            Err(Kept::Gravity) => {
                format!("elements of contacts under gravity are not made finer; {write}")
            }
            Err(Kept::Dear { updates: Some(updates) }) => format!(
                "a finer mesh would take {:.1e} element updates; write limits.element_updates = {:.0e}, or {write}",
                updates as f64,
                rounded_up(updates)
            ),
            Err(Kept::Dear { updates: None }) => write,
            Err(Kept::Stopped(why)) => format!("on a finer mesh {why}"),
            Err(Kept::Refused(fault)) => match fault.key() {
                Some(key) if key.starts_with("limits.") => {
                    format!("on a finer mesh {}; raise {key}", fault.message())
                }
                _ => format!("on a finer mesh {}; {write}", fault.message()),
            },
        };
        Some(format!(
            "{what} because of {cause}: {remedy}, or allow more in accuracy.tolerance{others}"
        ))
    }

    /// By how much elements would have to be smaller for what a collision is off by, as far as a mesh can help. Errors
    /// that are told of few elements fall faster than those of more.
    fn finer_by(&self, missed: &[Miss], collision: &Collision) -> f64 {
        let of_mesh = missed.iter().filter(|miss| miss.is_of_mesh());
        let excess = of_mesh.map(Miss::excess_of_mesh).fold(1.0, f64::max);
        let size =
            self.setup().elements.as_ref().map(|elements| elements.plan.contact_element_size);
        let across =
            collision.max_contact_radius.zip(size).map_or(FEW, |(radius, size)| radius / size);
        let to_usual = (FEW / across).max(1.0);
        let (excess, of_few) = (ROOM * excess, to_usual.powf(ORDER_OF_FEW));
        match excess < of_few {
            true => excess.powf(1.0 / ORDER_OF_FEW).max(STEPS[0]),
            false => (to_usual * (excess / of_few).powf(1.0 / ORDER)).max(STEPS[0]),
        }
    }

    /// Length of the elements (m) that a collision needs on whose mesh it misses its tolerance, where that was given.
    pub(crate) fn finest_needed(&self, collision: &Collision) -> Option<f64> {
        let missed = self.all_missed(collision);
        let finer = self.finer_by(&missed, collision);
        let kept = self.finer_or_kept(missed.first()?, Some(collision));
        let is_given = matches!(kept, Err(Kept::Given));
        let size = self.setup().elements.as_ref()?.plan.contact_element_size;
        (is_given && finer <= MOST_NAMED).then_some(size / finer)
    }

    /// That nothing tells what the mesh of a collision is off by, where that was to be told.
    fn untold(&self, collision: &Collision) -> Option<String> {
        let is_to_be = collision.is_complete()
            && collision.element_updates.is_some()
            && self.setup().elements.as_ref()?.plan.makes_meshes;
        let is_told = self.discretisation(collision).size(QuantityOfInterest::PeakForce).is_some();
        (is_to_be && !is_told).then(|| {
            "what the mesh is off by is not told: on coarser and finer meshes the bodies did not come through the \
             collision; lower body.N.approach_speed, or compare results of several mesh.contact_element_size"
                .to_string()
        })
    }
}

/// One digit.
fn rounded_up(updates: u64) -> f64 {
    let power = 10f64.powf((updates as f64).log10().floor());
    (updates as f64 / power).ceil() * power
}
