//! The stress in a body, beside the closed form.

use fem::schema::{BodyTable, MaterialTable, MeshTable, ModelTable};
use fem::{Case, CaseFile, Simulation, Snapshot, SnapshotInstant};

/// A steel ball strikes a wall.
fn case(model: ModelTable) -> Case {
    let steel = MaterialTable::from_youngs_modulus_poissons_ratio(7850.0, 210e9, 0.3);
    let ball = BodyTable::sphere("ball", 20e-3, "steel").approaching(0.1);
    let mut file = CaseFile::of_bodies(ball, BodyTable::wall("wall"))
        .with_material("steel", steel)
        .with_model(model);
    file.mesh = Some(MeshTable { contact_element_size: Some(10e-6.into()), ..Default::default() });
    Case::of(file).unwrap()
}

/// Johnson, Contact Mechanics (1985), eqs 3.40 and 3.45, for a Poisson's ratio of 0.3: σ_yy is
/// −p0 / (1 + z²/a²), and the largest shear is 0.310 p0 at 0.48 a. Some 14 elements span the
/// contact radius, which is 1 % of the sphere's: within 1 % of p0 below the first elements, where
/// the recovery has one side only.
#[test]
fn the_stress_on_the_axis_is_that_of_hertz() {
    let simulation = Simulation::new(case(ModelTable::condensed())).unwrap();
    let collision = simulation.run(&mut ());
    let hertz = &simulation.setup().estimate.hertz;
    let (radius, pressure) = (hertz.max_contact_radius(), hertz.peak_pressure());
    let snapshot = collision.snapshot(SnapshotInstant::Maximum).unwrap();
    let ball = simulation.stress(snapshot, 0).unwrap();
    let on_axis: Vec<_> = ball.on_axis().collect();
    assert_eq!(on_axis.len(), ball.mesh.axis().len());
    assert_eq!(on_axis[0].0, 0.0);
    assert!(on_axis.windows(2).all(|two| two[0].0 < two[1].0));
    for (depth, [_, yy, _, ry]) in on_axis.iter().skip(2).take_while(|(z, _)| *z < 2.0 * radius) {
        let expected = -pressure / (1.0 + (depth / radius).powi(2));
        assert!((yy - expected).abs() < 0.01 * pressure, "{depth:e} {yy:e} {expected:e}");
        assert_eq!(*ry, 0.0);
    }
    let shear = |stress: &[f64; 4]| 0.5 * (stress[0] - stress[1]);
    let by_shear = |a: &&(f64, _), b: &&(f64, _)| shear(&a.1).total_cmp(&shear(&b.1));
    let (depth, hardest) = on_axis.iter().max_by(by_shear).unwrap();
    assert!((shear(hardest) / pressure - 0.310).abs() < 0.005, "{}", shear(hardest) / pressure);
    assert!((depth / radius - 0.48).abs() < 0.05, "{}", depth / radius);
}

#[test]
fn walls_models_without_elements_and_fields_of_other_meshes_have_none() {
    let condensed = Simulation::new(case(ModelTable::condensed())).unwrap();
    for side in [0, 1, 2] {
        assert!(condensed.stress(&Snapshot::default(), side).is_none(), "{side}");
    }
    let ting = Simulation::new(case(ModelTable::ting())).unwrap();
    assert!(ting.stress(&Snapshot::default(), 0).is_none());
}
