//! Filled contours of a field on a plane section, as SVG.
//!
//! A [`Section`] consists of quads with a value at each point, a [`Panel`] of sections in one window, a
//! [`Contour`] of panels with a common window and scale. The field is linear on the four triangles between
//! a quad's corners and its centre, so the bands of a linear field are exact.
//!
//! The region beyond a level is drawn over that beyond the level before, so there are no seams between
//! bands. Edges that two triangles share are left out, so a region is drawn by its outline.
//!
//! [`Contour::svg`] draws all panels in one picture, [`Contour::frames`] one picture per panel for pages
//! that show them in turn.

mod colours;
mod drawing;
mod frames;
mod levels;
mod refined;
mod region;
mod rounded;
mod section;
mod window;

pub use drawing::{Contour, Panel};
pub use levels::Levels;
pub use region::Region;
pub use section::Section;
pub use window::Window;
