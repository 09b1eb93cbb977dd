//! A result folder, read back.

use std::path::{Path, PathBuf};

use fem::results::{CONTACT_FILE, HISTORY_FILE, Parts, SUMMARY_FILE};
use fem_collision::Headline;
use serde::Deserialize;
use serde_json::Value;

use super::columns::Columns;
use crate::failure::Failure;
use crate::standard_output::one_line;

/// What a page is drawn from: the files of one result.
pub struct Record {
    /// What it is called among others: its folder.
    pub name: String,
    /// As in its file.
    pub summary: Value,
    /// Empty where there is none.
    pub history: Columns,
    /// The contact at each snapshot.
    pub contacts: Vec<ContactAt>,
    /// The fields at each snapshot.
    pub frames: Vec<Frame>,
}

/// The contact at an instant.
pub struct ContactAt {
    /// s.
    pub time: f64,
    /// As in file names.
    pub label: String,
    /// (r in m, p in Pa) from the axis outward, as far as there is pressure and a row further.
    pub pressure: Vec<(f64, f64)>,
    /// Of the surfaces on the axis, m.
    pub gap: f64,
    /// Those of them that are at nodes of the mesh.
    pub at_nodes: Vec<(f64, f64)>,
}

/// A file of fields.
pub struct Frame {
    /// s.
    pub time: f64,
    /// As in file names.
    pub label: String,
    /// Where it is.
    pub path: PathBuf,
}

/// `<stem>.vtu.series`.
#[derive(Deserialize)]
struct Series {
    files: Vec<SeriesFile>,
}

#[derive(Deserialize)]
struct SeriesFile {
    name: String,
    time: f64,
}

impl Record {
    /// Reads a folder.
    ///
    /// # Errors
    /// No summary of a run there, or one that is no JSON.
    pub fn read(folder: &Path) -> Result<Self, Failure> {
        let shown = one_line(&folder.display().to_string());
        let help = match folder.join("members").is_dir() {
            true => "this is a sweep: its picture is sweep.svg; name folders below its members",
            false => "name the folder of a run, such as runs/glass_0.5ms",
        };
        let path = folder.join(SUMMARY_FILE);
        let text = std::fs::read_to_string(&path).map_err(|error| {
            Failure::bad_input(format!("{shown}: {SUMMARY_FILE} cannot be read: {error}"))
                .with_help(help)
        })?;
        Self::of(folder, &text).map_err(|error| {
            Failure::bad_input(format!("{shown}: {SUMMARY_FILE} is no summary: {error}"))
                .with_help(help)
        })
    }

    /// Reads several, each once; those whose folders are called alike are called by their paths.
    ///
    /// # Errors
    /// As [`Record::read`], and a folder that is named twice.
    pub fn read_all(folders: &[PathBuf]) -> Result<Vec<Self>, Failure> {
        let mut records: Vec<Self> = Vec::with_capacity(folders.len());
        let mut places: Vec<PathBuf> = Vec::with_capacity(folders.len());
        for folder in folders {
            records.push(Self::read(folder)?);
            let place = folder.canonicalize().unwrap_or_else(|_| folder.clone());
            if places.contains(&place) {
                let shown = one_line(&folder.display().to_string());
                let message = format!("{shown}: this result is named twice");
                return Err(Failure::bad_input(message).with_help("name each folder once"));
            }
            places.push(place);
        }
        let names: Vec<String> = records.iter().map(|record| record.name.clone()).collect();
        for (record, folder) in records.iter_mut().zip(folders) {
            if names.iter().filter(|name| **name == record.name).count() > 1 {
                record.name = one_line(&folder.display().to_string());
            }
        }
        Ok(records)
    }

    /// Of a folder whose summary is this text; files that are not there, or not whole, are left out.
    ///
    /// # Errors
    /// A text that is no JSON, or of no run.
    pub fn of(folder: &Path, summary: &str) -> Result<Self, String> {
        let summary: Value = serde_json::from_str(summary).map_err(|error| error.to_string())?;
        if summary.get("hertz").is_none() {
            return Err("it is of no run".to_string());
        }
        let history = Columns::read(&folder.join(HISTORY_FILE)).unwrap_or_default();
        let contacts = Columns::read(&folder.join(CONTACT_FILE)).unwrap_or_default();
        let name = folder.file_name().unwrap_or(folder.as_os_str()).to_string_lossy();
        Ok(Self {
            name: name.into_owned(),
            history,
            contacts: contacts_of(&contacts),
            frames: frames_of(folder, &summary),
            summary,
        })
    }

