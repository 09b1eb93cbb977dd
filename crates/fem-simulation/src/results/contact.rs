//! `contact.csv`: the contact at each snapshot.

use std::io::Write;

use fem_collision::{Collision, ContactProfile};

use super::shown::shown;
use crate::simulation::Simulation;

/// The name of the file.
pub const CONTACT_FILE: &str = "contact.csv";
/// How far from the axis rows go, over the contact radius, and how many nodes beyond it at least.
const REACH: f64 = 1.2;
const NODES_BEYOND: usize = 3;

/// Whether there is a contact to be written: only of models with snapshots.
pub fn has_contact(collision: &Collision) -> bool {
    collision.snapshots.iter().any(|snapshot| !snapshot.contact.places.is_empty())
}

/// Writes the contact of each snapshot from the axis outward: a row a node of the coarser surface out to 1.2
/// contact radii and three nodes beyond the contact at least, a row where the contact ends, and rows between that
/// make the pressure's integral the contact force. Pressure, gap (< 0 by what springs overlap), radial displacement
/// of both bodies, slip of the surfaces on each other (upper less lower), and whether the row is a node's.
/// Of surfaces that do not touch the nodes around the axis are all.
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

/// How many places of a contact have a row.
fn n_shown(contact: &ContactProfile) -> usize {
    let near = contact.places.partition_point(|place| place.radius <= REACH * contact.radius);
    let beyond = contact
        .places
        .iter()
        .enumerate()
        .filter(|(_, place)| place.is_node && place.radius > contact.radius);
    let last = beyond.take(NODES_BEYOND).last();
    near.max(last.map_or(0, |(k, _)| k + 1))
}
