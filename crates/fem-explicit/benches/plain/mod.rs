//! Elements one after the other in plain code, as a textbook has them: what faster loops are measured
//! against, on the machine of the moment.

use fem_element::QuadGeometry;
use fem_explicit::FreeMotion;
use fem_material::Material;
use fem_mesh::SphereMesh;

/// An elastic body that moves freely.
pub struct Plain {
    quads: Vec<[u32; 4]>,
    geometries: Vec<QuadGeometry>,
    /// k_rr, k_yy, k_ry of each element, N/m.
    hourglass: Vec<[f64; 3]>,
    inverse_mass: Vec<[f64; 2]>,
    bulk: f64,
    shear: f64,
    time_step: f64,
    displacement: Vec<[f64; 2]>,
    velocity: Vec<[f64; 2]>,
    forces: Vec<[f64; 2]>,
}

impl Plain {
    /// The body that `fast` computes, both undeformed and each node at a velocity (m/s) in proportion to
    /// its place; they are to move alike.
    pub fn beside(mesh: &SphereMesh, material: &Material, fast: &mut FreeMotion) -> Self {
        let mut plain = Self::new(mesh, material, fast);
        for _ in 0..100 {
            plain.step();
            fast.step();
        }
        let largest = |numbers: &mut dyn Iterator<Item = f64>| {
            numbers.fold(0.0, |most: f64, number| most.max(number.abs()))
        };
        let both = plain.displacement.as_flattened().iter().zip(fast.displacement().as_flattened());
        let apart = largest(&mut both.map(|(one, other)| one - other));
        let size = largest(&mut plain.displacement.as_flattened().iter().copied());
        assert!(apart < 1e-12 * size, "plain code computes another body");
        plain
    }

    fn new(mesh: &SphereMesh, material: &Material, fast: &FreeMotion) -> Self {
        let elements = 0..mesh.quads().len();
        let geometries: Vec<_> = elements.map(|k| QuadGeometry::new(&mesh.corners(k))).collect();
        let shear = material.instantaneous().shear_modulus();
        let n_nodes = mesh.nodes().len();
        Self {
            quads: mesh.quads().to_vec(),
            hourglass: (geometries.iter())
                .map(|geometry| geometry.hourglass_stiffness().map(|k| shear * k))
                .collect(),
            geometries,
            inverse_mass: (fast.body().nodal_mass().iter().enumerate())
                .map(|(node, mass)| match mesh.axis().contains(&(node as u32)) {
                    true => [0.0, mass.recip()],
                    false => [mass.recip(); 2],
                })
                .collect(),
            bulk: material.instantaneous().bulk_modulus(),
            shear,
            time_step: fast.time_step(),
            displacement: vec![[0.0; 2]; n_nodes],
            velocity: mesh.nodes().iter().map(|[r, y]| [*r, y - mesh.radius()]).collect(),
            forces: vec![[0.0; 2]; n_nodes],
        }
    }

    /// Moves the body by a step of central differences.
    pub fn step(&mut self) {
        let time_step = self.time_step;
        self.forces.fill([0.0; 2]);
        for element in 0..self.quads.len() {
            self.subtract_force(element);
        }
        for node in 0..self.forces.len() {
            for axis in 0..2 {
                let change = time_step * self.inverse_mass[node][axis] * self.forces[node][axis];
                self.velocity[node][axis] += change;
                self.displacement[node][axis] += time_step * self.velocity[node][axis];
            }
        }
    }

    /// Mean strain and hourglass amplitudes of an element, their stress, its forces.
    fn subtract_force(&mut self, element: usize) {
        let (quad, g) = (self.quads[element], &self.geometries[element]);
        let (mut rr, mut yy, mut tt, mut ry, mut h_r, mut h_y) = (0.0, 0.0, 0.0, 0.0, 0.0, 0.0);
        for a in 0..4 {
            let [r, y] = self.displacement[quad[a] as usize];
            rr += g.gradient_r[a] * r;
            yy += g.gradient_y[a] * y;
            tt += g.hoop[a] * r;
            ry += g.gradient_y[a] * r + g.gradient_r[a] * y;
            h_r += g.hourglass[a] * r;
            h_y += g.hourglass[a] * y;
        }
        let mean = (self.bulk - 2.0 / 3.0 * self.shear) * (rr + yy + tt);
        let [s_rr, s_yy, s_tt] = [rr, yy, tt].map(|e| g.volume * (mean + 2.0 * self.shear * e));
        let s_ry = g.volume * self.shear * ry;
        let [k_rr, k_yy, k_ry] = self.hourglass[element];
        let (q_r, q_y) = (k_rr * h_r + k_ry * h_y, k_ry * h_r + k_yy * h_y);
        for a in 0..4 {
            let force = &mut self.forces[quad[a] as usize];
            force[0] -= g.gradient_r[a] * s_rr
                + g.gradient_y[a] * s_ry
                + g.hoop[a] * s_tt
                + g.hourglass[a] * q_r;
            force[1] -= g.gradient_y[a] * s_yy + g.gradient_r[a] * s_ry + g.hourglass[a] * q_y;
        }
    }
}
