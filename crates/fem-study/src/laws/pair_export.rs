//! The laws of DEM codes for every pair of some materials and sizes.

use std::collections::{BTreeMap, BTreeSet};

use fem_case::schema::SphereTable;
use fem_case::{Case, library, nearest};
use fem_data::dem::{Export, Grain, PairOfGrains, Sphere, grouped};
use fem_data::estimate::FitError;
use serde::Serialize;

use super::dem_export::DemExport;
use super::impact_curve::ImpactCurve;
use super::law_fault::LawFault;

/// Largest number of pairs in a table: that of 45 grains.
const MAX_GRAINS: usize = 45;

/// A cell of the table; `None` stands for an empty one.
type Cell = Option<f64>;

/// All pairs of some grains, each with its own laws.
#[derive(Clone, Debug)]
pub struct PairExport {
    /// The grains, in the order of the codes' types.
    pub grains: Vec<Grain>,
    /// The pairs in the order 1 with 1, 1 with 2, …, 2 with 2, ….
    pub pairs: Vec<FittedPair>,
    /// Largest error of a constant e within its range of validity.
    pub tolerance: f64,
}

/// Two grains and their laws.
#[derive(Clone, Debug)]
pub struct FittedPair {
    /// The pair with its restitution.
    pub pair: PairOfGrains,
    /// The laws of the pair.
    pub export: DemExport,
}

/// A row of the table, SI.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct PairNumbers {
    /// Name of the first material.
    pub first_material: String,
    /// Diameter of the first sphere.
    pub first_diameter_m: f64,
    /// Name of the second material.
    pub second_material: String,
    /// Diameter of the second sphere.
    pub second_diameter_m: f64,
    /// Slowest speed of the fit.
    pub slowest_m_s: f64,
    /// Fastest speed of the fit.
    pub fastest_m_s: f64,
    /// The constant restitution.
    pub restitution: f64,
    /// First speed of its range of validity; `None` if it is valid nowhere.
    pub good_from_m_s: Cell,
    /// Last speed of its range of validity.
    pub good_to_m_s: Cell,
    /// Its largest error over the speeds of the fit; `None` if it is an upper bound.
    pub worst_error: Cell,
    /// The speeds at which it is an upper bound, with the reasons.
    pub bounds: Vec<String>,
    /// Other comments on it, such as the speeds that are left out.
    pub notes: Vec<String>,
    /// The entries of each code: `lammps_viscoelastic_eta`, ….
    pub entries: BTreeMap<String, f64>,
}

impl PairExport {
    /// Computes all pairs of spheres of these materials and diameters (m) at the case's speed with its
    /// model. Without materials or diameters, those of the case's spheres are used.
    ///
    /// # Errors
    /// A material is unknown, a diameter is not positive, or there are too many of both; see [`DemExport::of`].
    pub fn of(
        case: &Case,
        materials: &[String],
        diameters: &[f64],
        speeds: Option<(f64, f64)>,
        tolerance: f64,
        as_elastic: bool,
    ) -> Result<Self, LawFault> {
        let kinds = kinds(case, materials, diameters)?;
        let mut grains: Vec<Option<Grain>> = vec![None; kinds.len()];
        let mut pairs = Vec::new();
        for (first, second) in all_pairs(kinds.len()) {
            let collision = collision_of(case, [&kinds[first], &kinds[second]])?;
            for (place, body) in [first, second].into_iter().zip(collision.scene().bodies()) {
                let (Some(diameter), Some(material)) = (body.diameter(), body.material()) else {
                    continue;
                };
                let sphere = Sphere::new(diameter, material);
                grains[place] = Some(Grain { material: kinds[place].0.clone(), sphere });
            }
            let pair = collision.scene().pair().map_err(FitError::from)?;
            let curve = ImpactCurve::computed(&collision, speeds, as_elastic)?;
            let export = DemExport::of(&collision, curve, tolerance)?;
            let Export { restitution, bounds, notes, .. } = export.export.clone();
            let pair = PairOfGrains { grains: [first, second], pair, restitution, bounds, notes };
            pairs.push(FittedPair { pair, export });
        }
        Ok(Self { grains: grains.into_iter().flatten().collect(), pairs, tolerance })
    }

    /// Returns warnings of restitutions that are bounds, and of speeds that are left out.
    pub fn warnings(&self) -> Vec<String> {
        let pairs = self.of_codes();
        let (n, bounds) = (pairs.len(), grouped(&pairs, |pair| &pair.bounds));
        let left_out = self.pairs.iter().flat_map(|fitted| &fitted.export.curve.left_out);
        let left_out: BTreeSet<&String> = left_out.collect();
        let notes = grouped(&pairs, |pair| &pair.notes).into_iter();
        let notes = notes.filter(|(text, _)| left_out.iter().any(|known| known == text));
        let groups = bounds.into_iter().chain(notes);
        groups.map(|(text, found)| format!("{} of {n} pairs: {text}", found.len())).collect()
    }

    /// Returns the pairs for the input of the codes.
    pub fn of_codes(&self) -> Vec<PairOfGrains> {
        self.pairs.iter().map(|fitted| fitted.pair.clone()).collect()
    }

    /// Returns the table, one row per pair; values that a code's formula does not accept are left out.
    pub fn numbers(&self) -> Vec<PairNumbers> {
        self.pairs.iter().map(|fitted| self.row(fitted)).collect()
    }

