//! Input for codes of the discrete element method, and the restitution that each code makes of it.
//!
//! Codes interpret an entered restitution in four ways:
//!
//! - The contact ends at zero overlap, and the dashpot pulls at the end: LAMMPS without `limit_damping`, LIGGGHTS
//!   without `limitForce on`, MercuryDPM, Lethe, MFIX-DEM.
//! - The contact ends at zero force: YADE, MuJoCo, Drake, and LAMMPS and LIGGGHTS with those keywords.
//! - The dashpot acts in the approach only: Newton.
//! - An approximate formula: LAMMPS' `tsuji`, YADE's Hertz–Mindlin `en`, MFIX's `HERTZIAN`.
//!
//! `entries` has the formulas of each code and their sources, `friction` those of tangential forces, `snippets.txt` the texts.

mod entries;
mod friction;
mod grains;
mod pair_law;

pub use entries::{
    TsujiVersion, characteristic_velocity, dissipation_of, fit_dissipation, fit_springs,
    hertz_mindlin_entry, hooke_stiffness, mfix_entry, mfix_outcome, newton_entry, restitution_of,
    tsuji_entry, tsuji_outcome, viscel_entry, viscoelastic_damping, yade_betan,
};
pub use friction::{FittedFriction, FrictionLaw, PatchRebound};
pub use grains::{Grain, PairOfGrains, grain_snippets, grouped};
pub use pair_law::{DentTable, DentedSpot, PAIR_CHECK, PairLaw, Repulsion, ShearSprings};

use std::collections::BTreeMap;

use fem_laws::laws::{linear_from_restitution, zhang_whiten_coefficient};
use fem_laws::{EndRule, LawError, LawFamily, Pair};
use fem_material::Material;
use fem_material::engineering::number;

/// The texts of all snippets, whose format stands at their beginning.
const SNIPPETS: &str = include_str!("snippets.txt");
/// The contact laws that each code has; one restitution for all speeds is `tsuji` on Hertz' spring and `linear` on a linear one.
pub const CODE_LAWS: [(&str, &[LawFamily]); 9] = [
    (
        "lammps",
        &[LawFamily::Tsuji, LawFamily::KuwabaraKono, LawFamily::HertzDashpot, LawFamily::Mdr],
    ),
    ("liggghts", &[LawFamily::Tsuji, LawFamily::Linear, LawFamily::Luding]),
    ("yade", &[LawFamily::Tsuji, LawFamily::Linear, LawFamily::Luding]),
    ("mercurydpm", &[LawFamily::Tsuji, LawFamily::Linear, LawFamily::Luding]),
    ("lethe", &[LawFamily::Tsuji]),
    ("mfix-dem", &[LawFamily::Tsuji, LawFamily::Linear]),
    ("drake", &[LawFamily::HuntCrossley]),
    ("mujoco", &[LawFamily::Linear]),
    ("newton", &[LawFamily::Linear]),
];
/// Name of the table of the confidence band, beside the snippets.
pub const BAND_FILE: &str = "restitution_band.csv";
/// Longest line of a comment, in characters.
const LONGEST_LINE: usize = 110;
/// The comment for codes that use the entries of 1 and 2 for 1 with 1 and 2 with 2 too.
const UNLIKE: &str = "# Fitted for contacts of 1 with 2 alone: 1 with 1 and 2 with 2 are other pairs, which want an\n\
                      # export each; all at once: fem-run export CASE --diameters D1,D2.\n";

/// A sphere, SI.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Sphere {
    /// Diameter D, m.
    pub diameter: f64,
    /// Density ρ, kg/m³.
    pub density: f64,
    /// Instantaneous Young's modulus, Pa.
    pub youngs_modulus: f64,
    /// Poisson's ratio ν.
    pub poissons_ratio: f64,
}

/// A law whose restitution depends on speed, fitted to the data.
#[derive(Debug, Clone, PartialEq)]
pub struct LawOfSpeed {
    /// The name of its family: `kuwabara_kono` (A, s), `hertz_dashpot` (c, N s/m), `luding` (k_p/k₁, k₁ in N/m, φ_f), `mdr` (yield
    /// strength in Pa, Poisson's ratio), or `hunt_crossley` on a linear spring, as Drake has it (d, s/m, and the rms error of e).
    pub name: &'static str,
    /// Values of its parameters, SI.
    pub values: Vec<f64>,
    /// Range of speeds in which e is valid: from, to, m/s; and its largest error over all data.
    pub validity: [f64; 3],
}

