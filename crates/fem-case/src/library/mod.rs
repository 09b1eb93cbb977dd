//! The materials library, for `material = "lib:NAME"`: [`Material`]s from data books and papers, each with its source and
//! its range of validity.
//!
//! All are in one file, `library.toml`. A case that names one gets the table `[material."lib:NAME"]` from there, except for
//! the keys that it gives itself. An override can thus change single numbers, and the resolved case has the whole table.

mod measured_restitution;

use std::collections::BTreeMap;
use std::sync::LazyLock;

use fem_material::{ElasticModuli, ModuliInput};
use serde::Deserialize;
use toml::Spanned;
use toml::de::{DeString, DeTable, DeValue};
use toml::map::Entry;

use crate::quantity::{Quantity, Stress};
use crate::schema::{CaseFile, FlowPoints, FlowTable, MaterialTable};
use crate::source::nearest;
use crate::source::toml_syntax::shift;

pub use measured_restitution::MeasuredRestitution;

/// The prefix of the library's materials in a case.
pub(crate) const PREFIX: &str = "lib:";

/// The text of the library.
pub(crate) const TEXT: &str = include_str!("library.toml");
/// The tree of [`TEXT`], which all cases of a sweep share.
static TREE: LazyLock<DeTable<'static>> =
    LazyLock::new(|| DeTable::parse(TEXT).map(Spanned::into_inner).unwrap_or_default());

/// A material of the library.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Material {
    /// Title of the material.
    pub title: String,
    /// Other names of the material.
    #[serde(default)]
    pub names: Vec<String>,
    /// Source of the numbers.
    pub source: String,
    /// Range of validity and scatter of the numbers.
    pub range: String,
    /// The table of a case.
    pub material: MaterialTable,
    /// Measured restitutions between bodies of this material.
    #[serde(default)]
    pub measured: Vec<MeasuredRestitution>,
}

/// Returns all materials by name, without `lib:`.
///
/// ```
/// let ice = &fem_case::library::materials()["ice"];
/// assert_eq!(ice.material.density.si(), Ok(917.0));
/// assert!(ice.source.contains("Gammon"));
/// ```
pub fn materials() -> &'static BTreeMap<String, Material> {
    static MATERIALS: LazyLock<BTreeMap<String, Material>> =
        LazyLock::new(|| toml::from_str(TEXT).unwrap_or_default());
    &MATERIALS
}

/// Returns the names as in a case: `lib:alumina`, ….
pub(crate) fn names() -> Vec<String> {
    materials().keys().map(|name| format!("{PREFIX}{name}")).collect()
}

/// Returns the material of a name, without `lib:`, or of one of its other names, and its name in the library. Capitals do not
/// matter, nor do spaces in place of hyphens.
pub fn find(name: &str) -> Option<(&'static str, &'static Material)> {
    let plain = |name: &str| name.to_lowercase().replace([' ', '_'], "-");
    let wanted = plain(name);
    let is_it = |(known, entry): &(&'static String, &'static Material)| {
        **known == wanted || entry.names.iter().any(|other| plain(other) == wanted)
    };
    materials().iter().find(is_it).map(|(known, entry)| (known.as_str(), entry))
}

/// Returns the name, without `lib:`, of the material that has the name nearest to an unknown one.
pub fn nearest_to(name: &str) -> Option<&'static str> {
    let all = || {
        materials().iter().flat_map(|(known, entry)| {
            std::iter::once(known)
                .chain(&entry.names)
                .map(move |other| (other.to_lowercase(), known))
        })
    };
    let lower = name.to_lowercase();
    let whole: Vec<String> = all().map(|(other, _)| other).collect();
    let near = || find(nearest(name, &whole, 0.8)?);
    let first = |is: &dyn Fn(&str) -> bool| {
        all().find(|(other, _)| is(other)).map(|(_, known)| known.as_str())
    };
    // A part of a name, `rubber`, or a misspelled one, `rubbr`.
    let within = || first(&|other| lower.len() > 2 && other.contains(&lower));
    let of_part = || {
        let parts: Vec<&str> = whole.iter().flat_map(|other| other.split('-')).collect();
        let part = nearest(name, &parts, 0.9)?;
        first(&|other| other.split('-').any(|own| own == part))
    };
    near().map(|(known, _)| known).or_else(within).or_else(of_part)
}

/// A material of the library beside one of a case, by stiffness and density.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LikeMaterial {
    /// Name in the library, without `lib:`.
    pub name: &'static str,
    /// Yield strength, Pa; `None` if the library knows none, as of glass and rubber.
    pub yield_strength: Option<f64>,
    /// Whether Young's modulus and density are the same within a few per cent.
    pub is_alike: bool,
}

