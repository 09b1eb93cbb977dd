//! Likely causes of an early stop, and the changes that prevent it.

use fem_collision::Stop;

/// The likely cause of a stop, and the change that prevents it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct StopAdvice {
    /// Most frequent cause of such a stop.
    pub cause: &'static str,
    /// Suggested change of the case.
    pub remedy: &'static str,
}

/// Returns the likely cause and the remedy; `None` for a run that the user stopped.
pub fn stop_advice(stop: &Stop) -> Option<StopAdvice> {
    let (cause, remedy) = match stop {
        Stop::Interrupted { .. } => return None,
        Stop::EnergyGrowth { .. } | Stop::NoNumber { .. } => (
            "the contact opens and closes faster than the time step resolves, an imported mesh has \
             elements that are far too distorted, or a material at finite strain loses stability under \
             load, as St Venant and Kirchhoff's does in compression",
            "leave out contact.method and contact.penalty_factor; if the run still fails, set time.step_factor = 0.5 and \
             time.mass_scaling = 0, or name another material.NAME.hyperelastic; if it fails even so, please report the case: \
             the step should be stable",
        ),
        Stop::StabilityLost { .. } => (
            "the law loses ellipticity at this strain: deformation localises in a band that depends on the mesh, so a \
             shorter step or a finer mesh does not help",
            "name another material.NAME.hyperelastic: \"neo-hooke\" is stable at any deformation; or lower \
             body.N.approach_speed",
        ),
        Stop::ElementCollapsed { .. } => (
            "the impact is faster than this material can be compressed, or an element is far too \
             distorted: at the rim of a contact, or of an imported mesh",
            "lower body.N.approach_speed, use a coarser mesh.contact_element_size, or name a \
             material.NAME.hyperelastic that stiffens as it is compressed",
        ),
        Stop::NoStepShortEnough { of_contact: true, .. } => (
            "a surface is about to turn over where the other body touches it: the impact is too fast or \
             the material too soft",
            "lower body.N.approach_speed, or check the moduli and their units",
        ),
        Stop::NoStepShortEnough { .. } => (
            "the material is strained beyond the range of its law: it stiffens without limit, or elements \
             are drawn out or far too distorted",
            "lower body.N.approach_speed, use a coarser mesh.contact_element_size, or name another \
             material.NAME.hyperelastic",
        ),
        Stop::ContactBeyondCandidates { .. } | Stop::ContactTooLarge { .. } => (
            "the contact is as wide as the smaller sphere: the impact is too fast or the material \
             too soft",
            "lower body.N.approach_speed, or check the moduli and their units",
        ),
        Stop::SurfaceTurnsOver { .. } => (
            "the flank of the body folds onto the other one: the impact is faster than the shear waves of the body, \
             \u{221a}(G/\u{3c1}), or the body flows and spreads; no element size, penalty factor, time step or law prevents \
             this",
            "lower body.N.approach_speed, or check the moduli, the yield strength and their units",
        ),
        Stop::NoSeparation { .. } => (
            "the material has relaxed so far that no stiffness is left to push the bodies apart, or a \
             moving wall keeps pushing",
            "check the decay rates, relaxation times and weights of material.NAME.relaxation and \
             their units: the weights' sum below 1 leaves a lasting stiffness",
        ),
        Stop::NoContact { .. } => (
            "the contact is narrower than the first element, so no spring lies inside it",
            "use a smaller mesh.contact_element_size, or meshes that are finer at the contact \
             (body.N.sphere.mesh)",
        ),
        Stop::TooManyUpdates { .. } => (
            "the limit is close to the estimated cost, or the bodies relax strongly and separate or come to rest later than \
             closed forms predict",
            "raise limits.element_updates, use a larger mesh.contact_element_size, or use model.condensed",
        ),
        Stop::EnergyImbalance { .. } => (
            "modes of vibration that the mesh does not resolve, or steps that are too long for them",
            "lower model.condensed.vibration_modes, or raise model.condensed.steps",
        ),
        Stop::NoContactState { .. } | Stop::NotMade(_) => (
            "an imported mesh has elements that are far too distorted, or Poisson's ratio is \
             within rounding of its limits",
            "leave body.N.sphere.mesh out, keep material.NAME.poissons_ratio off its limits, or use \
             model.fem",
        ),
        Stop::OutOfMemory(_) => (
            "the factors of condensed bodies take more memory than is available",
            "raise mesh.contact_element_size, or use model.fem, which stores no factors",
        ),
        Stop::NotFinished(_) => (
            "the damping is so strong that the bodies creep apart without end",
            "lower the damping, or end the contact earlier with model.law.NAME.end = \"zero_force\"",
        ),
        Stop::OutsideValidity(_) => (
            "the contact is too wide for the first-order correction of the spheres' size",
            "write model.ting.finite_size = false, or use model.fem",
        ),
        Stop::OutOfRange(_) => (
            "the case is so extreme that a result leaves the range of numbers",
            "check the parameters of model.law.NAME, body.N.sphere.diameter, body.N.approach_speed, \
             material.NAME.density and the moduli, and their units",
        ),
    };
    Some(StopAdvice { cause, remedy })
}
