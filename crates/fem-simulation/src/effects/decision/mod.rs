//! The effects, and the trait that each implements: its relevance to a scene, its transformation of the scene,
//! and the error of neglecting it.

pub(super) mod neglect_error;
pub(super) mod relevance;
pub(super) mod simplified_scene;
pub(super) mod support;

use fem_case::{EffectsTable, Scene, Switch};
use fem_collision::Collision;

use self::neglect_error::{EffectStatus, NeglectError};
use self::relevance::Relevance;
use self::simplified_scene::TransformedScene;
use self::support::{Adequacy, ConsideredModel, Support};
use crate::estimate::Estimate;
use crate::quantity_errors::QuantityErrors;
use crate::rejection::Rejection;

/// The kind of an effect.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum EffectKind {
    /// The effect changes what bodies do.
    Physical,
    /// The effect changes how a computation goes.
    Numerical,
}

/// The name of an effect, its kind and its switch in a case.
pub trait NamedEffect: Sync {
    /// Returns the effect's name in results.
    fn name(&self) -> &'static str;

    /// Returns whether the effect is physics or a part of the computation.
    fn kind(&self) -> EffectKind;

    /// Returns an explanation of the effect in one sentence, for reports and the page.
    fn explanation(&self) -> &'static str;

    /// Returns the case's switch for the effect, if `[effects]` has one.
    fn switch(&self, effects: &EffectsTable) -> Option<Switch>;

    /// Returns the scene with another setting of the switch.
    fn switched(&self, scene: &Scene, switch: Option<Switch>) -> Scene;
}

macro_rules! effects {
    ($($(#[doc = $doc:literal])+ $kind:ident $effect:ident = $name:literal $($key:ident)?: $words:literal;)+) => {
        $(
            $(#[doc = $doc])+
            #[derive(Clone, Copy, Debug)]
            pub struct $effect;

            impl $effect {
                /// The effect's name in results.
                pub const NAME: &'static str = $name;
            }

            impl NamedEffect for $effect {
                fn name(&self) -> &'static str {
                    Self::NAME
                }

                fn kind(&self) -> EffectKind {
                    EffectKind::$kind
                }

                fn explanation(&self) -> &'static str {
                    $words
                }

                fn switch(&self, _effects: &EffectsTable) -> Option<Switch> {
                    None$(.or(_effects.$key))?
                }

                fn switched(&self, scene: &Scene, _switch: Option<Switch>) -> Scene {
                    let effects = EffectsTable { $($key: _switch,)? ..*scene.effects() };
                    scene.clone().with_effects(effects)
                }
            }
        )+

        /// All effects, in the order in which results show them.
        pub const EFFECTS: [&dyn Effect; [$($name),+].len()] = [$(&$effect),+];
    };
}

// One row per effect: its kind, its name in results, its key in `[effects]` if it can be switched, and its explanation.
effects! {
    /// Relaxation of the materials.
    Physical Viscoelasticity = "viscoelasticity" viscoelasticity:
        "The material relaxes while it is compressed and gives back less energy than it took.";
    /// Loss of a material whose relaxation is not known.
    Physical MaterialLoss = "material loss":
        "A material without a relaxation is computed as elastic: its own loss is missing.";
    /// The dashpot of a contact law.
    Physical DashpotEffect = "dashpot":
        "The law's dashpot resists the approach and stands for all losses together.";
    /// Compliance of the spheres beyond that of half-spaces.
    Physical FiniteSizeEffect = "finite size":
        "A sphere also deforms as a whole, not only at its contact.";
    /// Finite strain and rotations.
    Physical FiniteStrain = "finite strain" finite_strain:
        "At strains of several per cent the change of shape changes stiffness and contact.";
    /// Tangential slip between the surfaces of unlike materials.
    Physical SurfaceSlip = "surface slip" surface_slip:
        "Surfaces of unlike materials slide on each other as they are pressed together.";
    /// Friction of the surfaces.
    Physical FrictionEffect = "friction":
        "Surfaces that slide resist it, and turn and slow down what meets obliquely.";
    /// Slip along r between unlike bodies under friction.
    Physical TangentialCoupling = "tangential coupling":
        "Unlike bodies slip on each other already when they are pressed together, which takes part of the friction.";
    /// Plastic flow of the bodies.
    Physical PlasticFlow = "plastic flow" plastic_flow:
        "Above its yield strength a material deforms permanently and keeps a dent.";
    /// Dependence of the flow stress on the strain rate.
    Physical RateDependence = "rate dependence":
        "Metals are stronger at the strain rates of an impact than in a tensile test.";
    /// Attraction of the surfaces.
    Physical AdhesionEffect = "adhesion":
        "Surfaces attract each other: slow bodies stick, and faster ones lose energy.";
    /// Bending of a plate that is struck.
    Physical PlateBending = "plate bending" plate_bending:
        "A plate bends under the impact, and its bending waves carry energy away.";
    /// Waves radiated into a large partner.
    Physical PartnerWaves = "partner waves" partner_waves:
        "Waves that do not return from a large body within the contact carry energy away.";
    /// Two identical bodies computed as one against a rigid plane.
    Numerical MirrorSymmetry = "mirror symmetry" mirror_symmetry:
        "Two equal bodies are mirror images of each other, so only one is computed.";
    /// The stiffer body computed as a rigid one.
    Physical RigidPartner = "rigid partner" rigid_partner:
        "A much stiffer partner hardly deforms and is treated as rigid.";
    /// Inertia of the bodies' own deformation.
    Physical Vibration = "vibration":
        "A struck body keeps vibrating after the contact and retains that energy.";
    /// Hourglass control: the stiffness that elements with one integration point need against deformation modes
    /// without mean strain.
    Numerical HourglassControl = "hourglass control" hourglass_control:
        "Elements with one stress point have deformation modes without stiffness; a small one suppresses them.";
    /// Artificial viscosity that spreads steep fronts over several elements.
    Numerical BulkViscosity = "bulk viscosity" bulk_viscosity:
        "An artificial viscosity spreads steep wave fronts of fast impacts over a few elements.";
    /// Penalty springs at integration points, which resist penetration, in place of a contact that allows none.
    Numerical PenaltySprings = "penalty springs":
        "Springs keep the surfaces apart and allow a small overlap.";
    /// Weight of the bodies.
    Physical Gravity = "gravity":
        "Weight acts before, during and after the contact.";
    /// The candidate region of the contact search.
    Numerical ContactSearch = "contact search":
        "Contact is searched for only as far from the axis as it can reach.";
    /// Mass scaling: mass moved to light nodes for a longer time step.
    Numerical MassScaling = "mass scaling":
        "Mass is moved to the lightest nodes, which allows longer time steps.";
}

/// Returns the effect of this name.
pub(crate) fn effect_named(name: &str) -> Option<&'static dyn Effect> {
    EFFECTS.into_iter().find(|effect| effect.name() == name)
}

