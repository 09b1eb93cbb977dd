//! The sweep engine of the library: members from a file and from code, their order, observers and results.

use serde_json::json;
use std::sync::Mutex;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};

use fem::ComputedCollision;
use fem::schema::{
    ActsOn, BodyTable, CondensedTable, LimitsTable, MaterialTable, MeshTable, ModelTable, TermTable,
};
use fem::sweep::{
    COLUMNS, Columns, Member, Members, Observer, Row, Runner, Variations, check, column_unit,
    column_words, load, most_expensive_first, sweep_csv,
};
use fem::{Account, Case, CaseError, CaseFile, Monitor, Progress, SharedModels, Simulation, sweep};

const SPEEDS: [f64; 3] = [0.3, 0.1, 0.2];

/// Returns a pair of glass spheres with a coarse mesh.
fn pair(model: ModelTable) -> Case {
    let glass = MaterialTable::from_youngs_modulus_poissons_ratio(2390.0, 63e9, 0.244)
        .relaxing(ActsOn::All, [TermTable::with_decay_rate(1.0, 2708.0)]);
    let striker = BodyTable::sphere("striker", 22.2e-3, "glass").approaching(0.5);
    let mut file = CaseFile::of_bodies(striker, BodyTable::sphere("target", 15.9e-3, "glass"))
        .with_material("glass", glass)
        .with_model(model);
    file.mesh = Some(MeshTable {
        contact_element_size: Some(0.2e-3.into()),
        refined_radius: Some(0.4e-3.into()),
        ..Default::default()
    });
    Case::of(file).unwrap()
}

fn set_speed(file: &mut CaseFile, speed: f64) {
    file.body[0].approach_speed = Some(speed.into());
}

fn pool(n_threads: usize) -> rayon::ThreadPool {
    rayon::ThreadPoolBuilder::new().num_threads(n_threads).build().unwrap()
}

#[test]
fn summaries_are_in_order_and_equal_those_of_single_runs() {
    let case = pair(ModelTable::condensed());
    let alone = SPEEDS.map(|speed| {
        let case = case.edited(|file| set_speed(file, speed)).unwrap();
        let simulation = Simulation::new(case).unwrap().without_snapshots();
        let collision = simulation.run(&mut ());
        serde_json::to_value(simulation.summary(&collision)).unwrap()
    });
    for n_threads in [1, 3] {
        let summaries = pool(n_threads).install(|| sweep(&case, SPEEDS, set_speed));
        let summaries = summaries.into_iter().map(|summary| serde_json::to_value(summary.unwrap()));
        let summaries: Vec<_> = summaries.map(Result::unwrap).collect();
        assert_eq!(summaries, alone);
    }
}

#[test]
fn invalid_sweep_value_gives_one_error() {
    let summaries = sweep(&pair(ModelTable::ting()), [0.1, -1.0, 0.2], set_speed);
    let errors: Vec<Option<&str>> =
        summaries.iter().map(|summary| summary.as_ref().err().and_then(CaseError::key)).collect();
    assert_eq!(errors, [None, Some("body.0.approach_speed"), None]);
    // A value that the model rejects gives one error too.
    let summaries = sweep(&pair(ModelTable::fem()), [1e6, 10.0], |file, elements| {
        file.limits = Some(LimitsTable { elements: Some(elements.into()), ..Default::default() });
    });
    assert!(summaries[0].is_ok());
    assert_eq!(summaries[1].as_ref().unwrap_err().key(), Some("mesh.contact_element_size"));
}

/// A sweep file and code make the same members and results.
#[test]
fn members_of_a_file_are_those_of_code() {
    let case = pair(ModelTable::condensed());
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("case.toml"), case.file().to_toml().unwrap()).unwrap();
    let path = folder.path().join("sweep.toml");
    let vary = "case = 'case.toml'\n[vary]\nbody.0.approach_speed = ['30 cm/s', 0.1, 0.2]\n";
    std::fs::write(&path, vary).unwrap();
    let file = load(&path, &[]).unwrap();
    let code = Variations::of(&case, SPEEDS, set_speed);
    let cases = SPEEDS.map(|speed| case.edited(|file| set_speed(file, speed)).unwrap());

    fn identities(members: &(impl Members + ?Sized)) -> Vec<String> {
        let checked = check(members, |_| false, |_| false, |_, _| ()).unwrap();
        assert!(checked.left.is_empty(), "none is this process's own");
        checked.members.iter().map(Member::identity).collect()
    }
    let expected = identities(&code);
    assert_eq!(identities(&file), expected);
    assert_eq!(identities(&cases[..]), expected);
    assert_ne!(expected[0], expected[1]);

    fn histories(members: &(impl Members + ?Sized)) -> Vec<Vec<fem::HistoryRow>> {
        let shared = SharedModels::default();
        let runner = Runner::new(members, &shared).without_fields();
        let kept = runner.run(&[0, 1, 2], &(), |ran| ran.collision.history);
        assert_eq!(shared.pairs.n_made(), 1, "equal bodies share their factors");
        kept.into_iter().map(|(_, history)| history.unwrap()).collect()
    }
    let expected = histories(&code);
    assert!(expected.iter().all(|history| history.len() > 100));
    assert_eq!(histories(&file), expected);
    assert_eq!(histories(&cases[..]), expected);
}

