//! Tests of the public interface of fem-study.

mod accuracy;
mod calibrate;
mod pair_export;
mod pair_law;