impl LikeMaterial {
    /// Returns the material of the library that is nearest to one in Young's modulus and density, by their ratios, and in Poisson's
    /// ratio; of several that are equally near the weakest. One without a strength stands for its own kind alone, such as glasses;
    /// any other solid is judged by its neighbours that have one.
    pub fn of(material: &fem_material::Material) -> Option<Self> {
        const ALIKE: f64 = 0.05;
        const OF_ONE_KIND: f64 = 0.25;
        const EQUALLY_NEAR: f64 = 0.01;
        const NEIGHBOURS: f64 = 0.5;
        type Numbers = (&'static str, [f64; 3], Option<f64>);
        static NUMBERS: LazyLock<Vec<Numbers>> = LazyLock::new(|| {
            let numbers = |(name, entry): (&'static String, &'static Material)| {
                Some((name.as_str(), entry.moduli_and_density()?, entry.yield_strength()))
            };
            materials().iter().filter_map(numbers).collect()
        });
        let own = numbers_of(material.instantaneous(), material.density());
        let known = |(name, numbers, yield_strength): &Numbers| {
            let ratios = numbers[..2].iter().zip(own).map(|(a, b)| (a / b).ln().abs());
            let distance = ratios.sum::<f64>() + (numbers[2] - own[2]).abs();
            let (name, yield_strength) = (*name, *yield_strength);
            (distance, Self { name, yield_strength, is_alike: distance < ALIKE })
        };
        let is_its_kind = |(distance, like): &(f64, Self)| {
            like.yield_strength.is_some() || *distance < OF_ONE_KIND
        };
        let all: Vec<(f64, Self)> = NUMBERS.iter().map(known).filter(is_its_kind).collect();
        let (nearest, like) = all.iter().min_by(|a, b| a.0.total_cmp(&b.0))?;
        let reach = match (like.yield_strength, like.is_alike) {
            (None, _) => return Some(*like),
            (_, true) => EQUALLY_NEAR,
            _ => NEIGHBOURS,
        };
        let strength = |like: &Self| like.yield_strength.unwrap_or(f64::INFINITY);
        let near = all.iter().filter(|(distance, _)| *distance <= nearest + reach);
        near.map(|(_, like)| *like).min_by(|a, b| strength(a).total_cmp(&strength(b)))
    }
}

/// Returns Young's modulus, Pa, density, kg/m³, and Poisson's ratio.
fn numbers_of(moduli: &ElasticModuli, density: f64) -> [f64; 3] {
    [moduli.youngs_modulus(), density, moduli.poissons_ratio()]
}

impl Material {
    fn moduli_and_density(&self) -> Option<[f64; 3]> {
        let table = &self.material;
        let si = |modulus: Option<&Quantity<Stress>>| modulus?.si().ok();
        let moduli = ElasticModuli::from_two(ModuliInput {
            youngs_modulus: si(table.youngs_modulus.as_ref()),
            shear_modulus: si(table.shear_modulus.as_ref()),
            bulk_modulus: si(table.bulk_modulus.as_ref()),
            poissons_ratio: table.poissons_ratio.as_ref().and_then(|ratio| ratio.si().ok()),
        });
        Some(numbers_of(&moduli.ok()?, table.density.si().ok()?))
    }

    /// Returns the yield strength, Pa: that beside the density, or that of the flow rule.
    pub fn yield_strength(&self) -> Option<f64> {
        let of_table = |points: &FlowPoints| match points {
            FlowPoints::Rows(rows) => rows.first()?.1.si().ok(),
            FlowPoints::File(_) => None,
        };
        let of_flow = |flow: &FlowTable| match &flow.yield_strength {
            Some(strength) => strength.si().ok(),
            None => of_table(flow.hardening.as_ref()?.table.as_ref()?),
        };
        let plain = self.material.yield_strength.as_ref().and_then(|it| it.si().ok());
        plain.or_else(|| self.material.flow.as_ref().and_then(of_flow))
    }
}

/// Returns whether a name begins with `lib:`.
pub(crate) fn is_of_library(name: &str) -> bool {
    name.starts_with(PREFIX)
}

/// Returns a name without `lib:`.
pub(crate) fn bare(name: &str) -> &str {
    name.strip_prefix(PREFIX).unwrap_or(name)
}

/// Returns the library's name of a case's material: of one with a `lib:` name and any numbers, or with the name and the
/// numbers of the library, as `fem-run new` writes them, of which one may be another.
pub(crate) fn name_of(name: &str, table: &MaterialTable) -> Option<&'static str> {
    const MAX_CHANGED: usize = 1;
    let (known, entry) = materials().get_key_value(bare(name))?;
    let numbers = |of: &MaterialTable| {
        let stresses = [&of.youngs_modulus, &of.shear_modulus, &of.bulk_modulus]
            .map(|modulus| modulus.as_ref().and_then(|modulus| modulus.si().ok()));
        let ratio = of.poissons_ratio.as_ref().and_then(|ratio| ratio.si().ok());
        [of.density.si().ok(), stresses[0], stresses[1], stresses[2], ratio]
    };
    let both = numbers(table).into_iter().zip(numbers(&entry.material));
    let n_changed = both.filter(|(own, of_library)| own != of_library).count();
    (is_of_library(name) || n_changed <= MAX_CHANGED).then_some(known)
}

/// Returns a name of a case, which begins with `lib:`, as the library has it.
fn canonical(name: &str) -> Option<String> {
    find(name.strip_prefix(PREFIX)?).map(|(known, _)| format!("{PREFIX}{known}"))
}

