//! What is fed.

use crate::random::Random;

/// How an input was taken.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Taken {
    /// As something that can be computed.
    Accepted,
    /// With a message that says what is wrong.
    Refused,
}

/// Something that reads. A panic of it is a finding, too.
pub trait Target: Sync {
    /// An input.
    fn make(&self, random: &mut Random) -> Vec<u8>;

    /// Feeds it.
    ///
    /// # Errors
    /// A finding: what must not be.
    fn take(&self, input: &[u8]) -> Result<Taken, String>;
}

/// A message for a user, who is told something, and whose terminal obeys nothing of it.
///
/// # Errors
/// One that says nothing, or has control characters.
pub fn refused(message: &str) -> Result<Taken, String> {
    let is_tame = !message.contains(|c: char| c.is_control() && c != '\n');
    match is_tame && message.trim().len() > 8 && message.len() < 100_000 {
        true => Ok(Taken::Refused),
        false => Err(format!("a message that is none: {message:?}")),
    }
}
