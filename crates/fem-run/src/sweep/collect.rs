//! Table and figure of a sweep from the summaries of its members.
//!
//! Summaries are read in portions, twice: once for the columns and the figure, once for the rows. In memory
//! stay one bit per member and the values that are drawn or printed.

use std::io;

use fem::WarningKinds;
use fem::sweep::{Columns, KeyNumbers, Member, Row, SWEEP_FILE, sweep_csv};
use fem_case::Sweep;
use fem_report::sweep::{FigureChoice, FigurePoint, sweep_figure};
use serde_json::Value;

use super::folder::{FIGURE_FILE, SweepFolder};
use crate::result_folder::whole_file::cause;
use crate::text::{Failure, one_line};

const MAX_SHOWN: usize = 40;
const MAX_NAMED: usize = 40;

#[derive(Clone, Debug, Default)]
pub struct SweepOutcome {
    pub n_done: usize,
    /// Members of this process that are done.
    pub n_own_done: usize,
    pub shown: Vec<Row>,
    pub n_failed: usize,
    /// The first failed members, each with the reason.
    pub failed: Vec<String>,
    /// Warnings of this process' members.
    pub warnings: WarningKinds,
}

struct MemberScan {
    collected: SweepOutcome,
    is_there: Vec<bool>,
    columns: Columns,
    points: Vec<FigurePoint>,
    /// All failed members, of any process.
    n_failed: usize,
}

pub struct Collector<'a> {
    pub sweep: &'a Sweep,
    pub members: &'a [Member],
    pub folder: &'a mut SweepFolder,
    pub numbers: &'a KeyNumbers,
    /// The columns of the figure; without it neither table nor figure is written.
    pub choice: Option<&'a FigureChoice>,
}

impl Collector<'_> {
    /// Writes table and figure of the members that are done, if there is a choice, and returns what is known of them; `is_own`
    /// selects the members of this process.
    ///
    /// Another process may finish a member after this one has read the folder, and write its table before
    /// this one. A process that finds no new member after writing has written the final table.
    pub fn collect(&mut self, is_own: impl Fn(usize) -> bool) -> Result<SweepOutcome, Failure> {
        loop {
            self.folder.refresh();
            let look = self.look(&is_own);
            let Some(choice) = self.choice else { return Ok(look.collected) };
            self.write(&look, choice)?;
            self.folder.refresh();
            let missing = self.members.iter().filter(|member| !look.is_there[member.index]);
            if !self.summaries(missing).any(|summary| summary.is_some()) {
                return Ok(look.collected);
            }
        }
    }

    fn look(&self, is_own: &impl Fn(usize) -> bool) -> MemberScan {
        let mut look = MemberScan {
            collected: SweepOutcome::default(),
            is_there: vec![false; self.sweep.n_members()],
            columns: Columns::default(),
            points: Vec::new(),
            n_failed: 0,
        };
        for row in self.rows(self.members.iter()) {
            look.is_there[row.index] = true;
            look.columns.see(&row.summary);
            look.n_failed += usize::from(!row.is_complete());
            let point = |choice| FigurePoint::of(&row, choice, self.members.len());
            look.points.extend(self.choice.and_then(point));
            let is_own = is_own(row.index);
            look.collected.take(row, self.sweep, is_own);
        }
        look
    }

    fn write(&self, look: &MemberScan, choice: &FigureChoice) -> Result<(), Failure> {
        let folder = &*self.folder;
        let fault = |name: &str, error: &io::Error| {
            let place = folder.path().join(name);
            let message = format!("{} cannot be written: {}", place.display(), cause(error));
            Failure::failed(message)
                .with_help("the members that were computed are kept; the same command continues")
        };
        let numbers = self.numbers.columns(self.sweep);
        let keys = self.sweep.keys().map(|swept| swept.key.as_str());
        let keys = keys.chain(numbers.iter().map(|column| column.name.as_str()));
        let there = self.members.iter().filter(|member| look.is_there[member.index]);
        let rows = self.rows(there).map(|row| {
            let values = self.numbers.row(self.sweep, &numbers, row.index);
            row.with_numbers(values)
        });
        folder
            .write(SWEEP_FILE, |file| {
                sweep_csv(file, keys, &look.columns.names(), rows).map_err(io::Error::from)
            })
            .map_err(|error| fault(SWEEP_FILE, &error))?;
        match sweep_figure(self.sweep, &look.points, choice, look.n_failed) {
            Some(svg) => folder
                .write(FIGURE_FILE, |file| file.write_all(svg.as_bytes()))
                .map_err(|error| fault(FIGURE_FILE, &error))?,
            None => folder.remove(FIGURE_FILE),
        }
        Ok(())
    }

    fn summaries<'m>(
        &'m self,
        members: impl Iterator<Item = &'m Member> + 'm,
    ) -> impl Iterator<Item = Option<Value>> + 'm {
        self.folder.summaries(members.map(Member::identity))
    }

    fn rows<'m>(
        &'m self,
        members: impl Iterator<Item = &'m Member> + Clone + 'm,
    ) -> impl Iterator<Item = Row> + 'm {
        let summaries = self.summaries(members.clone());
        members.zip(summaries).filter_map(|(member, summary)| {
            Some(Row::new(member, self.sweep.values(member.index), summary?))
        })
    }
}

impl SweepOutcome {
    fn take(&mut self, row: Row, sweep: &Sweep, is_own: bool) {
        self.n_done += 1;
        self.n_own_done += usize::from(is_own);
        if is_own && !row.is_complete() {
            self.n_failed += 1;
            if self.failed.len() < MAX_NAMED {
                let reason = row.summary["stopped_because"].as_str().unwrap_or("unknown");
                self.failed.push(one_line(&format!("{}: {reason}", sweep.describe(row.index))));
            }
        }
        if is_own {
            let warnings = row.summary["warnings"].as_array().into_iter().flatten();
            for warning in warnings.filter_map(|warning| warning.as_str()) {
                self.warnings.add(row.index, warning);
            }
        }
        if self.shown.len() < MAX_SHOWN {
            self.shown.push(row);
        }
    }
}
