//! Lethe: `hertz_mindlin_limit_overlap` between particles, `nonlinear` with walls.
//!
//! ```math
//! F = \tfrac23S\,\xi - 2\sqrt{\tfrac56}\,\beta\sqrt{S\,m^*}\,\dot\xi, \qquad S = 2E^*\sqrt{R^*\xi}, \qquad
//! \beta = \frac{\ln e}{\sqrt{\pi^2+\ln^2e}}
//! ```
//!
//! (*Lethe documentation*, DEM theory; `particle_particle_contact_force.h`): Tsuji's dashpot with Antypov &
//! Elliott's exact coefficient, ended at zero overlap, constants in five digits. e of a pair is the harmonic
//! mean of both bodies', so both get the pair's. Read, not run.

use super::snippet::{Export, LETHE, Snippet, short};

/// Returns the sections of a parameter file.
pub fn lethe_snippets(export: &Export) -> Vec<Snippet> {
    let e = export.hertz.restitution;
    let mut text = "subsection model parameters\n  \
         set particle particle contact force method = hertz_mindlin_limit_overlap\n  \
         set particle wall contact force method     = nonlinear\nend\n\
         subsection lagrangian physical properties\n"
        .to_string();
    let is_one = export.spheres.len() == 2 && export.spheres.first() == export.spheres.last();
    let kinds = if is_one { &export.spheres[..1] } else { &export.spheres[..] };
    text += &format!("  set number of particle types = {}\n", kinds.len());
    for (index, sphere) in kinds.iter().enumerate() {
        let [diameter, density, young, poisson] = sphere.texts();
        text += &format!(
            "  subsection particle type {index}\n    \
             set size distribution type            = uniform\n    \
             set diameter                          = {diameter}\n    \
             set density particles                 = {density}\n    \
             set young modulus particles           = {young}\n    \
             set poisson ratio particles           = {poisson}\n    \
             set restitution coefficient particles = {}\n    \
             set friction coefficient particles    = 0\n    \
             set rolling friction particles        = 0\n  end\n",
            short(e)
        );
    }
    match &export.spheres[..] {
        [sphere] => {
            text += &format!(
                "  # A {}, of Poisson's ratio 0.\n  \
                 set young modulus wall           = {}\n  \
                 set poisson ratio wall           = 0\n  \
                 set restitution coefficient wall = {}\n  \
                 set friction coefficient wall    = 0\n",
                export.wall(),
                short(export.wall_modulus(sphere)),
                short(e)
            );
        }
        _ => text += export.unlike_note(),
    }
    text += "end\n";
    vec![export.snippet(
        LETHE,
        &[("restitution coefficient", e)],
        &[
            "One restitution for all speeds; the contact ends at zero overlap.",
            "Without friction; put in your own.",
        ],
        &text,
    )]
}
