//! Makes tables and pictures of the pages, and files that CI compares: `cargo run --release -p fem-tools -- TOOL …`,
//! with one module per tool.

#![allow(
    clippy::disallowed_macros,
    clippy::disallowed_methods,
    reason = "these programs have the clock and print what they found"
)]

mod contact;
mod effects;
mod finite_strain;
mod finite_strain_cost;
mod flow;
mod page;
mod performance;
mod pictures;
mod timing;
mod vtk_reference;

type Error = Box<dyn std::error::Error>;
/// Runs a tool on the words behind its name.
type Tool = fn(&[String]) -> Result<(), Error>;

const TOOLS: [(&str, Tool); 8] = [
    ("contact", contact::run),
    ("effects", effects::run),
    ("finite_strain", finite_strain::run),
    ("finite_strain_cost", finite_strain_cost::run),
    ("flow", flow::run),
    ("performance", performance::run),
    ("pictures", pictures::run),
    ("vtk_reference", vtk_reference::run),
];

fn main() -> Result<(), Error> {
    let words: Vec<String> = std::env::args().skip(1).collect();
    let (name, words) = words.split_first().map_or(("", &words[..]), |(name, rest)| (name, rest));
    match TOOLS.iter().find(|(own, _)| *own == name) {
        Some((_, run)) => run(words),
        None => Err(format!("name one of {}", TOOLS.map(|(own, _)| own).join(", ")).into()),
    }
}
