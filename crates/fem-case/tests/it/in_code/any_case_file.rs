//! Case files with random values: cases of the repository whose keys are replaced, removed, renamed and exchanged.

use std::path::Path;

use fem_case::{Case, CaseError, CaseFile};
use toml::Value;

use super::pair::parsed;
use super::shipped::{exactly, paths, shipped};

/// Knuth's MMIX generator: the same cases on every machine.
struct Random(u64);

impl Random {
    fn below(&mut self, n: usize) -> usize {
        self.0 = self.0.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
        (self.0 >> 33) as usize % n
    }

    fn of<T: Clone>(&mut self, values: &[T]) -> T {
        values[self.below(values.len())].clone()
    }

    fn text(&mut self) -> String {
        const TEXTS: [&str; 13] = [
            "",
            "1",
            "-1 mm",
            "3 furlong",
            "nan",
            "maximum",
            "1 us",
            "off",
            "a b",
            "x.y",
            "\u{7}\"",
            "größe",
            "\u{1b}[31m \u{0}\n\"'",
        ];
        self.of(&TEXTS).to_string()
    }

    /// Returns a value that few keys allow.
    fn value(&mut self) -> Value {
        const NUMBERS: [f64; 11] =
            [0.0, -0.0, 1.0, 1.5, -1.0, 7.0, 1e-320, 1e308, f64::NAN, f64::INFINITY, 9.1e15];
        match self.below(5) {
            0..2 => self.of(&NUMBERS).into(),
            2..4 => self.text().into(),
            _ => (self.below(2) == 0).into(),
        }
    }

    /// Changes a value, a key at any depth, or an item; values and keys may be those of another case at this place.
    fn change(&mut self, value: &mut Value, other: Option<&Value>) {
        match value {
            Value::Table(table) if self.below(20) > 0 => {
                let others = other.and_then(Value::as_table);
                let other_keys = others.into_iter().flat_map(|others| others.keys());
                let keys: Vec<_> = table.keys().chain(other_keys).cloned().collect();
                let Some(key) = (!keys.is_empty()).then(|| self.of(&keys)) else { return };
                let other = others.and_then(|it| it.get(&key));
                match (self.below(12), table.remove(&key), other) {
                    (0, ..) => {}
                    (1, Some(own), _) => drop(table.insert(self.text(), own)),
                    (2, ..) => drop(table.insert(key, self.value())),
                    (3..6, _, Some(other)) | (_, None, Some(other)) => {
                        table.insert(key, other.clone());
                    }
                    (_, Some(mut own), other) => {
                        self.change(&mut own, other);
                        table.insert(key, own);
                    }
                    (_, None, None) => {}
                }
            }
            Value::Array(items) if !items.is_empty() => {
                let k = self.below(items.len());
                match self.below(6) {
                    0 => drop(items.remove(k)),
                    1 => items.push(items[k].clone()),
                    _ => self.change(&mut items[k], other.and_then(|other| other.get(k))),
                }
            }
            other => *other = self.value(),
        }
    }

    /// Returns a case of the repository with a few changes.
    fn file(&mut self, cases: &[Value]) -> CaseFile {
        loop {
            let mut value = self.of(cases);
            for _ in 0..1 + self.below(4) {
                let other = self.of(cases);
                self.change(&mut value, Some(&other));
            }
            // A value of the wrong type is none of a case file.
            if let Ok(file) = value.try_into() {
                return file;
            }
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
    let cases: Vec<_> =
        shipped().iter().map(|case| Value::try_from(case.file()).unwrap()).collect();
    for _ in 0..500 {
        let file = random.file(&cases);
        let text = file.to_toml().unwrap();
        let read = Case::parse("made.toml", &text, Path::new("."), &[]);
        let edited = base.edited(|base| *base = file.clone());
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
    assert!(n_valid > 100 && n_faults > 100, "{n_valid} valid, {n_faults} faults");
}
