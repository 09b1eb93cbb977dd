//! The contact law of one pair as a C header: the template `pair_law.h.txt`, filled.
//!
//! A line `@if NAME` begins lines that a header has only where NAME holds (`@if !NAME`: where it does not), up to its `@end`; `@name@`
//! stands for a value.

use std::collections::{BTreeMap, BTreeSet};

use fem_laws::{ContactSprings, Pair, verlet_impact};
use fem_material::PronyTerm;

/// A C program that checks a compiled law: its impacts, its work under random motions, and its cost.
pub const PAIR_CHECK: &str = include_str!("pair_check.c");
/// The text of all headers.
const TEMPLATE: &str = include_str!("pair_law.h.txt");

/// The texts of all programs beside a header.
const HOSTS: [&str; 2] = [include_str!("hosts.txt"), include_str!("hosts_dem.txt")];

/// The contact law of a pair, the content of its header, SI.
#[derive(Debug, Clone, PartialEq)]
pub struct PairLaw {
    /// Name of the pair, a C identifier.
    pub name: String,
    /// The comment that opens the header, line by line.
    pub head: Vec<String>,
    /// The bodies of the contact.
    pub pair: Pair,
    /// The force that parts the bodies.
    pub repulsion: Repulsion,
    /// Pull-off force, N, and the distance over which it still acts, m; `None` without adhesion.
    pub adhesion: Option<[f64; 2]>,
    /// Speed, restitution and contact time at speeds in equal ratios.
    pub curve: Vec<[f64; 3]>,
}

/// The force that parts the bodies.
#[derive(Debug, Clone, PartialEq)]
pub enum Repulsion {
    /// Elastic bodies: F = K δ^(3/2)/(1 + c₁ √δ + c₂ δ), by K, c₁, c₂ and the largest √δ (m^½) in the denominator.
    Hertz([f64; 4]),
    /// Bodies that relax, a plate, or friction.
    Springs(ContactSprings, Option<ShearSprings>),
    /// Bodies that dent.
    Dents(DentTable),
}

impl Repulsion {
    /// Returns restitution, contact time (s) and largest force (N) of an impact at a speed (m/s) of bodies with an effective mass, kg, in
    /// steps of a time, s, as the compiled header makes them.
    pub fn impact(&self, mass: f64, speed: f64, step: f64) -> [f64; 3] {
        match self {
            Self::Springs(springs, _) => springs.impact(mass, speed, step),
            Self::Hertz([stiffness, first, second, widest]) => {
                verlet_impact(mass, speed, step, |[approach, _]| {
                    let (closed, root) = (approach.max(0.0), approach.max(0.0).sqrt());
                    let near = root.min(*widest);
                    stiffness * closed * root / (1.0 + near * (first + second * near))
                })
            }
            Self::Dents(table) => {
                let mut spot = table.spot(speed);
                verlet_impact(mass, speed, step, |[approach, _]| spot.force(approach))
            }
        }
    }
}

/// The tangential springs beside the normal ones.
#[derive(Debug, Clone, PartialEq)]
pub struct ShearSprings {
    /// Coulomb's coefficient of friction.
    pub friction: f64,
    /// Stiffness of each spring before relaxation, N/m.
    pub stiffnesses: Vec<f64>,
    /// Share of the stiffness that does not relax.
    pub equilibrium_weight: f64,
    /// The relaxing shares.
    pub terms: Vec<PronyTerm>,
}

/// A law that dents, tabulated.
#[derive(Debug, Clone, PartialEq)]
pub struct DentTable {
    /// Stiffness of Hertz' spring up to first yield, N/m^(3/2).
    pub stiffness: f64,
    /// Approach at first yield, m.
    pub yield_approach: f64,
    /// Logarithm of the ratio of neighbouring approaches.
    pub log_ratio: f64,
    /// Logarithm of the force (N), length of the rebound over the approach, and its exponent, from first yield on.
    pub knots: Vec<[f64; 3]>,
    /// Exponent of the flow stress in the speed of first touch, and the speed (m/s) of the table.
    pub rate: [f64; 2],
}

impl DentTable {
    /// Returns an undented spot that bodies first touch at a speed, m/s.
    pub fn spot(&self, speed: f64) -> DentedSpot<'_> {
        let strength = (speed / self.rate[1]).powf(self.rate[0]);
        DentedSpot { table: self, strength, deepest: 0.0, peak: 0.0, length: 0.0, exponent: 1.0 }
    }
}

/// A spot that remembers its dent.
#[derive(Debug, Clone)]
pub struct DentedSpot<'a> {
    table: &'a DentTable,
    strength: f64,
    deepest: f64,
    peak: f64,
    length: f64,
    exponent: f64,
}

