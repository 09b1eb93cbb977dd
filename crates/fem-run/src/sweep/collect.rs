//! From the members' summaries to table and picture.
//!
//! Members are read some at a time, twice: once for what the whole table and the picture have, once for the rows.
//! What is kept of each is a bit, and of some what is drawn or shown.

use std::io;

use fem::WarningKinds;
use fem::sweep::{Columns, KeyNumbers, Member, NumberColumn, Row, SWEEP_FILE, sweep_csv};
use fem_case::Sweep;
use fem_report::sweep::{FigureChoice, FigurePoint, sweep_figure};
use serde_json::Value;

use super::folder::{PICTURE_FILE, SweepFolder};
use crate::failure::Failure;
use crate::standard_output::one_line;

/// Rows that are shown; all are in the table.
const MOST_SHOWN: usize = 40;
/// Members that are named which failed.
const MOST_NAMED: usize = 40;

/// What the members of a sweep came to.
#[derive(Clone, Debug, Default)]
pub struct Collected {
    /// How many are done.
    pub n_done: usize,
    /// How many of those that are this process's own.
    pub n_own_done: usize,
    /// The first rows.
    pub shown: Vec<Row>,
    /// How many of its own failed.
    pub n_failed: usize,
    /// The first of them, and why.
    pub failed: Vec<String>,
    /// What its own members warn of.
    pub warnings: WarningKinds,
}

/// What one look at all members found.
struct Look {
    collected: Collected,
    is_there: Vec<bool>,
    columns: Columns,
    points: Vec<FigurePoint>,
    /// Of all members, whose ever they are.
    n_failed: usize,
}

/// A sweep and where its members' results are.
pub struct Collector<'a> {
    /// The sweep.
    pub sweep: &'a Sweep,
    /// All members.
    pub members: &'a [Member],
    /// Where their results are.
    pub folder: &'a mut SweepFolder,
    /// The values of its keys.
    pub numbers: &'a KeyNumbers,
    /// What is drawn.
    pub choice: &'a FigureChoice,
}

impl Collector<'_> {
    /// Writes table and picture of what is there and returns what it is; `is_own` says which members are
    /// this process's.
    ///
    /// Another process may finish a member after this one has looked, and write its table before this
    /// one does. Whoever looks again after writing and finds no more than it wrote is the last.
    ///
    /// # Errors
    /// The file system.
    pub fn collect(&mut self, is_own: impl Fn(usize) -> bool) -> Result<Collected, Failure> {
        loop {
            self.folder.refresh();
            let look = self.look(&is_own);
            self.write(&look)?;
            self.folder.refresh();
            let missing = self.members.iter().filter(|member| !look.is_there[member.index]);
            if !self.summaries(missing).any(|summary| summary.is_some()) {
                return Ok(look.collected);
            }
        }
    }

    fn look(&self, is_own: &impl Fn(usize) -> bool) -> Look {
        let mut look = Look {
            collected: Collected::default(),
            is_there: vec![false; self.members.len()],
            columns: Columns::default(),
            points: Vec::new(),
            n_failed: 0,
        };
        for row in self.rows(self.members.iter()) {
            let member = &self.members[row.index];
            look.is_there[member.index] = true;
            look.columns.see(&row.summary);
            look.n_failed += usize::from(!row.is_complete());
            look.points.extend(FigurePoint::of(&row, self.choice, self.members.len()));
            look.collected.take(row, self.sweep, is_own(member.index));
        }
        look
    }

    fn write(&self, look: &Look) -> Result<(), Failure> {
        let folder = &*self.folder;
        let fault = |name: &str, error: &io::Error| {
            let place = folder.path().join(name);
            let message = format!("{} cannot be written: {error}", place.display());
            Failure::failed(message)
                .with_help("the members that were computed are kept; the same command goes on")
        };
        let numbers = self.numbers.columns(self.sweep);
        let keys = self.sweep.keys().map(|swept| swept.key.as_str());
        let keys = keys.chain(numbers.iter().map(|column| column.name.as_str()));
        let there = self.members.iter().filter(|member| look.is_there[member.index]);
        let rows = self.rows(there).map(|row| self.numbered(row, &numbers));
        folder
            .write(SWEEP_FILE, |file| {
                sweep_csv(file, keys, &look.columns.names(), rows).map_err(io::Error::from)
            })
            .map_err(|error| fault(SWEEP_FILE, &error))?;
        match sweep_figure(self.sweep, &look.points, self.choice, look.n_failed) {
            Some(svg) => folder
                .write(PICTURE_FILE, |file| file.write_all(svg.as_bytes()))
                .map_err(|error| fault(PICTURE_FILE, &error))?,
            None => folder.remove(PICTURE_FILE),
        }
        Ok(())
    }

    fn summaries<'m>(
        &'m self,
        members: impl Iterator<Item = &'m Member> + 'm,
    ) -> impl Iterator<Item = Option<Value>> + 'm {
        self.folder.summaries(members.map(Member::identity))
    }

    /// The rows of those that are done.
    fn rows<'m>(
        &'m self,
        members: impl Iterator<Item = &'m Member> + Clone + 'm,
    ) -> impl Iterator<Item = Row> + 'm {
        let summaries = self.summaries(members.clone());
        members.zip(summaries).filter_map(|(member, summary)| {
            Some(Row::new(member, self.sweep.values(member.index), summary?))
        })
    }

    /// A row with its values in SI.
    fn numbered(&self, row: Row, columns: &[NumberColumn]) -> Row {
        let numbers = self.numbers.row(self.sweep, columns, row.index);
        row.with_numbers(numbers)
    }
}

impl Collected {
    /// Takes the row of a member that is done.
    pub fn take(&mut self, row: Row, sweep: &Sweep, is_own: bool) {
        self.n_done += 1;
        self.n_own_done += usize::from(is_own);
        if is_own && !row.is_complete() {
            self.n_failed += 1;
            if self.failed.len() < MOST_NAMED {
                let reason = row.summary["stopped_because"].as_str().unwrap_or("unknown");
                self.failed.push(one_line(&format!("{}: {reason}", sweep.describe(row.index))));
            }
        }
        if is_own {
            let warnings = row.summary["warnings"].as_array().into_iter().flatten();
            for warning in warnings.filter_map(|warning| warning.as_str()) {
                self.warnings.see(row.index, warning);
            }
        }
        if self.shown.len() < MOST_SHOWN {
            self.shown.push(row);
        }
    }
}
