//! Progress and files of `fem-run validate`.

mod board;
mod files;

pub use board::Board;
pub use files::{MADE_FROM, PAGE_FILE, write_files};
