//! MuJoCo: `solref` and `solimp` of a contact.
//!
//! MuJoCo prescribes accelerations: with the direct format of `solref`, (−κ, −β), and one impedance
//! for all depths, the bodies of a contact approach with
//!
//! ```math
//! \ddot\xi = -\kappa\,\xi - \beta\,\dot\xi,
//! ```
//!
//! while that pushes them apart (*MuJoCo documentation*, Computation, Solver parameters): a linear spring
//! and dashpot whose masses cancel, κ = k/m*, β = c/m*, and whose contact ends at zero force. So one
//! `solref` makes one e and one contact time for all sizes.
//! Run in MuJoCo by `.ci/check_robotics.py`.

use fem_laws::EndRule;

use super::snippet::{Export, Snippet, short, time};

/// Returns a contact with e and T of the linear law.
pub fn mujoco_snippets(export: &Export) -> Vec<Snippet> {
    // What cannot be entered is left out.
    let Ok(law) = export.linear_law(EndRule::ZeroForce) else { return Vec::new() };
    let mass = export.pair.effective_mass();
    let (stiffness, damping) = (law.stiffness() / mass, law.damping() / mass);
    let e = export.linear.restitution;
    let heading = export.heading(
        "MuJoCo, solref in its direct format",
        export.linear.validity,
        &[
            format!("Makes e = {e:.4} in {}, of any sizes;", time(export.linear.contact_time)),
            "the time step must be a fiftieth of that or less.".to_string(),
        ],
    );
    let heading = heading.replace("--", "-");
    let text = format!(
        "<!--\n{heading}-->\n<mujoco>\n  <option timestep=\"{}\" integrator=\"Euler\"/>\n  <default>\n    \
         <geom solref=\"-{} -{}\" solimp=\"0.9 0.9 0.001\" condim=\"1\"/>\n  </default>\n</mujoco>\n",
        short(export.linear.contact_time / 100.0),
        short(stiffness),
        short(damping)
    );
    vec![Snippet {
        name: "mujoco_contact.xml",
        code: "MuJoCo",
        model: "solref",
        entries: vec![("stiffness", stiffness), ("damping", damping)],
        restitution: Some(e),
        validity: export.linear.validity,
        text,
    }]
}
