//! The identity of a build's numerics.

/// Sixteen digits that two builds share only if they give the same bits on the same machine: a digest
/// of the sources of this crate and of all that it stands on in its workspace, of the versions of other
/// people's crates, and of the kind of machine that it is built for. It moves with a comment, too.
///
/// Built from a registry, where no workspace is, the versions of those crates stand for their sources.
pub const NUMERICS: &str = env!("FEM_NUMERICS");
