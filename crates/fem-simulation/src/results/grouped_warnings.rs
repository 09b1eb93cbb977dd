//! Collects the warnings of many runs, each kind once.

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
#[derive(Clone, Debug, Default)]
pub struct WarningKinds {
    kinds: Vec<WarningKind>,
    n_others: usize,
}

impl WarningKind {
    /// Returns whether a warning differs from these only in its numbers.
    pub fn is_of(&self, warning: &str) -> bool {
        self.kind == without_numbers(warning)
    }
}

impl WarningKinds {
    /// Adds a warning of the run with this index.
    pub fn add(&mut self, run: usize, warning: &str) {
        let kind = without_numbers(warning);
        if let Some(known) = self.kinds.iter_mut().find(|known| known.kind == kind) {
            known.count += 1;
        } else if self.kinds.len() < MAX_KINDS {
            let first = warning.to_string();
            self.kinds.push(WarningKind { kind, first, run, count: 1 });
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

/// Removes the numbers of a text and the units after them.
fn without_numbers(text: &str) -> String {
    const LONGEST_UNIT: usize = 4;
    let (mut words, mut is_behind_number) = (Vec::new(), false);
    for word in text.split_whitespace() {
        let is_unit = is_behind_number && word.chars().count() <= LONGEST_UNIT;
        is_behind_number = word.contains(|c: char| c.is_ascii_digit());
        if !is_unit && !is_behind_number {
            words.push(word);
        }
    }
    words.join(" ")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn warnings_that_differ_only_in_their_numbers_are_one_kind() {
        let [a, b] = ["a step of 12.3 µm is 4 % too long", "a step of 1.1 mm is 12 % too long"];
        assert_eq!(without_numbers(a), without_numbers(b));
        assert_ne!(without_numbers(a), without_numbers("a step of 12.3 µm is 4 % too short"));
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
