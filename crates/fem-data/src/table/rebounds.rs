//! Reads rebounds from oblique impacts: angles, spins or tangential velocities over the impact angle or the tangential velocity before.

use std::f64::consts::TAU;

use super::column_roles::{RESTITUTIONS, SPEEDS, ending_of, is_key, uncertainty_of};
use super::csv_table::Table;
use super::data_error::DataError;
use super::quantity::Measured;
use super::restitutions::MAX_RESTITUTION;
use super::sweep_table::COLUMNS;

const NUMBER: [i32; 3] = [0; 3];
const SPEED: [i32; 3] = [1, 0, -1];
const RATE: [i32; 3] = [0, 0, -1];

/// Names of columns of the angle of the velocity before against the axis; a sweep's own names come last.
const IMPACT_ANGLES: &str = "impact_angle incident_angle incidence_angle angle_of_incidence angle_of_impact angle_before body.0.impact_angle_si body.1.impact_angle_si";
/// Names of columns of the tangential velocity before.
const TANGENTIAL_BEFORE: &str = "tangential_velocity_before tangential_velocity tangential_speed_before tangential_speed v_t vt";
/// Names of columns of the whole speed before, along and across the axis.
const RESULTANT_SPEEDS: &str = "resultant_speed resultant_velocity total_speed";
/// Names of rolling resistance, which no collision has.
const ROLLING: &str = "rolling_friction rolling_resistance rolling_friction_coefficient";

/// Preferred names of columns of rebounds.
pub(super) const REBOUNDS: &str = "impact_angle tangential_velocity_before resultant_speed rebound_angle \
    contact_patch_rebound spin_after tangential_velocity_after tangential_restitution impulse_ratio";

/// What is measured of a rebound.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ReboundQuantity {
    /// Angle of the velocity of the ball against the axis, rad; negative if it goes back.
    ReboundAngle,
    /// The same of the velocity of its contact patch.
    ContactPatchRebound,
    /// Angular velocity after, rad/s.
    SpinAfter,
    /// Tangential velocity after, m/s.
    TangentialVelocityAfter,
    /// Velocity of the contact patch after over before.
    TangentialRestitution,
    /// Tangential over normal impulse.
    ImpulseRatio,
}

impl ReboundQuantity {
    /// All quantities; of several in a table the first one is read.
    pub const ALL: [Self; 6] = [
        Self::ReboundAngle,
        Self::ContactPatchRebound,
        Self::SpinAfter,
        Self::TangentialVelocityAfter,
        Self::TangentialRestitution,
        Self::ImpulseRatio,
    ];

    /// Returns the names of its columns, the preferred one first.
    pub fn names(self) -> &'static str {
        match self {
            Self::ReboundAngle => "rebound_angle angle_of_rebound reflection_angle angle_after",
            Self::ContactPatchRebound => {
                "contact_patch_rebound contact_patch_rebound_angle patch_rebound_angle"
            }
            Self::SpinAfter => "spin_after angular_velocity_after spin angular_velocity",
            Self::TangentialVelocityAfter => {
                "tangential_velocity_after tangential_speed_after v_t_after"
            }
            Self::TangentialRestitution => "tangential_restitution e_t et",
            Self::ImpulseRatio => "impulse_ratio",
        }
    }

    /// Returns its preferred name.
    pub fn name(self) -> &'static str {
        let names = self.names();
        names.split(' ').next().unwrap_or(names)
    }

    /// Returns its unit in texts, and the factor from SI to it.
    pub fn unit(self) -> (&'static str, f64) {
        match self {
            Self::ReboundAngle | Self::ContactPatchRebound => ("deg", 1f64.to_degrees()),
            Self::SpinAfter => ("rad/s", 1.0),
            Self::TangentialVelocityAfter => ("m/s", 1.0),
            Self::TangentialRestitution | Self::ImpulseRatio => ("", 1.0),
        }
    }

    fn dimension(self) -> [i32; 3] {
        match self {
            Self::SpinAfter => RATE,
            Self::TangentialVelocityAfter => SPEED,
            _ => NUMBER,
        }
    }
}

/// The ball before an impact.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Incidence {
    /// Angle of its velocity against the axis, rad.
    Angle(f64),
    /// Tangential velocity, m/s.
    Velocity(f64),
}

/// A measured rebound.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Rebound {
    /// Approach speed along the axis, m/s; `None` for that of the case.
    pub speed: Option<f64>,
    /// Tangential velocity before, or the angle.
    pub before: Incidence,
    /// The measured quantity, SI, with its standard uncertainty, 0 if there is none.
    pub after: Measured,
    /// Measured restitution along the axis.
    pub restitution: Option<f64>,
}

