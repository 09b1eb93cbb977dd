//! All faults of the members of a sweep at once: those of the base case, and those of each value in the lists.

use crate::case::Case;
use crate::error::CaseError;
use crate::source::error_recovery::MAX_FAULTS;
use crate::sweep::Sweep;
use crate::sweep::axes::Axis;
use crate::sweep::file::Combine;

/// The largest number of values of a list that are tried.
const MAX_TRIED: usize = 2000;

/// Returns the different faults among these in the order of the text, as many as are reported.
pub(crate) fn in_order(mut faults: Vec<CaseError>) -> Vec<CaseError> {
    let place = |fault: &CaseError| fault.span().map_or(usize::MAX, |span| span.start);
    faults.sort_by_key(place);
    faults.dedup();
    faults.truncate(MAX_FAULTS);
    faults
}

impl Sweep {
    /// Returns the first fault of the members together with the faults of all other values, each found with valid values
    /// of the other lists. `make` turns the case of a member into its result.
    pub fn with_other_faults<T>(
        &self,
        first: CaseError,
        make: impl Fn(Case) -> Result<T, CaseError>,
    ) -> CaseError {
        let attempt = |choice: &[(usize, usize)]| self.case(choice).and_then(&make).err();
        let points_here = |error: &CaseError| error.source_name() == self.name;
        let of_base = self.faults(&[]);
        if !of_base.is_empty() {
            return self.with_faults_of_base(first, &of_base);
        }
        if !points_here(&first) || attempt(&[]).is_some() {
            return first;
        }
        let tried = |axis: usize| 0..self.axes[axis].values.len().min(MAX_TRIED);
        let alone = |axis: usize| tried(axis).find(|value| attempt(&[(axis, *value)]).is_none());
        // If an axis has no valid value, the base case's own value is used.
        let valid: Vec<Option<usize>> = match self.combine {
            Combine::All => (0..self.axes.len()).map(alone).collect(),
            Combine::Paired => Vec::new(),
        };
        let mut faults = vec![first.clone()];
        for axis in 0..self.axes.len() {
            for value in tried(axis) {
                if faults.len() > MAX_FAULTS || attempt(&[(axis, value)]).is_none() {
                    continue;
                }
                let others = valid.iter().enumerate().filter(|(other, _)| *other != axis);
                let others = others.filter_map(|(other, own)| Some((other, (*own)?)));
                let mut choice: Vec<_> = others.chain([(axis, value)]).collect();
                choice.sort_unstable();
                let fault = self.build_of(&choice, &make).err();
                let Some(fault) = fault else { continue };
                let is_known = |known: &CaseError| known.span() == fault.span();
                if points_here(&fault) && !faults.iter().any(is_known) {
                    faults.push(fault);
                }
            }
        }
        CaseError::joined(in_order(faults)).unwrap_or(first)
    }

    /// Returns the faults of the base case that its values do not replace, and those that each value adds.
    fn with_faults_of_base(&self, first: CaseError, of_base: &[CaseError]) -> CaseError {
        let beginning: Vec<_> = (0..self.axes.len()).map(|axis| (axis, 0)).collect();
        let of_member = self.faults(&beginning);
        let stay = of_base.iter().filter(|fault| of_member.contains(fault)).cloned();
        let mut faults: Vec<CaseError> = Vec::new();
        for (axis, values) in self.axes.iter().map(|axis| axis.values.len()).enumerate() {
            for value in 0..values.min(MAX_TRIED) {
                if faults.len() > MAX_FAULTS {
                    break;
                }
                let added = self.faults(&[(axis, value)]);
                let added = added.into_iter().filter(|fault| !of_base.contains(fault));
                let member = self.member_of(&[(axis, value)]);
                faults.extend(added.map(|fault| match fault.source_name() == self.name {
                    true => fault,
                    false => self.blame(axis, value, member, &fault),
                }));
            }
        }
        let mut all: Vec<CaseError> = stay.chain(in_order(faults)).collect();
        // A fault that only `make` finds is in none of these.
        let place = |fault: &CaseError| (fault.source_name().to_string(), fault.span());
        if !all.iter().any(|fault| place(fault) == place(&first)) {
            all.insert(0, first.clone());
        }
        all.truncate(MAX_FAULTS);
        CaseError::joined(all).unwrap_or(first)
    }

    /// Returns the member with these values of these axes, and the first values of all others.
    pub(super) fn member_of(&self, choice: &[(usize, usize)]) -> usize {
        let value_of = |axis: usize| choice.iter().find(|(own, _)| *own == axis);
        let digit = |member: usize, (axis, of): (usize, &Axis)| {
            member * of.values.len() + value_of(axis).map_or(0, |(_, value)| *value)
        };
        match self.combine {
            Combine::All => self.axes.iter().enumerate().fold(0, digit),
            Combine::Paired => choice.first().map_or(0, |(_, value)| *value),
        }
    }
}
