//! Collects the warnings of many runs, each kind once.

use fem_case::parse_quantity;

/// Most kinds that are kept.
const MAX_KINDS: usize = 100;

/// Warnings that differ only in their numbers.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct WarningKind {
    kind: String,
    /// The first warning of this kind.
    pub first: String,
    /// Index of the run that gave the first warning.
    pub run: usize,
    /// Least and greatest of each number, with its unit; each word twice.
    ends: Vec<[String; 2]>,
    /// Index of the run that gave the last warning.
    pub last_run: usize,
    /// Number of warnings of this kind.
    pub count: usize,
}

/// All kinds of warnings, in the order of their first ones.
///
/// ```
/// let mut kinds = fem_simulation::WarningKinds::default();
/// kinds.add(0, "a step of 12.3 µm is 4 % too long");
/// kinds.add(1, "a step of 1.1 mm is 12 % too long");
/// assert_eq!((kinds.all().len(), kinds.all()[0].count), (1, 2));
/// ```
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct WarningKinds {
    kinds: Vec<WarningKind>,
    n_others: usize,
}

impl WarningKind {
    /// Returns whether a warning differs from these only in its numbers.
    pub fn is_of(&self, warning: &str) -> bool {
        self.kind == without_numbers(warning)
    }

    /// Returns the warning with the least and the greatest of each number that varies: "yields at 1 mm/s … 5 m/s".
    pub fn merged(&self) -> String {
        let merge = |[low, high]: &[String; 2]| match low == high {
            true => low.clone(),
            false => format!("{} … {}", before_marks(low), high.trim_start_matches(is_mark)),
        };
        self.ends.iter().map(merge).collect::<Vec<_>>().join(" ")
    }

    /// Takes another warning of this kind.
    fn take(&mut self, run: usize, warning: &str) {
        self.count += 1;
        self.last_run = run;
        let more = pieces(warning);
        if more.len() != self.ends.len() {
            return;
        }
        for ([low, high], Piece { text, value }) in self.ends.iter_mut().zip(more) {
            if value > number(high) {
                *high = text;
            } else if value < number(low) {
                *low = text;
            }
        }
    }
}

impl WarningKinds {
    /// Adds a warning of the run with this index.
    pub fn add(&mut self, run: usize, warning: &str) {
        let kind = without_numbers(warning);
        if let Some(known) = self.kinds.iter_mut().find(|known| known.kind == kind) {
            known.take(run, warning);
        } else if self.kinds.len() < MAX_KINDS {
            let first = warning.to_string();
            let ends = pieces(warning).into_iter().map(|it| [it.text.clone(), it.text]).collect();
            self.kinds.push(WarningKind { kind, first, run, ends, last_run: run, count: 1 });
        } else {
            self.n_others += 1;
        }
    }

    /// Returns the number of warnings of kinds that are not kept.
    pub fn n_others(&self) -> usize {
        self.n_others
    }

    /// Returns the kinds that are kept.
    pub fn all(&self) -> &[WarningKind] {
        &self.kinds
    }
}

/// A word of a warning, or a number with its unit.
struct Piece {
    text: String,
    /// The number in SI units; `None` of a word.
    value: Option<f64>,
}

/// Splits a text at its blanks, but not between a number and its unit.
fn pieces(text: &str) -> Vec<Piece> {
    let mut pieces: Vec<Piece> = Vec::new();
    for word in text.split_whitespace() {
        let bare_number = |it: &&mut Piece| it.value.is_some() && before_marks(&it.text) == it.text;
        let with_unit = pieces.last_mut().filter(bare_number).and_then(|it| {
            let text = format!("{} {word}", it.text);
            // "5 in the" is no length.
            let value = number(&text).filter(|_| !it.text.contains(' ') && word != "in")?;
            Some((it, Piece { text, value: Some(value) }))
        });
        match with_unit {
            Some((it, with_unit)) => *it = with_unit,
            None => pieces.push(Piece { text: word.to_string(), value: number(word) }),
        }
    }
    pieces
}

