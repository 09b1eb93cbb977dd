//! Identities of a build, a case and its result: digests that are equal for equal contents.

use std::path::Path;

use fem_case::{Case, CaseError, CaseFile, Shape};
use sha2::{Digest, Sha256};

use crate::simulation::Simulation;

/// Identity of the build's numerics: sixteen digits that two builds share only if they give the same bits on the same
/// machine. It is a digest of the sources of this crate and of the workspace crates below it (comments included), of the
/// versions of other crates, and of the kind of machine.
///
/// In a build from a registry, without the workspace, the versions of those crates stand for their sources.
pub const NUMERICS: &str = env!("FEM_NUMERICS");

/// Bytes of a digest that go into a name: two of a million cases share one by a chance of 1e-7.
const DIGEST_BYTES: usize = 8;

/// The identity of a run, known before it begins.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Identity {
    /// Identity of the case ([`case_identity`]).
    pub case: String,
    /// Digest of the build's numerics, the resolved case without its title, and the mesh files, which is equal for
    /// equal results.
    pub result: String,
}

impl Identity {
    /// Returns the identity of a case with this build.
    ///
    /// # Errors
    /// A case that its method rejects; a mesh file that cannot be read.
    pub fn of(case: &Case) -> Result<Self, CaseError> {
        let (result, _) = identified(case)?;
        Ok(Self { case: case_identity(case), result: name_of(result) })
    }
}

impl Simulation {
    /// Returns the identity of the run of the case.
    ///
    /// # Errors
    /// A mesh file that cannot be read.
    pub fn identity(&self) -> Result<Identity, CaseError> {
        // It is that of the mesh before any refinement.
        if !self.levels().is_empty() {
            return Identity::of(self.case());
        }
        let result = of_result(NUMERICS, self.resolved(), &mesh_files(self.case())?);
        Ok(Identity { case: case_identity(self.case()), result: name_of(result) })
    }
}

/// Returns the digest of a case's result with this build, and the resolved case.
///
/// # Errors
/// Those of [`Identity::of`].
pub fn identified(case: &Case) -> Result<(u64, CaseFile), CaseError> {
    let meshes = mesh_files(case)?;
    let resolved = Simulation::resolve(case)?;
    Ok((of_result(NUMERICS, &resolved, &meshes), resolved))
}

/// Returns the digest of a case: its keys and values with overrides, in SI, without title and output. Defaults do not
/// count, so that a build with another plan keeps the identity.
pub fn case_identity(case: &Case) -> String {
    identity_of(case.file())
}

/// Returns the identity of a case file ([`case_identity`]).
pub(crate) fn identity_of(file: &CaseFile) -> String {
    let file = CaseFile { title: None, output: None, ..file.clone() };
    digest_of([json(&file).as_slice()])
}

/// Returns the digest of a result from the numerics, the resolved case without its title, and the mesh files.
fn of_result(numerics: &str, case: &CaseFile, meshes: &[Vec<u8>]) -> u64 {
    // The command and Python title the members of a sweep differently.
    let case = json(&CaseFile { title: None, ..case.clone() });
    let meshes = meshes.iter().map(Vec::as_slice);
    digest([numerics.as_bytes(), &case].into_iter().chain(meshes))
}

/// Returns the digest of a list of texts as sixteen digits.
pub fn digest_of<'a>(parts: impl IntoIterator<Item = &'a [u8]>) -> String {
    name_of(digest(parts))
}

/// Prints a digest as in names.
pub fn name_of(digest: u64) -> String {
    format!("{digest:0digits$x}", digits = 2 * DIGEST_BYTES)
}

fn digest<'a>(parts: impl IntoIterator<Item = &'a [u8]>) -> u64 {
    let mut digest = Sha256::new();
    for bytes in parts {
        digest.update((bytes.len() as u64).to_le_bytes());
        digest.update(bytes);
    }
    digest
        .finalize()
        .iter()
        .take(DIGEST_BYTES)
        .fold(0, |number, byte| number << 8 | u64::from(*byte))
}

/// Serializes a case. It always succeeds, since a valid case has only finite numbers and text.
fn json(case: &CaseFile) -> Vec<u8> {
    serde_json::to_vec(case).unwrap_or_default()
}

/// Reads the mesh files of a case.
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
    fem_case::read_data_file(path)
}

#[cfg(not(feature = "files"))]
fn read(_: &Path) -> Result<Vec<u8>, &'static str> {
    Err("no files are read here")
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A result of another build, another case or another mesh has another digest.
    #[test]
    fn a_result_is_of_one_build_one_case_and_its_meshes() {
        let text = "material.ice = { density = 917, youngs_modulus = 9.3e9, poissons_ratio = 0.33 }
            [[body]]
            name = 'floor'
            wall = {}
            [[body]]
            name = 'ball'
            sphere.diameter = 0.02
            material = 'ice'
            approach_speed = 0.1";
        let parse = |set: &[String]| Case::parse("ball.toml", text, Path::new("."), set).unwrap();
        let (one, other) = (parse(&[]), parse(&["body.1.approach_speed=0.2".to_string()]));
        let mesh = [b"points".to_vec()];
        let own = of_result("0123", one.file(), &[]);
        assert_eq!(own, of_result("0123", one.file(), &[]));
        assert_ne!(own, of_result("0124", one.file(), &[]));
        assert_ne!(own, of_result("0123", other.file(), &[]));
        assert_ne!(own, of_result("0123", one.file(), &mesh));
        let titled = CaseFile { title: Some("other".into()), ..one.file().clone() };
        assert_eq!(own, of_result("0123", &titled, &[]));
    }
}
