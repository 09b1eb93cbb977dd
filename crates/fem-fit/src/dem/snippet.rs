//! What a snippet is made from, and its heading.

use fem_laws::laws::{ContactLaw, linear_from_restitution};
use fem_laws::{EndRule, LawError, Pair};

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

/// A Hertzian contact whose restitution is the same at every speed.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Elastic {
    /// Restitution e.
    pub restitution: f64,
    /// Where e is good: from, to, m/s, and its largest error over all data.
    pub validity: [f64; 3],
}

/// A linear spring and dashpot.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Dashpot {
    /// Restitution e.
    pub restitution: f64,
    /// Contact time T, s.
    pub contact_time: f64,
    /// Where e is good: from, to, m/s, and its largest error over all data.
    pub validity: [f64; 3],
}

/// What a law was fitted to, and the laws: the content of all snippets.
#[derive(Debug, Clone, PartialEq)]
pub struct Export {
    /// Where it comes from, one line.
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
    /// Linear, for all speeds.
    pub linear: Dashpot,
}

/// A file for a DEM code.
#[derive(Debug, Clone, PartialEq)]
pub struct Snippet {
    /// Its name.
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

impl Export {
    /// Comment lines that open each snippet: what it is, for which spheres, where it is good.
    pub(crate) fn heading(&self, model: &str, validity: [f64; 3], notes: &[String]) -> String {
        let [from, to, worst] = validity;
        let diameters: Vec<_> = self.spheres.iter().map(|sphere| short(sphere.diameter)).collect();
        let bodies = match &diameters[..] {
            [one] => format!("a sphere of {one} m on a rigid wall"),
            all => format!("spheres of {} m", all.join(" and ")),
        };
        let range = if from <= to {
            format!("e is good to {} from {from:.4} to {to:.4} m/s", self.tolerance)
        } else {
            format!("e is nowhere good to {}", self.tolerance)
        };
        let mut text = format!(
            "# {}\n# {model}; {bodies}, SI units.\n# Fitted from {:.4} to {:.4} m/s; \
             {range}\n# (largest error {worst:.4}).\n",
            self.title, self.speeds.0, self.speeds.1
        );
        for note in notes {
            text += &format!("# {note}\n");
        }
        text
    }

    /// The linear law that ends under a rule with the wanted e and T.
    pub(crate) fn linear_law(&self, end_rule: EndRule) -> Result<ContactLaw, LawError> {
        let Dashpot { restitution, contact_time, .. } = self.linear;
        linear_from_restitution(&self.pair, restitution, contact_time, end_rule)
    }
}

/// A number in ten digits, as short as it can be said.
pub(crate) fn short(value: f64) -> String {
    let rounded: f64 = format!("{value:.9e}").parse().unwrap_or(value);
    if (1e-4..1e6).contains(&rounded.abs()) || rounded == 0.0 {
        rounded.to_string()
    } else {
        format!("{rounded:e}")
    }
}
