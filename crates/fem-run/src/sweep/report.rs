//! Messages of a sweep: before it begins, when it is done, and how it ends.

use std::path::Path;

use comfy_table::CellAlignment::{Left, Right};
use fem::sweep::{Checked, Row, SWEEP_FILE};
use fem::{WarningKind, WarningKinds};
use fem_case::{Keep, Sweep};
use fem_collision::QuantityOfInterest;
use fem_report::answer::answer;

use super::collect::SweepOutcome;
use super::cost_estimate::{SweepCost, TotalTime};
use super::member_store::LINE_BYTES;
use crate::forecast::{estimated, estimated_time};
use crate::text::run_report::tangential_text;
use crate::text::{Failure, one_line, shown, standard_output, table};

pub fn announce(
    name: &str,
    sweep: &Sweep,
    checked: &Checked,
    expected: &SweepCost,
    n_own: usize,
    n_threads: usize,
) {
    let n_members = sweep.n_members();
    let n_left = checked.left.len();
    let shard = if n_own == n_members { String::new() } else { format!(", {n_own} in this shard") };
    let name = one_line(name);
    let time = match n_left {
        0 => String::new(),
        _ => {
            let on_threads = |total: TotalTime| estimated_time(total.on(n_threads));
            let most = expected.most.map_or(String::new(), |most| {
                format!(", up to {} if meshes have to be refined", on_threads(most))
            });
            format!(", about {} on {n_threads} threads{most}", on_threads(expected.all))
        }
    };
    let kept = match sweep.keep {
        Keep::Packed if n_left > 0 => {
            format!("; one file of summaries, about {}", member_file_size(n_left))
        }
        _ => String::new(),
    };
    let n_done = n_own - n_left;
    let text = format!(
        "{name}: {n_members} members{shard}; {n_done} already done, {n_left} to run{time}{kept}"
    );
    standard_output::tell("", &text);
    checked.advice.iter().for_each(|advice| standard_output::tell("hint: ", advice));
}

pub fn member_file_size(n_members: usize) -> String {
    estimated((LINE_BYTES * n_members as u64) as f64, "B")
}

pub fn report(sweep: &Sweep, collected: &SweepOutcome, n_members: usize, folder: &Path) -> String {
    let keys: Vec<&str> = sweep.keys().map(|swept| swept.key.as_str()).collect();
    let keys = keys.iter().map(|key| shortest_end(key, &keys));
    let is_oblique = collected.shown.iter().any(|row| tangential(row, TANGENTIAL[1]).is_some());
    let names = match is_oblique {
        true => ["restitution", TANGENTIAL[0][0], TANGENTIAL[1][0]],
        false => SHOWN.map(QuantityOfInterest::name),
    };
    let header: Vec<String> = keys.chain(names).map(one_line).collect();
    let row = |row: &Row| {
        let said = sweep.displayed(row.index);
        let mut cells: Vec<String> = said.iter().map(|value| one_line(value)).collect();
        cells.extend(result_cells(row, is_oblique));
        cells
    };
    let mut alignment = vec![Left; sweep.keys().count()];
    alignment.extend([Right; SHOWN.len()]);
    let rows = collected.shown.iter().map(row);
    let mut text = table(&alignment, std::iter::once(header).chain(rows));
    text += &legend(&text);
    let (n_done, n_shown) = (collected.n_done, collected.shown.len());
    if n_done > n_shown {
        text += &format!("… and {} more\n", n_done - n_shown);
    }
    if n_done < n_members {
        text += &format!("\n{n_done} of {n_members} members are done.\n");
    }
    text + &format!("\nResult: {}\n", shown(&folder.join(SWEEP_FILE)))
}

/// Returns the last parts of a dotted key that no other of the keys ends with: `approach_speed`.
fn shortest_end<'k>(key: &'k str, keys: &[&str]) -> &'k str {
    let is_unique = |end: &&str| {
        let is_end = |other: &&&str| {
            other.strip_suffix(*end).is_some_and(|rest| rest.is_empty() || rest.ends_with('.'))
        };
        keys.iter().filter(is_end).count() == 1
    };
    let dots = key.rmatch_indices('.').map(|(at, _)| &key[at + 1..]);
    dots.chain([key]).find(is_unique).unwrap_or(key)
}

/// The quantities in the table of a terminal of 80 columns.
const SHOWN: [QuantityOfInterest; 3] = [
    QuantityOfInterest::Restitution,
    QuantityOfInterest::ContactTime,
    QuantityOfInterest::PeakForce,
];