/// Returns the number of a word, with the unit behind it, in SI units; `None` of words, also of those with digits.
fn number(text: &str) -> Option<f64> {
    let digits = before_marks(text).trim_start_matches(is_mark).replace(',', "");
    let starts_so =
        digits.starts_with(|c: char| c.is_ascii_digit() || matches!(c, '+' | '-' | '.'));
    let value = starts_so.then(|| parse_quantity(&digits).ok())??;
    Some(value.0)
}

/// Returns a text without the punctuation at its end.
fn before_marks(text: &str) -> &str {
    text.trim_end_matches(|c| is_mark(c) && c != '%')
}

fn is_mark(c: char) -> bool {
    (c.is_ascii_punctuation() && !matches!(c, '+' | '-')) || matches!(c, '±' | '≤' | '≥')
}

/// Removes the numbers of a text and the units after them.
fn without_numbers(text: &str) -> String {
    let pieces = pieces(text);
    let words =
        pieces.iter().filter(|piece| piece.value.is_none()).map(|piece| piece.text.as_str());
    words.collect::<Vec<_>>().join(" ")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn warnings_that_differ_only_in_their_numbers_are_one_kind() {
        let [a, b] = ["a step of 12.3 µm is 4 % too long", "a step of 1.1 mm is 12 % too long"];
        assert_eq!(without_numbers(a), without_numbers(b));
        assert_ne!(without_numbers(a), without_numbers("a step of 12.3 µm is 4 % too short"));
        let mut kinds = WarningKinds::default();
        for (run, text) in [(2, a), (3, b), (7, "a step of 2 m is 4 % too long")] {
            kinds.add(run, text);
        }
        let kind = &kinds.all()[0];
        assert_eq!((kind.count, kind.run, kind.last_run), (3, 2, 7));
        assert_eq!(kind.merged(), "a step of 12.3 µm … 2 m is 4 % … 12 % too long");
        let mut yields = WarningKinds::default();
        yields.add(0, "at 924.9 µm/s: e from 0.84 to 1.00");
        yields.add(1, "at 5.000 m/s: e from 0.14 to 0.26");
        yields.add(2, "at 20.00 mm/s: e from 0.5 to 0.7");
        assert_eq!(
            yields.all()[0].merged(),
            "at 924.9 µm/s … 5.000 m/s: e from 0.14 … 0.84 to 0.26 … 1.00"
        );
    }

    /// A merged warning is one of them with ranges in place of its numbers: no word moves, none with digits is merged.
    #[test]
    fn only_numbers_become_ranges() {
        for (texts, merged) in [
            (
                [
                    "10 % stronger at 2000 1/s (e +0.01): set material.steel.flow.rate (c = 0 for none)",
                    "10 % stronger at 3000 1/s (e +0.02): set material.steel.flow.rate (c = 0 for none)",
                ],
                "10 % stronger at 2000 1/s … 3000 1/s (e +0.01 … +0.02): set material.steel.flow.rate (c = 0 for none)",
            ),
            (
                [
                    "error of 1.2 %, above 1.00 %: write size = \"37.8 µm\", or 1,200 elements",
                    "error of 800 %, above 1.00 %: write size = \"12.1 µm\", or 900 elements",
                ],
                "error of 1.2 % … 800 %, above 1.00 %: write size = \"12.1 µm … 37.8 µm\", or 900 … 1,200 elements",
            ),
            (["at 5 in the bounces", "at 7 in the bounces"], "at 5 … 7 in the bounces"),
        ] {
            let mut kinds = WarningKinds::default();
            texts.into_iter().enumerate().for_each(|(run, text)| kinds.add(run, text));
            let found: Vec<String> = kinds.all().iter().map(WarningKind::merged).collect();
            assert_eq!(found, [merged]);
        }
        assert_ne!(
            without_numbers("give lib:pa6 damping"),
            without_numbers("give lib:pa12 damping")
        );
    }

    #[test]
    fn kinds_that_are_not_kept_are_counted() {
        let mut kinds = WarningKinds::default();
        for k in 0..MAX_KINDS + 5 {
            let letters: String = format!("{k}").chars().map(|c| (c as u8 + 49) as char).collect();
            kinds.add(k, &format!("a kind {letters}"));
        }
        assert_eq!((kinds.all().len(), kinds.n_others()), (MAX_KINDS, 5));
        assert!(kinds.all()[0].is_of("a kind a 7") && !kinds.all()[1].is_of("a kind a"));
    }
}
