//! The content of DEM snippets: the laws that they enter, their heading, and their comments.

use fem_laws::laws::{ContactLaw, linear_from_restitution};
use fem_laws::{EndRule, LawError, Pair};
use fem_material::Material;
use fem_material::engineering::number;

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
    pub(super) fn texts(&self) -> [String; 4] {
        [self.diameter, self.density, self.youngs_modulus, self.poissons_ratio].map(short)
    }
}

/// A Hertzian contact whose restitution is the same at every speed.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Elastic {
    /// The restitution e.
    pub restitution: f64,
    /// Range of speeds in which e is valid: from, to, m/s; and its largest error over all data.
    pub validity: [f64; 3],
}

/// A linear spring and dashpot.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Dashpot {
    /// The restitution e.
    pub restitution: f64,
    /// Contact time T, s.
    pub contact_time: f64,
    /// Range of speeds in which e is valid: from, to, m/s; and its largest error over all data.
    pub validity: [f64; 3],
}

/// A dashpot of Hunt & Crossley on a linear spring, as Drake has it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct HuntCrossley {
    /// Dissipation d, s/m.
    pub dissipation: f64,
    /// √(Σ (e − e_i)²/N) over all data.
    pub rms: f64,
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
    /// Hertz with one e for all speeds.
    pub hertz: Elastic,
    /// A of Kuwabara & Kono, s, for a contact that ends at zero force, and its validity.
    pub dissipation_time: (f64, [f64; 3]),
    /// The linear law, for all speeds.
    pub linear: Dashpot,
    /// The law whose restitution falls with speed; `None` if it cannot make the loss.
    pub hunt_crossley: Option<HuntCrossley>,
    /// Materials whose loss is taken as 0 because none is published: e is too high.
    pub unpublished_loss: Vec<String>,
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
    /// Name and value of the numbers that decide on the loss.
    pub entries: Vec<(&'static str, f64)>,
    /// The restitution that it makes; `None` if it depends on speed.
    pub restitution: Option<f64>,
    /// From, to (m/s), largest error of e over all data.
    pub validity: [f64; 3],
    /// The whole text.
    pub text: String,
}

/// The fitted law whose numbers a snippet enters.
#[derive(Debug, Clone, Copy, PartialEq)]
enum EnteredLaw {
    /// One restitution for all speeds, on Hertz' spring.
    Constant,
    /// The viscoelastic dashpot of Kuwabara & Kono.
    Viscoelastic,
    /// A linear spring and dashpot.
    Linear,
    /// The dashpot of Hunt & Crossley.
    HuntCrossley,
}

/// A file of a code: its name, the code, the model in the code's own words and in the heading, and its law.
#[derive(Clone, Copy)]
pub(super) struct SnippetFile(&'static str, &'static str, &'static str, &'static str, EnteredLaw);

#[rustfmt::skip]
mod files {
    use super::{EnteredLaw, SnippetFile};

