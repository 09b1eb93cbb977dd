//! What a member is known by: equal for members that compute the same.

use std::path::Path;

use fem_case::{Case, CaseError, CaseFile, Shape};
use sha2::{Digest, Sha256};

use super::members::Members;
use crate::simulation::Simulation;

/// Bytes of the digest that go into a name: two of a million members share one by a chance of
/// 1e-7.
const IDENTITY_BYTES: usize = 8;

/// A member of a sweep, resolved.
#[derive(Clone, Debug)]
pub struct Member {
    /// Its place in the sweep.
    pub index: usize,
    /// Digest of program version, resolved case and mesh files: equal for equal results.
    pub identity: String,
    /// The resolved case.
    pub case: CaseFile,
}

impl Member {
    /// The member of a sweep that is this case.
    ///
    /// # Errors
    /// What the case's method refuses before it makes anything; a mesh file that cannot be read.
    pub fn of(index: usize, case: &Case) -> Result<Self, CaseError> {
        let meshes = mesh_files(case)?;
        let resolved = Simulation::resolve(case)?;
        Ok(Self { index, identity: identity(&resolved, &meshes), case: resolved })
    }
}

/// All members, in order.
///
/// # Errors
/// The first member that is no valid case.
pub fn identify(members: &(impl Members + ?Sized)) -> Result<Vec<Member>, CaseError> {
    let member = |index| members.build(index, |case| Member::of(index, &case));
    (0..members.n_members()).map(member).collect()
}

/// The bytes of the mesh files of a case.
fn mesh_files(case: &Case) -> Result<Vec<Vec<u8>>, CaseError> {
    let mut files = Vec::new();
    for (k, body) in case.scene().bodies().iter().enumerate() {
        if let Shape::Sphere { mesh: Some(path), .. } = body.shape() {
            files.push(read(path).map_err(|error| {
                let key = format!("body.{k}.sphere.mesh");
                case.error_at(&key, format!("mesh {}: {error}", path.display()))
            })?);
        }
    }
    Ok(files)
}

#[cfg(feature = "files")]
fn read(path: &Path) -> Result<Vec<u8>, std::io::Error> {
    std::fs::read(path)
}

#[cfg(not(feature = "files"))]
fn read(_: &Path) -> Result<Vec<u8>, &'static str> {
    Err("no files are read here")
}

fn identity(case: &CaseFile, meshes: &[Vec<u8>]) -> String {
    let mut digest = Sha256::new();
    let mut add = |bytes: &[u8]| {
        digest.update((bytes.len() as u64).to_le_bytes());
        digest.update(bytes);
    };
    add(env!("CARGO_PKG_VERSION").as_bytes());
    // A valid case has only finite numbers and text: it always serializes.
    add(&serde_json::to_vec(case).unwrap_or_default());
    meshes.iter().for_each(|mesh| add(mesh));
    digest.finalize().iter().take(IDENTITY_BYTES).map(|byte| format!("{byte:02x}")).collect()
}
