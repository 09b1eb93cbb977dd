//! Cases that are made and changed in code: the same scenes as from text, faults that name their key, and no panic for any
//! case file.

mod any_case_file;
mod built_case;
mod edited;
mod faults;
mod pair;
mod shipped;
