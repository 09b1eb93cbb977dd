//! How much of a contact's energy the elements of a body cannot store.
//!
//! An element carries its mean stress. Of Hertz' field, what varies inside of elements is lost:
//!
//! ```math
//! \eta^2 = \frac1U \sum_e \int_e W^*(\sigma - \bar\sigma_e)\, dV, \qquad
//! W^*(\sigma) = \frac{1-2\nu}{6E}(\mathrm{tr}\,\sigma)^2 + \frac{1+\nu}{2E}\,\sigma':\sigma', \qquad
//! U = \tfrac25 F\delta = \frac{2\pi^2}{15}\frac{1-\nu^2}{E}\,p_0^2 a^3 ,
//! ```
//!
//! U being Hertz' energy of one body. The sum is over the whole mesh: elements under the contact, around
//! it, and in depth. Limits: the field is that of a half-space; the sphere's own far field is left out.

use std::f64::consts::PI;

use fem_laws::HertzPressure;
use fem_mesh::SphereMesh;

/// Elements whose middle is nearer to the pole, in contact radii, are under the contact.
const UNDER_CONTACT: f64 = 1.5;
/// Elements that begin so many contact radii away lose nothing: of the field's energy a ten-thousandth lies beyond, and
/// rounding of its closed form would be more.
const FAR: f64 = 1e4;
/// Sub-cells of an integral are not larger than this share of their distance from the contact, ...
const SUB_CELL: f64 = 0.5;
/// ... unless they are smaller than this share of the contact radius anyway, ...
const SMALLEST_SUB_CELL: f64 = 0.25;
/// ... and not more than so many a side: elements that are larger still are bad in any case.
const MOST_SUB_CELLS: f64 = 24.0;

/// What the elements of a part of a body lose, over Hertz' energy of the body.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct Loss {
    /// Part of η².
    pub energy: f64,
    /// The element that loses most, and how much.
    pub worst: (usize, f64),
}

/// What the elements of a body lose.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct BodyLoss {
    /// Under the contact.
    pub under: Loss,
    /// Around it, to the side and in depth.
    pub around: Loss,
}

impl BodyLoss {
    /// Of a mesh whose material has this Poisson's ratio, in a contact of this radius, m.
    pub fn of(mesh: &SphereMesh, poissons_ratio: f64, contact_radius: f64) -> Self {
        let total = 2.0 * PI * PI / 15.0 * (1.0 - poissons_ratio * poissons_ratio);
        let mut losses = Self::default();
        for element in 0..mesh.quads().len() {
            let depth_first = mesh.corners(element).map(|[r, y]| [r, y.abs()]);
            let corners = depth_first.map(|corner| corner.map(|length| length / contact_radius));
            let nearest = corners.iter().map(|[r, z]| r * r + z * z).fold(f64::INFINITY, f64::min);
            if nearest > FAR * FAR {
                continue;
            }
            let lost = element_loss(&corners, poissons_ratio) / total;
            let [r, z] = middle(&corners);
            let part = match r * r + z * z < UNDER_CONTACT * UNDER_CONTACT {
                true => &mut losses.under,
                false => &mut losses.around,
            };
            part.energy += lost;
            if lost > part.worst.1 {
                part.worst = (element, lost);
            }
        }
        losses
    }
}

/// Mean of the corners.
pub(crate) fn middle(corners: &[[f64; 2]; 4]) -> [f64; 2] {
    [0, 1].map(|k: usize| corners.iter().map(|corner| corner[k]).sum::<f64>() / 4.0)
}

/// Length of the longest edge.
pub(crate) fn longest_edge(corners: &[[f64; 2]; 4]) -> f64 {
    let edges = (0..4).map(|a| {
        let (p, q) = (corners[a], corners[(a + 1) % 4]);
        (q[0] - p[0]).powi(2) + (q[1] - p[1]).powi(2)
    });
    edges.fold(0.0, f64::max).sqrt()
}

/// ∫ W*(σ − σ̄) dV of an element, for E, p₀ and a of 1; corners are (r, depth).
fn element_loss(corners: &[[f64; 2]; 4], nu: f64) -> f64 {
    const UNIT: HertzPressure = HertzPressure { contact_radius: 1.0, peak_pressure: 1.0 };
    let gauss = 0.5 / 3.0_f64.sqrt();
    let n = sub_cells(corners);
    let (mut volume, mut sum, mut energy) = (0.0, [0.0; 4], 0.0);
    for cell in 0..n * n {
        for point in 0..4 {
            let offset = [point % 2, point / 2].map(|side: usize| 0.5 + [-gauss, gauss][side]);
            let x = ((cell % n) as f64 + offset[0]) / n as f64;
            let y = ((cell / n) as f64 + offset[1]) / n as f64;
            let ([r, z], jacobian) = place(corners, x, y);
            let weight = 2.0 * PI * r * jacobian.abs() / (4 * n * n) as f64;
            let stress = UNIT.stress(r, z, nu);
            volume += weight;
            energy += weight * complementary_energy(stress, nu);
            for (sum, stress) in sum.iter_mut().zip(stress) {
                *sum += weight * stress;
            }
        }
    }
    // A quadratic form about the mean.
    (energy - volume * complementary_energy(sum.map(|sum| sum / volume), nu)).max(0.0)
}