/// The fitted laws and the data they were fitted to: the content of all snippets.
#[derive(Debug, Clone, PartialEq)]
pub struct Export {
    /// The origin of the laws, one line.
    pub title: String,
    /// The two spheres, or the one that strikes a rigid wall.
    pub spheres: Vec<Sphere>,
    /// The spheres as a pair.
    pub pair: Pair,
    /// Smallest and largest speed of the data, m/s.
    pub speeds: (f64, f64),
    /// Largest error of e inside a range of validity.
    pub tolerance: f64,
    /// e of the laws with one restitution for all speeds: Hertz' and the linear spring.
    pub restitution: f64,
    /// T of the linear law, s.
    pub contact_time: f64,
    /// Range of speeds in which that e is valid: from, to, m/s; and its largest error over all data.
    pub validity: [f64; 3],
    /// The laws whose restitution depends on speed, as far as they can make the loss.
    pub of_speed: Vec<LawOfSpeed>,
    /// The speeds at which e is an upper bound, with the reasons; empty if it is none.
    pub bounds: Vec<String>,
    /// Other comments on e, such as the speeds that are left out.
    pub notes: Vec<String>,
    /// Confidence level and largest half-width of the band of a fitted e(v).
    pub band: Option<(f64, f64)>,
    /// Friction of the contact; `None` without it.
    pub friction: Option<Friction>,
}

/// Friction of the contact, and what each file makes of it.
#[derive(Debug, Clone, PartialEq)]
pub struct Friction {
    /// The rebound of the patch.
    pub rebound: PatchRebound,
    /// The tangential law of each file, by its name.
    pub fitted: BTreeMap<&'static str, FittedFriction>,
}

/// The laws of a file.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Head {
    /// Name of the file.
    pub name: &'static str,
    /// The code it is for.
    pub code: &'static str,
    /// The model in the code's own words.
    pub model: &'static str,
    /// The model in the heading of the file.
    title: &'static str,
    /// The name of the normal law's family, or `constant`.
    pub law: &'static str,
    /// Whether a normal law with one restitution is linear.
    pub is_linear: bool,
    /// Names and values of what decides on the loss, as text.
    entries: &'static str,
    /// The tangential law, with the factor on its stiffness if the code leaves no choice; `None` if it is not known for the normal law.
    pub friction: Option<(FrictionLaw, Option<f64>)>,
}

/// A file for a DEM code.
#[derive(Debug, Clone, PartialEq)]
pub struct Snippet {
    /// Name of the file.
    pub name: &'static str,
    /// The code it is for.
    pub code: &'static str,
    /// The model in the code's own words.
    pub model: &'static str,
    /// The name of the law's family, or `constant`.
    pub law: &'static str,
    /// Name and value of the numbers that decide on the loss.
    pub entries: Vec<(&'static str, f64)>,
    /// The restitution that it makes; `None` if it depends on speed.
    pub restitution: Option<f64>,
    /// From, to (m/s), largest error of e over all data.
    pub validity: [f64; 3],
    /// The whole text.
    pub text: String,
}

/// The values of placeholders, by name.
#[derive(Default)]
struct Values {
    numbers: BTreeMap<&'static str, f64>,
    words: BTreeMap<String, String>,
}

/// What the lines of a block have made so far.
#[derive(Default)]
struct Lines {
    notes: String,
    commands: String,
}

impl Head {
    /// Returns the head of a block; `None` of a block that others insert.
    fn of(text: &'static str) -> Option<Self> {
        let parts: Vec<&str> = text.split(" | ").collect();
        let [name, code, model, title, law, entries, friction] = parts[..] else { return None };
        let (law, is_linear) = match law.split_once(' ') {
            Some((law, _)) => (law, true),
            None => (law, false),
        };
        let (word, given) = friction.split_once(' ').unwrap_or((friction, ""));
        let friction = FrictionLaw::of_word(word).map(|law| (law, given.parse().ok()));
        Some(Self { name, code, model, title, law, is_linear, entries, friction })
    }
}

impl Sphere {
    /// Creates a sphere of a diameter, m, and a material, with its instantaneous moduli.
    pub fn new(diameter: f64, material: &Material) -> Self {
        Self {
            diameter,
            density: material.density(),
            youngs_modulus: material.instantaneous().youngs_modulus(),
            poissons_ratio: material.instantaneous().poissons_ratio(),
        }
    }

