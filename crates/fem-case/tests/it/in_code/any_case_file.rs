//! Case files with random values.

use std::path::Path;

use fem_case::schema::*;
use fem_case::{Case, CaseError, CaseFile, Quantity, QuantityKind};

use super::pair::parsed;
use super::shipped::{exactly, paths};

/// Knuth's MMIX generator: the same cases on every machine.
struct Random(u64);

impl Random {
    fn below(&mut self, n: usize) -> usize {
        self.0 = self.0.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
        (self.0 >> 33) as usize % n
    }

    fn maybe<T>(&mut self, make: impl FnOnce(&mut Self) -> T) -> Option<T> {
        (self.below(3) == 0).then(|| make(self))
    }

    /// Returns one of these values, or rarely any value.
    fn quantity<K: QuantityKind>(&mut self, usual: &[f64]) -> Quantity<K> {
        const NUMBERS: [f64; 9] =
            [0.0, -0.0, 1.0, -1.0, 1e-320, 1e308, f64::NAN, f64::INFINITY, 9.1e15];
        const TEXTS: [&str; 8] =
            ["", "1", "-1 mm", "3 furlong", "nan", "maximum", "1 us", "\u{1b}[31m \u{0}\n\"'"];
        match self.below(20) {
            0 => NUMBERS[self.below(NUMBERS.len())].into(),
            1 => TEXTS[self.below(TEXTS.len())].into(),
            _ => usual[self.below(usual.len())].into(),
        }
    }

    fn name(&mut self, usual: &[&str]) -> String {
        const NAMES: [&str; 5] = ["", "a b", "x.y", "\u{7}\"", "größe"];
        match self.below(20) {
            0 => NAMES[self.below(NAMES.len())].to_string(),
            _ => usual[self.below(usual.len())].to_string(),
        }
    }

    /// Returns a sphere, a wall or a half-space, rarely two of them or none.
    fn body(&mut self, name: &str) -> BodyTable {
        let is_sphere = self.below(5) > 0;
        let is_sound = self.below(20) > 0;
        let is_block = self.below(2) > 0;
        let is_plate = self.below(2) > 0;
        BodyTable {
            name: self.name(&[name]),
            material: ((is_sphere || is_block) == is_sound).then(|| self.name(&["glass"])),
            approach_speed: (name != "b").then(|| self.quantity(&[0.5, 0.5, 0.5, -0.1])),
            held: (self.below(20) == 0).then(|| self.below(2) == 0),
            sphere: is_sphere.then(|| SphereTable {
                diameter: self.quantity(&[0.02]),
                mesh: self.maybe(|random| random.name(&["ball.vtu"])),
            }),
            wall: (is_sphere != is_sound && !is_block).then_some(EmptyTable {}),
            half_space: (!is_sphere && is_block && !is_plate).then_some(EmptyTable {}),
            plate: (!is_sphere && is_block && is_plate).then(|| PlateTable {
                thickness: self.quantity(&[5e-3]),
                diameter: self.maybe(|random| random.quantity(&[0.2])),
                support: self.maybe(|random| match random.below(2) {
                    0 => PlateSupport::Free,
                    _ => PlateSupport::Bonded,
                }),
            }),
        }
    }

    fn material(&mut self) -> MaterialTable {
        let mut material = MaterialTable::from_youngs_modulus_poissons_ratio(
            self.quantity(&[2390.0]),
            self.quantity(&[63e9]),
            self.quantity(&[0.244]),
        );
        if self.below(20) == 0 {
            material.bulk_modulus = Some(self.quantity(&[1e9]));
        }
        if self.below(20) == 0 {
            material.youngs_modulus = None;
        }
        material.yield_strength = self.maybe(|random| random.quantity(&[1e9]));
        material.surface_energy = self.maybe(|random| random.quantity(&[0.05]));
        material.hyperelastic = self.maybe(|random| {
            let words = HyperelasticLaw::WORDS;
            HyperelasticLaw::from_word(words[random.below(words.len())]).unwrap()
        });
        material.flow = self.maybe(|random| FlowTable {
            yield_strength: random.maybe(|random| random.quantity(&[1e9])),
            hardening: random.maybe(|random| {
                let none = HardeningTable::default();
                match random.below(4) {
                    0 => HardeningTable { perfect: Some(EmptyTable {}), ..none },
                    1 => HardeningTable { modulus: Some(random.quantity(&[1e9])), ..none },
                    2 => HardeningTable {
                        swift: Some(SwiftTable {
                            strain: random.quantity(&[0.002]),
                            exponent: random.quantity(&[0.2]),
                        }),
                        ..none
                    },
                    _ => {
                        let row = (random.quantity(&[0.0]), random.quantity(&[1e9]));
                        HardeningTable { table: Some(FlowPoints::Rows(vec![row])), ..none }
                    }
                }
            }),
            rate: None,
        });
        let n = self.below(3);
        let mut term = || TermTable {
            weight: self.quantity(&[0.3, 0.6]),
            decay_rate: (self.below(20) > 0).then(|| self.quantity(&[2708.0])),
            relaxation_time: (self.below(20) == 0).then(|| self.quantity(&[1e-3])),
        };
        let terms: Vec<_> = (0..n).map(|_| term()).collect();
        match self.maybe(|_| ()) {
            Some(()) => material.relaxing(ActsOn::Shear, terms),
            None => material,
        }
    }

