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

use super::snippet::{Export, MUJOCO_CONTACT, Snippet, short, time};

/// Returns a contact with e and T of the linear law; none if they cannot be entered.
pub fn mujoco_snippets(export: &Export) -> Vec<Snippet> {
    let Ok(law) = export.linear_law(EndRule::ZeroForce) else { return Vec::new() };
    let mass = export.pair.effective_mass();
    let (stiffness, damping) = (law.stiffness() / mass, law.damping() / mass);
    let (e, contact_time) = (export.linear.restitution, export.linear.contact_time);
    let commands = format!(
        "<mujoco>\n  <option timestep=\"{}\" integrator=\"Euler\"/>\n  <default>\n    \
         <geom solref=\"-{} -{}\" solimp=\"0.9 0.9 0.001\" condim=\"1\"/>\n  </default>\n</mujoco>\n",
        short(contact_time / 100.0),
        short(stiffness),
        short(damping)
    );
    vec![export.snippet(
        MUJOCO_CONTACT,
        &[("stiffness", stiffness), ("damping", damping)],
        &[
            &format!("Makes e = {e:.4} in {}, of any sizes;", time(contact_time)),
            "the time step must be a fiftieth of that or less.",
        ],
        &commands,
    )]
}