    /// Returns diameter, density, Young's modulus and Poisson's ratio as text.
    fn texts(&self) -> [String; 4] {
        [self.diameter, self.density, self.youngs_modulus, self.poissons_ratio].map(short)
    }
}

impl Values {
    /// Fills the placeholders of a line; `None` if one has no value.
    fn fill(&self, line: &str) -> Option<String> {
        let mut text = String::new();
        for (k, part) in line.split(['{', '}']).enumerate() {
            let (name, format) = part.split_once(':').unwrap_or((part, ""));
            text += &match (self.words.get(name), format) {
                _ if k % 2 == 0 => part.to_string(),
                (Some(word), _) => word.clone(),
                (None, "") => short(*self.numbers.get(name)?),
                (None, "4") => format!("{:.4}", self.numbers.get(name)?),
                (None, "6e") => format!("{:.6e}", self.numbers.get(name)?),
                (None, unit) => format!("{} {unit}", number(*self.numbers.get(name)?, 4)),
            };
        }
        Some(text)
    }

    /// Sets the words for a sphere with its number from 1; `suffix` ends their names.
    fn set_sphere(&mut self, number: usize, sphere: &Sphere, suffix: &str) {
        let names = ["diameter", "density", "young", "poisson"].into_iter().zip(sphere.texts());
        let numbers = [("i", number.to_string()), ("i0", (number - 1).to_string())];
        let words = names.chain(numbers);
        self.words.extend(words.map(|(name, text)| (format!("{name}{suffix}"), text)));
    }
}

impl Export {
    /// Returns the input of all codes.
    ///
    /// # Errors
    /// Numbers that a code's formula does not take.
    pub fn snippets(&self) -> Result<Vec<Snippet>, LawError> {
        let (numbers, words) = (self.numbers()?, self.words());
        let mut snippets = Vec::new();
        for (head, body) in blocks() {
            let Some(head) = Head::of(head) else { continue };
            let Head { name, code, model, title, law, entries, .. } = head;
            let mut values = Values { numbers: numbers.clone(), words: words.clone() };
            values.numbers.extend(self.friction_numbers(&head, &numbers));
            let mut lines = Lines::default();
            let is_filled = self.add_lines(body, &mut values, &mut lines).is_some();
            let entries = entries.split("; ").filter_map(|entry| {
                let (key, name) = entry.split_once(" = ")?;
                Some((key, *values.numbers.get(name)?))
            });
            if !is_filled || lines.commands.is_empty() {
                continue;
            }
            let of_speed = self.of_speed(law);
            let restitution = of_speed.is_none().then_some(self.restitution);
            let validity = of_speed.map_or(self.validity, |fitted| fitted.validity);
            let notes = lines.notes + &self.friction_note(&head);
            let heading = self.heading(&format!("{code}, {title}"), validity, &notes);
            let text = match name.rsplit_once('.').map_or("", |(_, ending)| ending) {
                "cpp" => slashed(&heading) + &lines.commands.replace(UNLIKE, &slashed(UNLIKE)),
                "xml" => format!("<!--\n{}-->\n{}", heading.replace("--", "-"), lines.commands),
                "usda" => "#usda 1.0\n".to_string() + &heading + &lines.commands,
                _ => heading + &lines.commands,
            };
            let entries = entries.collect();
            snippets.push(Snippet { name, code, model, law, entries, restitution, validity, text });
        }
        Ok(snippets)
    }

    /// Returns the fitted law of a family; `None` of one with one restitution for all speeds, or one that cannot make the loss.
    pub fn of_speed(&self, family: &str) -> Option<&LawOfSpeed> {
        self.of_speed.iter().find(|law| law.name == family)
    }

