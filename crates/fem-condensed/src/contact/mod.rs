//! The contact problem of an instant, and the contact radius and pressure that follow from it.

pub(crate) mod complementarity;
pub(crate) mod disc_contact;
pub(crate) mod elastic_impact;
pub(crate) mod pressure;
pub(crate) mod profile;
pub(crate) mod static_compression;
