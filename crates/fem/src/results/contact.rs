//! `contact.csv`: the contact at each snapshot.

use std::io::Write;

use fem_collision::Collision;

use super::shown::shown;
use crate::simulation::Simulation;

/// The name of the file.
pub const CONTACT_FILE: &str = "contact.csv";
/// How far from the axis rows go, over the contact radius.
const REACH: f64 = 1.2;

/// Whether there is a contact to be written: only of models with snapshots.
pub fn has_contact(collision: &Collision) -> bool {
    collision.snapshots.iter().any(|snapshot| !snapshot.contact.places.is_empty())
}

/// Writes the contact of each snapshot from the axis outward, a row a node of the coarser surface out to
/// 1.2 contact radii: pressure, gap (< 0 by what springs overlap) and radial displacement of both bodies.
/// Of surfaces that do not touch the axis is all.
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
    file.write_record(first.into_iter().chain(radial.iter().map(String::as_str)))?;
    for (snapshot, label) in shown(simulation, collision).snapshots {
        let contact = &snapshot.contact;
        let within = |radius: f64| radius == 0.0 || radius <= REACH * contact.radius;
        for place in contact.places.iter().filter(|place| within(place.radius)) {
            let numbers = (place.radius, place.pressure, place.gap, place.radial);
            file.serialize((snapshot.time, label, numbers))?;
        }
    }
    Ok(file.flush()?)
}
