//! Materials with a name, for `material = "lib:NAME"`: [`Material`]s of data books and papers, each
//! with its source and its range.
//!
//! They stand in one file, `library.toml`. A case that names one has the table `[material."lib:NAME"]`
//! from here, key by key where it does not give that key itself; so an override reaches single numbers
//! of it, and the resolved case holds it in full.

use std::collections::BTreeMap;
use std::sync::LazyLock;

use serde::Deserialize;
use toml::Spanned;
use toml::de::{DeString, DeTable, DeValue};

use crate::quantity::{Quantity, QuantityKind};
use crate::schema::{CaseFile, MaterialTable, TermTable};
use crate::source::explain::nearest;
use crate::source::toml_text::shift;

/// Begins the name of a material of the library.
pub(crate) const PREFIX: &str = "lib:";

/// The library as it is written.
pub(crate) const TEXT: &str = include_str!("library.toml");

/// A material of the library.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Material {
    /// Description of the material.
    pub title: String,
    /// Where its numbers are from.
    pub source: String,
    /// Where they hold, and how far they scatter.
    pub range: String,
    /// As a case holds it.
    pub material: MaterialTable,
}

/// All materials by name, without `lib:`.
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

/// The names as a case gives them, `lib:alumina`, ….
pub(crate) fn names() -> Vec<String> {
    materials().keys().map(|name| format!("{PREFIX}{name}")).collect()
}

/// The name, without `lib:`, that is nearest to one that is none, or of the material whose title has that word.
pub fn nearest_to(name: &str) -> Option<&'static str> {
    let names: Vec<&str> = materials().keys().map(String::as_str).collect();
    // Enough for what is in a name, `rubber`, and for a slip of the fingers.
    let within = names.iter().find(|known| name.len() > 2 && known.contains(name));
    let near = nearest(name, &names, 0.8);
    let titled = || {
        let lower = name.to_lowercase();
        let has_word = |title: &str| {
            let title = title.to_lowercase();
            let mut words = title.split(|c: char| !c.is_alphanumeric());
            words.any(|word| {
                word.len() > 2 && (word == lower || word.len() > 5 && lower.starts_with(word))
            })
        };
        materials()
            .iter()
            .find(|(_, entry)| has_word(&entry.title))
            .map(|(known, _)| known.as_str())
    };
    // A slip in a part of a name, `rubbr`.
    let parts: Vec<&str> = names.iter().flat_map(|known| known.split('-')).collect();
    let of_part = || {
        let part = nearest(name, &parts, 0.9)?;
        names.iter().find(|known| known.split('-').any(|own| own == part)).copied()
    };
    near.or(within.copied())
        .or_else(titled)
        .or_else(of_part)
        .and_then(|near| materials().get_key_value(near))
        .map(|(near, _)| near.as_str())
}

/// Whether it is the name of a material of the library.
pub(crate) fn is_of_library(name: &str) -> bool {
    name.starts_with(PREFIX)
}

/// A name without `lib:`.
pub(crate) fn bare(name: &str) -> &str {
    name.strip_prefix(PREFIX).unwrap_or(name)
}

/// Whether a material of a case, of this name, is one of the library of which no loss is published: by its
/// `lib:` name whatever its numbers are, else by its name and its numbers, as `fem-run new` writes them. One
/// that relaxes is not.
pub(crate) fn is_without_loss(name: &str, table: &MaterialTable) -> bool {
    let Some(entry) = materials().get(bare(name)) else {
        return false;
    };
    let known = &entry.material;
    let stress = |of: &MaterialTable| {
        [&of.youngs_modulus, &of.shear_modulus, &of.bulk_modulus]
            .map(|modulus| modulus.as_ref().map(|modulus| modulus.si().ok()))
    };
    let ratio = |of: &MaterialTable| {
        of.poissons_ratio.as_ref().map(|poissons_ratio| poissons_ratio.si().ok())
    };
    let is_same = || {
        table.density.si().ok() == known.density.si().ok()
            && stress(table) == stress(known)
            && ratio(table) == ratio(known)
    };
    let is_elastic = known.relaxation.is_none() && table.relaxation.is_none();
    is_elastic && (is_of_library(name) || is_same())
}

fn find(name: &str) -> Option<&'static Material> {
    materials().get(name.strip_prefix(PREFIX)?)
}

/// The table of a material as a case file has it, `[material.NAME]`, numbers as the library writes
/// them.
pub fn table_text(name: &str) -> Option<String> {
    let table = &materials().get(name)?.material;
    let mut text = format!("[material.{name}]\ndensity = {}\n", written(&table.density));
    let mut line = |key: &str, value: Option<String>| {
        text.extend(value.map(|value| format!("{key} = {value}\n")));
    };
    line("youngs_modulus", table.youngs_modulus.as_ref().map(written));
    line("shear_modulus", table.shear_modulus.as_ref().map(written));
    line("bulk_modulus", table.bulk_modulus.as_ref().map(written));
    line("poissons_ratio", table.poissons_ratio.as_ref().map(written));
    line("yield_strength", table.yield_strength.as_ref().map(written));
    line("hyperelastic", table.hyperelastic.map(|law| format!("{:?}", law.word())));
    if let Some(relaxation) = &table.relaxation {
        let acts_on = relaxation.acts_on.word();
        text += &format!("\n[material.{name}.relaxation]\nacts_on = \"{acts_on}\"\nterms = [\n");
        for TermTable { weight, decay_rate, relaxation_time } in &relaxation.terms {
            text += &format!("    {{ weight = {}", written(weight));
            text.extend(
                decay_rate.as_ref().map(|rate| format!(", decay_rate = {}", written(rate))),
            );
            let time = relaxation_time.as_ref().map(written);
            text.extend(time.map(|time| format!(", relaxation_time = {time}")));
            text += " },\n";
        }
        text += "]\n";
    }
    Some(text)
}

/// A quantity as TOML, its unit kept.
fn written<K: QuantityKind>(quantity: &Quantity<K>) -> String {
    match (quantity.text(), quantity.si()) {
        (None, Ok(value)) => format!("{value:?}"),
        _ => quantity.to_string(),
    }
}

/// Gives a case made in code the tables of the materials that its bodies name.
pub(crate) fn fill(file: &mut CaseFile) {
    for body in &file.body {
        if let Some((name, entry)) =
            body.material.as_ref().and_then(|name| Some((name, find(name)?)))
        {
            file.material.entry(name.clone()).or_insert_with(|| entry.material.clone());
        }
    }
}

/// Puts the tables of the materials that the bodies of a tree name under those that it gives; spans
/// count from `start`. Whether there was one.
pub(crate) fn underlay(root: &mut DeTable<'_>, start: usize) -> bool {
    let names = named(root);
    if names.is_empty() {
        return false;
    }
    let Ok(mut library) = DeTable::parse(TEXT).map(Spanned::into_inner) else { return false };
    let mut is_used = false;
    for name in names {
        let Some(entry) = name.strip_prefix(PREFIX).and_then(|name| library.remove(name)) else {
            continue;
        };
        let DeValue::Table(mut entry) = shift(entry, start).into_inner() else { continue };
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

/// Keys of `below` that `given` lacks; what is no table, its reader refuses.
fn lay_under<'t>(given: &mut Spanned<DeValue<'t>>, below: Spanned<DeValue<'t>>) {
    if let (DeValue::Table(given), DeValue::Table(below)) = (given.get_mut(), below.into_inner()) {
        for (key, value) in below {
            given.entry(key).or_insert(value);
        }
    }
}

/// The names of materials of the library that bodies of a tree have, each once.
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
