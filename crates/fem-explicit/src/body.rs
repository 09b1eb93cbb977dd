//! One body as the solver sees it: constant over a run.

use fem_collision::{BodyFields, StressField};
use fem_material::{ActsOn, Material, RelaxationStep};
use fem_mesh::SphereMesh;

use crate::block::Blocks;
use crate::kernel::{Field, Moduli, strain_energy};

/// One Prony term at the run's time step.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Branch {
    pub weight: f64,
    pub relaxation_time: f64,
    /// Factor of the branch over a step.
    pub decay: f64,
    /// Share of a step's displacement increment.
    pub gain: f64,
}

/// How a body's stress depends on its past. Linear viscoelasticity needs one
/// nodal vector q a term: q̇ + q/τ = u̇, stepped exactly for constant rate. The
/// deviatoric stress sees w = g∞ u + Σ g_k q_k; the bulk stress sees w too, or u.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Relaxation {
    pub acts_on: ActsOn,
    pub equilibrium_weight: f64,
    pub branches: Vec<Branch>,
}

/// A body, constant over a run. A wall is a body of one node without elements
/// and with infinite mass.
#[derive(Debug, Clone)]
pub struct Body {
    pub(crate) blocks: Blocks,
    pub(crate) moduli: Moduli,
    pub(crate) relaxation: Option<Relaxation>,
    /// Lumped masses, mass scaling included, kg.
    pub(crate) nodal_mass: Vec<f64>,
    /// Inverse masses of (r, y); 0 for what cannot move.
    pub(crate) inverse_mass: Vec<[f64; 2]>,
    pub(crate) velocity: f64,
    mesh: Option<SphereMesh>,
    material: Option<Material>,
    mass: f64,
    added_mass: f64,
}

impl Body {
    /// A wall.
    pub(crate) fn wall(velocity: f64) -> Self {
        Self {
            blocks: Blocks::none(),
            moduli: Moduli { bulk: 0.0, shear: 0.0 },
            relaxation: None,
            nodal_mass: vec![0.0],
            inverse_mass: vec![[0.0; 2]],
            velocity,
            mesh: None,
            material: None,
            mass: f64::INFINITY,
            added_mass: 0.0,
        }
    }

    /// A sphere whose nodes carry `nodal_mass` (kg), `added_mass` of it by mass
    /// scaling, at the given time step (s).
    pub(crate) fn deformable(
        mesh: SphereMesh,
        material: &Material,
        velocity: f64,
        nodal_mass: Vec<f64>,
        added_mass: f64,
        time_step: f64,
    ) -> Self {
        let mut inverse_mass: Vec<_> = nodal_mass.iter().map(|m| [m.recip(); 2]).collect();
        for &node in mesh.axis() {
            inverse_mass[node as usize][0] = 0.0;
        }
        let moduli = Moduli {
            bulk: material.instantaneous().bulk_modulus(),
            shear: material.instantaneous().shear_modulus(),
        };
        let relaxation = material.relaxation().map(|series| Relaxation {
            acts_on: series.acts_on(),
            equilibrium_weight: series.equilibrium_weight(),
            branches: series
                .terms()
                .iter()
                .filter(|term| term.weight > 0.0)
                .map(|term| {
                    let step = RelaxationStep::new(term.relaxation_time, time_step);
                    Branch {
                        weight: term.weight,
                        relaxation_time: term.relaxation_time,
                        decay: step.decay,
                        gain: step.gain,
                    }
                })
                .collect(),
        });
        let mass = nodal_mass.iter().sum::<f64>() - added_mass;
        Self {
            blocks: Blocks::pack(&mesh),
            moduli,
            relaxation: relaxation.filter(|r| !r.branches.is_empty()),
            nodal_mass,
            inverse_mass,
            velocity,
            mesh: Some(mesh),
            material: Some(material.clone()),
            mass,
            added_mass,
        }
    }

    /// Its mesh; a wall has none.
    pub fn mesh(&self) -> Option<&SphereMesh> {
        self.mesh.as_ref()
    }

    /// Lumped masses of the nodes, mass scaling included, kg; a wall's one node has none.
    pub fn nodal_mass(&self) -> &[f64] {
        &self.nodal_mass
    }

    /// Its material; a wall has none.
    pub fn material(&self) -> Option<&Material> {
        self.material.as_ref()
    }

    /// Stress of its fields; a wall has none.
    pub fn stress(&self, fields: &BodyFields) -> StressField {
        match (&self.mesh, &self.material) {
            (Some(mesh), Some(material)) => StressField::of(mesh, material, fields),
            _ => StressField::default(),
        }
    }

    /// Mass without mass scaling, kg; infinite for a wall.
    pub fn mass(&self) -> f64 {
        self.mass
    }

    /// Mass added by mass scaling, kg.
    pub fn added_mass(&self) -> f64 {
        self.added_mass
    }

    /// Number of elements.
    pub fn n_elements(&self) -> usize {
        self.mesh.as_ref().map_or(0, |mesh| mesh.quads().len())
    }

    /// Number of nodes that carry the body; a wall has none to show.
    pub fn n_nodes(&self) -> usize {
        self.mesh.as_ref().map_or(0, |mesh| mesh.nodes().len())
    }

    /// Number of Prony branches whose history is kept.
    pub fn n_branches(&self) -> usize {
        self.relaxation.as_ref().map_or(0, |relaxation| relaxation.branches.len())
    }

    /// Mass with mass scaling, kg.
    pub(crate) fn total_mass(&self) -> f64 {
        self.mass + self.added_mass
    }

    /// Mass-weighted mean of a field's y component.
    pub(crate) fn centre(&self, field: &Field) -> f64 {
        if self.mesh.is_none() {
            return field[0][1];
        }
        self.sum_mass(field) / self.total_mass()
    }

    /// Σ m x_y, 0 for a wall.
    pub(crate) fn sum_mass(&self, field: &Field) -> f64 {
        self.nodal_mass.iter().zip(field).map(|(m, x)| m * x[1]).sum()
    }

    /// Strain energy (J) and dissipated power (W) of displacement `u` and branch
    /// displacements `q`.
    ///
    /// A branch of weight g stores ½ q·gK q and dissipates q·gK q / τ; the rest
    /// of the stiffness stores ½ u·K u.
    pub(crate) fn stored_and_dissipated(&self, u: &Field, q: &[Vec<[f64; 2]>]) -> (f64, f64) {
        let Some(relaxation) = &self.relaxation else {
            return (strain_energy(&self.blocks, self.moduli, u), 0.0);
        };
        let Moduli { bulk, shear } = self.moduli;
        let (relaxing_bulk, lasting_bulk) = match relaxation.acts_on {
            ActsOn::All => (bulk, relaxation.equilibrium_weight * bulk),
            ActsOn::Shear => (0.0, bulk),
        };
        let lasting = Moduli { bulk: lasting_bulk, shear: relaxation.equilibrium_weight * shear };
        let mut stored = 0.0;
        if lasting.bulk != 0.0 || lasting.shear != 0.0 {
            stored += strain_energy(&self.blocks, lasting, u);
        }
        let mut power = 0.0;
        for (branch, q) in relaxation.branches.iter().zip(q) {
            let moduli =
                Moduli { bulk: branch.weight * relaxing_bulk, shear: branch.weight * shear };
            let energy = strain_energy(&self.blocks, moduli, q);
            stored += energy;
            power += 2.0 * energy / branch.relaxation_time;
        }
        (stored, power)
    }
}
