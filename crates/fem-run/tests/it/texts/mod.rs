//! Texts for people: terminal, standard streams, report pages, a first case.

mod first_minutes;
mod numbers;
mod report;
mod source_texts;
mod streams;
mod terminal;