/// Measured rebounds, each with its place in the data.
#[derive(Clone, Debug, PartialEq)]
pub struct Rebounds {
    /// Name of the data.
    pub name: String,
    /// The measured quantity.
    pub quantity: ReboundQuantity,
    /// The rebounds, in the order of the data.
    pub points: Vec<Rebound>,
    /// Line of each in the text; empty for one from an option.
    pub lines: Vec<u64>,
    /// Sentences about rows and columns that are not used.
    pub warnings: Vec<String>,
}

impl Rebounds {
    /// Returns whether a table has rebounds over an impact angle or a tangential velocity.
    pub fn are_in(table: &Table) -> bool {
        let has = |names: &str| !matches!(table.find(names), Ok(None));
        let is_oblique = has(IMPACT_ANGLES) || has(TANGENTIAL_BEFORE);
        is_oblique && (has(ROLLING) || ReboundQuantity::ALL.iter().any(|it| has(it.names())))
    }

    /// Reads a table with columns like `impact_angle_deg` and `rebound_angle_deg`, and optionally `speed_m_s`, `restitution` and
    /// `rebound_angle_uncertainty_deg`.
    ///
    /// # Errors
    /// The table has an error; the first one is returned.
    ///
    /// ```
    /// use fem_data::table::{Incidence, Rebounds, Table};
    ///
    /// let table = Table::parse("a.csv", "impact_angle_deg,spin_after_rpm\n30,60\n")?;
    /// let rebounds = Rebounds::read(&table)?;
    /// assert_eq!(rebounds.points[0].before, Incidence::Angle(30f64.to_radians()));
    /// assert!((rebounds.points[0].after.value - std::f64::consts::TAU).abs() < 1e-12);
    /// # Ok::<(), fem_data::table::DataError>(())
    /// ```
    pub fn read(table: &Table) -> Result<Self, DataError> {
        if let Some(column) = table.find(ROLLING)? {
            let message =
                "rolling resistance is not found: a collision is over before a ball has rolled";
            return Err(table.header_fault(message).in_column(&table.header()[column]));
        }
        let columns = Columns::of(table)?;
        let (mut points, mut lines) = (Vec::new(), Vec::new());
        for row in (0..table.n_rows()).filter(|row| columns.has_result(table, *row)) {
            points.push(columns.rebound(table, row)?);
            lines.push(table.line(row));
        }
        if points.is_empty() {
            let message = format!("no row has a {}", columns.quantity.name());
            return Err(DataError::new(table.name(), message));
        }
        let mut warnings = table.left_out().to_vec();
        let n_left_out = table.n_rows() - points.len();
        if n_left_out > 0 {
            warnings.push(format!("{n_left_out} rows without a value left out"));
        }
        let n_weighed = points.iter().filter(|point| point.after.uncertainty > 0.0).count();
        if n_weighed > 0 && n_weighed < points.len() {
            points.iter_mut().for_each(|point| point.after.uncertainty = 0.0);
            warnings.push(format!(
                "only {n_weighed} of {} rows have an uncertainty: none is used; give all rows one",
                points.len()
            ));
        }
        warnings.extend(columns.unused(table)?);
        let (name, quantity) = (table.name().to_string(), columns.quantity);
        Ok(Self { name, quantity, points, lines, warnings })
    }
}

/// The columns that are read.
struct Columns {
    quantity: ReboundQuantity,
    after: usize,
    uncertainty: Option<usize>,
    angle: Option<usize>,
    velocity: Option<usize>,
    speed: Option<usize>,
    resultant: Option<usize>,
    restitution: Option<usize>,
    complete: Option<usize>,
}

impl Columns {
    fn of(table: &Table) -> Result<Self, DataError> {
        let mut found = None;
        for quantity in ReboundQuantity::ALL {
            let column = table.find(quantity.names())?;
            found = found.or(column.map(|column| (quantity, column)));
        }
        let (quantity, after) = match found {
            Some(found) => found,
            None => {
                let quantity = ReboundQuantity::ReboundAngle;
                (quantity, table.require(quantity.names(), "rebound_angle_deg")?)
            }
        };
        let (angle, velocity) = (table.find(IMPACT_ANGLES)?, table.find(TANGENTIAL_BEFORE)?);
        let (speed, resultant) = (table.find(SPEEDS)?, table.find(RESULTANT_SPEEDS)?);
        if angle.is_none() && velocity.is_none() {
            table.require(IMPACT_ANGLES, "impact_angle_deg")?;
        }
        let twice = [angle.zip(velocity), speed.zip(resultant)];
        if let Some((one, other)) = twice.into_iter().flatten().next() {
            let names = [one, other].map(|column| &table.header()[column]);
            let message = format!("{} and {} say the same twice", names[0], names[1]);
            return Err(table.header_fault(message).with_help("remove one of the two columns"));
        }
        let uncertainty = table.position(&uncertainty_of(&table.header()[after]));
        let (restitution, complete) = (table.find(RESTITUTIONS)?, table.find("complete")?);
        Ok(Self {
            quantity,
            after,
            uncertainty,
            angle,
            velocity,
            speed,
            resultant,
            restitution,
            complete,
        })
    }