#[test]
fn the_identity_of_a_member_depends_on_its_values() {
    let case = pair(ModelTable::condensed());
    let identity = |case: &Case| Member::of(0, case).unwrap().identity();
    let edited = |change: fn(&mut CaseFile)| identity(&case.edited(change).unwrap());
    let own = identity(&case);
    assert_eq!(own.len(), 16);
    // A sweep may keep a million members.
    assert_eq!(size_of::<Member>(), 16);
    // Another spelling and a default value have the same identity.
    assert_eq!(edited(|file| file.body[0].approach_speed = Some("50 cm/s".into())), own);
    let default = |file: &mut CaseFile| {
        let table = CondensedTable { steps: Some(250.into()), ..Default::default() };
        file.model = Some(table.into());
    };
    assert_eq!(edited(default), own);
    assert_ne!(edited(|file| file.body[0].approach_speed = Some(0.6.into())), own);
    assert_ne!(edited(|file| file.model = Some(ModelTable::ting())), own);
}

#[test]
fn the_most_expensive_run_is_first_and_each_runs_once() {
    let case = pair(ModelTable::fem());
    let ting = ModelTable::ting;
    // Finer meshes are more expensive; the cheap members keep their order.
    let values = [(1.0, ting()), (2.0, ModelTable::fem()), (1.0, ModelTable::fem()), (1.0, ting())];
    let members = Variations::of(&case, values, |file, (factor, model)| {
        let mesh = file.mesh.as_mut().unwrap();
        mesh.contact_element_size = Some((factor * 0.2e-3).into());
        file.model = Some(model);
    });
    assert_eq!(most_expensive_first(&members), [2, 1, 0, 3]);
    let mut seen = Vec::new();
    let mut see = |member: &Member, _: &CaseFile| seen.push(*member);
    let all = check(&members, |_| true, |_| false, &mut see).unwrap();
    assert_eq!(all.members, seen, "seen in order");
    assert_eq!(seen.iter().map(|member| member.index).collect::<Vec<_>>(), [0, 1, 2, 3]);
    assert_eq!(seen[0].identity(), seen[3].identity());
    assert_eq!(all.left, [2, 1, 0]);
    let rest = check(&members, |_| true, |member| member.index == 2, |_, _| ()).unwrap();
    assert_eq!(rest.left, [1, 0]);
    // A shard has half of the members.
    let half = check(&members, |index| index % 2 == 1, |_| false, |_, _| ()).unwrap();
    assert_eq!((half.members.len(), half.left), (4, vec![1, 3]));
}

/// The first fault in the order of the sweep is reported, however many members are checked at once.
#[test]
fn the_first_fault_of_many_members_is_reported() {
    let case = pair(ModelTable::ting());
    let speeds = (0..300).map(|k| if k == 70 || k == 200 { -f64::from(k) } else { 0.1 });
    let members = Variations::of(&case, speeds, set_speed);
    for is_own in [true, false] {
        let error = check(&members, |_| is_own, |_| false, |_, _| ()).unwrap_err();
        assert!(error.message().contains("-70"), "{}", error.message());
    }
}

#[test]
fn condensed_members_with_different_meshes_get_advice() {
    let condensed = pair(ModelTable::condensed());
    let open = condensed.edited(|file| file.mesh = None).unwrap();
    for (case, is_advised) in [(&condensed, false), (&open, true)] {
        let members = Variations::of(case, SPEEDS, set_speed);
        let checked = check(&members, |_| true, |_| false, |_, _| ()).unwrap();
        assert_eq!(checked.advice.is_some(), is_advised);
        // Finished members get no advice.
        let done = check(&members, |_| true, |_| true, |_, _| ()).unwrap();
        assert_eq!(done.advice, None);
    }
}

/// Records when members begin, report and end, and stops them after some reports.
#[derive(Default)]
struct Recorder {
    seen: Mutex<Vec<(usize, &'static str)>>,
    n_reports: AtomicUsize,
    most_reports: usize,
    is_stopped: AtomicBool,
}

struct Watch<'a> {
    recorder: &'a Recorder,
    index: usize,
}

impl Recorder {
    fn see(&self, index: usize, what: &'static str) {
        self.seen.lock().unwrap().push((index, what));
    }
}

impl Monitor for Watch<'_> {
    fn report(&mut self, _: Progress) -> bool {
        if self.recorder.n_reports.fetch_add(1, Ordering::Relaxed) >= self.recorder.most_reports {
            self.recorder.is_stopped.store(true, Ordering::Relaxed);
        }
        !self.recorder.is_stopped.load(Ordering::Relaxed)
    }
}

impl<'a> Observer for &'a Recorder {
    type Watch = Watch<'a>;

    fn admits(&self, index: usize) -> bool {
        let is_stopped = self.is_stopped.load(Ordering::Relaxed);
        if is_stopped {
            self.see(index, "left out");
        }
        !is_stopped
    }

