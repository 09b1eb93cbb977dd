//! A memory as bytes, to be put into a file and taken up by another process: what it is of stands
//! before it.
//!
//! One line of JSON, then the memory, whatever fields it has, in [postcard](https://postcard.jamesmunns.com/wire-format).
//! Numbers keep their bits.

use serde::{Deserialize, Serialize};
use sha2::{Digest, Sha256};
use thiserror::Error;

use crate::models::restart_state::RestartState;
use crate::results::PROGRAM;
use crate::simulation::identity::Identity;
use crate::simulation::identity::NUMERICS;

/// Of the bytes; another one is not read.
const FORMAT: u32 = 1;
/// A longer first line is none of a checkpoint.
const LONGEST_HEAD: usize = 1000;

/// What a checkpoint is of.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct CheckpointHead {
    program: String,
    format: u32,
    /// [`NUMERICS`] of the build.
    numerics: String,
    /// See [`Identity::case`].
    pub case: String,
    /// See [`Identity::result`].
    result: String,
    /// SHA-256 of the memory's bytes.
    sha256: String,
}

/// Why a run does not go on from a checkpoint.
#[derive(Clone, Debug, PartialEq, Eq, Error)]
pub enum CheckpointError {
    /// No first line of a checkpoint, or one of another format.
    #[error("this is no checkpoint of fem-run")]
    NotOne,
    /// Cut off or changed.
    #[error("this checkpoint is damaged")]
    Damaged,
    /// Of a build that may give other bits.
    #[error(
        "this checkpoint is of another build: its numerics are {found}, those of this one {NUMERICS}"
    )]
    OtherNumerics {
        /// Of the build that wrote it.
        found: String,
    },
    /// Another case, output tables included, or other mesh files.
    #[error(
        "this checkpoint is of another case, or this case wants other output or has other meshes"
    )]
    OtherCase,
}

/// The bytes of a memory of a run.
///
/// ```
/// # use fem_case::schema::{BodyTable, MaterialTable, MeshTable};
/// # use fem_case::{Case, CaseFile};
/// # use fem_simulation::Simulation;
/// use fem_simulation::{Identity, checkpoint, restart_state_of};
/// # let ice = MaterialTable::from_youngs_modulus_poissons_ratio("917 kg/m^3", "9.3 GPa", 0.33);
/// # let ball = BodyTable::sphere("ball", "2 cm", "ice").approaching("0.2 m/s");
/// # let mut file = CaseFile::of_bodies(ball, BodyTable::wall("floor")).with_material("ice", ice);
/// # file.mesh =
/// #     Some(MeshTable { contact_element_size: Some("0.2 mm".into()), ..Default::default() });
/// # let simulation = Simulation::new(Case::of(file)?)?;
/// let run = Identity::of(simulation.case())?;
/// let mut course = simulation.start();
/// course.advance(&mut ());
/// let memory = course.memory().ok_or("a model that goes on from none")?;
/// let bytes = checkpoint(&run, &memory);
/// assert_eq!(restart_state_of(&bytes, &run), Ok(memory));
///
/// let other = Identity { result: "of another case".to_string(), ..run };
/// assert!(restart_state_of(&bytes, &other).is_err());
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn checkpoint(run: &Identity, memory: &RestartState) -> Vec<u8> {
    // A memory has lists, numbers and texts, all of which can be written.
    let body = postcard::to_stdvec(memory).unwrap_or_default();
    let head = CheckpointHead {
        program: PROGRAM.to_string(),
        format: FORMAT,
        numerics: NUMERICS.to_string(),
        case: run.case.clone(),
        result: run.result.clone(),
        sha256: sha256(&body),
    };
    let mut bytes = serde_json::to_vec(&head).unwrap_or_default();
    bytes.push(b'\n');
    bytes.extend(body);
    bytes
}

/// What a checkpoint is of, from its first bytes.
///
/// # Errors
/// None of this program and format.
pub fn checkpoint_head(bytes: &[u8]) -> Result<CheckpointHead, CheckpointError> {
    Ok(split(bytes)?.0)
}

/// The memory of a run, if the checkpoint is of this build and of this run.
///
/// # Errors
/// Bytes that are no whole checkpoint; one of another build or case.
pub fn restart_state_of(bytes: &[u8], run: &Identity) -> Result<RestartState, CheckpointError> {
    let (head, body) = split(bytes)?;
    if head.numerics != NUMERICS {
        return Err(CheckpointError::OtherNumerics { found: head.numerics });
    }
    if head.result != run.result {
        return Err(CheckpointError::OtherCase);
    }
    if head.sha256 != sha256(body) {
        return Err(CheckpointError::Damaged);
    }
    postcard::from_bytes(body).map_err(|_| CheckpointError::Damaged)
}

fn split(bytes: &[u8]) -> Result<(CheckpointHead, &[u8]), CheckpointError> {
    let end = bytes.iter().take(LONGEST_HEAD).position(|byte| *byte == b'\n');
    let (line, rest) = bytes.split_at(end.ok_or(CheckpointError::NotOne)?);
    let head: CheckpointHead = serde_json::from_slice(line).map_err(|_| CheckpointError::NotOne)?;
    if head.program != PROGRAM || head.format != FORMAT {
        return Err(CheckpointError::NotOne);
    }
    Ok((head, &rest[1..]))
}

fn sha256(bytes: &[u8]) -> String {
    Sha256::digest(bytes).iter().map(|byte| format!("{byte:02x}")).collect()
}
