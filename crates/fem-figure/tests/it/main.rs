//! Figures from outside, in one program: linked once, its tests run side by side.

mod contour;
mod panel;
