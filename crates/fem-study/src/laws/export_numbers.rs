//! `export.json`: laws of DEM codes as numbers.

use crate::fit::Point;
use crate::fit::dem::{Snippet, Sphere, restitution_of};
use fem_laws::LawFamily;
use serde::{Serialize, Serializer};

use super::dem_export::DemExport;

/// An export as it is kept, SI.
#[derive(Clone, Debug, Serialize)]
pub struct ExportNumbers {
    /// The case, as the caller calls it.
    pub case: String,
    /// Whether one of the bodies is a wall.
    pub wall: bool,
    /// Two spheres, or the one that strikes a wall.
    pub spheres: Vec<SphereNumbers>,
    /// Error of e up to which a law is called good.
    pub tolerance: f64,
    /// Slowest and fastest.
    pub speeds_m_s: (f64, f64),
    /// Effective mass m*.
    pub effective_mass_kg: f64,
    /// Effective radius R*.
    pub effective_radius_m: f64,
    /// Contact modulus E*.
    pub contact_modulus_pa: f64,
    /// A of Kuwabara & Kono.
    pub dissipation_time_s: f64,
    /// Contact time of the linear law.
    pub linear_contact_time_s: f64,
    /// Whether the contact times of the data are Hertz'.
    pub has_hertz_times: bool,
    /// Materials whose loss counts as nothing, since it is not published: e is too high.
    pub unpublished_loss: Vec<String>,
    /// The collisions that the laws are fitted to.
    pub data: Vec<PointNumbers>,
    /// The snippets.
    pub snippets: Vec<SnippetNumbers>,
}

/// One of the spheres.
#[derive(Clone, Debug, Serialize)]
pub struct SphereNumbers {
    /// The diameter D, m.
    pub diameter_m: f64,
    /// The density ρ, kg/m³.
    pub density_kg_m3: f64,
    /// The instantaneous Young's modulus E, Pa.
    pub youngs_modulus_pa: f64,
    /// Poisson's ratio ν.
    pub poissons_ratio: f64,
}

/// A point of the curve.
#[derive(Clone, Debug, Serialize)]
pub struct PointNumbers {
    /// Approach speed v.
    pub speed_m_s: f64,
    /// The restitution e.
    pub restitution: f64,
    /// Contact time T.
    pub contact_time_s: Option<f64>,
}

/// A file for a code.
#[derive(Clone, Debug, Serialize)]
pub struct SnippetNumbers {
    /// Name of the file.
    pub file: &'static str,
    /// The DEM code.
    pub code: &'static str,
    /// In the code's own words.
    pub model: &'static str,
    /// The entries of the code, by name.
    #[serde(serialize_with = "by_name")]
    pub entries: Vec<(&'static str, f64)>,
    /// The restitution that it makes; `None` if that depends on speed.
    pub restitution: Option<f64>,
    /// None if it is good nowhere.
    pub valid_from_m_s: Option<f64>,
    /// None if it is good nowhere.
    pub valid_to_m_s: Option<f64>,
    /// Largest error of e.
    pub worst_error: f64,
    /// At the speeds of the data.
    pub restitutions_at_data: Vec<Option<f64>>,
}

impl DemExport {
    /// Returns the stored form of it; `case` is what the case is called.
    pub fn numbers(&self, case: &str, snippets: &[Snippet]) -> ExportNumbers {
        let (export, points) = (&self.export, &self.curve.points);
        ExportNumbers {
            case: case.to_string(),
            wall: export.spheres.len() < 2,
            spheres: export.spheres.iter().map(sphere).collect(),
            tolerance: export.tolerance,
            speeds_m_s: export.speeds,
            effective_mass_kg: export.pair.effective_mass(),
            effective_radius_m: export.pair.effective_radius(),
            contact_modulus_pa: export.pair.contact_modulus(),
            dissipation_time_s: export.dissipation_time.0,
            linear_contact_time_s: export.linear.contact_time,
            has_hertz_times: self.curve.has_hertz_times,
            unpublished_loss: export.unpublished_loss.clone(),
            data: points.iter().map(point).collect(),
            snippets: snippets.iter().map(|snippet| self.snippet(snippet)).collect(),
        }
    }

    fn snippet(&self, snippet: &Snippet) -> SnippetNumbers {
        let [from, to, worst] = snippet.validity;
        // What depends on speed is the viscoelastic damping.
        let mut laws = self.laws.iter();
        let viscoelastic = laws.find(|law| law.model.family() == LawFamily::KuwabaraKono);
        let at_speed = |point: &Point| match (snippet.restitution, snippet.entries.first()) {
            (Some(restitution), _) => Some(restitution),
            (None, Some(("dissipation", d))) => Some(restitution_of(d * point.speed)),
            (None, _) => viscoelastic?.outcome(point.speed).map(|outcome| outcome.restitution),
        };
        SnippetNumbers {
            file: snippet.name,
            code: snippet.code,
            model: snippet.model,
            entries: snippet.entries.clone(),
            restitution: snippet.restitution,
            valid_from_m_s: (from <= to).then_some(from),
            valid_to_m_s: (from <= to).then_some(to),
            worst_error: worst,
            restitutions_at_data: self.curve.points.iter().map(at_speed).collect(),
        }
    }
}

fn sphere(sphere: &Sphere) -> SphereNumbers {
    SphereNumbers {
        diameter_m: sphere.diameter,
        density_kg_m3: sphere.density,
        youngs_modulus_pa: sphere.youngs_modulus,
        poissons_ratio: sphere.poissons_ratio,
    }
}

fn point(point: &Point) -> PointNumbers {
    PointNumbers {
        speed_m_s: point.speed,
        restitution: point.restitution,
        contact_time_s: point.contact_time,
    }
}

fn by_name<S: Serializer>(entries: &[(&str, f64)], to: S) -> Result<S::Ok, S::Error> {
    to.collect_map(entries.iter().copied())
}
