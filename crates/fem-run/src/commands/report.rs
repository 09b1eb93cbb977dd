//! `fem-run report FOLDER...`: the report page of a result, or the comparison of several; and `fem-run plot
//! FOLDER --what FIGURE`: one figure of a result as SVG, for a paper.

use std::path::PathBuf;

use clap::ValueEnum;
use fem_case::readable_name;
use fem_report::report::{
    Quantity, REPORT_FILE, StoredResult, bounce_charts, comparison_page, contour_of_dent,
    contour_of_result, energy_chart, history_chart, loop_chart, oblique_charts, pressure_chart,
    report_page,
};
use fem_report::section_view::mirrored;

use crate::result_folder::whole_file::OwnedFileKind;
use crate::text::failure::Failure;
use crate::text::standard_output;

/// Identifies the pages of this command.
const PAGE: OwnedFileKind = OwnedFileKind {
    what: "page",
    extension: "html",
    marker: "<meta name=\"generator\" content=\"fem-run\">",
    option: "--out",
};

/// Write the report page of a result, or compare several results
///
/// For one folder, writes its report.html as a run does. For several folders, writes one page with their
/// curves over each other, the differences of their numbers from the first, and the differences of their
/// cases.
#[derive(clap::Args, Debug)]
pub struct ReportArguments {
    /// Result folders of runs
    #[arg(value_name = "FOLDER", required = true)]
    folders: Vec<PathBuf>,
    /// The page, - for standard output [default: FOLDER/report.html; for several folders their names,
    /// A-B-comparison.html]
    ///
    /// An existing file is replaced only if it is such a page.
    #[arg(long, value_name = "FILE")]
    out: Option<PathBuf>,
    /// Print nothing but errors and warnings
    #[arg(long, short)]
    quiet: bool,
}

pub fn report(arguments: &ReportArguments) -> Result<(), Failure> {
    let records = StoredResult::read_all(&arguments.folders)?;
    let (text, usual) = match (records.as_slice(), arguments.folders.as_slice()) {
        ([record], [folder]) => (report_page(record)?, folder.join(REPORT_FILE)),
        _ => (comparison_page(&records)?, default_name(&records, "comparison.html")),
    };
    let path = arguments.out.clone().unwrap_or(usual);
    match PAGE.write(&path, &text)? {
        Some(written) if !arguments.quiet => standard_output::print(&written),
        _ => Ok(()),
    }
}

/// Returns a file name for these results, so that those of others are not replaced: `A-B-comparison.html`.
fn default_name(records: &[StoredResult], what: &str) -> PathBuf {
    let names: Vec<String> = records.iter().map(|record| readable_name(&record.name)).collect();
    PathBuf::from(format!("{}-{what}", readable_name(&names.join("-"))))
}

/// Identifies the pictures of this command.
const PICTURE: OwnedFileKind = OwnedFileKind {
    what: "picture",
    extension: "svg",
    marker: "<!-- fem-run plot -->",
    option: "--out",
};
/// Most panels of contours.
const MAX_PANELS: usize = 6;

/// Draw one figure of a result as SVG
#[derive(clap::Args, Debug)]
pub struct PlotArguments {
    /// Result folders of runs; the curves of several are drawn over each other
    #[arg(value_name = "FOLDER", required = true)]
    folders: Vec<PathBuf>,
    /// The figure to draw
    #[arg(long, value_name = "FIGURE")]
    what: Option<Figure>,
    /// The file, - for standard output [default: the names of the folders and the figure, A-force.svg]
    ///
    /// An existing file is replaced only if it is such a picture.
    #[arg(long, value_name = "FILE", value_parser = vector_file)]
    out: Option<PathBuf>,
    /// Print nothing but errors and warnings
    #[arg(long, short)]
    quiet: bool,
}

/// Rejects files of other formats, with the command that converts the picture.
fn vector_file(name: &str) -> Result<PathBuf, String> {
    let path = PathBuf::from(name);
    let format = path.extension().unwrap_or_default().to_string_lossy().to_lowercase();
    if !["png", "pdf", "eps", "jpg", "jpeg"].contains(&format.as_str()) {
        return Ok(path);
    }
    let svg = path.with_extension("svg");
    Err(format!(
        "figures are SVG; write --out {0} and convert it: inkscape {0} -o {name}",
        svg.display()
    ))
}

/// The figures of a result.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum Figure {
    /// Axial stress around the contact at the snapshots
    Contours,
    /// Equivalent plastic strain of the unloaded bodies
    Dent,
    /// Contact force over time
    Force,
    /// Approach over time
    Approach,
    /// Contact radius over time
    Radius,
    /// Pressure on the axis over time
    Pressure,
    /// Energies over time
    Energy,
    /// Contact pressure over the distance from the axis
    Profile,
    /// Height and velocity over several contacts, with gravity
    Bounces,
    /// Both contact forces and the sticking part of the contact over time, of an oblique impact; of several impacts ψ₂ over ψ₁
    Oblique,
    /// Contact force over the approach; the area of the loop is the energy that is lost
    Loop,
}

pub fn plot(arguments: &PlotArguments) -> Result<(), Failure> {
    let Some(figure) = arguments.what else {
        let figures = Figure::value_variants().iter().filter_map(Figure::to_possible_value);
        let names: Vec<String> = figures.map(|figure| figure.get_name().to_string()).collect();
        return Err(Failure::bad_input("plot needs --what FIGURE")
            .with_help(format!("the figures are {}", names.join(", "))));
    };
    let records = StoredResult::read_all(&arguments.folders)?;
    let of_one = |name: &str| match records.as_slice() {
        [record] => Ok(record),
        _ => Err(Failure::bad_input(format!("--what {name}: this figure shows a single result"))
            .with_help("name one folder")),
    };
    let chart = match figure {
        Figure::Contours | Figure::Dent | Figure::Bounces => None,
        Figure::Force => history_chart(&records, Quantity::Force),
        Figure::Approach => history_chart(&records, Quantity::Approach),
        Figure::Radius => history_chart(&records, Quantity::Radius),
        Figure::Pressure => history_chart(&records, Quantity::Pressure),
        Figure::Energy => energy_chart(of_one("energy")?),
        Figure::Profile => pressure_chart(&records),
        Figure::Oblique => oblique_charts(&records),
        Figure::Loop => loop_chart(&records),
    };
    let svg = match figure {
        Figure::Contours => {
            contour_of_result(of_one("contours")?, MAX_PANELS).map(|c| mirrored(c).svg())
        }
        Figure::Dent => contour_of_dent(of_one("dent")?).map(|c| mirrored(c).svg()),
        Figure::Bounces => fem_figure::stacked(&bounce_charts(of_one("bounces")?)),
        _ => chart.and_then(|chart| fem_figure::panel(&chart)),
    };
    let Some(svg) = svg else {
        return Err(Failure::bad_input("there is nothing to draw: the result lacks these data")
            .with_help("fields and profiles need [output] snapshots and a model with elements, bounces need \
                        gravity, oblique needs friction, and a dent a body that flows"));
    };
    let name = figure
        .to_possible_value()
        .map_or(String::new(), |value| format!("{}.svg", value.get_name()));
    let path = arguments.out.clone().unwrap_or_else(|| default_name(&records, &name));
    let svg = svg.replacen('>', &format!(">\n{}", PICTURE.marker), 1);
    match PICTURE.write(&path, &svg)? {
        Some(written) if !arguments.quiet => standard_output::print(&written),
        _ => Ok(()),
    }
}
