//! Cases made and changed in code: the same scenes as from text, faults named by their key, no
//! panic whatever the case file holds.

mod any_case_file;
mod edited;
mod faults;
mod made;
mod pair;
mod shipped;
