//! A sweep: a base case, lists of values for some of its keys, and the resulting cases (members).
//!
//! A member is the base case with the overrides and then one value of each list. Its faults point at the value in the
//! sweep file, even if another key of the base case contradicts it.

pub(crate) mod axes;
pub(crate) mod faults;
pub(crate) mod file;
pub(crate) mod values;

use std::path::{Path, PathBuf};

use serde::Deserialize;

use crate::case::{Case, text_at};
use crate::error::CaseError;
use crate::quantity::{Count, Quantity};
use crate::source::changes::{changes, folder_name};
use crate::source::document::{Document, Insertions};
use crate::source::error_recovery::{KeyRepair, read_repaired};
use crate::source::explain::explain;
use crate::source::overrides;
use crate::sweep::axes::{Axis, SweptKey, read_axes};
use crate::sweep::faults::in_order;
use crate::sweep::file::{Combine, Keep, PlotTable, SweepFile};
use crate::sweep::values::ReadRows;

/// The default of the largest number of members.
const MAX_MEMBERS: u64 = 10_000;
/// The largest number of members with a folder each by default, since file systems are slow with more.
const MAX_FOLDERS: usize = 10_000;

/// A sweep with a valid file; its members are validated one by one.
#[derive(Clone, Debug)]
pub struct Sweep {
    /// The varied keys in the order of the file, at least one.
    pub axes: Vec<Axis>,
    /// How the lists are combined.
    pub combine: Combine,
    /// The results that are kept of each member.
    pub keep: Keep,
    /// The figure of the sweep.
    pub plot: PlotTable,
    n_members: usize,
    name: String,
    text: String,
    document: Document,
    base: Base,
}

/// The case that all members share, as text.
#[derive(Clone, Debug)]
struct Base {
    path: PathBuf,
    name: String,
    text: String,
    overrides: Vec<String>,
}

impl Sweep {
    /// Reads a sweep file, its tables with `read_rows`, and its base case, to which `overrides` apply.
    ///
    /// # Errors
    /// Returns all faults of the sweep file ([`CaseError::others`]). Others are a base case that cannot be read, an
    /// override of a varied key, and too many members.
    pub fn load(
        path: &Path,
        overrides: &[String],
        read_rows: &ReadRows,
    ) -> Result<Self, CaseError> {
        let name = path.display().to_string();
        let text = text_at(path, &name).map_err(|error| match error.help() {
            Some(_) if error.span().is_none() => {
                error.with_help("name a sweep file: fem-run sweep cases/sweep_speed.toml")
            }
            _ => error,
        })?;
        let (document, tree) = Document::parse(&name, &text, &[], None, &[])?;
        if let (Some((body, _)), false) =
            (tree.get_ref().get_key_value("body"), tree.get_ref().contains_key("vary"))
        {
            return Err(document
                .error_on(body.span(), "this file is a case, not a sweep")
                .labelled("a table of cases")
                .with_help(
                    "run it with fem-run FILE; a sweep names it, case = \"FILE\", and has lists of values, \
                     [vary] \"body.0.approach_speed\" = [0.1, 1]",
                ));
        }
        let folder = path.parent().unwrap_or(Path::new(""));
        let (file, mut faults) = read_repaired(|repairs| {
            let (document, tree) = Document::parse(&name, &text, &[], None, repairs)?;
            SweepFile::deserialize(toml::de::Deserializer::from(tree))
                .map_err(|error| explain(&document, &error))
        });
        let axes = read_axes(&document, &text, (folder, read_rows), tree.get_ref(), &mut faults);
        let given = file.as_ref().and_then(|file| file.max_members.as_ref());
        let mut found = |fault| faults.push(fault);
        let max_members = max_members(&document, given).map_err(&mut found);
        let base = file.as_ref().map(|file| read_base(&document, path, &file.case, overrides));
        let base = base.and_then(|base| base.map_err(&mut found).ok());
        if let Some(first) = CaseError::joined(in_order(faults)) {
            return Err(first);
        }
        // Without a fault all three exist.
        let (Some(file), Some(base), Ok(max_members)) = (file, base, max_members) else {
            return Err(document.error_at("vary", "the sweep cannot be read"));
        };
        let n_members = count_members(&document, &axes, file.combine, max_members)?;
        check_overrides(&name, &axes, overrides)?;
        Ok(Self {
            axes,
            combine: file.combine,
            keep: file.keep.unwrap_or(match n_members {
                0..=MAX_FOLDERS => Keep::Summary,
                _ => Keep::Packed,
            }),
            plot: file.plot,
            n_members,
            name,
            text,
            document,
            base,
        })
    }

    /// Returns the number of members.
    pub fn n_members(&self) -> usize {
        self.n_members
    }

