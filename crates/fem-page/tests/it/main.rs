//! Tests of the browser page's module, run natively.

mod pictures;
mod session;
mod words;
