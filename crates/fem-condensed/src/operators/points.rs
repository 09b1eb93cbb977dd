//! The contact points of a pair and their interpolation from the nodes of each body.

use faer::Mat;
use fem_contact::{ContactInterface, ContactPoint, NodalContact, Surface};

use crate::error::CondensedError;
use crate::settings::{ContactModel, PairSettings};

/// For each contact point the contact nodes, numbered outward, with their shape functions.
pub(crate) type NodeInterpolation = Vec<Vec<(usize, f64)>>;

/// Interpolates rows of contact nodes at the contact points.
pub(crate) fn gather(projections: &NodeInterpolation, nodal: &Mat<f64>) -> Mat<f64> {
    Mat::from_fn(projections.len(), nodal.ncols(), |i, j| {
        projections[i].iter().map(|&(node, share)| share * nodal[(node, j)]).sum()
    })
}

/// The points at which the bodies can touch.
pub(crate) struct ContactPoints {
    pub points: Vec<ContactPoint>,
    /// Side whose nodes the points are; `None` for Gauss points.
    pub nodal_side: Option<usize>,
    pub projections: [NodeInterpolation; 2],
}

impl ContactPoints {
    /// Creates points at nodes for exact contact, at Gauss points for springs.
    ///
    /// # Errors
    /// Two rigid bodies; a radius that is not positive and finite.
    pub fn new(surfaces: &[Surface; 2], settings: &PairSettings) -> Result<Self, CondensedError> {
        let [lower, upper] = surfaces;
        match settings.contact {
            ContactModel::Exact => {
                let contact = NodalContact::new([lower, upper], 0.0, settings.candidate_radius)?;
                let NodalContact { points, side, shares } = contact;
                let own: NodeInterpolation = (0..points.len()).map(|k| vec![(k, 1.0)]).collect();
                let projections = if side == 0 { [own, shares] } else { [shares, own] };
                Ok(Self { points, nodal_side: Some(side), projections })
            }
            ContactModel::Springs(stiffness) => {
                let interface = ContactInterface::new(
                    lower.clone(),
                    upper.clone(),
                    stiffness,
                    0.0,
                    settings.candidate_radius,
                )?;
                let points = interface.points().to_vec();
                let projections = [0, 1]
                    .map(|side: usize| gauss_point_interpolation(&points, side, &surfaces[side]));
                Ok(Self { points, nodal_side: None, projections })
            }
        }
    }
}

/// Returns the interpolation of Gauss points, each between two nodes of a surface.
fn gauss_point_interpolation(
    points: &[ContactPoint],
    side: usize,
    surface: &Surface,
) -> NodeInterpolation {
    let along = surface.nodes_within(f64::INFINITY);
    let place = |node: u32| along.iter().position(|&other| other == node).unwrap_or(0);
    let projections = points.iter().map(|point| {
        let projection = &point.projections[side];
        projection.nodes.into_iter().map(place).zip(projection.shape).collect()
    });
    projections.collect()
}
