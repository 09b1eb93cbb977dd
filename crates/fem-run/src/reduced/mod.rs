//! What `fit`, `invert`, `export` and `cradle` share: from a case, options and CSV files to the
//! models and data of `fem-fit`, and the folder of what they write.

mod bodies;
mod data_file;
mod export_fit;
mod fit_picture;
mod fit_report;
mod laws;
mod measured;
mod output;
mod table;

pub use bodies::{ChosenLaw, family_of, model_of};
pub use data_file::{Data, LARGEST_UNCERTAINTY, OtherColumns, points_of, read_data};
pub use export_fit::{Curve, Drawn, fit_export, spheres_of};
pub use fit_picture::{fit_picture, histories_picture};
pub use fit_report::{Fitted, fit_numbers, fit_text, show_value};
pub use laws::{
    LawArguments, find_key, find_loss, from_fit_error, parse_confidence, parse_family, parse_speed,
    parse_value, split,
};
pub use measured::{Kind, parse_measured};
pub use output::{Output, OutputArguments};
pub use table::CsvTable;
