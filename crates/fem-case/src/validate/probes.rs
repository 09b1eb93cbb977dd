//! The places that probes tell of.

use super::{ANY, Check, NOT_NEGATIVE};
use crate::error::CaseError;
use crate::scene::Probe;
use crate::scene::body::{Body, Shape};
use crate::schema::ProbeTable;
use crate::source::explain::near;
use crate::source::key_path::join;

/// The most probes: each keeps some thousand instants.
const MOST_PROBES: usize = 100;
/// What a radius may be short of by the rounding of units, as a share of it.
const ROUNDING: f64 = 1e-9;

impl Check<'_> {
    pub(super) fn probes(
        &self,
        tables: &[ProbeTable],
        bodies: &[Body; 2],
    ) -> Result<Vec<Probe>, CaseError> {
        if tables.len() > MOST_PROBES {
            let message = format!("the case has {} probes", tables.len());
            return Err(self
                .error(&format!("output.probe.{MOST_PROBES}"), message)
                .with_help(format!("at most {MOST_PROBES} are allowed")));
        }
        tables.iter().enumerate().map(|(k, table)| self.probe(k, table, bodies)).collect()
    }

    fn probe(&self, k: usize, table: &ProbeTable, bodies: &[Body; 2]) -> Result<Probe, CaseError> {
        let path = format!("output.probe.{k}");
        let (of_r, of_y) = (join(&path, "r"), join(&path, "y"));
        let r = self.number(&of_r, &table.r, NOT_NEGATIVE)?;
        let y = self.number(&of_y, &table.y, ANY)?;
        let names = bodies.each_ref().map(Body::name);
        let Some(side) = names.iter().position(|name| *name == table.body) else {
            let message = format!("there is no body \"{}\"", table.body);
            let help =
                format!("{}the bodies are {}", near(&table.body, &names), names.join(" and "));
            return Err(self.error(&join(&path, "body"), message).with_help(help));
        };
        let depth = if side == 0 { -y } else { y };
        let name = names[side];
        let radius = match bodies[side].shape() {
            Shape::Wall | Shape::Rigid { .. } => {
                let message = format!("\"{name}\" is rigid: nothing happens in it");
                let help = "a probe is in a body that has a material";
                return Err(self.error(&join(&path, "body"), message).with_help(help));
            }
            Shape::HalfSpace { .. } => f64::INFINITY,
            Shape::Sphere { diameter, .. } => 0.5 * diameter,
        };
        if depth < 0.0 {
            let side = if side == 0 { "lower body, y <= 0" } else { "upper body, y >= 0" };
            let message = format!("y is {}, outside of \"{name}\"", table.y);
            return Err(self.error(&of_y, message).with_help(format!("\"{name}\" is the {side}")));
        }
        if radius.is_finite() && r.hypot(depth - radius) > radius * (1.0 + ROUNDING) {
            let message = format!("({}, {}) is outside of \"{name}\"", table.r, table.y);
            let help = format!("\"{name}\" has a radius of {radius} m and touches y = 0 at r = 0");
            return Err(self.conflict(&of_r, &[&of_y], message).with_help(help));
        }
        Ok(Probe { body: side, r, y })
    }
}
