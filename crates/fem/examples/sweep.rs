//! The restitution of a rubber ball over its speed, by half-spaces and by finite elements.
//!
//! `cargo run --release -p fem --example sweep`

#![allow(clippy::disallowed_macros, reason = "an example prints what it found")]

use fem::schema::{ActsOn, BodyTable, MaterialTable, MeshTable, ModelTable, TermTable};
use fem::{Case, CaseError, CaseFile, sweep};

fn main() -> Result<(), CaseError> {
    // Bulk and shear modulus; half of the shear modulus relaxes in 1 ms.
    let rubber = MaterialTable::from_bulk_shear("1100 kg/m^3", "50 MPa", "5 MPa")
        .relaxing(ActsOn::Shear, [TermTable::with_relaxation_time(0.5, "1 ms")]);
    let ball = BodyTable::sphere("ball", "20 mm", "rubber").approaching("0.1 m/s");
    let mut file =
        CaseFile::of_bodies(ball, BodyTable::wall("floor")).with_material("rubber", rubber);
    // One mesh for all speeds, so that they share their factors: fine enough for the slowest, and as
    // far as the contact of the fastest.
    file.mesh = Some(MeshTable {
        contact_element_size: Some("60 um".into()),
        refined_radius: Some("1 mm".into()),
        ..Default::default()
    });
    let case = Case::of(file)?;

    let speeds = [0.01, 0.02, 0.04, 0.08, 0.16];
    let models = [ModelTable::ting(), ModelTable::condensed()];
    // Every speed with every model, the models running fastest; all cores are used.
    let values: Vec<_> =
        speeds.into_iter().flat_map(|speed| models.clone().map(|model| (speed, model))).collect();
    let summaries = sweep(&case, values, |file, (speed, model)| {
        file.body[0].approach_speed = Some(speed.into());
        file.model = Some(model);
    });

    // In the order of the values, whichever is done first.
    let summaries: Vec<_> = summaries.into_iter().collect::<Result<_, _>>()?;
    println!("speed [m/s]    ting  condensed");
    for (speed, pair) in speeds.into_iter().zip(summaries.chunks(models.len())) {
        let restitution = |k: usize| pair[k].collision.restitution.unwrap_or(f64::NAN);
        println!("{speed:11.2}  {:.4}     {:.4}", restitution(0), restitution(1));
        // What is doubtful in a result says so itself.
        pair.iter().flat_map(|summary| &summary.warnings).for_each(|warning| println!("{warning}"));
    }
    Ok(())
}
