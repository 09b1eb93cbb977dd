//! Readers of `.vtu` files.

mod decode;
pub(crate) mod reader;
mod vtu_xml;
