//! The stress below the contact of two elastic spheres when they are closest, next to Hertz: pressed
//! hardest at the surface, sheared hardest in some depth.
//!
//! `cargo run --release -p fem --example stress`

#![allow(clippy::disallowed_macros, reason = "an example prints what it found")]

use fem::schema::{BodyTable, MaterialTable, MeshTable, ModelTable};
use fem::{Case, CaseError, CaseFile, Simulation, SnapshotInstant};

fn main() -> Result<(), CaseError> {
    let steel = MaterialTable::from_youngs_modulus_poissons_ratio("7850 kg/m^3", "210 GPa", 0.3);
    let ball = |name: &str| BodyTable::sphere(name, "20 mm", "steel");
    let mut file = CaseFile::of_bodies(ball("lower").approaching("0.1 m/s"), ball("upper"))
        .with_material("steel", steel)
        .with_model(ModelTable::condensed());
    // Some 16 elements across the contact radius; the refined block goes by the contact expected.
    file.mesh = Some(MeshTable { contact_element_size: Some("7 um".into()), ..Default::default() });

    let simulation = Simulation::new(Case::of(file)?)?;
    let collision = simulation.run(&mut ());
    let hertz = &simulation.setup().estimate.hertz;
    let (radius, pressure) = (hertz.max_contact_radius(), hertz.peak_pressure());
    println!(
        "Hertz: contact radius {:.1} µm, peak pressure {:.1} MPa",
        1e6 * radius,
        1e-6 * pressure
    );

    // A case asks for this instant unless it names others.
    let snapshot = collision.snapshot(SnapshotInstant::Maximum).expect("the fields at the maximum");
    let lower = simulation.stress(snapshot, 0).expect("a body with elements");
    println!("   depth / radius  compression / peak pressure  shear / peak pressure");
    let mut hardest = (0.0, 0.0);
    for (depth, [rr, yy, _, _]) in lower.on_axis() {
        // On the axis the stresses are principal: the largest shear is half of their difference.
        let shear = 0.5 * (rr - yy).abs();
        if shear > hardest.1 {
            hardest = (depth, shear);
        }
        if depth < 1.2 * radius {
            println!("{:17.3}  {:27.3}  {:21.3}", depth / radius, -yy / pressure, shear / pressure);
        }
    }
    let (depth, shear) = hardest;
    // 0.310 of the peak pressure at 0.48 of the radius: Johnson, Contact Mechanics (1985), eq. 3.45,
    // for a Poisson's ratio of 0.3.
    println!(
        "sheared hardest at {:.2} of the contact radius, by {:.3} of the peak pressure",
        depth / radius,
        shear / pressure
    );
    Ok(())
}