/// A physical or numerical effect that a collision may show or a computation may need.
pub trait Effect: NamedEffect {
    /// Returns whether the scene calls for the effect, or `None` if only the built model can decide.
    fn relevance(&self, _: &Scene, _: &Estimate) -> Option<Relevance> {
        None
    }

    /// Returns the scene with the effect applied, or `None` if the effect leaves the scene unchanged. The
    /// estimate belongs to the given scene.
    ///
    /// # Errors
    /// A switch that the scene's bodies do not allow.
    fn transform(&self, _: &Scene, _: &Estimate) -> Result<Option<TransformedScene>, Rejection> {
        Ok(None)
    }

    /// Returns a warning if the case's switch transforms the scene differently from the plan's own choice.
    fn forced(&self, _: &Scene, _: &Estimate) -> Option<String> {
        None
    }

    /// Returns the change of restitution, contact time and peak force without the effect, whether or not it
    /// is called for; `None` if closed forms cannot estimate it.
    fn neglect_error(&self, _: &Scene, _: &Estimate) -> Option<NeglectError> {
        None
    }

    /// Returns the model-form error because of the effect. It is the error of neglecting the effect if the
    /// model lacks it, and zero for purely numerical effects.
    fn model_form_error(
        &self,
        scene: &Scene,
        estimate: &Estimate,
        status: &EffectStatus,
    ) -> QuantityErrors {
        status.error(self, scene, estimate)
    }

    /// Returns how well a model computes the effect, for an effect by which models differ.
    fn adequacy(&self, _: &ConsideredModel) -> Adequacy {
        Adequacy::FULL
    }

    /// Returns whether a model that always includes the effect shows it although the case switches it off.
    fn is_never_off(&self, model: &ConsideredModel) -> bool {
        is_needed(self, model.case, model.estimate)
    }

    /// Returns whether the effect takes energy and makes the contact softer, so that results without it are bounds from a
    /// known side.
    fn is_dissipative(&self) -> bool {
        false
    }

    /// Returns the names of effects whose warnings are pointless where this one is needed and the model lacks it.
    fn silences(&self, _: &Scene, _: &Estimate) -> &'static [&'static str] {
        &[]
    }

    /// Returns the support that the finished collision shows, for an effect that depends on the bodies as
    /// computed.
    fn support_in_result(&self, _: &Scene, _: &Collision) -> Option<Support> {
        None
    }

    /// Returns warnings that follow from the finished collision and could not be given before.
    fn warnings_of_result(&self, _: &Scene, _: &Estimate, _: &Collision) -> Vec<String> {
        Vec::new()
    }
}

/// Returns whether a scene calls for an effect.
pub(crate) fn is_needed<E: Effect + ?Sized>(
    effect: &E,
    scene: &Scene,
    estimate: &Estimate,
) -> bool {
    effect.relevance(scene, estimate).is_some_and(|relevance| relevance.is_needed)
}
