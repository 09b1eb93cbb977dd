//! `fem-run plot FOLDER --what FIGURE`: one picture of a result as SVG, for a paper.

use std::path::PathBuf;

use fem_report::report::{
    Quantity, StoredResult, contour_of_result, energy_chart, history_chart, pressure_chart,
};
use fem_report::section_view::mirrored;

use crate::failure::Failure;
use crate::own_file::OwnFile;
use crate::standard_output;

/// By what a picture is known.
const PICTURE: OwnFile =
    OwnFile { what: "picture", extension: "svg", mark: "<!-- fem-run plot -->", option: "--out" };
/// Panels of contours at most.
const MOST_PANELS: usize = 6;

/// Draw one figure of a result as SVG
#[derive(clap::Args, Debug)]
pub struct Arguments {
    /// Result folders of runs; curves of several are drawn over each other
    #[arg(value_name = "FOLDER", required = true)]
    folders: Vec<PathBuf>,
    /// What to draw
    #[arg(long, value_name = "FIGURE")]
    what: Figure,
    /// The picture, - for standard output [default: FIGURE.svg]
    ///
    /// An existing file is replaced only if it is such a picture.
    #[arg(long, value_name = "FILE")]
    out: Option<PathBuf>,
    /// Print nothing but errors and warnings
    #[arg(long, short)]
    quiet: bool,
}

/// A figure.
#[derive(Clone, Copy, Debug, PartialEq, Eq, clap::ValueEnum)]
pub enum Figure {
    /// Stress along the axis around the contact at the snapshots
    Contours,
    /// Contact force over time
    Force,
    /// Approach over time
    Approach,
    /// Contact radius over time
    Radius,
    /// Pressure on the axis over time
    Pressure,
    /// Where the energy is over time
    Energy,
    /// Contact pressure over the distance from the axis
    Profile,
}

/// Writes a picture and says where it is.
pub fn execute(arguments: &Arguments) -> Result<(), Failure> {
    let (records, figure) = (StoredResult::read_all(&arguments.folders)?, arguments.what);
    let of_one = |name: &str| match records.as_slice() {
        [record] => Ok(record),
        _ => Err(Failure::bad_input(format!("--what {name}: this figure is of one result"))
            .with_help("name one folder")),
    };
    let chart = match figure {
        Figure::Contours => None,
        Figure::Force => history_chart(&records, Quantity::Force),
        Figure::Approach => history_chart(&records, Quantity::Approach),
        Figure::Radius => history_chart(&records, Quantity::Radius),
        Figure::Pressure => history_chart(&records, Quantity::Pressure),
        Figure::Energy => energy_chart(of_one("energy")?),
        Figure::Profile => pressure_chart(&records),
    };
    let svg = match figure {
        Figure::Contours => {
            contour_of_result(of_one("contours")?, MOST_PANELS).map(|c| mirrored(c).svg())
        }
        _ => chart.and_then(|chart| fem_figure::panel(&chart)),
    };
    let Some(svg) = svg else {
        return Err(Failure::bad_input("there is nothing to draw: the result has no such data")
            .with_help("fields and profiles need [output] snapshots and a model with elements"));
    };
    let name = clap::ValueEnum::to_possible_value(&figure);
    let name = name.map_or(String::new(), |value| format!("{}.svg", value.get_name()));
    let path = arguments.out.clone().unwrap_or_else(|| PathBuf::from(name));
    let svg = svg.replacen('>', &format!(">\n{}", PICTURE.mark), 1);
    match PICTURE.write(&path, &svg)? {
        Some(written) if !arguments.quiet => standard_output::print(&written),
        _ => Ok(()),
    }
}
