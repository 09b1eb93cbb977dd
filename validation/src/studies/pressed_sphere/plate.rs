//! The plate on the far side, as a force on the nodes of the far half of the surface.
//!
//! ```math
//! f_a = -k A_a \langle Y_a + u_a - y \rangle, \qquad y = 2 - 2 v t
//! ```
//!
//! along y, with the area A_a of each node on the undeformed surface. The near plate is at rest, and the sphere's
//! centre approaches at v.

use std::f64::consts::PI;

use fem_collision::Account;
use fem_explicit::{Accounts, Field, Motion, NodalField, NodeForce, Part};
use fem_mesh::SphereMesh;

/// The far plate, its springs and its speed.
#[derive(Debug)]
pub struct FarPlate {
    springs: Vec<Spring>,
    /// Speed along −y, twice that of the centre.
    speed: f64,
}

#[derive(Debug)]
struct Spring {
    node: usize,
    /// Distance of the undeformed node from the far pole along y.
    depth: f64,
    stiffness: f64,
}

impl FarPlate {
    /// Creates the plate for the far half of a unit sphere; it moves at `speed` along −y, and `penalty` is per area.
    pub fn new(mesh: &SphereMesh, penalty: f64, speed: f64) -> Self {
        let place = |node: u32| mesh.nodes()[node as usize];
        let mut areas = vec![0.0; mesh.nodes().len()];
        for piece in mesh.surface().windows(2) {
            let [[r, y], [r_next, y_next]] = [place(piece[0]), place(piece[1])];
            let area = PI * (r + r_next) * (r_next - r).hypot(y_next - y);
            areas[piece[0] as usize] += 0.5 * area;
            areas[piece[1] as usize] += 0.5 * area;
        }
        let far = mesh.surface().iter().filter(|&&node| place(node)[1] > 1.0);
        let spring = |&node: &u32| Spring {
            node: node as usize,
            depth: 2.0 - place(node)[1],
            stiffness: penalty * areas[node as usize],
        };
        Self { springs: far.map(spring).collect(), speed: 2.0 * speed }
    }

    /// Returns the compressed springs and their compressions.
    fn pressed<'a>(&'a self, motion: &Motion<'a>) -> impl Iterator<Item = (&'a Spring, f64)> {
        let (come, displacement) = (self.speed * motion.time, motion.displacement);
        self.springs.iter().filter_map(move |spring| {
            let overlap = displacement[spring.node][1] + come - spring.depth;
            (overlap > 0.0).then_some((spring, overlap))
        })
    }

    fn force(&self, motion: &Motion<'_>) -> f64 {
        self.pressed(motion).map(|(spring, overlap)| spring.stiffness * overlap).sum()
    }
}

impl Part for FarPlate {
    /// Returns the work of the plate and its force.
    fn n_history(&self) -> usize {
        1
    }
}

impl NodeForce for FarPlate {
    fn add_forces(&self, motion: &Motion<'_>, _: &[NodalField], forces: &mut Field) -> f64 {
        let mut resultant = 0.0;
        for (spring, overlap) in self.pressed(motion) {
            forces[spring.node][1] -= spring.stiffness * overlap;
            resultant -= spring.stiffness * overlap;
        }
        resultant
    }

    fn advance(&self, motion: &Motion<'_>, history: &mut [NodalField]) {
        let force = self.force(motion);
        let [work, before] = history[0][0];
        let path = self.speed * motion.time_step;
        history[0][0] = [work + 0.5 * path * (before + force), force];
    }

    fn add_energies(&self, motion: &Motion<'_>, history: &[NodalField], accounts: &mut Accounts) {
        let stored = self.pressed(motion).map(|(spring, x)| 0.5 * spring.stiffness * x * x).sum();
        accounts.energies.add(Account::Contact, stored);
        accounts.energies.add(Account::WallWork, history[0][0][0]);
    }

    fn add_stiffness_bound(&self, bound: &mut [f64]) {
        for spring in &self.springs {
            bound[spring.node] += spring.stiffness;
        }
    }
}
