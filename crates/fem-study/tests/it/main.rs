//! Tests of the public interface of fem-study.

mod accuracy;
mod calibrate;
mod friction;
mod pair_export;
mod pair_law;