    pub(crate) const LAMMPS_COEFF_RESTITUTION: SnippetFile = SnippetFile("lammps_coeff_restitution.in", "LAMMPS", "coeff_restitution", "granular hertz/material, damping coeff_restitution", EnteredLaw::Constant);
    pub(crate) const LAMMPS_VISCOELASTIC: SnippetFile = SnippetFile("lammps_viscoelastic.in", "LAMMPS", "viscoelastic", "granular hertz/material, damping viscoelastic", EnteredLaw::Viscoelastic);
    pub(crate) const LAMMPS_TSUJI: SnippetFile = SnippetFile("lammps_tsuji.in", "LAMMPS", "tsuji", "granular hertz/material, damping tsuji", EnteredLaw::Constant);
    pub(crate) const LIGGGHTS_HERTZ: SnippetFile = SnippetFile("liggghts_hertz.in", "LIGGGHTS", "hertz", "gran model hertz", EnteredLaw::Constant);
    pub(crate) const LIGGGHTS_HOOKE: SnippetFile = SnippetFile("liggghts_hooke.in", "LIGGGHTS", "hooke", "gran model hooke", EnteredLaw::Linear);
    pub(crate) const YADE_HERTZ_MINDLIN: SnippetFile = SnippetFile("yade_hertz_mindlin.py", "YADE", "Hertz-Mindlin", "Hertz-Mindlin", EnteredLaw::Constant);
    pub(crate) const YADE_VISCEL: SnippetFile = SnippetFile("yade_viscel.py", "YADE", "ViscEl", "ViscEl", EnteredLaw::Linear);
    pub(crate) const MERCURY_HERTZIAN: SnippetFile = SnippetFile("mercury_hertzian.cpp", "MercuryDPM", "HertzianViscoelastic", "HertzianViscoelastic", EnteredLaw::Constant);
    pub(crate) const MERCURY_LINEAR: SnippetFile = SnippetFile("mercury_linear.cpp", "MercuryDPM", "LinearViscoelastic", "LinearViscoelastic", EnteredLaw::Linear);
    pub(crate) const LETHE: SnippetFile = SnippetFile("lethe.prm", "Lethe", "hertz_mindlin_limit_overlap", "hertz_mindlin_limit_overlap", EnteredLaw::Constant);
    pub(crate) const MFIX_HERTZIAN: SnippetFile = SnippetFile("mfix_hertzian.dat", "MFIX-DEM", "HERTZIAN", "Hertzian", EnteredLaw::Constant);
    pub(crate) const MFIX_LSD: SnippetFile = SnippetFile("mfix_lsd.dat", "MFIX-DEM", "LSD", "linear spring and dashpot", EnteredLaw::Linear);
    pub(crate) const DRAKE_POINT_CONTACT: SnippetFile = SnippetFile("drake_point_contact.py", "Drake", "Hunt-Crossley", "point contact, Hunt & Crossley", EnteredLaw::HuntCrossley);
    pub(crate) const MUJOCO_CONTACT: SnippetFile = SnippetFile("mujoco_contact.xml", "MuJoCo", "solref", "solref in its direct format", EnteredLaw::Linear);
}
pub(super) use files::*;

impl Export {
    /// Returns the snippet of a file with these commands. Its heading says what it is fitted to and where it is
    /// valid, and ends with the notes.
    pub(super) fn snippet(
        &self,
        SnippetFile(name, code, model, title, law): SnippetFile,
        entries: &[(&'static str, f64)],
        notes: &[&str],
        commands: &str,
    ) -> Snippet {
        let (restitution, validity) = match law {
            EnteredLaw::Constant => (Some(self.hertz.restitution), self.hertz.validity),
            EnteredLaw::Viscoelastic => (None, self.dissipation_time.1),
            EnteredLaw::Linear => (Some(self.linear.restitution), self.linear.validity),
            EnteredLaw::HuntCrossley => {
                (None, self.hunt_crossley.map_or([f64::INFINITY, 0.0, 0.0], |it| it.validity))
            }
        };
        let heading = self.heading(&format!("{code}, {title}"), validity, notes);
        let heading = match name.rsplit_once('.').map_or("", |(_, ending)| ending) {
            "cpp" => slashed(&heading),
            "xml" => format!("<!--\n{}-->\n", heading.replace("--", "-")),
            _ => heading,
        };
        let (entries, text) = (entries.to_vec(), heading + commands);
        Snippet { name, code, model, entries, restitution, validity, text }
    }

    /// Returns the text of all spheres, each with its number from 1.
    pub(super) fn per_sphere(&self, text: impl Fn(usize, &Sphere) -> String) -> String {
        self.spheres.iter().enumerate().map(|(index, sphere)| text(index + 1, sphere)).collect()
    }

    /// Returns the comment lines that open each snippet: its law, its spheres and its validity.
    fn heading(&self, model: &str, [from, to, worst]: [f64; 3], notes: &[&str]) -> String {
        let diameters: Vec<_> = self.spheres.iter().map(|sphere| short(sphere.diameter)).collect();
        let bodies = match &diameters[..] {
            [one] => format!("a sphere of {one} m on a {}", self.wall()),
            all => format!("spheres of {} m", all.join(" and ")),
        };
        // If a loss is not known, the fit is valid but the restitution is not.
        let e = if self.unpublished_loss.is_empty() { "e" } else { "the fit" };
        let good = format!("good to {}", self.tolerance);
        let range = if from == to {
            format!("{e} is {good} at {} alone", speed(from))
        } else if from <= to {
            format!("{e} is {good} from {} to {}", speed(from), speed(to))
        } else {
            format!("{e} is nowhere {good}")
        };
        let (slowest, fastest) = self.speeds;
        let mut text = format!(
            "# {}\n# {model}; {bodies}, SI units.\n# Fitted from {} to {}; {range}\n\
             # (largest error {worst:.4}).\n",
            self.title,
            speed(slowest),
            speed(fastest)
        );
        if !self.unpublished_loss.is_empty() {
            text += &unpublished_loss("e", &self.unpublished_loss);
        }
        notes.iter().for_each(|note| text += &format!("# {note}\n"));
        text
    }

    /// Returns a comment, for codes that use the entries of 1 and 2 for 1 with 1 and 2 with 2 too, that
    /// names the pair; it is empty for equal spheres.
    pub(super) fn unlike_note(&self) -> &'static str {
        if self.spheres.first() == self.spheres.last() {
            return "";
        }
        "# Fitted for contacts of 1 with 2 alone: 1 with 1 and 2 with 2 are other pairs, which want an\n\
         # export each; all at once: fem-run export CASE --diameters D1,D2.\n"
    }

    /// Returns the name of the body that a single sphere strikes.
    pub(super) fn wall(&self) -> &'static str {
        if self.has_rigid_wall() { "rigid wall" } else { "block without an end" }
    }