/// Returns the table of a material as in a case file, `[material.NAME]`, with the text of the library.
pub fn table_text(name: &str) -> Option<String> {
    let DeValue::Table(entry) = TREE.get(name)?.get_ref() else { return None };
    let DeValue::Table(material) = entry.get("material")?.get_ref() else { return None };
    Some(section(&format!("material.{name}"), material))
}

/// Returns the text of a table of the library under another name: its lines, then the tables that have lines of their own.
fn section(name: &str, table: &DeTable<'_>) -> String {
    let mut entries: Vec<_> = table.iter().collect();
    entries.sort_by_key(|(_, value)| value.span().start);
    let mut text = format!("[{name}]\n");
    let mut tables = String::new();
    for (key, value) in entries {
        let key = key.get_ref();
        match (value.get_ref(), &TEXT[value.span()]) {
            (DeValue::Table(inner), written) if !written.starts_with('{') => {
                tables += &format!("\n{}", section(&format!("{name}.{key}"), inner));
            }
            (_, written) => text += &format!("{key} = {written}\n"),
        }
    }
    text + &tables
}

/// Adds to a case made in code the tables of the library's materials that its bodies name.
pub(crate) fn fill(file: &mut CaseFile) {
    let renamed = std::mem::take(&mut file.material).into_iter();
    file.material = renamed.map(|(name, own)| (canonical(&name).unwrap_or(name), own)).collect();
    for name in file.body.iter_mut().filter_map(|body| body.material.as_mut()) {
        *name = canonical(name).unwrap_or_else(|| name.clone());
        if is_of_library(name)
            && let Some((_, entry)) = find(bare(name))
        {
            file.material.entry(name.clone()).or_insert_with(|| entry.material.clone());
        }
    }
}

/// Adds to a tree the keys of the library's materials that its bodies name, unless it gives them; spans count from
/// `start`. Returns whether it added any.
pub(crate) fn underlay(root: &mut DeTable<'_>, start: usize) -> bool {
    rename(root);
    let names = named(root);
    if names.is_empty() {
        return false;
    }
    let mut is_used = false;
    for name in names {
        let Some(entry) = name.strip_prefix(PREFIX).and_then(|name| TREE.get(name)) else {
            continue;
        };
        let DeValue::Table(mut entry) = shift(entry.clone(), start).into_inner() else { continue };
        let Some(material) = entry.remove("material") else { continue };
        let span = material.span();
        let all = root.entry(Spanned::new(span.clone(), DeString::Borrowed("material")));
        let all = all.or_insert(Spanned::new(span.clone(), DeValue::Table(DeTable::new())));
        if let DeValue::Table(all) = all.get_mut() {
            let key = Spanned::new(span.clone(), DeString::Owned(name));
            let given =
                all.entry(key).or_insert(Spanned::new(span, DeValue::Table(DeTable::new())));
            lay_under(given, material);
            is_used = true;
        }
    }
    is_used
}

/// Adds the keys of `below` that `given` lacks; values that are not tables are unchanged, and their reader rejects them.
fn lay_under<'t>(given: &mut Spanned<DeValue<'t>>, below: Spanned<DeValue<'t>>) {
    if let (DeValue::Table(given), DeValue::Table(below)) = (given.get_mut(), below.into_inner()) {
        for (key, value) in below {
            given.entry(key).or_insert(value);
        }
    }
}

/// Gives the library's own names to the tables of its materials and to those that the bodies name.
fn rename(root: &mut DeTable<'_>) {
    if let Some(DeValue::Table(all)) = root.get_mut("material").map(Spanned::get_mut) {
        for (key, value) in std::mem::take(all) {
            let name = canonical(key.get_ref()).map(DeString::Owned);
            match all.entry(Spanned::new(key.span(), name.unwrap_or_else(|| key.into_inner()))) {
                Entry::Occupied(known) => lay_under(known.into_mut(), value),
                Entry::Vacant(place) => drop(place.insert(value)),
            }
        }
    }
    let Some(DeValue::Array(bodies)) = root.get_mut("body").map(Spanned::get_mut) else { return };
    for body in bodies.iter_mut() {
        let DeValue::Table(body) = body.get_mut() else { continue };
        let Some(material) = body.get_mut("material").map(Spanned::get_mut) else { continue };
        if let Some(name) = material.as_str().and_then(canonical) {
            *material = DeValue::String(name.into());
        }
    }
}

/// Returns the names of the library's materials that the bodies of a tree name, each once.
fn named(root: &DeTable<'_>) -> Vec<String> {
    let Some(DeValue::Array(bodies)) = root.get("body").map(Spanned::get_ref) else {
        return Vec::new();
    };
    let material = |body: &Spanned<DeValue<'_>>| match body.get_ref() {
        DeValue::Table(body) => body.get("material")?.get_ref().as_str().map(str::to_string),
        _ => None,
    };
    let mut names: Vec<String> = bodies.iter().filter_map(material).collect();
    names.retain(|name| is_of_library(name));
    names.sort();
    names.dedup();
    names
}