    /// Adds the lines of a block that apply to these spheres; `None` if a value does not exist.
    fn add_lines(&self, body: &'static str, values: &mut Values, lines: &mut Lines) -> Option<()> {
        let (is_wall, is_equal) = (self.spheres.len() < 2, self.is_equal());
        let is_word = |word: &str| word.chars().all(|c| c.is_ascii_lowercase() || c == ' ');
        let split = |line: &'static str| match line.split_once('|') {
            Some((condition, text)) if is_word(condition) => (condition, text),
            _ => ("", line),
        };
        let all: Vec<(&str, &str)> = body.trim_end().lines().map(split).collect();
        for group in all.chunk_by(|one, next| one.0 == next.0) {
            let applies = |word: &str| match word {
                "wall" => is_wall,
                "two" => !is_wall,
                "equal" => is_equal,
                "other" => !is_equal,
                "unlike" => !is_wall && !is_equal,
                "friction" => self.friction.is_some(),
                "smooth" => self.friction.is_none(),
                _ => true,
            };
            let condition = group[0].0;
            if !condition.split(' ').all(applies) {
                continue;
            }
            let n_repeats = match condition.split(' ').next() {
                Some("kinds") if is_equal => 1,
                Some("each" | "kinds") => self.spheres.len(),
                _ => 1,
            };
            for repeat in 0..n_repeats {
                values.set_sphere(repeat + 1, &self.spheres[repeat], "");
                for (_, line) in group {
                    match (condition.rsplit(' ').next().unwrap_or(""), line.strip_prefix("> ")) {
                        ("let", _) => {
                            let (name, text) = line.split_once(" = ")?;
                            let text = values.fill(text)?;
                            values.words.insert(name.to_string(), text);
                        }
                        ("note", _) => lines.notes += &format!("# {}\n", values.fill(line)?),
                        ("unlike", _) if line.is_empty() => lines.commands += UNLIKE,
                        (_, Some(name)) => {
                            let (_, body) = blocks().find(|(head, _)| *head == name)?;
                            self.add_lines(body, values, lines)?;
                        }
                        _ => lines.commands += &(values.fill(line)? + "\n"),
                    }
                }
            }
        }
        Some(())
    }

