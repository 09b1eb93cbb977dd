//! Contact profile of condensed bodies, from the axis outward.

use fem_collision::{BodyFields, ContactProfile, ContactProfilePoint};
use fem_contact::{Profile, facing};

use crate::contact::pressure::Pressures;
use crate::error::CondensedError;
use crate::fields::Contact;
use crate::pair::{CondensedPair, surface};

impl CondensedPair {
    /// Returns the contact profile of an instant for given fields and mean motions along the axis (m). `is_whole`
    /// is whether the fields include all motions of the surfaces.
    ///
    /// Radiated waves and slip move all points equally and are not in the fields. The gap is then shifted, so that the
    /// surfaces touch where the pressure is positive.
    pub(crate) fn profile(
        &self,
        contact: &Contact,
        bodies: &[BodyFields; 2],
        centres: [f64; 2],
        is_whole: bool,
    ) -> Result<ContactProfile, CondensedError> {
        let [lower, upper] = self.inputs();
        let surfaces = [surface(lower)?, surface(upper)?];
        let rigid = centres.map(|centre| [[0.0, centre]]);
        let u = [0, 1].map(|s: usize| match bodies[s].displacement.as_slice() {
            [] => rigid[s].as_slice(),
            deformed => deformed,
        });
        let nodes = self.nodal_pressure(&contact.forces);
        let at = |radius: f64| facing(surfaces.each_ref(), 0.0, radius, u);
        let along = nodes.clone().map(|(radius, _)| Some(at(radius)));
        let mut profile = Profile::new(
            nodes,
            self.recover(&contact.forces, &mut Pressures::default()).0,
            self.enforcement(),
            along,
        );
        let beyond = profile.nodes_beyond(surfaces.each_ref(), self.candidate_radius());
        profile = profile.extended(beyond.map(|radius| (radius, at(radius))));
        if !is_whole || self.settings().slip.is_some() {
            self.close(&mut profile);
        }
        let (force, own) = (contact.forces.iter().sum(), profile.contact_radius);
        // Radii of slipping surfaces are halfway between both, as in the history.
        let pressure = profile.points.first().map_or(0.0, |axis| axis.pressure);
        let [wider, denser] = match &self.settings().slip {
            Some(slip) if own > 0.0 && pressure > 0.0 => {
                let (radius, on_axis) = slip.halfway([own, pressure], force, contact.moved);
                [radius / own, on_axis / pressure]
            }
            _ => [1.0; 2],
        };
        profile.contact_radius = wider * own;
        for point in &mut profile.points {
            (point.radius, point.pressure) = (wider * point.radius, denser * point.pressure);
        }
        let profile = profile.closed();
        let places = profile.points.iter().map(|point| ContactProfilePoint {
            is_node: point.is_node,
            radius: point.radius,
            pressure: point.pressure,
            gap: point.gap,
            radial: point.radial,
        });
        Ok(ContactProfile { radius: profile.contact_radius, places: places.collect() })
    }

    /// Shifts all gaps so that their mean under the pressure is the overlap of the springs.
    fn close(&self, profile: &mut Profile) {
        let (mut load, mut open) = (0.0, 0.0);
        for (point, node) in profile.points.iter().zip(&self.nodes) {
            let after = self.points.partition_point(|spring| spring.radius < point.radius);
            let spring = &self.points[after.min(self.points.len() - 1)];
            let force = point.pressure * node.area;
            load += force;
            open += force * (point.gap + point.pressure / spring.stiffness);
        }
        if load > 0.0 {
            profile.points.iter_mut().for_each(|point| point.gap -= open / load);
        }
    }
}
