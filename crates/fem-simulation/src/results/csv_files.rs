//! The CSV files of a result: the history, the contact at each snapshot, the probes.

use std::io::{self, Write};

use fem_case::Scene;
use fem_collision::{
    Account, Collision, ContactProfile, HistoryRow, ProbeRequest, Snapshot, energy_key,
};

use super::dent::dents;
use super::energy::in_history;
use super::snapshots::shown;
use crate::simulation::Simulation;

/// The file name of the history.
pub const HISTORY_FILE: &str = "history.csv";

/// Writes the history, one row per instant. Accounts of effects come last. Numbers are the shortest that read back to the
/// same bits; unknown values are blank.
///
/// # Errors
/// `to` cannot be written to.
pub fn history_csv(mut to: impl Write, scene: &Scene, rows: &[HistoryRow]) -> io::Result<()> {
    let velocities = scene.bodies().each_ref().map(|body| format!("velocity_{}_m_s", body.name()));
    let ledgers = rows.iter().map(|row| &row.energies);
    let [energies, of_effects] = in_history(ledgers, Account::shown);
    let [keys, of_effects_keys] = [&energies, &of_effects]
        .map(|those| those.iter().map(|account| energy_key(*account)).collect::<Vec<_>>());
    let first =
        ["time_s", "contact_force_n", "contact_radius_m", "approach_m", "centre_pressure_pa"];
    let names = velocities.iter().chain(&keys).map(String::as_str);
    let last = of_effects_keys.iter().map(String::as_str);
    let header: Vec<&str> =
        first.into_iter().chain(names).chain(["residual_j"]).chain(last).collect();
    writeln!(to, "{}", header.join(","))?;
    let mut line = Line::default();
    for row in rows {
        line.number(row.time);
        line.number(row.contact_force);
        line.known(row.contact_radius);
        line.number(row.approach);
        line.known(row.centre_pressure);
        row.velocity.iter().for_each(|velocity| line.number(*velocity));
        energies.iter().for_each(|account| line.known(row.energy(*account)));
        line.known(row.residual);
        of_effects.iter().for_each(|account| line.known(row.energy(*account)));
        to.write_all(line.ended())?;
        line.text.clear();
    }
    to.flush()
}

/// A line of numbers, which need no quotes. A general CSV writer would take twice as long.
#[derive(Default)]
struct Line {
    /// The numbers, each with a comma after it.
    text: Vec<u8>,
}

impl Line {
    fn number(&mut self, number: f64) {
        self.text.extend_from_slice(ryu::Buffer::new().format(number).as_bytes());
        self.text.push(b',');
    }

    fn known(&mut self, number: Option<f64>) {
        match number {
            Some(number) => self.number(number),
            None => self.text.push(b','),
        }
    }

    fn ended(&mut self) -> &[u8] {
        if let Some(last) = self.text.last_mut() {
            *last = b'\n';
        }
        &self.text
    }
}

/// The file name of the contact at each snapshot.
pub const CONTACT_FILE: &str = "contact.csv";
/// Range of the rows from the axis, over the contact radius, and the least number of nodes beyond the
/// contact.
const CONTACT_ROWS_OVER_RADIUS: f64 = 1.2;
const NODES_BEYOND: usize = 3;

/// Returns whether the snapshots have a contact to be written.
pub fn has_contact(collision: &Collision) -> bool {
    collision.snapshots.iter().any(|snapshot| !snapshot.contact.places.is_empty())
}