/// Sub-cells along a side of an element, so that the field is nearly linear in each.
fn sub_cells(corners: &[[f64; 2]; 4]) -> usize {
    let squared = |[r, z]: [f64; 2]| (r - 1.0).max(0.0).powi(2) + z * z;
    let nearest = corners.iter().map(|corner| squared(*corner)).fold(f64::INFINITY, f64::min);
    let nearest = nearest.sqrt();
    let size = (SUB_CELL * nearest).max(SMALLEST_SUB_CELL);
    (longest_edge(corners) / size).ceil().clamp(1.0, MOST_SUB_CELLS) as usize
}

/// Place in an element at (x, y) of the unit square, and the area there over that of the square.
fn place(corners: &[[f64; 2]; 4], x: f64, y: f64) -> ([f64; 2], f64) {
    let [a, b, c, d] = corners;
    let at =
        |k: usize| (1.0 - y) * ((1.0 - x) * a[k] + x * b[k]) + y * ((1.0 - x) * d[k] + x * c[k]);
    let by_x = |k: usize| (1.0 - y) * (b[k] - a[k]) + y * (c[k] - d[k]);
    let by_y = |k: usize| (1.0 - x) * (d[k] - a[k]) + x * (c[k] - b[k]);
    ([at(0), at(1)], by_x(0) * by_y(1) - by_x(1) * by_y(0))
}

/// W* of σ_rr, σ_zz, σ_θθ, σ_rz, for E = 1.
fn complementary_energy([rr, zz, tt, rz]: [f64; 4], nu: f64) -> f64 {
    let trace = rr + zz + tt;
    let shape = [rr, zz, tt].map(|normal| (normal - trace / 3.0).powi(2)).iter().sum::<f64>();
    (1.0 - 2.0 * nu) / 6.0 * trace * trace + 0.5 * (1.0 + nu) * (shape + 2.0 * rz * rz)
}

#[cfg(test)]
mod tests {
    use fem_mesh::HalfDisc;

    use super::*;

    /// So many elements across a contact of this radius.
    fn mesh(elements: f64, contact_radius: f64) -> SphereMesh {
        let half_disc = HalfDisc {
            radius: 400.0 * contact_radius,
            contact_element_size: contact_radius / elements,
            refined_radius: 1.2 * contact_radius,
            growth: None,
        };
        half_disc.build().unwrap()
    }

    /// One element over all of the field has all of its energy: the integral is that of Hertz.
    #[test]
    fn the_energy_of_the_field_is_that_of_the_approach() {
        for nu in [-0.5, 0.0, 0.244, 0.45] {
            // Rings that are as many cells as the integral of one needs.
            let mesh = mesh(8.0, 1.0);
            let total: f64 = (0..mesh.quads().len())
                .map(|element| {
                    let corners = mesh.corners(element);
                    let (n, mut energy) = (sub_cells(&corners), 0.0);
                    for cell in 0..n * n {
                        let [x, y] = [cell % n, cell / n].map(|k| (k as f64 + 0.5) / n as f64);
                        let ([r, z], jacobian) = place(&corners, x, y);
                        let unit = HertzPressure { contact_radius: 1.0, peak_pressure: 1.0 };
                        let weight = 2.0 * PI * r * jacobian / (n * n) as f64;
                        energy += weight * complementary_energy(unit.stress(r, z, nu), nu);
                    }
                    energy
                })
                .sum();
            // What is beyond the sphere's far side is missing: some a/R, 0.0025.
            let exact = 2.0 * PI * PI / 15.0 * (1.0 - nu * nu);
            assert!((total / exact - 1.0).abs() < 0.02, "{nu}: {}", total / exact);
        }
    }

    /// Halved elements lose a quarter, but for the edge of the contact, where stress is not smooth.
    #[test]
    fn the_loss_falls_with_the_square_of_the_size() {
        for nu in [0.0, 0.45] {
            let losses = [4.0, 8.0, 16.0].map(|n| BodyLoss::of(&mesh(n, 1.0), nu, 1.0));
            for pair in losses.windows(2) {
                let ratio = pair[0].under.energy / pair[1].under.energy;
                assert!((3.2..4.2).contains(&ratio), "{nu}: {ratio}");
            }
        }
    }

    /// Lengths count over the contact radius: nothing else has a length.
    #[test]
    fn only_the_size_over_the_contact_counts() {
        let wide = BodyLoss::of(&mesh(4.0, 3e-4), 0.3, 3e-4);
        let narrow = BodyLoss::of(&mesh(4.0, 1.0), 0.3, 1.0);
        for (wide, narrow) in [(wide.under, narrow.under), (wide.around, narrow.around)] {
            assert!((wide.energy / narrow.energy - 1.0).abs() < 1e-9, "{wide:?} {narrow:?}");
            assert_eq!(wide.worst.0, narrow.worst.0);
        }
    }
}
