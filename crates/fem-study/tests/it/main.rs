//! Tests of the public interface of fem-study.

mod accuracy;
mod common;
mod cradle;
mod dem;
mod fits;
mod inverse;
mod spectrum;
