//! `history.csv`.

use std::io::{self, Write};

use fem_case::Scene;
use fem_collision::{Account, HistoryRow};

use super::energy::{energy_key, in_history};

/// The name of the file.
pub const HISTORY_FILE: &str = "history.csv";

/// Writes a history, a row an instant; accounts of effects that are on come last. Numbers are the
/// shortest that read back as the same, what the model does not know is blank.
///
/// # Errors
/// `to` cannot be written to.
pub fn history_csv(mut to: impl Write, scene: &Scene, rows: &[HistoryRow]) -> io::Result<()> {
    let velocities = scene.bodies().each_ref().map(|body| format!("velocity_{}_m_s", body.name()));
    let books = rows.iter().map(|row| &row.energies);
    let [energies, of_effects] = in_history(books, Account::shown);
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

/// A line of numbers, which need no quotes: what writes any text takes as long for it as for the digits.
#[derive(Default)]
struct Line {
    /// A comma after each.
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