impl DentedSpot<'_> {
    /// Returns the force, N, at an approach, m, after all before it.
    pub fn force(&mut self, approach: f64) -> f64 {
        if approach <= 0.0 {
            return 0.0;
        }
        if approach > self.deepest {
            self.press(approach);
            return self.peak;
        }
        let height = (approach - self.deepest) / self.length + 1.0;
        if height > 0.0 { self.peak * height.powf(self.exponent) } else { 0.0 }
    }

    fn press(&mut self, approach: f64) {
        let (scale, table) = (self.strength * self.strength, self.table);
        let unscaled = approach / scale;
        self.deepest = approach;
        if unscaled <= table.yield_approach {
            self.peak = table.stiffness * unscaled.powf(1.5) * scale * self.strength;
            (self.length, self.exponent) = (approach, 1.5);
            return;
        }
        let at = (unscaled / table.yield_approach).ln() / table.log_ratio;
        let low = (at as usize).min(table.knots.len() - 2);
        let share = at - low as f64;
        let between = |k: usize, share: f64| {
            table.knots[low][k] + share * (table.knots[low + 1][k] - table.knots[low][k])
        };
        self.peak = between(0, share).exp() * scale * self.strength;
        self.length = approach * between(1, share.min(1.0));
        self.exponent = between(2, share.min(1.0));
    }
}

impl PairLaw {
    /// Returns the name of the header's file.
    pub fn file_name(&self) -> String {
        format!("pair_{}.h", self.name)
    }

    /// Returns the text of the header.
    pub fn header(&self) -> String {
        self.filled(TEMPLATE)
    }

    /// Returns the programs beside the header, by the names of their files, without those that have no line for this law.
    pub fn hosts(&self) -> Vec<(String, String)> {
        let blocks = HOSTS.iter().flat_map(|hosts| hosts.split("\n@ ").skip(1));
        blocks
            .filter_map(|block| block.split_once('\n'))
            .map(|(name, text)| (self.filled(name).trim().to_string(), self.filled(text)))
            .filter(|(_, text)| !text.trim().is_empty())
            .collect()
    }

    /// Returns a template filled with the values of this law.
    pub fn filled(&self, template: &str) -> String {
        let (flags, values) = (self.flags(), self.values());
        let mut open: Vec<bool> = Vec::new();
        let mut text = String::new();
        for line in template.lines() {
            if let Some(condition) = line.strip_prefix("@if ") {
                open.push(match condition.strip_prefix('!') {
                    Some(name) => !flags.contains(name),
                    None => flags.contains(condition),
                });
            } else if line == "@end" {
                open.pop();
            } else if !open.contains(&false) {
                text += &replaced(line, &values);
                text.push('\n');
            }
        }
        text
    }

    /// Returns the conditions that hold.
    fn flags(&self) -> BTreeSet<&'static str> {
        let mut flags = BTreeSet::new();
        let mut set = |name, holds: bool| {
            flags.extend(Some(name).filter(|_| holds));
        };
        let is_hertz = matches!(self.repulsion, Repulsion::Hertz(_));
        set("sticks", self.adhesion.is_some());
        set("remembers", self.adhesion.is_some() || !is_hertz);
        match &self.repulsion {
            Repulsion::Hertz([_, first, second, _]) => {
                set("hertz", true);
                set("sized", *first != 0.0 || *second != 0.0);
            }
            Repulsion::Springs(springs, shear) => {
                let shears = shear.as_ref().is_some_and(|shear| !shear.terms.is_empty());
                set("springs", true);
                set("relaxing", !springs.terms.is_empty());
                set("plate", springs.plate_mobility > 0.0);
                set("waves", springs.radiation_damping > 0.0);
                set("sloped", springs.radiation_damping + springs.plate_mobility > 0.0);
                set("friction", shear.is_some());
                set("shear_relaxing", shears);
                set("relaxing_or_shear", shears || !springs.terms.is_empty());
            }
            Repulsion::Dents(_) => set("dents", true),
        }
        flags
    }

    /// Returns the bytes of a state in double precision.
    pub fn memory(&self) -> usize {
        let sticks = if self.adhesion.is_some() { 16 } else { 0 };
        match &self.repulsion {
            Repulsion::Hertz(_) => 8 + sticks,
            Repulsion::Dents(_) => 48 + sticks,
            Repulsion::Springs(springs, shear) => {
                let of_shear = shear.as_ref().map_or(0, |shear| 2 * (1 + shear.terms.len()));
                let per_spring = 2 + springs.terms.len() + of_shear;
                let plate = usize::from(springs.plate_mobility > 0.0);
                sticks + 8 * (2 + plate + per_spring * springs.gaps.len())
            }
        }
    }

    fn values(&self) -> BTreeMap<&'static str, String> {
        let [pull_off, reach] = self.adhesion.unwrap_or_default();
        let column = |k: usize| listed(self.curve.iter().map(|point| point[k]));
        let speed = |k: Option<&[f64; 3]>| digits(k.map_or(0.0, |point| point[0]));
        let keeps = match self.repulsion {
            Repulsion::Dents(_) => {
                "The dent stays: call it, and not _begin, where the next contact is at the same spot."
            }
            _ => "The next one may begin at once.",
        };
        let mut values = BTreeMap::from([
            ("name", self.name.clone()),
            ("NAME", self.name.to_uppercase()),
            (
                "head",
                self.head
                    .iter()
                    .map(|line| format!(" * {line}").trim_end().to_string())
                    .collect::<Vec<_>>()
                    .join("\n"),
            ),
            ("memory", self.memory().to_string()),
            ("keeps", keeps.to_string()),
            ("radius", digits(self.pair.effective_radius())),
            ("mass", digits(self.pair.effective_mass())),
            ("modulus", digits(self.pair.contact_modulus())),
            ("reach", digits(reach)),
            ("pull_off", digits(pull_off)),
            ("slow", speed(self.curve.first())),
            ("fast", speed(self.curve.last())),
            ("n_points", self.curve.len().to_string()),
            ("restitutions", column(1)),
            ("times", column(2)),
        ]);
        match &self.repulsion {
            Repulsion::Hertz(numbers) => {
                let keys = ["stiffness", "first", "second", "widest"].into_iter();
                values.extend(keys.zip(numbers.map(digits)));
            }
            Repulsion::Springs(springs, shear) => {
                values.extend(spring_values(springs));
                values.extend(shear.iter().flat_map(shear_values));
            }
            Repulsion::Dents(table) => values.extend(dent_values(table)),
        }
        values
    }
}

