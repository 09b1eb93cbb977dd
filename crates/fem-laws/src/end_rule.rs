//! The two ends that a contact with a law can have.

/// When a contact is over.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub enum EndRule {
    /// The force falls to zero: the surfaces cannot pull (Schwager & Pöschel 2007).
    #[default]
    ZeroForce,
    /// The overlap falls to zero; until then the dashpot may pull.
    ZeroOverlap,
}