    fn has_result(&self, table: &Table, row: usize) -> bool {
        let is_complete = self.complete.is_none_or(|column| table.text(row, column) != "false");
        let mut needed = [self.angle, self.velocity].into_iter().flatten().chain([self.after]);
        is_complete && needed.all(|column| !table.is_missing(row, column))
    }

    fn rebound(&self, table: &Table, row: usize) -> Result<Rebound, DataError> {
        let number = |column: usize, dimension| table.number(row, column, dimension);
        let optional = |column: Option<usize>, dimension| {
            let column = column.filter(|column| !table.is_missing(row, *column));
            column.map(|column| number(column, dimension)).transpose()
        };
        let before = match self.angle {
            Some(column) => Incidence::Angle(self.angle(table, row, column)?),
            None => Incidence::Velocity(optional(self.velocity, SPEED)?.unwrap_or_default()),
        };
        let along = match (optional(self.resultant, SPEED)?, before) {
            (None, _) => optional(self.speed, SPEED)?,
            (Some(whole), Incidence::Angle(angle)) => Some(whole * angle.cos()),
            (Some(whole), Incidence::Velocity(across)) => {
                Some((whole * whole - across * across).max(0.0).sqrt())
            }
        };
        if let Some(speed) = along.filter(|speed| *speed <= 0.0) {
            let message = format!("the approach speed is {speed} m/s");
            return Err(table.fault(row, message).with_help("it must be greater than 0"));
        }
        let restitution = optional(self.restitution, NUMBER)?;
        if let Some(e) = restitution.filter(|e| !(*e > 0.0 && *e <= MAX_RESTITUTION)) {
            let message = format!("the restitution is {e}");
            return Err(table
                .fault(row, message)
                .with_help("it must be from 0 to 1, along the axis"));
        }
        let uncertainty = match self.uncertainty {
            Some(column) => self.scaled(table, row, column)?,
            None => 0.0,
        };
        if uncertainty < 0.0 {
            return Err(table.fault(row, "the uncertainty is negative"));
        }
        let value = match self.quantity {
            ReboundQuantity::ReboundAngle | ReboundQuantity::ContactPatchRebound => {
                self.angle(table, row, self.after)?
            }
            _ => self.scaled(table, row, self.after)?,
        };
        Ok(Rebound { speed: along, before, after: Measured { value, uncertainty }, restitution })
    }

    /// Returns an angle, rad, which is less than a quarter turn.
    fn angle(&self, table: &Table, row: usize, column: usize) -> Result<f64, DataError> {
        let angle = table.number(row, column, NUMBER)?;
        if angle.abs() >= 0.25 * TAU {
            let help = "an angle is against the axis, less than 90 degrees; name the column with its unit, impact_angle_deg";
            return Err(table.cell_fault(row, column, angle, help));
        }
        Ok(angle)
    }

    /// Returns a cell of the measured quantity; rates in columns with a unit are in cycles per second.
    fn scaled(&self, table: &Table, row: usize, column: usize) -> Result<f64, DataError> {
        if table.is_missing(row, column) {
            return Ok(0.0);
        }
        let value = table.number(row, column, self.quantity.dimension())?;
        let is_cycles = self.quantity == ReboundQuantity::SpinAfter
            && ending_of(&table.header()[column]).is_some();
        Ok(if is_cycles { TAU * value } else { value })
    }

    /// Returns sentences about columns that are not read.
    fn unused(&self, table: &Table) -> Result<Vec<String>, DataError> {
        let read = [
            Some(self.after),
            self.uncertainty,
            self.angle,
            self.velocity,
            self.speed,
            self.resultant,
            self.restitution,
            self.complete,
        ];
        let read: Vec<usize> = read.into_iter().flatten().collect();
        let names = ReboundQuantity::ALL.map(ReboundQuantity::name);
        let unread = table.unread(&read, &names, |name| {
            is_key(name) || COLUMNS.iter().any(|known| known == name)
        })?;
        let list = unread.join(", ");
        Ok((!unread.is_empty())
            .then(|| format!("columns that are not read: {list}"))
            .into_iter()
            .collect())
    }
}
