//! A result folder, read back.

use std::collections::HashMap;
use std::path::{Path, PathBuf};

use fem::results::{CONTACT_FILE, HISTORY_FILE, HistoryColumns, Parts, SUMMARY_FILE};
use fem_collision::QuantityOfInterest;
use serde::Deserialize;
use serde_json::Value;
use thiserror::Error;

use crate::answer::error_parts;
use crate::number_text::one_line;

/// Errors of making a page.
#[derive(Debug, Error)]
pub enum ReportError {
    /// The folder holds no result of a run.
    #[error("{folder}: {SUMMARY_FILE} {fault}")]
    NoResult {
        /// The folder, as the user named it.
        folder: String,
        /// The error of its summary.
        fault: String,
        /// The suggested fix.
        help: &'static str,
    },
    /// The same result is named twice.
    #[error("{0}: this result is named twice")]
    Repeated(String),
    /// The template cannot be rendered.
    #[error("the page cannot be made: {0}")]
    Template(#[from] askama::Error),
}

impl ReportError {
    /// Returns what the user can do about it.
    pub fn help(&self) -> Option<&'static str> {
        match self {
            Self::NoResult { help, .. } => Some(help),
            Self::Repeated(_) => Some("name each folder once"),
            Self::Template(_) => None,
        }
    }
}

/// The files of one result.
pub struct StoredResult {
    /// The name of its folder.
    pub name: String,
    /// The folder of the result, as it was given.
    pub folder: PathBuf,
    /// The content of `summary.json`.
    pub summary: Value,
    /// The columns of `history.csv`; empty without that file.
    pub history: Columns,
    /// The contact at each snapshot.
    pub contacts: Vec<ContactSnapshot>,
    /// The files with the fields at each snapshot.
    pub frames: Vec<FieldFile>,
}

/// The contact at a snapshot.
pub struct ContactSnapshot {
    /// Time of the snapshot, s.
    pub time: f64,
    /// The snapshot's label, as in file names.
    pub label: String,
    /// (r in m, p in Pa) from the axis outward, to the first row without pressure.
    pub pressure: Vec<(f64, f64)>,
    /// Gap between the surfaces on the axis, m.
    pub gap: f64,
    /// The points of `pressure` that are nodes of the mesh.
    pub at_nodes: Vec<(f64, f64)>,
}

/// A file with the fields at a snapshot.
pub struct FieldFile {
    /// Time of the snapshot, s.
    pub time: f64,
    /// The snapshot's label, as in file names.
    pub label: String,
    /// The path of the file.
    pub path: PathBuf,
}

/// The content of `<stem>.vtu.series`.
#[derive(Deserialize)]
struct Series {
    files: Vec<SeriesFile>,
}

#[derive(Deserialize)]
struct SeriesFile {
    name: String,
    time: f64,
}

impl StoredResult {
    /// Reads a result folder.
    pub fn read(folder: &Path) -> Result<Self, ReportError> {
        let no_result = |fault: String| ReportError::NoResult {
            folder: one_line(&folder.display().to_string()),
            fault,
            help: match folder.join("members").is_dir() {
                true => {
                    "this is the folder of a sweep, whose figure is sweep.svg; name one of its folders \
                     in members/"
                }
                false => "name the folder of a run, such as runs/glass_0.5ms",
            },
        };
        let text =
            std::fs::read_to_string(folder.join(SUMMARY_FILE)).map_err(|error| {
                match folder.is_file() {
                    true => no_result("is looked for in a folder, and this is a file".to_string()),
                    false => no_result(format!("cannot be read: {error}")),
                }
            })?;
        let history = Columns::read(&folder.join(HISTORY_FILE)).unwrap_or_default();
        let found = Self::of(folder, &text, history);
        found.map_err(|error| no_result(format!("is no summary: {error}")))
    }

    /// Reads several result folders. Results whose folders have the same name are named by their paths.
    pub fn read_all(folders: &[PathBuf]) -> Result<Vec<Self>, ReportError> {
        let mut results: Vec<Self> = Vec::with_capacity(folders.len());
        let mut places: Vec<PathBuf> = Vec::with_capacity(folders.len());
        for folder in folders {
            results.push(Self::read(folder)?);
            let place = folder.canonicalize().unwrap_or_else(|_| folder.clone());
            if places.contains(&place) {
                return Err(ReportError::Repeated(one_line(&folder.display().to_string())));
            }
            places.push(place);
        }
        let names: Vec<String> = results.iter().map(|result| result.name.clone()).collect();
        for (result, folder) in results.iter_mut().zip(folders) {
            if names.iter().filter(|name| **name == result.name).count() > 1 {
                result.name = one_line(&folder.display().to_string());
            }
        }
        Ok(results)
    }

