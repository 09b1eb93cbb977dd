//! What `fit`, `invert`, `export` and `cradle` share: from a case, options and CSV files to the
//! models and data of `fem-fit`, and the folder of what they write.

mod bodies;
mod export_fit;
mod fit_picture;
mod fit_report;
mod laws;
mod output;

pub use bodies::{ChosenLaw, family_of, model_of};
pub use export_fit::{Curve, Drawn, fit_export, spheres_of};
pub use fit_picture::{fit_picture, histories_picture};
pub use fit_report::{Fitted, fit_numbers, fit_text, show_value};
pub use laws::{
    LawArguments, find_key, find_loss, from_fit_error, parse_confidence, parse_family, parse_speed,
    parse_value, split,
};
pub use output::{Output, OutputArguments};
