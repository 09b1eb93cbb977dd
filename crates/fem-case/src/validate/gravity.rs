//! `[gravity]` and `[stop]`: the weight of the upper sphere, its support, and the number of bounces.

use super::Check;
use crate::engineering::show;
use crate::error::CaseError;
use crate::quantity::range::Range;
use crate::scene::body::{Body, Shape};
use crate::scene::{Gravity, defaults, impact_speed};
use crate::schema::{CaseFile, GravityTable};
use crate::source::toml_syntax::join;

/// The pairs of bodies that gravity allows.
const SUPPORTS: &str = "with gravity, the second body must be a free sphere and the first a support: \
                        a wall, a half-space or a held sphere (held = true)";

impl Check<'_> {
    /// Returns the gravity of a case, if it has any; `gap` (m) is the distance at time 0.
    pub(super) fn gravity(
        &self,
        file: &CaseFile,
        bodies: &[Body; 2],
        gap: f64,
    ) -> Result<Option<Gravity>, CaseError> {
        for (index, body) in bodies.iter().enumerate() {
            if body.held && !matches!(body.shape, Shape::Sphere { .. }) {
                let message = format!("\"{}\" is held but is not a sphere", body.name);
                let error = self.error(&join(&place(index), "held"), message);
                return Err(error.with_help("only a sphere can be held: remove the key"));
            }
        }
        let bounces = file.stop.as_ref().and_then(|stop| stop.bounces.as_ref());
        let bounces = self.optional("stop.bounces", bounces, Range::BOUNCES)?;
        match &file.gravity {
            None => self.no_gravity(bodies, bounces.is_some()).map(|()| None),
            Some(table) => {
                let acceleration = self.weight(table, bodies, gap)?;
                let bounces = bounces.map_or(defaults::BOUNCES, |bounces| bounces as usize);
                Ok(Some(Gravity { acceleration, bounces, spot: table.spot }))
            }
        }
    }

    /// Rejects keys that have no meaning without gravity.
    fn no_gravity(&self, bodies: &[Body; 2], has_bounces: bool) -> Result<(), CaseError> {
        let help = "add [gravity] with acceleration = \"9.81 m/s^2\", or remove the key";
        if let Some(index) = bodies.iter().position(|body| body.held) {
            let message = format!("\"{}\" is held, but there is no [gravity]", bodies[index].name);
            return Err(self.error(&join(&place(index), "held"), message).with_help(help));
        }
        if has_bounces {
            let message = "stop.bounces needs [gravity]: without it the bodies meet once";
            return Err(self.error("stop.bounces", message).with_help(help));
        }
        Ok(())
    }

    /// Returns the acceleration (m/s²) if the upper body can fall on the lower one.
    fn weight(&self, table: &GravityTable, bodies: &[Body; 2], gap: f64) -> Result<f64, CaseError> {
        let acceleration =
            self.number("gravity.acceleration", &table.acceleration, Range::POSITIVE)?;
        let [lower, upper] = bodies;
        let reject =
            |path: &str, message: String| Err(self.error(path, message).with_help(SUPPORTS));
        if lower.held && upper.held {
            return reject("body.1.held", "both bodies are held: neither can fall".to_string());
        }
        if upper.held {
            let message = format!("the upper body \"{}\" is held and cannot fall", upper.name);
            return reject("body.1.held", message);
        }
        if !matches!(upper.shape, Shape::Sphere { .. }) {
            let message =
                format!("gravity is on, but the upper body \"{}\" is not a sphere", upper.name);
            return reject("gravity", message);
        }
        if matches!(lower.shape, Shape::Sphere { .. }) && !lower.held {
            let message =
                format!("gravity is on, but nothing supports the free sphere \"{}\"", lower.name);
            return reject("gravity", message);
        }
        if lower.velocity != 0.0 {
            let message = format!("the support \"{}\" moves", lower.name);
            let error = self.error("body.0.approach_speed", message);
            return Err(error.with_help("remove approach_speed from the first body"));
        }
        let impact_speed = impact_speed(upper.velocity, acceleration, gap);
        if !(impact_speed > 0.0 && impact_speed.is_finite()) {
            let message = format!(
                "\"{}\" would never reach its support (impact speed {})",
                upper.name,
                show(impact_speed, "m/s")
            );
            let given = ["body.1.approach_speed", "start.gap"];
            let path = given.into_iter().find(|path| self.document.has(path)).unwrap_or("gravity");
            return Err(self.error(path, message).with_help(
                "set its approach_speed, or let it fall from a height: [start] gap = \"10 cm\"",
            ));
        }
        Ok(acceleration)
    }
}

fn place(index: usize) -> String {
    format!("body.{index}")
}
