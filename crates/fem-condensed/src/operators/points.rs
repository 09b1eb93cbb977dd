//! The contact points of a pair and their interpolation from the nodes of each body.

use faer::Mat;
use fem_contact::{ContactInterface, ContactPoint, NodalContact, Surface};

use crate::error::CondensedError;
use crate::settings::{ContactModel, PairSettings};

/// For each contact point the contact nodes that carry it, numbered outward, and their shares.
pub(crate) type NodeInterpolation = Vec<Vec<(usize, f64)>>;

/// Rows of contact nodes gathered into rows of contact points.
pub(crate) fn gather(feet: &NodeInterpolation, nodal: &Mat<f64>) -> Mat<f64> {
    Mat::from_fn(feet.len(), nodal.ncols(), |i, j| {
        feet[i].iter().map(|&(node, share)| share * nodal[(node, j)]).sum()
    })
}

/// Where the bodies can touch.
pub(crate) struct ContactPoints {
    pub points: Vec<ContactPoint>,
    /// The side whose nodes the points are; `None` for Gauss points.
    pub nodal_side: Option<usize>,
    pub feet: [NodeInterpolation; 2],
}

impl ContactPoints {
    /// Nodes for exact contact, Gauss points for springs.
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
                let feet = if side == 0 { [own, shares] } else { [shares, own] };
                Ok(Self { points, nodal_side: Some(side), feet })
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
                let feet = [0, 1].map(|side: usize| spring_feet(&points, side, &surfaces[side]));
                Ok(Self { points, nodal_side: None, feet })
            }
        }
    }
}

/// A Gauss point lies between two nodes of each surface.
fn spring_feet(points: &[ContactPoint], side: usize, surface: &Surface) -> NodeInterpolation {
    let along = surface.nodes_within(f64::INFINITY);
    let place = |node: u32| along.iter().position(|&other| other == node).unwrap_or(0);
    let feet = points.iter().map(|point| {
        let foot = &point.feet[side];
        foot.nodes.into_iter().map(place).zip(foot.shape).collect()
    });
    feet.collect()
}
