//! Filled contours of a field on a plane section, as SVG.
//!
//! A [`Section`] is quads with a value at each point, a [`Panel`] some of them in one window, a
//! [`Contour`] panels of one window and one scale. The field is linear on the four triangles
//! that a quad's centre makes of it, so the bands of a linear field are exact.
//!
//! The region on the far side of a level from zero is drawn over that of the level before, so that no
//! seams show between bands; edges that two triangles share are left out, so that a region
//! is one path of its outline.
//!
//! [`Contour::svg`] is one picture of all panels, [`Contour::frames`] a picture a panel for pages that show
//! one after the other.

mod colours;
mod drawing;
mod frames;
mod levels;
mod paths;
mod region;
mod rounded;
mod section;
mod window;

pub use colours::band_colour;
pub use drawing::{Contour, Panel};
pub use levels::Levels;
pub use region::Region;
pub use section::Section;
pub use window::Window;
