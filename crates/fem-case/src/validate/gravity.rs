//! Weight, what bears it, and how often the ball bounces on that.

use super::{Allowed, Check, POSITIVE, allowed};
use crate::error::CaseError;
use crate::scene::body::{Body, Shape};
use crate::scene::gravity::{Gravity, impact_speed};
use crate::schema::{CaseFile, GravityTable};
use crate::source::key_path::join;

/// More contacts than any ball needs to come to rest.
const BOUNCES: Allowed =
    allowed("a whole number from 1 to 10000", |x| (1.0..=1e4).contains(&x) && x.fract() == 0.0);

/// What can bear a weight, in words.
const SUPPORTS: &str = "gravity is for a free sphere, the second body, above a wall, a half-space \
                        or a held sphere (held = true), the first";

impl Check<'_> {
    /// The gravity of a case, `None` if it has none; `gap` (m) is the distance at time 0.
    pub(super) fn gravity(
        &self,
        file: &CaseFile,
        bodies: &[Body; 2],
        gap: f64,
    ) -> Result<Option<Gravity>, CaseError> {
        for (index, body) in bodies.iter().enumerate() {
            if body.held && !matches!(body.shape, Shape::Sphere { .. }) {
                let message = format!("\"{}\" is held, and is no sphere", body.name);
                let error = self.error(&join(&place(index), "held"), message);
                return Err(error.with_help("held = true is for a sphere; leave the key out"));
            }
        }
        let bounces = file.stop.as_ref().and_then(|stop| stop.bounces.as_ref());
        let bounces = self.optional("stop.bounces", bounces, BOUNCES)?;
        match &file.gravity {
            None => self.no_gravity(bodies, bounces.is_some()).map(|()| None),
            Some(table) => {
                let acceleration = self.weight(table, bodies, gap)?;
                let bounces = bounces.map_or(1, |bounces| bounces as usize);
                Ok(Some(Gravity { acceleration, bounces }))
            }
        }
    }

    /// What has no meaning without gravity.
    fn no_gravity(&self, bodies: &[Body; 2], has_bounces: bool) -> Result<(), CaseError> {
        let help = "add [gravity] with acceleration = \"9.81 m/s^2\", or leave the key out";
        if let Some(index) = bodies.iter().position(|body| body.held) {
            let message = format!("\"{}\" is held, without [gravity]", bodies[index].name);
            return Err(self.error(&join(&place(index), "held"), message).with_help(help));
        }
        if has_bounces {
            let message = "bounces without [gravity]: nothing brings the bodies together again";
            return Err(self.error("stop.bounces", message).with_help(help));
        }
        Ok(())
    }

    /// The acceleration (m/s²) of bodies of which one can fall on the other.
    fn weight(&self, table: &GravityTable, bodies: &[Body; 2], gap: f64) -> Result<f64, CaseError> {
        let acceleration = self.number("gravity.acceleration", &table.acceleration, POSITIVE)?;
        let [lower, upper] = bodies;
        let refuse =
            |path: &str, message: String| Err(self.error(path, message).with_help(SUPPORTS));
        if lower.held && upper.held {
            return refuse("body.1.held", "both bodies are held: none can fall".to_string());
        }
        if upper.held {
            let message = format!("\"{}\" is held, and lies above", upper.name);
            return refuse("body.1.held", message);
        }
        if !matches!(upper.shape, Shape::Sphere { .. }) {
            let message =
                format!("gravity, and \"{}\", which lies above, is no sphere", upper.name);
            return refuse("gravity", message);
        }
        if matches!(lower.shape, Shape::Sphere { .. }) && !lower.held {
            let message = format!("gravity, and nothing bears \"{}\", a free sphere", lower.name);
            return refuse("gravity", message);
        }
        if lower.velocity != 0.0 {
            let message = format!("\"{}\" bears a weight, and moves", lower.name);
            let error = self.error("body.0.approach_speed", message);
            return Err(error.with_help("leave approach_speed out of the first body"));
        }
        let impact_speed = impact_speed(upper.velocity, acceleration, gap);
        if !(impact_speed > 0.0 && impact_speed.is_finite()) {
            let message =
                format!("\"{}\" falls at {impact_speed:?} m/s on what bears it", upper.name);
            let given = ["body.1.approach_speed", "start.gap"];
            let path = given.into_iter().find(|path| self.document.has(path)).unwrap_or("gravity");
            return Err(self.error(path, message).with_help(
                "give it an approach_speed, or drop it from a height: [start] gap = \"10 cm\"",
            ));
        }
        Ok(acceleration)
    }
}

fn place(index: usize) -> String {
    format!("body.{index}")
}
