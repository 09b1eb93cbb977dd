//! Tests of the public interface of fem-data.

mod common;
mod cradle;
mod dem;
mod fits;
mod inverse;
mod measured;
mod records;
mod relaxation;
mod robust;
mod spectrum;
