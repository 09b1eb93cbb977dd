//! All faults of a sweep file at once: those of its keys and lists, and of the values in them.

use std::ops::Range;

use serde::Deserialize;
use toml::Spanned;
use toml::de::{DeTable, DeValue, Error};

use crate::case::Case;
use crate::error::CaseError;
use crate::source::document::Document;
use crate::source::explain::explain;
use crate::sweep::Sweep;
use crate::sweep::file::{Combine, SweepFile};

/// As many faults are told.
const MOST_FAULTS: usize = 20;
/// Values that are tried; of longer lists the first.
const MOST_TRIED: usize = 2000;

/// The first of some faults, by their places, with the others.
pub(crate) fn first_of(mut faults: Vec<CaseError>) -> Option<CaseError> {
    let place = |fault: &CaseError| fault.span().map_or(usize::MAX, |span| span.start);
    faults.sort_by_key(place);
    faults.dedup();
    faults.truncate(MOST_FAULTS);
    let others = faults.split_off(faults.len().min(1));
    Some(faults.pop()?.with_others(others))
}

/// The sweep file of a tree; what is wrong with a key is told, and the key left out.
pub(crate) fn read_file(
    document: &Document,
    mut tree: Spanned<DeTable<'_>>,
    faults: &mut Vec<CaseError>,
) -> Option<SweepFile> {
    let mut is_whole = true;
    for _ in 0..MOST_FAULTS {
        let error = match SweepFile::deserialize(toml::de::Deserializer::from(tree.clone())) {
            Ok(file) => return Some(file),
            Err(error) => error,
        };
        let span = error.span().unwrap_or(0..0);
        // A misspelled key that is left out is missing.
        if is_whole || !is_missing(&error) {
            faults.push(explain(document, &error));
        }
        if !without(tree.get_mut(), &span) {
            return None;
        }
        is_whole = false;
    }
    None
}

fn is_missing(error: &Error) -> bool {
    error.message().starts_with("missing field")
}

/// Leaves the key out that is at these bytes, or whose value is; `false` if there is none.
fn without(table: &mut DeTable<'_>, span: &Range<usize>) -> bool {
    let covers = |outer: Range<usize>| outer.start <= span.start && span.end <= outer.end;
    let keys: Vec<String> = table.keys().map(|key| key.get_ref().to_string()).collect();
    for key in &keys {
        let Some((name, value)) = table.get_key_value(key.as_str()) else { continue };
        let is_it = covers(name.span()) || covers(value.span());
        // The bytes of a table are those of its header.
        if let Some(DeValue::Table(inner)) = table.get_mut(key.as_str()).map(Spanned::get_mut)
            && without(inner, span)
        {
            return true;
        }
        if is_it {
            return table.remove(key.as_str()).is_some();
        }
    }
    false
}

impl Sweep {
    /// The first fault of the members with the faults of all other values of the lists, each found with sound
    /// values of the other lists; `make` makes of a case what a member has to become.
    pub fn with_other_faults<T>(
        &self,
        first: CaseError,
        make: impl Fn(Case) -> Result<T, CaseError>,
    ) -> CaseError {
        let attempt = |choice: &[(usize, usize)]| self.case(choice).and_then(&make).err();
        let points_here = |error: &CaseError| error.source_name() == self.name();
        let of_base = self.faults(&[]);
        if !of_base.is_empty() {
            return self.beside_those_of_the_base(first, &of_base);
        }
        if !points_here(&first) || attempt(&[]).is_some() {
            return first;
        }
        let tried = |axis: usize| 0..self.axes[axis].elements.len().min(MOST_TRIED);
        let alone =
            |axis: usize| tried(axis).find(|element| attempt(&[(axis, *element)]).is_none());
        // Of an axis that has no sound value the base case's own is one.
        let sound: Vec<Option<usize>> = match self.combine {
            Combine::All => (0..self.axes.len()).map(alone).collect(),
            Combine::Paired => Vec::new(),
        };
        let mut faults = vec![first.clone()];
        for axis in 0..self.axes.len() {
            for element in tried(axis) {
                if faults.len() > MOST_FAULTS || attempt(&[(axis, element)]).is_none() {
                    continue;
                }
                let mut choice = sound.clone();
                if let Some(own) = choice.get_mut(axis) {
                    *own = Some(element);
                }
                let whole: Vec<usize> = choice.iter().map(|own| own.unwrap_or(0)).collect();
                let member = self.member_of(&whole).unwrap_or(element);
                let places = choice.iter().enumerate();
                let choice: Vec<_> =
                    places.filter_map(|(axis, own)| Some((axis, (*own)?))).collect();
                let fault = match self.combine {
                    Combine::All => self.build_of(&choice, member, &make).err(),
                    Combine::Paired => self.build_of(&[(axis, element)], member, &make).err(),
                };
                let Some(fault) = fault else { continue };
                let is_known = |known: &CaseError| known.span() == fault.span();
                if points_here(&fault) && !faults.iter().any(is_known) {
                    faults.push(fault);
                }
            }
        }
        first_of(faults).unwrap_or(first)
    }

    /// The faults of the base case that its values do not mend, and those that each value adds to them.
    fn beside_those_of_the_base(&self, first: CaseError, of_base: &[CaseError]) -> CaseError {
        let beginning: Vec<_> = (0..self.axes.len()).map(|axis| (axis, 0)).collect();
        let of_member = self.faults(&beginning);
        let stay = of_base.iter().filter(|fault| of_member.contains(fault)).cloned();
        let mut faults: Vec<CaseError> = Vec::new();
        for (axis, elements) in self.axes.iter().map(|axis| axis.elements.len()).enumerate() {
            for element in 0..elements.min(MOST_TRIED) {
                if faults.len() > MOST_FAULTS {
                    break;
                }
                let added = self.faults(&[(axis, element)]);
                let added = added.into_iter().filter(|fault| !of_base.contains(fault));
                let mut whole = vec![0; self.axes.len()];
                whole[axis] = element;
                let member = self.member_of(&whole).unwrap_or(element);
                faults.extend(added.map(|fault| match fault.source_name() == self.name() {
                    true => fault,
                    false => self.blame(axis, element, member, &fault),
                }));
            }
        }
        let of_values = first_of(faults).into_iter().flat_map(CaseError::each);
        let mut all: Vec<CaseError> = stay.chain(of_values).collect();
        // What only the making of a member refuses is in none of these.
        let place = |fault: &CaseError| (fault.source_name().to_string(), fault.span());
        if !all.iter().any(|fault| place(fault) == place(&first)) {
            all.insert(0, first);
        }
        all.truncate(MOST_FAULTS);
        let head = all.remove(0);
        head.with_others(all)
    }

    /// The member with these elements, where all are combined with all.
    fn member_of(&self, choice: &[usize]) -> Option<usize> {
        let digit = |member: usize, (axis, element): (usize, &usize)| {
            member * self.axes[axis].elements.len() + element
        };
        let is_any = !choice.is_empty() && self.combine == Combine::All;
        is_any.then(|| choice.iter().enumerate().fold(0, digit))
    }
}