    /// Returns the numbers that snippets can contain.
    fn numbers(&self) -> Result<BTreeMap<&'static str, f64>, LawError> {
        let Self { pair, restitution: e, contact_time: time, .. } = self;
        let (mass, modulus) = (pair.effective_mass(), pair.contact_modulus());
        let linear = |end_rule| linear_from_restitution(pair, *e, *time, end_rule);
        let stiffness = linear(EndRule::ZeroOverlap)?.stiffness();
        let poissons_ratio = self.spheres[0].poissons_ratio;
        let mut numbers = BTreeMap::from([
            ("e", *e),
            ("time", *time),
            ("stiffness", stiffness),
            ("velocity", characteristic_velocity(pair, stiffness)),
            ("contact_modulus", modulus),
            ("twice_plane_modulus", 2.0 * (1.0 - poissons_ratio.powi(2)) * modulus),
            ("twice_mass", 2.0 * mass),
            ("wall_modulus", self.wall_modulus()),
            ("slow", self.speeds.0),
            ("fast", self.speeds.1),
            ("mujoco_step", time / 100.0),
        ]);
        numbers.extend(tsuji_entry(*e, TsujiVersion::Plain).map(|entry| ("tsuji", entry)));
        numbers.extend(mfix_entry(*e).map(|entry| ("mfix_en", entry)));
        if self.spheres.len() == 2 {
            let en = hertz_mindlin_entry(pair, *e)?;
            // Tsuji's α over √(m* K) is β_n of √(m* S), K = ⅔S.
            let betan = zhang_whiten_coefficient(*e)? / 6f64.sqrt();
            numbers.extend([("mindlin_en", en), ("mindlin_betan", betan)]);
        }
        for LawOfSpeed { name, values, .. } in &self.of_speed {
            match (*name, &values[..]) {
                ("kuwabara_kono", &[time]) => {
                    let eta = viscoelastic_damping(pair, time)?;
                    numbers.extend([("dissipation_time", time), ("eta", eta)]);
                }
                ("hertz_dashpot", &[damping]) => {
                    numbers.insert("gamma", damping);
                }
                ("luding", &[ratio, loading, depth]) => numbers.extend([
                    ("k1", loading),
                    ("kp", ratio * loading),
                    ("kp_over_k1", ratio),
                    ("phi_f", depth),
                    ("k1_velocity", characteristic_velocity(pair, loading)),
                ]),
                ("mdr", &[strength, ratio, ..]) => {
                    let n_sides = self.spheres.len() as f64;
                    let young = n_sides * (1.0 - ratio * ratio) * modulus;
                    numbers.extend([("mdr_strength", strength), ("mdr_poisson", ratio)]);
                    numbers.insert("mdr_young", young);
                }
                ("hunt_crossley", &[dissipation, rms]) => numbers.extend([
                    ("dissipation", dissipation),
                    ("dissipation_rms", rms),
                    ("slow_e", restitution_of(dissipation * self.speeds.0)),
                    ("fast_e", restitution_of(dissipation * self.speeds.1)),
                ]),
                _ => {}
            }
        }
        if let Ok([stiffness, damping]) = newton_entry(pair, *e, *time) {
            numbers.extend([("newton_stiffness", stiffness), ("newton_damping", damping)]);
        }
        // Codes that end the contact at the force 0.
        let Ok(law) = linear(EndRule::ZeroForce) else { return Ok(numbers) };
        let [stiffness, damping] = [law.stiffness(), law.damping()].map(|of| of / mass);
        numbers.extend([("mujoco_stiffness", stiffness), ("mujoco_damping", damping)]);
        numbers.insert("point_stiffness", 2.0 * law.stiffness());
        numbers.extend([("yade_kn", 2.0 * law.stiffness()), ("yade_cn", 2.0 * law.damping())]);
        if let Some((time, en)) = viscel_entry(pair, &law) {
            numbers.extend([("viscel_tc", time), ("viscel_en", en)]);
        }
        Ok(numbers)
    }

    /// Returns the numbers of friction that a file can contain; all are 0 without it.
    fn friction_numbers(
        &self,
        head: &Head,
        numbers: &BTreeMap<&'static str, f64>,
    ) -> Vec<(&'static str, f64)> {
        let fitted = self
            .friction
            .as_ref()
            .and_then(|friction| Some((&friction.rebound, friction.fitted.get(head.name)?.factor)));
        let (friction, modulus, mass_ratio, factor) = match fitted {
            Some((rebound, factor)) => {
                (rebound.friction, rebound.modulus, rebound.mass_ratio, factor)
            }
            None => (0.0, 0.0, f64::INFINITY, 0.0),
        };
        let of = |key: &str| numbers.get(key).copied().unwrap_or_default();
        let patch_mass = self.pair.effective_mass() / mass_ratio;
        vec![
            ("mu", friction),
            ("friction_angle", friction.atan()),
            ("kt", 2.0 * modulus * factor),
            ("kt_over_kn", factor),
            ("kt_linear", factor * of("stiffness")),
            ("yade_ks", factor * of("yade_kn")),
            ("mercury_shear_modulus", 0.375 * modulus * factor),
            // The patch of a contact in fifty steps stands within two of them.
            ("friction_gain", 25.0 * patch_mass / self.contact_time),
        ]
    }

    /// Returns the comment on friction in a file.
    fn friction_note(&self, head: &Head) -> String {
        let known = self.friction.as_ref().zip(head.friction);
        let known = known.and_then(|(friction, (_, given))| {
            Some((&friction.rebound, friction.fitted.get(head.name)?, given))
        });
        let Some((rebound, FittedFriction { law, factor, rms, worst, .. }, given)) = known else {
            return commented("Without friction; put in your own tangential model.");
        };
        let factor = number(*factor, 3);
        let stiffness = match (law, given) {
            (FrictionLaw::Sliding, _) => "no tangential spring".to_string(),
            (FrictionLaw::Linear, Some(_)) => format!("k_t = {factor} k_n, which the code gives"),
            (FrictionLaw::Linear, None) => format!("k_t = {factor} k_n, fitted"),
            (_, Some(_)) => format!("{factor} of Mindlin's stiffness, which the code gives"),
            (_, None) => format!("{factor} of Mindlin's stiffness, fitted"),
        };
        let (from, to) = (rebound.before[0], rebound.before[rebound.before.len() - 1]);
        commented(&format!(
            "Friction {}, {stiffness}. For tan(angle)/mu from {} to {} the patch rebounds with v_t/(mu v_n) to {} rms, {} at worst.",
            number(rebound.friction, 4),
            number(from, 2),
            number(to, 2),
            number(*rms, 2),
            number(*worst, 2)
        ))
    }

    /// Returns the words that snippets can contain. The second of one sphere is the sphere itself.
    fn words(&self) -> BTreeMap<String, String> {
        let mut values = Values::default();
        let later = tsuji_entry(self.restitution, TsujiVersion::RootTwo);
        let n_kinds = if self.is_equal() { 1 } else { self.spheres.len() };
        for number in 1..=2 {
            let sphere = self.spheres.get(number - 1).unwrap_or(&self.spheres[0]);
            values.set_sphere(number, sphere, &number.to_string());
        }
        values.words.extend([
            ("wall".to_string(), self.wall().to_string()),
            ("n_kinds".to_string(), n_kinds.to_string()),
            ("left".to_string(), "{".to_string()),
            ("right".to_string(), "}".to_string()),
            ("tsuji_later".to_string(), later.map_or("nothing".into(), |e| format!("{e:.4}"))),
        ]);
        values.words
    }

    /// Returns the comment lines that open each snippet: its law, its spheres, its validity, and the notes.
    fn heading(&self, model: &str, [from, to, worst]: [f64; 3], notes: &str) -> String {
        let speed = |value: f64| format!("{} m/s", number(value, 4));
        let diameters: Vec<_> = self.spheres.iter().map(|sphere| short(sphere.diameter)).collect();
        let bodies = match &diameters[..] {
            [one] => format!("a sphere of {one} m on a {}", self.wall()),
            all => format!("spheres of {} m", all.join(" and ")),
        };
        // The fit of a bound is valid, but the restitution is not.
        let e = if self.bounds.is_empty() { "e" } else { "the fit" };
        let good = format!("good to {}", number(self.tolerance, 2));
        let range = if from == to {
            format!("{e} is {good} at {} alone", speed(from))
        } else if from <= to {
            format!("{e} is {good} from {} to {}", speed(from), speed(to))
        } else {
            format!("{e} is nowhere {good}")
        };
        let warnings = self.bounds.iter().map(|text| commented(&format!("WARNING: {text}")));
        let own_notes = self.notes.iter().map(|text| commented(text));
        let remarks: String = warnings.chain(own_notes).collect();
        let band = self.band.map_or(String::new(), |(confidence, half)| {
            format!(
                "# e(v) is known to {} or better ({} % band, {BAND_FILE}).\n",
                number(half, 2),
                number(100.0 * confidence, 3)
            )
        });
        format!(
            "# {}\n# {model}; {bodies}, SI units.\n# Fitted from {} to {}; {range}\n\
             # (largest error {worst:.4}).\n{band}{remarks}{notes}",
            self.title,
            speed(self.speeds.0),
            speed(self.speeds.1)
        )
    }

    /// Whether both spheres are the same.
    fn is_equal(&self) -> bool {
        self.spheres.len() == 2 && self.spheres.first() == self.spheres.last()
    }

    /// Returns the name of the body that a single sphere strikes.
    fn wall(&self) -> &'static str {
        if self.has_rigid_wall() { "rigid wall" } else { "half-space" }
    }

    /// Whether a single sphere strikes a rigid wall: E* is then its own E/(1 − ν²).
    fn has_rigid_wall(&self) -> bool {
        self.spheres.len() == 1 && self.wall_compliance() <= 1e-9 / self.pair.contact_modulus()
    }

    /// Returns Young's modulus, Pa, of a wall with Poisson's ratio 0 that gives the contact's E*; for a
    /// rigid wall a million times the sphere's.
    fn wall_modulus(&self) -> f64 {
        match self.has_rigid_wall() {
            true => 1e6 * self.spheres[0].youngs_modulus,
            false => self.wall_compliance().recip(),
        }
    }

    /// Returns 1/E* less the first sphere's share, 1/Pa.
    fn wall_compliance(&self) -> f64 {
        let Sphere { youngs_modulus, poissons_ratio, .. } = self.spheres[0];
        self.pair.contact_modulus().recip() - (1.0 - poissons_ratio.powi(2)) / youngs_modulus
    }
}

