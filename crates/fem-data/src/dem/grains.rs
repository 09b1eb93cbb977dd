//! Inputs for all pairs of some grains at once: one e for all speeds of each pair, on Hertz' spring.
//!
//! A code's type, or phase, is a material at a size. E* of a pair is made of both in LIGGGHTS and MFIX;
//! LAMMPS takes E = 2(1−ν²)E* of an explicit `pair_coeff`.

use fem_laws::Pair;

use super::entries::mfix_entry;
use super::{Sphere, commented, short};

/// A material at a size: a type, or phase, of a code.
#[derive(Debug, Clone, PartialEq)]
pub struct Grain {
    /// Name of the material.
    pub material: String,
    /// Size and material of the grain.
    pub sphere: Sphere,
}

/// Two grains and their restitution.
#[derive(Debug, Clone, PartialEq)]
pub struct PairOfGrains {
    /// Indices of the grains, in order.
    pub grains: [usize; 2],
    /// The two grains as a pair.
    pub pair: Pair,
    /// Their restitution at all speeds.
    pub restitution: f64,
    /// The speeds at which e is an upper bound, with the reasons; empty if it is none.
    pub bounds: Vec<String>,
    /// Other comments on e, such as the speeds that are left out.
    pub notes: Vec<String>,
}

/// Returns each different comment on pairs, with the pairs that it is one of.
pub fn grouped(
    pairs: &[PairOfGrains],
    comments_of: impl Fn(&PairOfGrains) -> &[String],
) -> Vec<(&str, Vec<[usize; 2]>)> {
    let mut groups: Vec<(&str, Vec<[usize; 2]>)> = Vec::new();
    for pair in pairs {
        for text in comments_of(pair) {
            match groups.iter_mut().find(|(known, _)| known == text) {
                Some((_, found)) => found.push(pair.grains),
                None => groups.push((text, vec![pair.grains])),
            }
        }
    }
    groups
}

/// Returns the names and the texts of the files; pairs are in the order 11, 12, …, 22, ….
pub fn grain_snippets(grains: &[Grain], pairs: &[PairOfGrains]) -> Vec<(&'static str, String)> {
    let mut files = vec![
        ("lammps_pairs.in", lammps(grains, pairs)),
        ("liggghts_pairs.in", liggghts(grains, pairs)),
    ];
    // A restitution may be too small for MFIX.
    files.extend(mfix(grains, pairs).map(|text| ("mfix_pairs.dat", text)));
    files
}

fn heading(code: &str, kind: &str, grains: &[Grain], pairs: &[PairOfGrains]) -> String {
    let mut text = format!(
        "# {code}; one restitution a pair, for all speeds, SI units; where it is good: pairs.csv.\n\
         # Without friction; put in your own tangential model.\n"
    );
    for (index, Grain { material, sphere }) in grains.iter().enumerate() {
        let material = material.replace(char::is_control, " ");
        text += &format!("# {kind} {}: {material}, {} m\n", index + 1, short(sphere.diameter));
    }
    let bounds = grouped(pairs, |pair| &pair.bounds).into_iter().map(|group| ("WARNING: ", group));
    let notes = grouped(pairs, |pair| &pair.notes).into_iter().map(|group| ("", group));
    for (word, (comment, pairs)) in bounds.chain(notes) {
        let names = pairs.iter().map(|pair| format!("{} {}", pair[0] + 1, pair[1] + 1));
        let names = names.collect::<Vec<_>>().join(", ");
        text += &commented(&format!("{word}e of {names}: {comment}"));
    }
    text
}

fn lammps(grains: &[Grain], pairs: &[PairOfGrains]) -> String {
    let mut text = heading("LAMMPS, granular hertz/material", "type", grains, pairs);
    text += "pair_style granular\n";
    for PairOfGrains { grains: [first, second], pair, restitution, .. } in pairs {
        let poissons_ratio = grains[*first].sphere.poissons_ratio;
        text += &format!(
            "pair_coeff {} {} hertz/material {} {} {} tangential linear_nohistory 0.0 0.0 damping \
             coeff_restitution\n",
            first + 1,
            second + 1,
            short(2.0 * (1.0 - poissons_ratio.powi(2)) * pair.contact_modulus()),
            short(*restitution),
            short(poissons_ratio)
        );
    }
    text
}

fn liggghts(grains: &[Grain], pairs: &[PairOfGrains]) -> String {
    let n = grains.len();
    let all = |of: &dyn Fn(&Sphere) -> f64| -> String {
        grains.iter().map(|grain| " ".to_string() + &short(of(&grain.sphere))).collect()
    };
    let restitution = |first: usize, second: usize| {
        let wanted = [first.min(second), first.max(second)];
        pairs.iter().find(|pair| pair.grains == wanted).map_or(1.0, |pair| pair.restitution)
    };
    let matrix = |of: &dyn Fn(usize, usize) -> f64| -> String {
        let rows = (0..n).flat_map(|first| (0..n).map(move |second| (first, second)));
        rows.map(|(first, second)| " ".to_string() + &short(of(first, second))).collect()
    };
    heading("LIGGGHTS, gran model hertz", "type", grains, pairs)
        + &format!(
            "fix m1 all property/global youngsModulus peratomtype{}\n\
             fix m2 all property/global poissonsRatio peratomtype{}\n\
             fix m3 all property/global coefficientRestitution peratomtypepair {n}{}\n\
             fix m4 all property/global coefficientFriction peratomtypepair {n}{}\n\
             pair_style gran model hertz tangential history\npair_coeff * *\n",
            all(&|sphere| sphere.youngs_modulus),
            all(&|sphere| sphere.poissons_ratio),
            matrix(&restitution),
            matrix(&|_, _| 0.0)
        )
}

fn mfix(grains: &[Grain], pairs: &[PairOfGrains]) -> Option<String> {
    let mut text = heading("MFIX-DEM, Hertzian", "phase", grains, pairs);
    text += "  des_coll_model = 'HERTZIAN'\n";
    for (index, Grain { sphere, .. }) in grains.iter().enumerate() {
        let phase = index + 1;
        let [diameter, density, young, poisson] = sphere.texts();
        text += &format!(
            "  d_p0({phase}) = {diameter}\n  ro_s0({phase}) = {density}\n  \
             e_young({phase}) = {young}\n  v_poisson({phase}) = {poisson}\n"
        );
    }
    text += "  # Entered for what comes out: HERTZIAN damps too little.\n";
    for (index, pair) in pairs.iter().enumerate() {
        let (place, [first, second]) = (index + 1, pair.grains.map(|grain| grain + 1));
        let entry = mfix_entry(pair.restitution)?;
        text += &format!(
            "  des_en_input({place}) = {}   # {first} with {second}, makes {:.4}\n  \
             des_et_input({place}) = 1.0\n",
            short(entry),
            pair.restitution
        );
    }
    Some(text)
}