    /// Whether a single sphere strikes a rigid wall: E* is then its own E/(1 − ν²).
    pub(super) fn has_rigid_wall(&self) -> bool {
        match &self.spheres[..] {
            [sphere] => self.wall_compliance(sphere) <= 1e-9 / self.pair.contact_modulus(),
            _ => false,
        }
    }

    /// Returns Young's modulus, Pa, of a wall with Poisson's ratio 0 that gives the contact's E*; for a
    /// rigid wall a million times the sphere's.
    pub(super) fn wall_modulus(&self, sphere: &Sphere) -> f64 {
        if self.has_rigid_wall() {
            1e6 * sphere.youngs_modulus
        } else {
            self.wall_compliance(sphere).recip()
        }
    }

    /// Returns 1/E* less the sphere's share, 1/Pa.
    fn wall_compliance(&self, sphere: &Sphere) -> f64 {
        let own = (1.0 - sphere.poissons_ratio.powi(2)) / sphere.youngs_modulus;
        self.pair.contact_modulus().recip() - own
    }

    /// Returns the linear law that has the wanted e and T under an end rule.
    pub(super) fn linear_law(&self, end_rule: EndRule) -> Result<ContactLaw, LawError> {
        let Dashpot { restitution, contact_time, .. } = self.linear;
        linear_from_restitution(&self.pair, restitution, contact_time, end_rule)
    }
}

/// Returns a comment that the loss of some materials is missing in the restitutions named.
pub(super) fn unpublished_loss(restitutions: &str, materials: &[String]) -> String {
    let materials = materials.join(" and ").replace(char::is_control, " ");
    format!(
        "# WARNING: no loss of {materials} is known, and none is in {restitutions}.\n\
         # It is too high there, by how much is not known: measure it, or give the material a relaxation.\n"
    )
}

/// Returns comment lines of C++ in place of those with a hash.
pub(super) fn slashed(text: &str) -> String {
    text.lines().map(|line| format!("//{}\n", line.trim_start_matches('#'))).collect()
}

/// Formats a number with up to ten digits, as short as possible.
pub(super) fn short(value: f64) -> String {
    let rounded: f64 = format!("{value:.9e}").parse().unwrap_or(value);
    if (1e-4..1e6).contains(&rounded.abs()) || rounded == 0.0 {
        rounded.to_string()
    } else {
        format!("{rounded:e}")
    }
}

/// Formats a speed for a comment.
pub(super) fn speed(value: f64) -> String {
    format!("{} m/s", number(value, 4))
}

/// Formats a time for a comment.
pub(super) fn time(value: f64) -> String {
    format!("{} s", number(value, 4))
}
