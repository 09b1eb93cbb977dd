//! Mesh files for hard scenes: a sphere's mesh of this program, unchanged or modified as by other
//! programs and users.

use std::f64::consts::PI;
use std::fs;
use std::path::Path;

use fem_mesh::{HalfDisc, SphereMesh};
use serde::Deserialize;

use crate::{StudyError, studies::random_scenes::Random};

#[derive(Clone, Copy, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Imported {
    /// Index of the body, 0 or 1.
    body: usize,
    /// Radius of the sphere, m.
    radius: f64,
    /// Element size at the contact, m.
    element_size: f64,
    /// Half-width of the block of equal elements, m.
    refined_radius: f64,
    #[serde(default)]
    change: Change,
}

#[derive(Clone, Copy, Default, Deserialize)]
#[serde(rename_all = "snake_case")]
enum Change {
    #[default]
    Plain,
    /// Elements under the contact are sheared by half of their height.
    Sheared,
    /// Elements along the surface are three times as wide at the edge of the block as at the pole.
    Graded,
    /// The contact is on the sphere's far side.
    Turned,
    /// Nodes and elements have any order; elements begin at any corner and have either orientation.
    Shuffled,
    /// A node is moved most of the way to the diagonal of an element.
    Thin,
    /// A node is moved across the diagonal.
    Inverted,
    /// A node has NaN coordinates.
    Nowhere,
    /// The row of nodes under the surface is duplicated, so that elements touch but are not connected.
    Cracked,
    /// A node is duplicated in another element.
    Doubled,
    /// There is a second body.
    Disconnected,
    /// A node belongs to no element.
    Loose,
}

impl Imported {
    /// Writes the mesh and returns the override that names it.
    pub fn write(&self, folder: &Path, name: &str) -> Result<String, StudyError> {
        let Self { radius, element_size, refined_radius, .. } = *self;
        let half_disc = HalfDisc {
            radius,
            contact_element_size: element_size,
            refined_radius,
            growth: None,
            edge: None,
        };
        let (nodes, quads) = self.changed(&half_disc.build()?);
        let path = folder.join(format!("{name}.vtu"));
        fs::write(&path, vtu(&nodes, &quads))
            .map_err(|error| StudyError::parameters(error.to_string()))?;
        Ok(format!("body.{}.sphere.mesh='{}'", self.body, path.display()))
    }

    fn changed(&self, mesh: &SphereMesh) -> (Vec<[f64; 2]>, Vec<[u32; 4]>) {
        let (mut nodes, mut quads) = (mesh.nodes().to_vec(), mesh.quads().to_vec());
        let (radius, width) = (self.radius, self.refined_radius);
        match self.change {
            Change::Plain => {}
            Change::Sheared => nodes.iter_mut().for_each(|node| shear(node, radius, width)),
            Change::Graded => nodes.iter_mut().for_each(|node| grade(node, radius, width)),
            Change::Turned => nodes.iter_mut().for_each(|[_, y]| *y = 2.0 * radius - *y),
            Change::Shuffled => shuffle(&mut nodes, &mut quads),
            Change::Thin | Change::Inverted => {
                let [a, b, c, _] = quads[inner(&nodes, &quads, radius)];
                // Corner b moves toward the middle of the diagonal from a to c, or beyond it.
                let [a, c] = [a, c].map(|k| nodes[k as usize]);
                let share = if let Change::Thin = self.change { 0.99 } else { 1.3 };
                let b = &mut nodes[b as usize];
                *b = [0, 1].map(|k| b[k] + share * (0.5 * (a[k] + c[k]) - b[k]));
            }
            Change::Nowhere => {
                let k = quads[inner(&nodes, &quads, radius)][0] as usize;
                nodes[k] = [f64::NAN; 2];
            }
            Change::Cracked | Change::Doubled => {
                // Only one element changes; its neighbours keep the old nodes.
                let element = inner(&nodes, &quads, radius);
                let n_torn = if let Change::Cracked = self.change { 2 } else { 1 };
                for corner in 0..n_torn {
                    let old = quads[element][corner];
                    quads[element][corner] = nodes.len() as u32;
                    nodes.push(nodes[old as usize]);
                }
            }
            Change::Disconnected => {
                let n = nodes.len() as u32;
                nodes.extend(mesh.nodes().iter().map(|[r, y]| [r + 3.0 * radius, *y]));
                quads.extend(mesh.quads().iter().map(|quad| quad.map(|k| k + n)));
            }
            Change::Loose => nodes.push([0.5 * radius, radius]),
        }
        (nodes, quads)
    }
}