    /// Reads a folder whose summary and history are known; files that are missing or damaged are left out.
    pub fn of(folder: &Path, summary: &str, history: Columns) -> Result<Self, String> {
        let summary: Value = serde_json::from_str(summary).map_err(|error| error.to_string())?;
        if summary.get("hertz").is_none() {
            return Err("it is not that of a run".to_string());
        }
        let contacts = Columns::read(&folder.join(CONTACT_FILE)).unwrap_or_default();
        let name = folder.file_name().unwrap_or(folder.as_os_str()).to_string_lossy();
        Ok(Self {
            name: name.into_owned(),
            folder: folder.to_path_buf(),
            history,
            contacts: contacts_of(&contacts),
            frames: frames_of(folder, &summary),
            summary,
        })
    }

    /// Returns a number of the summary by its path of keys; `None` if it is null or missing.
    pub fn number(&self, keys: &[&str]) -> Option<f64> {
        keys.iter().try_fold(&self.summary, |value, key| value.get(key))?.as_f64()
    }

    /// Returns the parts of a quantity's error; results of older versions lack some.
    pub fn error_parts(&self, quantity: QuantityOfInterest) -> Parts {
        error_parts(&self.summary, quantity)
    }

    /// Returns a text of the summary by its key, or an empty one.
    pub fn text(&self, key: &str) -> &str {
        self.summary.get(key).and_then(Value::as_str).unwrap_or_default()
    }

    /// Returns a list of the summary by its key, or an empty one.
    pub fn list(&self, key: &str) -> &[Value] {
        self.summary.get(key).and_then(Value::as_array).map_or(&[], Vec::as_slice)
    }

    /// Returns the names of the bodies, the lower one first.
    pub fn body_names(&self) -> Vec<String> {
        let name = |body: &Value| Some(body.get("name")?.as_str()?.to_string());
        self.list("bodies").iter().filter_map(name).collect()
    }

    /// Returns the title of the case, or the name of the folder.
    pub fn title(&self) -> String {
        let title = self.summary.get("case").and_then(|case| case.get("title"));
        let title = title.and_then(Value::as_str).filter(|title| !title.is_empty());
        title.unwrap_or(&self.name).to_string()
    }

    /// Whether forces and positions refer to the deformed shape.
    pub fn is_finite_strain(&self) -> bool {
        let text = |effect: &Value, key: &str| effect.get(key).cloned();
        self.list("effects").iter().any(|effect| {
            text(effect, "name") == Some("finite strain".into())
                && text(effect, "active") == Some(true.into())
        })
    }

    /// Whether a body has elements.
    pub fn has_elements(&self) -> bool {
        let elements = |body: &Value| body.get("elements").and_then(Value::as_u64);
        self.list("bodies").iter().filter_map(elements).any(|n| n > 0)
    }

    /// Whether the bodies stay together: the result is complete and has no contact time.
    pub fn stays_together(&self) -> bool {
        let is_null = self.summary.get("contact_time_s").is_some_and(Value::is_null);
        is_null && self.text("stopped_because").is_empty()
    }

    /// Returns the time of the largest contact force, s, or that of first touch if there is no force.
    pub fn peak_time(&self) -> f64 {
        let (times, forces) = (self.history.get("time_s"), self.history.get("contact_force_n"));
        let finite = times.iter().zip(forces).filter(|(_, force)| force.is_finite());
        finite.max_by(|a, b| a.1.total_cmp(b.1)).map_or(self.first_touch(), |(time, _)| *time)
    }

    /// Returns the time of first touch, s: the last row before the first one with a force.
    pub fn first_touch(&self) -> f64 {
        let (times, forces) = (self.history.get("time_s"), self.history.get("contact_force_n"));
        let closed = forces.iter().position(|force| *force > 0.0).unwrap_or(0);
        times.get(closed.saturating_sub(1)).copied().unwrap_or(0.0)
    }

    /// Returns the end of the first contact, s: the last row with a force before a force-free interval of
    /// half the contact. For bodies that stay together it is the last row.
    pub fn last_touch(&self) -> f64 {
        let (times, forces) = (self.history.get("time_s"), self.history.get("contact_force_n"));
        let start = self.first_touch();
        let mut last = start;
        for (time, force) in times.iter().zip(forces) {
            if *force > 0.0 {
                last = *time;
            } else if last > start && time - last > 0.5 * (last - start) {
                break;
            }
        }
        last
    }
}

