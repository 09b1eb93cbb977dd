//! The contact law of `fem-run export --law`, compiled by `cc`, for random pairs: its impacts beside the model that it stands for, and
//! random motions.
//!
//! `e.N`, `time.N` and `force.N` are the largest errors at N steps per contact, those of T and F relative, over `pairs` pairs and five
//! speeds over two decades; bodies are half-spaces to the contact. `size.e` is that of e at 100 steps where finite size counts,
//! over the loss 1 − e and the largest a/R. `gain` and `gain_across` are the largest work that `walks` further pairs give to a random motion of `steps`
//! steps, along the axis and across it, over the largest work that they have taken.

use std::path::Path;
use std::process::{Command, Stdio};

use fem::Case;
use fem::fit::dem::{PAIR_CHECK, PairLaw, Repulsion};
use fem::laws::LawExport;
use rayon::prelude::*;
use serde::Deserialize;

use crate::{Findings, Laboratory, StudyError};

/// Steps per contact.
const STEPS: [usize; 3] = [200, 100, 50];
/// Every so many points of a law's curve are five speeds.
const STRIDE: usize = 4;

#[derive(Deserialize)]
struct Parameters {
    pairs: u64,
    walks: u64,
    steps: f64,
}

pub fn study(laboratory: &Laboratory) -> Result<Findings, StudyError> {
    let parameters: Parameters = laboratory.parameters()?;
    let folder = tempfile::tempdir().map_err(|error| StudyError::parameters(error.to_string()))?;
    let mut findings = Findings::new();
    let found: Vec<[[f64; 3]; 3]> = (0..parameters.pairs)
        .into_par_iter()
        .map(|seed| impacts(folder.path(), &pair(seed, false)?))
        .collect::<Result<_, StudyError>>()?;
    for (n, steps) in STEPS.iter().enumerate() {
        for (k, quantity) in ["e", "time", "force"].into_iter().enumerate() {
            let worst = found.iter().map(|errors| errors[n][k]).fold(0.0, f64::max);
            findings.measure(format!("{quantity}.{steps}"), worst);
        }
    }
    let sized: Vec<f64> = (0..parameters.pairs)
        .into_par_iter()
        .map(|seed| {
            let export = pair(seed, true)?;
            let errors = impacts(folder.path(), &export)?;
            let loss = export.law.curve.iter().map(|[_, e, _]| 1.0 - e).fold(0.0, f64::max);
            Ok((errors[1][0] - 0.001).max(0.0) / (loss * export.contact_ratio))
        })
        .collect::<Result<_, StudyError>>()?;
    findings.measure("size.e", sized.into_iter().fold(0.0, f64::max));
    let gains: Vec<[f64; 2]> = (0..parameters.walks)
        .into_par_iter()
        .map(|seed| {
            walk(folder.path(), &pair(10_000 + seed, seed % 2 == 0)?, seed, parameters.steps)
        })
        .collect::<Result<_, StudyError>>()?;
    for (k, quantity) in ["gain", "gain_across"].into_iter().enumerate() {
        findings.measure(quantity, gains.iter().map(|gain| gain[k]).fold(0.0, f64::max));
    }
    let header = ["kind of pair", "pairs", "200 steps", "100 steps", "50 steps"];
    let rows = KINDS.iter().enumerate().map(|(kind, name)| {
        let own: Vec<_> = found.iter().skip(kind).step_by(KINDS.len()).collect();
        let worst = |n: usize| {
            let largest = |k: usize| own.iter().map(|errors| errors[n][k]).fold(0.0, f64::max);
            let [e, time, force] = [largest(0), 100.0 * largest(1), 100.0 * largest(2)];
            format!("{e:.5}, {time:.2} %, {force:.2} %")
        };
        [name.to_string(), own.len().to_string(), worst(0), worst(1), worst(2)]
    });
    findings.tabulate("Largest errors of e, T and F.", header, rows);
    Ok(findings)
}