/// Returns the blocks of the texts: head and body.
fn blocks() -> impl Iterator<Item = (&'static str, &'static str)> {
    SNIPPETS.split("\n@ ").skip(1).filter_map(|block| block.split_once('\n'))
}

/// Returns the laws of all files.
pub fn heads() -> impl Iterator<Item = Head> {
    blocks().filter_map(|(head, _)| Head::of(head))
}

/// Returns a text as comment lines.
fn commented(text: &str) -> String {
    let mut lines = vec!["#".to_string()];
    for word in text.split(|c: char| c.is_whitespace() || c.is_control()) {
        let is_full = lines.last().is_some_and(|line| line.len() + word.len() >= LONGEST_LINE);
        if is_full {
            lines.push("#".to_string());
        }
        lines.last_mut().into_iter().for_each(|line| *line += &format!(" {word}"));
    }
    lines.join("\n") + "\n"
}

/// Returns comment lines of C++ in place of those with a hash.
fn slashed(text: &str) -> String {
    text.lines().map(|line| format!("//{}\n", line.trim_start_matches('#'))).collect()
}

/// Formats a number with up to ten digits, as short as possible.
fn short(value: f64) -> String {
    let rounded: f64 = format!("{value:.9e}").parse().unwrap_or(value);
    if (1e-4..1e6).contains(&rounded.abs()) || rounded == 0.0 {
        rounded.to_string()
    } else {
        format!("{rounded:e}")
    }
}
