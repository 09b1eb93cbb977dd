//! The page's module, run where tests run.

mod pictures;
mod session;
mod words;
