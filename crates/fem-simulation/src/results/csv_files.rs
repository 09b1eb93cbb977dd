//! The CSV files of a result: the history, the contact at each snapshot, the probes.

use std::io::{self, Write};

use fem_case::Scene;
use fem_collision::{
    Account, Collision, ContactProfile, HistoryRow, ProbeRequest, Snapshot, TangentialRow,
    energy_key,
};

use super::dent::dents;
use super::energy::in_history;
use super::snapshots::shown;
use crate::plan::REFINED_OVER_CONTACT;
use crate::simulation::Simulation;

/// The file name of the history.
pub const HISTORY_FILE: &str = "history.csv";

/// The columns of a history, each with its name and one number for each instant; a value that is not known is NaN.
pub type HistoryColumns = Vec<(String, Vec<f64>)>;

/// Returns the history by columns. Accounts of effects come last.
pub fn history_columns(scene: &Scene, rows: &[HistoryRow]) -> HistoryColumns {
    let [energies, of_effects] = in_history(rows.iter().map(|row| &row.energies), Account::shown);
    let column = |name: &str, value: &dyn Fn(&HistoryRow) -> Option<f64>| {
        (name.to_string(), rows.iter().map(|row| value(row).unwrap_or(f64::NAN)).collect())
    };
    let of_account = |account: &Account| column(&energy_key(*account), &|row| row.energy(*account));
    let of_body = |side: usize| {
        let name = format!("velocity_{}_m_s", scene.bodies()[side].name());
        column(&name, &|row| Some(row.velocity[side]))
    };
    let mut columns = vec![
        column("time_s", &|row| Some(row.time)),
        column("contact_force_n", &|row| Some(row.contact_force)),
        column("contact_radius_m", &|row| row.contact_radius),
        column("approach_m", &|row| Some(row.approach)),
        column("centre_pressure_pa", &|row| row.centre_pressure),
    ];
    columns.extend([0, 1].map(of_body));
    columns.extend(energies.iter().map(of_account));
    columns.push(column("residual_j", &|row| row.residual));
    columns.extend(of_effects.iter().map(of_account));
    if rows.iter().any(|row| row.tangential.is_some()) {
        let across = |name: &str, value: fn(&TangentialRow) -> Option<f64>| {
            column(name, &|row| value(row.tangential.as_ref()?))
        };
        columns.extend([
            across("tangential_force_n", |row| Some(row.force)),
            across("patch_velocity_m_s", |row| Some(row.patch_velocity)),
            across("stick_radius_over_contact_radius", |row| row.stick_ratio),
        ]);
        columns.extend([Account::Friction, Account::TangentialRelaxation].iter().map(of_account));
    }
    columns
}

/// Writes a history, one row per instant. Numbers are the shortest that read back to the same bits; unknown values are blank. A
/// general CSV writer would take twice as long.
///
/// # Errors
/// `to` cannot be written to.
pub fn history_csv(mut to: impl Write, columns: &HistoryColumns) -> io::Result<()> {
    let names: Vec<&str> = columns.iter().map(|(name, _)| name.as_str()).collect();
    writeln!(to, "{}", names.join(","))?;
    let mut line = Vec::new();
    for row in 0..columns.first().map_or(0, |(_, first)| first.len()) {
        line.clear();
        for number in columns.iter().map(|(_, numbers)| numbers[row]) {
            if !number.is_nan() {
                line.extend_from_slice(ryu::Buffer::new().format(number).as_bytes());
            }
            line.push(b',');
        }
        line.pop();
        line.push(b'\n');
        to.write_all(&line)?;
    }
    to.flush()
}

/// The file name of the contact at each snapshot.
pub const CONTACT_FILE: &str = "contact.csv";
/// Least number of nodes beyond the contact.
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
        .partition_point(|place| place.radius <= REFINED_OVER_CONTACT * contact.radius);
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
