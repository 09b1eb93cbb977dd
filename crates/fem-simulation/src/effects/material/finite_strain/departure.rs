//! Change of a collision by finite strain, interpolated from computed collisions with and without it.

use std::iter::Sum;
use std::ops::{Add, Mul};

use fem_case::Accuracy;
use fem_material::finite::HyperelasticLaw;

use crate::effects::decision::relevance::percent;

use super::measured::{CHANGES, POISSONS_RATIOS, STRAINS};

/// Contact radius over sphere radius of the flattest computed sphere.
pub(super) const FLATTEST: f64 = STRAINS[STRAINS.len() - 1];

/// Change of a collision by finite strain: absolute for the restitution, relative for the others.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct Departure {
    pub restitution: f64,
    pub contact_time: f64,
    pub peak_force: f64,
    pub peak_pressure: f64,
}

/// Deformation of a body.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Deformation {
    /// Contact radius over effective radius, times the body's share of the compliance.
    pub strain: f64,
    /// Contact radius over the radius of a sphere, or its strain if that is more.
    pub flatness: f64,
}

impl Departure {
    /// Returns the change for an elastic body. Its first order is proportional to the strain, and higher orders depend
    /// on the flatness.
    pub fn of(law: HyperelasticLaw, poissons_ratio: f64, body: Deformation) -> Self {
        let first_order = Self::on_a_wall(law, poissons_ratio, STRAINS[0]);
        let less = (body.flatness - body.strain) / STRAINS[0];
        Self::on_a_wall(law, poissons_ratio, body.flatness) + -less * first_order
    }

    /// Returns the largest difference between two laws up to a deformation, as magnitudes, so that a difference that
    /// reverses its sign does not count as small. `None` is small strain.
    pub fn up_to(
        laws: [Option<HyperelasticLaw>; 2],
        poissons_ratio: f64,
        body: Deformation,
    ) -> Self {
        let ratio = if body.flatness > 0.0 { body.strain / body.flatness } else { 0.0 };
        let before = STRAINS.into_iter().filter(|flatness| *flatness < body.flatness);
        before.chain([body.flatness]).fold(Self::default(), |most, flatness| {
            let here = Deformation { strain: ratio * flatness, flatness };
            let [one, other] = laws
                .map(|law| law.map_or(Self::default(), |law| Self::of(law, poissons_ratio, here)));
            most.or(one + -1.0 * other)
        })
    }

    /// Returns the larger magnitude of each.
    pub fn or(self, other: Self) -> Self {
        let larger = |a: f64, b: f64| a.abs().max(b.abs());
        Self {
            restitution: larger(self.restitution, other.restitution),
            contact_time: larger(self.contact_time, other.contact_time),
            peak_force: larger(self.peak_force, other.peak_force),
            peak_pressure: larger(self.peak_pressure, other.peak_pressure),
        }
    }

    /// Returns the change for an elastic sphere on a rigid wall with Hertz' contact radius over sphere radius. It is linear
    /// between the collisions of [`CHANGES`], proportional below them, and constant beyond the flattest.
    fn on_a_wall(law: HyperelasticLaw, poissons_ratio: f64, strain: f64) -> Self {
        let law = HyperelasticLaw::ALL.iter().position(|one| *one == law).unwrap_or(0);
        let (row, weight) = place(&POISSONS_RATIOS, poissons_ratio);
        let (k, share) = place(&STRAINS, strain);
        let change = |row: usize| {
            let [before, after] = [k, k + 1].map(|k| computed(law, row, k));
            (1.0 - share) * before + share * after
        };
        // Below the least strain, where `place` stays.
        let less = (strain / STRAINS[0]).min(1.0);
        less * ((1.0 - weight) * change(row) + weight * change(row + 1))
    }

    /// Returns the largest change in units of the case's tolerance.
    pub fn over(&self, accuracy: &Accuracy) -> f64 {
        let shares = [
            self.restitution / accuracy.restitution,
            self.contact_time / accuracy.contact_time,
            self.peak_force / accuracy.peak_force,
            self.peak_pressure / accuracy.peak_pressure,
        ];
        shares.into_iter().map(f64::abs).fold(0.0, f64::max)
    }

    /// "1.00 % of the contact time, 1.80 % of the peak force and 5.00 % of the peak pressure".
    pub fn as_text(&self) -> String {
        let shares = [self.contact_time, self.peak_force, self.peak_pressure];
        let [time, force, pressure] = shares.map(|share| percent(share.abs()));
        format!(
            "{time} of the contact time, {force} of the peak force and {pressure} of the peak pressure"
        )
    }
}

/// Returns the computed change, or an extrapolation from the largest computed strain if the sphere collapsed.
fn computed(law: usize, row: usize, k: usize) -> Departure {
    let row = &CHANGES[law][row];
    let borne = (0..=k).rev().find_map(|j| Some((j, row[j]?)));
    borne.map_or(Departure::default(), |(j, change)| {
        STRAINS[k] / STRAINS[j] * Departure::from(change)
    })
}