    /// Returns the path of the base case.
    pub fn base_path(&self) -> &Path {
        &self.base.path
    }

    /// Returns the texts of the sweep file and of the base case.
    pub fn texts(&self) -> [&str; 2] {
        [&self.text, &self.base.text]
    }

    /// Returns the name of the default result folder: that of the sweep file, `stem`, and the overrides that change the
    /// scene, as for a case ([`Case::folder_name`]).
    pub fn folder_name(&self, stem: &str) -> String {
        let first: Vec<_> = self.choice(0).into_iter().enumerate().collect();
        let changes = self.case(&first).map(|case| changes(case.file(), &self.base.overrides));
        folder_name(stem, &changes.unwrap_or_default())
    }

    /// Returns the index of the member's value on each axis.
    pub fn choice(&self, member: usize) -> Vec<usize> {
        match self.combine {
            Combine::Paired => vec![member; self.axes.len()],
            Combine::All => {
                let mut rest = member;
                let digit = |axis: &Axis| {
                    let value = rest % axis.values.len();
                    rest /= axis.values.len();
                    value
                };
                let mut choice: Vec<usize> = self.axes.iter().rev().map(digit).collect();
                choice.reverse();
                choice
            }
        }
    }

    /// Returns the varied keys, axis by axis.
    pub fn keys(&self) -> impl Iterator<Item = &SweptKey> {
        self.axes.iter().flat_map(|axis| &axis.keys)
    }

    /// Returns the axis of each varied key, and the index of the key on the axis.
    pub fn places(&self) -> impl Iterator<Item = (usize, usize)> {
        let places =
            |(axis, keys): (usize, &Axis)| (0..keys.keys.len()).map(move |key| (axis, key));
        self.axes.iter().enumerate().flat_map(places)
    }

    /// Returns the member's values as written, in the order of the keys.
    pub fn values(&self, member: usize) -> Vec<&str> {
        let choice = self.choice(member);
        let value = |(axis, key): (usize, usize)| self.axes[axis].values[choice[axis]].text(key);
        self.places().map(value).collect()
    }

    /// Returns the member's values for display, in the order of the keys.
    pub fn displayed(&self, member: usize) -> Vec<String> {
        let choice = self.choice(member);
        let value =
            |(axis, key): (usize, usize)| self.axes[axis].values[choice[axis]].displayed(key);
        self.places().map(value).collect()
    }

    /// Describes the member: `body.0.approach_speed = 0.1 m/s, …`.
    pub fn describe(&self, member: usize) -> String {
        let pairs = self.keys().zip(self.displayed(member));
        let pairs: Vec<_> = pairs.map(|(key, value)| format!("{} = {value}", key.key)).collect();
        pairs.join(", ")
    }

    /// Applies `make` to the member's case.
    ///
    /// # Errors
    /// The member is not a valid case, or `make` fails. The error points at the value in the sweep file that causes it.
    pub fn build<T>(
        &self,
        member: usize,
        make: impl Fn(Case) -> Result<T, CaseError>,
    ) -> Result<T, CaseError> {
        let choice: Vec<_> = self.choice(member).into_iter().enumerate().collect();
        self.build_of(&choice, make)
    }

    /// Applies `make` to the base case with these values of these axes, which belong to a member.
    pub(crate) fn build_of<T>(
        &self,
        choice: &[(usize, usize)],
        make: impl Fn(Case) -> Result<T, CaseError>,
    ) -> Result<T, CaseError> {
        let attempt = |choice: &[(usize, usize)]| self.case(choice).and_then(&make);
        attempt(choice).map_err(|error| {
            let is_the_base = attempt(&[]).err().as_ref() == Some(&error);
            if error.source_name() == self.name || is_the_base {
                return error;
            }
            // The cause is the value without which the fault disappears or changes.
            let without = |value: &(usize, usize)| {
                let others = choice.iter().filter(|other| *other != value);
                attempt(&others.copied().collect::<Vec<_>>()).err()
            };
            let cures = |value: &&(usize, usize)| without(value).is_none();
            let changes = |value: &&(usize, usize)| without(value).as_ref() != Some(&error);
            let culprit = choice.iter().find(cures).or_else(|| choice.iter().find(changes));
            let (axis, value) = *culprit.or(choice.last()).unwrap_or(&(0, 0));
            self.blame(axis, value, self.member_of(choice), &error)
        })
    }

    /// Creates an error that points at a key of the sweep file.
    pub fn error_at(&self, path: &str, message: impl Into<String>) -> CaseError {
        self.document.error_at(path, message)
    }

    /// Returns the base case with these values of these axes.
    pub(crate) fn case(&self, choice: &[(usize, usize)]) -> Result<Case, CaseError> {
        self.read(choice, &[])
    }

