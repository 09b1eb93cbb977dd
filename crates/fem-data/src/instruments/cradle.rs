//! Newton's cradle: velocities and restitution from the angles before and after the impact.
//!
//! Two balls hang from threads of the length l (pivot to the ball's centre, the same for both); the
//! first is released at the angle α, the second was at rest and rises to β.
//!
//! ```math
//! u = 2\sqrt{gl}\,\sin\tfrac\alpha2, \quad v_2 = 2\sqrt{gl}\,\sin\tfrac\beta2, \quad
//! v_1 = u - \frac{m_2}{m_1}v_2, \quad
//! e = \frac{v_2-v_1}{u} = \Bigl(1+\frac{m_2}{m_1}\Bigr)\frac{\sin(\beta/2)}{\sin(\alpha/2)} - 1
//! ```
//!
//! Bordbar & Hyppänen (2007), eqs. 1–6: energy ½mu² = mgl(1 − cos α) of each swing, momentum of
//! the collision. Uncertainties of the inputs are taken as independent and small and propagate in
//! first order (JCGM 100, eq. 10). l and g cancel in e. Limits: light, inextensible threads, no
//! drag, small balls (r² ≪ l²: a solid ball on one thread swings slower by r²/(5l²)), no spin.

use std::f64::consts::FRAC_PI_2;

use crate::estimate::FitError;
use crate::table::{DataError, Table};
pub use crate::table::{Measured, impossible_restitution};
pub use fem_material::engineering::STANDARD_GRAVITY;

/// Dimensions of the apparatus.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Cradle {
    /// Acceleration of gravity g, m/s².
    pub gravity: Measured,
    /// Length l from the pivot to the centre of a ball, m.
    pub length: Measured,
    /// Masses m₁ and m₂, in any unit.
    pub masses: [Measured; 2],
}

/// One release and the rise that follows.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Trial {
    /// Angle of release α, 0 < α ≤ π/2.
    pub release: Measured,
    /// Angle of rise β of the second ball, 0 ≤ β ≤ π/2.
    pub rise: Measured,
}

/// Velocities along the motion of the first ball, and the restitution.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Swing {
    /// Velocity u of the first ball before, m/s.
    pub before: Measured,
    /// Velocity v₁ of the first ball after, m/s.
    pub first_after: Measured,
    /// Velocity v₂ of the second ball after, m/s.
    pub second_after: Measured,
    /// The restitution e.
    pub restitution: Measured,
    /// Shares of α, β, m₁ and m₂ in the variance of e; 0 without a variance.
    pub shares: [f64; 4],
}

/// Returns the masses of solid balls by their diameters as d³; their common density cancels.
pub fn masses_of_balls(diameters: [Measured; 2]) -> [Measured; 2] {
    diameters.map(|Measured { value, uncertainty }| Measured {
        value: value.powi(3),
        uncertainty: 3.0 * value * value * uncertainty,
    })
}

impl Cradle {
    /// Returns the result of one trial.
    ///
    /// # Errors
    /// A value is out of range.
    pub fn swing(&self, trial: &Trial) -> Result<Swing, FitError> {
        self.check(trial)?;
        let (g, l) = (self.gravity, self.length);
        let [m1, m2] = self.masses;
        let (alpha, beta) = (trial.release, trial.rise);
        let fastest = 2.0 * (g.value * l.value).sqrt();
        let (a, b) = ((0.5 * alpha.value).sin(), (0.5 * beta.value).sin());
        let (da, db) = (0.5 * (0.5 * alpha.value).cos(), 0.5 * (0.5 * beta.value).cos());
        let ratio = m2.value / m1.value;
        let (u, v2) = (fastest * a, fastest * b);
        let v1 = u - ratio * v2;
        let e = (1.0 + ratio) * b / a - 1.0;
        // Slopes are in the order g, l, α, β, m₁, m₂.
        let inputs = [g, l, alpha, beta, m1, m2];
        let scale = |value: f64| [0.5 * value / g.value, 0.5 * value / l.value];
        let [u_g, u_l] = scale(u);
        let [v2_g, v2_l] = scale(v2);
        let [v1_g, v1_l] = scale(v1);
        let (v1_m1, v1_m2) = (ratio * v2 / m1.value, -v2 / m1.value);
        let (e_m1, e_m2) = (-ratio / m1.value * b / a, b / (a * m1.value));
        let (e_alpha, e_beta) = (-(1.0 + e) * da / a, (1.0 + ratio) * db / a);
        let measured = |value: f64, slopes: [f64; 6]| Measured {
            value,
            uncertainty: variances(&slopes, &inputs).iter().sum::<f64>().sqrt(),
        };
        let of_e = [0.0, 0.0, e_alpha, e_beta, e_m1, e_m2];
        let parts = variances(&of_e, &inputs);
        let whole: f64 = parts.iter().sum();
        let share = |part: f64| if whole > 0.0 { part / whole } else { 0.0 };
        Ok(Swing {
            before: measured(u, [u_g, u_l, fastest * da, 0.0, 0.0, 0.0]),
            second_after: measured(v2, [v2_g, v2_l, 0.0, fastest * db, 0.0, 0.0]),
            first_after: measured(
                v1,
                [v1_g, v1_l, fastest * da, -ratio * fastest * db, v1_m1, v1_m2],
            ),
            restitution: measured(e, of_e),
            shares: [share(parts[2]), share(parts[3]), share(parts[4]), share(parts[5])],
        })
    }