/// The kinds of pairs, in turn.
const KINDS: [&str; 6] = [
    "relaxing, shear",
    "relaxing, all",
    "relaxing, rubbing",
    "elastic",
    "denting",
    "elastic, on a plate",
];

/// Random numbers, the same on every machine.
struct Random(u64);

impl Random {
    fn between(&mut self, low: f64, high: f64) -> f64 {
        self.0 =
            self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        low + (high - low) * (self.0 >> 11) as f64 / (1u64 << 53) as f64
    }

    fn power_of_ten(&mut self, low: f64, high: f64) -> f64 {
        10f64.powf(self.between(low, high))
    }
}

/// Returns the law of a random pair.
fn pair(seed: u64, finite_size: bool) -> Result<LawExport, StudyError> {
    let mut random = Random(seed.wrapping_mul(0x9e37_79b9_7f4a_7c15) + 1);
    (0..8).for_each(|_| _ = random.between(0.0, 1.0));
    let kind = (seed % KINDS.len() as u64) as usize;
    let (modulus, density) = (random.power_of_ten(6.0, 11.3), random.power_of_ten(2.7, 3.9));
    let (nu, diameter) = (random.between(0.05, 0.48), random.power_of_ten(-4.0, -1.3));
    let partner = diameter * random.between(0.5, 3.0);
    // Hertz' contact on a wall has (a/R)⁵ = 3.93 ρv²(1 − ν²)/E.
    let ratio: f64 = random.between(0.01, 0.035);
    let speed = (modulus * ratio.powi(5) / (3.93 * density)).sqrt();
    let time = 1.5 * diameter * ratio * ratio / speed;
    let mut material =
        format!("density = {density:e}\nyoungs_modulus = {modulus:e}\npoissons_ratio = {nu}\n");
    match kind {
        0..=2 => {
            let n_terms = random.between(1.0, 7.0) as usize;
            let whole = random.between(0.05, 0.9) / n_terms as f64;
            let terms = (0..n_terms).map(|_| {
                let relaxation_time = time * random.power_of_ten(-2.0, 2.0);
                format!("{{ weight = {whole}, relaxation_time = {relaxation_time:e} }}")
            });
            let terms = terms.collect::<Vec<_>>().join(", ");
            let acts_on = if kind == 0 { "shear" } else { "all" };
            material += &format!("relaxation = {{ acts_on = '{acts_on}', terms = [{terms}] }}\n");
        }
        4 => {
            let strength = modulus * random.power_of_ten(-3.0, -2.0);
            material += &format!("yield_strength = {strength:e}\nflow = {{}}\n");
        }
        _ => material += "elastic = true\n",
    }
    let lower = match kind {
        5 => format!(
            "plate = {{ thickness = {:e} }}\nmaterial = 'm'",
            diameter * random.between(0.25, 0.6)
        ),
        _ => format!("sphere.diameter = {partner:e}\nmaterial = 'm'"),
    };
    let friction = if kind == 2 { random.between(0.05, 1.0) } else { 0.0 };
    let model = match kind {
        0..=2 => format!("[model.ting]\nfinite_size = {finite_size}\n"),
        _ => format!("[model.hertz]\nfinite_size = {finite_size}\n"),
    };
    let text = format!(
        "[material.m]\n{material}\n[[body]]\nname = 'lower'\n{lower}\n[[body]]\nname = 'ball'\nsphere.diameter = {diameter:e}\n\
         material = 'm'\napproach_speed = {speed:e}\n[contact]\nfriction = {friction}\n{model}"
    );
    let case = Case::parse("pair.toml", &text, Path::new("."), &[])?;
    LawExport::of(&case, &format!("{}_{finite_size}", seed), None, true)
        .map_err(|error| StudyError::parameters(format!("pair {seed}: {error}\n{text}")))
}

