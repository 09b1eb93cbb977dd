//! Condensation of a body: its stiffness is factored once and reduced to the contact nodes.

pub(crate) mod condensed_body;
pub(crate) mod dense;
pub(crate) mod deviatoric;
pub(crate) mod dissection;
pub(crate) mod factor;
pub(crate) mod numbering;