/// Returns a weight that is 1 at the pole and 0 beyond twice the width.
fn near(r: f64, width: f64) -> f64 {
    (1.0 - (r / (2.0 * width)).powi(2)).max(0.0).powi(2)
}

/// Shears the mesh; pole, axis and surface stay.
fn shear([r, y]: &mut [f64; 2], radius: f64, width: f64) {
    let surface = radius - (radius * radius - *r * *r).max(0.0).sqrt();
    let depth = (*y - surface).max(0.0);
    let share = near(*r, width) * near(depth, width) * (4.0 * *r / width).min(1.0);
    *r += 0.5 * depth * share;
}

/// Rotates nodes about the centre so that elements are half as wide at the pole and 1.5 times as wide at twice
/// the width; the surface stays the same.
fn grade(node: &mut [f64; 2], radius: f64, width: f64) {
    let [r, y] = [node[0], radius - node[1]];
    let (angle, distance) = (r.atan2(y), r.hypot(y));
    let along = angle * radius / width;
    if r > 0.0 && along < 2.0 {
        let angle = (along - (0.5 * PI * along).sin() / PI) * width / radius;
        *node = [distance * angle.sin(), radius - distance * angle.cos()];
    }
}

/// Returns the element nearest to a point under the pole, away from axis and surface.
fn inner(nodes: &[[f64; 2]], quads: &[[u32; 4]], radius: f64) -> usize {
    let to = |quad: &[u32; 4]| {
        let at = quad.map(|k| nodes.get(k as usize).copied().unwrap_or_default());
        let [r, y] = [0, 1].map(|k| at.iter().map(|node| node[k]).sum::<f64>() / 4.0);
        (r - 0.5 * radius).hypot(y - radius)
    };
    let nearest = quads.iter().enumerate().min_by(|(_, a), (_, b)| to(a).total_cmp(&to(b)));
    nearest.map_or(0, |(k, _)| k)
}

fn shuffle(nodes: &mut Vec<[f64; 2]>, quads: &mut [[u32; 4]]) {
    let mut random = Random::new(1);
    let order = random.order(nodes.len());
    let mut place = vec![0_u32; nodes.len()];
    order.iter().enumerate().for_each(|(new, old)| place[*old] = new as u32);
    *nodes = order.iter().map(|old| nodes[*old]).collect();
    let elements = random.order(quads.len());
    let moved: Vec<[u32; 4]> = elements.iter().map(|old| quads[*old]).collect();
    for (new, old) in quads.iter_mut().zip(moved) {
        *new = old.map(|k| place[k as usize]);
        new.rotate_left(random.order(4)[0]);
        if random.order(2)[0] == 0 {
            new.reverse();
        }
    }
}

/// Writes a mesh as text, including errors that a reader has to reject.
fn vtu(nodes: &[[f64; 2]], quads: &[[u32; 4]]) -> String {
    let array = |kind: &str, name: &str, n: usize, values: Vec<String>| {
        format!(
            "<DataArray type=\"{kind}\" Name=\"{name}\" NumberOfComponents=\"{n}\" format=\"ascii\">\n{}\n\
             </DataArray>\n",
            values.join(" ")
        )
    };
    let points = nodes.iter().map(|[r, y]| format!("{r:?} {y:?} 0")).collect();
    let corners = quads.as_flattened().iter().map(u32::to_string).collect();
    let offsets = (1..=quads.len()).map(|k| (4 * k).to_string()).collect();
    format!(
        "<VTKFile type=\"UnstructuredGrid\" byte_order=\"LittleEndian\"><UnstructuredGrid>\n\
         <Piece NumberOfPoints=\"{}\" NumberOfCells=\"{}\">\n<Points>{}</Points>\n<Cells>{}{}{}</Cells>\n\
         </Piece></UnstructuredGrid></VTKFile>\n",
        nodes.len(),
        quads.len(),
        array("Float64", "Points", 3, points),
        array("Int64", "connectivity", 1, corners),
        array("Int64", "offsets", 1, offsets),
        array("UInt8", "types", 1, vec!["9".to_string(); quads.len()]),
    )
}