/// Compiles the program of checks with a law and returns the numbers that it writes.
fn checked(
    folder: &Path,
    law: &PairLaw,
    words: &[String],
    input: &str,
) -> Result<Vec<Vec<f64>>, StudyError> {
    let failed = |error: std::io::Error| StudyError::parameters(format!("cc: {error}"));
    let [header, source, program] = [law.file_name(), format!("{}.c", law.name), law.name.clone()]
        .map(|name| folder.join(name));
    std::fs::write(&header, law.header()).map_err(failed)?;
    std::fs::write(&source, PAIR_CHECK).map_err(failed)?;
    let mut command = Command::new("cc");
    command.args(["-std=c99", "-Wall", "-Wextra", "-pedantic", "-Werror", "-O1", "-include"]);
    command
        .arg(&header)
        .arg(format!("-DPAIR=pair_{}", law.name))
        .arg(&source)
        .arg("-o")
        .arg(&program);
    if matches!(law.repulsion, Repulsion::Springs(_, Some(_))) {
        command.arg("-DFRICTION");
    }
    let compiled = command.arg("-lm").output().map_err(failed)?;
    if !compiled.status.success() {
        return Err(StudyError::parameters(String::from_utf8_lossy(&compiled.stderr)));
    }
    let file = header.with_extension("txt");
    std::fs::write(&file, input).map_err(failed)?;
    let input = std::fs::File::open(&file).map_err(failed)?;
    let output =
        Command::new(&program).args(words).stdin(Stdio::from(input)).output().map_err(failed)?;
    for path in [&header, &source, &program, &file] {
        std::fs::remove_file(path).map_err(failed)?;
    }
    let text = String::from_utf8_lossy(&output.stdout);
    let numbers =
        |line: &str| line.split(' ').map(|word| word.parse().unwrap_or(f64::NAN)).collect();
    Ok(text.lines().map(numbers).collect())
}

/// Returns the largest errors of e, and of T and F relative, by the numbers of steps.
fn impacts(folder: &Path, export: &LawExport) -> Result<[[f64; 3]; 3], StudyError> {
    let points = || export.law.curve.iter().zip(&export.impacts).step_by(STRIDE);
    let parting = || points().filter(|(_, impact)| impact.contact_time.is_finite());
    let line = |n: usize| {
        parting().map(move |(point, impact)| {
            format!("{:e} {:e}\n", point[0], impact.contact_time / n as f64)
        })
    };
    let input: String = STEPS.iter().flat_map(|n| line(*n)).collect();
    let rows = checked(folder, &export.law, &["impacts".to_string()], &input)?;
    let mut errors = [[0.0f64; 3]; 3];
    let all = (0..STEPS.len()).flat_map(|n| parting().map(move |(_, impact)| (n, impact)));
    for ((n, impact), row) in all.zip(rows) {
        let [e, time, force] = [row[0], row[1], row[2]];
        let own = [
            (e - impact.restitution).abs(),
            (time / impact.contact_time - 1.0).abs(),
            (force / impact.peak_force - 1.0).abs(),
        ];
        for (worst, own) in errors[n].iter_mut().zip(own) {
            *worst = if own.is_nan() { own } else { worst.max(own) };
        }
    }
    Ok(errors)
}

/// Returns the gains of a random motion along the axis and across it.
fn walk(folder: &Path, export: &LawExport, seed: u64, steps: f64) -> Result<[f64; 2], StudyError> {
    let middle = export.law.curve.len() / 2;
    let (speed, impact) = (export.law.curve[middle][0], &export.impacts[middle]);
    let numbers =
        [steps, seed as f64, impact.max_approach, 1.5 * impact.max_approach / speed, 3.0 * speed];
    let words = ["walk".to_string()].into_iter().chain(numbers.iter().map(|it| format!("{it:e}")));
    let rows = checked(folder, &export.law, &words.collect::<Vec<_>>(), "")?;
    let row = rows
        .first()
        .ok_or_else(|| StudyError::parameters(format!("the walk of pair {seed} has no result")))?;
    Ok([-row[0], -row[1]])
}
