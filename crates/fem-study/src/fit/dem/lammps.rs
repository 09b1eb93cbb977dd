//! LAMMPS: `pair_style granular` with `hertz/material`.
//!
//! `damping viscoelastic` is η m* a with a = √(R* ξ), a Kelvin dashpot C √ξ, so that
//!
//! ```math
//! \eta = \frac{C}{m^*\sqrt{R^*}} = \frac{2E^*A}{m^*},
//! ```
//!
//! which is no material constant: another pair of sizes needs another η. `damping
//! coeff_restitution` is Tsuji's dashpot with Antypov & Elliott's exact coefficient. `damping tsuji`
//! is the same dashpot with a polynomial of the entered e (Marshall 2009, eq. 53),
//!
//! ```math
//! \alpha = 1.2728-4.2783e+11.087e^2-22.348e^3+27.467e^4-18.022e^5+4.8218e^6,
//! ```
//!
//! made for a mass that counts double: up to the release of 22 July 2025 the code applies it to m*
//! and damps too little by √2; later sources multiply by √2 (`gran_sub_mod_damping.cpp`).
//! `fix wall/gran` gives a wall the sphere's own modulus, E* = E/(2(1−ν²)): half of a rigid wall's. So
//! 2(1−ν²)E* of the contact is entered.
//! All of it checked by a collision in LAMMPS itself, `.ci/check_dem.py`.

use std::f64::consts::PI;

use fem_laws::bisection::last_where;
use fem_laws::laws::kuwabara_kono;
use fem_laws::{LawError, Pair};

use super::snippet::{
    Export, LAMMPS_COEFF_RESTITUTION, LAMMPS_TSUJI, LAMMPS_VISCOELASTIC, Snippet, short, time,
};

/// Which LAMMPS: the factor of its `tsuji`.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum TsujiVersion {
    /// Up to 22 July 2025: the polynomial as it is.
    Plain,
    /// Later: times √2.
    RootTwo,
}

/// Returns Marshall's polynomial at e.
fn polynomial(e: f64) -> f64 {
    let coefficients = [1.2728, -4.2783, 11.087, -22.348, 27.467, -18.022, 4.8218];
    coefficients.iter().rev().fold(0.0, |sum, coefficient| sum * e + coefficient)
}

/// α of F = K ξ^(3/2) + α √(m* K) ξ^(1/4) ξ̇ for an entered e.
fn tsuji_alpha(entered: f64, version: TsujiVersion) -> f64 {
    match version {
        TsujiVersion::Plain => polynomial(entered),
        TsujiVersion::RootTwo => 2f64.sqrt() * polynomial(entered),
    }
}

/// Returns the restitution that `damping tsuji` makes of an entered one, at zero overlap.
pub fn tsuji_outcome(entered: f64, version: TsujiVersion) -> f64 {
    let ratio = tsuji_alpha(entered, version).max(0.0) / 5f64.sqrt();
    (-PI * ratio / (1.0 - ratio * ratio).max(0.0).sqrt()).exp()
}

/// Returns the entry for which `damping tsuji` makes this restitution; `None` if no value from 0 to 1 does.
pub fn tsuji_entry(wanted: f64, version: TsujiVersion) -> Option<f64> {
    let reach = tsuji_outcome(0.0, version)..=tsuji_outcome(1.0, version);
    let entry = || last_where(0.0, 1.0, |entered| tsuji_outcome(entered, version) <= wanted);
    reach.contains(&wanted).then(entry)
}

/// Returns η, 1/(m s), of a pair with A, s.
///
/// # Errors
/// A negative or not finite.
pub fn viscoelastic_damping(pair: &Pair, dissipation_time: f64) -> Result<f64, LawError> {
    let law = kuwabara_kono(pair, dissipation_time)?;
    Ok(law.damping() / (pair.effective_mass() * pair.effective_radius().sqrt()))
}

/// Returns the snippets of the three dampings.
///
/// # Errors
/// The dissipation time is out of its range.
pub fn lammps_snippets(export: &Export) -> Result<Vec<Snippet>, LawError> {
    const FRICTIONLESS: &str = "Without friction; put in your own tangential model.";
    let e = export.hertz.restitution;
    let (dissipation_time, _) = export.dissipation_time;
    let eta = viscoelastic_damping(&export.pair, dissipation_time)?;
    let constant = export.snippet(
        LAMMPS_COEFF_RESTITUTION,
        &[("e", e)],
        &["One restitution for all speeds; the contact ends at zero overlap.", FRICTIONLESS],
        &commands(export, e, "coeff_restitution"),
    );
    let viscoelastic = export.snippet(
        LAMMPS_VISCOELASTIC,
        &[("eta", eta)],
        &[
            &format!(
                "A = {}: restitution falls with speed; the contact ends at zero force.",
                time(dissipation_time)
            ),
            &format!(
                "eta = 2 E* A/m_eff holds for this contact's sizes only (1/(m s)): {eta:.6e}."
            ),
            FRICTIONLESS,
        ],
        &commands(export, eta, "viscoelastic limit_damping"),
    );
    let tsuji = tsuji_entry(e, TsujiVersion::Plain).map(|entry| {
        let later = tsuji_entry(e, TsujiVersion::RootTwo);
        let later = later.map_or("nothing".to_string(), |later| format!("{later:.4}"));
        export.snippet(
            LAMMPS_TSUJI,
            &[("e", entry)],
            &[
                &format!(
                    "Entered {entry:.4}, wanted and made {e:.4}: up to the release of 22 July 2025"
                ),
                &format!("tsuji damps too little. Later sources correct it: there enter {later}."),
                FRICTIONLESS,
            ],
            &commands(export, entry, "tsuji"),
        )
    });
    Ok([constant, viscoelastic].into_iter().chain(tsuji).collect())
}

/// Returns the commands that set up the contact of two spheres, or of a sphere and a wall.
fn commands(export: &Export, entry: f64, damping: &str) -> String {
    let contact = |modulus: f64, poissons_ratio: f64| {
        format!(
            "hertz/material {} {} {} tangential linear_nohistory 0.0 0.0 damping {damping}",
            short(modulus),
            short(entry),
            short(poissons_ratio)
        )
    };
    if let [sphere] = &export.spheres[..] {
        let twice_the_plane_modulus =
            2.0 * (1.0 - sphere.poissons_ratio.powi(2)) * export.pair.contact_modulus();
        return format!(
            "# LAMMPS takes a wall for the sphere's own material: the modulus makes it a {}.\n\
             # Put your own wall in the place of zplane 0 NULL.\n\
             fix wall all wall/gran granular {} zplane 0 NULL\n",
            export.wall(),
            contact(twice_the_plane_modulus, sphere.poissons_ratio)
        );
    }
    let coefficients = export.per_sphere(|index, sphere| {
        let contact = contact(sphere.youngs_modulus, sphere.poissons_ratio);
        format!("pair_coeff {index} {index} {contact}\n")
    });
    format!(
        "pair_style granular\n{coefficients}# 1 2 is mixed by LAMMPS as Hertz' contact of unlike bodies is.\n{}",
        export.unlike_note()
    )
}
