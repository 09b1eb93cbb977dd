//! A program that uses the crate `fem` alone, which has every name that it needs.

use fem::results::{CostSummary, Energy, energy_key};
use fem::schema::{ActsOn, BodyTable, MaterialTable, ModelTable, SnapshotLabel, TermTable};
use fem::{
    Account, Approach, ApproachError, BalanceSide, Body, BodyFields, BodyResult, BodyStress, Case,
    CaseError, CaseFile, Collision, Cost, Ending, EnergyLedger, ErrorEstimate, HertzImpact,
    HistoryRow, Material, ModelChoice, ModelSetup, Monitor, OutputRequest, Phase, Progress,
    Quantity, Scene, Shape, ShownIn, Simulation, Snapshot, SnapshotInstant, SnapshotRequest,
    SphereMesh, Stop, StressField, Summary, invariants, stop_advice,
};

/// A monitor that records the phases of a run and ends it after a number of reports.
struct Panel {
    phases: Vec<Phase>,
    reports_left: u64,
}

impl Monitor for Panel {
    fn enter(&mut self, phase: Phase) {
        self.phases.push(phase);
    }

    fn report(&mut self, progress: Progress) -> bool {
        assert!(progress.contact_force >= 0.0 && progress.fraction <= 1.0);
        self.reports_left = self.reports_left.saturating_sub(1);
        self.reports_left > 0
    }
}

fn scene_of(model: ModelTable) -> Result<Case, CaseError> {
    let rubber = MaterialTable::from_youngs_modulus_poissons_ratio("1100 kg/m^3", "10 MPa", 0.45)
        .relaxing(ActsOn::Shear, [TermTable::with_decay_rate(0.5, "100 1/s")]);
    let ball = BodyTable::sphere("ball", "2 cm", "rubber").approaching("10 cm/s");
    let mut file = CaseFile::of_bodies(BodyTable::wall("floor"), ball)
        .with_material("rubber", rubber)
        .with_model(model);
    file.output.get_or_insert_default().snapshots =
        Some(fem::schema::SnapshotsValue::labels([SnapshotLabel::Maximum]));
    // Coarse: what comes out is looked at, not measured.
    file.mesh.get_or_insert_default().contact_element_size = Some(Quantity::from_si(4e-4));
    Case::of(file)
}

#[test]
fn a_case_is_built_run_and_read() -> Result<(), CaseError> {
    let case = scene_of(ModelTable::condensed())?;
    let scene: &Scene = case.scene();
    let ball: &Body = &scene.bodies()[1];
    assert!(matches!(ball.shape(), Shape::Sphere { mesh: None, .. }));
    let material: Option<&Material> = ball.material();
    assert!(material.is_some() && matches!(scene.model(), ModelChoice::Condensed(_)));

    let simulation = Simulation::new(case)?;
    let setup: &ModelSetup = simulation.setup();
    assert!(matches!(setup.cost, Cost::Factors { .. }));
    let hertz: &HertzImpact = &setup.estimate.hertz;
    assert!(hertz.contact_time() > 0.0 && setup.approach.speed() == 0.1);
    let request = OutputRequest {
        snapshots: SnapshotRequest::Labels(vec![SnapshotInstant::Maximum]),
        ..OutputRequest::history()
    };
    assert_eq!(simulation.request().snapshots, request.snapshots);
    let simulation = simulation.with_output_request(request).unwrap();

    let mut panel = Panel { phases: Vec::new(), reports_left: u64::MAX };
    let collision: Collision = simulation.run(&mut panel);
    assert_eq!(panel.phases.first(), Some(&Phase::Collision));
    assert_eq!(collision.ending, Ending::Parted);

    // Bodies and energy ledgers.
    let [floor, ball]: &[BodyResult; 2] = &collision.bodies;
    assert!(floor.mass.is_none() && ball.velocity_after.is_some_and(|speed| speed > 0.0));
    let book: &EnergyLedger = &collision.energies;
    let row: &HistoryRow = collision.history.last().unwrap();
    assert!(book.has(Account::Kinetic) && row.energies.total(BalanceSide::Lost) > Some(0.0));
    // Accounts of effects that are off are absent.
    assert!(
        Account::all().all(|account| account.shown() != ShownIn::WhereFilled || !book.has(account))
    );

    // Fields and stress.
    let snapshot: &Snapshot = collision.snapshot(SnapshotInstant::Maximum).unwrap();
    let fields: &BodyFields = &snapshot.bodies[1];
    let BodyStress { mesh, field } = simulation.stress(snapshot, 1).unwrap();
    let (mesh, field): (&SphereMesh, StressField) = (mesh, field);
    assert_eq!(fields.displacement.len(), mesh.nodes().len());
    let pressures = field.points.iter().map(|stress| invariants(*stress).0);
    assert!(pressures.fold(0.0, f64::max) > 0.0);

    // The summary.
    let errors: ErrorEstimate = simulation.estimate_errors(&collision);
    let summary: Summary = Summary::of(
        &simulation,
        &collision,
        &errors,
        CostSummary::default(),
        Vec::new(),
        Vec::new(),
    );
    let energy: &Energy = &summary.energy;
    assert_eq!(energy.get(Account::Kinetic), book.get(Account::Kinetic));
    assert_eq!(energy_key(Account::Kinetic), "kinetic_j");
    Ok(())
}

#[test]
fn a_run_is_stopped_and_continued_elsewhere() -> Result<(), CaseError> {
    let simulation = Simulation::new(scene_of(ModelTable::fem())?)?;
    let mut panel = Panel { phases: Vec::new(), reports_left: 2 };
    let stopped = simulation.run(&mut panel);
    let stop: &Stop = stopped.stop().unwrap();
    assert!(stopped.is_interrupted() && stop_advice(stop).is_none());

    let refused: ApproachError = Approach::at(-1.0).unwrap_err();
    assert!(refused.to_string().contains("-1"));
    let simulation = Simulation::new(scene_of(ModelTable::ting())?)?;
    let faster = Approach::at(0.2).unwrap();
    let collision = simulation.model().collide(&faster, &OutputRequest::quantities(), &mut ());
    assert_eq!(collision.approach.speed(), 0.2);
    Ok(())
}

/// This file uses no other crate of the workspace.
#[test]
fn no_other_crate_of_the_workspace_is_used() {
    let own = include_str!("public_interface.rs");
    let other = ["fem", "_"].concat();
    assert!(own.lines().all(|line| !line.contains(&other)), "a name of a crate below");
}
