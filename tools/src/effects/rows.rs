//! The rows of the table of the effects' cost: one per effect, off and on.

use fem::{
    Case, Explicit, Model, OutputRequest, Simulation, SnapshotInstant, SnapshotRequest, Stepper,
};
use std::path::Path;

/// Overrides of the glass pair without relaxation: eight elements across the contact radius and little mass
/// scaling, so that the cost of an effect shows over many steps.
const FINE: [&str; 3] =
    ["accuracy.tolerance='0.3 %'", "mesh.staggered=false", "time.mass_scaling=2e-4"];
const GLASS: &str = include_str!("../../../cases/glass_0.5ms_elastic.toml");
/// Two equal bodies: the smaller one becomes like the larger one.
const TWINS: &str = "body.1.sphere.diameter='22.2 mm'";

/// The larger body is of a stiffer glass.
const STIFF: [&str; 2] = [
    "material.stiff={density=2390, youngs_modulus=6.3e12, poissons_ratio=0.244}",
    "body.0.material='stiff'",
];
/// The larger body is of a softer glass.
const SOFT: [&str; 2] = [
    "material.soft={density=2390, youngs_modulus=3.15e10, poissons_ratio=0.1}",
    "body.0.material='soft'",
];
/// The smaller body falls on a floor.
const FLOOR: &str = "body.0={name='floor', wall={}}";
const BLOCK: &str = "body.0={name='block', half_space={}, material='glass'}";
const FALLING: &str = "body.1.approach_speed=0.5";
const WEIGHT: &str = "gravity.acceleration=9.81";

/// Records of a run in addition to the quantities of interest.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kept {
    /// Only the quantities of interest.
    Quantities,
    /// A history of a thousand rows.
    History,
    /// The states at the four named instants.
    Snapshots,
    /// These states and their stress.
    Stress,
}

/// A run: the changes of the glass pair, and its records.
#[derive(Clone, Copy, Debug)]
pub struct Side {
    /// Overrides, as for `--set`.
    pub overrides: &'static [&'static str],
    /// The records of the run.
    pub kept: Kept,
}

/// An effect, or something that a run records only on request.
#[derive(Clone, Copy, Debug)]
pub struct Row {
    /// Name in results.
    pub name: &'static str,
    /// The variant of the effect.
    pub kind: &'static str,
    /// The run without it; `None` if every run with explicit elements has it.
    pub off: Option<Side>,
    /// The run with it.
    pub on: Side,
}

const BARE: Side = of(&[]);

/// Creates the run of the glass pair with these changes that records nothing more.
const fn of(overrides: &'static [&'static str]) -> Side {
    Side { overrides, kept: Kept::Quantities }
}

const fn keeping(kept: Kept) -> Side {
    Side { kept, ..BARE }
}

const fn row(name: &'static str, kind: &'static str, off: Side, on: Side) -> Row {
    Row { name, kind, off: Some(off), on }
}

const fn always(name: &'static str, kind: &'static str) -> Row {
    Row { name, kind, off: None, on: BARE }
}

