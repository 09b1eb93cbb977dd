//! Two glass spheres collide, computed by three models: what comes out of each, and where the energy
//! is when the spheres are closest and when they have parted.
//!
//! `cargo run --release -p fem --example collide`

#![allow(clippy::disallowed_macros, reason = "an example prints what it found")]

use fem::schema::{ActsOn, BodyTable, MaterialTable, ModelTable, TermTable};
use fem::{Account, Case, CaseError, CaseFile, HistoryRow, Simulation};

fn main() -> Result<(), CaseError> {
    // The moduli are those that a sudden strain meets. They relax alike, G(t) = G0 exp(-t / 369 µs),
    // over a contact of some 60 µs.
    let glass = MaterialTable::from_youngs_modulus_poissons_ratio("2390 kg/m^3", "63 GPa", 0.244)
        .relaxing(ActsOn::All, [TermTable::with_decay_rate(1.0, "2708 1/s")]);
    let striker = BodyTable::sphere("striker", "22.2 mm", "glass").approaching("0.5 m/s");
    let target = BodyTable::sphere("target", "15.9 mm", "glass");
    let case = Case::of(CaseFile::of_bodies(striker, target).with_material("glass", glass))?;

    // Half-spaces; finite elements condensed to their contact, linear; explicit finite elements.
    for model in [ModelTable::ting(), ModelTable::condensed(), ModelTable::fem()] {
        let simulation = Simulation::new(case.edited(|file| file.model = Some(model))?)?;
        let collision = simulation.run(&mut ());
        println!("{}: {:?}", simulation.setup().description, collision.ending);
        // What a model does not know, or what has no value, is `None`.
        if let (Some(restitution), Some(time), Some(force)) =
            (collision.restitution, collision.contact_time, collision.peak_force)
        {
            println!(
                "  restitution {restitution:.4}, contact time {:.2} µs, peak force {force:.1} N",
                1e6 * time
            );
        }
        let history = &collision.history;
        let closest = history.iter().max_by(|a, b| a.approach.total_cmp(&b.approach));
        for row in closest.into_iter().chain(history.last()) {
            print_energies(row);
        }
        // What is doubtful in a result says so itself.
        simulation.warnings(&collision).iter().for_each(|warning| println!("  {warning}"));
    }
    Ok(())
}

/// The accounts that a model keeps: half-spaces know no energy of strain. `contact` is what springs
/// between the surfaces hold.
fn print_energies(row: &HistoryRow) {
    print!("  at {:5.2} µs, approach {:5.2} µm:", 1e6 * row.time, 1e6 * row.approach);
    for account in
        [Account::Kinetic, Account::Strain, Account::Contact, Account::ViscousDissipation]
    {
        if let Some(energy) = row.energy(account) {
            print!("  {} {:.4} mJ", account.name(), 1e3 * energy);
        }
    }
    println!();
}