fn spring_values(springs: &ContactSprings) -> [(&'static str, String); 9] {
    let ContactSprings { gaps, stiffnesses, terms, .. } = springs;
    [
        ("n_springs", gaps.len().to_string()),
        ("n_terms", terms.len().to_string()),
        ("gaps", listed(gaps.iter().copied())),
        ("stiffnesses", listed(stiffnesses.iter().copied())),
        ("equilibrium", digits(springs.equilibrium_weight)),
        ("weights", in_one_line(terms.iter().map(|term| term.weight))),
        ("rates", in_one_line(terms.iter().map(|term| term.relaxation_time.recip()))),
        ("mobility", digits(springs.plate_mobility)),
        ("waves", digits(springs.radiation_damping)),
    ]
}

fn shear_values(shear: &ShearSprings) -> [(&'static str, String); 6] {
    [
        ("n_shear_terms", shear.terms.len().to_string()),
        ("friction", digits(shear.friction)),
        ("shear_stiffnesses", listed(shear.stiffnesses.iter().copied())),
        ("shear_equilibrium", digits(shear.equilibrium_weight)),
        ("shear_weights", in_one_line(shear.terms.iter().map(|term| term.weight))),
        ("shear_rates", in_one_line(shear.terms.iter().map(|term| term.relaxation_time.recip()))),
    ]
}

fn dent_values(table: &DentTable) -> [(&'static str, String); 7] {
    let row = |knot: &[f64; 3]| format!("    {{{}}}", in_one_line(knot.iter().copied()));
    [
        ("stiffness", digits(table.stiffness)),
        ("yield", digits(table.yield_approach)),
        ("log_ratio", digits(table.log_ratio)),
        ("n_knots", table.knots.len().to_string()),
        ("rate_power", digits(table.rate[0])),
        ("rate_speed", digits(table.rate[1])),
        ("dents", table.knots.iter().map(row).collect::<Vec<_>>().join(",\n")),
    ]
}

/// Returns a line with its values; a name without one stays.
fn replaced(line: &str, values: &BTreeMap<&'static str, String>) -> String {
    let mut parts = line.split('@').enumerate().peekable();
    let mut text = String::new();
    while let Some((k, part)) = parts.next() {
        text += match values.get(part) {
            Some(value) if k % 2 == 1 && parts.peek().is_some() => value,
            _ => part,
        };
    }
    text
}

/// Returns a number as C reads it, in ten digits.
fn digits(value: f64) -> String {
    if value.is_finite() { format!("{value:.9e}") } else { "INFINITY".to_string() }
}

fn in_one_line(values: impl Iterator<Item = f64>) -> String {
    values.map(digits).collect::<Vec<_>>().join(", ")
}

/// Returns numbers as rows of six.
fn listed(values: impl Iterator<Item = f64>) -> String {
    let values: Vec<String> = values.map(digits).collect();
    let rows = values.chunks(6).map(|row| format!("    {}", row.join(", ")));
    rows.collect::<Vec<_>>().join(",\n")
}