    fn model(&mut self) -> ModelTable {
        let mut model = ModelTable::default();
        for _ in 0..=self.below(15) / 14 {
            let given = match self.below(15) {
                0 => ModelTable::auto(),
                1 => CondensedTable {
                    vibration_modes: self.maybe(|random| random.quantity(&[12.0])),
                    steps: self.maybe(|random| random.quantity(&[300.0])),
                    penalty_springs: self.maybe(|_| true),
                }
                .into(),
                2 => TingTable {
                    finite_size: self.maybe(|_| true),
                    tolerance: self.maybe(|random| random.quantity(&[1e-5])),
                }
                .into(),
                3 => ModelTable::hertz(),
                4 => ModelTable::law(TsujiTable {
                    e: self.maybe(|random| random.quantity(&[0.9])),
                    alpha: self.maybe(|random| random.quantity(&[0.1])),
                    ..Default::default()
                }),
                5 => ModelTable::law(LinearTable {
                    k: self.maybe(|random| random.quantity(&[1e7])),
                    e: self.maybe(|random| random.quantity(&[0.9])),
                    contact_time: self.maybe(|random| random.quantity(&[6e-5])),
                    ..Default::default()
                }),
                6 => ModelTable::law(KuwabaraKonoTable {
                    a: self.maybe(|random| random.quantity(&[1e-6])),
                    eta_1: self.maybe(|random| random.quantity(&[1e4])),
                    eta_2: self.maybe(|random| random.quantity(&[1e4])),
                    ..Default::default()
                }),
                _ => ModelTable::fem(),
            };
            model = ModelTable {
                fem: model.fem.or(given.fem),
                condensed: model.condensed.or(given.condensed),
                ting: model.ting.or(given.ting),
                hertz: model.hertz.or(given.hertz),
                law: model.law.or(given.law),
                auto: model.auto.or(given.auto),
            };
        }
        model
    }

    fn snapshots(&mut self) -> SnapshotsValue {
        const COUNTS: [f64; 6] = [7.0, 1.5, 0.0, 1e300, f64::NAN, f64::NEG_INFINITY];
        if self.below(2) == 0 {
            return SnapshotsValue::Count(COUNTS[self.below(COUNTS.len())]);
        }
        SnapshotsValue::List((0..self.below(4)).map(|_| self.quantity(&[1e-6, 2e-6])).collect())
    }

    fn probe(&mut self) -> ProbeTable {
        let body = self.name(&["a", "b"]);
        ProbeTable { body, r: self.quantity(&[1e-5]), y: self.quantity(&[1e-4, -1e-4]) }
    }