/// Writes the contact of each snapshot from the axis outward: one row per node of the coarser surface out
/// to 1.2 contact radii, with at least three nodes beyond the contact, one row at the contact's edge, and
/// rows in between that make the pressure's integral equal the contact force. Columns: pressure, gap (< 0
/// where springs overlap), radial displacement of both bodies, slip of the surfaces (upper less lower), and
/// whether the row is a node. Without contact the nodes around the axis are written.
///
/// # Errors
/// `to` cannot be written to.
pub fn contact_csv(
    to: impl Write,
    simulation: &Simulation,
    collision: &Collision,
) -> csv::Result<()> {
    let mut file = csv::Writer::from_writer(to);
    let bodies = simulation.case().scene().bodies();
    let radial = bodies.each_ref().map(|body| format!("u_r_{}_m", body.name()));
    let first = ["time_s", "label", "r_m", "pressure_pa", "gap_m"];
    let names = first.into_iter().chain(radial.iter().map(String::as_str));
    file.write_record(names.chain(["slip_m", "is_node"]))?;
    for (snapshot, label) in shown(simulation, collision).snapshots {
        let contact = &snapshot.contact;
        for place in &contact.places[..n_shown(contact)] {
            let numbers = (place.radius, place.pressure, place.gap, place.radial);
            let slip = place.radial[1] - place.radial[0];
            file.serialize((snapshot.time, label, numbers, slip, u8::from(place.is_node)))?;
        }
    }
    Ok(file.flush()?)
}

/// Returns the number of written contact places.
fn n_shown(contact: &ContactProfile) -> usize {
    let near = contact
        .places
        .partition_point(|place| place.radius <= CONTACT_ROWS_OVER_RADIUS * contact.radius);
    let beyond = contact
        .places
        .iter()
        .enumerate()
        .filter(|(_, place)| place.is_node && place.radius > contact.radius);
    let last = beyond.take(NODES_BEYOND).last();
    near.max(last.map_or(0, |(k, _)| k + 1))
}

/// The file name of the profiles of dents.
pub const DENT_FILE: &str = "dent.csv";

/// Writes the profile of each dent from the axis outward, one row per node: distance from the axis after the collision, and y
/// of the surface there before and after it, measured from the mass centre; the pole was at 0.
///
/// # Errors
/// `to` cannot be written to.
pub fn dent_csv(to: impl Write, simulation: &Simulation, collision: &Collision) -> csv::Result<()> {
    let mut file = csv::Writer::from_writer(to);
    file.write_record(["body", "r_m", "y_before_m", "y_after_m"])?;
    for (_, dent, profile) in dents(simulation, collision) {
        for row in profile {
            file.serialize((&dent.body, row))?;
        }
    }
    Ok(file.flush()?)
}

/// The file name of the probes.
pub const PROBES_FILE: &str = "probes.csv";

/// Quantities of a probe with their units: displacement since the start of the case, velocity, Cauchy
/// stress (tension positive).
const PROBE_COLUMNS: [&str; 8] = [
    "u_r_m",
    "u_y_m",
    "v_r_m_s",
    "v_y_m_s",
    "sigma_rr_pa",
    "sigma_yy_pa",
    "sigma_tt_pa",
    "sigma_ry_pa",
];

/// Writes the probes, one row per instant and eight columns per probe. Numbers are the shortest that read
/// back to the same bits.
///
/// # Errors
/// `to` cannot be written to.
pub fn probes_csv(
    to: impl Write,
    probes: &[ProbeRequest],
    samples: &[Snapshot],
) -> csv::Result<()> {
    let mut file = csv::Writer::from_writer(to);
    let columns = (0..probes.len())
        .flat_map(|k| PROBE_COLUMNS.map(|quantity| format!("probe_{k}_{quantity}")));
    file.write_record(["time_s".to_string()].into_iter().chain(columns))?;
    for sample in samples {
        let displacements = [0, 1].map(|side| sample.displacement(side));
        let of_probe = |(k, probe): (usize, &ProbeRequest)| {
            let fields = &sample.bodies[probe.side];
            let ([u_r, u_y], [v_r, v_y]) = (displacements[probe.side][k], fields.velocity[k]);
            let [rr, yy, tt, ry] = fields.stress[k];
            [u_r, u_y, v_r, v_y, rr, yy, tt, ry]
        };
        let numbers: Vec<f64> = probes.iter().enumerate().flat_map(of_probe).collect();
        file.serialize((sample.time, numbers))?;
    }
    Ok(file.flush()?)
}
