//! The rows of the table of what effects cost: a line an effect, off and on.

use fem::{Case, Course, Explicit, Label, Model, Simulation, SnapshotRequest, Want};
use std::path::Path;

/// The glass pair without relaxation, at default settings.
/// Eight elements across the contact, and hardly any mass moved: what an effect costs shows in many steps.
const FINE: [&str; 3] =
    ["accuracy.tolerance='0.3 %'", "mesh.staggered=false", "time.mass_scaling=2e-4"];
const GLASS: &str = include_str!("../../../../cases/glass_0.5ms_elastic.toml");
/// Two like bodies: the smaller becomes the larger.
const TWINS: &str = "body.1.sphere.diameter='22.2 mm'";

/// The larger one of a stiffer glass.
const STIFF: [&str; 2] = [
    "material.stiff={density=2390, youngs_modulus=6.3e12, poissons_ratio=0.244}",
    "body.0.material='stiff'",
];
/// The larger one of a softer glass.
const SOFT: [&str; 2] = [
    "material.soft={density=2390, youngs_modulus=3.15e10, poissons_ratio=0.1}",
    "body.0.material='soft'",
];
/// The smaller one on what does not end, and the weight that it may have there.
const FLOOR: &str = "body.0={name='floor', wall={}}";
const BLOCK: &str = "body.0={name='block', half_space={}, material='glass'}";
const FALLING: &str = "body.1.approach_speed=0.5";
const WEIGHT: &str = "gravity.acceleration=9.81";

/// What a run keeps beside the quantities of the collision.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kept {
    /// Nothing.
    Quantities,
    /// A thousand rows.
    History,
    /// The states at the four instants that have a name.
    Snapshots,
    /// Those, and their stress.
    Stress,
}

/// A run: what it changes of the glass pair, and what it keeps.
#[derive(Clone, Copy, Debug)]
pub struct Side {
    /// As `--set` writes them.
    pub overrides: &'static [&'static str],
    /// What it keeps.
    pub kept: Kept,
}

/// An effect, or what a run keeps only where it is asked to.
#[derive(Clone, Copy, Debug)]
pub struct Row {
    /// Its name in results.
    pub name: &'static str,
    /// Which of its kinds.
    pub kind: &'static str,
    /// Without it; `None` of what every run of explicit elements has.
    pub off: Option<Side>,
    /// With it.
    pub on: Side,
}

const BARE: Side = of(&[]);

/// The glass pair with these changes; nothing is kept.
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

/// All rows, in the order of the page.
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
    // With viscosity springs are between nodes that have mass.
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

    /// Its scene, ready to be computed.
    pub fn simulation(&self) -> Simulation {
        let mut simulation = Simulation::new(self.case()).expect("a scene");
        simulation.ask_for(self.want()).expect("a run");
        simulation
    }

    /// The model of one contact of a scene with several, which has a memory.
    pub fn contact(&self) -> Option<Explicit> {
        let case = self.case();
        case.scene().gravity()?;
        Some(Explicit::new(case.scene()).expect("a scene"))
    }

    /// Its run, of one contact, or of a simulation that has no more.
    pub fn start(&self, contact: Option<&Explicit>, simulation: &Simulation) -> Box<dyn Course> {
        match contact {
            Some(model) => {
                let course = model.start(&model.setup().approach, &self.want());
                course.expect("explicit elements go in steps")
            }
            None => simulation.start(),
        }
    }

    fn want(&self) -> Want {
        match self.kept {
            Kept::Quantities => Want::quantities(),
            Kept::History => Want::history(),
            Kept::Snapshots | Kept::Stress => {
                let snapshots = SnapshotRequest::Labels(Label::ALL.to_vec());
                Want { snapshots, ..Want::quantities() }
            }
        }
    }
}

/// Bytes of all that a run knows between two steps: what a restart needs.
pub fn n_bytes(course: &dyn Course) -> usize {
    let memory = course.memory().expect("explicit elements have a memory");
    postcard::to_stdvec(memory.contact()).expect("a memory is bytes").len()
}