/// Returns the index of the grid point before a number and the linear weight of the next point, clamped to the grid.
fn place(grid: &[f64], x: f64) -> (usize, f64) {
    let before = grid.partition_point(|point| *point <= x).saturating_sub(1);
    let before = before.min(grid.len() - 2);
    let weight = (x - grid[before]) / (grid[before + 1] - grid[before]);
    (before, weight.clamp(0.0, 1.0))
}

impl From<[f64; 4]> for Departure {
    fn from([restitution, contact_time, peak_force, peak_pressure]: [f64; 4]) -> Self {
        Self { restitution, contact_time, peak_force, peak_pressure }
    }
}

impl Add for Departure {
    type Output = Self;

    fn add(self, other: Self) -> Self {
        Self {
            restitution: self.restitution + other.restitution,
            contact_time: self.contact_time + other.contact_time,
            peak_force: self.peak_force + other.peak_force,
            peak_pressure: self.peak_pressure + other.peak_pressure,
        }
    }
}

impl Mul<Departure> for f64 {
    type Output = Departure;

    fn mul(self, change: Departure) -> Departure {
        Departure {
            restitution: self * change.restitution,
            contact_time: self * change.contact_time,
            peak_force: self * change.peak_force,
            peak_pressure: self * change.peak_pressure,
        }
    }
}

impl Sum for Departure {
    fn sum<I: Iterator<Item = Self>>(changes: I) -> Self {
        changes.fold(Self::default(), Add::add)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn grid_position_is_interpolated_and_clamped() {
        let grid = [1.0, 2.0, 4.0];
        let places =
            [(0.5, (0, 0.0)), (1.0, (0, 0.0)), (3.0, (1, 0.5)), (4.0, (1, 1.0)), (9.0, (1, 1.0))];
        for (x, expected) in places {
            assert_eq!(place(&grid, x), expected, "{x}");
        }
        assert_eq!(place(&grid, f64::NAN).0, 0);
    }

    fn like(strain: f64) -> Deformation {
        Deformation { strain, flatness: strain }
    }

    #[test]
    fn interpolation_passes_through_the_table() {
        let mut n_collapsed = 0;
        for (law, changes) in HyperelasticLaw::ALL.into_iter().zip(&CHANGES) {
            for (nu, row) in POISSONS_RATIOS.into_iter().zip(changes) {
                for (strain, change) in STRAINS.into_iter().zip(row) {
                    let found = Departure::of(law, nu, like(strain));
                    let Some(change) = change else {
                        // St Venant and Kirchhoff's sphere collapsed, and the extrapolation softens further.
                        n_collapsed += 1;
                        let before = Departure::of(law, nu, like(0.7 * strain));
                        assert!(found.contact_time > before.contact_time, "{nu} {strain}");
                        continue;
                    };
                    let expected = Departure::from(*change);
                    for (found, expected) in [
                        (found.restitution, expected.restitution),
                        (found.contact_time, expected.contact_time),
                        (found.peak_force, expected.peak_force),
                        (found.peak_pressure, expected.peak_pressure),
                    ] {
                        assert!((found - expected).abs() < 1e-12, "{law:?} {nu} {strain}");
                    }
                }
            }
        }
        assert!(n_collapsed > 0);
    }

    #[test]
    fn the_first_order_goes_with_the_strain() {
        let of = |strain: f64, flatness: f64| {
            Departure::of(HyperelasticLaw::NeoHooke, 0.45, Deformation { strain, flatness })
        };
        let [half, whole] = [of(0.005, 0.01), of(0.01, 0.01)];
        assert!((half.contact_time - 0.5 * whole.contact_time).abs() < 1e-12);
        let [half, whole] = [of(0.35, 0.7), of(0.7, 0.7)];
        let first_order = 35.0 * of(0.01, 0.01).contact_time;
        assert!((whole.contact_time - half.contact_time - first_order).abs() < 1e-12);
        assert_eq!(half.restitution, whole.restitution);
    }

    #[test]
    fn departure_of_a_law_from_itself_is_zero() {
        for law in HyperelasticLaw::ALL {
            assert_eq!(Departure::up_to([Some(law); 2], 0.3, like(0.4)), Departure::default());
        }
    }

    /// A faster impact has a larger change, so that decisions do not alternate with the speed.
    #[test]
    fn changes_grow_with_the_strain() {
        let accuracy = Accuracy::within(0.01);
        for law in HyperelasticLaw::ALL {
            for nu in [-0.5, 0.0, 0.1, 0.25, 0.33, 0.4, 0.45, 0.47, 0.49, 0.495] {
                let of =
                    |k: i32| Departure::up_to([Some(law), None], nu, like(0.005 * f64::from(k)));
                let shares = (0..200).map(|k| of(k).over(&accuracy));
                assert!(shares.is_sorted(), "{law:?} {nu}");
            }
        }
    }

    #[test]
    fn departure_vanishes_at_zero_strain() {
        for law in HyperelasticLaw::ALL {
            let [none, small] = [0.0, 1e-6].map(|strain| Departure::of(law, 0.3, like(strain)));
            assert_eq!(none.contact_time, 0.0);
            assert!(small.contact_time.abs() < 1e-6 && small.peak_force.abs() < 1e-6);
        }
    }
}