    /// A number of the summary by its keys; `None` of what is null or not there.
    pub fn number(&self, keys: &[&str]) -> Option<f64> {
        keys.iter().try_fold(&self.summary, |value, key| value.get(key))?.as_f64()
    }

    /// How far a quantity may be off; older results know less of it.
    pub fn parts(&self, headline: Headline) -> Parts {
        let part = |part: &str| self.number(&["uncertainty", headline.key(), part]);
        Parts {
            discretisation: part("discretisation"),
            model: part("model"),
            model_at_least: part("model_at_least"),
        }
    }

    /// A text of the summary by its key; empty where there is none.
    pub fn text(&self, key: &str) -> &str {
        self.summary.get(key).and_then(Value::as_str).unwrap_or_default()
    }

    /// A list of the summary by its key; empty where there is none.
    pub fn list(&self, key: &str) -> &[Value] {
        self.summary.get(key).and_then(Value::as_array).map_or(&[], Vec::as_slice)
    }

    /// What the case is called.
    pub fn title(&self) -> String {
        let title = self.summary.get("case").and_then(|case| case.get("title"));
        let title = title.and_then(Value::as_str).filter(|title| !title.is_empty());
        title.unwrap_or(&self.name).to_string()
    }

    /// Whether forces and places are those of the deformed shape.
    pub fn is_finite_strain(&self) -> bool {
        let text = |effect: &Value, key: &str| effect.get(key).cloned();
        self.list("effects").iter().any(|effect| {
            text(effect, "name") == Some("finite strain".into())
                && text(effect, "active") == Some(true.into())
        })
    }

    /// Whether bodies have elements.
    pub fn has_elements(&self) -> bool {
        let elements = |body: &Value| body.get("elements").and_then(Value::as_u64);
        self.list("bodies").iter().filter_map(elements).any(|n| n > 0)
    }

    /// Whether the bodies stay together, which a complete result without a contact time says.
    pub fn stays_together(&self) -> bool {
        let is_null = self.summary.get("contact_time_s").is_some_and(Value::is_null);
        is_null && self.text("stopped_because").is_empty()
    }

    /// Time of the largest contact force, s; that of the first touch without any.
    pub fn peak_time(&self) -> f64 {
        let (times, forces) = (self.history.get("time_s"), self.history.get("contact_force_n"));
        let finite = times.iter().zip(forces).filter(|(_, force)| force.is_finite());
        finite.max_by(|a, b| a.1.total_cmp(b.1)).map_or(self.first_touch(), |(time, _)| *time)
    }

    /// First touch, s: the last row before the first one with a force.
    pub fn first_touch(&self) -> f64 {
        let (times, forces) = (self.history.get("time_s"), self.history.get("contact_force_n"));
        let closed = forces.iter().position(|force| *force > 0.0).unwrap_or(0);
        times.get(closed.saturating_sub(1)).copied().unwrap_or(0.0)
    }

    /// End of the first contact, s: the last row before a force-free time of half of it; of bodies that
    /// stay together the last row of all.
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

fn contacts_of(columns: &Columns) -> Vec<ContactAt> {
    let (radii, pressures) = (columns.get("r_m"), columns.get("pressure_pa"));
    let is_node = columns.get("is_node");
    let mut contacts: Vec<ContactAt> = Vec::new();
    let rows = columns.get("time_s").iter().zip(columns.texts("label"));
    for (k, (&time, label)) in rows.enumerate() {
        if contacts.last().is_none_or(|last| last.time != time) {
            let (pressure, at_nodes) = (Vec::new(), Vec::new());
            let (label, gap) = (label.clone(), columns.get("gap_m").get(k).copied());
            let gap = gap.unwrap_or(0.0);
            contacts.push(ContactAt { time, label, gap, pressure, at_nodes });
        }
        let Some(last) = contacts.last_mut() else { continue };
        // The first row without pressure ends the curve.
        let is_over = last.pressure.len() > 1 && last.pressure.last().is_some_and(|p| p.1 == 0.0);
        if !is_over {
            last.pressure.push((radii[k], pressures[k]));
            // Tables of older results have nodes alone.
            if is_node.get(k).is_none_or(|is_node| *is_node == 1.0) {
                last.at_nodes.push((radii[k], pressures[k]));
            }
        }
    }
    contacts
}

fn frames_of(folder: &Path, summary: &Value) -> Vec<Frame> {
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
        Frame { time: file.time, label, path: folder.join(&file.name) }
    };
    series.files.into_iter().map(frame).collect()
}