    fn begin(&self, index: usize) -> Watch<'a> {
        self.see(index, "began");
        Watch { recorder: self, index }
    }

    fn end(&self, index: usize, watch: Watch<'a>, ran: Result<&ComputedCollision, &CaseError>) {
        assert_eq!(watch.index, index);
        self.see(
            index,
            match ran {
                Ok(ran) if ran.collision.is_interrupted() => "interrupted",
                Ok(_) => "done",
                Err(_) => "refused",
            },
        );
    }
}

#[test]
fn an_observer_sees_all_members_and_can_stop_them() {
    let case = pair(ModelTable::fem());
    let members = Variations::of(&case, [0.2, -1.0, 0.3, 0.4], set_speed);
    let shared = SharedModels::default();
    let run = |most_reports: usize| {
        let recorder = Recorder { most_reports, ..Recorder::default() };
        let runner = Runner::new(&members, &shared).without_fields();
        let run = || runner.run(&[3, 1, 0, 2], &&recorder, |ran| ran.collision.is_complete());
        let kept: Vec<_> =
            pool(1).install(run).into_iter().map(|(index, kept)| (index, kept.ok())).collect();
        (kept, recorder.seen.into_inner().unwrap(), recorder.n_reports.into_inner())
    };
    let (kept, seen, n_reports) = run(usize::MAX);
    assert_eq!(kept, [(0, Some(true)), (1, None), (2, Some(true)), (3, Some(true))]);
    let began_and = |index, end| [(index, "began"), (index, end)];
    let all = [(3, "done"), (1, "refused"), (0, "done"), (2, "done")];
    assert_eq!(seen, all.map(|(index, end)| began_and(index, end)).as_flattened());
    assert!(n_reports > 3);

    // The sweep is stopped after the first report of the first member.
    let (kept, seen, _) = run(0);
    assert_eq!(kept, [(3, Some(false))]);
    let first = began_and(3, "interrupted");
    assert_eq!(seen[..2], first);
    assert_eq!(seen[2..], [(1, "left out"), (0, "left out"), (2, "left out")]);
}

#[test]
fn rows_are_summaries() {
    let case = pair(ModelTable::condensed());
    let members = Variations::of(&case, SPEEDS, set_speed);
    let shared = SharedModels::default();
    let runner = Runner::new(&members, &shared);
    let member = Member::of(1, &members.case(1).unwrap()).unwrap();
    let ran = runner.run_one(1, &mut ()).unwrap();
    assert_eq!(ran.collision.snapshots.len(), 4, "fields are left out only on request");
    let summary = ran.summary();
    let row = Row::of(&member, [members.values()[1]], &summary);
    assert!(row.is_complete());
    assert_eq!(row.value("restitution").as_f64(), summary.collision.restitution);
    assert_eq!(row.value("hertz_peak_force_n").as_f64(), summary.hertz.peak_force_n);
    assert_eq!(row.value("energy_kinetic_j").as_f64(), summary.energy.get(Account::Kinetic));
    let n_elements: usize = summary.bodies.iter().filter_map(|body| body.elements).sum();
    assert_eq!(row.value("elements").as_u64(), Some(n_elements as u64));
    assert_eq!(row.value("warnings").as_u64(), Some(summary.warnings.len() as u64));
    assert!(row.value("element_updates").is_null());

    let mut shown = Columns::default();
    shown.see(&serde_json::to_value(&summary).unwrap());
    let shown = shown.names();
    let mut table = Vec::new();
    sweep_csv(&mut table, ["speed"], &shown, [row]).unwrap();
    let mut reader = csv::Reader::from_reader(table.as_slice());
    let header: Vec<String> = reader.headers().unwrap().iter().map(str::to_string).collect();
    assert_eq!(header[0], "speed");
    assert!(shown.len() < COLUMNS.len(), "no active effect has its own energy account");
    assert_eq!(header[1..=shown.len()], *shown);
    assert_eq!(header[shown.len() + 1..], ["member"]);
    let record = reader.records().next().unwrap().unwrap();
    assert_eq!(record[0], *"0.1");
    assert_eq!(record[1].parse().ok(), summary.collision.restitution);
    assert_eq!(record[record.len() - 1], member.identity());
}

#[test]
fn columns_have_words_and_units() {
    assert_eq!(
        (column_words("contact_time_s"), column_unit("contact_time_s")),
        ("contact time".into(), "s")
    );
    assert_eq!(column_unit("peak_pressure_pa"), "Pa");
    assert_eq!(
        (column_words("restitution"), column_unit("restitution")),
        ("restitution".into(), "")
    );
    assert_eq!(column_words("psi_after"), "velocity of the patch after ψ₂");
    assert_eq!(column_unit("contact_patch_rebound_deg"), "°");
    // An energy that no row has gets no column.
    let mut columns = Columns::default();
    let has_own = |columns: &Columns| columns.names().contains(&"energy_bulk_viscosity_j");
    columns.see(&json!({ "energy": { "kinetic_j": 1.0 } }));
    assert!(!has_own(&columns) && columns.names().contains(&"energy_kinetic_j"));
    columns.see(&json!({ "energy": { "bulk_viscosity_j": 0.5 } }));
    assert!(has_own(&columns));
}