    fn row(&self, fitted: &FittedPair) -> PairNumbers {
        let FittedPair { pair, export } = fitted;
        let [first, second] = pair.grains.map(|place| &self.grains[place]);
        let Export { speeds, validity, .. } = export.export;
        let known = Some(validity).filter(|_| pair.bounds.is_empty());
        let good = known.filter(|[from, to, _]| from <= to);
        PairNumbers {
            first_material: first.material.clone(),
            first_diameter_m: first.sphere.diameter,
            second_material: second.material.clone(),
            second_diameter_m: second.sphere.diameter,
            slowest_m_s: speeds.0,
            fastest_m_s: speeds.1,
            restitution: pair.restitution,
            good_from_m_s: good.map(|good| good[0]),
            good_to_m_s: good.map(|good| good[1]),
            worst_error: known.map(|validity| validity[2]),
            bounds: pair.bounds.clone(),
            notes: pair.notes.clone(),
            entries: entries(export),
        }
    }
}

/// Returns the entries by the file's stem and their name, such as `lammps_viscoelastic_eta`.
fn entries(of: &DemExport) -> BTreeMap<String, f64> {
    let snippets = of.export.snippets().unwrap_or_default();
    let named = snippets.iter().flat_map(|snippet| {
        let stem = snippet.name.split('.').next().unwrap_or(snippet.name);
        snippet.entries.iter().map(move |(key, value)| (format!("{stem}_{key}"), *value))
    });
    named.map(|(key, value)| (key.replace(' ', "_"), value)).collect()
}

/// Returns the pairs in the order 1 with 1, 1 with 2, …, 2 with 2, ….
fn all_pairs(n: usize) -> impl Iterator<Item = (usize, usize)> {
    (0..n).flat_map(move |first| (first..n).map(move |second| (first, second)))
}

/// Returns the grains of all materials and diameters.
fn kinds(
    case: &Case,
    materials: &[String],
    diameters: &[f64],
) -> Result<Vec<(String, f64)>, LawFault> {
    let bodies = || case.file().body.iter().zip(case.scene().bodies());
    let once = |mut all: Vec<(String, f64)>| {
        let mut seen: Vec<(String, f64)> = Vec::new();
        all.retain(|kind| {
            !seen.contains(kind) && {
                seen.push(kind.clone());
                true
            }
        });
        all
    };
    if let Some(diameter) = diameters.iter().find(|d| !(**d > 0.0 && d.is_finite())) {
        return Err(LawFault::Grains(
            format!("a diameter is {diameter:?}"),
            "it must be greater than 0".into(),
        ));
    }
    for material in materials {
        check_material(case, material)?;
    }
    let own_materials: Vec<String> =
        bodies().filter_map(|(table, _)| table.material.clone()).collect();
    let own_diameters: Vec<f64> = bodies().filter_map(|(_, body)| body.diameter()).collect();
    let all = if materials.is_empty() && diameters.is_empty() {
        let sphere = |(table, body): (&fem_case::schema::BodyTable, &fem_case::Body)| {
            Some((table.material.clone()?, body.diameter()?))
        };
        bodies().filter_map(sphere).collect()
    } else {
        let materials = if materials.is_empty() { &own_materials } else { materials };
        let diameters = if diameters.is_empty() { &own_diameters } else { diameters };
        let of = |material: &String| {
            diameters.iter().map(|diameter| (material.clone(), *diameter)).collect::<Vec<_>>()
        };
        materials.iter().flat_map(of).collect()
    };
    let all = once(all);
    if all.len() > MAX_GRAINS {
        let message = format!(
            "{} materials and sizes are {} pairs",
            all.len(),
            all.len() * (all.len() + 1) / 2
        );
        let help = format!("name {MAX_GRAINS} or fewer");
        return Err(LawFault::Grains(message, help));
    }
    Ok(all)
}

fn check_material(case: &Case, name: &str) -> Result<(), LawFault> {
    let own = &case.file().material;
    if own.contains_key(name)
        || name.strip_prefix("lib:").is_some_and(|it| library::find(it).is_some())
    {
        return Ok(());
    }
    let library = library::nearest_to(name.trim_start_matches("lib:"));
    let names: Vec<&String> = own.keys().collect();
    let near = nearest(name, &names, 0.8)
        .map(str::to_string)
        .or_else(|| library.map(|name| format!("lib:{name}")));
    let near = near.map_or(String::new(), |near| format!("did you mean {near}? "));
    let own = own.keys().cloned().collect::<Vec<_>>().join(", ");
    let help = format!("{near}the case has {own}; fem-run materials lists the library's");
    Err(LawFault::Grains(format!("there is no material {name}"), help))
}

/// Returns the case with spheres of two kinds.
fn collision_of(case: &Case, kinds: [&(String, f64); 2]) -> Result<Case, LawFault> {
    let edited = case.edited(|file| {
        let is_one = kinds[0].0 == kinds[1].0;
        for ((body, (material, diameter)), side) in file.body.iter_mut().zip(kinds).zip(0..) {
            // Comments on pairs name the bodies.
            let name = material.trim_start_matches("lib:");
            let is_letter = |c: char| c.is_ascii_alphanumeric() || c == '-' || c == '_';
            let name: String = name.chars().map(|c| if is_letter(c) { c } else { '-' }).collect();
            body.name = if is_one && side == 1 { name + "-2" } else { name };
            body.material = Some(material.clone());
            body.sphere = Some(SphereTable::new(*diameter));
            (body.wall, body.half_space, body.plate, body.held) = (None, None, None, None);
        }
        file.gravity = None;
        // That of another pair is not known.
        file.contact.iter_mut().for_each(|contact| contact.friction = None);
    });
    Ok(edited?)
}
