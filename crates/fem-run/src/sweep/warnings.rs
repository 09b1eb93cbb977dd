//! What the members of a sweep warn of: each warning once, with how many have it and the first of them.
//!
//! Numbers differ from member to member; warnings that are the same but for those are one.

use std::collections::HashMap;

use crate::standard_output::one_line;

/// As many kinds are told apart, so that a large sweep needs no more memory; and as many are told.
const MOST_KEPT: usize = 1000;
const MOST_TOLD: usize = 20;

/// Warnings by their kinds, in the order in which they were seen.
#[derive(Clone, Debug, Default)]
pub struct Warnings {
    kinds: Vec<Kind>,
    places: HashMap<String, usize>,
    /// Warnings of kinds that are not kept.
    n_others: usize,
}

/// Warnings that are the same but for their numbers.
#[derive(Clone, Debug)]
struct Kind {
    /// As the first member has it.
    text: String,
    first: String,
    n_members: usize,
}

impl Warnings {
    /// Takes a warning of the next member, which `name` names.
    pub fn see(&mut self, text: &str, name: impl FnOnce() -> String) {
        let kind = without_numbers(text);
        if let Some(place) = self.places.get(&kind) {
            self.kinds[*place].n_members += 1;
        } else if self.kinds.len() < MOST_KEPT {
            self.places.insert(kind, self.kinds.len());
            self.kinds.push(Kind { text: text.to_string(), first: name(), n_members: 1 });
        } else {
            self.n_others += 1;
        }
    }

    /// A line a kind, those of the most members first; of those that are left out that there are.
    /// What was `told` before is not told again.
    pub fn lines<'t>(&self, told: impl IntoIterator<Item = &'t String>) -> Vec<String> {
        let told: Vec<String> = told.into_iter().map(|text| without_numbers(text)).collect();
        let is_new = |kind: &&Kind| !told.contains(&without_numbers(&kind.text));
        let mut kinds: Vec<&Kind> = self.kinds.iter().filter(is_new).collect();
        kinds.sort_by_key(|kind| std::cmp::Reverse(kind.n_members));
        let line = |kind: &&Kind| {
            let Kind { text, first, n_members } = kind;
            one_line(&match n_members {
                1 => format!("{text} (1 member: {first})"),
                n => format!("{text} ({n} members, numbers are of the first: {first})"),
            })
        };
        let mut lines: Vec<String> = kinds.iter().take(MOST_TOLD).map(line).collect();
        let n_untold = kinds.len().saturating_sub(MOST_TOLD) + self.n_others;
        if n_untold > 0 {
            lines.push(format!("… and {n_untold} more, in the column `warnings` of sweep.csv"));
        }
        lines
    }
}

/// Each number, with its sign, digits, point and powerand the unit behind it, as one `#`.
fn without_numbers(text: &str) -> String {
    let mut kind = String::with_capacity(text.len());
    for word in text.split(' ') {
        let is_number = word.starts_with(|c: char| c.is_ascii_digit() || c == '-')
            && word.contains(|c: char| c.is_ascii_digit());
        let is_unit = kind.ends_with('#') && word.chars().count() <= 4 && !word.is_empty();
        kind.push_str(match (is_number, is_unit) {
            (true, _) => " #",
            // ms and µs are of one kind.
            (false, true) => "",
            (false, false) => " ",
        });
        if !is_number && !is_unit {
            kind.push_str(word);
        }
    }
    kind
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_warning_is_told_once_whatever_its_numbers() {
        let mut warnings = Warnings::default();
        warnings.see("waves change it by 0.5 µs of 2e-5", || "v = 1".to_string());
        warnings.see("steel yields", || "v = 1".to_string());
        for speed in 2..5 {
            let text = format!("waves change it by {speed} ms of {}e-4", 0.5 * f64::from(speed));
            warnings.see(&text, || format!("v = {speed}"));
        }
        assert_eq!(
            warnings.lines(&[]),
            [
                "waves change it by 0.5 µs of 2e-5 (4 members, numbers are of the first: v = 1)",
                "steel yields (1 member: v = 1)"
            ]
        );
        let told = ["waves change it by 7 s of 1e-3".to_string()];
        assert_eq!(warnings.lines(&told), ["steel yields (1 member: v = 1)"]);
    }

    #[test]
    fn what_is_not_told_is_counted() {
        let mut warnings = Warnings::default();
        for k in 0..u32::try_from(MOST_KEPT).unwrap() + 5 {
            let letters: String = format!("{k}").chars().map(|c| (c as u8 + 49) as char).collect();
            warnings.see(&format!("of a kind {letters}"), || "v = 1".to_string());
        }
        let lines = warnings.lines(&[]);
        assert_eq!(lines.len(), MOST_TOLD + 1);
        assert!(lines[MOST_TOLD].contains(&format!("{}", MOST_KEPT + 5 - MOST_TOLD)));
    }
}
