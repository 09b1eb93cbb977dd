//! A mesh file, read as the mesh of a sphere.

use fem_mesh::{HalfDisc, SphereMesh};
use fem_vtk::VtuFile;

use super::files;
use crate::mutate::{Random, change_bytes, change_text};
use crate::trial::{Taken, Target, rejected};

/// Radius of the sphere, m.
const RADIUS: f64 = 0.01;
/// Files of other writers with other layouts.
const FIXTURES: &str = "crates/fem-vtk/tests/fixtures";

pub struct MeshFile {
    seeds: Vec<Vec<u8>>,
}

impl MeshFile {
    pub fn new() -> Self {
        let mut seeds: Vec<Vec<u8>> =
            files(FIXTURES, "vtu").into_iter().map(|(_, bytes)| bytes).collect();
        // Most inputs start from a sphere, since others fail the first check of the shape.
        let sphere = HalfDisc {
            radius: RADIUS,
            contact_element_size: 2e-3,
            refined_radius: 2e-3,
            growth: Some(1.5),
            edge: None,
        };
        if let Ok(mesh) = sphere.build() {
            let text = ascii(mesh.nodes(), mesh.quads());
            seeds.extend(std::iter::repeat_n(text.into_bytes(), 2 * seeds.len()));
        }
        Self { seeds }
    }
}

impl Target for MeshFile {
    fn make(&self, random: &mut Random) -> Vec<u8> {
        let mut bytes = self.seeds[random.below(self.seeds.len())].clone();
        match random.once_in(3) {
            true => change_bytes(&mut bytes, random),
            false => change_text(&mut bytes, &self.seeds, random),
        }
        bytes
    }

    fn take(&self, input: &[u8]) -> Result<Taken, String> {
        let read =
            VtuFile::from_bytes("fuzzed.vtu", input.to_vec()).and_then(|file| file.quad_mesh());
        let mesh = match read {
            Err(error) => return rejected(&error.to_string()),
            Ok(mesh) => mesh,
        };
        let nodes: Vec<[f64; 2]> = mesh.points.iter().map(|point| [point[0], point[1]]).collect();
        match SphereMesh::import(RADIUS, nodes, mesh.quads) {
            Err(error) => rejected(&error.to_string()),
            Ok(mesh) if mesh.nodes().iter().flatten().all(|x| x.is_finite()) => Ok(Taken::Accepted),
            Ok(_) => Err("a node of the mesh is not finite".to_string()),
        }
    }
}

/// Writes a mesh as text, so that mutated words change numbers.
fn ascii(nodes: &[[f64; 2]], quads: &[[u32; 4]]) -> String {
    let points: Vec<String> = nodes.iter().map(|[r, y]| format!("{r:?} {y:?} 0")).collect();
    let corners: Vec<String> =
        quads.iter().map(|[a, b, c, d]| format!("{a} {b} {c} {d}")).collect();
    let offsets: Vec<String> = (1..=quads.len()).map(|k| (4 * k).to_string()).collect();
    let array = |kind: &str, name: &str, n: usize, text: String| {
        format!(
            "<DataArray type=\"{kind}\" Name=\"{name}\" NumberOfComponents=\"{n}\" format=\"ascii\">\n\
             {text}\n</DataArray>\n"
        )
    };
    format!(
        "<VTKFile type=\"UnstructuredGrid\" byte_order=\"LittleEndian\"><UnstructuredGrid>\n\
         <Piece NumberOfPoints=\"{}\" NumberOfCells=\"{}\">\n<Points>{}</Points>\n<Cells>{}{}{}</Cells>\n\
         </Piece></UnstructuredGrid></VTKFile>\n",
        nodes.len(),
        quads.len(),
        array("Float64", "Points", 3, points.join("\n")),
        array("Int32", "connectivity", 1, corners.join("\n")),
        array("Int32", "offsets", 1, offsets.join(" ")),
        array("UInt8", "types", 1, vec!["9"; quads.len()].join(" ")),
    )
}
