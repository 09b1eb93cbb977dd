//! The fem-run command: how do two viscoelastic spheres collide?.
fn main() {}
