//! A sweep: a base case, lists of values for some of its keys, and the cases that they make.
//!
//! A member is the base case with one value of each list put in, after the overrides. Its faults
//! point at the value in the sweep file, also where the base case gives the key that then does
//! not fit.

pub(crate) mod axes;
pub(crate) mod faults;
pub(crate) mod file;
pub(crate) mod values;

use std::path::{Path, PathBuf};

use crate::case::{Case, text_at};
use crate::error::CaseError;
use crate::quantity::{Count, Quantity};
use crate::source::document::{Document, Insertions};
use crate::source::overrides;
use crate::sweep::axes::{Axis, SweptKey, read_axes};
use crate::sweep::faults::{first_of, read_file};
use crate::sweep::file::{Combine, Keep, PlotTable};
use crate::sweep::values::ReadRows;

/// Members that a sweep may have unless it says otherwise.
const MAX_MEMBERS: u64 = 10_000;
/// Summaries of more members are packed unless the sweep says otherwise: file systems bear no folder for each.
const MOST_FOLDERS: usize = 10_000;

/// A sweep whose file is sound; its members are checked one by one.
#[derive(Clone, Debug)]
pub struct Sweep {
    /// The varied keys in the order of the file, at least one.
    pub axes: Vec<Axis>,
    /// How the lists make members.
    pub combine: Combine,
    /// What is kept of each member.
    pub keep: Keep,
    /// What is drawn.
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
    /// Reads a sweep file, the tables that it names by `read_rows`, and its base case; `overrides` are those of
    /// the base case.
    ///
    /// # Errors
    /// What is wrong with the sweep file, all of it: [`CaseError::others`]; a base case that cannot be read; an
    /// override of a varied key; too many members.
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
        let folder = path.parent().unwrap_or(Path::new(""));
        let mut faults = Vec::new();
        let axes = read_axes(&document, &text, (folder, read_rows), tree.get_ref(), &mut faults);
        let file = read_file(&document, tree, &mut faults);
        let given = file.as_ref().and_then(|file| file.max_members.as_ref());
        let mut found = |fault| faults.push(fault);
        let max_members = max_members(&document, given).map_err(&mut found);
        let base = file.as_ref().map(|file| read_base(&document, path, &file.case, overrides));
        let base = base.and_then(|base| base.map_err(&mut found).ok());
        if let Some(first) = first_of(faults) {
            return Err(first);
        }
        // Without a fault there is all of it.
        let (Some(file), Some(base), Ok(max_members)) = (file, base, max_members) else {
            return Err(document.error_at("vary", "the sweep cannot be read"));
        };
        let n_members = count_members(&document, &axes, file.combine, max_members)?;
        check_overrides(&name, &axes, overrides)?;
        Ok(Self {
            axes,
            combine: file.combine,
            keep: file.keep.unwrap_or(match n_members {
                0..=MOST_FOLDERS => Keep::Summary,
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

    /// How many members there are.
    pub fn n_members(&self) -> usize {
        self.n_members
    }

    /// What messages call the sweep file.
    pub(crate) fn name(&self) -> &str {
        &self.name
    }

    /// The base case's file.
    pub fn base_path(&self) -> &Path {
        &self.base.path
    }

    /// For each axis, which of its elements the member has.
    pub fn choice(&self, member: usize) -> Vec<usize> {
        match self.combine {
            Combine::Paired => vec![member; self.axes.len()],
            Combine::All => {
                let mut rest = member;
                let digit = |axis: &Axis| {
                    let element = rest % axis.elements.len();
                    rest /= axis.elements.len();
                    element
                };
                let mut choice: Vec<usize> = self.axes.iter().rev().map(digit).collect();
                choice.reverse();
                choice
            }
        }
    }

    /// The varied keys, axis by axis.
    pub fn keys(&self) -> impl Iterator<Item = &SweptKey> {
        self.axes.iter().flat_map(|axis| &axis.keys)
    }

    /// Of each varied key, its axis and its place in it.
    pub fn places(&self) -> impl Iterator<Item = (usize, usize)> {
        let places =
            |(axis, keys): (usize, &Axis)| (0..keys.keys.len()).map(move |key| (axis, key));
        self.axes.iter().enumerate().flat_map(places)
    }

    /// The member's values as written, in the order of the keys.
    pub fn values(&self, member: usize) -> Vec<&str> {
        let choice = self.choice(member);
        let value = |(axis, key): (usize, usize)| self.axes[axis].elements[choice[axis]].text(key);
        self.places().map(value).collect()
    }

    /// The member's values as people say them, in the order of the keys.
    pub fn said(&self, member: usize) -> Vec<String> {
        let choice = self.choice(member);
        let value = |(axis, key): (usize, usize)| self.axes[axis].elements[choice[axis]].said(key);
        self.places().map(value).collect()
    }

    /// The member in words: `body.0.approach_speed = 0.1 m/s, …`.
    pub fn describe(&self, member: usize) -> String {
        let pairs = self.keys().zip(self.said(member));
        let pairs: Vec<_> = pairs.map(|(key, value)| format!("{} = {value}", key.key)).collect();
        pairs.join(", ")
    }

    /// What `make` makes of the member's case.
    ///
    /// # Errors
    /// A member that is no case, or of which `make` can make nothing; points at the value in the
    /// sweep file that is to blame.
    pub fn build<T>(
        &self,
        member: usize,
        make: impl Fn(Case) -> Result<T, CaseError>,
    ) -> Result<T, CaseError> {
        let choice: Vec<_> = self.choice(member).into_iter().enumerate().collect();
        self.build_of(&choice, member, make)
    }

    /// What `make` makes of the base case with these elements of these axes, which a member has.
    pub(crate) fn build_of<T>(
        &self,
        choice: &[(usize, usize)],
        member: usize,
        make: impl Fn(Case) -> Result<T, CaseError>,
    ) -> Result<T, CaseError> {
        let attempt = |choice: &[(usize, usize)]| self.case(choice).and_then(&make);
        attempt(choice).map_err(|error| {
            let is_the_base = attempt(&[]).err().as_ref() == Some(&error);
            if error.source_name() == self.name || is_the_base {
                return error;
            }
            // To blame is a value without which the fault goes away, or else is another one.
            let without = |element: &(usize, usize)| {
                let others = choice.iter().filter(|other| *other != element);
                attempt(&others.copied().collect::<Vec<_>>()).err()
            };
            let cures = |element: &&(usize, usize)| without(element).is_none();
            let changes = |element: &&(usize, usize)| without(element).as_ref() != Some(&error);
            let culprit = choice.iter().find(cures).or_else(|| choice.iter().find(changes));
            let (axis, element) = *culprit.or(choice.last()).unwrap_or(&(0, 0));
            self.blame(axis, element, member, &error)
        })
    }

    /// An error that points at a key of the sweep file.
    pub fn error_at(&self, path: &str, message: impl Into<String>) -> CaseError {
        self.document.error_at(path, message)
    }

    /// The base case with these elements of these axes.
    pub(crate) fn case(&self, choice: &[(usize, usize)]) -> Result<Case, CaseError> {
        let assign =
            |(axis, element): &(usize, usize)| self.axes[*axis].assignments(*element, &self.text);
        let assignments = choice.iter().flat_map(assign).collect();
        let insertions = Insertions { name: &self.name, text: &self.text, assignments };
        let Base { path, name, text, overrides } = &self.base;
        let stem = path.file_stem().map_or(name.clone(), |stem| stem.to_string_lossy().to_string());
        let folder = path.parent().unwrap_or(Path::new(""));
        Case::build(name, &stem, text, folder, overrides, insertions)
    }

    /// All faults of the base case with these elements of these axes, each alone.
    pub(crate) fn faults(&self, choice: &[(usize, usize)]) -> Vec<CaseError> {
        let assign =
            |(axis, element): &(usize, usize)| self.axes[*axis].assignments(*element, &self.text);
        let Base { path, name, text, overrides } = &self.base;
        let folder = path.parent().unwrap_or(Path::new(""));
        Case::faults_with((name, text), folder, overrides, || Insertions {
            name: &self.name,
            text: &self.text,
            assignments: choice.iter().flat_map(assign).collect(),
        })
    }

    /// The error of a member that points into the base case, pointed at an element.
    pub(crate) fn blame(
        &self,
        axis: usize,
        element: usize,
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
                self.axes[axis].elements[element].span.clone(),
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
    let lengths = axes.iter().map(|axis| axis.elements.len());
    let n_members = match combine {
        Combine::All => lengths.fold(1usize, usize::saturating_mul),
        Combine::Paired => {
            let first = &axes[0];
            let n = first.elements.len();
            if let Some(other) = axes.iter().find(|axis| axis.elements.len() != n) {
                let count =
                    |n: usize| if n == 1 { "1 value".into() } else { format!("{n} values") };
                let message = format!(
                    "{} has {}, {} has {}",
                    other.name(),
                    count(other.elements.len()),
                    first.name(),
                    count(n)
                );
                return Err(document.error_on(other.span.clone(), message).with_help(
                    "paired lists are of one length; combine = \"all\" takes lists of any length",
                ));
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
            .with_help("case names the base case, relative to the sweep file")
    })?;
    Ok(Base { path, name, text, overrides: overrides.to_vec() })
}

/// An override of a varied key would have no effect.
fn check_overrides(sweep: &str, axes: &[Axis], overrides: &[String]) -> Result<(), CaseError> {
    for text in overrides {
        // What is wrong with an override itself is found with the first member.
        let Ok(assignment) = overrides::parse(text, 0) else { continue };
        let mut keys = axes.iter().flat_map(|axis| &axis.keys);
        if let Some(swept) = keys.find(|swept| swept.contains(&assignment.path)) {
            let key = overrides::key_text(text);
            let error = CaseError::new(
                format!("--set {key}=…"),
                format!("{sweep} varies {}; the override has no effect", swept.key),
            );
            return Err(error.with_help("change the list in the sweep file, or drop the override"));
        }
    }
    Ok(())
}