    /// Returns the largest β that the energy allows, that of e = 1; `None` if it allows every β up to a right angle.
    pub fn highest_rise(&self, release: f64) -> Option<f64> {
        let ratio = self.masses[1].value / self.masses[0].value;
        let sine = 2.0 / (1.0 + ratio) * (0.5 * release).sin();
        (sine <= (0.5 * FRAC_PI_2).sin()).then(|| 2.0 * sine.asin())
    }

    /// Returns the reason why energy or momentum forbid a swing.
    pub fn doubt(&self, trial: &Trial, swing: &Swing) -> Option<String> {
        let e = swing.restitution;
        let impossible = impossible_restitution(e)?;
        if e.value < 0.0 {
            return Some(format!("{impossible}: v2 is less than v1"));
        }
        let highest = self.highest_rise(trial.release.value);
        let highest = highest.map_or(String::new(), |highest| {
            format!(": without loss the second ball rises to {:.2} deg", highest.to_degrees())
        });
        Some(format!("{impossible}{highest}"))
    }

    fn check(&self, trial: &Trial) -> Result<(), FitError> {
        let positive = [
            ("gravity", self.gravity),
            ("length", self.length),
            ("mass of the first ball", self.masses[0]),
            ("mass of the second ball", self.masses[1]),
        ];
        for (quantity, Measured { value, .. }) in positive {
            if !(value > 0.0 && value.is_finite()) {
                let allowed = "positive and finite";
                return Err(FitError::OutOfRange { quantity, value, allowed });
            }
        }
        let angles = [("release angle", trial.release, 1e-6), ("rise angle", trial.rise, 0.0)];
        for (quantity, Measured { value, .. }, least) in angles {
            if !(value >= least && value <= FRAC_PI_2) {
                let allowed = if least > 0.0 {
                    "greater than 0 and at most a right angle (1.5708 rad), where threads go slack"
                } else {
                    "from 0 to a right angle (1.5708 rad), where threads go slack"
                };
                return Err(FitError::OutOfRange { quantity, value, allowed });
            }
        }
        let [m1, m2] = self.masses;
        for input in [self.gravity, self.length, m1, m2, trial.release, trial.rise] {
            let uncertainty = input.uncertainty;
            if !(uncertainty >= 0.0 && uncertainty.is_finite()) {
                let (quantity, allowed) = ("uncertainty", "at least 0 and finite");
                return Err(FitError::OutOfRange { quantity, value: uncertainty, allowed });
            }
        }
        Ok(())
    }
}

/// Returns (∂f/∂x σ)² of each input.
fn variances(slopes: &[f64; 6], inputs: &[Measured; 6]) -> [f64; 6] {
    std::array::from_fn(|i| (slopes[i] * inputs[i].uncertainty).powi(2))
}

/// Returns the trials of a table, one per row. Its columns are `alpha_deg` and `beta_deg` (or `_rad`) and optionally
/// `alpha_uncertainty_deg` and `beta_uncertainty_deg`.
///
/// # Errors
/// The table has an error, or a column does not name its unit.
///
/// ```
/// use fem_data::instruments::cradle_trials;
/// use fem_data::table::Table;
///
/// let table = Table::parse("trials.csv", "alpha_deg,beta_deg\n90,60\n")?;
/// let trials = cradle_trials(&table)?;
/// assert_eq!(trials[0].release.value, std::f64::consts::FRAC_PI_2);
///
/// let table = Table::parse("trials.csv", "alpha,beta\n90,60\n")?;
/// let error = cradle_trials(&table).unwrap_err();
/// assert_eq!(error.to_string(), "trials.csv:1: the column alpha does not name its unit");
/// # Ok::<(), fem_data::table::DataError>(())
/// ```
pub fn cradle_trials(table: &Table) -> Result<Vec<Trial>, DataError> {
    let alpha = table.require("alpha", "alpha_deg")?;
    let beta = table.require("beta", "beta_deg")?;
    let of_alpha = table.find("alpha_uncertainty")?;
    let of_beta = table.find("beta_uncertainty")?;
    let trial = |row: usize| {
        Ok(Trial {
            release: angle(table, row, alpha, of_alpha)?,
            rise: angle(table, row, beta, of_beta)?,
        })
    };
    (0..table.n_rows()).map(trial).collect()
}

/// Reads an angle; its column must name the unit, since a bare number may be in degrees or in radians.
fn angle(
    table: &Table,
    row: usize,
    column: usize,
    uncertainty: Option<usize>,
) -> Result<Measured, DataError> {
    let name = &table.header()[column];
    if !name.ends_with("_deg") && !name.ends_with("rad") {
        let error = table.header_fault(format!("the column {name} does not name its unit"));
        return Err(error.in_column(name).with_help(format!("call it {name}_deg or {name}_rad")));
    }
    let uncertainty = uncertainty.map(|column| table.number(row, column, [0; 3]));
    Ok(Measured {
        uncertainty: uncertainty.transpose()?.unwrap_or(0.0),
        value: table.number(row, column, [0; 3])?,
    })
}
