//! Charts and filled contours as self-contained SVG.
//!
//! A [`Chart`] has curves, points with error bars, and bands in colours that colour-blind readers can distinguish, short tick
//! labels, and room around the data of logarithmic axes. [`svg`] draws panels side by side, [`panel`] one chart for a page that
//! restyles it. [`contour`] draws fields on a section.
//!
//! ```
//! use fem_figure::{Axis, Chart, Curve};
//!
//! let chart = Chart::new(Axis::new("speed [m/s]").logarithmic(), Axis::new("restitution"))
//!     .with(Curve::line("computed", vec![(0.1, 0.95), (1.0, 0.93)]))
//!     .with(Curve::points("measured", vec![(0.5, 0.925)]));
//! assert!(fem_figure::svg(&[chart]).is_some_and(|svg| svg.starts_with("<svg")));
//! ```

mod chart;
mod clip;
pub mod contour;
mod curve;
mod panel;
mod scale;
mod style;

pub use chart::{Axis, Chart};
pub use curve::{Curve, Mark};
pub use panel::{legend_room, panel, stacked, svg};
pub use style::{COLOURS, GREY, colour_along, escaped, tick};
