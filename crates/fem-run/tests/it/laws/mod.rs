//! Commands about contact laws and measured data.

mod calibrate;
mod fit;