    fn file(&mut self) -> CaseFile {
        let names = match self.below(20) {
            0 => &["a", "b", "c"][..self.below(4)],
            1 => &["a", "a"],
            _ => &["a", "b"],
        };
        let materials = (0..1 + self.below(2)).map(|_| (self.name(&["glass"]), self.material()));
        CaseFile {
            title: None,
            scene: None,
            material: materials.collect(),
            body: names.iter().map(|name| self.body(name)).collect(),
            start: self.maybe(|random| StartTable { gap: Some(random.quantity(&[1e-6])) }),
            gravity: (self.below(10) == 0).then(|| GravityTable::new(self.quantity(&[9.81]))),
            stop: (self.below(10) == 0)
                .then(|| StopTable { bounces: self.maybe(|random| random.quantity(&[3.0])) }),
            mesh: self.maybe(|random| MeshTable {
                contact_element_size: random.maybe(|random| random.quantity(&[14e-6])),
                refined_radius: random.maybe(|random| random.quantity(&[3e-4])),
                growth: random.maybe(|random| random.quantity(&[1.1])),
                far_radius: random.maybe(|random| random.quantity(&[0.1])),
                staggered: random.maybe(|_| true),
            }),
            contact: self.maybe(|random| ContactTable {
                method: random.maybe(|random| {
                    let [a, b] = [random.below(2), random.below(2)];
                    match (a, b) {
                        (0, _) => ContactMethod::Massless,
                        (_, 0) => ContactMethod::Penalty,
                        _ => ContactMethod::NodeToSurface,
                    }
                }),
                penalty_factor: random.maybe(|random| random.quantity(&[1.0])),
                work_of_adhesion: random.maybe(|random| random.quantity(&[0.1])),
            }),
            time: self.maybe(|random| TimeTable {
                step_factor: random.maybe(|random| random.quantity(&[0.9])),
                mass_scaling: random.maybe(|random| random.quantity(&[2e-4])),
            }),
            output: self.maybe(|random| OutputTable {
                snapshots: random.maybe(Self::snapshots),
                fields: random.maybe(|random| match random.below(3) {
                    0 => Vec::new(),
                    n => Field::WORDS
                        .iter()
                        .filter_map(|word| Field::from_word(word))
                        .take(n)
                        .collect(),
                }),
                probe: (0..random.below(3).saturating_sub(1)).map(|_| random.probe()).collect(),
                report: random.maybe(|random| random.below(2) == 0),
            }),
            model: self.maybe(Self::model),
            accuracy: self.maybe(|random| AccuracyTable {
                tolerance: random.maybe(|random| match random.below(2) {
                    0 => ToleranceValue::Share(random.quantity(&[0.01])),
                    _ => ToleranceValue::Table(ToleranceTable {
                        restitution: random.maybe(|random| random.quantity(&[0.01])),
                        peak_pressure: random.maybe(|random| random.quantity(&[0.01])),
                        ..Default::default()
                    }),
                }),
            }),
            effects: self.maybe(|random| EffectsTable {
                mirror_symmetry: random.maybe(|random| match random.below(4) {
                    0 => Switch::On,
                    _ => Switch::Auto,
                }),
                ..Default::default()
            }),
            limits: self.maybe(|random| LimitsTable {
                elements: random.maybe(|random| random.quantity(&[2e5])),
                memory: random.maybe(|random| random.quantity(&[8e9])),
                ..Default::default()
            }),
        }
    }
}

/// Any case file gives the same scene, or a fault of the same key, in code and as text.
#[test]
fn no_case_file_panics_and_each_is_as_its_text() {
    let (mut n_valid, mut n_faults) = (0, 0);
    let base = parsed(&[]);
    let mut random = Random(1);
    let is_named = |error: &CaseError| error.key() == Some(error.source_name());
    for _ in 0..500 {
        let file = random.file();
        let text = file.to_toml().unwrap();
        let read = Case::parse("made.toml", &text, Path::new("."), &[]);
        let edited =
            base.edited(|base| *base = CaseFile { title: base.title.take(), ..file.clone() });
        match Case::of(file) {
            Ok(made) => {
                n_valid += 1;
                let read = read
                    .unwrap()
                    .edited(|file| file.title = Some(made.scene().title().to_string()));
                assert_eq!(exactly(&read.unwrap()), exactly(&made), "{text}");
                let edited = edited.unwrap();
                assert_eq!(edited.scene().bodies(), made.scene().bodies());
                for path in paths(made.file()) {
                    let error = edited.error_at(&path, "here");
                    assert!(error.line().is_some() || is_named(&error), "{error}");
                }
            }
            Err(error) => {
                n_faults += 1;
                assert!(is_named(&error) && error.line().is_none(), "{error}");
                assert!(!error.to_string().contains(['\u{1b}', '\u{0}']));
                assert_eq!(read.unwrap_err().key(), error.key(), "{text}");
                let edited = edited.unwrap_err();
                assert!(edited.line().is_some() || is_named(&edited), "{edited}");
            }
        }
    }
    assert!(n_valid > 25 && n_faults > 25, "{n_valid} valid, {n_faults} faults");
}