/// All rows in the order of the page.
pub const ROWS: &[Row] = &[
    row(
        "viscoelasticity",
        "all moduli, one term",
        BARE,
        of(&["material.glass.relaxation={acts_on='all', terms=[{weight=1.0, decay_rate=2708}]}"]),
    ),
    row(
        "viscoelasticity",
        "all moduli, three terms",
        BARE,
        of(&["material.glass.relaxation={acts_on='all', terms=[{weight=0.2, decay_rate=1e3}, \
              {weight=0.2, decay_rate=1e4}, {weight=0.2, decay_rate=1e5}]}"]),
    ),
    row(
        "viscoelasticity",
        "shear modulus, one term",
        BARE,
        of(&["material.glass.relaxation={acts_on='shear', terms=[{weight=1.0, decay_rate=2708}]}"]),
    ),
    row("finite strain", "neo-Hooke, forced on", BARE, of(&["effects.finite_strain='on'"])),
    row(
        "finite strain",
        "neo-Hooke that relaxes, one term, forced on",
        of(&["material.glass.relaxation={acts_on='all', terms=[{weight=1.0, decay_rate=2708}]}"]),
        of(&[
            "material.glass.relaxation={acts_on='all', terms=[{weight=1.0, decay_rate=2708}]}",
            "effects.finite_strain='on'",
        ]),
    ),
    row(
        "mirror symmetry",
        "like bodies",
        of(&[TWINS, "effects.mirror_symmetry='off'"]),
        of(&[TWINS, "effects.mirror_symmetry='on'"]),
    ),
    row(
        "rigid partner",
        "100 times stiffer, forced on",
        of(&[STIFF[0], STIFF[1], "effects.rigid_partner='off'"]),
        of(&[STIFF[0], STIFF[1], "effects.rigid_partner='on'"]),
    ),
    row(
        "surface slip",
        "unlike bodies",
        of(&[SOFT[0], SOFT[1], "effects.surface_slip='off'"]),
        of(&[SOFT[0], SOFT[1]]),
    ),
    row("partner waves", "a half-space for a wall", of(&[FLOOR, FALLING]), of(&[BLOCK, FALLING])),
    row("gravity", "of one contact", of(&[FLOOR, FALLING]), of(&[FLOOR, FALLING, WEIGHT])),
    // With viscosity the springs are between nodes with mass.
    row(
        "bulk viscosity",
        "forced on",
        of(&["contact.method='penalty'"]),
        of(&["effects.bulk_viscosity='on'"]),
    ),
    row("mass scaling", "2e-4 of the mass", of(&["time.mass_scaling=0"]), BARE),
    row("history", "1000 rows", BARE, keeping(Kept::History)),
    row("snapshots", "four", BARE, keeping(Kept::Snapshots)),
    row("stress recovery", "of four snapshots", keeping(Kept::Snapshots), keeping(Kept::Stress)),
    always("hourglass control", "in the elements' own loop"),
    always("contact search", "points that can touch"),
];

impl Side {
    fn case(&self) -> Case {
        let overrides =
            FINE.iter().chain(self.overrides).map(ToString::to_string).collect::<Vec<_>>();
        Case::parse("glass.toml", GLASS, Path::new("."), &overrides).expect("a case")
    }

    /// Returns the simulation of the run.
    pub fn simulation(&self) -> Simulation {
        let simulation = Simulation::new(self.case()).expect("a scene");
        simulation.with_output_request(self.request()).expect("a run")
    }

    /// Returns the model of one contact for a scene with several.
    pub fn contact(&self) -> Option<Explicit> {
        let case = self.case();
        case.scene().gravity()?;
        Some(Explicit::new(case.scene()).expect("a scene"))
    }

    /// Starts the run of one contact, or of the simulation if it has only one.
    pub fn start(&self, contact: Option<&Explicit>, simulation: &Simulation) -> Box<dyn Stepper> {
        match contact {
            Some(model) => {
                let stepper = model.start(&model.setup().approach, &self.request());
                stepper.expect("explicit elements go in steps")
            }
            None => simulation.start(),
        }
    }

    fn request(&self) -> OutputRequest {
        match self.kept {
            Kept::Quantities => OutputRequest::quantities(),
            Kept::History => OutputRequest::history(),
            Kept::Snapshots | Kept::Stress => {
                let snapshots = SnapshotRequest::Labels(SnapshotInstant::OF_CONTACT.to_vec());
                OutputRequest { snapshots, ..OutputRequest::quantities() }
            }
        }
    }
}

/// Returns the bytes of the restart state.
pub fn n_bytes(stepper: &dyn Stepper) -> usize {
    let state = stepper.restart_state().expect("explicit elements have a restart state");
    postcard::to_stdvec(state.contact()).expect("a restart state can be serialised").len()
}
