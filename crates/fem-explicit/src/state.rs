//! What changes in a run.

use serde::{Deserialize, Serialize};

use crate::body::Body;
use crate::model::Model;

/// State of a body at time t_n; velocities belong to t_n − Δt/2.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub(crate) struct BodyState {
    /// Displacement, m.
    pub u: Vec<[f64; 2]>,
    /// Velocity, m/s.
    pub v: Vec<[f64; 2]>,
    /// Effective displacement of a relaxing body, m; empty for an elastic one.
    pub w: Vec<[f64; 2]>,
    /// Elastic displacement of each Prony branch, m.
    pub q: Vec<Vec<[f64; 2]>>,
}

/// State of both bodies.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub(crate) struct State {
    /// Steps done.
    pub step: u64,
    /// Time since the start of the case, s.
    pub time: f64,
    pub bodies: [BodyState; 2],
}

/// Forces of the present step; never read across steps.
#[derive(Debug, Clone)]
pub(crate) struct Scratch {
    /// Nodal forces of both bodies, N.
    pub forces: [Vec<[f64; 2]>; 2],
}

impl State {
    /// The bodies at first touch, undeformed.
    pub fn at_first_touch(model: &Model) -> Self {
        let time = model.approach().first_touch();
        let bodies = model.bodies().each_ref().map(|body| BodyState::in_flight(body, time));
        Self { step: 0, time, bodies }
    }
}

impl BodyState {
    /// Undeformed, after a time (s) of free flight.
    pub fn in_flight(body: &Body, time: f64) -> Self {
        let n = body.nodal_mass.len();
        let u = vec![[0.0, body.velocity * time]; n];
        let v = vec![[0.0, body.velocity]; n];
        let n_branches = body.n_branches();
        let w = if n_branches > 0 { vec![[0.0; 2]; n] } else { Vec::new() };
        // Rigid motion strains nothing: the branches start at zero.
        let mut state = Self { u, v, w, q: vec![vec![[0.0; 2]; n]; n_branches] };
        state.update_effective(body);
        state
    }
}

impl BodyState {
    /// Whether its fields are of the body's sizes.
    pub fn fits(&self, body: &Body) -> bool {
        let (n, n_branches) = (body.nodal_mass.len(), body.n_branches());
        let n_effective = if n_branches > 0 { n } else { 0 };
        [self.u.len(), self.v.len(), self.w.len()] == [n, n, n_effective]
            && self.q.len() == n_branches
            && self.q.iter().all(|q| q.len() == n)
    }
}

impl Scratch {
    pub fn new(model: &Model) -> Self {
        Self { forces: model.bodies().each_ref().map(|body| vec![[0.0; 2]; body.nodal_mass.len()]) }
    }
}