/// The quantities of oblique impacts that take the places of contact time and force, which friction does not alter: name, key and unit.
const TANGENTIAL: [[&str; 3]; 2] =
    [["e_t", "tangential_restitution", ""], ["patch", "contact_patch_rebound_deg", "°"]];

fn result_cells(row: &Row, is_oblique: bool) -> [String; SHOWN.len()] {
    const NONE: &str = "-";
    if !row.is_complete() {
        return ["failed", NONE, NONE].map(String::from);
    }
    let axial = SHOWN.map(|quantity| answer(&row.summary, quantity));
    let [restitution, ..] = &axial;
    let cells = match is_oblique {
        true => {
            [restitution.clone(), tangential(row, TANGENTIAL[0]), tangential(row, TANGENTIAL[1])]
        }
        false => axial,
    };
    cells.map(|cell| cell.unwrap_or(NONE.into()))
}

fn tangential(row: &Row, [_, key, unit]: [&str; 3]) -> Option<String> {
    let parts = serde_json::from_value(row.summary["uncertainty"][key].clone()).unwrap_or_default();
    Some(tangential_text(row.summary[key].as_f64()?, &parts, unit))
}

/// Returns the lines below the table that explain its signs.
fn legend(cells: &str) -> String {
    let signs = [
        ("± ?", "unknown error"),
        ("≤", "upper bound, since a loss is unknown"),
        ("≥", "lower bound, since a loss is unknown"),
        (" (", "measured value before a bound"),
    ];
    let bar = ("±", "discretisation error, neglected effects and uncertain inputs");
    let there = [bar].into_iter().chain(signs).filter(|(sign, _)| cells.contains(sign));
    let lines: Vec<String> = there.map(|(sign, words)| format!("{sign}: {words}\n")).collect();
    lines.concat()
}

/// Concludes a sweep: an error lists the failed members, or says how to continue an interrupted sweep.
pub fn conclude(
    collected: &SweepOutcome,
    n_own: usize,
    is_interrupted: bool,
) -> Result<(), Failure> {
    let SweepOutcome { n_own_done, n_failed, failed, .. } = collected;
    if is_interrupted && *n_own_done < n_own {
        let message = format!("interrupted: {n_own_done} of {n_own} members are done");
        return Err(Failure::interrupted(message)
            .with_help("they are kept; the same command continues with the others"));
    }
    if *n_failed == 0 {
        return Ok(());
    }
    let mut lines = failed.join("\n");
    if failed.len() < *n_failed {
        lines += &format!("\n… and {} more", n_failed - failed.len());
    }
    Err(Failure::failed(format!("{n_failed} of {n_own} members failed")).with_help(format!(
        "{lines}\nthe others are done. Run a failed one alone with --set to see the cause and the remedy, or \
         correct its value in the sweep file and repeat the command; finished members are kept"
    )))
}

const MAX_KINDS: usize = 20;

/// Returns one line per kind, the most frequent first, and the number of kinds left out. Kinds that were
/// printed `before` are skipped.
pub fn warning_lines(warnings: &WarningKinds, sweep: &Sweep, before: &WarningKinds) -> Vec<String> {
    let is_new = |kind: &&WarningKind| !before.all().iter().any(|known| kind.is_of(&known.first));
    let mut kinds: Vec<&WarningKind> = warnings.all().iter().filter(is_new).collect();
    kinds.sort_by_key(|kind| std::cmp::Reverse(kind.count));
    let line = |kind: &&WarningKind| {
        let (text, first) = (&kind.first, sweep.describe(kind.run));
        one_line(&match kind.count {
            1 => format!("{text} (1 member: {first})"),
            n => {
                let last = sweep.describe(kind.last_run);
                format!("{} (in {n} members, first in {first}, last in {last})", kind.merged())
            }
        })
    };
    let mut lines: Vec<String> = kinds.iter().take(MAX_KINDS).map(line).collect();
    let n_omitted = kinds.len().saturating_sub(MAX_KINDS) + warnings.n_others();
    if n_omitted > 0 {
        lines.push(format!("… and {n_omitted} more, in the column `warnings` of sweep.csv"));
    }
    lines
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn keys_are_named_by_their_shortest_unique_end() {
        let keys = ["body.0.approach_speed", "body.0.sphere.diameter", "body.1.sphere.diameter"];
        let short: Vec<&str> = keys.iter().map(|key| shortest_end(key, &keys)).collect();
        assert_eq!(short, ["approach_speed", "0.sphere.diameter", "1.sphere.diameter"]);
        let quoted = ["material.glass.youngs_modulus", "mesh.growth"];
        assert_eq!(shortest_end(quoted[1], &quoted), "growth");
    }
}