    /// Returns all faults, one by one, of the base case with these values of these axes.
    pub(crate) fn faults(&self, choice: &[(usize, usize)]) -> Vec<CaseError> {
        read_repaired(|repairs| self.read(choice, repairs)).1
    }

    fn read(&self, choice: &[(usize, usize)], repairs: &[KeyRepair]) -> Result<Case, CaseError> {
        let assign =
            |(axis, value): &(usize, usize)| self.axes[*axis].assignments(*value, &self.text);
        let assignments = choice.iter().flat_map(assign).collect();
        let insertions = Insertions { name: &self.name, text: &self.text, assignments };
        let Base { path, name, text, overrides } = &self.base;
        let stem = path.file_stem().map_or(name.clone(), |stem| stem.to_string_lossy().to_string());
        let folder = path.parent().unwrap_or(Path::new(""));
        let document = Document::parse(name, text, overrides, Some(insertions), repairs)?;
        Case::of_document(document, &stem, folder, &[])
    }

    /// Converts an error of a member that points into the base case into one that points at a value.
    pub(crate) fn blame(
        &self,
        axis: usize,
        value: usize,
        member: usize,
        error: &CaseError,
    ) -> CaseError {
        let place = match (error.line(), error.column()) {
            (Some(line), Some(column)) => format!("{}:{line}:{column}", error.source_name()),
            _ => error.source_name().to_string(),
        };
        let member = format!("the member is {}", self.describe(member));
        let help = error.help().map_or(member.clone(), |help| format!("{help}; {member}"));
        self.document
            .error_on(
                self.axes[axis].values[value].span.clone(),
                format!("no valid case with this value: {} ({place})", error.message()),
            )
            .with_help(help)
    }
}

fn max_members(document: &Document, given: Option<&Quantity<Count>>) -> Result<u64, CaseError> {
    let Some(given) = given else { return Ok(MAX_MEMBERS) };
    let count = given.si().ok().filter(|count| *count >= 1.0 && *count <= 9e15);
    count.filter(|count| count.fract() == 0.0).map(|count| count as u64).ok_or_else(|| {
        document
            .error_at("max_members", format!("max_members is {given}"))
            .with_help("max_members must be a whole number from 1 to 9e15")
    })
}

fn count_members(
    document: &Document,
    axes: &[Axis],
    combine: Combine,
    max_members: u64,
) -> Result<usize, CaseError> {
    let lengths = axes.iter().map(|axis| axis.values.len());
    let n_members = match combine {
        Combine::All => lengths.fold(1usize, usize::saturating_mul),
        Combine::Paired => {
            let first = &axes[0];
            let n = first.values.len();
            if let Some(other) = axes.iter().find(|axis| axis.values.len() != n) {
                let count =
                    |n: usize| if n == 1 { "1 value".into() } else { format!("{n} values") };
                let message = format!(
                    "{} has {}, {} has {}",
                    other.name(),
                    count(other.values.len()),
                    first.name(),
                    count(n)
                );
                return Err(document
                    .error_on(other.span.clone(), message)
                    .with_help("give all lists the same length, or set combine = \"all\""));
            }
            n
        }
    };
    if n_members as u64 > max_members {
        let error = document.error_at("vary", format!("the sweep has {n_members} members"));
        return Err(error.with_help(format!(
            "at most {max_members} are allowed; shorten the lists or raise max_members"
        )));
    }
    Ok(n_members)
}

fn read_base(
    document: &Document,
    sweep: &Path,
    case: &str,
    overrides: &[String],
) -> Result<Base, CaseError> {
    let path = sweep.parent().unwrap_or(Path::new("")).join(case);
    let name = path.display().to_string();
    let text = text_at(&path, &name).map_err(|error| {
        if error.span().is_some() {
            return error;
        }
        document
            .error_at("case", format!("{name}: {}", error.message()))
            .with_help("give the path of the base case, relative to the sweep file")
    })?;
    Ok(Base { path, name, text, overrides: overrides.to_vec() })
}

/// Rejects overrides of varied keys, which would have no effect.
fn check_overrides(sweep: &str, axes: &[Axis], overrides: &[String]) -> Result<(), CaseError> {
    for text in overrides {
        // A fault of an override itself is found with the first member.
        let Ok(assignment) = overrides::parse(text, 0) else { continue };
        let mut keys = axes.iter().flat_map(|axis| &axis.keys);
        if let Some(swept) = keys.find(|swept| swept.contains(&assignment.path)) {
            let key = overrides::key_text(text);
            let error = CaseError::new(
                format!("--set {key}=…"),
                format!("{sweep} varies {}; the override has no effect", swept.key),
            );
            return Err(
                error.with_help("change the list in the sweep file, or remove the override")
            );
        }
    }
    Ok(())
}
