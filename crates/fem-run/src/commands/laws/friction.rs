//! The coefficient of friction from measured rebounds: the part of `fit` and `invert` for oblique impacts.

use fem::laws::{FrictionFit, PatchMotion};
use fem::measured::{Incidence, Kind, Measured, Rebound, ReboundQuantity, Rebounds, Table};
use fem::measured::{NotMeasured, parse_measured};
use fem_case::Case;
use fem_case::engineering::number;

use super::fit_text::relative;
use crate::text::failure::Failure;
use crate::text::{hanging, headed};

/// Key of the coefficient of friction in `--free`.
pub const FRICTION: &str = "friction";

/// A measured rebound in options.
#[derive(clap::Args, Debug)]
pub struct ReboundArguments {
    /// Angle of the velocity of the rebounding ball against the axis, '12 ± 0.5 deg': finds the coefficient of friction
    #[arg(long, value_name = "ANGLE", allow_hyphen_values = true, value_parser = angle)]
    rebound_angle: Option<Measured>,
    /// Angle of the velocity of its contact patch against the axis, negative if it goes back
    #[arg(long, value_name = "ANGLE", allow_hyphen_values = true, value_parser = angle)]
    contact_patch_rebound: Option<Measured>,
    /// Angular velocity of the rebounding ball, '600 rad/s' or '900 rpm'
    #[arg(long, value_name = "SPIN", allow_hyphen_values = true, value_parser = spin)]
    spin_after: Option<Measured>,
    /// Tangential velocity of the rebounding ball
    #[arg(long, value_name = "VELOCITY", allow_hyphen_values = true, value_parser = velocity)]
    tangential_velocity_after: Option<Measured>,
    /// Angle of the velocity before against the axis [default: that of the case]
    #[arg(long, value_name = "ANGLE", value_parser = angle)]
    impact_angle: Option<Measured>,
}

fn angle(text: &str) -> Result<Measured, NotMeasured> {
    parse_measured(Kind::Angle, text)
}

fn spin(text: &str) -> Result<Measured, NotMeasured> {
    parse_measured(Kind::Rate, text)
}

fn velocity(text: &str) -> Result<Measured, NotMeasured> {
    parse_measured(Kind::Speed, text)
}

impl ReboundArguments {
    /// Returns the rebound that the options give, if they give one, with a measured restitution.
    pub fn rebound(
        &self,
        case: &Case,
        speed: Option<f64>,
        restitution: Option<Measured>,
    ) -> Result<Option<Rebounds>, Failure> {
        let given = [
            (ReboundQuantity::ReboundAngle, self.rebound_angle),
            (ReboundQuantity::ContactPatchRebound, self.contact_patch_rebound),
            (ReboundQuantity::SpinAfter, self.spin_after),
            (ReboundQuantity::TangentialVelocityAfter, self.tangential_velocity_after),
        ];
        let mut given = given.into_iter().filter_map(|(quantity, it)| Some((quantity, it?)));
        let Some((quantity, after)) = given.next() else { return Ok(None) };
        if let Some((other, _)) = given.next() {
            let names = [quantity, other].map(|it| it.name().replace('_', "-"));
            let message = format!("--{} and --{} are given", names[0], names[1]);
            let help = "give one of them, or a table of several to fem-run fit";
            return Err(Failure::bad_input(message).with_help(help));
        }
        let scene = case.scene();
        let ball = scene.ball();
        let own = scene.bodies()[ball].tangential_velocity()
            - scene.bodies()[1 - ball].tangential_velocity();
        let before =
            self.impact_angle.map_or(Incidence::Velocity(own), |it| Incidence::Angle(it.value));
        let restitution = restitution.map(|it| it.value);
        Ok(Some(Rebounds {
            name: format!("--{}", quantity.name().replace('_', "-")),
            quantity,
            points: vec![Rebound { speed, before, after, restitution }],
            lines: Vec::new(),
            warnings: Vec::new(),
        }))
    }
}

/// Returns whether a fit to a table finds the coefficient of friction: `--free friction` asks for it, or the table has rebounds over
/// an angle and no option asks for a law.
pub fn is_asked(free: &[String], table: &Table, is_of_law: bool) -> Result<bool, Failure> {
    if let [key] = free
        && key == FRICTION
    {
        return Ok(true);
    }
    if free.iter().any(|key| key == FRICTION) {
        let message = "--free: nothing is fitted beside friction";
        return Err(Failure::bad_input(message).with_help(
            "write --free friction; a second parameter of the contact, such as Dundurs' β, changes rebounds less than their errors",
        ));
    }
    Ok(free.is_empty() && !is_of_law && Rebounds::are_in(table))
}

/// Returns the text of a fit.
pub fn text(fit: &FrictionFit<'_>) -> String {
    let quantity = fit.data.quantity;
    let (unit, scale) = quantity.unit();
    let value = match (fit.at_least, fit.standard_error()) {
        (Some(least), _) => format!("≥ {}", number(least, 3)),
        (None, Some(error)) => format!("{} ± {}", number(fit.friction, 4), number(error, 2)),
        (None, None) => format!("{} ± ?", number(fit.friction, 4)),
    };
    let n = fit.rows.len();
    let name = quantity.name().replace('_', " ");
    let of = if n == 1 { name.clone() } else { format!("{n} values of {name}") };
    let rms = format!("{} {unit}", number(scale * fit.rms, 3));
    let mut text = format!("{FRICTION} = {value} ({of}, rms misfit {})\n\n", rms.trim_end());
    let motions = [PatchMotion::Slides, PatchMotion::SlidesAndSticks, PatchMotion::Sticks];
    let rows = motions.into_iter().filter_map(|motion| {
        let (n, share) = fit.of_motion(motion);
        let share = format!("{} %", number(100.0 * share, 3));
        (n > 0).then(|| [motion.words().to_string(), n.to_string(), share])
    });
    text += &headed("contact patch|>rows|>share in the result", rows);
    let mut parts: Vec<String> = Vec::new();
    parts.extend(fit.by_data.map(|it| format!("{} by the data", number(it, 2))));
    parts.extend(fit.by_model.map(|it| format!("{} by the model", number(it, 2))));
    parts.extend(
        fit.inputs.iter().map(|part| {
            format!("{} by {}", number(part.changes[0].abs(), 2), relative(&part.input))
        }),
    );
    if fit.at_least.is_none() && !parts.is_empty() {
        text += &hanging(&format!("\nstandard error: {}\n", parts.join(", ")));
    }
    text
}
