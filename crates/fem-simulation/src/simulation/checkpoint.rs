//! Checkpoints: a restart state as bytes, which another process can read.
//!
//! A line of JSON identifies the run; the restart state follows in [postcard](https://postcard.jamesmunns.com/wire-format).
//! Numbers keep their bits.

use fem_collision::PROGRAM;
use serde::{Deserialize, Serialize};
use sha2::{Digest, Sha256};
use thiserror::Error;

use crate::models::stepper::RestartState;
use crate::simulation::identity::{Identity, NUMERICS};

/// Version of the format; others are not read.
const FORMAT_VERSION: u32 = 1;
/// Longest first line of a checkpoint.
const LONGEST_HEAD: usize = 1000;

/// The first line of a checkpoint, which identifies its run.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct CheckpointHead {
    program: String,
    format: u32,
    /// Identity [`NUMERICS`] of the build.
    numerics: String,
    /// Identity of the case ([`Identity::case`]).
    pub case: String,
    /// Identity of the result ([`Identity::result`]).
    result: String,
    /// SHA-256 of the restart state's bytes.
    sha256: String,
}

/// The reason why a run cannot resume from a checkpoint.
#[derive(Clone, Debug, PartialEq, Eq, Error)]
pub enum CheckpointError {
    /// The bytes do not begin like a checkpoint of this format.
    #[error("this is not a checkpoint of fem-run")]
    NotOne,
    /// The bytes are incomplete or changed.
    #[error("this checkpoint is damaged")]
    Damaged,
    /// The checkpoint belongs to a build that may give other bits.
    #[error(
        "this checkpoint belongs to another build: its numerics are {found}, those of this build {NUMERICS}"
    )]
    OtherNumerics {
        /// Numerics of the build that wrote it.
        found: String,
    },
    /// The checkpoint belongs to another case, another output request or other mesh files.
    #[error(
        "this checkpoint belongs to another case, or to other output tables or mesh files of this case"
    )]
    OtherCase,
}

/// Returns the checkpoint of a run's restart state.
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
/// let run = simulation.identity()?;
/// let mut stepper = simulation.start();
/// stepper.advance(&mut ());
/// let state = stepper.restart_state().ok_or("a model without restart states")?;
/// let bytes = checkpoint(&run, &state);
/// assert_eq!(restart_state_of(&bytes, &run), Ok(state));
///
/// let other = Identity { result: "another case".to_string(), ..run };
/// assert!(restart_state_of(&bytes, &other).is_err());
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn checkpoint(run: &Identity, state: &RestartState) -> Vec<u8> {
    // A restart state has lists, numbers and texts, which always serialize.
    let body = postcard::to_stdvec(state).unwrap_or_default();
    let head = CheckpointHead {
        program: PROGRAM.to_string(),
        format: FORMAT_VERSION,
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

/// Reads the first line of a checkpoint.
///
/// # Errors
/// Bytes of another program or format.
pub fn checkpoint_head(bytes: &[u8]) -> Result<CheckpointHead, CheckpointError> {
    Ok(split(bytes)?.0)
}

/// Reads the restart state of a run.
///
/// # Errors
/// An incomplete checkpoint, or one of another build or case.
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
    if head.program != PROGRAM || head.format != FORMAT_VERSION {
        return Err(CheckpointError::NotOne);
    }
    Ok((head, &rest[1..]))
}

fn sha256(bytes: &[u8]) -> String {
    Sha256::digest(bytes).iter().map(|byte| format!("{byte:02x}")).collect()
}