fn contacts_of(columns: &Columns) -> Vec<ContactSnapshot> {
    let (radii, pressures) = (columns.get("r_m"), columns.get("pressure_pa"));
    let is_node = columns.get("is_node");
    let mut contacts: Vec<ContactSnapshot> = Vec::new();
    let rows = columns.get("time_s").iter().zip(columns.texts("label"));
    for (k, (&time, label)) in rows.enumerate() {
        if contacts.last().is_none_or(|last| last.time != time) {
            let (pressure, at_nodes) = (Vec::new(), Vec::new());
            let (label, gap) = (label.clone(), columns.get("gap_m").get(k).copied());
            let gap = gap.unwrap_or(0.0);
            contacts.push(ContactSnapshot { time, label, gap, pressure, at_nodes });
        }
        let Some(last) = contacts.last_mut() else { continue };
        // The first row without pressure ends the curve.
        let is_over = last.pressure.len() > 1 && last.pressure.last().is_some_and(|p| p.1 == 0.0);
        if !is_over {
            last.pressure.push((radii[k], pressures[k]));
            // Tables of older versions have nodes only.
            if is_node.get(k).is_none_or(|is_node| *is_node == 1.0) {
                last.at_nodes.push((radii[k], pressures[k]));
            }
        }
    }
    contacts
}

fn frames_of(folder: &Path, summary: &Value) -> Vec<FieldFile> {
    const ENDING: &str = ".vtu.series";
    let files = summary.get("files").and_then(Value::as_array);
    let mut names = files.into_iter().flatten().filter_map(Value::as_str);
    let Some(name) = names.find(|name| name.ends_with(ENDING)) else { return Vec::new() };
    let stem = format!("{}_", name.trim_end_matches(ENDING));
    let text = std::fs::read(folder.join(name)).unwrap_or_default();
    let series: Series = serde_json::from_slice(&text).unwrap_or(Series { files: Vec::new() });
    let frame = |file: SeriesFile| {
        let rest = file.name.strip_prefix(&stem).unwrap_or(&file.name);
        let label = rest.split_once('_').map_or(rest, |(_, label)| label);
        let label = label.trim_end_matches(".vtu").to_string();
        FieldFile { time: file.time, label, path: folder.join(&file.name) }
    };
    series.files.into_iter().map(frame).collect()
}

/// A CSV table of this program by columns; a cell without a number is NaN.
#[derive(Default)]
pub struct Columns {
    names: Vec<String>,
    numbers: HashMap<String, Vec<f64>>,
    texts: HashMap<String, Vec<String>>,
}

impl From<HistoryColumns> for Columns {
    fn from(columns: HistoryColumns) -> Self {
        let names = columns.iter().map(|(name, _)| name.clone()).collect();
        Self { names, numbers: columns.into_iter().collect(), texts: HashMap::new() }
    }
}

impl Columns {
    /// Reads a file; `None` if it is missing or no table.
    pub fn read(path: &Path) -> Option<Self> {
        let mut file = csv::Reader::from_path(path).ok()?;
        let names: Vec<String> = file.headers().ok()?.iter().map(String::from).collect();
        let mut numbers = vec![Vec::new(); names.len()];
        let mut texts = vec![Vec::new(); names.len()];
        let mut row = csv::StringRecord::new();
        while file.read_record(&mut row).ok()? {
            for (k, field) in row.iter().enumerate() {
                numbers[k].push(field.parse().unwrap_or(f64::NAN));
                if matches!(names[k].as_str(), "label" | "body") {
                    texts[k].push(field.to_string());
                }
            }
        }
        Some(Self {
            numbers: names.iter().cloned().zip(numbers).collect(),
            texts: names.iter().cloned().zip(texts).collect(),
            names,
        })
    }

    /// Returns the names of the columns, in the order of the file.
    pub fn names(&self) -> &[String] {
        &self.names
    }

    /// Returns the numbers of a column; empty if there is no such column.
    pub fn get(&self, name: &str) -> &[f64] {
        self.numbers.get(name).map_or(&[], Vec::as_slice)
    }

    /// Returns the texts of the column `label` or `body`.
    pub fn texts(&self, name: &str) -> &[String] {
        self.texts.get(name).map_or(&[], Vec::as_slice)
    }

    /// Interpolates a column linearly at a time, s; NaN beyond the table.
    pub fn at(&self, name: &str, time: f64) -> f64 {
        let (times, values) = (self.get("time_s"), self.get(name));
        let after = times.partition_point(|row| *row < time);
        match (after.checked_sub(1), values.get(after)) {
            (None, Some(value)) if times[after] == time => *value,
            (Some(before), Some(value)) => {
                let share = (time - times[before]) / (times[after] - times[before]);
                values[before] + share * (value - values[before])
            }
            _ => f64::NAN,
        }
    }
}
