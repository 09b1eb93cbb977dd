//! Texts for people: terminal, standard streams, report pages, a first case.

mod new_and_materials;
pub mod printed_numbers;
mod report;
mod source_texts;
mod stdin_stdout;
mod terminal;
