//! The bodies that benchmarks move: the larger sphere of the glass pair.

use std::fmt::{self, Display, Formatter};

use fem_explicit::FreeMotion;
use fem_material::finite::HyperelasticLaw;
use fem_material::{ActsOn, ElasticModuli, Material, PronySeries, PronyTerm};
use fem_mesh::{HalfDisc, SphereMesh};

const RADIUS: f64 = 11.1e-3;

/// These constructions cannot fail.
pub type Error = Box<dyn std::error::Error>;

/// A way to compute an element: its name, the weights of relaxation terms and what they act on.
#[derive(Debug, Clone, Copy)]
pub struct Kind {
    name: &'static str,
    weights: &'static [f64],
    acts_on: ActsOn,
    is_finite: bool,
    /// Whether the nodes are in the order of a mesh that is made here, and not in none, as a file may have them.
    is_ordered: bool,
}

/// Hooke's law on a mesh that is made here.
pub const ELASTIC: Kind = Kind {
    name: "elastic",
    weights: &[],
    acts_on: ActsOn::All,
    is_finite: false,
    is_ordered: true,
};

/// All, in the order of the table.
pub const KINDS: [Kind; 7] = [
    ELASTIC,
    Kind { name: "elastic, nodes in no order", is_ordered: false, ..ELASTIC },
    Kind { name: "all moduli relax, one term", weights: &[0.5], ..ELASTIC },
    Kind { name: "all moduli relax, three terms", weights: &[0.4, 0.3, 0.2], ..ELASTIC },
    Kind { name: "shear relaxes, one term", weights: &[0.5], acts_on: ActsOn::Shear, ..ELASTIC },
    Kind { name: "finite strain, neo-Hooke", is_finite: true, ..ELASTIC },
    Kind {
        name: "finite strain that relaxes, one term",
        weights: &[0.5],
        is_finite: true,
        ..ELASTIC
    },
];

impl Display for Kind {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        f.write_str(self.name)
    }
}

impl Kind {
    /// A sphere that breathes, its elements at the contact of a size (m).
    pub fn sphere(self, size: f64) -> Result<FreeMotion, Error> {
        let (mesh, glass) = (mesh(size)?, glass(self.weights, self.acts_on)?);
        let mesh = if self.is_ordered { mesh } else { unordered(&mesh)? };
        let mut sphere = match self.is_finite {
            true => FreeMotion::at_finite_strain(mesh, &glass, HyperelasticLaw::NeoHooke, 0.9)?,
            false => FreeMotion::new(mesh, &glass, 0.9)?,
        };
        sphere.set_velocity(|[r, y]| [r, y - RADIUS]);
        Ok(sphere)
    }
}

/// The mesh of the elastic one, and what it is made of.
pub fn mesh_and_glass(contact_element_size: f64) -> Result<(SphereMesh, Material), Error> {
    Ok((mesh(contact_element_size)?, glass(&[], ActsOn::All)?))
}

/// Contact radius 0.22 mm, refined a fifth further.
fn mesh(contact_element_size: f64) -> Result<SphereMesh, Error> {
    let disc = HalfDisc {
        radius: RADIUS,
        contact_element_size,
        refined_radius: 0.27e-3,
        growth: None,
        edge: None,
    };
    Ok(disc.build()?)
}

/// Glass that relaxes by terms of these weights.
fn glass(weights: &[f64], acts_on: ActsOn) -> Result<Material, Error> {
    let moduli = ElasticModuli::from_youngs_modulus_poissons_ratio(63e9, 0.244)?;
    let term = |&weight: &f64| PronyTerm { weight, relaxation_time: 1e-4 * weight };
    let series = PronySeries::new(weights.iter().map(term).collect(), acts_on);
    let relaxation = if weights.is_empty() { None } else { Some(series?) };
    Ok(Material::new(2390.0, moduli, relaxation)?)
}

/// The mesh with its nodes numbered in another order, none next to its neighbour on the mesh.
fn unordered(mesh: &SphereMesh) -> Result<SphereMesh, Error> {
    let n = mesh.nodes().len();
    let common = |mut a: usize, mut b: usize| {
        while b != 0 {
            (a, b) = (b, a % b);
        }
        a
    };
    // A step that has no factor in common with the number of nodes visits all.
    let step = (n / 3..n).find(|&step| common(step, n) == 1).unwrap_or(1);
    let mut nodes = mesh.nodes().to_vec();
    for (k, node) in mesh.nodes().iter().enumerate() {
        nodes[k * step % n] = *node;
    }
    let number = |node: u32| (node as usize * step % n) as u32;
    let quads = mesh.quads().iter().map(|quad| quad.map(number)).collect();
    Ok(SphereMesh::import(mesh.radius(), nodes, quads)?)
}
